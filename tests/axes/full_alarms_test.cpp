// SPDX-License-Identifier: Apache-2.0
// More causes at once than the list of alarms has room for, as when the supply of the inputs is lost: what takes the drives off and what stops the machine is in it all
// the same, and what is told once is told when there is room again.
#include "axes_machine.hpp"

namespace {

using nc::rt::AlarmId;
using nc::rt::CommandKind;
using nc::rt::Mode;

class FullAlarms : public nc::test::AxesMachine {
 protected:
  static constexpr const char* kNames = "XYZABCUV";
  // Eight axes with both limit switches, eight contacts, a supply: all closed.
  static std::string many() {
    std::string axes = "[machine]\nname = \"many\"\n", points, wires = "[signals]\n\"plc.power_fail_n\" = \"supply\"\n";
    const auto input = [&points](const std::string& name) { points += "[[point]]\nname = \"" + name + "\"\ndirection = \"input\"\ninitial = 1\n"; };
    input("supply");
    for (const char* name = kNames; *name != 0; ++name) {
      const std::string n(1, *name);
      axes += "[[axis]]\nname = \"" + n + "\"\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 50000.0\nsoft_limits = [-300.0, 300.0]\nlimit_switches = { minus = \"m_" + n + "\", plus = \"p_" + n + "\" }\n";
      if (*name == 'Z') axes += "brake = { point = \"z_brake\", open_s = 0.1, close_s = 0.2 }\n";
      input("m_" + n);
      input("p_" + n);
    }
    for (int n = 1; n <= 8; ++n) {
      points += "[[point]]\nname = \"contact" + std::to_string(n) + "\"\ndirection = \"input\"\n";
      wires += "\"plc.alarm." + std::to_string(n) + "\" = \"contact" + std::to_string(n) + "\"\n";
    }
    return axes + points + "[[point]]\nname = \"z_brake\"\ndirection = \"output\"\n" + wires + "[power]\nstop_s = 0.5\nsettle_s = 0.05\n[[sim.axis]]\nname = \"Z\"\nweight = 9810.0\n";
  }
  void switches(std::uint32_t value) {
    for (const char* name = kNames; *name != 0; ++name)
      for (const char* side : {"m_", "p_"}) in((std::string(side) + *name).c_str(), value);
  }
  void contacts(std::uint32_t value) {
    for (int n = 1; n <= 8; ++n) in(("contact" + std::to_string(n)).c_str(), value);
  }
  bool listed(AlarmId id) const {
    const nc::rt::Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i)
      if (now.alarms.alarm[i].id == id) return true;
    return false;
  }
  void fill() {
    ASSERT_NO_FATAL_FAILURE(build(many()));
    switches(0);
    contacts(1);
    steps(3);
    ASSERT_EQ(runtime->snapshot().alarms.count, nc::rt::kMaxActiveAlarms);
  }
};

TEST_F(FullAlarms, AFaultOfADriveTakesTheDrivesOff) {
  ASSERT_NO_FATAL_FAILURE(fill());
  ASSERT_TRUE(brake_open());
  machine->fail_drive(0, kX, true);
  steps(3);
  EXPECT_TRUE(listed(AlarmId::kDriveFault));
  EXPECT_FALSE(brake_open());
  steps(300);
  EXPECT_FALSE(measured->last.enable);
  machine->fail_drive(0, kX, false);
  switches(1);
  contacts(0);
  reset();
  ASSERT_GE(until([&] { return brake_open(); }, 400), 0);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
}

TEST_F(FullAlarms, ALostBusTakesTheDrivesOff) {
  ASSERT_NO_FATAL_FAILURE(fill());
  machine->fail_bus(true);
  steps(2);
  machine->fail_bus(false);
  steps(300);
  EXPECT_TRUE(listed(AlarmId::kHalLost));
  EXPECT_FALSE(measured->last.enable);
  EXPECT_FALSE(brake_open());
}

TEST_F(FullAlarms, AFailureOfThePowerWaitsForItsReset) {
  ASSERT_NO_FATAL_FAILURE(fill());
  in("supply", 0);
  steps(1000);
  EXPECT_TRUE(listed(AlarmId::kPowerFails));
  EXPECT_FALSE(brake_open());
  in("supply", 1);
  steps(1000);
  EXPECT_TRUE(listed(AlarmId::kPowerFails)) << "nobody has acknowledged it";
  EXPECT_FALSE(brake_open());
  EXPECT_FALSE(measured->last.enable);
}

}  // namespace
