// SPDX-License-Identifier: Apache-2.0
#include "command/arguments.hpp"

namespace nc {
namespace {

/// Argument designation II: I J K up to ten times, for #(3k+1) #(3k+2) #(3k+3). A word that does not come after the previous one in the order I J K begins
/// the next group. The first group gives the same variables as designation I.
struct GroupCounter {
  unsigned group = 1;
  int last = -1;
  /// Number of the variable for component 0, 1 or 2; 0 = there are more than ten groups.
  unsigned variable(int component) {
    if (component <= last) ++group;
    last = component;
    return group > 10 ? 0 : 3 * group + 1 + static_cast<unsigned>(component);
  }
};

/// Which of I J K (0, 1, 2) the word is, -1 = none of them.
int component_of(const FrontEnd& front, const Word& word) {
  for (unsigned i = 0; i < 3; ++i)
    if (front.is(word, vector_along(i))) return static_cast<int>(i);
  return -1;
}

/// The code calls the program whose arguments stand behind it.
bool calls_with_arguments(const FrontEnd& front, double code) {
  const FunctionRow* const row = front.codes->find(code);
  return (row != nullptr && is_macro_call(row->function)) || front.calls->find_g(code) != nullptr;
}

constexpr unsigned kNoArgument = kWordNoValue | kWordComma | kWordCount;

}  // namespace

Reading read_arguments(const Block& block, FrontEnd& front, bool every_word, MacroCall& call) {
  GroupCounter groups;
  const bool refuses_codes = front.dialect->rules.block.unused_words_are_faults;
  bool called = false;
  for (const Word& word : block.words) {
    const bool code = front.is(word, Role::code) && !every_word;
    if (code && !refuses_codes) continue;
    Value value;
    const Reading read = front.value_of(block, word, &value);
    if (read != Reading::done) return read;
    if (code) {  // HX 14.1.1 (1): behind the code that calls no other one is an argument
      if (called) return front.refuse(Condition::illegal_address, slot_of(word), value.number);
      called = calls_with_arguments(front, value.number);
      continue;
    }
    called = called || (front.is(word, Role::misc_code) && front.calls->find_m(value.number) != nullptr);
    if ((word.flags & kNoArgument) != 0) return front.refuse(Condition::format_error, slot_of(word));
    if (!every_word && front.is(word, Role::call_program)) {
      call.has_program = !value.vacant;
      call.program = value.or_zero();
      continue;
    }
    if (!every_word && front.is(word, Role::call_repeats)) {
      call.has_repeats = !value.vacant;
      call.repeats = value.or_zero();
      continue;
    }
    if (!every_word && (front.is(word, Role::sequence_number) || front.is(word, Role::program_number))) return front.refuse(Condition::illegal_address, slot_of(word));
    unsigned variable = front.dialect->argument_of[index_of(slot_of(word))];
    if (const int component = component_of(front, word); component >= 0) {
      variable = groups.variable(component);
      if (variable == 0) return front.refuse(Condition::macro_argument, slot_of(word));
    }
    call.argument[variable - 1] = value;
  }
  return Reading::done;
}

Reading read_vendor_words(const Block& block, FrontEnd& front, unsigned at, VendorWords& words) {
  for (unsigned i = 0; i < block.words.size(); ++i) {
    const Word& word = block.words[i];
    if (i == at || (i < at && front.is(word, Role::code))) continue;
    if ((word.flags & kNoArgument) != 0) return front.refuse(Condition::format_error, slot_of(word));
    Value value;
    const Reading read = front.value_of(block, word, &value);
    if (read != Reading::done) return read;
    if (!value.vacant) words.push_back(nc_word{letter_of(word.slot), value.number});  // M700 13.5.4
  }
  return Reading::done;
}

}  // namespace nc
