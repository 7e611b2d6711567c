// SPDX-License-Identifier: Apache-2.0
// Joints behind the axes of a part system (nc_kinematics): the last thing of a cycle. Scan thread.
#pragma once

#include "nc/run.h"

namespace nc {

class Joints {
 public:
  /// `kinematics` has been looked at; nullptr = the axes are what moves.
  void create(const nc_kinematics* kinematics, double cycle_s);
  bool any() const { return any_; }
  /// In front of the cycle: measured joints become a machine position, and what cannot be gone to stops the part system.
  void before(nc_inputs* in) NC_RT;
  /// Behind it: the joints of the commanded position.
  void after(nc_outputs* out) NC_RT;

 private:
  uint8_t follow(const nc_axes& machine) NC_RT;

  nc_kinematics kinematics_{};
  bool any_ = false;
  double cycle_s_ = 0.001;
  unsigned known_ = 0;     ///< good cycles behind one another, at most 2: velocity needs two places, acceleration two velocities
  bool stops_ = false;     ///< the last commanded place has no joints
  uint8_t actual_fault_ = 0;
  nc_axes joint_{}, velocity_{};
};

}  // namespace nc
