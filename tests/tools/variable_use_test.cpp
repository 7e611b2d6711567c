// SPDX-License-Identifier: Apache-2.0
// Which variables a text uses, and what it calls.
#include "tools/lib/variable_use.hpp"

#include <gtest/gtest.h>

namespace nc::tools {
namespace {

std::string described(const std::string& text) {
  std::string all;
  for (const VariableUse& use : uses_of(text, "f", NC_DIALECT_M700).uses)
    all += use.text + (use.read.line ? "r" + std::to_string(use.read.line) : "w" + std::to_string(use.written.line)) + " ";
  return all;
}

TEST(VariableUse, ReadsAndWrites) {
  EXPECT_EQ(described("#100=#500+#1\nIF[#1000EQ1]GOTO9\nG1 X#101 Y[#5001+1.]\n"), "#100w1 #500r1 #1000r2 #101r3 #5001r3 ");
  EXPECT_EQ(described("# 1 0 2 = 5 (#103=1)\n"), "#102w1 ");
  EXPECT_EQ(described("[#depth]=#502\nX[#DEPTH]\n"), "#DEPTHw1 #502r1 #DEPTHr2 ");
  EXPECT_EQ(described("#33=1\n#1=#2\n"), "") << "locals";
  EXPECT_EQ(described("DPRNT[X#100[53]]\n"), "#100r1 ");
}

TEST(VariableUse, ComputedNumbers) {
  EXPECT_EQ(described("#[#1+2]=#[100+#[#150]]\n"), "#[#1+2]w1 #[100+#[#150]]r1 #[#150]r1 #150r1 ");
  EXPECT_EQ(described("##120=##1\n"), "##120w1 #120r1 ##1r1 ");
}

TEST(VariableUse, Calls) {
  const TextUses found = uses_of("O7\nM98 P0100\nG65 <CYCLE.NC> A1\nM198P5\nG66.1P9010\nM98 P#100\nM98 H5\nG43.4\nM98P6,D2\n", "f", NC_DIALECT_M700);
  std::string calls;
  for (const TextUses::Call& call : found.calls) calls += call.name + "@" + std::to_string(call.line) + " ";
  EXPECT_EQ(calls, "O100@2 CYCLE.NC@3 198:O5@4 O9010@5 @6 D2:O6@9 ");
  // Which codes call, the dialect says.
  EXPECT_EQ(uses_of("G65 P1\nM98 P2\n", "f", NC_DIALECT_ISO).calls.size(), 1u) << "iso has no G65";
  EXPECT_EQ(uses_of("G650 P1\nM980 P2\nG66.5 P3\nM096 P4\nG0066. P5\n", "f", NC_DIALECT_M700).calls.size(), 2u);
  EXPECT_EQ(found.programs, std::vector<uint32_t>{7});
}

}  // namespace
}  // namespace nc::tools
