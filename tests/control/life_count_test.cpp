// SPDX-License-Identifier: Apache-2.0
// Tool life management on a machine: minutes of cutting, the signals for the ladder, a tool that breaks.
#include <gtest/gtest.h>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

class LifeCount : public testing::Test {
 protected:
  LifeCount() : bench(NC_DIALECT_M700, machine(256)) { bench.param("1103", "1"); }
  double life(unsigned number, nc_life_column column) {
    double value = NAN;
    EXPECT_EQ(nc_tool_life_get(bench.control(), number, column, &value), NC_OK);
    return value;
  }
  void run(const std::string& text) {
    drive = std::make_unique<Drive>(bench, text);
    for (unsigned n = 0; n < 100000 && !drive->ended; ++n) {
      drive->press_start();
      drive->step(50);
    }
    ASSERT_TRUE(drive->ended) << drive->alarm();
    for (unsigned n = 0; n < 5; ++n) drive->step(50);
  }
  Bench bench;
  std::unique_ptr<Drive> drive;
};

TEST_F(LifeCount, MinutesAreThoseInWhichItCuts) {
  bench.at(0, 0, 0);
  // 60 mm at 600 mm/min are 6 s; rapid traverse, the dwell and the tool of another group do not count.
  run("G10 L3\nP1 L1 Q2\nT11\nP2 L1 Q2\nT21\nG11\nT1 M6\nG1 X60. F600\nG0 X0\nG4 X3.\nT2 M6\nG1 X20.\nT0 M6\nG1 X0\nM30");
  EXPECT_NEAR(life(1, NC_LIFE_USED) * 60, 6, 0.05) << "s";
  EXPECT_NEAR(life(2, NC_LIFE_USED) * 60, 2, 0.05);
  EXPECT_EQ(life(1, NC_LIFE_STATUS), 1);
}

TEST_F(LifeCount, ALifeThatEndsIsTold) {
  bench.at(0, 0, 0);
  run("G10 L3\nP7 L1 Q2\nT11\nT12\nG11\nT7 M6\nG1 X590. F600\nM30");
  EXPECT_EQ(drive->out.tool_group, 7U);
  EXPECT_EQ(drive->out.tool_life, 0);
  run("G1 X550. F600\nM30");  // one minute is full within it
  EXPECT_EQ(life(1, NC_LIFE_STATUS), 2);
  EXPECT_EQ(drive->out.tool_life, NC_TOOL_LIFE_ENDED) << "a spare tool is left";
  run("T7 M6\nM30");
  EXPECT_EQ(drive->out.t, 12U);
  EXPECT_EQ(drive->out.tool_life, 0);
  run("G1 X-100. F600\nM30");
  EXPECT_EQ(drive->out.tool_life, NC_TOOL_LIFE_ENDED | NC_TOOL_GROUP_ENDED);
}

// All of the program fits into the look-ahead; what T selects and what is told goes by what has happened all the same.
TEST_F(LifeCount, NothingGoesByWhatIsOnlyRead) {
  bench.at(0, 0, 0);
  run("G10 L3\nP10 L1 Q2\nT101\nT102\nG11\nG94 F600\nT10 M06\nG1 X650.\nT10 M06\nG1 X0\nM30");
  EXPECT_EQ(drive->out.t, 102U) << "the minute of the first one was over";
  EXPECT_NEAR(life(2, NC_LIFE_USED), 65. / 60, 0.02);
  drive = std::make_unique<Drive>(bench, "G10 L3\nP10 L2\nT101\nT102\nG11\nG94 F600\nT10 M06\nG1 X100.\nG1 X0.\nT10 M06\nG1 X100.\nM30");
  unsigned told_at = 0;
  for (unsigned n = 0; n < 100000 && !drive->ended; ++n) {
    drive->press_start();
    drive->step(50);
    if (told_at == 0 && drive->out.tool_life != 0) told_at = drive->out.source.line;
  }
  EXPECT_GE(told_at, 10U) << "with the second mount, and not before";
}

// A run that no machine executes tells the table how long a tool has cut; the end of the range ends a life of 4000 minutes.
TEST_F(LifeCount, ARunWithoutAMachineCountsTheSame) {
  bench.at(0, 0, 0);
  run("G10 L3\nP7 L4000 Q2\nT11\nP8 L5 Q1\nT21\nG11\nM30");
  nc_control* const c = bench.control();
  EXPECT_EQ(nc_tool_life_cut(c, 1, 11, 3999.25), NC_OK);
  EXPECT_EQ(nc_tool_life_cut(c, 2, 11, 0.25), NC_OK) << "wherever it is registered now";
  EXPECT_EQ(life(1, NC_LIFE_USED), 3999.5);
  EXPECT_EQ(life(1, NC_LIFE_STATUS), 0);
  EXPECT_EQ(nc_tool_life_cut(c, 1, 11, 1), NC_OK);
  EXPECT_EQ(life(1, NC_LIFE_USED), 4000);
  EXPECT_EQ(life(1, NC_LIFE_STATUS), 2);
  EXPECT_EQ(nc_tool_life_cut(c, 2, 21, 3), NC_OK);
  EXPECT_EQ(life(2, NC_LIFE_USED), 0) << "its life is counted in mounts";
  EXPECT_EQ(nc_tool_life_cut(c, 1, 99, 3), NC_OK) << "it is not registered";
  for (const double minutes : {-1.0, std::nan(""), HUGE_VAL}) EXPECT_EQ(nc_tool_life_cut(c, 1, 11, minutes), NC_E_ARGUMENT) << minutes;
  for (const unsigned number : {0U, NC_TOOL_LIVES + 1U}) EXPECT_EQ(nc_tool_life_cut(c, number, 11, 1), NC_E_ARGUMENT) << number;
}

// What was registered in the place of the tool in the spindle is another tool.
TEST_F(LifeCount, AToolThatIsNotRegisteredAnyMoreIsNotCounted) {
  bench.at(0, 0, 0);
  for (const char* removes : {"G10 L3\n", "G10 L3 P2\nP1\nG11\nG10 L3 P1\n", "G10 L3 P1\nP1 L9 Q2\nT12\n"}) {
    SCOPED_TRACE(removes);
    run("G10 L3\nP1 L9 Q2\nT11\nG11\nT1 M6\nG1 X10. F600\nM30");
    EXPECT_NEAR(life(1, NC_LIFE_USED) * 60, 1, 0.05) << "s";
    run(std::string(removes) + "P2 L9 Q2\nT21\nG11\nG1 X0 F600\nM30");
    for (unsigned number = 1; number <= 2; ++number) EXPECT_EQ(life(number, NC_LIFE_USED), 0) << number;
    EXPECT_EQ(drive->out.tool_group, 0U);
  }
}

// A block that removes many tools writes more than any other. What is read ahead can be taken back all the same.
TEST_F(LifeCount, AResetTakesBackThatAllToolsWereRemoved) {
  bench.at(0, 0, 0);
  std::string registers = "G10 L3\nP1 L9 Q2\n";
  for (unsigned n = 1; n <= NC_TOOL_LIVES; ++n) registers += "T" + std::to_string(n) + "\n";
  for (const char* removes : {"G10 L3\nG11\n", "G10 L3 P2\nP1\nG11\n", "G10 L3 P1\nP1 L1\nT7\nG11\n"}) {
    SCOPED_TRACE(removes);
    run(registers + "G11\n#149=#0\nM30");
    std::string text = "G1 X" + std::to_string(drive->out.command.v[0] + 100) + " F600\n";
    for (unsigned n = 0; n < 2400; ++n) text += "#" + std::to_string(100 + n % 50) + "=1" + (n % 10 == 9 ? "\n" : " ");
    drive = std::make_unique<Drive>(bench, text + removes + "M30");
    for (unsigned n = 0; n < 40; ++n) {
      drive->press_start();
      drive->step(1000);
    }
    ASSERT_EQ(drive->out.state, NC_STATE_RUNNING);
    drive->in.reset = true;
    for (unsigned n = 0; n < 5; ++n) drive->step(50);
    drive->in.reset = false;
    for (unsigned n = 0; n < 5; ++n) drive->step(50);
    EXPECT_EQ(life(NC_TOOL_LIVES, NC_LIFE_TOOL), NC_TOOL_LIVES);
    double value = 0;
    bool vacant = false;
    EXPECT_EQ(nc_variable_get(bench.control(), 0, 149, &value, &vacant), NC_OK);
    EXPECT_TRUE(vacant);
  }
}

TEST_F(LifeCount, AToolThatBreaksIsNotUsedAnyMore) {
  run("G10 L3\nP7 L100\nT11\nT12\nG11\nT7 M6\nM30");
  EXPECT_EQ(drive->out.t, 11U);
  drive->in.tool_broken = true;
  for (unsigned n = 0; n < 5; ++n) drive->step(50);
  EXPECT_EQ(life(1, NC_LIFE_STATUS), 3);
  EXPECT_EQ(drive->out.tool_life, NC_TOOL_LIFE_ENDED);
  run("T7 M6\nM30");
  EXPECT_EQ(drive->out.t, 12U);
}

}  // namespace
}  // namespace nc::test
