// SPDX-License-Identifier: Apache-2.0
// A simple law for a program of lines, with which the optimal mode is compared: its time, and where it is at any time, so that a test can measure
// that it keeps the limits. It shares no code with the planner.
#pragma once

#include "interpolate/line_program.hpp"

#include <algorithm>

namespace nc::test {

/// What the law keeps: limits of every axis, and the distance by which a corner may be cut.
struct SimpleLimits {
  double velocity = 0, acceleration = 0, jerk = 0, tolerance = 0;
};

/// Each corner is rounded at constant speed by a curve whose q'' is a triangle (half width h, so that it cuts the corner by turn h / 6), and the rest
/// of each line has seven phases of constant jerk between these speeds. It rests at programmed stops and, with a tolerance of 0, at corners.
class SimpleLaw {
 public:
  SimpleLaw(const SimpleLimits& limits, const LineProgram& program) : limits_(limits), program_(program) {
    const size_t n = program.point.size();
    reach_.assign(n, 0), speed_.assign(n, 0), most_.assign(n, 0), a_.assign(n, 0), j_.assign(n, 0), end_.assign(n, 0);
    for (size_t k = 1; k < n; ++k) {
      const AxisVec d = program.direction(k);
      const double share = std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
      most_[k] = std::min(program.feed[k], limits.velocity / share);
      a_[k] = limits.acceleration / share;
      j_[k] = limits.jerk / share;
      end_[k] = end_[k - 1] + program.length(k);
    }
    for (size_t k = 1; k + 1 < n; ++k) round_corner(k);
    for (size_t k = 1; k < n; ++k) speed_[k] = std::min(speed_[k], reachable(speed_[k - 1], k));
    for (size_t k = n - 1; k > 0; --k) speed_[k - 1] = std::min(speed_[k - 1], reachable(speed_[k], k));
    for (size_t k = 1; k < n; ++k) {
      at_constant_speed(reach_[k - 1], speed_[k - 1]);
      go_straight(k);
      at_constant_speed(reach_[k], speed_[k]);
    }
  }

  double seconds() const { return seconds_; }

  /// Place and distance from the programmed lines `at` seconds after the start. Times must not go back from call to call.
  AxisVec place(double at, double* off) {
    while (phase_ + 1 < phases_.size() && at >= phases_[phase_ + 1].from_s) ++phase_;
    if (phases_.empty()) return program_.point[0];
    const Phase& p = phases_[phase_];
    const double t = std::min(at - p.from_s, p.seconds);
    return at_length(p.from + t * (p.v + t * (p.a / 2 + t * p.j / 6)), off);
  }

 private:
  struct Phase {
    double from_s, seconds, from, v, a, j;
  };

  void round_corner(size_t k) {
    const double turn = program_.turn(k), feed = std::min(most_[k], most_[k + 1]);
    if (program_.stop[k]) return;
    if (turn < 1e-9) {
      speed_[k] = feed;
      return;
    }
    const double h = reach_[k] = std::min({0.9 * 6 * limits_.tolerance / turn, 0.45 * program_.length(k), 0.45 * program_.length(k + 1)});
    speed_[k] = std::min({feed, std::sqrt(limits_.acceleration * h / turn), std::cbrt(limits_.jerk * h * h / turn)});
  }
  double straight(size_t k) const { return program_.length(k) - reach_[k] - reach_[k - 1]; }

  static double change_seconds(double from, double to, double a, double j) {
    const double by = std::fabs(to - from);
    return by > a * a / j ? by / a + a / j : 2 * std::sqrt(by / j);
  }
  static double change_length(double from, double to, double a, double j) { return 0.5 * (from + to) * change_seconds(from, to, a, j); }
  template <class Fits>
  static double bisect(double low, double high, const Fits& fits) {
    for (int n = 0; n < 50; ++n) {
      const double middle = 0.5 * (low + high);
      (fits(middle) ? low : high) = middle;
    }
    return low;
  }
  /// The highest speed at the end of a line that has `from` at its start.
  double reachable(double from, size_t k) const {
    return bisect(from, from + 2 * limits_.velocity, [&](double v) { return change_length(from, v, a_[k], j_[k]) <= straight(k); });
  }

  void go_straight(size_t k) {
    const double from = speed_[k - 1], to = speed_[k], length = straight(k);
    const double peak = bisect(std::max(from, to), std::max({from, to, most_[k]}), [&](double v) {
      return change_length(from, v, a_[k], j_[k]) + change_length(v, to, a_[k], j_[k]) <= length;
    });
    const double rest = length - change_length(from, peak, a_[k], j_[k]) - change_length(peak, to, a_[k], j_[k]);
    change(from, peak, a_[k], j_[k]);
    at_constant_speed(std::max(rest, 0.0) / 2, peak);
    at_constant_speed(std::max(rest, 0.0) / 2, peak);
    change(peak, to, a_[k], j_[k]);
  }
  void change(double from, double to, double a, double j) {
    const double by = std::fabs(to - from), sign = to > from ? 1 : -1, grows = by > a * a / j ? a / j : std::sqrt(by / j);
    if (!(by > 0)) return;
    add(grows, from, 0, sign * j);
    const double v = from + sign * j * grows * grows / 2, top = sign * j * grows;
    const double holds = by > a * a / j ? by / a - a / j : 0;
    if (holds > 0) add(holds, v, top, 0);
    add(grows, v + top * holds, top, -sign * j);
  }
  void at_constant_speed(double length, double v) {
    if (length > 0 && v > 0) add(length / v, v, 0, 0);
  }
  void add(double seconds, double v, double a, double j) {
    phases_.push_back({seconds_, seconds, gone_, v, a, j});
    seconds_ += seconds;
    gone_ += seconds * (v + seconds * (a / 2 + seconds * j / 6));
  }

  AxisVec at_length(double u, double* off) {
    while (line_ + 1 < program_.point.size() && u > end_[line_]) ++line_;
    const size_t k = line_;
    const AxisVec d = program_.direction(k);
    const double before = u - end_[k - 1], behind = end_[k] - u;
    AxisVec q;
    for (unsigned i = 0; i < 3; ++i) q[i] = program_.point[k - 1][i] + d[i] * before;
    const size_t corner = behind < reach_[k] && reach_[k] > 0 ? k : before < reach_[k - 1] ? k - 1 : 0;
    *off = 0;
    if (corner == 0) return q;
    const AxisVec e = program_.direction(corner), f = program_.direction(corner + 1);
    const double h = reach_[corner], near = h - (corner == k ? behind : before), cut = near * near * near / (6 * h * h);
    for (unsigned i = 0; i < 3; ++i) q[i] += (f[i] - e[i]) * cut;
    *off = program_.turn(corner) * cut;
    return q;
  }

  SimpleLimits limits_;
  const LineProgram& program_;
  std::vector<double> reach_, speed_, most_, a_, j_;
  std::vector<double> end_;  ///< of each line, length from the start
  std::vector<Phase> phases_;
  double seconds_ = 0, gone_ = 0;
  size_t phase_ = 0, line_ = 1;
};

/// The largest velocity, acceleration and jerk of an axis that the law has from cycle to cycle, over their limits, and the distance from the lines over the
/// tolerance; what is above 1 is not kept.
inline double worst_of(SimpleLaw law, const SimpleLimits& limits, double cycle_s) {
  const auto cycles = static_cast<uint64_t>(law.seconds() / cycle_s) + 4;
  double worst = 0, off = 0;
  AxisVec last[4];
  for (uint64_t n = 0; n < cycles; ++n) {
    for (unsigned k = 3; k > 0; --k) last[k] = last[k - 1];
    last[0] = law.place(static_cast<double>(n) * cycle_s, &off);
    if (n == 0) last[1] = last[2] = last[3] = last[0];
    if (limits.tolerance > 0) worst = std::max(worst, off / limits.tolerance);
    for (unsigned i = 0; i < 3; ++i) {
      const double a = last[0][i], b = last[1][i], c = last[2][i], d = last[3][i];
      worst = std::max({worst, std::fabs(a - b) / (limits.velocity * cycle_s), std::fabs(a - 2 * b + c) / (limits.acceleration * cycle_s * cycle_s),
                        std::fabs(a - 3 * b + 3 * c - d) / (limits.jerk * cycle_s * cycle_s * cycle_s)});
    }
  }
  return worst;
}

}  // namespace nc::test
