// SPDX-License-Identifier: Apache-2.0
// Scaling G50 G51 (M700 13.19) and coordinate rotation by program G68 G69 (13.20). How they map a point is in program_map.cpp.
#include <cmath>
#include <numbers>

#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// A parameter has a factor that is in its range.
bool in_range_of_scale(const InForce& in, double factor) {
  const RangeRules& range = in.dialect->rules.range;
  return factor >= range.least_scale && factor <= range.most_scale;
}

/// The factor: P of G51, or else #8072; a parameter that is out of range counts as 1.
bool factor_of(const BlockInHand& in, double* factor) {
  const Command& w = in.words;
  if (w.has(Role::scaling_factor)) return in.dialect->rules.scaling.factor_of_word(w.get(Role::scaling_factor), w.pointed(Role::scaling_factor), in.dialect->rules.range, factor);
  *factor = in.settings.scaling_factor;
  if (!in_range_of_scale(in, *factor)) *factor = 1;
  return true;
}

/// Factor of each axis: of I J K, or of P, else of its parameter (HX 15.2.2). False: out of range, and `word` says which one.
bool factors_of_axes(const BlockInHand& in, AxisVec& factors, Role* word) {
  const Command& w = in.words;
  const auto of_word = in.dialect->rules.scaling.factor_of_word;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    factors[i] = in.settings.axis_factor[i];
    if (!in_range_of_scale(in, std::fabs(factors[i]))) factors[i] = 1;
    *word = Role::scaling_factor;
    for (unsigned k = 0; k < 3; ++k)
      if (in.settings.plane_basic[k] == in.axis_words.word(i) && w.has(vector_along(k))) *word = vector_along(k);
    if (w.has(*word) && !of_word(w.get(*word), w.pointed(*word), in.dialect->rules.range, &factors[i])) return false;
  }
  return true;
}

}  // namespace

Execution begin_map_about_zero(BlockContext& in, Role word, bool (*set)(BlockInHand& in, ProgramMaps* maps)) {
  Command& w = in.words;
  const FunctionRow& row = *w.one_shot;
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_code(Condition::plane_mismatch, row);
  if (in.state.compensated()) return in.raise_code(Condition::not_in_compensation, row);
  if (!w.has(word)) return in.raise(Condition::words_missing, word);
  const AxisVec programmed = program_mapped(in) ? to_program(in, in.position()) : in.position();
  ProgramMaps maps = in.records->maps;
  maps.start[0] = programmed[static_cast<unsigned>(plane.h)];
  maps.start[1] = programmed[static_cast<unsigned>(plane.v)];
  if (!set(in, &maps)) return in.raise(Condition::value_range, word, w.get(word));
  in.change(&ProgramRecords::maps, maps);
  in.state.map_begins = true;
  in.program_changed();
  w.present &= ~in.set_of({word});
  if (w.target.axes() == 0) return Execution::done;
  const Function motion = in.state.modal.of(Mode::motion);
  return is_line(motion) ? move_by_words(in) : in.raise_code(Condition::not_accepted, row);
}

namespace {

bool set_factor_of_plane(BlockInHand& in, ProgramMaps* maps) {
  const Command& w = in.words;
  double factor = 1;
  if (!in.dialect->rules.scaling.factor_of_word(w.get(Role::scaling_factor), w.pointed(Role::scaling_factor), in.dialect->rules.range, &factor)) return false;
  const PlaneAxes plane = plane_axes(in);
  in.state.scaled = static_cast<uint8_t>(1u << plane.h | 1u << plane.v);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    maps->scaling_factor[i] = factor;
    maps->scaling_center[i] = 0;
  }
  in.state.modal.set(Function::scaling_on);
  return true;
}

bool set_turn_of_plane(BlockInHand& in, ProgramMaps* maps) {
  const Command& w = in.words;
  maps->rotation_deg = std::fmod(length_value(in, w.written(Role::rotation_angle), true, true), 360);
  maps->rotation_center[0] = maps->rotation_center[1] = 0;
  in.state.rotated = true;
  in.state.modal.set(Function::rotation_on);
  return true;
}

}  // namespace

Execution do_scaling(BlockContext& in) {
  const Command& w = in.words;
  const ScalingRules& rules = in.dialect->rules.scaling;
  if (rules.about_zero) return begin_map_about_zero(in, Role::scaling_factor, set_factor_of_plane);
  if (!w.has(Role::scaling_factor) && rules.factor_required) return in.raise(Condition::words_missing, Role::scaling_factor);
  if (rules.factor_by_axis && w.has(Role::scaling_factor) && w.any({Role::vector_x, Role::vector_y, Role::vector_z}))  // HX 15.2.1, 15.2.2: two formats
    return in.raise(Condition::two_words, Role::scaling_factor, w.get(Role::scaling_factor));
  AxisVec factors;
  Role word = Role::scaling_factor;
  double factor = 1;
  const bool good = rules.factor_by_axis ? factors_of_axes(in, factors, &word) : factor_of(in, &factor);
  if (!good) return in.raise(Condition::value_range, word, w.get(word));
  for (unsigned i = 0; i < in.axis_count && !rules.factor_by_axis; ++i) factors[i] = factor;  // (8): the newest counts for all axes
  const AxisVec at = to_program(in, in.position());
  if (rules.all_linear_axes && (w.target.axes() & in.rotary) != 0) return in.raise_axis(Condition::illegal_axis, first_of(w.target.axes() & in.rotary));  // it has no length
  const uint32_t axes = rules.all_linear_axes ? ~in.rotary & ((1u << in.axis_count) - 1) : w.target.axes();
  ProgramMaps maps = in.records->maps;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((axes >> i) & 1) == 0) continue;
    const bool given = w.target.commands(i), incremental = w.target.counts_on(i);
    maps.scaling_center[i] = !given ? at[i] : incremental ? at[i] + w.target[i] : w.target[i];
  }
  maps.scaling_factor = factors;
  in.change(&ProgramRecords::maps, maps);
  in.state.scaled |= static_cast<uint8_t>(axes);
  if (in_figure(in)) in.state.figure_scaled |= static_cast<uint8_t>(axes);  // (6)
  in.program_changed();
  in.state.modal.set(Function::scaling_on);
  return Execution::done;
}

void end_scaling(InForce& in) {
  in.state.scaled = 0;
  in.state.map_begins = false;
  in.program_changed();
  in.state.modal.set(Function::scaling_off);
}

Execution do_rotation(BlockContext& in) {
  const Command& w = in.words;
  if (in.dialect->rules.rotation.about_zero) return begin_map_about_zero(in, Role::rotation_angle, set_turn_of_plane);
  if (w.has(Role::vector_x) && w.has(Role::vector_y) && w.has(Role::vector_z)) {
    for (const FunctionRow* row : w.functions)  // 12.3, interference with other functions (1)
      if (row->function == Function::length_along_tool) return in.raise_code(Condition::space_conversion_block, *row);
    const bool along = in.state.modal.is(Function::length_along_tool);
    return in.raise_code(along ? Condition::tool_axis_code : Condition::space_conversion, *w.one_shot);  // 13.22
  }
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_code(Condition::plane_mismatch, *w.one_shot);
  for (const FunctionRow* row : w.functions)
    if (is_plane(row->function) && !in.dialect->rules.rotation.plane_in_block) return in.raise_code(Condition::plane_in_rotation, *row);  // (13)
  ProgramMaps maps = in.records->maps;
  const bool by_parameter = !w.has(Role::rotation_angle) && in.dialect->rules.rotation.angle_by_parameter;
  if (w.has(Role::rotation_angle) || by_parameter) {                                                         // (4), (5)
    const double r = by_parameter ? in.settings.rotation_deg : length_value(in, w.written(Role::rotation_angle), true, true);
    const double before = in.state.modal.is(Function::incremental) ? maps.rotation_deg : 0;
    maps.rotation_deg = std::fmod(before + r, 360);
  }
  const AxisVec at = in_front_of_mirror(in, in.position());
  const int axes[2] = {plane.h, plane.v};
  for (unsigned i = 0; i < 2; ++i) {
    const auto axis = static_cast<unsigned>(axes[i]);
    const bool given = w.target.commands(axis);  // the word is absolute, also in G91
    const bool scaled = given && in.dialect->rules.rotation.centre_is_scaled && (in.state.scaled >> axis & 1) != 0;
    const double point = scaled ? maps.scaling_center[axis] + maps.scaling_factor[axis] * (w.target[axis] - maps.scaling_center[axis]) : w.target[axis];
    maps.rotation_center[i] = given ? point : at[axis];
  }
  in.change(&ProgramRecords::maps, maps);
  in.state.rotated = true;
  in.program_changed();
  in.state.modal.set(Function::rotation_on);
  return Execution::done;
}

void end_rotation(InForce& in) {
  in.state.rotated = false;
  in.state.map_begins = false;
  in.program_changed();
  in.state.modal.set(Function::rotation_off);
}

void keep_rotation_center(InForce& in, const AxisVec& zero_before) {
  if (!in.state.rotated || in.dialect->rules.rotation.about_zero) return;
  ProgramMaps maps = in.records->maps;
  const PlaneAxes plane = plane_axes(in);
  const int axes[2] = {plane.h, plane.v};
  for (unsigned i = 0; i < 2; ++i) {
    const auto axis = static_cast<unsigned>(axes[i]);
    maps.rotation_center[i] += zero_before[axis] - in.zero()[axis];
  }
  in.change(&ProgramRecords::maps, maps);
}

}  // namespace nc
