// SPDX-License-Identifier: Apache-2.0
// The codes that the maker of the machine has added (nc_config::vendor_codes). One table for all part systems.
#pragma once

#include "base/arena.hpp"
#include "command/code_calls.hpp"
#include "nc/control.h"

namespace nc {

struct Dialect;

class VendorCodes {
 public:
  /// `rows` have been checked and stay as long as the control, which is handed to their functions.
  void create(const nc_vendor_code* rows, unsigned count, const Dialect& dialect, nc_control* control, Arena& arena);
  bool any() const { return count_ != 0; }
  nc_control* control() const { return control_; }
  /// What this word with this value calls; nullptr = it is no code of the vendor.
  const CodeCall* find(WordSlot word, double value) const;
  /// A row replaces this G code (times 10) of the dialect.
  bool replaces_g(int code) const;

 private:
  const nc_vendor_code* row_ = nullptr;
  CodeCall* call_ = nullptr;
  unsigned count_ = 0;
  WordSlot code_word_ = kNoWord;  ///< of G codes
  nc_control* control_ = nullptr;
};

/// Puts a NUL at the end of a text that may fill its whole room, without cutting a UTF-8 character in two.
void end_text(char* text, size_t size);

}  // namespace nc
