// SPDX-License-Identifier: Apache-2.0
// Codes and letters that call a program because a parameter says so: G M S T B (M700 13.5.2) and ASCII codes (13.5.3).
#pragma once

#include <cstdint>

#include "nc/vendor.h"

namespace nc {

class Parameters;
struct Dialect;

/// How a code calls: the values of the manual's <Type>.
enum class CodeCallType : uint8_t { sub = NC_CALL_SUB, macro = NC_CALL_MACRO, modal = NC_CALL_MODAL, modal_block = NC_CALL_EVERY_BLOCK };

struct CodeCall {
  uint32_t code = 0;       ///< G (times 1) or M number; ASCII: the letter
  uint32_t program = 0;    ///< O number; 0 = this row is not in use
  uint32_t variable = 0;   ///< ASCII type 0: the common variable that takes the value
  CodeCallType type = CodeCallType::sub;
  const nc_vendor_code* vendor = nullptr;  ///< a function of the host is called, and no program
};

/// Everything that is registered. Parameters: docs/macros.md.
struct CodeCalls {
  static constexpr unsigned kCodes = 10, kLetters = 2;
  CodeCall g[kCodes], m[kCodes];
  CodeCall s, t, b;
  CodeCall ascii[kLetters];
  bool any = false;
  bool system_codes = false;  ///< #1081 Gmac_P: also G codes that the control has itself

  const CodeCall* find_g(double code) const;
  const CodeCall* find_m(double code) const;
  const CodeCall* find_ascii(char letter) const;
};

CodeCalls read_code_calls(const Parameters& parameters, const Dialect& dialect);

}  // namespace nc
