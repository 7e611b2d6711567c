// SPDX-License-Identifier: Apache-2.0
// The table of instructions: for each the text of the documentation and what the compiler does with it.
#pragma once

#include <string_view>
#include <vector>

#include "ladder/code.hpp"

namespace nc::ladder {

enum class Action {
  kLoad,        // LD: emits op at the beginning of a rung and op2 within one
  kJoin,        // AND or OR of one contact; `parallel` means OR
  kBlock,       // ANB, ORB
  kPushBranch,  // MPS
  kReadBranch,
  kPopBranch,
  kInvert,
  kEdgeOfResult,  // MEP, MEF
  kOut,           // OUT of a bit, timer or counter
  kSet,
  kReset,
  kPulseCoil,  // PLS, PLF, FF
  kMaster,     // MC
  kMasterEnd,
  kWords,       // an operation on words with the operands of `spec`
  kAccumulate,  // the same, with two forms as in + S D and + S1 S2 D
  kResetRange,
  kJump,
  kCall,
  kReturn,
  kMainEnd,
  kEnd,
  kFor,
  kNext,
  kAlias,
  kNothing
};

struct Rule {
  InstructionInfo info;
  Action action;
  Op op = Op::kNop;
  Op op2 = Op::kNop;
  // Word operands, one letter each. Sources: s = 16 bits, S = 32 bits, r = a row of words. Destinations: d = 16 bits,
  // D = 32 bits, q = two words, Q = four words, w = a row of words.
  const char* spec = "";
  std::uint32_t extra = 0;  // relation of a compare, or unit of a timer in microseconds
  bool edge = false;        // needs the memory of an edge
  bool parallel = false;    // OR
};

const std::vector<Rule>& rules();

// The rule of a mnemonic in upper case; *pulse is set for a P form. Null when there is none.
const Rule* find_rule(std::string_view mnemonic, bool* pulse);

}  // namespace nc::ladder
