// SPDX-License-Identifier: Apache-2.0
// Curves that are neither lines nor circles, executed by the scan: no axis exceeds its limits, the end is exact, and a thread follows its spindle
// and is not held.
#include <gtest/gtest.h>

#include <numbers>

#include "interpolate/test_machine.hpp"
#include "path/shape.hpp"

namespace nc::test {
namespace {

constexpr double kPi = std::numbers::pi;

double uniform(std::mt19937_64& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }

ExecutorConfig rotary_config() {
  ExecutorConfig c;
  c.axis_count = 4;
  c.rotary = 0b1000;
  for (unsigned i = 0; i < 4; ++i) c.limits[i] = {300, 250, 1500, 0, 0.01};
  c.limits[3] = {360, 360, 3000, 0, 0.01};
  c.capacity = 64;
  return c;
}

/// Shapes must exist longer than the curves that refer to them.
using Shapes = std::vector<std::unique_ptr<CurveShape>>;

Curve shaped(Shapes& shapes, const ExecutorConfig& c, const MoveShape& what, const AxisVec& start, const AxisVec& end, const AxisVec& machine) {
  shapes.push_back(std::make_unique<CurveShape>());
  Curve curve;
  make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, machine, c.axis_count, c.rotary, shapes.back().get(), &curve);
  return curve;
}

/// A random span of a NURBS from where the program stands.
Curve span_from(Shapes& shapes, const ExecutorConfig& c, std::mt19937_64& rng, const AxisVec& at) {
  MoveShape what;
  what.kind = ShapeKind::rational;
  what.span = RationalSpan{};
  what.span.degree = 3;
  AxisVec end = at;
  for (unsigned k = 0; k < 4; ++k) {
    for (unsigned i = 0; i < 3; ++i) {
      if (k > 0) end[i] += uniform(rng, -1, 1) * 8 + (i == 0 ? 6 : 0);
      what.span.axis[i] = static_cast<uint8_t>(i);
      what.span.point[k][i] = end[i];
    }
    what.span.weight[k] = uniform(rng, 0.6, 1.6);
  }
  return shaped(shapes, c, what, at, end, at);
}

Curve exponential_from(Shapes& shapes, const ExecutorConfig& c, std::mt19937_64& rng, const AxisVec& at) {
  const double tan_i = std::tan(uniform(rng, 15, 60) * kPi / 180), tan_j = std::tan(uniform(rng, 40, 80) * kPi / 180);
  const double r = uniform(rng, 20, 100), x = uniform(rng, 5, 60), d = tan_j / tan_i, turn = d * std::log(x * tan_i / r + 1);
  MoveShape what;
  what.kind = ShapeKind::exponential;
  what.exponential = Exponential{r / tan_i, d, turn, 180 / kPi, 0, 3};
  AxisVec end = at;
  end[0] += x;
  end[2] += uniform(rng, -20, 20);
  end[3] += turn * 180 / kPi;
  return shaped(shapes, c, what, at, end, at);
}

TEST(ShapedMotion, KeepsTheLimitsOfEveryAxis) {
  const ExecutorConfig c = rotary_config();
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937_64 rng(seed);
    Shapes shapes;
    Program p(c);
    for (int n = 0; n < 12; ++n) {
      const double feed = uniform(rng, 10, 200);
      switch (rng() % 3) {
        case 0: p.segment(span_from(shapes, c, rng, p.at()), feed); break;
        case 1: {
          Segment& s = p.segment(exponential_from(shapes, c, rng, p.at()), feed);
          s.feed_end_mm_s = uniform(rng, 10, 200);
          break;
        }
        default: {
          AxisVec end = p.at();
          end[1] += uniform(rng, 2, 30);
          p.line(end, feed);
        }
      }
      p.mark();
    }
    p.end();
    Machine m(c);
    ASSERT_TRUE(m.run_to_end(p)) << seed;
    EXPECT_TRUE(m.checker.ok()) << seed << ": " << m.checker.report();
    for (unsigned i = 0; i < c.axis_count; ++i) EXPECT_EQ(m.out.command.v[i], p.at()[i]);
  }
}

TEST(ShapedMotion, PassesThePoleAsFastAsTheRotaryAxisCan) {
  const ExecutorConfig c = rotary_config();
  for (const double aside : {0.05, 0.3, 1.0, 5.0, 20.0}) {
    MoveShape what;
    what.map.kind = AxisMap::Kind::polar;
    what.map.linear = 0;
    what.map.rotary = 3;
    AxisVec start, end, machine;
    start[0] = 30;
    start[3] = end[3] = aside;
    end[0] = -30;
    machine[0] = std::hypot(30, aside);
    machine[3] = std::atan2(aside, 30) * 180 / kPi;
    Shapes shapes;
    Program p(c, machine);
    p.segment(shaped(shapes, c, what, start, end, machine), 100);
    p.mark();
    p.end();
    Machine m(c);
    m.executor.set_position(machine);
    ASSERT_TRUE(m.run_to_end(p)) << aside;
    EXPECT_TRUE(m.checker.ok()) << aside << ": " << m.checker.report();
    EXPECT_NEAR(m.out.command.v[3], 180 - machine[3], 1e-9);
  }
}

TEST(ShapedMotion, ExponentialFeedGoesFromFToQ) {
  const ExecutorConfig c = rotary_config();
  std::mt19937_64 rng(3);
  Shapes shapes;
  Program p(c);
  Curve curve = exponential_from(shapes, c, rng, p.at());
  Segment& s = p.segment(curve, 5);
  s.feed_end_mm_s = 15;
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  double middle = 0;
  ASSERT_TRUE(m.until(p, [&] {
    const double share = m.out.command.v[0] / curve.delta[0];
    if (share > 0.49 && share < 0.51) middle = m.out.feed_mm_min / 60;
    return m.out.state == NC_STATE_IDLE;
  }));
  EXPECT_NEAR(middle, 10, 0.3);  // M700 6.11: the feed depends on the position of the linear axis
}

Program thread_program(const ExecutorConfig& c) {
  Program p(c);
  AxisVec end;
  end[2] = 20;
  Segment& s = p.line(end, 0);
  s.thread = true;
  s.feed_mm_rev = 2;
  p.mark();
  end[0] = 10;
  p.line(end, 50);
  p.mark();
  end[2] = 0;
  p.line(end, 50);
  p.mark();
  p.end();
  return p;
}

TEST(Thread, GoesWithTheSpindleWhateverTheOverride) {  // M700 6.7.1
  const ExecutorConfig c = rotary_config();
  const Program p = thread_program(c);
  Machine m(c);
  m.in.spindle[0].rev_per_s = 5;
  m.in.feed_override = 0.5;
  m.feed(p);
  m.start();
  for (int i = 0; i < 500; ++i) m.cycle();
  EXPECT_NEAR(m.out.feed_mm_min, 600, 1e-6);
  m.in.spindle[0].rev_per_s = 2;
  for (int i = 0; i < 50; ++i) m.cycle();
  EXPECT_NEAR(m.out.feed_mm_min, 240, 1e-6);
}

TEST(Thread, FeedHoldActsBehindTheBlockAfterIt) {  // M700 6.7.1 (6)
  const ExecutorConfig c = rotary_config();
  const Program p = thread_program(c);
  Machine m(c);
  m.in.spindle[0].rev_per_s = 5;
  m.feed(p);
  m.start();
  for (int i = 0; i < 300; ++i) m.cycle();
  m.in.feed_hold = true;
  m.cycle();
  m.in.feed_hold = false;
  ASSERT_TRUE(m.until(p, [&] { return m.out.state != NC_STATE_RUNNING; }));
  EXPECT_EQ(m.out.state, NC_STATE_STOPPED);
  EXPECT_EQ(m.out.command.v[2], 20);
  EXPECT_EQ(m.out.command.v[0], 10);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[2], 0);
}

TEST(Thread, SingleBlockStopsBehindTheFirstBlockThatIsNone) {  // M700 6.7.1
  const ExecutorConfig c = rotary_config();
  const Program p = thread_program(c);
  Machine m(c);
  m.in.spindle[0].rev_per_s = 5;
  m.in.single_block = true;
  m.cycle();
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.out.command.v[0], 10);
}

}  // namespace
}  // namespace nc::test
