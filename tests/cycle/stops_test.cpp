// SPDX-License-Identifier: Apache-2.0
// M00 and M01 in the block of a fixed cycle and in its mode (M700 13.1.1 (2)): "output after positioning", and where other families have them.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Moves, M codes, stops of the program ("halt", "optional") and of single block ("stop", and "end" at the end of a block).
Path order(const Outcome& run) {
  Path all;
  size_t next = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) all.push_back(moves[next++]);
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M) all.push_back("M" + brief(item.u.action.value));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_STOP) all.push_back("halt");
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_OPTIONAL_STOP) all.push_back("optional");
    if (item.kind == NC_ITEM_MARK && item.u.mark.stop) all.push_back(item.u.mark.report ? "end" : "stop");
  }
  return all;
}

Path m700(const std::string& text) {
  const Outcome run = Bench().at(0, 0, 10).run("G0 S500\n" + text + "\nM30");
  EXPECT_EQ(run.alarm, "") << text;
  Path all = order(run);
  all.erase(all.begin());  // the end of the first block
  return all;
}

TEST(ProgramStop, ComesOverTheHole) {
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 M00"), (Path{"rapid 5 0 10", "M0", "halt", "rapid 5 0 2", "stop", "line 5 0 -8 F100", "rapid 5 0 10", "end", "M30"}));
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 M01"), (Path{"rapid 5 0 10", "optional", "stop", "rapid 5 0 2", "stop", "line 5 0 -8 F100", "rapid 5 0 10", "end", "M30"}));
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 L0\nX7. M00").at(2), "M0") << "in the mode";
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 L0\nR3. M00"), (Path{"end", "M0", "halt", "rapid 0 0 3", "stop", "line 0 0 -8 F100", "rapid 0 0 10", "end", "M30"})) << "over the hole already";
}

TEST(ProgramStop, ComesOnceForTheHolesOfABlock) {  // precaution (5)
  for (const char* block : {"G91 X5. L3 M00", "G35 X10. Y0 I5. K3 M00"}) {
    const Path all = m700(std::string("G81 Z-8. R2. F100 L0\n") + block);
    EXPECT_EQ(std::count(all.begin(), all.end(), "M0"), 1) << block;
    EXPECT_EQ(all.at(2), "M0") << block << ": behind the first positioning";
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const std::string& step) { return step.rfind("line", 0) == 0; }), 3) << block;
  }
}

TEST(ProgramStop, WithoutAHoleIsThatOfAnyBlock) {
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 L0 M00"), (Path{"M0", "halt", "end", "M30"})) << "the data are recorded";
  EXPECT_EQ(m700("G81 Z-8. R2. F100 L0\nM00"), (Path{"end", "M0", "halt", "end", "M30"})) << "the cycle is ignored";
  EXPECT_EQ(m700("G81 Z-8. R2. F100 L0\nM00 P100 Q2."), (Path{"end", "M0", "halt", "end", "M30"}));
  EXPECT_EQ(m700("X5. M00"), (Path{"rapid 5 0 10", "M0", "halt", "end", "M30"})) << "outside of the mode it comes behind the move";
  EXPECT_EQ(m700("G81 Z-8. R2. F100 L0\nG0 X5. M00").at(2), "M0") << "the block ends the mode";
}

TEST(ProgramStop, OtherCodesOfItsBlockKeepTheirPlaces) {
  EXPECT_EQ(m700("G81 X5. Z-8. R2. F100 M08 M00 M09").at(0), "M8");
  const Path all = m700("G81 X5. Z-8. R2. F100 M08 M00 M09");
  EXPECT_EQ((Path{all.begin(), all.begin() + 6}), (Path{"M8", "M9", "rapid 5 0 10", "M0", "halt", "rapid 5 0 2"}));
  const Path ends = m700("G81 X5. Z-8. R2. F100 M02");
  EXPECT_EQ(ends.back(), "M2") << "the end of the program comes behind the hole";
}

/// RS-274/NGC 3.8: stops come last in their block. HX and Series 8 say nothing of cycles; DGSHAPE 2 wants them alone.
TEST(ProgramStop, OfOtherFamiliesComesBehindTheHole) {
  const auto hx = Bench(NC_DIALECT_HX).at(0, 0, 10).run("G81 X5. Z-8. R2. F100 M00\nM30");
  EXPECT_EQ(hx.alarm, "");
  const auto iso = Bench(NC_DIALECT_ISO).at(0, 0, 10).run("M3 S500\nG81 X5. Z-8. R2. F100 M0\nM30");
  EXPECT_EQ(iso.alarm, "");
  for (const Outcome& run : {hx, iso}) {
    const Path all = order(run);
    const auto stop = std::find(all.begin(), all.end(), "M0");
    ASSERT_NE(stop, all.end());
    EXPECT_EQ(*(stop - 1), "rapid 5 0 10");
  }
  EXPECT_NE(Bench(NC_DIALECT_DGSHAPE).at(0, 0, 10).run("%\nM03\nG81X5000Z-8000R2000F60000M00\nM02").alarm, "");
}

/// 13.12 offline: the signal comes with a stroke of a hole. Type 1 cuts other moves in their middle.
TEST(InterruptInAHole, ComesBehindIt) {
  for (const double level : {2.0, -8.0}) {
    Bench bench;
    bench.add("O1000", "M8\nM99\n");
    bench.at(0, 0, 10).start("G0 S500 M3\nM96 P1000\nG81 X5. Z-8. R2. F100\nX7.\nM30");
    Path all;
    Step step;
    bool done = false;
    while (bench.pull(&step) == NC_OK) {
      if (!done && step.item.kind == NC_ITEM_MOVE && step.machine.v[2] == level) {
        done = true;
        bool take_back = true, ignored = false;
        EXPECT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_OK);
        EXPECT_FALSE(take_back);
        nc_interrupt_signal(bench.control(), 0, false, &ignored);
      }
      if (step.item.kind == NC_ITEM_MOVE) all.push_back(brief(step.machine.v[0]) + " " + brief(step.machine.v[2]));
      if (step.item.kind == NC_ITEM_ACTION && step.item.u.action.kind == NC_ACTION_M) all.push_back("M" + brief(step.item.u.action.value));
    }
    EXPECT_EQ(all, (Path{"M3", "5 10", "5 2", "5 -8", "5 10", "M8", "7 10", "7 2", "7 -8", "7 10", "M30"})) << level;
  }
}

}  // namespace
}  // namespace nc::test
