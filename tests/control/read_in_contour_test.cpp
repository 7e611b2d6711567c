// SPDX-License-Identifier: Apache-2.0
// Reads of the machine between two blocks of a contour with radius compensation: the path is what it is without them, and positions are those at the end of
// what has been read.
#include <gtest/gtest.h>

#include <string>

#include "support/drive.hpp"

namespace nc::test {
namespace {

/// Path of a program in which `%` stands for what is put between its blocks.
Outcome with(const std::string& program, const std::string& between, nc_dialect dialect = NC_DIALECT_M700) {
  std::string text;
  for (const char c : program) text += c == '%' ? between : std::string(1, c);
  Bench bench(dialect);
  bench.tool(1, 3);
  if (dialect != NC_DIALECT_M700) bench.tool(1, 3, NC_TOOL_RADIUS);
  return bench.run(text);
}

constexpr char kInner[] = "G90 G94 G17\nG41 D1 G1 X10. F100\n%Y10.\n%X30.\n%G3 X40. Y20. J10.\n%G1 G40 X40. Y40.\nM30\n";
constexpr char kOuter[] = "G90 G94 G17\nG42 D1 G1 X10. F100\n%Y10.\n%X30.\n%X0 Y12.\n%Y40.\n%G40 X-40.\nM30\n";
constexpr char kAlone[] = "G90 G94 G17\nG41 D1\n%G1 X10. Y0 F100\n%Y10.\n%X30.\nG40\n%X50. Y20.\nM30\n";

TEST(ReadInContour, LeavesThePathAlone) {
  for (const char* program : {kInner, kOuter, kAlone}) {
    const Outcome plain = with(program, "");
    ASSERT_EQ(plain.alarm, "");
    for (const char* read : {"#100=#5041\n", "#100=#5021+#5022\n", "#100=#1000\n", "#100=#3001\n", "#100=#4201\n", "IF[#5043 GT 5.]GOTO9\n", "#100=#5041\n#101=#1001\n#102=#3002\nM8\n"}) {
      const Outcome run = with(program, read);
      EXPECT_EQ(run.alarm, "") << read;
      EXPECT_EQ(run.path(), plain.path()) << program << read;
    }
  }
  const Outcome hx = with("G90 G94 G17\nG41 D1 G01 X10. F100\nY10.\n%X30.\nG40 X40.\nM30\n", "#100=#4083\n", NC_DIALECT_HX);
  EXPECT_EQ(hx.alarm, "");
  EXPECT_EQ(hx.path(), with("G90 G94 G17\nG41 D1 G01 X10. F100\nY10.\n%X30.\nG40 X40.\nM30\n", "", NC_DIALECT_HX).path());
}

/// What the program of an inner corner gives, read at the corner.
double read_at_corner(const char* variable, const std::function<void(Bench&)>& change = {}, const char* head = "") {
  Bench bench;
  bench.tool(1, 3).work_offset(1, {100, 50, 7});
  if (change) change(bench);
  const Outcome run = bench.run(std::string("G54 G90 G94 G17 G0 X0 Y0 Z0\n") + head + "G41 D1 G1 X10. F100\nY10.\n#100=" + variable + "\nX30.\nG40 X40.\nM30\n");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  return run.var(100);
}

TEST(ReadInContour, GivesTheEndOfTheBlockBefore) {  // with the vector at right angles to it, as where the contour ends there (12.4.2)
  EXPECT_EQ(read_at_corner("#5001"), 10);
  EXPECT_EQ(read_at_corner("#5041"), 7);
  EXPECT_EQ(read_at_corner("#5042"), 10);
  EXPECT_EQ(read_at_corner("#5021"), 107);
  EXPECT_EQ(read_at_corner("#5022"), 60);
  EXPECT_EQ(read_at_corner("#5043"), 0);
  EXPECT_EQ(read_at_corner("#5021", {}, "G51.1 X0\n"), 93);  // mirrored behind compensation
}

TEST(ReadInContour, ComesInFrontOfTheBlocksThatWaitForTheCorner) {
  const Outcome run = with(kInner, "");
  ASSERT_EQ(run.of(NC_ITEM_SYNC).size(), 0u);
  const Outcome read = with("G90 G94 G17\nG41 D1 G1 X10. F100\nY10.\n#100=#1000\nX30.\nG40 X40.\nM30\n", "");
  std::string kinds;
  for (const Step& step : read.steps) kinds += step.item.kind == NC_ITEM_SYNC ? 's' : step.item.kind == NC_ITEM_MOVE ? 'm' : '-';
  EXPECT_LT(kinds.find('s'), kinds.find('m')) << kinds;  // the start and its first block are held for the corner behind them
}

// A loop that waits for the machine would be waited for for ever by the corner in front of it.
TEST(ReadInContour, ALoopThatWaitsIsAnAlarm) {
  const Outcome run = with("G90 G94 G17\nG41 D1 G1 X10. F100\nY10.\nWHILE[#1000 EQ 0]DO1\nEND1\nX30.\nG40 X40.\nM30\n", "");
  EXPECT_EQ(run.alarm, "P990");
  EXPECT_EQ(run.alarm_line, 3u);
}

// At the machine the same: it waits for the answer where the block before the ones that are held ends.
TEST(ReadInContour, OnlineAsOffline) {
  const std::string text =
      "G90 G94 G17\nG41 D1 G1 X10. F3000\nY10.\n#100=#5041 #101=#5042\nX30.\n#102=#5021\n#104=#1000\nG3 X40. Y20. J10.\n#103=#5042\nG1 G40 X40. Y40.\nM30\n";
  Bench offline;
  offline.tool(1, 3).input[0] = 1;
  const Outcome expected = offline.run(text);
  ASSERT_EQ(expected.alarm, "");
  Bench bench;
  bench.tool(1, 3);
  Drive drive(bench, text);
  while (!drive.ended && drive.cycle < 100000) {
    drive.press_start();
    drive.in.input[0] = 1;
    drive.step();
  }
  EXPECT_EQ(drive.alarm(), "");
  ASSERT_TRUE(drive.ended);
  for (uint32_t n = 100; n <= 104; ++n) EXPECT_NEAR(bench.var_now(n), expected.var(n), 1e-9) << n;
  EXPECT_NEAR(expected.var(100), 7, 1e-9);
  EXPECT_NEAR(expected.var(102), 30, 1e-9);
  const std::vector<nc_axes> ends = drive.ends();
  const std::vector<nc_move> moves = expected.moves();
  ASSERT_EQ(ends.size(), moves.size());
  for (size_t i = 0; i < ends.size(); ++i)
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(ends[i].v[axis], moves[i].machine.v[axis], 1e-9) << i;
}

/// Value of an input that is on from the place on where Y passes 5, read behind the block Y10, and how far that block has led.
struct ReadOnTheWay {
  double value = -1, corner = 0;
};
ReadOnTheWay read_on_the_way(const std::string& head, const std::string& compensation) {
  Bench bench;
  bench.tool(1, 3);
  bench.add("O1000", "M99\n");
  Drive drive(bench, head + "G90 G94 G17\n" + compensation + "G1 X10. F3000\nY10.\n#100=#1000\nX30.\nG40 X40.\nM30\n");
  while (!drive.ended && drive.cycle < 100000) {
    drive.press_start();
    drive.in.input[0] = drive.out.command.v[1] > 5 ? 1 : 0;
    drive.step();
  }
  EXPECT_EQ(drive.alarm(), "");
  EXPECT_TRUE(drive.ended);
  const std::vector<nc_axes> ends = drive.ends();
  return {bench.var_now(100), ends.size() < 2 ? 0 : ends[1].v[1]};
}

// The input is that of the moment when the blocks in front of those that wait for their corner have been executed; so it is not what the place of the read in the
// program says. Where M96 is in force the order of the program counts: the contour ends in front of the read, at right angles, and the corner is cut.
TEST(ReadInContour, AnInputIsThatOfTheBlocksThatAreExecuted) {
  const ReadOnTheWay without = read_on_the_way("", "");
  EXPECT_EQ(without.value, 1);
  EXPECT_EQ(without.corner, 10);
  const ReadOnTheWay inside = read_on_the_way("", "G41 D1 ");
  EXPECT_EQ(inside.value, 0);
  EXPECT_EQ(inside.corner, 13);
  const ReadOnTheWay outside = read_on_the_way("", "G42 D1 ");
  EXPECT_EQ(outside.value, 0);
  EXPECT_EQ(outside.corner, 7);
  const ReadOnTheWay interrupted = read_on_the_way("M96 P1000\n", "G42 D1 ");
  EXPECT_EQ(interrupted.value, 1);
  EXPECT_EQ(interrupted.corner, 10);
}

// What closes the contour in front of the read, as M00 does: a read while M96 is in force, and one of what part systems share. One part system alone shares nothing.
TEST(ReadInContour, WhatEndsTheBlockBeforeAtRightAngles) {
  const auto path = [](const std::string& program, const std::string& between, unsigned systems) {
    std::string text;
    for (const char c : program) text += c == '%' ? between : std::string(1, c);
    Bench bench(NC_DIALECT_M700, [systems](nc_config& c) {
      c.system_count = static_cast<uint8_t>(systems);
      for (unsigned n = 1; n < systems; ++n) c.system[n] = c.system[0];
    });
    bench.tool(1, 3);
    bench.add("O1000", "M99\n");
    const Outcome run = bench.run(text);
    EXPECT_EQ(run.alarm, "") << text;
    return run.path();
  };
  for (const std::string program : {kInner, kOuter, kAlone}) {
    const Path plain = path(program, "", 1), stopped = path(program, "M0\n", 1);
    EXPECT_NE(plain, stopped);
    EXPECT_EQ(path(program, "#100=#500\n", 1), plain) << program;
    EXPECT_EQ(path(program, "#100=#500\n", 2), stopped) << program;
    EXPECT_EQ(path(program, "#100=#2001\n", 2), stopped) << program;
    EXPECT_EQ(path(program, "#100=#1000\n", 2), plain) << program;
    for (const char* read : {"#100=#1000\n", "#100=#5041\n", "#100=#3002\n"}) EXPECT_EQ(path("M96 P1000\n" + program, read, 1), stopped) << read << program;
    EXPECT_EQ(path("M96 P1000\n" + program, "#100=#500\n", 1), plain) << "nothing is read of the machine";
    EXPECT_EQ(path("M96 P1000\nM97\n" + program, "#100=#1000\n", 1), plain);
  }
}

}  // namespace
}  // namespace nc::test
