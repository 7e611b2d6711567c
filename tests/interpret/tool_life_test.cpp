// SPDX-License-Identifier: Apache-2.0
// Tool life management (M700 13.5.5, system variables 10.15; docs/decisions.md): data by program, the tool of a group, counting, and what programs read.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

class ToolLifeTest : public testing::Test {
 protected:
  ToolLifeTest() { bench.param("1103", "1"); }
  double life(unsigned number, nc_life_column column) {
    double value = NAN;
    EXPECT_EQ(nc_tool_life_get(bench.control(), number, column, &value), NC_OK);
    return value;
  }
  /// "group tool status life used H D" of the tools that are registered.
  std::string table() {
    std::string all;
    for (unsigned n = 1; n <= NC_TOOL_LIVES; ++n) {
      if (life(n, NC_LIFE_GROUP) == 0) continue;
      if (!all.empty()) all += ", ";
      for (const nc_life_column column : {NC_LIFE_GROUP, NC_LIFE_TOOL, NC_LIFE_STATUS, NC_LIFE_LIFE, NC_LIFE_USED, NC_LIFE_LENGTH, NC_LIFE_RADIUS})
        all += (column == NC_LIFE_GROUP ? "" : " ") + brief(life(n, column));
    }
    return all;
  }
  std::string alarm_of(const std::string& text) { return bench.run(text + "\nM30").alarm; }

  Bench bench;
  static constexpr char kTwoGroups[] =
      "G10 L3\nP10 L2 Q1\nT101 H1 D11\nT102 H2 D12\nP20 L5 Q3\nT201 H3 D13\nG11\n";
};

TEST_F(ToolLifeTest, GroupsAreRegisteredByProgram) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(table(), "10 101 0 2 0 1 11, 10 102 0 2 0 2 12, 20 201 0 5 0 3 13");
  EXPECT_EQ(life(1, NC_LIFE_FLAGS), 16) << "mounts";
  EXPECT_EQ(life(3, NC_LIFE_FLAGS), 32) << "uses";
  // Q2 counts minutes; without Q mounts. What was registered before goes.
  EXPECT_EQ(alarm_of("G10 L3\nP30 L60 Q2\nT1\nP31 L7\nT2\nG11"), "");
  EXPECT_EQ(table(), "30 1 0 60 0 0 0, 31 2 0 7 0 0 0");
  EXPECT_EQ(life(1, NC_LIFE_FLAGS), 0);
  EXPECT_EQ(life(2, NC_LIFE_FLAGS), 16);
}

TEST_F(ToolLifeTest, GroupsAreAddedAndRemoved) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(alarm_of("G10 L3 P1\nP30 L1\nT301\nP10 L9\nT111\nG11"), "");
  EXPECT_EQ(table(), "10 111 0 9 0 0 0, 20 201 0 5 0 3 13, 30 301 0 1 0 0 0") << "group 10 is registered anew";
  EXPECT_EQ(alarm_of("G10 L3 P2\nP20\nP30\nG11"), "");
  EXPECT_EQ(table(), "10 111 0 9 0 0 0");
  for (const char* data : {"P10 L9", "P10 Q1", "P10 L9 Q1"}) EXPECT_EQ(alarm_of(std::string("G10 L3 P2\n") + data), "P32") << data << ": of a group that was to be registered, and would be removed";
  EXPECT_EQ(table(), "10 111 0 9 0 0 0");
}

/// One input names a group once; what was registered before it is registered anew.
TEST_F(ToolLifeTest, AGroupIsGivenOnceInAnInput) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(alarm_of("G10 L3 P1\nP10 L9\nT111\nP30 L1\nT301\nP10 L8\nT112\nG11"), "P179");
  EXPECT_EQ(table(), "10 111 0 9 0 0 0, 30 301 0 1 0 0 0, 20 201 0 5 0 3 13") << "the first one stays";
  for (unsigned n = 0; n < 2; ++n) EXPECT_EQ(alarm_of("G10 L3 P1\nP30 L4\nT302\nP10 L7\nT113\nG11"), "") << "another input";
  EXPECT_EQ(table(), "10 113 0 7 0 0 0, 30 302 0 4 0 0 0, 20 201 0 5 0 3 13");
}

TEST_F(ToolLifeTest, WrongDataAreAlarms) {
  const std::pair<const char*, const char*> cases[] = {
      {"P179", "G10 L3\nP1 L1\nT1\nP1 L1"},          // appendix 1: commanded in duplicate
      {"P179", "G10 L3 P1\nP1 L1\nT1\nP1 L1"},
      {"P179", "G10 L3 P1\nP1 L1\nP1 L1"},
      {"P179", "G10 L3 P1\nP1 L1\nT1\nP2 L1\nT2\nP1 L1"},
      {"P179", "G10 L3 P2\nP77"},                    // not registered
      {"P33", "G10 L3\nT1"},                         // a tool without a group
      {"P33", "G10 L3\nP1 Q1"},                      // no life
      {"P33", "G10 L3\nL1"},                         // no group
      {"P33", "G10 L3\nP1 L1\nH1"},                  // no tool
      {"P33", "G10 L3 P2\nT1"},                      // a tool cannot be removed
      {"P35", "G10 L3\nP0 L1"},
      {"P35", "G10 L3\nP100000000 L1"},
      {"P35", "G10 L3\nP1 L4001 Q2"},                // minutes
      {"P35", "G10 L3\nP1 L10000 Q1"},               // times
      {"P35", "G10 L3\nP1 L-1"},
      {"P35", "G10 L3\nP1 L1 Q4"},
      {"P35", "G10 L3\nP1 L1\nT0"},
      {"P35", "G10 L3\nP1 L1\nT1 H201"},
      {"P35", "G10 L3\nP1 L1\nT1 D-1"},
      {"P35", "G10 L3 P3"},
      {"P32", "G10 L3\nP1 L1 T1"},                  // a group and a tool in one block
      {"P32", "G10 L3\nX1."},
      {"P32", "G10 L3\nM3"},
      {"P32", "G10 L3\nG0 X1."},
      {"P32", "G10 L3\nG11 X1."},
      {"P33", "G81 Z-1. R1. F100\nG10 L3"},
  };
  for (const auto& [alarm, text] : cases) EXPECT_EQ(alarm_of(text), alarm) << text;
}

TEST_F(ToolLifeTest, MoreToolsThanThereAreIsP178) {
  std::string text = "G10 L3\nP1 L1\n";
  for (unsigned n = 1; n <= NC_TOOL_LIVES; ++n) text += "T" + std::to_string(n) + "\n";
  EXPECT_EQ(alarm_of(text + "G11"), "");
  EXPECT_EQ(alarm_of(text + "T999"), "P178");
}

TEST_F(ToolLifeTest, TheCommandOfAGroupSelectsItsTool) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  // Group 10 has tools for two mounts each.
  EXPECT_EQ(bench.run("T10 M6\nT20\nM6\nT10\nM6\nT10\nM6\nM30").aux(), "T101 M6 T201 M6 T101 M6 T102 M6 M30");
  EXPECT_EQ(table(), "10 101 2 2 2 1 11, 10 102 1 2 1 2 12, 20 201 1 5 0 3 13");
  EXPECT_EQ(bench.run("T10 M6\nT10 M6\nM30").aux(), "T102 M6 T102 M6 M30") << "all being worn, it is the last one";
  EXPECT_EQ(alarm_of("T33"), "P179") << "not registered";
  EXPECT_EQ(bench.run("T0 M6\nM30").aux(), "T0 M6 M30") << "T0 is no group";
}

TEST_F(ToolLifeTest, WithToolNumbersTheToolIsCountedThatIsNamed) {  // #1104
  bench.param("1104", "1");
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(bench.run("T102 M6\nT5 M6\nT102 M6\nM30").aux(), "T102 M6 T5 M6 T102 M6 M30");
  EXPECT_EQ(table(), "10 101 0 2 0 1 11, 10 102 2 2 2 2 12, 20 201 0 5 0 3 13");
}

TEST_F(ToolLifeTest, WithoutManagementTIsATool) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  bench.param("1103", "0");
  EXPECT_EQ(bench.run("T10 M6\nG1 X1. F100\nM30").aux(), "T10 M6 M30");
  EXPECT_EQ(table(), "10 101 0 2 0 1 11, 10 102 0 2 0 2 12, 20 201 0 5 0 3 13") << "nothing is counted";
}

TEST_F(ToolLifeTest, AUseIsACutBehindRapidTraverse) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(alarm_of("T20 M6\nG0 X1.\nG1 X2. F100\nX3.\nG2 X5. I1.\nG0 X0\nX-1.\nG1 X0\n"), "");
  EXPECT_EQ(life(3, NC_LIFE_USED), 2);
  EXPECT_EQ(alarm_of("T20 M6\nG81 X1. Z-1. R1. F100\nX2.\nG80"), "");
  EXPECT_EQ(life(3, NC_LIFE_USED), 4) << "each hole";
  EXPECT_EQ(life(3, NC_LIFE_STATUS), 1);
  EXPECT_EQ(alarm_of("T20 M6\nG1 X9. F100"), "");
  EXPECT_EQ(life(3, NC_LIFE_STATUS), 2) << "5 uses";
}

TEST_F(ToolLifeTest, TheOffsetsOfTheToolInTheSpindleAreNumber99) {
  bench.tool(2, 25).tool(12, 3).tool(99, 77);
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  for (const char* without : {"G0 G43 H99 Z0", "G41 D99 G1 X5. F100", "T20\nG0 G43 H99 Z0", "G10 L10 P99 R5.\nG0 G43 H99 Z0"}) EXPECT_EQ(alarm_of(without), "P170") << without << ": no managed tool is in the spindle";
  EXPECT_EQ(bench.run("T10 M6\nT10 M6\nT10 M6\nG0 G43 H99 Z0\nM30").path(), (Path{"rapid 0 0 25"})) << "tool 102";
}

TEST_F(ToolLifeTest, AToolInTheSpindleThatIsRegisteredAnewIsTheSameTool) {
  bench.tool(1, 1).tool(2, 2).tool(7, 7).tool(99, 77);
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(bench.run("T10 M6\nG10 L3 P1\nP10 L5\nT101 H7\nG11\nG0 G43 H99 Z0\nM30").path(), (Path{"rapid 0 0 7"}));
  bench.at(0, 0, 0);
  EXPECT_EQ(bench.run("T10 M6\nG10 L3\nP40 L5\nT1\nP41 L5\nT101 H2\nG11\nG0 G43 H99 Z0\nG49\nM30").path(), (Path{"rapid 0 0 2", "rapid 0 0 0"})) << "in another group, in another place";
  bench.at(0, 0, 0);
  EXPECT_EQ(alarm_of("T41 M6\nG10 L3 P2\nP41\nG11\nG0 G43 H99 Z0"), "P170") << "removed";
  EXPECT_EQ(bench.run("G10 L3 P1\nP41 L5\nT101 H1\nG11\nG0 G43 H99 Z0\nM30").path(), (Path{"rapid 0 0 1"})) << "and registered once more by a later program";
  bench.at(0, 0, 0);
  EXPECT_EQ(alarm_of("T41 M6\nG10 L3 P1\nP41 L5\nT102 H1\nG11\nG0 G43 H99 Z0"), "P170") << "another number";
  EXPECT_EQ(bench.run("G10 L3\nP10 L5\nT101 H1\nT102 H2\nG11\nT10\nG10 L3 P1\nP10 L5\nT101 H7\nG11\nM6\nG0 G43 H99 Z0\nM30").path(), (Path{"rapid 0 0 7"})) << "between T and M06";
}

// M700 23300-23753: the table of #60001 to #60008, and the examples (1) to (4).
TEST_F(ToolLifeTest, TheVariablesOfAGroup) {
  const auto group = [this](const std::string& before) {
    std::string text = before, all;
    for (unsigned n = 1; n <= 8; ++n) text += "#" + std::to_string(500 + n) + "=#" + std::to_string(60000 + n) + "\n";
    const Outcome run = bench.run(text + "M30");
    EXPECT_EQ(run.alarm, "");
    for (unsigned n = 1; n <= 8; ++n) all += (n == 1 ? "" : " ") + brief(run.var(500 + n));
    return all;
  };
  EXPECT_EQ(group(""), "-1 -1 -1 -1 -1 -1 -1 -1") << "nothing is registered";
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  // tools, used, selected, first alive, in use, -, all ended, next is new
  EXPECT_EQ(group(""), "2 0 1 1 0 0 0 1") << "the group registered first";
  EXPECT_EQ(group("#60000=20\n"), "1 0 1 1 0 0 0 1");
  EXPECT_EQ(group("#60000=9999\n"), "-1 -1 -1 -1 -1 -1 -1 -1");
  EXPECT_EQ(group("T10 M6\n"), "2 1 1 1 1 0 0 0");
  EXPECT_EQ(group("T10 M6\n"), "2 2 1 2 1 0 0 1") << "tool 101 is worn and in the spindle";
  EXPECT_EQ(group("T10 M6\n"), "2 1 2 2 1 0 0 0");
  EXPECT_EQ(group("T10 M6\n"), "2 2 2 0 1 0 1 0") << "all are worn";
  EXPECT_EQ(group("T20 M6\n"), "2 2 2 0 0 0 1 0") << "the spindle has another tool";
}

TEST_F(ToolLifeTest, TheVariablesOfEachTool) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  EXPECT_EQ(alarm_of("T10 M6\nT10 M6"), "");
  const auto tool = [this](unsigned number, const std::string& before = "") {
    std::string text = before, all;
    for (unsigned c = 0; c < 9; ++c) text += "#" + std::to_string(501 + c) + "=#" + std::to_string(60500 + 500 * c + number) + "\n";
    const Outcome run = bench.run(text + "M30");
    EXPECT_EQ(run.alarm, "");
    for (unsigned c = 0; c < 9; ++c) all += (c == 0 ? "" : " ") + brief(run.var(501 + c));
    return all;
  };
  EXPECT_EQ(tool(1), "10 101 16 2 2 2 1 11 0");
  EXPECT_EQ(tool(2), "10 102 16 0 2 0 2 12 0");
  EXPECT_EQ(tool(3), "-1 -1 -1 -1 -1 -1 -1 -1 -1") << "(3): registration number not used";
  EXPECT_EQ(tool(1, "#60000=20\n"), "20 201 32 0 5 0 3 13 0");
  EXPECT_EQ(tool(200), "-1 -1 -1 -1 -1 -1 -1 -1 -1");
  EXPECT_EQ(alarm_of("#1=#60701"), "P241") << "out of the specifications";
  EXPECT_NE(alarm_of("#60001=1"), "") << "read only";
}

// What was read ahead is taken back with its block, what the host writes is not.
TEST_F(ToolLifeTest, ARewindTakesBackWhatItsBlocksHaveCounted) {
  EXPECT_EQ(alarm_of(kTwoGroups), "");
  bench.start("G0 X1.\nT10 M6\nG10 L3\nP5 L1\nT5\nG11\nM30");
  nc_item item;
  uint64_t first = 0;
  while (nc_pull(bench.control(), 0, 1000, &item) == NC_OK) {
    if (item.kind == NC_ITEM_MARK && first == 0) first = item.serial;
    if (item.kind != NC_ITEM_SYNC) continue;
    const nc_world world{};  // T and M06 of managed tools wait for the machine
    ASSERT_EQ(nc_answer(bench.control(), 0, &world), NC_OK);
  }
  EXPECT_EQ(table(), "5 5 0 1 0 0 0");
  ASSERT_EQ(nc_rewind(bench.control(), 0, first), NC_OK);
  EXPECT_EQ(table(), "10 101 0 2 0 1 11, 10 102 0 2 0 2 12, 20 201 0 5 0 3 13");
}

TEST_F(ToolLifeTest, TheHostReadsAndWritesTheTable) {
  nc_control* const control = bench.control();
  double value = 0;
  EXPECT_EQ(nc_tool_life_set(control, 3, NC_LIFE_GROUP, 7), NC_OK);
  EXPECT_EQ(nc_tool_life_set(control, 3, NC_LIFE_USED, 1.25), NC_OK);
  EXPECT_EQ(life(3, NC_LIFE_USED), 1.25);
  for (const auto& [column, wrong] : {std::pair{NC_LIFE_GROUP, 1e8}, {NC_LIFE_TOOL, -1.0}, {NC_LIFE_FLAGS, 256.0}, {NC_LIFE_STATUS, 5.0}, {NC_LIFE_STATUS, 0.5},
                                      {NC_LIFE_LIFE, 10000.0}, {NC_LIFE_USED, -1.0}, {NC_LIFE_LENGTH, 201.0}, {NC_LIFE_AUXILIARY, 1e12}, {NC_LIFE_GROUP, double{NAN}}})
    EXPECT_EQ(nc_tool_life_set(control, 3, column, wrong), NC_E_ARGUMENT) << column;
  EXPECT_EQ(nc_tool_life_set(control, 0, NC_LIFE_GROUP, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_life_set(control, NC_TOOL_LIVES + 1, NC_LIFE_GROUP, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_life_get(control, NC_TOOL_LIVES + 1, NC_LIFE_GROUP, &value), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_life_get(control, 1, NC_LIFE_GROUP, nullptr), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
