// SPDX-License-Identifier: Apache-2.0
// Synchronous taps on a control that is driven cycle by cycle (M700 13.1.1): the machine, and a spindle as it really turns.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "online_helpers.hpp"
#include "real_spindle.hpp"

namespace nc::test {

inline std::function<void(nc_config&)> machine_that_taps(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = 0.004;
    c.look_ahead = 256;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 200;
      c.system[0].axis[i].max_velocity = 100;
      c.system[0].axis[i].max_acceleration = 1000;
      c.system[0].axis[i].max_jerk = optimal ? 100000 : 0;
    }
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

/// What a test of such a machine has at hand.
class TapTest : public testing::TestWithParam<bool> {
 protected:
  static constexpr double kLead = 1.5, kCycle_s = 0.004;
  TapTest() : bench(NC_DIALECT_M700, machine_that_taps(GetParam())) {}
  virtual void step() = 0;
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  }
  double z() const { return drive->out.command.v[2]; }

  Bench bench;
  std::unique_ptr<Drive> drive;
};

inline std::string name_of_law(const testing::TestParamInfo<bool>& law) { return law.param ? "Optimal" : "Trapezoid"; }

/// The spindle accelerates no faster than its motor can, and is behind its command.
class RealTap : public TapTest {
 protected:
  static constexpr double kRamp = 25, kLag = 0.02;  // rev/s^2, s
  RealTap() {
    // 600 r/min in 0.5 s: 20 rev/s^2, what the motor can do and a reserve.
    bench.param("3005", "3000").param("3013", "600").param("3017", "500").param("3037", "1200").param("3041", "500").param("3045", "1500");
  }
  void start(const std::string& block) {
    bench.at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, "G0 X0\n" + block + "\nG80\nM30");
    read();
  }
  void read() { spindle.show(drive->in); }
  void step() override {
    drive->press_start();
    drive->step(50);
    spindle.step(drive->out);
    read();
  }

  RealSpindle spindle{kRamp, kLag, kCycle_s};
};

}  // namespace nc::test
