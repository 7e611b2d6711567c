// SPDX-License-Identifier: Apache-2.0
// What an alarm tells beside its code: which blocks called the program, which variable was vacant, which option is off, and what a code of another
// control is called here.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// The blocks that led to the alarm, as "2 > O9001:3 > O9002:1".
std::string calls(Bench& bench) {
  nc_source all[NC_MAX_CALLS];
  const unsigned count = nc_alarm_calls_get(bench.control(), 0, all, NC_MAX_CALLS);
  std::string text;
  for (unsigned i = 0; i < count; ++i) {
    EXPECT_EQ(all[i].depth, i);
    EXPECT_EQ(all[i].system, 0);
    if (i != 0) text += " > ";
    if (all[i].program != 0) text += "O" + std::to_string(all[i].program) + ":";
    text += std::to_string(all[i].line);
  }
  return text;
}

TEST(AlarmCalls, OutermostFirst) {
  Bench bench;
  bench.add("O9001", "O9001\nG90\nG65 P9002 A1.\nM99\n");
  bench.add("O9002", "O9002\nM98 P9003\nM99\n");
  bench.add("O9003", "O9003\nG4 P1\nG123\nM99\n");
  EXPECT_EQ(bench.run("G21\n\nM98 P9001\nM30").alarm, "P34");
  EXPECT_EQ(calls(bench), "3 > O9001:3 > O9002:2 > O9003:3");
  nc_source two[2];
  EXPECT_EQ(nc_alarm_calls_get(bench.control(), 0, two, 2), 4u);  // as many as there are, as many as there is room for
  EXPECT_EQ(two[1].program, 9001u);
  EXPECT_EQ(nc_alarm_calls_get(bench.control(), 0, nullptr, 0), 4u);
  EXPECT_EQ(nc_alarm_calls_get(bench.control(), 0, nullptr, 2), 0u);
  EXPECT_EQ(nc_alarm_calls_get(bench.control(), 1, two, 2), 0u);
  EXPECT_EQ(nc_alarm_calls_get(nullptr, 0, two, 2), 0u);
  EXPECT_TRUE(bench.run("M30").ended_ok);
  EXPECT_EQ(nc_alarm_calls_get(bench.control(), 0, two, 2), 0u);
}

TEST(AlarmCalls, OfTheMainProgram) {
  Bench bench;
  bench.run("G21\nG123\nM30");
  EXPECT_EQ(calls(bench), "2");
}

/// If a block that calls or returns raises the alarm itself, it is the last one in the list.
TEST(AlarmCalls, OfABlockThatCannotCall) {
  Bench bench;
  bench.add("O9001", "M98 P7777\nM99\n");
  bench.run("M98 P9001\nM30");
  EXPECT_EQ(calls(bench), "1 > O9001:1");
  bench.add("O9002", "M99 P50\n");
  bench.run("M98 P9002\nM30");
  EXPECT_EQ(calls(bench), "1 > O9002:1");
  bench.add("O9003", "M98 P9003\nM99\n");
  EXPECT_EQ(bench.run("M98 P9003\nM30").alarm, "P230");
  EXPECT_EQ(calls(bench), "1 > O9003:1 > O9003:1 > O9003:1 > O9003:1 > O9003:1 > O9003:1 > O9003:1 > O9003:1");
}

TEST(AlarmCalls, OfModalCallsCodesAndCycles) {
  Bench bench;
  bench.add("O9001", "G4 P1\nG123\nM99\n");
  bench.run("G0 X1.\nG66 P9001\nG0 X2.\nM30");
  EXPECT_EQ(calls(bench), "3 > O9001:2");
  bench.param("7201", "201").param("7202", "1").param("7203", "9001");
  bench.run("G201\nM30");
  EXPECT_EQ(calls(bench), "1 > O9001:2");
}

/// Alarms of a stage behind the interpreter (limits on the finished path, compensation), which come when more has been read already.
TEST(AlarmCalls, OfAlarmsThatTheFinishedPathShows) {
  const auto limited = [](nc_config& c) {
    c.system[0].axis[0].soft_limited = true;
    c.system[0].axis[0].soft_min = -50;
    c.system[0].axis[0].soft_max = 50;
  };
  for (const char* first : {"", "G0 Y1.\n", "M3 S100\n"}) {  // the first block of the program is the wrong one, or a later one
    Bench bench(NC_DIALECT_M700, limited);
    bench.add("O9001", std::string("O9001\n") + first + "M98 P9002\nM99\n");
    bench.add("O9002", std::string("O9002\n") + first + "G0 X60.\nG0 X0\nM99\n");
    bench.run("G0 X1.\nM98 P9001\nG0 X2.\nM30");
    const unsigned at = *first == 0 ? 2 : 3;
    EXPECT_EQ(calls(bench), "2 > O9001:" + std::to_string(at) + " > O9002:" + std::to_string(at)) << first;
    bench.run("G0 X1.\nM98 P9001\nG0 X60.\nM30");
    bench.add("O9002", "O9002\nG0 X2.\nM99\n");
    bench.run("G0 X1.\nM98 P9001\nG0 X60.\nM30");  // back in the main program
    EXPECT_EQ(calls(bench), "3") << first;
  }
  Bench bench;
  bench.tool(1, 5);
  bench.add("O9001", "G41 D1 G1 X10. F100\nX20.\nY1.\nX10.\nY20.\nG40 X0\nM99\n");
  EXPECT_EQ(bench.run("G0 X1.\nM98 P9001\nM30").alarm, "P153");
  EXPECT_EQ(calls(bench).substr(0, 10), "2 > O9001:");
}

TEST(AlarmCalls, OfAnInterrupt) {
  Bench bench;
  bench.add("O9001", "G4 P1\nG123\nM99\n");
  bench.start("M96 P9001\nG1 X10. F100\nG1 X20.\nM97\nM30");
  Step step;
  while (bench.pull(&step) == NC_OK)
    if (step.item.kind == NC_ITEM_MOVE && step.item.source.line == 3) break;
  bool take_back = false;
  ASSERT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_OK);
  bench.finish();
  EXPECT_EQ(calls(bench), "3 > O9001:2");
}

std::string detail(const std::string& program, Bench&& bench = Bench()) {
  const Outcome run = bench.run(program);
  EXPECT_NE(run.alarm, "") << program;
  return run.alarm_detail;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(AlarmDetail, NamesTheCompensationThatWasCommanded) {
  for (const std::string code : {"G41", "G42"}) {
    EXPECT_TRUE(says(detail("%\nG18\n" + code + " D1\nM02\n", Bench(NC_DIALECT_DGSHAPE)), code)) << code;
  }
}

TEST(AlarmCause, TheVacantVariable) {
  const struct {
    const char *program, *alarm, *cause;
  } rows[] = {
      {"G1 X10. F#650\nM30", "P62", "F#650 is vacant."},
      {"F#650\nG1 X10.\nM30", "P62", "F#650 was vacant in line 1."},
      {"G1 X10. F[#650*1]\nM30", "P62", "In the value of F, #650 is vacant."},
      {"G1 X10. F[#0+0]\nM30", "P62", ""},
      {"#650=0\nG1 X10. F#650\nM30", "P62", ""},
      {"#9=5\nG1 X10. F#10\nM30", "P62", "F#10 is vacant."},
      {"#1=650\nG1 X10. F##1\nM30", "P62", "In the value of F, #650 is vacant."},
      {"G2 X10. I#4 F100\nM30", "P70", "I#4 is vacant."},
      {"M98 P#600\nM30", "P230", "P#600 is vacant."},
      {"G65 P#600\nM30", "", "P#600 is vacant."},
      {"#2=10/#1\nM30", "P283", "In the value for #2, #1 is vacant, which counts as 0."},
      {"#2=LN[#1]\nM30", "P282", "In the value for #2, #1 is vacant, which counts as 0."},
      {"IF [10/#7 GT 1] GOTO 5\nM30", "P283", "In the condition, #7 is vacant, which counts as 0."},
      {"GOTO#5\nM30", "P231", "In the number behind GOTO, #5 is vacant."},
      {"X[10/#7]\nM30", "P283", "In the value of X, #7 is vacant."},
      {"#3=1 #4=#3/#5\nM30", "P283", "In the value for #4, #5 is vacant"},
      {"G10 L2 P[#8-3] X1.\nM30", "", "In the value of P, #8 is vacant."},
  };
  for (const auto& row : rows) {
    Bench bench;
    const Outcome run = bench.run(row.program);
    EXPECT_TRUE(*row.alarm == 0 || run.alarm == row.alarm) << row.program << ": " << run.alarm;
    EXPECT_EQ(says(run.alarm_detail, "vacant"), *row.cause != 0) << row.program << ": " << run.alarm_detail;
    EXPECT_TRUE(says(run.alarm_detail, row.cause)) << row.program << ": " << run.alarm_detail;
  }
}

/// A vacant variable that has nothing to do with the alarm is not named.
TEST(AlarmCause, NotAVariableThatHasNothingToDoWithIt) {
  for (const char* program : {"IF [#5 EQ #0] GOTO 10\nM30", "G123 X#5\nM30", "#5=#6\nG1 X1.\nM30", "G1 X#5 Y1.\nM30", "#6=1\nG1 X1. F#6\nG95 X5.\nM30",
                              "F#650\nF100\nG1 X1.\nG95 X5.\nM30", "G0 X1. Y#7 U5.\nM30"}) {
    const std::string text = detail(program);
    EXPECT_FALSE(says(text, "vacant")) << program << ": " << text;
  }
}

TEST(AlarmCause, TheOptionThatIsOff) {
  const auto sets = [](uint32_t n) { return [n](nc_config& c) { c.variable_sets = n; }; };
  EXPECT_TRUE(says(detail("#900000=1\nM30"), "#900000. The option extended_variables is off."));
  EXPECT_TRUE(says(detail("#1=#907399\nM30"), "The option extended_variables is off."));
  EXPECT_TRUE(says(detail("#150=1\nM30", Bench(NC_DIALECT_M700, sets(100))), "variable_sets = 200 or more."));
  EXPECT_TRUE(says(detail("X#560\nM30", Bench(NC_DIALECT_M700, sets(100))), "variable_sets = 200 or more."));
  EXPECT_TRUE(says(detail("#650=1\nM30", Bench(NC_DIALECT_M700, sets(200))), "variable_sets = 300 or more."));
  EXPECT_TRUE(says(detail("#700=1\nM30", Bench(NC_DIALECT_M700, sets(300))), "variable_sets = 600 or more."));
  EXPECT_TRUE(says(detail("#450=1\nM30"), "The option variable_ranges"));
  EXPECT_TRUE(says(detail("#2050=1\nM30", Bench(NC_DIALECT_M700, [](nc_config& c) { c.tool_offsets = 40; })), "The option tool_offsets is 40."));
  EXPECT_TRUE(says(detail("#16001=1\nM30"), "type II (#1037 = 2)"));
  EXPECT_TRUE(says(detail("#7021=1\nM30", Bench(NC_DIALECT_M700, [](nc_config& c) { c.work_offsets = 0; })), "The option work_offsets is 0."));
  EXPECT_TRUE(says(detail("IF [1 EQ 1] THEN #1=2\nM30"), "macro_extensions, which is off."));
  // No option is named for what no option can provide, or what an option provides already.
  for (const char* program : {"#5004=1\nM30", "#1=#4129\nM30", "#1=#999999\nM30", "IF [1 EQ] GOTO 5\nM30", "SETVN 520[ABC]\nM30"})
    EXPECT_FALSE(says(detail(program), "option")) << program << ": " << detail(program);
  // The common variables of the HX are those of its manual (14.2), whatever the option of the machine is.
  EXPECT_FALSE(says(detail("#800=1\nM30", Bench(NC_DIALECT_HX, sets(100))), "option"));
  EXPECT_FALSE(says(detail("IF [1 EQ 1] THEN\nGOTO 77\nM30", std::move(Bench().param("macro_extensions", "1"))), "option"));
}

TEST(AlarmCause, CodesOfOtherControls) {
  for (const char* program : {"o100 sub\nM30", "O<finish> call [1] [2]\nM30", "N5 o101 if [#1 GT 2]\nM30", "o102 while [#1 LT 5]\nM30", "o100 endsub\nM30",
                              "o103 repeat [5]\nM30", " O 104 ENDIF\nM30", "o105 return\nM30", "o106 do\nM30", "o[#1] call\nM30"}) {
    EXPECT_TRUE(says(detail(program), "O-words of LinuxCNC")) << program << ": " << detail(program);
  }
  // After blocks of the program an O begins another program; it may also stand behind other words.
  for (const char* word : {"sub", "ENDSUB", "call", "call [1] [2]", "return", "return [#1]", "if [#1 EQ 0]", "elseif [#1 EQ 0]", "else", "endif",
                           "while [#1 LT 3]", "endwhile", "do", "break", "continue", "repeat [5]", "endrepeat"})
    for (const char* before : {"o100 ", "O1", "o<name> ", "O <my sub> ", "N10 o100 ", "N10 O<x> ", "G0 X1. o100 ", "X1 O<abc> ", "(o) o100 ", "/ o100 ", "/2 O<a> ", "o#1 "}) {
      const std::string program = std::string("G90\n") + before + word + "\nM30";
      EXPECT_TRUE(says(detail(program.c_str()), "O-words of LinuxCNC")) << program << ": " << detail(program.c_str());
    }
  for (const char* program : {"G1 X10. F#<feed>\nM30", "#<feed>=100\nM30", "G90\nN5 X[#<_global> + 1]\nM30", "#1=# <x>\nM30", "IF [#<a> GT 1] GOTO 5\nM30",
                              "WHILE [#<a> LT 1] DO1\nM30", "G1 X1. (#2) Y#<y>\nM30"})
    EXPECT_TRUE(says(detail(program), "Named parameters of LinuxCNC")) << program << ": " << detail(program);
  // What the family has in place of it is said in its own codes, and only where it has it.
  const char* const call = "O1\no100 call [1]\nM30";
  EXPECT_TRUE(says(detail(call), "do not exist here: M98 and G65 call, M99 returns, IF [ ] GOTO and WHILE [ ] DO branch."));
  EXPECT_TRUE(says(detail("%\nO1\nG90 G54\no100 call [1]\nM30\n%", Bench(NC_DIALECT_DGSHAPE)), "O-words of LinuxCNC do not exist here."));
  EXPECT_TRUE(says(detail("%\nO1\nG90 G54\nX#<a>\nM30\n%", Bench(NC_DIALECT_DGSHAPE)), "do not exist here, nor do variables."));
  EXPECT_FALSE(says(detail("G90\nX1. & (#<x>)\nM30"), "LinuxCNC"));
  EXPECT_FALSE(says(detail("G90\nO100 (call)\nM30"), "LinuxCNC"));
  EXPECT_FALSE(says(detail("G90\nX1. & (o100 call)\nM30"), "LinuxCNC"));
  EXPECT_FALSE(says(detail("G90\nO100\nM30"), "LinuxCNC"));
  EXPECT_TRUE(says(detail("G90.1\nM30"), "absolute arc centres"));
  EXPECT_TRUE(says(detail("G21 G91.1\nM30"), "Leave it out."));
  EXPECT_FALSE(says(detail("G92.7\nM30"), "arc"));
  EXPECT_FALSE(says(detail("O100 X\nM30"), "LinuxCNC"));
  EXPECT_FALSE(says(detail("X5 &\nM30"), "LinuxCNC"));
}

/// The text is never cut in the middle of a sentence.
TEST(AlarmCause, IsAWholeSentence) {
  for (const char* program : {"IF [1 EQ 1] THEN #1=2\nM30", "o100 sub\nM30", "G91.1\nM30", "G1 X10. F#650\nM30", "G2 X10. I#4 F100\nM30",
                              "G10 L2 P[#123456+1] X1.\nM30", "#2=LN[#1]\nM30"}) {
    const std::string text = detail(program);
    EXPECT_LT(text.size(), size_t{NC_MAX_TEXT});
    EXPECT_EQ(text.back(), '.') << text;
  }
}

}  // namespace
}  // namespace nc::test
