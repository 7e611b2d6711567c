// SPDX-License-Identifier: Apache-2.0
// What ends the mode of a fixed cycle (M700 13.1.1 precautions (4), (21), 13.1.2) and what an end leaves: no hole data, and the initial level as the return level.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

const Path kOneHole{"rapid 7 0 10", "rapid 7 0 2", "line 7 0 -8 F100", "rapid 7 0 10"};

Outcome at_ten(const std::string& text) { return Bench().at(0, 0, 10).run("G0 S500 M3\n" + text + "\nM30"); }

/// 13.1.2: "G00, G01, G02, G03, G02.1, G03.1, G33", beside a cycle code in the block, behind it and alone. The data are cleared: a cycle behind it has no bottom.
TEST(CycleMode, EndsWithEveryMotionCode) {
  const struct {
    const char* code;
    const char* words;
  } kRows[] = {{"G00", "X5."},      {"G01", "X5."},           {"G02", "X5. I2.5"},      {"G03", "X5. I2.5"},         {"G02", "X5. R4."}, {"G03", "X5. R4."},
               {"G33", "Z-5. F1."}, {"G02.1", "X60. I100. P2"}, {"G03.1", "X60. I100. P2"}, {"G02.1", "X60. I100. Z5. P2"}};
  for (const auto& row : kRows) {
    const std::string both = std::string(row.code) + " " + row.words;
    for (const std::string& text : {"G81 Z-8. R2. F100 L0\n" + both, "G81 Z-8. R2. F100 L0\n" + std::string(row.code) + "\n" + row.words, "F100\nG81 " + both,
                                    "F100\n" + std::string(row.code) + " G81 " + row.words}) {
      const Outcome run = at_ten(text);
      EXPECT_EQ(run.alarm, "") << text;
      EXPECT_EQ(run.last_modal().code[9], 800) << text;
      EXPECT_EQ(run.moves().size(), 1U) << text << ": the motion, and no hole";
      const Outcome again = at_ten(text + "\nG80 G0 X0 Z10.\nG81 X7. F100");
      EXPECT_EQ(again.alarm, "") << text;
      EXPECT_EQ(again.path().back(), "rapid 7 0 10") << text << ": it only positions, for R and the bottom are forgotten";
    }
  }
}

/// 13.1.2: G98 is the initial state, behind M02, M30 and a reset, also one in a hole.
TEST(CycleMode, EndsWithTheProgramAndAReset) {
  for (const char* end : {"M02", "M30", "reset", "reset in the hole"}) {
    Bench bench;
    bench.at(0, 0, 10);
    const std::string way = end;
    if (way == "M02" || way == "M30") {
      EXPECT_EQ(bench.run("G0 S500 M3\nG99 G81 X5. Z-8. R2. F100\n" + way).alarm, "");
    } else {
      bench.start("G0 S500 M3\nG99 G81 X5. Z-8. R2. F100\nG4 X1.\nX6.\nM30");
      Step step;
      for (bool there = false; !there && bench.pull(&step) == NC_OK;)
        there = way == "reset" ? step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_DWELL_SECONDS : step.item.kind == NC_ITEM_MOVE && step.machine.v[2] < 0;
      ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
    }
    bench.at(0, 0, 10);
    EXPECT_EQ(bench.run("G0\nG81 X7. Z-8. R2. F100\nM30").path(), kOneHole) << way << ": back to the initial level";
    bench.at(0, 0, 10);
    EXPECT_EQ(bench.run("G0\nX7.\nM30").path(), (Path{"rapid 7 0 10"})) << way << ": no hole without a code";
  }
}

TEST(CycleMode, DoesNotEndWithOtherCodes) {
  for (const char* block : {"G90", "G04 X1.", "G98", "G94", "G54", "M08", "G10 L2 P1 X0", "#1=1", "G17", "G28 Z10.", "G09"}) {
    const Outcome run = at_ten(std::string("G81 Z-8. R2. F100 L0\n") + block + "\nX7.");
    EXPECT_EQ(run.alarm, "") << block;
    const Path moves = run.path();
    ASSERT_GE(moves.size(), 4U) << block;
    EXPECT_EQ((Path{moves.end() - 3, moves.end()}), (Path{kOneHole.begin() + 1, kOneHole.end()})) << block << ": and the initial level is that of before";
  }
}

}  // namespace
}  // namespace nc::test
