// SPDX-License-Identifier: Apache-2.0
// Three-dimensional radius compensation (M700 12.5) in random programs: starts, vectors, changes of amount, side and plane, cancels and starts anew, machine moves, in
// absolute and in incremental words. Where each block ends is compared with a second writing of the section: its place plus the vector.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using Triple = std::array<double, 3>;
constexpr double kAmount[] = {0, 5, 10, -5, 0.35};  // of the numbers D0 to D4

/// What 12.5 says of each block, beside the words that say it.
class Program {
 public:
  explicit Program(uint64_t seed) : random_(seed) {
    add("G17 G90 G94 G1 F1000");
    for (unsigned blocks = 12 + pick(20); blocks > 0; --blocks) add_block();
    text += "M30";
  }

  std::string text;
  std::map<unsigned, Triple> ends;  ///< by line

 private:
  unsigned pick(unsigned n) { return std::uniform_int_distribution<unsigned>(0, n - 1)(random_); }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 1e3) / 1e3; }
  static std::string word(char letter, double value) {
    char words[40];
    std::snprintf(words, sizeof words, " %c%.3f", letter, value);
    return words;
  }
  void add(const std::string& block) {
    text += block + "\n";
    Triple end = place_;
    for (unsigned i = 0; i < 3 && on_ && !away_; ++i) end[i] += vector_[i];
    ends[++line_] = end;
  }
  /// End point words of some axes, at least of `least`.
  std::string move(unsigned least) {
    std::string words;
    unsigned named = 0;
    for (unsigned i = 0; i < 3; ++i) {
      if (pick(2) == 0 && named + (3 - i) > least) continue;
      ++named;
      const double value = number(-60, 60);
      words += word("XYZ"[i], value);
      place_[i] = incremental_ ? place_[i] + value : value;
    }
    away_ = away_ && named == 0;
    return words;
  }
  /// I J K, all three or at least one; those that are missing are 0.
  std::string normal(bool all) {
    std::string words;
    Triple n{};
    for (unsigned i = 0; i < 3; ++i) {
      if (!all && words.empty() ? i < 2 && pick(2) == 0 : !all && pick(2) == 0) continue;
      n[i] = pick(5) == 0 && (n[0] != 0 || n[1] != 0) ? 0 : (pick(2) == 0 ? 1 : -1) * number(0.1, 9);
      words += word("IJK"[i], n[i]);
    }
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), signed_amount = (right_ ? -1 : 1) * kAmount[d_];
    for (unsigned i = 0; i < 3; ++i) vector_[i] = signed_amount * n[i] / size;
    away_ = false;
    return words;
  }
  std::string code() {
    right_ = pick(2) == 0;
    return right_ ? "G42" : "G41";
  }
  std::string amount() {
    d_ = 1 + pick(4);
    return " D" + std::to_string(d_);
  }
  std::string motion() { return pick(3) == 0 ? "G0" : "G1"; }

  void add_block() {
    const unsigned kind = pick(20);
    if (kind == 0) return add("G1" + std::to_string(7 + pick(3)));  // the space stays what it is
    if (kind == 1) {
      incremental_ = !incremental_;
      return add(incremental_ ? "G91" : "G90");
    }
    if (!on_) {
      if (kind < 5) return add(motion() + move(1));
      const std::string start = code(), number = amount();  // the vector goes by both
      on_ = true;
      away_ = false;
      const std::string end = pick(4) == 0 ? "" : move(1);
      return add(motion() + " " + start + end + normal(true) + number);
    }
    if (kind < 6) return add(motion() + move(1));
    if (kind < 10) {
      const std::string end = pick(4) == 0 ? "" : move(1);
      return add(motion() + end + normal(false));
    }
    if (kind < 12) {  // counts from the next I J K on (4), (5)
      std::string block = code();
      if (pick(2) == 0) block += amount();
      return add(motion() + " " + block + (pick(2) == 0 ? "" : move(1)));
    }
    if (kind < 14) {
      const std::string start = code(), number = pick(2) == 0 ? amount() : "";
      const std::string end = pick(4) == 0 ? "" : move(1);
      return add(motion() + " " + start + end + normal(false) + number);
    }
    if (kind < 16 && !incremental_) {  // a machine move: all axes without their vectors until the next movement
      const std::string end = move(1);
      away_ = true;
      return add("G53 G0" + end);
    }
    if (kind == 16) return add("M8");
    on_ = away_ = false;
    const std::string cancel = pick(2) == 0 ? "G40" : "D0";
    return add(motion() + (pick(2) == 0 ? " " + cancel : " " + cancel + move(1)));
  }

  std::mt19937_64 random_;
  Triple place_{}, vector_{};
  bool on_ = false, away_ = false, right_ = false, incremental_ = false;
  unsigned d_ = 1, line_ = 0;
};

TEST(SpaceCompensationRandom, EachBlockEndsBesideItsPlaceByTheVector) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(1500, 100);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    const Program program(seed);
    SCOPED_TRACE(program.text);
    Bench bench;
    for (unsigned d = 1; d < 5; ++d) bench.tool(d, kAmount[d]);
    const Outcome run = bench.run(program.text);
    ASSERT_EQ(run.alarm, "") << "seed " << seed << ", line " << run.alarm_line << ": " << run.alarm_detail;
    unsigned blocks = 0;
    for (const Step& step : run.steps) {
      if (step.item.kind != NC_ITEM_MARK || program.ends.count(step.item.source.line) == 0) continue;
      ++blocks;
      for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(step.machine.v[i], program.ends.at(step.item.source.line)[i], 1e-6) << "seed " << seed << ", line " << step.item.source.line << ", axis " << i;
    }
    EXPECT_EQ(blocks, program.ends.size());
  }
}

}  // namespace
}  // namespace nc::test
