// SPDX-License-Identifier: Apache-2.0
// See desk.hpp.
#include "runtime/restart/desk.hpp"

#include <cstdio>

#include "runtime/alarm_message.hpp"
#include "runtime/restart/skipped_writes.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"

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

// The program is mirrored about where the axes stand when it is begun.
std::string mirror_sentence(const nc_restart_place& place, const std::string& letters) {
  std::string places;
  unsigned count = 0;
  for (unsigned a = 0; a < letters.size() && a < NC_MAX_AXES; ++a) {
    if ((place.mirror >> a & 1u) == 0) continue;
    char text[40];
    std::snprintf(text, sizeof text, "%s%c%.10g", count++ == 0 ? "" : " ", letters[a], place.start.v[a]);
    places += text;
  }
  if (place.start_given) return "mirror image by the machine about " + places + ": whether the run that was stopped had it is not known";
  return "mirror image by the machine about " + places + (count == 1 ? ", where the axis stands now" : ", where the axes stand now");
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

nc_status RestartDesk::begin(NcPort* nc, unsigned system, const nc_restart_place& place, const nc_world& world, std::string what, const CoordinatesBegun& with, std::uint64_t order) {
  const std::string letters = nc->axis_letters(system);
  const nc_restart_coordinates present = nc->coordinates(system, false);
  nc_status status = with.known ? nc->set_coordinates(system, coordinates_of(with, letters)) : NC_OK;
  if (status >= 0) status = nc->restart_begin(system, place, world);
  if (status < 0) {
    if (with.known) (void)nc->set_coordinates(system, present);
    return status;
  }
  system_ = system;
  coordinates_before_ = present;
  order_ = order;
  to_confirm_.clear();
  const std::string begins_with = coordinates_text(coordinate_rows(nc->coordinates(system, true), letters));
  if (!begins_with.empty() && with.known) what += ", begun with " + begins_with;
  if (!begins_with.empty() && !with.known) to_confirm_.push_back(begins_with + " in force at the beginning");
  if (place.mirror != 0 && !(place.start_given && with.mirror_known)) to_confirm_.push_back(mirror_sentence(place, letters));
  before_ = after_ = {};
  written_ = true;
  before_known_ = after_known_ = false;
  place_ = place;
  status_ = {};
  status_.phase = RestartPhase::kSearching;
  status_.text = std::move(what);
  return status;
}

bool RestartDesk::search(NcPort* nc, unsigned system) {
  if (!before_known_) before_ = {nc->variables(), nc->tables()}, before_known_ = true;
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
  nc_variable_range local{};
  (void)nc_variable_kind_get(nc->dialect(), NC_VARIABLES_LOCAL, &local);
  if (const std::string writes = skipped_writes(before_, after_, system, local); !writes.empty()) status_.list.begin_with("written in front of the place: " + writes);
  for (auto text = to_confirm_.rbegin(); text != to_confirm_.rend(); ++text) status_.list.begin_with(*text);
  coordinates_after_ = nc->coordinates(system, false);
  after_known_ = true;
}

bool RestartDesk::owes_values(NcPort* nc) const {
  if (!owes() || !before_known_) return false;
  const KeptValues left = after_known_ ? after_ : KeptValues{nc->variables(), nc->tables()};
  return left.variables != before_.variables || left.tables != before_.tables;
}

// A search that has ended on its way has left what is there now.
void RestartDesk::put_back(NcPort* nc) {
  if (!owes()) return;
  const nc_restart_coordinates now = nc->coordinates(system_, false);
  if (!after_known_) after_ = {nc->variables(), nc->tables()}, coordinates_after_ = now;
  if (before_known_) nc->put_back(before_, after_);
  (void)nc->set_coordinates(system_, coordinates_without(coordinates_before_, coordinates_after_, now));
  written_ = false;
  before_ = after_ = {};
}

std::string RestartDesk::kept_variables(const std::string& now) const {
  return written_ && before_known_ ? variables_without(before_.variables, after_known_ ? after_.variables : now, now) : now;
}

std::string RestartDesk::kept_tables(const std::string& now) const {
  return written_ && before_known_ ? tables_without(before_.tables, after_known_ ? after_.tables : now, now) : now;
}

void RestartDesk::follow(const Snapshot& now, unsigned system) {
  if (searching() && now.mode != Mode::kAuto) return lose("another mode has been chosen");
  if (status_.phase != RestartPhase::kFound && status_.phase != RestartPhase::kStands) return;
  const nc_outputs& out = now.system[system].nc;
  status_.list.look(out, now.interface_output);
  if (out.state == NC_STATE_ALARM) return lose("an alarm has come");
  if (status_.phase == RestartPhase::kFound) {
    if (out.state == NC_STATE_STOPPED) status_.phase = RestartPhase::kStands;
    return;
  }
  // Blocks of MDI run in their own mode, and do not count. What is left of the program may have come to its end since the last look.
  const bool runs = out.state == NC_STATE_RUNNING && now.mode == Mode::kAuto;
  if (runs || out.blocks > status_.found.blocks) {
    written_ = false;
    return end("the program has gone on");
  }
  if (out.state == NC_STATE_IDLE) lose("the program has been given up");
}

void RestartDesk::end(const std::string& why) {
  if (!in_hand() && !lost()) return;
  status_.phase = RestartPhase::kEnded;
  status_.text = why;
}

void RestartDesk::lose(const std::string& why) {
  if (in_hand()) bar_start(why);
}

void RestartDesk::bar_start(const std::string& why) {
  status_.phase = RestartPhase::kLost;
  status_.text = why;
}

}  // namespace nc::rt
