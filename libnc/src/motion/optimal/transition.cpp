// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/transition.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kTangent = 1e-9;  ///< where |q'| and the length times |q''| change by no more than this at a joint, there is no step
constexpr double kCut = 3.0 / 16;  ///< the distance at the joint divided by the reach times the step of q'
constexpr double kBow = 0.0108;  ///< the largest distance divided by the square of the reach times the step of q''
constexpr double kUse = 0.92;  ///< a transition is laid out for this part of the tolerance at first
constexpr double kUseMost = 0.97;  ///< it may be away by this part of the tolerance at any place that is looked at
constexpr double kLess = 0.8;  ///< where the reach was too long, the next one is this part of it
constexpr unsigned kTries = 16;
constexpr unsigned kLooks = 16;  ///< places on either side of the joint that are looked at
constexpr unsigned kLooksTurn = 3;  ///< the same in each piece of a sharp corner
constexpr double kBowOfTurn = 0.1;  ///< of the tolerance, that the step of curvature may take at a sharp corner
constexpr double kShortest = 2e-6;  ///< mm: a transition is no shorter
constexpr double kTurnCell = 0.26;  ///< and one on a sharp corner this part of a piece
constexpr double kCell = 0.125;  ///< a cell of the time law has at most this part of the length

double distance(const AxisVec& a, const AxisVec& b, unsigned axis_count) {
  double sum = 0;
  for (unsigned i = 0; i < axis_count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace

CurvePoint JointSide::at(double x, unsigned axis_count) const {
  if (curve != nullptr) return curve_evaluate(*curve, s + x, axis_count);
  CurvePoint q;
  for (unsigned i = 0; i < axis_count; ++i) {
    q.position[i] = place[i] + x * along[i];
    q.d1[i] = along[i];
  }
  return q;
}

JointSide line_through(const AxisVec& joint, const AxisVec& from, const AxisVec& to, double length, unsigned axis_count) {
  JointSide side;
  side.place = joint;
  for (unsigned i = 0; i < axis_count; ++i) side.along[i] = (to[i] - from[i]) / length;
  return side;
}

JointSide arc_end(const Curve& curve) {
  JointSide side;
  side.curve = &curve;
  side.s = curve.length;
  return side;
}

JointSide arc_start(const Curve& curve) {
  JointSide side;
  side.curve = &curve;
  return side;
}

namespace {

/// With the ends' position, direction and curvature.
Piece between(const CurvePoint& from, const CurvePoint& to, double l, unsigned axis_count) {
  Piece p;
  p.length = l;
  p.quintic = true;
  p.cell = kCell * l;
  for (unsigned i = 0; i < axis_count; ++i) {
    // What is left of the ends when the parabola at the start is taken away.
    const double bend = from.d2[i];
    const double place = to.position[i] - from.position[i] - l * (from.d1[i] + 0.5 * l * bend);
    const double slope = (to.d1[i] - from.d1[i] - l * bend) * l, curve = (to.d2[i] - bend) * l * l;
    p.c[0][i] = from.position[i];
    p.c[1][i] = from.d1[i];
    p.c[2][i] = 0.5 * bend;
    p.c[3][i] = (10 * place - 4 * slope + 0.5 * curve) / (l * l * l);
    p.c[4][i] = (-15 * place + 7 * slope - curve) / (l * l * l * l);
    p.c[5][i] = (6 * place - 3 * slope + 0.5 * curve) / (l * l * l * l * l);
  }
  return p;
}

/// Cuts the polynomial at the knots of the sharp corner and adds step times T to each part, T'' = K, T = max(u, 0) outside.
void add_turn(const Piece& whole, const AxisVec& step, double reach, unsigned axis_count, Transition* out) {
  out->count = kTurnPieces;
  for (unsigned n = 0; n < kTurnPieces; ++n) {
    const TurnPiece& turn = kTurn.piece[n];
    const double x = (turn.at + 1) * reach;
    Piece& p = out->piece[n];
    p = whole;
    p.length = turn.length * reach;
    p.cell = kTurnCell * p.length;
    for (unsigned i = 0; i < axis_count; ++i) {
      double c[6];
      for (unsigned j = 0; j < 6; ++j) c[j] = whole.c[j][i];
      for (unsigned j = 0; j < 5; ++j)
        for (unsigned k = 5; k-- > j;) c[k] += x * c[k + 1];  // Horner's scheme, shifted to x
      double scale = reach * step[i];
      for (unsigned j = 0; j < 6; ++j, scale /= reach) p.c[j][i] = c[j] + scale * turn.c[j];
    }
  }
}

}  // namespace

void make_transition(const Joint& joint, const CurvePoint& from, const JointSide& after, unsigned axis_count, Transition* out) {
  CurvePoint to = after.at(joint.reach, axis_count);
  if (!joint.turns) {
    out->piece[0] = between(from, to, 2 * joint.reach, axis_count);
    out->count = 1;
    return;
  }
  for (unsigned i = 0; i < axis_count; ++i) {
    to.position[i] -= joint.reach * joint.step[i];
    to.d1[i] -= joint.step[i];
  }
  add_turn(between(from, to, 2 * joint.reach, axis_count), joint.step, joint.reach, axis_count, out);
}

double transition_distance(const Transition& t, const JointSide& before, const JointSide& after, double reach, unsigned axis_count) {
  const unsigned looks = t.count == 1 ? 2 * kLooks : kLooksTurn;
  double worst = 0, from = -reach;
  for (unsigned k = 0; k < t.count; ++k) {
    const Piece& p = t.piece[k];
    for (unsigned n = 1; n <= looks; ++n) {
      const double at = p.length * n / looks, x = from + at;
      worst = std::max(worst, distance(evaluate(p, at, axis_count).position, (x < 0 ? before : after).at(x, axis_count).position, axis_count));
    }
    from += p.length;
  }
  return worst;
}

Joint find_joint(const JointSide& before, const JointSide& after, double most, double tolerance, unsigned axis_count, Transition* room) {
  const CurvePoint a = before.at(0, axis_count), b = after.at(0, axis_count);
  const double step = distance(a.d1, b.d1, axis_count), turn = kCut * step, bend = kBow * distance(a.d2, b.d2, axis_count);
  Joint joint;
  if (step < kTangent && bend * most < kBow * kTangent) {
    joint.found = true;
    return joint;
  }
  if (!(tolerance > 0)) return joint;
  for (unsigned i = 0; i < axis_count; ++i) joint.step[i] = b.d1[i] - a.d1[i];
  // turn h + bend h^2 = what is allowed, in the form that bend may vanish in.
  const double allowed = kUse * tolerance, sharp = std::min(most, allowed / (kTurnDepth * step));
  joint.turns = bend * sharp * sharp < kBowOfTurn * tolerance && kTurnDepth * step * sharp > kBowOfTurn * tolerance;
  joint.reach = joint.turns ? sharp : std::min(most, 2 * allowed / (turn + std::sqrt(turn * turn + 4 * bend * allowed)));
  for (unsigned n = 0; n < kTries && joint.reach > kShortest; ++n) {
    make_transition(joint, before.at(-joint.reach, axis_count), after, axis_count, room);
    if (transition_distance(*room, before, after, joint.reach, axis_count) <= kUseMost * tolerance) {
      joint.found = true;
      return joint;
    }
    joint.reach *= kLess;
  }
  joint.reach = 0;
  return joint;
}

}  // namespace nc::optimal
