// SPDX-License-Identifier: Apache-2.0
// The words of a program as all rooms but the reader of a language know them: numbers, by which a word can be compared, looked for and put into a set. How it
// is spelled is known to its family only (dialect/role.hpp).
#pragma once

#include <cstdint>

namespace nc {

/// The number of different words that a language may have.
inline constexpr unsigned kAddresses = 31;
/// The address of a meaning that has no word. No word ever has this address.
inline constexpr uint8_t kNoAddress = kAddresses;

/// A word of a family. The first 26 are also the names of axes, A to Z, whatever the language; in one of ISO words they are its letters. A family that has
/// other words takes those that it needs for no axis, and the rest behind Z, which no axis can have.
enum class WordSlot : uint8_t {};
/// No word.
inline constexpr WordSlot kNoWord{kNoAddress};
/// A set of words, one bit for each.
using WordSet = uint32_t;
constexpr unsigned index_of(WordSlot word) { return static_cast<unsigned>(word); }
/// The set of one word; of kNoWord it is empty.
constexpr WordSet set_of(WordSlot word) { return (1u << index_of(word)) & ((1u << kNoAddress) - 1); }
constexpr bool holds(WordSet words, WordSlot word) { return (words >> index_of(word) & 1) != 0; }

inline constexpr unsigned kLetters = 26;
/// The word number `i` behind Z: no axis has it as its name.
constexpr WordSlot word_behind_z(unsigned i) { return WordSlot{static_cast<uint8_t>(kLetters + i)}; }
/// The word that an alarm names by this character: a capital letter, or one of the first control characters for those behind Z. kNoWord for any other one.
constexpr WordSlot word_named(char letter) {
  if (letter >= 'A' && letter <= 'Z') return WordSlot{static_cast<uint8_t>(letter - 'A')};
  const unsigned behind_z = static_cast<unsigned char>(letter) - 1u;  // very large for NUL
  return behind_z < kAddresses - kLetters ? word_behind_z(behind_z) : kNoWord;
}
/// The character by which an alarm names a word, 0 for kNoWord.
constexpr char letter_of(WordSlot word) {
  if (word == kNoWord) return char{0};
  return static_cast<char>(index_of(word) < kLetters ? 'A' + index_of(word) : 1 + index_of(word) - kLetters);
}
/// The word whose capital letter has this code of a character, kNoWord for any other number.
constexpr WordSlot word_of_capital(uint32_t code) { return code >= 'A' && code <= 'Z' ? word_named(static_cast<char>(code)) : kNoWord; }
/// The word whose letter, small or capital, has this code of a character, as parameters give it; kNoWord for any other number.
constexpr WordSlot word_of_character(double code) {
  if (!(code >= 'A' && code <= 'z')) return kNoWord;
  const char letter = static_cast<char>(code);
  return word_named(letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : letter);
}

}  // namespace nc
