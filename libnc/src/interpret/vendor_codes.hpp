// SPDX-License-Identifier: Apache-2.0
// The codes that the maker of the machine has added (nc_config::vendor_codes). One table for all part systems.
#pragma once

#include "base/arena.hpp"
#include "interpret/code_calls.hpp"
#include "nc/control.h"

namespace nc {

struct Dialect;

class VendorCodes {
 public:
  /// `rows` have been looked at and stay as long as the control, which is handed to their functions.
  void create(const nc_vendor_code* rows, unsigned count, const Dialect& dialect, nc_control* control, Arena& arena);
  bool any() const { return count_ != 0; }
  nc_control* control() const { return control_; }
  /// What a word calls, by its letter and value; nullptr = nothing of the vendor's.
  const CodeCall* find(char letter, double value) const;
  /// It takes the place of this code (times 10) of the dialect.
  bool replaces_g(int code) const;

 private:
  const nc_vendor_code* row_ = nullptr;
  CodeCall* call_ = nullptr;
  unsigned count_ = 0;
  char code_letter_ = 0;  ///< that of G codes
  nc_control* control_ = nullptr;
};

/// The last byte of a text's room is its end, and no character of UTF-8 is cut in two there.
void end_text(char* text, size_t size);

}  // namespace nc
