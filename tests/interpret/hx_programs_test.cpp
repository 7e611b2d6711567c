// SPDX-License-Identifier: Apache-2.0
// Sub-programs, macros and variables of the hx family: what its manual says otherwise than those of the other families do.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome hx(const std::string& text) { return Bench(NC_DIALECT_HX).run(text); }
std::string alarm_of(const std::string& text) { return hx(text).alarm; }

TEST(Hx, ASubProgramIsRunFromQToR) {  // 2.4.3, the printed program
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O0010\nN1 G90 G00 Z5.\nG01 Z-10. F20.\nZ-25. F100\nN2 G00 Z50.\nX99.\nM99\n");
  EXPECT_EQ(bench.run("M98 P10 Q1 R2 L2\nX70. Y20.\nM30").path(),
            (Path{"rapid 0 0 5", "line 0 0 -10 F20", "line 0 0 -25 F100", "rapid 0 0 50", "rapid 0 0 5", "line 0 0 -10 F20", "line 0 0 -25 F100",
                  "rapid 0 0 50", "rapid 70 20 50"}));
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("M98 P11 R2\nM30\nO11\nN1 M99").alarm, "F_82019");
  EXPECT_EQ(Bench(NC_DIALECT_HX).run("M98 P12\nM30").alarm, "F_82109");
}

TEST(Hx, FourSubProgramsStandInOneAnother) {  // 2.4.1; 14.1.7 (5): eight levels with macros
  const auto nest = [](unsigned levels, const char* call) {
    std::string text = "#100=0\nM98 P101\nM30\n";
    for (unsigned i = 1; i <= levels; ++i) text += "O" + std::to_string(100 + i) + "\n" + (i < levels ? call + std::to_string(101 + i) : "#100=#100+1") + "\nM99\n";
    return hx(text);
  };
  EXPECT_EQ(nest(4, "M98 P").alarm, "");
  EXPECT_EQ(nest(5, "M98 P").alarm, "F_82021");
  EXPECT_EQ(nest(5, "G65 P").alarm, "");
  EXPECT_EQ(nest(6, "G65 P").alarm, "NC-NESTING");  // four levels of macros
}

TEST(Hx, TheLastBlockMayBeACallOrAJump) {  // 2.4.3
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O10\nG91 G00 X1.\nN5 M98 P11\nX100.\nM99\nO11\nY1.\nM99\n");
  const Outcome run = bench.run("M98 P10 R5 L2\nZ1.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 1 1 0", "rapid 2 1 0", "rapid 2 2 0", "rapid 2 2 1"}));
  Bench jumping(NC_DIALECT_HX);
  jumping.add("O10.nc", "O10\nG91 G00 X1.\nN5 GOTO 7\nX100.\nN7 Y1.\nM99\n");
  EXPECT_EQ(jumping.run("M98 P10 R5\nZ1.\nM30").path(), (Path{"rapid 1 0 0", "rapid 1 1 0", "rapid 1 1 1"}));
}

TEST(Hx, BlocksOfMdiCallNoSubProgram) {  // 2.4.3
  Bench bench(NC_DIALECT_HX);
  bench.add("O10.nc", "O10\nG00 X1.\nM99\n");
  const std::string text = "M98 P10";
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, text.data(), text.size()), NC_OK);
  const Outcome run = bench.finish();
  EXPECT_EQ(run.alarm, "F_82113");
}

TEST(Hx, BlocksOfMdiEndTheirLoops) {  // 14.2.5
  const auto mdi = [](const std::string& text) {
    Bench bench(NC_DIALECT_HX);
    EXPECT_EQ(nc_mdi_load(bench.control(), 0, text.data(), text.size()), NC_OK);
    return bench.finish().alarm;
  };
  EXPECT_EQ(mdi("WHILE [1 EQ 1] DO1"), "NC-LOOP");
  EXPECT_EQ(mdi("#1=0 ; WHILE [#1 LT 2] DO1 ; #1=#1+1 ; END1"), "");
}

TEST(Hx, TheMainProgramIsRepeatedAsOftenAsLSays) {  // 2.4.4
  EXPECT_EQ(hx("N1 G91 G00 X1.\nM99 P1 L3\nY1.\nM30").path(), (Path{"rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0", "rapid 4 0 0", "rapid 4 1 0"}));
}

TEST(Hx, CodesCallMacrosByTheirPlace) {  // 14.1.3 to 14.1.5
  const auto bench = [](const std::string& text) {
    Bench b(NC_DIALECT_HX);
    b.param("3086", "101").param("3085", "6").param("3095", "33");
    b.add("O9010.nc", "O9010\n#110=#24\nM99\n");
    b.add("O9011.nc", "O9011\n#100=#1\nM99\n");
    b.add("O9020.nc", "O9020\n#101=#1\n#102=#13\nM99\n");
    return b.run(text);
  };
  EXPECT_EQ(bench("G101 A5.\nM30").var(100), 5);
  EXPECT_EQ(bench("G06 X7.\nM30").var(110), 7);
  const Outcome arguments = bench("M33 A8.\nM30");  // an M code that begins its block takes arguments,
  EXPECT_EQ(arguments.var(101), 8);
  EXPECT_EQ(arguments.var(102), 33);
  EXPECT_EQ(arguments.aux(), "M30");
  const Outcome behind = bench("#1=3\nG00 X4. M33\nM30");  // behind other words it is a sub program with the variables of the caller
  EXPECT_EQ(behind.path(), (Path{"rapid 4 0 0"}));
  EXPECT_EQ(behind.var(101), 3);
}

TEST(Hx, ToolNumbersCallAMacro) {  // 10.1.1, 14.1.6
  const auto calls = [](const char* pi_105, const char* pi_106) {
    Bench b(NC_DIALECT_HX);
    b.param("3105", pi_105).param("3106", pi_106);
    b.add("O9000.nc", "O9000\n#100=1\nM99\n");
    b.add("O9004.nc", "O9004\n#100=4\nM99\n");
    return b.run("G00 X1. T5\nM30");
  };
  EXPECT_EQ(calls("1", "0").var(100), 1);
  EXPECT_EQ(calls("4", "1").var(100), 4);
  EXPECT_EQ(calls("0", "0").aux(), "T5 M30");
}

TEST(Hx, TheProgramThatATCallsKnowsTheTool) {  // 10.1.1, 14.1.6, docs/decisions.md
  const auto calls = [](const std::string& text) {
    Bench b(NC_DIALECT_HX);
    b.param("3105", "1");
    b.add("O9000.nc", "O9000\n#100=#149\nT#149 M06\nM99\n");
    return b.run(text + "\nM30");
  };
  const Outcome one = calls("G00 X2. T5");
  EXPECT_EQ(one.alarm, "") << one.alarm_detail;
  EXPECT_EQ(one.var(100), 5);
  EXPECT_EQ(one.aux(), "T5 M6 M30");  // and not before: the macro changes it
  EXPECT_EQ(calls("T5\nT7").aux(), "T5 M6 T7 M6 M30");
  EXPECT_EQ(calls("T5.5").alarm, alarm_of("G00 T5.5\nM30"));
  EXPECT_NE(calls("T5.5").alarm, "");
}

TEST(Hx, TheManualBoringCycleWaitsForTheHand) {  // 12.3.11 "(handle, JOG)"
  const Outcome run = hx("S300 M03\nG00 Z20.\nG99 G88 X1. Z-5. R2. P200 F100\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  Path order;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_STOP) order.push_back("stop");
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M) order.push_back("M" + brief(item.u.action.value));
    if (item.kind == NC_ITEM_MOVE) order.push_back(brief(item.u.move.work.v[2]));
  }
  EXPECT_EQ(order, (Path{"M3", "20", "20", "2", "-5", "M5", "stop", "2", "M3", "M30"}));
}

TEST(Hx, TheBackBoringCycleCutsUpwards) {  // 12.3.10: from R under the part up to Z
  const auto bore = [](const std::string& levels) { return alarm_of("S300 M03\nG00 Z20.\nG98 G87 X1. " + levels + " I.5 F100\nM30"); };
  EXPECT_EQ(bore("Z-25. R-30."), "");
  EXPECT_EQ(bore("Z-30. R-25."), "F_82002");
  EXPECT_EQ(bore("Z-30. R-30."), "F_82002");
  EXPECT_EQ(bore("G91 Z5. R-50."), "");
  EXPECT_EQ(bore("G91 Z-5. R-50."), "F_82002");
}

TEST(Hx, WhatIsNoCircleAnyMoreIsAnAlarm) {  // 15.2.2 with different factors, also where both ends happen to lie on one circle
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J500\nG02 I10. J0 F100\nM30"), "F_82112");
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J500\nG02 X20. I10. F100\nM30"), "F_82112");
  EXPECT_EQ(alarm_of("G51 X0 Y0 I2000 J-2000\nG02 I10. J0 F100\nM30"), "");
  // A corner: R is that of an arc; C would have a leg of its own for each axis.
  EXPECT_EQ(hx("G51 X0 Y0 I500 J1000\nG01 X20. ,R4. F100\nY20.\nM30").path(), (Path{"line 6 0 0 F100", "ccw 10 4 0 c6,4 F100", "line 10 20 0 F100"}));
  EXPECT_EQ(hx("G51 X0 Y0 I1000 J500\nG01 X20. ,R4. F100\nY20.\nM30").path(), (Path{"line 16 0 0 F100", "ccw 20 4 0 c16,4 F100", "line 20 10 0 F100"}));
  const Outcome cut = hx("G51 X0 Y0 I500 J1000\nG01 X20. ,C4. F100\nY20.\nM30");
  EXPECT_EQ(cut.alarm + " " + cut.alarm_detail, "F_82112 The two axes of the plane are scaled differently, so C4 would not be the corner that is written.");
  EXPECT_EQ(m700("G51 X0 P0.5\nG1 X20. ,R4. F100\nY20.\nM30").alarm, "P70");  // M700 13.19 (4): no arc there
}

TEST(Hx, FactorsAreOfOneFormat) {  // 15.2.1, 15.2.2: P, or I J K
  const Outcome run = hx("G51 X0 Y0 P2000 I1000\nG00 X10.\nM30");
  EXPECT_EQ(run.alarm + " " + run.alarm_detail, "F_82004 P2000 and another word of the block exclude each other.");
  EXPECT_EQ(hx("G51 X0 Y0 I1000 J2000 K1000\nG00 X10. Y10.\nM30").path(), (Path{"rapid 10 20 0"}));
}

TEST(Hx, WhatACycleTakesFromTheOneBefore) {
  // 12.3.8: G86 has no P; 12.3.10: Q of the block goes before I and J of an earlier one.
  EXPECT_EQ(hx("S500 M03\nG00 Z20.\nG99 G88 X1. Z-5. R2. P500 F100\nG86 X2.\nG89 X3.\nG80\nM30").dwells(), (std::vector<double>{0.5, 0.5}));
  const std::string program = "S500 M03\nG00 Z20.\nG98 G76 X1. Z-5. R2. I.5 J.25 F100\nG87 X3. Z-3. R-10. Q1.\nG80\nM30";
  Bench by_q(NC_DIALECT_HX);
  by_q.param("3070", "0").param("3071", "0");
  const Outcome run = by_q.run(program);
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  const Path path = run.path();
  EXPECT_NE(std::find(path.begin(), path.end(), "rapid 4 0 -10"), path.end());
  EXPECT_EQ(alarm_of(program), "NC-WORDS");  // PI 70 and PI 71 do not say where Q goes
}

TEST(Hx, CodesBehindACallAreNoArguments) {  // 14.1.1 (1)
  const std::string program = "\nM30\nO1\n#100=#1\nM99";
  for (const char* call : {"G65 P1 G999 A1.", "G65 P1 G31.2 A1.", "G66 P1 G83 A1."}) EXPECT_EQ(alarm_of(call + program), "F_82001") << call;
  EXPECT_EQ(hx("G90 G65 P1 A1." + program).var(100), 1);  // in front of it they act
}

TEST(Hx, ChamferAndRoundingExcludeEachOther) {  // 4.3.1, 4.3.2
  EXPECT_EQ(alarm_of("G01 X30. ,R5. ,C5. F300\nY30.\nM30"), "F_82004");
  EXPECT_EQ(alarm_of("G01 X30. ,C5. ,R5. F300\nY30.\nM30"), "F_82004");
}

TEST(Hx, ParametersAreVariablesOfTheirNumber) {  // 14.2.3
  const Outcome run = hx("#3129=2.5\n#100=#3129\nG99 G83 X1. Z-10. R0 Q5. F100.\n#101=#22097\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 2.5);
  EXPECT_EQ(run.var(101), 0);
  bool near = false;
  for (const std::string& move : run.path()) near = near || move == "rapid 1 0 -2.5";
  EXPECT_TRUE(near);
  EXPECT_EQ(alarm_of("#3151=-1\nM30"), "F_82002");
}

TEST(Hx, SystemVariablesAreThoseOfTheManual) {  // 14.2.3
  Bench bench(NC_DIALECT_HX);
  bench.work_offset(1, {1, 2, 3}).work_offset(6, {10, 20, 30}).work_offset(0, {0.5, 0, 0}).at(5, 6, 7);
  const Outcome run = bench.run("S800 D7 H9\n#100=#2377\n#101=#2379\n#102=#2423\n#103=#2368\n#104=#6205\n#105=#4083\n#106=#6718\n#107=#6733\n"
      "#108=#4792\n#109=#4882\n#110=#4883\nN55 #111=#6716\n#112=#6740\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 3);
  EXPECT_EQ(run.var(102), 20);
  EXPECT_EQ(run.var(103), 0.5);
  EXPECT_EQ(run.var(104), 5);
  EXPECT_EQ(run.var(105), 3.5);
  EXPECT_EQ(run.var(106), 0);   // G00
  EXPECT_EQ(run.var(107), 17);  // group 16
  EXPECT_EQ(run.var(108), 800);
  EXPECT_EQ(run.var(109), 7);
  EXPECT_EQ(run.var(111), 55);
  for (const char* text : {"#8000=1", "#4083=1", "#6718=1"}) EXPECT_EQ(alarm_of(std::string(text) + "\nM30"), "NC-VARIABLE") << text;
  for (const char* text : {"#100=#1600", "#100=#2431", "#100=#4018", "#100=#5005"}) EXPECT_EQ(alarm_of(std::string(text) + "\nM30"), "NC-VARIABLE") << text;
}

TEST(Hx, TheInterfaceHasItsNumbers) {  // 14.2.3 (1), (2)
  const Outcome run = hx("#7501=1\n#7533=5\n#100=#7501\n#101=#7533\nM30");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 5);
}

}  // namespace
}  // namespace nc::test
