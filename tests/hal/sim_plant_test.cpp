// SPDX-License-Identifier: Apache-2.0
// The simulated spindle and tool changer that a ladder program drives by points.
#include "hal/sim/sim_plant.hpp"

#include <gtest/gtest.h>

namespace {

using nc::hal::PointImage;
using nc::hal::SimPlant;
using nc::hal::SimPlantConfig;

enum Point { kForward, kReverse, kSpeed, kPrepare, kPocket, kChange, kAtSpeed, kStopped, kPrepared, kChanged, kTool };

class SimPlantTest : public testing::Test {
 protected:
  static SimPlantConfig config() {
    SimPlantConfig c;
    c.spindle[0] = {true, kForward, kReverse, kSpeed, kAtSpeed, kStopped};
    c.tool_changer = true;
    c.prepare = kPrepare, c.pocket = kPocket, c.change = kChange;
    c.prepared = kPrepared, c.changed = kChanged, c.tool = kTool;
    c.ramp_rpm_per_s = 1000, c.max_rpm = 6000, c.prepare_s = 0.1, c.change_s = 0.5;
    return c;
  }
  // Cycles of 10 ms until the input is on; -1 = not within a minute.
  int until(Point input, std::uint32_t value = 1) {
    for (int n = 1; n <= 6000; ++n) {
      step();
      if (in.value[input] == value) return n;
    }
    return -1;
  }
  void step() { plant.step(0.01, out, &in); }
  SimPlant plant{config()};
  PointImage out, in;
};

TEST_F(SimPlantTest, SpindleRampsToItsSpeedAndSaysSo) {
  out.value[kSpeed] = 1000;
  step();
  EXPECT_EQ(in.value[kStopped], 1u);
  EXPECT_EQ(in.value[kAtSpeed], 0u) << "standing is not at speed";
  out.value[kForward] = 1;
  EXPECT_EQ(until(kAtSpeed), 97) << "97 % of 1000 r/min at 1000 r/min in a second";
  EXPECT_EQ(in.value[kStopped], 0u);
  out.value[kSpeed] = 20000;
  for (int n = 0; n < 1000; ++n) step();
  EXPECT_DOUBLE_EQ(plant.rpm(), 6000) << "no faster than it can";
}

TEST_F(SimPlantTest, ReverseGoesThroughStandstillAndBothDirectionsStop) {
  out.value[kSpeed] = 500;
  out.value[kForward] = 1;
  ASSERT_GT(until(kAtSpeed), 0);
  out.value[kForward] = 0;
  out.value[kReverse] = 1;
  EXPECT_GT(until(kStopped), 0);
  EXPECT_GT(until(kAtSpeed), 0);
  EXPECT_LT(plant.rpm(), 0);
  out.value[kForward] = 1;
  EXPECT_GT(until(kStopped), 0);
}

TEST_F(SimPlantTest, ToolIsPreparedAndExchanged) {
  out.value[kPocket] = 7;
  out.value[kPrepare] = 1;
  EXPECT_NEAR(until(kPrepared), 10, 1);
  out.value[kPrepare] = 0;
  step();
  EXPECT_EQ(in.value[kPrepared], 0u) << "the answer goes with the request";
  EXPECT_EQ(plant.tool(), 0u);
  out.value[kChange] = 1;
  EXPECT_NEAR(until(kChanged), 50, 1);
  EXPECT_EQ(in.value[kTool], 7u);
  out.value[kChange] = 0;
  step();
  EXPECT_EQ(in.value[kChanged], 0u);
}

TEST_F(SimPlantTest, AToolThatTakesNoTimeIsPreparedAndExchangedAtOnce) {
  SimPlantConfig c = config();
  c.prepare_s = c.change_s = 0;
  SimPlant quick(c);
  out.value[kPocket] = 7;
  out.value[kPrepare] = 1;
  quick.step(0.01, out, &in);
  EXPECT_EQ(in.value[kPrepared], 1u);
  out.value[kChange] = 1;
  quick.step(0.01, out, &in);
  EXPECT_EQ(in.value[kChanged], 1u);
  EXPECT_EQ(in.value[kTool], 7u);
}

TEST_F(SimPlantTest, NoChangeWithATurningSpindleOrWithoutATool) {
  out.value[kChange] = 1;
  for (int n = 0; n < 200; ++n) step();
  EXPECT_EQ(in.value[kChanged], 0u) << "nothing was prepared";
  out.value[kSpeed] = 300;
  out.value[kForward] = 1;
  out.value[kPocket] = 2;
  out.value[kPrepare] = 1;
  ASSERT_GT(until(kPrepared), 0);
  for (int n = 0; n < 200; ++n) step();
  EXPECT_EQ(in.value[kChanged], 0u) << "the spindle turns";
  out.value[kForward] = 0;
  EXPECT_GT(until(kChanged), 0);
  EXPECT_EQ(in.value[kTool], 2u);
}

}  // namespace
