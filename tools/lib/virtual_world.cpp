// SPDX-License-Identifier: Apache-2.0
// The offline machine; see virtual_world.hpp.
//
// Where a skip move meets a solid. The path is p(t) = a + t (b - a), 0 <= t <= 1; a box is the product of
// intervals, so the parameters inside it are the intersection of one interval per axis (the slab method),
// exact up to rounding. The signal is on in the open inside: a path that starts on a surface and leaves it,
// or slides along it, does not skip, one that starts on a surface and goes in skips at once, and so does one
// that would go in where it ends. A stay shorter than kTouch counts as rounding, not as inside.
#include "tools/lib/virtual_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nc::tools {
namespace {

constexpr double kTouch = 1e-9;           // mm
constexpr double kRapidMmMin = 10'000.0;  // the trace's clock takes rapids at 10 m/min
constexpr double kClockReadSeconds = 0.001;

}  // namespace

VirtualWorld::VirtualWorld(const Setup& setup, const nc_system_config& system)
    : setup_(setup), axis_count_(system.axis_count), machine_(setup.start), skip_machine_(setup.start) {
  for (int w = 0; w < NC_WORDS; ++w) input_[w] = setup.inputs.bits[w];
  for (const SetupEvent& event : setup.events) (event.line ? line_events_ : time_events_).push_back(&event);
}

void VirtualWorld::fire(const SetupEvent& event) {
  for (int w = 0; w < NC_WORDS; ++w)
    input_[w] = (input_[w] & ~event.inputs.mask[w]) | (event.inputs.bits[w] & event.inputs.mask[w]);
  // feed_hold delays and is continued at once; macro_interrupt without M96 does nothing. // M700 13.12
  const auto interrupt = event.signals.find("macro_interrupt");
  if (interrupt != event.signals.end()) interrupt_ = interrupt->second != 0;
  const auto reset = event.signals.find("reset");
  if (reset != event.signals.end() && reset->second) reset_ = true;
}

bool VirtualWorld::fire_due(const nc_item& item, uint32_t next_line) {
  uint32_t began = 0;
  if (item.source.depth == 0) {
    began = item.source.line;
    called_ = false;
  } else if (!called_) {
    began = next_line;
    called_ = true;
  }
  if (began && !line_events_.empty())
    std::erase_if(line_events_, [&](const SetupEvent* event) {
      if (*event->line != began) return false;
      fire(*event);
      return true;
    });
  if (!time_events_.empty())
    std::erase_if(time_events_, [&](const SetupEvent* event) {
      if (*event->seconds > seconds_) return false;
      fire(*event);
      return true;
    });
  return reset_;
}

uint32_t VirtualWorld::signals_at(const nc_axes& machine) const {
  uint32_t on = 0;
  for (const SkipSolid& solid : setup_.skip) {
    bool inside = true;
    for (unsigned a = 0; a < axis_count_; ++a)
      inside = inside && machine.v[a] > solid.low[a] && machine.v[a] < solid.high[a];
    if (inside) on |= 1u << (solid.signal - 1);
  }
  return on;
}

// Smallest path parameter at which a signal of the move's mask is on; infinity when there is none.
double VirtualWorld::first_entry(const nc_move& move) const {
  double entry = std::numeric_limits<double>::infinity();
  double length = 0.0;
  for (unsigned a = 0; a < axis_count_; ++a)
    length = std::hypot(length, move.machine.v[a] - move.machine_start.v[a]);
  for (const SkipSolid& solid : setup_.skip) {
    if (!(move.skip_mask & (1u << (solid.signal - 1)))) continue;
    const double end = length > 0.0 ? 1.0 + 2.0 * kTouch / length : 1.0;  // the last place is looked at as well
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
    if ((out - in) * length > kTouch) entry = std::min(entry, std::min(in, 1.0));
  }
  return entry;
}

bool VirtualWorld::execute(nc_move* move) {
  double part = 1.0;
  if (move->kind == NC_MOVE_SKIP) {
    const double entry = first_entry(*move);
    skipped_ = entry <= 1.0;
    if (skipped_) {
      part = entry;
      for (unsigned a = 0; a < axis_count_; ++a) {
        const double end = move->machine.v[a];
        const double at = move->machine_start.v[a] + entry * (end - move->machine_start.v[a]);
        move->work.v[a] -= end - at;
        move->machine.v[a] = at;
      }
      skip_machine_ = move->machine;
    }
    move->length *= part;
  }
  machine_ = move->machine;
  double feed = move->feed_mm_min;
  if (move->kind == NC_MOVE_RAPID) feed = kRapidMmMin;
  if (move->feed_mm_rev > 0.0) feed = move->feed_mm_rev * spindle_rev_min_;
  if (feed > 0.0) seconds_ += move->length / feed * 60.0;
  return part > 0.0;
}

void VirtualWorld::dwell(bool turns, double value, uint32_t skip_mask) {
  if (skip_mask && (signals_at(machine_) & skip_mask)) return;
  if (!turns)
    seconds_ += value;
  else if (spindle_rev_min_ > 0.0)
    seconds_ += value / spindle_rev_min_ * 60.0;
}

nc_world VirtualWorld::answer(uint32_t what) {
  nc_world world = {};
  world.machine = machine_;
  world.skip_machine = skip_machine_;
  world.skipped = skipped_;
  for (int w = 0; w < NC_WORDS; ++w) world.input[w] = input_[w];
  const double ms =
      std::floor(seconds_ * 1000.0 + 1e-6);  // a whole number of ms must not fall short by rounding
  world.clock_ms = setup_.clock_ms + static_cast<int64_t>(ms);
  world.power_on_ms = ms;
  world.run_ms = ms;
  if (what & NC_SYNC_CLOCK) seconds_ += kClockReadSeconds;
  return world;
}

}  // namespace nc::tools
