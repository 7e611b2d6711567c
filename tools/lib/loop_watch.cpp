// SPDX-License-Identifier: Apache-2.0
// See loop_watch.hpp. A loop is a jump back, known by its two lines. Its passes are in a row until the program jumps back to a line before its
// head, which begins it anew (the inner loop of two), or comes to a line behind all that it has reached before: a program that runs on ends.
// A pass in which no variable, offset, parameter and position changes and nothing is asked is followed by one like it, for ever. Only a call that repeats a
// program (L) counts where no variable shows it.
#include "tools/lib/loop_watch.hpp"

#include <utility>

namespace nc::tools {

bool LoopWatch::block(const nc_source& source, const Look& look) {
  levels_.resize(size_t{source.depth} + 1);  // calls below have returned
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
  return pass(source, from, &level.loops[{source.line, from}], look);
}

bool LoopWatch::pass(const nc_source& to, uint32_t from, Loop* loop, const Look& look) {
  const uint64_t same = to.depth == 0 ? limits_.same : limits_.same_called;
  const uint64_t passes = ++loop->passes;
  const auto give_up = [&](const std::string& why) {
    const std::string program = to.program != 0 ? " of O" + std::to_string(to.program) : "";
    verdict_ = "line " + std::to_string(from) + program + ": " + std::to_string(passes) + " passes of the loop back to line " + std::to_string(to.line) +
               why + " (--max-passes)";
    return true;
  };
  if (limits_.any != 0 && passes >= limits_.any) return give_up(" without an end");
  if (same == 0) return false;
  if (passes % same == 0) {
    const bool asked = std::exchange(loop->questions, questions_) != questions_;
    if (!asked && passes > 1 && look() == loop->before) return give_up(", the last one without any change: an endless loop");
  }
  if ((passes + 1) % same == 0) {
    loop->questions = questions_;
    loop->before = look();
  }
  return false;
}

std::vector<std::pair<uint32_t, double>> loop_state(const nc_control* control, unsigned system, const nc_axes& work) {
  constexpr uint32_t kLocals = 33, kCoordinateSystems = 6, kMoreSystems = 100;  // G54.1 Pn is kMoreSystems + n
  std::vector<std::pair<uint32_t, double>> state;
  double value = 0.0;
  bool vacant = false;
  for (uint32_t number = 1; number <= kLocals; ++number)
    if (nc_variable_get(control, system, number, &value, &vacant) == NC_OK && !vacant) state.emplace_back(number, value);
  uint32_t number = 0;
  for (uint32_t from = 0; nc_variable_next(control, system, from, &number, &value) == NC_OK; from = number + 1) state.emplace_back(number, value);
  for (const double axis : work.v) state.emplace_back(0, axis);
  for (unsigned offset = 1, found = 1; found != 0; ++offset) {
    found = 0;
    for (int column = 0; column < 4; ++column) {
      if (nc_tool_offset_get(control, offset, static_cast<nc_tool_column>(column), &value) != NC_OK) continue;
      state.emplace_back(offset, value);
      ++found;
    }
  }
  const auto add_zero = [&](unsigned index) {
    bool any = false;
    for (unsigned axis = 0; axis < NC_MAX_AXES; ++axis) {
      if (nc_work_offset_get(control, system, index, axis, &value) != NC_OK) continue;
      state.emplace_back(index, value);
      any = true;
    }
    return any;
  };
  for (unsigned index = 0; index <= kCoordinateSystems; ++index) add_zero(index);
  for (unsigned index = kMoreSystems + 1; add_zero(index);) ++index;
  char key[24] = "", axis = 0, text[64] = "";
  unsigned place = 0;
  for (unsigned from = 0; nc_parameter_next(control, system, from, &place, key, &axis, &value, text) == NC_OK; from = place + 1)
    state.emplace_back(place, value);  // counters of parts among them
  return state;
}

}  // namespace nc::tools
