// SPDX-License-Identifier: Apache-2.0
// Motion by hand in a feed hold: the axes leave the path amid a block, and come back to where it has stopped. The block, its law and all that is committed
// stay as they are. Cycle start is refused until every axis is at its place again, and then the path goes on as if nobody had moved them.
#include <cmath>

#include "base/same_place.hpp"
#include "interpolate/interpolator.hpp"

namespace nc {

/// In a hold at rest axes may be moved by hand, but not where that breaks the tool or spoils the work: between R and R of a tap, amid a thread. Nor while a
/// skip signal that has come is still to end its move.
bool Interpolator::hold_frees_hands() const {
  if (state_ != NC_STATE_HOLD || (tapping_ & NC_TAPPING_STROKES) != 0 || tap_follower_.active()) return false;
  return !moving_ || !(current().segment.thread || skip_braking_);
}

/// To be called at rest in a hold, before axes are moved by hand.
void Interpolator::step_aside() {
  if (aside_.on) return;
  aside_.on = true;
  aside_.rounding = rounding_;
  aside_.path = wanted_;
  aside_.place = place();
  end_rounding();
}

/// Bit i: axis i was moved by hand in a hold, and is not back. One that is a spindle now stands nowhere.
uint32_t Interpolator::axes_off_path() const {
  return aside_.on ? axes_off(aside_.place) : 0;
}

/// Bit i: axis i is elsewhere.
uint32_t Interpolator::axes_off(const AxisVec& place) const {
  uint32_t off = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if (std::fabs(wanted_[i] - place[i]) > kAddingUp && (spindles_now() >> i & 1) == 0) off |= 1u << i;
  return off;
}

/// nc_outputs::restart_axes.
uint32_t Interpolator::axes_away() const {
  const bool stop = state_ == NC_STATE_STOPPED && held_stop().on;
  if (begins_again_ && !(stop && in_mdi_)) return axes_off(restart_at_);
  return stop ? axes_off(held_stop().place) : axes_off_path();
}

/// Whether a cycle start has to be refused, because the axes are not where the path has stopped. Where they are, the path has them again.
bool Interpolator::aside_bars() {
  if (!aside_.on) return false;
  if (manual_.active() || axes_off_path() != 0) {
    start_ = false;
    return true;
  }
  wanted_ = aside_.path;
  rounding_ = aside_.rounding;
  aside_ = {};
  return false;
}

/// A hold that was asked for amid a thread acts at the end of a block behind it (M700 6.7.1).
void Interpolator::stop_held() {
  state_ = NC_STATE_STOPPED;
  cause_ = NC_CAUSE_FEED_HOLD;
  held_stop_[in_mdi_ ? 1 : 0] = {true, wanted_};
}

/// Whether a cycle start has to be refused behind such a stop. Blocks of MDI (`mdi`) begin anywhere, and leave the bar of the program as it is.
bool Interpolator::held_stop_bars(bool mdi) {
  if (state_ != NC_STATE_STOPPED || !held_stop().on || mdi || axes_off(held_stop().place) == 0) return false;
  start_ = false;
  return true;
}

/// What is committed is given up, and the axes stay where the hands have brought them. A reference return counts then as one without a program does.
void Interpolator::leave_aside() {
  returned_ |= aside_.returned;
  aside_ = {};
  for (HeldStop& stop : held_stop_) stop = {};
}

}  // namespace nc
