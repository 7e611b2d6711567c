// SPDX-License-Identifier: Apache-2.0
// The law of a straight line in closed form: with one limit each for speed, acceleration and jerk along it, the shortest time to rest is
// some phases of constant jerk, seven of them from rest to rest (docs/motion-optimal.md, "A straight line").
#pragma once

#include "nc/types.h"

namespace nc::optimal {

/// Constant jerk for a time.
struct Phase {
  double seconds = 0, jerk = 0;
};

/// Place, speed and acceleration along a line, mm and s.
struct LineState {
  double s = 0, v = 0, a = 0;
  /// `t` seconds later.
  LineState behind(double jerk, double t) const {
    return {s + t * (v + t * (a / 2 + t * jerk / 6)), v + t * (a + t * jerk / 2), a + t * jerk};
  }
};

/// Limits along a line, > 0; acceleration and jerk are finite.
struct LineLimits {
  double speed = 0, acceleration = 0, jerk = 0;
};

/// mm by which a law over `distance` may miss its end: rounding, and no more than an axis shows.
double unseen(const LineLimits& limits, double distance);

class LineLaw {
 public:
  static constexpr unsigned kPhases = 8;

  /// To rest as soon as possible. False where that takes more than the limits.
  bool stop(double v, double a, const LineLimits& limits);
  /// To rest behind `distance` in the shortest time; where it begins faster than the limit, down to that as soon as possible.
  /// False where it cannot be at rest so soon. What would take more than `most_seconds` rests earlier (see whole()), by as much less of
  /// the constant speed as that leaves.
  bool reach(double distance, double v, double a, const LineLimits& limits, double most_seconds);
  bool whole() const { return whole_; }

  unsigned count() const { return count_; }
  const Phase& phase(unsigned k) const { return phase_[k]; }
  /// From this phase on a law to a farther end would be another one.
  unsigned last_part() const { return last_part_; }
  const LineState& start() const { return start_; }
  double distance() const { return at_.s; }
  double seconds() const { return seconds_; }

 private:
  void begin(double v, double a);
  void add(double seconds, double jerk);
  void to_speed(double speed);
  bool to_rest();
  double way_through(double speed, double cruise);
  double way_behind(double rise);

  LineLimits limits_;
  Phase phase_[kPhases];
  unsigned count_ = 0, last_part_ = 0;
  bool whole_ = true;
  double seconds_ = 0;
  LineState start_, at_;  ///< where it begins, and behind the phases so far
};

}  // namespace nc::optimal
