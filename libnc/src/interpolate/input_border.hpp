// SPDX-License-Identifier: Apache-2.0
// The border of the scan: every number of nc_inputs passes it once in each cycle. A number that is not finite, or out of the range that nc/run.h
// gives, is refused; nc_input_bits says what acts in its place. Code behind this border need not check inputs.
#pragma once

#include "nc/run.h"

namespace nc {

class InputBorder {
 public:
  void create(unsigned axis_count, double max_feed_override, double cycle_s);

  /// The inputs of this cycle as they act; valid until the next call.
  const nc_inputs& check(const nc_inputs& in) NC_RT;
  uint32_t refused() const { return refused_; }  ///< nc_input_bits of this cycle
  uint32_t lost_axes() const { return lost_axes_; }  ///< bit i: the measured position of axis i was refused in this cycle

 private:
  void override_of(double* value, double most, double* last, uint32_t bit) NC_RT;
  void spindle(unsigned n) NC_RT;
  void actual() NC_RT;
  void skip_place() NC_RT;
  void manual() NC_RT;
  void manual_feed() NC_RT;
  void tool_length() NC_RT;
  void tool_angle() NC_RT;

  unsigned axis_count_ = 0;
  double most_ = 2, cycle_s_ = 0.001;
  nc_inputs now_{};
  uint32_t refused_ = 0, lost_axes_ = 0;
  // the last values that were accepted
  double feed_ = 0, rapid_ = 0, manual_feed_ = 0;
  double tool_angle_[2] = {0, 0};
  nc_axes actual_{};
  struct Spindle {
    double rev_per_s = 0, turns = 0, age_s = 0;
    double bad_s = 0;  ///< s for which its inputs have been refused
  };
  Spindle spindle_[NC_MAX_SPINDLES];
};

}  // namespace nc
