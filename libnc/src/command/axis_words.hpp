// SPDX-License-Identifier: Apache-2.0
// Which words command the axes of a machine.
#pragma once

#include "dialect/role.hpp"
#include "nc/control.h"
#include "stream/stream.hpp"

namespace nc {

class AxisWords {
 public:
  /// Each axis is commanded by the word of its name, and by no other.
  void name(const nc_axis_config* axis, unsigned count) {
    for (int8_t& index : axis_) index = -1;
    for (WordSlot& word : word_) word = kNoWord;
    all_ = 0;
    for (unsigned i = 0; i < count; ++i) {
      word_[i] = word_named(axis[i].name);
      add(word_[i], i);
    }
  }
  /// A mode lets another word command an axis, too.
  void add(WordSlot word, unsigned axis) {
    axis_[index_of(word)] = static_cast<int8_t>(axis);
    all_ |= set_of(word);
  }
  /// The axis that a word commands now, -1 = none.
  int axis(WordSlot word) const { return axis_[index_of(word)]; }
  /// The axis that the word with this letter commands now, whatever character the host gives; -1 = none.
  int axis_named(char letter) const { return axis(word_named(letter)); }
  /// The word of the name of an axis.
  WordSlot word(unsigned axis) const { return word_[axis]; }
  /// The words that command axes now.
  WordSet all() const { return all_; }

 private:
  int8_t axis_[kAddresses + 1];   ///< by word; that of kNoWord is always -1
  WordSlot word_[kMaxAxes];
  WordSet all_ = 0;
};

}  // namespace nc
