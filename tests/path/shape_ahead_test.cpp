// SPDX-License-Identifier: Apache-2.0
// The table of a curve that is made little by little is that which is made at once, to the last bit, and none is taken for another curve.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "path/shape_ahead.hpp"

namespace nc {
namespace {

constexpr unsigned kAxes = 3;

MoveShape span(double bulge) {
  MoveShape what;
  what.kind = ShapeKind::rational;
  what.span = {};
  const double points[4][3] = {{0, 0, 0}, {2, bulge, 0}, {4, -bulge, 1}, {6, 0, 0}};
  std::memcpy(what.span.point, points, sizeof points);
  for (unsigned k = 0; k < 4; ++k) what.span.weight[k] = k == 1 ? 0.7 : 1;
  for (uint8_t i = 0; i < 3; ++i) what.span.axis[i] = i;
  what.span.degree = 3;
  return what;
}

struct Made {
  CurveShape shape;
  Curve curve;
};

std::unique_ptr<Made> made(const MoveShape& what, const AxisVec& end, const ShapeAhead* ahead) {
  auto out = std::make_unique<Made>();
  const AxisVec start;
  make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, start, kAxes, 0, &out->shape, &out->curve, ahead);
  return out;
}

void expect_same(const Made& a, const Made& b) {
  EXPECT_EQ(a.curve.length, b.curve.length);
  for (unsigned k = 0; k <= 100; ++k) {
    const CurvePoint p = curve_evaluate(a.curve, a.curve.length * k / 100, kAxes), q = curve_evaluate(b.curve, b.curve.length * k / 100, kAxes);
    for (unsigned i = 0; i < kAxes; ++i) {
      EXPECT_EQ(p.position[i], q.position[i]);
      EXPECT_EQ(p.d3[i], q.d3[i]);
    }
  }
}

AxisVec at_six() {
  AxisVec end;
  end[0] = 6;
  return end;
}

TEST(ShapeAhead, InSlicesComesWhatComesAtOnce) {
  const AxisVec start, end = at_six();
  for (const double bulge : {0.5, 3.0, 40.0}) {
    const auto ahead = std::make_unique<ShapeAhead>();
    const MoveShape what = span(bulge);
    unsigned calls = 1;
    for (;; ++calls) {
      int64_t left = 20000;
      if (ahead->go_on(what, PlainMove{&start, &end, nullptr, 0, 1}, kAxes, 0, &left)) break;
      ASSERT_LT(calls, 10000u);
      EXPECT_LE(left, 0);
    }
    EXPECT_GT(calls, 5u) << "next to nothing was left to be made in slices";
    expect_same(*made(what, end, ahead.get()), *made(what, end, nullptr));
  }
}

TEST(ShapeAhead, AnotherCurveGetsItsOwnTable) {
  const AxisVec start, end = at_six();
  const auto ahead = std::make_unique<ShapeAhead>();
  int64_t left = INT64_MAX;
  ASSERT_TRUE(ahead->go_on(span(3), PlainMove{&start, &end, nullptr, 0, 1}, kAxes, 0, &left));
  expect_same(*made(span(1), end, ahead.get()), *made(span(1), end, nullptr));
  left = 20000;
  EXPECT_FALSE(ahead->go_on(span(2), PlainMove{&start, &end, nullptr, 0, 1}, kAxes, 0, &left));
  expect_same(*made(span(2), end, ahead.get()), *made(span(2), end, nullptr));  // half a table is none
}

TEST(ShapeAhead, TheEndNeedsNoTable) {
  const AxisVec start, end = at_six();
  const PlainMove move{&start, &end, nullptr, 0, 1};
  EXPECT_EQ(shaped_end(span(3), move, Affine{}, start, kAxes, 0), made(span(3), end, nullptr)->curve.end);
}

}  // namespace
}  // namespace nc
