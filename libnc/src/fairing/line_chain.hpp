// SPDX-License-Identifier: Apache-2.0
// Lines in a row, and what fairing makes of them (M700 13.17.1, additional functions (1)). docs/high-accuracy.md has the derivation.
//
// Between two lines of a chain lies a joint. At first each joint is a programmed point. When a line is left out, its two joints become one in the middle
// of the line; this joint stands for all programmed points for which the two stood.
#pragma once

#include "fairing/rule.hpp"
#include "stream/stream.hpp"

namespace nc {

/// The number of lines that are looked at behind the one whose end is decided. M700 13.17.1 precaution (2): mode II looks up to 8 blocks ahead.
inline constexpr unsigned kFairingAhead = 8;

/// |b - a|. For two directions it is 2 sin(angle / 2), the change of velocity at a speed of 1.
double distance_of(const AxisVec& a, const AxisVec& b, unsigned axis_count);

class LineChain {
 public:
  explicit LineChain(unsigned axis_count) : axis_count_(axis_count) {}
  /// Sets where the first line begins. This point is never moved.
  void begin(const AxisVec& point);
  /// Adds a line to this point, at most kFairingAhead + 1 of them.
  void add(const AxisVec& point);

  /// Leaves out protruding lines as long as there are any, the shortest first. The first and the last line stay, and so do the ends of the
  /// chain. Work: a few hundred products for each line left out.
  void fair(const FairingRule& rule);

  unsigned lines() const { return joints_ - 1; }
  /// The end of the first line; and how many lines right behind it are left out.
  const AxisVec& first_end() const { return joint_[1].at; }
  unsigned left_out() const { return joint_[1].last - joint_[1].first; }
  double length(unsigned line) const { return line_[line].length; }
  /// Direction of a line, of length 1; zeros for a line without length.
  const AxisVec& direction(unsigned line) const { return line_[line].direction; }

 private:
  struct Joint {
    AxisVec at;
    unsigned first = 0, last = 0;  ///< numbers of the first and last programmed point that it stands for
  };
  struct Line {
    AxisVec direction;
    double length = 0;
  };
  bool protrudes(unsigned line, const FairingRule& rule) const;
  bool joined(unsigned line, double most, AxisVec* at) const;
  void leave_out(unsigned line, const AxisVec& at);
  Line line_between(const AxisVec& from, const AxisVec& to) const;
  double cosine(unsigned a, unsigned b) const { return dot(line_[a].direction, line_[b].direction); }
  double dot(const AxisVec& a, const AxisVec& b) const;
  double distance(const AxisVec& a, const AxisVec& b) const { return distance_of(a, b, axis_count_); }

  static constexpr unsigned kMost = kFairingAhead + 2;
  unsigned axis_count_;
  unsigned joints_ = 0, points_ = 0;
  AxisVec point_[kMost];  ///< points as programmed, except the first: there the machine is
  Joint joint_[kMost];
  Line line_[kMost];      ///< line i leads from joint i to joint i + 1
};

}  // namespace nc
