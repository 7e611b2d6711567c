// SPDX-License-Identifier: Apache-2.0
// Encodings of program files. See encoding.hpp.
#include "runtime/programs/encoding.hpp"

#include <iconv.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace nc::rt {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

struct EncodingRow {
  Encoding encoding;
  std::string_view name;
  const char* charset;  // name that iconv_open() takes
};
// Of the variants of Shift-JIS it is that of Windows, which editors and CAM systems write; in it 0x5c and 0x7e mean the same as in ASCII.
constexpr EncodingRow kEncodings[] = {
    {Encoding::kUtf8, "utf-8", "UTF-8"},
    {Encoding::kLatin1, "latin-1", "ISO-8859-1"},
    {Encoding::kShiftJis, "shift-jis", "CP932"},
};

const iconv_t kNoConverter = reinterpret_cast<iconv_t>(-1);  // NOLINT(performance-no-int-to-ptr): the value that iconv_open() returns on failure

// Eight characters are looked at together, because nearly all of a program is ASCII.
std::size_t ascii_length(std::string_view text) {
  constexpr std::uint64_t kNotAscii = 0x8080808080808080u;
  std::size_t n = 0;
  for (std::uint64_t eight = 0; n + sizeof eight <= text.size(); n += sizeof eight) {
    std::memcpy(&eight, text.data() + n, sizeof eight);
    if ((eight & kNotAscii) != 0) break;
  }
  while (n < text.size() && static_cast<unsigned char>(text[n]) < 0x80) ++n;
  return n;
}

}  // namespace

bool is_ascii(std::string_view text) { return ascii_length(text) == text.size(); }

std::optional<Encoding> encoding_from_name(std::string_view name) {
  for (const EncodingRow& row : kEncodings)
    if (row.name == name) return row.encoding;
  return std::nullopt;
}

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t n = lead >= 0xC2 && lead <= 0xDF ? 2 : (lead & 0xF0) == 0xE0 ? 3 : lead >= 0xF0 && lead <= 0xF4 ? 4 : 0;
  if (n == 0 || text.size() < n) return 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const unsigned char next = byte(1);
  const bool overlong = (lead == 0xE0 && next < 0xA0) || (lead == 0xF0 && next < 0x90);
  const bool no_character = (lead == 0xED && next > 0x9F) || (lead == 0xF4 && next > 0x8F);
  return overlong || no_character ? 0 : n;
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t n = utf8_length(text);
    out += n != 0 ? text.substr(0, n) : kReplacement;
    text.remove_prefix(n != 0 ? n : 1);
  }
  return out;
}

std::size_t unseen_length(std::string_view text) {
  const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto is_in = [](unsigned value, unsigned first, unsigned last) { return value >= first && value <= last; };
  if (text.empty()) return 0;
  if (at(0) < 0x20 || at(0) == 0x7f) return 1;
  if ((at(0) == 0xC2 && is_in(at(1), 0x80, 0x9F)) || (at(0) == 0xD8 && at(1) == 0x9C)) return 2;
  if (at(0) != 0xE2) return 0;
  const unsigned last = at(2);
  const bool unseen = (at(1) == 0x80 && (is_in(last, 0x8E, 0x8F) || is_in(last, 0xA8, 0xAE))) || (at(1) == 0x81 && is_in(last, 0xA6, 0xA9));
  return unseen ? 3 : 0;
}

std::string seen_text(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string seen;
  seen.reserve(valid.size());
  for (std::string_view rest = valid; !rest.empty();) {
    const std::size_t unseen = unseen_length(rest), length = unseen != 0 ? unseen : utf8_length(rest);
    seen += unseen != 0 ? " " : rest.substr(0, length);
    rest.remove_prefix(length);
  }
  return seen;
}

std::string_view cut_utf8(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

void make_valid(char* text, std::size_t size) {
  const std::string valid = valid_utf8(text);
  const std::string_view kept = cut_utf8(valid, size - 1);
  std::memcpy(text, kept.data(), kept.size());
  text[kept.size()] = 0;
}

Decoder::Decoder(Encoding encoding) : encoding_(encoding), converter_(kNoConverter) {
  for (const EncodingRow& row : kEncodings)
    if (row.encoding == encoding && encoding != Encoding::kUtf8) converter_ = iconv_open("UTF-8", row.charset);
}

Decoder::~Decoder() {
  if (converter_ != kNoConverter) iconv_close(converter_);
}

bool Decoder::usable() const { return encoding_ == Encoding::kUtf8 || converter_ != kNoConverter; }

std::size_t Decoder::take(std::string_view piece, bool last, std::string* out) {
  std::size_t used = 0;
  while (used < piece.size()) {
    const std::string_view left = piece.substr(used);
    if (const std::size_t ascii = ascii_length(left); ascii != 0) {  // a fast path, because nearly all of a program is ASCII
      out->append(left.substr(0, ascii));
      used += ascii;
      continue;
    }
    if (encoding_ == Encoding::kUtf8) {
      constexpr std::size_t kLongest = 4;
      const std::size_t n = utf8_length(left);
      if (n == 0 && !last && left.size() < kLongest && (static_cast<unsigned char>(left[0]) & 0xC0) == 0xC0) return used;
      out->append(n != 0 ? left.substr(0, n) : kReplacement);
      used += n != 0 ? n : 1;
      continue;
    }
    // Converts one character at a time, which is one byte or a lead byte and a second one. So a wrong character does not spoil the next one.
    char converted[8];
    std::size_t length = 1, room = sizeof converted;
    char* to = converted;
    bool good = false, begun = true;
    for (; begun && !good && length <= left.size() && length <= 2; length += good ? 0 : 1) {
      char* from = const_cast<char*>(left.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast): iconv() does not write there
      std::size_t input = length;
      to = converted;
      room = sizeof converted;
      iconv(converter_, nullptr, nullptr, nullptr, nullptr);
      good = iconv(converter_, &from, &input, &to, &room) != static_cast<std::size_t>(-1);
      begun = good || errno == EINVAL;
    }
    if (!good && begun && left.size() < 2 && !last) return used;
    if (good) {
      out->append(converted, sizeof converted - room);
      used += length;
    } else {
      out->append(kReplacement);
      ++used;
    }
  }
  return used;
}

}  // namespace nc::rt
