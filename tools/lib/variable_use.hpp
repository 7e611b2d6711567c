// SPDX-License-Identifier: Apache-2.0
// Finds which variables a program and the programs that it calls read and write. It goes by their texts, whether a block is executed or not.
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

/** One variable, or one expression that computes the number of a variable. */
struct VariableUse {
  uint32_t number = 0;  // 0 = the number is computed, or the variable has a name
  std::string text;     // as in the program: "#100", "#[#1+2]", "#DEPTH"
  TextPlace read, written;  // first place where it is read, and where it is written
};

/** The variables that one text uses and the programs that it calls. */
struct TextUses {
  std::vector<VariableUse> uses;
  struct Call {
    std::string name;  // in the form of nc_program_missing; "" = computed
    uint32_t line = 0;
  };
  std::vector<Call> calls;
  std::vector<uint32_t> programs;  // O numbers of the programs in the text
};

/** Local variables are not listed, because no other program can use them. */
TextUses uses_of(const std::string& text, const std::string& file, nc_dialect dialect);

/** `ncsim variables --of PROGRAM`: prints a line for each variable on `out`, and on `err` the calls that could not be followed. */
int variable_use_command(const SessionOptions& options, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
