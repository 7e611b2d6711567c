// SPDX-License-Identifier: Apache-2.0
// G10 I J, G10 K: a program sets the parameters of the rotation of the workpiece coordinate systems (M700 13.21). The numbers of these parameters ("coord rot
// plane, centre, vector, angle") belong to the family; 13.11 shows the first of them.
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "interpret/functions/functions.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr ParameterOf kVectorH = {Parameter::work_turn_vector, 0};
constexpr ParameterOf kVectorV = {Parameter::work_turn_vector, 1};
constexpr ParameterOf kAngle = Parameter::work_turn_angle;

/// Stores a value in a parameter, rounded to nine decimals.
bool store(BlockInHand& in, ParameterOf parameter, double value) {
  constexpr double kDecimals = 1e9;
  const double rounded = std::nearbyint(std::fabs(value) * kDecimals) / kDecimals;
  return in.set_parameter(parameter, value < 0 && rounded != 0 ? -rounded : rounded);
}

}  // namespace

Execution do_work_rotation(BlockContext& in) {
  const Command& w = in.words;
  // Axis words, P and R belong to another G10.
  if (w.target.axes() != 0 || w.any({Role::input_number, Role::input_amount})) return in.raise_code(Condition::format_error, *w.one_shot);
  if (in.state.map.kind != AxisMap::Kind::none) return in.raise_code(Condition::mill_code, *w.one_shot);
  // A component that is not commanded keeps its value.
  const double i = w.has(Role::vector_x) ? length_of(in, Role::vector_x) : in.settings.work_turn_vector[0];
  const double j = w.has(Role::vector_y) ? length_of(in, Role::vector_y) : in.settings.work_turn_vector[1];
  for (const Role word : {Role::vector_x, Role::vector_y}) {
    const double component = word == Role::vector_x ? i : j;
    if (w.has(word) && !(std::fabs(component) <= in.dialect->rules.range.largest_turn_vector))
      return in.raise(Condition::value_range, word, w.get(word));
  }
  const bool vector = w.any({Role::vector_x, Role::vector_y}) && (i != 0 || j != 0);
  bool kept = true;
  if (w.has(Role::turn_angle)) {
    const double k = length_value(in, w.written(Role::turn_angle), true, true);
    if (!(std::fabs(k) <= in.dialect->rules.range.largest_turn_deg)) return in.raise(Condition::value_range, Role::turn_angle, w.get(Role::turn_angle));
    // "Set the vector contents to 0 when commanding coordinate rotation angle."
    if (vector) return in.raise(Condition::format_error, Role::turn_angle, w.get(Role::turn_angle));
    kept = store(in, kVectorH, 0) && store(in, kVectorV, 0) && store(in, kAngle, k);
  } else {
    kept = store(in, kVectorH, i) && store(in, kVectorV, j);
    if (vector) kept = kept && store(in, kAngle, std::atan2(j, i) * 180 / std::numbers::pi);
  }
  if (!kept) return in.raise_code(Condition::parameter_input, *w.one_shot);
  take_work_rotation(in, false);  // (4): it acts at once
  const Compensation& comp = in.state.comp;
  const bool tilted = comp.side != 0 && tilts_plane(in, comp.axis[0], comp.axis[1]);
  return tilted ? in.raise_code(Condition::plane_mismatch, *w.one_shot) : Execution::done;
}

}  // namespace nc
