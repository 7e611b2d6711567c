// SPDX-License-Identifier: Apache-2.0
// The words of a block that a call gives to what it calls.
#pragma once

#include "base/fixed.hpp"
#include "command/front_end.hpp"
#include "macro/variables.hpp"
#include "nc/vendor.h"

namespace nc {

/// A macro call as it is written: the program and how often, and the values of its local variables, #1 first.
struct MacroCall {
  bool has_program = false, has_repeats = false;
  double program = 0, repeats = 0;
  Value argument[kLocals];
};
/// Takes the words of a block as arguments. `every_word`: G L N O P are arguments, too (M700 13.5.1, G66.1).
Reading read_arguments(const Block& block, FrontEnd& front, bool every_word, MacroCall& call);

/// The words that a function of the vendor gets: all except the word number `at`, which calls it, the G codes before it, and words without a value.
using VendorWords = FixedVector<nc_word, decltype(Block::words)::capacity()>;
Reading read_vendor_words(const Block& block, FrontEnd& front, unsigned at, VendorWords& words);
/// What the function gets of the code that calls it.
inline nc_vendor_block block_of(const nc_vendor_code& code, const VendorWords& words) {
  nc_vendor_block block{};
  block.struct_size = sizeof block;
  block.letter = code.letter;
  block.number = code.number;
  block.word_count = words.size();
  block.words = words.begin();
  return block;
}

}  // namespace nc
