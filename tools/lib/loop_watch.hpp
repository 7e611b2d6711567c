// SPDX-License-Identifier: Apache-2.0
// Tells a loop that never ends from a program that is long: passes of the same jump back are counted, not blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** Passes in a row after which a loop is given up; 0 = never. */
struct LoopLimits {
  uint64_t same = 100;  // when it comes back to a state that it has had before
  uint64_t any = 10'000'000;
  static LoopLimits all(uint64_t passes) { return {passes, passes}; }
};

class LoopWatch {
 public:
  explicit LoopWatch(const LoopLimits& limits) : limits_(limits) {}

  /** A number for all that the program can go by (nc_program_state_hash). It is dear: it is asked for in few passes. */
  using Look = std::function<uint64_t()>;

  /** Something has been read that changes by itself, or may: passes until now and the one in hand are different ones. */
  void asked() { ++questions_; }

  /** A block has ended. @return true: it ends one pass too many of a loop; verdict() says so. */
  bool block(const nc_source& source, const Look& look);

  /** "line 7: the loop back to line 3 ..." */
  const std::string& verdict() const { return verdict_; }

 private:
  struct Loop {
    uint64_t passes = 0;
    uint64_t kept_at = 0, state = 0, questions = 0;  // the pass whose state is kept, 0 = none yet
  };
  struct Level {
    uint32_t program = 0, file = 0, line = 0, furthest = 0;
    std::map<std::pair<uint32_t, uint32_t>, Loop> loops;  // by the lines to and from which the jump goes
  };
  bool pass(const nc_source& to, uint32_t from, Loop* loop, const Look& look);

  const LoopLimits limits_;
  std::vector<Level> levels_;  // of calls
  uint64_t questions_ = 0;
  std::string verdict_;
};

}  // namespace nc::tools
