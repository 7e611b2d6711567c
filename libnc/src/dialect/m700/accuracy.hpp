// SPDX-License-Identifier: Apache-2.0
// The formulas of the M700's high-accuracy control (13.15 to 13.18) as functions without state: at what speed a corner, an arc or a curve may
// be passed, how much smaller a filter or a servo makes a circle, how long an acceleration takes. The names say the units. These are mm/min and
// ms if the manual has them, so that its numbers can be used unchanged.
#pragma once

#include "dialect/accuracy.hpp"
#include "ring/accuracy_limits.hpp"

namespace nc::m700 {

// ---- acceleration before interpolation: one slope for all axes (13.15 "pre-interpolation acceleration") -------------

/// Change of speed in a millisecond, dV = G1bF / G1btL, in mm/min per ms; 0 if #1207 is not set.
double tolerable_step(const AccuracyParameters& p);
/// The same as an acceleration in mm/s^2.
double tolerable_acceleration(const AccuracyParameters& p);
/// Time from rest to a speed, in ms. It is shorter for a lower speed.
double rise_time_ms(const AccuracyParameters& p, double speed_mm_min);
/// Length of the path from rest to a speed, in mm.
double rise_length_mm(const AccuracyParameters& p, double speed_mm_min);

// ---- acceleration after interpolation: a time constant for each axis (13.15 (1), normal mode) ----------------------

/// The share of the commanded speed that an axis has at time t after a step of the command, with the linear time constant #2007 G1tL.
double linear_rise(double t_ms, double g1tl_ms);
/// The same with the exponential time constant #2008 G1t1.
double exponential_rise(double t_ms, double g1t1_ms);
/// The same with both time constants, one behind the other. 0 means that there is no such time constant.
double combined_rise(double t_ms, double g1tl_ms, double g1t1_ms);
/// How far the axis is behind its command at constant speed, in mm. It is the area above the curve of the rise.
double smoothing_lag_mm(double speed_mm_min, double g1tl_ms, double g1t1_ms);

// ---- how far a circle comes out too small (13.15 (2)) ---------------------------------------------------------------

/// What makes a circle smaller: the time constants of the filter behind interpolation and of the position loop in s, and the feed forward as
/// fwd_g / 100. The functions below return the error of the radius in mm.
struct ServoLag {
  double filter_s = 0, loop_s = 0, feed_forward = 0;
};
double radius_error_linear(double feed_mm_min, double radius_mm, const ServoLag& lag);
double radius_error_exponential(double feed_mm_min, double radius_mm, const ServoLag& lag);
double radius_error_high_accuracy(double feed_mm_min, double radius_mm, const ServoLag& lag);
/// The largest radius error that high-accuracy control can have, in mm. It does not depend on the feed or the radius, because the arc speed
/// clamp limits the speed by the radius.
double largest_radius_error(const AccuracyParameters& p, const ServoLag& lag);
/// The feed forward that a loop with smooth high gain and this fwd_g amounts to, in percent (13.15 "feed forward").
double equivalent_feed_forward(double fwd_g_percent, double pgn1_conventional, double pgn1_shg);

// ---- speeds ---------------------------------------------------------------------------------------------------------

/// Optimum corner deceleration: highest speed at a corner between two straight lines with the outside angle `theta`, in mm/min; infinite if
/// the corner needs no lower speed (13.15 "optimum speed control" (1)).
double corner_speed(const AccuracyParameters& p, double theta_deg);
/// #2096 crncsp: the speed at a corner does not become lower than the composite of the settings of the moving axes. Returns `optimum_mm_min`
/// or this composite, whichever is higher. `direction` has unit length; `least_mm_min` holds the setting of each axis. If the setting of a
/// moving axis is 0, there is no composite.
double corner_speed_at_least(double optimum_mm_min, const double* direction, const double* least_mm_min, unsigned axes);
/// Highest speed on an arc, in mm/min; infinite if the accuracy coefficient is 0 (note 4).
double arc_speed_clamp(const AccuracyParameters& p, double radius_mm);
/// Highest speed in a spline block, in mm/min. `radius_mm` is the smaller of the radii of curvature at the ends of the block; the coefficient
/// Ks is #8019 (13.18 (3)).
double spline_speed_clamp(const AccuracyParameters& p, double radius_mm);
/// Acceleration clamp of high-speed high-accuracy control II (#8034): highest speed in mm/min between two blocks of these lengths, when the
/// direction turns by `theta` between them (13.17.1 "additional functions" (2)).
double acceleration_clamp(const AccuracyParameters& p, double theta_deg, double length_before_mm, double length_behind_mm);
/// Highest speed where an arc begins or ends, in mm/min: #1209, or the speed of the corner if that is lower; infinite if neither limits it
/// (13.15 "arc entrance/exit").
double arc_joint_speed(const AccuracyParameters& p, double theta_deg);
/// The clamp of an axis in the mode: #2110, or #2002 if #2110 is 0. For rapid traverse it is #2109, or #2001.
double mode_clamp(double high_precision_mm_min, double normal_mm_min);
/// The path speed in mm/min at which the first axis reaches its clamp; infinite if no moving axis has one. `direction` has unit length, or
/// holds the largest share of each axis in the path.
double path_clamp(const double* clamp_mm_min, const double* direction, unsigned axes);

// ---- a move ---------------------------------------------------------------------------------------------------------

/// The limits that the mode sets for a move (13.15, 13.17.1).
AccuracyLimits accuracy_limits(const AccuracyParameters& p, const AccuracyMove& move);
/// Highest speed where two moves meet, in mm/s; infinite = no limit. It applies corner_speed(), acceleration_clamp() and arc_joint_speed() with
/// the limits that the moves carry instead of the parameters.
double joint_speed(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);

// ---- circular error radius compensation, #8107, #8108, #2069 ---------------------------------------------------------

/// How far an axis is moved outwards at the angle phi from its direction, in mm.
double radius_compensation(double coefficient_mm, double share, double phi_deg);

// ---- S-pattern filters, #1568 SfiltG1, #1569 SfiltG0, #1570 Sfilt2 ---------------------------------------------------

/// The share of a step that has come through the filters at time t after it. The first filter is a mean over the time `first`, the second a
/// mean of that over the time `second`.
double s_filter(double t_ms, double first_ms, double second_ms);
/// A filter may have this length.
constexpr bool s_filter_valid(double ms) { return ms >= 0 && ms <= 200; }

}  // namespace nc::m700
