// SPDX-License-Identifier: Apache-2.0
// The block in hand beside what is in force: its command, what functions keep for it, the answers of the machine, and the alarm that it ends with. Who gets
// this can check a block and raise an alarm, but puts nothing into the stream.
#pragma once

#include <optional>

#include "interpret/in_force.hpp"
#include "interpret/jobs_of_block.hpp"
#include "interpret/read_command.hpp"
#include "nc/run.h"

namespace nc {

/// Result of executing a block or a part of it.
enum class Execution : uint8_t {
  done,
  fault,   ///< Interpreter::fault says what is wrong
  sync,    ///< Interpreter::sync_needed says what is missing; the same is executed again when the answer is there
  later    ///< the block goes on at the next call (a cycle, an answer)
};

/// What an alarm is about: nothing, a word, given by itself or by its meaning, or a variable, a name or a character of a text.
class AlarmSubject {
 public:
  constexpr AlarmSubject() = default;
  constexpr AlarmSubject(WordSlot word) : kind_(Kind::word), number_(static_cast<uint8_t>(word)) {}    // NOLINT(google-explicit-constructor): a call names its subject
  constexpr AlarmSubject(Role role) : kind_(Kind::role), number_(static_cast<uint8_t>(role)) {}        // NOLINT(google-explicit-constructor)
  constexpr AlarmSubject(Sign sign) : kind_(Kind::sign), number_(static_cast<uint8_t>(sign)) {}        // NOLINT(google-explicit-constructor)
  /// Puts it into an alarm of a family.
  void name_in(Fault& fault, const AddressTable& addresses) const;

 private:
  enum class Kind : uint8_t { nothing, word, role, sign };
  Kind kind_ = Kind::nothing;
  uint8_t number_ = 0;
};

struct BlockInHand : InForce {
  const Block* block = nullptr;
  nc_source source{};
  Command words;
  FrontEnd front;                  ///< what the words of a block are read with
  BlockReader reader;
  JobsOfBlock jobs;
  Step next_step = Step::none;

  // ---- what is known of the machine, and what a handler gives back
  Fault fault;
  nc_world world{};
  bool world_fresh = false;        ///< `world` is the answer to a sync and nothing has been emitted since

  // ---- parameters: a block may change them
  /// Makes everything that follows from parameters anew, after parameters have been changed.
  void refresh_settings();
  /// Journalled write to a parameter; false when there is no such parameter or value.
  template <class Given>  // double, const char*
  bool set_parameter(ParameterId id, int bit, int axis, Given given) {
    unsigned index = 0;
    ParameterValue old;
    if (parameters.set(*dialect, id, bit, axis, given, &index, &old) != NC_OK) return false;
    note_parameter(index, old);
    return true;
  }
  /// The same by meaning; `axis` is the index of the axis for a parameter that each axis has for itself, -1 = one of all axes.
  bool set_parameter(ParameterOf parameter, double number, int axis = -1);

  // ---- alarms and questions
  /// Raises an alarm, with what it is about and with the value that it shows. Where the text could not be read, that is the alarm, because `condition`
  /// (something is missing) may only follow from it.
  Execution raise(Condition condition, AlarmSubject about = {}, std::optional<double> value = {});
  /// An alarm about the first word of the block that is one of `of` (not empty).
  Execution raise_first(Condition condition, WordSet of) {
    const WordSlot first = first_of_block(*block, of);
    return raise(condition, first, words.get(first));
  }
  /// An alarm about an axis, given by its index.
  Execution raise_axis(Condition condition, unsigned axis, std::optional<double> value = {}) {
    raise(condition, axis_words.word(axis), value);
    fault.axis = static_cast<int8_t>(axis);
    return Execution::fault;
  }
  /// An alarm about a code of the block in hand. Condition::no_function gives the code times ten, by which alarm_text() finds its row.
  Execution raise_code(Condition condition, const FunctionRow& row) {
    return raise(condition, Role::code, condition == Condition::no_function ? row.code : row.code / 10.0);
  }
  /// An alarm about a function, where its code is not at hand: the family's first code with this function is named.
  Execution raise_function(Condition condition, Function function) {
    const FunctionRow* const row = codes.row(function);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  /// An alarm about the code that is in force for a mode.
  Execution raise_mode(Condition condition, Mode mode) {
    const FunctionRow* const row = row_in_force(*dialect, state.modal, mode);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  Execution raise_misc(Condition condition, MiscFunction function) { return raise(condition, Role::misc_code, misc_code(*dialect, function)); }
  /// What reading words with `front` has come to.
  Execution executed(Reading reading) {
    if (reading == Reading::refused) return raise(front.refusal.condition, front.refusal.word, front.refusal.has_value ? std::optional(front.refusal.value) : std::nullopt);
    return reading == Reading::done ? Execution::done : reading == Reading::sync ? Execution::sync : Execution::fault;
  }
  /// The data that part systems share can be read now: the machine has come to this block, or there is only one part system. False: a sync is needed
  /// (NC_SYNC_SHARED).
  bool shared_known() const { return shared == nullptr || world_fresh; }
  /// Part of Interpreter::sync_needed: a variable is read in a contour with radius compensation, or before its end has been made.
  static constexpr uint32_t kSyncAhead = uint32_t{1} << 31;
  bool in_contour() const { return state.comp.side != 0 || state.moved_side != 0; }
  Execution need(uint32_t what) {
    sync_needed = what;
    return Execution::sync;
  }

 protected:
  void note_parameter(unsigned index, ParameterValue old);
  uint32_t sync_needed = 0;
  const VendorCodes* vendor = nullptr;  ///< the codes that the vendor of the machine has added
  CodeCalls code_calls;                 ///< codes that parameters have registered to call a program
  bool codes_call = false;              ///< there are such codes, or codes of the vendor
  bool settings_stale_ = false;
  bool settings_of_moves_stale_ = true;   ///< they are interned anew with the next move, so that only moves take up numbers
};

/// interpret/interrupt.cpp, macro_call.cpp: what other functions need of program control.
/// A code of the block calls a program, or names one (M96): then P, H and I J K are words of that code (M700 13.3.1, 13.3.3, 13.12).
bool has_words_of_call(const BlockInHand& in);
/// The word belongs to a code of the block that calls a program, names one or returns from it, and to nothing else there (M700 13.5.2: "except M, P, H and L"; HX 2.4.3: Q and R as well).
bool is_word_of_call(const BlockInHand& in, Role word);
bool has_modal_call(const InForce& in);   ///< something that G67 can cancel

}  // namespace nc
