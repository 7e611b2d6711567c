// SPDX-License-Identifier: Apache-2.0
// See ladder.hpp.
#include "runtime/services/ladder.hpp"

#include <optional>

#include "runtime/ladder_task.hpp"

namespace nc::rt::services {
namespace {

constexpr auto kScanPatience = std::chrono::milliseconds(500);  // within which the scan answers
// At 1 ms one scan in two hundred at most notes its power flow, so the 99th percentile of the scan does not feel it.
constexpr auto kFlowPause = std::chrono::milliseconds(200);

// A device that an operand names, and which of its bits: "D0.5" is bit 5 of D0.
struct Named {
  const ladder::Device* device = nullptr;
  int bit = -1;  // -1 = the whole device

  std::int32_t part_of(std::int32_t value) const { return bit == -1 ? value : static_cast<std::int32_t>(static_cast<std::uint32_t>(value) >> bit & 1u); }
};

Named find(const LadderTask& task, const std::string& operand) {
  if (const ladder::Device* device = task.find_device(operand)) return {device};
  constexpr std::string_view kBits = "0123456789ABCDEF";
  if (operand.size() < 3 || operand[operand.size() - 2] != '.') return {};
  const std::size_t bit = kBits.find(operand.back());
  const ladder::Device* device = bit == std::string_view::npos ? nullptr : task.find_device(operand.substr(0, operand.size() - 2));
  if (device == nullptr || device->type == ladder::DeviceType::kBit) return {};
  return {device, static_cast<int>(bit)};
}

Outcome no_ladder() { return Outcome::refused(Refused::kNotFound, "the machine has no ladder program"); }
Outcome no_scan() { return Outcome::refused(Refused::kNotReached, "the scan does not run"); }

}  // namespace

Outcome LadderDesk::list_rungs(const Call& call) {
  LadderTask* const task = runtime_.ladder();
  if (task == nullptr) return no_ladder();
  const ladder::Program& program = task->program();
  const auto now = std::chrono::steady_clock::now();
  const bool anew = flow_.size() != program.flow_bytes() || now - flow_time_ >= kFlowPause;
  const auto from = static_cast<unsigned>(call.value_or(Field::kFrom, 0)), count = static_cast<unsigned>(call.value_or(Field::kCount, kWholePage));
  if (from > program.line_count()) return Outcome::refused(Refused::kNotFound, "the program has " + std::to_string(program.line_count()) + " lines");

  const std::vector<ladder::ListedLine> plain = program.listing(from, count, nullptr);
  std::vector<LadderLook::Source> sources;
  std::vector<Named> named;  // of all operands, in their order
  for (const ladder::ListedLine& line : plain)
    for (const std::string& operand : line.operands)
      if (named.push_back(find(*task, operand)); named.back().device != nullptr) sources.push_back({named.back().device->type, named.back().device->index});
  LadderLook& look = task->look();
  if (!look.take(std::move(sources), anew ? program.flow_bytes() : 0, kScanPatience)) return no_scan();
  if (anew) {
    flow_ = look.flow();
    flow_scan_ = look.scan();
    flow_time_ = now;
  }

  Json lines = Json::array();
  auto next_named = named.cbegin();
  auto next_value = look.values().cbegin();
  unsigned next = 0;
  for (const ladder::ListedLine& line : program.listing(from, count, flow_.data(), &next)) {
    Json operands = Json::array();
    for (const std::string& operand : line.operands) {
      Json shown = {{"name", operand}};
      const Named& of = *next_named++;
      if (of.device != nullptr) shown["value"] = of.part_of(*next_value++);
      operands.push_back(std::move(shown));
    }
    Json& shown = lines.emplace_back(Json{{"line", line.line}, {"rung", line.rung}, {"instruction", line.instruction}, {"operands", std::move(operands)}});
    if (line.power != ladder::ListedLine::Power::kNone) shown["power"] = line.power == ladder::ListedLine::Power::kOn;
  }
  return Outcome::with({{"file", program.file()}, {"flow_scan", flow_scan_}, {"scan", look.scan()}, {"lines", std::move(lines)}, {"next", next}});
}

Outcome LadderDesk::list_devices(const Call& call) {
  LadderTask* const task = runtime_.ladder();
  if (task == nullptr) return no_ladder();
  const std::vector<std::string>& names = call.list(Field::kDevices);
  std::vector<LadderLook::Source> sources;
  std::vector<Named> named;
  for (const std::string& name : names) {
    named.push_back(find(*task, name));
    if (named.back().device == nullptr) return Outcome::refused(Refused::kNotFound, "there is no device \"" + name + "\"");
    sources.push_back({named.back().device->type, named.back().device->index});
  }
  LadderLook& look = task->look();
  if (!look.take(std::move(sources), 0, kScanPatience)) return no_scan();
  const ForceList forces = runtime_.snapshot().forces;
  Json list = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ladder::Device& device = *named[i].device;
    bool forced = false;
    for (unsigned f = 0; f < forces.count; ++f) forced |= task->find_device(runtime_.forced_name(forces.device[f].number)) == &device;
    list.push_back({{"name", names[i]},
                    {"type", named[i].bit == -1 ? ladder::type_name(device.type) : "bit"},
                    {"value", named[i].part_of(look.values()[i])},
                    {"forced", forced},
                    {"meaning", device.comment}});
  }
  return Outcome::with({{"scan", look.scan()}, {"devices", std::move(list)}});
}

}  // namespace nc::rt::services
