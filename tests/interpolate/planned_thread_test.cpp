// SPDX-License-Identifier: Apache-2.0
// Threads in the optimal mode (M700 6.7.1): the place on the path follows the angle of the spindle from the start to the end of the cut, and
// velocity, acceleration and jerk of every axis keep their limits while the spindle is uneven, stops or is interlocked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "interpolate/spindle_sync.hpp"
#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

ExecutorConfig thread_config() {
  ExecutorConfig c = standard_config();
  c.optimal = true;
  for (unsigned i = 0; i < 3; ++i) c.limits[i] = {250, 250, 2000, 50000, 0.01};
  return c;
}

AxisVec place(double x, double z) {
  AxisVec p;
  p[0] = x;
  p[2] = z;
  return p;
}

Segment& thread(Program* p, const AxisVec& end, double lead, float angle = 0) {
  Segment& s = p->line(end, 0);
  s.thread = true;
  s.feed_mm_rev = lead;
  s.thread_angle = angle;
  p->mark();
  return s;
}

/// Turns the spindle on by one cycle.
void turn(Machine& m, double rev_per_s) {
  nc_spindle_inputs& s = m.in.spindle[0];
  s.turns_valid = true;
  s.turns += s.rev_per_s * m.config.cycle_s;
  s.rev_per_s = rev_per_s;
}

double fraction(double x) {
  return x - std::floor(x);
}

/// The place of the thread on the spindle when Z has reached `depth`, as a part of a turn.
double phase_at(double rev_per_s, double first_turns, float angle, double depth) {
  const ExecutorConfig c = thread_config();
  Program p(c);
  thread(&p, place(0, -20), 2, angle);
  p.end();
  Machine m(c);
  m.in.spindle[0].rev_per_s = rev_per_s;
  m.in.spindle[0].turns = first_turns;
  m.feed(p);
  m.start();
  double last = 0;
  for (int i = 0; i < 20000; ++i) {
    turn(m, rev_per_s);
    last = m.out.command.v[2];
    m.feed(p);
    m.cycle();
    if (m.out.command.v[2] <= -depth) break;
  }
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  // Between the two cycles, where the depth was passed.
  const double share = (-depth - last) / (m.out.command.v[2] - last);
  const double turns = m.in.spindle[0].turns + share * rev_per_s * c.cycle_s;
  return fraction(turns * (rev_per_s > 0 ? 1 : -1));
}

TEST(PlannedThread, EveryPassLiesInTheSameGroove) {
  for (const double depth : {0.1, 10.0, 19.8}) {  // speeding up, at speed, braking
    const double first = phase_at(8, 0.123, 0, depth);
    const double most = depth == 10 ? 1e-5 : 1e-3;  // between two cycles the speed changes
    for (const double turns : {0.0, 0.5, 3.999, -7.3}) EXPECT_NEAR(phase_at(8, turns, 0, depth), first, most) << turns;
    const double second = phase_at(8, 0.4, 120, depth);
    EXPECT_NEAR(fraction(second - first), 1.0 / 3, most);
  }
  EXPECT_NEAR(phase_at(-8, 0.7, 0, 10), phase_at(-8, 0.1, 0, 10), 1e-5);
}

TEST(PlannedThread, ItsLeadIsExact) {
  const double at5 = phase_at(8, 0, 0, 5), at15 = phase_at(8, 0, 0, 15);
  EXPECT_NEAR(at5, at15, 1e-7);  // five revolutions
  EXPECT_NEAR(fraction(phase_at(8, 0, 0, 8.5) - at5), 0.75, 1e-7);
}

TEST(PlannedThread, KeepsItsPlaceWhenTheSpindleIsUneven) {
  const ExecutorConfig c = thread_config();
  Program p(c);
  thread(&p, place(0, -40), 2);
  p.end();
  Machine m(c);
  m.in.spindle[0].rev_per_s = 8;
  m.feed(p);
  m.start();
  double low = 1e9, high = -1e9;
  for (int i = 0; i < 20000 && m.out.command.v[2] > -36; ++i) {
    turn(m, 8 * (1 + 0.1 * std::sin(i * 0.01)));
    nc_spindle_inputs& s = m.in.spindle[0];
    s.rev_per_s *= 1.01;  // the speed is measured one per cent wrong
    m.feed(p);
    m.cycle();
    s.rev_per_s /= 1.01;
    if (m.out.command.v[2] > -6) continue;
    const double where = 2 * (s.turns + s.rev_per_s * c.cycle_s) + m.out.command.v[2];
    low = std::min(low, where), high = std::max(high, where);
  }
  EXPECT_LE(m.out.command.v[2], -36);
  EXPECT_LT(high - low, 0.01);  // mm over 15 turns
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(PlannedThread, IsNotHeldNorChangedByTheOverride) {
  const ExecutorConfig c = thread_config();
  Program p(c);
  thread(&p, place(0, -20), 2);
  p.line(place(5, -20), 50);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  for (int i = 0; i < 50; ++i) turn(m, 0), m.feed(p), m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_STOPPED);
  for (int i = 0; i < 300; ++i) turn(m, 4 * std::min(1.0, i * 0.005)), m.feed(p), m.cycle();  // the spindle comes to speed meanwhile
  while (m.out.command.v[2] == 0) turn(m, 4), m.feed(p), m.cycle();
  double from = 0;
  for (int i = 0; i < 3000 && m.out.command.v[2] > -15; ++i) {
    turn(m, 4);
    m.in.feed_hold = i > 200;
    m.in.feed_override = i % 100 < 50 ? 0.1 : 2;
    m.feed(p);
    m.cycle();
    if (i == 400) from = m.in.spindle[0].turns * 2 + m.out.command.v[2];
    if (i > 400) {
      ASSERT_NEAR(m.in.spindle[0].turns * 2 + m.out.command.v[2], from, 1e-4) << i;
    }
  }
  EXPECT_LE(m.out.command.v[2], -15);
  m.in.feed_override = 1;
  for (int i = 0; i < 3000; ++i) turn(m, 4), m.feed(p), m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_STOPPED);  // M700 6.7.1: after the first block that is no thread
  EXPECT_EQ(m.out.cause, NC_CAUSE_FEED_HOLD);
  EXPECT_EQ(m.command(), place(5, -20));
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

// The speed of the spindle is measured, but not its angle: the thread begins anywhere, and is cut to its end.
TEST(PlannedThread, FollowsASpeedWithoutAnAngle) {
  const ExecutorConfig c = thread_config();
  for (const double speed : {8.0, -8.0, 60.0}) {
    Program p(c);
    thread(&p, place(0, -20), 2);
    p.line(place(5, -20), 50);
    p.mark();
    p.end();
    Machine m(c);
    m.in.spindle[0].rev_per_s = speed;
    m.feed(p);
    m.start();
    double fastest = 0;
    for (int i = 0; i < 6000; ++i) {
      m.in.spindle[0].rev_per_s = speed * (1 + 0.02 * std::sin(0.01 * i));
      m.feed(p), m.cycle();
      fastest = std::max(fastest, std::fabs(m.out.velocity.v[2]));
    }
    EXPECT_EQ(m.command(), place(5, -20)) << speed;
    EXPECT_NEAR(fastest, 2 * std::fabs(speed), 0.06 * std::fabs(speed));
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  }
}

TEST(PlannedThread, DoesNotBeginBeyondTheLargestFeed) {
  const ExecutorConfig c = thread_config();
  Program p(c);
  thread(&p, place(0, -20), 2);
  p.end();
  Machine m(c);
  m.in.spindle[0].rev_per_s = 110;  // 220 mm/s; 250 / 1.15 = 217.4 can be kept
  m.feed(p);
  m.start();
  for (int i = 0; i < 200; ++i) turn(m, 110), m.feed(p), m.cycle();
  EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_FAST);
  EXPECT_EQ(m.out.command.v[2], 0);
}

TEST(PlannedThread, WaitsForASpindleThatTurnsTheWrongWay) {
  const ExecutorConfig c = thread_config();
  for (const SpindleTurn way : {SpindleTurn::forward, SpindleTurn::reverse}) {
    const double right = way == SpindleTurn::forward ? 8 : -8;
    Program p(c);
    p.action(NC_ACTION_M, 3);
    p.records.back().action.turn = way;
    p.gate(NC_GATE_FIN);
    thread(&p, place(0, -20), 2);
    p.end();
    Machine m(c);
    m.answer_fin = true;
    m.feed(p);
    m.start();
    for (int i = 0; i < 300; ++i) turn(m, -right), m.feed(p), m.cycle();
    EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_REVERSED);
    EXPECT_EQ(m.out.command.v[2], 0);
    m.in.spindle[0].rev_per_s = right;
    for (int i = 0; i < 4000; ++i) turn(m, right), m.feed(p), m.cycle();
    EXPECT_EQ(m.command(), place(0, -20));
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  }
}

TEST(PlannedThread, AnInterlockStopsItAtOnceAndWithinTheLimits) {
  const ExecutorConfig c = thread_config();
  Program p(c);
  thread(&p, place(0, -40), 2);
  p.end();
  for (const int begin : {150, 400, 900}) {
    Machine m(c);
    m.in.spindle[0].rev_per_s = 20;
    m.feed(p);
    m.start();
    size_t n = p.records.size();
    int stood = -1;
    for (int i = 0; i < begin + 1200; ++i) {
      turn(m, 20 * (1 + 0.02 * std::sin(0.03 * i)));
      m.in.interlock = i >= begin && i < begin + 600;
      const double z = m.out.command.v[2];
      m.feed(p);
      m.cycle();
      if (i >= begin && stood < 0 && m.out.command.v[2] == z) stood = i - begin;
    }
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    EXPECT_LT(stood, 200) << begin;
    EXPECT_GE(stood, 0);
    m.in.interlock = false;
    for (int i = 0; i < 4000; ++i) turn(m, 20), m.feed(p), m.cycle();
    EXPECT_EQ(m.command(), place(0, -40));
    EXPECT_EQ(m.next, n);
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  }
}

// With a fine lead and fast axes a stop takes less than a cycle.
TEST(PlannedThread, WhateverStopsItStopsAFineOneToo) {
  ExecutorConfig c = thread_config();
  for (const double jerk : {2e5, 6e7}) {
    for (unsigned i = 0; i < 3; ++i) c.limits[i] = {250, 250, jerk == 2e5 ? 2000.0 : 20000.0, jerk, 0.01};
    for (const double lead : {0.01, 0.02, 0.1, 0.5}) {
      for (bool nc_inputs::*const stops : {&nc_inputs::interlock, &nc_inputs::reset, &nc_inputs::alarm}) {
        Program p(c);
        thread(&p, place(0, -40), lead);
        p.end();
        Machine m(c);
        m.in.spindle[0].rev_per_s = 2;
        m.feed(p);
        m.start();
        double last = 0;
        for (int i = 0; i < 1100; ++i) {
          turn(m, 2);
          m.in.*stops = i >= 1000;
          m.feed(p);
          last = m.out.command.v[2];
          m.cycle();
        }
        EXPECT_LT(last, 0);
        EXPECT_EQ(m.out.command.v[2], last) << "lead " << lead << " jerk " << jerk;
        EXPECT_TRUE(m.checker.ok()) << m.checker.report();
      }
    }
  }
}

/// Chains of threads with tapers and different leads, spindles that speed up, slow down and stop, resets in between.
TEST(PlannedThread, RandomThreadsKeepTheLimits) {
  for (unsigned seed = 1; seed <= seeds(60, 12); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
    const ExecutorConfig c = thread_config();
    Program p(c);
    AxisVec to;
    for (unsigned n = 0, count = 1 + random() % 4; n < count; ++n) {
      to[2] -= number(0.5, 30);
      if (random() % 2 != 0) to[0] += number(-3, 3);
      thread(&p, to, number(0.2, 6), static_cast<float>(number(0, 360)));
      if (random() % 3 == 0) p.rapid(to = place(number(-5, 5), number(-5, 5)));
    }
    p.end();
    Machine m(c);
    const double speed = number(0.5, 20) * (random() % 2 != 0 ? 1 : -1), wave = number(0, 0.4), pace = number(0.001, 0.02);
    const bool stops = random() % 4 == 0, reset = random() % 3 == 0;
    m.in.spindle[0].rev_per_s = speed;
    m.feed(p);
    m.start();
    const int event = static_cast<int>(number(200, 2000));
    bool done = false;
    for (int i = 0; i < 60000 && !done; ++i) {
      double rev = speed * (1 + wave * std::sin(pace * i));
      if (stops && i > event && i < event + 1500) rev *= std::max(0.0, i < event + 750 ? 1 - 0.004 * (i - event) : 0.004 * (i - event - 1250));
      turn(m, rev);
      m.in.reset = reset && i == event;
      m.feed(p);
      m.cycle();
      done = m.out.state == NC_STATE_IDLE;
    }
    EXPECT_TRUE(done) << int{m.out.cause} << " " << m.out.command.v[2];
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    if (!reset) {
      EXPECT_EQ(m.command(), p.at());
    }
  }
}

/// A former fault: single block came in the last cells of the line before, where nothing can be changed any more. At rest no cell was passed, so
/// nothing was planned anew for the present speed of the spindle, and the thread waited for its angle for ever.
TEST(PlannedThread, BeginsWhereSingleBlockCameInTheLastCellsOfTheLineBefore) {
  for (unsigned n = 0; n < 60; ++n) {
    const ExecutorConfig c = thread_config();
    Program p(c);
    p.line(place(5, 0), 60);
    p.mark();
    thread(&p, place(5, -10), 1);
    p.end();
    Machine m(c);
    m.feed(p);
    m.start();
    const double last = 0.0005 * n * n;  // mm of the line that are left when single block comes
    int rests = 0;
    for (int i = 0; i < 4000 && m.out.command.v[2] > -10; ++i) {
      rests += m.out.command.v[0] > 5 - 1e-9;
      turn(m, rests > 0 ? 20 : 2);
      m.in.single_block = m.out.command.v[0] >= 5 - last;
      m.in.cycle_start = rests == 20;
      m.feed(p);
      m.cycle();
    }
    EXPECT_NEAR(m.out.command.v[2], -10, 1e-6) << last << " mm before its end, cause " << int{m.out.cause};
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  }
}

/// A former fault: sigma came to the end of its range with the slope of one cycle before, so that the last steps had twice the allowed sigma''.
TEST(PlannedThread, TheSynchronizerKeepsItsReachAtTheEndsOfItsRange) {
  std::mt19937_64 rng(5);
  const auto log_uniform = [&](double low, double high) { return low * std::pow(high / low, std::uniform_real_distribution<double>()(rng)); };
  for (int n = 0; n < 500; ++n) {
    const double cycle = log_uniform(0.00025, 0.004), slower = log_uniform(0.01, 0.5);
    SpindleSync::Reach reach;
    reach.slope = log_uniform(0.2, 50);
    reach.bend = log_uniform(10, 20000);
    SpindleSync sync;
    sync.create(cycle);
    sync.begin(0, 10);
    SpindleSync::Sample s;
    s.lead = 1;
    double slope = 0, sigma = 1;
    for (int i = 0; i < 4000; ++i) {
      const double rate = i < 2000 ? std::min(1.4, 1 + i * cycle * slower) : std::max(0.0, 1.4 - (i - 2000) * cycle * slower * 4);
      s.rev_per_s = 10 * rate;
      s.turns += s.rev_per_s * cycle;
      const double gone = sync.advance(cycle, s, reach);
      const PlanPace now = sync.pace();
      ASSERT_LE(std::fabs(now.slope - slope), reach.bend * cycle * (1 + 1e-9)) << n << ", cycle " << i << ", sigma " << now.sigma;
      ASSERT_LE(std::fabs(now.slope), reach.slope * (1 + 1e-9));
      ASSERT_NEAR(now.sigma - sigma, cycle * (slope + now.slope) / 2, 1e-12) << n << ", cycle " << i;
      ASSERT_NEAR(gone, cycle * sigma, cycle * cycle * (reach.slope + reach.bend * cycle));
      ASSERT_LE(now.sigma, optimal::ThreadShare::kFaster);
      ASSERT_GE(now.sigma, 0);
      slope = now.slope;
      sigma = now.sigma;
    }
  }
}

}  // namespace
}  // namespace nc::test
