// SPDX-License-Identifier: Apache-2.0
// Lines of a nanometre: the last digit of their words says where they lead, so they have no direction of their own. The tool's path is that of the
// contour without them, and a contour of nothing else is followed all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "path_builder.hpp"

namespace nc::test {
namespace {

constexpr double kNanometre = 1e-6;

double apart(const AxisVec& a, const AxisVec& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// A corner of `turn_deg` at the origin, the tool on the left; with a line of a nanometre in it, where `facet_deg` is a direction.
std::vector<Item> corner(double turn_deg, double facet_deg, bool facet) {
  const double turn = turn_deg * std::numbers::pi / 180, way = facet_deg * std::numbers::pi / 180;
  PathBuilder path(-80, 10);
  path.side(1, 8.653);
  path.comp.check = true;
  path.line(-60, 0);
  path.line(0, 0);
  if (facet) {
    path.by(kNanometre * std::cos(way), kNanometre * std::sin(way));
  } else {
    path.idle();
  }
  path.by(60 * std::cos(turn), 60 * std::sin(turn));
  path.cancel().by(20, 20);
  path.end();
  return run_stage(path);
}

TEST(WithoutDirection, AFacetOfANanometreLeavesTheCornerAsItIs) {
  for (double turn = -165; turn <= 150; turn += 15) {
    if (turn == 0) continue;
    const std::vector<Item> plain = corner(turn, 0, false);
    ASSERT_EQ(alarm_of(plain), nullptr) << turn;
    for (double way = 0; way < 360; way += 22.5) {
      const std::vector<Item> out = corner(turn, way, true);
      ASSERT_EQ(alarm_of(out), nullptr) << turn << " " << way;
      AxisVec start;
      start[0] = -80;
      start[1] = 10;
      for (const uint32_t block : {1u, 2u, 3u, 4u}) EXPECT_LE(apart(at_block(out, start, block), at_block(plain, start, block)), 2 * kNanometre) << turn << " " << way << " block " << block;
    }
  }
}

TEST(WithoutDirection, ACircleOfNothingElseIsFollowed) {
  constexpr double kRadius = 0.5, kAmount = 2;
  constexpr unsigned kLines = 12000;  // a quarter of a micrometre each
  PathBuilder path(kRadius, -10);
  path.side(-1, kAmount);  // counter-clockwise, the tool outside
  path.comp.check = true;
  path.line(kRadius, 0);
  for (unsigned i = 1; i <= kLines; ++i) {
    const double angle = 2 * std::numbers::pi * i / kLines;
    path.line(kRadius * std::cos(angle), kRadius * std::sin(angle));
  }
  path.cancel().line(10, 0);
  path.end();
  const std::vector<Item> out = run_stage(path);
  ASSERT_EQ(alarm_of(out), nullptr);
  double least = INFINITY, most = 0;
  const std::vector<Move> moves = moves_of(out);
  ASSERT_GT(moves.size(), kLines / 2);
  for (size_t i = 1; i + 1 < moves.size(); ++i) {  // without the way in and the way out
    EXPECT_EQ(moves[i].start, moves[i - 1].end);
    const double from_center = std::hypot(moves[i].end[0], moves[i].end[1]);
    least = std::min(least, from_center);
    most = std::max(most, from_center);
  }
  EXPECT_GT(least, kRadius + kAmount - 1e-3);
  EXPECT_LT(most, kRadius + kAmount + 1e-3);
}

TEST(WithoutDirection, WhatIsLeftOfAnArcOfTheToolsRadiusIsALine) {  // rounding, which would stop the machine as the bend that it is
  PathBuilder path(-20, 20);
  path.side(1, 5 - 2e-8);
  path.line(0, 0).line(50, 0).arc_by(true, 5, 5, 0, 5).line(55, 60);
  path.cancel().line(40, 80);
  path.end();
  const std::vector<Item> out = run_stage(path);
  ASSERT_EQ(alarm_of(out), nullptr);
  for (const Move& move : moves_of(out)) EXPECT_FALSE(move.circular);
  const AxisVec at = at_block(out, path.start(), 3);
  EXPECT_NEAR(at[0], 50, 1e-6);
  EXPECT_NEAR(at[1], 5, 1e-6);
}

// Two half circles of the tool's own radius, whose centres the last digit of their words puts apart: each has a point left of it, and the tool stands there. No P152,
// whichever way rounding has it, and whatever the size.
TEST(WithoutDirection, ArcsOfTheToolsRadiusMeetInTheirCentre) {
  for (const double scale : {1.0, 0.5}) {
    for (const double digit : {0.0, 1e-6}) {
      PathBuilder path(0, 0);
      path.side(1, 2.019 * scale - 2e-6);
      path.comp.check = true;
      const double x = 1.896433 * scale, y = -0.692753 * scale;
      path.line(x, y);
      path.arc(true, -1.896372 * scale + digit, 0.692918 * scale, -x, -y);
      path.by(-0.000121 * scale, -0.000331 * scale);
      path.arc(true, x, y, 1.896493 * scale, -0.692587 * scale - digit);
      path.cancel().line(0, 0);
      path.end();
      const std::vector<Item> out = run_stage(path);
      EXPECT_EQ(alarm_of(out), nullptr) << scale << ' ' << digit;
      for (const Move& move : moves_of(out)) EXPECT_LT(std::hypot(move.end[0], move.end[1]), 1e-3) << scale << ' ' << digit;
    }
  }
}

TEST(WithoutDirection, OneThatOpensTheContourWaitsForABlockWithADirection) {
  PathBuilder path(-20, -5);
  path.side(1, 3);
  path.line(0, 0);
  path.by(0, -kNanometre);  // straight back
  path.line(40, 0);
  path.cancel().by(5, 5);
  path.end();
  const std::vector<Item> out = run_stage(path);
  ASSERT_EQ(alarm_of(out), nullptr);
  const AxisVec at = at_block(out, path.start(), 1);
  EXPECT_NEAR(at[0], 0, 2 * kNanometre);
  EXPECT_NEAR(at[1], 3, 2 * kNanometre);
}

// A change of the amount in such a line takes place between the blocks around it: the one in front ends where the corner with its amount is, the one behind begins where the
// corner with its own is, wherever the line leads.
TEST(WithoutDirection, OneThatChangesTheAmount) {
  const auto beside = [](double turn, double way, double before, double behind) {  // the end of the block in front, the start of the one behind
    PathBuilder path(-80, 10);
    path.side(1, before);
    path.comp.check = true;
    path.line(-60, 0).line(0, 0);
    path.side(1, behind);
    path.comp.check = true;
    if (before != behind) path.by(kNanometre * std::cos(way), kNanometre * std::sin(way));
    path.by(60 * std::cos(turn), 60 * std::sin(turn));
    path.cancel().by(20, 20).end();
    const std::vector<Item> out = run_stage(path);
    EXPECT_EQ(alarm_of(out), nullptr) << turn << ' ' << way << ' ' << before;
    std::pair<AxisVec, AxisVec> ends;
    const uint32_t last = before != behind ? 4 : 3;
    for (const Item& item : out) {
      if (item.kind != ItemKind::move || item.move.connecting) continue;
      if (item.source.line == 2) ends.first = item.move.end;
      if (item.source.line == last) ends.second = item.move.start;
    }
    return ends;
  };
  for (double turn = -165; turn <= 150; turn += 15) {
    for (double way = 0; way < 360; way += 22.5) {
      for (const auto& [before, behind] : {std::pair{5.0, 4.0}, std::pair{4.0, 5.0}}) {
        const double rad = std::numbers::pi / 180;
        const auto ends = beside(turn * rad, way * rad, before, behind), first = beside(turn * rad, 0, before, before), last = beside(turn * rad, 0, behind, behind);
        EXPECT_LE(apart(ends.first, first.first), 1e-5) << turn << ' ' << way << ' ' << before;
        EXPECT_LE(apart(ends.second, last.second), turn < -90 ? behind + 1e-5 : 1e-5) << turn << ' ' << way << ' ' << before;  // of a lengthened corner with two amounts the last vector stays
      }
    }
  }
}

// A change of side in such a line takes place between the blocks around it: its own direction would end the arc wherever it crosses it.
TEST(WithoutDirection, OneThatChangesTheSide) {
  const auto ends = [](double tiny) {
    PathBuilder path(20, 0);
    path.side(-1, 1);
    path.line(10, 0).arc_by(true, -10, 10, -10, 0);
    path.comp.side = 1;
    if (tiny > 0) path.by(tiny, 0);
    path.line(-10, 10);
    path.cancel().line(-20, 20);
    path.end();
    const std::vector<Item> out = run_stage(path);
    EXPECT_EQ(alarm_of(out), nullptr);
    return at_block(out, path.start(), 2);
  };
  const AxisVec without = ends(0), with = ends(3e-4);
  EXPECT_NEAR(with[0], without[0], 1e-3);
  EXPECT_NEAR(with[1], without[1], 1e-3);
}

// Behind a vector that the program gives no joint leads to the other side. The tool goes there before the block begins; an arc was a spiral through its wall.
TEST(WithoutDirection, OneThatChangesTheSideBehindAVectorOfTheProgram) {
  for (const double tiny : {0.0, 5e-5}) {
    PathBuilder path(-5, 0);
    path.side(1, 1);
    path.one_shot(path.vector(1, 0)).line(0, 0);
    path.comp.side = -1;
    if (tiny > 0) path.by(tiny, 0);
    else path.command();
    path.arc_by(true, 0, 20, 0, 10);
    path.cancel().line(-20, 20);
    path.end();
    const std::vector<Item> out = run_stage(path);
    ASSERT_EQ(alarm_of(out), nullptr) << tiny;
    unsigned arcs = 0;
    for (const Move& move : moves_of(out)) {
      if (!move.circular) continue;
      ++arcs;
      EXPECT_NEAR(move.start[1], -1, 1e-3) << tiny;
      EXPECT_NEAR(std::hypot(move.start[0] - tiny, move.start[1] - 10), std::hypot(move.end[0] - tiny, move.end[1] - 10), 1e-6) << "no spiral, " << tiny;
    }
    EXPECT_EQ(arcs, 1u);
  }
}

// Where the path goes on straight, the side changes at right angles, into an arc as into a line: the curves beside would meet far ahead, through the wall.
TEST(WithoutDirection, AChangeOfSideWhereTheArcIsTangent) {
  for (const double bend : {0.0, 1e-8, 1e-6, 1e-3}) {
    PathBuilder path(-15, 0);
    path.side(1, 2);
    path.line(-10, 0).line(0, 0);
    path.comp.side = -1;
    path.arc_by(true, 20 * std::sin(bend), 20 + 20 * std::cos(bend), -20 * std::sin(bend), 20 * std::cos(bend));
    path.cancel().line(-20, 50);
    path.end();
    const std::vector<Item> out = run_stage(path);
    ASSERT_EQ(alarm_of(out), nullptr) << bend;
    for (const Move& move : moves_of(out)) {
      if (!move.circular) continue;
      EXPECT_NEAR(move.start[0], 0, 0.01) << bend;
      EXPECT_NEAR(move.start[1], -2, 0.01) << bend;
    }
  }
}

}  // namespace
}  // namespace nc::test
