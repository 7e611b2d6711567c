// SPDX-License-Identifier: Apache-2.0
// Cylindrical interpolation G07.1 (G107, M700 6.9) and polar coordinate interpolation G12.1/G13.1 (G112/G113, M700 6.10): modes in which a plane is
// programmed and the linear and rotary axes of the machine follow it. A move gets an AxisMap for this (path/shape.hpp).
#include <cmath>
#include <numbers>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"

namespace nc {
namespace {

/// Raises an alarm (P485, P486) in modes in which neither of the two can be commanded.
Execution check_modes_before_milling(BlockInHand& in, const FunctionRow& row) {
  const State& state = in.state;
  const bool polar = row.function == Function::polar_on;
  const Condition modal = polar ? Condition::polar_modal : Condition::mill_modal, mode = polar ? Condition::polar_state : Condition::mill_state;
  if (state.high_accuracy != 0) return in.raise_code(Condition::not_accepted, row);  // 13.15 (3); appendix 1 has P126
  if (state.compensated()) return in.raise_code(modal, row);
  if (state.modal.is(Function::surface_on)) return in.raise_code(modal, row);
  if (!state.modal.is(Function::rotation_off) || state.work_turned) return in.raise_code(modal, row);
  if (in.dialect->rules.mill.bars_scaling && state.scaled != 0) return in.raise_code(modal, row);
  if (is_space_arc(state.modal.of(Mode::motion))) return in.raise_code(modal, row);  // 6.14 (a)
  if (state.any_mirror() != 0) return in.raise_code(mode, row);
  if (!state.modal.is(Function::normal_line_off)) return in.raise_code(mode, row);
  return Execution::done;
}

/// HX 4.7: the axis that the block of the cylinder names; 4.6: the one of the parameter, or the first that turns.
int rotary_axis_of_block(const BlockInHand& in) {
  const uint32_t named = in.words.target.axes() & in.rotary;
  if (named != 0) return static_cast<int>(first_of(named));
  const unsigned number = in.settings.polar_axis[1];
  if (number != 0) return number <= in.axis_count && ((in.rotary >> (number - 1)) & 1) != 0 ? static_cast<int>(number - 1) : -1;
  return in.rotary != 0 ? static_cast<int>(first_of(in.rotary)) : -1;
}

/// Index of the rotary axis of both modes (#1516), -1 = none is named or it does not turn.
int rotary_axis(const BlockInHand& in) {
  if (in.dialect->rules.mill.rotary_in_block) return rotary_axis_of_block(in);
  const WordSlot name = in.settings.mill_axis;
  const int axis = in.axis_words.axis(name);
  return axis >= 0 && ((in.rotary >> axis) & 1) != 0 ? axis : -1;
}

/// The basic axis that is the linear axis of polar coordinate interpolation: the first, unless #1533 names another (6.10).
unsigned polar_linear(const InForce& in) {
  if (const unsigned number = in.settings.polar_axis[0]; number != 0 && number <= in.axis_count) {
    for (unsigned i = 1; i < 3; ++i)
      if (in.axis_words.word(number - 1) == in.word(basic_along(i))) return i;
  }
  for (unsigned i = 2; i > 0; --i)
    if (in.settings.polar_linear != kNoWord && in.settings.polar_linear == in.word(basic_along(i))) return i;
  return 0;
}

/// M700 6.9 (1), 6.10 (1): the code has to stand alone in its block. An axis word in it would be ignored, so it is an alarm; `own` is the axis that the code
/// itself names.
Execution stands_alone(BlockInHand& in, uint32_t own) {
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((in.words.target.axes() & ~own) >> i & 1) != 0) return in.raise(Condition::format_error, in.axis_words.word(i), in.words.target[i]);
  return Execution::done;
}

/// Does what is the same at the start of both modes: the feed per minute comes into force, the previous state is kept for the end of the mode, and a tool
/// length that was commanded without a movement acts from now on (6.9, 6.10 "tool length compensation").
void begin_mode(BlockContext& in, const FunctionRow& row) {
  State& state = in.state;
  state.mill.moved = false;
  state.mill.plane = state.modal.of(Mode::plane);
  state.mill.plane_axis[0] = state.plane_axis[0];
  state.mill.plane_axis[1] = state.plane_axis[1];
  state.mill.third_axis = state.third_axis;
  state.mill.feed_mode = state.modal.of(Mode::feed);
  state.mill.feed = state.modal.feed;
  if (state.mill.feed_mode != Function::feed_per_minute) {
    in.state.modal.set(Function::feed_per_minute);
    state.modal.feed = 0;  // so that it is P62 unless an F is commanded in the mode
  }
  for (unsigned i = 0; i < in.axis_count; ++i) state.applied[i] = i == state.length_axis ? state.length_value : 0.0;
  state.modal.set(row);
  in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION;
}

void end_mode(BlockContext& in) {
  State& state = in.state;
  state.map = AxisMap{.frozen = state.map.frozen};
  state.mill.hypothetical_word = kNoWord;
  in.state.modal.set(state.mill.plane);
  state.plane_axis[0] = state.mill.plane_axis[0];
  state.plane_axis[1] = state.mill.plane_axis[1];
  state.third_axis = state.mill.third_axis;
  if (state.mill.feed_mode != Function::feed_per_minute) {
    in.state.modal.set(state.mill.feed_mode);
    state.modal.feed = state.mill.feed;
    state.modal.feed_digit = 0;
  }
  const Function cutting = state.modal.of(Mode::cutting);
  in.state.modal.set(Function::cutting_mode);
  in.state.modal.set(Function::polar_off);
  change_cutting_mode(in, cutting);
  in.refresh_axis_words();
  in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION;
}

/// M700 6.9, 6.10: the function can be used in these modes.
bool allowed_inside(Function function) {
  switch (function) {
    case Function::rapid:
    case Function::linear:
    case Function::arc_cw:
    case Function::arc_ccw:
    case Function::dwell:
    case Function::exact_stop_once:
    case Function::comp_off:
    case Function::comp_left:
    case Function::comp_right:
    case Function::exact_stop_mode:
    case Function::cutting_mode:
    case Function::macro_call:
    case Function::macro_modal:
    case Function::macro_every_block:
    case Function::macro_modal_off:
    case Function::cycle_off:  // G80 to G89
    case Function::cycle_drill:
    case Function::cycle_spot:
    case Function::cycle_peck:
    case Function::cycle_tap:
    case Function::cycle_bore_feed:
    case Function::cycle_bore_stop:
    case Function::cycle_back_bore:
    case Function::cycle_bore_stop_dwell:
    case Function::cycle_bore_dwell:
    case Function::absolute:
    case Function::incremental:
    case Function::feed_per_minute:
    case Function::return_initial:
    case Function::return_r: return true;
    default: return false;
  }
}

/// HX 4.6: G112 bears less than the cylinder does.
bool allowed_in_polar(Function function) { return allowed_inside(function) && function != Function::rapid && mode_of(function) != Mode::cycle && mode_of(function) != Mode::return_level; }

bool allowed_here(const InForce& in, Function function) {
  return in.state.map.kind == AxisMap::Kind::polar && in.dialect->rules.mill.polar_cuts_only ? allowed_in_polar(function) : allowed_inside(function);
}

}  // namespace

Execution do_cylinder(BlockContext& in) {
  State& state = in.state;
  const Command& w = in.words;
  const FunctionRow& code = *w.one_shot;
  if (w.functions.size() > 1) return in.raise_code(Condition::format_error, code);
  if (state.map.kind == AxisMap::Kind::polar) return in.raise_code(Condition::polar_state, code);
  const bool by_word = in.dialect->rules.mill.rotary_in_block;
  const int axis = by_word && (w.target.axes() & in.rotary) == 0 ? -1 : rotary_axis(in);
  const WordSlot name = by_word && axis >= 0 ? in.axis_words.word(static_cast<unsigned>(axis)) : in.settings.mill_axis;
  if (axis < 0) return in.raise(Condition::mill_axis, name);
  if (!w.has(name)) return in.raise(Condition::format_error, name);
  if (const Execution did = stands_alone(in, 1u << axis); did != Execution::done) return did;
  const double radius = length_of(in, name, false);
  if (radius < 0) return in.raise(Condition::value_range, name, w.get(name));
  if (radius == 0) {
    if (state.map.kind == AxisMap::Kind::none) return Execution::done;
    if (state.compensated()) return in.raise_code(Condition::mill_modal, code);
    end_mode(in);
    return Execution::done;
  }
  if (state.map.kind != AxisMap::Kind::none) return in.raise_code(Condition::mill_code, code);
  const Execution did = check_modes_before_milling(in, code);
  if (did != Execution::done) return did;
  begin_mode(in, code);
  state.map.kind = AxisMap::Kind::cylinder;
  state.map.rotary = static_cast<uint8_t>(axis);
  state.map.scale = std::numbers::pi * radius / 180;
  state.refresh_special();
  // (3), (9): the plane with the rotary axis may be selected just before or just behind; some models take the one of Z and the
  // rotary axis by themselves in G19.
  if (by_word) {
    put_cylinder_axis(in);
    return Execution::done;
  }
  const int8_t rotary = static_cast<int8_t>(axis);
  const bool chosen = state.plane_axis[0] == rotary || state.plane_axis[1] == rotary;
  const bool paired = in.settings.plane_parallel[0] == name || in.settings.plane_parallel[1] == name || in.settings.plane_parallel[2] == name;
  if (!chosen && !paired && state.modal.is(Function::plane_yz)) state.plane_axis[0] = rotary;
  return Execution::done;
}

Execution do_polar_on(BlockContext& in) {
  State& state = in.state;
  const FunctionRow& code = *in.words.one_shot;
  if (in.words.functions.size() > 1) return in.raise_code(Condition::format_error, code);
  if (const Execution did = stands_alone(in, 0); did != Execution::done) return did;
  if (state.map.kind == AxisMap::Kind::polar) return in.raise_code(Condition::polar_state, code);
  if (state.map.kind == AxisMap::Kind::cylinder) return in.raise_code(Condition::mill_code, code);
  const Execution did = check_modes_before_milling(in, code);
  if (did != Execution::done) return did;
  const int axis = rotary_axis(in);
  if (axis < 0) return in.raise(Condition::polar_axis, in.settings.mill_axis);
  const unsigned basic = polar_linear(in);
  const int linear = in.axis_called(basic_along(basic));
  if (linear < 0) return in.raise(Condition::polar_axis, basic_along(basic));
  begin_mode(in, code);
  const auto l = static_cast<unsigned>(linear), r = static_cast<unsigned>(axis);
  state.map.kind = AxisMap::Kind::polar;
  state.map.linear = static_cast<uint8_t>(linear);
  state.map.rotary = static_cast<uint8_t>(axis);
  state.map.side = state.machine[l] - in.zero()[l] - state.applied[l] < 0 ? -1 : 1;
  state.map.angle = state.machine[r];
  in.state.modal.set(basic == 1 ? Function::plane_yz : basic == 2 ? Function::plane_zx : Function::plane_xy);
  state.plane_axis[0] = static_cast<int8_t>(linear);
  state.plane_axis[1] = static_cast<int8_t>(axis);
  // #1517: the hypothetical axis is commanded by the word of the second axis of the plane, or by the name of the rotary axis.
  state.mill.hypothetical_word = in.settings.hypothetical_by_name ? kNoWord : in.word(basic_along((basic + 1) % 3));
  state.refresh_special();
  in.refresh_axis_words();
  return Execution::done;
}

Execution do_polar_off(BlockContext& in) {
  State& state = in.state;
  const FunctionRow& code = *in.words.one_shot;
  if (state.map.kind == AxisMap::Kind::none) return Execution::done;
  if (in.words.functions.size() > 1) return in.raise_code(Condition::format_error, code);
  if (const Execution did = stands_alone(in, 0); did != Execution::done) return did;
  if (state.map.kind != AxisMap::Kind::polar) return in.raise_code(Condition::mill_code, code);
  if (state.compensated()) return in.raise_code(Condition::polar_modal, code);
  end_mode(in);
  return Execution::done;
}

Execution check_mill_block(BlockInHand& in) {
  const Command& w = in.words;
  const bool polar = in.state.map.kind == AxisMap::Kind::polar;
  const Condition code = polar ? Condition::polar_code : Condition::mill_code, modal = polar ? Condition::polar_modal : Condition::mill_modal;
  for (const FunctionRow* row : w.functions) {
    switch (row->function) {
      case Function::cylinder:
      case Function::polar_on:
      case Function::polar_off: continue;  // these have rules of their own
      case Function::plane_xy:
      case Function::plane_zx:
      case Function::plane_yz:
        if (polar) return in.raise_code(modal, *row);
        if (in.state.mill.moved) return in.raise_code(Condition::mill_code, *row);
        continue;
      case Function::polar_command_on:  // 6.10 (7) (b): "G16 to G19"
        return in.raise_code(polar ? modal : code, *row);
      default:
        if (!allowed_here(in, row->function)) return in.raise_code(code, *row);
    }
  }
  if (w.has(Role::tool)) return in.raise(modal, Role::tool, w.get(Role::tool));
  return Execution::done;
}

Execution check_mill_move(BlockInHand& in, uint32_t commanded) {
  State& state = in.state;
  state.mill.moved = true;
  const Function motion = state.modal.of(Mode::motion);
  if (!allowed_here(in, motion)) return in.raise_mode(state.map.kind == AxisMap::Kind::polar ? Condition::polar_code : Condition::mill_code, Mode::motion);
  if (state.map.kind != AxisMap::Kind::cylinder) return Execution::done;
  const auto rotary = static_cast<int8_t>(state.map.rotary);
  if (state.plane_axis[0] != rotary && state.plane_axis[1] != rotary) return in.raise(Condition::mill_modal);
  // App.1 P482: the cylindrical coordinate system is the basic one, with the rotary axis in the place of the axis to which it is parallel.
  uint32_t system = 1u << state.map.rotary;
  for (unsigned i = 0; i < 3; ++i) {
    const WordSlot basic = in.settings.plane_basic[i];
    const bool replaced = in.dialect->rules.mill.rotary_in_block ? i == cylinder_stands_for(in) : in.settings.plane_parallel[i] == in.settings.mill_axis;
    const int axis = basic == kNoWord || replaced ? -1 : in.axis_words.axis(basic);
    if (axis >= 0) system |= 1u << axis;
  }
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded & ~system) >> i & 1) != 0) return in.raise(Condition::mill_axis, in.axis_words.word(i), in.words.target[i]);
  if (is_arc(motion) && in.words.any({Role::vector_x, Role::vector_y, Role::vector_z})) return in.raise(Condition::format_error, in.words.has(Role::vector_x) ? Role::vector_x : in.words.has(Role::vector_y) ? Role::vector_y : Role::vector_z);
  return Execution::done;
}

}  // namespace nc
