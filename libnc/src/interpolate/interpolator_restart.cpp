// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside stands at the place (nc/restart.h), and axes go back by hand to where a program goes on.
#include "interpolate/interpolator.hpp"

namespace nc {

/// The axes are elsewhere than where the program goes on, so that blocks of MDI, and motion by hand, find them here. Nobody has moved them by hand.
void Interpolator::stand_at_restart() {
  begins_again_ = true;
  restart_at_ = shared_->restart_at;
  blocks_ = shared_->restart_blocks;
  if (axes_off(restart_at_) == 0) return;
  leave_at(restart_at_);
  displaced_ = true;
}

/// Whether a cycle start has to be refused: the block would begin from another place than the program comes from. Blocks of MDI begin anywhere, those that wait
/// (`mdi`) and those that have begun and stand in a block stop. The bar stays until a start is executed: one that waits may be taken back.
bool Interpolator::restart_bars(bool mdi) {
  if (!begins_again_ || state_ != NC_STATE_STOPPED || mdi || in_mdi_ || axes_off(restart_at_) == 0) return false;
  start_ = false;
  cause_ = NC_CAUSE_RESTART;
  return true;
}

/// Bit i: there is a place to which axis i can go back, in *places.
uint32_t Interpolator::return_places(const AxisVec** places) const {
  const uint32_t all = (1u << config_.axis_count) - 1;
  if (aside_.on) {
    *places = &aside_.place;
    return all;
  }
  if (state_ != NC_STATE_STOPPED || !(begins_again_ || held_stop().on || elsewhere_)) return 0;
  *places = begins_again_ && !(held_stop().on && in_mdi_) ? &restart_at_ : held_stop().on ? &held_stop().place : &left_at_;
  return all;
}

}  // namespace nc
