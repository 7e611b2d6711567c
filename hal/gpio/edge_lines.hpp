// SPDX-License-Identifier: Apache-2.0
// The inputs of a bank whose edges the kernel notes: their levels from edges, and what was lost. The level of such a line is that of its edges, not the one that
// was read, so that no level is seen without its edge; what is read says the first level, and that edges were lost. No thread and no clock.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/gpio/edge_filter.hpp"
#include "hal/gpio/line_chip.hpp"

namespace nc::hal::gpio {

// A level of a line that counts, with the time at which the line first had it.
struct LineChange {
  std::size_t line = 0;
  bool level = false;
  std::int64_t time_ns = 0;
  bool timed = false;  // false: the kernel has no time for it, and time_ns is that of the poll
  bool lost = false;   // edges before it are missing
};

class EdgeLines {
 public:
  // A line that notes no edges has no entry of meaning. `debounce_ns`: for each line of the request.
  EdgeLines(const std::vector<LineSetup>& setup, std::span<const std::int64_t> debounce_ns);

  bool any() const { return any_; }
  bool known(std::size_t line) const { return line_[line].known; }
  bool level(std::size_t line) const { return line_[line].filter.shown(); }
  // The lines were requested anew: what they have been is of no use.
  void restart();
  // One poll: the levels that were read at `now_ns` and the edges that were read behind them. Appends the changes, those of one line in their order.
  void poll(std::int64_t now_ns, const std::vector<std::uint8_t>& levels, std::span<const LineEdge> edges, std::vector<LineChange>* changes);
  // Number of times at which edges were seen to be missing.
  std::uint64_t losses() const { return losses_; }
  // The kernel gives times of another clock.
  bool other_clock() const { return other_clock_; }

 private:
  struct Line {
    bool edges = false;
    bool known = false;
    bool timed = false;   // the first edge away from the level that counts has a time
    bool differs = false;  // the level that was read did not fit in the poll before
    bool had_edge = false;
    std::int64_t last_ns = 0;  // time of the newest edge
    EdgeFilter filter;
  };

  void take(std::size_t index, bool level, std::int64_t time_ns, bool timed, std::vector<LineChange>* changes);
  void settle(std::size_t index, std::int64_t time_ns, std::vector<LineChange>* changes);
  void compare(std::size_t index, bool read, std::int64_t now_ns, std::vector<LineChange>* changes);
  void lose(std::size_t index, std::int64_t time_ns, std::vector<LineChange>* changes);

  std::vector<Line> line_;
  bool any_ = false, other_clock_ = false;
  std::uint64_t losses_ = 0;
};

}  // namespace nc::hal::gpio
