// SPDX-License-Identifier: Apache-2.0
#include "fairing/line_chain.hpp"

#include <cmath>

#include "base/same_place.hpp"

namespace nc {
namespace {

constexpr double kNoise = 1e-12;    // rounding of cosines

}  // namespace

double LineChain::dot(const AxisVec& a, const AxisVec& b) const {
  double sum = 0;
  for (unsigned i = 0; i < axis_count_; ++i) sum += a[i] * b[i];
  return sum;
}

double distance_of(const AxisVec& a, const AxisVec& b, unsigned axis_count) {
  double squares = 0;
  for (unsigned i = 0; i < axis_count; ++i) squares += (b[i] - a[i]) * (b[i] - a[i]);
  return std::sqrt(squares);
}

LineChain::Line LineChain::line_between(const AxisVec& from, const AxisVec& to) const {
  Line line;
  line.length = distance(from, to);
  for (unsigned i = 0; i < axis_count_ && line.length > kNoLength; ++i) line.direction[i] = (to[i] - from[i]) / line.length;
  return line;
}

void LineChain::begin(const AxisVec& point) {
  point_[0] = point;
  joint_[0] = Joint{point, 0, 0};
  joints_ = points_ = 1;
}

void LineChain::add(const AxisVec& point) {
  line_[joints_ - 1] = line_between(joint_[joints_ - 1].at, point);
  point_[points_] = point;
  joint_[joints_++] = Joint{point, points_, points_};
  ++points_;
}

/// Line b between the lines a and c protrudes: there are corners at both its ends, and either these turn in opposite senses, or the corner would be less
/// sharp without b than each of them is (a way back, a loop).
///
/// Opposite senses in any number of axes: (a x b) . (b x c) < 0, which is (a.b)(b.c) < (a.c)(b.b) by Lagrange's identity.
bool LineChain::protrudes(unsigned line, const FairingRule& rule) const {
  if (!(line_[line].length < rule.length_mm)) return false;
  const double ab = cosine(line - 1, line), bc = cosine(line, line + 1);
  if (ab >= rule.corner_cos - kNoise || bc >= rule.corner_cos - kNoise) return false;
  const double ac = cosine(line - 1, line + 1);
  return ac > ab * bc + kNoise || (ac > ab + kNoise && ac > bc + kNoise);
}

/// The point at which the neighbours of `line` would meet when it is left out. False, when a programmed point would move by more than `most`, a neighbour
/// would have no length any more, or the new corner would not be less sharp than those that it replaces.
bool LineChain::joined(unsigned line, double most, AxisVec* at) const {
  const Joint &before = joint_[line], &behind = joint_[line + 1];
  for (unsigned i = 0; i < axis_count_; ++i) (*at)[i] = 0.5 * (before.at[i] + behind.at[i]);
  for (unsigned p = before.first; p <= behind.last; ++p)
    if (distance(point_[p], *at) > most) return false;
  const Line a = line_between(joint_[line - 1].at, *at), c = line_between(*at, joint_[line + 2].at);
  if (a.length <= kNoLength || c.length <= kNoLength) return false;
  const double sharpest = std::fmin(cosine(line - 1, line), cosine(line, line + 1));
  return dot(a.direction, c.direction) > sharpest + kNoise;
}

void LineChain::leave_out(unsigned line, const AxisVec& at) {
  joint_[line].at = at;
  joint_[line].last = joint_[line + 1].last;
  --joints_;
  for (unsigned i = line + 1; i < joints_; ++i) joint_[i] = joint_[i + 1];
  for (unsigned i = line; i < joints_ - 1; ++i) line_[i] = line_[i + 1];
  line_[line - 1] = line_between(joint_[line - 1].at, at);
  line_[line] = line_between(at, joint_[line + 1].at);
}

void LineChain::fair(const FairingRule& rule) {
  if (!rule.fairing) return;
  for (;;) {
    unsigned shortest = 0;  // the first line always stays
    AxisVec at, place;
    for (unsigned i = 1; i + 1 < lines(); ++i) {
      if (shortest != 0 && !(line_[i].length < line_[shortest].length)) continue;
      if (protrudes(i, rule) && joined(i, rule.length_mm, &place)) shortest = i, at = place;
    }
    if (shortest == 0) return;
    leave_out(shortest, at);
  }
}

}  // namespace nc
