// SPDX-License-Identifier: Apache-2.0
// M, S, T and the second auxiliary function (M700 9, 10, 11; DGSHAPE 2).
#include <cmath>
#include <initializer_list>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

Action& emit_action(BlockContext& in, nc_action_kind kind, WordSlot word, double value) {
  Action& action = in.emit(ItemKind::action).action;
  in.state.tool_angles_old = turned_outside(in);
  action.kind = kind;
  name_word(action, word);
  action.value = value;
  return action;
}

Action& emit_action(BlockContext& in, nc_action_kind kind, Role word, double value) { return emit_action(in, kind, in.word(word), value); }

SpindleTurn turn_of(MiscFunction function) {
  switch (function) {
    case MiscFunction::spindle_forward: return SpindleTurn::forward;
    case MiscFunction::spindle_reverse: return SpindleTurn::reverse;
    case MiscFunction::spindle_stop: return SpindleTurn::stop;
    case MiscFunction::program_end: return SpindleTurn::stop_all;
    default: return SpindleTurn::as_it_is;
  }
}

void emit_misc(BlockContext& in, MiscFunction function, uint32_t m) {
  Action& action = emit_action(in, NC_ACTION_M, Role::misc_code, m);
  action.turn = turn_of(function);
  action.program_flow = function == MiscFunction::program_stop || function == MiscFunction::program_end;
  action.changes_tool = function == MiscFunction::tool_change;
}

void emit_fin(BlockContext& in) { await_fin(in); }

void note_spindle(BlockContext& in, MiscFunction function) {
  const bool reverse = function == MiscFunction::spindle_reverse;
  if (reverse || function == MiscFunction::spindle_forward) {
    in.state.spindle_on = true;
    in.state.spindle_reverse = reverse;
  }
  if (function == MiscFunction::spindle_stop) in.state.spindle_on = false;
  if (function == MiscFunction::surface_hold || function == MiscFunction::surface_resume) hold_surface(in, function == MiscFunction::surface_hold);
}

}  // namespace

/// The second auxiliary function: B, unless an axis has that name; then A, then C (M700 9.2). kNoWord = the family has none.
WordSlot second_function(const InForce& in) {
  for (const Role word : {Role::second_function, Role::second_function_2, Role::second_function_3})
    if (in.dialect->addresses.has(word) && in.axis_called(word) < 0) return in.word(word);
  return kNoWord;
}

namespace {

Execution spindle_word(BlockContext& in) {
  uint32_t s = 0;
  const bool tap = taps_with_spindle(in);
  if (tap || keeps_spindle_of_tap(in)) {
    const Execution did = check_tap_speed(in);
    if (did != Execution::done) return did;
  }
  const double written = in.words.get(Role::spindle_speed);
  if (!whole_number(written, &s) || s > in.dialect->rules.range.largest_spindle_value) return in.raise(Condition::value_range, Role::spindle_speed, written);
  if (in.state.spindle.axis != 0 && !tap) {  // the S of a synchronous tap is a speed, and not that of a surface
    const Execution did = surface_word(in);
    if (did != Execution::done) return did;
  }
  const SpindleRules& rules = in.dialect->rules.spindle;
  const double speed = rules.speed_is_real ? written : rules.speed_of_word(s);
  in.state.modal.spindle = speed;
  if (in.state.spindle.axis != 0 && in.state.spindle.held) return Execution::done;  // it counts from M58 on
  if (!tap) emit_action(in, NC_ACTION_S, Role::spindle_speed, speed);
  return Execution::done;
}

/// Raises an alarm for a word that could be one of an axis, if it is none and has no other meaning.
Execution check_axis_words(BlockInHand& in, WordSlot second) {
  const AddressTable& addresses = in.dialect->addresses;
  const WordSet auxiliary = addresses.set({Role::second_function, Role::second_function_2, Role::second_function_3});
  WordSet known = in.axis_words.all() | set_of(second);
  if (in.words.one_shot != nullptr && in.words.one_shot->function == Function::dwell) known |= addresses.set({Role::dwell_seconds});
  if (says_line_angle(in)) known |= addresses.set({Role::line_angle});
  const WordSet unknown = in.words.present & in.dialect->axis_addresses & ~known;
  if (unknown == 0) return Execution::done;
  const bool aux = holds(auxiliary, first_of_block(*in.block, unknown)) && second != kNoWord;
  return in.raise_first(aux ? Condition::second_aux : Condition::illegal_axis, unknown);
}

/// DGSHAPE M06: M06 and T come as a pair, with at most one of each in a block.
Execution check_tool_pair(BlockInHand& in) {
  const unsigned tools = count_of(*in.block, in.word(Role::tool));
  unsigned changes = 0;
  for (const Auxiliary& m : in.words.auxiliary) changes += m.function == MiscFunction::tool_change ? 1u : 0u;
  if (changes == 1 && tools == 1) return Execution::done;
  return changes == 0 ? in.raise(Condition::tool_pair, Role::tool, in.words.get(Role::tool)) : in.raise_misc(Condition::tool_pair, MiscFunction::tool_change);
}

/// DGSHAPE M06: the block asks for the tool that is there already, or for none (0) where the change before has put the tool back. Before the first change
/// whether there is a tool is not known.
bool holds_tool_asked_for(const InForce& in, uint32_t tool) {
  if (!in.dialect->rules.auxiliary.skips_tool_held) return false;
  return tool == 0 ? in.state.spindle_tool == 0 : tool == in.state.modal.tool;
}

/// DGSHAPE 2: checks numbers "with no decimal point": codes, speeds and numbers of things; also P (except the factor of G51) and K where they are
/// milliseconds, a number or a count.
Execution check_whole_numbers(BlockInHand& in) {
  const Command& w = in.words;
  const bool cycle = w.cycle != nullptr || in.state.cycle.kind != CycleKind::none;
  const bool arc = w.motion != nullptr && !is_line(w.motion->function);
  WordSet whole = in.set_of({Role::misc_code, Role::spindle_speed, Role::tool, Role::offset_number, Role::length_number, Role::input_kind, Role::dwell_time});
  if (w.one_shot != nullptr && w.one_shot->function == Function::scaling_on) whole &= ~in.set_of({Role::scaling_factor});
  if (cycle && !arc) whole |= in.set_of({Role::cycle_count});
  double value = 0;
  const WordSlot word = first_with_point(*in.block, whole, &value);
  return word == kNoWord ? Execution::done : in.raise(Condition::format_error, word, value);
}

/// Words of the block whose values are whole numbers (HX 2.2.2, RS-274/NGC 3.3.2.1); of a call its program, of a cycle the number of holes.
WordSet whole_words(const BlockInHand& in) {
  const Command& w = in.words;
  WordSet whole = in.set_of({Role::tool, Role::offset_number, Role::length_number});
  if (!in.dialect->rules.spindle.speed_is_real) whole |= in.set_of({Role::spindle_speed});
  if (limits_surface_speed(in)) whole &= ~in.set_of({Role::clamp_highest});
  const Function one_shot = w.one_shot != nullptr ? w.one_shot->function : Function::count_;
  if (one_shot == Function::data_input) whole |= in.set_of({Role::input_kind, Role::input_number});
  for (const Auxiliary& m : w.auxiliary)
    if (calls_program(m.function)) whole |= in.set_of({Role::call_program});
  const bool arc = is_arc(in.state.modal.of(Mode::motion));
  const bool hole = w.cycle != nullptr || (in.state.cycle.kind != CycleKind::none && w.motion == nullptr && w.one_shot == nullptr);
  const bool moves = w.target.axes() != 0 || w.any({Role::vector_x, Role::vector_y, Role::vector_z});  // else P is another code's (LinuxCNC G64)
  if (arc && moves && !hole && one_shot == Function::count_) whole |= in.set_of({Role::arc_turns});
  if (hole && !arc) whole |= in.set_of({Role::cycle_count, Role::cycle_count_2});
  if (hole && !arc && !in.dialect->rules.cycle.dwell_in_seconds) whole |= in.set_of({Role::cycle_dwell});  // milliseconds, HX 12.3.2
  const bool turns = in.settings.dwell_in_revolutions && in.state.modal.is(Function::feed_per_revolution);
  if (one_shot == Function::dwell && !turns && !in.settings.dwell_p_decimal) whole |= in.set_of({Role::dwell_time});  // milliseconds, HX 5.4
  return whole;
}

/// Checks the values of these words; one near enough to a whole number becomes that number.
Execution check_fractions(BlockInHand& in) {
  Command& w = in.words;
  const double within = in.dialect->rules.block.whole_words_within;
  for (WordSet left = whole_words(in) & w.present; left != 0; left &= left - 1) {
    const WordSlot word = first_word(left);
    double value = w.get(word);
    if (!make_whole(within, &value)) return in.raise(Condition::format_error, word, value);
    w.put(word, value);
  }
  return Execution::done;
}

/// HX 13.3: a code of position offset takes the words of the block, and so no other code that is no mode stands beside it. It makes the ways of axes longer,
/// which a radius and an angle are not.
Execution check_position_offset_alone(BlockInHand& in) {
  const auto takes_words = [](const FunctionRow& row) { return mode_of(row.function) == Mode::none && row.function != Function::exact_stop_once; };
  for (const FunctionRow* row : in.words.functions) {
    if (!offsets_position(row->function)) continue;
    if (in.state.modal.is(Function::polar_command_on)) return in.raise_code(Condition::not_accepted, *row);
    for (const FunctionRow* other : in.words.functions)
      if (row != other && takes_words(*other)) return in.raise_code(Condition::illegal_address, *row);
  }
  return Execution::done;
}

}  // namespace

/// M700 13.5.9: with #3003 bit 1 FIN is not waited for.
void await_fin(BlockContext& in) {
  if ((in.state.suppressed & NC_SUPPRESS_FIN) != 0) return;
  in.emit(ItemKind::gate).gate.kind = NC_GATE_FIN;
}

void give_out_spindle(BlockContext& in, MiscFunction function, uint32_t code) {
  note_spindle(in, function);
  emit_misc(in, function, code);
  emit_fin(in);
}

Execution check_precedence(BlockInHand& in) {
  const Command& w = in.words;
  const BlockRules& rules = in.dialect->rules.block;
  if (rules.whole_words_refuse_point) {
    const Execution did = check_whole_numbers(in);
    if (did != Execution::done) return did;
  }
  if (rules.whole_words_within >= 0) {
    const Execution did = check_fractions(in);
    if (did != Execution::done) return did;
  }
  if (in.dialect->rules.compensation.position_offset_is_of_motion) {
    const Execution did = check_position_offset_alone(in);
    if (did != Execution::done) return did;
  }
  if (in.dialect->rules.compensation.bars_position_offset && (w.cycle != nullptr || in.state.cycle.kind != CycleKind::none))
    for (const FunctionRow* row : w.functions)  // HX 12.2.2
      if (offsets_position(row->function)) return in.raise_code(Condition::not_accepted, *row);
  const unsigned words = word_count(*in.block);
  if (rules.stops_stand_alone)
    for (const Auxiliary& m : w.auxiliary)
      if (!m.is_output() && words > 1) return in.raise(Condition::must_stand_alone, Role::misc_code, m.number);
  if (rules.dwell_stands_alone && w.one_shot != nullptr && w.one_shot->function == Function::dwell && words > 2)
    return in.raise_code(Condition::must_stand_alone, *w.one_shot);
  if (!in.dialect->rules.auxiliary.tool_change_is_pair) return Execution::done;
  const uint32_t tool = w.has(Role::tool) ? 1u : 0u;
  for (const Auxiliary& m : w.auxiliary)
    if (tool != 0 || m.function == MiscFunction::tool_change) return check_tool_pair(in);
  return tool != 0 ? check_tool_pair(in) : Execution::done;
}

bool codes_behind_motion(const BlockInHand& in) { return in.settings.codes_after_motion && (in.words.target.axes() != 0 || in.words.moved_before); }

Execution auxiliary_before(BlockContext& in) {
  Command& w = in.words;
  // Most blocks have none of the words that are looked at here.
  if (w.auxiliary.empty() && !w.any((in.dialect->axis_addresses | in.set_of({Role::spindle_speed, Role::tool})) & ~in.axis_words.all())) return Execution::done;
  const Rules& rules = in.dialect->rules;
  const WordSlot second = second_function(in);
  Execution did = check_axis_words(in, second);
  if (did != Execution::done) return did;
  bool waiting = false;
  if (w.has(Role::spindle_speed) && !is_clamp_command(in)) {
    const unsigned before = in.items_made();
    did = spindle_word(in);
    if (did != Execution::done) return did;
    waiting = in.items_made() != before;
  }
  uint32_t tool = 0;
  if (w.has(Role::tool) && (!whole_number(w.get(Role::tool), &tool) || tool > rules.range.largest_tool)) return in.raise(Condition::value_range, Role::tool, w.get(Role::tool));
  const bool held = w.has(Role::tool) && holds_tool_asked_for(in, tool);
  if (w.has(Role::tool) && !held) {
    in.state.modal.tool = in.state.selected_tool = tool;
    if (in.settings.life_managed) {
      did = select_managed_tool(in, &tool);
      if (did != Execution::done) return did;
    }
    emit_action(in, NC_ACTION_T, Role::tool, tool);
    waiting = true;
  }
  if (w.has(second)) {
    if (!whole_number(w.get(second), &in.state.modal.b) || in.state.modal.b > rules.range.largest_second_misc) return in.raise(Condition::value_range, second, w.get(second));
    emit_action(in, NC_ACTION_B, second, in.state.modal.b);
    waiting = true;
  }
  const unsigned most = rules.auxiliary.most_m_codes, first = w.auxiliary.size() > most ? w.auxiliary.size() - most : 0;
  for (unsigned i = first; i < w.auxiliary.size(); ++i) {
    const Auxiliary& m = w.auxiliary[i];
    if (!m.is_output()) {  // M700 13.12: codes of the macro interrupt are processed internally, too
      did = act_on_machine(in, m);
      if (did != Execution::done) return did;
      continue;
    }
    if (m.number > rules.range.largest_misc) return in.raise(Condition::value_range, Role::misc_code, m.number);
    const MiscFunction function = m.function;
    if (function == MiscFunction::tool_change && rules.compensation.bars_tool_change && in.state.comp.side != 0 && !w.comp_command)
      return in.raise_misc(Condition::not_in_compensation, function);
    const bool forward = function == MiscFunction::spindle_forward, stops = function == MiscFunction::spindle_stop;
    if (rules.spindle.skips_repeated_codes && ((forward && in.state.spindle_on) || (stops && !in.state.spindle_on))) continue;
    if (held && function == MiscFunction::tool_change) continue;
    if (function == MiscFunction::spindle_oriented)  // LinuxCNC M19 R P Q: the machine has one angle, goes there in its own way, and FIN is waited for
      for (const Role word : {Role::orient_angle, Role::output_number, Role::input_limit})
        if (w.has(word) && w.get(word) != 0) return in.raise(Condition::no_function, word, w.get(word));
    note_spindle(in, function);
    if (m.taps_synchronously) in.state.tap_code = true;
    if (waiting && i > first) emit_fin(in);  // one M strobe at a time
    in.state.modal.m = m.number;
    emit_misc(in, function, m.number);
    if (function == MiscFunction::tool_change) in.state.spindle_tool = in.state.selected_tool;
    if (function == MiscFunction::tool_change && in.settings.life_managed) take_managed_tool(in);
    waiting = true;
  }
  if (!waiting) return Execution::done;
  if (w.one_shot != nullptr && w.one_shot->function == Function::dwell) {
    w.fin_behind_dwell = true;  // M700 8.1 (5): the dwell begins together with the function
  } else {
    emit_fin(in);
  }
  return Execution::done;
}

void auxiliary_behind(BlockContext& in, const Auxiliary& auxiliary) {
  const MiscFunction function = auxiliary.function;
  const uint32_t m = auxiliary.number;
  switch (function) {
    case MiscFunction::program_stop:
      in.state.modal.m = m;
      emit_misc(in, function, m);
      emit_fin(in);  // M700 9.1: the stop comes with the completion
      in.emit(ItemKind::gate).gate.kind = NC_GATE_STOP;
      break;
    case MiscFunction::optional_stop:
      in.state.modal.m = m;
      in.emit(ItemKind::gate).gate.kind = NC_GATE_OPTIONAL_STOP;
      break;
    case MiscFunction::program_end:
      if (in.state.comp.side != 0) in.state.comp.side = 0;
      in.state.modal.m = m;
      emit_misc(in, function, m);
      emit_fin(in);
      end_spindle_control(in);
      in.state.end_seen = true;
      break;
    case MiscFunction::override_allowed:
    case MiscFunction::override_barred: {
      const bool barred = function == MiscFunction::override_barred;
      in.state.modal.m = m;
      in.state.disabled = static_cast<uint8_t>(barred ? in.state.disabled | NC_DISABLE_OVERRIDE : in.state.disabled & ~NC_DISABLE_OVERRIDE);
      Action& action = in.emit(ItemKind::action).action;
      action.kind = NC_ACTION_CONTROL;
      action.index = NC_CONTROL_DISABLE;
      action.value = in.state.disabled;
      break;
    }
    default: break;
  }
}

}  // namespace nc
