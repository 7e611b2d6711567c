// SPDX-License-Identifier: Apache-2.0
// The listing of a program: its rungs, their lines, and the power flow of a scan. That the power of every line of logic is right is shown by
// rung_property_test.cpp.
#include <gtest/gtest.h>

#include "ladder/rig.hpp"

namespace nc::ladder {
namespace {

// "3/1 OUT Y0 on": line 3, rung 1.
std::string shown(const std::vector<ListedLine>& lines) {
  std::string out;
  for (const ListedLine& line : lines) {
    out += std::to_string(line.line) + "/" + std::to_string(line.rung) + " " + line.instruction;
    for (const std::string& operand : line.operands) out += " " + operand;
    if (line.power != ListedLine::Power::kNone) out += line.power == ListedLine::Power::kOn ? " on" : " off";
    out += "\n";
  }
  return out;
}

std::string looked_at(Rig* rig, unsigned first = 1, unsigned most = 1000) {
  std::vector<std::uint8_t> flow(rig->program().flow_bytes());
  rig->engine().scan(&rig->image, nullptr, 0, flow.data());
  return shown(rig->program().listing(first, most, flow.data()));
}

TEST(LadderListing, ShowsRungsAndPower) {
  Rig rig(
      "; a comment\n"
      "LD X0\n"
      "or X1   // another one\n"
      "SET Y0\n"
      "OUT M0\n"
      "\n"
      "LD> in16 K4\n"
      "MOV  in16,D0\n"
      "LDP X2\n"
      "MOVP K1 D1\n");
  rig.set("X1", 1);
  rig.set("in16", 4);
  EXPECT_EQ(looked_at(&rig),
            "2/2 LD X0 off\n3/2 or X1 on\n4/2 SET Y0 on\n5/2 OUT M0 on\n"
            "7/7 LD> in16 K4 off\n8/7 MOV in16 D0 off\n"
            "9/9 LDP X2 off\n10/9 MOVP K1 D1 off\n");
  rig.set("X1", 0);
  rig.set("X2", 1);
  rig.set("in16", 5);
  EXPECT_EQ(looked_at(&rig),
            "2/2 LD X0 off\n3/2 or X1 off\n4/2 SET Y0 off\n5/2 OUT M0 off\n"
            "7/7 LD> in16 K4 on\n8/7 MOV in16 D0 on\n"
            "9/9 LDP X2 on\n10/9 MOVP K1 D1 on\n");
  EXPECT_EQ(rig.get("Y0"), 1) << "the power of SET is that in front of it, and not its device";
}

// What is jumped over has no power, and neither have labels and what needs no condition.
TEST(LadderListing, ShowsWhatWasNotExecuted) {
  Rig rig(
      "LD SM400\n"
      "CJ P1\n"
      "LD SM400\n"
      "OUT Y0\n"
      "P1\n"
      "LDI SM400\n"
      "CALL P2\n"
      "FEND\n"
      "P2\n"
      "LD SM400\n"
      "OUT Y1\n"
      "RET\n"
      "END\n");
  EXPECT_EQ(looked_at(&rig),
            "1/1 LD SM400 on\n2/1 CJ P1 on\n3/3 LD SM400\n4/3 OUT Y0\n5/5 P1\n6/5 LDI SM400 off\n7/5 CALL P2 off\n"
            "8/8 FEND\n9/9 P2\n10/9 LD SM400\n11/9 OUT Y1\n12/12 RET\n13/13 END\n");
}

// A block that ANB joins with the result of the outputs before it belongs to their rung, and so does the end of MC.
TEST(LadderListing, KeepsARungTogether) {
  Rig rig("LD X0\nOUT Y0\nLD X1\nOR X2\nANB\nOUT Y1\nLD X3\nMC N0 M9\nLD X4\nMPS\nAND X0\nOUT Y2\nMPP\nOUT Y3\nMCR N0\n");
  rig.set("X0", 1);
  rig.set("X2", 1);
  rig.set("X4", 1);
  EXPECT_EQ(looked_at(&rig),
            "1/1 LD X0 on\n2/1 OUT Y0 on\n3/1 LD X1 off\n4/1 OR X2 on\n5/1 ANB on\n6/1 OUT Y1 on\n"
            "7/7 LD X3 off\n8/7 MC N0 M9 off\n"
            "9/9 LD X4 on\n10/9 MPS off\n11/9 AND X0 off\n12/9 OUT Y2 off\n13/9 MPP off\n14/9 OUT Y3 off\n15/15 MCR N0\n");
}

TEST(LadderListing, GivesWholeRungs) {
  Rig rig("LD X0\nOUT Y0\nOUT Y1\n\nLD X1\nOUT Y2\nLD X2\nOUT Y3\n");
  const auto part = [&](unsigned first, unsigned most) { return shown(rig.program().listing(first, most, nullptr)); };
  EXPECT_EQ(part(2, 1), "1/1 LD X0\n2/1 OUT Y0\n3/1 OUT Y1\n");
  EXPECT_EQ(part(4, 1), "1/1 LD X0\n2/1 OUT Y0\n3/1 OUT Y1\n") << "an empty line belongs to the rung before it";
  EXPECT_EQ(part(5, 3), "5/5 LD X1\n6/5 OUT Y2\n7/7 LD X2\n8/7 OUT Y3\n");
  EXPECT_EQ(part(8, 500), "7/7 LD X2\n8/7 OUT Y3\n");
  EXPECT_EQ(part(9, 500), "7/7 LD X2\n8/7 OUT Y3\n") << "behind the end: the last rung";
  Program none;
  EXPECT_TRUE(none.listing(1, 10, nullptr).empty());
}

}  // namespace
}  // namespace nc::ladder
