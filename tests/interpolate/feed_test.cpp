// SPDX-License-Identifier: Apache-2.0
// Feeds that are not constant: the handle on F1 to F5, the zone before a corner, tapping mode, reversals, feed per revolution, the skip of a
// dwell; and threads, which keep their place on the spindle.
#include <gtest/gtest.h>

#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

AxisVec at(double x, double z = 0) {
  AxisVec a;
  a[0] = x;
  a[2] = z;
  return a;
}

/// Turns the spindle, which has an encoder, on by one cycle.
void turn(Machine& m) { m.in.spindle[0].turns += m.in.spindle[0].rev_per_s * m.config.cycle_s; }

TEST(DigitFeed, TheHandleChangesItWithinItsLimits) {  // M700 7.3
  const ExecutorConfig c = standard_config();
  Program p(c);
  for (int i = 1; i <= 2; ++i) {
    Segment& s = p.line(at(100 * i), 20);
    s.feed_digit = 2;  // F1
    s.digit_most_mm_s = 50;
    s.digit_step_mm_s = 0.5F;
    p.mark();
  }
  p.end();
  Machine m(c);
  m.feed(p);
  m.in.feed_pulses = 100;  // nothing moves yet, so these pulses do not count
  m.cycle();
  m.in.feed_pulses = 0;
  m.start();
  const auto settle = [&](int pulses) {
    m.in.feed_pulses = pulses;
    m.cycle();
    m.in.feed_pulses = 0;
    for (int i = 0; i < 100; ++i) m.cycle();
    return m.out.feed_mm_min / 60;
  };
  EXPECT_NEAR(settle(0), 20, 1e-6);
  EXPECT_NEAR(settle(10), 25, 1e-6);
  EXPECT_TRUE(m.out.feed_digit_on);
  EXPECT_EQ(m.out.feed_digit, 1);
  EXPECT_NEAR(m.out.feed_command_mm_min, 1500, 1e-6);
  EXPECT_NEAR(settle(1000), 50, 1e-6);
  EXPECT_NEAR(settle(-2), 49, 1e-6);  // pulses beyond the limit are not kept
  EXPECT_EQ(settle(-10000), 0);
  EXPECT_EQ(m.out.cause, NC_CAUSE_FEED_ZERO);  // operation alarm 104
  EXPECT_NEAR(settle(80), 40, 1e-6);
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE || m.out.command.v[0] > 150; }));
  EXPECT_NEAR(m.out.feed_mm_min / 60, 40, 1e-6);  // it stays for the next F1
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(CornerOverride, SlowsDownBeforeTheEnd) {  // M700 7.10
  const ExecutorConfig c = standard_config();
  Program p(c);
  Segment& s = p.line(at(50), 20);
  s.slow_zone = 10;
  s.slow_factor = 0.5F;
  p.mark();
  p.line(at(100), 20);
  p.mark();
  p.end();
  Machine m(c);
  m.in.feed_override = 0.5;  // on top of the override
  m.feed(p);
  m.start();
  std::vector<double> speed;
  for (const double x : {30.0, 39.5, 45.0, 49.5, 60.0}) {
    ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] >= x; }));
    speed.push_back(m.out.feed_mm_min / 60);
  }
  EXPECT_NEAR(speed[0], 10, 1e-6);
  EXPECT_NEAR(speed[1], 10, 1e-6);
  EXPECT_NEAR(speed[2], 5, 1e-6);
  EXPECT_NEAR(speed[3], 5, 1e-6);
  EXPECT_NEAR(speed[4], 10, 1e-6);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

// The corner is at the end of a block that is shorter than the zone, which begins in an earlier block.
TEST(CornerOverride, ReachesBackOverShortBlocks) {  // M700 7.10
  const ExecutorConfig c = standard_config();
  Program p(c);
  for (const double end : {20.0, 40.0, 44.0, 47.0, 50.0, 80.0, 82.0}) {
    Segment& s = p.line(at(end), 20);
    s.corner_reach = 10;
    if (end == 50 || end == 82) s.slow_zone = 10;
    s.slow_factor = end == 50 ? 0.5F : 0.25F;
    p.mark();
  }
  p.line(at(100), 20);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  std::vector<double> speed;
  for (const double x : {15.0, 38.0, 43.0, 46.0, 49.5, 60.0, 75.0, 81.5, 90.0}) {
    ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] >= x; }));
    speed.push_back(m.out.feed_mm_min / 60);
  }
  const double wanted[] = {20, 20, 10, 10, 10, 20, 5, 5, 20};
  for (unsigned i = 0; i < speed.size(); ++i) EXPECT_NEAR(speed[i], wanted[i], 1e-6) << i;
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(TappingMode, OverrideAndFeedHoldDoNothing) {  // M700 7.11
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_CONTROL, 1, NC_CONTROL_TAPPING);
  p.line(at(20), 20).fixed_override = true;
  p.mark(false);
  p.line(at(40), 20).fixed_override = true;
  p.mark(false);
  p.action(NC_ACTION_CONTROL, 0, NC_CONTROL_TAPPING);
  p.line(at(60), 20);
  p.mark();
  p.end();
  Machine m(c);
  m.in.feed_override = 0.5;
  m.in.single_block = true;
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 10; }));
  m.in.feed_hold = true;
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 20.5; }));
  EXPECT_TRUE(m.out.tapping);
  EXPECT_NEAR(m.out.feed_mm_min / 60, 20, 1e-6);
  ASSERT_TRUE(m.until(p, [&] { return m.out.state != NC_STATE_RUNNING && m.still(); }));
  EXPECT_EQ(m.out.state, NC_STATE_HOLD);  // feed hold was on all the time, and acts when the mode ends
  EXPECT_GE(m.out.command.v[0], 40);
  EXPECT_FALSE(m.out.tapping);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Reversal, TheJointIsPassedAtRest) {  // M700 7.9.2
  const ExecutorConfig c = standard_config();
  for (const bool check : {false, true}) {
    Program p(c);
    AxisVec end = at(10);
    p.line(end, 20);
    p.mark();
    end[0] = 20;
    end[1] = 0.02;  // hardly a corner
    p.line(end, 20).rest_before = check;
    p.mark();
    p.end();
    Machine m(c);
    double slowest = 1e9;
    m.feed(p);
    m.start();
    ASSERT_TRUE(m.until(p, [&] {
      if (m.out.command.v[0] > 9 && m.out.command.v[0] < 11) slowest = std::min(slowest, m.out.feed_mm_min / 60);
      return m.out.state == NC_STATE_IDLE;
    }));
    EXPECT_EQ(slowest < 5, check) << slowest;
  }
}

TEST(PerRevolution, GoesWithTheSpindleAndWaitsForIt) {  // M700 7.4
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(at(100), 0).feed_mm_rev = 0.5;
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 50; ++i) m.cycle();
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_STOPPED);  // operation alarm 105
  m.in.spindle[0].rev_per_s = -20;
  m.in.feed_override = 1.5;
  for (int i = 0; i < 50; ++i) m.cycle();
  EXPECT_NEAR(m.out.feed_mm_min, 900, 1e-6);  // FC = F N OVR
  m.in.spindle[0].rev_per_s = 10000;
  for (int i = 0; i < 400; ++i) m.cycle();
  EXPECT_NEAR(m.out.feed_mm_min / 60, c.limits[0].velocity, 1e-6);  // the clamp
}

TEST(Dwell, ASkipSignalEndsIt) {  // M700 8.1 (8)
  const ExecutorConfig c = standard_config();
  Program p(c);
  Record& r = p.add(ItemKind::gate);
  r.gate = Gate{NC_GATE_DWELL_SECONDS, true, 5, 2};
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 100; ++i) m.cycle();
  m.in.skip = 1;  // another signal
  m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_DWELL);
  m.in.skip = 2;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
}

// ---- threads (M700 6.7.1) ------------------------------------------------------------------------------------------------------

/// A thread of lead 2 along Z from 0 to -20, with this start angle.
Program thread_program(const ExecutorConfig& c, float angle) {
  Program p(c);
  Segment& s = p.line(at(0, -20), 0);
  s.thread = true;
  s.feed_mm_rev = 2;
  s.thread_angle = angle;
  p.mark();
  p.end();
  return p;
}

/// The place of the thread on the spindle at half depth: turns less depth divided by lead, as a part of a turn.
double phase_of_cut(double rev_per_s, double first_turns, float angle) {
  const ExecutorConfig c = standard_config();
  const Program p = thread_program(c, angle);
  Machine m(c);
  m.in.spindle[0].rev_per_s = rev_per_s;
  m.in.spindle[0].turns = first_turns;
  m.in.spindle[0].turns_valid = true;
  m.feed(p);
  m.start();
  for (int i = 0; i < 20000 && m.out.command.v[2] > -10; ++i) {
    turn(m);
    m.cycle();
  }
  turn(m);  // the command is the place at the end of its cycle
  const double phase = m.in.spindle[0].turns * (rev_per_s > 0 ? 1 : -1) + m.out.command.v[2] / 2;
  return phase - std::floor(phase);
}

TEST(Thread, EveryPassLiesInTheSameGroove) {
  const double first = phase_of_cut(8, 0.123, 0);
  for (const double turns : {0.0, 0.5, 3.999, -7.3}) EXPECT_NEAR(phase_of_cut(8, turns, 0), first, 1e-6) << turns;
  // A second start, a third of a turn behind the first.
  const double second = phase_of_cut(8, 0.4, 120);
  EXPECT_NEAR(second - first - std::floor(second - first), 1.0 / 3, 1e-6);
  EXPECT_NEAR(phase_of_cut(-8, 0.7, 0), phase_of_cut(-8, 0.1, 0), 1e-6);
}

TEST(Thread, KeepsItsPlaceWhenTheSpindleIsUneven) {
  const ExecutorConfig c = standard_config();
  const Program p = thread_program(c, 0);
  Machine m(c);
  m.in.spindle[0].rev_per_s = 8;
  m.in.spindle[0].turns_valid = true;
  m.feed(p);
  m.start();
  double low = 1e9, high = -1e9;
  for (int i = 0; i < 20000 && m.out.command.v[2] > -18; ++i) {
    m.in.spindle[0].rev_per_s = 8 * (1 + 0.1 * std::sin(i * 0.01));
    turn(m);
    m.in.spindle[0].rev_per_s *= 1.01;  // the speed is measured one per cent wrong
    m.cycle();
    m.in.spindle[0].rev_per_s /= 1.01;
    if (m.out.command.v[2] > -4) continue;
    const double place = 2 * (m.in.spindle[0].turns + m.in.spindle[0].rev_per_s * c.cycle_s) + m.out.command.v[2];
    low = std::min(low, place), high = std::max(high, place);
  }
  EXPECT_LT(high - low, 0.01);  // mm over seven turns
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Thread, WaitsForItsAngleAndThenCannotBeHeld) {
  const ExecutorConfig c = standard_config();
  const Program p = thread_program(c, 180);
  Machine m(c);
  m.in.spindle[0].turns_valid = true;
  m.feed(p);
  m.start();
  for (int i = 0; i < 20; ++i) m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_STOPPED);
  m.in.spindle[0].rev_per_s = 0.5;
  for (int i = 0; i < 900; ++i) turn(m), m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_ANGLE);
  EXPECT_EQ(m.out.command.v[2], 0);
  m.in.feed_hold = true;  // before the axis moves it acts at once
  turn(m), m.cycle();
  m.in.feed_hold = false;
  EXPECT_EQ(m.out.state, NC_STATE_HOLD);
  m.start();
  for (int i = 0; i < 2100; ++i) turn(m), m.cycle();
  EXPECT_LT(m.out.command.v[2], 0);
}

/// S and M codes before a thread; their records hold what they command the spindle to do, according to the table of the dialect.
Program turned_thread(const ExecutorConfig& c, SpindleTurn turn) {
  Program p(c);
  p.action(NC_ACTION_M, 4);
  p.records.back().action.turn = turn;
  p.gate(NC_GATE_FIN);
  Segment& s = p.line(at(0, -20), 0);
  s.thread = true;
  s.feed_mm_rev = 2;
  p.mark();
  p.end();
  return p;
}

TEST(Thread, WaitsForASpindleThatTurnsTheWrongWay) {
  for (const bool angle : {false, true}) {
    for (const SpindleTurn way : {SpindleTurn::forward, SpindleTurn::reverse}) {
      const double right = way == SpindleTurn::forward ? 8 : -8;
      const ExecutorConfig c = standard_config();
      const Program p = turned_thread(c, way);
      Machine m(c);
      m.answer_fin = true;
      m.in.spindle[0].turns_valid = angle;
      m.in.spindle[0].rev_per_s = -right;
      m.feed(p);
      m.start();
      for (int i = 0; i < 500; ++i) turn(m), m.cycle();
      EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_REVERSED);
      EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
      EXPECT_EQ(m.out.command.v[2], 0);
      m.in.spindle[0].rev_per_s = 0;  // it slows down and turns round
      turn(m), m.cycle();
      EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_STOPPED);
      m.in.spindle[0].rev_per_s = right;
      for (int i = 0; i < 3000; ++i) turn(m), m.cycle();
      EXPECT_EQ(m.out.command.v[2], -20);
      EXPECT_EQ(m.out.state, NC_STATE_IDLE);
      EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    }
  }
}

// The thread begins with either direction if none is commanded: without an M code, after one that stops the spindle or is for another one, after
// a reset, or if the speed has no sign.
TEST(Thread, BeginsEitherWayWhereNobodyHasSaidWhich) {
  for (const double rev_per_s : {8.0, -8.0}) {
    for (const SpindleTurn turn : {SpindleTurn::as_it_is, SpindleTurn::stop, SpindleTurn::stop_all}) {
      const ExecutorConfig c = standard_config();
      const Program p = turned_thread(c, turn);
      Machine m(c);
      m.answer_fin = true;
      m.in.spindle[0].rev_per_s = rev_per_s;
      m.feed(p);
      m.start();
      for (int i = 0; i < 3000; ++i) m.cycle();
      EXPECT_EQ(m.out.command.v[2], -20);
    }
    ExecutorConfig c = standard_config();
    c.spindle_unsigned = 1;
    const Program p = turned_thread(c, SpindleTurn::reverse);
    Machine m(c);
    m.answer_fin = true;
    m.in.spindle[0].rev_per_s = rev_per_s;
    m.feed(p);
    m.start();
    for (int i = 0; i < 3000; ++i) m.cycle();
    EXPECT_EQ(m.out.command.v[2], -20);
  }
}

TEST(Thread, DoesNotBeginBeyondTheLargestFeed) {
  const ExecutorConfig c = standard_config();
  const Program p = thread_program(c, 0);
  Machine m(c);
  m.in.spindle[0].rev_per_s = 101;  // 202 mm/s; the clamp is 200
  m.in.spindle[0].turns_valid = true;
  m.feed(p);
  m.start();
  for (int i = 0; i < 100; ++i) turn(m), m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_FAST);
  EXPECT_EQ(m.out.command.v[2], 0);
}

}  // namespace
}  // namespace nc::test
