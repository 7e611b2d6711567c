// SPDX-License-Identifier: Apache-2.0
// Curves: their end points are exact; derivatives are compared with finite differences, the length with quadrature, the
// bounds with samples.
#include "path/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nc {
namespace {

constexpr unsigned kAxes = 5;
constexpr uint32_t kRotary = 0b11000;  // axes 3 and 4

double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

Curve random_line(std::mt19937_64& rng) {
  AxisVec a, b;
  for (unsigned i = 0; i < kAxes; ++i) {
    a[i] = uniform(rng, -100, 100);
    b[i] = rng() % 3 ? uniform(rng, -100, 100) : a[i];
  }
  if (a == b) b[rng() % kAxes] += 1;
  return make_line(a, b, kAxes, kRotary);
}

/// `spiral` is the relative difference of the radii.
Curve random_arc(std::mt19937_64& rng, double spiral, bool lead) {
  const uint8_t h = static_cast<uint8_t>(rng() % 3), v = static_cast<uint8_t>((h + 1) % 3);
  Circle k;
  k.center[0] = uniform(rng, -50, 50);
  k.center[1] = uniform(rng, -50, 50);
  k.radius_start = uniform(rng, 0.1, 50);
  k.radius_end = k.radius_start * (1 + spiral);
  k.angle_start = uniform(rng, -3.2, 3.2);
  k.sweep = uniform(rng, -14, 14);
  AxisVec a, b;
  for (unsigned i = 0; i < kAxes; ++i) a[i] = b[i] = uniform(rng, -20, 20);
  if (lead) {
    b[3 - h - v] += uniform(rng, -20, 20);
    b[3] += uniform(rng, -90, 90);
  }
  a[h] = k.center[0] + k.radius_start * std::cos(k.angle_start);
  a[v] = k.center[1] + k.radius_start * std::sin(k.angle_start);
  b[h] = k.center[0] + k.radius_end * std::cos(k.angle_start + k.sweep);
  b[v] = k.center[1] + k.radius_end * std::sin(k.angle_start + k.sweep);
  return make_arc(a, b, h, v, k, kAxes, kRotary);
}

Curve random_curve(std::mt19937_64& rng) {
  switch (rng() % 5) {
    case 0:
      return random_line(rng);
    case 1:
      return random_arc(rng, 0, false);
    case 2:
      return random_arc(rng, 0, true);
    case 3:
      return random_arc(rng, uniform(rng, -0.02, 0.02), true);
    default:
      return random_arc(rng, uniform(rng, -0.6, 1.5), rng() % 2);
  }
}

TEST(Curve, EndPointsAreExactBitForBit) {
  std::mt19937_64 rng(1);
  for (int n = 0; n < 2000; ++n) {
    const Curve c = random_curve(rng);
    EXPECT_EQ(curve_position(c, 0, kAxes), c.start);
    EXPECT_EQ(curve_position(c, c.length, kAxes), c.end);
    EXPECT_EQ(curve_position(c, -1, kAxes), c.start);
    EXPECT_EQ(curve_position(c, c.length + 1, kAxes), c.end);
    // and the curve goes there without a jump
    const AxisVec just = curve_position(c, c.length * (1 - 1e-12), kAxes);
    for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(just[i], c.end[i], 1e-8);
  }
}

TEST(Curve, DerivativesMatchFiniteDifferences) {
  std::mt19937_64 rng(2);
  for (int n = 0; n < 2000; ++n) {
    const Curve c = random_curve(rng);
    const double s = c.length * uniform(rng, 0.05, 0.95), e = 1e-5 * c.length;
    const CurvePoint p = curve_evaluate(c, s, kAxes), q = curve_evaluate(c, s + e, kAxes),
                     r = curve_evaluate(c, s - e, kAxes);
    EXPECT_EQ(p.position, curve_position(c, s, kAxes));
    for (unsigned i = 0; i < kAxes; ++i) {
      const double d1 = (q.position[i] - r.position[i]) / (2 * e);
      const double d2 = (q.d1[i] - r.d1[i]) / (2 * e);
      const double d3 = (q.d2[i] - r.d2[i]) / (2 * e);
      EXPECT_NEAR(p.d1[i], d1, 1e-6 * (1 + std::fabs(d1))) << n << " axis " << i;
      EXPECT_NEAR(p.d2[i], d2, 1e-5 * (1 + std::fabs(d2))) << n << " axis " << i;
      EXPECT_NEAR(p.d3[i], d3, 1e-4 * (1 + std::fabs(d3))) << n << " axis " << i;
    }
  }
}

TEST(Curve, ParameterIsTheLengthOfTheLinearAxes) {
  std::mt19937_64 rng(3);
  for (int n = 0; n < 2000; ++n) {
    const Curve c = random_curve(rng);
    bool linear = false;
    for (unsigned i = 0; i < 3; ++i)
      linear = linear || c.delta[i] != 0 || c.circular;  // else the rotary axes determine the length
    const double s = c.length * uniform(rng, 0, 1);
    const CurvePoint p = curve_evaluate(c, s, kAxes);
    double norm = 0;
    for (unsigned i = linear ? 0 : 3; i < (linear ? 3u : kAxes); ++i) norm += p.d1[i] * p.d1[i];
    EXPECT_NEAR(std::sqrt(norm), 1, 1e-7) << n;
  }
}

TEST(Curve, LengthMatchesChordsRefined) {
  std::mt19937_64 rng(4);
  for (int n = 0; n < 300; ++n) {
    const Curve c = random_curve(rng);
    if (!c.circular) continue;
    // Chords at steps of u, not of s, so that the test does not use what it tests. Their sum converges with 1/n^2, and is
    // extrapolated once.
    const auto chords = [&](int count) {
      double sum = 0, last[3] = {};
      for (int i = 0; i <= count; ++i) {
        const double u = static_cast<double>(i) / count;
        const double r = c.circle.radius_start + (c.circle.radius_end - c.circle.radius_start) * u;
        const double t = c.circle.angle_start + c.circle.sweep * u;
        const double now[3] = {r * std::cos(t), r * std::sin(t), std::sqrt(c.linear2) * u};
        if (i > 0) sum += std::hypot(now[0] - last[0], now[1] - last[1], now[2] - last[2]);
        for (int k = 0; k < 3; ++k) last[k] = now[k];
      }
      return sum;
    };
    const double coarse = chords(20000), fine = chords(40000);
    EXPECT_NEAR(c.length, fine + (fine - coarse) / 3, 1e-9 * c.length) << n;
  }
}

TEST(Curve, BoundsHoldTheCurveAndTouchIt) {
  std::mt19937_64 rng(5);
  for (int n = 0; n < 500; ++n) {
    const Curve c = random_curve(rng);
    AxisVec low, high;
    curve_bounds(c, kAxes, &low, &high);
    AxisVec seen_low = c.start, seen_high = c.start;
    for (int i = 0; i <= 20000; ++i) {
      const AxisVec p = curve_position(c, c.length * i / 20000.0, kAxes);
      for (unsigned a = 0; a < kAxes; ++a) {
        seen_low[a] = std::min(seen_low[a], p[a]);
        seen_high[a] = std::max(seen_high[a], p[a]);
      }
    }
    for (unsigned a = 0; a < kAxes; ++a) {
      EXPECT_LE(low[a], seen_low[a] + 1e-9) << n;
      EXPECT_GE(high[a], seen_high[a] - 1e-9) << n;
      EXPECT_NEAR(low[a], seen_low[a], 1e-4 * (1 + c.length * 1e-2)) << n;
      EXPECT_NEAR(high[a], seen_high[a], 1e-4 * (1 + c.length * 1e-2)) << n;
    }
  }
}

TEST(Curve, FullCircleHasItsFourExtremes) {
  AxisVec at;
  at[0] = 13;
  at[1] = 5;
  Circle k;
  k.center[0] = 3;
  k.center[1] = 5;
  k.radius_start = k.radius_end = 10;
  k.sweep = 6.283185307179586;
  AxisVec low, high;
  curve_bounds(make_arc(at, at, 0, 1, k, 3, 0), 3, &low, &high);
  EXPECT_NEAR(low[0], -7, 1e-12);
  EXPECT_NEAR(high[0], 13, 1e-12);
  EXPECT_NEAR(low[1], -5, 1e-12);
  EXPECT_NEAR(high[1], 15, 1e-12);
}

TEST(Curve, RotaryAxesMakeTheLengthOnlyWhenAlone) {
  AxisVec a, b;
  b[3] = 30;
  b[4] = 40;
  EXPECT_DOUBLE_EQ(make_line(a, b, kAxes, kRotary).length, 50);
  b[0] = 2;
  EXPECT_DOUBLE_EQ(make_line(a, b, kAxes, kRotary).length, 2);
  EXPECT_EQ(make_line(a, a, kAxes, kRotary).length, 0);
}

}  // namespace
}  // namespace nc
