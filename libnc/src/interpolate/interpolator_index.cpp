// SPDX-License-Identifier: Apache-2.0
// Index tables in the scan (M700 9.3). A segment says which tables it moves, and it begins when they are unclamped. After it they stay unclamped until
// it is known what follows: another move of the same axes goes on without clamping (7); before anything else they are clamped.
#include <algorithm>
#include <cmath>

#include "interpolate/interpolator.hpp"

namespace nc {
namespace {

constexpr double kStands = 1e-4;  ///< mm or deg in one cycle: noise of an encoder while the drives are off

/// Bit i: axis i stays unclamped for this record, because it moves the axis, or the one behind it does.
uint32_t stay_open(const Record& r) {
  const bool moves = r.kind == ItemKind::move && r.segment.curve.length > 0;
  return moves ? uint32_t{r.segment.index_axes} | r.segment.unclamps : 0;
}

}  // namespace

Interpolator::Done Interpolator::wait_for_clamp() {
  index_waits_ = true;
  return wait(NC_CAUSE_FIN);
}

/// Unclamps the tables that a segment moves. 9.3 (3), (4): the whole path waits for them. Tables of the move behind are only commanded to be unclamped,
/// and the segment does not wait for these ("the movement of other axes ... is carried out for non-interpolation commands").
bool Interpolator::unclamp_for(const Segment& s, const nc_inputs& in) {
  law_.v = 0;
  if (interlock_) {  // nothing may move: the table stays clamped
    wait(NC_CAUSE_INTERLOCK);
    return false;
  }
  index_.open(s.unclamps, in.unclamped);
  if (index_.open(s.index_axes, in.unclamped)) return true;
  wait_for_clamp();
  return false;
}

/// 9.3 (5), (6): the next record is executed only when the tables that it does not move are clamped; until then the answer is false. The end of a block
/// does not wait, unless the program stops there (7), nor does the deceleration check, which comes before clamping.
bool Interpolator::clamp_before(const Record& r, const nc_inputs& in) {
  if (r.kind == ItemKind::move && !(r.segment.curve.length > 0)) return true;
  if (r.kind == ItemKind::mark && !stops_at(r.mark, in)) return true;
  if (r.kind == ItemKind::gate && r.gate.kind == NC_GATE_IN_POSITION) return true;
  uint32_t off = index_.unclamp() & ~stay_open(r);
  if (r.kind == ItemKind::alarm && off != 0) off &= may_clamp();  // an alarm does not wait for tables that cannot be clamped
  if (off == 0 && index_.clamping() == 0) return true;
  law_.v = 0;
  if (off != 0 && !in_position(in)) {
    wait(NC_CAUSE_IN_POSITION);
    return false;
  }
  if ((off & ~may_clamp()) == 0 && index_.close(off, in.unclamped)) return true;
  wait_for_clamp();
  return false;
}

/// Axes that stand where they can be clamped.
uint32_t Interpolator::may_clamp() {
  const AxisParameters& parameters = shared_->axes.read();
  uint32_t axes = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if (index_.may_clamp(i, parameters, wanted_[i], config_.reference[i])) axes |= 1u << i;
  return axes;
}

/// 9.3 (5): when a moving table is no longer answered as unclamped, it stops with everything that moves together with it. The command to unclamp it
/// stays, and the move goes on when the answer is back.
void Interpolator::watch_index(const nc_inputs& in) {
  index_waits_ = false;
  index_lost_ = index_.busy() && moving_ && (current().segment.index_axes & ~in.unclamped) != 0;
}

/// While no program moves: clamps the tables that manual motion does not need (`wanted` are those that it does) and that stand where they can be
/// clamped. The tables of a move that is interrupted stay unclamped (6).
void Interpolator::clamp_at_rest(uint32_t wanted, const nc_inputs& in) {
  if (state_ == NC_STATE_RUNNING || (moving_ && !aside_.on) || !stands() || frozen_ || rereading_) return;
  uint32_t off = index_.unclamp() & ~wanted;
  if (state_ == NC_STATE_HOLD && tail_ != end_ && is_current(current())) off &= ~stay_open(current());
  if (off != 0) off &= may_clamp();
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const double width = config_.limits[i].in_position;
    const bool stands = wanted_[i] == command_[i] && std::fabs(command_[i] - last_command_[i]) <= kStands &&
                        (!in.actual_valid || !(width > 0) || std::fabs(in.actual.v[i] - wanted_[i]) <= width);
    if (!stands) off &= ~(1u << i);
  }
  index_.close(off, in.unclamped);
}

/// Manual motion. A table is unclamped before it moves and clamped after it.
void Interpolator::manual_cycle(const nc_inputs& in) {
  const AxisParameters& parameters = shared_->axes.read();
  Manual::Rules rules;
  rules.stop = !manual_allowed_ || in.interlock || in.feed_hold;
  rules.dropped = spindles_now();  // M700 10.5 (1): an axis that is a spindle is not moved; the command does not go on later either (precaution (3))
  rules.refused = tap_holds(in);
  if (state_ == NC_STATE_HOLD) rules.refused |= stale_;  // they stand where their spindle has turned to, and not on the path
  rules.turning = parameters.turning;
  rules.short_cut = parameters.short_cut;
  rules.unlimited = static_cast<uint32_t>(in.unlimited);
  rules.returns = return_places(&rules.back);
  const nc_manual* wish = in.manual;
  nc_manual with_tap[kMaxAxes];
  if (tap_.held) {
    std::copy_n(in.manual, kMaxAxes, with_tap);
    if (draw_tap_out(in, with_tap, &rules)) wish = with_tap;
  }
  if (parameters.index == 0 && !index_.busy()) {
    manual_.cycle(wish, rules, &wanted_);
    return;
  }
  const AxisVec before = wanted_;
  rules.held |= parameters.index & ~(index_.unclamp() & in.unclamped);
  manual_.cycle(wish, rules, &wanted_);
  const uint32_t wanted = manual_.active_axes() & parameters.index;
  uint32_t moved = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) moved |= wanted_[i] != before[i] ? 1u << i : 0;
  index_.leave(moved & parameters.index);
  index_waits_ = !index_.open(wanted, in.unclamped);
  clamp_at_rest(wanted, in);
}

}  // namespace nc
