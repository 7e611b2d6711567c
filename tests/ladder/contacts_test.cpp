// SPDX-License-Identifier: Apache-2.0
// Contacts, blocks, branches, edges and coils.
#include "rig.hpp"

namespace nc::ladder {
namespace {

// Y0 for the four states of X0 (bit 0) and X1 (bit 1).
unsigned truth(std::string_view text) {
  unsigned table = 0;
  for (int state = 0; state < 4; ++state) {
    Rig rig(text);
    rig.set("X0", state & 1);
    rig.set("X1", state >> 1);
    rig.scan();
    table |= static_cast<unsigned>(rig.get("Y0")) << state;
  }
  return table;
}

TEST(LadderContacts, TruthOfEachContact) {
  EXPECT_EQ(truth("LD X0\nOUT Y0"), 0b1010u);
  EXPECT_EQ(truth("LDI X0\nOUT Y0"), 0b0101u);
  EXPECT_EQ(truth("LD X0\nAND X1\nOUT Y0"), 0b1000u);
  EXPECT_EQ(truth("LD X0\nANI X1\nOUT Y0"), 0b0010u);
  EXPECT_EQ(truth("LD X0\nOR X1\nOUT Y0"), 0b1110u);
  EXPECT_EQ(truth("LD X0\nORI X1\nOUT Y0"), 0b1011u);
  EXPECT_EQ(truth("LD X0\nAND X1\nINV\nOUT Y0"), 0b0111u);
}

TEST(LadderContacts, BlocksJoinInSeriesAndInParallel) {
  // (X0 or X1) and not (X0 and X1)
  EXPECT_EQ(truth("LD X0\nOR X1\nLDI X0\nORI X1\nANB\nOUT Y0"), 0b0110u);
  EXPECT_EQ(truth("LD X0\nANI X1\nLDI X0\nAND X1\nORB\nOUT Y0"), 0b0110u);
}

TEST(LadderContacts, BranchesGoOnFromTheKeptResult) {
  Rig rig("LD X0\nMPS\nAND X1\nOUT Y0\nMRD\nAND X2\nOUT Y1\nMPP\nANI X1\nOUT Y2\n");
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 0);
  rig.set("X1", 0);
  rig.set("X2", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 1);
}

TEST(LadderContacts, BranchesNest) {
  Rig rig("LD X0\nMPS\nAND X1\nMPS\nAND X2\nOUT Y0\nMPP\nANI X2\nOUT Y1\nMPP\nANI X1\nOUT Y2");
  for (int state = 0; state < 8; ++state) {
    rig.set("X0", state & 1);
    rig.set("X1", state >> 1 & 1);
    rig.set("X2", state >> 2 & 1);
    rig.scan();
    const bool x0 = state & 1, x1 = state & 2, x2 = state & 4;
    EXPECT_EQ(rig.get("Y0"), x0 && x1 && x2) << state;
    EXPECT_EQ(rig.get("Y1"), x0 && x1 && !x2) << state;
    EXPECT_EQ(rig.get("Y2"), x0 && !x1) << state;
  }
}

TEST(LadderContacts, ABlockMayGoOnFromTheResultOfAnOutput) {
  // X0 -+- (Y0)
  //     +- (X1 or X2) - (Y1)
  Rig rig("LD X0\nOUT Y0\nLD X1\nOR X2\nANB\nOUT Y1\nLDP X3\nANB\nOUT Y2");
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y1"), 0);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 0);
  rig.set("X3", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y2"), 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y2"), 0);
}

TEST(LadderContacts, OutputsInARowShareTheResult) {
  Rig rig("LD X0\nOUT Y0\nSET Y1\nMOV K5 D0\nOUT Y2\nAND X1\nOUT Y3");
  rig.set("X0", 1);
  rig.scan();
  for (const char* name : {"Y0", "Y1", "Y2"}) EXPECT_EQ(rig.get(name), 1) << name;
  EXPECT_EQ(rig.get("Y3"), 0);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 0);
}

TEST(LadderContacts, SetAndResetHoldAndTheirResultGoesOn) {
  Rig rig("LD X0\nSET Y0\nOUT Y1\nLD X1\nRST Y0\nOUT Y2\nSET Y3");
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 1);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 0);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y2"), 1);
  EXPECT_EQ(rig.get("Y3"), 1);
}

TEST(LadderContacts, ACoilUsedTwiceTheLastOneWinsAndIsReported) {
  Rig rig("LD X0\nOUT Y0\nLD X1\nOUT Y0");
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  ASSERT_EQ(rig.program().warnings().size(), 1u);
  const std::string text = rig.program().warnings()[0].text();
  EXPECT_EQ(text.find("test.il:4: OUT Y0:"), 0u) << text;
  EXPECT_NE(text.find("line 2"), std::string::npos) << text;
}

// Level of X0 in each scan -> Y0 in each scan.
std::string pulses(std::string_view text, std::string_view levels) {
  Rig rig(text);
  std::string out;
  for (const char level : levels) {
    rig.set("X0", level == '1');
    rig.scan();
    out += rig.get("Y0") != 0 ? '1' : '0';
  }
  return out;
}

TEST(LadderEdges, OneScanPerEdge) {
  const std::string levels = "0110010111";
  const std::string rise = "0100010100", fall = "0001001000";
  EXPECT_EQ(pulses("LDP X0\nOUT Y0", levels), rise);
  EXPECT_EQ(pulses("LDF X0\nOUT Y0", levels), fall);
  EXPECT_EQ(pulses("LD SM400\nANDP X0\nOUT Y0", levels), rise);
  EXPECT_EQ(pulses("LD SM400\nANDF X0\nOUT Y0", levels), fall);
  EXPECT_EQ(pulses("LD SM401\nORP X0\nOUT Y0", levels), rise);
  EXPECT_EQ(pulses("LD SM401\nORF X0\nOUT Y0", levels), fall);
  EXPECT_EQ(pulses("LD X0\nMEP\nOUT Y0", levels), rise);
  EXPECT_EQ(pulses("LD X0\nMEF\nOUT Y0", levels), fall);
  EXPECT_EQ(pulses("LD X0\nPLS Y0", levels), rise);
  EXPECT_EQ(pulses("LD X0\nPLF Y0", levels), fall);
  EXPECT_EQ(pulses("LD X0\nFF Y0", levels), "0111100111");
}

TEST(LadderEdges, NoEdgeInTheFirstScan) {
  // On at the start: the memory takes the level, no edge is seen.
  EXPECT_EQ(pulses("LDP X0\nOUT Y0", "1101"), "0001");
  EXPECT_EQ(pulses("LDF X0\nOUT Y0", "0010"), "0001");
  EXPECT_EQ(pulses("LD X0\nMEP\nOUT Y0", "1101"), "0001");
  EXPECT_EQ(pulses("LD X0\nMEF\nOUT Y0", "0010"), "0001");
  EXPECT_EQ(pulses("LD X0\nPLS Y0", "1101"), "0001");
  EXPECT_EQ(pulses("LD X0\nPLF Y0", "0010"), "0001");
  EXPECT_EQ(pulses("LD X0\nFF Y0", "1101"), "0001");
  EXPECT_EQ(pulses("LD X0\nSETP Y0", "1101"), "0001");
}

TEST(LadderEdges, AnInstructionLeftOutAtFirstSeesNoOldEdgeEither) {
  Rig rig("LDI X1\nCJ P1\nLDP X0\nOUT Y0\nP1");
  rig.set("X0", 0);
  rig.scan(3);
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
}

TEST(LadderEdges, EachInstructionHasAMemoryOfItsOwn) {
  Rig rig("LDP X0\nOUT Y0\nLDP X0\nOUT Y1\nLDF X0\nOUT Y2");
  rig.scan();
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 1);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y2"), 1);
}

TEST(LadderEdges, PulseFormsRunOnTheRisingEdge) {
  Rig rig(
      "LD X0\nINCP D0\nINC D1\nMOVP K7 D2\nSETP Y0\nRSTP Y1\nCALLP P1\nOUT Y2\nFEND\nP1\nLD SM400\nINC "
      "D3\nRET");
  rig.scan();
  rig.set("Y1", 1);
  rig.set("X0", 1);
  rig.scan(3);
  EXPECT_EQ(rig.get("D0"), 1);
  EXPECT_EQ(rig.get("D1"), 3);
  EXPECT_EQ(rig.get("D2"), 7);
  EXPECT_EQ(rig.get("D3"), 1);
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 1);
  rig.set("Y0", 0);
  rig.set("Y1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0) << "no second edge";
  EXPECT_EQ(rig.get("Y1"), 1);
}

TEST(LadderSpecial, RelaysOfTheEngine) {
  Rig rig("LD SM400\nOUT Y0\nLD SM401\nOUT Y1\nLD SM402\nOUT Y2\nLD SM403\nOUT Y3");
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 1);
  EXPECT_EQ(rig.get("Y3"), 0);
  rig.scan(2);
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y2"), 0);
  EXPECT_EQ(rig.get("Y3"), 1);
}

TEST(LadderSpecial, ClocksAreOfHalfTheirPeriod) {
  Rig rig("LD SM410\nOUT Y0\nLD SM411\nOUT Y1\nLD SM412\nOUT Y2\nLD SM413\nOUT Y3");
  const unsigned half[] = {50, 100, 500, 1000};
  for (unsigned scan = 0; scan < 4100; ++scan) {
    rig.scan();
    for (unsigned i = 0; i < 4; ++i)
      ASSERT_EQ(rig.get("Y" + std::to_string(i)), static_cast<int>(scan / half[i] % 2)) << scan << " " << i;
  }
}

TEST(LadderSpecial, EveryImageIsAMachineOfItsOwn) {
  Rig rig("LDP X0\nOUT Y0\nLD X0\nOUT T0 K1");
  rig.scan(10);
  DeviceImage other = rig.engine().make_image();
  rig.set("X0", 1);
  other.bit[rig.device("X0").index] = 1;
  rig.engine().scan(&other);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(other.bit[rig.device("Y0").index], 0) << "first scan of that one";
}

}  // namespace
}  // namespace nc::ladder
