// SPDX-License-Identifier: Apache-2.0
// Solids that a probe touches: their distances, and the place at which a path enters them, compared with geometry.
#include "tools/lib/probe_solid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace nc::tools {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

ProbeShape box(Point3 low, Point3 high) {
  ProbeShape s;
  s.low = low, s.high = high;
  return s;
}
ProbeShape cylinder(int axis, Point3 center, double radius, double low = -kEndless, double high = kEndless) {
  ProbeShape s;
  s.kind = ProbeShape::Kind::kCylinder;
  s.axis = axis, s.center = center, s.radius = radius;
  s.low.fill(-kEndless), s.high.fill(kEndless);
  s.low[static_cast<size_t>(axis)] = low, s.high[static_cast<size_t>(axis)] = high;
  return s;
}
ProbeShape sphere(Point3 center, double radius) {
  ProbeShape s;
  s.kind = ProbeShape::Kind::kSphere;
  s.center = center, s.radius = radius;
  return s;
}
ProbeSolid solid(ProbeShape shape, double ball = 0.0) {
  ProbeSolid s;
  s.shape = shape;
  s.ball_radius = ball;
  return s;
}

/// The length of the path up to the place where the ball enters the solid; infinity if it does not.
double touch(const ProbeSolid& s, Point3 from, Point3 to) {
  const double none[8] = {};
  const double part = s.first_entry({from, to, none, none});
  return part * std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}

TEST(ProbeSolid, TheBallTouchesFacesEdgesAndCorners) {
  const ProbeSolid s = solid(box({0, 0, -20}, {100, 50, 0}), 3);
  EXPECT_NEAR(touch(s, {-20, 25, -10}, {50, 25, -10}), 17, 1e-9);   // face
  EXPECT_NEAR(touch(s, {50, 25, 30}, {50, 25, -10}), 27, 1e-9);     // from above
  // On the edge x = 0, z = 0 at half height of the ball: the ball is 3 away along the diagonal.
  const double h = 1.8;
  EXPECT_NEAR(touch(s, {-20, 25, h}, {20, 25, h}), 20 - std::sqrt(9 - h * h), 1e-9);
  // The corner.
  EXPECT_NEAR(touch(s, {-20, -1, 1}, {20, -1, 1}), 20 - std::sqrt(9 - 2), 1e-9);
  EXPECT_EQ(touch(s, {-20, -3.01, -10}, {120, -3.01, -10}), kEndless);  // passes beside
  EXPECT_EQ(touch(s, {-20, -3, -10}, {120, -3, -10}), kEndless);        // slides along
  EXPECT_EQ(touch(s, {-3, 25, -10}, {-30, 25, -10}), kEndless);         // leaves the surface
  EXPECT_EQ(touch(s, {-3, 25, -10}, {30, 25, -10}), 0);                 // goes in at once
  EXPECT_EQ(touch(s, {5, 25, -10}, {300, 25, -10}), 0);                 // is in
  EXPECT_NEAR(touch(s, {-20, 25, -10}, {-3, 25, -10}), 17, 1e-9);       // would go in where it ends
  EXPECT_EQ(touch(s, {-20, 25, -10}, {-3.001, 25, -10}), kEndless);
}

TEST(ProbeSolid, EndlessSidesOfABox) {
  const ProbeSolid s = solid(box({-kEndless, -kEndless, -kEndless}, {kEndless, kEndless, 0}), 2);
  EXPECT_NEAR(touch(s, {1000, -777, 10}, {1000, -777, -10}), 8, 1e-9);
  EXPECT_EQ(touch(s, {0, 0, 2}, {1000, 0, 2}), kEndless);
}

TEST(ProbeSolid, ABoreIsMeasuredFromInside) {
  ProbeSolid plate = solid(box({-100, -100, -20}, {100, 100, 0}), 3);
  plate.holes = {cylinder(2, {10, 20, 0}, 25)};
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    EXPECT_NEAR(touch(plate, {10, 20, -10}, {10 + 40 * c, 20 + 40 * s, -10}), 22, 1e-9) << degrees;
  }
  EXPECT_EQ(touch(plate, {10, 20, 50}, {10, 20, -60}), kEndless);  // through it
  EXPECT_NEAR(touch(plate, {60, 20, 50}, {60, 20, -60}), 47, 1e-9);
}

TEST(ProbeSolid, SpheresCylindersAndHalfSpaces) {
  EXPECT_NEAR(touch(solid(sphere({0, 0, 0}, 10), 3), {-50, 5, 0}, {50, 5, 0}), 50 - 12, 1e-9);  // 13, 12, 5
  EXPECT_NEAR(touch(solid(cylinder(2, {0, 0, 0}, 10, -30, 0), 3), {-50, 5, -15}, {50, 5, -15}), 50 - 12, 1e-9);
  EXPECT_NEAR(touch(solid(cylinder(0, {0, 0, 0}, 10), 3), {700, 0, 50}, {700, 0, -50}), 37, 1e-9);
  EXPECT_NEAR(touch(solid(cylinder(2, {0, 0, 0}, 10, -30, 0), 3), {0, 0, 20}, {0, 0, -20}), 17, 1e-9);  // its end
  ProbeSolid slope = solid(ProbeShape(), 3);
  slope.shape.kind = ProbeShape::Kind::kHalfSpace;
  slope.shape.normal = {-0.6, 0, 0.8};
  EXPECT_NEAR(touch(slope, {10, 0, 50}, {10, 0, -50}), 50 - (10 * 0.6 + 3) / 0.8, 1e-9);
}

TEST(ProbeSolid, TheCentreOfTheBallIsBesideTheControlledPoint) {
  ProbeSolid s = solid(box({0, 0, 0}, {10, 10, 10}), 2);
  s.ball_center = {0, 0, 2};  // the tool length ends at the tip of the ball
  EXPECT_NEAR(touch(s, {5, 5, 40}, {5, 5, 0}), 30, 1e-9);
}

/// A block on a table that has turned: the ball touches it where the rotation has brought it.
TEST(ProbeSolid, TurnsWithItsTable) {
  ProbeSolid s = solid(box({0, -5, -5}, {40, 5, 5}), 1);
  s.turns = {ProbeTurn{3, 2, {0, 0, 0}}};
  const auto x_touch = [&](double c, Point3 from, Point3 to) {
    const double angles[8] = {0, 0, 0, c};
    return s.first_entry({from, to, angles, angles}) * std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  };
  EXPECT_NEAR(x_touch(0, {100, 0, 0}, {0, 0, 0}), 59, 1e-9);
  // ISO 841: C90 turns the table by -90 degrees, so the end of the block points to -Y.
  EXPECT_NEAR(x_touch(90, {0, -100, 0}, {0, 0, 0}), 59, 1e-9);
  EXPECT_EQ(x_touch(90, {100, 20, 0}, {-100, 20, 0}), kEndless);
  EXPECT_NEAR(x_touch(450, {0, -100, 0}, {0, 0, 0}), 59, 1e-9);
  EXPECT_NEAR(x_touch(-90, {0, 100, 0}, {0, 0, 0}), 59, 1e-9);
  // A on the base, C on it: A90 turns the table by -90 degrees about X, so its top points to +Y.
  ProbeSolid two = solid(box({-10, -10, 0}, {10, 10, 30}), 0);
  two.turns = {ProbeTurn{3, 0, {0, 0, 0}}, ProbeTurn{4, 2, {0, 0, 0}}};
  const double angles[8] = {0, 0, 0, 90, 0};
  EXPECT_NEAR(two.first_entry({{0, 100, 0}, {0, -100, 0}, angles, angles}) * 200, 70, 1e-9);
}

/// The table turns while the probe stands: the block comes to it.
TEST(ProbeSolid, TheTableTurnsIntoTheProbe) {
  ProbeSolid s = solid(box({0, -5, -5}, {40, 5, 5}), 0);
  s.turns = {ProbeTurn{3, 2, {0, 0, 0}}};
  const double from[8] = {0, 0, 0, 0}, to[8] = {0, 0, 0, -90};
  const Point3 probe{0, 20, 0};  // the block turns by +90 degrees; its flank y = 5 arrives when asin(5/20) are left
  const double part = s.first_entry({probe, probe, from, to});
  EXPECT_NEAR(part * 90, 90 - std::asin(5.0 / 20) * 180 / M_PI, 1e-6);
  EXPECT_EQ(s.first_entry({probe, probe, from, from}), kEndless);
}

/// Any path is outside the solid up to the place of the touch, where the clearance is 0.
RC_GTEST_PROP(ProbeSolidProperty, TheWayIsFreeUpToTheTouch, ()) {
  const auto number = [] { return *rc::gen::inRange(-60000, 60000) * 0.001; };
  ProbeSolid s = solid(box({-20, -15, -10}, {20, 15, 10}), *rc::gen::inRange(0, 4000) * 0.001);
  const int kind = *rc::gen::inRange(0, 3);
  if (kind == 1) s.shape = sphere({3, -2, 1}, 17);
  if (kind == 2) s.shape = cylinder(*rc::gen::inRange(0, 3), {1, 2, 3}, 12, -25, 18);
  if (*rc::gen::arbitrary<bool>()) s.holes = {cylinder(2, {2, 1, 0}, 6)};
  if (*rc::gen::arbitrary<bool>()) s.turns = {ProbeTurn{3, *rc::gen::inRange(0, 3), {5, 0, -5}}};
  const Point3 from{number(), number(), number()}, to{number(), number(), number()};
  const double a[8] = {0, 0, 0, number()}, b[8] = {0, 0, 0, number()};
  const double part = s.first_entry({from, to, a, b});
  const auto clearance = [&](double t) {
    Point3 p;
    for (size_t i = 0; i < 3; ++i) p[i] = from[i] + t * (to[i] - from[i]);
    const double angle[8] = {0, 0, 0, a[3] + t * (b[3] - a[3])};
    return s.clearance(p, angle);
  };
  const bool found = part <= 1;
  for (int i = 0; i <= 400; ++i) {
    const double t = (found ? part : 1.0) * i / 400;
    if (clearance(0) >= 0) RC_ASSERT(clearance(t) > -2e-4);  // a chord of a millionth of the path may be missed
  }
  if (found && part > 0) RC_ASSERT(std::fabs(clearance(part)) < 1e-8);
  if (found && part == 0) RC_ASSERT(clearance(0) < 1e-8);
}

}  // namespace
}  // namespace nc::tools
