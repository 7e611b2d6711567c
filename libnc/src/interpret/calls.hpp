// SPDX-License-Identifier: Apache-2.0
// Entering programs: what all kinds of calls use. M98 and M99 are in flow.cpp, G65 to G67 in macro_call.cpp, codes that call in code_call.cpp, M96 in
// interrupt.cpp.
#pragma once

#include "command/arguments.hpp"
#include "interpret/interpreter.hpp"

namespace nc {

inline constexpr unsigned kMacroDepth = 4;  ///< M700 13.5.2
inline constexpr uint64_t kWholeText = ~uint64_t{0};

inline CallFrame& top(Interpreter& in) { return in.state.frame[in.state.depth]; }

Execution evaluate_here(Interpreter& in, uint16_t code, Value* value);

/// Finds the program that P or <name> of the block in hand names; when there is neither, it is the running program, if `own_allowed`.
Execution find_called(Interpreter& in, bool has_p, double p, bool own_allowed, ProgramRef* program);
/// Turns the value of a word of a call into a program number or sequence number.
Execution called_number(Interpreter& in, Role word, double value, uint32_t* number);
Execution find_number(Interpreter& in, uint32_t number, ProgramRef* program);
/// Finds where a called program begins: at its first block, or at the sequence number that H names.
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
/// Enters a program; the result is Execution::later, or a fault. The block in hand gets its mark when the program returns.
Execution enter(Interpreter& in, const Entry& entry);
/// Enters a program as a macro, with its own level of local variables, which get these 33 values.
Execution enter_macro(Interpreter& in, const Entry& entry, const Value* arguments);

/// The modal call in a slot; slots are counted from 1.
inline const ModalCall& modal_call(const Interpreter& in, unsigned slot) { return in.records->modal_call[slot - 1]; }
/// G66, G66.1: stores a modal call.
Execution store_modal_call(Interpreter& in, const ProgramRef& program, const MacroCall& call, uint32_t passes, bool every_block, bool by_code);
/// Makes the modal call that is in force in this program.
Execution make_modal_call(Interpreter& in);
/// Sets the modal state that #4014 reads to the modal call of the program that runs.
void show_modal_call(Interpreter& in);

/// print.cpp: SETVN, POPEN, PCLOS, DPRNT, BPRNT
Execution set_names(Interpreter& in, const Statement& statement);
Execution open_port(Interpreter& in);
Execution close_port(Interpreter& in);
Execution print_decimal(Interpreter& in, const Statement& statement);
Execution print_binary(Interpreter& in, const Statement& statement);

/// The block has M98 or M99, and no other words than O N P L H (M700 13.3.1).
bool only_calls(const Interpreter& in);

}  // namespace nc
