// SPDX-License-Identifier: Apache-2.0
// Spline interpolation G05.1 Q2: a smooth curve through the points of fine segments (M700 13.18). Each block is its own part of the curve, for which the text
// is read up to two blocks ahead:
//
//   * at a point between two blocks of the spline the curve has the first two derivatives, by chord length, of the parabola through the point and its two
//     neighbours, so tangent and curvature are the same on both sides;
//   * at the beginning and the end of the spline, a block has the derivatives of the parabola at its other end;
//   * a block is the quintic with these derivatives at its ends; where both ends belong to the same parabola it is that parabola.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr double kNoMotion = 1e-9;      // mm
constexpr double kLongBlock = 8;        // 13.18 (1) (d)
constexpr double kCancelError = 5;      // (2): an error above this multiple of the tolerance cancels the spline
constexpr unsigned kEmptyBlocks = 64;   // most blocks without a movement that are passed over between two blocks of a spline

struct Vec3 {
  double v[3] = {0, 0, 0};
  double& operator[](unsigned i) { return v[i]; }
  double operator[](unsigned i) const { return v[i]; }
};
Vec3 combine(double a, const Vec3& x, double b, const Vec3& y) { return {{a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]}}; }
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// The way of one block along the basic axes.
struct Chord {
  Vec3 way;
  double length = 0;
};

/// The first two derivatives, by the length of the chord, at one end of a block.
struct EndDerivatives {
  Vec3 first, second;
};

/// A block as a curve with u in [0, 1]: its way and the derivatives by u at both ends.
struct Hermite {
  Vec3 way, v0, v1, w0, w1;
};

void basic_axes(const InForce& in, uint8_t (&axis)[3]) {
  for (unsigned i = 0; i < 3; ++i) {
    const WordSlot name = in.settings.plane_basic[i];
    const int index = in.axis_words.axis(name);
    axis[i] = index < 0 ? uint8_t{0xff} : static_cast<uint8_t>(index);
  }
}

Chord chord_between(const AxisVec& from, const AxisVec& to, const uint8_t (&axis)[3]) {
  Chord c;
  for (unsigned i = 0; i < 3; ++i)
    if (axis[i] < kMaxAxes) c.way[i] = to[axis[i]] - from[axis[i]];
  c.length = norm(c.way);
  return c;
}

double angle_deg(const Chord& a, const Chord& b) {
  const Vec3 unit_a = combine(1 / a.length, a.way, 0, a.way), unit_b = combine(1 / b.length, b.way, 0, b.way);
  return 2 * std::atan2(norm(combine(1, unit_b, -1, unit_a)), norm(combine(1, unit_b, 1, unit_a))) * 180 / std::numbers::pi;
}

// ---- the blocks to come ---------------------------------------------------------------------------------------------

struct Place {
  uint64_t offset;
  uint32_t line;
};

/// The next block of the text that is not empty, if it only moves spline axes. *at: before the call where the block begins, after it where the block ends.
bool look_ahead(BlockInHand& in, const uint8_t (&axis)[3], Place* place, bool* relative, AxisVec* at, Chord* chord) {
  const unsigned file = in.state.frame[in.state.depth].program.file;
  for (unsigned i = 0; i < kEmptyBlocks; ++i) {
    const Block* block = in.reader.peek(file, place->offset, place->line);
    if (block == nullptr || block->end_of_text || block->percent || block->has_fault || block->has_o) return false;
    place->offset = block->next;
    place->line = block->next_line;
    const bool skipped = block->skip != 0 && ((in.optional_skip >> block->skip) & 1) != 0;
    if (skipped || (block->empty && !block->has_n)) continue;  // (1) (c): a block with only ";" does not count
    if (!block->statements.empty()) return false;
    ComingMove move;
    if (!read_coming_move(*block, in.front, in.state.spline.axes, *relative, &move)) return false;
    *relative = move.relative;
    Targets targets;
    for (uint32_t left = move.axes; left != 0; left &= left - 1) {
      const unsigned moved = first_of(left);
      targets.set(moved, (move.incremental >> moved & 1) != 0 ? TargetKind::incremental : TargetKind::absolute, axis_value(in, moved, move.value[moved], false));
    }
    const AxisVec end = target_of(in, *at, targets);
    *chord = chord_between(*at, end, axis);
    *at = end;
    return chord->length > kNoMotion;
  }
  return false;
}

// ---- conditions ------------------------------------------------------------------------------------------------------

/// (1): the modes are such that a spline is formed.
bool modes_fit(const InForce& in, bool exact_stop) {
  const State& state = in.state;
  const ModalState& modal = state.modal;
  return !exact_stop && state.comp.side == 0 && modal.is(Function::comp_off) && modal.is(Function::cutting_mode) &&
         modal.is(Function::feed_per_minute) && state.cycle.kind == CycleKind::none && (state.special & kSpecialMap) == 0;
}

/// (1) (b), (d): the block is not longer than #8030, and not longer than eight times a neighbour. A neighbour without length does not count.
bool length_fits(const InForce& in, double length, double before, double behind) {
  const double minute = in.settings.spline_minute_length;
  if (minute < 0) return true;
  if (length > minute) return false;
  return (before <= 0 || length <= kLongBlock * before) && (behind <= 0 || length <= kLongBlock * behind);
}

// ---- the curve --------------------------------------------------------------------------------------------------------

/// The derivatives at the point between the chords a and b.
EndDerivatives parabola(const Chord& a, const Chord& b) {
  const double whole = a.length + b.length;
  EndDerivatives d;
  d.first = combine(b.length / (a.length * whole), a.way, a.length / (b.length * whole), b.way);
  d.second = combine(2 / (b.length * whole), b.way, -2 / (a.length * whole), a.way);
  return d;
}

/// The derivatives at the end of `chord` at which the spline begins or ends: those of the parabola of its other end. `sign`: +1 at the start, -1 at the end.
EndDerivatives free_end(const Chord& chord, const EndDerivatives& other, double sign) {
  return {combine(1 / chord.length, chord.way, -sign * 0.5 * chord.length, other.second), other.second};
}

Hermite span_between(const Chord& chord, const EndDerivatives& start, const EndDerivatives& end) {
  const double h = chord.length;
  Hermite s;
  s.way = chord.way;
  s.v0 = combine(h, start.first, 0, start.first);
  s.v1 = combine(h, end.first, 0, end.first);
  s.w0 = combine(h * h, start.second, 0, start.second);
  s.w1 = combine(h * h, end.second, 0, end.second);
  return s;
}

/// A curve with the same tangents and curvatures at its ends that lies nearer to the chord: the first derivatives at its ends are multiplied by `share`, the
/// second ones by its square.
Hermite flattened(const Hermite& s, double share) {
  Hermite f = s;
  for (unsigned i = 0; i < 3; ++i) {
    f.v0[i] *= share;
    f.v1[i] *= share;
    f.w0[i] *= share * share;
    f.w1[i] *= share * share;
  }
  return f;
}

void coefficients(const Hermite& s, SplineSpan* out) {
  for (unsigned i = 0; i < 3; ++i) {
    const double d = s.way[i], v0 = s.v0[i], v1 = s.v1[i], w0 = s.w0[i], w1 = s.w1[i];
    out->c[0][i] = v0;
    out->c[1][i] = 0.5 * w0;
    out->c[2][i] = 10 * d - 6 * v0 - 4 * v1 - 1.5 * w0 + 0.5 * w1;
    out->c[3][i] = -15 * d + 8 * v0 + 7 * v1 + 1.5 * w0 - w1;
    out->c[4][i] = 6 * d - 3 * v0 - 3 * v1 - 0.5 * w0 + 0.5 * w1;
  }
}

Vec3 across(const Vec3& a, const Vec3& along) { return combine(1, a, -dot(a, along) / dot(along, along), along); }

double distance_at(const SplineSpan& span, const Vec3& chord, double u) {
  Vec3 p;
  for (unsigned i = 0; i < 3; ++i) p[i] = ((((span.c[4][i] * u + span.c[3][i]) * u + span.c[2][i]) * u + span.c[1][i]) * u + span.c[0][i]) * u;
  return norm(across(p, chord));
}

/// Largest distance between the block and its chord: the largest of many samples, made more exact by a search around it.
double chord_error(const Hermite& s) {
  constexpr unsigned kSamples = 48, kThirds = 40;
  SplineSpan span;
  coefficients(s, &span);
  double most = 0, at = 0;
  for (unsigned k = 1; k < kSamples; ++k) {
    const double d = distance_at(span, s.way, static_cast<double>(k) / kSamples);
    if (d > most) most = d, at = static_cast<double>(k) / kSamples;
  }
  double low = at - 1.0 / kSamples, high = at + 1.0 / kSamples;
  for (unsigned k = 0; k < kThirds; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const double da = distance_at(span, s.way, a), db = distance_at(span, s.way, b);
    most = std::max(most, std::max(da, db));
    (da < db ? low : high) = da < db ? a : b;
  }
  return most;
}

/// (2): inside the block the curvature changes its side, or the curve leaves the chord on one side and reaches it on the other.
bool inflected(const Hermite& s) {
  return dot(across(s.v0, s.way), across(s.v1, s.way)) > 0 || dot(across(s.w0, s.v0), across(s.w1, s.v1)) < 0;
}

/// (2): revises a block whose chord error is above the tolerance; false when the error is so large that it cancels the spline.
bool revise(const InForce& in, Hermite* s, double error) {
  constexpr unsigned kHalvings = 50;
  const double tolerance = inflected(*s) ? in.settings.spline_tolerance_inflected : in.settings.spline_tolerance_arched;
  if (!(tolerance > 0) || error <= tolerance) return true;
  if (error > kCancelError * tolerance) return false;
  double low = 0, high = 1;
  for (unsigned k = 0; k < kHalvings; ++k) {
    const double share = 0.5 * (low + high);
    (chord_error(flattened(*s, share)) > tolerance ? high : low) = share;
  }
  *s = flattened(*s, low);
  return true;
}

/// Radius of curvature from the derivatives by any parameter.
double radius_of(const Vec3& v, const Vec3& w) {
  const double bend = norm(across(w, v));
  return bend > 0 ? dot(v, v) / bend : HUGE_VAL;
}

void emit_span(BlockContext& in, const MoveFrame& frame, const uint8_t (&axis)[3], const Hermite& s) {
  MoveShape shape;
  shape.kind = ShapeKind::spline;
  shape.map = in.state.map;
  for (unsigned i = 0; i < 3; ++i) shape.spline.axis[i] = axis[i];
  coefficients(s, &shape.spline);
  Move& move = emit_shaped(in, frame, shape, NC_MOVE_SPLINE);
  set_modal_feed(in, move, feed_mm_min(in));
  const double radius = std::min(radius_of(s.v0, s.w0), radius_of(s.v1, s.w1));  // (3)
  const double clamp = in.dialect->rules.motion.spline_speed_mm_min(in.settings.accuracy, radius);
  if (clamp < HUGE_VAL) move.speed_clamp = static_cast<float>(clamp / 60);
}

}  // namespace

Execution move_spline(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style) {
  SplineWay& past = in.state.spline_way;
  uint8_t axis[3];
  basic_axes(in, axis);
  const MoveFrame frame = frame_of_move(in, target, commanded);
  const Chord now = chord_between(frame.start, frame.end, axis);
  Chord before;
  for (unsigned i = 0; i < 3 && past.moved; ++i) before.way[i] = past.back[i];
  before.length = norm(before.way);
  const bool joined = past.joined;
  past.joined = false;
  const bool only_spline_axes = (commanded & ~uint32_t{in.state.spline.axes}) == 0 && now.length > kNoMotion;
  past.moved = only_spline_axes;
  for (unsigned i = 0; i < 3; ++i) past.back[i] = now.way[i];
  const auto straight = [&] {
    move_linear(in, target, commanded, style);
    return Execution::done;
  };
  if (!only_spline_axes || !modes_fit(in, style.exact_stop)) return straight();

  const CallFrame& program = in.state.frame[in.state.depth];
  Place place{program.offset, program.line};
  bool relative = in.state.modal.is(Function::incremental);
  AxisVec at = frame.end;
  Chord next, after;
  const bool has_next = look_ahead(in, axis, &place, &relative, &at, &next);
  const bool has_after = has_next && look_ahead(in, axis, &place, &relative, &at, &after);
  if (!has_next) next = Chord{};
  if (!has_after) after = Chord{};
  if (!length_fits(in, now.length, before.length, next.length)) return straight();
  // Where the path turns back on itself a curve would have a cusp, so there is none, whatever #8026 says (docs/decisions.md).
  constexpr double kTurnsBack = 150;
  const double cancel = in.settings.spline_cancel_angle, most = cancel > 0 ? std::fmin(cancel, kTurnsBack) : kTurnsBack;
  const bool joins = has_next && length_fits(in, next.length, now.length, after.length) && angle_deg(now, next) <= most;
  const bool begins = joined && before.length > 0;
  if (!begins && !joins) return straight();

  EndDerivatives start, end;
  if (begins) start = parabola(before, now);
  if (joins) end = parabola(now, next);
  if (!begins) start = free_end(now, end, 1);
  if (!joins) end = free_end(now, start, -1);
  Hermite span = span_between(now, start, end);
  const double error = chord_error(span);
  if (!revise(in, &span, error)) return straight();
  past.joined = joins;
  if (error < kNoMotion) return straight();
  emit_span(in, frame, axis, span);
  return Execution::done;
}

}  // namespace nc
