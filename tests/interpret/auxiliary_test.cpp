// SPDX-License-Identifier: Apache-2.0
// S, T, B and M (M700 9, 10.1, 10.2, 11.1; DGSHAPE 2), and the stops.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// What goes out and what is waited for, in order: "S1000 M3 fin line stop".
std::string order(const Outcome& run) {
  std::string all;
  for (const Step& step : run.steps) {
    std::string word;
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_ACTION) word = item.u.action.letter + brief(item.u.action.value);
    if (item.kind == NC_ITEM_MOVE) word = "move";
    if (item.kind == NC_ITEM_GATE) {
      static constexpr const char* kNames[] = {"fin", "dwell", "turns", "in-position", "stop", "optional-stop"};
      word = kNames[item.u.gate.kind];
    }
    if (!word.empty()) all += (all.empty() ? "" : " ") + word;
  }
  return all;
}

TEST(Auxiliary, OrderInABlock) {  // S, T, second auxiliary, then M, before the motion
  EXPECT_EQ(order(m700("G0 M3 X1. B5 T2 S1000\nM30")), "S1000 T2 B5 M3 fin move M30 fin");
  EXPECT_EQ(order(m700("G1 X1. M8 M9 F1\nM30")), "M8 fin M9 fin move M30 fin");
}

TEST(Auxiliary, OfFiveCodesTheLastFourCount) {  // M700 9.1
  EXPECT_EQ(m700("M11 M12 M13 M14 M15\nM30").aux(), "M12 M13 M14 M15 M30");
}

TEST(Auxiliary, Ranges) {
  EXPECT_EQ(m700("M99999999 S99999999 T99999999\nM30").aux(), "S99999999 T99999999 M99999999 M30");
  EXPECT_EQ(m700("S-1\nM30").alarm, "P35");
  EXPECT_NE(m700("M123456789\nM30").alarm, "");
}

TEST(Auxiliary, SecondAddress) {  // M700 9.2: not the name of an axis
  EXPECT_EQ(m700("B90\nM30").aux(), "B90 M30");
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZb")).run("A5\nG0 B90.\nM30").aux(), "A5 M30");
  EXPECT_EQ(Bench(NC_DIALECT_M700, axes("XYZab")).run("C5\nM30").aux(), "C5 M30");
  EXPECT_EQ(m700("A5\nM30").alarm, "P130");
}

TEST(Auxiliary, Stops) {  // M700 9.1
  EXPECT_EQ(order(m700("G0 X1. M0\nX2.\nM30")), "move M0 fin stop move M30 fin");
  EXPECT_EQ(order(m700("G0 X1.\nM1\nX2.\nM30")), "move optional-stop move M30 fin");
  EXPECT_EQ(m700("M0\nM30").lines(), (std::vector<unsigned>{1, 2}));
}

TEST(DgshapeAuxiliary, SpindleCodes) {  // DGSHAPE 2-4: R20 series
  auto speed = [](const char* word) { return dgshape(std::string(word) + "\nM02").of(NC_ITEM_ACTION)[0].u.action.value; };
  EXPECT_DOUBLE_EQ(speed("S100"), 100);
  EXPECT_DOUBLE_EQ(speed("S12000"), 12000);
  EXPECT_DOUBLE_EQ(speed("S20"), 10);
  EXPECT_DOUBLE_EQ(speed("S40"), 100);
  EXPECT_DOUBLE_EQ(speed("S60"), 1000);
  EXPECT_DOUBLE_EQ(speed("S80"), 10000);
  EXPECT_DOUBLE_EQ(speed("S01"), 1.12);
  EXPECT_DOUBLE_EQ(speed("S19"), 9);
  EXPECT_DOUBLE_EQ(speed("S98"), 80000);
}

TEST(DgshapeAuxiliary, RepeatedSpindleCodesAreIgnored) {  // DGSHAPE 2-3
  EXPECT_EQ(dgshape("M05\nM03\nM03\nM05\nM05\nM03\nM30").aux(), "M3 M5 M3 M30");
}

TEST(DgshapeAuxiliary, ToolChangeComesAsAPair) {  // DGSHAPE 2-5
  EXPECT_EQ(dgshape("M06T2\nM02").aux(), "T2 M6 M2");
  EXPECT_EQ(dgshape("M06T0\nM02").alarm, "");
  EXPECT_EQ(dgshape("M06\nM02").alarm, "NC-TOOL");
  EXPECT_EQ(dgshape("T2\nM02").alarm, "NC-TOOL");
  EXPECT_EQ(dgshape("M06M06T2\nM02").alarm, "NC-TOOL");
}

TEST(DgshapeAuxiliary, StandAloneCodes) {  // DGSHAPE 2-3
  for (const char* code : {"M00", "M01", "M02", "M30"}) {
    EXPECT_EQ(dgshape(std::string(code) + "G0X1000\nM02").alarm, "NC-ALONE") << code;
    EXPECT_EQ(dgshape("N10" + std::string(code) + "\nM02").alarm, "") << code;
  }
  EXPECT_EQ(dgshape("M03M12\nM02").aux(), "M3 M12 M2");
}

TEST(DgshapeAuxiliary, NoSubPrograms) {
  EXPECT_EQ(dgshape("M98P1\nM02").alarm, "NC-NO-SUCH-CODE");
  EXPECT_EQ(dgshape("M99\nM02").alarm, "NC-NO-SUCH-CODE");
}

}  // namespace
}  // namespace nc::test
