// SPDX-License-Identifier: Apache-2.0
// The optimal mode on curves that are neither lines nor circles of the axes: spans of a NURBS, arcs in space, exponential curves, lines on
// a developed cylinder. The axes pass from one to the next, and to lines and arcs, at speed and within the tolerance, and keep their limits.
#include <gtest/gtest.h>

#include "interpolate/path_distance.hpp"
#include "interpolate/test_machine.hpp"
#include "path/shape.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kPi = std::numbers::pi;

double uniform(std::mt19937_64& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }

ExecutorConfig config_of() {
  ExecutorConfig c = standard_config(4);
  c.optimal = true;
  for (unsigned i = 0; i < 4; ++i) c.limits[i] = {250, 250, 2000, 50000, 0.01};
  c.limits[3] = {180, 150, 3000, 60000, 0.01};
  return c;
}

/// A program of curves; a curve may begin in the direction in which the last one ended.
struct Curves {
  explicit Curves(const ExecutorConfig& setup) : config(setup), program(setup) {}

  AxisVec heading() const {
    AxisVec h;
    h[0] = 1;
    for (size_t k = program.records.size(); k-- > 0;) {
      const Record& r = program.records[k];
      if (r.kind == ItemKind::move) return curve_evaluate(r.segment.curve, r.segment.curve.length, config.axis_count).d1;
    }
    return h;
  }
  Curve make(const MoveShape& what, const AxisVec& end) {
    shapes.push_back(std::make_unique<CurveShape>());
    Curve curve;
    const AxisVec start = program.at();
    make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, start, config.axis_count, config.rotary, shapes.back().get(), &curve);
    return curve;
  }
  /// One span whose first leg goes along `along`.
  void span(const AxisVec& along, const double (&leg)[3][3], const double (&weight)[4], double feed) {
    MoveShape what;
    what.kind = ShapeKind::rational;
    what.span = RationalSpan{};
    what.span.degree = 3;
    AxisVec end = program.at();
    for (unsigned k = 0; k < 4; ++k) {
      for (unsigned i = 0; i < 3; ++i) {
        if (k > 0) end[i] += leg[k - 1][i] + (k == 1 ? 6 * along[i] : 0);
        what.span.axis[i] = static_cast<uint8_t>(i);
        what.span.point[k][i] = end[i];
      }
      what.span.weight[k] = weight[k];
    }
    program.segment(make(what, end), feed);
    program.mark();
  }
  void random_span(std::mt19937_64& rng, const AxisVec& along, double feed) {
    double leg[3][3] = {}, weight[4];
    for (unsigned k = 1; k < 3; ++k)
      for (unsigned i = 0; i < 3; ++i) leg[k][i] = 5 * along[i] + uniform(rng, -4, 4);
    for (double& w : weight) w = uniform(rng, 0.7, 1.4);
    span(along, leg, weight, feed);
  }
  /// At most half of a circle, in a plane that contains `along` and is turned about it.
  void space_arc(std::mt19937_64& rng, const AxisVec& along, double feed) {
    double d[3], n[3], e[3], length = 0, dot = 0, size = 0;
    for (unsigned i = 0; i < 3; ++i) length += along[i] * along[i];
    if (!(length > 0)) return;
    for (unsigned i = 0; i < 3; ++i) d[i] = along[i] / std::sqrt(length), e[i] = uniform(rng, -1, 1), dot += d[i] * e[i];
    for (unsigned i = 0; i < 3; ++i) n[i] = e[i] - dot * d[i], size += n[i] * n[i];
    MoveShape what;
    what.kind = ShapeKind::space_arc;
    what.arc = SpaceArc{};
    what.arc.radius = uniform(rng, 1, 20);
    what.arc.sweep = uniform(rng, 0.3, 2.5);
    AxisVec end = program.at();
    for (unsigned i = 0; i < 3; ++i) {
      what.arc.axis[i] = static_cast<uint8_t>(i);
      what.arc.e1[i] = -n[i] / std::sqrt(size);
      what.arc.e2[i] = d[i];
      what.arc.center[i] = end[i] - what.arc.radius * what.arc.e1[i];
    }
    for (unsigned i = 0; i < 3; ++i)
      end[i] = what.arc.center[i] + what.arc.radius * (what.arc.e1[i] * std::cos(what.arc.sweep) + what.arc.e2[i] * std::sin(what.arc.sweep));
    program.segment(make(what, end), feed);
    program.mark();
  }
  Segment& exponential(std::mt19937_64& rng, double feed) {
    const double tan_i = std::tan(uniform(rng, 15, 60) * kPi / 180), tan_j = std::tan(uniform(rng, 40, 80) * kPi / 180);
    const double r = uniform(rng, 20, 100), x = uniform(rng, 5, 40), d = tan_j / tan_i, turn = d * std::log(x * tan_i / r + 1);
    MoveShape what;
    what.kind = ShapeKind::exponential;
    what.exponential = Exponential{r / tan_i, d, turn, 180 / kPi, 0, 3};
    AxisVec end = program.at();
    end[0] += x;
    end[3] += turn * 180 / kPi;
    return program.segment(make(what, end), feed);
  }
  void line(const AxisVec& along, double length, double feed) {
    AxisVec end = program.at();
    for (unsigned i = 0; i < 3; ++i) end[i] += length * along[i];
    if (end == program.at()) return;
    program.line(end, feed);
    program.mark();
  }

  ExecutorConfig config;
  Program program;
  std::vector<std::unique_ptr<CurveShape>> shapes;  ///< must exist longer than the curves that refer to them
};

Curves random_curves(uint64_t seed) {
  std::mt19937_64 rng(seed);
  Curves c(config_of());
  for (int n = 0; n < 5; ++n) {
    const double feed = uniform(rng, 10, 200);
    AxisVec along = c.heading();
    if (rng() % 3 == 0) {
      for (unsigned i = 0; i < 3; ++i) along[i] = uniform(rng, -0.6, 0.6);
    }
    switch (rng() % 6) {
      case 0:
      case 1: c.random_span(rng, along, feed); break;
      case 2: c.space_arc(rng, along, feed); break;
      case 3: {
        Segment& s = c.exponential(rng, feed);
        if (rng() % 2 == 0) s.feed_end_mm_s = uniform(rng, 10, 200);
        c.program.mark();
        break;
      }
      case 4: c.line(along, uniform(rng, 0.2, 20), feed); break;
      default: c.program.arc(0, 1, uniform(rng, 1, 15), std::atan2(along[1], along[0]) - kPi / 2, uniform(rng, 0.3, 3), feed); c.program.mark();
    }
  }
  c.program.end();
  return c;
}

TEST(PlannedShapes, RandomCurvesKeepLimitsAndTolerance) {
  const uint64_t count = seeds(20, 2);
  for (uint64_t seed = 0; seed < count; ++seed) {
    const Curves c = random_curves(seed);
    std::mt19937_64 rng(seed);
    const PathDistance path(c.program, c.config.axis_count);
    Machine m(c.config);
    m.feed(c.program);
    m.start();
    uint64_t n = 0;
    double farthest = 0;
    for (; n < 60000 && !(m.out.state == NC_STATE_IDLE && m.next == c.program.records.size() && m.executor.drained()); ++n) {
      m.feed(c.program);
      if (seed % 2 == 1 && rng() % 200 == 0) m.in.feed_override = uniform(rng, 0.3, 2);
      if (seed % 4 == 3) m.in.feed_hold = rng() % 300 == 0 || (m.in.feed_hold && rng() % 50 != 0);
      m.in.cycle_start = m.out.state == NC_STATE_HOLD && rng() % 5 == 0 && !m.in.cycle_start;
      m.cycle();
      if (n % 5 == 0) farthest = std::max(farthest, path.near(m.out.serial, m.command(), std::max(0.001, farthest)));
    }
    EXPECT_LT(n, 60000u) << "seed " << seed << " does not end, serial " << m.out.serial << " " << m.out.cause;
    EXPECT_TRUE(m.checker.ok()) << "seed " << seed << ": " << m.checker.report();
    EXPECT_LE(farthest, c.config.tolerance + 1e-9) << "seed " << seed;
    EXPECT_EQ(m.command(), c.program.at()) << "seed " << seed;
    if (HasFailure()) break;
  }
}

/// Two spans with one tangent, and a line in front of and behind them that touches them.
/// Near the pole of a polar plane the rotary axis turns by many degrees per mm (M700 6.10). Nevertheless the size of a cell depends only on the turn
/// of the path: with cells that are too small a window would end before the path can become fast.
TEST(PlannedShapes, ALinePassesThePoleSoon) {
  for (const auto& [aside, most] : {std::pair{5.0, 1.0}, {0.3, 1.8}, {0.05, 2.3}, {0.01, 5.5}}) {
    const ExecutorConfig c = config_of();
    MoveShape what;
    what.map.kind = AxisMap::Kind::polar;
    what.map.linear = 0;
    what.map.rotary = 3;
    AxisVec start, end, machine;
    start[0] = 10;
    start[3] = end[3] = aside;
    end[0] = -10;
    machine[0] = std::hypot(10, aside);
    machine[3] = std::atan2(aside, 10) * 180 / kPi;
    CurveShape shape;
    Curve curve;
    make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, machine, c.axis_count, c.rotary, &shape, &curve);
    Program p(c, machine);
    p.segment(curve, 50);
    p.mark();
    p.end();
    Machine m(c);
    m.executor.set_position(machine);
    ASSERT_TRUE(m.run_to_end(p, 40000)) << aside;
    EXPECT_TRUE(m.checker.ok()) << aside << ": " << m.checker.report();
    EXPECT_LE(static_cast<double>(m.cycles) * 0.001, most) << aside;
    EXPECT_NEAR(m.out.command.v[3], 180 - machine[3], 1e-9);
  }
}

TEST(PlannedShapes, TangentSpansAndLinesDoNotRest) {
  Curves c(config_of());
  AxisVec x;
  x[0] = 1;
  c.line(x, 30, 60);
  const double up[3][3] = {{0, 0, 0}, {8, 6, 0}, {8, 6, 0}}, level[3][3] = {{0, 0, 0}, {8, 0, 0}, {8, 0, 0}}, weight[4] = {1, 1, 1, 1};
  c.span(x, up, weight, 60);
  c.span(c.heading(), level, weight, 60);
  c.line(c.heading(), 30, 60);
  c.program.end();
  Machine m(c.config);
  m.feed(c.program);
  m.start();
  AxisVec last;
  double slowest = HUGE_VAL, length = 0;
  for (const Record& r : c.program.records) length += r.kind == ItemKind::move ? r.segment.curve.length : 0;
  for (int n = 0; n < 10000 && !(m.out.state == NC_STATE_IDLE && n > 0); ++n) {
    m.feed(c.program);
    m.cycle();
    const AxisVec now = m.command();
    double way = 0;
    for (unsigned i = 0; i < 3; ++i) way += (now[i] - last[i]) * (now[i] - last[i]);
    last = now;
    if (now[0] > 25 && now[0] < c.program.at()[0] - 25) slowest = std::min(slowest, std::sqrt(way) / c.config.cycle_s);
  }
  EXPECT_EQ(m.command(), c.program.at());
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  EXPECT_GT(slowest, 40);
  EXPECT_LE(static_cast<double>(m.cycles) * c.config.cycle_s, length / 60 + 0.2);
}

/// M700 6.11: the feed goes from F to Q with the linear axis; it is never exceeded and nearly reached.
TEST(PlannedShapes, AnExponentialCurveGoesFromFToQ) {
  Curves c(config_of());
  std::mt19937_64 rng(3);
  Segment& s = c.exponential(rng, 20);
  s.feed_end_mm_s = 60;
  const Curve curve = s.curve;
  c.program.mark();
  c.program.end();
  Machine m(c.config);
  m.feed(c.program);
  m.start();
  double most = 0, reached = 0, last = 0;
  for (int n = 0; n < 20000 && !(m.out.state == NC_STATE_IDLE && n > 0); ++n) {
    m.feed(c.program);
    m.cycle();
    const double speed = (m.out.path_length - last) / c.config.cycle_s;
    last = m.out.path_length;
    const double share = (m.command()[0] - curve.start[0]) / curve.delta[0], feed = 20 + 40 * share;
    most = std::max(most, speed / feed);
    if (share > 0.2 && share < 0.8) reached = std::max(reached, 1 - speed / feed);
  }
  EXPECT_EQ(m.command(), c.program.at());
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  EXPECT_LE(most, 1.001);
  EXPECT_LE(reached, 0.1);
}

/// The same in the trapezoid mode: as slow as the sharpest place requires.
TEST(TrapezoidShapes, NearCuspsKeepTheLimits) {
  const double weight[4] = {1, 1.37, 1, 1};  // so that the sharpest place is not where equal steps would find it
  for (const double gap : {0.3, 0.1, 0.05, 0.02})
    for (const double size : {0.1, 1.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << gap << " " << size);
      ExecutorConfig config = config_of();
      config.optimal = false;
      for (AxisLimits& axis : config.limits) axis.jerk = 0;
      Curves c(config);
      const double a = size * (1 + gap), b = size * (1 + 2 * gap);
      const double leg[3][3] = {{a, size, 0}, {-b, 0, 0.1 * gap}, {a, -size, 0}};
      c.span({}, leg, weight, 100);
      c.program.end();
      Machine m(c.config);
      m.run_to_end(c.program, 20000);  // it need not come to the end in these cycles
      EXPECT_GT(m.out.path_length, 0);
      EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    }
}

/// A spline through points that go back and forth has a place where its parameter nearly stands, or reverses on the spot.
TEST(PlannedShapes, CuspsArePassedWithinTheLimits) {
  const double weight[4] = {1, 1, 1, 1};
  for (const double gap : {1.0, 0.1, 1e-2, 1e-3, 1e-5, 1e-8, 0.0})
    for (const double size : {0.01, 0.1, 1.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << gap << " " << size);
      Curves c(config_of());
      const double a = size * (1 + gap), b = size * (1 + 2 * gap);
      const double leg[3][3] = {{a, size, 0}, {-b, 0, 0.1 * gap}, {a, -size, 0}};
      const double back[3][3] = {{-size, 0, 0}, {0.5 * size, 0, 0}, {-2 * size, 0, 0}};  // along one line
      c.span({}, leg, weight, 100);
      c.span({}, back, weight, 100);
      c.span({}, leg, weight, 100);
      c.program.end();
      Machine m(c.config);
      EXPECT_TRUE(m.run_to_end(c.program, 3000)) << int{m.out.cause} << " " << int{m.out.state} << " " << m.out.command.v[0] << " " << m.out.command.v[1];
      EXPECT_EQ(m.out.state, NC_STATE_IDLE);
      EXPECT_TRUE(m.checker.ok()) << m.checker.report();
      EXPECT_EQ(m.command(), c.program.at());
    }
}

}  // namespace
}  // namespace nc::test
