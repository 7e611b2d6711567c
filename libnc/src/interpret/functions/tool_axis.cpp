// SPDX-License-Identifier: Apache-2.0
// G43.1: the length of the tool is compensated along its axis, which rotary axes turn (M700 12.3).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The two axes of the part system that turn the tool: the first about X or Y, the second about Z (12.3 (2)).
struct TurningPair {
  int tilt = -1, turn = -1;
  bool about_x = false;
  bool complete() const { return tilt >= 0 && turn >= 0; }
};

int turning_axis(const InForce& in, Role name) {
  const int axis = in.axis_called(name);
  return axis >= 0 && (in.rotary >> axis & 1) != 0 ? axis : -1;
}

/// The manual's parameter for the pair has no number. A machine that has both A and B gets A, the first that 12.3 names.
TurningPair turning_pair(const InForce& in) {
  const int a = turning_axis(in, Role::turn_x);
  return {a >= 0 ? a : turning_axis(in, Role::turn_y), turning_axis(in, Role::turn_z), a >= 0};
}

/// How the tool stands, degrees.
struct ToolAngles {
  double tilt = 0, turn = 0;
  bool about_x = false;  ///< `tilt`
};

/// 12.3, "vectors" (3): of servo axes their machine positions, of mechanical axes what the machine says.
ToolAngles tool_angles(const InForce& in, const AxisVec& machine) {
  if (turned_outside(in)) return {in.state.tool_angle[0], in.state.tool_angle[1], in.system->tool_axis == NC_TOOL_AXIS_MECHANICAL_A};
  const TurningPair pair = turning_pair(in);
  return {machine[static_cast<unsigned>(pair.tilt)], machine[static_cast<unsigned>(pair.turn)], pair.about_x};
}

/// 12.3, "vectors": (1) A and C, (2) B and C. Whole quarters of a turn are exact.
void add_along_tool(const InForce& in, const AxisVec& machine, SpaceVector& vector) {
  const ToolAngles angles = tool_angles(in, machine);
  const double tilt = angles.tilt * (std::numbers::pi / 180), turn = angles.turn * (std::numbers::pi / 180), length = in.state.tool_length;
  const auto exact = [](double value) { return std::fabs(value) < 1e-15 ? 0 : value; };
  const double sine = exact(std::sin(tilt)), cosine = exact(std::cos(tilt));
  const double turn_sine = exact(std::sin(turn)), turn_cosine = exact(std::cos(turn));
  vector.v[0] += length * sine * (angles.about_x ? turn_sine : turn_cosine);
  vector.v[1] += length * sine * (angles.about_x ? -turn_cosine : turn_sine);
  vector.v[2] += length * cosine;
}

/// The block begins compensation, or what the machine has been told since the angles were read may have turned the tool.
bool needs_tool_angles(const BlockInHand& in) {
  if (in.state.tool_length != 0 && in.state.tool_angles_old) return true;
  return std::any_of(in.words.functions.begin(), in.words.functions.end(), [](const FunctionRow* row) { return row->function == Function::length_along_tool; });
}

/// Bit i: axis i has to do with the length along the tool (12.3 (3)).
uint32_t axes_along_tool(const InForce& in) {
  const TurningPair pair = turning_pair(in);
  uint32_t axes = turned_outside(in) ? 0u : 1u << pair.tilt | 1u << pair.turn;
  for (unsigned i = 0; i < 3; ++i) axes |= 1u << in.axis_called(basic_along(i));
  return axes;
}

}  // namespace

bool turned_outside(const InForce& in) { return in.system->tool_axis != NC_TOOL_AXIS_TURNED; }

Execution take_tool_angles(BlockInHand& in) {
  if (!needs_tool_angles(in)) return Execution::done;
  if (!in.world_fresh) return in.need(NC_SYNC_INPUT | (in.in_contour() ? BlockInHand::kSyncAhead : 0u));
  in.state.tool_angle[0] = in.world.tool_angle[0];
  in.state.tool_angle[1] = in.world.tool_angle[1];
  in.state.tool_angles_old = false;
  return Execution::done;
}

void cancel_length_by_hand(InForce& in, uint32_t axes) {
  State& state = in.state;
  if (!in.dialect->rules.reference.hand_cancels_length || state.modal.is(Function::length_off)) return;
  if (!state.modal.is(Function::length_along_tool)) {
    cancel_length_of(in, axes);
    if (state.modal.is(Function::length_off)) state.applied[state.length_axis] = 0;
    return;
  }
  if ((axes & axes_along_tool(in)) == 0) return;
  state.tool_length = state.length_by_handle = 0;
  state.length_changed_by_handle = false;
  state.modal.set(Function::length_off);
  state.moved_space = state.moved_space.on ? space_compensation_vector(in) : SpaceVector{};
}

SpaceVector space_vector(const InForce& in, const AxisVec& machine) {
  SpaceVector vector = space_compensation_vector(in);
  if (in.state.tool_length == 0) return vector;
  if (!vector.on) {
    vector.on = true;
    for (unsigned i = 0; i < 3; ++i) vector.axis[i] = static_cast<uint8_t>(in.axis_called(basic_along(i)));
  }
  vector.turns = !turned_outside(in);
  add_along_tool(in, machine, vector);
  return vector;
}

Execution set_length_along_tool(BlockInHand& in, double length) {
  State& state = in.state;
  if (!turned_outside(in) && !turning_pair(in).complete()) return in.raise_function(Condition::tool_axis_pair, Function::length_along_tool);
  for (unsigned i = 0; i < 3; ++i) {
    const int axis = in.axis_called(basic_along(i));
    if (axis < 0) return in.raise(Condition::illegal_axis, basic_along(i));
    if (state.space.on && state.space.axis[i] != axis) return in.raise_function(Condition::tool_axis_pair, Function::length_along_tool);
  }
  const uint32_t closed = axes_along_tool(in) & in.closed_axes;
  if (closed != 0) return in.raise_axis(Condition::no_reference, first_of(closed));  // 12.3 (3), which does not ask for the reference of mechanical axes
  if (state.map.active()) return in.raise_function(Condition::mill_modal, Function::length_along_tool);
  state.tool_length = length;
  // The length that has been compensated so far goes: its axis is commanded to where it is.
  const uint32_t bit = 1u << state.length_axis;
  if (state.applied[state.length_axis] != 0 && (in.words.target.axes() & bit) == 0)
    in.words.target.set(state.length_axis, TargetKind::absolute, in.position()[state.length_axis]);
  state.length_value = 0;
  // The vector is gone to at once, even where the block names no axis, as the printed example of 12.3 needs it.
  in.words.comp_command = true;
  return Execution::done;
}

}  // namespace nc
