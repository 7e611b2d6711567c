// SPDX-License-Identifier: Apache-2.0
// See restart.hpp.
#include "runtime/services/restart.hpp"

#include <algorithm>

#include "runtime/share/publisher.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

// What the program has asked of what is outside of it. The rest of the bits the control has answered by itself.
Json asked_json(std::uint32_t asked) {
  struct Row {
    std::uint32_t bit;
    const char* name;
  };
  constexpr Row kAsked[] = {{NC_SYNC_INPUT, "inputs"}, {NC_SYNC_CLOCK, "clock"}, {NC_SYNC_SKIP, "skip"}};
  Json list = Json::array();
  for (const Row& row : kAsked)
    if ((asked & row.bit) != 0) list.push_back(row.name);
  return list;
}

Json codes_json(const RecoveryList& list) {
  Json codes = Json::array();
  for (const RecoveryEntry& entry : list.entries()) codes.push_back({{"entry", codes.size() + 1}, {"code", list.text(entry)}, {"state", recovery_state_text(entry.state)}});
  return codes;
}

Json axes_json(const nc_system_config& axes, const nc_outputs& out, const RestartStatus& status) {
  const bool known = status.phase == RestartPhase::kFound || status.phase == RestartPhase::kStands;
  const bool held = !known && (out.state == NC_STATE_HOLD || out.restart_axes != 0);
  const std::uint32_t away = known || held ? out.restart_axes : out.moved_by_hand;
  const nc_axes& place = held ? out.return_place : status.found.machine;
  Json list = Json::array();
  for (unsigned a = 0; a < axes.axis_count; ++a) {
    Json axis = {{"name", std::string(1, axes.axis[a].name)}, {"machine", out.command.v[a]}, {"away", (away >> a & 1u) != 0}};
    if (known || held) axis["place"] = place.v[a];
    if (known || held) axis["to_go"] = place.v[a] - out.command.v[a];
    list.push_back(std::move(axis));
  }
  return list;
}

}  // namespace

std::string restart_words(const share::Request& r) {
  constexpr const char* kWays[] = {"behind block ", "sequence number ", "line ", "power off", "last stop"};  // in the order of RestartBy
  if (r.axis >= static_cast<std::uint32_t>(RestartBy::kCount)) return "";
  std::string text = kWays[r.axis];
  if (r.axis < static_cast<std::uint32_t>(RestartBy::kPowerOff)) text += std::to_string(static_cast<std::uint64_t>(std::clamp(r.value, 0.0, 1e15)));
  if (const std::string file(share::text_of(r.text)); !file.empty()) text += " of " + file;
  return r.number > 1 ? text + ", time " + std::to_string(r.number) : text;
}

Outcome show_restart(Runtime* runtime, const Call& call) {
  const nc_config& nc = runtime->config().nc;
  const auto system = static_cast<unsigned>(call.value_or(Field::kSystem, 1));
  if (system == 0 || system > nc.system_count) return Outcome::refused(Refused::kMalformed, "no such part system");
  const unsigned s = system - 1;
  const RestartStatus status = runtime->info().system[s].restart;
  const nc_outputs out = runtime->snapshot().system[s].nc;
  const nc_restart_found& found = status.found;
  const std::uint32_t kept = std::min<std::uint32_t>(found.m_count, NC_RESTART_CODES);
  const bool modal = status.modal_known && runtime->control() != nullptr;
  return Outcome::with({{"system", system},
                        {"phase", restart_phase_text(status.phase)},
                        {"text", status.text},
                        {"read", status.read},
                        {"file", status.program},
                        {"line", found.source.line},
                        {"program", found.source.program},
                        {"depth", found.source.depth},
                        {"blocks", found.blocks},
                        {"modal", modal ? share::modal_text(runtime->control(), status.modal) : std::string()},
                        {"asked", asked_json(found.asked)},
                        {"axes", axes_json(nc.system[s], out, status)},
                        {"codes", codes_json(status.list)},
                        {"open", status.list.open()},
                        {"left_out", found.m_count - kept}});
}

}  // namespace nc::rt::services
