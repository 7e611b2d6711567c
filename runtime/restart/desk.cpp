// SPDX-License-Identifier: Apache-2.0
// See desk.hpp.
#include "runtime/restart/desk.hpp"

#include "runtime/alarm_message.hpp"

namespace nc::rt {
namespace {

// Of one step of the feeder, which has other work as well.
constexpr std::uint32_t kSearchBudget = 256;
constexpr unsigned kSearchCalls = 4;

// The alarm at which the program has stopped on its way to the place.
std::string alarm_sentence(NcPort* nc, unsigned system) {
  nc_alarm alarm;
  nc_alarm_init(&alarm);
  if (nc->alarm(system, &alarm) != NC_OK) return "the program has stopped with an alarm on the way there";
  const std::string text = "the program has stopped on the way there: " + std::string(alarm.code) + " " + alarm_message(alarm);
  return alarm.source.line == 0 ? text : text + " (line " + std::to_string(alarm.source.line) + ")";
}

std::string why_not(NcPort* nc, unsigned system, nc_status status) {
  switch (status) {
    case NC_ENDED: return "the program has ended before it came there";
    case NC_ALARMED: return alarm_sentence(nc, system);
    case NC_E_NOT_FOUND: return "there is no such sequence number, or the program cannot begin there: a call amid a contour, or blocks that hang together";
    case NC_E_STATE: return "the control has given the search up";
    default: return std::string("the search has failed: ") + nc_status_text(status);
  }
}

}  // namespace

const char* restart_phase_text(RestartPhase phase) {
  switch (phase) {
    case RestartPhase::kNone: return "none";
    case RestartPhase::kSearching: return "searching";
    case RestartPhase::kFound: return "found";
    case RestartPhase::kStands: return "stands";
    case RestartPhase::kLost: return "lost";
    case RestartPhase::kEnded: return "ended";
  }
  return "?";
}

nc_status RestartDesk::begin(NcPort* nc, unsigned system, const nc_restart_place& place, const nc_world& world, std::string what) {
  const nc_status status = nc->restart_begin(system, place, world);
  if (status < 0) return status;
  before_ = {nc->variables(), nc->tables()};
  written_ = true;
  after_known_ = false;
  place_ = place;
  status_ = {};
  status_.phase = RestartPhase::kSearching;
  status_.text = std::move(what);
  return status;
}

bool RestartDesk::search(NcPort* nc, unsigned system) {
  for (unsigned call = 0; call < kSearchCalls; ++call) {
    nc_restart_found place;
    nc_restart_found_init(&place);
    const nc_status status = nc->restart_find(system, kSearchBudget, &place);
    if (status == NC_BUDGET) {
      status_.read += kSearchBudget;
      continue;
    }
    if (status == NC_OK) {
      found(nc, system, place);
      return false;
    }
    lose(status_.text + ": " + why_not(nc, system, status));
    return true;
  }
  return false;
}

void RestartDesk::found(NcPort* nc, unsigned system, const nc_restart_found& place) {
  status_.phase = RestartPhase::kFound;
  status_.found = place;
  status_.read = place.blocks;
  status_.program = nc->program_name(place.source.file);
  nc_modal_init(&status_.modal);
  status_.modal_known = place.modal != 0 && nc->modal(system, place.modal, &status_.modal) == NC_OK;
  status_.list.begin(place, nc->dialect());
  after_ = {nc->variables(), nc->tables()};
  after_known_ = true;
}

// A search that has ended on its way has left what is there now.
void RestartDesk::put_back(NcPort* nc) {
  if (!owes()) return;
  if (!after_known_) after_ = {nc->variables(), nc->tables()};
  nc->put_back(before_, after_);
  written_ = false;
  before_ = after_ = {};
}

void RestartDesk::follow(const Snapshot& now, unsigned system) {
  if (searching() && now.mode != Mode::kAuto) return lose("another mode has been chosen");
  if (status_.phase != RestartPhase::kFound && status_.phase != RestartPhase::kStands) return;
  const nc_outputs& out = now.system[system].nc;
  status_.list.look(out, now.interface_output);
  if (out.state == NC_STATE_ALARM) return end("an alarm has come");
  if (status_.phase == RestartPhase::kFound) {
    if (out.state == NC_STATE_STOPPED) status_.phase = RestartPhase::kStands;
    return;
  }
  if (out.state == NC_STATE_IDLE) return end("the program has been given up");
  // Blocks of MDI run in their own mode, and do not count.
  const bool runs = out.state == NC_STATE_RUNNING && now.mode == Mode::kAuto;
  if (!runs && out.blocks <= status_.found.blocks) return;
  written_ = false;
  end("the program has gone on");
}

void RestartDesk::end(const std::string& why) {
  if (!in_hand() && !lost()) return;
  status_.phase = RestartPhase::kEnded;
  status_.text = why;
}

void RestartDesk::lose(const std::string& why) {
  if (!in_hand()) return;
  status_.phase = RestartPhase::kLost;
  status_.text = why;
}

}  // namespace nc::rt
