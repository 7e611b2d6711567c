// SPDX-License-Identifier: Apache-2.0
// Entering programs: what the kinds of calls have in common. flow.cpp has M98 and M99, macro_call.cpp G65 to G67, code_call.cpp the
// codes that call, interrupt.cpp M96.
#pragma once

#include "interpret/interpreter.hpp"

namespace nc {

inline constexpr unsigned kMacroDepth = 4;  ///< M700 13.5.2
inline constexpr uint64_t kWholeText = ~uint64_t{0};

inline CallFrame& top(Interpreter& in) { return in.state.frame[in.state.depth]; }

Execution evaluate_here(Interpreter& in, uint16_t code, Value* value);

/// The program that P or <name> of the block in hand names; without both the running one where `own_allowed`.
Execution find_called(Interpreter& in, bool has_p, double p, bool own_allowed, ProgramRef* program);
/// A number of a program or a sequence that a call names.
Execution called_number(Interpreter& in, Role word, double value, uint32_t* number);
Execution find_number(Interpreter& in, uint32_t number, ProgramRef* program);
/// Where a called program begins: its head, or the sequence number that H names.
Execution find_start(Interpreter& in, const ProgramRef& program, uint64_t* offset, uint32_t* line);
/// L of a call: 1 when it is not there.
Execution repetitions(Interpreter& in, bool has_l, double l, uint32_t* count);

/// How a program is entered.
struct Entry {
  ProgramRef program;
  CallKind kind = CallKind::sub;
  CallOrigin origin = CallOrigin::word;
  uint32_t passes = 1;
  uint64_t offset = 0;      ///< of its first block (H), and
  uint32_t line = 1;
  uint8_t slot = 0;         ///< of the modal call that enters
  uint32_t last_sequence = 0;  ///< of the block behind which a pass has ended, 0 = M99 says so
};
/// later, or what is wrong. The block in hand gets its mark when the program returns.
Execution enter(Interpreter& in, const Entry& entry);
/// The same as a macro: a level of local variables with these values (33).
Execution enter_macro(Interpreter& in, const Entry& entry, const Value* arguments);

struct MacroCall {
  bool has_p = false, has_l = false;
  double p = 0, l = 0;
  Value argument[kLocals];
};
/// The block in hand as arguments. `every_word`: G L N O P are arguments too (M700 13.5.1, G66.1).
Execution gather_arguments(Interpreter& in, bool every_word, MacroCall& call);

/// G66, G66.1: the call is stored.
/// The modal call in a slot, from 1.
inline const ModalCall& modal_call(const Interpreter& in, unsigned slot) { return in.records->modal_call[slot - 1]; }
Execution store_modal_call(Interpreter& in, const ProgramRef& program, const MacroCall& call, uint32_t passes, bool every_block, bool by_code);
/// The modal call in force in this program is made now.
Execution make_modal_call(Interpreter& in);
/// What #4014 reads follows the program that runs.
void show_modal_call(Interpreter& in);

/// print.cpp: SETVN, POPEN, PCLOS, DPRNT, BPRNT
Execution set_names(Interpreter& in, const Statement& statement);
Execution open_port(Interpreter& in);
Execution close_port(Interpreter& in);
Execution print_decimal(Interpreter& in, const Statement& statement);
Execution print_binary(Interpreter& in, const Statement& statement);

/// M98 or M99 with nothing but O N P L H (M700 13.3.1).
bool only_calls(const Interpreter& in);

}  // namespace nc
