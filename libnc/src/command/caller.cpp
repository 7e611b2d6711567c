// SPDX-License-Identifier: Apache-2.0
#include "command/caller.hpp"

#include "modal/modes.hpp"

namespace nc {
namespace {

bool plain_number(const Word& word) { return (word.flags & (kWordComma | kWordCount | kWordNoValue)) == 0; }

/// The word is the second auxiliary function; it may call where its word is not that of an axis (M700 9.2).
bool second_aux(const FrontEnd& front, const Word& word) { return front.is(word, Role::second_function) && front.axis_words->axis(slot_of(word)) < 0; }

/// M00 M01 M02 M30, the codes of calls and of the macro interrupt keep their meaning, whatever is registered (M700 13.5.3: priority of the letter M).
bool kept_by_control(const FrontEnd& front, double value) {
  uint32_t code = 0;
  return whole_number(value, &code) && code == value && find_misc(*front.dialect, code) != nullptr;
}

/// The word may call, as far as its letter goes.
bool may_call(const FrontEnd& front, const Word& word) {
  const CodeCalls& calls = *front.calls;
  return front.is(word, Role::code) || front.is(word, Role::misc_code) || calls.find_ascii(slot_of(word)) != nullptr ||
         (front.is(word, Role::spindle_speed) && calls.s.program != 0) || (front.is(word, Role::tool) && calls.t.program != 0) ||
         (front.is(word, Role::second_function) && calls.b.program != 0);
}

const CodeCall* registered(const FrontEnd& front, const Word& word, double value, bool ascii_allowed, bool* ascii) {
  const CodeCalls& calls = *front.calls;
  *ascii = false;
  const CodeCall* call = front.vendor->any() && (front.is(word, Role::code) || front.is(word, Role::misc_code)) ? front.vendor->find(slot_of(word), value) : nullptr;
  if (call != nullptr) return call;
  const CodeCall* of_word = nullptr;
  if (front.is(word, Role::code)) return calls.find_g(value);
  if (front.is(word, Role::misc_code)) {
    if (kept_by_control(front, value)) return nullptr;
    call = calls.find_m(value);
  } else if (front.is(word, Role::spindle_speed)) {
    of_word = &calls.s;
  } else if (front.is(word, Role::tool)) {
    of_word = &calls.t;
  } else if (second_aux(front, word)) {
    of_word = &calls.b;
  }
  if (of_word != nullptr && of_word->program != 0) call = of_word;
  if (call != nullptr || !ascii_allowed) return call;
  *ascii = true;
  return calls.find_ascii(slot_of(word));
}

bool starts_cycle(Function f) { return mode_of(f) == Mode::cycle && f != Function::cycle_off && f != Function::user_cycle; }

/// M700 13.5.3 (5) (a), (e): beside data setting and in a fixed cycle, of which the block with its code is the first, an ASCII code is an ordinary word.
bool has_words_of_code(const Block& block, const FrontEnd& front) {
  for (const Word& word : block.words) {
    const FunctionRow* const row = front.code_of(word);
    if (row != nullptr && (row->function == Function::data_input || starts_cycle(row->function))) return true;
  }
  return false;
}

}  // namespace

bool begins_cycle(const Block& block, const FrontEnd& front, const Caller& caller) {
  for (unsigned i = 0; i < block.words.size(); ++i) {
    const FunctionRow* const row = i != caller.at ? front.code_of(block.words[i]) : nullptr;
    if (row != nullptr && starts_cycle(row->function)) return true;
  }
  return false;
}

Reading find_caller(const Block& block, FrontEnd& front, bool functions_only, bool in_cycle, Caller* caller) {
  const bool ascii_allowed = !in_cycle && !has_words_of_code(block, front);
  for (unsigned i = 0; i < block.words.size(); ++i) {
    const Word& word = block.words[i];
    if (!plain_number(word) || !may_call(front, word)) continue;
    Value value;
    const Reading read = front.value_of(block, word, &value);
    if (read != Reading::done) return read;
    if (value.vacant) continue;
    if (front.is(word, Role::code)) {
      const FunctionRow* const row = front.codes->find(value.number);
      if (row != nullptr && is_macro_call(row->function) && front.calls->find_g(value.number) == nullptr) return Reading::done;
    }
    bool ascii = false;
    const CodeCall* const call = registered(front, word, value.number, ascii_allowed, &ascii);
    if (call == nullptr || (functions_only && call->vendor == nullptr)) continue;
    *caller = Caller{i, slot_of(word), call, ascii, value.number};
    return Reading::done;
  }
  return Reading::done;
}

Reading goes_on_elsewhere(const Block& block, FrontEnd& front, bool* elsewhere) {
  for (const Word& word : block.words) {
    if (!plain_number(word) || !front.is(word, Role::misc_code)) continue;
    Value value;
    const Reading read = front.value_of(block, word, &value);
    if (read != Reading::done) return read;
    uint32_t code = 0;
    if (value.vacant || !whole_number(value.number, &code)) continue;
    const MiscFunction function = misc_function(*front.dialect, code);
    *elsewhere = *elsewhere || leads_elsewhere(function);
  }
  return Reading::done;
}

}  // namespace nc
