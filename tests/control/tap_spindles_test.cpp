// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) and their spindle: which way round, several of them (10.6), and one that is an axis (10.5).
#include <gtest/gtest.h>

#include "tap_helpers.hpp"

namespace nc::test {
namespace {

constexpr double kLead = 1.5;

// Series 8 G84 taps in the direction in which the spindle turns, also at the places of a pattern behind another direction.
TEST(TapDirection, IsThatOfTheSpindleAtTheHole) {
  Bench bench(NC_DIALECT_SERIES8, machine_that_taps(false));
  bench.at(0, 0, 10);
  Drive drive(bench, "S600M03\nG84X0Y0Z-8R2K1.5\nM04\nG49X20Y0I10J10\nG80\nM30");
  unsigned holes[2][2] = {};  // [before, at the pattern][forward, reverse]
  bool in_hole = false;
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.press_start();
    drive.in.spindle[0] = {};
    drive.in.spindle[0].turns_valid = true;
    drive.in.spindle[0].turns = drive.out.spindle_turns;
    drive.step(50);
    const bool deep = drive.out.command.v[2] < -2;
    if (deep && !in_hole) ++holes[drive.out.command.v[0] > 10 ? 1 : 0][drive.out.spindle_rev_min[0] < 0 ? 1 : 0];
    in_hole = deep;
  }
  EXPECT_TRUE(drive.ended);
  EXPECT_EQ(holes[0][0], 1U);
  EXPECT_EQ(holes[1][0], 0U);
  EXPECT_EQ(holes[1][1], 4U);
}

TEST(TapSpindles, EverySelectedSpindleTurnsWithTheTap) {  // 10.6
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    machine_that_taps(false)(c);
    c.system[0].spindle_count = 3;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  double turns[3] = {}, deepest[3] = {};
  uint8_t seen = 0;
  drive.in.spindle_select = 6;
  for (nc_spindle_inputs& spindle : drive.in.spindle) spindle = {};
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.press_start();
    for (unsigned i = 0; i < 3; ++i) {
      drive.in.spindle[i].turns_valid = true;
      drive.in.spindle[i].turns = turns[i];
    }
    drive.step(50);
    seen = static_cast<uint8_t>(seen | drive.out.spindle_synchronous);
    for (unsigned i = 0; i < 3; ++i)
      if ((drive.out.spindle_synchronous >> i & 1) != 0) deepest[i] = std::max(deepest[i], turns[i] = drive.out.spindle_turns);
  }
  ASSERT_TRUE(drive.ended) << drive.alarm() << unsigned{drive.out.cause};
  EXPECT_EQ(seen, 6);
  EXPECT_EQ(deepest[0], 0);
  EXPECT_NEAR(deepest[1], 10 / kLead, 0.01);
  EXPECT_NEAR(deepest[2], 10 / kLead, 0.01);
}

// What selects a spindle may begin anew with a reset. The one whose tap stands in the work goes on with its axis, and no other.
TEST(TapSpindles, ATapThatAResetHasLeftInItsHoleKeepsItsSpindle) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    machine_that_taps(false)(c);
    c.system[0].spindle_count = 2;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  const double from[2] = {0.3, 0.7};
  double turns[2] = {from[0], from[1]}, worst = 0;
  drive.in.spindle_select = 2;
  const auto z = [&] { return drive.out.command.v[2]; };
  const auto step = [&] {
    drive.press_start();
    for (unsigned i = 0; i < 2; ++i) {
      drive.in.spindle[i] = {};
      drive.in.spindle[i].turns_valid = true;
      drive.in.spindle[i].turns = turns[i];
    }
    drive.step(50);
    for (unsigned i = 0; i < 2; ++i)
      if ((drive.out.spindle_synchronous >> i & 1) != 0) turns[i] = from[i] + drive.out.spindle_turns;
    if (drive.out.spindle_synchronous != 0) worst = std::max(worst, std::fabs(2 - z() - kLead * (turns[1] - from[1])));
  };
  const auto until = [&](auto done) {
    for (unsigned n = 0; n < 20000; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  };
  ASSERT_TRUE(until([&] { return drive.out.tapping && z() < -3; }));
  drive.in.reset = true;
  drive.in.spindle_select = 1;
  ASSERT_TRUE(until([&] { return drive.out.state == NC_STATE_IDLE; }));
  drive.in.reset = false;
  for (unsigned n = 0; n < 100; ++n) step();
  ASSERT_TRUE(drive.out.tap_retract_possible);
  EXPECT_EQ(drive.out.spindle_synchronous, 2);
  EXPECT_EQ(drive.out.spindle_encoder, 2);
  drive.in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 2 - 1e-3; })) << z() << " " << drive.alarm();
  EXPECT_LT(worst, 0.1) << "mm beside the thread";
  EXPECT_EQ(turns[0], from[0]);
  drive.in.tap_retract = false;
  drive.in.manual[2] = {NC_MANUAL_JOG, 5, 0};
  ASSERT_TRUE(until([&] { return z() > 6; }));
  EXPECT_EQ(drive.out.spindle_selected, 1) << "out of the hole it is let go";
}

/// Two spindles that turn as they are told, from where they stand when a tap takes them.
class TwoSpindles {
 public:
  explicit TwoSpindles(Drive& drive) : drive_(drive) {}
  void step() {
    for (unsigned i = 0; i < 2; ++i) {
      drive_.in.spindle[i] = {};
      drive_.in.spindle[i].turns_valid = true;
      drive_.in.spindle[i].turns = turns[i];
    }
    drive_.step(50);
    for (unsigned i = 0; i < 2; ++i) {
      const bool follows = (drive_.out.spindle_synchronous >> i & 1) != 0;
      if (follows && !taken_[i]) from_[i] = turns[i] - drive_.out.spindle_turns;
      if (follows) turns[i] = from_[i] + drive_.out.spindle_turns;
      taken_[i] = follows;
    }
  }
  double turns[2] = {0.3, 0.7};

 private:
  Drive& drive_;
  bool taken_[2] = {};
  double from_[2] = {};
};

// M700 10.6.1 (6): with the power the selection of the ladder goes, and another spindle would tear the tap. The one that has tapped draws it out. Where nobody knows
// which that was, it is the one that is selected.
TEST(TapSpindles, BehindAPowerCutTheOneOfTheTapDrawsItOut) {
  const auto two = [](nc_config& c) {
    machine_that_taps(false)(c);
    c.system[0].spindle_count = 2;
  };
  Bench bench(NC_DIALECT_M700, two);
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  TwoSpindles spindles(drive);
  drive.in.spindle_select = 2;
  nc_tap tap = NC_INIT(nc_tap);
  for (unsigned n = 0; n < 20000 && !(drive.out.tapping && drive.out.command.v[2] < -3); ++n) {
    drive.press_start();
    spindles.step();
  }
  ASSERT_EQ(nc_tap_get(bench.control(), 0, &tap), NC_OK);
  EXPECT_EQ(tap.spindles, 2);
  EXPECT_EQ(tap.encoder, 2);
  for (const bool known : {true, false}) {
    Bench after(NC_DIALECT_M700, two);
    after.at(0, 0, -4.2);
    if (!known) tap.spindles = tap.encoder = 0;
    ASSERT_EQ(nc_tap_set(after.control(), 0, &tap), NC_OK);
    Drive out(after, "M30");
    TwoSpindles turning(out);
    out.in.spindle_select = 1;
    for (unsigned n = 0; n < 100; ++n) turning.step();
    ASSERT_TRUE(out.out.tap_retract_possible);
    EXPECT_EQ(out.out.spindle_synchronous, known ? 2 : 1);
    nc_tap kept = NC_INIT(nc_tap);
    ASSERT_EQ(nc_tap_get(after.control(), 0, &kept), NC_OK);
    EXPECT_EQ(kept.spindles, known ? 2 : 0) << "also over a second power cut";
    const double before[2] = {turning.turns[0], turning.turns[1]};
    const unsigned holds = known ? 1 : 0;
    out.in.tap_retract = true;
    double worst = 0;
    for (unsigned n = 0; n < 3000; ++n) {
      turning.step();
      worst = std::max(worst, std::fabs(out.out.command.v[2] + 4.2 + kLead * (turning.turns[holds] - before[holds])));
    }
    EXPECT_NEAR(out.out.command.v[2], 2, 1e-3);
    EXPECT_LT(worst, 0.1) << "mm beside the thread";
    EXPECT_EQ(turning.turns[1 - holds], before[1 - holds]);
    out.in.tap_retract = false;
    out.in.manual[2] = {NC_MANUAL_JOG, 5, 0};
    for (unsigned n = 0; n < 1000; ++n) turning.step();
    EXPECT_EQ(out.out.spindle_selected, 1) << "out of the hole it is let go";
  }
}

TEST(TapSpindles, ASpindleThatIsACAxisTurnsAsTheAxis) {  // 10.5
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    machine_that_taps(false)(c);
    nc_system_config& system = c.system[0];
    system.axis_count = 4;
    system.axis[3] = system.axis[2];
    system.axis[3].name = 'C';
    system.axis[3].rotary = true;
    system.axis[3].spindle = 1;
    system.axis[3].rapid = system.axis[3].max_velocity = 36000;
    system.axis[3].max_acceleration = 360000;
  });
  bench.at(0, 0, 10);
  Drive drive(bench, "G84 Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
  drive.in.servo_on = 8;
  drive.in.spindle[0] = {};
  drive.in.spindle[0].servo_ready = true;
  double worst = 0, most = 0, from = NAN;
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    drive.in.cycle_start = n == 5;
    drive.step(50);
    if (n == 4) from = drive.out.command.v[3];
    EXPECT_EQ(drive.out.spindle_synchronous, 0);
    const double z = drive.out.command.v[2];
    if (z < 2 && drive.out.tapping) {
      worst = std::max(worst, std::fabs(2 - z - kLead * (drive.out.command.v[3] - from) / 360));
      most = std::max(most, drive.out.command.v[3] - from);
    }
  }
  ASSERT_TRUE(drive.ended) << drive.alarm() << unsigned{drive.out.cause};
  EXPECT_LT(worst, 1e-6);
  EXPECT_NEAR(most, 360 * 10 / kLead, 5);
  EXPECT_NEAR(drive.out.command.v[3], from, 1e-9) << "it has turned back";
}

}  // namespace
}  // namespace nc::test
