// SPDX-License-Identifier: Apache-2.0
// G06.2: NURBS, with one control point, its knot and its weight in each block (M700 6.15). A span of the curve is given out, as a rational Bezier curve, as
// soon as its knots are known, so that there is no limit for the number of control points.
#include <cmath>
#include <initializer_list>

#include "base/same_place.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The indexes of the basic axes, 0xff where the machine has no such axis.
void curve_axes(const InForce& in, uint8_t (&axis)[3]) {
  for (unsigned i = 0; i < 3; ++i) {
    const WordSlot name = in.settings.plane_basic[i];
    const int index = in.axis_words.axis(name);
    axis[i] = index < 0 ? uint8_t{0xff} : static_cast<uint8_t>(index);
  }
}

/// M700 6.15: at most four decimals.
bool too_fine(double value) { return std::fabs(value * 1e4 - std::nearbyint(value * 1e4)) > 1e-6; }

Execution take_knot(BlockInHand& in, double* knot) {
  if (!in.words.has(Role::curve_knot)) return in.raise(Condition::format_error, Role::curve_knot);
  *knot = in.words.get(Role::curve_knot);  // K1 means 1.0, with or without a point
  if (too_fine(*knot)) return in.raise(Condition::format_error, Role::curve_knot, *knot);
  return Execution::done;
}

Execution take_weight(BlockInHand& in, double* weight) {
  *weight = 1;
  if (!in.words.has(Role::curve_weight)) return Execution::done;
  *weight = in.words.get(Role::curve_weight);
  if (too_fine(*weight)) return in.raise(Condition::format_error, Role::curve_weight, *weight);
  const RangeRules& range = in.dialect->rules.range;
  if (*weight < range.least_curve_weight || *weight > range.most_curve_weight) return in.raise(Condition::value_range, Role::curve_weight, *weight);
  return Execution::done;
}

/// Takes the order and the axes from the first block of a curve.
Execution begin_curve(BlockInHand& in, const AxisVec& target) {
  NurbsState& n = in.state.nurbs;
  const Command& w = in.words;
  n = NurbsState{};
  uint32_t order = n.order = in.state.nurbs_order != 0 && !w.has(Role::curve_order) && w.motion == nullptr ? in.state.nurbs_order : uint8_t{4};
  if (w.has(Role::curve_order) && (!whole_number(w.get(Role::curve_order), &order) || order < 2 || order > 4)) return in.raise(Condition::value_range, Role::curve_order, w.get(Role::curve_order));
  n.order = in.state.nurbs_order = static_cast<uint8_t>(order);
  n.axes = static_cast<uint8_t>(w.target.axes());
  const AxisVec at = in.position();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (std::fabs(target[i] - at[i]) > kReached) return in.raise(Condition::nurbs_start, in.axis_words.word(i));
  uint8_t axis[3];
  curve_axes(in, axis);
  uint32_t basic = 0;
  for (const uint8_t a : axis)
    if (a < kMaxAxes) basic |= 1u << a;
  if (w.target.axes() == 0) n.axes = static_cast<uint8_t>(basic);  // a knot alone after a curve begins the next curve at the end of that one
  if ((w.target.axes() & ~basic) != 0) return in.raise(Condition::illegal_address, Role::basic_x);
  return Execution::done;
}

const PathPoint& point(const InForce& in, uint32_t index) { return in.points[in.state.nurbs.first + index]; }

/// The Bezier points of the span between knots j and j + 1: they are values of the polar form (de Boor's scheme, with one argument for each level).
RationalSpan span_of(const InForce& in, uint32_t j, const uint8_t (&axis)[3]) {
  const unsigned degree = in.state.nurbs.order - 1u;
  RationalSpan span{};
  span.degree = static_cast<uint8_t>(degree);
  for (unsigned i = 0; i < 3; ++i) span.axis[i] = axis[i];
  const double from = point(in, j).knot, to = point(in, j + 1).knot;
  for (unsigned b = 0; b <= degree; ++b) {
    double c[4][4];
    for (unsigned r = 0; r <= degree; ++r) {
      const PathPoint& p = point(in, j - degree + r);
      c[r][3] = p.weight;
      for (unsigned i = 0; i < 3; ++i) c[r][i] = axis[i] < kMaxAxes ? p.at[axis[i]] * p.weight : 0;
    }
    for (unsigned level = 1; level <= degree; ++level) {
      const double u = level <= b ? to : from;
      for (unsigned r = degree; r >= level; --r) {
        const double left = point(in, j - degree + r).knot, right = point(in, j + 1 + r - level).knot;
        const double share = (u - left) / (right - left);
        for (unsigned i = 0; i < 4; ++i) c[r][i] = (1 - share) * c[r - 1][i] + share * c[r][i];
      }
    }
    span.weight[b] = c[degree][3];
    for (unsigned i = 0; i < 3; ++i) span.point[b][i] = c[degree][i] / c[degree][3];
  }
  return span;
}

/// Adds the next point of the curve. The points of a curve have consecutive ids. When the program is read again from the middle of a curve, the next free id
/// is another one; then the older points that further spans need are entered again, too.
void append(InForce& in, const PathPoint& p) {
  constexpr uint32_t kNeeded = 2 * 3;  // a span needs as many points back as twice the degree
  NurbsState& n = in.state.nurbs;
  uint32_t id = in.points.intern(p);
  if (n.knots > 0 && id != n.first + n.knots) {
    const uint32_t kept = n.knots < kNeeded ? n.knots : kNeeded, from = n.first + n.knots - kept;
    for (uint32_t i = 0; i < kept; ++i) {
      const PathPoint before = in.points[from + i];
      in.points.intern(before);
    }
    id = in.points.intern(p);
  }
  n.first = id - n.knots;
  ++n.knots;
}

/// Emits the span whose last knot has just been given.
void emit_span(BlockContext& in) {
  const NurbsState& n = in.state.nurbs;
  const unsigned degree = n.order - 1u;
  const uint32_t newest = n.knots - 1;
  if (newest < 2 * degree) return;
  const uint32_t j = newest - degree;
  if (j >= n.points || !(point(in, j + 1).knot > point(in, j).knot)) return;
  uint8_t axis[3];
  curve_axes(in, axis);
  MoveShape shape;
  shape.kind = ShapeKind::rational;
  shape.map = in.state.map;
  shape.span = span_of(in, j, axis);
  AxisVec end = in.position();
  for (unsigned i = 0; i < 3; ++i)
    if (axis[i] < kMaxAxes) end[axis[i]] = shape.span.point[degree][i];
  set_modal_feed(in, emit_shaped(in, frame_of_move(in, end, n.axes), shape, NC_MOVE_NURBS), feed_mm_min(in));
}

}  // namespace

Execution check_nurbs_block(BlockInHand& in) {
  const Command& w = in.words;
  const NurbsState& n = in.state.nurbs;
  if (!n.active()) return Execution::done;
  // Until the curve is closed a block may have no other codes, and no F, M, S or T.
  if (!w.functions.empty()) return in.raise_code(Condition::format_error, *w.functions.back());
  if (!w.auxiliary.empty()) return in.raise(Condition::format_error, Role::misc_code, w.auxiliary.back().number);
  for (const Role word : {Role::feed, Role::spindle_speed, Role::tool, Role::curve_order})
    if (w.has(word)) return in.raise(Condition::format_error, word, w.get(word));
  return Execution::done;
}

Execution move_nurbs(BlockContext& in, const AxisVec& target) {
  State& state = in.state;
  NurbsState& n = state.nurbs;
  const Command& w = in.words;
  if (state.high_speed != SpeedMode::accuracy_2) return in.raise_mode(Condition::illegal_g, Mode::motion);
  if (state.compensated()) return in.raise_mode(Condition::not_in_compensation, Mode::motion);
  PathPoint p{target};
  Execution did = take_knot(in, &p.knot);
  if (did == Execution::done) did = take_weight(in, &p.weight);
  if (did != Execution::done) return did;
  if (!n.active()) {
    did = begin_curve(in, target);
    if (did != Execution::done) return did;
  }
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (w.target.commands(i) && ((n.axes >> i) & 1) == 0) return in.raise(Condition::illegal_address, in.axis_words.word(i), w.target[i]);
  if (n.knots > 0 && p.knot < point(in, n.knots - 1).knot) return in.raise(Condition::nurbs_knot, Role::curve_knot, p.knot);
  const bool closes = w.target.axes() == 0 && n.knots > 0;
  // The first knot and the last knot are repeated as often as the order says, so that the curve begins and ends on control points.
  const bool must_repeat = closes ? n.knots > n.points : n.knots > 0 && n.knots < n.order;
  if (must_repeat && p.knot != point(in, n.knots - 1).knot) return in.raise(Condition::nurbs_knot, Role::curve_knot, p.knot);
  if (!closes && n.knots > n.points) return in.raise(Condition::format_error, Role::curve_knot, p.knot);  // the closing knots have begun: no more points
  if (closes && n.points < n.order) return in.raise(Condition::format_error, Role::curve_knot, p.knot);   // there are fewer points than the order
  append(in, p);
  if (!closes) n.points = n.knots;
  emit_span(in);
  if (closes && n.knots == n.points + n.order) n = NurbsState{};
  return Execution::done;
}

}  // namespace nc
