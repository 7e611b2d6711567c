// SPDX-License-Identifier: Apache-2.0
// What high-accuracy control does to the limits of segments and joints (M700 13.15, 13.17.1).
#include <gtest/gtest.h>

#include <cmath>

#include "dialect/dialect.hpp"
#include "motion/limits.hpp"

namespace nc {
namespace {

MotionLimits fast_machine() {
  MotionLimits limits;
  limits.axis_count = 2;
  for (unsigned i = 0; i < 2; ++i) limits.axis[i] = AxisLimits{1000, 1000, 50000, 0, 0};
  limits.accuracy_joint_speed = dialect(NC_DIALECT_M700).rules.motion.accuracy_joint_speed;
  return limits;
}

Segment line(double x, double y) {
  Segment s;
  AxisVec end;
  end[0] = x;
  end[1] = y;
  s.curve = make_line(AxisVec{}, end, 2, 0);
  s.feed_mm_s = 200;
  return s;
}

Segment half_circle(double radius) {
  Segment s;
  AxisVec end;
  end[0] = 2 * radius;
  Circle c;
  c.center[0] = radius;
  c.radius_start = c.radius_end = radius;
  c.angle_start = M_PI;
  c.sweep = M_PI;
  s.curve = make_arc(AxisVec{}, end, 0, 1, c, 2, 0);
  s.feed_mm_s = 200;
  return s;
}

double joint_speed(const Segment& a, const Segment& b) {
  const MotionLimits limits = fast_machine();
  return std::sqrt(joint_between(a, shape_of(a, limits), b, shape_of(b, limits), limits).speed2);
}

/// A line at 20 degrees to X, for after one along X: as far as the axes are concerned this corner can be passed at speed.
Segment turned() { return line(50 * std::cos(M_PI / 9), 50 * std::sin(M_PI / 9)); }
const double kTurn = 2 * std::sin(M_PI / 18);

TEST(M700Limits, CornerStepClampsTheJoint) {
  const Segment a = line(50, 0);
  Segment b = turned();
  const double free_speed = joint_speed(a, b);
  b.accuracy.corner_step = 2;
  b.accuracy.smooth_cos = std::cos(10 * static_cast<float>(M_PI) / 180);
  EXPECT_NEAR(joint_speed(a, b), 2 / kTurn, 1e-6);
  EXPECT_GT(free_speed, joint_speed(a, b));
  Segment nearly = line(50, 50 * std::tan(8 * M_PI / 180));  // below #8020
  const double smooth = joint_speed(a, nearly);
  nearly.accuracy = b.accuracy;
  EXPECT_EQ(joint_speed(a, nearly), smooth);
}

TEST(M700Limits, AJudgedCornerCountsInsteadOfTheRealOne) {  // 13.17.1 (3)
  const Segment a = line(50, 0);
  Segment b = turned();
  const double free_speed = joint_speed(a, b);
  b.accuracy.corner_step = 2;
  b.accuracy.smooth_cos = std::cos(10 * static_cast<float>(M_PI) / 180);
  b.accuracy.judged_turn = std::sqrt(2.0f);  // a right angle
  EXPECT_NEAR(joint_speed(a, b), 1.414213562, 1e-6);  // 2 / (2 sin 45)
  b.accuracy.judged_turn = 1;  // 60 degrees
  EXPECT_NEAR(joint_speed(a, b), 2, 1e-6);
  for (const float turn : {0.0f, 0.17f}) {  // straight on, and 9.8 degrees
    b.accuracy.judged_turn = turn;
    EXPECT_EQ(joint_speed(a, b), free_speed);
  }
  // However a corner is judged, the axes limit its speed.
  Segment back = line(0, 50);
  const double limit = joint_speed(a, back);
  back.accuracy = b.accuracy;
  back.accuracy.judged_turn = 0;
  EXPECT_EQ(joint_speed(a, back), limit);
}

TEST(M700Limits, CornerMinimumNeedsBothSides) {  // #2096
  Segment a = line(50, 0), b = turned();
  b.accuracy.corner_step = 2;
  b.accuracy.smooth_cos = 1;
  b.accuracy.corner_least = 9;
  EXPECT_NEAR(joint_speed(a, b), 2 / kTurn, 1e-6);
  a.accuracy.corner_least = 8;
  EXPECT_NEAR(joint_speed(a, b), 8, 1e-6);
}

TEST(M700Limits, ArcEntranceAndExit) {  // #1209
  Segment a = line(0, 50), b = half_circle(10);
  b.curve.circle.sweep = -M_PI;  // clockwise: it begins upwards, as the line ends
  EXPECT_GT(joint_speed(a, b), 100);
  b.accuracy.arc_joint = 30;
  EXPECT_NEAR(joint_speed(a, b), 30, 1e-6);
}

TEST(M700Limits, AFamilyWithoutTheRuleAsksNothing) {
  MotionLimits limits = fast_machine();
  limits.accuracy_joint_speed = dialect(NC_DIALECT_DGSHAPE).rules.motion.accuracy_joint_speed;
  const Segment a = line(50, 0);
  Segment b = turned();
  const double free_speed = joint_speed(a, b);
  b.accuracy.bend_acceleration = 5;
  EXPECT_LT(joint_speed(a, b), free_speed);
  EXPECT_EQ(std::sqrt(joint_between(a, shape_of(a, limits), b, shape_of(b, limits), limits).speed2), free_speed);
}

TEST(M700Limits, SpeedClampIsTheSegmentsLimit) {
  const MotionLimits limits = fast_machine();
  Segment s = half_circle(10);
  set_segment_limits(s, shape_of(s, limits), {}, limits);
  EXPECT_GT(s.speed_limit, 100);
  s.accuracy.speed_clamp = 70;
  set_segment_limits(s, shape_of(s, limits), {}, limits);
  EXPECT_DOUBLE_EQ(s.speed_limit, 70);
  EXPECT_DOUBLE_EQ(shape_of(s, limits).reach, 70);
}

TEST(M700Limits, AccelerationClampIsThatOfTheCurve) {  // 13.17.1 (2): 1 mm chords of a circle of 20 mm at 500 mm/s^2: 100 mm/s
  const double half = std::asin(1 / 40.0);
  const Segment a = line(std::cos(half), -std::sin(half));
  Segment b = line(std::cos(half), std::sin(half));
  const double free_speed = joint_speed(a, b);
  b.accuracy.bend_acceleration = 500;
  EXPECT_NEAR(joint_speed(a, b), std::min(free_speed, 100.0), 1e-6);
  b.accuracy.bend_acceleration = 5;
  EXPECT_NEAR(joint_speed(a, b), 10, 1e-6);
}

}  // namespace
}  // namespace nc
