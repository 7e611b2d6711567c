// SPDX-License-Identifier: Apache-2.0
// The scan and what is done by hand to the compensation of lengths: the handle that changes the one along the axis of the tool (M700 12.3, "changing the amount"), and
// the reference return that ends it. The handle moves no axis: its way is collected
// here, and at the end of the block in execution, or at the start that goes on from a block stop, the feeder reads the blocks behind it again with the new
// amount ("effective immediately in the next block", note 2).
#include "interpolate/interpolator.hpp"

namespace nc {

void Interpolator::take_length_handle(const nc_inputs& in) {
  if (in.tool_length_handle == 0) return;
  if (length_handle_acts(in)) length_way_ += in.tool_length_handle;
  else length_dropped_ = true;
}

/// 12.3 (1): "during single block stop, during feed hold or during cutting feed movement", not "during error"; and during G43.1. An interrupt program may have cut
/// a block that goes on behind it as it was.
bool Interpolator::length_handle_acts(const nc_inputs& in) const {
  if (length_.number == 0 || alarmed_ || reset_ || in.reset || begins_again_ || (interrupt_mode_ & NC_INTERRUPT_IN_SERVICE) != 0) return false;
  if (state_ == NC_STATE_STOPPED || state_ == NC_STATE_HOLD) return true;
  return state_ == NC_STATE_RUNNING && moving_ && !current().segment.rapid;
}

/// What a return to the reference position by hand ends (12.2 (4) (a), 12.3 "compensation amount resetting") is gone when the program goes on, also where the axis
/// has stood there already. A program that is begun inside is as it was at its place.
void Interpolator::note_returned(const AxisVec& before) {
  if (manual_.returned() == 0 || begins_again_ || (state_ == NC_STATE_STOPPED && held_stop().on)) return;
  if (aside_.on) {  // the block that is held goes on as it was read
    aside_.returned |= manual_.returned();
    return;
  }
  returned_ |= manual_.returned();
  if (state_ != NC_STATE_STOPPED) return;
  leave_at(before);
  displaced_ = true;
}

/// With a request to read again, and with a run.
void Interpolator::tell_returned() {
  shared_->returned.store(returned_, std::memory_order_relaxed);
  returned_ = 0;
}

/// With a request to read again.
void Interpolator::tell_length_way() {
  shared_->reread_handle = length_told_ = length_way_;
  shared_->handle_added = false;
  length_way_ = 0;
  end_is_old_ = block_begun_;
}

void Interpolator::take_length_answer() {
  length_dropped_ = length_dropped_ || (length_told_ != 0 && !shared_->handle_added);
  length_told_ = 0;
  note_length(shared_->along_tool);
}

void Interpolator::block_ends_with(const Mark& mark) {
  if (!end_is_old_) note_length(mark.along_tool);
  else end_is_old_ = !mark.resume;
}

/// With another number the change is cancelled (12.3 (2)), as it is by G49 (note 3).
void Interpolator::note_length(const LengthAlongTool& length) {
  if (length.number != length_.number && length_way_ != 0) {
    length_way_ = 0;
    length_dropped_ = true;
  }
  length_ = length;
}

/// The program has ended, or is given up.
void Interpolator::forget_length() {
  length_dropped_ = length_dropped_ || length_way_ != 0;
  length_ = {};
  length_way_ = length_told_ = 0;
  end_is_old_ = false;
}

}  // namespace nc
