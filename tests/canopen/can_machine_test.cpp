// SPDX-License-Identifier: Apache-2.0
// A control cuts with three drives on a bus: the simulated axes are where the control commands them.
#include "hal/canopen/can_machine.hpp"

#include <gtest/gtest.h>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::kIncrementsPerMm;

constexpr double kIncrement = 1 / kIncrementsPerMm;

TEST(CanMachine, DrivesAreSetUpAndFollowFromWhereTheyStand) {
  CanRig rig;
  rig.drives[0]->plant().position = 12'000;
  rig.drives[2]->plant().position = -50'000;
  rig.bring_up();
  EXPECT_TRUE(rig.enabled());
  EXPECT_NEAR(rig.command(0), 6.0, 1e-9);  // the place of the axis, not the start position of the configuration
  EXPECT_NEAR(rig.command(2), -25.0, 1e-9);
  rig.step(200);
  EXPECT_DOUBLE_EQ(rig.drives[0]->plant().position, 12'000);  // nothing has jumped
  EXPECT_DOUBLE_EQ(rig.drives[2]->plant().position, -50'000);
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanMachine, AMoveEndsWhereItIsProgrammedAndThePlantStaysBesideTheCommand) {
  CanRig rig;
  rig.bring_up();
  ASSERT_EQ(rig.mdi("G90 G01 X20. Y-10. Z5. F6000"), Answer::kDone);
  double most = 0;
  std::vector<double> sent;
  for (unsigned i = 0; i < 3000 && !(i > 20 && rig.idle()); ++i) {
    rig.step();
    sent.push_back(rig.command(0));
    // The position goes out with the scan, and the drive takes it with the next SYNC.
    if (sent.size() > 3) most = std::max(most, std::abs(rig.plant_mm(0) - sent[sent.size() - 2]));
  }
  rig.step(20);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.plant_mm(0), 20.0, kIncrement);
  EXPECT_NEAR(rig.plant_mm(1), -10.0, kIncrement);
  EXPECT_NEAR(rig.plant_mm(2), 5.0, kIncrement);
  EXPECT_LE(most, kIncrement);
  EXPECT_NEAR(rig.actual(0), 20.0, kIncrement);
}

// An operator, or ncrtd mdi, may load a program before the drives are on: only the start is refused until then.
TEST(CanMachine, ABlockThatWasReadBeforeTheDrivesCameOnBeginsWhereTheAxesAre) {
  CanRig rig;
  rig.drives[0]->plant().position = 12'000;
  rig.drives[1]->plant().position = -30'000;
  ASSERT_TRUE(rig.boot()) << rig.said();
  rig.make_runtime();
  EXPECT_EQ(rig.mdi("G90 G01 X20. F6000"), Answer::kDrivesOff);
  ASSERT_TRUE(rig.until([&] { return rig.following(); }, 2000)) << rig.alarms();
  ASSERT_EQ(rig.run(CommandKind::kCycleStart), Answer::kDone);
  double last = rig.plant_mm(0), most = 0;
  for (unsigned i = 0; i < 3000 && !(i > 20 && rig.idle()); ++i) {
    rig.step();
    most = std::max(most, std::abs(rig.plant_mm(0) - last));
    last = rig.plant_mm(0);
  }
  rig.step(20);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_LE(most, 0.101);  // of 6000 mm/min in 1 ms: no jump
  EXPECT_NEAR(rig.plant_mm(0), 20.0, kIncrement);
  EXPECT_NEAR(rig.plant_mm(1), -15.0, kIncrement);
}

}  // namespace
