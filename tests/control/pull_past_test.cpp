// SPDX-License-Identifier: Apache-2.0
// nc_pull_past() gives what nc_pull() gives, less the moves and the places inside a block behind them, which it counts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"
#include "support/seeds.hpp"

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
  Pulling(nc_dialect dialect, const std::string& text, const std::function<void(nc_config&)>& machine = {}) : bench_(dialect, machine) { bench_.start(text); }

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

void expect_same(nc_dialect dialect, const std::string& text, const std::function<void(nc_config&)>& machine = {}) {
  const Told all = Pulling(dialect, text, machine).one_by_one(), past = Pulling(dialect, text, machine).passing();
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

/// Strokes of holes are counted without items where nothing else is under way (interpret/stroke_counter.hpp): to the last bit as their items would be, also where shifts
/// leave a rounding, the tool has a length, a program is turned or mirrored, or a limit ends it.
TEST(PullPast, CountsHolesAsTheirItems) {
  for (uint64_t seed = 1; seed <= seeds(300, 40); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto any = [&](double low, double high) { return brief(std::uniform_real_distribution<double>(low, high)(random)); };
    const auto one_of = [&](std::initializer_list<const char*> of) { return std::string(of.begin()[random() % of.size()]); };
    std::string text = "G90 G10 L2 P1 X" + any(-9, 9) + " Y" + any(-9, 9) + " Z" + any(-9, 9) + "\nG54 S500 M3\nG0 X0 Y0 Z20.\n";
    if (random() % 3 == 0) text += "G10 L10 P1 R" + any(0, 3) + one_of({"\nG43 H1 Z20.\n", "\nG43 H1\n"});  // the second waits for the next Z
    if (random() % 8 == 0) text += one_of({"G51.1 X0\n", "G51 X0 Y0 Z0 P2.\n", "G95 F0.2\n", "G22 X-90. Y-90. Z-90. I-80. J-80. K-80.\n", "G61.1\n"});
    text += one_of({"G17\n", "G17\n", "G18\n", "G19\n"}) + "G94 F" + any(50, 900) + "\n";
    for (unsigned cycles = 1 + random() % 4; cycles > 0; --cycles) {
      const std::string code = one_of({"G81", "G82", "G83", "G73", "G85", "G86", "G89", "G76", "G87", "G84", "G74"});
      text += one_of({"G90 ", "G90 ", "G91 "}) + one_of({"G98 ", "G99 "}) + code + " X" + any(-9, 9) + " Y" + any(-9, 9) + " Z" + any(-9, -1) + " R" + any(0, 5);
      if (code == "G83" || code == "G73" || code == "G76" || code == "G87") text += " Q" + any(0.3, 2);
      if (random() % 3 == 0) text += " P" + one_of({"100", "0"});
      if (random() % 8 == 0) text += " ,I" + any(0.01, 1) + " ,J" + any(0.01, 1);
      text += '\n';
      for (unsigned holes = random() % 5; holes > 0; --holes) text += one_of({"X", "Y", "Z"}) + any(-9, -1) + (random() % 4 == 0 ? " L3" : "") + '\n';
      if (random() % 3 == 0) text += "G80\nG0 Z20.\nG1 X" + any(-9, 9) + " F200\n";
    }
    const double lowest = -std::uniform_real_distribution<double>(10, 60)(random);
    expect_same(NC_DIALECT_M700, text + "G80\nM30\n", [&](nc_config& c) {
      if (seed % 3 == 0) return;
      for (unsigned i = 0; i < 3; ++i) {
        c.system[0].axis[i].soft_limited = true;
        c.system[0].axis[i].soft_min = lowest;
        c.system[0].axis[i].soft_max = 90;
      }
      if (seed % 3 == 1) return;
      c.system[0].axis_count = 6;  // more than the few for which lines have a form of their own
      for (unsigned i = 3; i < 6; ++i) c.system[0].axis[i].name = "ABC"[i - 3];
    });
  }
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
