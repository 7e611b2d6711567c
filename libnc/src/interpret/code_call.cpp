// SPDX-License-Identifier: Apache-2.0
// Codes that call programs: G M S T B codes (M700 13.5.2) and ASCII codes (13.5.3) that parameters register; and the call that follows a block when the
// block itself has been executed.
#include <cmath>

#include "command/caller.hpp"
#include "interpret/calls.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// Makes the code modal, so that it is shown as any other code although it is not given out (M700 13.5.2 (3)).
void show_code(Interpreter& in, const Caller& caller) {
  const auto whole = static_cast<uint32_t>(caller.value > 0 && caller.value < 4294967295.0 ? caller.value : 0);
  if (caller.word == in.word(Role::misc_code)) in.state.modal.m = whole;
  if (caller.word == in.word(Role::spindle_speed)) in.state.modal.spindle = caller.value;
  if (caller.word == in.word(Role::tool)) in.state.modal.tool = whole;
  if (caller.word == in.word(Role::second_function)) in.state.modal.b = whole;
}

/// Executes the G codes before the call, which act as they do before G65: G91 G100 X10.
Execution apply_codes_before(Interpreter& in, unsigned at) {
  const Block* original = in.block;
  Block& copy = *in.rewritten;
  copy_codes_before(*original, in.front, at, copy);
  in.block = &copy;
  Execution did = read_block_command(in);
  if (did == Execution::done) did = apply_reading_modes(in);
  in.block = original;
  return did;
}

/// A word that calls as M98 has no place beside a code by which the block goes on in another program, returns, or ends this one: one of them would be lost
/// (M700 13.5.2 (1), 13.3.1; HX 14.1.5). Nor, where the family says so, has a second word that would call.
Execution check_calls_alone(BlockInHand& in, const Caller& caller) {
  const bool one = in.dialect->rules.code_call.one_in_block;
  bool elsewhere = false;
  Execution did = in.executed(goes_on_elsewhere(*in.block, in.front, &elsewhere));
  if (did != Execution::done) return did;
  if (elsewhere) return in.raise(one ? Condition::illegal_address : Condition::format_error, caller.word, caller.value);
  if (!one) return Execution::done;
  Caller other;
  did = in.executed(find_caller(*in.block, in.front, false, false, &other));
  if (did != Execution::done || other.call == nullptr) return did;
  return in.raise(Condition::illegal_address, other.word, other.value);
}

/// A call as M98: the rest of the block is executed as if the code was not there, then the program is called.
Execution run_rest_first(Interpreter& in, const Caller& caller) {
  Block& copy = *in.rewritten;
  copy_without(*in.block, caller.at, copy);
  in.block = &copy;
  in.after_block = caller.call;
  return check_calls_alone(in, caller);
}

/// M700 App.1 P310: no such call during a fixed cycle. What the block is behind a call as M98 is executed first, so it may be what ends the cycle, or what begins it.
Execution check_cycle_ends(Interpreter& in, const Caller& caller) {
  const Execution did = read_block_command(in);
  return did == Execution::done && cycle_goes_on(in) ? in.raise(Condition::call_in_cycle, caller.word, caller.value) : did;
}

/// The common variable in which the called program finds the value of the word: of an ASCII code, or of a tool number, which is a whole one.
Execution set_variable_of_call(Interpreter& in, const Caller& caller) {
  if (!caller.ascii && caller.call->variable == 0) return Execution::done;
  double value = caller.value;
  const double within = in.dialect->rules.block.whole_words_within;
  if (!caller.ascii && within >= 0 && !make_whole(within, &value)) return in.raise(Condition::format_error, caller.word, value);
  const bool is_tool = !caller.ascii && caller.word == in.word(Role::tool);
  if (is_tool && !(value >= 0 && value <= in.dialect->rules.range.largest_tool)) return in.raise(Condition::value_range, caller.word, value);
  if (in.variables.set(caller.call->variable, in.macro_level(), Value::of(value), in.state.seq + 1)) return Execution::done;
  return in.raise(Condition::variable_number, Sign::variable, caller.call->variable);
}

/// How the word calls: as its parameter says, or an M code by its place (HX 14.1.4, 14.1.5).
CodeCallType type_of_call(const Interpreter& in, const Caller& caller) {
  const bool by_place = in.dialect->rules.code_call.arguments_behind_m && caller.word == in.word(Role::misc_code);
  if (by_place) return caller.at == 0 ? CodeCallType::macro : CodeCallType::sub;
  return caller.call->type;
}

/// Behind an M code that begins its block the other words are arguments (HX 14.1.4), and so a code by which the block would go on elsewhere would be lost.
Execution check_no_way_on(BlockInHand& in, const Caller& caller) {
  if (!in.dialect->rules.code_call.arguments_behind_m || caller.word != in.word(Role::misc_code)) return Execution::done;
  bool elsewhere = false;
  const Execution did = in.executed(goes_on_elsewhere(*in.block, in.front, &elsewhere));
  return did == Execution::done && elsewhere ? in.raise(Condition::illegal_address, caller.word, caller.value) : did;
}

/// Types G65, G66, G66.1: every other word is an argument, and so is the code itself but for G.
Execution call_with_arguments(Interpreter& in, const Caller& caller) {
  MacroCall call;
  Execution did = in.executed(read_arguments(*in.block, in.front, false, call));
  if (did != Execution::done) return did;
  if (call.has_program) return in.raise(Condition::illegal_address, Role::call_program, call.program);
  Entry entry;
  did = repetitions(in, call.has_repeats, call.repeats, &entry.passes);
  if (did != Execution::done) return did;
  did = find_number(in, caller.call->program, &entry.program);
  if (did != Execution::done) return did;
  if (type_of_call(in, caller) == CodeCallType::macro) {
    entry.kind = CallKind::macro;
    entry.origin = CallOrigin::code;
    entry.offset = entry.program.offset;
    entry.line = entry.program.line;
    return enter_macro(in, entry, call.argument);
  }
  const bool every_block = caller.call->type == CodeCallType::modal_block;
  did = store_modal_call(in, entry.program, call, entry.passes, every_block, true);
  return did == Execution::done && every_block ? make_modal_call(in) : did;
}

/// The words of the block are a movement command, after which G66 calls (M700 13.5.1).
bool moves(const Interpreter& in) {
  const Command& w = in.words;
  if (makes_pattern(in) || (w.one_shot != nullptr && cuts_circle(w.one_shot->function))) return true;
  if (w.target.axes() == 0) return !is_line(in.state.modal.of(Mode::motion)) && w.any({Role::vector_x, Role::vector_y, Role::vector_z, Role::arc_radius}) && w.one_shot == nullptr;
  return w.one_shot == nullptr || goes_to_position(w.one_shot->function);
}

bool cancels(const Interpreter& in) {
  for (const FunctionRow* row : in.words.functions)
    if (row->function == Function::macro_modal_off) return true;
  return false;
}

}  // namespace

Execution dispatch_block(Interpreter& in, bool* taken) {
  in.after_block = nullptr;
  if (modal_call_takes_blocks(in)) return Execution::done;
  const bool nested = top(in).origin == CallOrigin::code;  // M700 13.5.2: in a program that a code has called codes do not call
  if (nested && !in.vendor->any()) return Execution::done;
  Caller caller;
  Execution did = in.executed(find_caller(*in.block, in.front, nested, in.state.cycle.kind != CycleKind::none, &caller));
  if (did != Execution::done || caller.call == nullptr) return did;
  if (caller.call->vendor != nullptr) {
    *taken = true;
    if (!in.world_fresh) return in.need(NC_SYNC_STOPPED);
    did = apply_codes_before(in, caller.at);
    if (did != Execution::done) return did;
    show_code(in, caller);
    return call_vendor(in, caller);
  }
  const bool sub = type_of_call(in, caller) == CodeCallType::sub;
  const bool in_cycle = in.state.cycle.kind != CycleKind::none || begins_cycle(*in.block, in.front, caller);
  if (in_cycle && !sub) return in.raise(Condition::call_in_cycle, caller.word, caller.value);
  if (caller.ascii && std::fabs(caller.value) > in.dialect->rules.range.largest_calling_value) return in.raise(Condition::value_range, caller.word, caller.value);
  if (sub) {
    did = run_rest_first(in, caller);
    if (did == Execution::done && in_cycle) did = check_cycle_ends(in, caller);
    if (did != Execution::done) return did;
    show_code(in, caller);
    return set_variable_of_call(in, caller);
  }
  show_code(in, caller);
  *taken = true;
  did = check_no_way_on(in, caller);
  if (did == Execution::done) did = apply_codes_before(in, caller.at);
  return did == Execution::done ? call_with_arguments(in, caller) : did;
}

bool block_is_argument(const Interpreter& in) { return modal_call_takes_blocks(in) && !cancels(in); }

bool goes_on_elsewhere(const Interpreter& in) {
  if (modal_call_takes_blocks(in) || !moves(in) || cancels(in)) return false;
  if (in.after_block != nullptr) return true;
  for (const Auxiliary& m : in.words.auxiliary) {
    if (calls_program(m.function) || m.function == MiscFunction::return_sub) return true;
  }
  return false;
}

/// M700 13.5.1, 13.3.1: the macro of G66 comes right behind the movement; the sub program, or the return, comes behind everything else of the block. For
/// that the block is read again when the macro has ended.
Execution make_modal_call_first(Interpreter& in) {
  in.emit_stop_point();  // single block may stop behind the move
  CallFrame& frame = top(in);
  const uint32_t bit = 1u << in.state.depth;
  frame.offset = in.block->begin;
  frame.line = in.block->line;
  in.state.codes_left |= bit;
  Execution did = make_modal_call(in);
  if (did != Execution::done) return did;
  in.state.codes_left &= ~bit;  // G66 L0 makes no call, so the block goes on
  frame.offset = in.block->next;
  frame.line = in.block->next_line;
  return execute_behind_motion(in);
}

Execution execute_behind_motion(Interpreter& in) {
  const Execution did = codes_behind(in);
  return did == Execution::done && in.after_block != nullptr ? call_behind_block(in) : did;
}

Execution call_behind_block(Interpreter& in) {
  if (in.state.end_seen) return Execution::done;
  if (in.after_block != nullptr) {
    Entry entry;
    entry.origin = CallOrigin::code;
    Execution did = find_number(in, in.after_block->program, &entry.program);
    in.after_block = nullptr;
    if (did != Execution::done) return did;
    entry.offset = entry.program.offset;
    entry.line = entry.program.line;
    if (word_count(*in.block) != 0) in.emit_stop_point();
    did = enter(in, entry);
    if (did == Execution::later) in.keep_call();
    return did;
  }
  if (modal_call_takes_blocks(in) || !moves(in) || cancels(in)) return Execution::done;
  in.emit_stop_point();  // single block may stop behind the move
  return make_modal_call(in);
}

}  // namespace nc
