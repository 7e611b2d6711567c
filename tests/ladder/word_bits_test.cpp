// SPDX-License-Identifier: Apache-2.0
// Bits of words as devices (D0.5), and instructions that a constant makes impossible, found at load.
#include "rig.hpp"

namespace nc::ladder {
namespace {

TEST(LadderWordBits, AreContacts) {
  Rig rig("LD D0.5\nOUT Y0\nLDI D0.F\nOUT Y1\nLD X0\nAND D0.0\nOR D1.A\nOUT Y2");
  rig.set("D0", 1 << 5);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 0);
  rig.set("D0", -32768 | 1);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y2"), 1);
  rig.set("X0", 0);
  rig.set("D1", 1 << 10);
  rig.scan();
  EXPECT_EQ(rig.get("Y2"), 1);
}

TEST(LadderWordBits, AreCoilsThatLeaveTheOtherBitsAlone) {
  Rig rig("LD X0\nOUT D0.3\nLD X1\nSET D0.F\nLD X2\nRST D0.F\nLD X3\nFF D1.0\nLD X4\nPLS D1.1\nLD X4\nSETP D1.2");
  rig.set("D0", 0x0101);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 0x0101);
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(static_cast<std::uint16_t>(rig.get("D0")), 0x8109);
  rig.set("X0", 0);
  rig.set("X1", 0);
  rig.set("X2", 1);
  rig.set("X3", 1);
  rig.set("X4", 1);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 0x0101);
  EXPECT_EQ(rig.get("D1"), 7);
  rig.scan();
  EXPECT_EQ(rig.get("D1"), 5) << "a pulse lasts one scan";
  rig.set("D1", 0);
  rig.scan();
  EXPECT_EQ(rig.get("D1"), 0) << "an edge that is over does nothing";
}

TEST(LadderWordBits, HaveEdgesAndStandInBlocks) {
  Rig rig("LDP D0.1\nSET Y0\nLD X0\nLD D0.2\nOR D0.3\nANB\nOUT Y1\nLD X0\nOUT Y2\nLD D0.2\nANB\nOUT Y3");
  rig.set("D0", 2);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0) << "on at the start is no edge";
  rig.set("D0", 0);
  rig.scan();
  rig.set("D0", 2 | 4);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("Y1"), 0);
  EXPECT_EQ(rig.get("Y3"), 0);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y2"), 1);
  EXPECT_EQ(rig.get("Y3"), 1);
  rig.set("D0", 8);
  rig.scan();
  EXPECT_EQ(rig.get("Y1"), 1);
  EXPECT_EQ(rig.get("Y3"), 0);
}

TEST(LadderWordBits, OfSignalsAndByAlias) {
  Rig rig("ALIAS R5 D100\nALIAS door R5.3\nLD in16.4\nOUT out16.0\nLD in32.F\nOUT door");
  rig.set("in16", 16);
  rig.set("in32", 0x8000);
  rig.scan();
  EXPECT_EQ(rig.get("out16"), 1);
  EXPECT_EQ(rig.get("D100"), 8);
}

TEST(LadderWordBits, InsideMasterControlAndBranches) {
  Rig rig("LD X0\nMC N0 D0.0\nLD X1\nMPS\nAND D0.1\nOUT D0.2\nMPP\nOUT D0.3\nMCR N0\nLD D0.0\nOUT Y0");
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.set("D0", 2);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 1 | 2 | 4 | 8);
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 2) << "the master control is off: its coils are";
  EXPECT_EQ(rig.get("Y0"), 0);
}

TEST(LadderWordBits, WrongOnesAreErrors) {
  for (const char* line : {"LD D0.G", "LD D0.10", "LD D0.", "LD D9000.1", "LD M0.1", "LD in16.g", "MOV D0.1 D2",
                           "OUT in16.1", "LD D0Z1.5", "ALIAS D0.5 X0", "LD K5.1", "ZRST D0.1 D0.5", "LD .1"}) {
    const std::string text = std::string(line)[0] == 'L' || line[0] == 'A' ? std::string(line) + "\nOUT Y0\n"
                                                                            : "LD X0\n" + std::string(line) + "\n";
    EXPECT_FALSE(errors_of(text).empty()) << line;
  }
}

TEST(LadderWordBits, ACoilUsedTwiceIsSeen) {
  Rig rig("LD X0\nOUT D0.1\nLD X1\nOUT D0.2\nLD X2\nOUT D0.1");
  ASSERT_EQ(rig.program().warnings().size(), 1u);
  EXPECT_NE(rig.program().warnings()[0].text().find("line 2"), std::string::npos);
}

TEST(LadderConstants, WhatCanNeverBeDoneIsAnErrorAtLoad) {
  struct Case {
    const char* instruction;
    const char* says;
  };
  for (const Case& c :
       {Case{"/ D0 K0 D2", "division by zero"}, Case{"D/ D0 K0 D4", "division by zero"},
        Case{"/ K-32768 K-1 D2", "does not fit"}, Case{"BMOV D8190 D0 K3", "there are 2"},
        Case{"BMOV D0 D8190 K3", "there are 2"}, Case{"BMOV D0 D10 K-1", "0 to 32767"}, Case{"FMOV K0 D8191 K2", "there are 1"},
        Case{"SER K1 D8190 D0 K3", "there are 2"}, Case{"DSER K1 D8190 D0 K2", "there are 1"}, Case{"ROR D0 K16", "0 to 15"},
        Case{"DROL D0 K32", "0 to 31"}, Case{"BSET D0 K16", "0 to 15"}, Case{"SFR D0 K-1", "0 to 15"},
        Case{"BCD K10000 D0", "0 to 9999"}, Case{"BCD K-1 D0", "0 to 9999"}, Case{"BIN H0A D0", "no BCD"},
        Case{"ROTS K0 D1 D2 D3", "1 to 32767"}, Case{"ROTS K10 K11 D2 D3", "1 to 10"}, Case{"ROTS K10 D1 K0 D3", "1 to 10"}}) {
    const auto errors = errors_of("LD X0\n" + std::string(c.instruction) + "\n");
    ASSERT_EQ(errors.size(), 1u) << c.instruction << all_text(errors);
    EXPECT_EQ(errors[0].line, 2u);
    EXPECT_NE(errors[0].text().find(c.instruction), std::string::npos) << errors[0].text();
    EXPECT_NE(errors[0].text().find(c.says), std::string::npos) << errors[0].text();
  }
}

TEST(LadderConstants, WhatIsJustPossibleIsNoError) {
  for (const char* line : {"/ D0 K-1 D2", "BMOV D8190 D0 K2", "BMOV D8000Z1 D0 K500", "FMOV K0 D8191 K1", "ROR D0 K15",
                           "DROL D0 K31", "BCD K9999 D0", "DBCD K99999999 D0", "BIN H9999 D0", "ROTS K10 K10 K1 D3", "FMOV K0 D0 K0"})
    Rig rig("LD X0\n" + std::string(line) + "\n");
}

TEST(LadderWarnings, AnEdgeThatNeverComes) {
  for (const char* text : {"LD SM402\nMOVP K1 D0", "LD SM400\nPLS M0", "LD SM400\nSETP Y0", "LDP SM402\nOUT Y0", "LD SM402\nMEP\nOUT Y0"}) {
    Rig rig(text);
    EXPECT_EQ(rig.program().warnings().size(), 1u) << text;
    rig.scan(3);
    EXPECT_EQ(rig.get("Y0") + rig.get("D0") + rig.get("M0"), 0) << text;
  }
  for (const char* text : {"LD SM402\nMOV K1 D0", "LD SM403\nMOVP K1 D0", "LD SM402\nPLF M0", "LD SM400\nAND X0\nMOVP K1 D0",
                           "LD X0\nMC N0 M1\nLD SM400\nMOVP K1 D0\nMCR N0"}) {
    Rig rig(text);
    EXPECT_TRUE(rig.program().warnings().empty()) << text;
  }
}

}  // namespace
}  // namespace nc::ladder
