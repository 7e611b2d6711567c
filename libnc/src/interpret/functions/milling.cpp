// SPDX-License-Identifier: Apache-2.0
// Cylindrical interpolation G07.1 (G107, M700 6.9) and polar coordinate interpolation G12.1/G13.1 (G112/G113, M700 6.10): modes in
// which a plane is programmed and a linear and a rotary axis follow. What the mode does to a move is an AxisMap (path/shape.hpp).
#include <cmath>
#include <numbers>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"

namespace nc {
namespace {

/// Codes of the modes in front of which both are refused: P485, P486.
Did check_modes_before(Interpreter& in, double code) {
  const State& state = in.state;
  if (state.high_accuracy != 0) return in.raise(Condition::not_accepted, 'G', code);  // 13.15 (3); appendix 1 has P126
  if (state.comp.side != 0) return in.raise(Condition::mill_modal, 'G', code);
  if (state.modal.code[kGroupSurfaceSpeed] == 960) return in.raise(Condition::mill_modal, 'G', code);
  if (state.modal.code[kGroupRotation] != 690 || state.work_turned) return in.raise(Condition::mill_modal, 'G', code);
  if (is_space_arc(state.modal.code[kGroupMotion])) return in.raise(Condition::mill_modal, 'G', code);  // 6.14 (a)
  if (state.any_mirror() != 0) return in.raise(Condition::mill_state, 'G', code);
  if (state.modal.code[kGroupNormalLine] != 401) return in.raise(Condition::mill_state, 'G', code);
  return Did::done;
}

/// Index of the rotary axis of both modes (#1516), -1 = none is named or it does not turn.
int rotary_axis(const Interpreter& in) {
  const char name = in.settings.mill_axis;
  const int axis = name == 0 ? -1 : in.axis_of[name - 'A'];
  return axis >= 0 && ((in.rotary >> axis) & 1) != 0 ? axis : -1;
}

/// M700 6.9 (1), 6.10 (1): an independent block. An axis word in it would go nowhere; `own` is the axis that the code itself names.
Did stands_alone(Interpreter& in, uint32_t own) {
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((in.words.axes & ~own) >> i & 1) != 0) return in.raise(Condition::format_error, in.system->axis[i].name, in.words.axis[i]);
  return Did::done;
}

/// What both starts have in common: the feed per minute is forced, the state of before is kept, and a tool length that was
/// commanded without a movement is in force from now on (6.9, 6.10 "tool length compensation").
void begin_mode(Interpreter& in, int16_t code) {
  State& state = in.state;
  state.mill.moved = false;
  state.mill.plane = state.modal.code[kGroupPlane];
  state.mill.plane_axis[0] = state.plane_axis[0];
  state.mill.plane_axis[1] = state.plane_axis[1];
  state.mill.feed_mode = state.modal.code[kGroupFeed];
  state.mill.feed = state.modal.feed;
  if (state.mill.feed_mode != 940) {
    state.modal.code[kGroupFeed] = 940;
    state.modal.feed = 0;  // P62 unless the mode gets an F of its own
  }
  for (unsigned i = 0; i < in.axis_count; ++i) state.applied[i] = i == state.length_axis ? state.length_value : 0.0;
  state.modal.code[kGroupInterpolationMode] = code;
  in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION;
}

void end_mode(Interpreter& in) {
  State& state = in.state;
  state.map = AxisMap{.frozen = state.map.frozen};
  state.mill.hypothetical_letter = 0;
  state.modal.code[kGroupPlane] = state.mill.plane;
  state.plane_axis[0] = state.mill.plane_axis[0];
  state.plane_axis[1] = state.mill.plane_axis[1];
  if (state.mill.feed_mode != 940) {
    state.modal.code[kGroupFeed] = state.mill.feed_mode;
    state.modal.feed = state.mill.feed;
    state.modal.feed_digit = 0;
  }
  const int16_t cutting = state.modal.code[kGroupCutting];
  state.modal.code[kGroupCutting] = 640;
  state.modal.code[kGroupInterpolationMode] = 131;
  change_cutting_mode(in, cutting);
  in.refresh_letters();
  in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION;
}

/// M700 6.9, 6.10: the G codes that can be used inside.
bool allowed_inside(int16_t code) {
  switch (code) {
    case 0: case 10: case 20: case 30: case 40: case 90: case 400: case 410: case 420: case 610: case 640: case 650: case 660:
    case 661: case 670: case 900: case 910: case 940: case 980: case 990: return true;
    default: return code % 10 == 0 && code >= 800 && code <= 890;
  }
}

}  // namespace

Did do_cylinder(Interpreter& in) {
  State& state = in.state;
  const BlockWords& w = in.words;
  const double code = w.one_shot_code / 10.0;
  if (w.g.size() > 1) return in.raise(Condition::format_error, 'G', code);
  if (state.map.kind == AxisMap::Kind::polar) return in.raise(Condition::mill_state, 'G', code);
  const char name = in.settings.mill_axis;
  const int axis = rotary_axis(in);
  if (axis < 0) return in.raise(Condition::mill_axis, name);
  if (!w.has(name)) return in.raise(Condition::format_error, name);
  if (const Did did = stands_alone(in, 1u << axis); did != Did::done) return did;
  const double radius = length_of(in, name, false);
  if (radius < 0) return in.raise(Condition::value_range, name, w.get(name));
  if (radius == 0) {
    if (state.map.kind == AxisMap::Kind::none) return Did::done;
    if (state.comp.side != 0) return in.raise(Condition::mill_modal, 'G', code);
    end_mode(in);
    return Did::done;
  }
  if (state.map.kind != AxisMap::Kind::none) return in.raise(Condition::mill_code, 'G', code);
  const Did did = check_modes_before(in, code);
  if (did != Did::done) return did;
  begin_mode(in, w.one_shot_code);
  state.map.kind = AxisMap::Kind::cylinder;
  state.map.rotary = static_cast<uint8_t>(axis);
  state.map.scale = std::numbers::pi * radius / 180;
  state.refresh_special();
  // (3), (9): the plane with the rotary axis may be selected just before or just behind; some models take the one of Z and the
  // rotary axis by themselves in G19.
  const int8_t rotary = static_cast<int8_t>(axis);
  const bool chosen = state.plane_axis[0] == rotary || state.plane_axis[1] == rotary;
  const bool paired = in.settings.plane_parallel[0] == name || in.settings.plane_parallel[1] == name || in.settings.plane_parallel[2] == name;
  if (!chosen && !paired && state.modal.code[kGroupPlane] == 190) state.plane_axis[0] = rotary;
  return Did::done;
}

Did do_polar_on(Interpreter& in) {
  State& state = in.state;
  const double code = in.words.one_shot_code / 10.0;
  if (in.words.g.size() > 1) return in.raise(Condition::format_error, 'G', code);
  if (const Did did = stands_alone(in, 0); did != Did::done) return did;
  if (state.map.kind == AxisMap::Kind::polar) return in.raise(Condition::mill_state, 'G', code);
  if (state.map.kind == AxisMap::Kind::cylinder) return in.raise(Condition::mill_code, 'G', code);
  const Did did = check_modes_before(in, code);
  if (did != Did::done) return did;
  const int axis = rotary_axis(in);
  if (axis < 0) return in.raise(Condition::mill_axis, in.settings.mill_axis);
  const char name = in.settings.polar_linear == 'Y' || in.settings.polar_linear == 'Z' ? in.settings.polar_linear : 'X';
  const int linear = in.axis_of[name - 'A'];
  if (linear < 0) return in.raise(Condition::mill_axis, name);
  begin_mode(in, in.words.one_shot_code);
  const auto l = static_cast<unsigned>(linear), r = static_cast<unsigned>(axis);
  state.map.kind = AxisMap::Kind::polar;
  state.map.linear = static_cast<uint8_t>(linear);
  state.map.rotary = static_cast<uint8_t>(axis);
  state.map.side = state.machine[l] - in.zero()[l] - state.applied[l] < 0 ? -1 : 1;
  state.map.angle = state.machine[r];
  state.modal.code[kGroupPlane] = name == 'Y' ? 190 : name == 'Z' ? 180 : 170;
  state.plane_axis[0] = static_cast<int8_t>(linear);
  state.plane_axis[1] = static_cast<int8_t>(axis);
  // #1517: the hypothetical axis is commanded by the second letter of the deemed plane, or by the name of the rotary axis.
  state.mill.hypothetical_letter = in.settings.hypothetical_by_name ? char{0} : name == 'Y' ? 'Z' : name == 'Z' ? 'X' : 'Y';
  state.refresh_special();
  in.refresh_letters();
  return Did::done;
}

Did do_polar_off(Interpreter& in) {
  State& state = in.state;
  const double code = in.words.one_shot_code / 10.0;
  if (state.map.kind == AxisMap::Kind::none) return Did::done;
  if (in.words.g.size() > 1) return in.raise(Condition::format_error, 'G', code);
  if (const Did did = stands_alone(in, 0); did != Did::done) return did;
  if (state.map.kind != AxisMap::Kind::polar) return in.raise(Condition::mill_code, 'G', code);
  if (state.comp.side != 0) return in.raise(Condition::mill_modal, 'G', code);
  end_mode(in);
  return Did::done;
}

Did check_mill_block(Interpreter& in) {
  const BlockWords& w = in.words;
  const bool polar = in.state.map.kind == AxisMap::Kind::polar;
  for (const FunctionRow* row : w.g) {
    switch (row->function) {
      case Function::cylinder:
      case Function::polar_on:
      case Function::polar_off: continue;  // their own rules
      case Function::plane_xy:
      case Function::plane_zx:
      case Function::plane_yz:
        if (polar) return in.raise(Condition::mill_modal, 'G', row->code / 10.0);
        if (in.state.mill.moved) return in.raise(Condition::mill_code, 'G', row->code / 10.0);
        continue;
      case Function::polar_command_on:  // 6.10 (7) (b): "G16 to G19"
        return in.raise(polar ? Condition::mill_modal : Condition::mill_code, 'G', row->code / 10.0);
      default:
        if (!allowed_inside(row->code)) return in.raise(Condition::mill_code, 'G', row->code / 10.0);
    }
  }
  if (w.has('T')) return in.raise(Condition::mill_modal, 'T', w.get('T'));
  return Did::done;
}

Did check_mill_move(Interpreter& in, uint32_t commanded) {
  State& state = in.state;
  state.mill.moved = true;
  const int16_t motion = state.modal.code[kGroupMotion];
  if (!allowed_inside(motion)) return in.raise(Condition::mill_code, 'G', motion / 10.0);
  if (state.map.kind != AxisMap::Kind::cylinder) return Did::done;
  const auto rotary = static_cast<int8_t>(state.map.rotary);
  if (state.plane_axis[0] != rotary && state.plane_axis[1] != rotary) return in.raise(Condition::mill_modal);
  // [App.1 P482] the cylindrical coordinate system is the basic one with the rotary axis in the place of the axis it is parallel to.
  uint32_t system = 1u << state.map.rotary;
  for (unsigned i = 0; i < 3; ++i) {
    const char basic = in.settings.plane_basic[i];
    const int axis = basic == 0 || in.settings.plane_parallel[i] == in.settings.mill_axis ? -1 : in.axis_of[basic - 'A'];
    if (axis >= 0) system |= 1u << axis;
  }
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded & ~system) >> i & 1) != 0) return in.raise(Condition::mill_axis, in.system->axis[i].name, in.words.axis[i]);
  const bool arc = motion == 20 || motion == 30;
  if (arc && in.words.any(letters("IJK"))) return in.raise(Condition::format_error, in.words.has('I') ? 'I' : in.words.has('J') ? 'J' : 'K');
  return Did::done;
}

}  // namespace nc
