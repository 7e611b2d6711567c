// SPDX-License-Identifier: Apache-2.0
// The encoding of program files, and texts as UTF-8. Inside of the control every text is UTF-8: a file in another encoding is converted
// where it is read, so that neither the lexer nor anybody who shows a text has to know of it. (A second byte of Shift-JIS may look like
// `)`, `;`, `%` or a backslash; in UTF-8 no byte of a longer character looks like one of ASCII.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nc::rt {

enum class Encoding : std::uint8_t { kUtf8, kLatin1, kShiftJis };

// "utf-8", "latin-1", "shift-jis"; nothing for another name.
std::optional<Encoding> encoding_from_name(std::string_view name);

// Bytes of the well-formed UTF-8 character at the start of `text`, 0 when there is none (overlong, surrogate, cut off).
std::size_t utf8_length(std::string_view text);
// The text with U+FFFD in the place of each byte that belongs to no character.
std::string valid_utf8(std::string_view text);
// The longest beginning of a valid text that has at most `bytes` bytes and ends with a whole character.
std::string_view cut_utf8(std::string_view text, std::size_t bytes);

// The same for a text that ends with a NUL in an array of `size` bytes.
void make_valid(char* text, std::size_t size);

// Converts to UTF-8, piece by piece, with iconv() of the C library. Bytes that are no character become U+FFFD.
class Decoder {
 public:
  explicit Decoder(Encoding encoding);
  ~Decoder();
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // False when the C library does not know the encoding.
  bool usable() const;
  // Appends to *out what `piece` is in UTF-8. Returns the bytes used: all, but for the first bytes of a character whose others are to come,
  // unless `last`.
  std::size_t take(std::string_view piece, bool last, std::string* out);

 private:
  const Encoding encoding_;
  void* converter_;
};

}  // namespace nc::rt
