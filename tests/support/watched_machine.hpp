// SPDX-License-Identifier: Apache-2.0
// A machine in single block whose steps are watched.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "support/drive.hpp"

namespace nc::test {

/// A machine, and the largest step that it gave to an axis, divided by the step that the axis' velocity allows. It has the axes `names`, with these velocities
/// (mm/s, deg/s), 20 times as much acceleration, and in the optimal mode 400 times as much jerk.
class WatchedMachine {
 public:
  static constexpr double kCycle = 0.001;

  /// `more` changes its configuration.
  WatchedMachine(nc_dialect dialect, const char* names, std::vector<double> velocity, bool optimal, unsigned feed, const std::function<void(nc_config&)>& more = {})
      : bench(dialect, limits(names, velocity, optimal, more)), velocity_(std::move(velocity)), feed_(feed) {}

  void start(const std::string& text) {
    drive = std::make_unique<Drive>(bench, text);
    drive->in.single_block = true;
    known_ = false;
    press();
  }
  void press() {
    drive->in.cycle_start = true;
    step(2);
    drive->in.cycle_start = false;
  }
  void step(unsigned cycles = 1) {
    for (; cycles > 0; --cycles) {
      drive->step(feed_);
      for (unsigned i = 0; i < velocity_.size() && known_; ++i) {
        const double way = std::fabs(drive->out.command.v[i] - last_.v[i]);
        const double part = std::isfinite(way) ? way / (velocity_[i] * kCycle) : INFINITY;
        if (part > worst) worst = part, worst_axis = i, worst_line = drive->out.source.line;
      }
      last_ = drive->out.command;
      known_ = true;
    }
  }

  Bench bench;
  std::unique_ptr<Drive> drive;
  double worst = 0;
  unsigned worst_axis = 0, worst_line = 0;

 private:
  static std::function<void(nc_config&)> limits(const char* names, const std::vector<double>& velocity, bool optimal, const std::function<void(nc_config&)>& more) {
    return [names, velocity, optimal, more](nc_config& c) {
      axes(names)(c);
      c.cycle_s = kCycle;
      c.look_ahead = 128;
      c.motion_mode = optimal ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
      for (unsigned i = 0; i < velocity.size(); ++i) {
        nc_axis_config& axis = c.system[0].axis[i];
        axis.rapid = axis.max_velocity = velocity[i];
        axis.max_acceleration = 20 * velocity[i];
        axis.max_jerk = optimal ? 400 * velocity[i] : 0;
      }
      if (more) more(c);
    };
  }

  std::vector<double> velocity_;
  unsigned feed_;
  nc_axes last_{};
  bool known_ = false;  ///< last_ is a place of this run
};

}  // namespace nc::test
