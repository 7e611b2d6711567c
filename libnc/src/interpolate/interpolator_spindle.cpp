// SPDX-License-Identifier: Apache-2.0
// Which spindles the program commands (M700 10.6), and axes that are a spindle as well (M700 10.5): the C axis.
//
// While its servo is off such an axis is a spindle: its position counter stays, and the spindle turns without it. When the servo is ready the
// counter takes the position that the axis really has. Records committed meanwhile do not know that position, so the axis stands beside their path
// by `turned_`. It keeps that distance, which is right for every move that does not move the axis. A move that does is not executed. The blocks
// behind the one in execution are read again, from where the axes are. Nothing of this is needed where the interpreter has waited for this moment
// (a sync: an M code that prohibits reading ahead).
#include <cmath>

#include "base/same_place.hpp"
#include "interpolate/interpolator.hpp"

namespace nc {
namespace {

uint8_t with(uint8_t bits, uint8_t bit, bool on) { return static_cast<uint8_t>(on ? bits | bit : bits & ~bit); }

}  // namespace

/// The inputs of the spindle whose encoder is used for feed per revolution, threads and dwells.
const nc_spindle_inputs& Interpolator::encoder(const nc_inputs& in) const {
  static constexpr nc_spindle_inputs kNone{};
  return encoder_ != 0 ? in.spindle[encoder_ - 1] : kNone;
}

/// The spindle turns in the wrong direction: a thread would get the wrong hand.
bool Interpolator::spindle_reversed(const nc_inputs& in) const {
  if (encoder_ == 0 || (config_.spindle_unsigned >> (encoder_ - 1) & 1) != 0) return false;
  return spindles_.turns_wrong(encoder_ - 1u, encoder(in).rev_per_s);
}

void Interpolator::follow_spindles(const nc_inputs& in) {
  losing_ = false;
  // M700 10.6.1, relation (3) to (5): the selection is not to be changed while the spindle cuts a thread. What is in the work goes on.
  // So does what a reset or a power cut has left there until it is let go: another spindle's encoder would draw the axis out of the hole.
  const bool engaged = tapping_ != 0 || cutting_thread();
  if (!engaged && (!tap_.held || tap_.selects)) {
    const unsigned count = spindles_.count();
    if (count > 1) spindles_.select(static_cast<uint8_t>(in.spindle_select & ((1u << count) - 1)));
    encoder_ = in.spindle_encoder == 0 ? spindles_.lead() + 1 : in.spindle_encoder <= count ? in.spindle_encoder : 0;
  }
  if (c_axes_ == 0) return;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const auto bit = static_cast<uint8_t>(1u << i);
    if ((c_axes_ & bit) == 0) continue;
    const unsigned spindle = config_.axis_spindle[i] - 1u;
    const bool kept = engaged && ((spindles_.selected() >> spindle & 1) != 0 || encoder_ == spindle + 1);
    if (!kept) servo_on_ = with(servo_on_, bit, (in.servo_on & bit) != 0);
    const bool ready = (servo_on_ & bit) != 0 && in.spindle[spindle].servo_ready;
    if (ready && (servo_ready_ & bit) == 0) take_position(i, in);
    servo_ready_ = with(servo_ready_, bit, ready);
    referenced_ = with(referenced_, bit, ready && in.spindle[spindle].zero_passed);
  }
}

/// M700 10.5 (1): at servo READY the position counter of the axis is set to where the spindle has turned to.
void Interpolator::take_position(unsigned axis, const nc_inputs& in) {
  const nc_spindle_inputs& spindle = in.spindle[config_.axis_spindle[axis] - 1];
  double place = command_[axis];
  if (in.actual_valid) place = in.actual.v[axis];
  else if (spindle.turns_valid) place = tap_turns_axis(axis) ? tap_axis_place(in) : 360 * (spindle.turns - std::floor(spindle.turns));
  if (aside_.on) wanted_[axis] = aside_.place[axis];  // by how far it was moved by hand is void: the spindle has turned since
  turned_[axis] = place - wanted_[axis] - added_by_tap(axis);
  command_[axis] = last_command_[axis] = place;
  stale_ = static_cast<uint8_t>(stale_ | 1u << axis);
  if (!stands() || frozen_ || rereading_) return;
  if (state_ == NC_STATE_IDLE || state_ == NC_STATE_ALARM) return settle_axes();
  if (state_ != NC_STATE_STOPPED || !between_blocks()) return;
  settle_axes();
  displaced_ = true;  // as if it was moved by hand: the blocks that follow are read again at the next start
}

/// The path goes on from where the axes are, so they do not stand beside it any more.
void Interpolator::settle_axes() {
  dropping_ = false;
  if (stale_ == 0) return;
  leave_at(wanted_);
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    wanted_[i] += turned_[i];
    target_[i] += turned_[i];
    turned_[i] = 0;
  }
  stale_ = 0;
  filter_.relocate(place());
}

/// The segment moves one of `axes`. An axis that a block does not name is commanded to where it is, up to the rounding of two conversions between
/// coordinate systems; such a difference does not count.
bool Interpolator::moves_any(const Segment& s, uint8_t axes) const {
  if (axes == 0) return false;
  AxisVec low, high;
  const bool curved = s.curve.circular || s.curve.shape != nullptr;
  if (curved) curve_bounds(s.curve, config_.axis_count, &low, &high);
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((axes >> i & 1) != 0 && (curved ? high[i] - low[i] : std::fabs(s.curve.delta[i])) > kAddingUp) return true;
  return false;
}

/// M700 10.5, precaution (3): when its servo goes off the C axis stops, and at the next servo ON the rest of its command is dropped. Here the whole
/// rest of the block is dropped, because the other axes move together with it. True: *done says what becomes of the move.
bool Interpolator::lost_move(const Record& r, Done* done) {
  *done = Done::yes;
  if (dropping_) {
    drop(r.segment);
    return true;
  }
  if (stale_ != 0 && !moving_ && at_rest()) {  // the move may have been read when the axis had its present position already
    bool known = true;
    for (unsigned i = 0; i < config_.axis_count; ++i)
      known = known && std::fabs(r.segment.curve.start[i] - wanted_[i] - turned_[i]) <= kReached;
    if (known) settle_axes();
  }
  const auto closed = static_cast<uint8_t>(spindles_now());
  if (!moves_any(r.segment, static_cast<uint8_t>(closed | stale_))) return false;
  losing_ = true;
  if (!stands()) return false;
  if (moves_any(r.segment, closed)) {
    *done = wait(NC_CAUSE_SERVO_OFF);
    return true;
  }
  losing_ = moving_ = false;
  end_rounding();
  dropping_ = true;
  law_.s = 0;
  follower_.give_up();
  drop(r.segment);
  return true;
}

/// For the program the axes are at the end of a dropped move; that they are not there counts like a movement by hand.
void Interpolator::drop(const Segment& s) {
  left_at_ = s.curve.end;
  elsewhere_ = true;
}

/// At the end of a block, while a C axis stands beside the committed path: whether the next blocks may be read again. They may not when an alarm has
/// been read, so that the alarm of the reference check, which is made as a block is read, shows (M700 10.5 (2), note); but they may when a move that
/// would be dropped comes before the alarm.
bool Interpolator::may_read_again() const {
  if (dropping_) return true;
  for (uint32_t at = tail_ + 1; at != end_; ++at) {
    const Record& r = ring_[at & mask_];
    if (r.kind == ItemKind::alarm) return false;
    if (r.kind == ItemKind::move && moves_any(r.segment, stale_)) return true;
  }
  return true;
}

}  // namespace nc
