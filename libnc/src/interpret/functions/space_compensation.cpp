// SPDX-License-Identifier: Apache-2.0
// Three-dimensional radius compensation: G41 and G42 with I, J and K together (M700 12.5). The geometry is offset/space.hpp.
#include <cmath>

#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr Role kVector[3] = {Role::vector_x, Role::vector_y, Role::vector_z};

bool all_three(const BlockInHand& in) { return in.words.has(kVector[0]) && in.words.has(kVector[1]) && in.words.has(kVector[2]); }

/// 12.5, "compensation space": of an axis and its parallel the one that the start block names; where it names both or none, the one that the code of the plane
/// in force has chosen, also of the third pair, which lies in no plane (the table's G17 W).
Execution choose_space(BlockInHand& in, SpaceVector* space) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  const PlaneAxes in_plane = plane_axes(in);
  for (unsigned pair = 0; pair < 3; ++pair) {
    const int basic = in.axis_called(basic_along(pair));
    int axis = axis_of_pair(in, pair);
    const bool names_parallel = axis >= 0 && axis != basic && in.words.target.commands(static_cast<unsigned>(axis));
    const bool names_basic = basic >= 0 && in.words.target.commands(static_cast<unsigned>(basic));
    if (!names_parallel) {
      const int of_plane = pair == plane.first ? in_plane.h : pair == plane.second ? in_plane.v : in.state.third_axis;
      const bool of_plane_named = of_plane >= 0 && in.words.target.commands(static_cast<unsigned>(of_plane));
      axis = names_basic && !of_plane_named ? basic : of_plane;
    }
    if (axis < 0 || (in.rotary >> axis & 1) != 0) return in.raise(Condition::illegal_axis, basic_along(pair));
    space->axis[pair] = static_cast<uint8_t>(axis);
  }
  return Execution::done;
}

/// The vector stands mirrored on these axes and on no others.
void set_mirrored(InForce& in, uint8_t axes) {
  if (in.state.space_mirror == axes) return;
  in.state.space_mirror = axes;
  in.program_changed();
}

uint8_t axes_of(const SpaceVector& space) { return static_cast<uint8_t>(1u << space.axis[0] | 1u << space.axis[1] | 1u << space.axis[2]); }

/// 12.5, "vector": along I J K, as long as the amount; against it with G42, and with a negative amount. Words that the block does not have
/// are 0.
Execution make_vector(BlockInHand& in, Function side) {
  State& state = in.state;
  double squares = 0;
  for (unsigned i = 0; i < 3; ++i) {
    state.space.v[i] = in.words.has(kVector[i]) ? length_of(in, kVector[i]) : 0;
    squares += state.space.v[i] * state.space.v[i];
  }
  if (squares == 0) return in.raise(Condition::no_direction, kVector[0], 0);
  if (!std::isfinite(squares)) return in.raise(Condition::value_range, kVector[0], in.words.has(kVector[0]) ? in.words.get(kVector[0]) : 0);
  const double radius = radius_amount(in, state.space_number);
  const double divisor = in.settings.space_divisor != 0 ? in.settings.space_divisor : std::sqrt(squares);
  const double factor = (side == Function::comp_right ? -radius : radius) / divisor;
  for (double& along : state.space.v) along *= factor;
  set_mirrored(in, state.any_mirror() & axes_of(state.space));
  in.words.comp_command = true;
  return Execution::done;
}

bool straight(const InForce& in) { return is_line(in.state.modal.of(Mode::motion)); }

/// D00 cancels the mode as G40 does: a D behind it is no code of compensation that would start it again, or another one (restriction (1)).
void cancel_by_number(BlockInHand& in) {
  end_space_compensation(in);
  in.state.modal.set(Function::comp_off);
}

}  // namespace

bool means_space(const BlockInHand& in) {
  if (!in.dialect->rules.compensation.vector_by_words) return false;
  return in.state.space.on || (in.state.comp.side == 0 && all_three(in));  // in the mode of the plane they mean nothing more
}

Execution set_space_compensation(BlockInHand& in, Function function) {
  State& state = in.state;
  if (in.words.has(Role::offset_number)) {
    const Execution did = take_radius_number(in);
    if (did != Execution::done) return did;
  } else if (state.modal.d_given == 0) {
    return in.raise(Condition::no_offset_number, Role::offset_number);
  }
  if (state.modal.d == 0) {  // D00 cancels, and starts nothing
    cancel_by_number(in);
    return Execution::done;
  }
  state.space_number = state.modal.d;
  if (state.space.on) return gives_space_vector(in) ? make_vector(in, function) : Execution::done;  // (5): from the next I J K on
  if (!straight(in) || state.map.active() || state.spline.on) return in.raise(Condition::space_compensation, Role::vector_z);
  if (state.cycle.kind != CycleKind::none && in.words.motion == nullptr) return in.raise_function(Condition::cycle_in_compensation, function);
  SpaceVector space;
  const Execution did = choose_space(in, &space);
  if (did != Execution::done) return did;
  for (unsigned i = 0; state.tool_length != 0 && i < 3; ++i)
    if (space.axis[i] != in.axis_called(basic_along(i))) return in.raise_axis(Condition::illegal_axis, space.axis[i]);
  space.on = true;
  state.space = space;
  return make_vector(in, function);
}

Execution change_space_number(BlockInHand& in) {
  uint32_t number = 0;
  const bool of_position = in.words.one_shot != nullptr && offsets_position(in.words.one_shot->function);
  const Execution did = of_position ? take_radius_number(in) : offset_number(in, Role::offset_number, &number);
  if (did != Execution::done || of_position || number != 0) return did;  // restriction (1): it counts beside a code of the mode
  cancel_by_number(in);
  in.words.comp_command = true;
  return Execution::done;
}

bool gives_space_vector(const BlockInHand& in) {
  if (!straight(in) || in.words.one_shot != nullptr || has_words_of_call(in)) return false;  // I J K beside M98 are the centre of a figure (13.3.3)
  return in.words.any({kVector[0], kVector[1], kVector[2]});
}

void end_space_compensation(InForce& in) {
  in.state.space = {};
  set_mirrored(in, 0);
}

/// 12.5 (8): what is mirrored behind the compensation is the place of the tool, which an axis comes to with its next command (13.6). Until then its component of
/// the vector stays as it is.
void mirror_space_vector(InForce& in, uint32_t commanded) {
  State& state = in.state;
  if (!state.space.on) return;
  const uint32_t axes = commanded & axes_of(state.space);
  set_mirrored(in, static_cast<uint8_t>((state.space_mirror & ~axes) | (state.any_mirror() & axes)));
}

SpaceVector space_compensation_vector(const InForce& in) {
  SpaceVector vector = in.state.space;
  if (!vector.on || !in.state.mapped) return vector;
  AxisVec along;
  for (unsigned i = 0; i < 3; ++i) along[vector.axis[i]] = (in.state.space_mirror >> vector.axis[i] & 1) != 0 ? -vector.v[i] : vector.v[i];
  if (in.state.work_turned) along = work_rotation(in, in.records->work_turn.reached).direct(along);
  for (unsigned i = 0; i < 3; ++i) vector.v[i] = along[vector.axis[i]];
  return vector;
}

Execution change_space_vector(BlockInHand& in) { return make_vector(in, in.state.modal.of(Mode::radius)); }

}  // namespace nc
