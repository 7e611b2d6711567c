// SPDX-License-Identifier: Apache-2.0
// The keys of an interpreter's journal (macro/journal.hpp): which table a key belongs to, and which of its places it is.
#pragma once

#include "macro/variables.hpp"

namespace nc {

// First keys of the tables.
inline constexpr uint32_t kFrameKey = Variables::kForeignKey;
inline constexpr uint32_t kRecordKey = Variables::kForeignKey + 0x10000000;
inline constexpr uint32_t kLifeKey = Variables::kForeignKey + 0x20000000;
inline constexpr uint32_t kParameterKey = Variables::kForeignKey + 0x30000000;

enum class JournalTable : uint8_t { variables, frames, records, lives, parameters };

struct JournalPlace {
  JournalTable table;
  uint32_t index;  ///< place in the table; for variables the key
};

constexpr JournalPlace place_of(uint32_t key) {
  if (key < kFrameKey) return {JournalTable::variables, key};
  if (key < kRecordKey) return {JournalTable::frames, key - kFrameKey};
  if (key < kLifeKey) return {JournalTable::records, key - kRecordKey};
  if (key < kParameterKey) return {JournalTable::lives, key - kLifeKey};
  return {JournalTable::parameters, key - kParameterKey};
}

}  // namespace nc
