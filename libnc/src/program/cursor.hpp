// SPDX-License-Identifier: Apache-2.0
// Moves over the characters of one block: skips what has no meaning, finds the end of the block, reads numbers and keywords. Used by the lexer
// (dialect/iso_lexer.cpp) and the expression compiler (macro/compile.cpp).
#pragma once

#include <bit>
#include <cstring>

#include "program/number.hpp"

namespace nc {

/// NUL (blank tape) and DEL (a row that was punched out) have no meaning (M700 3.1): editors and transmissions leave them in files.
inline bool is_ignored(char c) {
  return c == '\0' || c == '\x7f';
}
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || is_ignored(c);
}
inline bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}
inline bool is_letter(char c) {
  return static_cast<unsigned char>((c | 0x20) - 'a') < 26;
}
inline char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
}

/// Looks at eight characters together: how many of them, from the first on, are digits, and which number these make. A loop over digits mispredicts a
/// branch once per number; this has no branch.
class EightCharacters {
 public:
  static constexpr bool kUsable = std::endian::native == std::endian::little;

  explicit EightCharacters(const char* p) {
    std::memcpy(&x_, p, sizeof x_);
    x_ ^= 0x3030303030303030u;  // digits become 0..9
    // Bit 7 of every byte above 9. A carry out of a byte can only spoil those behind the first such byte.
    others_ = ((x_ + 0x7676767676767676u) | x_) & 0x8080808080808080u;
    count_ = first(others_);
  }
  unsigned digits() const { return count_; }
  /// Value of the digits, where there are fewer than eight. Neighbours are joined to numbers of 2, then 4, then 8 digits.
  uint64_t value() const { return joined(x_, count_); }

  /// Number of characters up to the end of the digits behind a point; 8 = there may be more.
  unsigned length_past_point() const {
    return first(others_ & (others_ - 1));  // a point makes no carry, so the next mark is right, too
  }
  /// Value of `length` characters, leaving out the point among them.
  uint64_t value_without(unsigned point, unsigned length) const {
    const unsigned bits = 8 * point;
    const uint64_t before = x_ & ((uint64_t{1} << bits) - 1);
    return joined(before | ((x_ >> bits >> 8) << bits), length - 1);
  }

 private:
  /// Number of the byte with the lowest mark, 8 = there is no mark.
  static unsigned first(uint64_t marks) {
    return marks != 0 ? static_cast<unsigned>(std::countr_zero(marks)) >> 3 : 8;
  }
  static uint64_t joined(uint64_t digits, unsigned count) {
    uint64_t v = (digits << (56 - 8 * count)) << 8;
    v = (v * 10 + (v >> 8)) & 0x00ff00ff00ff00ffu;
    v = (v * 100 + (v >> 16)) & 0x0000ffff0000ffffu;
    return (v * 10000 + (v >> 32)) & 0xffffffffu;
  }

  uint64_t x_, others_;
  unsigned count_;
};

/// A place in the text of a block, and the rules for moving on from it.
struct Cursor {
  const char* p = nullptr;
  const char* end = nullptr;
  bool semicolon_ends = false;    ///< ';' ends the words of a block, whatever follows it
  const char* comment = nullptr;  ///< text of the last comment passed over
  const char* comment_end = nullptr;
  bool comment_is_open = false;   ///< a comment had no end

  /// Moves past blanks and comments. A comment that is not closed ends with its line (M700 3.1, 3.2).
  void skip() {
    while (p != end) {
      if (is_blank(*p)) {
        ++p;
      } else if (*p == '(') {
        skip_comment();
      } else {
        return;
      }
    }
  }
  void skip_comment() {
    comment = ++p;
    while (p != end && *p != ')' && *p != '\n') ++p;
    comment_end = p;
    if (p != end && *p == ')') ++p;
    else comment_is_open = true;
  }
  /// At the end of the block: a line end, a ';' that ends it, '%', or the end of the text.
  bool at_end() const { return p == end || *p == '\n' || *p == '%' || (*p == ';' && semicolon_ends); }
  /// The next character behind blanks and comments, as a capital; 0 = end of the block.
  char peek() {
    skip();
    return at_end() ? '\0' : upper(*p);
  }
  /// Moves past `c` when it is the next character.
  bool accept(char c) {
    if (peek() != c || at_end()) return false;
    ++p;
    return true;
  }
  /// Moves past a keyword when it comes next; blanks inside it are allowed, as everywhere.
  bool accept(const char* word) {
    const Cursor before = *this;
    for (; *word != '\0'; ++word) {
      if (!accept(*word)) {
        *this = before;
        return false;
      }
    }
    return true;
  }
  /// Reads an unsigned decimal number; blanks and comments are allowed between its characters.
  Decimal number() {
    constexpr uint32_t kMantissaDigits = 19;
    Decimal d;
    uint64_t mantissa = 0;
    uint32_t significant = 0, dropped = 0;  // digits in `mantissa`; fraction digits beyond them
    uint32_t taken_fraction = 0;
    for (char c = peek(); is_digit(c) || (c == '.' && !d.point); c = peek()) {
      ++p;
      if (c == '.') {
        d.point = true;
        continue;
      }
      ++d.digits;
      if (d.point) ++d.fraction_digits;
      if (significant != 0 || c != '0') {
        if (!d.point) ++d.integer_digits;
        if (significant == kMantissaDigits) {
          ++dropped;
          continue;
        }
        ++significant;
        mantissa = mantissa * 10 + static_cast<uint64_t>(c - '0');
      }
      if (d.point) ++taken_fraction;
      if (!d.point) d.integer = mantissa;
    }
    if (d.integer_digits > kMantissaDigits) {
      d.integer = kPowersOfTen[kMantissaDigits];
      d.value = static_cast<double>(d.integer);  // the caller refuses such a number, because of integer_digits
    } else {
      d.value = scale_decimal(mantissa, taken_fraction);
    }
    return d;
  }
};

}  // namespace nc
