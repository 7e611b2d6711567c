// SPDX-License-Identifier: Apache-2.0
// Curves that nearly have a cusp: the parameter at a length is exact there, too, and no point of them costs much more than any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "path/shape_base.hpp"

namespace nc::test {
namespace {

constexpr unsigned kAxes = 5;

/// A cubic whose derivative at its slowest place is `gap` / 10 of the mean; with 0 it has a cusp. `weight` is that of its second control point.
void make_cusp(double gap, double weight, CurveShape* shape, Curve* curve) {
  MoveShape what;
  what.kind = ShapeKind::rational;
  what.span = RationalSpan{{{0, 0, 0}, {10 + gap, 10, 1e-3 * gap}, {-gap, 10, 1e-3 * gap}, {10, 0, 0}}, {1, weight, 1, 1}, {0, 1, 2}, 3};
  AxisVec start, end;
  for (unsigned i = 0; i < 3; ++i) end[i] = what.span.point[3][i];
  make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, start, kAxes, 0, shape, curve);
}

constexpr double kGaps[] = {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 0};

TEST(Cusp, NoPointTakesMoreThanSomePartsOfTheLength) {
  for (const double gap : kGaps)
    for (const double weight : {1.0, 1.3}) {
      SCOPED_TRACE(testing::Message() << gap << " " << weight);
      CurveShape shape;
      Curve curve;
      make_cusp(gap, weight, &shape, &curve);
      const ParameterTable& t = shape.table;
      for (unsigned k = 0; k < ParameterTable::kSteps; ++k) {
        if (t.graded[k] == 0) {
          EXPECT_LE(t.newton[k] * t.panels[k], 4) << k;
          EXPECT_LE(t.newton[k], 2) << k;
          continue;
        }
        for (unsigned n = t.first[k]; n < unsigned{t.first[k]} + t.graded[k]; ++n) EXPECT_LE(t.effort[n], 12) << k;
      }
    }
}

/// The length between two parameters, as the sum of 20,000 chords at equal steps of the parameter.
double length_of(const CurveShape& shape, double from, double to) {
  constexpr int kParts = 20000;
  double sum = 0;
  AxisVec last = base_position(shape, from, kAxes);
  for (int n = 1; n <= kParts; ++n) {
    const AxisVec now = base_position(shape, from + (to - from) * n / kParts, kAxes);
    double d2 = 0;
    for (unsigned i = 0; i < kAxes; ++i) d2 += (now[i] - last[i]) * (now[i] - last[i]);
    sum += std::sqrt(d2);
    last = now;
  }
  return sum;
}

TEST(Cusp, TheParameterIsTheLengthsEverywhere) {
  for (const double gap : kGaps) {
    SCOPED_TRACE(gap);
    CurveShape shape;
    Curve curve;
    make_cusp(gap, 1, &shape, &curve);
    double before = 0, s_before = 0;
    for (int n = 1; n <= 200; ++n) {
      const double s = curve.length * n / 200, u = base_parameter(shape, s, kAxes);
      ASSERT_GT(u, before);
      // Chords are too short by the square of their length.
      ASSERT_NEAR(length_of(shape, before, u), s - s_before, 2e-7 * curve.length) << n;
      before = u, s_before = s;
    }
  }
}

/// The third difference of positions at steps of 1 um shows every error of the parameter.
TEST(Cusp, NothingStepsFromOneIntervalToTheNext) {
  for (const double gap : kGaps) {
    SCOPED_TRACE(gap);
    CurveShape shape;
    Curve curve;
    make_cusp(gap, 1, &shape, &curve);
    double most = 0, before = -1;
    for (double s = 0; s < curve.length; s += 1e-4) {
      const double u = base_parameter(shape, s, kAxes);
      if (before >= 0) {
        const AxisVec a = base_position(shape, before, kAxes), b = base_position(shape, u, kAxes);
        double d2 = 0;
        for (unsigned i = 0; i < kAxes; ++i) d2 += (a[i] - b[i]) * (a[i] - b[i]);
        most = std::max(most, std::sqrt(d2) - 1e-4);  // a chord is never longer than its arc
      }
      before = u;
    }
    EXPECT_LT(most, 1e-9);
  }
}

}  // namespace
}  // namespace nc::test
