// SPDX-License-Identifier: Apache-2.0
#include "dialect/m700/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nc::m700 {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kMsPerMinute = 60.0 * 1000.0;

/// The part of a speed or an error that an accuracy coefficient leaves.
double remaining(double percent) { return std::max(0.0, (100 - percent) / 100); }

}  // namespace

// M700 13.15 "pre-interpolation acceleration/deceleration" (1)

double tolerable_step(const AccuracyParameters& p) { return p.time_ms > 0 ? p.target_mm_min / p.time_ms : 0; }

double tolerable_acceleration(const AccuracyParameters& p) { return tolerable_step(p) * 1000 / 60; }

double rise_time_ms(const AccuracyParameters& p, double speed_mm_min) {
  const double step = tolerable_step(p);
  return step > 0 ? speed_mm_min / step : 0;
}

double rise_length_mm(const AccuracyParameters& p, double speed_mm_min) {
  return 0.5 * speed_mm_min * rise_time_ms(p, speed_mm_min) / kMsPerMinute;
}

double linear_rise(double t, double g1tl) {
  if (!(t > 0)) return 0;
  return t >= g1tl ? 1 : t / g1tl;
}

double exponential_rise(double t, double g1t1) {
  if (!(t > 0)) return 0;
  return g1t1 > 0 ? -std::expm1(-t / g1t1) : 1;
}

double combined_rise(double t, double g1tl, double g1t1) {
  if (!(g1tl > 0)) return exponential_rise(t, g1t1);
  if (!(g1t1 > 0) || !(t > 0)) return linear_rise(t, g1tl);
  // A ramp through a lag of first order: 1/T times the integral of 1 - e^(-t/tau) over the time that the ramp has lasted.
  const auto area = [g1t1](double x) { return x > 0 ? x + g1t1 * std::expm1(-x / g1t1) : 0; };
  return (area(t) - area(t - g1tl)) / g1tl;
}

double smoothing_lag_mm(double speed_mm_min, double g1tl, double g1t1) { return speed_mm_min * (0.5 * g1tl + g1t1) / kMsPerMinute; }

// M700 13.15 "path control in circular interpolation"

double radius_error_linear(double feed, double radius, const ServoLag& lag) {
  const double v = feed / 60;
  return (lag.filter_s * lag.filter_s / 12 + lag.loop_s * lag.loop_s) * v * v / (2 * radius);
}

double radius_error_exponential(double feed, double radius, const ServoLag& lag) {
  const double v = feed / 60;
  return (lag.filter_s * lag.filter_s + lag.loop_s * lag.loop_s) * v * v / (2 * radius);
}

double radius_error_high_accuracy(double feed, double radius, const ServoLag& lag) {
  const double v = feed / 60;
  return lag.loop_s * lag.loop_s * (1 - lag.feed_forward * lag.feed_forward) * v * v / (2 * radius);
}

double largest_radius_error(const AccuracyParameters& p, const ServoLag& lag) {
  const double whole = 0.5 * lag.loop_s * lag.loop_s * (1 - lag.feed_forward * lag.feed_forward) * tolerable_acceleration(p);
  return whole * remaining(p.curve_coefficient());
}

double equivalent_feed_forward(double fwd_g, double conventional, double shg) {
  const double ratio = conventional / (2 * shg), half = fwd_g / 50;
  return 100 * std::sqrt(std::max(0.0, 1 - (1 - half * half) * ratio * ratio));
}

// M700 13.15 "optimum speed control"

double corner_speed(const AccuracyParameters& p, double theta_deg) {
  const double step = tolerable_step(p), theta = std::fabs(theta_deg);
  if (!(step > 0) || theta <= p.corner_angle_deg) return kInfinite;
  // Two equal speeds that enclose the angle theta are two sides of a triangle; dV is its third side.
  const double optimum = step / (2 * std::sin(0.5 * theta * kDegree));
  return optimum * remaining(p.corner_coefficient());
}

double corner_speed_at_least(double optimum, const double* direction, const double* least, unsigned axes) {
  double composite = kInfinite;
  for (unsigned i = 0; i < axes; ++i) {
    if (direction[i] == 0) continue;
    if (!(least[i] > 0)) return optimum;
    composite = std::min(composite, least[i] / std::fabs(direction[i]));
  }
  return composite < kInfinite ? std::max(optimum, composite) : optimum;
}

double arc_speed_clamp(const AccuracyParameters& p, double radius) {
  const double coefficient = p.curve_coefficient(), step = tolerable_step(p);
  if (coefficient == 0 || !(step > 0)) return kInfinite;
  // F' = sqrt(R dV 60 1000). The error dR grows with the square of the speed, so that for dR' = dR (100 - Ks)/100 the speed is multiplied by
  // the root of (100 - Ks)/100.
  return std::sqrt(radius * step * kMsPerMinute * remaining(coefficient));
}

double spline_speed_clamp(const AccuracyParameters& p, double radius) {
  const double step = tolerable_step(p);
  return step > 0 ? std::sqrt(radius * step * kMsPerMinute * remaining(p.radius_percent)) : kInfinite;
}

double acceleration_clamp(const AccuracyParameters& p, double theta_deg, double before, double behind) {
  const double a = tolerable_acceleration(p), turn = 2 * std::sin(0.5 * std::fabs(theta_deg) * kDegree);
  if (!(a > 0) || !(turn > 0)) return kInfinite;
  // The direction changes by `turn` in the time in which the mean length of the two blocks is passed: a = v turn / (mean / v).
  return std::sqrt(a * 0.5 * (before + behind) / turn) * 60;
}

double arc_joint_speed(const AccuracyParameters& p, double theta_deg) {
  const double corner = corner_speed(p, theta_deg);
  return p.arc_joint_mm_min > 0 ? std::min(corner, p.arc_joint_mm_min) : corner;
}

double mode_clamp(double high_precision, double normal) { return high_precision > 0 ? high_precision : normal; }

double path_clamp(const double* clamp, const double* direction, unsigned axes) {
  double speed = kInfinite;
  for (unsigned i = 0; i < axes; ++i)
    if (clamp[i] > 0 && direction[i] != 0) speed = std::min(speed, clamp[i] / std::fabs(direction[i]));
  return speed;
}

AccuracyLimits accuracy_limits(const AccuracyParameters& p, const AccuracyMove& move) {
  AccuracyLimits limits;
  double clamp = path_clamp(move.rapid ? p.rapid_mm_min : p.clamp_mm_min, move.share.v, move.axis_count);
  if (move.circular) clamp = std::fmin(clamp, arc_speed_clamp(p, move.radius_mm));
  if (move.speed_clamp_mm_s > 0) clamp = std::fmin(clamp, 60 * move.speed_clamp_mm_s);
  if (clamp < kInfinite) limits.speed_clamp = static_cast<float>(clamp / 60);
  if (move.rapid) return limits;
  limits.acceleration = static_cast<float>(tolerable_acceleration(p));
  const double step = tolerable_step(p) * (100 - p.corner_coefficient()) / 100;
  if (step > 0) {
    limits.corner_step = static_cast<float>(step / 60);
    limits.smooth_cos = static_cast<float>(std::cos(p.corner_angle_deg * std::numbers::pi / 180));
    limits.corner_least = static_cast<float>(corner_speed_at_least(0, move.share.v, p.corner_least_mm_min, move.axis_count) / 60);
    limits.judged_turn = move.judged_turn;
  }
  limits.arc_joint = static_cast<float>(p.arc_joint_mm_min / 60);
  if (move.fine_segments && p.acceleration_clamp) limits.bend_acceleration = static_cast<float>(tolerable_acceleration(p));
  return limits;
}

double joint_speed(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint) {
  double v = kInfinite;
  const double step = static_cast<double>(behind.corner_step), smooth = static_cast<double>(behind.smooth_cos);
  const double judged = behind.judged_turn < 0.0f ? joint.turn : static_cast<double>(behind.judged_turn);  // 13.17.1 (3)
  if (step > 0 && 1 - 0.5 * judged * judged < smooth) {
    v = step / judged;
    const float least = std::min(before.corner_least, behind.corner_least);  // #2096, not 0 only if every moving axis has a setting
    v = std::max(v, static_cast<double>(least));
  }
  // 13.17.1 (2): the direction turns in the time in which the mean length of the two lines is passed.
  const double bend = static_cast<double>(behind.bend_acceleration);
  if (bend > 0 && joint.turn > 0 && joint.both_lines)
    v = std::min(v, std::sqrt(0.5 * bend * (joint.length_before_mm + joint.length_behind_mm) / joint.turn));
  const double arc_joint = static_cast<double>(behind.arc_joint);
  if (arc_joint > 0 && joint.arc_ends) v = std::min(v, arc_joint);  // 13.15 "arc entrance/exit"
  return v;
}

// M700 13.15 "circular error radius compensation control for each axis"

double radius_compensation(double coefficient, double share, double phi_deg) { return coefficient * share * std::cos(phi_deg * kDegree); }

// M700 13.15 "S-pattern filter control"

double s_filter(double t, double first, double second) {
  if (!(second > 0)) return linear_rise(t, first);
  if (!(first > 0)) return linear_rise(t, second);
  // The mean of a ramp over a window. The integral of the ramp is x^2 / (2 first) up to its end and a straight line behind it.
  const auto area = [first](double x) { return x <= 0 ? 0 : x < first ? x * x / (2 * first) : x - 0.5 * first; };
  return (area(t) - area(t - second)) / second;
}

}  // namespace nc::m700
