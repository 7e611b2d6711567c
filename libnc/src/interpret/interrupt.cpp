// SPDX-License-Identifier: Apache-2.0
// Macro interrupt: M96, M97, and the way into the interrupt program and back (M700 13.12).
//
// An interrupt comes when everything before it has been executed, so it never has to be taken back: therefore what is kept for the return is not a part of
// the state. On the machine the item in execution may have been executed in part; the rest of it is executed after the return (PartSystem).
//
// A block is interrupted at one of its items. The interpreter goes back to the beginning of the block and enters the interrupt program from there, with the
// machine where it stands. On return either the rest of the block is not executed (type 1, when the interrupt program has moved or given out M S T B), or
// the block is read again and the items that have been executed already are dropped.
#include <algorithm>
#include <initializer_list>

#include "interpret/calls.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/lifetimes.hpp"

namespace nc {
namespace {

/// Tells the sinks and the scan the state of the interrupt.
void announce(Interpreter& in) {
  uint32_t bits = 0;
  if (in.state.interrupt_on) bits |= NC_INTERRUPT_ENABLED;
  if (in.settings.interrupt_by_level) bits |= NC_INTERRUPT_BY_LEVEL;
  if (!in.settings.interrupt_type_2) bits |= NC_INTERRUPT_AT_ONCE;
  if (in.state.interrupt_depth != 0) bits |= NC_INTERRUPT_IN_SERVICE;
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = NC_CONTROL_INTERRUPT;
  action.value = bits;
}

/// The interrupted block is not finished: its program goes on behind it.
void pass_over_block(Interpreter& in, CallFrame& frame) {
  const Block* block = in.reader.read(frame.program.file, frame.offset, frame.line);
  if (block == nullptr || block->end_of_text) return;
  frame.offset = block->next;
  frame.line = block->next_line;
}

}  // namespace

bool has_words_of_call(const BlockInHand& in) {
  for (const Auxiliary& m : in.words.auxiliary)
    if (m.function == MiscFunction::interrupt_on || calls_program(m.function)) return true;
  return false;
}

bool is_word_of_call(const BlockInHand& in, Role word) {
  const AddressTable& addresses = in.dialect->addresses;
  const auto is_one = [&](std::initializer_list<Role> roles) { return std::any_of(roles.begin(), roles.end(), [&](Role role) { return addresses.has(role) && addresses.same(word, role); }); };
  return std::any_of(in.words.auxiliary.begin(), in.words.auxiliary.end(), [&](const Auxiliary& m) {
    if (m.function == MiscFunction::interrupt_on) return is_one({Role::interrupt_program});
    if (m.function == MiscFunction::return_sub) return is_one({Role::return_sequence, Role::return_passes});
    return calls_program(m.function) && is_one({Role::call_program, Role::call_repeats, Role::call_sequence, Role::call_end_sequence});
  });
}

Execution enable_interrupt(Interpreter& in) {
  const Command& w = in.words;
  InterruptProgram called;
  Execution did = find_called(in, w.has(Role::interrupt_program), w.has(Role::interrupt_program) ? w.get(Role::interrupt_program) : 0, false, &called.program);
  if (did != Execution::done) return did;
  did = find_start(in, called.program, &called.begin, &called.begin_line);
  if (did != Execution::done) return did;
  in.change(&ProgramRecords::interrupt, called);
  in.store->note(called.program.file, in.system_index);
  in.state.interrupt_on = true;
  announce(in);
  return Execution::done;
}

Execution disable_interrupt(Interpreter& in) {
  in.state.interrupt_on = false;
  announce(in);
  return Execution::done;
}

bool Interpreter::interruptible() const { return state.interrupt_on && state.interrupt_depth == 0 && !ended && !state.end_seen; }

bool Interpreter::interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block) {
  if (!queue.empty() || next_step != Step::none || taken_back > 0) {
    if (!cut_block || (waiting_ && queue.empty())) return false;  // a block that waits for the answer of a sync is finished first
    // The block in hand may have ended the program, or the state that M96 began: what was in force at the beginning of the block counts.
    const unsigned items = made_ - queue.size() - taken_back;
    return rewind(block_seq_) && begin_interrupt(true, items, machine);
  }
  if (!interruptible()) return false;
  // The interrupt comes between two blocks; a part of the second one may have been executed before an earlier interrupt.
  return begin_interrupt(state.repeat.active, state.repeat.items, machine);
}

bool Interpreter::interrupt_inside(const AxisVec& machine, unsigned items) {
  if (!interruptible()) return false;
  if (state.repeat.active) items += state.repeat.items;
  return begin_interrupt(true, items, machine);
}

/// What has been read ahead is given up, so the place in the program is that of the next block.
void Interpreter::place_at_next_block() {
  place_in_program();
  source.line = state.frame[state.depth].line;
}

bool Interpreter::begin_interrupt(bool inside_block, unsigned items, const AxisVec& machine) {
  place_at_next_block();
  if (state.owes_mark) {  // the block that called the program which has just returned ends before the interrupt program begins
    finish_call();
    inside_block = false;
    items = 0;
    place_at_next_block();
  }
  const BlockSeq head = state.seq, answered = answered_;
  InterruptReturn& back = interrupted_;
  back.inside_block = inside_block;
  back.items = items;
  back.state = state;
  note_block_call();
  back.maps = records->maps;
  const Execution did = enter_interrupt();
  if (did == Execution::fault) {
    note_calls(source, state.frame);
    stop(fault, source);
    return true;
  }
  interrupted_.world = world;
  interrupted_.world_known = inside_block && answered == head;
  begin_interrupt_program(state, machine);
  announce(*this);
  keep_state();
  return true;
}

Execution Interpreter::enter_interrupt() {
  Entry entry;
  entry.program = records->interrupt.program;
  entry.origin = CallOrigin::interrupt;
  entry.kind = settings.interrupt_as_sub ? CallKind::sub : CallKind::macro;  // M700 #1229 bit 0
  entry.offset = records->interrupt.begin;
  entry.line = records->interrupt.begin_line;
  const unsigned level = macro_level() + 1u;
  if (entry.kind == CallKind::macro && level > kMacroDepth) return raise(Condition::macro_nesting, Role::interrupt_program, entry.program.number);
  const Execution did = enter(*this, entry);
  if (did != Execution::later) return did;
  static constexpr Value kNoArguments[kLocals] = {};
  if (entry.kind == CallKind::macro) variables.enter(level, kNoArguments, state.seq + 1);
  state.interrupt_depth = state.depth;
  CallFrame& frame = state.frame[state.depth];
  frame.modal_call = 0;  // no macro is called behind the moves of an interrupt program
  show_modal_call(*this);
  return Execution::later;
}

/// M700 13.12: restores modal information, and tells the machine again what the interrupt program has changed there.
void Interpreter::restore_modal() {
  const Function cutting = state.modal.of(Mode::cutting);
  const SpindleControl spindle = state.spindle;
  return_from_interrupt(state, interrupted_.state, interrupted_.inside_block);
  change_cutting_mode(*this, cutting);
  if (spindle.axis != state.spindle.axis || (state.spindle.axis != 0 && spindle.surface != state.spindle.surface)) announce_surface(*this);
  refresh_derived();  // the rotation by parameter is data and no mode, so the interrupt program may have changed it (13.21)
  take_changed_amounts(*this);
}

/// M99 of the interrupt program, whose frame is still on the stack. `to_sequence`: it is M99 P, which says itself where to go on.
void Interpreter::leave_interrupt(bool to_sequence) {
  CallFrame& caller = state.frame[state.depth - 1];
  const bool cut = settings.interrupt_type_2 ? false : state.interrupt_moved;
  state.interrupt_depth = 0;
  if (to_sequence || cut) go_on_behind_interrupt(state, interrupted_.state);
  if (to_sequence) {
    if (interrupted_.inside_block) pass_over_block(*this, caller);
  } else if (!cut) {
    restore_modal();
    change(&ProgramRecords::maps, interrupted_.maps);
    if (interrupted_.inside_block) {
      next_repeat_.active = true;
      next_repeat_.items = static_cast<uint16_t>(interrupted_.items);
    }
  } else if (interrupted_.inside_block) {
    pass_over_block(*this, caller);
  }
  announce(*this);
}

}  // namespace nc
