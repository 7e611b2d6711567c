// SPDX-License-Identifier: Apache-2.0
// The joints that the axes of a part system are turned into (nc_kinematics), at the end of each cycle. Scan thread.
#pragma once

#include "nc/run.h"

namespace nc {

class Joints {
 public:
  /// `kinematics` has been checked before; nullptr = there are no joints, the axes themselves are driven.
  void create(const nc_kinematics* kinematics, double cycle_s);
  bool any() const { return any_; }
  /// Before the cycle: turns measured joints into a machine position, and stops the part system when the joints do not reach the last commanded
  /// position.
  void before(nc_inputs* in) NC_RT;
  /// After the cycle: calculates the joints of the commanded position.
  void after(nc_outputs* out) NC_RT;

 private:
  bool turn(nc_axes* place) const NC_RT;
  uint8_t follow(const nc_axes& machine) NC_RT;

  nc_kinematics kinematics_{};
  bool any_ = false;
  double cycle_s_ = 0.001;
  unsigned known_ = 0;     ///< cycles without a fault in a row, counted up to 2: a velocity needs two positions, an acceleration two velocities
  bool stops_ = false;     ///< the joints do not reach the last commanded position
  uint8_t actual_fault_ = 0;
  nc_axes joint_{}, velocity_{};
};

}  // namespace nc
