// SPDX-License-Identifier: Apache-2.0
// Master control, jumps, subroutines, loops; what stops the engine.
#include "rig.hpp"

namespace nc::ladder {
namespace {

TEST(LadderMasterControl, NothingIsOnWhileItIsOff) {
  Rig rig(
      "LD X0\nMC N0 M100\n"
      "LD X1\nOUT Y0\nSET Y1\nOUTHS T0 K2\nOUTHS ST0 K100\nOUT C0 K5\nMOV K5 D0\n"
      "LDI X1\nOUT Y2\n"
      "LD X1\nINV\nOUT Y3\n"
      "LD X1\nMPS\nINV\nOUT Y4\nMPP\nINV\nOUT Y5\n"
      "MCR N0\n"
      "LD X1\nOUT plc.fin1\n");
  for (const int x1 : {0, 1}) {
    rig.set("X1", x1);
    rig.scan(3);
    for (const char* name : {"M100", "Y0", "Y1", "Y2", "Y3", "Y4", "Y5", "T0", "TN0", "STN0", "CN0", "D0"})
      EXPECT_EQ(rig.get(name), 0) << name;
    EXPECT_EQ(rig.get("plc.fin1"), x1);
  }
  rig.set("X0", 1);
  rig.scan(3);
  for (const char* name : {"M100", "Y0", "Y1", "T0", "CN0"}) EXPECT_EQ(rig.get(name), 1) << name;
  EXPECT_EQ(rig.get("D0"), 5);
  EXPECT_EQ(rig.get("STN0"), 2);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("T0"), 0) << "a timer is reset";
  EXPECT_EQ(rig.get("Y1"), 1) << "SET holds";
  EXPECT_EQ(rig.get("STN0"), 2) << "a retentive timer holds";
  EXPECT_EQ(rig.get("CN0"), 1) << "a counter holds";
}

TEST(LadderMasterControl, Nests) {
  Rig rig(
      "LD X0\nMC N0 M0\nLD X1\nOUT Y0\nLD X1\nMC N1 M1\nLD SM400\nOUT Y1\nMCR N1\nLD SM400\nOUT Y2\nMCR "
      "N0\nLD SM400\nOUT Y3");
  for (int state = 0; state < 4; ++state) {
    const bool x0 = state & 1, x1 = state & 2;
    rig.set("X0", x0);
    rig.set("X1", x1);
    rig.scan();
    EXPECT_EQ(rig.get("Y0"), x0 && x1);
    EXPECT_EQ(rig.get("Y1"), x0 && x1);
    EXPECT_EQ(rig.get("Y2"), x0);
    EXPECT_EQ(rig.get("Y3"), 1);
  }
}

TEST(LadderMasterControl, McrOfTheOuterOneEndsAll) {
  Rig rig(
      "LD X0\nMC N0 M0\nLD X1\nMC N1 M1\nLD SM400\nOUT Y0\nMCR N0\nLD SM400\nOUT Y1\nLD X1\nMC N0 M2\nLD "
      "SM400\nOUT Y2\nMCR N0");
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 1);
}

TEST(LadderFlow, ConditionalJumpLeavesOut) {
  Rig rig("LD X0\nCJ P1\nLD X1\nOUT Y0\nP1:\nLD X1\nOUT Y1");
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X0", 1);
  rig.set("X1", 0);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1) << "not run: stays as it is";
  EXPECT_EQ(rig.get("Y1"), 0);
}

TEST(LadderFlow, JumpWithoutCondition) {
  Rig rig("JMP P4095\nLD SM400\nOUT Y0\nP4095\nLD SM400\nOUT Y1");
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y1"), 1);
}

TEST(LadderFlow, JumpBackwardsMakesALoop) {
  Rig rig("LD SM400\nMOV K0 D0\nP1\nLD SM400\nINC D0\nLD< D0 K10\nCJ P1\nLD SM400\nOUT Y0");
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 10);
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.engine().fault(), kNoFault);
}

TEST(LadderFlow, SubroutinesGiveTheResultBack) {
  Rig rig(
      "LD X0\nMPS\nCALL P1\nOUT Y0\nMPP\nAND X1\nOUT Y1\nFEND\n"
      "P1\nLD SM400\nINC D0\nLDI X0\nMPS\nOUT Y2\nMPP\nCALL P2\nRET\n"
      "P2\nLD SM400\nINC D1\nSRET\nEND\n");
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 0);
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 1);
  EXPECT_EQ(rig.get("D1"), 0) << "its condition was off";
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.engine().fault(), kNoFault);
}

TEST(LadderFlow, LoopsNest) {
  Rig rig("FOR K3\nLD SM400\nINC D0\nFOR D10\nLD SM400\nINC D1\nNEXT\nNEXT\nLD SM400\nOUT Y0");
  rig.set("D10", 4);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 3);
  EXPECT_EQ(rig.get("D1"), 12);
  EXPECT_EQ(rig.get("Y0"), 1);
  for (const int none : {0, -5}) {
    rig.set("D10", none);
    rig.set("D1", 0);
    rig.scan();
    EXPECT_EQ(rig.get("D1"), 0);
  }
}

TEST(LadderFlow, AJumpMayLeaveALoop) {
  Rig rig("FOR K100\nLD SM400\nINC D0\nLD= D0 K7\nCJ P1\nNEXT\nP1\nLD SM400\nOUT Y0");
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 7);
  EXPECT_EQ(rig.get("Y0"), 1);
}

TEST(LadderFlow, NothingBehindFendRunsByItself) {
  Rig rig("LD SM400\nOUT Y0\nFEND\nLD SM400\nOUT Y1\nEND\nLD SM400\nOUT Y2");
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 0);
  ASSERT_EQ(rig.program().warnings().size(), 1u) << "text behind END";
}

TEST(LadderFlow, AnEmptyProgramRuns) {
  for (const char* text : {"", "END", "; nothing\n\n// nothing\n", "NOP"}) {
    Rig rig(text);
    rig.scan(2);
    EXPECT_EQ(rig.engine().fault(), kNoFault);
  }
  const Program none;
  Engine engine(none);
  DeviceImage image = engine.make_image();
  engine.scan(&image);
  EXPECT_EQ(engine.fault(), kNoFault);
}

TEST(LadderWatchdog, AJumpThatDoesNotEndStopsTheEngine) {
  Rig rig("LD X0\nOUT Y0\nLD SM400\nINC D0\nP1\nLD X0\nCJ P1\nLD SM400\nOUT Y1");
  rig.scan();
  EXPECT_EQ(rig.get("Y1"), 1);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.engine().fault(), kWatchdog);
  EXPECT_EQ(rig.engine().fault_line(), 7u);
  EXPECT_EQ(rig.engine().fault_text().find("test.il:7: CJ P1: watchdog"), 0u) << rig.engine().fault_text();
  EXPECT_EQ(rig.get("Y0"), 1) << "outputs stay as they are";
  const DeviceImage stopped = rig.image;
  rig.set("X0", 0);
  rig.engine().scan(&rig.image);
  EXPECT_EQ(rig.get("D0"), 2) << "no scan runs any more";
  EXPECT_EQ(rig.get("Y0"), stopped.bit[rig.device("Y0").index]);
  rig.engine().reset_fault();
  rig.scan();
  EXPECT_EQ(rig.engine().fault(), kNoFault);
  EXPECT_EQ(rig.get("D0"), 3);
  EXPECT_EQ(rig.engine().fault_text(), "");
}

TEST(LadderWatchdog, LoopsSubroutinesAndRowsCount) {
  for (const char* text :
       {"FOR K32767\nFOR K32767\nLD SM400\nINC D0\nNEXT\nNEXT",
        "FOR K32767\nLD SM400\nCALL P1\nNEXT\nFEND\nP1\nLD SM400\nINC D0\nRET",
        "FOR K32767\nLD SM400\nFMOV K0 D0 K8000\nNEXT", "FOR K32767\nLD SM400\nBMOV D0 D1 K8000\nNEXT",
        "FOR K32767\nLD SM400\nSER K1 D0 D0 K8000\nNEXT", "FOR K32767\nLD SM400\nZRST M0 M8191\nNEXT",
        "FOR K32767\nLD SM400\nZRST T0 T511\nNEXT", "FOR K32767\nLD SM400\nZRST C0 C511\nNEXT",
        "FOR K32767\nLD SM400\nZRST D0 D8191\nNEXT", "P1\nJMP P1"}) {
    Rig rig(text);
    rig.scan();
    EXPECT_EQ(rig.engine().fault(), kWatchdog) << text;
    EXPECT_NE(rig.engine().fault_line(), 0u) << text;
  }
}

TEST(LadderWatchdog, TheBudgetIsAnOption) {
  CompileOptions options;
  options.step_budget = 100;
  Rig tight("FOR K1000\nLD SM400\nINC D0\nNEXT", options);
  tight.scan();
  EXPECT_EQ(tight.engine().fault(), kWatchdog);
  Rig wide("FOR K1000\nLD SM400\nINC D0\nNEXT");
  wide.scan();
  EXPECT_EQ(wide.engine().fault(), kNoFault);
  EXPECT_EQ(wide.get("D0"), 1000);
}

TEST(LadderFaults, Subroutines) {
  Rig deep("LD SM400\nCALL P1\nFEND\nP1\nLD SM400\nINC D0\nCALL P1\nRET");
  deep.scan();
  EXPECT_EQ(deep.engine().fault(), kCallStack);
  EXPECT_EQ(deep.engine().fault_line(), 7u);
  EXPECT_EQ(deep.get("D0"), static_cast<int>(kMaxCalls));
  Rig open("LD SM400\nCALL P1\nFEND\nP1\nLD SM400\nINC D0\nEND");
  open.scan();
  EXPECT_EQ(open.engine().fault(), kEndInCall);
  EXPECT_EQ(open.engine().fault_line(), 7u);
}

TEST(LadderFaults, AnImageOfAnotherProgramIsRefused) {
  Rig one("LDP X0\nOUT Y0"), other("LD X0\nOUT Y0");
  DeviceImage image = other.engine().make_image();
  one.engine().scan(&image);
  EXPECT_EQ(one.engine().fault(), kImageSize);
  EXPECT_EQ(one.engine().fault_line(), 0u);
  EXPECT_NE(one.engine().fault_text(), "");
}

}  // namespace
}  // namespace nc::ladder
