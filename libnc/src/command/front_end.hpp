// SPDX-License-Identifier: Apache-2.0
// What a family's blocks are read with: its tables, the words of the machine's axes, and the few questions that only the core can answer.
#pragma once

#include "command/auxiliary.hpp"
#include "command/axis_words.hpp"
#include "command/code_calls.hpp"
#include "command/vendor_codes.hpp"
#include "command/word.hpp"
#include "dialect/code_index.hpp"
#include "macro/expression.hpp"

namespace nc {

/// How the core evaluates an expression of the block in hand.
struct Evaluation {
  VariableReader variables;
  EvalOptions options;
};

/// What the front end asks the core while it reads a block. `core` is FrontEnd::core.
struct CoreQuestions {
  Evaluation (*evaluation)(void* core) = nullptr;
  /// Whether a code may be commanded now. Reading::fault: it may not, and the core has put the reason into FrontEnd::fault.
  Reading (*check_code)(void* core, const FunctionRow& row, double written) = nullptr;
  /// A modal call is in force that a block could cancel.
  bool (*has_modal_call)(const void* core) = nullptr;
  /// A length in mm, in the units that are in force before the block.
  double (*length)(const void* core, Written number) = nullptr;
};

/// All that it points at outlives it.
struct FrontEnd {
  const Dialect* dialect = nullptr;
  const CodeIndex* codes = nullptr;
  const AxisWords* axis_words = nullptr;
  const VendorCodes* vendor = nullptr;
  const CodeCalls* calls = nullptr;   ///< codes that parameters have registered
  const MiscCodes* misc_codes = nullptr;  ///< M codes to which parameters give a meaning
  WordSet code_words = 0;             ///< words of G and M codes and of numbers at the head of a block
  bool checks_codes = false;          ///< the core is asked about every code of the block; otherwise only about those that are not built
  void* core = nullptr;
  const CoreQuestions* questions = nullptr;
  Fault* fault = nullptr;             ///< receives the reason of Reading::fault
  uint32_t* sync = nullptr;           ///< receives what Reading::sync needs
  Refusal refusal;                    ///< the reason of Reading::refused

  /// The word has this meaning. A word may have several.
  bool is(const Word& word, Role role) const { return dialect->addresses.is(word.slot, role); }
  const FunctionRow* code_of(const Word& word) const { return is(word, Role::code) && (word.flags & kWordExpression) == 0 ? codes->find(word.value) : nullptr; }
  Reading evaluate_code(const Block& block, uint16_t code, Value* value) const {
    const Evaluation by = questions->evaluation(core);
    const Eval eval = evaluate(block, code, by.variables, by.options, value, fault, sync);
    return eval == Eval::ok ? Reading::done : eval == Eval::fault ? Reading::fault : Reading::sync;
  }
  /// The value of a word, be it a number or an expression.
  Reading value_of(const Block& block, const Word& word, Value* value) const {
    *value = Value::of(word.value);
    return (word.flags & kWordExpression) != 0 ? evaluate_code(block, word.code, value) : Reading::done;
  }
  Reading refuse(Condition condition, WordSlot word) {
    refusal = {condition, word, false, 0};
    return Reading::refused;
  }
  Reading refuse(Condition condition, WordSlot word, double value) {
    refusal = {condition, word, true, value};
    return Reading::refused;
  }
  /// About a code of the block. Condition::no_function gives the code times ten, by which alarm_text() finds its row.
  Reading refuse_code(Condition condition, const FunctionRow& row) {
    return refuse(condition, Role::code, condition == Condition::no_function ? row.code : row.code / 10.0);
  }
  Reading refuse(Condition condition, Role word) { return refuse(condition, dialect->addresses.word(word)); }
  Reading refuse(Condition condition, Role word, double value) { return refuse(condition, dialect->addresses.word(word), value); }
};

/// The word of a compiled block as the rest of the control knows it.
inline WordSlot slot_of(const Word& word) { return word.slot; }

}  // namespace nc
