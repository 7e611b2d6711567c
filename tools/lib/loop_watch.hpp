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

/**
 * Rounds of a loop of the main program that has no end by what is written, after which it is given up although it comes to new states: it counts. `never_ends` says
 * that of a loop back to a line, from another one; without it no loop is given up so.
 */
struct RoundLimits {
  uint64_t rounds = 1000;
  uint64_t few = 3, blocks = 1'000'000;  // or so few rounds, of so many blocks together
  std::function<bool(const nc_source& to, uint32_t from)> never_ends = {};
};

/** Passes in a row after which a loop is given up; 0 = never. */
struct LoopLimits {
  uint64_t same = 100;        // for a loop that comes back to an earlier state
  uint64_t any = 10'000'000;  // for any loop
  static LoopLimits all(uint64_t passes) { return {passes, passes}; }
};

class LoopWatch {
 public:
  explicit LoopWatch(const LoopLimits& limits, RoundLimits rounds = {}) : limits_(limits), rounds_(std::move(rounds)) {}

  /** Returns a hash of everything that can influence the program (nc_program_state_hash). It is expensive, so it is called in few passes only. */
  using Look = std::function<uint64_t()>;

  /** To be called when the program has read something that may change by itself: the present pass then counts as different from those before. */
  void asked() { ++questions_; }

  /** To be called when a block has ended. @return true when a loop has exceeded its limit; verdict() says which. */
  bool block(const nc_source& source, const Look& look);

  /** To be called when a block that goes on asks the machine how. @return true when it has done so more often than a loop may pass. */
  bool block_goes_on(const nc_source& source, const Look& look);

  /** To be called when the program is given up by the time that it takes. @return true when it is in a loop of the main program, which verdict() says then. */
  bool given_up();
  /** The loop of the verdict has no end by what is written. */
  bool endless_as_written() const { return endless_as_written_; }

  /** The loop that exceeded its limit, such as "line 7: 100 passes of the loop back to line 3 ...". */
  const std::string& verdict() const { return verdict_; }
  /** The same for who may set the limit by an option of ncsim. */
  std::string verdict_and_option() const { return verdict_ + " (--max-passes)"; }

 private:
  struct Loop {
    uint64_t passes = 0;
    uint64_t kept_at = 0, state = 0, questions = 0;  // pass whose state is kept (0 = none yet), that state, and questions_ then
    uint64_t began = 0;                              // blocks_ when it began
  };
  struct Level {
    uint32_t program = 0, file = 0, line = 0, furthest = 0;
    std::map<std::pair<uint32_t, uint32_t>, Loop> loops;  // keyed by the line to which the jump goes and the line from which it comes
  };
  bool enough_rounds(const nc_source& to, uint32_t from, const Loop& loop);
  void say_rounds(const std::pair<uint32_t, uint32_t>& lines, const Loop& loop);
  bool pass(const nc_source& to, uint32_t from, Loop* loop, const Look& look);
  std::string too_often(Loop* loop, const Look& look) const;

  const LoopLimits limits_;
  const RoundLimits rounds_;
  std::vector<Level> levels_;  // one for each level of calls
  Loop in_block_;              // of the block in execution
  uint64_t questions_ = 0, blocks_ = 0;
  bool endless_as_written_ = false;
  std::string verdict_;
};

}  // namespace nc::tools
