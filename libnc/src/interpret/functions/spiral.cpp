// SPDX-License-Identifier: Apache-2.0
// Spirals and cones about the centre of the plane: G02.1/G03.1 (type 1), G02/G03 with Q, K or L (type 2; M700 6.13).
#include <cmath>
#include <numbers>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSame = 1e-9;       // mm
constexpr double kSameAngle = 1e-9;  // rad

struct Spiral {
  Circle circle;
  double delta = 0;  ///< angle from the start to the end in the direction of travel, rad, [0, 2 pi)
};

/// Circle and end angle; the number of turns is set later.
Spiral spiral_about(const double start[2], const double end[2], const double center[2], bool ccw) {
  Spiral s;
  s.circle.center[0] = start[0] + center[0];
  s.circle.center[1] = start[1] + center[1];
  const double a[2] = {-center[0], -center[1]};
  const double b[2] = {end[0] - s.circle.center[0], end[1] - s.circle.center[1]};
  s.circle.radius_start = std::hypot(a[0], a[1]);
  s.circle.radius_end = std::hypot(b[0], b[1]);
  s.circle.angle_start = s.circle.radius_start > kSame ? std::atan2(a[1], a[0]) : std::atan2(b[1], b[0]);
  if (s.circle.radius_end > kSame && s.circle.radius_start > kSame) {
    s.delta = (std::atan2(b[1], b[0]) - s.circle.angle_start) * (ccw ? 1 : -1);
    s.delta -= kTurn * std::floor(s.delta / kTurn);
    if (kTurn - s.delta < kSameAngle || s.delta < kSameAngle) s.delta = 0;
  }
  return s;
}

/// Full turns in addition to `delta`, from the number of turns that follows from the step (Q or K). M700 6.13, type 2: P70 when the end point to which the step
/// leads differs from the commanded one by more than #8075.
Execution turns_by_step(BlockInHand& in, const Spiral& s, double turns, Role word, double* whole) {
  const double angle = turns * kTurn;
  *whole = std::fmax(0.0, std::nearbyint((angle - s.delta) / kTurn));
  const double off = 2 * s.circle.radius_end * std::fabs(std::sin((angle - s.delta) / 2));
  if (off > in.settings.spiral_tolerance + kSame) return in.raise(Condition::arc_deviation, word, s.circle.radius_end);
  if (std::fabs(s.delta + *whole * kTurn - angle) > kTurn / 2) return in.raise(Condition::arc_deviation, word, s.circle.radius_end);
  return Execution::done;
}

/// A word with the number of pitches.
Execution pitches(BlockInHand& in, Role word, uint32_t* number) {
  if (!whole_number(in.words.get(word), number) || *number > in.dialect->rules.range.most_pitches) return in.raise(Condition::value_range, word, in.words.get(word));
  return Execution::done;
}

/// The basic axis along which the height of a cone (type 2) is measured: Y in G18, X in G19, otherwise Z; its word is J, I or K.
unsigned height_axis(const PlaneAxes& plane) { return plane.plane == Plane::zx ? 1 : plane.plane == Plane::yz ? 0 : 2; }

/// Type 2: Q counts before K, and K before L.
Execution turns_of_type_2(BlockInHand& in, const Spiral& s, double height, Role height_word, double* whole) {
  const Command& w = in.words;
  if (w.has(Role::spiral_step)) {
    const double step = length_of(in, Role::spiral_step), change = s.circle.radius_end - s.circle.radius_start;
    if (step == 0 || step * change < 0) return in.raise(Condition::format_error, Role::spiral_step, w.get(Role::spiral_step));
    return turns_by_step(in, s, std::fabs(change / step), Role::spiral_step, whole);
  }
  if (w.has(height_word) && std::fabs(height) > kSame) {
    const double step = length_of(in, height_word);
    if (step == 0 || step * height < 0) return in.raise(Condition::format_error, height_word, w.get(height_word));
    return turns_by_step(in, s, std::fabs(height / step), height_word, whole);
  }
  uint32_t number = 1;
  if (w.has(Role::spiral_pitches)) {
    const Execution did = pitches(in, Role::spiral_pitches, &number);
    if (did != Execution::done) return did;
  }
  *whole = number > 0 ? number - 1 : 0;  // Ln means at least n - 1 turns, and fewer than n
  return Execution::done;
}

/// Type 1: Pn means at least n turns, and fewer than n + 1.
Execution turns_of_type_1(BlockInHand& in, double* whole) {
  uint32_t number = 0;
  if (in.words.has(Role::helix_pitches)) {
    const Execution did = pitches(in, Role::helix_pitches, &number);
    if (did != Execution::done) return did;
  }
  *whole = number;
  return Execution::done;
}

}  // namespace

bool means_spiral(const BlockInHand& in) {
  const Command& w = in.words;
  return in.settings.spiral_type_2 && !w.has(Role::arc_radius) && w.any({Role::spiral_step, Role::spiral_pitches, vector_along(height_axis(plane_axes(in)))});
}

Execution move_spiral(BlockContext& in, const AxisVec& target, uint32_t commanded, bool ccw) {
  const PlaneAxes plane = plane_axes(in);
  const Command& w = in.words;
  if (plane.h < 0 || plane.v < 0) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  const bool type_2 = in.settings.spiral_type_2;
  if (type_2) {  // G02.1 and G03.1 belong to type 1; mirror image and scaling are not possible
    const State& state = in.state;
    if (is_spiral(state.modal.of(Mode::motion)) || state.any_mirror() != 0 || !state.modal.is(Function::scaling_off))
      return in.raise_mode(Condition::illegal_g, Mode::motion);
  }
  if (in.state.compensated()) return in.raise_mode(Condition::not_in_compensation, Mode::motion);
  if (starts_or_ends_compensation(in)) return in.raise_mode(Condition::arc_in_compensation_start, Mode::radius);
  if (!w.has(plane.center[0]) && !w.has(plane.center[1])) return in.raise_mode(Condition::center_missing, Mode::motion);
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  // In inch a degree of a rotary axis has the length of a tenth of an inch in arcs (3.2 note 5); 6.13 does not say what that means here.
  const uint32_t turning = in.rotary & (1u << h | 1u << v);
  if (turning != 0 && in.dialect->rules.arc.degree_is_tenth_of_inch && in.state.modal.is(Function::inch) && !in.state.map.active())
    return in.raise(Condition::no_function, in.axis_words.word(first_of(turning)));
  double center[2] = {0, 0};
  for (unsigned i = 0; i < 2; ++i)
    if (w.has(plane.center[i])) center[i] = length_of(in, plane.center[i]);
  if (program_mapped(in)) {
    if (tilts_plane(in, h, v)) return in.raise_mode(Condition::plane_mismatch, Mode::motion);  // 13.21
    if (scaled_unevenly(in, h, v)) return in.raise_mode(Condition::arc_deviation, Mode::motion);  // 13.19 (4)
    map_arc(in, h, v, center, &ccw);
  }
  const MoveFrame frame = frame_of_move(in, target, commanded);
  const double from[2] = {frame.start[h], frame.start[v]}, to[2] = {frame.end[h], frame.end[v]};
  Spiral s = spiral_about(from, to, center, ccw);
  const Role height_word = vector_along(height_axis(plane));
  const int normal = in.axis_called(basic_along(height_axis(plane)));
  const double height = normal >= 0 ? frame.end[static_cast<unsigned>(normal)] - frame.start[static_cast<unsigned>(normal)] : 0;
  double whole = 0;
  const Execution did = type_2 ? turns_of_type_2(in, s, height, height_word, &whole) : turns_of_type_1(in, &whole);
  if (did != Execution::done) return did;
  s.circle.sweep = (ccw ? 1 : -1) * (s.delta + whole * kTurn);
  if (s.circle.sweep == 0) {  // there is no angle, so a line leads to the end
    LinearStyle style;
    style.feed_mm_min = feed_for(in, frame.start, frame.end);
    style.special_feed = special_feed(in);
    move_linear(in, frame.end, commanded, style);
    return Execution::done;
  }
  emit_circular(in, frame, plane, s.circle, NC_MOVE_SPIRAL);
  return Execution::done;
}

}  // namespace nc
