// SPDX-License-Identifier: Apache-2.0
// G43.1: the length of the tool is compensated along its axis, which rotary axes turn (M700 12.3).
#include <cmath>
#include <numbers>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The two axes that turn the tool: the first about X or Y, the second about Z (12.3 (2)).
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

double radians(const AxisVec& machine, int axis) { return machine[static_cast<unsigned>(axis)] * (std::numbers::pi / 180); }

/// 12.3, "vectors": (1) A and C, (2) B and C, at machine positions. Whole quarters of a turn are exact.
void add_along_tool(const InForce& in, const AxisVec& machine, SpaceVector& vector) {
  const TurningPair pair = turning_pair(in);
  const double tilt = radians(machine, pair.tilt), turn = radians(machine, pair.turn), length = in.state.tool_length;
  const auto exact = [](double value) { return std::fabs(value) < 1e-15 ? 0 : value; };
  const double sine = exact(std::sin(tilt)), cosine = exact(std::cos(tilt));
  const double turn_sine = exact(std::sin(turn)), turn_cosine = exact(std::cos(turn));
  vector.v[0] += length * sine * (pair.about_x ? turn_sine : turn_cosine);
  vector.v[1] += length * sine * (pair.about_x ? -turn_cosine : turn_sine);
  vector.v[2] += length * cosine;
}

}  // namespace

SpaceVector space_vector(const InForce& in, const AxisVec& machine) {
  SpaceVector vector = in.state.space;
  if (in.state.tool_length == 0) return vector;
  if (!vector.on) {
    vector.on = true;
    for (unsigned i = 0; i < 3; ++i) vector.axis[i] = static_cast<uint8_t>(in.axis_called(basic_along(i)));
  }
  vector.turns = true;
  add_along_tool(in, machine, vector);
  return vector;
}

Execution set_length_along_tool(BlockInHand& in, double length) {
  State& state = in.state;
  const TurningPair pair = turning_pair(in);
  if (!pair.complete()) return in.raise_function(Condition::tool_axis_pair, Function::length_along_tool);
  uint32_t axes = 1u << pair.tilt | 1u << pair.turn;
  for (unsigned i = 0; i < 3; ++i) {
    const int axis = in.axis_called(basic_along(i));
    if (axis < 0) return in.raise(Condition::illegal_axis, basic_along(i));
    if (state.space.on && state.space.axis[i] != axis) return in.raise_function(Condition::tool_axis_pair, Function::length_along_tool);
    axes |= 1u << axis;
  }
  if ((axes & in.closed_axes) != 0) return in.raise_axis(Condition::no_reference, first_of(axes & in.closed_axes));  // 12.3 (3)
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
