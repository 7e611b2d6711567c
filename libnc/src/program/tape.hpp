// SPDX-License-Identifier: Apache-2.0
// Programs that are images of a punched tape, one byte for each row of holes (M700 3.1, 3.6): rows to
// characters, the label in front of the significant section, the parity of rows and blocks.
//
// A row becomes exactly one character, so that offsets into the tape are offsets into the text.
#pragma once

#include <cstddef>
#include <cstdint>

#include "program/window.hpp"

namespace nc {

/// What a row with a wrong number of holes becomes; no other character of a tape has this code.
inline constexpr char kBadRow = '\x80';
/// What a row that is always ignored becomes (codes B of 3.1): blank, and not counted in the parity of a
/// block.
inline constexpr char kIgnoredRow = '\r';

/// `size` rows from `offset` on, in place.
void decode_tape(const TextEntry& entry, uint64_t offset, char* text, size_t size);

/// The row is the end of a block.
bool ends_tape_block(uint8_t code, char row);

/// Parity of the rows of one block, decoded.
class BlockParity {
 public:
  void take(const char* text, size_t size);
  bool bad_row() const { return bad_; }
  /// Valid for a block with its end: the number of its characters, the end among them, is odd.
  bool odd() const { return odd_; }

 private:
  bool bad_ = false, odd_ = false;
};

}  // namespace nc
