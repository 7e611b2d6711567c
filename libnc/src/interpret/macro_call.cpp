// SPDX-License-Identifier: Apache-2.0
// Macro calls: arguments, G65, and the modal calls G66, G66.1, G67 (M700 13.5.1).
//
// Modal calls nest. Each frame of the call stack knows the slot of the modal call that is in force in its program. In the program that a modal call enters,
// the modal call commanded before that one is in force, so that a move in the macro of the last G66 calls the macro of the G66 before.
#include <cmath>
#include <initializer_list>

#include "interpret/calls.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// A slot to which no open program refers; 0 = none. It is needed rarely, so it may look at all frames.
unsigned free_slot(const Interpreter& in) {
  uint32_t used = 0;
  for (unsigned level = 0; level <= in.state.depth; ++level) {
    for (unsigned slot : {in.state.frame[level].modal_call, in.state.frame[level].modal_slot}) {
      while (slot != 0 && ((used >> slot) & 1) == 0) {
        used |= 1u << slot;
        slot = modal_call(in, slot).below;
      }
    }
  }
  for (unsigned slot = 1; slot <= kModalCalls; ++slot)
    if (((used >> slot) & 1) == 0) return slot;
  return 0;
}

Execution enter_modal(Interpreter& in, unsigned slot, const Value* arguments) {
  const ModalCall& call = modal_call(in, slot);
  Entry entry;
  entry.program = call.program;
  entry.kind = CallKind::macro;
  entry.origin = call.by_code ? CallOrigin::code : CallOrigin::modal;
  entry.passes = call.repeats;
  entry.offset = entry.program.offset;
  entry.line = entry.program.line;
  entry.slot = static_cast<uint8_t>(slot);
  return enter_macro(in, entry, arguments);
}

}  // namespace

Execution enter_macro(Interpreter& in, const Entry& entry, const Value* arguments) {
  if (entry.passes == 0) return Execution::done;
  if (top(in).figure != 0) return in.raise(Condition::nesting, Role::call_program, entry.program.number);  // M700 13.3.3 (6)
  const unsigned level = in.macro_level() + 1u;
  if (level > kMacroDepth) return in.raise(Condition::macro_nesting, Role::call_program, entry.program.number);
  const Execution did = enter(in, entry);
  if (did != Execution::later) return did;
  in.variables.enter(level, arguments, in.state.seq + 1);
  in.keep_call();
  return did;
}

// ---- modal calls ------------------------------------------------------------------------------------------------------------

void show_modal_call(Interpreter& in) {
  in.program_changed();
  const unsigned slot = top(in).modal_call;
  in.state.modal.set(slot == 0 ? Function::macro_modal_off : modal_call(in, slot).every_block ? Function::macro_every_block : Function::macro_modal);
}

bool modal_call_takes_blocks(const Interpreter& in) {
  const unsigned slot = in.state.frame[in.state.depth].modal_call;
  return slot != 0 && modal_call(in, slot).every_block;
}

Execution store_modal_call(Interpreter& in, const ProgramRef& program, const MacroCall& call, uint32_t passes, bool every_block, bool by_code) {
  const unsigned slot = free_slot(in);
  if (slot == 0) return in.raise(Condition::macro_nesting, Role::call_program, program.number);
  ModalCall stored;
  stored.program = program;
  stored.repeats = passes;
  stored.every_block = every_block;
  stored.by_code = by_code;
  stored.below = top(in).modal_call;
  stored.depth = in.state.depth;
  for (unsigned i = 0; i < kLocals; ++i)
    if (!call.argument[i].vacant) stored.argument[i] = call.argument[i].number;
  in.change(&ProgramRecords::modal_call, slot - 1, stored);
  in.store->note(program.file, in.system_index);
  top(in).modal_call = static_cast<uint8_t>(slot);
  show_modal_call(in);
  return Execution::done;
}

Execution make_modal_call(Interpreter& in) {
  const unsigned slot = top(in).modal_call;
  Value arguments[kLocals];
  for (unsigned i = 0; i < kLocals; ++i) {
    const OptionalDouble argument = modal_call(in, slot).argument[i];
    if (argument.has_value()) arguments[i] = Value::of(*argument);
  }
  return enter_modal(in, slot, arguments);
}

/// M700 13.5.1, G66.1: the words of each block are given to the macro as if G65 P_ stood before them. O, N and modal G codes also change the modal state.
Execution call_with_block(Interpreter& in) {
  MacroCall call;
  for (const FunctionRow* row : in.words.functions) {
    if (is_space_arc(row->function)) return in.raise_code(Condition::space_arc_mode, *row);  // 6.14 (b)
    if (row->function == Function::work_system && select_work_system(in, *row) != Execution::done) return Execution::fault;
  }
  const Execution did = in.executed(read_arguments(*in.block, in.front, true, call));
  return did == Execution::done ? enter_modal(in, top(in).modal_call, call.argument) : did;
}

bool has_modal_call(const InForce& in) {
  const CallFrame& frame = in.state.frame[in.state.depth];
  return frame.modal_call != 0 || frame.modal_slot != 0;  // a macro that has cancelled its own call may do so again in its next pass
}

/// G67: cancels the modal call commanded last. A macro that is run by a modal call may cancel that call itself (M700 13.5.2 (1)).
void cancel_modal_call(Interpreter& in) {
  CallFrame& frame = top(in);
  const unsigned own = frame.modal_call;
  const bool commanded_here = own != 0 && modal_call(in, own).depth == in.state.depth;
  const bool runs_here = frame.modal_slot != 0 && in.state.frame[in.state.depth - 1].modal_call == frame.modal_slot;
  if (runs_here && !commanded_here) {
    in.state.frame[in.state.depth - 1].modal_call = modal_call(in, frame.modal_slot).below;
  } else if (own != 0) {
    frame.modal_call = modal_call(in, own).below;
  }
  show_modal_call(in);
}

// ---- G65, G66, G66.1 as written -----------------------------------------------------------------------------------------------

Execution call_macro(Interpreter& in) {
  MacroCall call;
  Execution did = in.executed(read_arguments(*in.block, in.front, false, call));
  if (did != Execution::done) return did;
  const Function function = in.words.one_shot->function;
  Entry entry;
  did = repetitions(in, call.has_repeats, call.repeats, &entry.passes);
  if (did != Execution::done || (entry.passes == 0 && function == Function::macro_call)) return did;  // L0: no call is made, and no program is searched for
  did = find_called(in, call.has_program, call.program, false, &entry.program);
  if (did != Execution::done) return did;
  if (function == Function::macro_call) {
    entry.kind = CallKind::macro;
    entry.offset = entry.program.offset;
    entry.line = entry.program.line;
    return enter_macro(in, entry, call.argument);
  }
  const bool every_block = function == Function::macro_every_block;
  did = store_modal_call(in, entry.program, call, entry.passes, every_block, false);
  // M700 13.5.1: the block of G66 only stores the call; the block of G66.1 also makes it.
  return did == Execution::done && every_block ? make_modal_call(in) : did;
}

}  // namespace nc
