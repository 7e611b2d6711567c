// SPDX-License-Identifier: Apache-2.0
// A machine option of our own (nc_config::retract_overlap): between two holes of a fixed cycle the tool does not stop at its return level, at the
// traverse and in front of the next hole, but goes on beyond the level, over to the next hole and down again on two curves.
//
// With c the way beyond the level, e the direction away from the hole, d the direction of the traverse and u from 0 to 1 the curves are
//     up and over:   c (1 - (1-u)^3) e + c u^3 d           over and down:   c (1 - (1-u)^3) d - c u^3 e
// One direction stops while the other one starts. At both ends the curve has the direction of the line that it meets and no curvature, so nothing
// steps where the path goes on at speed. Both lie beyond the level from which they begin, so below it nothing moves in the plane, whatever the
// speed is. c is at most half of the traverse.
#include <algorithm>
#include <cmath>

#include "interpret/feed.hpp"
#include "interpret/functions/cycle.hpp"
#include "interpret/motion.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr double kLeastTraverse = 1e-3;  ///< mm: a shorter one goes as it is programmed

/// The traverse in the coordinates of the program, with the drilling axis.
struct Traverse {
  uint8_t axis[3];       ///< the two of the plane, and the one that drills
  double along[3] = {};  ///< unit vector of the traverse
  double away = 1;       ///< direction away from the hole, along the drilling axis
  double length = 0;
};

/// How far the tool may go beyond its level with an axis that has a limit of its stroke.
double room_beyond(const InForce& in, unsigned axis, double away) {
  const nc_axis_config& limits = in.system->axis[axis];
  if (!limits.soft_limited) return HUGE_VAL;
  return away > 0 ? limits.soft_max - in.state.machine[axis] : in.state.machine[axis] - limits.soft_min;
}

/// The length offset that is in force for the axis is the one that it has: a move of the axis would not shift it.
bool length_is_applied(const InForce& in, unsigned axis) {
  return in.state.applied[axis] == (axis == in.state.length_axis ? in.state.length_value : 0.0);
}

/// A curve to `end` from one direction into another one, each `reach` long: p(u) = reach (1 - (1-u)^3) from + reach u^3 to.
void emit_curve(BlockContext& in, const Traverse& t, const double (&from)[3], const double (&to)[3], double reach, const AxisVec& end, bool flows = true) {
  MoveShape shape;
  shape.kind = ShapeKind::spline;
  shape.spline = SplineSpan{};
  uint32_t axes = 0;
  for (unsigned i = 0; i < 3; ++i) {
    shape.spline.axis[i] = t.axis[i];
    shape.spline.c[0][i] = 3 * reach * from[i];
    shape.spline.c[1][i] = -3 * reach * from[i];
    shape.spline.c[2][i] = reach * (from[i] + to[i]);
    axes |= 1u << t.axis[i];
  }
  Move& move = emit_shaped(in, frame_of_move(in, end, axes), shape, NC_MOVE_RAPID);
  move.exact_stop = !flows;
  move.rule.check_reversal = false;
  move.flows = flows;
  move.feed_mm_min = 0;
}

bool traverse_to(const InForce& in, const AxisVec& target, Traverse* t) {
  const CycleState& c = in.state.cycle;
  const AxisVec at = in.position();
  const int h = in.state.plane_axis[0], v = in.state.plane_axis[1];
  if (h < 0 || v < 0 || h == c.drill_axis || v == c.drill_axis) return false;
  t->axis[0] = static_cast<uint8_t>(h);
  t->axis[1] = static_cast<uint8_t>(v);
  t->axis[2] = c.drill_axis;
  const uint32_t own = 1u << t->axis[0] | 1u << t->axis[1] | 1u << t->axis[2];
  if ((in.rotary & own) != 0) return false;
  for (unsigned i = 0; i < 2; ++i) t->along[i] = target[t->axis[i]] - at[t->axis[i]];
  t->length = std::hypot(t->along[0], t->along[1]);
  if (!(t->length > kLeastTraverse)) return false;
  for (unsigned i = 0; i < 2; ++i) t->along[i] /= t->length;
  t->away = c.returned;
  return true;
}

/// The straight part between the curves is left out, or long enough to be a line of its own.
double reach_of(const InForce& in, const Traverse& t) {
  const double reach = std::min({in.retract_overlap, 0.5 * t.length, room_beyond(in, t.axis[2], t.away)});
  const double straight = t.length - 2 * reach;
  return straight > 0 && straight < kLeastTraverse ? reach - kLeastTraverse : reach;
}

}  // namespace

bool strokes_flow(const BlockInHand& in) { return in.retract_overlap > 0 && !in.settings.check_rapid && !asks_exact_stop(in); }

int8_t way_back(const BlockInHand& in) {
  const Hole& hole = in.jobs.holes.hole;
  const CycleTable& table = strokes_of(in.state.cycle.kind);
  if (table.shifts || !table.leaves_rapidly || hole.bottom == hole.r) return 0;
  return hole.bottom < hole.r ? int8_t{1} : int8_t{-1};
}

bool traverse_beyond_level(BlockContext& in, const AxisVec& target, uint32_t axes) {
  const CycleState& c = in.state.cycle;
  if (!strokes_flow(in) || c.returned == 0 || c.in_position > 0 || program_mapped(in) || (in.state.special & kSpecialMap) != 0 || in.state.stroke_box != 0)
    return false;
  Traverse t;
  if (!length_is_applied(in, c.drill_axis) || !traverse_to(in, target, &t)) return false;
  if ((axes & ~(1u << t.axis[0] | 1u << t.axis[1])) != 0) return false;
  const double reach = reach_of(in, t);
  if (!(reach > kLeastTraverse)) return false;
  const double up[3] = {0, 0, t.away}, over[3] = {t.along[0], t.along[1], 0}, down[3] = {0, 0, -t.away};
  const AxisVec from = in.position();
  AxisVec end = from;
  for (unsigned i = 0; i < 3; ++i) end[t.axis[i]] += reach * (up[i] + over[i]);
  emit_curve(in, t, up, over, reach, end);
  if (t.length > 2 * reach) {
    for (unsigned i = 0; i < 2; ++i) end[t.axis[i]] = target[t.axis[i]] - reach * t.along[i];
    LinearStyle style;
    style.kind = NC_MOVE_RAPID;
    style.flows = true;
    move_linear(in, end, axes, style);
  }
  for (unsigned i = 0; i < 2; ++i) end[t.axis[i]] = target[t.axis[i]];
  end[c.drill_axis] = from[c.drill_axis];
  emit_curve(in, t, over, down, reach, end, !is_tap(c.kind));  // in front of a tap it rests, so that a hold does not take it into the thread
  return true;
}

}  // namespace nc
