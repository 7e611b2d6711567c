// SPDX-License-Identifier: Apache-2.0
// Shapes: end points and tangents; the length is compared with quadrature, derivatives and curvature with finite differences, bounds with
// samples, and maps with their definition.
#include "path/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace nc {
namespace {

constexpr unsigned kAxes = 5;
constexpr uint32_t kRotary = 0b11000;  // axes 3 and 4
constexpr double kPi = std::numbers::pi;

double uniform(std::mt19937_64& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }

struct Made {
  CurveShape shape;
  Curve curve;
};

void make(const MoveShape& what, const AxisVec& start, const AxisVec& end, const Circle* circle, uint8_t h, uint8_t v, const AxisVec& machine,
          const AxisVec& offset, Made* made) {
  make_shaped(what, PlainMove{&start, &end, circle, h, v}, Affine::translation(offset), machine, kAxes, kRotary, &made->shape, &made->curve);
}

void random_space_arc(std::mt19937_64& rng, Made* made) {
  MoveShape what;
  what.kind = ShapeKind::space_arc;
  what.arc = SpaceArc{};
  double e1[3], e2[3], norm = 0, along = 0;
  for (double& x : e1) x = uniform(rng, -1, 1), norm += x * x;
  for (double& x : e1) x /= std::sqrt(norm);
  for (unsigned i = 0; i < 3; ++i) e2[i] = uniform(rng, -1, 1), along += e2[i] * e1[i];
  norm = 0;
  for (unsigned i = 0; i < 3; ++i) e2[i] -= along * e1[i], norm += e2[i] * e2[i];
  for (double& x : e2) x /= std::sqrt(norm);
  SpaceArc& a = what.arc;
  a.radius = uniform(rng, 0.5, 60);
  a.sweep = uniform(rng, 0.1, 6.2);
  AxisVec start, end;
  for (unsigned i = 0; i < 3; ++i) {
    a.axis[i] = static_cast<uint8_t>(i);
    a.center[i] = uniform(rng, -50, 50);
    a.e1[i] = e1[i];
    a.e2[i] = e2[i];
    start[i] = a.center[i] + a.radius * e1[i];
    end[i] = a.center[i] + a.radius * (e1[i] * std::cos(a.sweep) + e2[i] * std::sin(a.sweep));
  }
  end[3] = uniform(rng, -90, 90);
  make(what, start, end, nullptr, 0, 1, start, AxisVec{}, made);
}

void random_exponential(std::mt19937_64& rng, Made* made) {
  const double tan_i = std::tan(uniform(rng, 5, 80) * kPi / 180) * (rng() % 2 ? 1 : -1), tan_j = std::tan(uniform(rng, 20, 85) * kPi / 180);
  const double r = uniform(rng, 5, 120), x = std::copysign(uniform(rng, 1, 150), tan_i);
  const double d = tan_j / tan_i, theta = d * std::log(x * tan_i / r + 1), sign = theta < 0 ? -1 : 1;
  MoveShape what;
  what.kind = ShapeKind::exponential;
  what.exponential = Exponential{r / tan_i, d * sign, theta * sign, sign * 180 / kPi, 0, 3};
  AxisVec start, end;
  start[0] = uniform(rng, -10, 10);
  end = start;
  end[0] += x;
  end[2] += uniform(rng, -50, 50);
  end[3] += theta * 180 / kPi;
  make(what, start, end, nullptr, 0, 1, start, AxisVec{}, made);
}

void random_span(std::mt19937_64& rng, Made* made) {
  MoveShape what;
  what.kind = ShapeKind::rational;
  what.span = RationalSpan{};
  RationalSpan& s = what.span;
  s.degree = static_cast<uint8_t>(1 + rng() % 3);
  double at[3] = {0, 0, 0};
  for (unsigned k = 0; k <= s.degree; ++k) {
    for (unsigned i = 0; i < 3; ++i) {
      s.axis[i] = static_cast<uint8_t>(i);
      s.point[k][i] = at[i];
    }
    s.weight[k] = uniform(rng, 0.5, 2);
    at[0] += uniform(rng, 1, 8);
    at[1] += uniform(rng, -6, 6);
    at[2] += uniform(rng, -3, 3);
  }
  AxisVec start, end;
  for (unsigned i = 0; i < 3; ++i) start[i] = s.point[0][i], end[i] = s.point[s.degree][i];
  make(what, start, end, nullptr, 0, 1, start, AxisVec{}, made);
}

/// One block of a spline: a quintic that always goes forward.
void random_spline(std::mt19937_64& rng, Made* made) {
  MoveShape what;
  what.kind = ShapeKind::spline;
  what.spline = SplineSpan{};
  AxisVec start, end;
  for (unsigned i = 0; i < 3; ++i) {
    what.spline.axis[i] = static_cast<uint8_t>(i);
    start[i] = end[i] = uniform(rng, -50, 50);
    for (unsigned k = 0; k < 5; ++k) {
      const double c = i == 0 && k == 0 ? uniform(rng, 4, 8) : uniform(rng, -0.5, 0.5) / (k + 1);
      what.spline.c[k][i] = c;
      end[i] += c;
    }
  }
  make(what, start, end, nullptr, 0, 1, start, AxisVec{}, made);
}

/// A line or an arc in a plane that is not one of the axes.
void random_mapped(std::mt19937_64& rng, AxisMap::Kind kind, Made* made) {
  MoveShape what;
  what.map.kind = kind;
  what.map.linear = 0;
  what.map.rotary = 3;
  what.map.scale = uniform(rng, 0.1, 2);
  what.map.angle = uniform(rng, -180, 180);
  what.map.side = rng() % 2 ? 1 : -1;
  AxisVec start, end, offset;
  for (unsigned i = 0; i < kAxes; ++i) offset[i] = uniform(rng, -30, 30);
  start[2] = uniform(rng, -10, 10);
  end[2] = uniform(rng, -10, 10);
  Circle circle;
  const bool arc = rng() % 2;
  if (arc) {
    circle.center[0] = uniform(rng, -40, 40);
    circle.center[1] = uniform(rng, -40, 40);
    const double distance = std::hypot(circle.center[0], circle.center[1]);
    do circle.radius_start = uniform(rng, 2, 60);
    while (std::fabs(circle.radius_start - distance) < 3);
    circle.radius_end = circle.radius_start;
    circle.angle_start = uniform(rng, -3, 3);
    circle.sweep = uniform(rng, -9, 9);
    for (unsigned i = 0; i < 2; ++i) {
      const double shift = i == 0 ? 0 : -kPi / 2;
      start[i == 0 ? 0 : 3] = circle.center[i] + circle.radius_start * std::cos(circle.angle_start + shift);
      end[i == 0 ? 0 : 3] = circle.center[i] + circle.radius_end * std::cos(circle.angle_start + circle.sweep + shift);
    }
  } else {
    double nearest = 0;
    while (nearest < 2) {
      for (const unsigned i : {0u, 3u}) start[i] = uniform(rng, -60, 60), end[i] = uniform(rng, -60, 60);
      const double dx = end[0] - start[0], dy = end[3] - start[3];
      nearest = std::fabs(start[0] * dy - start[3] * dx) / std::hypot(dx, dy);
    }
  }
  AxisVec machine;
  for (unsigned i = 0; i < kAxes; ++i) machine[i] = start[i] + offset[i];
  if (kind == AxisMap::Kind::polar) {
    machine[0] = what.map.side * std::hypot(start[0], start[3]) + offset[0];
    machine[3] = what.map.angle + std::atan2(what.map.side * start[3], what.map.side * start[0]) * 180 / kPi + 360 * static_cast<double>(rng() % 3);
  } else {
    machine[3] = start[3] / what.map.scale + offset[3];
  }
  make(what, start, end, arc ? &circle : nullptr, 0, 3, machine, offset, made);
}

constexpr unsigned kKinds = 6;
void random_shape(std::mt19937_64& rng, unsigned kind, Made* made) {
  switch (kind % kKinds) {
    case 0: return random_space_arc(rng, made);
    case 1: return random_exponential(rng, made);
    case 2: return random_span(rng, made);
    case 3: return random_mapped(rng, AxisMap::Kind::cylinder, made);
    case 4: return random_mapped(rng, AxisMap::Kind::polar, made);
    default: return random_spline(rng, made);
  }
}

TEST(Shape, EndPointsAreExactAndReachedWithoutAJump) {
  std::mt19937_64 rng(1);
  for (unsigned n = 0; n < 1000; ++n) {
    Made m;
    random_shape(rng, n, &m);
    EXPECT_EQ(curve_evaluate(m.curve, 0, kAxes).position, m.curve.start);
    EXPECT_EQ(curve_position(m.curve, 0, kAxes), m.curve.start);
    EXPECT_EQ(curve_position(m.curve, m.curve.length, kAxes), m.curve.end);
    const AxisVec first = curve_position(m.curve, m.curve.length * 1e-12, kAxes);
    const AxisVec just = curve_position(m.curve, m.curve.length * (1 - 1e-12), kAxes);
    for (unsigned i = 0; i < kAxes; ++i) {
      EXPECT_NEAR(first[i], m.curve.start[i], 1e-8) << "kind " << n % kKinds;
      EXPECT_NEAR(just[i], m.curve.end[i], 1e-8) << "kind " << n % kKinds;
    }
  }
}

TEST(Shape, DerivativesAreThoseOfFiniteDifferences) {
  std::mt19937_64 rng(2);
  for (unsigned n = 0; n < 1000; ++n) {
    Made m;
    random_shape(rng, n, &m);
    const double e = m.curve.length * 1e-4, s = uniform(rng, 2 * e, m.curve.length - 2 * e);
    const CurvePoint p = curve_evaluate(m.curve, s, kAxes), q = curve_evaluate(m.curve, s + e, kAxes), r = curve_evaluate(m.curve, s - e, kAxes);
    EXPECT_EQ(p.position, curve_position(m.curve, s, kAxes));
    for (unsigned i = 0; i < kAxes; ++i) {
      // The error of central differences is e^2/6 of the third derivative.
      const double rough = 1e-6 * (1 + std::fabs(p.d1[i])) + e * e * std::fabs(q.d3[i]) + e * e * std::fabs(r.d3[i]);
      EXPECT_NEAR((q.position[i] - r.position[i]) / (2 * e), p.d1[i], rough) << "kind " << n % kKinds;
      const double change = std::fabs(q.d3[i] - r.d3[i]);
      EXPECT_NEAR((q.d1[i] - r.d1[i]) / (2 * e), p.d2[i], 1e-6 * (1 + std::fabs(p.d2[i])) + e * change) << "kind " << n % kKinds;
      EXPECT_NEAR((q.d2[i] - r.d2[i]) / (2 * e), p.d3[i], 1e-5 * (1 + std::fabs(p.d3[i])) + 0.2 * change) << "kind " << n % kKinds;
    }
  }
}

TEST(Shape, TheTangentOfTheProgrammedPathIsOfUnitLength) {
  std::mt19937_64 rng(3);
  for (unsigned n = 0; n < 1000; ++n) {
    Made m;
    random_shape(rng, n, &m);
    const uint32_t linear = n % kKinds == 1 ? 0b11111 : n % kKinds == 3 || n % kKinds == 4 ? 0b01111 : 0b00111;
    const CurvePoint p = shape_programmed(m.shape, uniform(rng, 0, m.curve.length), kAxes);
    double d1 = 0, d12 = 0;
    for (unsigned i = 0; i < kAxes; ++i) {
      if (!(linear >> i & 1)) continue;
      d1 += p.d1[i] * p.d1[i];
      d12 += p.d1[i] * p.d2[i];
    }
    EXPECT_NEAR(d1, 1, 1e-9) << "kind " << n % kKinds;
    EXPECT_NEAR(d12, 0, 1e-7) << "kind " << n % kKinds;  // curvature is at right angles to the tangent
  }
}

TEST(Shape, LengthIsThatOfManyChords) {
  std::mt19937_64 rng(4);
  for (unsigned n = 0; n < 100; ++n) {
    Made m;
    random_shape(rng, n, &m);
    const uint32_t linear = n % kKinds == 1 ? 0b11111 : n % kKinds == 3 || n % kKinds == 4 ? 0b01111 : 0b00111;
    constexpr int kChords = 4000;
    double sum = 0;
    AxisVec before = shape_programmed(m.shape, 0, kAxes).position;
    for (int k = 1; k <= kChords; ++k) {
      const AxisVec p = shape_programmed(m.shape, m.curve.length * k / kChords, kAxes).position;
      double d = 0;
      for (unsigned i = 0; i < kAxes; ++i)
        if (linear >> i & 1) d += (p[i] - before[i]) * (p[i] - before[i]);
      // Every step of length must be exactly that: the table is neither ahead nor behind.
      EXPECT_NEAR(std::sqrt(d), m.curve.length / kChords, 1e-4 * m.curve.length / kChords) << "kind " << n % kKinds;
      sum += std::sqrt(d);
      before = p;
    }
    EXPECT_NEAR(sum, m.curve.length, 1e-5 * m.curve.length) << "kind " << n % kKinds;
  }
}

TEST(Shape, BoundsAreThoseOfManySamples) {
  std::mt19937_64 rng(5);
  for (unsigned n = 0; n < 200; ++n) {
    Made m;
    random_shape(rng, n, &m);
    AxisVec low, high;
    curve_bounds(m.curve, kAxes, &low, &high);
    AxisVec least = m.curve.start, most = m.curve.start;
    for (int k = 0; k <= 3000; ++k) {
      const AxisVec p = curve_position(m.curve, m.curve.length * k / 3000.0, kAxes);
      for (unsigned i = 0; i < kAxes; ++i) least[i] = std::min(least[i], p[i]), most[i] = std::max(most[i], p[i]);
    }
    for (unsigned i = 0; i < kAxes; ++i) {
      const double fine = 1e-9 + 1e-4 * (most[i] - least[i]);
      EXPECT_LE(low[i], least[i] + 1e-9) << "kind " << n % kKinds;
      EXPECT_GE(high[i], most[i] - 1e-9) << "kind " << n % kKinds;
      EXPECT_NEAR(low[i], least[i], fine) << "kind " << n % kKinds;
      EXPECT_NEAR(high[i], most[i], fine) << "kind " << n % kKinds;
    }
  }
}

TEST(Shape, PolarAxesLeadBackToThePlane) {
  std::mt19937_64 rng(6);
  for (unsigned n = 0; n < 500; ++n) {
    Made m;
    random_mapped(rng, AxisMap::Kind::polar, &m);
    const double s = uniform(rng, 0, m.curve.length);
    const AxisVec axes = curve_position(m.curve, s, kAxes);
    const AxisVec plane = to_programmed(m.shape.what.map, m.shape.to_machine, axes);
    const AxisVec wanted = shape_programmed(m.shape, s, kAxes).position;
    for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(plane[i], wanted[i], 1e-9);
    const AxisVec end = to_programmed(m.shape.what.map, m.shape.to_machine, m.curve.end);
    for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(end[i], m.shape.base.end[i], 1e-9);
  }
}

TEST(Shape, ArcsOnACylinderAreArcsOfItsSurface) {
  std::mt19937_64 rng(7);
  for (unsigned n = 0; n < 200; ++n) {
    Made m;
    random_mapped(rng, AxisMap::Kind::cylinder, &m);
    if (!m.shape.base.circular) continue;
    const AxisVec p = curve_position(m.curve, uniform(rng, 0, m.curve.length), kAxes);
    const double x = p[0] - m.shape.to_machine.offset()[0], y = (p[3] - m.shape.to_machine.offset()[3]) * m.shape.what.map.scale;
    EXPECT_NEAR(std::hypot(x - m.shape.base.circle.center[0], y - m.shape.base.circle.center[1]), m.shape.base.circle.radius_start, 1e-9);
  }
}

TEST(Shape, AHeldAxisStaysAndTheOthersGoAsIfItMoved) {
  MoveShape what;
  what.map.frozen = 0b10;
  Circle circle;
  circle.center[1] = -10;
  circle.radius_start = circle.radius_end = 10;
  circle.angle_start = kPi / 2;
  circle.sweep = -4 * kPi;
  AxisVec start, end, machine;
  end[2] = 40;
  machine[1] = 7;  // any position
  Made m;
  make(what, start, end, &circle, 0, 1, machine, AxisVec{}, &m);
  for (int k = 0; k <= 40; ++k) {
    const AxisVec p = curve_position(m.curve, m.curve.length * k / 40.0, kAxes);
    EXPECT_EQ(p[1], 7);
    EXPECT_NEAR(p[2], k, 1e-9);
    EXPECT_NEAR(p[0], 10 * std::sin(2 * kPi * k / 20), 1e-9);  // M700 6.16: a sine of amplitude 10 and pitch 20
  }
  EXPECT_EQ(curve_evaluate(m.curve, 3, kAxes).d1[1], 0);
}

}  // namespace
}  // namespace nc
