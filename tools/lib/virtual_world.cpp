// SPDX-License-Identifier: Apache-2.0
// The offline machine; see virtual_world.hpp.
//
// How it is found where a skip move meets a solid. The path is p(t) = a + t (b - a), 0 <= t <= 1. A box is the product of
// intervals, so the parameters inside it are the intersection of one interval for each axis (the slab method),
// exact up to rounding. The signal is on only in the interior, without the surface. So a path that starts on a surface and leaves it,
// or slides along it, does not skip. A path that starts on a surface and goes in skips at once, and a path
// that would enter just beyond its end skips at its end. A part inside that is shorter than kTouch counts as rounding.
#include "tools/lib/virtual_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nc::tools {
namespace {

constexpr double kTouch = 1e-9;           // mm
constexpr double kSameTime = 1e-9;        // s: an event so shortly before the end of an item comes behind it
constexpr double kClockReadSeconds = 0.001;
constexpr double kNever = std::numeric_limits<double>::infinity();

// The bit of a skip signal: "skip" is signal 1, "skip2" to "skip8" are the others; 0 = not a skip signal.
uint32_t skip_bit(const std::string& name) {
  if (name.compare(0, 4, "skip") != 0) return 0;
  return name.size() == 4 ? 1u : 1u << (name[4] - '1');
}

}  // namespace

void OutsideSignals::change(const SetupEvent& event) {
  for (int w = 0; w < NC_WORDS; ++w) input[w] = (input[w] & ~event.inputs.mask[w]) | (event.inputs.bits[w] & event.inputs.mask[w]);
  for (const auto& [name, on] : event.signals)
    if (const uint32_t bit = skip_bit(name)) skip = on ? skip | bit : skip & ~bit;
}

VirtualWorld::VirtualWorld(const Setup& setup, const nc_system_config& system)
    : setup_(setup), axis_count_(system.axis_count), machine_(setup.start), skip_machine_(setup.start), work_(setup.start), schedule_(setup) {
  for (int w = 0; w < NC_WORDS; ++w) signals_.input[w] = setup.inputs.bits[w];
  for (const SetupEvent& event : setup.events)
    if (event.seconds) time_events_.push_back(&event);
  for (const SkipHit& hit : setup.hits) hits_.push_back({&hit});
}

void VirtualWorld::fire(const SetupEvent& event) {
  signals_.change(event);
  // feed_hold is ignored: it would only delay, and is continued at once. macro_interrupt has no effect without M96. // M700 13.12
  const auto interrupt = event.signals.find("macro_interrupt");
  if (interrupt != event.signals.end()) interrupt_ = interrupt->second != 0;
  const auto reset = event.signals.find("reset");
  if (reset != event.signals.end() && reset->second) reset_ = true;
}

void VirtualWorld::fire_by_time() {
  if (time_events_.empty()) return;
  std::erase_if(time_events_, [&](const SetupEvent* event) {
    if (*event->seconds > seconds_) return false;
    fire(*event);
    return true;
  });
}

bool VirtualWorld::fire_due(const nc_item& item, uint32_t main_line) {
  fire_by_time();
  for (const SetupEvent* event : schedule_.take(item, item.source.depth == 0 ? item.source.line : main_line)) fire(*event);
  return reset_;
}

uint32_t VirtualWorld::signals_at(const nc_axes& machine) const {
  nc_axes work = machine;
  for (unsigned a = 0; a < axis_count_; ++a) work.v[a] += work_.v[a] - machine_.v[a];
  return signals_at(machine, work);
}

uint32_t VirtualWorld::solids_at(const nc_axes& machine, const nc_axes& work) const {
  uint32_t on = 0;
  for (const SkipSolid& solid : setup_.skip) {
    bool inside = true;
    if (solid.probe)
      inside = solid.probe->clearance(setup_.linear(solid.probe->work ? work : machine), machine.v) < -kTouch;
    else
      for (unsigned a = 0; a < axis_count_; ++a) inside = inside && machine.v[a] > solid.low[a] && machine.v[a] < solid.high[a];
    if (inside) on |= 1u << (solid.signal - 1);
  }
  return on;
}

// The smallest parameter at which the path is inside of a plain box; infinity when there is none.
double VirtualWorld::first_box(const nc_move& move, const SkipSolid& solid, double length) const {
  const double end = length > 0.0 ? 1.0 + 2.0 * kTouch / length : 1.0;  // a little beyond the end, so that a path that would enter at its end is found
  double in = 0.0, out = end;
  for (unsigned a = 0; a < axis_count_ && in < out; ++a) {
    if (!solid.bounded[a]) continue;
    const double from = move.machine_start.v[a], by = move.machine.v[a] - from;
    if (by == 0.0) {
      if (!(from > solid.low[a] && from < solid.high[a])) out = in;
      continue;
    }
    const double t0 = (solid.low[a] - from) / by, t1 = (solid.high[a] - from) / by;
    in = std::max(in, std::min(t0, t1));
    out = std::min(out, std::max(t0, t1));
  }
  if ((out - in) * length > kTouch) return std::min(in, 1.0);
  return kNever;
}

double VirtualWorld::first_probe(const nc_move& move, const SkipSolid& solid) const {
  nc_axes from = move.machine_start, to = move.machine;
  for (unsigned a = 0; a < axis_count_ && solid.probe->work; ++a) {
    const double offset = move.work.v[a] - move.machine.v[a];
    from.v[a] += offset;
    to.v[a] += offset;
  }
  return solid.probe->first_entry({setup_.linear(from), setup_.linear(to), move.machine_start.v, move.machine.v});
}

VirtualWorld::Touch VirtualWorld::take_hit(const nc_source& source, const nc_move& move) {
  HitState* mine = nullptr;
  for (HitState& state : hits_) {
    if (state.taken) continue;
    const SkipHit& hit = *state.hit;
    const bool here = hit.line && *hit.line == source.line && (hit.program ? *hit.program == source.program : source.depth == 0);
    if (here) {
      mine = &state;
      break;
    }
    if (!hit.line && mine == nullptr) mine = &state;  // the next entry in order is used, unless there is one for this line
  }
  if (mine == nullptr) return {};
  mine->taken = true;
  mine->line = source.line;
  const SkipHit& hit = *mine->hit;
  Touch touch{static_cast<size_t>(mine - hits_.data()), kNever, hit.signal};
  if (hit.none) return touch;
  double along = 0.0, square = 0.0;
  for (unsigned a = 0; a < axis_count_; ++a) {
    if (!hit.named[a]) continue;
    const double by = move.machine.v[a] - move.machine_start.v[a];
    const double start = move.work.v[a] - by;
    along += (hit.at[a] - start) * by;
    square += by * by;
  }
  const double part = square > 0.0 ? along / square : kNever, slack = square > 0.0 ? kTouch / std::sqrt(square) : 0.0;
  mine->missed = !(part >= -slack && part <= 1.0 + slack) || !(move.skip_mask & (1u << (hit.signal - 1)));
  if (!mine->missed) touch.part = std::clamp(part, 0.0, 1.0);
  return touch;
}

void VirtualWorld::put_back(const Touch& touch) {
  if (touch.hit < hits_.size()) hits_[touch.hit].taken = hits_[touch.hit].missed = false;
}

// The first event within the next `seconds` that switches on (off) a signal of the mask.
const SetupEvent* VirtualWorld::signal_within(double seconds, uint32_t mask, bool off) const {
  const SetupEvent* first = nullptr;
  for (const SetupEvent* event : time_events_) {
    if (!(*event->seconds < seconds_ + seconds) || (first && *event->seconds >= *first->seconds)) continue;
    for (const auto& [name, on] : event->signals)
      if (on != off && (skip_bit(name) & mask)) first = event;
  }
  return first;
}

// The smallest parameter at which a signal of the move's mask is on; infinity when there is none.
double VirtualWorld::first_entry(const nc_move& move) const {
  if (signals_.skip & move.skip_mask) return 0.0;
  double entry = kNever;
  double length = 0.0;
  for (unsigned a = 0; a < axis_count_; ++a)
    length = std::hypot(length, move.machine.v[a] - move.machine_start.v[a]);
  for (const SkipSolid& solid : setup_.skip) {
    if (!(move.skip_mask & (1u << (solid.signal - 1)))) continue;
    entry = std::min(entry, solid.probe ? first_probe(move, solid) : first_box(move, solid, length));
  }
  return entry;
}

// The probe touches the solid at this part of the way, on its surface as well: a probe that has just touched stands there.
bool VirtualWorld::touches_at(const nc_move& move, const SkipSolid& solid, double part) const {
  nc_axes machine = move.machine_start, work = move.machine_start;
  for (unsigned a = 0; a < axis_count_; ++a) {
    machine.v[a] += part * (move.machine.v[a] - move.machine_start.v[a]);
    work.v[a] = machine.v[a] + move.work.v[a] - move.machine.v[a];
  }
  if (solid.probe) return solid.probe->clearance(setup_.linear(solid.probe->work ? work : machine), machine.v) < kTouch;
  bool inside = true;
  for (unsigned a = 0; a < axis_count_; ++a)
    inside = inside && (!solid.bounded[a] || (machine.v[a] > solid.low[a] - kTouch && machine.v[a] < solid.high[a] + kTouch));
  return inside;
}

// The part of the way at which the path leaves a solid that it touches on its way; infinity when it ends in it. The way back enters where the way leaves.
double VirtualWorld::exit_of(const nc_move& move, const SkipSolid& solid, double length) const {
  nc_move back = move;
  back.machine_start = move.machine;
  back.machine = move.machine_start;
  for (unsigned a = 0; a < axis_count_; ++a) back.work.v[a] = back.machine.v[a] + move.work.v[a] - move.machine.v[a];
  const double entry = solid.probe ? first_probe(back, solid) : first_box(back, solid, length);
  if (!(entry <= 1.0)) return 0.0;  // it lies along its surface
  return entry > 0.0 ? 1.0 - entry : kNever;
}

// The smallest parameter at which no signal of the move's mask is on; infinity when one stays on.
double VirtualWorld::first_exit(const nc_move& move) const {
  if (signals_.skip & move.skip_mask) return kNever;
  double length = 0.0;
  for (unsigned a = 0; a < axis_count_; ++a) length = std::hypot(length, move.machine.v[a] - move.machine_start.v[a]);
  double part = 0.0, next = 0.0;
  bool touched = false;
  do {
    part = next;
    for (const SkipSolid& solid : setup_.skip) {
      if (!(move.skip_mask & (1u << (solid.signal - 1))) || !touches_at(move, solid, part)) continue;
      touched = true;
      next = std::max(next, exit_of(move, solid, length));
    }
  } while (next > part && next <= 1.0);
  return touched && length > 0.0 ? std::max(next, kTouch / length) : next;  // it has moved
}

// The next event of the clock before the end of the item in hand fires; those that come together with it follow with the next calls.
bool VirtualWorld::go_on_to_event() {
  const auto sooner = [](const SetupEvent* a, const SetupEvent* b) { return *a->seconds < *b->seconds; };
  const auto next = std::min_element(time_events_.begin(), time_events_.end(), sooner);
  if (next == time_events_.end() || *(*next)->seconds >= item_end_ - kSameTime) {
    seconds_ = item_end_;
    return true;
  }
  const SetupEvent* const event = *next;
  time_events_.erase(next);
  seconds_ = std::max(seconds_, *event->seconds);
  fire(*event);
  return false;
}

bool VirtualWorld::begin_skip(nc_move* move) {
  const Touch hit = take_hit(now_, *move);
  double entry = !move->skip_away ? std::min(first_entry(*move), hit.part) : hit.hit != SIZE_MAX ? hit.part : first_exit(*move);
  nc_move entered = *move;
  entered.length *= std::min(entry, 1.0);
  const SetupEvent* const switched_on = signal_within(clock_.seconds(entered), move->skip_mask, move->skip_away);
  if (switched_on) entry = clock_.share_after(*move, *switched_on->seconds - seconds_);
  skipped_ = entry <= 1.0;
  const double part = skipped_ ? entry : 1.0;
  if (skipped_) {
    for (unsigned a = 0; a < axis_count_; ++a) {
      const double end = move->machine.v[a];
      const double at = move->machine_start.v[a] + entry * (end - move->machine_start.v[a]);
      move->work.v[a] -= end - at;
      move->machine.v[a] = at;
    }
    skip_machine_ = move->machine;
  }
  move->length *= part;
  begin_item(switched_on ? std::max(seconds_, *switched_on->seconds) : seconds_ + clock_.seconds(*move));
  skip_hit_ = hit;
  return part > 0.0;
}

double VirtualWorld::begin_dwell(bool turns, double value, uint32_t skip_mask) {
  const double rev = rev_min();
  double seconds = !turns ? value : rev > 0.0 ? value / rev * 60.0 : 0.0;
  if (skip_mask && (signals_at(machine_) & skip_mask)) seconds = value = 0.0;
  const SetupEvent* const switched_on = signal_within(seconds, skip_mask);
  if (switched_on) {
    seconds = std::max(0.0, *switched_on->seconds - seconds_);
    value = turns ? seconds * rev / 60.0 : seconds;
  }
  begin_item(seconds_ + seconds);
  return value;
}

bool VirtualWorld::changes() const {
  return schedule_.any() || !time_events_.empty() || std::any_of(hits_.begin(), hits_.end(), [](const HitState& hit) { return !hit.taken; });
}

std::vector<std::string> VirtualWorld::unused() const {
  std::vector<std::string> all;
  const auto add = [&](const SetupPlace& place, const std::string& why) {
    all.push_back(setup_.name + ":" + std::to_string(place.line) + ": " + place.path + ": " + why);
  };
  for (const SetupEvent& event : setup_.events) {
    if (event.seconds) {
      if (std::find(time_events_.begin(), time_events_.end(), &event) != time_events_.end())
        add(event.place, "has not fired: the program ended before that time");
    } else if (!schedule_.waits(event)) {
      continue;
    } else if (event.m) {
      add(event.place, "has not fired: M" + std::to_string(*event.m) + " was not given out");
    } else {
      add(event.place, "has not fired: line " + std::to_string(*event.line) + " of " +
                           (event.program ? "O" + std::to_string(*event.program) : "the main program") + " was not executed, or holds no block");
    }
  }
  for (const HitState& state : hits_) {
    if (!state.taken) add(state.hit->place, "no skip move came to take it");
    if (state.missed)
      add(state.hit->place, "the skip move on line " + std::to_string(state.line) + " does not pass this place, or listens to another signal");
  }
  return all;
}

nc_world VirtualWorld::answer(uint32_t what) {
  nc_world world = {};
  world.machine = machine_;
  world.skip_machine = skip_machine_;
  world.skipped = skipped_;
  for (int w = 0; w < NC_WORDS; ++w) world.input[w] = signals_.input[w];
  const int64_t ms = whole_ms(seconds_);
  world.clock_ms = setup_.clock_ms + ms;
  world.power_on_ms = static_cast<double>(ms);
  world.run_ms = world.power_on_ms;
  if (what & NC_SYNC_CLOCK) seconds_ += kClockReadSeconds;
  return world;
}

}  // namespace nc::tools
