// SPDX-License-Identifier: Apache-2.0
// Writes text into a fixed buffer. The text always ends with NUL and is cut where the buffer ends. Numbers do not depend on the locale.
#pragma once

#include <cstddef>

namespace nc {

class TextWriter {
 public:
  TextWriter(char* text, size_t size) : text_(text), size_(size) {
    if (size_ > 0) text_[0] = 0;
  }

  TextWriter& put(char c) {
    if (used_ + 1 < size_) {
      text_[used_++] = c;
      text_[used_] = 0;
    }
    return *this;
  }
  /// Appends `s`. If it does not fit, it is cut between two characters of UTF-8.
  TextWriter& put(const char* s) {
    const char* const begin = s;
    for (; *s != 0 && used_ + 1 < size_; ++s) put(*s);
    // The text ends before a continuation byte, which belongs to a character already begun: that character is removed.
    for (int i = 0; i < 3 && s != begin && (static_cast<unsigned char>(*s) & 0xc0) == 0x80; ++i, --s) text_[--used_] = 0;
    return *this;
  }
  /// Appends at least `digits` digits, with leading zeros.
  TextWriter& put_integer(unsigned long long value, unsigned digits = 1) {
    char reversed[24];
    unsigned n = 0;
    do {
      reversed[n++] = static_cast<char>('0' + value % 10);
      value /= 10;
    } while (value != 0 || n < digits);
    while (n > 0) put(reversed[--n]);
    return *this;
  }
  static constexpr double kVeryLarge = 1e14;  ///< from here on a number is not written in digits
  /// Appends a number with up to four decimals and without trailing zeros: "12.5", "-0.0001", "100".
  TextWriter& put_number(double value) {
    if (!(value == value)) return put("not a number");
    if (value < 0) {
      put('-');
      value = -value;
    }
    if (value >= kVeryLarge) return put("very large");
    const unsigned long long scaled = static_cast<unsigned long long>(value * 10000 + 0.5);
    put_integer(scaled / 10000);
    unsigned fraction = static_cast<unsigned>(scaled % 10000);
    if (fraction == 0) return *this;
    put('.');
    for (unsigned place = 1000; fraction != 0; place /= 10) {
      put(static_cast<char>('0' + fraction / place));
      fraction %= place;
    }
    return *this;
  }
  size_t used() const { return used_; }

 private:
  char* text_;
  size_t size_;
  size_t used_ = 0;
};

}  // namespace nc
