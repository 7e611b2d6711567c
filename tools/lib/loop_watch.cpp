// SPDX-License-Identifier: Apache-2.0
// See loop_watch.hpp. A loop is a jump back, identified by its two lines. Its passes are counted until the program jumps back to a line before the
// head of the loop, which begins the loop anew (this is the inner one of two loops), or reaches a line beyond all lines that it has reached before,
// because a program that goes forward comes to its end.
//
// When a state of the program occurs again, everything that followed it the first time follows again, for ever, unless the program reads something from
// outside. So the state after pass 99 is kept and compared with the next two, which finds a loop whose state no longer changes or alternates. The loop may
// come to that only later, or repeat only after more passes: so the state after pass 199 is compared with the next 4, that after pass 399 with the next 8,
// and so on. The state is needed so rarely that even the longest loop does not become slower, nor an inner loop, whose passes are counted anew again and
// again.
//
// A loop that counts comes to new states for ever. Where its text has no end it is given up after some rounds, or when the time of the whole program is over.
#include "tools/lib/loop_watch.hpp"

#include <algorithm>
#include <utility>

namespace nc::tools {
namespace {

constexpr uint64_t kLongestPeriod = 16;  // a loop is found when it repeats a state within at most this number of passes

std::string program_of(const nc_source& source) { return source.program != 0 ? " of O" + std::to_string(source.program) : ""; }

}  // namespace

bool LoopWatch::block(const nc_source& source, const Look& look) {
  in_block_ = {};
  ++blocks_;
  levels_.resize(size_t{source.depth} + 1);  // removes the levels of calls that have returned
  Level& level = levels_.back();
  if (level.program != source.program || level.file != source.file) {
    level = {};
    level.program = source.program;
    level.file = source.file;
  }
  const uint32_t from = std::exchange(level.line, source.line);
  if (from == 0 || source.line > from) {
    if (source.line > level.furthest) {
      level.furthest = source.line;
      level.loops.clear();
    }
    return false;
  }
  level.loops.erase(level.loops.upper_bound({source.line, UINT32_MAX}), level.loops.end());
  Loop& loop = level.loops[{source.line, from}];
  if (loop.passes == 0) loop.began = blocks_;
  return pass(source, from, &loop, look) || (source.depth == 0 && enough_rounds(source, from, loop));
}

bool LoopWatch::pass(const nc_source& to, uint32_t from, Loop* loop, const Look& look) {
  const std::string why = too_often(loop, look);
  if (why.empty()) return false;
  verdict_ = "line " + std::to_string(from) + program_of(to) + ": " + std::to_string(loop->passes) + " passes of the loop back to line " +
             std::to_string(to.line) + why;
  return true;
}

bool LoopWatch::enough_rounds(const nc_source& to, uint32_t from, const Loop& loop) {
  const bool enough = loop.passes == rounds_.rounds || (loop.passes >= rounds_.few && loop.passes < rounds_.rounds && blocks_ - loop.began >= rounds_.blocks);
  if (!enough || !rounds_.never_ends || !rounds_.never_ends(to, from)) return false;
  endless_as_written_ = true;
  say_rounds({to.line, from}, loop);
  return true;
}

void LoopWatch::say_rounds(const std::pair<uint32_t, uint32_t>& lines, const Loop& loop) {
  verdict_ = "line " + std::to_string(lines.second) + ": " + std::to_string(loop.passes) + " rounds of the loop back to line " + std::to_string(lines.first);
}

bool LoopWatch::given_up() {
  if (levels_.empty()) return false;
  const Level& main = levels_.front();
  for (const auto& [lines, loop] : main.loops) {
    if (loop.passes < rounds_.few) continue;
    nc_source to{};
    to.file = main.file, to.program = main.program, to.line = lines.first;
    const bool never_ends = rounds_.never_ends && rounds_.never_ends(to, lines.second);
    if (verdict_.empty() || (never_ends && !endless_as_written_)) say_rounds(lines, loop);
    endless_as_written_ |= never_ends;
  }
  return !verdict_.empty();
}

bool LoopWatch::block_goes_on(const nc_source& source, const Look& look) {
  const std::string why = too_often(&in_block_, look);
  if (why.empty()) return false;
  verdict_ = "line " + std::to_string(source.line) + program_of(source) + ": " + std::to_string(in_block_.passes) + " passes within this block" + why;
  return true;
}

std::string LoopWatch::too_often(Loop* loop, const Look& look) const {
  const uint64_t passes = ++loop->passes;
  if (limits_.any != 0 && passes >= limits_.any) return " without an end";
  if (limits_.same == 0 || passes + 1 < limits_.same) return {};
  const uint64_t since = passes - loop->kept_at;
  if (loop->kept_at == 0 || passes + 1 == 2 * (loop->kept_at + 1)) {
    *loop = {passes, passes, look(), questions_, loop->began};
  } else if (since <= std::min(kLongestPeriod, 2 * (loop->kept_at + 1) / limits_.same) && loop->questions == questions_ && look() == loop->state) {
    const std::string last = since == 1 ? ", the last one without any change" : ", the last " + std::to_string(since) + " of them back to where they began";
    return last + ": an endless loop";
  }
  return {};
}

}  // namespace nc::tools
