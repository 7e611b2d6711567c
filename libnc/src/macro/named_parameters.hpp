// SPDX-License-Identifier: Apache-2.0
// Parameters that a program names itself: #<feed height>. A parameter exists from the first block on that gives it a value; blanks and the case of letters
// do not count in its name. Parameters whose name begins with '_' stay when the program has ended, all others belong to the program (LinuxCNC "Named
// Parameters").
#pragma once

#include "base/arena.hpp"
#include "macro/expression.hpp"

namespace nc {

class NamedParameters {
 public:
  static constexpr unsigned kMost = 128, kLongest = 47;

  /// Takes the memory. Without this call there are no named parameters.
  void create(Arena& arena);
  /// The place of a name, which is given in capitals and without blanks; false = there is no such parameter.
  bool find(const char* name, size_t length, uint32_t* place) const;
  /// As find(), but makes the parameter when there is none; false = there is no room, or the name is too long.
  bool make(const char* name, size_t length, uint32_t* place);
  bool exists(uint32_t place) const { return slot_ != nullptr && place < kMost; }
  Value get(uint32_t place) const { return slot_[place].value; }
  void set(uint32_t place, Value value) { slot_[place].value = value; }
  /// A program begins, and nothing of the one before can be taken back any more: its own parameters are forgotten.
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
