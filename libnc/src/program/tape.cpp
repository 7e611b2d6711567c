// SPDX-License-Identifier: Apache-2.0
#include "program/tape.hpp"

#include <bit>

namespace nc {
namespace {

constexpr unsigned char kIsoDelete = 0xff, kIsoLineFeed = 0x0a;
constexpr unsigned char kEiaDelete = 0x7f, kEiaEndOfBlock = 0x80;
constexpr char kUnknown = '\x01';  ///< stands for a row that is in no table: P32 when its block is executed (3.1 note 1)

/// RS-244: channels 1 to 8 are the bits; channel 5 makes the number of holes odd.
struct EiaTable {
  char character[256] = {};
  constexpr EiaTable() {
    for (char& c : character) c = kUnknown;
    const unsigned char digits[] = {0x20, 0x01, 0x02, 0x13, 0x04, 0x15, 0x16, 0x07, 0x08, 0x19};
    for (int i = 0; i < 10; ++i) character[digits[i]] = static_cast<char>('0' + i);
    const unsigned char letters[] = {0x61, 0x62, 0x73, 0x64, 0x75, 0x76, 0x67, 0x68, 0x79,
                                     0x51, 0x52, 0x43, 0x54, 0x45, 0x46, 0x57, 0x58, 0x49,
                                     0x32, 0x23, 0x34, 0x25, 0x26, 0x37, 0x38, 0x29};
    for (int i = 0; i < 26; ++i) character[letters[i]] = static_cast<char>('A' + i);
    character[0x70] = '+';
    character[0x40] = '-';
    character[0x6b] = '.';
    character[0x3b] = ',';
    character[0x31] = '/';
    character[0x10] = ' ';
    character[0x0e] = '&';
    character[0x1a] = '(';  // control out, 2-4-5
    character[0x4a] = ')';  // control in, 2-4-7
    character[0x3e] = '\t';
    character[0x0b] = '%';  // end of record
    character[kEiaEndOfBlock] = '\n';
  }
};
constexpr EiaTable kEia;

char decode_iso(unsigned char row) {
  if (row == 0 || row == kIsoDelete) return kIgnoredRow;
  if (std::popcount(row) % 2 != 0) return kBadRow;
  const char c = static_cast<char>(row & 0x7f);
  return c == '\r' ? ' ' : c;  // it has no meaning, but counts in the parity of the block
}

char decode_eia(unsigned char row) {
  if (row == 0 || row == kEiaDelete) return kIgnoredRow;
  return std::popcount(row) % 2 == 0 ? kBadRow : kEia.character[row];
}

}  // namespace

bool ends_tape_block(uint8_t code, char row) {
  return static_cast<unsigned char>(row) == (code == NC_TAPE_EIA ? kEiaEndOfBlock : kIsoLineFeed);
}

void decode_tape(const TextEntry& entry, uint64_t offset, char* text, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    if (offset + i < entry.label) {  // M700 3.1 (1): the label becomes blanks; the end of its only block stays, so that lines are counted
      text[i] = ends_tape_block(entry.tape, text[i]) ? '\n' : ' ';
    } else if (entry.tape != NC_TAPE_TEXT) {
      const unsigned char row = static_cast<unsigned char>(text[i]);
      text[i] = entry.tape == NC_TAPE_EIA ? decode_eia(row) : decode_iso(row);
    }
  }
}

void BlockParity::take(const char* text, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    if (text[i] == kBadRow) bad_ = true;
    if (text[i] != kIgnoredRow) odd_ = !odd_;
  }
}

}  // namespace nc
