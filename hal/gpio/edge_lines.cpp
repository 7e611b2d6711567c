// SPDX-License-Identifier: Apache-2.0
// The inputs of a bank whose edges the kernel notes. See edge_lines.hpp.
#include "hal/gpio/edge_lines.hpp"

#include <algorithm>
#include <cstdlib>

namespace nc::hal::gpio {
namespace {

constexpr std::int64_t kSameClockNs = 10'000'000'000;  // farther from the time of the poll no edge of the same clock can be

}  // namespace

EdgeLines::EdgeLines(const std::vector<LineSetup>& setup, std::span<const std::int64_t> debounce_ns) : line_(setup.size()) {
  for (std::size_t i = 0; i < setup.size(); ++i) {
    line_[i].edges = setup[i].edges;
    line_[i].filter = EdgeFilter(debounce_ns[i]);
    any_ |= setup[i].edges;
  }
}

void EdgeLines::restart() {
  for (Line& line : line_) {
    line.known = line.differs = false;
    line.last_ns = 0;
  }
}

void EdgeLines::poll(std::int64_t now_ns, const std::vector<std::uint8_t>& levels, std::span<const LineEdge> edges, std::vector<LineChange>* changes) {
  for (std::size_t i = 0; i < line_.size(); ++i) {
    line_[i].had_edge = false;
    if (!line_[i].edges || line_[i].known) continue;
    line_[i].filter.begin(levels[i] != 0, now_ns);
  }
  for (const LineEdge& edge : edges) {
    const bool timed = std::abs(edge.time_ns - now_ns) < kSameClockNs;
    other_clock_ |= !timed;
    line_[edge.line].had_edge = true;
    if (line_[edge.line].known) take(edge.line, edge.rising, timed ? edge.time_ns : now_ns, timed, changes);
    else line_[edge.line].filter.begin(edge.rising, now_ns);  // amid the first poll, whose level may be from before or behind it
  }
  for (std::size_t i = 0; i < line_.size(); ++i) {
    if (!line_[i].edges) continue;
    if (line_[i].known) compare(i, levels[i] != 0, now_ns, changes);
    line_[i].known = true;
    settle(i, now_ns, changes);
  }
}

// The edges of a line come in their order. One whose time is before that of the edge before it has none: it would be put before that one.
void EdgeLines::take(std::size_t index, bool level, std::int64_t time_ns, bool timed, std::vector<LineChange>* changes) {
  Line& line = line_[index];
  timed &= time_ns >= line.last_ns;
  time_ns = line.last_ns = std::max(line.last_ns, time_ns);
  settle(index, time_ns, changes);
  if (line.filter.raw() == line.filter.shown()) line.timed = timed;
  if (!line.filter.edge(level, time_ns)) lose(index, time_ns, changes);
  settle(index, time_ns, changes);
}

void EdgeLines::settle(std::size_t index, std::int64_t time_ns, std::vector<LineChange>* changes) {
  EdgeFilter::Change change;
  if (line_[index].filter.settle(time_ns, &change)) changes->push_back({index, change.level, change.time_ns, line_[index].timed, false});
}

// An edge that comes between the reading of the levels and that of the edges makes them differ once. Without an edge in between a second difference says that
// one was lost.
void EdgeLines::compare(std::size_t index, bool read, std::int64_t now_ns, std::vector<LineChange>* changes) {
  Line& line = line_[index];
  const bool differs = read != line.filter.raw() && !line.had_edge;
  if (differs && line.differs) {
    lose(index, now_ns, changes);
    take(index, read, now_ns, false, changes);
    line.differs = false;
    return;
  }
  line.differs = differs;
}

void EdgeLines::lose(std::size_t index, std::int64_t time_ns, std::vector<LineChange>* changes) {
  ++losses_;
  changes->push_back({index, line_[index].filter.shown(), time_ns, false, true});
}

}  // namespace nc::hal::gpio
