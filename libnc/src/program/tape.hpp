// SPDX-License-Identifier: Apache-2.0
// Programs that are images of a punched tape, one byte for each row of holes (M700 3.1, 3.6): turns rows into characters, hides the label before the
// significant section, and checks the parity of rows and blocks.
//
// A row becomes exactly one character, so that offsets into the tape are offsets into the text.
#pragma once

#include <cstddef>
#include <cstdint>

#include "program/window.hpp"

namespace nc {

/// The character for a row with a wrong number of holes; no other row gives it.
inline constexpr char kBadRow = '\x80';
/// The character for a row that is always ignored (codes B of 3.1): a blank, which does not count in the parity of a block.
inline constexpr char kIgnoredRow = '\r';

/// Decodes `size` rows, the first of which is at `offset`, in place.
void decode_tape(const TextEntry& entry, uint64_t offset, char* text, size_t size);

/// The row is the end of a block.
bool ends_tape_block(uint8_t code, char row);

/// Checks the parity of the decoded rows of one block.
class BlockParity {
 public:
  void take(const char* text, size_t size);
  bool bad_row() const { return bad_; }
  /// The number of characters of the block, counting its end, is odd. Valid only when the end has been taken.
  bool odd() const { return odd_; }

 private:
  bool bad_ = false, odd_ = false;
};

}  // namespace nc
