// SPDX-License-Identifier: Apache-2.0
#include "command/vendor_codes.hpp"

#include <cmath>

#include "dialect/dialect.hpp"

namespace nc {

void VendorCodes::create(const nc_vendor_code* rows, unsigned count, const Dialect& dialect, nc_control* control, Arena& arena) {
  control_ = control;
  code_word_ = dialect.addresses.word(Role::code);
  if (count == 0) return;
  call_ = arena.make<CodeCall>(count);
  if (rows == nullptr || call_ == nullptr) return;
  row_ = rows;
  for (unsigned i = 0; i < count; ++i) {
    call_[i].code = rows[i].number;
    call_[i].program = rows[i].program;
    call_[i].type = static_cast<CodeCallType>(rows[i].call);
    call_[i].vendor = rows[i].function != nullptr ? &rows[i] : nullptr;
  }
  count_ = count;
}

const CodeCall* VendorCodes::find(WordSlot word, double value) const {
  const double scaled = word == code_word_ ? value * 10 : value, whole = std::nearbyint(scaled);
  if (!(whole >= 0 && whole < 1e9) || std::fabs(scaled - whole) > 1e-6) return nullptr;
  const auto number = static_cast<uint32_t>(whole);
  for (unsigned i = 0; i < count_; ++i)
    if (row_[i].number == number && word_named(row_[i].letter) == word) return &call_[i];
  return nullptr;
}

bool VendorCodes::replaces_g(int code) const {
  for (unsigned i = 0; i < count_; ++i)
    if (word_named(row_[i].letter) == code_word_ && static_cast<int>(row_[i].number) == code) return true;
  return false;
}

void end_text(char* text, size_t size) {
  text[size - 1] = 0;
  size_t end = 0;
  while (text[end] != 0) ++end;
  if (end + 1 < size) return;  // the text does not fill its room
  size_t behind = end;         // will be the first byte of the last character
  while (behind > 0 && (text[behind - 1] & 0xc0) == 0x80) --behind;
  if (behind == 0) return;
  const auto lead = static_cast<unsigned char>(text[behind - 1]);
  const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  if (behind - 1 + bytes > end) text[behind - 1] = 0;
}

}  // namespace nc
