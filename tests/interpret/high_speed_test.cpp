// SPDX-License-Identifier: Apache-2.0
// High-accuracy control and the modes for fine segments: their codes and states, and what may be commanded in them (M700 13.15 to 13.17).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// The alarm of `text`, which is run from zero with #1267 bit 0 on.
std::string alarm_of(const std::string& text, const char* parameter = nullptr, const char* value = "1") {
  Bench bench;
  bench.param("1267/bit0", "1").tool(1, 2);
  bench.add("O1", "M99\n");
  if (parameter != nullptr) bench.param(parameter, value);
  return bench.run(text + "\nM30").alarm;
}

int16_t cutting_code(Bench& bench, const std::string& text) { return bench.run(text).last_modal().code[13]; }

TEST(HighAccuracy, IsACodeOfGroup13) {  // M700 13.15
  Bench bench;
  EXPECT_EQ(cutting_code(bench, "G61.1 F500"), 611);
  for (const char* off : {"G61", "G64"}) EXPECT_NE(cutting_code(bench, std::string("G61.1\n") + off), 611) << off;
  EXPECT_EQ(cutting_code(bench, "G61.1\nG8 P1"), 640);
  EXPECT_EQ(cutting_code(bench, "G61\nG8 P1.7\nG8 P0"), 640);  // decimals are ignored; G61 does not come back
  EXPECT_EQ(bench.run("G61\nG8 P1\n#100=#4013\nG8 P0\n#101=#4013\nG61.1\n#102=#4013\nM30").alarm, "");
  bench.param("1267/bit0", "1");
  EXPECT_EQ(bench.run("G61.1\nM30").alarm, "P34");  // precaution (3)
}

TEST(HighAccuracy, IsOnAfterResetWhereTheParameterSaysSo) {  // M700 13.15 (4)
  Bench bench;
  bench.param("1148", "1");
  EXPECT_EQ(cutting_code(bench, "G1 X1. F9"), 611);
  EXPECT_EQ(cutting_code(bench, "G64\nG1 X1. F9"), 640);
}

TEST(HighAccuracy, CommandStandsAloneAndHasItsStates) {  // M700 13.15
  EXPECT_EQ(alarm_of("G8"), "P33");
  EXPECT_EQ(alarm_of("G8 P2"), "P35");
  EXPECT_EQ(alarm_of("G8 P1 X1."), "P33");
  EXPECT_EQ(alarm_of("G8 P1 G90"), "P33");
  EXPECT_EQ(alarm_of("G8 P1 M8"), "P33");
  EXPECT_EQ(alarm_of("N5 G8 P1\nG1 X5. F100\nG8 P0"), "");
  EXPECT_EQ(alarm_of("G8 P1\nG61"), "P126");
  EXPECT_EQ(alarm_of("G8 P1\nG64\nG8 P0\nG61"), "");
  EXPECT_EQ(alarm_of("G43 H1 Z5.\nG8 P1"), "P62");
  for (const char* before : {"G5 P1", "G5 P2", "G5 P10000", "G5.1 Q1", "G8 P1", "G16", "G0 G41 D1 X9.", "G0 G43 H1 Z5.", "G51.1 X0", "M96 P1"})
    EXPECT_EQ(alarm_of(std::string(before) + "\nG8 P1"), "P34") << before;
}

TEST(HighAccuracy, MillingModesExcludeIt) {  // M700 13.15 (2), (3)
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1516", "C").param("1030", "C");
  EXPECT_EQ(bench.run("G12.1\nG61.1\nM30").alarm, "P481");
  EXPECT_EQ(bench.run("G12.1\nG8 P1\nM30").alarm, "P481");
  EXPECT_EQ(bench.run("G61.1\nG12.1\nM30").alarm, "P29");
  EXPECT_EQ(bench.run("G8 P1\nG7.1 C10.\nM30").alarm, "P29");
}

TEST(HighSpeed, WordsOfG05) {  // M700 13.16, 13.17.1
  EXPECT_EQ(alarm_of("G5 P1\nG1 X0.1 F100\nG5 P2\nX0.2\nG5 P0"), "");
  EXPECT_EQ(alarm_of("G5"), "P33");
  EXPECT_EQ(alarm_of("G5 P1."), "P33");
  EXPECT_EQ(alarm_of("G5 P4"), "P35");
  EXPECT_EQ(alarm_of("G5 P3"), "P65");
  EXPECT_EQ(alarm_of("G5 P1 X1."), "P35");
  EXPECT_EQ(alarm_of("G5 P0 X1."), "P35");
  EXPECT_EQ(alarm_of("G5 P10000 X1."), "P33");
  EXPECT_EQ(alarm_of("G5 P10000\nG5 P0 X1."), "P33");
  EXPECT_EQ(alarm_of("G5 P10000 M8"), "P33");
  EXPECT_EQ(alarm_of("N1 G5 P10000\nN2 G5 P0"), "");
}

TEST(HighSpeed, OneModeAtATime) {  // M700 13.17.1 precautions (10), (11)
  EXPECT_EQ(alarm_of("G5.1 Q1\nG5 P10000"), "P34");
  EXPECT_EQ(alarm_of("G5 P10000\nG5.1 Q1"), "P34");
  EXPECT_EQ(alarm_of("G5 P10000\nG5 P1"), "P34");
  EXPECT_EQ(alarm_of("G5 P1\nG5.1 Q1\nG5.1 Q0\nG5 P2\nG5 P10000\nG5 P0\nG5.1 Q1\nG5.1 Q0"), "");
  EXPECT_EQ(alarm_of("G5.1"), "P33");
  EXPECT_EQ(alarm_of("G5.1 Q1."), "P33");
  EXPECT_EQ(alarm_of("G5.1 Q3"), "P35");
  EXPECT_EQ(alarm_of("G5.1 Q1 X0"), "P33");
  EXPECT_EQ(alarm_of("G5 P10000", "1267/bit0", "0"), "P34");
  EXPECT_EQ(alarm_of("G5.1 Q1", "1267/bit0", "0"), "P34");
}

TEST(HighSpeed, StatesItStartsFrom) {  // M700 13.17.1 "relation with other functions" (1), 13.17.2 (1)
  for (const char* before : {"G0 G41 D1 X9.", "G51.1 X0", "G16", "G81 Z-1. R1. F9", "M96 P1"}) {
    EXPECT_EQ(alarm_of(std::string(before) + "\nG5.1 Q1"), "P34") << before;
    EXPECT_EQ(alarm_of(std::string(before) + "\nG5 P10000"), "P34") << before;
  }
  EXPECT_EQ(alarm_of("G0 G43 Z9. H1\nG5.1 Q1"), "P34");
  EXPECT_EQ(alarm_of("G0 G43 Z9. H1\nG5 P10000"), "");  // G49 is asked for by mode I alone
  EXPECT_EQ(alarm_of("G61\nG5.1 Q1"), "");
  EXPECT_EQ(alarm_of("G61\nG5 P10000"), "P34");
}

TEST(HighSpeed, RadiusCompensationEndsInside) {  // M700 13.17.1 (5)
  const std::string on = "G41 G1 X10. Y10. D1 F1000\nY30.\n", off = "G40 X0 Y0\n";
  EXPECT_EQ(alarm_of("G5 P10000\n" + on + "G5 P0"), "P34");
  EXPECT_EQ(alarm_of("G5.1 Q1\n" + on + "G5.1 Q0"), "P34");
  EXPECT_EQ(alarm_of("G5 P10000\n" + on + off + "G5 P0"), "");
  EXPECT_EQ(alarm_of("G5.1 Q1\n" + on + off + "G5.1 Q0"), "");
}

TEST(HighSpeed, AllowedCodesOfEachMode) {  // M700 13.17.1 (2), 13.17.2 (2)
  struct Row {
    const char* block;
    bool mode1, mode2, smooth;
  };
  const Row rows[] = {
      {"G0 X1.", true, true, true},
      {"G1 X1. F100", true, true, true},
      {"G2 X2. R1. F100", true, true, true},
      {"G3 X2. I1. Z1. F100", true, true, true},
      {"G2.1 X2. I2. P1 F100", false, false, true},
      {"G18", true, true, true},
      {"G43 Z1. H1", true, true, false},
      {"G49", true, true, false},
      {"G51.1 X0", true, true, true},
      {"G91", true, true, true},
      {"G92 X0", true, true, false},
      {"G55", true, true, false},
      {"G53 X0", true, true, false},
      {"G10 L10 P1 R1.", true, true, false},
      {"G10 L2 P1 X1.", false, false, false},
      {"G4 P100", false, false, false},
      {"G28 X0", false, false, false},
      {"G9 G1 X1. F100", false, false, false},
      {"G94", false, false, false},
      {"G81 Z-1. R1. F100", false, false, false},
      {"G68 X0 Y0 R30.", false, false, false},
      {"G16", false, false, false},
      {"G61", false, false, false},
      {"M8 S100", true, true, true},
      {"/G1 X1.", true, true, true},
  };
  for (const Row& row : rows) {
    const std::string block = std::string(row.block) + "\n";
    EXPECT_EQ(alarm_of("F100\nG5.1 Q1\n" + block) != "P34", row.mode1) << row.block;
    EXPECT_EQ(alarm_of("F100\nG5 P10000\n" + block) != "P34", row.mode2) << row.block;
    EXPECT_EQ(alarm_of("F100\nG5 P10000\n" + block, "8090") != "P34", row.smooth) << row.block;
  }
}

TEST(HighSpeed, OtherDataIsAFormatError) {  // M700 13.17.2 (2), 13.17.1 note 1 and precaution (12)
  EXPECT_EQ(alarm_of("G5 P10000\nG1 X1. F100 E5"), "P33");
  EXPECT_EQ(alarm_of("G5 P10000\nM96 P1"), "P33");
  EXPECT_EQ(alarm_of("G5 P10000\nH1"), "");
  EXPECT_EQ(alarm_of("G5.1 Q1\nH1"), "");
  EXPECT_EQ(alarm_of("G5 P10000\nH1", "8090"), "P33");  // no length compensation in SSS control
  EXPECT_EQ(alarm_of("G5 P10000\nG65 P1"), "P34");
  EXPECT_EQ(alarm_of("G5 P10000\n#100=1"), "P33");
  EXPECT_EQ(alarm_of("#100=1\nG5 P10000\nG1 X#100 F100"), "P33");
  EXPECT_EQ(alarm_of("G5.1 Q1\n#100=1\nG1 X#100 F100\nG5.1 Q0"), "");
}

TEST(HighSpeed, FeedByDigitIsNotForSss) {  // M700 13.17.2 (3)
  Bench bench;
  bench.param("1267/bit0", "1").param("8090", "1").param("1079", "1").param("1185", "100");
  EXPECT_EQ(bench.run("G5 P10000\nG1 X1. F1\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G5 P10000\nG1 X1. F100\nM30").alarm, "");
}

TEST(HighSpeed, TheEndOfTheProgramEndsIt) {
  Bench bench;
  EXPECT_EQ(bench.run("G5 P10000\nG1 X1. F100\nM30").alarm, "");
  EXPECT_EQ(bench.run("G4 P10\nG61.1\nG8 P1\nM30").alarm, "");
}

}  // namespace
}  // namespace nc::test
