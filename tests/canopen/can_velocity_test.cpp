// SPDX-License-Identifier: Apache-2.0
// Axes whose drives have a loop of their speed only (cyclic velocity): the control holds their position.
#include <random>

#include "can_rig.hpp"
#include "support/seeds.hpp"

namespace {

using nc::rt::Answer;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::kIncrementsPerMm;

constexpr double kIncrement = 1 / kIncrementsPerMm;

// The simulated drive measures its place and is then, at once, where the SYNC leads it.
std::string velocity(const std::string& more = "") { return "mode = \"velocity\"\nvelocity_delay = 2.0\n" + more; }

// Executes a block. Returns the largest distance of the plant of X from the command that it should be at then: a command goes out behind a scan, is taken with the next SYNC and acts up to the one behind it.
double worst_distance(CanRig* rig, const std::string& block) {
  EXPECT_EQ(rig->mdi(block), Answer::kDone);
  double worst = 0;
  std::vector<double> sent;
  for (unsigned i = 0; i < 6000 && !(i > 20 && rig->idle()); ++i) {
    rig->step();
    sent.push_back(rig->command(0));
    if (sent.size() > 3) worst = std::max(worst, std::abs(rig->plant_mm(0) - sent[sent.size() - 2]));
  }
  return worst;
}

TEST(CanVelocity, AMoveEndsWhereItIsProgrammedAndStaysBesideTheCommand) {
  CanRig rig(can_toml("", velocity()));
  rig.drives[0]->plant().position = 12'000;
  rig.bring_up();
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 9u);
  EXPECT_EQ(rig.drives[1]->object(0x6061, 0), 8u);
  rig.step(200);
  EXPECT_DOUBLE_EQ(rig.drives[0]->plant().position, 12'000);
  EXPECT_LE(worst_distance(&rig, "G90 G01 X-40. Y10. F9000"), 3 * kIncrement);  // 150 mm/s, 0.15 mm in each SYNC
  EXPECT_LE(worst_distance(&rig, "G90 G00 X30. Y-10."), 3 * kIncrement);
  rig.step(300);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.plant_mm(0), 30.0, kIncrement);
  EXPECT_NEAR(rig.actual(0), 30.0, kIncrement);
}

TEST(CanVelocity, WhatTheDriveMakesOfASpeedIsCorrected) {
  for (const double wrong : {0.98, 1.02}) {  // the drive is that much slower or faster than it says
    const double scale = 10'000.0 / 60 * wrong;
    CanRig rig(can_toml("", velocity("velocity_scale = " + std::to_string(scale) + "\nvelocity_gain = 50.0\n")));
    rig.bring_up();
    EXPECT_LE(worst_distance(&rig, "G90 G01 X60. F6000"), 100 * 0.02 / 50 + 3 * kIncrement) << wrong;  // 100 mm/s, of which 2 % are missing
    rig.step(500);
    EXPECT_NEAR(rig.plant_mm(0), 60.0, 1.5 * kIncrement) << wrong;
    EXPECT_EQ(rig.alarms(), "");
  }
}

// A delay that is not that of the drive is a distance that goes with the speed: it is found that way (docs/canopen.md).
TEST(CanVelocity, AWrongDelayIsADistanceThatGoesWithTheSpeed) {
  CanRig rig(can_toml("", "mode = \"velocity\"\nvelocity_delay = 2.5\n"));
  rig.bring_up();
  EXPECT_NEAR(worst_distance(&rig, "G90 G01 X100. F6000"), 0.5 * 0.1, 0.01);
  rig.step(500);
  EXPECT_NEAR(rig.plant_mm(0), 100.0, kIncrement);
}

TEST(CanVelocity, APushIsBroughtBackWithoutASwing) {
  CanRig rig(can_toml("", velocity("velocity_gain = 100.0\n")));
  rig.bring_up();
  rig.drives[0]->plant().position = 400;  // 0.2 mm
  double least = 400;
  for (unsigned i = 0; i < 300; ++i) {
    rig.step();
    least = std::min(least, rig.drives[0]->plant().position);
  }
  EXPECT_NEAR(rig.drives[0]->plant().position, 0, 1.0);
  EXPECT_GE(least, -20) << "at the largest gain that is allowed it comes back without a swing";
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanVelocity, AnAxisThatDoesNotFollowIsStopped) {
  CanRig rig(can_toml("", velocity()));
  rig.bring_up();
  rig.drives[0]->plant().blocked = true;
  ASSERT_EQ(rig.mdi("G90 G01 X40. F3000"), Answer::kDone);
  ASSERT_TRUE(rig.until([&rig] { return !rig.alarms().empty(); }, 2000));
  EXPECT_NE(rig.alarms().find("Following error"), std::string::npos) << rig.alarms();
  rig.step(500);
  rig.drives[0]->plant().blocked = false;  // it has been let go (can_lost_loop_test.cpp), and does not go to where it was sent
  const double place = rig.plant_mm(0);
  rig.step(500);
  EXPECT_DOUBLE_EQ(rig.plant_mm(0), place);
  ASSERT_EQ(rig.run(nc::rt::CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&rig] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
  EXPECT_NEAR(rig.plant_mm(0), rig.command(0), kIncrement);
  EXPECT_NEAR(rig.plant_mm(0), place, kIncrement);
}

TEST(CanVelocity, ItHomesAndGoesOnInItsMode) {
  CanRig rig(can_toml("", velocity("homing = { method = 1, fast = 20.0, slow = 5.0, acceleration = 500.0, request = \"home_x\", done = \"x_homed\" }\n")));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100=1"), Answer::kDone);
  ASSERT_TRUE(rig.until([&rig] { return rig.drives[0]->object(0x6061, 0) == 6; }, 2000)) << rig.alarms();
  ASSERT_TRUE(rig.until([&rig] { return rig.drives[0]->object(0x6061, 0) == 9 && rig.following(); }, 20000)) << rig.alarms();
  rig.step(100);
  EXPECT_LE(worst_distance(&rig, "G91 G01 X5. F3000"), 3 * kIncrement);
  EXPECT_EQ(rig.alarms(), "");
}

// The scan is silent: the bus's thread takes the torque away, and no speed stays in the drive.
TEST(CanVelocity, NoSpeedStaysWithoutCommands) {
  CanRig rig(can_toml("", velocity()));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("G90 G01 X400. F9000"), Answer::kDone);
  rig.step(600);
  for (unsigned i = 0; i < 200; ++i) rig.bus_step();
  const double place = rig.drives[0]->plant().position;
  for (unsigned i = 0; i < 200; ++i) rig.bus_step();
  EXPECT_DOUBLE_EQ(rig.drives[0]->plant().position, place);
  EXPECT_FALSE(rig.drives[0]->enabled());
}

// An operator who holds, goes on, resets and turns the override at any moment, with an axis in each mode: no axis is ever given more than it may have, both end together where the program says.
TEST(CanVelocity, AnyOperator) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    CanRig rig(can_toml("", velocity("velocity_gain = " + std::to_string(5 + random() % 95) + ".0\n")));
    rig.bring_up();
    double worst = 0;
    for (unsigned n = 0; n < 4; ++n) {
      const std::string block = "G90 G01 X" + std::to_string(static_cast<int>(random() % 200) - 100) + ". Y" + std::to_string(static_cast<int>(random() % 200) - 100) + ". F9000";
      Answer begun = rig.mdi(block);
      for (unsigned i = 0; i < 1000 && begun == Answer::kResetting; ++i, begun = rig.mdi(block)) rig.step();
      ASSERT_EQ(begun, Answer::kDone) << "seed " << seed << " move " << n << rig.alarms();
      const unsigned scans = 50 + random() % 1500;
      for (unsigned i = 0; i < scans; ++i) {
        if (random() % 150 == 0) (void)rig.run(nc::rt::CommandKind::kFeedHold);
        if (random() % 60 == 0) (void)rig.run(nc::rt::CommandKind::kCycleStart);
        if (random() % 200 == 0) (void)rig.runtime->execute(nc::rt::CommandKind::kFeedOverride, random() % 151);
        rig.step();
        worst = std::max(worst, std::abs(rig.drives[0]->plant().coast) / kIncrementsPerMm);  // in one SYNC
      }
      (void)rig.run(nc::rt::CommandKind::kReset);
      ASSERT_TRUE(rig.until([&rig] { return rig.idle(); }, 3000)) << "seed " << seed;
    }
    (void)rig.runtime->execute(nc::rt::CommandKind::kFeedOverride, 100);
    rig.step(500);
    EXPECT_LE(worst, 0.2 + kIncrement) << "seed " << seed;
    EXPECT_NEAR(rig.plant_mm(0), rig.command(0), 2 * kIncrement) << "seed " << seed;
    EXPECT_NEAR(rig.plant_mm(1), rig.command(1), kIncrement) << "seed " << seed;
    EXPECT_EQ(rig.alarms(), "") << "seed " << seed;
  }
}

// The same with hands and with a screw, while scans come late by any number of cycles that is allowed: a sound machine has no alarm, its motor never turns faster than it can,
// and stands where the control says, with what its screw needs.
TEST(CanVelocity, AnyHandAndLateScans) {
  const unsigned seeds = static_cast<unsigned>(nc::test::seeds(6, 2));
  for (unsigned seed = 1; seed <= seeds && !testing::Test::HasFailure(); ++seed) {
    std::mt19937 random(seed);
    const auto below = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
    std::string text = can_toml("", velocity("velocity_gain = " + std::to_string(5 + below(95)) + ".0\n"));
    const std::string axis = "name = \"X\"\nmax_velocity";
    text.replace(text.find(axis), axis.size(), "name = \"X\"\nscrew = { backlash = 0.04, from = -200.0, step = 10.0, error = [0.0, 0.02, 0.0, -0.02, 0.01] }\nmax_velocity");
    CanRig rig(text);
    rig.bring_up();
    ASSERT_EQ(rig.run(nc::rt::CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
    double worst = 0, jog = 0;
    unsigned left = 0, late = 0;
    const auto look = [&] {
      worst = std::max(worst, std::abs(rig.drives[0]->plant().coast) / kIncrementsPerMm);  // in one SYNC
    };
    for (unsigned n = 0; n < 15'000 && rig.alarms().empty(); ++n) {
      nc::rt::Command command;
      command.axis = 0;
      if (below(300) == 0) jog = (below(2) == 0 ? 1 : -1) * (1.0 + below(200)), left = 1 + below(800);
      if (left > 0 && --left % 40 == 0) {
        command.kind = nc::rt::CommandKind::kJog;
        command.value = left == 0 ? 0 : jog;
        (void)rig.runtime->execute(command);
      }
      if (below(400) == 0) {
        command.kind = nc::rt::CommandKind::kStep;
        command.value = (static_cast<int>(below(201)) - 100) / 10.0;
        (void)rig.runtime->execute(command);
      }
      if (below(3000) == 0) (void)rig.run(nc::rt::CommandKind::kReset);
      if (below(500) == 0) {
        ++late;
        for (unsigned cycles = 1 + below(18); cycles > 0; --cycles) {
          rig.bus_step();
          look();
        }
      }
      rig.step();
      look();
    }
    EXPECT_EQ(rig.alarms(), "") << "seed " << seed;
    EXPECT_GT(late, 10u);
    EXPECT_LE(worst, 0.25 + kIncrement) << "seed " << seed << ": 1.25 times the largest velocity";
    ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000)) << "seed " << seed;
    rig.step(1500);
    const double screw = rig.runtime->snapshot().system[0].axes.screw[0];
    EXPECT_NEAR(rig.plant_mm(0) - screw, rig.command(0), 2 * kIncrement) << "seed " << seed;
    EXPECT_NEAR(rig.actual(0), rig.command(0), 2 * kIncrement) << "seed " << seed;
  }
}

TEST(CanVelocity, TheGainThatNobodyGivesFitsTheSync) {
  for (const auto& [sync_us, gain] : {std::pair{1000, 30.0}, std::pair{4000, 25.0}, std::pair{10'000, 10.0}}) {
    nc::rt::Config config;
    ASSERT_TRUE(nc::rt::parse_config(can_toml("sync_us = " + std::to_string(sync_us) + "\n", velocity()), "can.toml", &config).empty());
    EXPECT_DOUBLE_EQ(config.canopen.nodes[0].axes[0].velocity_gain, gain) << sync_us;
  }
}

TEST(CanVelocity, WhatCannotBeIsAnErrorAtItsLine) {
  const auto errors = [](const std::string& axis, const std::string& bus = "") {
    nc::rt::Config config;
    std::string text;
    for (const nc::rt::ConfigError& error : nc::rt::parse_config(can_toml(bus, axis), "can.toml", &config)) text += error.text() + "\n";
    return text;
  };
  EXPECT_EQ(errors(velocity()), "");
  EXPECT_NE(errors("velocity_gain = 20.0\n").find("velocity_gain: belongs to mode"), std::string::npos) << errors("velocity_gain = 20.0\n");
  EXPECT_NE(errors(velocity("velocity_gain = 120.0\n")).find("is too large for a SYNC of 1000 us"), std::string::npos);
  EXPECT_NE(errors(velocity("velocity_gain = 30.0\n"), "sync_us = 4000\n").find("is too large for a SYNC of 4000 us: the axis would swing; at most 25"), std::string::npos);
  EXPECT_NE(errors(velocity("velocity_scale = 900000.0\n")).find("beyond the 32 bits"), std::string::npos);
  EXPECT_NE(errors("mode = \"torque\"\n").find("mode"), std::string::npos);
}

}  // namespace
