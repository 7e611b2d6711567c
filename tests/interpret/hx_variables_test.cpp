// SPDX-License-Identifier: Apache-2.0
// HX 14.2.3: the system variables, one row for each range of the table: what its first and its last number read, and whether a program may write them. What a
// written one does is looked for in the tables of the control.
#include <gtest/gtest.h>

#include "dialect/dialect.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

struct VariableCase {
  uint32_t first, last;
  const char* before;     ///< blocks in front of the reading
  double reads_first, reads_last;
  bool written;
};

constexpr double kVacant = -1e9;  ///< the machine has no such axis: a fault, or without a value

const VariableCase kCases[] = {
    {2112, 2239, "G10 L12 P1 R3.\nG10 L12 P128 R4.", 3, 4, true},
    {2240, 2367, "G10 L10 P1 R3.\nG10 L10 P128 R4.", 3, 4, true},
    {2368, 2370, "#2368=5.\n#2370=6.", 5, 6, true},
    {2377, 2430, "#2377=5.", 5, kVacant, true},
    {3000, 3082, "", kVacant, kVacant, true},  // those that something asks for: see the tests of parameters
    {3083, 3083, "#3083=1", 1, 1, true},
    {3084, 3999, "", kVacant, kVacant, true},
    {4083, 4086, "G92 X7.", 7, kVacant, false},
    {4379, 4382, "G31 X9. F100", 9, kVacant, false},
    {4792, 4792, "S500", 500, 500, false},
    {4882, 4883, "D5 G43 H6", 5, 6, false},
    {5001, 5004, "G92 X7.", 7, kVacant, false},
    {5021, 5024, "G53 X8.", 8, kVacant, false},
    {6205, 6208, "G53 X8.", 8, kVacant, false},
    {6319, 6350, "G31 X9. F100", 9, kVacant, false},
    {6716, 6716, "N77", 77, 77, false},
    {6718, 6749, "G01 F1.", 1, kVacant, false},
    {7000, 7031, "", 1, 1, false},
    {7032, 7035, "", 2147483649.0, 40, false},
    {7500, 7531, "#7500=1\n#7531=1", 1, 1, true},
    {7532, 7535, "#7532=12\n#7535=-7", 12, 4294967289.0, true},
    {8000, 8095, "", 100, kVacant, false},
    {20000, 29999, "", kVacant, kVacant, true},
};

TEST(HxVariables, SingleBlockIsSuppressedOrNot) {
  for (const char* value : {"2", "3", "0.5", "-1"}) EXPECT_EQ(Bench(NC_DIALECT_HX).run(std::string("#3083=") + value + "\nM30").alarm, "F_82002") << value;
  Bench bench(NC_DIALECT_HX);
  const Outcome run = bench.run("#3083=1\n#100=#3083\n#3083=0\n#101=#3083\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 0);
}

Bench& prepared(Bench& bench) {
  bench.input[0] = 0x80000001u;
  bench.input[3] = 40;
  return bench.param("22097", "100");
}

TEST(HxVariables, ReadWhatTheTableSays) {
  for (const VariableCase& row : kCases) {
    Bench bench(NC_DIALECT_HX);
    std::string text = std::string(row.before) + "\n";
    if (row.reads_first != kVacant) text += "#100=#" + std::to_string(row.first) + "\n";
    if (row.reads_last != kVacant) text += "#101=#" + std::to_string(row.last) + "\n";
    if (row.first == 6716) text = "N77 #100=#6716 #101=#6716\n";
    const Outcome run = prepared(bench).run(text + "M30");
    EXPECT_EQ(run.alarm, "") << row.first << ": " << run.alarm_detail;
    EXPECT_EQ(row.reads_first == kVacant ? kVacant : run.var(100), row.reads_first) << row.first;
    EXPECT_EQ(row.reads_last == kVacant ? kVacant : run.var(101), row.reads_last) << row.last;
  }
}

TEST(HxVariables, AreWrittenWhereTheTableSaysSo) {
  for (const VariableCase& row : kCases) {
    if (row.written) continue;
    Bench bench(NC_DIALECT_HX);
    const Outcome run = prepared(bench).run("G00 X1.\n#" + std::to_string(row.first) + "=1\nM30");
    EXPECT_EQ(run.alarm, "NC-VARIABLE") << row.first;
    EXPECT_EQ(run.alarm_line, 2u) << row.first;
  }
  Bench bench(NC_DIALECT_HX);
  const Outcome run = bench.run("#2112=1.\n#2239=2.\n#2240=3.\n#2367=4.\n#2368=5.\n#2378=6.\n#2422=7.\n#3129=8.\n#22098=9.\n#7500=1\n#7533=3\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(bench.tool_now(1, NC_TOOL_RADIUS), 1);
  EXPECT_EQ(bench.tool_now(128, NC_TOOL_RADIUS), 2);
  EXPECT_EQ(bench.tool_now(1, NC_TOOL_LENGTH), 3);
  EXPECT_EQ(bench.tool_now(128, NC_TOOL_LENGTH), 4);
  EXPECT_EQ(bench.work_offset_now(0, 0), 5);
  EXPECT_EQ(bench.work_offset_now(1, 1), 6);
  EXPECT_EQ(bench.work_offset_now(6, 0), 7);
  double value = 0;
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "3129", 0, &value), NC_OK);
  EXPECT_EQ(value, 8);
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "22098", 0, &value), NC_OK);
  EXPECT_EQ(value, 9);
  // The words of outputs go out at once, each bit by itself.
  std::string outputs;
  for (const nc_item& item : run.of(NC_ITEM_ACTION))
    if (item.u.action.kind == NC_ACTION_OUTPUT) outputs += std::to_string(item.u.action.index) + ":" + std::to_string(item.u.action.mask) + ":" + std::to_string(item.u.action.bits) + " ";
  EXPECT_EQ(outputs, "0:1:1 1:4294967295:3 ");
}

TEST(HxVariables, AreThoseOfTheTable) {
  const Table<VariableRow>& rows = dialect(NC_DIALECT_HX).variables->rows;
  size_t i = 0;
  for (const VariableRow& row : rows) {
    ASSERT_LT(i, sizeof kCases / sizeof kCases[0]);
    EXPECT_EQ(row.first, kCases[i].first);
    EXPECT_EQ(row.last, kCases[i].last);
    ++i;
  }
  EXPECT_EQ(i, sizeof kCases / sizeof kCases[0]);
}

TEST(HxVariables, ThirtyFourToNinetyNineAreLocal) {  // 14.2.3, 14.4
  Bench bench(NC_DIALECT_HX);
  const Outcome run = bench.run("#100=0\n#34=1\n#99=2\n#1=3\nG65 P1 A5.\n#103=#34+#99+#1\nM30\nO1\nIF [#34 EQ #0] GOTO 1\n#100=1\nN1 #34=7\n#99=8\n#101=#1\n#102=#[30+4]\nM99");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.var(100), 0);  // vacant in the macro that is called
  EXPECT_EQ(run.var(101), 5);
  EXPECT_EQ(run.var(102), 7);
  EXPECT_EQ(run.var(103), 6);  // and as they were behind it
}

TEST(HxVariables, AnAmountOfRadiusHasTheRangeOf13_3) {  // +-999.999 mm, +-99.999 inch
  for (const char* text : {"G10 L12 P3 R1000.", "G10 L12 P3 R-1234.", "#2113=1000.", "G20\nG10 L12 P3 R100.", "G20\n#2113=-200.", "G10 L12 P3 R600.\nG91 G10 L12 P3 R500."})
    EXPECT_EQ(Bench(NC_DIALECT_HX).run(std::string(text) + "\nM30").alarm, "F_82002") << text;
  for (const char* text : {"G10 L12 P3 R999.999", "G10 L12 P3 R-999.999", "#2113=999.999", "G20\nG10 L12 P3 R99.999", "G20\n#2113=-99.999", "G10 L10 P3 R1234.", "#2240=1234."})
    EXPECT_EQ(Bench(NC_DIALECT_HX).run(std::string(text) + "\nM30").alarm, "") << text;
}

}  // namespace
}  // namespace nc::test
