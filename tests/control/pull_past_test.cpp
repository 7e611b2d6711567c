// SPDX-License-Identifier: Apache-2.0
// nc_pull_past() gives what nc_pull() gives, less the moves and the places inside a block behind them, which it counts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kRapid_mm_min = 10000, kSpindle_rev_min = 500;

/// What a program gives, and what its moves come to.
struct Told {
  std::vector<std::string> given;  ///< "kind serial line", and where the machine stands then
  uint64_t moves = 0;
  double length = 0, seconds = 0;
};

class Pulling {
 public:
  Pulling(nc_dialect dialect, const std::string& text) : bench_(dialect) { bench_.start(text); }

  Told one_by_one() {
    bool behind_move = false;
    nc_item item = NC_INIT(nc_item);
    while (more(nc_pull(bench_.control(), 0, 100, &item))) {
      if (status_ != NC_OK) continue;
      const nc_move& move = item.u.move;
      if (item.kind == NC_ITEM_MOVE) machine_ = move.machine;
      if (item.kind == NC_ITEM_MOVE && move.kind != NC_MOVE_SKIP) {
        count(move);
        behind_move = true;
      } else if (item.kind != NC_ITEM_MARK || item.u.mark.report || !behind_move) {
        give(item);
        behind_move = false;
      }
    }
    return told_;
  }

  Told passing() {
    nc_passed passed = NC_INIT(nc_passed);
    passed.rapid_mm_min = kRapid_mm_min;
    passed.spindle_rev_min = kSpindle_rev_min;
    nc_item item = NC_INIT(nc_item);
    while (more(nc_pull_past(bench_.control(), 0, 100, &passed, &item))) {
      if (passed.moves != told_.moves) machine_ = passed.machine;
      told_.moves = passed.moves;
      if (status_ != NC_OK) continue;
      if (item.kind == NC_ITEM_MOVE) machine_ = item.u.move.machine;
      give(item);
    }
    told_.length = passed.length;
    told_.seconds = passed.seconds;
    return told_;
  }

 private:
  bool more(nc_status status) {
    status_ = status;
    return status == NC_OK || status == NC_BUDGET;
  }
  void count(const nc_move& move) {
    ++told_.moves;
    told_.length += move.length;
    double feed = move.kind == NC_MOVE_RAPID ? kRapid_mm_min : move.feed_mm_min;
    if (move.feed_mm_rev > 0 && move.kind != NC_MOVE_TAP) feed = move.feed_mm_rev * kSpindle_rev_min;
    if (feed > 0) told_.seconds += move.length / feed * 60;
  }
  void give(const nc_item& item) {
    std::string text = std::to_string(item.kind) + ' ' + std::to_string(item.serial) + ' ' + std::to_string(item.source.line) + ':';
    for (unsigned i = 0; i < 3; ++i) text += ' ' + brief(machine_.v[i]);
    told_.given.push_back(text);
    if (item.kind != NC_ITEM_SYNC) return;
    nc_world world = NC_INIT(nc_world);
    world.machine = machine_;
    ASSERT_EQ(nc_answer(bench_.control(), 0, &world), NC_OK);
  }

  Bench bench_;
  nc_status status_ = NC_OK;
  nc_axes machine_{};
  Told told_;
};

void expect_same(nc_dialect dialect, const std::string& text) {
  const Told all = Pulling(dialect, text).one_by_one(), past = Pulling(dialect, text).passing();
  EXPECT_GT(all.moves, 0u) << text << ::testing::PrintToString(all.given);
  EXPECT_EQ(all.given, past.given) << text;
  EXPECT_EQ(all.moves, past.moves) << text;
  EXPECT_EQ(all.length, past.length) << text;
  EXPECT_EQ(all.seconds, past.seconds) << text;
}

TEST(PullPast, CountsWhatPullGives) {
  for (const char* text : {
           "G90 G0 X10. Y5.\nG1 Z-1. F100\nG2 X20. I5. J0\nG95 F0.2\nG1 X0\nM30\n",                             // lines, an arc, a feed per revolution
           "G90 S500 M3\nG81 X1. Y1. Z-3. R1. F100\nX2.\nG83 X3. Z-9. Q2. R1.\nG82 X4. P500\nG80\nM30\n",       // holes
           "G90 G98 G81 X1. Y1. Z-3. R1. F100 L3\nG91 X5. L4\nG80\nM30\n",                                       // several of a block
           "G90 G84 X1. Z-3. R1. F1. S100 ,R1\nX2.\nG84 X3. Z-3. R1. F100 ,R0\nG80\nM30\n",                      // taps
           "G90 G41 D1 G1 X10. Y10. F100\nX20.\nY20.\nX10.\nG40 X0 Y0\nM30\n",                                   // items that a stage has held
           "G90 G31 X10. F100\n#1=#5061\nG1 X#1 Y5. F100\nM30\n",                                                 // a skip move and a value of the machine
           "G91 G28 X0 Y0 Z0\nG4 P500\nT1 M6\nG1 X1. F100\nM30\n",                                                // M codes and a dwell between moves
           "G90 G1 X1. F100\nX2.\nG1 X3. Y\nX4.\nG999\nM30\n",                                                    // an alarm
       })
    expect_same(NC_DIALECT_M700, text);
}

/// A macro interrupt may cut the item that was given last, so each move is given while its signal is on.
TEST(PullPast, PassesNoMoveWhileAnInterruptIsAskedFor) {
  Bench bench;
  bench.add("O1000", "G0 Z7.\nM99\n");
  bench.start("M96 P1000\nG0 X1.\nG91 X2. M8\nG90 Y5.\nN9 Z1.\nM97\nM30");
  nc_passed passed = NC_INIT(nc_passed);
  nc_item item = NC_INIT(nc_item);
  Path given;
  for (nc_status status = NC_OK; status == NC_OK || status == NC_BUDGET;) {
    status = nc_pull_past(bench.control(), 0, 100, &passed, &item);
    if (status != NC_OK) continue;
    const double* const to = item.u.move.machine.v;
    if (item.kind == NC_ITEM_MOVE) given.push_back(brief(to[0]) + ' ' + brief(to[1]) + ' ' + brief(to[2]));
    if (item.kind != NC_ITEM_MARK || item.source.line != 2 || item.source.depth != 0) continue;
    bool take_back = true;
    ASSERT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_OK);
    EXPECT_FALSE(take_back);
  }
  EXPECT_EQ(given, (Path{"1 0 7", "3 0 7", "3 5 7", "3 5 1"}));
  EXPECT_EQ(passed.moves, 1u);
}

/// A block that never ends does not hold its caller.
TEST(PullPast, StopsAtTheMostMovesInARow) {
  Bench bench;
  bench.start("G90 G83 Z-100. R1. Q0.001 F100\nM30\n");
  nc_passed passed = NC_INIT(nc_passed);
  passed.most_in_row = 1000;
  nc_item item = NC_INIT(nc_item);
  nc_status status = NC_OK;
  while (status == NC_OK) status = nc_pull_past(bench.control(), 0, 100, &passed, &item);
  EXPECT_EQ(status, NC_BUDGET);
  EXPECT_EQ(passed.moves_in_row, 1000u);
  EXPECT_EQ(passed.source.line, 1u);
}

TEST(PullPast, TakesStructsOfAnotherVersion) {
  Bench bench;
  bench.start("G90 G1 X3. F100\nM30\n");
  nc_passed passed = NC_INIT(nc_passed);
  nc_item item = NC_INIT(nc_item);
  passed.struct_size = 2;
  EXPECT_EQ(nc_pull_past(bench.control(), 0, 100, &passed, &item), NC_E_ARGUMENT) << "no size";
  passed.struct_size = offsetof(nc_passed, source);
  passed.source.line = 77;
  EXPECT_EQ(nc_pull_past(bench.control(), 0, 100, &passed, &item), NC_OK);
  EXPECT_EQ(passed.moves, 1u);
  EXPECT_EQ(passed.source.line, 77u) << "beyond the size that was given";
  EXPECT_EQ(nc_pull_past(bench.control(), 0, 100, nullptr, &item), NC_E_ARGUMENT);
  EXPECT_EQ(nc_pull_past(bench.control(), 0, 100, &passed, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_pull_past(bench.control(), 1, 100, &passed, &item), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
