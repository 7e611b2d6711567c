// SPDX-License-Identifier: Apache-2.0
// Distinguishes a loop that never ends from a long program: it counts passes of the same jump back, not blocks.
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
  uint64_t same = 100;        // for a loop that comes back to an earlier state
  uint64_t any = 10'000'000;  // for any loop
  static LoopLimits all(uint64_t passes) { return {passes, passes}; }
};

class LoopWatch {
 public:
  explicit LoopWatch(const LoopLimits& limits) : limits_(limits) {}

  /** Returns a hash of everything that can influence the program (nc_program_state_hash). It is expensive, so it is called in few passes only. */
  using Look = std::function<uint64_t()>;

  /** To be called when the program has read something that may change by itself: the present pass then counts as different from those before. */
  void asked() { ++questions_; }

  /** To be called when a block has ended. @return true when a loop has exceeded its limit; verdict() says which. */
  bool block(const nc_source& source, const Look& look);

  /** To be called when a block that goes on asks the machine how. @return true when it has done so more often than a loop may pass. */
  bool block_goes_on(const nc_source& source, const Look& look);

  /** The loop that exceeded its limit, such as "line 7: 100 passes of the loop back to line 3 ...". */
  const std::string& verdict() const { return verdict_; }
  /** The same for who may set the limit by an option of ncsim. */
  std::string verdict_and_option() const { return verdict_ + " (--max-passes)"; }

 private:
  struct Loop {
    uint64_t passes = 0;
    uint64_t kept_at = 0, state = 0, questions = 0;  // pass whose state is kept (0 = none yet), that state, and questions_ then
  };
  struct Level {
    uint32_t program = 0, file = 0, line = 0, furthest = 0;
    std::map<std::pair<uint32_t, uint32_t>, Loop> loops;  // keyed by the line to which the jump goes and the line from which it comes
  };
  bool pass(const nc_source& to, uint32_t from, Loop* loop, const Look& look);
  std::string too_often(Loop* loop, const Look& look) const;

  const LoopLimits limits_;
  std::vector<Level> levels_;  // one for each level of calls
  Loop in_block_;              // of the block in execution
  uint64_t questions_ = 0;
  std::string verdict_;
};

}  // namespace nc::tools
