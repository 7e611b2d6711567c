// SPDX-License-Identifier: Apache-2.0
// Codes of the iso family that act on the machine by number (LinuxCNC M50 to M53, M61 to M68), and those of the shift (G92.2, G92.3) and of constant surface
// speed (G96 D).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome iso(const std::string& text) { return Bench(NC_DIALECT_ISO).run(text); }
std::string alarm_of(const std::string& text) { return iso(text).alarm; }

/// Moves, outputs and what the operator may override, in the order of the stream: "X1 w0/8=8 X2".
std::string order(const Outcome& run) {
  std::string all;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    std::string text;
    if (item.kind == NC_ITEM_MOVE) text = "X" + brief(item.u.move.machine.v[0]);
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_OUTPUT)
      text = "w" + std::to_string(item.u.action.index) + "/" + std::to_string(item.u.action.mask) + "=" + std::to_string(item.u.action.bits);
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_DISABLE) text = "bars" + brief(item.u.action.value);
    if (!text.empty()) all += (all.empty() ? "" : " ") + text;
  }
  return all;
}

TEST(MachineOutput, ChangesWithTheMotionThatFollows) {  // M62 to M65
  EXPECT_EQ(order(iso("G0 X1\nM62 P3\nX2\nM63 P3\nM64 P0\nX3\nM65 P0 X4\nM2")), "X1 w0/8=8 X2 w0/8=0 w0/1=1 X3 w0/1=0 X4");
  EXPECT_EQ(alarm_of("M62\nM2"), "NC-WORDS");
  EXPECT_EQ(alarm_of("M64 P32\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M64 P1.5\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M64 P-1\nM2"), "NC-RANGE");
  const Outcome both = iso("M64 P31 M65 P31\nM2");
  EXPECT_EQ(both.alarm, "NC-FORMAT");  // a letter stands once
}

TEST(MachineOutput, AValueIsAWordOfItsOwn) {  // M67, M68
  EXPECT_EQ(order(iso("M67 E0 Q8\nX1\nM68 E2 Q-2\nM2")), "w1/4294967295=8 X1 w3/4294967295=4294967294");
  EXPECT_EQ(alarm_of("M67 E0 Q7.6\nM2"), "NC-RANGE");  // a word of whole numbers
  EXPECT_EQ(alarm_of("M67 E0\nM2"), "NC-WORDS");
  EXPECT_EQ(alarm_of("M68 Q1\nM2"), "NC-WORDS");
  EXPECT_EQ(alarm_of("M68 E3 Q1\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M68 E1 Q1e9\nM2") == "", false);  // no number has an exponent
}

TEST(MachineOutput, ALetterEBelongsToItsCodesAlone) {
  for (const char* text : {"G1 X1E-05 F100", "G0 X1 E2", "M3 E1"}) EXPECT_NE(alarm_of(std::string(text) + "\nM2"), "") << text;
}

// ---- M66

/// What #5399 is behind the block, with inputs that a function sets before each question.
double answer(const std::string& block, const std::function<void(Bench&, unsigned question)>& machine, unsigned* questions = nullptr) {
  Bench bench(NC_DIALECT_ISO);
  unsigned asked = 0;
  bench.on_sync = [&](const nc_item&) { machine(bench, asked++); };
  const Outcome run = bench.run(block + "\n#100=#5399\nM2");
  EXPECT_EQ(run.alarm, "") << block << run.alarm_detail;
  if (questions != nullptr) *questions = asked;
  return run.var(100);
}

TEST(MachineInput, IsReadAtOnce) {
  EXPECT_EQ(answer("M66 P3 L0", [](Bench& bench, unsigned) { bench.input[0] = 8; }), 1);
  EXPECT_EQ(answer("M66 P3", [](Bench& bench, unsigned) { bench.input[0] = ~8u; }), 0);
  EXPECT_EQ(answer("M66 E1", [](Bench& bench, unsigned) { bench.input[2] = 0xfffffff0u; }), -16);
}

TEST(MachineInput, IsWaitedFor) {
  unsigned questions = 0;
  EXPECT_EQ(answer("M66 P0 L3 Q5", [](Bench& bench, unsigned n) { bench.input[0] = n >= 4; }, &questions), 1);
  EXPECT_EQ(questions, 5u);
  EXPECT_EQ(answer("M66 P0 L4 Q5", [](Bench& bench, unsigned n) { bench.input[0] = n < 4; }), 0);
  // A rise is one only behind a low level, a fall behind a high one.
  EXPECT_EQ(answer("M66 P0 L1 Q5", [](Bench& bench, unsigned n) { bench.input[0] = n < 3 || n > 6; }, &questions), 1);
  EXPECT_EQ(questions, 8u);
  EXPECT_EQ(answer("M66 P0 L2 Q5", [](Bench& bench, unsigned n) { bench.input[0] = n > 3 && n < 6; }, &questions), 0);
  EXPECT_EQ(questions, 7u);
}

TEST(MachineInput, ThatDoesNotComeIsMinusOneBehindItsTime) {
  unsigned questions = 0;
  EXPECT_EQ(answer("M66 P0 L3 Q0.5", [](Bench& bench, unsigned) { bench.input[0] = 0; }, &questions), -1);
  EXPECT_EQ(questions, 51u);  // a hundredth of a second from one to the next
  const Outcome run = iso("M66 P0 L3 Q0.5\nM2");
  double waited = 0;
  for (const double dwell : run.dwells()) waited += dwell;
  EXPECT_NEAR(waited, 0.5, 1e-9);
}

TEST(MachineInput, HasItsAlarms) {
  EXPECT_EQ(alarm_of("M66\nM2"), "NC-WORDS");
  EXPECT_EQ(alarm_of("M66 P0 E0\nM2"), "NC-FORMAT");  // an input of one kind
  EXPECT_EQ(alarm_of("M66 P40\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M66 P0 L5 Q1\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M66 P0 L3\nM2"), "NC-RANGE");     // LinuxCNC: a wait has a time
  EXPECT_EQ(alarm_of("M66 E0 L3 Q1\nM2"), "NC-RANGE");  // an analog input is only read
  EXPECT_EQ(alarm_of("G0 X1 M66 P0\nM2"), "NC-ALONE");
}

// ---- M50 to M53, M61, M19

TEST(Overrides, AreBarredOneByOne) {
  EXPECT_EQ(order(iso("M50 P0\nM53 P0\nM50 P1\nM53\nM49\nM48\nM2")), "bars2 bars3 bars1 bars0 bars2 bars0");
  EXPECT_EQ(alarm_of("M50 P2\nM2"), "NC-RANGE");
  EXPECT_EQ(alarm_of("M51 P1\nM52 P0\nM2"), "");
  EXPECT_EQ(alarm_of("M51 P0\nM2"), "NC-NOT-BUILT");
  EXPECT_EQ(alarm_of("M52 P1\nM2"), "NC-NOT-BUILT");
}

TEST(ToolInTheSpindle, IsTheOneThatWasChangedIn) {  // LinuxCNC G43, G41 without a number, #5400: "currently loaded"; T only selects
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 10).tool(1, 1, NC_TOOL_RADIUS).tool(2, 20).tool(2, 4, NC_TOOL_RADIUS);
  Outcome run = bench.run("T2 M6\nT1\n#100=#5400\nG43\nG0 Z0\nM2");
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 20"}));
  EXPECT_EQ(run.var(100), 2);
  run = bench.at(0, 0, 0).run("G40 T2 M6\nT1\nG1 F100 G41 X10\nX20\nM2");
  EXPECT_EQ(run.path().back(), "line 20 4 0 F100");
  run = bench.at(0, 0, 0).run("#100=#5400\nM6\n#101=#5400\nG43\nG0 Z0\nM2");  // the tool, and the one that is selected, outlive the program
  EXPECT_EQ(run.var(100), 2);
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 10"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("T2\nM6 T1\nG43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 10"}));
  // In one block the tool is changed first (LinuxCNC, order of execution).
  EXPECT_EQ(bench.at(0, 0, 0).run("T1 M6\nM6 T2 G43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 20"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("T1 M6\nT2\nM6 G43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 20"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("T1 M6\nT2 G43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 10"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("T1 M6\nM61 Q2 G43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 20"}));
  EXPECT_EQ(Bench(NC_DIALECT_ISO).tool(1, 10).run("M6 T1 G43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 10"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("M61 Q2\nT1\nG43\nG0 Z0\nM2").path(), (Path{"rapid 0 0 20"}));
  EXPECT_EQ(bench.at(0, 0, 0).run("T0 M6\nG43\nG0 Z1\nM2").path(), (Path{"rapid 0 0 1"}));  // an empty spindle has no length
  for (const char* block : {"G43", "G41"}) {
    Bench fresh(NC_DIALECT_ISO);
    const Outcome unknown = fresh.tool(1, 10).run(std::string("T1\n") + block + "\nM2");
    EXPECT_EQ(unknown.alarm + " " + unknown.alarm_detail, "NC-OFFSET-DATA Which tool is in the spindle is not known. Program M06 or M61, or the number of the offset.") << block;
  }
}

TEST(ToolInTheSpindle, IsNamed) {  // M61
  Bench bench(NC_DIALECT_ISO);
  bench.tool(7, 12);
  const Outcome run = bench.run("M61 Q7\n#100=#5400\nG43\nG0 Z1\nM2");
  EXPECT_EQ(run.var(100), 7);
  EXPECT_EQ(run.path(), (Path{"rapid 0 0 13"}));
  EXPECT_EQ(run.aux(), "M2");
  EXPECT_EQ(alarm_of("M61\nM2"), "NC-WORDS");
  EXPECT_EQ(alarm_of("M61 Q-1\nM2"), "NC-RANGE");
}

TEST(Spindle, IsOrientedAtTheAngleOfTheMachine) {  // M19
  EXPECT_EQ(iso("M19\nM19 R0\nM2").aux(), "M19 M19 M2");
  for (const char* block : {"M19 R90", "M19 P1", "M19 Q5"}) EXPECT_EQ(alarm_of(std::string(block) + "\nM2"), "NC-NOT-BUILT") << block;
  EXPECT_EQ(iso("M19 Q5\nM2").alarm_detail, "The function that Q5 asks for is not fitted.");
}

// ---- G92.2, G92.3

TEST(Shift, IsSuspendedAndRestored) {
  EXPECT_EQ(iso("G0 X10\nG92 X0\nX1\nG92.2\nX2\nG92.3\nX3\nG92.1\nX4\nG92.3\nX5\nM2").path(),
            (Path{"rapid 10 0 0", "rapid 11 0 0", "rapid 2 0 0", "rapid 13 0 0", "rapid 4 0 0", "rapid 5 0 0"}));
  EXPECT_EQ(iso("G0 X10\nG92 X0\nG92.2\nG92.2\nG92.3\nX1\nM2").path().back(), "rapid 11 0 0");
  Bench bench(NC_DIALECT_ISO);
  bench.tool(1, 2, NC_TOOL_RADIUS);
  EXPECT_NE(bench.run("G41 D1 G1 X10 F100\nX20\nG92.2\nM2").alarm, "");
}

// ---- G96

TEST(SurfaceSpeed, HasItsLimitBesideIt) {
  std::string controls;
  for (const nc_item& item : iso("G96 D2500 S200\nG96 S100\nG97 S500\nM2").of(NC_ITEM_ACTION)) {
    const nc_action& a = item.u.action;
    if (a.kind != NC_ACTION_CONTROL) continue;
    if (a.index == NC_CONTROL_SPINDLE_CLAMP) controls += "most" + std::to_string(a.bits) + " ";
    if (a.index == NC_CONTROL_SURFACE_SPEED) controls += a.bits == 0 ? "off " : brief(a.value) + " ";
  }
  EXPECT_EQ(controls, "most2500 200 most0 100 off ");
  EXPECT_NE(alarm_of("G96\nM2"), "");
  Bench bench(NC_DIALECT_ISO);  // D of G96 is no offset number
  EXPECT_EQ(bench.run("G96 D2500 S200\nM2").alarm, "");
}

}  // namespace
}  // namespace nc::test
