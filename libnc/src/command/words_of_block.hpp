// SPDX-License-Identifier: Apache-2.0
// Questions about the words of a compiled block that no command answers: in which order they stand, how often, and what the words of a block say that is not
// executed yet.
#pragma once

#include "command/front_end.hpp"
#include "dialect/text.hpp"

namespace nc {

inline unsigned word_count(const Block& block) { return block.words.size(); }

/// How often a word stands in the block.
unsigned count_of(const Block& block, WordSlot word);
/// One of these words stands in the block.
bool has_any(const Block& block, WordSet words);
/// The words of the block are all of this set, but for those behind a comma.
bool has_only(const Block& block, WordSet words);
/// The first word of the block that is one of `words` (not empty); where none is, the first of `words`.
WordSlot first_of_block(const Block& block, WordSet words);
/// The place of a word in the block, from 1; of several the last one's. 0 = it is not there.
unsigned place_of(const Block& block, WordSlot word);
/// The first word that is an expression, kNoWord = none.
WordSlot first_expression(const Block& block);
/// The first of these words that is written with a point, and its value as it is written; kNoWord = none.
WordSlot first_with_point(const Block& block, WordSet words, double* value);
/// The word stands in the block, and no code with this function before it. Codes that are expressions do not count.
bool stands_before(const Block& block, const FrontEnd& front, WordSlot word, Function function);
/// The motion that is in force when the whole block has been read, if it is `now` before; codes that are expressions do not count.
Function motion_behind(const Block& block, const FrontEnd& front, Function now);

/// The next word from number *at on that is an expression and one of `words`; *at becomes the number behind it. False: there is none.
bool next_expression(const Block& block, WordSet words, unsigned* at, WordSlot* word, uint16_t* code);

/// A block to come that only moves axes.
struct ComingMove {
  uint32_t axes = 0;             ///< bit i: axis i is commanded ...
  uint32_t incremental = 0;      ///< ... incrementally
  Written value[kMaxAxes];
  bool relative = false;         ///< G91 is in force behind it
};
/// False: the block does anything but move some of `axes` along lines, and give out F S T and M. `relative`: G91 is in force before it.
bool read_coming_move(const Block& block, const FrontEnd& front, uint32_t axes, bool relative, ComingMove* move);

/// Copies the codes of a block before its word number `at`, and nothing else of its words.
void copy_codes_before(const Block& block, const FrontEnd& front, unsigned at, Block& copy);
/// Copies a block without its word number `at`.
void copy_without(const Block& block, unsigned at, Block& copy);

/// Writes a word as it stands in a program.
inline TextWriter& put_word(TextWriter& out, WordSlot word) { return out.put(letter_of(word)); }
/// How a parameter shows the name of an axis: the code of its letter.
inline double character_of(WordSlot word) { return letter_of(word); }
/// An alarm is about a word with this meaning.
inline bool is_about(const Fault& fault, const Dialect& dialect, Role role) { return fault.letter == dialect.addresses.letter(role); }
/// The place of a device in the store of programs ("D1:"), where sub programs are looked for.
struct DevicePlace {
  char text[4];
};
inline DevicePlace place_of_device(const Dialect& dialect, int device) { return {{dialect.device_letter, static_cast<char>('0' + device), ':', 0}}; }

}  // namespace nc
