// SPDX-License-Identifier: Apache-2.0
// The encodings of program files, and functions for texts in UTF-8. Inside the control every text is UTF-8: a file in another encoding is converted
// when it is read, so that neither the lexer nor the displays have to know of encodings. (In Shift-JIS the second byte of a character may be the code
// of `)`, `;`, `%` or a backslash; in UTF-8 no byte of a longer character is an ASCII code.)
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

// A text of ASCII alone is the same in each of these encodings.
bool is_ascii(std::string_view text);

// Bytes of the well-formed UTF-8 character at the start of `text`, 0 when there is none (overlong, surrogate, cut off).
std::size_t utf8_length(std::string_view text);
// The text, in which each byte that belongs to no character is replaced by U+FFFD.
std::string valid_utf8(std::string_view text);
// Bytes of the character at the start of a text when nobody sees it but a terminal acts on it, else 0: control characters (to U+001F, U+007F to U+009F), and those that
// change lines or the direction in which a text is read (U+061C, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069), so that it is shown as another text.
std::size_t unseen_length(std::string_view text);
// The text for a terminal and for displays: valid, with a blank for each such character.
std::string seen_text(std::string_view text);
// The longest beginning of a valid text that has at most `bytes` bytes and ends with a whole character.
std::string_view cut_utf8(std::string_view text, std::size_t bytes);

// Makes a text that ends with a NUL in an array of `size` bytes valid UTF-8, cut to the array at a whole character.
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
  // Appends `piece` in UTF-8 to *out. Returns the number of bytes used. That is all of them, except for an incomplete character at the end, which is
  // left for the next call unless `last` is set.
  std::size_t take(std::string_view piece, bool last, std::string* out);

 private:
  const Encoding encoding_;
  void* converter_;
};

}  // namespace nc::rt
