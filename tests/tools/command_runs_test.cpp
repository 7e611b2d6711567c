// SPDX-License-Identifier: Apache-2.0
// How a run of ncsim goes on and ends with loops, M99, interrupts, skip moves and events, which is the same in every subcommand.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tools/command_fixture.hpp"

namespace nc::tools {
namespace {

TEST_F(CommandTest, AnEndlessLoopEndsWithAMessage) {
  for (const char* loop :
       {"N1 GOTO 1\nM30\n", "N1\n#1=1\nGOTO 1\nM30\n", "WHILE [#1000 EQ 0] DO1\nEND1\nM30\n"}) {
    file("p.nc", loop);
    for (const char* command : {"check --max-silent-blocks 100000 p.nc", "time p.nc"}) {
      const Outcome run = ncsim(command);
      EXPECT_EQ(run.code, 3) << command << "\n" << loop;
      EXPECT_NE(run.err.find("endless loop"), std::string::npos) << run.err;
    }
  }
}

// M700 13.12, #1112 = 1: between two runs of the interrupt program, which moves nothing, one block is executed.
TEST_F(CommandTest, AnInterruptSignalThatStaysOnEndsWithTheProgram) {
  file("s.json", R"({"params": {"1112": 1}, "subprograms": {"1000": "O1000\n#100=#100+1\nM99\n%"},
                     "events": [{"when": {"line": 3}, "signals": {"macro_interrupt": 1}}]})");
  file("p.nc", "#100=0\nM96 P1000\nG0 X1.\nX2.\nX3.\nM97\nX4.\nM30\n");
  const Outcome run = ncsim("trace --setup s.json p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  ASSERT_FALSE(run.events().empty());
  EXPECT_EQ(run.events().back()["vars"]["100"], 4);
  EXPECT_EQ(run.events().back()["work"]["X"], 4);
  file("p.nc", "#100=0\nM96 P1000\nN1 GOTO 1\nM30\n");  // calls and returns of the interrupt program do not count as actions of the machine
  const Outcome loop = ncsim("check --setup s.json --max-silent-blocks 10000 p.nc");
  EXPECT_EQ(loop.code, 3);
  EXPECT_NE(loop.err.find("endless loop"), std::string::npos) << loop.err;
}

// M700 15.2: the signal is on at the start. The next block begins where the axes are, and the skipped distance is not made up for.
TEST_F(CommandTest, ASkipMoveThatDoesNotMoveLeavesNothingBehindInAnyMode) {
  file("s.json", R"({"axes":["X","Y","Z"],"events":[{"when":{"line":2},"signals":{"skip":1}}]})");
  for (const char* behind : {"G1 Z4. F1000\n", "G0 Z4.\n", "#100=#5061\nG1 Z4. F1000\n", "M3 S500\nG1 Z4. F1000\n", "G31 Y20. F500\nG1 Z4. F1000\n"}) {
    file("p.nc", std::string("G90 G21\nG0 X5.\nG31 X15. F1600\n") + behind + "M30\n");
    for (const char* mode : {"--motion trapezoid ", "--motion optimal "}) {
      const Outcome run = ncsim(std::string("motion --setup s.json ") + mode + "p.nc");
      EXPECT_EQ(run.code, 0) << mode << behind << run.err;
      double x = 0, y = 0, z = 0, seconds = 0;
      const size_t end = run.out.find_last_not_of('\n');
      const std::string last = run.out.substr(run.out.rfind('\n', end) + 1);
      ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf,%lf", &seconds, &x, &y, &z), 4) << last;
      EXPECT_NEAR(x, 5, 1e-9) << mode << behind;
      EXPECT_NEAR(y, 0, 1e-9) << mode << behind;
      EXPECT_NEAR(z, 4, 1e-9) << mode << behind;
      for (size_t at = 0; (at = run.out.find('\n', at)) != std::string::npos; ++at) {
        if (std::sscanf(run.out.c_str() + at + 1, "%lf,%lf", &seconds, &x) != 2) continue;
        ASSERT_LT(x, 5.0001) << mode << behind;
      }
    }
  }
}

TEST_F(CommandTest, ALoopThatNeverEndsIsSeen) {
  file("p.nc", "WHILE [1 EQ 1] DO1\n#1=#1+1\nEND1\nM30\n");
  const Outcome calculates = ncsim("time p.nc");
  EXPECT_EQ(calculates.code, 3);
  EXPECT_NE(calculates.err.find("without motion"), std::string::npos) << calculates.err;
  file("p.nc", "WHILE [1 EQ 1] DO1\nG4 X600\nEND1\nM30\n");
  const Outcome waits = ncsim("time --cycle-us 100000 --max-seconds 20000 --max-passes 0 p.nc");
  EXPECT_EQ(waits.code, 3);
  EXPECT_NE(waits.out.find("cycle time   20000"), std::string::npos) << "what it has done until then: " << waits.out;
  EXPECT_NE(waits.err.find("note: line 2 after 1 h"), std::string::npos) << waits.err;
  EXPECT_NE(waits.err.find("after 4 h"), std::string::npos) << waits.err;
  EXPECT_EQ(waits.err.find("after 3 h"), std::string::npos) << waits.err;
}

TEST_F(CommandTest, ALoopThatMovesAndChangesNothingIsGivenUp) {
  for (const char* loop : {"G1 X1. F60000\nN2 G1 X2.\nX1.\nGOTO 2\nM30\n", "N1 G1 X1. F60000\nX0\nM99 P1\n", "G90 F60000\nWHILE[1EQ1]DO1\nG1 X1.\nX0\nEND1\nM30\n",
                           "M98 P7\nM30\nO7\nN2 G1 X2. F60000\nX1.\nGOTO 2\nM99\n"}) {
    file("p.nc", loop);
    const std::string passes = "100 passes of the loop back to line ";
    Outcome run = ncsim("check p.nc");
    EXPECT_EQ(run.code, 3) << loop << run.err;
    EXPECT_NE(run.err.find(passes), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("an endless loop (--max-passes)"), std::string::npos) << run.err;
    EXPECT_NE(run.out.find("no alarm until it was given up; "), std::string::npos) << run.out;
    run = ncsim("trace p.nc");
    EXPECT_EQ(run.code, 3) << loop;
    const std::vector<Json> events = run.events();  // whole lines
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.back()["t"], "end");
    EXPECT_EQ(events.back()["ok"], false);
    run = ncsim("plot p.nc -o drawn");
    EXPECT_EQ(run.code, 3) << loop;
    EXPECT_NE(content(folder_ + "/drawn.svg").find("</svg>"), std::string::npos);
    run = ncsim("time --cycle-us 10000 p.nc");
    EXPECT_EQ(run.code, 3) << loop << run.err;
    EXPECT_NE(run.err.find(passes), std::string::npos) << run.err;
    EXPECT_NE(run.out.find("s (0:0"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("until it was given up"), std::string::npos) << run.out;
    run = ncsim("motion --cycle-us 10000 p.nc -o m.csv");
    EXPECT_EQ(run.code, 3) << loop << run.err;
    EXPECT_GT(content(folder_ + "/m.csv").size(), 10'000u);
  }
}

// A loop in which something changes may come to its end; that need not be a variable.
TEST_F(CommandTest, ALoopThatComesToItsEndIsNotCut) {
  for (const char* loop :
       {"#1=0\nWHILE[#1LT3000]DO1\nG1 X1. F60000\nX0\n#1=#1+1\nEND1\nM30\n",                // a local variable
        "#500=0\nN2 G1 X1. F60000\nX0\n#500=#500+1\nIF[#500LT3000]GOTO 2\nM30\n",             // a common one
        "#3901=0\nN2 G1 X1. F60000\nX0\n#3901=#3901+1\nIF[#3901LT500]GOTO 2\nM30\n",          // parts made
        "#2001=0\nN2 G1 X1. F60000\nX0\n#2001=#2001+0.01\nIF[#2001LT5]GOTO 2\nM30\n",         // a tool offset
        "#5221=0\nN2 G1 X1. F60000\nX0\n#5221=#5221+0.01\nIF[#5221LT5]GOTO 2\nM30\n",         // a workpiece offset
        "G91\nN2 G1 X1. F60000\nIF[#5001LT3000]GOTO 2\nM30\n",                                  // the place
        "N2 G1 X1. F60000\nX0\nIF[#3001LT20000]GOTO 2\nM30\n",                                  // the clock
        "F1000\nN2 G1 X1. F[#4109+1]\nX0\nIF[#4109LT1500]GOTO 2\nM30\n",                      // F, S, T, D, H, M, N as they are in force
        "S1\nN2 G1 X1. F60000 S[#4119+1]\nX0\nIF[#4119LT500]GOTO 2\nM30\n",
        "T1\nG1 F60000\nWHILE[#4120LT500]DO1\nX1. T[#4120+1]\nX0\nEND1\nM30\n",
        "D1\nN2 G1 X1. F60000\nX0 D[#4107+1]\nIF[#4107LT150]GOTO 2\nM30\n",
        "H1\nN2 G1 X1. F60000\nX0 H[#4111+1]\nIF[#4111LT150]GOTO 2\nM30\n",
        "M200\nN2 G1 X1. F60000\nX0\nM[#4113+1]\nIF[#4113LT900]GOTO 2\nM30\n",
        "G54.1 P1\nN2 G1 X1. F60000\nG54.1 P[#4130+1] X0\nIF[#4130LT96]GOTO 2\nX5.\nGOTO 3\nN3 M30\n",
        "G1 F60000\nM98 P7\nM30\nO7\nN1 X1.\nX0 F[#4109+1]\nIF[#4109LT60300]GOTO 1\nM99\n",
        "#3901=0\nN2 M98 P7\nIF[#4109LT60500]GOTO 2\nM30\nO7 #3901=#3901+1\nG1 X1. F[60000+#3901]\nM99\n",  // counted in a sub program
        "G10 L2 P1 X0\nN2 G1 X1. F60000\nG10 L2 P1 X[#5221+1]\nIF[#5221LT500]GOTO 2\nM30\n",
        "N2 G1 X1. F60000\nX0\n#1100=1-#1100\n#1132=#1132+2\nIF[#1132LT2000]GOTO 2\nM30\n",            // outputs
        "M98 P7 L9999\nM30\nO7 G1 X1. F60000\nX0\nM99\n"}) {
    file("p.nc", loop);
    const Outcome run = ncsim("check p.nc");
    EXPECT_EQ(run.code, 0) << loop << run.err;
  }
  file("s.json", R"({"events": [{"when": {"seconds": 60}, "inputs": {"1000": 1}}]})");
  file("p.nc", "N1 G1 X1. F60000\nX0\nIF[#1000EQ0]GOTO 1\nM30\n");
  EXPECT_EQ(ncsim("check --setup s.json p.nc").code, 0);  // an event to come
  EXPECT_EQ(ncsim("check p.nc").code, 3);
}

// G06 of the Series 8 goes to and fro for as long as an input is on, which the setup leaves on.
TEST_F(CommandTest, ABlockThatNeverEndsIsGivenUp) {
  file("p.s8", "F100\nG06X10Y5F1000\nM30\n");
  file("on.json", R"({"inputs":{"1000":1}})");
  for (const char* command : {"check", "trace", "time --cycle-us 10000"}) {
    const Outcome run = ncsim(std::string(command) + " --dialect series8 --setup on.json p.s8");
    EXPECT_EQ(run.code, 3) << command << run.err;
    EXPECT_NE((run.err + run.out).find("line 2: 100 passes within this block, the last one without any change: an endless loop"), std::string::npos) << run.err << run.out.substr(0, 300);
  }
  EXPECT_EQ(ncsim("check --dialect series8 p.s8").code, 0);
}

// M66 asks again and again for its time, and then goes on.
TEST_F(CommandTest, AWaitForAnInputIsNoLoop) {
  file("p.ngc", "M66 P0 L3 Q5\nG0 X#5399\nM2\n");
  for (const char* command : {"check", "time"}) EXPECT_EQ(ncsim(std::string(command) + " --dialect iso p.ngc").code, 0) << command;
  EXPECT_NE(ncsim("trace --dialect iso p.ngc").out.find("\"X\":-1"), std::string::npos);
}

// A cycle without the point of its Q: so many strokes that nobody has meant them.
TEST_F(CommandTest, ABlockOfMillionsOfMovesIsGivenUp) {
  file("p.s8", "F100\nG83X1Z-1000R1I0J.0001\nM30\n");
  const Outcome run = ncsim("check --dialect series8 p.s8");
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.err.find("line 2: 1000000 moves of this block alone, and it goes on"), std::string::npos) << run.err;
}

// A loop that comes back to a state that it has had before: in every pass, in every second or third one, or from some pass on.
TEST_F(CommandTest, ALoopThatGoesRoundIsGivenUp) {
  struct {
    const char* program;
    const char* verdict;
  } const loops[] = {
      {"#1=0\nN1 G1 X#1 F60000\n#1=1-#1\nGOTO1\nM30\n", "101 passes of the loop back to line 2, the last 2 of them back to where they began: an endless loop"},
      {"T1\nN1 G1 X1. F60000\nX0 T[[#4120 MOD 3]+1]\nGOTO1\nM30\n", "202 passes of the loop back to line 2, the last 3 of them"},
      {"#1=0\nN1 G1 X1. F60000\nX0\nIF[#1EQ150]GOTO1\n#1=#1+1\nGOTO1\nM30\n", "passes of the loop back to line 2, the last one without any change"},
      {"#3901=0\nN1 M98 P7\nGOTO1\nM30\nO7 G1 X#3901 F60000\nX9.\nM99\n", "100 passes of the loop back to line 2, the last one without any change"},
      {"N1 G1 X1. F60000\nX0\n#1=1\nG10 L2 P1 X5.\nG22 X9. Y9. Z9. I8. J8. K8.\nG54\nGOTO1\nM30\n", "the last one without any change"}};
  for (const auto& loop : loops) {
    file("p.nc", loop.program);
    for (const char* command : {"check p.nc", "time --cycle-us 10000 p.nc"}) {
      const Outcome run = ncsim(command);
      EXPECT_EQ(run.code, 3) << command << "\n" << loop.program;
      EXPECT_NE(run.err.find(loop.verdict), std::string::npos) << command << "\n" << loop.program << run.err;
    }
  }
}

TEST_F(CommandTest, ALoopThatOnlyCountsEndsAtTheLimitOfPasses) {
  file("p.nc", "N1 G1 X1. F60000\nX0\n#500=#500+1\nGOTO 1\nM30\n");
  const Outcome run = ncsim("check --max-passes 5000 p.nc");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("line 4: 5000 passes of the loop back to line 1 without an end (--max-passes)"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("10001 moves"), std::string::npos) << run.out;
  // An inner loop begins anew with each pass of the outer one.
  file("p.nc", "#1=0\nWHILE[#1LT90]DO1\n#2=0\nWHILE[#2LT90]DO2\nG1 X1. F60000\nX0\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n");
  EXPECT_EQ(ncsim("check --max-passes 100 p.nc").code, 0);
}

TEST_F(CommandTest, APlotWithoutAMoveShowsWhereItStands) {
  file("s.json", R"({"start": {"X": 30, "Z": 100}, "work_offsets": {"G54": {"X": 10}}})");
  file("p.nc", "G90 G54\nG1 X10.\nM30\n");  // no feed
  const Outcome run = ncsim("plot --setup s.json --view xz p.nc -o none");
  EXPECT_EQ(run.code, 2) << run.err;
  const std::string drawing = content(folder_ + "/none.svg");
  EXPECT_NE(drawing.find("<path"), std::string::npos);
  file("e.nc", "M30\n");
  EXPECT_EQ(ncsim("plot --setup s.json --view xz e.nc -o empty").code, 0);
  EXPECT_NE(content(folder_ + "/none.png"), content(folder_ + "/empty.png"));
}

TEST_F(CommandTest, AProgramThatM99BeginsAgainIsCheckedAndDrawnOnce) {
  file("p.nc", "G90 G0 X10. (NOT YET: M99)\nM98 P5 L2\n/M99\nG0 X0\nM99\n\nO5\nG91 G0 Y1.\nM99\n");
  Outcome run = ncsim("check p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("no alarm in one pass (it begins again by itself); 9 blocks"), std::string::npos) << run.out;
  EXPECT_EQ(ncsim("plot p.nc -o once").code, 0);
  // In a sub program it is a return.
  file("p.nc", "M98 P5\nM30\nO5\nG0 X1.\nM99\n");
  run = ncsim("check p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("one pass"), std::string::npos) << run.out;
}

// This is so for trace, time and motion, too; but a program whose passes differ may end by itself.
TEST_F(CommandTest, AProgramThatM99BeginsAgainRunsOnce) {
  file("p.nc", "G91 G1 X10. F6000\n#500=#500+1\n/M99\nM30\n");
  file("s.json", R"({"optional_skip": []})");
  Outcome run = ncsim("trace p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  ASSERT_FALSE(run.events().empty());
  EXPECT_EQ(run.events().back()["t"], "end");
  EXPECT_EQ(run.events().back()["work"]["X"], 10);
  run = ncsim("time p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("of one pass (it begins again by itself)"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("path length  10."), std::string::npos) << run.out;  // and in the last cycle a little of the next pass
  file("p.nc", "#500=#500+1\nIF[#500GT4]GOTO9\nG91 G1 X10. F6000\nM99\nN9 M30\n");
  run = ncsim("trace p.nc");
  EXPECT_EQ(run.events().back()["work"]["X"], 40);
  run = ncsim("time p.nc");
  EXPECT_EQ(run.out.find("one pass"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("path length  40.000 mm"), std::string::npos) << run.out;
}

// An event at a line that calls a program comes before the first block of that program, in every subcommand.
TEST_F(CommandTest, EventsOfLinesAreTheSameInEverySubcommand) {
  file("p.nc", "G90 G0 X0 Y0\nM98 P1\nG0 X3.\n#101=#1000\nG1 X[4.+#101] F1000\nM98 P1\nM30\n"
       "O1\nIF[#1000EQ1]GOTO20\nG1 Y-1. F1000\nM99\nN20 G1 Y1. F1000\nM99\n");
  for (const int line : {2, 3, 4, 5, 6, 7}) {
    file("s.json", R"({"events": [{"when": {"line": )" + std::to_string(line) + R"(}, "inputs": {"1000": 1}}]})");
    std::string expected;
    for (const Json& event : ncsim("trace --setup s.json p.nc").events())
      if (event["t"] == "move") expected += event["work"]["X"].dump() + "," + event["work"]["Y"].dump() + " ";
    const std::string first = line == 2 ? "0,1 3,1 5,1 " : line == 3 || line == 4 ? "0,-1 3,-1 5,-1 5,1 " : line < 7 ? "0,-1 3,-1 4,-1 4,1 " : "0,-1 3,-1 4,-1 ";
    EXPECT_EQ(expected, first) << line;
    ASSERT_EQ(ncsim("motion --setup s.json p.nc -o m.csv").code, 0);
    // The highest Y on the way, and the place where the axes end.
    std::ifstream rows(folder_ + "/m.csv");
    double top = 0, x = 0, y = 0;
    std::string row;
    for (std::getline(rows, row); std::getline(rows, row);) {
      ASSERT_EQ(std::sscanf(row.c_str(), "%*[^,],%lf,%lf", &x, &y), 2) << row;
      top = std::max(top, y);
    }
    EXPECT_NEAR(top, line < 7 ? 1 : 0, 1e-6) << line;
    EXPECT_NEAR(x, line < 5 ? 5 : 4, 1e-6) << line;
    EXPECT_NEAR(y, line < 7 ? 1 : -1, 1e-6) << line;
  }
}

}  // namespace
}  // namespace nc::tools
