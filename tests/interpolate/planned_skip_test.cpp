// SPDX-License-Identifier: Apache-2.0
// Skip moves of the optimal mode and the blocks after them: wherever the signal ends a skip move, the next move must not continue the plan of its
// remaining part.
#include <gtest/gtest.h>

#include <numbers>

#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kCycle = 0.002;
constexpr double kPlace = 1e-6;  ///< mm

ExecutorConfig skip_config() {
  ExecutorConfig c = standard_config();
  c.optimal = true;
  c.cycle_s = kCycle;
  for (unsigned i = 0; i < 3; ++i) c.limits[i] = {250, 250, 2000, 50000, 0.01};
  return c;
}

AxisVec at(double x, double y, double z) {
  AxisVec p;
  p[0] = x;
  p[1] = y;
  p[2] = z;
  return p;
}

/// What the next block is; it does not move X.
enum class Behind { line, rapid, arc, thread, function, skip };
constexpr Behind kBehind[] = {Behind::line, Behind::rapid, Behind::arc, Behind::thread, Behind::function, Behind::skip};

/// To X5, then a skip move for signal 2 to X15.
Program to_the_probe(const ExecutorConfig& c) {
  Program p(c);
  p.rapid(at(5, 0, 0));
  p.mark();
  Segment& s = p.line(at(15, 0, 0), 1600 / 60.0);
  s.skip = s.exact_stop = true;
  s.skip_mask = 2;
  p.mark();
  p.sync(NC_SYNC_SKIP);
  return p;
}

/// A block from where the axes are to Z4.
Program to_the_end(const ExecutorConfig& c, Behind behind, const AxisVec& from) {
  Program p(c, from);
  const AxisVec end = at(from[0], 0, 4);
  switch (behind) {
    case Behind::line: p.line(end, 1000 / 60.0); break;
    case Behind::rapid: p.rapid(end); break;
    case Behind::arc: p.arc(1, 2, 2, -std::numbers::pi / 2, std::numbers::pi, 1000 / 60.0); break;
    case Behind::thread: {
      Segment& s = p.line(end, 0);
      s.thread = true;
      s.feed_mm_rev = 1;
      break;
    }
    case Behind::function:
      p.action(NC_ACTION_M, 3);
      p.gate(NC_GATE_FIN);
      p.line(end, 1000 / 60.0);
      break;
    case Behind::skip: {
      Segment& s = p.line(end, 1000 / 60.0);
      s.skip = s.exact_stop = true;
      s.skip_mask = 1;  // another signal: it does not come
      break;
    }
  }
  p.mark();
  p.end();
  return p;
}

/// What the operator does in the same cycle in which the signal comes.
enum class Operator { nothing, holds, sets_single_block, turns_override_off, locks };
constexpr Operator kOperator[] = {Operator::nothing, Operator::holds, Operator::sets_single_block, Operator::turns_override_off,
                                  Operator::locks};

class SkipRun {
 public:
  explicit SkipRun(unsigned period) : machine(skip_config()), period_(period) {
    machine.in.spindle[0].rev_per_s = 10;
    machine.in.spindle[0].turns_valid = true;
  }

  /// One cycle; the feeder is called every `period` cycles.
  void cycle(const Program& p) {
    if (machine.cycles % period_ == 0) machine.feed(p);
    machine.in.spindle[0].turns += machine.in.spindle[0].rev_per_s * kCycle;
    machine.cycle();
    machine.in.cycle_start = false;
  }
  void act(Operator what) {
    machine.in.feed_hold = what == Operator::holds;
    machine.in.single_block = what == Operator::sets_single_block;
    machine.in.feed_override = what == Operator::turns_override_off ? 0 : 1;
    machine.in.interlock = what == Operator::locks;
  }
  void press_start() {
    machine.executor.run_taken(machine.executor.run());
    machine.in.cycle_start = true;
  }
  bool stopped() const { return machine.out.state == NC_STATE_STOPPED || machine.out.state == NC_STATE_HOLD; }

  /// Runs to the sync after the skip move. The signal comes in the `signal`-th cycle of the program, together with `what`, which ends 40 cycles
  /// later.
  bool probe(unsigned signal, Operator what, nc_world* world) {
    const Program p = to_the_probe(machine.config);
    machine.feed(p);
    press_start();
    for (unsigned n = 0; n < 2000; ++n) {
      if (n == signal) machine.in.skip = 2, act(what);
      if (n == signal + 40) act(Operator::nothing);
      // If a hold came in the cycle of the start, nothing has begun: start again.
      if (n > signal + 40 && (stopped() || machine.out.state == NC_STATE_IDLE)) press_start();
      cycle(p);
      if (machine.out.state == NC_STATE_ALARM) return false;
      if (n > signal + 40 && machine.executor.sync_reached(p.records.back().serial, world)) return true;
    }
    return false;
  }
  /// Runs the rest of the program to its end.
  bool go_on(const Program& p, bool from_its_head = true) {
    if (from_its_head) machine.next = 0;
    for (unsigned n = 0; n < 2000; ++n) {
      if (stopped()) press_start();
      cycle(p);
      if (machine.out.state == NC_STATE_ALARM) return false;
      if (machine.out.state == NC_STATE_IDLE && machine.executor.drained()) return true;
    }
    return false;
  }

  Machine machine;

 private:
  unsigned period_;
};

/// After the skip move the axes must stand where the world says, and the next block must move only Z, to its end.
void expect_next_block(unsigned signal, Operator what, Behind behind, unsigned period) {
  SCOPED_TRACE(testing::Message() << "signal in cycle " << signal << ", operator " << static_cast<int>(what) << ", behind "
                                  << static_cast<int>(behind) << ", feeder each " << period);
  SkipRun run(period);
  nc_world world{};
  ASSERT_TRUE(run.probe(signal, what, &world)) << int{run.machine.out.state} << " " << int{run.machine.out.cause};
  const double x = run.machine.out.command.v[0];
  ASSERT_EQ(world.machine.v[0], x);
  ASSERT_LE(world.skip_machine.v[0], x);
  const Program rest = to_the_end(run.machine.config, behind, run.machine.command());
  ASSERT_TRUE(run.go_on(rest)) << int{run.machine.out.state} << " " << int{run.machine.out.cause} << " X "
                               << run.machine.out.command.v[0];
  ASSERT_NEAR(run.machine.out.command.v[0], x, kPlace);
  ASSERT_NEAR(run.machine.out.command.v[2], 4, kPlace);
  ASSERT_TRUE(run.machine.checker.ok()) << run.machine.checker.report();
}

// M700 15.2: if the signal is on when the skip move begins nothing moves, and the next block begins there.
TEST(PlannedSkip, OnFromTheStartTheNextBlockGoesItsOwnWay) {
  for (const Behind behind : kBehind)
    for (const unsigned period : {1u, 7u}) {
      expect_next_block(0, Operator::nothing, behind, period);
      SkipRun run(period);
      nc_world world{};
      ASSERT_TRUE(run.probe(0, Operator::nothing, &world));
      EXPECT_TRUE(world.skipped);
      EXPECT_EQ(world.skip_machine.v[0], 5);
      EXPECT_EQ(world.machine.v[0], 5);
    }
}

/// The signal comes in each cycle from before the beginning of the skip move to its end, alone and together with an action of the operator.
TEST(PlannedSkip, WhereverTheSignalComesTheNextBlockGoesItsOwnWay) {
  unsigned last = 0;  // cycle in which the skip move ends by itself
  {
    SkipRun run(1);
    const Program p = to_the_probe(run.machine.config);
    nc_world world{};
    run.machine.feed(p);
    run.press_start();
    while (last < 2000 && !run.machine.executor.sync_reached(p.records.back().serial, &world)) run.cycle(p), ++last;
    ASSERT_LT(last, 1000u);
    EXPECT_FALSE(world.skipped);
    EXPECT_NEAR(world.machine.v[0], 15, kPlace);
  }
  for (unsigned signal = 0; signal < last + 3; signal += sanitized() ? 5 : 1)
    for (const Operator what : kOperator)
      for (const unsigned period : {1u, 7u}) {
        expect_next_block(signal, what, signal % 2 != 0 ? Behind::line : Behind::thread, period);
        if (HasFatalFailure()) return;
      }
}

/// The same with a reset in the cycle of the signal: a program that is started after it begins where the axes are.
TEST(PlannedSkip, ResetInTheCycleOfTheSignalLeavesNothingOfThePlan) {
  for (unsigned signal = 1; signal < 300; signal += sanitized() ? 7 : 1)
    for (const unsigned period : {1u, 7u}) {
      SCOPED_TRACE(testing::Message() << "in cycle " << signal << ", feeder each " << period);
      SkipRun run(period);
      const Program p = to_the_probe(run.machine.config);
      run.machine.feed(p);
      run.press_start();
      for (unsigned n = 0; n < signal + 200; ++n) {
        if (n == signal) run.machine.in.skip = 2;
        run.machine.in.reset = n == signal;
        run.cycle(p);
      }
      ASSERT_EQ(run.machine.out.state, NC_STATE_IDLE);
      const AxisVec from = run.machine.command();
      const Program next = to_the_end(run.machine.config, Behind::line, from);
      run.machine.next = 0;
      run.machine.feed(next);
      run.press_start();
      run.cycle(next);
      ASSERT_TRUE(run.go_on(next, false)) << int{run.machine.out.state} << " " << int{run.machine.out.cause};
      ASSERT_NEAR(run.machine.out.command.v[0], from[0], kPlace);
      ASSERT_NEAR(run.machine.out.command.v[2], 4, kPlace);
      ASSERT_TRUE(run.machine.checker.ok()) << run.machine.checker.report();
    }
}

}  // namespace
}  // namespace nc::test
