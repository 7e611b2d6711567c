// SPDX-License-Identifier: Apache-2.0
// Parameters that a program names itself: #<feed height>. A name is there from the first block that gives it a value; blanks and the case of letters
// do not count. Those that begin with '_' stay when the program is over, the others are the program's (LinuxCNC "Named Parameters").
#pragma once

#include "base/arena.hpp"
#include "macro/expression.hpp"

namespace nc {

class NamedParameters {
 public:
  static constexpr unsigned kMost = 128, kLongest = 47;

  /// Without it there are none, and no memory for them.
  void create(Arena& arena);
  /// The place of a name in capitals without blanks; false = it has none.
  bool find(const char* name, size_t length, uint32_t* place) const;
  /// The same, and a place for it where it has none; false = there is no room, or the name is too long.
  bool make(const char* name, size_t length, uint32_t* place);
  bool exists(uint32_t place) const { return slot_ != nullptr && place < kMost; }
  Value get(uint32_t place) const { return slot_[place].value; }
  void set(uint32_t place, Value value) { slot_[place].value = value; }
  /// A program begins, and nothing of the one before can be taken back.
  void forget_program();

 private:
  struct Slot {
    uint8_t length;  ///< 0 = free
    char name[kLongest];
    Value value;
  };
  Slot* slot_ = nullptr;
};

}  // namespace nc
