// SPDX-License-Identifier: Apache-2.0
// Tells a loop that never ends from a program that is long: passes of the same jump back are counted, not blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** Passes in a row after which a loop is given up; 0 = never. */
struct LoopLimits {
  uint64_t same = 100;             // of the main program, when nothing that it could decide by changes any more
  uint64_t same_called = 10'000;   // the same in a program called: a call may repeat it 9999 times
  uint64_t any = 10'000'000;
  static LoopLimits all(uint64_t passes) { return {passes, passes, passes}; }
};

class LoopWatch {
 public:
  explicit LoopWatch(const LoopLimits& limits) : limits_(limits) {}

  /** What the program could decide by: variables and positions. Asked twice in `same` passes. */
  using Look = std::function<std::vector<std::pair<uint32_t, double>>()>;

  /** Something has been read that changes by itself, or may: passes until now and the one in hand are different ones. */
  void asked() { ++questions_; }

  /** A block has ended. @return true: it ends one pass too many of a loop; verdict() says so. */
  bool block(const nc_source& source, const Look& look);

  /** "line 7: the loop back to line 3 ..." */
  const std::string& verdict() const { return verdict_; }

 private:
  struct Loop {
    uint64_t passes = 0, questions = 0;
    std::vector<std::pair<uint32_t, double>> before;
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

/** Variables, local ones of the level included, offsets, parameters, and where the program stands: a LoopWatch::Look. Their numbers only tell them apart. */
std::vector<std::pair<uint32_t, double>> loop_state(const nc_control* control, unsigned system, const nc_axes& work);

}  // namespace nc::tools
