// SPDX-License-Identifier: Apache-2.0
// ';' ends a block and is the last character of its line (M700 3.2): text behind it must never be executed by accident. And numbers have no
// exponent: a text that looks like one is an alarm, not another number.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome with_comments(const std::string& text) { return Bench().param("semicolon_comments", "1").run(text); }

/// Pulls MDI blocks to their end.
Outcome mdi(Bench& bench, const std::string& text) {
  EXPECT_EQ(nc_mdi_load(bench.control(), 0, text.data(), text.size()), NC_OK);
  return bench.finish();
}

TEST(Semicolon, EndsABlockAtTheEndOfItsLine) {
  const Path two{"rapid 1 0 0", "rapid 1 2 0"};
  EXPECT_EQ(m700("G0 X1.;\nY2.;\nM30;\n").path(), two);
  EXPECT_EQ(m700("G0 X1. ;  \t\nY2.;(COMMENT; G0 X9.) ;;\r\nM30;").path(), two);
  EXPECT_EQ(m700("G0 X1.;\n;\n ; \nY2.\nM30;%\nG0 X100.").path(), two);
}

TEST(Semicolon, TextBehindItIsAnAlarmBeforeAnythingOfItsLine) {
  for (const char* text : {"G0 X1. ; X100.\nM30", "; X100.\nM30", "G0 X1.;Y2.\nM30", "G0 X1. ;rough pass\nM30", "G0 X1. ; (A) X100.\nM30", "G0 X1.;;X2.\nM30",
                           "G0 X1.;N5 Y1.\nM30", "G0 X1.;/Y1.\nM30", "G0 X1.;#1=2\nM30"}) {
    const Outcome run = m700(text);
    EXPECT_EQ(run.alarm, "P33") << text;
    EXPECT_EQ(run.path(), Path{}) << text;
    EXPECT_EQ(run.alarm_line, 1u) << text;
    EXPECT_NE(run.alarm_detail.find("';'"), std::string::npos) << run.alarm_detail;
  }
}

TEST(Semicolon, NothingBehindItIsGoneTo) {
  const Outcome run = m700("GOTO5\n/G0 X1.;N5 X2.\nM30");
  EXPECT_EQ(run.alarm, "P231");
  EXPECT_EQ(m700("M98 P7\nM30;\n/X1.;O7\nX2.\nM99").alarm, "P232");
}

TEST(Semicolon, AMachineMayTakeItForAComment) {
  const Outcome run = with_comments("G0 X1. ; X100. (\n; X100. % G0\nY2.;\n#1=5;#1=7\nX#1 ;END\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 1 2 0", "rapid 5 2 0"}));
  EXPECT_EQ(with_comments("G0\nGOTO5\nX1. ; N5 Y1.\nN5 X2.\nM30").path(), Path{"rapid 2 0 0"});
}

TEST(Semicolon, TheRuleChangesBetweenTwoRuns) {
  Bench bench;
  const std::string text = "#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\nG0X#1 ;X9.\nEND1\nM30";
  EXPECT_EQ(bench.run(text).alarm, "P33");
  EXPECT_EQ(bench.param("semicolon_comments", "1").run(text).path().size(), 3u);
  EXPECT_EQ(bench.param("semicolon_comments", "0").run(text).alarm, "P33");
}

TEST(Semicolon, MdiHasSeveralBlocksInALine) {
  for (const char* comments : {"0", "1"}) {
    Bench bench;
    bench.param("semicolon_comments", comments);
    EXPECT_EQ(mdi(bench, "G0 X1.;Y2.;G1 Z3. F100;").path(), (Path{"rapid 1 0 0", "rapid 1 2 0", "line 1 2 3 F100"}));
  }
}

TEST(Semicolon, IsNoCharacterOfDgshape) { EXPECT_EQ(dgshape("G0 X1. ;\nM30").alarm, "NC-CHARACTER"); }

TEST(Exponent, IsAnAlarm) {
  for (const char* text : {"G0 X1e-05\nM30", "G0 X1E-05\nM30", "G1 X1.5E+3 F100\nM30", "G1 X1. F1e3\nM30", "G0 X1. E5\nM30", "G4 P1E3\nM30", "S1E3 M3\nM30",
                           "G28 X0 E1\nM30", "G81 X1. Z-1. R1. F100 E2\nM30", "G33 Z-10. F1E+05\nM30", "G33 Z-1e-05 F1.\nM30", "G33 Z1e1 F2.\nM30", "g33 z-1.e2.\nM30", "G0 X1.E#1\nM30"}) {
    const Outcome run = m700(std::string("#1=3\n") + text);
    EXPECT_EQ(run.alarm, "P32") << text;
    EXPECT_EQ(run.path(), Path{}) << text;
    EXPECT_EQ(run.aux(), "") << text;
  }
  EXPECT_NE(m700("G0 X1e-05\nM30").alarm_detail.find("exponent"), std::string::npos);
  for (const char* text : {"#1=1e-5\nM30", "#1=1E5\nM30", "#1=[1.5E+2]\nM30", "G0 X[1E2]\nM30"}) EXPECT_NE(m700(text).alarm, "") << text;
}

TEST(Exponent, TheLeadOfAThreadAndArgumentsStay) {
  const Outcome thread = m700("S100 M3\nG33 Z-10. E12.7\nM30");
  EXPECT_EQ(thread.alarm, "");
  ASSERT_EQ(thread.moves().size(), 1u);
  EXPECT_DOUBLE_EQ(thread.moves()[0].feed_mm_rev, 2);
  EXPECT_EQ(m700("S100 M3\nG33 Z-10.E12.7\nM30").alarm, "");
  EXPECT_EQ(m700("s100 m3\ng33 z-10. e12.7\nm30").alarm, "");
  Bench bench;
  bench.add("O9", "#100=#8\nM99");
  EXPECT_EQ(bench.run("G65 P9 A1.E-5.\nM30").var(100), -5);
  EXPECT_EQ(bench.run("G65 P9 E+2.\nM30").var(100), 2);
  bench.add("O9", "#101=#8\nM99");
  EXPECT_EQ(bench.run("G66.1 P9\nX1. E7.\nG67\nM30").var(101), 7);
}

}  // namespace
}  // namespace nc::test
