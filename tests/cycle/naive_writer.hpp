// SPDX-License-Identifier: Apache-2.0
// What the tests have in common that write random programs of fixed cycles, and beside each block what its manual makes of it: a program text, the list of what
// the machine is to do, and the comparison with what it does.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {

class NaiveWriter {
 public:
  std::string text;
  Path list;

 protected:
  explicit NaiveWriter(uint64_t seed) : random_(seed) {}

  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }
  bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 1000) / 1000; }
  void line(const std::string& block) { text += (text.empty() ? "" : "\n") + block; }
  /// A word whose number has its point.
  static std::string word(char letter, double value) {
    const std::string digits = brief(value);
    return std::string(" ") + letter + digits + (digits.find('.') == std::string::npos ? "." : "");
  }

  /// A move in machine coordinates; one that leads nowhere is none.
  void go(const std::string& kind, const std::array<double, 3>& to, const std::string& behind = "") {
    bool moves = false;
    for (unsigned i = 0; i < 3; ++i) moves = moves || std::fabs(to[i] - at_[i]) > 1e-9;
    at_ = to;
    if (moves) list.push_back(kind + " " + brief(to[0]) + " " + brief(to[1]) + " " + brief(to[2]) + behind);
  }
  void rapid_z(double z) { go("rapid", {at_[0], at_[1], z}); }
  void feed_z(double z) { go("line", {at_[0], at_[1], z}, " F" + brief(feed_)); }
  void dwell(double seconds) {
    if (seconds > 0) list.push_back("dwell " + brief(seconds));
  }
  void m(int code) { list.push_back("M" + std::to_string(code)); }

  std::array<double, 3> at_{};
  double feed_ = 0;

 private:
  std::mt19937_64 random_;
};

/// What the machine does, in the words of the list.
inline Path cycle_events(const Outcome& run) {
  Path all;
  size_t next_move = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) {
      all.push_back(moves[next_move++]);
      if (item.u.move.kind == NC_MOVE_TAP) all.back() += " lead " + brief(item.u.move.feed_mm_rev);
    }
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_STOP) all.push_back("stop");
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) all.push_back(item.u.action.letter + brief(item.u.action.value));
  }
  return all;
}

/// "" = it does what the list says.
inline std::string compare_with_list(const Outcome& run, const NaiveWriter& writer) {
  const Path made = cycle_events(run);
  size_t same = 0;
  while (same < made.size() && same < writer.list.size() && made[same] == writer.list[same]) ++same;
  if (run.alarm.empty() && same == made.size() && same == writer.list.size()) return "";
  std::string all = run.alarm.empty() ? "" : "alarm " + run.alarm + " (" + run.alarm_detail + ") in line " + std::to_string(run.alarm_line) + "; ";
  all += "step " + std::to_string(same) + " is " + (same < made.size() ? made[same] : "none") + " and not " + (same < writer.list.size() ? writer.list[same] : "none") + "; before it";
  for (size_t n = same < 4 ? 0 : same - 4; n < same; ++n) all += " | " + made[n];
  return all + "\n" + writer.text;
}

template <class Writer>
void compare_programs(Bench& bench, uint64_t usual, unsigned blocks, const std::array<double, 3>& start = {}) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(usual, usual / 8);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    Writer writer(seed);
    writer.write(blocks);
    bench.at(start[0], start[1], start[2]);
    EXPECT_EQ(compare_with_list(bench.run(writer.text), writer), "") << "seed " << seed;
  }
}

}  // namespace nc::test
