// SPDX-License-Identifier: Apache-2.0
// ncsim as a person calls it: exit codes, messages, the same bytes on every run.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "places/places.hpp"
#include "tools/command_fixture.hpp"

namespace nc::tools {
namespace {

constexpr const char* kPart =
    "G90 G54 G00 X0 Y0 Z5.\nG01 Z-1. F100.\nX10. Y5. F250.\nG02 X20. Y-5. I0 J-10.\nM30\n";

TEST_F(CommandTest, TraceOfAProgramThatEnds) {
  file("p.nc", kPart);
  const Outcome run = ncsim("trace p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto events = run.events();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back()["t"], "end");
  EXPECT_EQ(events.back()["ok"], true);
  int moves = 0, blocks = 0;
  for (const Json& e : events) {
    moves += e["t"] == "move";
    blocks += e["t"] == "block";
    for (const char* key : {"t", "sys", "line", "prog", "depth"}) EXPECT_TRUE(e.contains(key)) << e;
  }
  EXPECT_EQ(moves, 4);
  EXPECT_EQ(blocks, 5);
}

TEST_F(CommandTest, TwoRunsGiveTheSameBytes) {
  file("p.nc", std::string("#100=#3011\n#101=#3012\n#102=#3001\n") + kPart);
  const Outcome one = ncsim("trace p.nc"), two = ncsim("trace p.nc");
  EXPECT_FALSE(one.out.empty());
  EXPECT_EQ(one.out, two.out);
}

TEST_F(CommandTest, StandardInputByPipeAndByFile) {
  file("p.nc", kPart);
  const Outcome by_path = ncsim("trace p.nc"), by_file = ncsim("trace - < p.nc");
  ASSERT_EQ(std::system(
                ("cd " + folder_ + " && cat p.nc | " + nc::test::kBinaryDir + "/bin/ncsim trace - > pipe.txt").c_str()),
            0);
  EXPECT_FALSE(by_path.out.empty());
  EXPECT_EQ(by_path.out, by_file.out);
  EXPECT_EQ(by_path.out, content(folder_ + "/pipe.txt"));
}

TEST_F(CommandTest, AlarmIsExitTwoWithItsLine) {
  file("p.nc", "G00 X1.\nG01 X2.\nM30\n");  // no F: P62
  const Outcome trace = ncsim("trace p.nc");
  EXPECT_EQ(trace.code, 2);
  const auto events = trace.events();
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events[events.size() - 2]["t"], "alarm");
  EXPECT_EQ(events[events.size() - 2]["code"], "P62");
  EXPECT_EQ(events[events.size() - 2]["line"], 2);
  EXPECT_EQ(events.back()["ok"], false);
  const Outcome check = ncsim("check p.nc");
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.out.rfind("p.nc:2: P62 ", 0), 0u) << check.out;
}

TEST_F(CommandTest, CheckSaysWhatAGoodProgramDoes) {
  file("p.nc", kPart);
  const Outcome check = ncsim("check p.nc");
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(check.out.rfind("p.nc: no alarm; 5 blocks, 4 moves, ", 0), 0u) << check.out;
}

TEST_F(CommandTest, CheckNotesParametersThatDoNothing) {
  file("p.nc", kPart);
  file("s.json", "{\"params\":\n {\"8033\": 1,\n  \"8092\": 1}}");
  const Outcome check = ncsim("check --setup s.json p.nc");
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(check.err, "note: s.json:3: params.8092: nothing in the control asks for this parameter: it is kept for programs that read it\n");
  EXPECT_EQ(ncsim("trace --setup s.json p.nc").err, "");
}

TEST_F(CommandTest, UsageFileAndSetupErrorsAreOneLineAndExitOne) {
  file("p.nc", kPart);
  file("bad.json", "{\n\"axez\": 1}");
  file("param.json", "{\"params\":\n {\"no-such\": 1}}");
  file("local.json", "{\"vars\":\n {\"1\": 5}}");
  std::filesystem::create_directory(folder_ + "/dir");
  ASSERT_EQ(mkfifo((folder_ + "/fifo").c_str(), 0600), 0);
  const struct {
    const char* line;
    const char* says;
  } cases[] = {
      {"", "subcommand"},
      {"trace", "PROGRAM"},
      {"trace nothing.nc", "nothing.nc: No such file or directory"},
      {"trace fifo", "fifo: is a pipe"},
      {"check --setup dir p.nc", "dir: is a folder"},
      {"trace dir", "dir: is a folder, not a program"},
      {"trace --setup bad.json p.nc", "bad.json:2: axez: no such key"},
      {"trace --setup param.json p.nc", "param.json:2: params.no-such: the control has no such parameter"},
      {"trace --setup local.json p.nc", "local.json:2: vars.1: is a local variable"},
      {"trace --setup none.json p.nc", "none.json: cannot be opened"},
      {"trace --dialect fanuc p.nc", "--dialect fanuc"},
      {"trace --programs nowhere p.nc", "--programs nowhere: not a folder"},
      {"time --config mill.toml p.nc", "mill.toml: limits are JSON (docs/trace.md); the configuration of a machine is --machine mill.toml"},
      {"check nothing.nc", "nothing.nc"},
      {"time nothing.nc", "nothing.nc"},
      {"plot -o none/x p.nc", "none/x.svg"},
      {"functions --dialect fanuc", "--dialect fanuc"},
      {"trace --frobnicate p.nc", "frobnicate"}};
  for (const auto& c : cases) {
    const Outcome run = ncsim(c.line);
    EXPECT_EQ(run.code, 1) << c.line;
    EXPECT_NE(run.err.find(c.says), std::string::npos) << c.line << "\n said: " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.err.rfind("ncsim: ", 0), 0u) << run.err;
  }
}

TEST_F(CommandTest, OutputThatCannotBeWrittenIsExitOne) {
  file("p.nc", kPart);
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const Outcome full = ncsim("trace p.nc > /dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_EQ(full.err, "ncsim: the trace cannot be written: No space left on device\n");
  EXPECT_EQ(ncsim("check p.nc > /dev/full").code, 1);
  std::string longer;
  for (int i = 0; i < 20'000; ++i) longer += "G01 X" + std::to_string(i % 7) + ". F100.\n";
  file("long.nc", longer + "M30\n");
  const Outcome gone = ncsim("trace long.nc | head -c 10 > /dev/null; true");
  EXPECT_EQ(gone.err, "ncsim: the trace cannot be written: Broken pipe\n");
}

TEST_F(CommandTest, SubProgramsFromTheSetupTheFileAndTheFolder) {
  file("main.nc", "M98 P1000\nM98 P2000\nM98 P3000\nM30\nO2000\nG00 X2.\nM99\n");
  file("o3000.NC", "G00 X3.\nM99\n");
  std::filesystem::create_directory(folder_ + "/other");
  file("other/O3000", "G00 X33.\nM99\n");
  file("s.json", R"({"subprograms": {"1000": "O1000\nG00 X1.\nM99\n%"}})");
  const auto ends = [](const Outcome& run) {
    std::vector<double> x;
    for (const Json& e : run.events())
      if (e["t"] == "move") x.push_back(e["work"]["X"].get<double>());
    return x;
  };
  const Outcome run = ncsim("trace --setup s.json main.nc");
  EXPECT_EQ(run.code, 0) << run.out;
  EXPECT_EQ(ends(run), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(ends(ncsim("trace --setup s.json --programs other main.nc")), (std::vector<double>{1, 2, 33}));
  for (const Json& e : run.events()) EXPECT_TRUE(e["t"] != "move" || e["depth"] == 1) << e;
}

TEST_F(CommandTest, AnAlarmInASubProgramNamesItsFile) {
  file("main.nc", "M98 P3000\nM30\n");
  file("O3000.nc", "G00 X3.\nG01 X4.\nM99\n");
  const Outcome check = ncsim("check main.nc");
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.out.rfind("./O3000.nc:2: P62 ", 0), 0u) << check.out;
  EXPECT_NE(check.out.find("\n  main.nc:1: calls O3000\n"), std::string::npos) << check.out;
}

TEST_F(CommandTest, SkipEndsAtTheSolid) {
  file("p.nc", "G91 G31 Z-50. F100.\n#100=#5063\n#101=#5023\nM30\n");
  file("s.json", R"({"skip": [{"box": {"Z": [-40, -12.5]}}]})");
  const Outcome run = ncsim("trace --setup s.json p.nc");
  EXPECT_EQ(run.code, 0) << run.out;
  const auto events = run.events();
  for (const Json& e : events) EXPECT_TRUE(e["t"] != "move" || e["machine"]["Z"] == -12.5) << e;
  EXPECT_EQ(events.back()["vars"]["100"], -12.5);
  EXPECT_EQ(events.back()["vars"]["101"], -12.5);
}

TEST_F(CommandTest, InputsAndEventsReachTheProgram) {
  file("p.nc", "#100=#1000\n#101=#1001\nG04 X1.\n#102=#1001\n#103=#1033\nM30\n");
  file("s.json", R"({"inputs": {"1000": 1}, "events": [{"when": {"line": 4}, "inputs": {"1001": 1}},
                     {"when": {"seconds": 0.5}, "inputs": {"1203": 1}}]})");
  const auto vars = ncsim("trace --setup s.json p.nc").events().back()["vars"];
  EXPECT_EQ(vars["100"], 1);
  EXPECT_EQ(vars["101"], 0);
  EXPECT_EQ(vars["102"], 1);
  EXPECT_EQ(vars["103"], 8);
}

TEST_F(CommandTest, OptionalStopIsAnEventOnlyWithItsSwitch) {
  file("p.nc", "M00\nM01\nM30\n");
  file("s.json", R"({"switches": {"optional_stop": true}})");
  const auto codes = [](const Outcome& run) {
    std::vector<double> list;
    for (const Json& e : run.events())
      if (e["t"] == "aux") list.push_back(e["value"].get<double>());
    return list;
  };
  EXPECT_EQ(codes(ncsim("trace p.nc")), (std::vector<double>{0, 30}));
  EXPECT_EQ(codes(ncsim("trace --setup s.json p.nc")), (std::vector<double>{0, 1, 30}));
}

// A part is measured offline: a macro with four touches measures a bore that is not in its nominal place.
TEST_F(CommandTest, AProbeMeasuresABore) {
  file("p.nc", "G90 G54 G0\nG43 H1 Z-5.\nX0 Y0\nG65 P9010\n#104=[#101+#102]/2\n#105=#102-#101+6\nM30\n");
  file("O9010.nc", "G31 X-40. F200\n#101=#5061\nG0 X0\nG31 X40. F200\n#102=#5061\nG0 X0\nG31 Y-1. F200\nM99\n");
  file("s.json", R"({"work_offsets": {"G54": {"X": 300, "Y": -120, "Z": -400}}, "offsets": {"1": 80},
    "skip": [{"coordinates": "work", "ball": {"radius": 3}, "box": {"X": [-50, 50], "Y": [-50, 50], "Z": [-20, 0]},
              "holes": [{"cylinder": {"axis": "Z", "center": {"X": 0.25, "Y": 0}, "radius": 20}}]}]})");
  const Outcome run = ncsim("trace --setup s.json p.nc");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  std::vector<bool> skipped;
  for (const Json& e : run.events()) {
    if (e["t"] != "move") continue;
    EXPECT_EQ(e.contains("skipped"), e["kind"] == "skip") << e;
    if (e.contains("skipped")) skipped.push_back(e["skipped"].get<bool>());
  }
  EXPECT_EQ(skipped, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(run.events().back()["vars"]["104"].get<double>(), 0.25);
  EXPECT_EQ(run.events().back()["vars"]["105"].get<double>(), 40);
  EXPECT_EQ(run.err, "");
  // On the virtual machine the same solid ends the moves, within a cycle of their feed.
  const Outcome time = ncsim("time --motion trapezoid --setup s.json p.nc");  // the path beyond a touch is that of the braking
  EXPECT_EQ(time.code, 0) << time.err;
  EXPECT_NEAR(std::stod(time.out.substr(time.out.find("path length") + 12)), 717.11, 0.1);
}

TEST_F(CommandTest, WhatASetupGivesInVainIsNoted) {
  file("p.nc", "G31 X10. F100\nM30\n");
  file("s.json", "{\"hits\": [{\"at\": {\"X\": 4}},\n {\"at\": {\"X\": 5}}],\n \"events\": [{\"when\": {\"m\": 6}, \"inputs\": {\"1000\": 1}}]}");
  for (const char* command : {"trace", "check", "time", "motion"}) {
    const Outcome run = ncsim(std::string(command) + " --setup s.json p.nc");
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "note: s.json:3: events[0]: has not fired: M6 was not given out\nnote: s.json:2: hits[1]: no skip move came to take it\n");
  }
  file("e.json", R"({"events": [{"when": {"m": 6}, "inputs": {"1000": 1}}, {"when": {"m": 30}, "inputs": {"1001": 1}}]})");
  const Outcome events = ncsim("time --setup e.json p.nc");
  EXPECT_EQ(events.code, 0) << events.err;
  EXPECT_EQ(events.err, "note: e.json:1: events[0]: has not fired: M6 was not given out\n");
}

TEST_F(CommandTest, EncodingsOfPrograms) {
  file("l.nc", "#3006=1(FR\xC4SER \xD8" "20)\nM30\n");
  Outcome run = ncsim("trace --encoding latin-1 l.nc");
  EXPECT_EQ(run.events()[0]["text"], "FR\u00c4SER \u00d8" "20") << run.out;
  run = ncsim("trace l.nc");
  EXPECT_EQ(run.events()[0]["text"], "FR\ufffdSER \ufffd" "20") << run.out;
  // The second bytes of these characters are a backslash, a bracket and a letter.
  file("j.nc", "#3006=1(\x95\x5C \x83\x5B \x83\x41)\nG0 X1.\nM30\n");
  run = ncsim("trace --encoding shift-jis j.nc");
  EXPECT_EQ(run.events()[0]["text"], "\u8868 \u30bc \u30a2") << run.out;
  EXPECT_EQ(ncsim("check --encoding ebcdic l.nc").code, 1);
  file("a.nc", "#3000=5(FR\xC4SER)\nM30\n");
  run = ncsim("check --encoding latin-1 a.nc");
  EXPECT_NE(run.out.find("FR\u00c4SER"), std::string::npos) << run.out;
}

TEST_F(CommandTest, FilesAsTheyComeFromOldMachines) {
  constexpr char kTape[] = "\0\0\0%\rO1\rG0 X1.\rN5\x7f G0 X2.\rM30\r%\r";
  file("cr.nc", std::string(kTape, sizeof kTape - 1));
  Outcome run = ncsim("trace cr.nc");
  EXPECT_EQ(run.code, 0) << run.out;
  EXPECT_EQ(run.events().back()["work"]["X"], 2);
  EXPECT_EQ(run.events().back()["line"], 5);
  const std::string name(252, 'n');
  file(name + ".nc", "G0 X7.\nM30\n");
  run = ncsim("trace " + name + ".nc");
  EXPECT_EQ(run.events().back()["work"]["X"], 7) << run.err;
}

TEST_F(CommandTest, CheckNotesNumbersThatWereHardlyMeant) {
  const auto notes = [&](const std::string& text, const std::string& setup = "{}") {
    file("p.nc", text);
    file("s.json", setup);
    const Outcome run = ncsim("check --setup s.json p.nc");
    EXPECT_EQ(run.code, 0) << run.out;
    return run.err;
  };
  std::string note = notes("G90 G1 X1.5 F100\nG1 X10 Y20\nZ0\nM30\n");
  EXPECT_NE(note.find("note: p.nc:2: X10 and 1 more number without a decimal point are"), std::string::npos) << note;
  EXPECT_EQ(notes("G90 G1 X1.5 F100\nG1 X10 Y20\nM30\n", R"({"params": {"1078": 1}})"), "");
  note = notes("G90 G1 X10000 F100\nG1 X10 Y-25000\nM30\n");
  EXPECT_NE(note.find("note: p.nc: all numbers are without a decimal point, 3 from line 1 on"), std::string::npos) << note;
  EXPECT_NE(note.find("the largest is Y-25000"), std::string::npos) << note;
  EXPECT_EQ(note.find("#1078"), std::string::npos) << "thousandths throughout are told, not blamed: " << note;
  EXPECT_EQ(notes("G90 G1 X10000 F100\nM30\n", R"({"params": {"1078": 1}})"), "");
  EXPECT_NE(notes("G90 G1 X10 F100\nG1 X50 Y20\nM30\n"), "") << "a part of 0.05 mm";
  EXPECT_EQ(notes("G90 G1 X1. F100 (X10)\nX0 Y-0\nG65 P9 X10\nM30\nO9\nM99\n"), "") << "an argument";
  // A single word has a note without plural. A value behind a comma is a length (M700 13.7), and so are some data of G10 (12.7, 14.10), but not
  // a parameter or a percentage.
  const std::string one = " without a decimal point is read";
  EXPECT_NE(notes("G90 G1 X1. F100\nX20\nM30\n").find(":2: X20" + one), std::string::npos);
  EXPECT_NE(notes("G90 G1 X9. F100,R2\nY9.\nM30\n").find(":1: ,R2" + one), std::string::npos);
  EXPECT_NE(notes("G90 G1 X9. ,C1 F100\nY9.\nM30\n").find(":1: ,C1" + one), std::string::npos);
  EXPECT_NE(notes("G10 L2 P1 X1. Y5\nM30\n").find(":1: Y5" + one), std::string::npos);
  EXPECT_NE(notes("G10 L20 P1 X1. Y5\nM30\n").find(":1: Y5" + one), std::string::npos);
  EXPECT_NE(notes("G10 L10 P1 R5\nG0 X1.\nM30\n").find(":1: R5" + one), std::string::npos);
  EXPECT_EQ(notes("G0 X1.\nG10 L14 X80\nM30\n"), "");
  EXPECT_EQ(notes("G0 X1.\nG10 L70\nP8004 D10\nG11\nM30\n"), "");
  note = notes("G4 P1.00000\nG04 P2.5\nG04 P500\nG04 X1.\nM30\n");
  EXPECT_NE(note.find("note: p.nc:1: P1.00000 of a dwell counts milliseconds"), std::string::npos) << note;
  EXPECT_NE(note.find("; 1 more dwell\n"), std::string::npos) << note;
  EXPECT_EQ(notes("G4 P1.00000\nM30\n", R"({"params": {"8112": 1}})"), "");
}

// Families that have no parameter for it: the program is one of another family, which is said as it is where it has an alarm.
TEST_F(CommandTest, CheckNotesNumbersOfAnotherFamily) {
  file("p.ngc", "g20 g64\ng0z1\ng0x0y0\ng1z-.1f24\ng1x1.5y2\nm30\n");
  const Outcome hx = ncsim("check --dialect hx p.ngc");
  EXPECT_EQ(hx.code, 0) << hx.out;
  EXPECT_NE(hx.err.find("note: p.ngc:2: Z1 and 1 more number without a decimal point are read in the least command unit"), std::string::npos) << hx.err;
  EXPECT_NE(hx.err.find("note: this looks like a program of iso, as which it ends without an alarm; try --dialect iso\n"), std::string::npos) << hx.err;
  EXPECT_EQ(ncsim("check --dialect iso p.ngc").err, "");
  file("p.nc", "%\nG21G90\nG00X1.5\nX7\nM30\n");
  EXPECT_NE(ncsim("check --dialect dgshape p.nc").err.find("note: p.nc:4: X7 without a decimal point is read"), std::string::npos);
  file("s.json", R"({"params": {"interpretation": "calculator"}})");
  EXPECT_EQ(ncsim("check --dialect dgshape --setup s.json p.nc").err, "");
  file("p.nc", "G83 X75. Y50. Z-70. R5. Q6 F100.\nM30\n");
  EXPECT_NE(ncsim("check --dialect hx p.nc").err.find("note: p.nc:1: Q6 without a decimal point is read"), std::string::npos) << "a peck of six thousandths";
  file("p.nc", "G00 X10000\nX20000\nM30\n");
  EXPECT_EQ(ncsim("check --dialect hx p.nc").err.find("looks like"), std::string::npos) << "thousandths throughout";
}

TEST_F(CommandTest, VariablesOfAProgram) {
  file("p.nc", "#500=#5001\nM98 P7\nM98 P8\nM98 P#500\nO7 #1100=1\nM99\n");
  file("O8", "#[#1+2]=#1000\n#500=1\nM99\n");
  const Outcome run = ncsim("variables --of p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  for (const char* line : {"#500\tcommon variable\tp.nc:4\tp.nc:1\n", "#5001\t", "#1000\t", "\t\tp.nc:5\n", "#[#1+2]\tcomputed\t\t./O8:1\n"})
    EXPECT_NE(run.out.find(line), std::string::npos) << line << run.out;
  // Which common variables there are the dialect says.
  file("q.nc", "#100=1\n#250=1\n#999=1\n#1200=1\n#900000=1\n#34=1\n#999999999=1\nM30\n");
  const std::string m700 = ncsim("variables --of q.nc").out, hx = ncsim("variables --dialect hx --of q.nc").out, iso = ncsim("variables --dialect iso --of q.nc").out;
  EXPECT_NE(m700.find("#100\tcommon variable\t"), std::string::npos) << m700;
  EXPECT_NE(m700.find("#250\tcommon variable of a machine\t"), std::string::npos) << m700;
  EXPECT_NE(m700.find("#999\tcommon variable\t"), std::string::npos) << m700;
  EXPECT_NE(m700.find("#900000\tcommon variable\t"), std::string::npos) << m700;
  EXPECT_NE(m700.find("#999999999\t\t"), std::string::npos) << m700;
  EXPECT_NE(hx.find("#250\tcommon variable\t"), std::string::npos) << hx;
  EXPECT_NE(hx.find("#999\tcommon variable of a machine\t"), std::string::npos) << hx;
  EXPECT_NE(iso.find("#34\tcommon variable\t"), std::string::npos) << iso;
  EXPECT_NE(run.err.find("p.nc:4: the number of the program called is computed"), std::string::npos) << run.err;
  EXPECT_EQ(ncsim("variables --of nowhere.nc").code, 1);
  EXPECT_EQ(ncsim("variables --programs .").code, 1);
}

TEST_F(CommandTest, TimeSaysThatASpindleIsMissing) {
  file("p.nc", "G95 G1 X10. F0.2\nM30\n");
  const Outcome run = ncsim("time p.nc");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("waits for the spindle"), std::string::npos) << run.err;
  file("p.nc", "S600 M3\nG95 G1 X10. F0.2\nM30\n");
  EXPECT_EQ(ncsim("time p.nc").code, 0);
}

TEST_F(CommandTest, TheOptimalModeRefusesALineOfHeldAxes) {  // M700 6.16: it moves nothing, but takes its time in the other mode
  file("p.nc", "G7 Y0\nG1 Y10. F600\nM30\n");
  const Outcome run = ncsim("time --limits 250,2000,50000 --tolerance 0.01 p.nc");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.out.find("P29"), std::string::npos) << run.out;
  EXPECT_EQ(ncsim("time --limits 250,2000,50000 --motion trapezoid p.nc").code, 0);
  file("p.nc", "G7 Y0\nG1 X5. Y10. F600\nG2 J5. F600\nM30\n");
  EXPECT_EQ(ncsim("time --limits 250,2000,50000 --tolerance 0.01 p.nc").code, 0);
}

TEST_F(CommandTest, TheLawOfMotionIsTheOptimalOneWhereEveryAxisHasAJerk) {
  file("p.nc", "G1 X10. F6000\nY10.\nX0\nY0\nM30\n");
  const auto time = [&](const char* options) { return ncsim(std::string("time ") + options + " p.nc").out; };
  EXPECT_EQ(time(""), time("--motion optimal --tolerance 0.01"));
  EXPECT_EQ(time(""), time("--tolerance 0.01"));
  EXPECT_NE(time(""), time("--motion trapezoid"));
  EXPECT_EQ(time("--limits 250,2000,0"), time("--motion trapezoid"));
  EXPECT_EQ(ncsim("time --limits 250,2000,0 --motion optimal p.nc").err,
            "ncsim: --motion optimal: the time-optimal mode needs limits of velocity, acceleration and jerk of every axis, X has no max_jerk\n");
  std::string machine = "[machine]\nname = \"m\"\n";
  for (const char* axis : {"X", "Y", "Z"}) machine += std::string("[[axis]]\nname = \"") + axis + "\"\nmax_velocity = 250.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\n";
  file("m.toml", machine);
  file("t.toml", machine + "[motion]\nmode = \"trapezoid\"\n");
  EXPECT_EQ(ncsim("check --machine m.toml p.nc").err, "note: motion: optimal: every axis has limits of velocity, acceleration and jerk\n");
  EXPECT_EQ(ncsim("check --machine t.toml p.nc").err, "note: motion: trapezoid, as it is configured\n");
  EXPECT_EQ(time("--machine t.toml --motion optimal"), time("--machine m.toml"));
  EXPECT_EQ(time("--machine m.toml --limits 250,2000,0"), time("--machine t.toml"));  // the resulting limits choose the mode
}

TEST_F(CommandTest, AProgramThatOnlyRunsOnIsNoEndlessLoop) {
  std::string blanks = "O1\n", standing = "O1 G1 F100 X0\n";
  for (unsigned i = 0; i < 30000; ++i) blanks += "\n", standing += "X0\n";
  for (const std::string& text : {blanks, standing}) {
    file("p.nc", text + "M30\n");
    const Outcome run = ncsim("check --max-silent-blocks 10000 p.nc");
    EXPECT_EQ(run.code, 0) << run.err;
  }
}

TEST_F(CommandTest, ASubcommandThatDoesNotExistIsNamed) {
  EXPECT_EQ(ncsim("foo").err, "ncsim: there is no subcommand 'foo' (ncsim --help)\n");
  EXPECT_NE(ncsim("trace /").err.find("/: is a folder, not a program"), std::string::npos);
}

TEST_F(CommandTest, TimeOfAMoveIsThatOfItsLimits) {
  file("p.nc", "G00 X500.\nM30\n");
  file("m.json", R"({"axes": {"X": {"velocity": 100, "acceleration": 1000, "jerk": 1000000}}})");
  const Outcome run = ncsim("time --config m.json p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  double seconds = 0, length = 0;
  ASSERT_EQ(std::sscanf(run.out.c_str(), "cycle time %lf s", &seconds), 1) << run.out;
  const size_t at = run.out.find("path length");
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(std::sscanf(run.out.c_str() + at, "path length %lf mm", &length), 1);
  EXPECT_NEAR(length, 500.0, 1e-3);
  EXPECT_GT(seconds, 5.0);   // 500 mm at 100 mm/s ...
  EXPECT_LT(seconds, 5.25);  // ... and 0.1 s for the ramps, the end of the program in some cycles
}

TEST_F(CommandTest, MaxSecondsIsANumberOfSeconds) {
  file("p.nc", kPart);
  for (const std::string value : {"nan", "inf", "0", "-1", "1e400", "1e10"}) {
    const Outcome run = ncsim("time --max-seconds=" + value + " p.nc");
    EXPECT_EQ(run.code, 1) << value;
    EXPECT_NE(run.err.find("--max-seconds: must be above 0 and at most 1e9, is " + value), std::string::npos)
        << run.err;
  }
  EXPECT_EQ(ncsim("time --max-seconds 1e9 p.nc").code, 0);
}

TEST_F(CommandTest, OptionsRefuseBadValuesWithASentence) {
  file("p.nc", kPart);
  const struct {
    const char* arguments;
    const char* says;
  } rows[] = {
      {"check p.nc --max-silent-blocks=-1", "--max-silent-blocks: must be a whole number from 0 to 1000000000000000000, is -1"},
      {"check p.nc --max-silent-blocks 1.5", "--max-silent-blocks: must be a whole number"},
      {"trace p.nc --max-silent-blocks 0x10", "--max-silent-blocks: must be a whole number"},
      {"plot p.nc --max-silent-blocks 99999999999999999999999", "--max-silent-blocks: must be a whole number"},
      {"check p.nc --max-silent-blocks ''", "--max-silent-blocks: must be a whole number"},
      {"plot p.nc --view foo", "--view: must be one of iso, xy, xz, yz, is foo"},
      {"plot p.nc --view 2", "--view: must be one of iso, xy, xz, yz, is 2"},
      {"plot p.nc --view ''", "--view: must be one of iso, xy, xz, yz, is empty"},
      {"plot p.nc --color red", "--color: must be one of kind, tool, feed, z, is red"},
      {"plot p.nc --coordinates part", "--coordinates: must be one of work, machine, is part"},
      {"plot p.nc -o ''", "--output: must not be empty"},
      {"trace p.nc --setup ''", "--setup: must not be empty"},
      {"trace p.nc --programs ''", "--programs: must not be empty"},
      {"trace p.nc --dialect ''", "--dialect: must not be empty"},
      {"trace p.nc --dialect foo", "--dialect foo: this version knows m700, dgshape, iso, hx and series8"},
      {"time p.nc --limits-file ''", "--limits-file: must not be empty"},
      {"time p.nc --max-seconds ''", "--max-seconds: must be above 0"},
      {"motion p.nc --limits 1,2", "--limits: must be three numbers, velocity,acceleration,jerk, is 1,2"},
      {"motion p.nc --limits 1,2,3,4", "--limits: must be three numbers"},
      {"motion p.nc --limits '1, 2,3'", "--limits: must be three numbers"},
      {"motion p.nc --limits ''", "--limits: must be three numbers, velocity,acceleration,jerk, is empty"},
      {"motion p.nc --limits nan,1,1", "--limits: must be three numbers"},
      {"motion p.nc --limits=-1,1,1", "--limits: each must be from 0.001 to 1e9"},
      {"time p.nc --limits 1,0,1", "--limits: each must be from 0.001 to 1e9"},
      {"motion p.nc --cycle-us 9", "--cycle-us: must be a whole number from 10 to 100000, is 9"},
      {"motion p.nc --cycle-us 1e3", "--cycle-us: must be a whole number from 10 to 100000, is 1e3"},
      {"motion p.nc --format xml", "--format: must be one of csv, f64, is xml"},
      {"motion p.nc -o ''", "--output: must not be empty"},
      {"motion p.nc --machine ''", "--machine: must not be empty"},
      {"motion p.nc --machine none.toml", "none.toml: cannot be read"},
      {"motion p.nc --machine p.nc", "p.nc:1: syntax"},
      {"motion p.nc --machine m.toml --config m.json", "--machine excludes --limits-file"},
      {"plot p.nc --limits 1,1,1", "--limits requires --profile"},
      {"plot p.nc --profile --view xy", "--profile excludes --view"},
      {"plot p.nc --profile --coordinates work", "--profile excludes --coordinates"},
      {"trace ''", "PROGRAM: must not be empty"},
      {"functions --dialect foo", "--dialect foo: this version knows"},
  };
  for (const auto& row : rows) {
    const Outcome run = ncsim(row.arguments);
    EXPECT_EQ(run.code, 1) << row.arguments;
    EXPECT_EQ(run.out, "") << row.arguments;
    EXPECT_NE(run.err.find(row.says), std::string::npos) << row.arguments << ": " << run.err;
  }
  EXPECT_EQ(ncsim("check p.nc --max-silent-blocks 0009").code, 0);
  EXPECT_EQ(ncsim("plot p.nc --view XZ").code, 0);
}

TEST_F(CommandTest, WhatCannotBeWrittenIsAnErrorOfEveryCommand) {
  file("p.nc", kPart);
  for (const char* command :
       {"trace p.nc", "check p.nc", "time p.nc", "motion p.nc", "motion --format f64 p.nc", "plot p.nc",
        "plot --profile p.nc", "functions", "alarms", "--help", "--version"}) {
    const Outcome run = ncsim(std::string(command) + " > /dev/full");
    EXPECT_EQ(run.code, 1) << command;
    EXPECT_NE(run.err.find("cannot be written"), std::string::npos) << command << ": " << run.err;
  }
}

// It is found before the program is read, which would be another error, as it does not exist.
TEST_F(CommandTest, AnUnwritablePlotIsFoundBeforeTheRun) {
  for (const char* base : {"none/x", "/dev/null/x"}) {
    const Outcome run = ncsim(std::string("plot -o ") + base + " no-such-program.nc");
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find(std::string(base) + ".svg: cannot be written: "), std::string::npos) << run.err;
  }
  std::filesystem::create_directory(folder_ + "/y.png");
  const Outcome run = ncsim("plot -o y no-such-program.nc");
  EXPECT_NE(run.err.find("y.png: cannot be written: "), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/y.svg")) << "the check leaves nothing behind";
  file("z.svg", "old");
  ncsim("plot -o z no-such-program.nc");
  EXPECT_EQ(content(folder_ + "/z.svg"), "old");
}

TEST_F(CommandTest, AByteOrderMarkAtTheStartOfAProgramIsNotThere) {
  const std::string mark = "\xEF\xBB\xBF";
  file("plain.nc", kPart);
  file("p.nc", mark + kPart);
  const std::string plain = ncsim("trace plain.nc").out;
  EXPECT_EQ(ncsim("trace p.nc").out, plain);
  EXPECT_EQ(ncsim("trace - < p.nc").out, plain);
  EXPECT_EQ(ncsim("trace /dev/stdin < p.nc").code, 0);
  ASSERT_EQ(std::system(
                ("cd " + folder_ + " && cat p.nc | " + nc::test::kBinaryDir + "/bin/ncsim trace - > pipe.txt").c_str()),
            0);
  EXPECT_EQ(content(folder_ + "/pipe.txt"), plain);
  file("jis.nc", mark + "%\nG00X1.\nM02\n");
  EXPECT_EQ(ncsim("check --dialect dgshape jis.nc").code, 0);
  file("sub.nc", "G90 G0 X1.\nM98 P77\nM30\n");
  file("O77.nc", mark + "G0 X2.\nM99\n");
  EXPECT_EQ(ncsim("check sub.nc").code, 0);
  file("short.nc", "\xEF\xBB");  // no mark: the program is what stands there
  EXPECT_NE(ncsim("check short.nc").code, 0);
  file("line.json", "{\"events\": [{\"when\": {\"line\": 4}, \"inputs\": {\"1000\": 1}}]}");
  EXPECT_EQ(ncsim("trace --setup line.json p.nc").out, ncsim("trace --setup line.json plain.nc").out);
}

TEST_F(CommandTest, PlotWritesBothFiles) {
  file("p.nc", kPart);
  const Outcome run = ncsim("plot -o drawing --view xy p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(content(folder_ + "/drawing.png").substr(1, 3), "PNG");
  const std::string svg = content(folder_ + "/drawing.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(ncsim("plot -o again --view xy p.nc").code, 0);
  EXPECT_EQ(svg == content(folder_ + "/again.svg"), true) << "two runs give the same bytes";
}

TEST_F(CommandTest, APlotSaysToolFeedAndZByItsColour) {
  file("p.nc", "T1 M06\nT2\nG0 X0 Y0 Z0\nG1 X10. F100\nM06\nX20. Z-5. F200\nM30\n");
  const auto colors = [this](const std::string& color) {
    EXPECT_EQ(ncsim("plot -o drawing --color " + color + " p.nc").code, 0);
    const std::string svg = content(folder_ + "/drawing.svg");
    std::set<std::string> all;
    for (size_t at = svg.find("stroke:rgb("); at != std::string::npos; at = svg.find("stroke:rgb(", at + 1))
      all.insert(svg.substr(at, svg.find(')', at) - at + 1));
    return all;
  };
  const std::set<std::string> kind = colors("kind"), tool = colors("tool"), feed = colors("feed"), z = colors("z");
  EXPECT_EQ(kind.count("stroke:rgb(5%,30%,75%)"), 1u);
  EXPECT_EQ(tool.count("stroke:rgb(0%,55%,30%)"), 1u) << "the second tool cuts behind its M06";
  EXPECT_EQ(feed.count("stroke:rgb(27%,0%,33%)"), 1u) << "the lowest feed";
  EXPECT_EQ(feed.count("stroke:rgb(90%,80%,10%)"), 1u) << "the highest feed";
  EXPECT_EQ(z.count("stroke:rgb(90%,80%,10%)"), 1u);
  EXPECT_EQ(z.count("stroke:rgb(5%,30%,75%)"), 0u);
}

// A drawing by sides shows that of G41 or G42, also on a way in that comes from the other side of the wall, and on the way out. The legend has one line of
// each colour.
TEST_F(CommandTest, APlotOfCompensationHasTheSideOfTheCode) {
  const auto strokes = [this](const std::string& text, const std::string& color) {
    file("p.nc", "G90 G94\nG10 L10 P1 R3.\nG10 L10 P2 R-3.\nF500\n" + text + "M30\n");
    EXPECT_EQ(ncsim("plot -o drawing --view xy --compensation p.nc").code, 0) << text;
    const std::string svg = content(folder_ + "/drawing.svg");
    size_t count = 0;
    for (size_t at = svg.find(color); at != std::string::npos; at = svg.find(color, at + 1)) ++count;
    return count;
  };
  const char* const none = "stroke:rgb(5%,30%,75%)";
  const char* const left = "stroke:rgb(0%,55%,30%)";
  const char* const right = "stroke:rgb(90%,55%,0%)";
  const char* const space = "stroke:rgb(50%,20%,65%)";
  const char* const walls[] = {"G17\nG0 X-10. Y20.\nG41 D1 G1 X0 Y0\nY20.\nX20.\nY0\nG40 X10. Y-10.\n", "G18\nG0 Z-10. X20.\nG41 D1 G1 Z0 X0\nX20.\nZ20.\nX0\nG40 Z10. X-10.\n"};
  for (const std::string text : walls) {
    EXPECT_GT(strokes(text, left), 1u) << text;
    EXPECT_EQ(strokes(text, right), 1u) << text;
    EXPECT_EQ(strokes(text, none), 1u) << text;
    for (const char* other : {"G42 D1", "G41 D2"}) {  // a negative amount changes the sides
      std::string opposite = text;
      opposite.replace(opposite.find("G41 D1"), 6, other);
      EXPECT_EQ(strokes(opposite, left), 1u) << opposite;
      EXPECT_GT(strokes(opposite, right), 1u) << opposite;
      EXPECT_EQ(strokes(opposite, none), 1u) << opposite;
    }
  }
  // A vector in space leads beside nothing; it lifts the tool here, or lies in the plane.
  for (const char* vector : {"I0 J0 K1.", "I1. J0 K0", "I1. J1. K1."}) {
    const std::string text = "G17\nG0 X-10. Y20.\nG41 D1 G1 X0 Y0 " + std::string(vector) + "\nY20.\nX20.\nG40 X10. Y-10.\n";
    EXPECT_GT(strokes(text, space), 1u) << text;
    EXPECT_EQ(strokes(text, left), 1u) << text;
    EXPECT_EQ(strokes(text, right), 1u) << text;
    EXPECT_EQ(strokes(text, none), 1u) << text;
  }
}

// The clamping position of a part and the lengths of the tools change nothing in a drawing in workpiece coordinates, but much in one in machine
// coordinates.
TEST_F(CommandTest, APlotShowsThePartWhereverItIsClamped) {
  const std::string cuts = "G54 G0 X0 Y0\nG43 H1 Z5.\nG1 Z-5. F500\nX30.\nG2 X40. Y10. R10.\nG0 Z5.\nG43 H2 Z4.\nG1 Z-5.\nY20.\nM30\n";
  file("near.nc", "G10 L2 P1 X0 Y0 Z0\nG10 L10 P1 R0\nG10 L10 P2 R0\n" + cuts);
  file("near.json", "{\"start\": {\"X\": 10, \"Y\": 0, \"Z\": 20}}");
  file("far.nc", "G10 L2 P1 X-300. Y-200. Z-150.\nG10 L10 P1 R50.\nG10 L10 P2 R68.\n" + cuts);
  file("far.json", "{\"start\": {\"X\": -290, \"Y\": -200, \"Z\": -130}}");
  const auto drawing = [this](const std::string& name, const std::string& coordinates) {
    EXPECT_EQ(ncsim("plot -o " + name + " --view xz --setup " + name + ".json --coordinates " + coordinates + " " + name + ".nc").code, 0);
    const std::string svg = content(folder_ + "/" + name + ".svg");
    std::string lines;  // the path and the frame, not the title and the numbers
    for (size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) {
      const std::string path = svg.substr(at, svg.find("/>", at) - at);
      if (path.find("stroke:rgb(") != std::string::npos) lines += path + "\n";
    }
    EXPECT_GT(lines.size(), 500u);
    return lines;
  };
  EXPECT_TRUE(drawing("near", "work") == drawing("far", "work"));
  EXPECT_FALSE(drawing("near", "machine") == drawing("far", "machine"));
}

// A row of a recorded motion: the time, then the position of each axis.
using Row = std::vector<double>;

std::vector<Row> csv_rows(const std::string& text, std::string* head) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, *head);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

double seconds_of(const std::string& text) {
  double seconds = -1;
  std::sscanf(text.c_str(), "cycle time %lf s", &seconds);  // NOLINT(cert-err34-c): -1 says that it failed
  return seconds;
}

TEST_F(CommandTest, MotionIsARowForEveryCycleOfTheTime) {
  file("p.nc", kPart);
  file("stops.nc", "G00 X1.\nM00\nG04 X0.25\nG01 X2. F60.\nM01\nM03 S100\nM30\n");
  for (const char* program : {"p.nc", "stops.nc"})
    for (const std::string us : {"1000", "250", "333"}) {
      const Outcome motion = ncsim(std::string("motion --cycle-us ") + us + " " + program);
      EXPECT_EQ(motion.code, 0) << motion.err;
      std::string head;
      const std::vector<Row> rows = csv_rows(motion.out, &head);
      EXPECT_EQ(head, "t,X,Y,Z");
      const double seconds = seconds_of(ncsim(std::string("time --cycle-us ") + us + " " + program).out);
      ASSERT_GT(rows.size(), 100u);
      EXPECT_NEAR(static_cast<double>(rows.size() - 1) * std::stod(us) * 1e-6, seconds, 1e-9) << program << " " << us;
      EXPECT_NEAR(rows.back()[0], seconds, 1e-9);
      for (size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), 4u);
        ASSERT_NEAR(rows[i][0], static_cast<double>(i) * std::stod(us) * 1e-6, 1e-9);
      }
    }
  std::string head;
  EXPECT_EQ(csv_rows(ncsim("motion p.nc").out, &head).back(), (Row{seconds_of(ncsim("time p.nc").out), 20, -5, -1}));
}

TEST_F(CommandTest, MotionHasTwelveDecimalsAndNoNegativeZero) {
  file("p.nc", "G00 X-1. Y0.\nG01 X0. F600.\nM30\n");
  const Outcome run = ncsim("motion p.nc");
  EXPECT_EQ(run.out.find("-0.000000000000"), std::string::npos);
  EXPECT_NE(run.out.find("\n0.001,"), std::string::npos);
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    for (size_t at = line.find(','); at != std::string::npos; at = line.find(',', at + 1)) {
      const size_t point = line.find('.', at), end = std::min(line.find(',', at + 1), line.size());
      ASSERT_EQ(end - point, 13u) << line;
    }
  }
  EXPECT_EQ(ncsim("motion p.nc").out, run.out) << "two runs give the same bytes";
}

TEST_F(CommandTest, RawMotionIsTheSameRows) {
  file("p.nc", kPart);
  std::string head;
  const std::vector<Row> rows = csv_rows(ncsim("motion p.nc").out, &head);
  EXPECT_EQ(ncsim("motion --format F64 -o raw p.nc").out, "");
  const std::string raw = content(folder_ + "/raw");
  ASSERT_EQ(raw.size(), rows.size() * 4 * sizeof(double));
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t k = 0; k < 4; ++k) {
      double value = 0;  // this machine is little-endian too
      std::memcpy(&value, raw.data() + (i * 4 + k) * sizeof value, sizeof value);
      ASSERT_NEAR(value, rows[i][k], 1e-9);
    }
}

TEST_F(CommandTest, MotionUntilAnAlarmIsExitTwo) {
  file("p.nc", "G00 X1.\nG01 X2.\nM30\n");  // no F: P62
  const Outcome run = ncsim("motion p.nc");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err.rfind("p.nc:2: P62 ", 0), 0u) << run.err;
  std::string head;
  EXPECT_EQ(csv_rows(run.out, &head).back()[1], 1.0);
}

TEST_F(CommandTest, MotionThatCannotBeWrittenIsExitOne) {
  file("p.nc", kPart);
  EXPECT_EQ(ncsim("motion -o none/x no-such-program.nc").err, "ncsim: none/x: cannot be written: No such file or directory\n");
  EXPECT_EQ(ncsim("motion -o /dev/full p.nc").err, "ncsim: /dev/full cannot be written: No space left on device\n");
  EXPECT_EQ(ncsim("motion p.nc > /dev/full").err, "ncsim: the motion cannot be written: No space left on device\n");
}

TEST_F(CommandTest, LimitsOfTheCommandLineHoldForEveryAxis) {
  file("p.nc", "G00 X500.\nM30\n");
  file("m.json", R"({"axes": {"X": {"velocity": 5}}})");
  const double slow = seconds_of(ncsim("time --config m.json p.nc").out);
  EXPECT_GT(slow, 100.0);
  const double fast = seconds_of(ncsim("time --config m.json --limits 100,1000,1e9 p.nc").out);
  EXPECT_GT(fast, 5.0);
  EXPECT_LT(fast, 5.25);
}

TEST_F(CommandTest, AMachineConfigurationGivesAxesLimitsAndStart) {
  file("p.nc", "G90 G53 G00 X-100. C90.\nM30\n");
  std::string machine = "[machine]\nname = \"m\"\ncycle_us = 500\n";
  for (const char* axis : {"X", "C"})
    machine += std::string("[[axis]]\nname = \"") + axis + "\"\n" + (*axis == 'C' ? "rotary = true\nspindle = 1\n" : "") +
               "rapid = 100.0\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 50000.0\nin_position = 0.01\nstart = -10.0\n";
  file("m.toml", machine);
  const Outcome run = ncsim("motion --machine m.toml p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  std::string head;
  const std::vector<Row> rows = csv_rows(run.out, &head);
  EXPECT_EQ(head, "t,X,C");
  ASSERT_GT(rows.size(), 1000u);
  EXPECT_EQ(rows.front(), (Row{0, -10, -10}));
  EXPECT_EQ(rows[1][0], 0.0005);
  EXPECT_EQ(rows.back()[1], -100);
  EXPECT_EQ(rows.back()[2], 90);
  file("s.json", R"({"axes": ["X", "Y"]})");
  EXPECT_EQ(ncsim("time --machine m.toml --setup s.json p.nc").err, "ncsim: s.json: axes: are not those of m.toml\n");
  file("start.json", R"({"start": {"C": 45}})");
  EXPECT_EQ(csv_rows(ncsim("motion --machine m.toml --setup start.json p.nc").out, &head).front(), (Row{0, -10, 45}));
  EXPECT_EQ(ncsim("time --dialect dgshape --machine m.toml p.nc").err,
            "ncsim: --dialect dgshape: m.toml is a machine of another dialect\n");
}

TEST_F(CommandTest, AMachineConfigurationHasItsStrokeLimitsInTheTraceToo) {
  std::string machine = "[machine]\nname = \"m\"\n";
  for (const char* axis : {"X", "Y", "Z"})
    machine += std::string("[[axis]]\nname = \"") + axis + "\"\nrapid = 100.0\nmax_velocity = 100.0\nmax_acceleration = 1000.0\n" +
               "max_jerk = 50000.0\nin_position = 0.01\nsoft_limits = [-50.0, 50.0]\nstart = -10.0\n";
  file("m.toml", machine);
  file("p.nc", "G90 G53 G0 X40.\nM3 X60.\nM30\n");
  EXPECT_EQ(ncsim("check p.nc").code, 0);
  const Outcome check = ncsim("check --machine m.toml p.nc");
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.out.substr(0, 15), "p.nc:2: M01-000");
  const Outcome trace = ncsim("trace --machine m.toml p.nc");
  EXPECT_EQ(trace.code, 2);
  EXPECT_EQ(trace.events()[0]["machine"]["Y"], -10);
  for (const Json& event : trace.events()) EXPECT_NE(event["t"], "m");
  EXPECT_EQ(ncsim("plot --machine m.toml p.nc").code, 2);
  EXPECT_EQ(ncsim("plot --limits 1,1,1 p.nc").code, 1);  // an option of --profile
  EXPECT_EQ(ncsim("check --machine none.toml p.nc").code, 1);
  EXPECT_EQ(ncsim("trace --dialect dgshape --machine m.toml p.nc").err,
            "ncsim: --dialect dgshape: m.toml is a machine of another dialect\n");
}

TEST_F(CommandTest, CheckNotesWhatLimitsTheMachineAndWhatHasNoEffect) {
  std::string machine = "[machine]\nname = \"m\"\n";
  for (const char* axis : {"X", "Y", "Z"})
    machine += std::string("[[axis]]\nname = \"") + axis + "\"\nrapid = 100.0\nmax_velocity = 100.0\nmax_acceleration = 1000.0\n" +
               "max_jerk = 50000.0\nin_position = 0.01\n";
  file("m.toml", machine + "[motion]\nmode = \"trapezoid\"\n[parameters]\n\"2007\" = { X = 100.0, Y = 200.0, Z = 200.0 }\n\"2069\" = 0.01\n");
  file("p.nc", "G1 X10. F1000\nM30\n");
  const Outcome check = ncsim("check --machine m.toml p.nc");
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(check.err,
            "note: motion: trapezoid, as it is configured\n"
            "note: #2069: no effect while #8107 and #8108 are not both 1\n"
            "note: X: #2007 #2008 let cuts go at 3000 mm/min, the axis could go at 6000: faster would break its limit of acceleration\n");
  // L / F, the constant, and the end of the program.
  const Outcome time = ncsim("time --machine m.toml p.nc");
  EXPECT_NEAR(std::stod(time.out.substr(13)), 0.7, 0.01) << time.out;
}

// The runtime's simulated machine with its servos needs the same cycles. The time for M30, that is, for the answer of the ladder program, is
// subtracted.
TEST_F(CommandTest, TimeIsWhatTheRuntimeNeeds) {
  file("end.nc", "M30\n");
  file("p.nc", "G17 G21 G90 G94 G64\nG53 G0 X-250. Y-150. Z-20.\nG91\nG1 X20. F3000.\nG61\nY20.\nG64\nG2 X10. Y10. I10. J0.\n"
       "G4 X0.3\nG0 Z-30.\nG1 X-30. Y-30. F800.\nM30\n");
  const std::string machine = nc::test::kSourceDir + "/etc/machine.toml";
  const auto runtime = [&](const std::string& program) {
    const std::string command = "cd " + folder_ + " && " + nc::test::kBinaryDir + "/bin/ncrtd --config " + machine +
                                " run --fast --no-progress " + program + " > runtime.txt 2> /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe,cert-env33-c): a test's own command
    return seconds_of(content(folder_ + "/runtime.txt"));
  };
  const auto offline = [&](const std::string& program) { return seconds_of(ncsim("time --machine " + machine + " " + program).out); };
  const double seconds = offline("p.nc") - offline("end.nc");
  EXPECT_GT(seconds, 4.0);
  EXPECT_NEAR(runtime("p.nc") - runtime("end.nc"), seconds, 0.001 + 1e-9);
}

// Index tables (M700 9.3): the clamps take the times that the machine file gives, in ncsim as in the runtime; a trace has no clamps.
TEST_F(CommandTest, TimeCountsTheClampsOfAnIndexTable) {
  const auto machine = [](const std::string& table) {
    return "[machine]\nname = \"t\"\n[[axis]]\nname = \"X\"\nmax_velocity = 100.0\nmax_acceleration = 1000.0\n"
           "[[axis]]\nname = \"B\"\nrotary = true\nmax_velocity = 90.0\nmax_acceleration = 900.0\n" + table;
  };
  file("table.toml", machine("unclamp_s = 0.7\nclamp_s = 0.4\n[parameters]\n\"2076\" = { B = 1 }\n"));
  file("plain.toml", machine(""));
  file("p.nc", "G0 X5.\nB45.\nB90.\nX10.\nB0 X0\nM30\n");
  const double plain = seconds_of(ncsim("time --machine plain.toml p.nc").out), table = seconds_of(ncsim("time --machine table.toml p.nc").out);
  EXPECT_NEAR(table - plain, 2 * (0.7 + 0.4), 0.15) << "two of three moves follow each other; the axes settle before a clamp";
  const std::string command = "cd " + folder_ + " && " + nc::test::kBinaryDir + "/bin/ncrtd --config table.toml run --fast --no-progress p.nc > run.txt 2> /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe,cert-env33-c): a test's own command
  EXPECT_NEAR(seconds_of(content(folder_ + "/run.txt")), table, 0.02) << "but for what M30 takes";
  EXPECT_EQ(ncsim("trace --machine table.toml p.nc").out, ncsim("trace --machine plain.toml p.nc").out);
}

TEST_F(CommandTest, ProfileIsDrawnForEveryAxis) {
  file("p.nc", kPart);
  const Outcome run = ncsim("plot --profile --limits 100,1000,50000 -o drawing p.nc");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("drawing.svg drawing.png: ", 0), 0u) << run.out;
  EXPECT_EQ(content(folder_ + "/drawing.png").substr(1, 3), "PNG");
  const std::string svg = content(folder_ + "/drawing.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(ncsim("plot --profile --limits 100,1000,50000 -o again p.nc").code, 0);
  EXPECT_EQ(svg == content(folder_ + "/again.svg"), true) << "two runs give the same bytes";
  EXPECT_EQ(ncsim("plot --profile p.nc").out.rfind("profile.svg profile.png: ", 0), 0u);
}

TEST_F(CommandTest, TablesOfFunctionsAndAlarms) {
  for (const std::string dialect : {"m700", "dgshape"}) {
    const Outcome plain = ncsim("functions --dialect " + dialect),
                  table = ncsim("functions --markdown --dialect " + dialect);
    EXPECT_EQ(plain.code, 0);
    EXPECT_NE(plain.out.find("G01\t"), std::string::npos) << plain.out;
    EXPECT_NE(table.out.find("| G01 |"), std::string::npos);
    EXPECT_NE(table.out.find("| --- |"), std::string::npos);
  }
  const Outcome alarms = ncsim("alarms");
  EXPECT_EQ(alarms.code, 0);
  EXPECT_NE(alarms.out.find("P62\t"), std::string::npos);
}

}  // namespace
}  // namespace nc::tools
