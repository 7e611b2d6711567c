// SPDX-License-Identifier: Apache-2.0
// Macro statements between compensated blocks: they are no blocks without a movement (M700 12.4.2), however many there are.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// A staircase of inner and outer corners with this many statements in front of each of its blocks.
Outcome staircase(unsigned statements, const char* check = "0") {
  std::string between;
  for (unsigned i = 0; i < statements; ++i) between += "#1=#1+1\n";
  std::string text = "G90 G94 G0 X-20. Y-30.\nG41 D1 G1 X0 Y-20. F1000\nY0\n";
  for (unsigned step = 1; step <= 4; ++step) text += between + "X" + std::to_string(20 * step) + ".\n" + between + "Y" + std::to_string(20 * step) + ".\n";
  Bench bench;
  bench.tool(1, 5).param("8103", check);
  return bench.run(text + "G40 X100. Y100.\nM30");
}

TEST(StatementsBetweenBlocks, DoNotChangeThePath) {
  const Path path = staircase(0).path();
  for (const char* const check : {"0", "1"})
    for (const unsigned statements : {1u, 5u, 12u, 24u, 40u, 100u}) EXPECT_EQ(staircase(statements, check).path(), path) << statements;
}

TEST(StatementsBetweenBlocks, WhatIsTooMuchToWaitForIsNoGouge) {  // an end at right angles would cut into the corner
  const Outcome run = staircase(200);
  EXPECT_EQ(run.alarm, "P990");
  EXPECT_EQ(run.alarm_line, 3u);
  EXPECT_NE(run.alarm_detail.find("calculate in front of it"), std::string::npos) << run.alarm_detail;
}

}  // namespace
}  // namespace nc::test
