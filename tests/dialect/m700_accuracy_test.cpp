// SPDX-License-Identifier: Apache-2.0
// The formulas of high-accuracy control, compared with values computed by hand (M700 13.15 to 13.18). The machine of the examples has
// #1206 = 10000 mm/min and #1207 = 100 ms, so dV = 100 mm/min per ms = 1666.67 mm/s^2.
#include "dialect/m700/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "interpolate/radius_share.hpp"

namespace nc::m700 {
namespace {

AccuracyParameters machine() {
  AccuracyParameters p;
  p.target_mm_min = 10000;
  p.time_ms = 100;
  p.corner_angle_deg = 10;
  return p;
}

TEST(M700Accuracy, AccelerationBeforeInterpolationHasOneSlope) {  // 13.15 "pre-interpolation" (1)
  const AccuracyParameters p = machine();
  EXPECT_DOUBLE_EQ(tolerable_step(p), 100);
  EXPECT_NEAR(tolerable_acceleration(p), 5000.0 / 3, 1e-9);
  EXPECT_DOUBLE_EQ(rise_time_ms(p, 10000), 100);
  EXPECT_DOUBLE_EQ(rise_time_ms(p, 5000), 50);  // half the speed, half the time
  // 6000 mm/min = 100 mm/s at 1666.67 mm/s^2: v^2 / 2a = 3 mm.
  EXPECT_NEAR(rise_length_mm(p, 6000), 3, 1e-12);
  EXPECT_EQ(tolerable_step(AccuracyParameters{}), 0);
}

TEST(M700Accuracy, AccelerationBehindInterpolationHasOneTime) {  // 13.15 "normal mode"
  EXPECT_DOUBLE_EQ(linear_rise(25, 100), 0.25);
  EXPECT_EQ(linear_rise(100, 100), 1);
  EXPECT_EQ(linear_rise(-1, 100), 0);
  EXPECT_NEAR(exponential_rise(50, 50), 0.6321205588, 1e-10);  // 1 - 1/e
  EXPECT_EQ(exponential_rise(1, 0), 1);
  // Ramp of 100 ms behind a lag of 50 ms, at 100 ms: 1 - (50/100)(1 - e^-2) = 0.567667642.
  EXPECT_NEAR(combined_rise(100, 100, 50), 0.5676676416, 1e-10);
  EXPECT_NEAR(combined_rise(2000, 100, 50), 1, 1e-12);
  EXPECT_DOUBLE_EQ(combined_rise(25, 100, 0), 0.25);
  EXPECT_NEAR(combined_rise(50, 0, 50), 0.6321205588, 1e-10);
  // 6000 mm/min = 0.1 mm/ms; half the ramp and the whole lag: 0.1 (50 + 30) = 8 mm.
  EXPECT_NEAR(smoothing_lag_mm(6000, 100, 30), 8, 1e-12);
}

TEST(M700Accuracy, LagIsTheAreaAboveTheRise) {
  for (const double linear : {0.0, 40.0, 100.0}) {
    for (const double lag : {0.0, 10.0, 35.0}) {
      double area = 0;
      constexpr double kStep = 0.01;
      for (double t = kStep / 2; t < 1500; t += kStep) area += (1 - combined_rise(t, linear, lag)) * kStep;
      EXPECT_NEAR(area * 6000 / 60000, smoothing_lag_mm(6000, linear, lag), 1e-3);
    }
  }
}

TEST(M700Accuracy, RadiusErrors) {  // 13.15 "path control in circular interpolation"
  // F 3000 = 50 mm/s, R 10, Ts 0.06 s, Tp 0.03 s: linear (0.0003 + 0.0009) 2500 / 20, exponential (0.0036 + 0.0009) 2500 / 20.
  const ServoLag lag{0.06, 0.03, 0.6};
  EXPECT_NEAR(radius_error_linear(3000, 10, lag), 0.15, 1e-12);
  EXPECT_NEAR(radius_error_exponential(3000, 10, lag), 0.5625, 1e-12);
  EXPECT_NEAR(radius_error_high_accuracy(3000, 10, lag), 0.0009 * 0.64 * 125, 1e-12);
  EXPECT_EQ(radius_error_high_accuracy(3000, 10, {0.06, 0.03, 1}), 0);  // (b): Kf = 1
}

TEST(M700Accuracy, LargestRadiusErrorIsThatAtTheClamp) {  // 13.15 "optimum speed control" (2)
  AccuracyParameters p = machine();
  const ServoLag lag{0, 0.03, 0.6};
  // 1/2 0.0009 0.64 1666.67 = 0.48 mm without a coefficient.
  EXPECT_NEAR(largest_radius_error(p, lag), 0.48, 1e-12);
  for (const double percent : {50.0, -20.0}) {
    p.radius_percent = percent;
    for (const double radius : {0.5, 7.0, 300.0})
      EXPECT_NEAR(radius_error_high_accuracy(arc_speed_clamp(p, radius), radius, lag), largest_radius_error(p, lag), 1e-12);
  }
}

TEST(M700Accuracy, EquivalentFeedForward) {  // 13.15 "feed forward" (2)
  EXPECT_DOUBLE_EQ(equivalent_feed_forward(50, 33, 47), 100);  // the braces are empty
  // fwd_g 0, PGN1 33 and 47: 100 sqrt(1 - (33/94)^2) = 93.6352.
  EXPECT_NEAR(equivalent_feed_forward(0, 33, 47), 93.6352, 1e-4);
}

TEST(M700Accuracy, CornerSpeed) {  // 13.15 "optimum speed control" (1)
  AccuracyParameters p = machine();
  // dV = 2 V sin(theta/2): 60 degrees gives V = dV, 90 degrees dV / sqrt 2, a reversal dV / 2.
  EXPECT_NEAR(corner_speed(p, 60), 100, 1e-9);
  EXPECT_NEAR(corner_speed(p, 90), 70.710678, 1e-6);
  EXPECT_NEAR(corner_speed(p, 180), 50, 1e-9);
  EXPECT_TRUE(std::isinf(corner_speed(p, 10)));  // #8020: no corner
  EXPECT_FALSE(std::isinf(corner_speed(p, 10.1)));
  p.radius_percent = 20;
  EXPECT_NEAR(corner_speed(p, 60), 80, 1e-9);
  p.radius_percent = -50;  // note 2
  EXPECT_NEAR(corner_speed(p, 60), 150, 1e-9);
  p.separate = true;
  p.corner_percent = 10;
  EXPECT_NEAR(corner_speed(p, 60), 90, 1e-9);
  EXPECT_TRUE(std::isinf(corner_speed(AccuracyParameters{}, 60)));
}

TEST(M700Accuracy, CornerSpeedIsNotBelowItsMinimum) {  // #2096
  const double direction[3] = {0.6, 0.8, 0};
  const double least[3] = {300, 200, 0};  // 300/0.6 = 500, 200/0.8 = 250
  EXPECT_DOUBLE_EQ(corner_speed_at_least(100, direction, least, 3), 250);
  EXPECT_DOUBLE_EQ(corner_speed_at_least(400, direction, least, 3), 400);  // the composite is below the optimum
  const double none[3] = {300, 0, 200};
  EXPECT_DOUBLE_EQ(corner_speed_at_least(100, direction, none, 3), 100);   // a moving axis without a setting
}

TEST(M700Accuracy, ArcSpeedClamp) {  // 13.15 "optimum speed control" (2)
  AccuracyParameters p = machine();
  EXPECT_TRUE(std::isinf(arc_speed_clamp(p, 1)));  // note 4
  p.radius_percent = 50;
  // sqrt(6 100 60000 0.5) = 4242.64; v^2 / R = 833.3 mm/s^2, half of the tolerable.
  EXPECT_NEAR(arc_speed_clamp(p, 6), 4242.640687, 1e-6);
  p.separate = true;  // note 5: #8023, not set
  EXPECT_TRUE(std::isinf(arc_speed_clamp(p, 6)));
  p.curve_percent = -20;
  EXPECT_NEAR(arc_speed_clamp(p, 5), 6000, 1e-9);  // sqrt(5 100 60000 1.2)
}

TEST(M700Accuracy, SplineAndAccelerationClamps) {  // 13.18 (3); 13.17.1 (2)
  AccuracyParameters p = machine();
  EXPECT_NEAR(spline_speed_clamp(p, 6), 6000, 1e-9);  // clamps without a coefficient, too
  p.radius_percent = 75;
  EXPECT_NEAR(spline_speed_clamp(p, 6), 3000, 1e-9);
  // Blocks of 1 mm round a circle of 100 mm turn by 2 asin(1/200): the speed is that of the arc, sqrt(a R) = 408.248 mm/s.
  const double theta = 2 * std::asin(0.005) * 180 / 3.14159265358979323846;
  EXPECT_NEAR(acceleration_clamp(machine(), theta, 1, 1), std::sqrt(5000.0 / 3 * 100) * 60, 1e-6);
  EXPECT_TRUE(std::isinf(acceleration_clamp(machine(), 0, 1, 1)));
}

/// The parts of the parameters that moves carry give the same speeds at joints as the parameters themselves.
TEST(M700Accuracy, JointOfMoves) {
  AccuracyParameters p = machine();
  p.radius_percent = 20;
  p.arc_joint_mm_min = 80;
  p.acceleration_clamp = true;
  AccuracyMove move;
  move.axis_count = 2;
  move.fine_segments = true;
  AccuracyLimits limits = accuracy_limits(p, move);
  EXPECT_TRUE(limits.ask_of_joint());
  AccuracyJoint joint;
  joint.length_before_mm = 1;
  joint.length_behind_mm = 3;
  for (const double theta : {5.0, 12.0, 60.0, 90.0, 170.0}) {
    joint.turn = 2 * std::sin(theta * M_PI / 360);
    joint.both_lines = joint.arc_ends = false;
    const double corner = corner_speed(p, theta), clamp = acceleration_clamp(p, theta, 1, 3);
    const double between = 60 * joint_speed(limits, limits, joint);
    EXPECT_EQ(std::isinf(between), std::isinf(corner));
    if (!std::isinf(corner)) {
      EXPECT_NEAR(between, corner, 1e-5 * corner) << theta;
    }
    joint.both_lines = true;
    EXPECT_NEAR(60 * joint_speed(limits, limits, joint), std::min(corner, clamp), 1e-5 * clamp) << theta;
    joint.both_lines = false;
    joint.arc_ends = true;
    EXPECT_NEAR(60 * joint_speed(limits, limits, joint), arc_joint_speed(p, theta), 1e-5 * 80) << theta;
  }
  EXPECT_FALSE(AccuracyLimits{}.ask_of_joint());
  EXPECT_TRUE(std::isinf(joint_speed({}, {}, joint)));
}

TEST(M700Accuracy, ArcEntranceAndExit) {  // 13.15 "arc entrance/exit"
  AccuracyParameters p = machine();
  EXPECT_TRUE(std::isinf(arc_joint_speed(p, 0)));
  p.arc_joint_mm_min = 80;
  EXPECT_DOUBLE_EQ(arc_joint_speed(p, 0), 80);             // example 1: tangential
  EXPECT_NEAR(arc_joint_speed(p, 90), 70.710678, 1e-6);    // example 2: the corner is slower
  EXPECT_DOUBLE_EQ(mode_clamp(0, 8000), 8000);
  EXPECT_DOUBLE_EQ(mode_clamp(3000, 8000), 3000);
}

TEST(M700Accuracy, PathClampIsThatOfTheFirstAxis) {  // #2109, #2110
  const double clamp[3] = {3000, 2000, 0}, direction[3] = {0.6, -0.8, 0};
  EXPECT_DOUBLE_EQ(path_clamp(clamp, direction, 3), 2500);  // 3000/0.6 = 5000, 2000/0.8 = 2500
  const double none[3] = {0, 0, 0};
  EXPECT_TRUE(std::isinf(path_clamp(none, direction, 3)));
}

TEST(M700Accuracy, RadiusCompensationGrowsAndFalls) {  // #8107, #8108, #2069
  EXPECT_DOUBLE_EQ(radius_compensation_share(0, 360), 0);
  EXPECT_DOUBLE_EQ(radius_compensation_share(45, 360), 0.5);
  EXPECT_DOUBLE_EQ(radius_compensation_share(180, 360), 1);
  EXPECT_DOUBLE_EQ(radius_compensation_share(337.5, 360), 0.25);
  EXPECT_DOUBLE_EQ(radius_compensation_share(60, 120), 60.0 / 90);  // an arc that is too short for the full compensation
  EXPECT_NEAR(radius_compensation(0.01, 0.5, 60), 0.0025, 1e-12);
}

TEST(M700Accuracy, SFilters) {  // #1568 to #1570
  EXPECT_DOUBLE_EQ(s_filter(25, 100, 0), 0.25);
  EXPECT_DOUBLE_EQ(s_filter(25, 0, 100), 0.25);
  EXPECT_NEAR(s_filter(50, 100, 50), 0.25, 1e-12);  // mean of 0 ... 0.5
  EXPECT_NEAR(s_filter(150, 100, 50), 1, 1e-12);
  EXPECT_NEAR(s_filter(125, 100, 50), 1 - 0.5 * 0.25 * 0.5, 1e-12);
  EXPECT_TRUE(s_filter_valid(200));
  EXPECT_FALSE(s_filter_valid(201));
}

}  // namespace
}  // namespace nc::m700
