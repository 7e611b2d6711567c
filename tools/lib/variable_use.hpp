// SPDX-License-Identifier: Apache-2.0
// Which variables a program and the programs that it calls read and write: from their texts, whether a block is executed or not.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tools/lib/session.hpp"

namespace nc::tools {

/** A place in a program. */
struct TextPlace {
  std::string file;
  uint32_t line = 0;  // 0 = nowhere
};

/** One variable, or one way in which a number is computed. */
struct VariableUse {
  uint32_t number = 0;  // 0 = computed, or a name
  std::string text;     // as written: "#100", "#[#1+2]", "#DEPTH"
  TextPlace read, written;  // first
};

/** What one text uses and calls. */
struct TextUses {
  std::vector<VariableUse> uses;
  struct Call {
    std::string name;  // as nc_program_missing names it; "" = computed
    uint32_t line = 0;
  };
  std::vector<Call> calls;
  std::vector<uint32_t> programs;  // O numbers in the text
};

/** Local variables (#1 to #33) are left out: they are nobody else's. */
TextUses uses_of(const std::string& text, const std::string& file);

/** `ncsim variables --of PROGRAM`: a line for each variable to `out`; what could not be followed to `err`. */
int variable_use_command(const SessionOptions& options, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
