// SPDX-License-Identifier: Apache-2.0
// Codes and words to which parameters give a program that they call: G M S T B (M700 13.5.2) and ASCII codes (13.5.3).
#pragma once

#include <cstdint>

#include "dialect/role.hpp"
#include "nc/vendor.h"

namespace nc {

/// How a code calls its program: the values of <Type> in the manual.
enum class CodeCallType : uint8_t { sub = NC_CALL_SUB, macro = NC_CALL_MACRO, modal = NC_CALL_MODAL, modal_block = NC_CALL_EVERY_BLOCK };

struct CodeCall {
  uint32_t code = 0;       ///< number of the G code (not times 10) or M code
  WordSlot word = kNoWord; ///< of an ASCII code
  uint32_t program = 0;    ///< O number; 0 = this row is not in use
  uint32_t variable = 0;   ///< of an ASCII code of type 0, or of T: number of the common variable that gets the value, 0 = none
  CodeCallType type = CodeCallType::sub;
  const nc_vendor_code* vendor = nullptr;  ///< not nullptr: a function of the host is called instead of a program
};

/// All codes that parameters have registered (docs/macros.md lists these parameters).
struct CodeCalls {
  static constexpr unsigned kCodes = 10, kAsciiCodes = 2;
  CodeCall g[kCodes], m[kCodes];
  CodeCall s, t, b;
  CodeCall ascii[kAsciiCodes];
  bool any = false;
  bool system_codes = false;  ///< #1081 Gmac_P: also G codes that the control itself has may be registered

  const CodeCall* find_g(double code) const;
  const CodeCall* find_m(double code) const;
  const CodeCall* find_ascii(WordSlot word) const;
};

}  // namespace nc
