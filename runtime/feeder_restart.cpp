// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, in the feeder: the place that the operator names, the search beside the other work, and where programs have stopped.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/feeder.hpp"
#include "runtime/retain/place.hpp"

namespace nc::rt {
namespace {

std::string place_words(const RestartWish& wish) {
  constexpr const char* kWords[] = {"behind block ", "sequence number ", "line ", "", ""};  // in the order of RestartBy
  std::string text = kWords[static_cast<unsigned>(wish.by)] + std::to_string(wish.number);
  if (!wish.file.empty()) text += " of " + wish.file;
  if (wish.passing > 1) text += ", time " + std::to_string(wish.passing);
  return text;
}

// The cause of a kept stop behind which its program has been begun again. Where that run has stopped is known only when the control sees it.
constexpr const char* kOutdated = "outdated";

}  // namespace

void Feeder::set_restart_wish(const RestartWish& wish) {
  const std::lock_guard lock(mutex_);
  wish_ = wish;
}

// ---- commands ----

// The answer comes when the search has begun.
Answer Feeder::find_restart(const Command& command) {
  RestartWish wish;
  {
    const std::lock_guard lock(mutex_);
    wish = wish_;
  }
  return look_for(command, wish);
}

Answer Feeder::look_for(const Command& command, const RestartWish& wish) {
  const unsigned s = command.system;
  if (seen_.mode != Mode::kAuto) return Answer::kNotInThisMode;
  if (!system_[s].selected || system_[s].mdi) return Answer::kNoProgram;
  nc_restart_place place;
  nc_restart_place_init(&place);
  std::string what;
  CoordinatesBegun with;
  const bool known = wish.by < RestartBy::kPowerOff ? restart_place(s, wish, &place, &what) : stopped_place(s, wish, &place, &what, &with);
  if (!known) return refuse(Answer::kNoPlace, what);
  if (gate_ != nullptr && !gate_->may_begin(s, system_[s].file)) return Answer::kNotChecked;  // the search executes what the program writes
  place.mirror = seen_.system[s].mirror;
  nc_world world;
  nc_world_init(&world);
  std::copy(std::begin(seen_.interface_input), std::end(seen_.interface_input), world.input);
  world.clock_ms = seen_.clock_ms;
  std::copy(std::begin(seen_.system[s].tool_angle), std::end(seen_.system[s].tool_angle), world.tool_angle);
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  scan_->set_loaded(Scan::kNothingLoaded);  // until the end of this step: by then the scan knows of the search
  restart_[s].lose("another place is looked for");
  put_back_searched();
  const nc_status status = restart_[s].begin(nc_, s, place, world, what, with, ++searches_);
  if (status < 0) return refuse(Answer::kRefusedByControl, std::string("the place cannot be looked for: ") + nc_status_text(status));
  follow_restart();
  return Answer::kDone;
}

bool Feeder::restart_place(unsigned s, const RestartWish& wish, nc_restart_place* place, std::string* what) {
  place->by = static_cast<std::uint8_t>(wish.by);
  place->number = wish.number;
  place->passing = wish.passing;
  place->start = seen_.system[s].nc.command;  // where the axes are now
  const int file = wish.file.empty() ? 0 : nc_->program_of(wish.file);
  place->in_file = !wish.file.empty();
  place->file = static_cast<std::uint16_t>(std::max(file, 0));
  *what = file < 0 ? "the control has no program \"" + wish.file + "\" now: it has been neither selected nor called" : place_words(wish);
  return file >= 0;
}

// Where the program was stopped, by whatever, or where it was when the power failed. It must be the same program still.
bool Feeder::stopped_place(unsigned s, const RestartWish& wish, nc_restart_place* place, std::string* what, CoordinatesBegun* with) {
  const bool power = wish.by == RestartBy::kPowerOff;
  const Stops& stops = stops_[s];
  const ProgramPlace& at = power ? stops.power : stops.last;
  const char* const when = power ? "when the power failed" : "at the last stop";
  const auto refused = [&](std::string why) {
    *what = std::move(why);
    return false;
  };
  if (!(power ? stops.any_power : stops.any)) return refused(power ? "it is not known where a program was when the power failed" : "no stop of a program before its end is known");
  if (!at.restartable) return refused("what was kept of the place does not tell how many blocks had been executed: name a line or a sequence number");
  const std::string name = nc_->program_name(system_[s].file);
  if (at.cause == kOutdated && name == at.program)
    return refused("it is not known: the control has ended in a later run of " + name + " than that of the stop that was kept. Name a line or a sequence number");
  if (name != at.program) return refused(std::string(when) + " the program was " + at.program + ", and " + name + " is selected");
  if (nc_->program_size(system_[s].file) != at.size || (!at.hash.empty() && at.hash != stops.hash))
    return refused("the program has been changed since: the place " + std::string(when) + " is another one in it. Name a line or a sequence number");
  const std::string letters = nc_->axis_letters(s), mirrored = mirrored_axes(seen_.system[s].mirror, letters);
  if (at.coordinates.mirror_known && at.coordinates.mirrored != mirrored)
    return refused("the machine's switches (plc.mirror) mirror " + axes_words(mirrored) + ", and the run that was stopped was begun with " + axes_words(at.coordinates.mirrored) +
                   ": set them as they were, or name a line or a sequence number");
  place->by = NC_RESTART_BLOCK;
  place->number = at.blocks;
  place->start_given = true;
  for (const auto& [axis, value] : at.begun)
    if (const std::size_t index = letters.find(axis); index != std::string::npos) place->start.v[index] = value;
  *with = at.coordinates;
  *what = "behind block " + std::to_string(at.blocks) + ", " + when;
  return true;
}

Answer Feeder::confirm_restart(const Command& command) {
  RestartDesk& desk = restart_[command.system];
  if (!desk.in_hand() || desk.searching()) return refuse(Answer::kNoPlace, "no place has been found: there is nothing to be confirmed");
  if (command.number != kEveryEntry && command.number >= desk.status().list.entries().size()) return Answer::kOutOfRange;
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  if (command.number == kEveryEntry) desk.list()->confirm_all();
  else (void)desk.list()->confirm(command.number);
  follow_restart();
  return Answer::kDone;
}

Answer Feeder::cancel_restart(const Command& command) {
  RestartDesk& desk = restart_[command.system];
  if (!desk.in_hand() && !desk.lost()) return refuse(Answer::kNoPlace, "no place is looked for or found");
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  scan_->set_loaded(Scan::kNothingLoaded);
  if (const nc_status status = nc_->restart_cancel(command.system); status < 0)
    return refuse(Answer::kRefusedByControl, std::string("it cannot be cancelled: ") + nc_status_text(status));
  desk.end("it was cancelled");
  follow_restart();
  return Answer::kDone;
}

// ---- each step ----

void Feeder::follow_restart() {
  for (GivenCode code; scan_->poll_given(&code);)
    if (code.system < systems_) restart_[code.system].given(code);
  for (unsigned s = 0; s < systems_; ++s) {
    RestartDesk& desk = restart_[s];
    const bool searched = desk.searching();
    if (searched && (seen_.resetting || scan_->reset_waits())) desk.reset();  // the control gives the search up, which is no place that was not found
    desk.follow(seen_, s);
    bool again = searched && !desk.searching();
    if (desk.searching() && may_search(s)) again = desk.search(nc_, s);
    // What was read on the way is not what a start should find: that begins at the head of the program.
    if (again && system_[s].selected && !system_[s].mdi) {
      scan_->set_loaded(Scan::kNothingLoaded);
      if (const nc_status status = nc_->select(s, system_[s].file); status < 0 && status != NC_E_STATE) system_[s] = {};
    }
  }
  tell_restart();
}

// One search after the other, and none before what an earlier one has written is put back.
bool Feeder::may_search(unsigned s) const {
  for (unsigned other = 0; other < systems_; ++other) {
    const RestartDesk& desk = restart_[other];
    if (other != s && (desk.owes() || (desk.searching() && desk.order() < restart_[s].order()))) return false;
  }
  return true;
}

std::vector<unsigned> Feeder::newest_search_first() const {
  std::vector<unsigned> order(systems_);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [this](unsigned a, unsigned b) { return restart_[a].order() > restart_[b].order(); });
  return order;
}

// Several part systems that are begun inside are as if each had come to its place behind those that were looked for before, and in front of the others. So a place stays
// when the values are put back that a later search has written, or an earlier one that has written nothing; it is lost with those that it was found with.
std::uint32_t Feeder::places_that_stay() const {
  std::uint32_t stay = 0;
  for (unsigned s = 0; s < systems_; ++s) {
    const auto was_read_with = [&](const RestartDesk& other) { return other.order() < restart_[s].order() && other.owes_values(nc_); };
    if (restart_[s].in_hand() && std::none_of(restart_, restart_ + systems_, was_read_with)) stay |= 1u << s;
  }
  return stay;
}

// What searches have written whose programs do not go on from their places. Programs that are ready to start are read again, because that are other values.
void Feeder::put_back_searched() {
  if (std::none_of(restart_, restart_ + systems_, [](const RestartDesk& desk) { return desk.owes(); })) return;
  const std::uint32_t stay = places_that_stay();
  const RestartDesk* const with = std::find_if(restart_, restart_ + systems_, [this](const RestartDesk& desk) { return desk.owes_values(nc_); });
  const std::string why = "what the search in part system " + std::to_string(with - restart_ + 1) + " had written was put back, and this place was found with it";
  if (read_again(stay, why.c_str()) == NC_E_STATE) return;
  for (const unsigned s : newest_search_first()) restart_[s].put_back(nc_);
  (void)read_again(stay);  // cannot be refused now: nothing could be started since the first time
}

// To the scan, before it may begin what this step has loaded, and to who shows it.
void Feeder::tell_restart() {
  std::uint32_t searches = 0, found = 0, bars = 0, stands = 0, lost = 0;
  for (unsigned s = 0; s < systems_; ++s) {
    const RestartDesk& desk = restart_[s];
    searches |= static_cast<std::uint32_t>(desk.searching()) << s;
    found |= static_cast<std::uint32_t>(desk.status().phase == RestartPhase::kFound) << s;
    bars |= static_cast<std::uint32_t>(desk.bars()) << s;
    stands |= static_cast<std::uint32_t>(desk.status().phase == RestartPhase::kStands) << s;
    lost |= static_cast<std::uint32_t>(desk.lost()) << s;
  }
  scan_->set_restart(searches, found, bars, stands, lost);
  const std::lock_guard lock(mutex_);
  for (unsigned s = 0; s < systems_; ++s)
    if (restart_[s].status().phase != RestartPhase::kNone) info_.system[s].restart = restart_[s].status();
}

// Notes where a part program is that is in execution or interrupted, and keeps that when it ends before its end.
void Feeder::follow_stops() {
  const std::uint32_t failed = scan_->power_failed_in();
  for (unsigned s = 0; s < systems_; ++s) {
    Stops& stops = stops_[s];
    const std::uint8_t state = seen_.system[s].nc.state;
    const bool by_hand = stops.runs && state == NC_STATE_MANUAL;  // in a block stop
    const bool runs = system_[s].selected && !system_[s].mdi && (state == NC_STATE_RUNNING || state == NC_STATE_HOLD || state == NC_STATE_STOPPED || by_hand);
    if (runs && !stops.runs) {
      const RestartPhase phase = restart_[s].status().phase;
      stops.begun = phase == RestartPhase::kFound || phase == RestartPhase::kStands ? restart_[s].start() : seen_.system[s].begun;
      stops.coordinates = coordinate_rows(nc_->coordinates(s, true), nc_->axis_letters(s));
      stops.coordinates.mirror_known = true;
      stops.coordinates.mirrored = mirrored_axes(seen_.system[s].mirror, nc_->axis_letters(s));
    }
    const bool stopped = stops.runs && !runs;
    if (runs || (stopped && state == NC_STATE_ALARM)) stops.now = place_of(s, seen_);
    if (stopped) stops.now.blocks = std::max(stops.now.blocks, seen_.system[s].nc.blocks);  // finished since the last step
    stops.runs = runs;
    if (!stopped || !stops.now.restartable) continue;
    if (system_[s].ended && !system_[s].alarmed) {
      if (stops.any && stops.last.program == stops.now.program) stops.any = stops.any_power = false;
      continue;
    }
    stops.last = stops.now;
    stops.last.cause = (failed >> s & 1u) != 0 ? "power" : state == NC_STATE_ALARM ? "alarm" : "reset";
    stops.any = true;
    if (stops.last.cause != "power") continue;
    stops.power = stops.last;
    stops.any_power = true;
  }
}

// While a program runs the stop that is kept of an earlier run of it is outdated, so that a control that is killed in the run does not offer that stop. It is
// written when the run begins, once, and only where a stop is kept.
std::string Feeder::stop_bytes() const {
  std::vector<ProgramPlace> places;
  for (unsigned s = 0; s < systems_; ++s) {
    const Stops& stops = stops_[s];
    const bool goes_on = stops.runs && !restart_[s].in_hand();
    const auto outdated = [&](const ProgramPlace& place) { return goes_on && place.program == stops.now.program; };
    if (stops.any_power && !outdated(stops.power) && !(stops.any && stops.power == stops.last)) places.push_back(stops.power);
    if (!stops.any) continue;
    places.push_back(stops.last);
    if (outdated(stops.last)) places.back().cause = kOutdated;
  }
  return encode_places(places);
}

void Feeder::set_stops(const std::vector<ProgramPlace>& places) {
  for (const ProgramPlace& place : places) {
    if (place.system >= systems_) continue;
    Stops& stops = stops_[place.system];
    stops.last = place;
    stops.any = true;
    if (place.cause == "reset" || place.cause == "alarm" || place.cause == kOutdated) continue;
    stops.power = place;
    stops.any_power = true;
  }
}

}  // namespace nc::rt
