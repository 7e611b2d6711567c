// SPDX-License-Identifier: Apache-2.0
// What else may stand in radius compensation (M700 12.4.2, DGSHAPE G39): G38, G39, changes of side, vectors that go away for a while, blocks without movement, G40 with I J K.
#include "rules.hpp"

namespace nc::test {
namespace {

TEST(OffsetG39, PrintedExample) {
  PathBuilder path;
  path.side(-1, 5);
  path.by(20, 20);
  Compensation corner = path.comp;
  corner.corner_arc = true;
  path.one_shot(corner)
      .by(40, 0)
      .one_shot(corner)
      .by(0, 40)
      .one_shot(corner)
      .by(-40, 0)
      .by(0, -40)
      .cancel()
      .by(-20, -20)
      .end();
  const auto out = run_stage(path);
  expect_path(out, path,
              {{20, 15}, {60, 15}, {65, 20}, {65, 60}, {60, 65}, {20, 65}, {15, 60}, {15, 20}, {0, 0}});
  const auto moves = moves_of(out);
  for (size_t i : {2u, 4u, 6u}) {
    EXPECT_TRUE(moves[i].circular);
    EXPECT_TRUE(moves[i].connecting);
    EXPECT_GT(moves[i].circle.sweep, 0);
    EXPECT_NEAR(moves[i].circle.radius_start, 5, 1e-12);
    EXPECT_EQ(moves[i].plane, Plane::xy);
  }
  EXPECT_EQ(moves[2].work_center[0], 60);
  EXPECT_EQ(moves[2].work_center[1], 20);
}

TEST(OffsetG39, DgshapeCornerWithoutMovement) {
  PathBuilder path;
  path.side(-1, 5);
  path.by(20, 20).by(40, 0);
  Compensation corner = path.vector(0, 40);
  corner.corner_arc = true;
  path.one_shot(corner).command().by(0, 40).cancel().by(-20, 0).end();
  const auto out = run_stage(path);
  expect_path(out, path, {{20, 15}, {60, 15}, {65, 20}, {65, 60}, {40, 60}});
  expect_at(out, path, 2, 60, 15);
  expect_at(out, path, 3, 65, 20);
  EXPECT_TRUE(moves_of(out)[2].circular);
}

TEST(OffsetG38, HoldKeepsTheVectorOfTheEndBefore) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.line(0, 0).line(50, 0);
  Compensation hold = path.comp;
  hold.hold_vector = true;
  path.one_shot(hold).line(50, -30).cancel().line(80, -30).end();
  const auto out = run_stage(path);
  expect_at(out, path, 2, 55, 5);
  expect_at(out, path, 3, 55, -25);
  expect_at(out, path, 4, 80, -30);
}

TEST(OffsetG38, HoldBehindAResume) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.line(0, 0).line(50, 0);
  const size_t first = path.items.size();
  Compensation hold = path.comp;
  hold.hold_vector = true;
  path.one_shot(hold).line(50, -30).cancel().line(80, -30).end();
  StageWithMemory stage;
  for (const Item& item : path.items) stage.push(item);
  Item item;
  while (stage.pop(item) && !(item.kind == ItemKind::mark && item.source.line == 2)) {
  }
  StageWithMemory again;
  again.restore(stage.resume_point());
  const auto out =
      run_stage(again, {path.items.begin() + static_cast<std::ptrdiff_t>(first), path.items.end()});
  expect_at(out, path, 3, 55, -25);
}

TEST(OffsetG38, VectorAlongTheWords) {
  PathBuilder path(-30, 30);
  path.side(1, 10);
  path.by(30, -30).by(60, 0);
  Compensation g38 = path.vector(50, 50);
  g38.hold_vector = true;
  path.one_shot(g38).by(100, 0).cancel().by(40, 40).end();
  const auto out = run_stage(path);
  expect_at(out, path, 3, 167.07107, 7.07107);
  expect_at(out, path, 4, 200, 40);
}

TEST(OffsetSide, ChangeAtACornerIsTheIntersection) {
  PathBuilder path(-30, 30);
  path.side(1, 7);
  path.line(0, 0).line(60, 0).line(120, 0);
  path.side(-1, 7);
  path.line(120, 50).line(170, 50).cancel().line(190, 20).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 0, 7);
  expect_at(out, path, 2, 60, 7);
  expect_at(out, path, 3, 127, 7);
  expect_at(out, path, 4, 127, 43);
  expect_at(out, path, 5, 170, 43);
  expect_at(out, path, 6, 190, 20);
}

TEST(OffsetSide, ChangeStraightOnCrosses) {
  PathBuilder path(-30, 30);
  path.side(1, 7);
  path.line(0, 0).line(60, 0);
  path.side(-1, 7);
  path.line(120, 0).line(150, 0).end();
  expect_path(run_stage(path), path, {{0, 7}, {60, 7}, {60, -7}, {120, -7}, {150, -7}});
}

TEST(OffsetSide, ChangeWithAnotherAmountHasTheAmountOfTheBlockBefore) {
  PathBuilder path(-30, 30);
  path.side(1, 7);
  path.line(0, 0).line(60, 0);
  path.side(-1, 3);
  path.line(60, 50).line(100, 50).end();
  expect_path(run_stage(path), path, {{0, 7}, {67, 7}, {63, 47}, {100, 47}});
}

TEST(OffsetSide, LinearReturn) {
  PathBuilder path(-30, 30);
  path.side(1, 5);
  path.line(0, 0).line(50, 0).line(100, 0);
  path.side(-1, 5);
  path.line(20, 0).cancel().line(10, 40).end();
  expect_path(run_stage(path), path, {{0, 5}, {50, 5}, {100, 5}, {20, 5}, {10, 40}});
}

TEST(OffsetTransparent, ReferenceReturnInTheMode) {
  PathBuilder path(-200, -100);
  path.side(1, 10);
  path.by(20, -10).by(60, 30);
  Compensation g28 = path.comp;
  g28.transparent = true;
  path.one_shot(g28).by(50, -40).one_shot(g28).line(0, 0).by(30, -60).by(70, 40).cancel().by(-10, 30).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, -184.47214, -101.05573);
  expect_at(out, path, 2, -118.7493, -68.19431);
  expect_at(out, path, 3, -70, -120);
  expect_at(out, path, 4, 0, 0);
  expect_at(out, path, 5, 34.21679, -46.0729);
  expect_at(out, path, 6, 95.03861, -11.31757);
  expect_at(out, path, 7, 90, 10);
}

TEST(OffsetIdle, OneBlockWithoutMovementIsLookedOver) {
  PathBuilder path(-50, -50);
  path.side(1, 8);
  path.by(50, 50).by(100, 200).idle().by(200, 0).cancel().by(10, 50).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, -7.15542, 3.57771);
  expect_at(out, path, 2, 95.05573, 208);
  expect_at(out, path, 4, 300, 208);
  expect_at(out, path, 5, 310, 250);
}

TEST(OffsetIdle, FourBlocksWithoutMovementEndPerpendicular) {
  PathBuilder path(-50, -50);
  path.side(1, 8);
  path.by(50, 50).by(100, 200).idle().idle().idle().idle().by(100, 0).by(0, 50).cancel().by(-20, 10).end();
  const auto out = run_stage(path);
  expect_at(out, path, 2, 92.84458, 203.57771);
  expect_at(out, path, 6, 92.84458, 203.57771);
  expect_at(out, path, 7, 192, 208);
  expect_at(out, path, 8, 192, 250);
  expect_at(out, path, 9, 180, 260);
}

TEST(OffsetIdle, ThreeBlocksWithoutMovementAreLookedOver) {
  PathBuilder path(-50, -50);
  path.side(1, 8);
  path.by(50, 50).by(100, 200).idle().idle().idle().by(200, 0).end();
  expect_at(run_stage(path), path, 2, 95.05573, 208);
}

TEST(OffsetIdle, ProgramStopEndsPerpendicular) {
  PathBuilder path(-50, -50);
  path.side(1, 8);
  path.by(50, 50).by(100, 200).program_stop().by(100, 0).cancel().by(-20, 10).end();
  expect_at(run_stage(path), path, 2, 92.84458, 203.57771);
}

TEST(OffsetIdle, CommandAloneIsPerpendicularAtTheNextStart) {
  PathBuilder path;
  path.by(30, 60);
  path.side(1, 9);
  path.command().by(20, -50).by(50, -20).cancel().by(30, 20).end();
  const auto moves = moves_of(run_stage(path));
  const double n = std::hypot(20, 50);
  ASSERT_GE(moves.size(), 4u);
  EXPECT_TRUE(moves[1].connecting);
  EXPECT_NEAR(moves[1].end[0], 30 + 9 * 50 / n, kTol);
  EXPECT_NEAR(moves[1].end[1], 60 + 9 * 20 / n, kTol);
  EXPECT_NEAR(moves[2].end[0], 56.92378, kTol);
  EXPECT_NEAR(moves[2].end[1], 16.92378, kTol);
}

TEST(OffsetIdle, CommandAndFourBlocksMakeNoVector) {
  PathBuilder path;
  path.by(30, 60);
  path.side(1, 9);
  path.command().idle().idle().idle().idle().by(20, -50).by(50, -20).cancel().by(30, 20).end();
  expect_path(run_stage(path), path, {{30, 60}, {56.92378, 16.92378}, {103.34252, -1.64371}, {130, 10}});
}

TEST(OffsetIdle, StartBlockAndFourBlocksMakeNoVector) {
  PathBuilder path;
  path.side(1, 9);
  path.by(30, 60).idle().idle().idle().idle().by(20, -50).by(50, -20).cancel().by(30, 20).end();
  expect_path(run_stage(path), path, {{30, 60}, {56.92378, 16.92378}, {103.34252, -1.64371}, {130, 10}});
}

TEST(OffsetIdle, CancelWithoutMovement) {
  PathBuilder path(-50, -50);
  path.side(1, 8);
  path.by(50, 50).by(100, 200).cancel().command().by(100, 50).by(20, 0).end();
  const auto out = run_stage(path);
  expect_at(out, path, 2, 92.84458, 203.57771);
  expect_at(out, path, 4, 200, 250);
  expect_at(out, path, 5, 220, 250);
}

TEST(OffsetCancelVector, WrongSignsStillIntersect) {
  PathBuilder path(-20, 15);
  path.side(1, 10);
  path.line(0, 0).line(80, 0).cancel();
  Compensation cancel = path.vector(30, -40);
  cancel.has_vector = false;
  cancel.cancel_vector = true;
  path.one_shot(cancel).line(120, 60).end();
  expect_path(run_stage(path), path, {{0, 10}, {85, 10}, {120, 60}});
}

TEST(OffsetCancelVector, ExtremelyLargeIsThePerpendicular) {
  PathBuilder path(-20, 15);
  path.side(1, 10);
  path.line(0, 0).line(80, 0).cancel();
  Compensation cancel = path.vector(-40, -0.5);
  cancel.has_vector = false;
  cancel.cancel_vector = true;
  path.one_shot(cancel).line(120, 60).end();
  expect_path(run_stage(path), path, {{0, 10}, {80, 10}, {120, 60}});
}

TEST(OffsetCancelVector, AfterAFullCircle) {
  // M700 12.4.2 (2): G02 J150 inside, then the hypothetical path (-100, 100).
  PathBuilder path(0, 30);
  path.side(-1, 10);
  path.line(50, 0).line(200, 0).arc(false, 200, 0, 0, 150).cancel();
  Compensation cancel = path.vector(-100, 100);
  cancel.has_vector = false;
  cancel.cancel_vector = true;
  path.one_shot(cancel).line(350, -150).end();
  const auto moves = moves_of(run_stage(path));
  Move arc;
  for (const Move& move : moves)
    if (move.circular) arc = move;
  ASSERT_TRUE(arc.circular);
  const double h = arc.end[0], v = arc.end[1];
  EXPECT_NEAR(std::hypot(h - 200, v - 150), 140, 1e-9);               // on the offset circle
  EXPECT_NEAR(((h - 200) + v) * std::sqrt(0.5), 10, 1e-9);            // and beside the hypothetical path
  EXPECT_LT(std::abs(arc.circle.sweep), 2 * std::acos(-1.0) + 1e-9);  // what is beyond 360 degrees only
}

// The circle G02 I30 outside, tool on the left, entered along +Y; then a path to the right, so that the arc
// goes beyond 360 degrees.
PathBuilder circle_beyond_full_turn() {
  PathBuilder path(20, -40);
  path.side(1, 10);
  path.line(0, -40).line(0, 0).arc(false, 0, 0, 30, 0);
  return path;
}

TEST(OffsetFullCircle, CancelVectorLeavesASectionUncut) {
  PathBuilder path = circle_beyond_full_turn();
  Compensation cancel = path.vector(1, 0);
  cancel.has_vector = false;
  cancel.cancel_vector = true;
  cancel.side = 0;
  path.cancel().one_shot(cancel).line(40, 60).end();
  const auto moves = moves_of(run_stage(path));
  ASSERT_TRUE(moves[2].circular);
  const double beyond = std::asin(10.0 / 40.0);  // the offset circle meets y = 10
  EXPECT_NEAR(moves[2].circle.sweep, -beyond, 1e-9);
  EXPECT_NEAR(moves[2].end[1], 10, 1e-9);
}

TEST(OffsetFullCircle, AnOrdinaryCornerIsTravelledInFull) {
  PathBuilder path = circle_beyond_full_turn();
  path.line(40, 0).cancel().line(40, 60).end();
  const auto moves = moves_of(run_stage(path));
  ASSERT_TRUE(moves[2].circular);
  EXPECT_NEAR(moves[2].circle.sweep, -2 * std::acos(-1.0) - std::asin(10.0 / 40.0), 1e-9);
}

}  // namespace
}  // namespace nc::test
