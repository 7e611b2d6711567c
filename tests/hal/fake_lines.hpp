// SPDX-License-Identifier: Apache-2.0
// A board with one chip of GPIO lines for tests: lines have names, the chip can be pulled out, and lines may belong to others.
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "hal/gpio/gpio_bus.hpp"

namespace nc::test {

// The state that the test and the thread of a bus share.
struct FakeBoard {
  std::mutex mutex;
  std::condition_variable wake;
  bool present = true;
  std::string trouble;                     // error of reads and writes; empty = none
  bool stuck = false;                      // reads do not return
  std::map<std::string, std::string> owner;  // owners of lines that others have
  std::map<std::string, unsigned> level;   // of each line: 1 = active
  std::vector<hal::gpio::LineSetup> asked;
  std::string consumer;
  unsigned requests = 0, releases = 0, reads = 0, writes = 0;
  std::map<std::string, unsigned> changes;  // number of changes of each output
  struct Edge {
    std::string line;
    bool rising = false;
    std::int64_t time_ns = 0;
  };
  std::vector<Edge> edges;                 // that have not been read yet
  bool debounces = false;

  // A line gets another level, and the kernel notes the edge.
  void turn(const std::string& line, bool to, std::int64_t time_ns) {
    level[line] = to ? 1 : 0;
    edges.push_back({line, to, time_ns});
  }
};

class FakeChip final : public hal::gpio::LineChip {
 public:
  explicit FakeChip(FakeBoard* board) : board_(board) {}
  ~FakeChip() override { release(); }

  hal::gpio::Opening request(const std::string& chip, const std::string& consumer, std::span<const hal::gpio::LineSetup> lines,
                             std::span<const std::uint8_t> values, std::string* error) override {
    using hal::gpio::Opening;
    const std::lock_guard lock(board_->mutex);
    EXPECT_FALSE(held_) << "requested twice";
    EXPECT_EQ(lines.size(), values.size());
    ++board_->requests;
    board_->asked.assign(lines.begin(), lines.end());
    board_->consumer = consumer;
    if (!board_->present) {
      *error = "there is no chip \"" + chip + "\"";
      return Opening::kNoChip;
    }
    for (const auto& line : lines) {
      const auto owner = board_->owner.find(line.text());
      if (owner == board_->owner.end()) continue;
      *error = "line " + line.text() + " is taken by \"" + owner->second + "\"";
      return Opening::kTaken;
    }
    held_ = true;
    put(values);
    return Opening::kOpen;
  }

  bool read(std::vector<std::uint8_t>* values, std::string* error) override {
    std::unique_lock lock(board_->mutex);
    board_->wake.wait(lock, [this] { return !board_->stuck; });
    if (!works(error)) return false;
    ++board_->reads;
    for (std::size_t i = 0; i < board_->asked.size(); ++i)
      if (!board_->asked[i].output) values->at(i) = static_cast<std::uint8_t>(board_->level[board_->asked[i].text()]);
    return true;
  }

  bool edges(std::vector<hal::gpio::LineEdge>* edges, std::string* error) override {
    const std::lock_guard lock(board_->mutex);
    if (!works(error)) return false;
    for (const FakeBoard::Edge& edge : board_->edges)
      for (std::size_t i = 0; i < board_->asked.size(); ++i)
        if (board_->asked[i].text() == edge.line && board_->asked[i].edges) edges->push_back({i, edge.rising, edge.time_ns});
    board_->edges.clear();
    return true;
  }
  bool debounces() const override { return board_->debounces; }

  bool write(std::span<const std::uint8_t> values, std::string* error) override {
    const std::lock_guard lock(board_->mutex);
    if (!works(error)) return false;
    ++board_->writes;
    put(values);
    return true;
  }

  void release() noexcept override {
    const std::lock_guard lock(board_->mutex);
    if (held_) ++board_->releases;
    held_ = false;
  }

 private:
  bool works(std::string* error) const {
    EXPECT_TRUE(held_) << "used without a request";
    *error = board_->present ? board_->trouble : "chip is gone";
    return error->empty();
  }
  void put(std::span<const std::uint8_t> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!board_->asked[i].output) continue;
      unsigned& level = board_->level[board_->asked[i].text()];
      if (level != values[i]) ++board_->changes[board_->asked[i].text()];
      level = values[i];
    }
  }

  FakeBoard* board_;
  bool held_ = false;
};

inline hal::gpio::PointLine gpio_line(unsigned point, const std::string& name, bool output) {
  hal::gpio::PointLine line;
  line.point = point;
  line.line.name = name;
  line.line.output = output;
  return line;
}

}  // namespace nc::test
