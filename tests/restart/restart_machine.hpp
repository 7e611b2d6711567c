// SPDX-License-Identifier: Apache-2.0
// A machine on virtual time whose path is recorded and whose axes are watched in every scan, for programs that are begun inside.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/clock.hpp"
#include "runtime/runtime.hpp"

namespace nc::test {

// The simulated machine; each scan is compared with the limits of the axes.
class PathMachine final : public hal::Hal {
 public:
  explicit PathMachine(const rt::Config& config) : sim(config.sim, config.points), config_(config) {}
  bool start(const hal::PointImage& initial, std::string* error) override { return sim.start(initial, error); }
  void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override {
    sim.read(feedback, image);
    for (const auto& [point, value] : held_) image->value[point] = value;
  }
  // An input has this value from the next scan on.
  void hold(int point, std::int32_t value) { held_[static_cast<unsigned>(point)] = value; }
  void write(const hal::Command& command, const hal::PointImage& image) noexcept override {
    const nc_system_config& system = config_.nc.system[0];
    const double cycle = config_.nc.cycle_s;
    for (unsigned a = 0; a < system.axis_count; ++a) {
      const double now = command.system[0].position.v[a], velocity = scans_ == 0 ? 0 : (now - before_.v[a]) / cycle;
      const double change = (velocity - velocity_[a]) / cycle;
      if (std::abs(velocity) > system.axis[a].max_velocity * 1.001 || (scans_ > 1 && std::abs(change) > system.axis[a].max_acceleration * 1.01)) ++violations;
      velocity_[a] = velocity;
    }
    before_ = command.system[0].position;
    ++scans_;
    if (path.empty() || std::memcmp(&path.back(), &before_, sizeof before_) != 0) path.push_back(before_);
    sim.write(command, image);
  }
  void stop() noexcept override { sim.stop(); }

  hal::SimMachine sim;
  std::vector<nc_axes> path;  // the commanded places, each once where the axes stand
  unsigned violations = 0;

 private:
  const rt::Config& config_;
  std::map<unsigned, std::int32_t> held_;
  nc_axes before_{};
  double velocity_[NC_MAX_AXES] = {};
  std::uint64_t scans_ = 0;
};

}  // namespace nc::test
