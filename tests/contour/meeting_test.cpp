// SPDX-License-Identifier: Apache-2.0
// Where two blocks meet of which the first has no end (M700 13.9): each form against the conditions that it has to fulfil, over random cases.
#include "contour/meeting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace nc {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNear = 1e-7;

class Meetings : public testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  PlanePoint point(double size) { return {number(-size, size), number(-size, size)}; }
  bool coin() { return random_() % 2 == 0; }
  std::mt19937 random_{20240611};
};

double distance(PlanePoint a, PlanePoint b) { return std::hypot(a.h - b.h, a.v - b.v); }

double off_line(const SlopedLine& line, PlanePoint at) {
  const double angle = line.angle_deg * kPi / 180;
  return std::fabs(std::cos(angle) * (at.v - line.through.v) - std::sin(angle) * (at.h - line.through.h));
}

/// Direction of travel of an arc at a point of its circle.
PlanePoint tangent(PlanePoint center, PlanePoint at, bool ccw) {
  const double r = distance(center, at), sign = ccw ? 1 : -1;
  return {-sign * (at.v - center.v) / r, sign * (at.h - center.h) / r};
}

TEST_F(Meetings, LinesMeetOnBoth) {
  unsigned met = 0;
  for (unsigned i = 0; i < 20000; ++i) {
    const SlopedLine first{point(100), number(-720, 720)}, second{point(100), number(-720, 720)};
    const Meeting meeting = meet_lines(first, second);
    const double apart = std::fabs(std::remainder(first.angle_deg - second.angle_deg, 180));
    EXPECT_EQ(meeting.bad == Condition::geometric_parallel, apart <= 1) << apart;
    if (meeting.bad != Condition::none) continue;
    ++met;
    const double scale = 1 + distance(meeting.at, first.through) + distance(meeting.at, second.through);
    EXPECT_LT(off_line(first, meeting.at), 1e-11 * scale);
    EXPECT_LT(off_line(second, meeting.at), 1e-11 * scale);
  }
  EXPECT_GT(met, 19000u);
}

TEST_F(Meetings, OneDegreeIsParallelAndABitMoreIsNot) {
  EXPECT_EQ(meet_lines({{0, 0}, 10}, {{5, 5}, 11}).bad, Condition::geometric_parallel);
  EXPECT_EQ(meet_lines({{0, 0}, 10}, {{5, 5}, 191}).bad, Condition::geometric_parallel);
  EXPECT_EQ(meet_lines({{0, 0}, 10}, {{5, 5}, 11.001}).bad, Condition::none);
  EXPECT_EQ(meet_lines({{0, 0}, 179.5}, {{5, 5}, -0.4}).bad, Condition::geometric_parallel);
}

TEST_F(Meetings, QuartersOfATurnAreExact) {
  const Meeting meeting = meet_lines({{0.1, 0.3}, 90}, {{70, 40.7}, 180});
  EXPECT_EQ(meeting.at.h, 0.1);
  EXPECT_EQ(meeting.at.v, 40.7);
}

TEST_F(Meetings, LineAndCircleCrossInTheNearerOrTheFartherPoint) {
  unsigned crossed = 0;
  for (unsigned i = 0; i < 20000; ++i) {
    const SlopedLine line{point(50), number(-360, 360)};
    const KnownCircle circle{point(50), coin(), false, 0, point(50)};
    const double radius = distance(circle.on, circle.center), away = off_line(line, circle.center);
    const Meeting near = meet_line_and_circle(line, circle, false), far = meet_line_and_circle(line, circle, true);
    EXPECT_EQ(near.bad == Condition::none, away <= radius + 1e-6) << away - radius;
    if (near.bad != Condition::none) continue;
    ++crossed;
    for (const Meeting& meeting : {near, far}) {
      EXPECT_LT(off_line(line, meeting.at), kNear);
      EXPECT_NEAR(distance(meeting.at, circle.center), std::fmax(radius, away), kNear);
    }
    EXPECT_LE(distance(near.at, line.through), distance(far.at, line.through) + kNear);
  }
  EXPECT_GT(crossed, 5000u);
}

TEST_F(Meetings, AnArcOfARadiusTouchesTheLineInTheSenseOfTravel) {
  unsigned touched[2] = {0, 0};
  for (unsigned i = 0; i < 20000; ++i) {
    const bool arc_first = coin(), longer = number(0, 1) < 0.3;
    const SlopedLine line{point(50), number(-360, 360)};
    const KnownCircle circle{point(50), coin(), true, (longer ? -1 : 1) * number(0.5, 80), {}};
    const Meeting meeting = touch_line_and_circle(line, circle, arc_first);
    if (meeting.bad != Condition::none) continue;
    ++touched[arc_first ? 1 : 0];
    const double radius = std::fabs(circle.radius);
    EXPECT_NEAR(distance(meeting.center, circle.on), radius, 1e-5);
    EXPECT_NEAR(distance(meeting.center, meeting.at), radius, kNear);
    EXPECT_NEAR(off_line(line, meeting.center), radius, kNear);
    EXPECT_LT(off_line(line, meeting.at), kNear);
    // The line goes on as the arc does where they touch.
    const PlanePoint u = tangent(meeting.center, meeting.at, circle.ccw);
    const PlanePoint way = arc_first ? PlanePoint{line.through.h - meeting.at.h, line.through.v - meeting.at.v}
                                     : PlanePoint{meeting.at.h - line.through.h, meeting.at.v - line.through.v};
    EXPECT_GT(u.h * way.h + u.v * way.v, -kNear);
    const PlanePoint from = arc_first ? circle.on : meeting.at, to = arc_first ? meeting.at : circle.on;
    const double sweep = std::fabs(part_of_circle(from, to, meeting.center, circle.ccw).sweep);
    EXPECT_TRUE(longer ? sweep > kPi - 1e-6 : sweep < kPi + 1e-6) << sweep;
  }
  EXPECT_GT(touched[0], 2000u);
  EXPECT_GT(touched[1], 2000u);
}

TEST_F(Meetings, CirclesTouchOnBothAndGoOnInOneDirection) {
  unsigned touched = 0;
  for (unsigned i = 0; i < 20000; ++i) {
    const bool first_by_radius = coin();
    KnownCircle centred{point(50), coin(), false, 0, point(50)}, other{point(80), coin(), true, number(0.5, 60), {}};
    const Meeting meeting = first_by_radius ? touch_circles(other, centred, 0.01) : touch_circles(centred, other, 0.01);
    if (meeting.bad != Condition::none) continue;
    ++touched;
    EXPECT_NEAR(distance(meeting.at, centred.center), distance(centred.on, centred.center), kNear);
    EXPECT_NEAR(distance(meeting.at, meeting.center), other.radius, kNear);
    EXPECT_NEAR(distance(other.on, meeting.center), other.radius, 1e-5);
    const PlanePoint a = tangent(centred.center, meeting.at, centred.ccw), b = tangent(meeting.center, meeting.at, other.ccw);
    EXPECT_NEAR(a.h * b.h + a.v * b.v, 1, 1e-9);  // one direction: neither a corner nor a way back
  }
  EXPECT_GT(touched, 2000u);
}

TEST_F(Meetings, CirclesByTheirCentresHaveToTouch) {
  const KnownCircle first{{-10, 0}, false, false, 0, {0, 0}}, second{{40, 0}, true, false, 0, {25, 0}};
  const Meeting meeting = touch_circles(first, second, 0.01);
  EXPECT_EQ(meeting.bad, Condition::none);
  EXPECT_NEAR(meeting.at.h, 10, 1e-12);
  EXPECT_NEAR(meeting.at.v, 0, 1e-12);
  KnownCircle apart = second;
  apart.center.h = 25.1;
  EXPECT_EQ(touch_circles(first, apart, 0.01).bad, Condition::geometric_contact);
  EXPECT_EQ(touch_circles(first, first, 0.01).bad, Condition::geometric_contact);
}

TEST_F(Meetings, TheCentreOfARadius) {
  for (unsigned i = 0; i < 10000; ++i) {
    const PlanePoint start = point(20), end = point(20);
    const double radius = (coin() ? 1 : -1) * (distance(start, end) / 2 + number(0.001, 30));
    const bool ccw = coin();
    const PlanePoint center = center_of_radius(start, end, radius, ccw);
    EXPECT_NEAR(distance(center, start), std::fabs(radius), 1e-8);
    EXPECT_NEAR(distance(center, end), std::fabs(radius), 1e-8);
    EXPECT_EQ(std::fabs(part_of_circle(start, end, center, ccw).sweep) < kPi, radius > 0);
  }
}

}  // namespace
}  // namespace nc
