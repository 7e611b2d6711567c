// SPDX-License-Identifier: Apache-2.0
#include "interpret/vendor_codes.hpp"

#include <cmath>

#include "dialect/dialect.hpp"

namespace nc {

void VendorCodes::create(const nc_vendor_code* rows, unsigned count, const Dialect& dialect, nc_control* control, Arena& arena) {
  control_ = control;
  code_letter_ = dialect.addresses.letter(Role::code);
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

const CodeCall* VendorCodes::find(char letter, double value) const {
  const double scaled = letter == code_letter_ ? value * 10 : value, whole = std::nearbyint(scaled);
  if (!(whole >= 0 && whole < 1e9) || std::fabs(scaled - whole) > 1e-6) return nullptr;
  const auto number = static_cast<uint32_t>(whole);
  for (unsigned i = 0; i < count_; ++i)
    if (row_[i].number == number && row_[i].letter == letter) return &call_[i];
  return nullptr;
}

bool VendorCodes::replaces_g(int code) const {
  for (unsigned i = 0; i < count_; ++i)
    if (row_[i].letter == code_letter_ && static_cast<int>(row_[i].number) == code) return true;
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
