// SPDX-License-Identifier: Apache-2.0
// Chamfers and roundings beside arcs, on a machine with the option (corner_ii): the cut touches both blocks, or lies at its distance from the corner.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/pull.hpp"

namespace nc::test {
namespace {

using Path = std::vector<std::string>;

Outcome run_of(const std::string& text, bool option = true, double radius = 0) {
  Bench bench;
  if (option) bench.param("corner_ii", "1");
  if (radius > 0) bench.tool(1, radius);
  return bench.run(text);
}

Path path_of(const std::string& text) {
  const Outcome run = run_of(text);
  EXPECT_EQ(run.alarm, "") << text << run.alarm_detail;
  Path all = run.path();
  for (std::string& move : all)
    if (const size_t feed = move.find(" F"); feed != std::string::npos) move.resize(feed);
  return all;
}

std::string alarm_of(const std::string& text, bool option = true) {
  const Outcome run = run_of(text, option);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

struct Point {
  double x = 0, y = 0;
};
double apart(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

Point end_of(const nc_move& move) { return {move.machine.v[0], move.machine.v[1]}; }
Point start_of(const nc_move& move) { return {move.machine_start.v[0], move.machine_start.v[1]}; }
Point center_of(const nc_move& move) { return {move.machine_center[0], move.machine_center[1]}; }

/// Unit tangent in the direction of travel.
Point tangent(const nc_move& move, bool at_end) {
  if (move.plane == NC_PLANE_NONE) {
    const double length = apart(start_of(move), end_of(move));
    return {(end_of(move).x - start_of(move).x) / length, (end_of(move).y - start_of(move).y) / length};
  }
  const Point at = at_end ? end_of(move) : start_of(move), c = center_of(move);
  const double radius = apart(at, c), sense = move.ccw ? 1 : -1;
  return {-sense * (at.y - c.y) / radius, sense * (at.x - c.x) / radius};
}

TEST(ArcCorner, WithoutTheOptionAnAlarm) {
  EXPECT_EQ(alarm_of("G1 X30. ,R4. F100\nG3 X0 Y30. R30.\nM30", false), "P381 L2");
  EXPECT_EQ(alarm_of("G3 X30. Y30. R30. ,R4. F100\nG1 X0\nM30", false), "P381 L1");
}

TEST(ArcCorner, RoundingBetweenLineAndArc) {
  // Line along X to (10, 0), then round (0, 0) counter-clockwise: the centre of the rounding lies 2 above the line and 8 from (0, 0).
  const double x = std::sqrt(64.0 - 4.0);
  const Path path = path_of("G1 X10. ,R2. F100\nG3 X0 Y10. I-10. J0\nM30");
  ASSERT_EQ(path.size(), 3u);
  EXPECT_EQ(path[0], "line " + brief(x) + " 0 0");
  EXPECT_EQ(path[1], "ccw " + brief(x * 1.25) + " 2.5 0 c" + brief(x) + ",2");
  EXPECT_EQ(path[2], "ccw 0 10 0 c0,0");
}

TEST(ArcCorner, ChamferBetweenArcAndLine) {  // 6 from the corner: on the arc by its chord
  const Path path = path_of("G1 X10. F100\nG3 X0 Y10. I-10. J0 ,C6.\nG1 Y30.\nM30");
  ASSERT_EQ(path.size(), 4u);
  const double angle = std::acos(-1.0) / 2 - 2 * std::asin(0.3);
  EXPECT_EQ(path[1], "ccw " + brief(10 * std::cos(angle)) + ' ' + brief(10 * std::sin(angle)) + " 0 c0,0");
  EXPECT_EQ(path[2], "line 0 16 0");
  EXPECT_EQ(path[3], "line 0 30 0");
}

TEST(ArcCorner, EveryRoundingTouchesBothBlocksAndEveryChamferHasItsSize) {
  std::mt19937 random(11);
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  unsigned cut = 0, alarms = 0;
  for (unsigned i = 0; i < 600; ++i) {
    char text[400];
    const bool chamfer = i % 2 == 0, first_round = i % 3 != 1, second_round = i % 3 != 2;
    const double amount = number(0.2, 3);
    const Point corner{number(10, 20), number(-10, 10)}, end{number(-10, 40), number(12, 20)};
    const double r1 = apart({}, corner) * number(0.52, 2), r2 = apart(corner, end) * number(0.52, 2);
    const auto block = [&](bool round, Point to, double radius, const char* word) {
      char words[100];
      if (round) std::snprintf(words, sizeof words, "G%d X%.4f Y%.4f R%.4f %s", random() % 2 == 0 ? 2 : 3, to.x, to.y, radius, word);
      else std::snprintf(words, sizeof words, "G1 X%.4f Y%.4f %s", to.x, to.y, word);
      return std::string(words);
    };
    char word[30];
    std::snprintf(word, sizeof word, ",%c%.4f", chamfer ? 'C' : 'R', amount);
    std::snprintf(text, sizeof text, "F100\n%s\n%s\nM30", block(first_round, corner, r1, word).c_str(), block(second_round, end, r2, "").c_str());
    const Outcome run = run_of(text);
    if (run.alarm != "") {
      EXPECT_TRUE(run.alarm == "P383" || run.alarm == "P384") << text << run.alarm;
      ++alarms;
      continue;
    }
    const std::vector<nc_move> moves = run.moves();
    if (moves.size() != 3) continue;  // straight on
    ++cut;
    EXPECT_LT(apart(end_of(moves[0]), start_of(moves[1])), 1e-9) << text;
    EXPECT_LT(apart(end_of(moves[1]), start_of(moves[2])), 1e-9) << text;
    EXPECT_LT(apart(end_of(moves[2]), end), 1e-4) << text;
    for (const nc_move& move : moves) {
      if (move.plane == NC_PLANE_NONE) continue;
      EXPECT_NEAR(apart(start_of(move), center_of(move)), apart(end_of(move), center_of(move)), 1e-6) << text;
    }
    const Point k{std::round(corner.x * 1e4) / 1e4, std::round(corner.y * 1e4) / 1e4};
    const double size = std::round(amount * 1e4) / 1e4;
    if (chamfer) {
      EXPECT_NEAR(apart(end_of(moves[0]), k), size, 1e-6) << text;
      EXPECT_NEAR(apart(start_of(moves[2]), k), size, 1e-6) << text;
      EXPECT_EQ(moves[1].plane, NC_PLANE_NONE) << text;
    } else {
      EXPECT_NEAR(moves[1].radius, size, 1e-6) << text;
      for (unsigned joint = 0; joint < 2; ++joint) {
        const Point a = tangent(moves[joint], true), b = tangent(moves[joint + 1], false);
        EXPECT_NEAR(a.x * b.x + a.y * b.y, 1, 1e-9) << text << joint;
      }
    }
  }
  EXPECT_GT(cut, 300u);
  EXPECT_GT(alarms, 5u);
}

TEST(ArcCorner, WhatDoesNotFitIsAnAlarm) {
  EXPECT_EQ(alarm_of("G1 X-30. F100\nX10. ,R12.\nG3 X0 Y10. I-10. J0\nM30"), "P384 L3");  // the arc turns to that side, and is smaller
  EXPECT_EQ(alarm_of("G1 X10. F100\nG3 X0 Y10. I-10. J0 ,C16.\nG1 Y30.\nM30"), "P383 L2");  // its whole chord is 14.1
  EXPECT_EQ(alarm_of("G1 X10. F100\nG3 X0 Y10. I-10. J0 ,C6.\nG1 Y13.\nM30"), "P384 L3");
  EXPECT_EQ(alarm_of("G1 X10. F100\nG3 X0 Y10. I-10. J0 ,C6.\nG0 Y13.\nM30"), "P382 L3");
  EXPECT_EQ(alarm_of("G1 X10. F100\nG3 X0 Y10. I-10. J0 ,C6.\nM0\nG1 Y13.\nM30"), "P382 L3");
  for (const char* const corner : {",C2.", ",R2."})  // an arc that goes nowhere
    for (const char* const arc : {"G3 R-4.", "G3 R4.", "G3 X20. Y0 R4."})
      for (const char* const behind : {"G1 Y9.\n", ""}) EXPECT_EQ(alarm_of(std::string("G1 X20.") + corner + " F100\n" + arc + "\n" + behind + "M30"), "P382 L2") << corner << arc << behind;
}

TEST(ArcCorner, SeveralInARowAndTheHelix) {
  const Outcome run = run_of("G1 X40. ,R3. F100\nG3 X40. Y40. R25. ,R3.\nG1 X0 ,C2.\nG2 X0 Y0 R25.\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.moves().size(), 7u);
  const Path helix = path_of("G1 X10. ,R2. F100\nG3 X0 Y10. I-10. J0 Z-9.\nM30");
  ASSERT_EQ(helix.size(), 3u);
  EXPECT_EQ(helix[2].substr(0, 9), "ccw 0 10 ");
}

TEST(ArcCorner, RadiusCompensationFollowsTheShape) {
  const auto tool_path = [](const std::string& contour) {
    const Outcome run = run_of("G0 X-20. Y-20.\nG1 G42 D1 X0 Y0 F100\n" + contour + "G1 G40 X-20. Y30.\nM30", true, 1);
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    return run.path();
  };
  const double x = std::sqrt(60.0);
  char written[200];
  std::snprintf(written, sizeof written, "X%.9f\nG3 X%.9f Y2.5 I0 J2.\nG3 X0 Y10. I%.9f J-2.5\nG1 X-10.\n", x, 1.25 * x, -1.25 * x);
  EXPECT_EQ(tool_path("X10. ,R2.\nG3 X0 Y10. I-10. J0\nG1 X-10.\n"), tool_path(written));
}

}  // namespace
}  // namespace nc::test
