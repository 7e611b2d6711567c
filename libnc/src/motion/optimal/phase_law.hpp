// SPDX-License-Identifier: Apache-2.0
// A law in closed form along any path: phases of constant jerk that keep velocity, acceleration and jerk of every axis, found in one go.
// It is not the shortest one. It says how long another law may take at most, it is where that begins, and it goes where no other is found
// (docs/motion-optimal.md, "The law in phases").
#pragma once

#include "motion/optimal/line_law.hpp"
#include "motion/optimal/mesh.hpp"

namespace nc::optimal {

class PhaseLaw {
 public:
  /// From the place and the state that the request names to rest at the end of its pieces, or as far as it reaches, with `share` of the
  /// limits. False where there is none; from rest there always is one, and only for want of room it ends earlier (whole()).
  Task<bool> find(Work& work, const MeshRequest& request, const Limits& limits, double share = 1);
  /// The same in two steps, for several starts on one path: s behind that of the request. In all that follows places count from there.
  Task<bool> measure(Work& work, const MeshRequest& request, const Limits& limits, double share = 1);
  Task<bool> from(Work& work, double s, double v, double a);

  unsigned count() const { return count_; }
  const Phase& phase(unsigned k) const { return phase_[k]; }
  /// From this phase on a law to a farther end would be another one.
  unsigned last_part() const { return last_part_; }
  const LineState& start() const { return start_; }
  double distance() const { return distance_; }
  double seconds() const { return seconds_; }
  bool whole() const { return whole_; }  ///< it reaches the end of the pieces, or of the reach
  /// The reach was shortened by the caller: the path goes on behind it.
  void ends_early() { whole_ = false; }
  /// How far it has come after so many seconds.
  double way_after(double seconds) const;
  /// Squared speed at ever farther places.
  double squared_speed(double s);

 private:
  static constexpr int64_t kLookCost = 120;  ///< instructions, of a stretch in a ramp
  static constexpr unsigned kStretches = 1024, kMoves = 2 * kStretches, kPhases = 3 * kMoves;

  /// A piece or a part of it: the largest size of each derivative of each axis.
  struct Stretch {
    double d1[kMaxAxes], d2[kMaxAxes], d3[kMaxAxes];
    double from, to;
    double use_a, use_j;  ///< of the limits
    double cap;           ///< speed: feed, axes, and the bends with their share of the limits
    double hold;          ///< the same with all of them and without the feed: what may be kept, and left
  };
  /// What is left along the path beside the bends.
  struct Budget {
    double acceleration = HUGE_VAL, jerk = HUGE_VAL;
    bool ok() const { return acceleration > 0 && jerk > 0 && acceleration < HUGE_VAL && jerk < HUGE_VAL; }
  };
  /// From one constant speed to another, or along one.
  struct Move {
    double v0, v1, length;
    Budget most;
  };
  /// Between two places that are passed at constant speed: to be divided, or one move.
  struct Range {
    double from, to, v0, v1;
    bool is_move;
    Budget most;
    bool stayed = false;  ///< stay() has been asked
  };

  unsigned parts_of(const Piece& p, double x, double length) const;
  bool measure_stretch(const Piece& p, double from, double to, unsigned samples, Stretch* out) const;
  void bound(const Piece& p, Stretch* s) const;
  Task<bool> stretches(Work& work, const MeshRequest& request);
  Budget budget(unsigned stretch, double speed) const;
  /// Of the path, as it is gone or as it is seen from its end.
  enum class Sense : uint8_t { forward, backward };
  static unsigned beyond(unsigned k, Sense sense) { return sense == Sense::forward ? k + 1 : k - 1; }  // behind the first one: none
  double near_edge(unsigned k, double at, Sense sense) const { return sense == Sense::forward ? stretch_[k].from - at : at - stretch_[k].to; }
  double far_edge(unsigned k, double at, Sense sense) const { return sense == Sense::forward ? stretch_[k].to - at : at - stretch_[k].from; }
  unsigned next_to(double s, Sense sense) const;
  double ramp(double at, Sense sense, double v0, double v1, double room, Budget* most) const;
  double ramp_from(double at, double v0, double v1, double room, Budget* most) const { return ramp(at, Sense::forward, v0, v1, room, most); }
  double ramp_to(double at, double v0, double v1, double room, Budget* most) const { return ramp(at, Sense::backward, v0, v1, room, most); }
  double stay(const Range& r, Sense sense) const;
  double first_move(double speed);
  Task<bool> begin(Work& work);
  Task<bool> solve(Work& work, const Range& whole);
  Task<bool> descend(Work& work, const Range& r);
  bool leave_fast(const Range& r, unsigned first, unsigned last, unsigned least);
  Task<double> slow_enough(Work& work, const Range& rest, double high);
  enum class Divided : uint8_t { no, yes, as_a_hill };
  Divided divide(const Range& r, double* most);
  Task<bool> hill(Work& work, const Range& r, double most);
  bool fits(const Range& r, double speed, Budget* rise, Budget* fall) const;
  /// What ramps have looked at since the last pause.
  int64_t looked() const {
    const int64_t cost = kLookCost * looks_;
    looks_ = 0;
    return cost;
  }
  bool push(const Range& r);
  bool make_phases();
  bool add(double seconds, double jerk);

  const Limits* limits_ = nullptr;
  double share_ = 1;
  Stretch stretch_[kStretches];
  unsigned stretches_ = 0;
  Range stack_[2 * kStretches];
  unsigned depth_ = 0;
  Move move_[kMoves];
  unsigned moves_ = 0;
  Phase phase_[kPhases];
  unsigned count_ = 0, last_part_ = 0;
  LineState start_, at_;
  unsigned at_phase_ = 0;
  double distance_ = 0, seconds_ = 0;
  bool whole_ = true;
  mutable int64_t looks_ = 0;
};

}  // namespace nc::optimal
