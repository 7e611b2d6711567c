// SPDX-License-Identifier: Apache-2.0
// A synchronous tap that is left in its hole (M700 13.1.1, "tap retract"): by a reset, and by a power cut.
#include <gtest/gtest.h>

#include "tap_helpers.hpp"

namespace nc::test {
namespace {

class Retract : public RealTap {
 protected:
  void into_the_hole(const std::string& before = "") {
    start(before + "G84 Z-8. R2. S600 F1.5 ,R1");
    ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
    drive->in.reset = true;
    ASSERT_TRUE(until([&] { return drive->out.state == NC_STATE_IDLE; }));
    drive->in.reset = false;
    rest();
    ASSERT_TRUE(drive->out.tap_retract_possible);
    ASSERT_LT(z(), -2);
  }
  void rest() {
    for (unsigned n = 0; n < 200; ++n) step();
  }
  double apart() const { return std::fabs(2 - z() - kLead * spindle.since_taken()); }
};
INSTANTIATE_TEST_SUITE_P(BothLaws, Retract, testing::Bool(), name_of_law);

TEST_P(Retract, TheSignalDrawsItOut) {
  into_the_hole();
  drive->in.tap_retract = true;
  double worst = 0, fastest = 0;
  ASSERT_TRUE(until([&] {
    worst = std::max(worst, apart());
    fastest = std::max(fastest, drive->out.velocity.v[2]);
    return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE;
  }));
  rest();
  EXPECT_NEAR(z(), 2, 1e-3) << "R";
  EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s) << "the spindle has turned back with it";
  EXPECT_NEAR(fastest, 15, 1) << "S times the lead";
  EXPECT_FALSE(drive->out.tap_retract_possible);
  drive->in.tap_retract = false;
  rest();
  drive->in.tap_retract = true;
  rest();
  EXPECT_NEAR(z(), 2, 1e-3) << "there is nothing left to be drawn out";
}

TEST_P(Retract, ItStandsWhileTheSignalIsOff) {
  into_the_hole();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > -6; }));
  drive->in.tap_retract = false;
  rest();
  const double stands = z();
  EXPECT_LT(stands, -3);
  rest();
  EXPECT_NEAR(z(), stands, 1e-3);
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 1.99; }));
}

TEST_P(Retract, AFeedHoldGivesTheWayUp) {
  into_the_hole();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > -6; }));
  drive->in.feed_hold = true;
  rest();
  const double stands = z();
  drive->in.feed_hold = false;
  rest();
  EXPECT_NEAR(z(), stands, 1e-3) << "the signal has to rise again";
  drive->in.tap_retract = false;
  rest();
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return z() > 1.99; }));
}

TEST_P(Retract, AStartIsRefusedWhileTheTapStandsInItsHole) {
  into_the_hole();
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE) << "nobody has pressed start";
  const double stands = z();
  const auto press = [&] {
    drive->in.cycle_start = true;
    drive->step(50);
    spindle.step(drive->out);
    read();
    rest();
  };
  press();
  EXPECT_EQ(drive->out.state, NC_STATE_IDLE);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  EXPECT_NEAR(z(), stands, 1e-3);
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE; }));
  drive->in.tap_retract = false;
  rest();
  EXPECT_EQ(drive->out.cause, NC_CAUSE_NONE) << "it is out";
  press();
  EXPECT_NE(drive->out.state, NC_STATE_IDLE) << "and the program begins";
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
}

// Out of its hole the tap lets its spindle go: rapid traverse of its axis, by hand or by a program, would turn it faster than it can.
TEST_P(Retract, OutOfItsHoleTheSpindleIsLetGo) {
  const auto out_by_signal = [&] {
    into_the_hole("G0 Z30.\n");
    drive->in.tap_retract = true;
    ASSERT_TRUE(until([&] { return !drive->out.tap_retract_possible && drive->out.state == NC_STATE_IDLE; }));
    drive->in.tap_retract = false;
    rest();
  };
  const auto out_by_hand = [&] {
    into_the_hole();
    drive->in.manual[2] = {NC_MANUAL_JOG, 5, 0};
    ASSERT_TRUE(until([&] { return z() > 2.05; }));
  };
  double angle = 0;
  const auto jog_fast = [&] {
    angle = spindle.turns();
    drive->in.manual[2] = {NC_MANUAL_JOG, 100, 0};
    EXPECT_TRUE(until([&] { return z() > 60; }));
    drive->in.manual[2] = {};
    rest();
  };
  const auto run_program = [&] {
    angle = spindle.turns();
    drive->in.cycle_start = true;
    drive->step(50);
    EXPECT_TRUE(until([&] { return z() < 0; })) << "the second time";
    drive->in.reset = true;
    rest();
    drive->in.reset = false;
  };
  out_by_signal();
  jog_fast();
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_EQ(drive->out.spindle_synchronous, 0);
  EXPECT_NEAR(spindle.turns(), angle, 0.1) << "it stands";
  out_by_hand();
  jog_fast();
  EXPECT_EQ(drive->alarm(), "") << "faster, without a stop at R";
  EXPECT_EQ(drive->out.spindle_synchronous, 0);
  out_by_signal();
  run_program();
  EXPECT_EQ(drive->alarm(), "") << "rapid traverse up to the initial level";
}

// Whatever asks for X or Y by hand would tear the tap sideways out of its hole. Its own axis goes, and the spindle with it.
TEST_P(Retract, OnlyItsOwnAxisIsMovedByHandWhileItStandsInItsHole) {
  into_the_hole();
  EXPECT_EQ(drive->out.tap_holds, 0b011u);
  const nc_manual wishes[] = {{NC_MANUAL_JOG, 20, 0}, {NC_MANUAL_STEP, 20, 5}, {NC_MANUAL_HANDLE, 0, 0.1}, {NC_MANUAL_REFERENCE, 0, 0}};
  const double x = drive->out.command.v[0], y = drive->out.command.v[1];
  uint64_t dropped = 0;
  for (const nc_manual& wish : wishes) {
    drive->in.manual[0] = drive->in.manual[1] = wish;
    for (unsigned n = 0; n < 50; ++n) step(), dropped |= drive->out.handle_dropped;
    drive->in.manual[0] = drive->in.manual[1] = {};
    rest();
  }
  EXPECT_EQ(drive->out.command.v[0], x);
  EXPECT_EQ(drive->out.command.v[1], y);
  EXPECT_EQ(dropped, 0b011u) << "the wheel is told";
  drive->in.manual[0] = {NC_MANUAL_JOG, 20, 0};  // stays pressed
  drive->in.manual[2] = {NC_MANUAL_JOG, 10, 0};
  ASSERT_TRUE(until([&] { return z() > 2.5; }));
  EXPECT_EQ(drive->out.tap_holds, 0u) << "it is out";
  drive->in.manual[2] = {};
  rest();
  EXPECT_EQ(drive->out.command.v[0], x) << "a button that was refused is let go first";
  drive->in.manual[0] = {};
  rest();
  drive->in.manual[0] = {NC_MANUAL_JOG, 20, 0};
  ASSERT_TRUE(until([&] { return drive->out.command.v[0] > x + 1; }));
}

// Behind a power cut an axis without its place cannot tell whether the tap is still in the hole.
TEST_P(Retract, AnAxisThatDoesNotKnowItsPlaceHoldsTheOthersUntilItDoes) {
  into_the_hole();
  drive->in.unlimited = 0b100;
  drive->in.manual[2] = {NC_MANUAL_JOG, 10, 0};
  ASSERT_TRUE(until([&] { return z() > 2.5; }));
  drive->in.manual[2] = {};
  rest();
  EXPECT_EQ(drive->out.tap_holds, 0b011u);
  drive->in.unlimited = 0;
  rest();
  EXPECT_EQ(drive->out.tap_holds, 0u);
}

TEST_P(Retract, ASpindleThatDoesNotTurnAnyMoreLocksNobodyOut) {
  into_the_hole();
  const double stands = spindle.turns();
  const auto cycle = [&](bool start) {  // the encoder answers, and shows a spindle that stands
    drive->in.spindle[0].rev_per_s = 0;
    drive->in.spindle[0].turns = stands;
    drive->in.spindle[0].turns_valid = true;
    drive->in.cycle_start = start;
    drive->step(50);
  };
  const auto wait = [&] {
    for (unsigned n = 0; n < 3000; ++n) cycle(false);
  };
  cycle(true);
  wait();
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  drive->in.tap_retract = true;
  wait();
  drive->in.tap_retract = false;
  EXPECT_EQ(drive->out.state, NC_STATE_ALARM) << "NC-TAP";
  drive->in.reset = true;
  cycle(false);
  drive->in.reset = false;
  wait();
  EXPECT_EQ(drive->out.state, NC_STATE_IDLE);
  EXPECT_NE(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  EXPECT_EQ(drive->out.tap_holds, 0u) << "it has to be freed by hand, and the machine moved for that";
  drive->in.tap_retract = true;  // another attempt has begun: what it finds counts, and meanwhile a start is refused again
  cycle(false);
  cycle(true);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_TAP_IN_HOLE);
  wait();
  drive->in.tap_retract = false;
  EXPECT_EQ(drive->out.state, NC_STATE_ALARM);
  drive->in.reset = true;
  cycle(false);
  drive->in.reset = false;
  wait();
  cycle(true);
  bool began = false;
  for (unsigned n = 0; n < 500; ++n) {
    began = began || drive->out.state == NC_STATE_RUNNING;
    cycle(false);
  }
  EXPECT_TRUE(began);
}

TEST_P(Retract, NothingIsDrawnOutWhereNoTapStands) {
  start("G1 Z-3. F3000");
  drive->in.tap_retract = true;
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_FALSE(drive->out.tap_retract_possible);
  rest();
  EXPECT_NEAR(z(), -3, 1e-9);
}

// What nc_tap_get() has given is kept by the host; another control, as behind a power cut, draws the tap out with it.
TEST_P(Retract, BehindAPowerCutItIsDrawnOut) {
  start("G84 Z-8. R2. S600 F1.5 ,R1");
  ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
  nc_tap tap = NC_INIT(nc_tap);
  ASSERT_EQ(nc_tap_get(bench.control(), 0, &tap), NC_OK);
  EXPECT_EQ(tap.axis, 3);
  EXPECT_NEAR(tap.entry, 2, 1e-9);
  EXPECT_NEAR(tap.turns_per_mm, -1 / kLead, 1e-9);
  EXPECT_EQ(tap.spindles, 1);
  EXPECT_EQ(tap.encoder, 1);
  const double stands = -4.2;

  Bench after(NC_DIALECT_M700, machine_that_taps(GetParam()));
  after.at(0, 0, stands);
  ASSERT_EQ(nc_tap_set(after.control(), 0, &tap), NC_OK);
  drive = std::make_unique<Drive>(after, "M30");
  spindle = RealSpindle{kRamp, kLag, kCycle_s};
  const double before = spindle.turns();
  const auto cycle = [&] {
    read();
    drive->step(50);
    spindle.step(drive->out);
  };
  for (unsigned n = 0; n < 100; ++n) cycle();
  EXPECT_TRUE(drive->out.tap_retract_possible);
  EXPECT_NEAR(spindle.turns(), before, 1e-9) << "nothing moves by itself";
  drive->in.tap_retract = true;
  double worst = 0;
  for (unsigned n = 0; n < 2000; ++n) {
    cycle();
    worst = std::max(worst, std::fabs(z() - stands + kLead * (spindle.turns() - before)));
  }
  EXPECT_NEAR(z(), 2, 1e-3);
  EXPECT_LT(worst, 1e-3 + kLead * kRamp * kLag * kCycle_s);
  EXPECT_FALSE(drive->out.tap_retract_possible);
}

// On the way to the next hole the tap is in none: neither the one that is made nor the one to come is kept.
TEST_P(Retract, BetweenTwoHolesThereIsNothingToBeDrawnOut) {
  start("G84 X5. Z-5. R5. F1. S500 ,R1\nX15. Z-8. R0. F2. ,R1");
  unsigned holes = 0;
  bool kept = false;
  ASSERT_TRUE(until([&] {
    nc_tap tap = NC_INIT(nc_tap);
    EXPECT_EQ(nc_tap_get(bench.control(), 0, &tap), NC_OK);
    const bool first = drive->out.source.line == 2, below = z() < (first ? 5 : 0) - 1e-6, strokes = (drive->out.spindle_synchronous & 1) != 0;
    if (below && strokes) {
      EXPECT_EQ(tap.axis, 3) << z();
      EXPECT_NEAR(tap.entry, first ? 5 : 0, 1e-9) << "that of the hole in hand";
    }
    if (!strokes) {
      EXPECT_EQ(tap.axis, 0) << "in the air, at Z" << z();
    }
    holes += tap.axis != 0 && !kept ? 1 : 0;
    kept = tap.axis != 0;
    return drive->ended;
  }));
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_EQ(holes, 2u);
}

TEST(TapData, OnlyATapThatCanBeIsTaken) {
  Bench bench(NC_DIALECT_M700, machine_that_taps(false));
  nc_tap tap = NC_INIT(nc_tap);
  tap.axis = 3;
  tap.turns_per_mm = 0.5;
  tap.speed = -10;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_OK);
  for (double nc_tap::*number : {&nc_tap::turns_per_mm, &nc_tap::speed}) {
    nc_tap bad = tap;
    for (const double value : {0.0, 1e12, static_cast<double>(NAN)}) {
      bad.*number = value;
      EXPECT_EQ(nc_tap_set(bench.control(), 0, &bad), NC_E_ARGUMENT) << value;
    }
  }
  nc_tap other = tap;
  other.spindles = other.encoder = 1;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &other), NC_OK);
  other.spindles = 2;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &other), NC_E_ARGUMENT) << "there is one spindle";
  other.spindles = 1;
  other.encoder = 2;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &other), NC_E_ARGUMENT);
  tap.axis = 4;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_E_ARGUMENT) << "there is no such axis";
  tap.axis = 0;
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_OK) << "no tap";
  EXPECT_EQ(nc_tap_set(bench.control(), 7, &tap), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tap_get(bench.control(), 0, nullptr), NC_E_ARGUMENT);
  nc_inputs in;
  nc_inputs_init(&in);
  nc_outputs out;
  nc_outputs_init(&out);
  ASSERT_EQ(nc_cycle(bench.control(), &in, &out), NC_OK);
  EXPECT_EQ(nc_tap_set(bench.control(), 0, &tap), NC_E_STATE) << "the scan runs";
}

}  // namespace
}  // namespace nc::test
