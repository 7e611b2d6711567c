// SPDX-License-Identifier: Apache-2.0
// G02.4, G03.4: arcs in space through three points, given by two blocks (M700 6.14). The first block alone moves nothing: its arc and its mark are made with
// the second block, because only then the circle is known.
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

using Vec3 = double[3];

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void cross(const Vec3& a, const Vec3& b, Vec3& out) {
  for (unsigned i = 0; i < 3; ++i) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/// The arc through three points, from the first through the second to the third.
struct ThreePoints {
  SpaceArc first, second;  ///< the part up to the middle point, and the part from there
};

/// False when the points lie on one line, or two of them are the same: then both parts are straight.
bool circle_through(const Vec3& a, const Vec3& b, const Vec3& c, ThreePoints* out) {
  constexpr double kFlat = 1e-9;  // sine of the angle between the sides below which the points count as lying on one line
  Vec3 p, q, n;
  for (unsigned i = 0; i < 3; ++i) {
    p[i] = b[i] - a[i];
    q[i] = c[i] - a[i];
  }
  cross(p, q, n);
  const double pp = dot(p, p), qq = dot(q, q), nn = dot(n, n);
  if (nn <= kFlat * kFlat * pp * qq || nn == 0) return false;
  // The centre, seen from a, is (q.q (n x p) + p.p (q x n)) / (2 n.n), with n = p x q.
  Vec3 np, nq;
  cross(n, p, np);
  cross(q, n, nq);
  Vec3 u;  // from a to the centre
  for (unsigned i = 0; i < 3; ++i) u[i] = (qq * np[i] + pp * nq[i]) / (2 * nn);
  const double radius = std::sqrt(dot(u, u)), normal = std::sqrt(nn);
  if (!(radius > 0)) return false;
  Vec3 e1, e2, unit;
  for (unsigned i = 0; i < 3; ++i) {
    e1[i] = -u[i] / radius;
    unit[i] = n[i] / normal;
  }
  cross(unit, e1, e2);
  const auto angle_of = [&](const Vec3& from_a) {
    Vec3 r;
    for (unsigned i = 0; i < 3; ++i) r[i] = from_a[i] - u[i];
    const double angle = std::atan2(dot(r, e2), dot(r, e1));
    return angle > 0 ? angle : angle + 6.28318530717958648;
  };
  const double middle = angle_of(p), end = angle_of(q);
  SpaceArc& f = out->first;
  SpaceArc& s = out->second;
  f = s = SpaceArc{};
  f.radius = s.radius = radius;
  f.sweep = middle;
  s.sweep = end - middle;
  for (unsigned i = 0; i < 3; ++i) {
    f.center[i] = s.center[i] = a[i] + u[i];
    f.e1[i] = e1[i];
    f.e2[i] = e2[i];
    s.e1[i] = e1[i] * std::cos(middle) + e2[i] * std::sin(middle);
    s.e2[i] = e2[i] * std::cos(middle) - e1[i] * std::sin(middle);
  }
  return s.sweep > 0;
}

/// The three basic axes, #1026 to #1028.
bool axes_in_space(const InForce& in, uint8_t (&axis)[3]) {
  for (unsigned i = 0; i < 3; ++i) {
    const WordSlot name = in.settings.plane_basic[i];
    const int index = in.axis_words.axis(name);
    if (index < 0) return false;
    axis[i] = static_cast<uint8_t>(index);
  }
  return true;
}

/// Emits one half: along its arc, or as a line.
void emit_half(BlockContext& in, const AxisVec& to, const SpaceArc* arc) {
  const uint32_t all = (1u << in.axis_count) - 1;
  if (arc == nullptr) {
    LinearStyle style;
    style.feed_mm_min = feed_for(in, in.position(), to);
    style.special_feed = special_feed(in);
    style.exact_stop = asks_exact_stop(in);
    move_linear(in, to, all, style);
    return;
  }
  MoveShape shape;
  shape.kind = ShapeKind::space_arc;
  shape.map = in.state.map;
  shape.arc = *arc;
  set_modal_feed(in, emit_shaped(in, frame_of_move(in, to, all), shape, NC_MOVE_ARC), feed_mm_min(in));
}

/// Emits the first half and the mark at the end of its block, so that the machine can stop there; a rewind to that mark reads the block in hand again.
void emit_first_half(BlockContext& in, const AxisVec& middle, const SpaceArc* arc) {
  State& state = in.state;
  const nc_source second = in.source;
  const PathPoint& first = in.points[state.arc_points];
  in.source = first.source;
  const double feed = state.modal.feed;
  const uint16_t digit = state.modal.feed_digit;
  state.modal.feed = first.feed;  // the first half has the F of its own block
  state.modal.feed_digit = first.feed_digit;
  state.refresh_special();
  emit_half(in, middle, arc);
  state.modal.feed = feed;
  state.modal.feed_digit = digit;
  state.refresh_special();
  state.arc_step = ArcStep::halfway;
  CallFrame& frame = state.frame[state.depth];
  const uint64_t next = frame.offset;
  const uint32_t line = frame.line;
  frame.offset = in.block->begin;
  frame.line = in.block->line;
  in.finish_block(true, true);
  frame.offset = next;
  frame.line = line;
  in.source = second;
}

bool names_centre(const BlockInHand& in) { return has_any(*in.block, in.set_of({Role::vector_x, Role::vector_y, Role::vector_z})); }

}  // namespace

Execution check_in_space_arc(BlockInHand& in, const FunctionRow& row) {
  Condition bad = barred(*in.dialect, kInSpaceArc, row.function);  // 6.14 (a)
  if (row.function == Function::rotation_on && names_centre(in)) bad = Condition::space_conversion_code;  // with I J K it is a conversion in space
  return bad == Condition::none ? Execution::done : in.raise_code(bad, row);
}

Execution check_space_arc_block(BlockInHand& in) {
  State& state = in.state;
  const Command& w = in.words;
  const bool goes_on = w.one_shot == nullptr && w.cycle == nullptr && w.target.axes() != 0 && is_space_arc(state.modal.of(Mode::motion));
  if (state.arc_step == ArcStep::middle_given && !goes_on) return in.raise(Condition::space_arc_blocks);
  if (w.motion == nullptr || !is_space_arc(w.motion->function)) return Execution::done;
  // 6.14 (b)
  if (state.high_speed != SpeedMode::off) return in.raise_code(Condition::illegal_g, *w.motion);
  const ModalState& modal = state.modal;
  const bool refused = modal.is(Function::polar_command_on) || state.comp.side != 0 || !modal.is(Function::comp_off) ||
                       !modal.is(Function::normal_line_off) || !modal.is(Function::length_off) || !modal.is(Function::scaling_off) ||
                       state.any_mirror() != 0 || !modal.is(Function::macro_modal_off) || !modal.is(Function::rotation_off);
  return refused ? in.raise_code(Condition::space_arc_mode, *w.motion) : Execution::done;
}

Execution move_space_arc(BlockContext& in, const AxisVec& target) {
  State& state = in.state;
  if (state.arc_step == ArcStep::none) {  // this is the first block, which gives the middle point
    PathPoint start{in.position()}, middle{target};
    start.source = middle.source = in.source;
    start.feed = state.modal.feed;
    start.feed_digit = state.modal.feed_digit;
    state.arc_points = in.points.intern(start);
    in.points.intern(middle);
    state.arc_step = ArcStep::middle_given;
    in.keep_call();
    return Execution::later;
  }
  uint8_t axis[3];
  if (!axes_in_space(in, axis)) return in.raise(Condition::illegal_axis, Role::basic_x);
  const AxisVec start = in.points[state.arc_points].at, middle = in.points[state.arc_points + 1].at;
  Vec3 a, b, c;
  for (unsigned i = 0; i < 3; ++i) {
    a[i] = start[axis[i]];
    b[i] = middle[axis[i]];
    c[i] = target[axis[i]];
  }
  ThreePoints arcs;
  const bool bent = circle_through(a, b, c, &arcs);
  for (unsigned i = 0; bent && i < 3; ++i) arcs.first.axis[i] = arcs.second.axis[i] = axis[i];
  if (state.arc_step == ArcStep::middle_given) emit_first_half(in, middle, bent ? &arcs.first : nullptr);
  emit_half(in, target, bent ? &arcs.second : nullptr);
  state.arc_step = ArcStep::none;
  return Execution::done;
}

}  // namespace nc
