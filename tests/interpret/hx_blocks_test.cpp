// SPDX-License-Identifier: Apache-2.0
// The hx family: codes that cannot share a block or a mode, calls of which a block has one, and measurements whose values are missing. Each was passed over in
// silence, or refused with a sentence about something else.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome hx(const std::string& text) { return Bench(NC_DIALECT_HX).tool(1, 10, NC_TOOL_RADIUS).run(text + "\nM30"); }

/// X Y Z and a rotary C.
void with_c(nc_config& config) {
  config.system[0].axis_count = 4;
  config.system[0].axis[3] = config.system[0].axis[2];
  config.system[0].axis[3].name = 'C';
  config.system[0].axis[3].rotary = true;
}

TEST(HxBlocks, PositionOffsetsStandBesideMotionsAlone) {  // 13.3
  for (const char* block : {"G45 G31 X30. D1 F100", "G31 G45 X30. D1 F100", "G45 G53 X10. D1", "G53 G45 X10. D1", "G46 G28 X30. D1", "G47 G60 G00 X30. D1",
                            "G60 G48 G00 X30. D1", "G45 G46 X30. D1", "G45 G10 L10 P1 R2."})
    EXPECT_EQ(hx(std::string("G90 ") + block).alarm, "F_82001") << block;
  EXPECT_EQ(hx("G90 G45 G31 X30. D1 F100").alarm_detail, "The word G45 is not possible in this block.");
  EXPECT_EQ(hx("G90 G09 G45 G01 X30. D1 F100").path(), (Path{"line 40 0 0 F100"}));
  EXPECT_EQ(hx("G90 G17 G43 H1 G45 G00 X30. D1").path(), (Path{"rapid 40 0 0"}));
  // Radius and angle are no ways of axes.
  for (const char* code : {"G45", "G46", "G47", "G48"}) EXPECT_EQ(hx(std::string("G90 G16 ") + code + " G01 X30. Y30. D1 F100").alarm, "NC-MODE") << code;
}

TEST(HxBlocks, ACycleStandsBesideNoOtherFunctionThatUsesAxes) {
  for (const char* block : {"G53 G81 X1. Z-1. R1. F100", "G28 G81 X1. Z-1. R1. F100", "G31 G81 X1. Z-1. R1. F100", "G92 G81 X1. Z-1. R1. F100", "G81 G52 X1. Z-1. R1. F100"}) {
    const Outcome run = hx(block);
    EXPECT_EQ(run.alarm, "F_82001") << block;
    EXPECT_TRUE(run.moves().empty()) << block;
  }
  EXPECT_EQ(hx("G60 G81 X1. Z-1. R1. F100").alarm, "");
  EXPECT_EQ(hx("G80 G53 X1.").alarm, "");
}

// The end of a cycle takes no words: it acts, and so does what stands beside it.
TEST(HxBlocks, ACycleEndsBesideEachFunction) {
  EXPECT_EQ(hx("G80 G68 X0 Y0 R90.\nG00 X10. Y0").path().back(), "rapid 0 10 0");
  EXPECT_EQ(hx("G80 G51 X0 Y0 P2000\nG00 X10.").path().back(), "rapid 20 0 0");
  for (const char* code : {"G28 X0", "G53 X5.", "G04 P5", "G92 X5."}) {
    const Outcome run = hx(std::string("G81 Z-5. R1. F100\nG80 ") + code + "\nG91 X1.");
    EXPECT_EQ(run.alarm, "") << code;
    EXPECT_EQ(run.last_modal().code[10], 800) << code;
  }
  EXPECT_EQ(hx("G80 G53 X5. I2.").alarm, "F_82001");
}

TEST(HxBlocks, ACycleAndAFunctionWithWordsExcludeEachOther) {
  for (const char* code : {"G107 C20.", "G112", "G113", "G22", "G39"})
    EXPECT_EQ(Bench(NC_DIALECT_HX, with_c).run(std::string(code) + " G81 X1. Z-1. R1. F100\nM30").alarm, "F_82001") << code;
  for (const char* beside : {"G28 X5.", "G81 X1. Z-1. R1. F100"}) EXPECT_EQ(hx(std::string("G66 P1\nG67 ") + beside + "\nM30\nO1\nM99").alarm, "F_82001") << beside;
}

// Passed over, it would be missing in what follows.
TEST(HxBlocks, CompensationIsNotPassedOver) {
  for (const char* block : {"G41 D1 G28 X5.", "G42 D1 G53 X5.", "G43 H1 G53 Z5.", "G44 H1 G28 Z5.", "G41 D1 G52 X5."}) EXPECT_EQ(hx(block).alarm, "F_82001") << block;
  EXPECT_EQ(hx("G28 G40 G80 G49 Z5.").alarm, "");
  EXPECT_EQ(hx("G43 H1 G00 Z5.\nG53 G49 Z20.\nG00 Z7.").path().back(), "rapid 0 0 7");
}

TEST(HxBlocks, SingleDirectionIsNoCut) {  // 4.2
  EXPECT_EQ(hx("G60 G01 X10. F100").alarm, "F_82001");
  EXPECT_EQ(hx("G60 G00 X10.").alarm, "");
  EXPECT_EQ(hx("G01 X1. F100\nG60 X10.").alarm, "");
}

TEST(HxBlocks, ACommentHasAnEnd) {
  const Outcome run = hx("G00 X1. (open Y2.");
  EXPECT_EQ(run.alarm, "F_82004");
  EXPECT_EQ(run.alarm_detail, "A comment that begins with '(' has no ')' in its line.");
  EXPECT_EQ(hx("(a) G00 X1. (b) (c)").alarm, "");
}

TEST(HxBlocks, HaveOneWordThatCallsBehindThem) {  // 14.1.5, 14.1.6
  const auto run = [](const std::string& block) {
    Bench b(NC_DIALECT_HX);
    b.param("3095", "6").param("3096", "7").param("3105", "1");
    b.add("O9000.nc", "O9000\n#500=#500+1\nM99\n");
    b.add("O9020.nc", "O9020\n#500=#500+10\nM99\n");
    b.add("O9021.nc", "O9021\n#500=#500+100\nM99\n");
    const Outcome out = b.run("#500=0\n" + block + "\n#101=#500\nM30");
    return out.alarm.empty() ? std::to_string(std::lround(out.var(101))) : out.alarm + " " + out.alarm_detail;
  };
  EXPECT_EQ(run("T5"), "1");
  EXPECT_EQ(run("X1. M6"), "10");
  EXPECT_EQ(run("M6 T5"), "10") << "behind the code that begins its block T is an argument (14.1.4)";
  EXPECT_EQ(run("T5 M6"), "F_82001 The word M06 is not possible in this block.");
  EXPECT_EQ(run("X1. M6 T7"), "F_82001 The word T7 is not possible in this block.");
  EXPECT_EQ(run("X1. M6 M7"), "F_82001 The word M07 is not possible in this block.");
  EXPECT_EQ(run("T5 M8"), "1") << "M8 calls nothing";
  for (const char* block : {"M98 P30 T5", "T5 M98 P30", "X5. M98 P30 L2 T5", "M30 T5", "M02 T5"}) EXPECT_EQ(run(block), "F_82001 The word T5 is not possible in this block.") << block;
  EXPECT_EQ(run("M98 P30 M6"), "F_82001 The word M06 is not possible in this block.");
  EXPECT_EQ(run("M99 T5"), "F_82001 The word T5 is not possible in this block.") << "of a sub program it would return without the call";
  // Arguments of the M code that begins the block are no way on: the return, or the end, would be lost.
  for (const char* block : {"M6 M99", "M6 M30", "M6 X1. M2", "M6 M98"}) EXPECT_EQ(run(block), "F_82001 The word M06 is not possible in this block.") << block;
}

TEST(HxBlocks, ACodeThatCallsIsNotLostInASubProgram) {  // 14.1.5, 14.1.6: PI 105 = 0, PI 106 = 1, PI 95 = 50
  for (const char* back : {"M99 T5", "T5 M99", "X5. T5 M99", "M06 T5 M99", "M99 M50", "M50 M99", "X5. M50 M99", "M99 P2 T5"})
    for (const char* call : {"M98 P31", "G65 P31"}) {
      Bench b(NC_DIALECT_HX);
      b.param("3106", "1").param("3095", "50").add("O31.nc", std::string("O31\nG04 P31\n") + back);
      b.add("O9000.nc", "O9000\nM99\n"), b.add("O9020.nc", "O9020\nM99\n");
      const Outcome run = b.run(std::string(call) + "\nN2\nM30");
      EXPECT_EQ(run.alarm, "F_82001") << back;
      EXPECT_EQ(run.alarm_line, 3u) << back;
      EXPECT_TRUE(run.moves().empty()) << back;
    }
}

TEST(HxBlocks, TheEndOfAModalCallMayStandWhereThereIsNone) {  // 3.2: G67 is in force at power on
  EXPECT_EQ(hx("G17 G40 G49 G67 G80\nG00 X1.").alarm, "");
  const Outcome run = hx("G67 G00 X1.\nG66 P1\nX2.\nG67\nG67 X3.\nM30\nO1\nM99");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0"}));
}

TEST(HxBlocks, ThePlaneStaysUntilAMoveBehindTheEndOfCompensation) {  // as M700 App. 1 P112
  const Outcome run = hx("G10 L12 P1 R2.\nG01 G41 D1 X10. F100\nX20.\nG40\nG18\nM30");
  EXPECT_EQ(run.alarm_line, 5u);
  EXPECT_EQ(run.alarm_detail, "The plane cannot be changed while tool radius compensation is on, nor behind G40 before the tool has moved.");
  EXPECT_EQ(hx("G10 L12 P1 R2.\nG01 G41 D1 X10. F100\nX20.\nG40 X30.\nG18\nM30").alarm, "");
}

TEST(HxBlocks, AToolThatCallsIsWithinItsRange) {  // 10.1.1
  for (const char* block : {"T-5", "X5. T-5", "T100000000"}) {
    Bench b(NC_DIALECT_HX);
    b.param("3106", "1").add("O9000.nc", "O9000\n#500=1\nM99\n");
    const Outcome run = b.run(std::string("#500=0\n") + block + "\n#101=#500\nM30");
    EXPECT_EQ(run.alarm, "F_82002") << block;
    EXPECT_EQ(run.alarm_line, 2u) << block;
  }
}

TEST(HxBlocks, PassesOfTheMainProgramAreNoWordOfASubProgram) {  // 2.4.4 has L beside M99 of a main program alone
  for (const char* call : {"M98 P31", "G65 P31", "M98 P31 L2"})
    for (const char* back : {"M99 L1", "M99 L0", "M99 P2 L3", "X7. M99 L2"}) {
      Bench b(NC_DIALECT_HX);
      b.add("O31.nc", std::string("O31\nX1.\n") + back + "\n");
      const Outcome run = b.run(std::string(call) + "\nN2\nM30");
      EXPECT_EQ(run.alarm, "F_82001") << back;
      EXPECT_EQ(run.alarm_line, 3u) << back;
      EXPECT_EQ(run.path().front(), "rapid 1 0 0") << back;
      EXPECT_LE(run.path().size(), 2u) << back;
    }
}

TEST(HxBlocks, CodesThatKeepTheirMeaningCallNothing) {  // 14.1.3 (2), 14.1.4 (3)
  for (const char* write : {"#3085=65", "#3086=66", "#3094=67", "#3085=256", "#3095=2", "#3096=30", "#3104=98"}) EXPECT_EQ(hx(write).alarm, "F_82002") << write;
  for (const char* write : {"#3085=64", "#3085=68", "#3095=3", "#3095=0"}) EXPECT_EQ(hx(write).alarm, "") << write;
}

TEST(HxBlocks, ThePlaneInForceMayBeNamedInARotation) {  // 15.4, PI 150
  Bench bench(NC_DIALECT_HX);
  bench.param("3150", "1").param("3117", "90");
  const Outcome run = bench.run("G90 G17 G40 G80\nG00 X10. Y0\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 0 10 0"}));
  EXPECT_EQ(bench.run("G90 G18\nM30").alarm, "NC-PLANE");
  EXPECT_EQ(hx("G68 X0 Y0 R90.\nG17 X1. Y0").alarm, "");
  EXPECT_EQ(hx("G68 X0 Y0 R90.\nG19 X1. Y0").alarm, "NC-PLANE");
}

TEST(HxBlocks, ALineThatLeadsNowhereNeedsNoFeed) {  // the program of 4.7
  const Outcome run = Bench(NC_DIALECT_HX, with_c)
                          .run("G54 G00 G90 Z100.0 C0\nG01 G91 G18 Z0 C0\nG107 C57.299\nG90 G01 Z120. F250\nC30.\nG02 Z90. C60. R30.\nG01 Z70.\nG03 Z60. C70. R10.\n"
                              "G01 C150.\nG03 Z70. C190. R75.\nG01 Z110. C230.\nG02 Z120. C270. R75.\nG01 C360.\nZ100.\nG107 C0\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(hx("G90 G01 X0 Y0").alarm, "");
  EXPECT_EQ(hx("G90 G01 X0 Y1.").alarm, "F_84020");
  EXPECT_EQ(hx("G90 G02 X0 Y0 I1.").alarm, "F_84020");
}

TEST(HxBlocks, AMeasurementNeedsItsParameters) {  // 4.10
  const auto measure = [](const char* deceleration, const char* range, const char* feed, const std::string& text) {
    Bench b(NC_DIALECT_HX);
    b.param("3141", deceleration).param("3142", range).param("3143", feed).tool(1, 10);
    const Outcome run = b.run(text + "\nM30");
    EXPECT_TRUE(run.alarm.empty() || run.moves().size() <= 1) << "nothing moves towards the sensor";
    return run.alarm + " " + run.alarm_detail;
  };
  const std::string distances = "F_82002 The way to the measuring position must be longer than #3141 (measuring feed), and #3141 longer than #3142 (range).";
  EXPECT_EQ(measure("2", "5", "50", "G43 H1 Z0\nG37 Z-38."), distances);
  EXPECT_EQ(measure("0", "5", "50", "G43 H1 Z0\nG37 Z-38."), distances);
  EXPECT_EQ(measure("0", "0", "50", "G43 H1 Z0\nG37 Z-38."), distances);
  EXPECT_EQ(measure("10", "5", "50", "G43 H1 Z0\nG37 Z-8."), distances);
  EXPECT_EQ(measure("10", "5", "0", "G43 H1 Z0\nG37 Z-38."), "F_82002 The measuring feed, #3143, has no value.");
  // The sensor stands at a place of the machine, which no scale and no rotation moves.
  EXPECT_EQ(measure("10", "5", "50", "G43 H1 Z0\nG51 X0 Y0 Z0 P2000\nG37 Z-38.").substr(0, 7), "NC-MODE");
  EXPECT_EQ(measure("10", "5", "50", "G43 H1 Z0\nG68 X0 Y0 R30.\nG37 Z-38.").substr(0, 7), "NC-MODE");
}

TEST(HxBlocks, CodesOfTheCylinderAndOfPolarCoordinatesStandAlone) {  // 4.6, 4.7
  const auto said = [](const std::string& text) {
    const Outcome run = Bench(NC_DIALECT_HX, with_c).tool(1, 1, NC_TOOL_RADIUS).run(text + "\nM30");
    return run.alarm + " " + run.alarm_detail;
  };
  EXPECT_EQ(said("G18 G107 C20."), "F_82004 G107 must stand in a block of its own.");
  EXPECT_EQ(said("X10.\nG17 G112"), "F_82004 G112 must stand in a block of its own.");
  EXPECT_EQ(said("X10.\nG112\nG41 D1 G01 X5. F100\nG113"),
            "F_82204 G113 does not end polar coordinate interpolation in radius compensation. Cancel it with G40 first.");
}

}  // namespace
}  // namespace nc::test
