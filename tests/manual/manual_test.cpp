// SPDX-License-Identifier: Apache-2.0
// Jog, step, handle and reference return in the executor: limits, soft limits, and when they may act.
#include <gtest/gtest.h>

#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

ExecutorConfig manual_config() {
  ExecutorConfig c = standard_config();
  for (unsigned i = 0; i < 3; ++i) {
    c.limits[i].rapid = 200;
    c.soft_min[i] = -100;
    c.soft_max[i] = 100;
    c.reference[i] = 10.0 * i;
  }
  c.soft_limited = 0b011;
  return c;
}

nc_manual jog(double velocity) {
  return {NC_MANUAL_JOG, velocity, 0};
}

void run(Machine& m, int cycles) {
  for (int i = 0; i < cycles; ++i) m.cycle();
}

TEST(Manual, JogRampsUpGoesAndStopsWhenLetGo) {
  Machine m(manual_config());
  m.in.manual[0] = jog(-50);
  run(m, 100);
  EXPECT_NEAR(m.out.velocity.v[0], -50, 1e-9);
  EXPECT_EQ(m.out.state, NC_STATE_MANUAL);
  m.in.manual[0] = {};
  run(m, 30);
  EXPECT_TRUE(m.still());
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Manual, AnAxisThatDoesNotKnowWhereItStandsHasNoSoftLimits) {
  Machine m(manual_config());
  m.in.unlimited = 1;
  m.in.manual[0] = jog(100);
  m.in.manual[1] = jog(100);
  run(m, 1500);
  EXPECT_GT(m.out.command.v[0], 140);
  EXPECT_EQ(m.out.command.v[1], 100) << "the others have theirs";
  m.in.unlimited = 0;  // outside, it may come in and not go further out
  m.in.manual[0] = {};
  run(m, 200);
  const double stands = m.out.command.v[0];
  m.in.manual[0] = jog(100);
  run(m, 200);
  EXPECT_EQ(m.out.command.v[0], stands);
  m.in.manual[0] = jog(-100);
  run(m, 200);
  EXPECT_LT(m.out.command.v[0], stands - 10);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Manual, JogStopsExactlyAtTheSoftLimit) {
  Machine m(manual_config());
  m.in.manual[0] = jog(1000);  // faster than the axis: goes at rapid
  double top = 0, fastest = 0;
  for (int i = 0; i < 2000; ++i) {
    m.cycle();
    top = std::max(top, m.out.command.v[0]);
    fastest = std::max(fastest, m.out.velocity.v[0]);
  }
  EXPECT_EQ(top, 100);
  EXPECT_EQ(m.out.command.v[0], 100);
  EXPECT_NEAR(fastest, 200, 1e-6);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  m.in.manual[0] = jog(-20);  // and back from it
  run(m, 100);
  EXPECT_LT(m.out.command.v[0], 99);
}

TEST(Manual, AxisOutsideItsLimitsMayOnlyComeBack) {
  Machine m(manual_config());
  AxisVec outside;
  outside[1] = 120;
  m.executor.set_position(outside);
  m.in.manual[1] = jog(20);
  run(m, 200);
  EXPECT_EQ(m.out.command.v[1], 120);
  m.in.manual[1] = jog(-20);
  run(m, 200);
  EXPECT_LT(m.out.command.v[1], 119);
}

/// The state shows every motion by hand, even one detent of a handle that an axis goes within one cycle: an axis must never move in IDLE.
TEST(Manual, EveryCycleInWhichAnAxisMovesByHandSaysSo) {
  for (const uint8_t kind : {uint8_t{NC_MANUAL_JOG}, uint8_t{NC_MANUAL_STEP}, uint8_t{NC_MANUAL_HANDLE}, uint8_t{NC_MANUAL_REFERENCE}}) {
    for (const double distance : {0.0005, 0.001, 0.02, 0.7}) {
      SCOPED_TRACE(std::to_string(kind) + " " + std::to_string(distance));
      ExecutorConfig c = manual_config();
      c.reference[0] = distance;
      Machine m(c);
      unsigned moved = 0;
      for (int n = 0; n < 400; ++n) {
        m.in.manual[0] = n % 40 < 2 ? nc_manual{kind, kind == NC_MANUAL_JOG ? distance * 500 : 0, n % 40 == 0 ? distance : 0} : nc_manual{};
        m.cycle();
        const bool moves = m.out.velocity.v[0] != 0;
        moved += moves;
        ASSERT_EQ(m.out.state, moves ? NC_STATE_MANUAL : NC_STATE_IDLE) << "in cycle " << n;
      }
      EXPECT_GT(moved, 0u);
    }
  }
}

TEST(Manual, StepGoesOncePerEdge) {
  Machine m(manual_config());
  m.in.manual[0] = {NC_MANUAL_STEP, 0, 0.1};
  run(m, 100);
  EXPECT_EQ(m.out.command.v[0], 0.1);
  m.in.manual[0] = {};
  m.cycle();
  m.in.manual[0] = {NC_MANUAL_STEP, 0, -0.3};
  m.cycle();
  m.in.manual[0] = {};
  run(m, 100);
  EXPECT_NEAR(m.out.command.v[0], -0.2, 1e-12);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Manual, HandleFollowsTheSumOfItsPulses) {
  Machine m(manual_config());
  std::mt19937_64 rng(3);
  double sum = 0;
  for (int i = 0; i < 3000; ++i) {
    const double d = 0.001 * (static_cast<double>(rng() % 41) - 20);
    m.in.manual[1] = {NC_MANUAL_HANDLE, 0, d};
    sum += d;
    m.cycle();
  }
  m.in.manual[1] = {};
  run(m, 200);
  EXPECT_NEAR(m.out.command.v[1], sum, 1e-9);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Manual, HandleTurnedTooFastIsLimitedAndStopsSoon) {
  Machine m(manual_config());
  m.in.manual[2] = {NC_MANUAL_HANDLE, 0, 5};  // 5 m/s
  run(m, 1000);
  EXPECT_EQ(m.out.handle_dropped, 1u << 2);
  m.in.manual[2] = {};
  run(m, 500 + 100 + 1);  // half a second, and the ramp of 200 mm/s at 2000 mm/s2
  EXPECT_TRUE(m.still());
  EXPECT_LE(m.checker.worst_velocity, 1.001);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

/// The distance of a handwheel is moved completely if the axis can do it soon; a part that is dropped is reported in that cycle.
TEST(Manual, AHandleLosesNothingWithoutAWord) {
  for (const double distance : {0.001, 9.375, 50.0, 110.0, 110.1, 4000.0}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(sign * distance);
      Machine m(manual_config());
      m.in.manual[2] = {NC_MANUAL_HANDLE, 0, sign * distance};
      m.cycle();
      const bool dropped = m.out.handle_dropped != 0;
      EXPECT_EQ(dropped, distance > 0.5 * 200 + 0.5 * 200 * 200 / 2000) << "nc/run.h";
      m.in.manual[2] = {};
      run(m, 500 + 150 + 1);
      EXPECT_EQ(m.out.handle_dropped, 0u);
      EXPECT_TRUE(m.still());
      EXPECT_NEAR(m.out.command.v[2], sign * std::min(distance, 110.0), 1e-9);
      EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    }
  }
}

TEST(Manual, AHandleSaysWhatASoftLimitAHoldAndAJogTakeFromIt) {
  Machine m(manual_config());
  const auto pulse = [&m](double distance) {
    m.in.manual[0] = {NC_MANUAL_HANDLE, 0, distance};
    m.cycle();
    m.in.manual[0] = {};
    return m.out.handle_dropped != 0;
  };
  EXPECT_FALSE(pulse(99));
  run(m, 1000);
  EXPECT_TRUE(pulse(2)) << "1 mm of it lies beyond the limit";
  run(m, 100);
  EXPECT_EQ(m.out.command.v[0], 100);
  EXPECT_FALSE(pulse(-30));
  m.in.feed_hold = true;
  m.cycle();
  EXPECT_NE(m.out.handle_dropped, 0u) << "the way that is left";
  m.cycle();
  EXPECT_EQ(m.out.handle_dropped, 0u) << "once";
  EXPECT_TRUE(pulse(1));
  run(m, 200);
  m.in.feed_hold = false;
  const double there = m.out.command.v[0];
  run(m, 200);
  EXPECT_EQ(m.out.command.v[0], there);
  EXPECT_FALSE(pulse(-5));
  m.in.manual[0] = jog(-10);
  m.cycle();
  EXPECT_NE(m.out.handle_dropped, 0u);
}

/// A reason that refuses manual motion, and stops it.
struct Refusal {
  const char* name;
  void (*set)(Machine& m, bool on);
};
const Refusal kRefusals[] = {
    {"feed hold", [](Machine& m, bool on) { m.in.feed_hold = on; }},
    {"interlock", [](Machine& m, bool on) { m.in.interlock = on; }},
    {"reset", [](Machine& m, bool on) { m.in.reset = on; }},
    {"alarm and its reset", [](Machine& m, bool on) {
       m.in.alarm = on;
       if (on) return;
       m.in.reset = true;
       run(m, 3);
       m.in.reset = false;
     }}};

/// A button that was pressed in a hold, or whose axis was stopped by one, does nothing when the hold ends: it must be released first.
TEST(Manual, NothingBeginsByItselfWhenWhatRefusedOrStoppedItEnds) {
  for (const Refusal& refusal : kRefusals) {
    for (const uint8_t kind : {uint8_t{NC_MANUAL_JOG}, uint8_t{NC_MANUAL_STEP}, uint8_t{NC_MANUAL_HANDLE}, uint8_t{NC_MANUAL_REFERENCE}}) {
      for (const bool moves : {false, true}) {
        SCOPED_TRACE(std::string(refusal.name) + ", kind " + std::to_string(kind) + (moves ? ", on its way" : ""));
        Machine m(manual_config());
        const nc_manual wish{kind, kind == NC_MANUAL_JOG ? 50.0 : 0.0, 8};
        const nc_manual level = kind == NC_MANUAL_HANDLE ? nc_manual{} : wish;  // each pulse of a wheel is a new command
        if (moves) {
          m.in.manual[1] = wish;
          m.cycle();
          m.in.manual[1] = level;
          run(m, 10);
          ASSERT_NE(m.out.velocity.v[1], 0);
        }
        refusal.set(m, true);
        m.in.manual[1] = wish;
        run(m, 3);
        m.in.manual[1] = level;
        run(m, 200);
        ASSERT_TRUE(m.still());
        const double there = m.out.command.v[1];
        refusal.set(m, false);
        run(m, 200);
        EXPECT_EQ(m.out.command.v[1], there);
        // A detent of the wheel is no release of the button, either.
        m.in.manual[1] = {NC_MANUAL_HANDLE, 0, 0};
        m.cycle();
        m.in.manual[1] = level;
        run(m, 200);
        EXPECT_EQ(m.out.command.v[1], there);
        m.in.manual[1] = {};
        run(m, 2);
        m.in.manual[1] = wish;
        m.cycle();
        m.in.manual[1] = level;
        run(m, 100);
        EXPECT_NE(m.out.command.v[1], there) << "a new press";
        EXPECT_TRUE(m.checker.ok()) << m.checker.report();
      }
    }
  }
}

/// A refused jog that changes its direction is still the same press, since the button is still on.
TEST(Manual, ARefusedJogThatTurnsRoundWaitsAsWell) {
  Machine m(manual_config());
  m.in.feed_hold = true;
  m.in.manual[0] = jog(20);
  run(m, 5);
  m.in.feed_hold = false;
  m.in.manual[0] = jog(-20);
  run(m, 100);
  EXPECT_EQ(m.out.command.v[0], 0);
  m.in.manual[0] = jog(0);
  m.cycle();
  m.in.manual[0] = jog(-20);
  run(m, 100);
  EXPECT_LT(m.out.command.v[0], -1);
}

/// A refusal of one axis does not affect the others.
TEST(Manual, ARefusalIsOfItsAxis) {
  Machine m(manual_config());
  m.in.interlock = true;
  m.in.manual[0] = jog(20);
  run(m, 5);
  m.in.interlock = false;
  m.in.manual[1] = jog(20);
  run(m, 100);
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_GT(m.out.command.v[1], 1);
}

TEST(Manual, ReferenceReturn) {
  Machine m(manual_config());
  for (unsigned i = 0; i < 3; ++i) m.in.manual[i] = {NC_MANUAL_REFERENCE, 0, 0};
  run(m, 1000);
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(m.out.command.v[i], 10.0 * i);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Manual, RandomOrdersKeepTheLimits) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 rng(seed);
    const ExecutorConfig c = manual_config();
    Machine m(c);
    for (int i = 0; i < 5000; ++i) {
      for (unsigned a = 0; a < 3; ++a) {
        if (rng() % 40) continue;
        nc_manual& w = m.in.manual[a];
        w.kind = static_cast<uint8_t>(rng() % 5);
        w.velocity = static_cast<double>(rng() % 601) - 300;
        w.distance = (static_cast<double>(rng() % 2001) - 1000) * (w.kind == NC_MANUAL_HANDLE ? 1e-4 : 1e-2);
      }
      if (rng() % 200 == 0) m.in.interlock = !m.in.interlock;
      if (rng() % 300 == 0) m.in.reset = !m.in.reset;
      m.cycle();
      for (unsigned a = 0; a < 2; ++a) {
        ASSERT_LE(m.out.command.v[a], 100);
        ASSERT_GE(m.out.command.v[a], -100);
      }
    }
    ASSERT_TRUE(m.checker.ok()) << "seed " << seed << ": " << m.checker.report();
  }
}

TEST(Manual, DoesNothingWhileAProgramRunsAndActsInABlockStop) {
  const ExecutorConfig c = manual_config();
  Program p(c);
  AxisVec a;
  a[0] = 20;
  p.line(a, 50);
  p.mark();
  p.gate(NC_GATE_STOP);
  p.mark();
  a[0] = 40;
  p.line(a, 50);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  m.in.manual[1] = jog(50);
  ASSERT_TRUE(m.until(p, [&] { return m.out.cause == NC_CAUSE_PROGRAM_STOP; }));
  run(m, 100);
  EXPECT_TRUE(m.out.manual_allowed);
  EXPECT_EQ(m.out.command.v[1], 0) << "a button that was pressed beside the program does not set it off at the stop";
  m.in.manual[1] = {};
  m.cycle();
  m.in.manual[1] = jog(50);
  run(m, 100);
  EXPECT_EQ(m.out.state, NC_STATE_MANUAL);
  EXPECT_GT(m.out.command.v[1], 3);
  m.start();  // refused while an axis moves
  EXPECT_EQ(m.out.state, NC_STATE_MANUAL);
  m.in.manual[1] = {};
  run(m, 50);
  EXPECT_EQ(m.out.state, NC_STATE_STOPPED);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  // The machine has left the path, so that the rest of the plan would begin with a jump. The start waits until the following
  // blocks have been read again, and no axis is moved by hand meanwhile.
  EXPECT_FALSE(m.executor.reread_asked());
  m.start();
  m.in.manual[0] = jog(50);
  run(m, 5);
  EXPECT_EQ(m.out.state, NC_STATE_STOPPED);
  EXPECT_TRUE(m.still());
  EXPECT_FALSE(m.out.manual_allowed);
  ASSERT_TRUE(m.executor.reread_asked());
  EXPECT_EQ(m.executor.give_up_ahead(), 4u) << "the mark of the block that stopped";
  const AxisVec here = m.executor.commanded();
  Program rest(c, here);
  for (size_t i = 0; i < 4; ++i) rest.records.push_back(p.records[i]);
  a[1] = here[1];
  rest.line(a, 50);
  rest.mark();
  rest.end();
  m.next = 4;
  m.executor.reread_done();
  m.in.manual[0] = {};
  ASSERT_TRUE(m.until(rest, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[0], 40);
  EXPECT_EQ(m.out.command.v[1], here[1]);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

// In the middle of a block the rest of its path begins where the axes stand, so they cannot be moved by hand.
TEST(Manual, InTheMiddleOfABlockNothingMoves) {
  const ExecutorConfig c = manual_config();
  Program p(c);
  AxisVec a;
  a[0] = 20;
  p.line(a, 50);
  p.gate(NC_GATE_STOP);
  a[0] = 40;
  p.line(a, 50);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  m.in.manual[1] = jog(50);
  ASSERT_TRUE(m.until(p, [&] { return m.out.cause == NC_CAUSE_PROGRAM_STOP; }));
  run(m, 100);
  EXPECT_FALSE(m.out.manual_allowed);
  EXPECT_EQ(m.out.command.v[1], 0);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[0], 40);
}

TEST(Manual, WithTheDrivesOffTheCommandFollowsWhatIsMeasured) {
  const ExecutorConfig c = manual_config();
  Machine m(c);
  m.cycle();
  m.in.actual_valid = true;
  m.in.actual.v[0] = 7;
  m.cycle();
  EXPECT_EQ(m.out.command.v[0], 0);
  m.in.follow_up = true;
  m.cycle();
  EXPECT_EQ(m.out.command.v[0], 7);
  EXPECT_EQ(m.executor.commanded()[0], 7);
  EXPECT_TRUE(m.out.distance_zero) << "nothing is commanded to move";
  m.in.actual_valid = false;
  m.in.actual.v[0] = 9;
  m.cycle();
  EXPECT_EQ(m.out.command.v[0], 7);
  m.in.actual_valid = true;
  m.in.alarm = true;
  m.cycle();
  EXPECT_EQ(m.out.command.v[0], 9) << "also in an alarm";
}

// ---- rotary axes that count on over their turns (M700 14.13) -------------------------------------------------------------------

ExecutorConfig turning_config() {
  ExecutorConfig c = manual_config();
  c.rotary = 1u;
  c.soft_min[0] = 0;
  c.soft_max[0] = 350;
  c.reference[0] = 30;
  return c;
}

AxisParameters turning(bool short_cut) {
  AxisParameters p;
  p.turning = 1;
  p.short_cut = short_cut ? 1u : 0u;
  return p;
}

AxisVec first(double x) {
  AxisVec a;
  a[0] = x;
  return a;
}

TEST(ManualTurning, TheLimitsHoldInTheTurnInWhichTheAxisStands) {
  Machine m(turning_config());
  m.executor.set_axis_parameters(turning(false));
  m.executor.set_position(first(720 + 300));
  m.in.manual[0] = jog(200);
  run(m, 3000);
  EXPECT_EQ(m.out.command.v[0], 720 + 350);
  m.in.manual[0] = jog(-200);
  run(m, 4000);
  EXPECT_EQ(m.out.command.v[0], 720);
  EXPECT_EQ(m.out.turning, 1u);
  Machine linear(turning_config());  // a rotary axis of type 3 has its limits only once
  linear.executor.set_position(first(720 + 300));
  linear.in.manual[0] = jog(200);
  run(linear, 1000);
  EXPECT_EQ(linear.out.command.v[0], 720 + 300);
}

TEST(ManualTurning, ReferenceReturnDoesNotWindItBack) {
  for (const bool short_cut : {false, true}) {
    Machine m(turning_config());
    m.executor.set_axis_parameters(turning(short_cut));
    m.executor.set_position(first(720 + 340));
    m.in.manual[0] = {NC_MANUAL_REFERENCE, 0, 0};
    run(m, 4000);
    EXPECT_EQ(m.out.command.v[0], 720 + 30) << "by the difference of the coordinates: the shorter way leads over the limit";
    EXPECT_EQ(m.out.at_reference & 1u, 1u);
  }
}

TEST(ManualTurning, TheShorterWayToTheReferencePosition) {
  ExecutorConfig c = turning_config();
  c.soft_limited = 0;
  for (const bool short_cut : {false, true}) {
    Machine m(c);
    m.executor.set_axis_parameters(turning(short_cut));
    m.executor.set_position(first(720 + 340));
    m.in.manual[0] = {NC_MANUAL_REFERENCE, 0, 0};
    run(m, 4000);
    EXPECT_EQ(m.out.command.v[0], short_cut ? 1080 + 30 : 720 + 30);
    EXPECT_EQ(m.out.at_reference & 1u, 1u);
    EXPECT_TRUE(m.still());
  }
}

/// A jog is pressed again and again while a block stop comes, or a program ends. The path comes to rest within a cycle, and the axes rest in the
/// remainder of that cycle: an axis that brakes and begins to move by hand in the same cycle would use its acceleration twice.
TEST(Manual, AJogBeginsACycleBehindTheStopAtTheEarliest) {
  for (const bool optimal : {false, true}) {
    for (const bool stops : {false, true}) {
      for (unsigned n = 0; n < 40; ++n) {
        SCOPED_TRACE(std::string(optimal ? "optimal " : "trapezoid ") + (stops ? "block stop " : "end ") + std::to_string(n));
        ExecutorConfig config = manual_config();
        config.optimal = optimal;
        if (optimal)
          for (unsigned i = 0; i < 3; ++i) config.limits[i].jerk = 200000;
        Machine m(config);
        Program p(config);
        AxisVec to;
        to[0] = 3 + 0.0037 * n;
        p.line(to, 100);
        p.mark();
        if (stops) {
          to[0] = 20;
          p.line(to, 100);
          p.mark();
        }
        p.end();
        m.in.single_block = stops;
        m.feed(p);
        m.start();
        const double end = 3 + 0.0037 * n;
        unsigned moved = 0, allowed = 0;
        for (unsigned k = 1; k < 300 && m.out.state != NC_STATE_MANUAL; ++k) {
          const double before = m.out.command.v[0];
          // Pressed in each second cycle, in those of even or of odd number; held once it acts.
          const bool pressed = m.out.manual_allowed || k % 2 == n / 2 % 2;
          m.in.manual[0] = pressed ? jog(n % 2 == 0 ? -200 : 200) : nc_manual{};
          m.in.manual[1] = pressed ? jog(50) : nc_manual{};
          m.feed(p);
          m.cycle();
          if (allowed == 0 && !m.out.manual_allowed && m.out.command.v[0] != before) moved = k;
          if (allowed == 0 && m.out.manual_allowed) allowed = k;
          if (m.out.state == NC_STATE_MANUAL) {
            EXPECT_NEAR(before, end, 1e-12);
          } else {
            EXPECT_EQ(m.out.command.v[1], 0);
          }
        }
        ASSERT_EQ(m.out.state, NC_STATE_MANUAL);
        EXPECT_GT(moved, 0u);
        EXPECT_EQ(allowed, moved + 1);
        run(m, 50);
        EXPECT_LE(m.checker.worst_acceleration, 1.001) << m.checker.report();
      }
    }
  }
}

}  // namespace
}  // namespace nc::test
