// SPDX-License-Identifier: Apache-2.0
// Skip moves in the executor: where they stop, what they report, and what their signals change.
#include <gtest/gtest.h>

#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

Program skip_program(const ExecutorConfig& c) {
  Program p(c);
  Segment& s = p.line(AxisVec{{0, 0, -20}}, 10);
  s.skip = true;
  s.skip_mask = 2;
  p.mark();
  p.sync(NC_SYNC_SKIP);
  return p;
}

TEST(Executor, SkipDeceleratesAndReportsWhereTheSignalCame) {
  const ExecutorConfig c = standard_config();
  const Program p = skip_program(c);
  Machine m(c);
  m.feed(p);
  m.in.feed_override = 0.3;  // a skip move goes at 100 %
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= -5; }));
  EXPECT_NEAR(m.out.velocity.v[2], -10, 1e-6);
  const double at = m.out.command.v[2];
  m.in.skip = 1;  // another signal
  m.cycle();
  EXPECT_LT(m.out.command.v[2], at);
  const double z = m.out.command.v[2];
  m.in.skip = 2;
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }));
  EXPECT_TRUE(w.skipped);
  EXPECT_EQ(w.skip_machine.v[2], z);
  EXPECT_NEAR(w.machine.v[2], z - 10.0 * 10 / (2 * 2000), 0.011) << "stopping distance";
  EXPECT_EQ(w.machine.v[2], m.out.command.v[2]);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, SkipUsesTheMeasuredPosition) {
  const ExecutorConfig c = standard_config();
  const Program p = skip_program(c);
  Machine m(c);
  m.in.actual_valid = true;
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= -5; }));
  m.in.actual = m.out.command;
  m.in.actual.v[2] += 0.123;
  m.in.skip = 2;
  m.cycle();
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] {
    m.in.actual = m.out.command;
    return m.executor.sync_reached(3, &w);
  }));
  EXPECT_NEAR(w.skip_machine.v[2], -5 + 0.123, 0.011);
}

/// A drive has latched the place with its touch probe input, which is neither the measured place of this cycle nor the commanded one.
TEST(Executor, SkipUsesThePlaceThatWasLatchedForItsSignal) {
  for (const uint32_t latched : {2u, 1u}) {
    const ExecutorConfig c = standard_config();
    const Program p = skip_program(c);
    Machine m(c);
    m.in.actual_valid = true;
    m.feed(p);
    m.start();
    const auto go = [&] {
      m.in.actual = m.out.command;
      return m.out.command.v[2] <= -5;
    };
    ASSERT_TRUE(m.until(p, go));
    const double measured = m.in.actual.v[2];
    m.in.skip_place.v[2] = -4.87;
    m.in.skip_latched = latched;
    m.in.skip = 3;
    m.cycle();
    EXPECT_EQ(m.out.inputs_refused, 0u);
    m.in.skip_place.v[2] = -1;  // a later edge
    nc_world w{};
    ASSERT_TRUE(m.until(p, [&] {
      m.in.actual = m.out.command;
      return m.executor.sync_reached(3, &w);
    }));
    EXPECT_EQ(w.skip_machine.v[2], latched == 2 ? -4.87 : measured);
  }
}

/// A place that was latched before the move is none of this move.
TEST(Executor, APlaceThatWasLatchedBeforeTheSkipMoveDoesNotCount) {
  const ExecutorConfig c = standard_config();
  const Program p = skip_program(c);
  Machine m(c);
  m.feed(p);
  m.in.skip = m.in.skip_latched = 2;
  m.in.skip_place.v[2] = -4;
  m.start();
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }, 10));
  EXPECT_TRUE(w.skipped);
  EXPECT_EQ(w.skip_machine.v[2], 0);
}

TEST(Executor, SkipSignalOnAtTheStartMeansNoMove) {
  const ExecutorConfig c = standard_config();
  const Program p = skip_program(c);
  Machine m(c);
  m.feed(p);
  m.in.skip = 2;
  m.start();
  nc_world w{};
  ASSERT_TRUE(m.until(
      p, [&] { return m.executor.sync_reached(3, &w); }, 10));
  EXPECT_TRUE(w.skipped);
  EXPECT_EQ(w.skip_machine.v[2], 0);
  EXPECT_EQ(w.machine.v[2], 0);
}

TEST(Executor, SkipWithoutSignalEndsAtItsEnd) {
  const ExecutorConfig c = standard_config();
  const Program p = skip_program(c);
  Machine m(c);
  m.feed(p);
  m.start();
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }));
  EXPECT_FALSE(w.skipped);
  EXPECT_EQ(w.machine.v[2], -20);
  EXPECT_EQ(w.skip_machine.v[2], -20);
}

// M700 15.5 (9), (11): a signal sets its feed at its rising edge, of two signals the smaller feed counts, and the stop signal always stops.
TEST(Executor, SkipSignalsChangeTheFeed) {
  const ExecutorConfig c = standard_config();
  SkipSpeeds speeds;
  speeds.mask = 0xe;
  speeds.feed_mm_min[1] = 120;
  speeds.feed_mm_min[2] = 240;
  speeds.feed_mm_min[3] = 360;
  Program p(c);
  Segment& s = p.line(AxisVec{{0, 0, -20}}, 10);
  s.skip = true;
  s.skip_mask = 1;
  s.skip_speeds = &speeds;
  s.start_feed_mm_s = 10;
  p.mark();
  p.sync(NC_SYNC_SKIP);
  Machine m(c);
  m.feed(p);
  m.start();
  const auto speed_at = [&](double z, uint32_t signals) {
    EXPECT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= z; }));
    m.in.skip = signals;
    for (unsigned i = 0; i < 20; ++i) m.cycle();
    return -m.out.velocity.v[2];
  };
  EXPECT_NEAR(speed_at(-2, 0), 10, 1e-6);
  EXPECT_NEAR(speed_at(-4, 8), 6, 1e-6);
  EXPECT_NEAR(speed_at(-5, 8 + 4 + 2), 2, 1e-6);  // both rise at once
  EXPECT_NEAR(speed_at(-6, 8), 2, 1e-6);          // nothing rises
  EXPECT_NEAR(speed_at(-6.5, 8 + 4), 4, 1e-6);
  EXPECT_NEAR(speed_at(-7, 8 + 4 + 16), 4, 1e-6);  // no feed is given for signal 5
  m.in.skip = 8 + 4 + 1;
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }));
  EXPECT_TRUE(w.skipped);
  EXPECT_GT(w.skip_machine.v[2], -8);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Executor, ASkipSignalEndsADwell) {  // M700 15.3 (2)
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.gate(NC_GATE_DWELL_SECONDS, 1000);
  p.records.back().gate.skip_mask = 2;
  p.line(AxisVec{{1, 0, 0}}, 10);
  Machine m(c);
  m.feed(p);
  m.start();
  for (unsigned i = 0; i < 100; ++i) m.cycle();
  m.in.skip = 1;
  for (unsigned i = 0; i < 100; ++i) m.cycle();
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_EQ(m.out.cause, NC_CAUSE_DWELL);
  m.in.skip = 2;
  EXPECT_TRUE(m.until(p, [&] { return m.out.command.v[0] == 1; }));
}

}  // namespace
}  // namespace nc::test
