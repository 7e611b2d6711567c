// SPDX-License-Identifier: Apache-2.0
// Constant surface speed G96, G97 and the clamp speeds G92 S Q (M700 10.3, 10.4). The interpreter only hands on what the program commands; the spindle speed
// follows the position of an axis and is calculated by the scan (interpolate/spindle.hpp).
#include <algorithm>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

void emit_control(BlockContext& in, uint32_t index, double value, uint32_t mask, uint32_t bits) {
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = index;
  action.value = value;
  action.mask = mask;
  action.bits = bits;
}

Execution speed_word(BlockInHand& in, Role word, uint32_t* speed) {
  const double raw = in.words.get(word);
  if (whole_number(raw, speed) && *speed <= in.dialect->rules.range.largest_spindle_value) return Execution::done;
  return in.raise(Condition::value_range, word, raw);
}

}  // namespace

void announce_surface(BlockContext& in) {
  const SpindleControl& spindle = in.state.spindle;
  if (spindle.held) return;  // it follows neither the axis nor S
  emit_control(in, NC_CONTROL_SURFACE_SPEED, spindle.axis != 0 ? spindle.surface : 0, 0, spindle.axis != 0 ? 1u << (spindle.axis - 1) : 0);
}

bool is_clamp_command(const BlockInHand& in) {
  const Command& w = in.words;
  if (w.one_shot == nullptr || w.one_shot->function != Function::coordinate_set || !in.dialect->rules.spindle.limits_by_coordinate_setting) return false;
  // 10.4 (Note 1): without Sclamp an S of G92 in G97 is a spindle speed.
  return in.settings.clamp_command_always || in.state.spindle.axis != 0;
}

/// LinuxCNC G96: D of the block is the highest speed, and it holds until the next G96.
bool limits_surface_speed(const BlockInHand& in) {
  if (!in.dialect->rules.spindle.limit_beside_surface) return false;
  for (const FunctionRow* row : in.words.functions)
    if (row->function == Function::surface_on) return true;
  return false;
}

Execution set_surface_speed(BlockContext& in) {
  State& state = in.state;
  if (limits_surface_speed(in)) {
    uint32_t largest = 0;
    if (in.words.has(Role::clamp_highest)) {
      const Execution did = speed_word(in, Role::clamp_highest, &largest);
      if (did != Execution::done) return did;
    }
    in.state.spindle_clamp.any = largest != 0;
    emit_control(in, NC_CONTROL_SPINDLE_CLAMP, largest != 0 ? NC_CLAMP_S : 0, 0, largest);
  }
  for (const FunctionRow* row : in.words.functions) {
    if (mode_of(row->function) != Mode::surface_speed) continue;
    state.modal.set(*row);
    if (row->function == Function::surface_off) {
      if (state.spindle.axis == 0) continue;
      state.spindle.axis = 0;
      announce_surface(in);  // a spindle that turns keeps its speed until the next S
      continue;
    }
    uint32_t axis = in.settings.surface_axis == 0 ? 1u : in.settings.surface_axis;
    if (in.settings.surface_axis != 0 && in.words.has(Role::surface_axis)) {  // 10.3 (2)
      if (!whole_number(in.words.get(Role::surface_axis), &axis) || axis < 1 || axis > 3 || axis > in.axis_count)
        return in.raise(Condition::surface_axis, Role::surface_axis, in.words.get(Role::surface_axis));
      take_word_of_code(in, Role::surface_axis);
    }
    if (axis > in.axis_count) return in.raise(Condition::surface_axis, Role::surface_axis, axis);
    if (in.words.has(Role::spindle_speed) ? !(in.words.get(Role::spindle_speed) > 0) : state.spindle.surface == 0) return in.raise(Condition::surface_speed, Role::spindle_speed);  // P132
    state.spindle.axis = static_cast<uint8_t>(axis);
    if (!in.words.has(Role::spindle_speed)) announce_surface(in);  // otherwise surface_word() does it
  }
  return Execution::done;
}

/// Series 8 M58, M59.
void hold_surface(BlockContext& in, bool held) {
  SpindleControl& spindle = in.state.spindle;
  if (spindle.held == held) return;
  spindle.held = held;
  if (spindle.axis == 0) return;
  if (held) {
    emit_control(in, NC_CONTROL_SURFACE_SPEED, 0, 0, 0);  // a spindle that turns keeps its speed
  } else {
    announce_surface(in);
  }
}

/// Series 8 G92 R: the radius at the present position of the axis.
Execution set_surface_radius(BlockContext& in) {
  const double radius = length_of(in, Role::surface_radius);
  if (!(radius >= 0)) return in.raise(Condition::value_range, Role::surface_radius, in.words.get(Role::surface_radius));
  emit_control(in, NC_CONTROL_SURFACE_RADIUS, radius, 0, 1u << (in.settings.surface_axis == 0 ? 0 : in.settings.surface_axis - 1));
  return Execution::done;
}

Execution surface_word(BlockContext& in) {
  uint32_t whole = 0;
  const Execution did = speed_word(in, Role::spindle_speed, &whole);
  if (did != Execution::done) return did;
  const double speed = in.dialect->rules.spindle.speed_is_real ? in.words.get(Role::spindle_speed) : whole;
  // The example has m/min; in inch it is feet/min, as in FANUC.
  in.state.spindle.surface = in.state.modal.is(Function::inch) ? speed * 0.3048 : speed;
  announce_surface(in);
  return Execution::done;
}

Execution set_spindle_clamp(BlockContext& in) {
  const Command& w = in.words;
  const bool s = w.has(Role::spindle_speed) && is_clamp_command(in);
  if (!s && !w.has(Role::clamp_lowest)) return Execution::done;
  uint32_t largest = 0, smallest = 0;
  Execution did = s ? speed_word(in, Role::spindle_speed, &largest) : Execution::done;
  if (did == Execution::done && w.has(Role::clamp_lowest)) did = speed_word(in, Role::clamp_lowest, &smallest);
  if (did != Execution::done) return did;
  SpindleClamp& clamp = in.state.spindle_clamp;
  // 10.4, Sclamp and aux11 bit 5: the clamp acts in G97 only with Sclamp = 1 and bit 5 = 0.
  const bool always = in.settings.clamp_command_always && !in.settings.clamp_in_surface_speed_only;
  clamp.any = true;
  clamp.always = always;
  // Which of several spindles is selected the machine knows when it comes here: a tap keeps the lowest of the clamps that any of them may have.
  if (s) clamp.s = in.system->spindle_count > 1 && clamp.has_s ? std::min(clamp.s, largest) : largest;
  clamp.has_s = clamp.has_s || s;
  if (w.has(Role::clamp_lowest)) clamp.q = smallest;
  emit_control(in, NC_CONTROL_SPINDLE_CLAMP,
               (always ? NC_CLAMP_ALWAYS : 0) + (in.settings.keeps_clamp ? NC_CLAMP_OVER_RESET : 0) + (s ? NC_CLAMP_S : 0) + (w.has(Role::clamp_lowest) ? NC_CLAMP_Q : 0),
               smallest, largest);
  return Execution::done;
}

void end_spindle_control(BlockContext& in) {
  const SpindleControl& spindle = in.state.spindle;
  if (spindle.axis != 0) emit_control(in, NC_CONTROL_SURFACE_SPEED, 0, 0, 0);
  if (in.state.spindle_clamp.any && !in.settings.keeps_clamp) emit_control(in, NC_CONTROL_SPINDLE_CLAMP, 0, 0, 0);
}

}  // namespace nc
