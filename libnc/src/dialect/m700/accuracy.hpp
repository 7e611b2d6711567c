// SPDX-License-Identifier: Apache-2.0
// The formulas of the M700's high-accuracy control (13.15 to 13.18) as functions without state: what speed a corner, an arc, a curve
// may be passed at, how far a filter or a servo pulls a circle in, how long an acceleration takes. Units are in the names; mm/min and
// ms where the manual has them, so that its numbers can be put in as they stand.
#pragma once

#include "dialect/accuracy.hpp"
#include "ring/accuracy_limits.hpp"

namespace nc::m700 {

// ---- acceleration before interpolation: one slope for all axes (13.15 "pre-interpolation acceleration") -------------

/// dV = G1bF / G1btL, mm/min per ms; 0 where it is not set.
double tolerable_step(const AccuracyParameters& p);
/// The same as an acceleration, mm/s^2.
double tolerable_acceleration(const AccuracyParameters& p);
/// Time from rest to a speed, ms: shorter for a lower speed.
double rise_time_ms(const AccuracyParameters& p, double speed_mm_min);
/// Way from rest to a speed, mm.
double rise_length_mm(const AccuracyParameters& p, double speed_mm_min);

// ---- acceleration after interpolation: a time constant for each axis (13.15 (1), normal mode) ----------------------

/// Share of the commanded speed `t` after a step of the command, with #2007 G1tL.
double linear_rise(double t_ms, double g1tl_ms);
/// With #2008 G1t1.
double exponential_rise(double t_ms, double g1t1_ms);
/// With one behind the other; a time constant of 0 is none.
double combined_rise(double t_ms, double g1tl_ms, double g1t1_ms);
/// What the axis is behind its command at constant speed, mm: the area above the rise.
double smoothing_lag_mm(double speed_mm_min, double g1tl_ms, double g1t1_ms);

// ---- how far a circle comes out too small (13.15 (2)) ---------------------------------------------------------------

/// Time constant of the filter behind interpolation and of the position loop, s; feed forward as fwd_g / 100.
struct ServoLag {
  double filter_s = 0, loop_s = 0, feed_forward = 0;
};
double radius_error_linear(double feed_mm_min, double radius_mm, const ServoLag& lag);
double radius_error_exponential(double feed_mm_min, double radius_mm, const ServoLag& lag);
double radius_error_high_accuracy(double feed_mm_min, double radius_mm, const ServoLag& lag);
/// The largest radius error of high-accuracy control, whatever the feed and the radius: the arc clamp makes it so.
double largest_radius_error(const AccuracyParameters& p, const ServoLag& lag);
/// fwd_g that makes the feed forward of a loop with smooth high gain whole, percent (13.15 "feed forward").
double equivalent_feed_forward(double fwd_g_percent, double pgn1_conventional, double pgn1_shg);

// ---- speeds ---------------------------------------------------------------------------------------------------------

/// Optimum corner deceleration: highest speed at a corner of the outside angle `theta` between straight ways, mm/min; infinite where
/// nothing is to be slowed down (13.15 "optimum speed control" (1)).
double corner_speed(const AccuracyParameters& p, double theta_deg);
/// #2096 crncsp: the corner is not passed slower than the composite of the moving axes' settings. `direction` of unit length,
/// `least_mm_min` by axis; a moving axis with 0 asks nothing, and then nobody does.
double corner_speed_at_least(double optimum_mm_min, const double* direction, const double* least_mm_min, unsigned axes);
/// Arc speed clamp, mm/min; infinite without an accuracy coefficient (note 4).
double arc_speed_clamp(const AccuracyParameters& p, double radius_mm);
/// Clamp of a spline block: R the smaller of the radii of curvature at its ends, Ks of #8019 (13.18 (3)).
double spline_speed_clamp(const AccuracyParameters& p, double radius_mm);
/// Acceleration clamp of high-speed high-accuracy control II (#8034): blocks of the given lengths that turn by `theta` between them
/// (13.17.1 "additional functions" (2)).
double acceleration_clamp(const AccuracyParameters& p, double theta_deg, double length_before_mm, double length_behind_mm);
/// Speed where an arc begins or ends: #1209, or the corner's where that is lower; infinite where neither asks (13.15 "arc
/// entrance/exit").
double arc_joint_speed(const AccuracyParameters& p, double theta_deg);
/// #2110 or, where that is 0, #2002 (and #2109, #2001 of rapid traverse).
double mode_clamp(double high_precision_mm_min, double normal_mm_min);
/// The path speed at which some axis reaches its clamp; infinite without one. `direction` of unit length: its largest shares.
double path_clamp(const double* clamp_mm_min, const double* direction, unsigned axes);

// ---- a move ---------------------------------------------------------------------------------------------------------

/// What the mode asks of a move (13.15, 13.17.1).
AccuracyLimits accuracy_limits(const AccuracyParameters& p, const AccuracyMove& move);
/// What it leaves of the speed where two moves meet, mm/s: corner_speed(), acceleration_clamp() and arc_joint_speed() by what the moves
/// carry of the parameters.
double joint_speed(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);

// ---- circular error radius compensation, #8107, #8108, #2069 ---------------------------------------------------------

/// What an axis is moved outwards at the angle phi from its direction, mm.
double radius_compensation(double coefficient_mm, double share, double phi_deg);

// ---- S-pattern filters, #1568 SfiltG1, #1569 SfiltG0, #1570 Sfilt2 ---------------------------------------------------

/// Share of a step of acceleration that has come through `t` behind it: a mean over `first`, and of that one over `second`.
double s_filter(double t_ms, double first_ms, double second_ms);
/// Length that a filter may have.
constexpr bool s_filter_valid(double ms) { return ms >= 0 && ms <= 200; }

}  // namespace nc::m700
