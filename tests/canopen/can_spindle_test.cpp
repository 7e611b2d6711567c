// SPDX-License-Identifier: Apache-2.0
// A spindle on a CiA 402 drive: speed, both ways, gear steps, orientation, synchronous taps from its encoder, and its faults.
#include <gtest/gtest.h>

#include <iomanip>
#include <random>
#include <sstream>

#include "can_rig.hpp"
#include "hal/canopen/spindle_loop.hpp"
#include "support/seeds.hpp"

namespace {

using nc::hal::canopen::SpindleAsked;
using nc::hal::canopen::SpindleLaw;
using nc::hal::canopen::SpindleLoop;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Config;
using nc::test::can_toml;
using nc::test::CanRig;

constexpr const char* kSpindle =
    "[[canopen.drive]]\nname = \"spindle drive\"\nnode = 4\n[[canopen.drive.spindle]]\nencoder = 10000\nmax_rpm = 3000.0\nacceleration = 6000.0\n"
    "forward = \"m3\"\nbackward = \"m4\"\n";
constexpr const char* kOrient = "orient = { request = \"m19\", done = \"m19_done\", angle = 90.0, speed = 120.0, window = 1.0 }\n";
constexpr double kMotorIncrements = 10000, kTapRamp_s = 0.25;
constexpr const char* kGears = "gears = [[4, 1], [1, 1]]\ngear_select = \"gear\"\n";

// #3013 and #3017: the tap accelerates its spindle to `rpm` in a quarter of a second.
std::string with_spindle(const std::string& more = "", const std::string& base = kSpindle, unsigned sync_us = 2000, unsigned rpm = 600,
                         const std::string& most = "\"3005\" = 3000\n") {
  std::string text = can_toml("sync_us = " + std::to_string(sync_us) + "\n");
  std::string points;
  for (const char* name : {"m3", "m4", "m19"}) points += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"output\"\n";
  points += "[[point]]\nname = \"m19_done\"\ndirection = \"input\"\n[[point]]\nname = \"gear\"\ndirection = \"output\"\ntype = \"word\"\ninitial = 1\n";
  text.insert(text.find("[macro_interface]"), points);
  text.insert(text.find("\"#1000\" = "), "\"#1103\" = \"m3\"\n\"#1104\" = \"m4\"\n\"#1119\" = \"m19\"\n\"#1019\" = \"m19_done\"\n\"#1133\" = \"gear\"\n");
  return text + base + more + "[parameters]\n" + most + "\"3013\" = " + std::to_string(rpm) + "\n\"3017\" = 250\n";
}

std::string errors_of(const std::string& text) {
  Config config;
  std::string all;
  for (const auto& error : nc::rt::parse_config(text, "can.toml", &config)) all += error.text() + "\n";
  return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

struct SpindleRig : CanRig {
  explicit SpindleRig(const std::string& more = "", const std::string& base = kSpindle, unsigned sync_us = 2000, unsigned rpm = 600, const std::string& most = "\"3005\" = 3000\n")
      : CanRig(with_spindle(more, base, sync_us, rpm, most), {1, 2, 3, 4}) {
    drives[3]->sync_s = sync_us * 1e-6;
    bring_up();
    step(200);
  }
  nc::test::SimDrive& motor() { return *drives[3]; }
  double rpm() { return motor().plant().velocity * 60 / 10000; }
  nc_spindle_inputs measured() const { return runtime->snapshot().system[0].spindle[0]; }
  void block(const std::string& text, unsigned most = 5000) {
    ASSERT_EQ(mdi(text), Answer::kDone) << text;
    step(10);
    ASSERT_TRUE(until([&] { return idle(); }, most)) << alarms();
  }
};

TEST(CanSpindle, TurnsAtItsSpeedBothWays) {
  SpindleRig rig;
  EXPECT_EQ(rig.motor().object(0x6061, 0), 9u);
  EXPECT_EQ(rig.motor().object(0x1600, 2), 0x60FF0020u);
  rig.block("S600\n#1103 = 1");
  rig.step(50);
  EXPECT_GT(rig.rpm(), 200) << "6000 r/min in a second";
  EXPECT_LT(rig.rpm(), 500);
  rig.step(200);
  EXPECT_NEAR(rig.rpm(), 600, 0.01);
  EXPECT_NEAR(rig.measured().rev_per_s, 10, 0.02);
  EXPECT_TRUE(rig.measured().turns_valid);
  EXPECT_FALSE(rig.measured().unmeasured);
  rig.block("#1103 = 0\n#1104 = 1");
  rig.step(400);
  EXPECT_NEAR(rig.rpm(), -600, 0.01);
  EXPECT_NEAR(rig.measured().rev_per_s, -10, 0.02);
  rig.block("#1104 = 0");
  rig.step(400);
  EXPECT_EQ(rig.rpm(), 0);
  rig.block("S9000\n#1103 = 1");
  rig.step(1000);
  EXPECT_NEAR(rig.rpm(), 3000, 0.01) << "its highest";
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanSpindle, FeedPerRevolutionGoesByItsEncoder) {
  SpindleRig rig;
  rig.block("S600\n#1103 = 1");
  rig.step(300);
  const double turned = rig.motor().plant().position;
  rig.block("G91 G95 G01 X10. F0.5\nG94");
  EXPECT_NEAR((rig.motor().plant().position - turned) / 10000, 20, 3);
}

TEST(CanSpindle, GearStepsTurnTheMotorFaster) {
  SpindleRig rig(kGears);
  rig.block("S300\n#1103 = 1");
  rig.step(400);
  EXPECT_NEAR(rig.rpm(), 1200, 0.01);
  EXPECT_NEAR(rig.measured().rev_per_s, 5, 0.02);
  const double before = rig.measured().turns;
  rig.block("#1133 = 0");
  rig.step(400);
  EXPECT_EQ(rig.rpm(), 0) << "no gear is in";
  rig.block("#1133 = 2");
  rig.step(400);
  EXPECT_NEAR(rig.rpm(), 300, 0.01);
  EXPECT_NEAR(rig.measured().rev_per_s, 5, 0.02);
  EXPECT_LT(rig.measured().turns - before, 20) << "the angle goes on";
}

// A ladder that names the next gear while the spindle still turns, or slows down, gives the motor no step: it goes on from the speed that it has, with the acceleration of its spindle.
TEST(CanSpindle, AGearStepThatComesAmidAChangeOfSpeedLeadsTheMotorByItsSlope) {
  SpindleRig rig(kGears);
  const double steepest = 6000 * 4 * 0.002 * 1.5;  // r/min of the motor in a SYNC, in the lower gear
  rig.block("S600\n#1103 = 1");
  rig.step(400);
  EXPECT_NEAR(rig.rpm(), 2400, 0.01);
  const auto steps_no_more = [&](unsigned scans) {
    double before = rig.rpm(), most = 0;
    for (unsigned n = 0; n < scans; ++n) {
      rig.step(2);
      most = std::max(most, std::abs(rig.rpm() - before));
      before = rig.rpm();
    }
    EXPECT_LT(most, steepest);
  };
  ASSERT_EQ(rig.mdi("#1133 = 2"), Answer::kDone);
  steps_no_more(400);
  EXPECT_NEAR(rig.rpm(), 600, 0.01);
  ASSERT_EQ(rig.mdi("S1200\nG04 P20\n#1133 = 1"), Answer::kDone);  // on its way to 1200
  steps_no_more(600);
  EXPECT_NEAR(rig.rpm(), 4800, 0.01);
  ASSERT_EQ(rig.mdi("#1133 = 0\nG04 P20\n#1133 = 2"), Answer::kDone);
  steps_no_more(600);
  EXPECT_NEAR(rig.rpm(), 1200, 0.01);
}

TEST(CanSpindle, IsOrientedAndHolds) {
  SpindleRig rig(kOrient);
  rig.block("S600\n#1103 = 1");
  rig.step(300);
  rig.block("#1103 = 0\n#1119 = 1");
  ASSERT_TRUE(rig.until([&] { return (rig.runtime->snapshot().interface_input[0] >> 19 & 1u) != 0; }, 4000));
  rig.step(500);
  const double turns = rig.motor().plant().position / 10000;
  EXPECT_NEAR(turns - std::floor(turns), 0.25, 1.0 / 360);
  EXPECT_NEAR(rig.rpm(), 0, 0.5);
  rig.motor().plant().position += 400;  // something turns it
  rig.step(500);
  EXPECT_NEAR(rig.motor().plant().position / 10000, turns, 1.0 / 360) << "it holds";
  rig.block("#1119 = 0");
  rig.step(20);
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] >> 19 & 1u, 0u);
  rig.block("#1119 = 1");
  rig.step(100);
  EXPECT_NEAR(rig.motor().plant().position / 10000, turns, 1.0 / 360) << "it stands there, and does not turn once more";
}

// ---- synchronous taps ----

struct TapCut {
  unsigned sync_us = 2000, rpm = 600;
  double lead = 1.5, depth = 10;  // mm
  double spare = 1.8;             // what the motor can accelerate with, of what the tap asks for
  double lag = 0;                 // of the axis' drive: share of the way that is left after each SYNC
};

// Follows the motors of axis and spindle through a tap from R2. down. In `apart` is the farthest that the axis was beside its thread, as the motors really
// stood, in mm; in `deepest` the lowest place of the axis.
void cut_tap(const TapCut& cut, double* apart, double* deepest) {
  const double ramp_rev = cut.rpm / 60.0 / kTapRamp_s, sync_s = cut.sync_us * 1e-6;
  const double lag_s = sync_s * cut.lag / (1 - cut.lag);
  std::ostringstream more;
  if (cut.lag != 0) more << "tap_axis_lag_ms = " << lag_s * 1000 << "\n";
  const double ramp = cut.spare * ramp_rev;  // rev/s^2, of the motor as of the slope that it is given
  SpindleRig rig(more.str(), replaced(kSpindle, "acceleration = 6000.0", "acceleration = " + std::to_string(60 * ramp)), cut.sync_us, cut.rpm);
  rig.block("G90 G00 Z2.");
  rig.motor().velocity_ramp = ramp * kMotorIncrements * sync_s;
  rig.drives[2]->plant().lag = cut.lag;
  const auto turns = [&] { return rig.motor().plant().position / kMotorIncrements; };
  double began = 0;
  *apart = *deepest = 0;
  std::ostringstream blocks;
  blocks << std::fixed << std::setprecision(3) << "G90 G84 X0 Y0 Z" << 2 - cut.depth << " R2. F" << cut.lead << " S" << cut.rpm << " ,R1\nG80";
  ASSERT_EQ(rig.mdi(blocks.str()), Answer::kDone);
  ASSERT_TRUE(rig.until(
      [&] {
        const auto out = rig.runtime->snapshot().system[0].nc;
        if (out.spindle_synchronous == 0 || !out.tapping) began = turns();
        else *apart = std::max(*apart, std::abs(2 - rig.plant_mm(2) - cut.lead * (turns() - began)));
        *deepest = std::min(*deepest, rig.plant_mm(2));
        return rig.idle() && *deepest < 2 - 0.9 * cut.depth;
      },
      30'000))
      << rig.alarms() << rig.command(2);
  EXPECT_EQ(rig.alarms(), "");
  rig.step(200);
  EXPECT_NEAR(rig.rpm(), 0, 0.5);
}

// What a tap may be beside its thread: 1 um, where a half is the resolution of the axis, and what a spindle that accelerates with `ramp` changes in the dead time
// of two SYNCs and two scans.
double thread_bound(const TapCut& cut) {
  const double dead_s = 2 * cut.sync_us * 1e-6 + 0.002 + cut.sync_us * 1e-6 * cut.lag / (1 - cut.lag);
  return 1e-3 + cut.lead * cut.spare * (cut.rpm / 60.0 / kTapRamp_s) * dead_s * dead_s;
}

TEST(CanSpindle, ATapIsCutWithItsEncoder) {
  const TapCut cut;
  double apart = 0, deepest = 0;
  cut_tap(cut, &apart, &deepest);
  EXPECT_LT(apart, thread_bound(cut)) << "mm between thread and axis: at 15 mm/s a SYNC is 30 um";
  EXPECT_NEAR(deepest, -8, 0.25 * cut.lead) << "a quarter of a turn";
}

TEST(CanSpindle, TapsStayInTheirThreadOnAnyBus) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), count = nc::test::seeds(20, 2);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto between = [&random](double least, double most) { return std::uniform_real_distribution(least, most)(random); };
    TapCut cut;
    cut.sync_us = 1000 * std::uniform_int_distribution(2, 4)(random);
    cut.rpm = std::uniform_int_distribution(100, 2000)(random);
    cut.lead = std::round(between(0.4, 3) * 100) / 100;
    cut.depth = std::round(std::max(between(2, 20), 3 * cut.lead));
    cut.spare = between(1.3, 4);
    if (random() % 2 == 0) cut.lag = between(0.05, 0.7);
    double apart = 0, deepest = 0;
    cut_tap(cut, &apart, &deepest);
    EXPECT_LT(apart, thread_bound(cut)) << "seed " << seed << ": SYNC " << cut.sync_us << " us, S" << cut.rpm << ", lead " << cut.lead << ", depth " << cut.depth << ", spare " << cut.spare << ", lag " << cut.lag;
    EXPECT_NEAR(deepest, 2 - cut.depth, 0.25 * cut.lead) << seed;
    if (HasFailure()) return;
  }
}

/// A tap in cuts that an operator disturbs at random instants: overrides, holds, and a reset behind which it is drawn out by the command, with stops on the way.
/// Axis and spindle stay in one thread as the motors really stand, the tap does not stand in its hole in a hold, and it comes out.
void disturb_tap(std::mt19937_64& random, unsigned* resets) {
  const auto pick = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
  TapCut cut;
  cut.sync_us = 1000 * (2 + pick(3));
  cut.rpm = 200 + 100 * pick(12);
  cut.lead = 0.5 + 0.25 * pick(8);
  cut.depth = 4 * cut.lead + pick(8);
  const double ramp = cut.spare * (cut.rpm / 60.0 / kTapRamp_s);
  SpindleRig rig("", replaced(kSpindle, "acceleration = 6000.0", "acceleration = " + std::to_string(60 * ramp)), cut.sync_us, cut.rpm);
  rig.block("G90 G00 Z2.");
  rig.motor().velocity_ramp = ramp * kMotorIncrements * cut.sync_us * 1e-6;
  std::ostringstream blocks;
  blocks << std::fixed << std::setprecision(3) << "G90 " << (pick(2) == 0 ? "G84" : "G74") << " X0 Y0 Z" << 2 - cut.depth << " R2. F" << cut.lead << " S" << cut.rpm << " ,R1" << (pick(2) == 0 ? " Q" : " P200 Q");
  blocks << cut.depth / (1 + pick(3)) << "\nG80";
  const double hand = blocks.str().find("G84") != std::string::npos ? 1 : -1, out_at = 2 - 3e-3;
  SCOPED_TRACE(blocks.str());
  ASSERT_EQ(rig.mdi(blocks.str()), Answer::kDone);
  double began = 0, apart = 0, deepest = 2;
  bool was_in = false, reset = false, out_again = false, draws = false;
  const unsigned reset_at = 200 + pick(2500);
  for (unsigned n = 0; n < 60'000 && !(out_again && rig.idle()); ++n) {
    const auto out = rig.runtime->snapshot().system[0].nc;
    const double turns = rig.motor().plant().position / kMotorIncrements, z = rig.plant_mm(2);
    if (out.spindle_synchronous == 0) began = turns;
    const bool in_hole = z < out_at;
    if (in_hole) apart = std::max(apart, std::abs(2 - z - hand * cut.lead * (turns - began)));
    ASSERT_FALSE(in_hole && out.spindle_synchronous == 0) << "the spindle is let go in the hole, cycle " << n;
    ASSERT_FALSE(in_hole && !reset && out.state == NC_STATE_HOLD && out.distance_zero) << "it stands in its hole, cycle " << n;
    out_again = out_again || (was_in && !in_hole);
    was_in = was_in || in_hole;
    deepest = std::min(deepest, z);
    if (!reset && pick(300) == 0) (void)rig.runtime->execute(CommandKind::kFeedOverride, 0.01 * pick(200));
    if (!reset && pick(400) == 0) (void)rig.run(CommandKind::kFeedHold);
    if (!reset && out.state == NC_STATE_HOLD && pick(50) == 0) (void)rig.run(CommandKind::kCycleStart);
    if (!reset && n >= reset_at && in_hole) {
      reset = true;
      ++*resets;
      (void)rig.run(CommandKind::kReset);
    } else if (reset && out.distance_zero && !draws) {
      (void)rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual));
      if (out.tap_retract_possible && pick(20) == 0) draws = rig.run(CommandKind::kTapRetract, 1) == Answer::kDone;
    } else if (draws && pick(200) == 0) {
      draws = false;
      (void)rig.run(CommandKind::kTapRetract, 0);
    }
    rig.step();
  }
  EXPECT_TRUE(out_again) << rig.alarms() << rig.plant_mm(2);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_LT(apart, thread_bound(cut));
  if (!reset) {
    EXPECT_NEAR(deepest, 2 - cut.depth, 0.25 * cut.lead);
  }
}

TEST(CanSpindle, ATapThatIsDisturbedStaysInItsThreadAndComesOut) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), count = nc::test::seeds(20, 2);
  unsigned resets = 0;
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    disturb_tap(random, &resets);
  }
  if (count >= 10) {
    EXPECT_GT(resets, 2U) << "the sessions are not what they should be";
  }
}

// A reset in the hole, and the tap is drawn out. Its spindle comes to its place by the gain of its loop, a little beyond R and back, and the axis goes with it in the thread: within a second of the
// longest SYNC both stand at R, and move no more.
TEST(CanSpindle, BehindARetractAxisAndSpindleComeToRest) {
  struct Retract {
    unsigned sync_us, rpm;
    double lead;
  };
  for (const Retract& retract : {Retract{2000, 600, 1.5}, Retract{5000, 600, 1.5}, Retract{5000, 1500, 3}, Retract{10'000, 2000, 3}}) {
    SCOPED_TRACE(std::to_string(retract.sync_us) + " us, S" + std::to_string(retract.rpm));
    const TapCut cut{retract.sync_us, retract.rpm, retract.lead};
    const double ramp = cut.spare * cut.rpm / 60.0 / kTapRamp_s;
    SpindleRig rig("", replaced(kSpindle, "acceleration = 6000.0", "acceleration = " + std::to_string(60 * ramp)), cut.sync_us, cut.rpm);
    rig.block("G90 G00 Z2.");
    rig.motor().velocity_ramp = ramp * kMotorIncrements * cut.sync_us * 1e-6;
    std::ostringstream blocks;
    blocks << std::fixed << std::setprecision(3) << "G90 G84 X0 Y0 Z-8. R2. F" << cut.lead << " S" << cut.rpm << " ,R1\nG80";
    const double began = rig.motor().plant().position;
    ASSERT_EQ(rig.mdi(blocks.str()), Answer::kDone);
    ASSERT_TRUE(rig.until([&] { return rig.plant_mm(2) < -3; }, 30'000)) << rig.alarms();
    ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig.until([&] { return !rig.runtime->snapshot().resetting && rig.idle(); }, 5000)) << rig.alarms();
    rig.step(100);
    ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
    const auto possible = [&] { return rig.runtime->snapshot().system[0].nc.tap_retract_possible; };
    ASSERT_TRUE(possible());
    for (unsigned n = 0; n < 100 && possible(); ++n) {
      ASSERT_EQ(rig.run(CommandKind::kTapRetract, 1), Answer::kDone) << rig.alarms();
      rig.step(50);
    }
    ASSERT_FALSE(possible());
    double apart = 0;
    for (unsigned n = 0; n < 1000; ++n) {
      rig.step();
      apart = std::max(apart, std::abs(rig.plant_mm(2) - 2 + cut.lead * (rig.motor().plant().position - began) / kMotorIncrements));
    }
    EXPECT_LT(apart, thread_bound(cut)) << "in the thread";
    EXPECT_NEAR(rig.plant_mm(2), 2, 1e-3);
    const double axis = rig.plant_mm(2), spindle = rig.motor().plant().position;
    for (unsigned n = 0; n < 2000; ++n) {
      rig.step();
      ASSERT_NEAR(rig.plant_mm(2), axis, 1e-9) << n;
      ASSERT_NEAR(rig.motor().plant().position, spindle, 1e-9) << n;
    }
    EXPECT_EQ(rig.alarms(), "");
  }
}

TEST(CanSpindle, ItsFaultNamesItAndStopsTheAxes) {
  SpindleRig rig;
  rig.block("S600\n#1103 = 1");
  ASSERT_EQ(rig.mdi("G91 G01 X100. F1000"), Answer::kDone);
  rig.step(300);
  rig.motor().trip(0, 0x3210, 0x05);
  rig.step(20);
  EXPECT_EQ(rig.alarms().rfind("R12 Drive fault: EMCY 3210h: DC link over-voltage (error register 05h), spindle 1", 0), 0u) << rig.alarms();
  EXPECT_TRUE(rig.measured().unmeasured);
  rig.step(500);
  EXPECT_FALSE(rig.enabled());
  ASSERT_EQ(rig.mdi("#1103 = 0"), Answer::kAlarmActive);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.enabled(); }, 4000)) << rig.alarms();
}

// ---- behind a loss of "enabled" ----

// A fault of the spindle's own drive, and of that of an axis: the ladder of this machine leaves its point on.
TEST(CanSpindle, BehindAFaultOfAnyDriveAResetAloneTurnsNothing) {
  for (const unsigned drive : {0u, 3u})
    for (const char* point : {"#1103", "#1104"}) {
      SpindleRig rig;
      rig.block(std::string("S600\n") + point + " = 1");
      rig.step(300);
      ASSERT_NEAR(std::abs(rig.rpm()), 600, 0.01);
      rig.drives[drive]->trip(0, 0x3210, 0x05);
      rig.step(1000);
      ASSERT_FALSE(rig.enabled());
      rig.motor().plant().velocity = 0;
      ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
      ASSERT_TRUE(rig.until([&] { return rig.enabled(); }, 4000)) << rig.alarms();
      const double stood = rig.motor().plant().position;
      rig.step(1000);
      EXPECT_NEAR(rig.motor().plant().position, stood, 1) << drive << point;
      rig.block("M08");
      rig.step(300);
      EXPECT_NEAR(rig.motor().plant().position, stood, 1) << "a function that is not for the spindle";
      rig.block(std::string(point) + " = 0");
      rig.step(20);
      EXPECT_NEAR(rig.motor().plant().position, stood, 1);
      rig.block(std::string(point) + " = 1");
      rig.step(300);
      EXPECT_NEAR(std::abs(rig.rpm()), 600, 0.01) << "let go first, then asked for again";
      EXPECT_EQ(rig.alarms(), "");
    }
}

TEST(CanSpindle, BehindAFaultANewSpeedIsANewCommand) {
  SpindleRig rig;
  rig.block("S600\n#1103 = 1");
  rig.step(300);
  rig.motor().trip(0, 0x3210, 0x05);
  rig.step(1000);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.enabled(); }, 4000)) << rig.alarms();
  rig.step(300);
  ASSERT_NEAR(rig.rpm(), 0, 0.01);
  rig.block("S300");
  rig.step(300);
  EXPECT_NEAR(rig.rpm(), 300, 0.01);
}

// A point that rises while the drive is off is no command for the time when it is on again.
TEST(CanSpindle, APointThatRisesWhileTheDriveIsOffTurnsNothingBehindTheReset) {
  SpindleRig rig;
  rig.block("S600");
  rig.motor().trip(0, 0x3210, 0x05);
  rig.step(1000);
  rig.shell.held_on = rig.config.points.find("m3");
  rig.step(20);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.enabled(); }, 4000)) << rig.alarms();
  rig.step(500);
  EXPECT_NEAR(rig.rpm(), 0, 0.01);
}

TEST(CanSpindle, BehindAFaultNothingIsOrientedByTheResetAlone) {
  SpindleRig rig(kOrient);
  rig.block("#1119 = 1");
  ASSERT_TRUE(rig.until([&] { return (rig.runtime->snapshot().interface_input[0] >> 19 & 1u) != 0; }, 4000));
  rig.motor().trip(0, 0x3210, 0x05);
  rig.step(500);
  rig.motor().plant().position += 3000;  // somebody turns it meanwhile
  const double stood = rig.motor().plant().position;
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.enabled(); }, 4000)) << rig.alarms();
  rig.step(1500);
  EXPECT_NEAR(rig.motor().plant().position, stood, 1);
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] >> 19 & 1u, 0u);
  rig.block("#1119 = 0");
  rig.block("#1119 = 1");
  EXPECT_TRUE(rig.until([&] { return (rig.runtime->snapshot().interface_input[0] >> 19 & 1u) != 0; }, 4000));
}

// Alarms that stop the axes on their paths leave its drive on: whether it turns on is for its points, which are the machine's (docs/safety.md).
TEST(CanSpindle, AnAlarmThatHoldsTheDrivesLeavesItsSpeedToItsPoints) {
  SpindleRig rig;
  rig.block("S600\n#1103 = 1");
  ASSERT_TRUE(rig.until([&] { return rig.rpm() > 595; }, 3000));
  ASSERT_EQ(rig.mdi("G91 G01 X100. F1000"), Answer::kDone);
  rig.step(300);
  rig.drives[0]->plant().blocked = true;
  rig.step(200);
  EXPECT_EQ(rig.alarms().substr(0, 3), "R11");
  EXPECT_TRUE(rig.enabled());
  EXPECT_NEAR(rig.rpm(), 600, 5);
  rig.drives[0]->plant().blocked = false;
}

TEST(CanSpindle, WithoutItsDriveTheSpeedIsNotMeasured) {
  SpindleRig rig;
  rig.motor().dead = true;
  rig.step(400);
  EXPECT_TRUE(rig.measured().unmeasured);
  EXPECT_NE(rig.alarms().find("spindle 1"), std::string::npos) << rig.alarms();
}

TEST(CanSpindle, WhatIsWrongInTheFileIsNamed) {
  const struct {
    const char *from, *to, *says;
  } rows[] = {
      {"encoder = 10000\nmax_rpm", "max_rpm", "canopen.drive[4].spindle[1].encoder: is missing"},
      {"max_rpm = 3000.0", "max_rpm = -1.0", "canopen.drive[4].spindle[1].max_rpm: must be"},
      {"acceleration = 6000.0\n", "", "canopen.drive[4].spindle[1].acceleration: is missing"},
      {"forward = \"m3\"", "forward = \"m33\"", "canopen.drive[4].spindle[1].forward: no point is named \"m33\""},
      {"forward = \"m3\"", "forward = \"m19_done\"", "canopen.drive[4].spindle[1].forward: point \"m19_done\" must be a bit and an output"},
      {"backward = \"m4\"\n", "backward = \"m4\"\nnumber = 2\n", "canopen.drive[4].spindle[1].number: must be"},
      {"backward = \"m4\"\n", "backward = \"m4\"\nmode = \"torque\"\n", "canopen.drive[4].spindle[1].mode: must be"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ngears = [[1]]\n", "canopen.drive[4].spindle[1].gears: is one pair for each gear step"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ngears = [[1, 0]]\n", "canopen.drive[4].spindle[1].gears: is one pair for each gear step"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ngears = [[4, 1], [1, 1]]\n", "canopen.drive[4].spindle[1].gears: with several steps gear_select names the point"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ngear_select = \"gear\"\n", "canopen.drive[4].spindle[1].gear_select: is for several gears"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ntap_axis_lag_ms = -1.0\n", "canopen.drive[4].spindle[1].tap_axis_lag_ms: must be"},
      {"backward = \"m4\"\n", "backward = \"m4\"\nvelocity_scale = 1e8\n", "canopen.drive[4].spindle[1].max_rpm: is more than the 32 bits of 60FFh can say"},
      {"backward = \"m4\"\n", "backward = \"m4\"\norient = { request = \"m19\" }\n", "canopen.drive[4].spindle[1].orient.done: is missing"},
      {"backward = \"m4\"", "backward = \"m3\"", "canopen.drive[4].spindle[1].backward: point \"m3\" asks for two things: a way for spindle 1 to turn, and a way for spindle 1 to turn, first in line"},
      {"backward = \"m4\"\n", "backward = \"m4\"\norient = { request = \"m3\", done = \"m19_done\" }\n", "canopen.drive[4].spindle[1].orient.request: point \"m3\" asks for two things: a way for spindle 1 to turn, and the orientation of spindle 1, first in line"},
      {"backward = \"m4\"\n", "backward = \"m4\"\norient = { request = \"m4\", done = \"m19_done\" }\n", "canopen.drive[4].spindle[1].orient.request: point \"m4\" asks for two things: a way for spindle 1 to turn, and the orientation of spindle 1, first in line"},
      {"backward = \"m4\"\n", "backward = \"m4\"\norient = { request = \"m19\", done = \"m19_done\", speed = 3001.0 }\n",
       "canopen.drive[4].spindle[1].orient.speed: is above max_rpm (3000)"},
      {"max_rpm = 3000.0", "max_rpm = 59.0\norient = { request = \"m19\", done = \"m19_done\" }", "canopen.drive[4].spindle[1].orient.speed: is above max_rpm (59)"},
      {"backward = \"m4\"\n", "backward = \"m4\"\ngain = 50.1\n",
       "canopen.drive[4].spindle[1].gain: is too large for a SYNC of 2000 us: the spindle would swing; at most 50"},
      {"[canopen]\n", "[[spindle]]\nfeedback = \"none\"\n[canopen]\n", "spindle[1].feedback: spindle 1 is on a drive, which measures it"},
      {"backward = \"m4\"\n", "backward = \"m4\"\n[[canopen.drive.spindle]]\nencoder = 1\nmax_rpm = 1.0\nacceleration = 1.0\nforward = \"m3\"\nbackward = \"m4\"\n",
       "canopen.drive[4].spindle[2].encoder: spindle 1 is on this drive already"},
  };
  ASSERT_EQ(errors_of(with_spindle()), "");
  for (const auto& row : rows) {
    const std::string said = errors_of(replaced(with_spindle(), row.from, row.to));
    EXPECT_NE(said.find(row.says), std::string::npos) << row.to << "\n" << said;
    EXPECT_EQ(said.rfind("can.toml:", 0), 0u) << said;
  }
  const std::string both = errors_of(with_spindle(std::string(kGears) + kOrient));
  EXPECT_NE(both.find("orient.request: a spindle with gear steps cannot be oriented by its motor"), std::string::npos) << both;
}

// M700 13.1.1 (14): no tap turns its spindle faster than #3005, and what does not name it has max_rpm. A tap with a higher S would lose its spindle in the hole.
TEST(CanSpindle, ATapGoesNoFasterThanItsSpindleCan) {
  for (const char* named : {"\"3005\" = 2000\n", ""}) {
    SpindleRig rig(std::string(), kSpindle, 2000, 1200, named);
    rig.block("G90 G0 Z0");
    ASSERT_EQ(rig.mdi("G84 X0 Y0 Z-45. R0 F.5 S9000 ,R1\nG80"), Answer::kDone);
    double most = 0;
    ASSERT_TRUE(rig.until([&] {
      most = std::max(most, std::fabs(rig.rpm()));
      return rig.idle();
    }, 20000)) << rig.alarms();
    EXPECT_EQ(rig.alarms(), "");
    EXPECT_LT(most, *named != 0 ? 2020 : 3020);
    EXPECT_GT(most, *named != 0 ? 1950 : 2950);
  }
}

// An angle is held by the loop of an axis whose drive is given a speed, so the gain that a file does not give is one that cannot swing either.
TEST(CanSpindle, TheGainThatNobodyGivesFitsTheSync) {
  for (const auto& [sync_us, gain] : {std::pair{2000u, 30.0}, std::pair{4000u, 25.0}, std::pair{10'000u, 10.0}}) {
    Config config;
    ASSERT_TRUE(nc::rt::parse_config(with_spindle("", kSpindle, sync_us), "can.toml", &config).empty());
    EXPECT_DOUBLE_EQ(config.canopen.nodes[3].axes[0].spindle->law.gain, gain) << sync_us;
  }
}

TEST(CanSpindle, WithTheLargestGainOfALongSyncItStandsAtItsAngle) {
  SpindleRig rig(std::string(kOrient) + "gain = 10.0\n", kSpindle, 10'000);
  rig.block("#1119 = 1");
  ASSERT_TRUE(rig.until([&] { return (rig.runtime->snapshot().interface_input[0] >> 19 & 1u) != 0; }, 20'000));
  rig.step(1000);
  double least = 1e9, most = -1e9;
  for (int n = 0; n < 2000; ++n) {
    rig.step();
    least = std::min(least, rig.motor().plant().position);
    most = std::max(most, rig.motor().plant().position);
  }
  EXPECT_LT((most - least) / 10000 * 360, 0.1) << "degrees";
}

// ---- the law by itself ----

TEST(SpindleLoop, AFollowedAngleIsReachedWithinTheRampOfADriveThatLags) {
  SpindleLaw law;
  law.acceleration = 50;
  law.most = 50;
  SpindleLoop loop(law);
  double turns = 0.3, given[3] = {};  // the drive takes the speed three scans later
  SpindleAsked asked;
  asked.enabled = asked.synchronous = true;
  double worst = 0;
  for (int n = 0; n < 4000; ++n) {
    const double t = std::max(0, n - 100) * 0.001;
    asked.turns = t < 0.2 ? 0.5 * 40 * t * t : 0.8 + 8 * (t - 0.2);
    const double speed = loop.step(asked, turns, 0.001);
    turns += given[0] * 0.001;
    given[0] = given[1], given[1] = given[2], given[2] = speed;
    if (n > 200) worst = std::max(worst, std::abs(turns - 0.3 - asked.turns));
  }
  EXPECT_LT(worst, 0.06);
  EXPECT_NEAR(turns - 0.3, asked.turns, 0.03);
}

}  // namespace
