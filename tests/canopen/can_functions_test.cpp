// SPDX-License-Identifier: Apache-2.0
// Homing by the drive, and its touch probe.
#include <gtest/gtest.h>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;

constexpr const char* kHoming =
    "homing = { method = 17, fast = 20.0, slow = 2.0, acceleration = 200.0, position = -30.0, request = \"home_x\", done = \"x_homed\", timeout_s = 5.0 }\n";

TEST(CanFunctions, TheDriveHomesAndTheControlIsWhereItSays) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  EXPECT_EQ(rig.drives[0]->object(0x6098, 0), 17u);
  EXPECT_EQ(rig.drives[0]->object(0x6099, 1), 40'000u);
  EXPECT_EQ(rig.drives[0]->object(0x607C, 0), static_cast<std::uint32_t>(-60'000));
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  rig.step(200);
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);  // back in cyclic position
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
  rig.step(10);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.command(0), -30.0, 0.001);
  EXPECT_NEAR(rig.plant_mm(0), -30.0, 0.001);
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] & 1u, 1u);  // x_homed
  ASSERT_EQ(rig.mdi("G90 G01 X0. F6000"), Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000));
  rig.step(20);
  EXPECT_NEAR(rig.plant_mm(0), 0.0, 0.001);
}

TEST(CanFunctions, NothingStartsWhileADriveHomes) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return !rig.following(); }, 300));
  EXPECT_EQ(rig.mdi("G01 Y5. F600"), Answer::kDrivesOff);
}

// A drive that loses its power while it homes comes back in cyclic position.
TEST(CanFunctions, ADriveThatIsLostWhileItHomesComesBack) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.drives[0]->object(0x6061, 0) == 6; }, 300));
  ASSERT_EQ(rig.runtime->execute(CommandKind::kReset), Answer::kDone);
  rig.drives[0]->dead = true;
  rig.step(2000);
  rig.drives[0]->power_cycle();
  ASSERT_TRUE(rig.until([&] { return rig.machine->cyclic().ready(); }, 9000)) << rig.said();
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.following(); }, 3000)) << rig.alarms() << rig.said();
}

// An axis of a program that is interrupted is not taken away from it.
TEST(CanFunctions, NothingHomesInAProgram) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1\nG90 G01 X50. F3000\nM00\nX60."), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.runtime->snapshot().system[0].nc.state == NC_STATE_STOPPED; }, 5000)) << rig.alarms();
  rig.step(300);
  EXPECT_TRUE(rig.following());
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);
  EXPECT_NEAR(rig.plant_mm(0), 50.0, 0.001);
}

TEST(CanFunctions, AHomingThatFailsIsAFaultOfItsAxis) {
  CanRig rig(can_toml("", kHoming));
  rig.drives[0]->homing_fails = true;
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  rig.step(400);
  EXPECT_NE(rig.alarms().find("its homing has failed, axis X"), std::string::npos) << rig.alarms();
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] & 1u, 0u);
}

TEST(CanFunctions, ATouchProbeIsASkipSignalAndIsReadyAgain) {
  CanRig rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n"));
  rig.bring_up();
  rig.step(50);
  for (int edge = 0; edge < 2; ++edge) {
    const double target = edge == 0 ? 100 : 0;
    ASSERT_EQ(rig.mdi("G90 G31 X" + std::to_string(target) + " F3000"), Answer::kDone);
    rig.step(300);
    ASSERT_FALSE(rig.idle());
    rig.drives[0]->probe_edge();
    const double at = rig.plant_mm(0);
    rig.step(5);
    ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
    EXPECT_LT(std::abs(rig.plant_mm(0) - at), 3.0) << edge;  // it has braked there
    rig.step(200);
  }
  EXPECT_EQ(rig.alarms(), "");
}

}  // namespace
