// SPDX-License-Identifier: Apache-2.0
// See stroke_counter.hpp.
#include "interpret/stroke_counter.hpp"

#include <cmath>

#include "base/same_place.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr double kNowhere = 1e-9;  // mm or deg, as goes_along_axis() has it

/// A stage would hold such moves back, they end beside their programmed ends, or they are more than a line.
bool more_than_lines(const State& state) {
  const bool beside = state.comp.side != 0 || state.moved_side != 0 || stands_beside(state.comp) || leads_beside(state);
  return beside || state.mapped || (state.special & kSpecialMap) != 0 || state.high_accuracy != 0 || state.stroke_box != 0 || state.interrupt_depth != 0;
}

/// Something comes with each stroke, or behind it.
bool more_than_strokes(const InForce& in) {
  const CycleState& c = in.state.cycle;
  const Settings& s = in.settings;
  return is_tap(c.kind) || c.in_position != 0 || in.retract_overlap > 0 || s.check_rapid || s.check_cutting || s.life_managed || s.machine_turn != 0 || special_feed(in);
}

/// An axis that does not move goes to its programmed place all the same, which is where it stands but for the rounding of two conversions.
bool stays(const InForce& in, unsigned drills) {
  const AxisVec& zero = in.zero();
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const double offset = zero[i] + in.state.applied[i], at = in.state.machine[i];
    if (i != drills && at - offset + offset != at) return false;
  }
  return true;
}

}  // namespace

CountedStrokes::CountedStrokes(BlockContext& in) : in_(in) {
  const State& state = in.state;
  if (in.stroke_counter == nullptr || in.items_made() != 0 || more_than_lines(state) || more_than_strokes(in) || program_mapped(in)) return;
  axis_ = state.cycle.drill_axis;
  const double length = axis_ == state.length_axis ? state.length_value : 0.0;
  if (state.applied[axis_] != length || !stays(in, axis_) || !in.stroke_counter->stands(in.stroke_counter->user, state.machine)) return;
  counter_ = in.stroke_counter;
  offset_ = in.zero()[axis_] + length;
  feed_ = feed_mm_min(in);
}

bool CountedStrokes::take(const CycleStep& step) {
  if (counter_ == nullptr) return false;
  double& at = in_.state.machine[axis_];
  if (std::fabs(at - offset_ - step.to) <= kNowhere) return true;
  const double to = step.to + offset_;
  if (in_.items_made() != 0 || !counter_->stroke(counter_->user, axis_, to, step.kind == StrokeKind::rapid, feed_)) return false;
  at = to;
  work_ = step.to;
  taken_ = any_ = true;
  ++in_.counted;
  return true;
}

bool CountedStrokes::take_stop_point() {
  if (counter_ == nullptr || in_.items_made() != 0 || !counter_->stop_point(counter_->user)) return false;
  any_ = true;
  ++in_.counted;
  return true;
}

void CountedStrokes::end() {
  if (!any_) return;
  if (!taken_) return counter_->end(counter_->user, in_.source, nullptr);
  in_.state.moves_since_comp_off = 1;
  in_.world_fresh = false;
  AxisVec work;
  const AxisVec& zero = in_.zero();
  for (unsigned i = 0; i < in_.axis_count; ++i) work[i] = in_.state.machine[i] - (zero[i] + in_.state.applied[i]);
  work[axis_] = work_;
  counter_->end(counter_->user, in_.source, &work);
}

}  // namespace nc
