// SPDX-License-Identifier: Apache-2.0
// The rules of radius compensation one by one, with the numbers of the manuals' examples: start, cancel and corners (M700 12.4.1, DGSHAPE G40-G42 and 1-6).
#include "rules.hpp"

#include "base/units.hpp"

namespace nc::test {
namespace {

TEST(OffsetOff, EverythingGoesThroughUnchanged) {
  PathBuilder path;
  path.line(10, 0).idle().arc(true, 10, 20, 0, 10).off_plane(-3).program_stop().line(0, 0).end();
  StageWithMemory stage;
  const std::vector<Item> out = run_stage(stage, path.items);
  ASSERT_EQ(out.size(), path.items.size());
  for (size_t i = 0; i < out.size(); ++i) {
    EXPECT_EQ(out[i].kind, path.items[i].kind);
    if (out[i].kind != ItemKind::move) continue;
    EXPECT_EQ(out[i].move.end, path.items[i].move.end);
    EXPECT_EQ(out[i].move.circle.sweep, path.items[i].move.circle.sweep);
    EXPECT_FALSE(out[i].move.connecting);
  }
  EXPECT_TRUE(stage.idle());
}

TEST(OffsetStart, TypeBObtuseIsTheIntersection) {
  PathBuilder path(-40, 0);
  path.side(1, 8);
  path.comp.type_b = true;
  path.line(0, 0).line(40, -60).line(100, -60).cancel().line(100, -20).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 4.28147, 8);
  expect_at(out, path, 2, 44.28147, -52);
  expect_at(out, path, 3, 100, -52);
  expect_at(out, path, 4, 100, -20);
}

TEST(OffsetStart, TypeAAcuteIsThePerpendicular) {
  PathBuilder path(-40, 0);
  path.side(1, 6.5);
  path.line(0, 0).line(-30, -50).line(30, -90).cancel().line(60, -60).end();
  expect_path(run_stage(path), path,
              {{5.5737, -3.34422}, {-21.23753, -48.02962}, {33.60555, -84.59167}, {60, -60}});
}

TEST(OffsetStart, TypeBAcuteGoesOverBothPerpendiculars) {
  PathBuilder path(0, 0);
  path.side(1, 5);
  path.comp.type_b = true;
  path.line(50, 0).line(0, -50).line(0, -90).end();  // a turn of 135 degrees to the right, tool on the left
  const auto moves = moves_of(run_stage(path));
  ASSERT_GE(moves.size(), 4u);
  EXPECT_NEAR(moves[0].end[0], 50, kTol);  // perpendicular to the start block, at its end
  EXPECT_NEAR(moves[0].end[1], 5, kTol);
  EXPECT_NEAR(moves[1].end[0], 55, kTol);  // lengthened by the amount
  EXPECT_NEAR(moves[1].end[1], 5, kTol);
  EXPECT_TRUE(moves[1].connecting);
  const double q =
      5 * std::sqrt(0.5);  // perpendicular to the next block (q, -q), back by the amount: (2q, 0)
  EXPECT_NEAR(moves[2].end[0], 50 + 2 * q, kTol);
  EXPECT_NEAR(moves[2].end[1], 0, kTol);
  EXPECT_TRUE(moves[2].connecting);
  EXPECT_FALSE(moves[3].connecting);
}

TEST(OffsetCancel, TypeAAcuteIsThePerpendicular) {
  PathBuilder path(-20, 30);
  path.side(1, 9);
  path.line(0, 0).line(70, 10).cancel().line(20, -45).end();
  expect_path(run_stage(path), path, {{-1.27279, 8.90955}, {68.72721, 18.90955}, {20, -45}});
}

TEST(OffsetCancel, TypeBObtuseIsTheIntersection) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.comp.type_b = true;
  path.line(0, 0).line(50, 0).cancel().line(50, -40).end();
  expect_path(run_stage(path), path, {{0, 5}, {55, 5}, {50, -40}});
}

// Two humps that meet in a point, and a hump with the wall from whose foot it rises: straight back, but the tool is between the two, so it is an inner corner. The
// circles of 6 mm about X5 and X15 meet at Y sqrt(36 - 25); the one of 6 mm about X5 and the line X9 at Y sqrt(36 - 16).
TEST(OffsetArcs, ACuspIsAnInnerCornerOnTheSideOfTheHumps) {
  const double beside = std::sqrt(11.0), wall = std::sqrt(20.0);
  for (const double off : {0.0, 1e-4, -1e-4}) {  // as far as the last digits of the words lead
    PathBuilder humps(-10, -10);
    humps.side(1, 1);
    humps.line(0, -5).line(0, 0).arc(false, 10, 0, 5, 0).arc(false, 20, 0, 5, off).line(20, -5).cancel().line(30, -10).end();
    const auto out = run_stage(humps);
    EXPECT_EQ(alarm_of(out), nullptr);
    EXPECT_NEAR(at_block(out, humps.start(), 3)[0], 10, 3e-4);
    EXPECT_NEAR(at_block(out, humps.start(), 3)[1], beside, 3e-4);
  }
  PathBuilder up(-10, -10);
  up.side(1, 1);
  up.line(0, -5).line(0, 0).arc(false, 10, 0, 5, 0).line(10, 20).line(0, 30).cancel().line(-10, 30).end();
  expect_path(run_stage(up), up, {{-1, -5}, {-1, 0}, {9, wall}, {9, 20 - std::sqrt(2.0) + 1}, {-1 / std::sqrt(2.0), 30 - 1 / std::sqrt(2.0)}, {-10, 30}});
  PathBuilder down(0, 40);
  down.side(-1, 1);
  down.line(10, 20).line(10, 0).arc(true, 0, 0, -5, 0).line(0, -5).cancel().line(-10, -10).end();
  expect_path(run_stage(down), down, {{9, 20}, {9, wall}, {-1, 0}, {-1, -5}, {-10, -10}});
}

// An arc that the tool fills, and an outer corner of less than 90 degrees behind it: the offset curves do not meet, and the tangents meet before they are as long as the
// amount. Lengthened by all of it they would lead into the arc.
TEST(OffsetArcs, ASmallOuterCornerWithoutAMeetingHasTheOneOfItsTangents) {
  const double i = 2, j = 0.9793, r = std::hypot(i, j), h = -2 * i / r, v = -2 * j / r;  // the vector at right angles to the second arc
  const double along = 1 / (1 + i / r);                                                  // 1 / (1 + cosine of the turn)
  PathBuilder path(-10, 6);
  path.side(-1, 2);
  path.line(0, 6).line(0, 12).arc(false, 4, 12, 2, 0).arc(true, 8, 12, i, j).line(8, 0).cancel().line(20, 0).end();
  const std::vector<Move> moves = moves_of(run_stage(path));
  ASSERT_GE(moves.size(), 5u);
  const auto ends_at = [&](unsigned move, double x, double y) {
    EXPECT_NEAR(moves[move].end[0], x, 1e-9) << move;
    EXPECT_NEAR(moves[move].end[1], y, 1e-9) << move;
  };
  ends_at(1, 2, 12);
  ends_at(2, 4 + along * (h - 2), 12 + along * v);
  ends_at(3, 4 + h, 12 + v);
}

TEST(OffsetArcs, ACuspIsAnOuterCornerOnTheOtherSide) {
  PathBuilder path(-10, -10);
  path.side(-1, 1);
  path.line(0, -5).line(0, 0).arc(false, 10, 0, 5, 0).line(10, 20).line(20, 20).cancel().line(20, 30).end();
  expect_path(run_stage(path), path, {{1, -5}, {1, 0}, {9, 0}, {9, -1}, {11, -1}, {11, 19}, {20, 19}, {20, 30}});
}

// A slot end that the tool all but fills, and a flare of 30 degrees behind it, or in front of it: the offset curves do not meet, and the tangents of both cross
// 5 tan(15) mm ahead. The tool has nothing to go to beyond that: lengthened by 5 mm they led back through the arc's own wall.
TEST(OffsetArcs, AnOuterCornerBesideAnArcThatTheToolFillsIsWhereTheTangentsCross) {
  const double ahead = 5 * std::tan(kPi / 12), i = 40 * std::cos(kPi / 6), from = 5 * std::cos(kPi / 6);
  for (const double radius : {5.01, 5.1, 5.3}) {
    const double room = radius - 5, end = radius + i;
    PathBuilder out(0, -30);
    out.side(-1, 5);
    out.line(-radius, -30).line(-radius, 0).arc(false, radius, 0, radius, 0).arc(true, end, -20, i, 20).cancel().line(end, -40).end();
    expect_path(run_stage(out), out, {{-room, -30}, {-room, 0}, {room, 0}, {room, -ahead}, {radius - from, -2.5}, {end, -25}, {end, -40}});
    PathBuilder in(end, -40);
    in.side(1, 5);
    in.line(end, -20).arc(false, radius, 0, 0, 40).arc(true, -radius, 0, -radius, 0).line(-radius, -30).cancel().line(0, -30).end();
    expect_path(run_stage(in), in, {{end, -25}, {radius - from, -2.5}, {room, -ahead}, {room, 0}, {-room, 0}, {-room, -30}, {0, -30}});
  }
}

TEST(OffsetArcs, AlongALineTheSamePointLiesOnItsWay) {
  const double ahead = 5 * std::tan(kPi / 8), beside = 5 * std::sqrt(0.5);
  PathBuilder path(0, -30);
  path.side(-1, 5);
  path.line(-20.01, -15).line(-5.01, 0).arc(false, 5.01, 0, 5.01, 0).line(20.01, -15).cancel().line(0, -30).end();
  expect_path(run_stage(path), path, {{-20.01 + beside, -15 - beside}, {-0.01, -ahead}, {-0.01, 0}, {0.01, 0}, {0.01, -ahead}, {20.01 - beside, -15 - beside}, {0, -30}});
}

TEST(OffsetArcs, TypeBStartsAndEndsInThatPoint) {
  const double slope = std::hypot(9.9, 20.0), ahead = 5 * (9.9 / slope) / (1 + 20 / slope);
  PathBuilder path(-15, -20);
  path.side(-1, 5);
  path.comp.type_b = true;
  path.line(-5.1, 0).arc(false, 5.1, 0, 5.1, 0).cancel().line(15, -20).end();
  expect_path(run_stage(path), path, {{-0.1, -ahead}, {-0.1, 0}, {0.1, 0}, {0.1, -ahead}, {15, -20}});
}

TEST(OffsetArcs, TangentialChainKeepsCentres) {
  PathBuilder path(-20, 0);
  path.side(1, 3.5);
  path.by(20, 10).by(0, 50).arc_by(false, 20, 20, 20, 0).by(30, 0).arc_by(true, 15, 15, 0, 15).by(0, 25);
  path.arc_by(false, 20, 0, 10, 0).by(0, -30).cancel().by(15, -5).end();
  const auto out = run_stage(path);
  expect_path(out, path,
              {{-3.5, 10},
               {-3.5, 60},
               {20, 83.5},
               {50, 83.5},
               {61.5, 95},
               {61.5, 120},
               {88.5, 120},
               {88.5, 90},
               {100, 85}});
  const auto moves = moves_of(out);
  EXPECT_NEAR(moves[2].circle.radius_start, 23.5, 1e-9);
  EXPECT_NEAR(moves[2].circle.radius_end, 23.5, 1e-9);
  EXPECT_NEAR(moves[4].circle.radius_start, 11.5, 1e-9);
  EXPECT_NEAR(moves[6].circle.radius_end, 13.5, 1e-9);
  EXPECT_EQ(moves[2].circle.center[0], 20);
  EXPECT_EQ(moves[2].circle.center[1], 60);
}

TEST(OffsetArcs, InnerCornerOfTwoArcs) {
  PathBuilder path(60, 40);
  path.side(1, 5);
  path.line(40, 50)
      .line(0, 50)
      .arc(true, -40, -30, 0, -50)
      .arc(true, -80, 50, -40, 30)
      .line(-120, 50)
      .cancel()
      .line(-140, 30)
      .end();
  expect_path(run_stage(path), path,
              {{40, 45}, {0, 45}, {-40, -20.61553}, {-80, 45}, {-120, 45}, {-140, 30}});
}

TEST(OffsetArcs, FullCircleInside) {
  PathBuilder path(20, -10);
  path.side(1, 7);
  path.line(30, 0).arc(true, 30, 0, -30, 0).cancel().line(20, 10).end();
  const auto out = run_stage(path);
  expect_path(out, path, {{23, 0}, {23, 0}, {20, 10}});
  EXPECT_NEAR(moves_of(out)[1].circle.sweep, 2 * std::acos(-1.0), 1e-12);
  EXPECT_NEAR(moves_of(out)[1].circle.radius_start, 23, 1e-12);
}

TEST(OffsetArcs, OuterObtuseWithArcIsTheIntersection) {
  // Line +X, then an arc that starts 45 degrees to the right; tool on the left: y = r meets the circle R + r.
  const double big = 20, r = 4, q = std::sqrt(0.5);
  PathBuilder path(-60, 0);
  path.side(1, r);
  path.line(-50, 0)
      .line(0, 0)
      .arc(false, -2 * big * q, -2 * big * q, -big * q, -big * q)
      .line(-80, -80)
      .end();
  const auto moves = moves_of(run_stage(path));
  ASSERT_GE(moves.size(), 3u);
  const double away = r + big * q, x = -big * q + std::sqrt((big + r) * (big + r) - away * away);
  EXPECT_NEAR(moves[1].end[0], x, 1e-9);
  EXPECT_NEAR(moves[1].end[1], r, 1e-9);
  EXPECT_NEAR(moves[2].circle.radius_start, big + r, 1e-9);
}

TEST(OffsetArcs, NoIntersectionOnTheInsideIsAnAlarmBeforeTheBlock) {
  // M700 12.4.1 (4): two arcs meet in a notch, so that their offsets do not intersect.
  PathBuilder path(60, 40);
  path.side(1, 12);  // the centres are 80 apart, the offset circles have the radius 38
  path.line(40, 50).line(0, 50).arc(true, -40, -30, 0, -50).arc(true, -80, 50, -40, 30).line(-120, 50).end();
  const auto out = run_stage(path);
  ASSERT_NE(alarm_of(out), nullptr);
  EXPECT_EQ(out.back().kind, ItemKind::alarm);
  EXPECT_EQ(out.back().alarm.condition, Condition::comp_no_intersection);
  EXPECT_EQ(out.back().source.line, 3u);
  expect_at(out, path, 2, 0, 38);
}

// Half a circle of twice the amount, whose offset circle only just comes to the curve behind: a line, or another arc. Whether they meet is the last digit of the words.
TEST(OffsetArcs, CurvesThatTouchMeetInThatPoint) {
  for (const double apart : {-0.4e-3, 0.0, 1e-12, 1e-6, 0.4e-3, 0.6e-3}) {
    PathBuilder line(-40, 10);
    line.side(-1, 1.5);
    line.line(-20, 0).line(0, 0).arc(false, 0, -6 + 2 * apart, 0, -3 + apart).line(0, 50).cancel().line(-10, 50).end();
    const std::vector<Item> beside_line = run_stage(line);
    ASSERT_EQ(alarm_of(beside_line) != nullptr, apart > 0.5e-3) << apart;
    if (apart > 0.5e-3) {
      EXPECT_EQ(alarm_of(beside_line)->alarm.condition, Condition::comp_no_intersection);
    } else if (apart >= 0) {
      expect_at(beside_line, line, 3, 1.5, -3 + apart);
    }
  }
  for (const double apart : {-0.4e-3, 0.0, 1e-12, 1e-6, 0.7e-3, 1.2e-3}) {
    const double r = 1.5 + apart / 2, x = std::sqrt(13.75);  // centres (0, -3) and (x, -4.5), 4 from each other and radii of 3 and 4
    PathBuilder arc(-40, 10);
    arc.side(-1, r);
    arc.line(-20, 0).line(0, 0).arc(false, 0, -6, 0, -3).arc(false, x, -0.5, x, 1.5).line(40, -0.5).cancel().line(60, -10).end();
    const std::vector<Item> beside_arc = run_stage(arc);
    ASSERT_EQ(alarm_of(beside_arc) != nullptr, apart > 1e-3) << apart;
    if (apart > 1e-3) {
      EXPECT_EQ(alarm_of(beside_arc)->alarm.condition, Condition::comp_no_intersection);
    } else if (apart >= 0) {
      const double along = (1.5 + apart / 8) / 4;  // as far beyond the one circle as beyond the other, by the squares
      expect_at(beside_arc, arc, 3, along * x, -3 - along * 1.5);
    }
  }
}

TEST(OffsetArcs, ArcThatVanishesInsideIsAnAlarm) {
  PathBuilder path(-20, 0);
  path.side(1, 12);
  path.line(0, 0).line(30, 0).arc(true, 40, 10, 0, 10).line(40, 60).end();
  const auto out = run_stage(path);
  expect_alarm(out, Condition::comp_interference);
  EXPECT_EQ(alarm_of(out)->source.line, 3u);
  expect_at(out, path, 2, 30, 12);
}

TEST(OffsetArcs, FilletOfTheToolsOwnRadiusShrinksToAPoint) {
  PathBuilder path(-20, 0);
  path.side(1, 10);
  path.comp.check = true;
  path.line(0, 0).line(30, 0).arc(true, 40, 10, 0, 10).line(40, 60).line(0, 60).cancel().line(0, 90).end();
  const auto out = run_stage(path);
  EXPECT_EQ(alarm_of(out), nullptr);
  expect_path(out, path, {{0, 10}, {30, 10}, {30, 50}, {0, 50}, {0, 90}});
}

TEST(OffsetCorner, OuterAcuteIsLengthenedAndLinked) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.line(0, 0).line(50, 0).line(0, -50).line(0, -90).end();
  const auto out = run_stage(path);
  const auto moves = moves_of(out);
  const double q = 5 * std::sqrt(0.5);
  EXPECT_NEAR(moves[1].end[0], 55, kTol);
  EXPECT_NEAR(moves[1].end[1], 5, kTol);
  EXPECT_TRUE(moves[2].connecting);
  EXPECT_NEAR(moves[2].end[0], 50 + 2 * q, kTol);
  EXPECT_NEAR(moves[2].end[1], 0, kTol);
  EXPECT_EQ(moves[2].feed_mm_min, 500);
  EXPECT_EQ(moves[2].work, path.items[2].move.work);  // the connecting move belongs to the block before ...
  uint32_t marks = 0;
  for (const Item& item : out) {
    if (item.kind == ItemKind::mark) ++marks;
    if (item.kind == ItemKind::move && item.move.connecting) {
      EXPECT_EQ(marks, 1u);  // ... and comes before its mark
    }
  }
}

TEST(OffsetCorner, ObtuseNinetyDegrees) {
  PathBuilder path(0, -10);
  path.side(-1, 2.5);
  path.kind = NC_MOVE_RAPID;
  path.line(10, 0);
  path.kind = NC_MOVE_LINE;
  path.line(60, 0).line(85, 43.3).line(60, 86.6).cancel().line(60, 120).end();
  const auto out = run_stage(path);
  expect_at(out, path, 2, 61.443355, -2.5);
  expect_at(out, path, 3, 87.886773, 43.3);
  expect_at(out, path, 5, 60, 120);
}

TEST(OffsetDgshape, SampleProgramOfSection16) {
  PathBuilder path;
  path.side(1, 3);
  path.kind = NC_MOVE_RAPID;
  path.by(8, 8);
  path.kind = NC_MOVE_LINE;
  path.off_plane(-7).by(0, 35).by(45, 0).arc_by(true, 15, -15, 15, 0).by(0, -20).by(-60, 0).off_plane(7);
  path.kind = NC_MOVE_RAPID;
  path.cancel().by(-8, -8).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 5, 8);
  expect_at(out, path, 2, 5, 8);
  EXPECT_EQ(at_block(out, path.start(), 2)[2], -7);
  expect_at(out, path, 3, 5, 46);
  expect_at(out, path, 6, 71, 5);
  expect_at(out, path, 7, 8, 5);
  expect_at(out, path, 9, 0, 0);
}

TEST(OffsetSigns, NegativeAmountChangesTheSide) {
  PathBuilder path(40, 25);
  path.side(-1, -6);
  path.line(30, 0).line(80, 0).line(70, 50).line(0, 40).line(0, 0).line(30, 0).cancel().line(40, 25).end();
  expect_path(run_stage(path), path,
              {{30, 6}, {72.68118, 6}, {65.22966, 43.25761}, {6, 34.79623}, {6, 6}, {30, 6}, {40, 25}});
}

TEST(OffsetPlanes, YzWithNegativeAmount) {
  PathBuilder path(-90, 40, 1, 2);
  path.side(1, -5.25);
  path.by(40, 0).by(0, -50).by(30, -30).by(60, 15).by(20, 45).cancel().by(40, 20).end();
  expect_path(run_stage(path), path,
              {{-55.25, 40},
               {-55.25, -12.17462},
               {-21.61044, -45.81419},
               {43.75752, -29.47219},
               {64.79751, 17.86777},
               {100, 40}});
}

}  // namespace
}  // namespace nc::test
