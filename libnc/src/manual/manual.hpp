// SPDX-License-Identifier: Apache-2.0
// Manual motion of the axes of one part system: jog, step, handle and reference return. Each axis moves by a trapezoid of velocity of its own, and can
// always stop at its soft limit.
#pragma once

#include <cmath>

#include "motion/axis_limits.hpp"
#include "nc/run.h"
#include "stream/stream.hpp"

namespace nc {

struct ManualConfig {
  unsigned axis_count = 3;
  AxisLimits limits[kMaxAxes];
  AxisVec soft_min, soft_max;
  uint32_t soft_limited = 0;
  AxisVec reference;
  double cycle_s = 0.001;
};

class Manual {
 public:
  void create(const ManualConfig& config) { config_ = config; }
  struct Rules {
    bool stop = false;       ///< every axis brakes to rest and its target is given up
    // Bit i of each stands for axis i.
    uint32_t held = 0;       ///< axes that come to rest and keep their targets until they may move
    uint32_t dropped = 0;    ///< axes that stand at once, and whose targets are given up: they are no axes now
    uint32_t refused = 0;    ///< axes that brake to rest, and whose targets are given up
    uint32_t turning = 0;    ///< axes whose positions count within one turn (M700 14.13)
    uint32_t short_cut = 0;  ///< axes among those that go to a position by the shorter way
    uint32_t gentle = 0;     ///< axes that accelerate no faster than `gentle_acceleration`, and go no faster than `gentle_velocity`
    double gentle_acceleration = HUGE_VAL, gentle_velocity = HUGE_VAL;  ///< mm/s^2, mm/s
    uint32_t unlimited = 0;  ///< axes without soft limits, because it is not known where they stand
    uint32_t returns = 0;    ///< axes that can go back to `back`
    const AxisVec* back = nullptr;
  };
  /// One cycle, in which `position` is moved. To be called only while no program moves.
  void cycle(const nc_manual* wish, const Rules& rules, AxisVec* position) NC_RT;
  /// A cycle in which no manual motion is possible: what is commanded is refused, and does not begin by itself when motion is possible again.
  void idle(const nc_manual* wish) NC_RT;
  /// Some axis moves, or has a target to go to.
  bool active() const NC_RT { return active_ != 0; }
  /// Some axis is active, or has moved in the last cycle and come to rest: a single step of a handle begins and ends in one cycle.
  bool moving() const NC_RT { return (active_ | moved_) != 0; }
  uint32_t active_axes() const NC_RT { return active_; }
  /// Bit i: in the last cycle a part of the way that the handle of axis i asked for was given up.
  uint32_t handle_dropped() const NC_RT { return handle_dropped_; }
  /// Bit i: a reference return of axis i is commanded, and the axis stands at its reference position.
  uint32_t returned() const NC_RT { return returned_; }

 private:
  struct Axis {
    double velocity = 0;            ///< signed, mm/s or deg/s
    double target = 0;              ///< position to which the axis goes, mm or deg
    double cap = 0;                 ///< top speed of this motion, mm/s or deg/s
    uint8_t kind = NC_MANUAL_NONE;     ///< kind that was commanded in the last cycle, if it acted
    uint8_t refused = NC_MANUAL_NONE;  ///< kind that was refused or stopped and is still commanded: it has to be released before it acts again
    bool going = false;                ///< true: it goes to its target; false: it brakes or stands
    bool by_handle = false;            ///< the target comes from a handle
    bool to_reference = false;         ///< of a reference return: its target is the reference position, and not a soft limit in front of it
  };
  static bool stands_at_reference(const Axis& axis, double position) NC_RT;
  void give_up_handle(unsigned axis) NC_RT;
  void refuse(unsigned axis, const nc_manual& wish) NC_RT;
  bool let_go(unsigned axis, const nc_manual& wish) NC_RT;
  void wish(unsigned axis, const nc_manual& wish, const Rules& rules, double position) NC_RT;
  double move(unsigned axis, const Rules& rules, double position) NC_RT;
  double top_speed(unsigned axis) const NC_RT;
  double acceleration(unsigned axis) const NC_RT;
  double within(unsigned axis, const Rules& rules, double target, double position) const NC_RT;

  ManualConfig config_;
  Axis axis_[kMaxAxes];
  uint32_t active_ = 0;
  uint32_t moved_ = 0;  ///< bit i: the position of axis i was changed in the last cycle
  uint32_t handle_dropped_ = 0;
  uint32_t returned_ = 0;
};

}  // namespace nc
