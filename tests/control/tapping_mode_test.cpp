// SPDX-License-Identifier: Apache-2.0
// The mode of tapping (M700 7.11, G63): cuts at 100 %, no stop between them, neither feed hold nor single block, whatever the operator does. What stops it are
// an interlock, a reset and a stop of the program's own.
#include <gtest/gtest.h>

#include <random>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kCycle_s = 0.002, kFeed = 15;  // mm/s

class TappingMode : public testing::TestWithParam<bool> {
 protected:
  TappingMode()
      : bench(NC_DIALECT_M700, [](nc_config& c) {
          c.cycle_s = kCycle_s;
          c.look_ahead = 256;
          for (unsigned i = 0; i < 3; ++i) {
            c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = 100;
            c.system[0].axis[i].max_acceleration = 1000;
            c.system[0].axis[i].max_jerk = GetParam() ? 100000 : 0;
          }
          if (GetParam()) c.motion_mode = NC_MOTION_OPTIMAL;
        }) {
    start("G0 Z2.\nG63\nG1 Z-8. F900\nZ-12.\nZ2.\nG64\nG1 X5. F900\nM30");
  }
  void start(const std::string& text) {
    bench.at(0, 0, 10);
    drive = std::make_unique<Drive>(bench, text);
  }
  void step() {
    drive->press_start();
    drive->step(50);
  }
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most && !done(); ++n) step();
    return done();
  }
  double z() const { return drive->out.command.v[2]; }
  double x() const { return drive->out.command.v[0]; }
  bool in_mode() const { return drive->out.tapping; }

  Bench bench;
  std::unique_ptr<Drive> drive;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, TappingMode, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(TappingMode, AHoldActsBehindIt) {  // (3)
  ASSERT_TRUE(until([&] { return in_mode() && z() < -3; }));
  drive->in.feed_hold = true;
  double lowest = 0, highest = -100;
  ASSERT_TRUE(until([&] {
    lowest = std::min(lowest, z());
    if (in_mode()) highest = std::max(highest, z());
    return drive->out.state == NC_STATE_HOLD && drive->out.distance_zero;
  }));
  EXPECT_NEAR(lowest, -12, 0.02) << "it goes on";
  EXPECT_NEAR(z(), 2, 1e-6) << "out of the hole";
  EXPECT_LT(x(), 1) << "and stops then";
  drive->in.feed_hold = false;
  step();
  drive->in.cycle_start = true;
  drive->step(50);
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_NEAR(x(), 5, 1e-6);
}

TEST_P(TappingMode, APressThatWasLetGoInItIsForgotten) {
  ASSERT_TRUE(until([&] { return in_mode() && z() < -3; }));
  drive->in.feed_hold = true;
  for (unsigned n = 0; n < 20; ++n) step();
  drive->in.feed_hold = false;
  ASSERT_TRUE(until([&] { return drive->ended || drive->out.state == NC_STATE_HOLD; }));
  EXPECT_TRUE(drive->ended) << "invalid, and not put off";
}

TEST_P(TappingMode, TheOverrideIsThatOfTheProgram) {  // (1)
  for (const double override_by : {0.0, 0.4, 1.8}) {
    start("G0 Z2.\nG63\nG1 Z-8. F900\nZ-12.\nZ2.\nG64\nM30");
    ASSERT_TRUE(until([&] { return in_mode() && z() < 0; }));
    drive->in.feed_override = override_by;
    double most = 0;
    ASSERT_TRUE(until([&] {
      if (in_mode() && z() < 1) most = std::max(most, std::fabs(drive->out.velocity.v[2]));
      return drive->ended;
    })) << override_by;
    EXPECT_NEAR(most, kFeed, 0.02) << override_by;
    drive->in.feed_override = 1;
  }
}

TEST_P(TappingMode, SingleBlockStopsBehindIt) {  // (4)
  ASSERT_TRUE(until([&] { return in_mode() && z() < -3; }));
  drive->in.single_block = true;
  ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_STOPPED; }));
  EXPECT_NEAR(z(), 2, 1e-6);
  EXPECT_NEAR(x(), 0, 1e-6);
}

TEST_P(TappingMode, BlocksAreNotParted) {  // (2): both go the same way, so there is no rest between them
  ASSERT_TRUE(until([&] { return in_mode() && z() < -6; }));
  double least = 100;
  ASSERT_TRUE(until([&] {
    least = std::min(least, std::fabs(drive->out.velocity.v[2]));
    return z() < -10;
  }));
  EXPECT_NEAR(least, kFeed, 0.02);
}

TEST_P(TappingMode, AnInterlockAndAResetStopIt) {
  ASSERT_TRUE(until([&] { return in_mode() && z() < -3; }));
  drive->in.interlock = true;
  ASSERT_TRUE(until([&] { return drive->out.distance_zero; }));
  EXPECT_GT(z(), -7);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_INTERLOCK);
  drive->in.interlock = false;
  ASSERT_TRUE(until([&] { return z() < -6; }));
  drive->in.reset = true;
  ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_IDLE; }));
  drive->in.reset = false;
  EXPECT_FALSE(in_mode());
  EXPECT_GT(z(), -11);
}

TEST_P(TappingMode, AStopOfTheProgramIsItsOwn) {
  start("G0 Z2.\nG63\nG1 Z-8. F900\nM00\nZ2.\nG64\nM30");
  ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_STOPPED; }));
  EXPECT_NEAR(z(), -8, 1e-6);
  drive->in.cycle_start = true;
  drive->step(50);
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_NEAR(z(), 2, 1e-6);
}

/// Whatever he does, but for the interlock: the way through the hole is gone in one, in the time that it takes without him.
TEST_P(TappingMode, GoesThroughWhateverTheOperatorDoes) {
  const auto cycles_in_hole = [&](uint64_t seed) {
    start("G0 Z2.\nG63\nG1 Z-8. F900\nZ-12.\nZ2.\nG64\nM30");
    std::mt19937_64 random(seed);
    const auto chance = [&](double p) { return seed != 0 && std::uniform_real_distribution<double>(0, 1)(random) < p; };
    unsigned cycles = 0;
    for (unsigned n = 0; n < 100000 && !drive->ended; ++n) {
      nc_inputs& in = drive->in;
      if (chance(0.02)) in.feed_override = std::uniform_real_distribution<double>(0, 2)(random);
      if (chance(0.02)) in.rapid_override = std::uniform_real_distribution<double>(0.1, 1)(random);
      if (chance(0.02)) in.feed_hold = !in.feed_hold;
      if (chance(0.02)) in.single_block = !in.single_block;
      in.cycle_start = n == 2 || (n > 3 && !in.cycle_start && chance(0.1));
      drive->step(50);
      cycles += in_mode() && z() < 1.999 ? 1 : 0;
    }
    EXPECT_TRUE(drive->ended) << seed;
    EXPECT_EQ(drive->alarm(), "");
    return cycles;
  };
  const unsigned alone = cycles_in_hole(0);
  for (uint64_t seed = 1; seed <= seeds(20, 3); ++seed) EXPECT_NEAR(cycles_in_hole(seed), alone, 2) << seed;
}

}  // namespace
}  // namespace nc::test
