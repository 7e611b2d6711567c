// SPDX-License-Identifier: Apache-2.0
// See foresight.hpp.
#include "tools/lib/foresight.hpp"

#include <algorithm>
#include <utility>

namespace nc::tools {
namespace {

bool listens(const nc_item& item) {
  return item.kind == NC_ITEM_SYNC || (item.kind == NC_ITEM_MOVE && item.u.move.kind == NC_MOVE_SKIP) ||
         (item.kind == NC_ITEM_GATE && item.u.gate.skip_mask != 0);
}

bool commands_reset(const SetupEvent& event) {
  const auto reset = event.signals.find("reset");
  return reset != event.signals.end() && reset->second != 0;
}

}  // namespace

bool Foresight::commit(const nc_item& item, uint32_t main_line) {
  if (over_) return false;
  if (item.serial <= committed_) go_back(item.serial);
  committed_ = item.serial;
  if (item.kind != NC_ITEM_SYNC) probe_ = {};
  Entry entry;
  entry.serial = item.serial;
  entry.events = world_.schedule().take(item, main_line);
  entry.listens = listens(item);
  entry.put_off = std::any_of(entry.events.begin(), entry.events.end(), [](const SetupEvent* event) { return commands_reset(*event); });
  const bool put_off = entry.put_off;
  if (!put_off && item.kind == NC_ITEM_MOVE && entry.listens) {
    const nc_move& move = item.u.move;
    probe_ = {item.serial, world_.take_hit(item.source, move), move.machine_start, {}, 0.0, move.skip_away};
    for (unsigned a = 0; a < axis_count_; ++a) probe_.by.v[a] = move.machine.v[a] - move.machine_start.v[a];
  }
  if (entry.listens || !entry.events.empty()) ahead_.push_back(std::move(entry));
  return !put_off;
}

// Undoes what was committed from this item on: it is read again, or it was put off and now comes again.
void Foresight::go_back(uint64_t serial) {
  for (; !ahead_.empty() && ahead_.back().serial >= serial; ahead_.pop_back())
    for (const SetupEvent* event : ahead_.back().events)
      if (!ahead_.back().fired) world_.schedule().put_back(event);
  if (probe_.serial < serial) return;
  if (executed_ < probe_.serial) world_.put_back(probe_.touch);
  probe_ = {};
}

bool Foresight::fire(uint64_t begun) {
  for (Entry& entry : ahead_) {
    if (entry.fired) continue;
    if (entry.serial > begun && !(entry.put_off && executed_ + 1 >= entry.serial)) break;
    entry.fired = true;
    for (const SetupEvent* event : entry.events) world_.fire(*event);
  }
  while (!ahead_.empty() && ahead_.front().fired && ahead_.front().serial <= executed_) ahead_.pop_front();
  world_.fire_by_time();
  over_ = over_ || world_.reset();
  return over_;
}

// Serial of the first listener that has not been executed; 0 = no such listener is committed.
uint64_t Foresight::next_listener() const {
  for (const Entry& entry : ahead_)
    if (entry.listens && entry.serial > executed_) return entry.serial;
  return 0;
}

OutsideSignals Foresight::signals(const nc_axes& command, const nc_axes& work) {
  OutsideSignals found = world_.signals();
  const uint64_t listener = next_listener();
  for (const Entry& entry : ahead_) {
    if (entry.serial > listener) break;
    if (entry.fired) continue;
    for (const SetupEvent* event : entry.events) found.change(*event);
  }
  found.skip |= world_.solids_at(command, work);
  const bool probing = probe_.serial != 0 && (listener == probe_.serial || executed_ >= probe_.serial);
  const bool leaves = probe_.away && probe_.touch.hit != SIZE_MAX;  // the signal is on until the place of the hit has come
  if (probing && touches(command) != leaves) found.skip |= 1u << (probe_.touch.signal - 1);
  return found;
}

// True when the place of the touch would be passed in the next cycle: that is the cycle in which the move ends, so that a touch at the very end of the move
// is not missed.
bool Foresight::touches(const nc_axes& command) {
  constexpr double kTouch = 1e-9;
  double along = 0.0, square = 0.0;
  for (unsigned a = 0; a < axis_count_; ++a) {
    along += (command.v[a] - probe_.from.v[a]) * probe_.by.v[a];
    square += probe_.by.v[a] * probe_.by.v[a];
  }
  const double before = std::exchange(probe_.part, square > 0.0 ? along / square : 0.0);
  const double step = probe_.part - before;
  return probe_.part + std::max(step, 0.0) >= probe_.touch.part - kTouch;
}

}  // namespace nc::tools
