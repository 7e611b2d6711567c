// SPDX-License-Identifier: Apache-2.0
// M700 appendix 2: which G codes may be in one block, and what becomes of each. There is one test for each column of the table, over its rows.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Bench& prepared(Bench& bench) {
  bench.tool(1, 3.0).work_offset(1, {0, 0, 0}).work_offset(2, {100, 0, 0});
  bench.add("O1", "#140=#140+1\nM99\n");
  bench.add("O2", "M99\n");
  return bench;
}

struct Ran {
  Outcome out;
  int16_t code(unsigned group) const { return out.last_modal().code[group]; }
};

Ran run(const std::string& text) {
  Bench bench;
  return {prepared(bench).run(text + "\nM30")};
}

TEST(Precedence, Group1IsUpdatedBesideOneShots) {
  for (const char* block : {"G1 G4 P100", "G1 G10 L2 P1 X0", "G1 G52 X0", "G1 G28 X0", "G1 G92 X0", "G1 G53 X0"}) {
    const Ran r = run(std::string("G0 X1.\n") + block);
    EXPECT_EQ(r.out.alarm, "") << block;
    EXPECT_EQ(r.code(1), 10) << block;
  }
}

TEST(Precedence, CompensationIsIgnored) {  // columns 07 and 08
  for (const char* block : {"G4 P100", "G10 L2 P1 X0", "G52 X0", "G28 X0", "G53 X0"}) {
    const Ran r = run(std::string("G0 X1.\nG41 D1 G43 H1 ") + block);
    EXPECT_EQ(r.out.alarm, "") << block;
    EXPECT_EQ(r.code(7), 400) << block;
    EXPECT_EQ(r.code(8), 490) << block;
  }
  // Not beside these.
  EXPECT_EQ(run("G0 X1.\nG43 H1 G92 X0").code(8), 430);
  EXPECT_EQ(run("G0 X1.\nG43 H1\nG49 G28 Z0").code(8), 490);  // 12.2
}

TEST(Precedence, CyclesAreIgnored) {  // column 09
  for (const char* block : {"G4 P100", "G10 L2 P1 X0", "G52 X0", "G92 X0"}) {
    const Ran r = run(std::string("G0 Z9.\nG81 Z-1. R1. F100 ") + block);
    EXPECT_EQ(r.out.alarm, "") << block;
    EXPECT_EQ(r.code(9), 800) << block;
    EXPECT_EQ(r.out.moves().size(), 1u) << block;
  }
}

TEST(Precedence, MirrorIsIgnoredOnEitherSide) {  // column 19
  for (const char* block : {"G51.1 G4 P100", "G4 G51.1 P100", "G51.1 G10 L2 P1 X0", "G10 G51.1 L2 P1 X0", "G51.1 G52 X0", "G52 G51.1 X0", "G28 G51.1 X0",
                            "G53 G51.1 X0", "G51.1 G53 X0"}) {
    const Ran r = run(std::string("G0 X1.\n") + block);
    EXPECT_EQ(r.out.alarm, "") << block;
    EXPECT_EQ(r.code(19), 501) << block;
  }
  EXPECT_EQ(run("G4 G51.1 P700\nG0 X1.").out.dwells(), (std::vector<double>{0.7}));
}

// Column 9 names the cycles: the code that ends them is none.
TEST(Precedence, TheEndOfACycleActsBesideEachCode) {
  for (const char* beside : {"G28 X5.", "G53 X5.", "G4 P1", "G10 L2 P1 X0", "G92 X5.", "G52 X1.", "G31 X5. F10"}) {
    const Ran r = run(std::string("G81 Z-1. R1. F100\nG80 ") + beside);
    EXPECT_EQ(r.out.alarm, "") << beside;
    EXPECT_EQ(r.code(9), 800) << beside;
  }
  EXPECT_EQ(run("G81 Z-1. R1. F100 G92.1 X0").out.alarm, "P33");  // the table has no row for it, and one of the two would be left out
}

TEST(Precedence, MacroCallsUpdateModalState) {  // rows G65, G66
  Ran r = run("G0 X1.\nG1 G43 H1 G55 G66 P1");
  EXPECT_EQ(r.out.alarm, "");
  EXPECT_EQ(r.code(1), 10);
  EXPECT_EQ(r.code(8), 430);
  EXPECT_EQ(r.code(12), 550);
  r = run("#140=0\nG0 X1.\nG1 G44 H1 G65 P1");
  EXPECT_EQ(r.code(1), 10);
  EXPECT_EQ(r.code(8), 440);
  EXPECT_EQ(r.out.var(140), 1);
  EXPECT_EQ(run("G0 Z9.\nG81 Z-1. R1. F100 G65 P2").code(9), 800);  // the cycle is ignored
}

TEST(Precedence, NothingElseIsDoneBesideG67) {  // column 14: G10, G28, cycles, mirror
  Ran r = run("G66 P1\nG28 X5. G67");
  EXPECT_EQ(r.out.alarm, "");
  EXPECT_EQ(r.out.moves().size(), 0u);
  EXPECT_EQ(r.code(14), 670);
  Bench bench;
  prepared(bench).run("G66 P1\nG10 L2 P1 X7. G67\nM30");
  EXPECT_EQ(bench.work_offset_now(1, 0), 0);
  r = run("G66 P1\nG67 G81 X1. Z-1. R1. F100");
  EXPECT_EQ(r.code(9), 800);
  EXPECT_EQ(run("G66 P1\nG51.1 X1. G67").code(19), 501);
  EXPECT_EQ(run("G66 P1\nG4 P300 G67").out.dwells(), (std::vector<double>{0.3}));
}

TEST(Precedence, AlarmCells) {
  EXPECT_EQ(run("G0 X1.\nG2 G41 D1 X5. R5. F100").out.alarm, "P151");
  EXPECT_EQ(run("G0 X1.\nG2 G43 H1 X5. R5. F100").out.alarm, "P70");
  EXPECT_EQ(run("G0 X1.\nG1 G41 D1 X5. F100\nG18 X9.\nX10.\nX11.\nX12.").out.alarm, "P112");
  EXPECT_EQ(run("G1 G41 D1 X5. F100\nX9.\nG31 X20. F10\nX10.").out.alarm, "P608");
  EXPECT_EQ(run("G1 G41 D1 X5. F100\nX9.\nG81 X20. Z-1. R1.\nX10.").out.alarm, "P155");
  EXPECT_EQ(run("G65 G66 P1").out.alarm, "P33");
  EXPECT_EQ(run("G66 G65 P1").out.alarm, "P33");
}

/// M700 3.7 note 2: a block with two codes of one group is the block with the latter alone, also where the former takes words.
TEST(Precedence, TheLatterCodeOfAGroupCounts) {
  const char* const kTwo[][3] = {
      // former, latter, words
      {"G0", "G1", "X2. F100"}, {"G1", "G0", "X2."}, {"G2", "G1", "X2. R5. F100"}, {"G18", "G17", "X2."}, {"G90", "G91", "X2."}, {"G91", "G90", "X2."},
      {"G20", "G21", "X2."}, {"G21", "G20", "X2."}, {"G94", "G95", "X2. F1."}, {"G42 D1", "G40", "X2."}, {"G43 H1", "G49", "Z2."}, {"G49", "G43 H1", "Z2."},
      {"G81", "G80", "X2."}, {"G82", "G81", "X2. Z-1. R1. F100"}, {"G55", "G54", "X2."}, {"G54", "G55", "X2."}, {"G54.1", "G55", "X2. P7000"},
      {"G61", "G64", "X2."}, {"G68", "G69", "X2. Y1. R90."}, {"G69", "G68", "X2. Y1. R90."}, {"G51", "G50", "X2. Y1. P2."}, {"G50", "G51", "X2. Y1. P2."},
      {"G51.1", "G50.1", "X2."}, {"G50.1", "G51.1", "X2."}, {"G16", "G15", "X2. Y30."}, {"G15", "G16", "X2. Y30."}, {"G96", "G97", "S100 X2."},
      {"G22", "G23", "X50. Y50. Z50. I-50. J-50. K-50."}, {"G23", "G22", "X50. Y50. Z50. I-50. J-50. K-50."},
      {"G67", "G66", "P1"}, {"G67", "G66.1", "P1"}, {"G98", "G99", "X2."}};
  for (const char* before : {"", "G68 X0 Y0 R90.\n", "G51 X0 Y0 P3.\n", "G51.1 Y0\n", "G16\n"})
    for (const auto& [former, latter, words] : kTwo) {
      const std::string first = std::string("G0 X1. Y1.\n") + before, behind = std::string(" ") + words + "\nG0 X70. Y3. Z-7.";
      const std::string text = first + former + " " + latter + behind;
      const Ran both = run(text), one = run(first + latter + behind);
      EXPECT_EQ(both.out.alarm, one.out.alarm) << text;
      EXPECT_EQ(both.out.path(), one.out.path()) << text;
      for (unsigned group = 1; group <= 21; ++group) EXPECT_EQ(both.code(group), one.code(group)) << text << " group " << group;
      EXPECT_TRUE(std::isnan(both.out.var(140)) == std::isnan(one.out.var(140))) << text;
    }
}

TEST(Precedence, TheLatterOfTheModalCallAndItsEndCounts) {  // 3.7 note 2, 13.5.1
  EXPECT_TRUE(std::isnan(run("G66 P2\nG66 P1 G67\nG0 X5.").out.var(140)));
  EXPECT_EQ(run("G66 P1 G67\nG0 X5.").out.alarm, "P276");  // as G67 alone
  EXPECT_EQ(run("#140=0\nG67 G66 P1\nG0 X5.\nG67").out.var(140), 1);
  EXPECT_EQ(run("G67 G65 P1").out.alarm, "P276");
}

/// M700 14.10 (12): the P of a block is used by one code. That of G54.1 is no number of turns of the arc, and no dwell of the cycle, that is in force.
TEST(Precedence, AWordOfACodeIsNotOneOfTheMotionInForce) {
  const auto behind = [](const std::string& first, const std::string& block) {
    Bench bench;
    return bench.param("1181", "1").run("G0 X0 Y0 Z2.\n" + first + "\n" + block + "\nX3.\nM30");
  };
  const auto turns = [&](const std::string& block) { return behind("G2 X5. I2.5 F100", block).moves()[2].turns; };
  EXPECT_EQ(turns("X10. I2.5 P2"), 2u);
  for (const char* code : {"G54.1 P2 ", "G96 S100 P1 "}) EXPECT_EQ(turns(std::string(code) + "X10. I2.5"), 0u) << code;
  const auto dwells = [&](const std::string& block) { return behind("G82 X1. Z-1. R1. P500 F100", block).dwells(); };
  EXPECT_EQ(dwells("X2. P300"), (std::vector<double>{0.5, 0.3, 0.3}));
  for (const char* code : {"G54.1 P7 ", "G96 S100 P1 "}) EXPECT_EQ(dwells(std::string(code) + "X2."), (std::vector<double>{0.5, 0.5, 0.5})) << code;
}

}  // namespace
}  // namespace nc::test
