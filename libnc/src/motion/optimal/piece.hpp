// SPDX-License-Identifier: Apache-2.0
// The path of the `optimal` mode: pieces with continuous position, first and second derivative by one
// parameter u, and a bounded third. The parameter is near to the length (|q'| <= 1) but need not be it, so a
// piece may turn round on the spot.
#pragma once

#include <cmath>

#include "motion/dry_run.hpp"
#include "path/curve.hpp"

namespace nc::optimal {

/// What feeds are multiplied by, or replaced by, while the path is gone.
struct Scales {
  double feed = 1, rapid = 1;  ///< overrides
  double turns = 0;            ///< of the spindle, rev/s
  double pulses[5] = {};       ///< what the handle has made of F1 to F5 (M700 7.3)
  DryFeeds dry;                ///< what replaces the feeds in dry run
  double skip_feed = 0;        ///< mm/s that the newest skip signal calls for (M700 15.5); 0 = none has come
  int8_t turning_axis = -1;    ///< the axis that the spindle of synchronous taps is (M700 10.5), -1 = it is none

  bool operator==(const Scales&) const = default;
};

/// Axis limits of one part system, mm/s and so on; 0 = no limit.
struct Limits {
  unsigned axis_count = 3;
  double velocity[kMaxAxes] = {}, rapid[kMaxAxes] = {}, acceleration[kMaxAxes] = {}, jerk[kMaxAxes] = {};
  uint32_t linear = ~0u;  ///< bit i: axis i makes the length that a feed is measured by
  Scales scale;
};

/// What the feed of a piece goes by. `spindle` is a thread: by the turns and by nothing else, and the plan leaves a part of the limits to
/// what keeps it with the spindle (interpolate/spindle_sync.hpp). `fixed_turns`: a tap that follows its spindle by G95: no override concerns it. `digit`: F1 to F5 with their handle. `signals`: a skip move whose signals
/// change its feed.
enum class FeedBy : uint8_t { override, constant, turns, fixed_turns, spindle, digit, signals };

/// The feed is one per revolution.
inline bool goes_by_spindle(FeedBy by) { return by == FeedBy::turns || by == FeedBy::fixed_turns || by == FeedBy::spindle; }

/// A cut with such a feed goes at that of dry run, when dry run is on.
inline bool may_be_dry(FeedBy by) { return by != FeedBy::constant && by != FeedBy::fixed_turns && by != FeedBy::signals; }

/// F1 to F5: what the handle does to a feed.
struct DigitFeed {
  uint8_t digit = 0;        ///< 0 = F1
  float step = 0, most = 0; ///< mm/s by one pulse, and the limit
  bool operator==(const DigitFeed&) const = default;
};

/// Of a thread: how much faster than planned the spindle may turn, and what the plan may use of the axes' acceleration and jerk.
struct ThreadShare {
  static constexpr double kFaster = 1.15, kAcceleration = 0.7, kJerk = 0.52;
};

/// A polynomial by x = u - u_start, of degree 3 or 5, or a part of a committed curve.
struct Piece {
  double length = 0;             ///< of the parameter, > 0
  double feed = 0;               ///< mm/s (mm/rev) along the path; HUGE_VAL where only the axes limit
  FeedBy by = FeedBy::override;
  DigitFeed digit;               ///< where `by` says so; `feed` is then that without pulses
  bool rest_behind = false;      ///< the path rests at its end
  bool rapid = false;            ///< the rapid rates hold
  bool dry = false;              ///< dry run concerns it
  bool quintic = false;          ///< c[4] and c[5] are not 0
  double cell = 0;               ///< no cell on it is longer; 0 = any
  const Curve* curve = nullptr;  ///< then q(x) = curve(curve_from + x)
  double curve_from = 0;
  double share = 1;              ///< of the axes' acceleration and jerk that it may use (a synchronous tap: what its spindle can)
  double turning = 0;            ///< a synchronous tap, which is a line: deg that its spindle turns with each mm, whatever the direction; else 0
  AxisVec c[6];  ///< else q(x) = c[0] + c[1] x + ...
};

/// mm/s: the greatest speed with which the axis that turns with the piece keeps its own.
inline double feed_of_turning(const Piece& p, const Limits& limits) {
  const int axis = limits.scale.turning_axis;
  return p.turning > 0 && axis >= 0 && limits.velocity[axis] > 0 ? limits.velocity[axis] / p.turning : HUGE_VAL;
}
/// What that axis leaves of a limit (of acceleration, or of jerk) to those that move along the line.
inline double share_of_turning(const Piece& p, const Limits& limits, const double (&limit)[kMaxAxes]) NC_RT {
  const int axis = limits.scale.turning_axis;
  if (!(p.turning > 0) || axis < 0 || !(limit[axis] > 0)) return 1;
  double along = HUGE_VAL;
  for (unsigned i = 0; i < limits.axis_count; ++i)
    if (limit[i] > 0 && along * std::fabs(p.c[1][i]) > limit[i]) along = limit[i] / std::fabs(p.c[1][i]);
  return along < HUGE_VAL ? std::fmin(1, limit[axis] / (p.turning * along)) : 1;
}
inline double tap_acceleration_share(const Piece& p, const Limits& limits) NC_RT { return std::fmin(p.share, share_of_turning(p, limits, limits.acceleration)); }
inline double tap_jerk_share(const Piece& p, const Limits& limits) NC_RT { return std::fmin(p.share, share_of_turning(p, limits, limits.jerk)); }

/// Feed of the piece under the present overrides.
inline double feed_of(const Piece& p, const Limits& limits) {
  const Scales& by = limits.scale;
  if (p.dry && by.dry.of(p.rapid) >= 0) return by.dry.of(p.rapid);
  if (p.feed == HUGE_VAL) return p.feed;
  switch (p.by) {
    case FeedBy::constant: return std::fmin(p.feed, feed_of_turning(p, limits));
    case FeedBy::turns: return p.feed * by.feed * by.turns;
    case FeedBy::fixed_turns:
    case FeedBy::spindle: return p.feed * by.turns;
    case FeedBy::signals: return by.skip_feed > 0 ? by.skip_feed : p.feed;
    case FeedBy::digit:
      return by.feed * std::fmin(std::fmax(p.feed + by.pulses[p.digit.digit] * static_cast<double>(p.digit.step), 0), static_cast<double>(p.digit.most));
    case FeedBy::override: break;
  }
  return p.feed * by.feed;
}
/// Largest velocity of axis i on the piece.
inline double velocity_of(const Piece& p, const Limits& limits, unsigned i) {
  if (p.by == FeedBy::spindle) return limits.velocity[i] / ThreadShare::kFaster;
  return p.rapid ? (limits.rapid[i] > 0 ? limits.rapid[i] : limits.velocity[i]) * limits.scale.rapid : limits.velocity[i];
}
/// What a plan may use of the limits of acceleration and of jerk.
inline double acceleration_share(const Piece& p, const Limits& limits) {
  return p.by == FeedBy::spindle ? ThreadShare::kAcceleration : tap_acceleration_share(p, limits);
}
inline double jerk_share(const Piece& p, const Limits& limits) {
  return p.by == FeedBy::spindle ? ThreadShare::kJerk : tap_jerk_share(p, limits);
}
/// Nothing moves on the piece under the present overrides.
inline bool stands(const Piece& p, const Limits& limits) {
  return (p.rapid && !(limits.scale.rapid > 0)) || !(feed_of(p, limits) > 0);
}

/// Derivatives at x in [0, length]; the position is left as it was (but for a curve's).
inline void derivatives(const Piece& p, double x, unsigned axis_count, CurvePoint* q) NC_RT {
  if (p.curve != nullptr) {
    *q = curve_evaluate(*p.curve, p.curve_from + x, axis_count);
    return;
  }
  for (unsigned i = 0; i < axis_count; ++i) {
    const double c2 = p.c[2][i], c3 = p.c[3][i];
    q->d1[i] = p.c[1][i] + x * (2 * c2 + x * 3 * c3);
    q->d2[i] = 2 * c2 + x * 6 * c3;
    q->d3[i] = 6 * c3;
  }
  if (!p.quintic) return;
  const double x2 = x * x;
  for (unsigned i = 0; i < axis_count; ++i) {
    const double c4 = p.c[4][i], c5 = p.c[5][i];
    q->d1[i] += x2 * x * (4 * c4 + x * 5 * c5);
    q->d2[i] += x2 * (12 * c4 + x * 20 * c5);
    q->d3[i] += x * (24 * c4 + x * 60 * c5);
  }
}

/// s^3: jerk alone takes an axis this far in 23 us, a thousandth of the way that it makes in the shortest cycle.
inline constexpr double kUnseen = 2e-15;
/// mm in front of the end of a piece that no axis shows: a path that has come so near to it has come to it. An axis may turn by thousands of degrees
/// for each mm of a piece, so a length alone does not say that. `way` mm were added up to come there, with their rounding.
inline double unseen(const Piece& p, const Limits& limits, double way) NC_RT {
  constexpr double kMost = 1e-9, kRounding = 3e-14;
  double least = kMost;
  CurvePoint q;
  derivatives(p, p.length, limits.axis_count, &q);
  for (unsigned i = 0; i < limits.axis_count; ++i)
    if (limits.jerk[i] > 0 && least * std::fabs(q.d1[i]) > kUnseen * limits.jerk[i]) least = kUnseen * limits.jerk[i] / std::fabs(q.d1[i]);
  return std::fmax(least, kRounding * way);
}

/// Position of one axis of a polynomial.
inline double place_on(const Piece& p, double x, unsigned i) NC_RT {
  const double high = p.quintic ? x * (p.c[4][i] + x * p.c[5][i]) : 0;
  return p.c[0][i] + x * (p.c[1][i] + x * (p.c[2][i] + x * (p.c[3][i] + high)));
}

/// Position and derivatives at x in [0, length].
inline CurvePoint evaluate(const Piece& p, double x, unsigned axis_count) NC_RT {
  if (p.curve != nullptr) return curve_evaluate(*p.curve, p.curve_from + x, axis_count);
  CurvePoint q;
  for (unsigned i = 0; i < axis_count; ++i) q.position[i] = place_on(p, x, i);
  derivatives(p, x, axis_count, &q);
  return q;
}

}  // namespace nc::optimal
