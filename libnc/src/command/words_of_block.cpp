// SPDX-License-Identifier: Apache-2.0
#include "command/words_of_block.hpp"

#include <cmath>

#include "command/command.hpp"
#include "modal/modes.hpp"

namespace nc {
namespace {

bool is_in(const Word& word, WordSet words) { return holds(words, slot_of(word)); }

}  // namespace

unsigned count_of(const Block& block, WordSlot word) {
  unsigned count = 0;
  for (const Word& at : block.words) count += slot_of(at) == word ? 1u : 0u;
  return count;
}

bool has_any(const Block& block, WordSet words) {
  for (const Word& word : block.words)
    if (is_in(word, words)) return true;
  return false;
}

bool has_only(const Block& block, WordSet words) {
  for (const Word& word : block.words)
    if (!is_in(word, words) && (word.flags & kWordComma) == 0) return false;
  return true;
}

WordSlot first_of_block(const Block& block, WordSet words) {
  for (const Word& word : block.words)
    if (is_in(word, words)) return slot_of(word);
  return first_word(words);
}

unsigned place_of(const Block& block, WordSlot word) {
  for (unsigned place = block.words.size(); place > 0; --place)
    if (slot_of(block.words[place - 1]) == word) return place;
  return 0;
}

WordSlot first_expression(const Block& block) {
  for (const Word& word : block.words)
    if ((word.flags & kWordExpression) != 0) return slot_of(word);
  return kNoWord;
}

WordSlot first_with_point(const Block& block, WordSet words, double* value) {
  for (const Word& word : block.words) {
    if (!is_in(word, words) || (word.flags & kWordPoint) == 0) continue;
    *value = word.value;
    return slot_of(word);
  }
  return kNoWord;
}

bool stands_before(const Block& block, const FrontEnd& front, WordSlot word, Function function) {
  for (const Word& at : block.words) {
    if (slot_of(at) == word) return true;
    const FunctionRow* const row = front.code_of(at);
    if (row != nullptr && row->function == function) return false;
  }
  return false;
}

Function motion_behind(const Block& block, const FrontEnd& front, Function now) {
  Function motion = now;
  for (const Word& word : block.words) {
    const FunctionRow* const row = front.code_of(word);
    if (row != nullptr && mode_of(row->function) == Mode::motion) motion = row->function;
  }
  return motion;
}

bool next_expression(const Block& block, WordSet words, unsigned* at, WordSlot* word, uint16_t* code) {
  while (*at < block.words.size()) {
    const Word& here = block.words[(*at)++];
    if ((here.flags & kWordExpression) == 0 || !is_in(here, words)) continue;
    *word = slot_of(here);
    *code = here.code;
    return true;
  }
  return false;
}

bool read_coming_move(const Block& block, const FrontEnd& front, uint32_t axes, bool relative, ComingMove* move) {
  move->axes = move->incremental = 0;
  move->relative = relative;
  for (const Word& word : block.words) {
    if ((word.flags & (kWordExpression | kWordComma | kWordCount | kWordNoValue)) != 0) return false;
    if (front.is(word, Role::feed) || front.is(word, Role::sequence_number) || front.is(word, Role::spindle_speed) || front.is(word, Role::tool)) continue;
    if (front.is(word, Role::code)) {
      const FunctionRow* const row = front.codes->find(word.value);
      if (row == nullptr || front.vendor->find(slot_of(word), word.value) != nullptr || (row->function != Function::linear && mode_of(row->function) != Mode::distance)) return false;
      if (row->function != Function::linear) move->relative = row->function == Function::incremental;
      continue;
    }
    if (front.is(word, Role::misc_code)) {
      uint32_t code = 0;
      if (front.calls->any || front.vendor->any() || (whole_number(word.value, &code) && !goes_out(misc_function(*front.dialect, code)))) return false;
      continue;
    }
    const int axis = front.axis_words->axis(slot_of(word));
    if (axis < 0 || ((axes >> axis) & 1) == 0) return false;
    const uint32_t bit = 1u << axis;
    move->axes |= bit;
    move->incremental = move->relative ? move->incremental | bit : move->incremental & ~bit;
    move->value[axis] = {word.value, word.flags};
  }
  return move->axes != 0;
}

void copy_codes_before(const Block& block, const FrontEnd& front, unsigned at, Block& copy) {
  copy = block;
  copy.words.clear();
  for (unsigned i = 0; i < at; ++i)
    if (front.is(block.words[i], Role::code)) copy.words.push_back(block.words[i]);
}

void copy_without(const Block& block, unsigned at, Block& copy) {
  copy = block;
  for (unsigned i = at; i + 1 < copy.words.size(); ++i) copy.words[i] = copy.words[i + 1];
  copy.words.resize(copy.words.size() - 1);
}

}  // namespace nc
