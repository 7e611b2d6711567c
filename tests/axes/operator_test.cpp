// SPDX-License-Identifier: Apache-2.0
// An operator who jogs, steps, homes, resets, changes modes and works the machine's inputs at random. In every scan: no drive is given a step
// that its axis may not make, no axis goes further behind a limit switch than it needs for stopping, and what falls is held.
#include <cstdlib>
#include <random>

#include "axes_machine.hpp"

namespace {

using nc::rt::CommandKind;
using nc::rt::Mode;

class RandomOperator : public nc::test::AxesMachine {
 protected:
  void do_anything(std::mt19937& random) {
    const auto below = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
    const unsigned axis = below(3);
    const double direction = below(2) == 0 ? 1 : -1;
    switch (below(16)) {
      case 0:
      case 1:
      case 2:
      case 3:
        jog_axis_ = axis;
        jog_velocity_ = direction * (1 + below(300));
        jog_left_ = 1 + below(3000);
        break;
      case 4: (void)ask(CommandKind::kStep, axis, direction * below(200)); break;
      case 5: (void)ask(CommandKind::kHome, axis); break;
      case 6: (void)home_all(); break;
      case 7: (void)ask(CommandKind::kReference, axis); break;
      case 8:
      case 9: (void)ask(CommandKind::kReset); break;
      case 10: in("x_free_p", below(4) != 0); break;
      case 11: in("x_free_m", below(4) != 0); break;
      case 12: in("x_go", below(4) != 0); break;
      case 13: in("z_servo_off", below(3) == 0); break;
      case 14:
        (void)ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kAuto));
        (void)ask(CommandKind::kCycleStart);
        program_left_ = below(3000);
        break;
      case 15:
        if (below(4) == 0) fault_left_ = 1 + below(50), fault_axis_ = axis;
        break;
    }
  }
  void scan() {
    if (jog_left_ > 0 && --jog_left_ % 50 == 0) (void)ask(CommandKind::kJog, jog_axis_, jog_left_ == 0 ? 0 : jog_velocity_);
    if (program_left_ > 0 && --program_left_ == 0) {
      (void)ask(CommandKind::kReset);
      back_left_ = 500;
    }
    if (back_left_ > 0 && --back_left_ % 100 == 0) (void)ask(CommandKind::kSetMode, 0, static_cast<double>(Mode::kManual));
    if (fault_left_ > 0) machine->fail_drive(0, fault_axis_, --fault_left_ > 0);
    runtime->step();
  }
  // What stops by its drive and within its limits; without its drive an axis coasts, and that is the machine's.
  void expect_behind_no_switch(unsigned axis, double end) {
    const nc_axis_config& limits = config.nc.system[0].axis[axis];
    const double v = limits.max_velocity;
    const double coasts = axis == kZ ? 0 : v * 0.03;
    const double jerk = limits.max_acceleration / (2 * limits.max_jerk) + 0.03;  // of a program's law of motion: docs/homing.md
    const double most = end + v * v / (2 * limits.max_acceleration) + v * (3 * config.nc.cycle_s + 0.002 + jerk) + coasts + 1e-6;
    ASSERT_LE(std::abs(place(axis)), most) << "axis " << axis;
  }

 private:
  unsigned program_left_ = 0, back_left_ = 0;
  unsigned jog_axis_ = 0, jog_left_ = 0, fault_left_ = 0, fault_axis_ = 0;
  double jog_velocity_ = 0;
};

TEST_F(RandomOperator, DrivesNothingBeyondItsLimits) {
  const char* wanted = std::getenv("NC_SEEDS");
  const unsigned seeds = wanted != nullptr ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : 12;
  std::uint64_t homed = 0, limits = 0, moved = 0, ran = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    build(changed({{"stands_at = -37.5", ("stands_at = " + std::to_string(static_cast<int>(random() % 600) - 300)).c_str()}}));
    load("G90 G53 G0 X-280. Y100. Z-30.\nG53 G1 X250. Y-290. Z20. F9000\nG53 G0 X0. Y0. Z0.\nM99\n");
    manual_mode();
    bool was_homed = false, was_limit = false, was_running = false;
    for (unsigned n = 0; n < 40000; ++n) {
      if (random() % (flags().homing != 0 ? 9000 : 300) == 0) do_anything(random);  // or no search would come to its end
      scan();
      const nc::rt::AxisFlags now = flags();
      was_homed |= (now.homed & 1) != 0;
      was_running |= out().state == NC_STATE_RUNNING && !out().distance_zero;
      was_limit |= now.limit[0] != 0 || now.limit[1] != 0;
      expect_behind_no_switch(kX, 320);
      expect_behind_no_switch(kY, 320);
      ASSERT_LE(measured->fastest, 1.001) << n;
      ASSERT_LE(measured->hardest, 1.001) << n;
      // What an axis that is homed believes is true, but for the way of the scan before (the copy is one behind) and what its search saw late.
      const double wrong = 200 * config.nc.cycle_s + 0.01;
      for (unsigned a = 0; a < 3; ++a) {
        const bool knows = (now.homed >> a & 1u) != 0;
        ASSERT_NEAR(knows ? runtime->snapshot().system[0].actual.v[a] - place(a) : 0, 0, wrong) << n << " axis " << a;
      }
    }
    homed += was_homed;
    limits += was_limit;
    ran += was_running;
    moved += measured->moved;
  }
  EXPECT_GE(homed, 3u) << "of 12 sessions, else it shows little";
  EXPECT_GE(limits, 3u);
  EXPECT_GE(ran, 1u);
  EXPECT_GE(moved, 100000u);
}

}  // namespace
