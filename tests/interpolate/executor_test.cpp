// SPDX-License-Identifier: Apache-2.0
// The executor's states, gates, handshake, syncs, truncation and alarms, one promise per test.
#include <gtest/gtest.h>

#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

AxisVec xyz(double x, double y = 0, double z = 0) {
  AxisVec a;
  a[0] = x;
  a[1] = y;
  a[2] = z;
  return a;
}

/// Ten lines along X of 5 mm, one block each.
Program ten_lines(const ExecutorConfig& c, double feed = 50) {
  Program p(c);
  for (int i = 1; i <= 10; ++i) {
    p.line(xyz(5.0 * i), feed);
    p.mark();
  }
  p.end();
  return p;
}

TEST(Executor, RunsToTheEndAndReportsEverything) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  ASSERT_FALSE(m.overflowed);
  ASSERT_TRUE(m.run_to_end(p));
  EXPECT_EQ(check_events(p, m.events, 3), "");
  EXPECT_EQ(m.out.command.v[0], 50.0);
  EXPECT_EQ(m.out.blocks, 10u);
  EXPECT_NEAR(m.out.path_length, 50, 1e-9);
  EXPECT_TRUE(m.executor.drained());
  // Trapezoid of one 50 mm line at 50 mm/s and 2000 mm/s^2: 1 s and 25 ms, to the cycle (the joints are
  // collinear).
  EXPECT_NEAR(m.out.run_s, 1.025, 0.002);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, DoesNothingBeforeCycleStart) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  for (int i = 0; i < 50; ++i) {
    m.feed(p);
    m.cycle();
  }
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_TRUE(m.events.empty());
}

TEST(Executor, FeedHoldStopsOnThePathAndCycleStartGoesOn) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 200; ++i) m.cycle();
  m.in.feed_hold = true;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_HOLD);
  EXPECT_FALSE(m.still());
  for (int i = 0; i < 40; ++i) m.cycle();
  EXPECT_TRUE(m.still());
  EXPECT_EQ(m.out.cause, NC_CAUSE_FEED_HOLD);
  const double x = m.out.command.v[0];
  m.start();  // refused while the switch is on
  for (int i = 0; i < 10; ++i) m.cycle();
  EXPECT_EQ(m.out.command.v[0], x);
  m.in.feed_hold = false;
  for (int i = 0; i < 10; ++i) m.cycle();
  EXPECT_EQ(m.out.command.v[0], x) << "letting go is not starting";
  m.start();
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(check_events(p, m.events, 3), "");
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, SingleBlockStopsAtEveryBlockEndExactly) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.in.single_block = true;
  m.cycle();
  m.feed(p);
  for (int i = 1; i <= 10; ++i) {
    m.feed(p);
    m.start();
    ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
    EXPECT_EQ(m.out.cause, NC_CAUSE_SINGLE_BLOCK);
    EXPECT_EQ(m.out.command.v[0], 5.0 * i);
    EXPECT_EQ(m.out.blocks, static_cast<uint64_t>(i));
  }
  m.start();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(check_events(p, m.events, 3), "");
}

TEST(Executor, SingleBlockSwitchedOnLateStopsAtTheFirstBlockEndThatCanBeReachedAtRest) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  for (int i = 1; i <= 200; ++i) {  // 0.5 mm blocks at 100 mm/s: stopping takes 2.5 mm
    p.line(xyz(0.5 * i), 100);
    p.mark();
  }
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 20; }));
  m.in.single_block = true;
  const double x = m.out.command.v[0];
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  const double stop = m.out.command.v[0];
  EXPECT_NEAR(std::remainder(stop, 0.5), 0, 1e-12) << "at the end of a block";
  EXPECT_LE(stop - x, 2.5 + 0.5 + 0.3) << "stopping distance, one block, what a cycle of replanning takes";
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, StopsWhereItStarvesAndGoesOnWhenFed) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p, 4);  // two lines and their marks
  m.start();
  for (int i = 0; i < 600; ++i) {
    m.executor.plan();
    m.cycle();
  }
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  EXPECT_EQ(m.out.cause, NC_CAUSE_STARVED);
  EXPECT_EQ(m.out.command.v[0], 10.0) << "the last line committed is not held back for ever";
  EXPECT_TRUE(m.executor.drained());
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(check_events(p, m.events, 3), "");
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, FinHandshake) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_M, 8);
  p.action(NC_ACTION_T, 12);
  p.gate(NC_GATE_FIN);
  p.action(NC_ACTION_M, 6);
  p.gate(NC_GATE_FIN);
  p.mark();
  p.end();
  Machine m(c);
  m.answer_fin = false;
  m.feed(p);
  m.start();
  EXPECT_EQ(m.out.strobe, 0b101);
  EXPECT_EQ(m.out.m, 8u);
  EXPECT_EQ(m.out.t, 12u);
  for (int i = 0; i < 5; ++i) m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_FIN);
  EXPECT_EQ(m.events.size(), 2u);
  m.in.fin = true;
  m.cycle();
  EXPECT_EQ(m.out.strobe, 0) << "FIN takes the strobes away, and the next may not rise while it is on";
  EXPECT_EQ(m.out.m, 8u);
  for (int i = 0; i < 5; ++i) m.cycle();
  EXPECT_EQ(m.out.m, 8u);
  EXPECT_EQ(m.out.cause, NC_CAUSE_FIN);
  m.in.fin = false;
  m.cycle();
  EXPECT_EQ(m.out.strobe, 0b001);
  EXPECT_EQ(m.out.m, 6u);
  EXPECT_EQ(m.out.fin_wait, 0b001);
  m.in.fin = true;
  for (int i = 0; i < 3; ++i) m.cycle();
  EXPECT_EQ(m.out.strobe, 0);
  EXPECT_EQ(m.out.fin_wait, 0b001) << "FIN1 completes when it falls";
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  m.in.fin = false;
  m.cycle();
  EXPECT_EQ(m.out.fin_wait, 0);
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(check_events(p, m.events, 3), "");
}

TEST(Executor, Fin2CompletesWhenItRises) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_M, 8);
  p.gate(NC_GATE_FIN);
  p.line(xyz(1), 50);
  p.action(NC_ACTION_M, 9);
  p.gate(NC_GATE_FIN);
  p.end();
  Machine m(c);
  m.answer_fin = false;
  m.feed(p);
  m.start();
  EXPECT_EQ(m.out.strobe, 1);
  m.in.fin2 = true;
  m.cycle();
  EXPECT_EQ(m.out.fin_wait, 0);
  EXPECT_NE(m.out.cause, NC_CAUSE_FIN) << "the program goes on while FIN2 is still on";
  for (int i = 0; i < 2000 && m.out.m != 9; ++i) {
    m.feed(p);
    m.cycle();
    if (m.out.command.v[0] >= 1) break;
  }
  for (int i = 0; i < 5; ++i) m.cycle();
  EXPECT_EQ(m.out.m, 8u) << "the next strobe waits until it is off";
  m.in.fin2 = false;
  m.cycle();
  EXPECT_EQ(m.out.m, 9u);
  EXPECT_EQ(m.out.strobe, 1);
  m.in.fin2 = true;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
}

TEST(Executor, AFinThatWasOnBeforeTheStrobeDoesNotCount) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_M, 8);
  p.gate(NC_GATE_FIN);
  p.end();
  Machine m(c);
  m.answer_fin = false;
  m.in.fin = true;
  m.feed(p);
  m.start();
  for (int i = 0; i < 20; ++i) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  EXPECT_EQ(m.out.cause, NC_CAUSE_FIN);
  m.in.fin = false;
  m.cycle();
  EXPECT_EQ(m.out.strobe, 1);
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  m.in.fin = true;
  m.cycle();
  m.in.fin = false;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
}

TEST(Executor, ResetWhileWaitingForFinTakesTheStrobeAway) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_M, 6);
  p.gate(NC_GATE_FIN);
  p.line(xyz(10), 50);
  p.end();
  Machine m(c);
  m.answer_fin = false;
  m.feed(p);
  m.start();
  EXPECT_EQ(m.out.strobe, 1);
  m.reset();
  EXPECT_EQ(m.out.strobe, 0);
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.epoch(), 1u);
  m.in.fin = true;  // late
  for (int i = 0; i < 20; ++i) m.cycle();
  EXPECT_TRUE(m.executor.drained()) << "records of the old epoch are gone";
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_EQ(m.events.size(), 1u) << "only the M was executed";
}

TEST(Executor, DwellTakesItsTimeAndTurnsTheirTurns) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.gate(NC_GATE_DWELL_SECONDS, 0.25);
  p.mark();
  p.gate(NC_GATE_DWELL_TURNS, 3);
  p.end();
  Machine m(c);
  m.in.spindle[0].rev_per_s = -20;
  m.feed(p);
  m.start();
  uint64_t first = 0;
  while (m.out.state != NC_STATE_IDLE && m.cycles < 1000) {
    m.cycle();
    if (m.events.size() == 2 && first == 0) first = m.cycles;
  }
  EXPECT_NEAR(static_cast<double>(first), 250, 1);
  EXPECT_NEAR(static_cast<double>(m.cycles), 250 + 150, 1);
}

TEST(Executor, DwellAndLineTogetherLoseNoTimeToCycles) {
  // 100 times 2.5 cycles of dwell: exact within a cycle means 250 cycles in all.
  const ExecutorConfig c = standard_config();
  Program p(c);
  for (int i = 0; i < 100; ++i) p.gate(NC_GATE_DWELL_SECONDS, 0.0025);
  p.end();
  Machine m(c);
  ASSERT_TRUE(m.run_to_end(p));
  EXPECT_NEAR(static_cast<double>(m.cycles), 250, 1);
}

TEST(Executor, InPositionWaitsForTheAxes) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(xyz(1), 50);
  p.gate(NC_GATE_IN_POSITION);
  p.end();
  Machine m(c);
  m.in.actual_valid = true;
  m.feed(p);
  m.start();
  for (int i = 0; i < 100; ++i) m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_IN_POSITION);
  m.in.actual.v[0] = 0.989;
  m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_IN_POSITION);
  m.in.actual.v[0] = 0.991;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
}

TEST(Executor, ProgramStopAndOptionalStop) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.gate(NC_GATE_OPTIONAL_STOP);
  p.line(xyz(1), 50);
  p.gate(NC_GATE_STOP);
  p.line(xyz(2), 50);
  p.gate(NC_GATE_OPTIONAL_STOP);
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.out.cause, NC_CAUSE_PROGRAM_STOP);
  EXPECT_EQ(m.out.command.v[0], 1.0);
  m.in.optional_stop = true;
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.out.command.v[0], 2.0);
  m.start();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
}

TEST(Executor, OutputsAreWrittenWhenThePathGetsThereAndDoNotStopIt) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(xyz(10), 100);
  p.action(NC_ACTION_OUTPUT, 0, 2, 0xf0, 0x50);
  p.mark();
  p.line(xyz(20), 100);
  p.action(NC_ACTION_OUTPUT, 0, 2, 0x10, 0);
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  double slowest = 1e9;
  unsigned writes = 0;
  while (m.out.command.v[0] < 15 && m.cycles < 1000) {
    m.cycle();
    const double x = m.out.command.v[0];
    EXPECT_EQ(m.out.output[2], x >= 10 ? 0x50u : 0u) << x;
    writes += m.out.output_written[2] == 0xf0 ? 1 : 0;
    if (x > 8 && x < 12) slowest = std::min(slowest, m.out.velocity.v[0]);
  }
  EXPECT_EQ(writes, 1u) << "in the cycle of the block alone";
  EXPECT_NEAR(slowest, 100, 1e-6);
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.output[2], 0x40u);
}

TEST(Executor, SyncGivesTheWorldOfItsMoment) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(xyz(3), 50);
  p.sync(NC_SYNC_INPUT);
  Machine m(c);
  m.feed(p);
  nc_world w{};
  m.in.input[1] = 0x1234;
  m.in.clock_ms = 77;
  m.start();
  EXPECT_FALSE(m.executor.sync_reached(2, &w));
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(2, &w); }));
  EXPECT_FALSE(m.executor.sync_reached(1, &w));
  EXPECT_EQ(w.machine.v[0], 3.0);
  EXPECT_EQ(w.input[1], 0x1234u);
  EXPECT_EQ(w.clock_ms, 77);
  EXPECT_FALSE(w.skipped);
  EXPECT_NEAR(w.power_on_ms, static_cast<double>(m.cycles), 2);
  EXPECT_NEAR(w.run_ms, static_cast<double>(m.cycles), 3);
}

TEST(Executor, CurrentLimitsGoOutWithTheirAction) {  // M700 15.6
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(xyz(1, 0, 0), 10);
  p.action(NC_ACTION_CURRENT_LIMIT, 80, 1);
  p.line(xyz(2, 0, 0), 10);
  Machine m(c);
  m.feed(p);
  m.start();
  EXPECT_EQ(m.out.current_limit[1], 0);
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] == 2; }));
  EXPECT_EQ(m.out.current_limit[1], 80);
  EXPECT_EQ(m.out.current_limit[0], 0);
}

TEST(Executor, ResetStopsOnThePathAndGivesEverythingUp) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 300; ++i) m.cycle();
  m.reset();
  EXPECT_EQ(m.epoch(), 0u) << "not before it is at rest";
  for (int i = 0; i < 40; ++i) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.epoch(), 1u);
  EXPECT_TRUE(m.still());
  EXPECT_TRUE(m.executor.drained());
  // A record that the feeder had made before it knew of the reset is discarded, too.
  Program late(c, m.command());
  late.line(xyz(100), 50);
  late.mark();
  late.end();
  for (Record r : late.records) {
    r.epoch = 0;
    m.executor.push(r);
  }
  m.executor.plan();
  const double x = m.out.command.v[0];
  m.start();
  for (int i = 0; i < 50; ++i) m.cycle();
  EXPECT_EQ(m.out.command.v[0], x);
  EXPECT_TRUE(m.executor.drained());
  // and the new epoch runs
  m.next = 0;
  ASSERT_TRUE(m.until(late, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[0], 100);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, AlarmInputStopsAndNeedsReset) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 300; ++i) m.cycle();
  m.in.alarm = true;
  for (int i = 0; i < 60; ++i) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_ALARM);
  EXPECT_EQ(m.out.cause, NC_CAUSE_ALARM);
  EXPECT_TRUE(m.still());
  m.in.alarm = false;
  m.start();
  for (int i = 0; i < 10; ++i) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_ALARM);
  EXPECT_TRUE(m.still());
  m.reset();
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

/// A move that does not begin where the axes are raises an alarm for which there is no record: until a reset the feeder can ask which move it was.
TEST(Executor, AMoveThatCannotBeginIsAnAlarmOfTheScansOwn) {
  for (const bool optimal : {false, true}) {
    SCOPED_TRACE(optimal);
    ExecutorConfig c = standard_config();
    c.optimal = optimal;
    for (unsigned i = 0; i < 3; ++i) c.limits[i].jerk = optimal ? 50000 : 0;
    Program p(c);
    p.line(xyz(4), 50);
    p.mark();
    p.gate(NC_GATE_IN_POSITION);
    Program elsewhere(c, xyz(9));
    elsewhere.line(xyz(9, 3), 50);
    p.records.push_back(elsewhere.records[0]);
    p.records.back().source.line = 7;
    p.mark();
    p.end();
    Machine m(c);
    nc_source place{};
    m.feed(p);
    m.start();
    EXPECT_FALSE(m.executor.faulted(&place));
    ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_ALARM; }, 5000));
    ASSERT_TRUE(m.executor.faulted(&place)) << "in the cycle that shows the alarm";
    EXPECT_EQ(place.line, 7u);
    for (int i = 0; i < 5; ++i) m.cycle();
    EXPECT_TRUE(m.executor.faulted(&place));
    EXPECT_EQ(m.command(), xyz(4)) << "nothing has jumped";
    m.reset();
    m.cycle();
    EXPECT_EQ(m.out.state, NC_STATE_IDLE);
    EXPECT_FALSE(m.executor.faulted(&place));
    m.in.alarm = true;  // an alarm of the machine is no fault of a move
    for (int i = 0; i < 3; ++i) m.cycle();
    EXPECT_EQ(m.out.state, NC_STATE_ALARM);
    EXPECT_FALSE(m.executor.faulted(&place));
  }
}

TEST(Executor, AlarmRecordStopsAfterEverythingBefore) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.line(xyz(4), 50);
  p.mark();
  p.alarm();
  p.end(false);
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_ALARM; }));
  EXPECT_EQ(m.out.command.v[0], 4);
  m.cycle();
  EXPECT_EQ(check_events(p, m.events, 3), "") << "the end item follows the alarm";
  EXPECT_EQ(m.out.state, NC_STATE_ALARM);
}

TEST(Executor, InterlockBrakesAndLetsGoOn) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 300; ++i) m.cycle();
  m.in.interlock = true;
  for (int i = 0; i < 60; ++i) m.cycle();
  EXPECT_TRUE(m.still());
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  EXPECT_EQ(m.out.cause, NC_CAUSE_INTERLOCK);
  m.in.interlock = false;
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(check_events(p, m.events, 3), "");
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, OverrideZeroStopsAndSaysSo) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 300; ++i) m.cycle();
  m.in.feed_override = 0;
  for (int i = 0; i < 60; ++i) {
    m.feed(p);
    m.cycle();
  }
  EXPECT_TRUE(m.still());
  EXPECT_EQ(m.out.cause, NC_CAUSE_OVERRIDE_ZERO);
  m.in.feed_override = 2;
  double fastest = 0;
  ASSERT_TRUE(m.until(p, [&] {
    fastest = std::max(fastest, m.out.velocity.v[0]);
    return m.out.state == NC_STATE_IDLE;
  }));
  EXPECT_NEAR(fastest, 100, 1e-6);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, ASegmentThatDoesNotStartWhereTheMachineStandsIsAnAlarmAndNoJump) {
  const ExecutorConfig c = standard_config();
  Program p(c, xyz(1));
  p.line(xyz(5), 50);
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 10; ++i) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_ALARM);
  EXPECT_EQ(m.out.command.v[0], 0);
}

TEST(Executor, SetPositionIsWhereItStarts) {
  const ExecutorConfig c = standard_config();
  Program p(c, xyz(1, 2, 3));
  p.line(xyz(5, 2, 3), 50);
  p.end();
  Machine m(c);
  m.executor.set_position(xyz(1, 2, 3));
  EXPECT_EQ(m.executor.commanded(), xyz(1, 2, 3));
  ASSERT_TRUE(m.run_to_end(p));
  EXPECT_EQ(m.executor.commanded(), xyz(5, 2, 3));
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, MessagesComeOneAtATimeWithAnEdgeEach) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  for (uint32_t id = 1; id <= 3; ++id) p.action(NC_ACTION_MESSAGE, id);
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  std::vector<uint32_t> seen;
  bool last = false;
  for (int i = 0; i < 12; ++i) {
    m.cycle();
    if (m.out.message && !last) seen.push_back(m.out.message_text);
    last = m.out.message;
  }
  EXPECT_EQ(seen, (std::vector<uint32_t>{1, 2, 3}));
}

TEST(Executor, ControlVariablesSuppressSingleBlockHoldAndOverride) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.action(NC_ACTION_CONTROL, NC_SUPPRESS_SINGLE_BLOCK, NC_CONTROL_SUPPRESS);
  p.action(NC_ACTION_CONTROL, NC_DISABLE_FEED_HOLD | NC_DISABLE_OVERRIDE, NC_CONTROL_DISABLE);
  p.line(xyz(5), 50);
  p.mark();
  p.line(xyz(10), 50);
  p.mark();
  p.action(NC_ACTION_CONTROL, 0, NC_CONTROL_SUPPRESS);
  p.action(NC_ACTION_CONTROL, 0, NC_CONTROL_DISABLE);
  p.line(xyz(15), 50);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  m.in.single_block = m.in.feed_hold = true;
  m.in.feed_override = 0.1;
  ASSERT_TRUE(m.until(
      p, [&] { return m.out.velocity.v[0] > 49; }, 100))
      << "neither hold nor override acts";
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_HOLD; }));
  EXPECT_GE(m.out.command.v[0], 10);
}

TEST(Executor, TruncateGivesUpWhatLiesBehindTheBlockInExecution) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  m.start();
  Serial last = 99;
  EXPECT_FALSE(m.executor.truncate(&last)) << "moves: asked";
  m.cycle();
  EXPECT_FALSE(m.executor.truncate(&last)) << "moves: refused";
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 12; }));
  m.in.feed_hold = true;
  for (int i = 0; i < 40; ++i) m.cycle();
  ASSERT_TRUE(m.still());
  EXPECT_FALSE(m.executor.truncate(&last));
  m.cycle();
  ASSERT_TRUE(m.executor.truncate(&last));
  EXPECT_EQ(last, 6u) << "the mark of the third line";
  m.in.feed_hold = false;
  Program rest(c, xyz(15));
  for (size_t i = 0; i < 6; ++i) rest.records.push_back(p.records[i]);
  rest.line(xyz(15, 7), 50);
  rest.mark();
  rest.end();
  m.next = 6;
  m.feed(rest);
  m.start();
  ASSERT_TRUE(m.until(rest, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[0], 15);
  EXPECT_EQ(m.out.command.v[1], 7);
  EXPECT_EQ(check_events(rest, m.events, 3), "");
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, TruncateAtABlockStopLeavesNothingAndNamesTheMarkExecutedLast) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.in.single_block = true;
  m.cycle();
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  Serial last = 99;
  EXPECT_FALSE(m.executor.truncate(&last));
  m.start();  // pressed while the feeder gives records up: it acts afterwards
  EXPECT_EQ(m.out.state, NC_STATE_STOPPED);
  ASSERT_TRUE(m.executor.truncate(&last));
  EXPECT_EQ(last, 2u);
  EXPECT_TRUE(m.executor.drained());
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_RUNNING);
  EXPECT_EQ(m.out.cause, NC_CAUSE_STARVED);
}

TEST(Executor, ATruncationThatNobodyFetchesDoesNotBlockTheMachine) {
  const ExecutorConfig c = standard_config();
  const Program p = ten_lines(c);
  Machine m(c);
  m.feed(p);
  Serial last = 0;
  EXPECT_FALSE(m.executor.truncate(&last));
  m.start();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE) << "the scan has agreed and waits";
  ASSERT_TRUE(m.until(p, [&] { return m.executor.drained() && m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(check_events(p, m.events, 3), "");
}

TEST(Executor, EventsThatNobodyFetchesAreCountedAndTheNewestStay) {
  ExecutorConfig c = standard_config();
  c.capacity = 64;
  Machine m(c);
  Program p(c);
  for (int i = 0; i < 1000; ++i) p.mark();
  p.end();
  m.feed(p);
  m.in.cycle_start = true;
  for (int i = 0; i < 1000 && m.next < p.records.size(); ++i) {
    m.executor.cycle(m.in, m.out);
    m.feed(p);
  }
  m.executor.cycle(m.in, m.out);
  nc_event e;
  uint64_t dropped = 0;
  std::vector<Serial> seen;
  while (m.executor.poll_event(&e, &dropped)) seen.push_back(e.serial);
  EXPECT_GE(seen.size(), 64u);
  EXPECT_EQ(seen.size() + dropped, 1001u);
  EXPECT_EQ(seen.back(), 1001u);
  for (size_t i = 1; i < seen.size(); ++i) EXPECT_EQ(seen[i], seen[i - 1] + 1);
}

TEST(Executor, WorkCoordinatesAndDistanceToGo) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  Segment& s = p.line(xyz(8, 4), 50);
  s.to_work = Affine::stretch(1, -1, 0);
  ASSERT_TRUE(s.to_work.then(Affine::translation(xyz(-100, 0))));
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 50; ++i) m.cycle();
  EXPECT_NEAR(m.out.work.v[0], m.out.command.v[0] - 100, 1e-12);
  EXPECT_NEAR(m.out.work.v[1], -m.out.command.v[1], 1e-12);
  EXPECT_NEAR(m.out.distance_to_go.v[0], 8 - m.out.command.v[0], 1e-12);
  EXPECT_GT(m.out.distance_to_go.v[0], 1);
  EXPECT_EQ(m.out.feed_command_mm_min, 3000);
}

}  // namespace
}  // namespace nc::test
