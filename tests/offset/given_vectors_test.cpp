// SPDX-License-Identifier: Apache-2.0
// G41 and G42 with I J K (M700 12.4.3).
#include "rules.hpp"

namespace nc::test {
namespace {

TEST(OffsetVector, StartWithMovement) {
  PathBuilder path;
  path.side(1, 12);
  path.one_shot(path.vector(150, 0))
      .by(100, 100)
      .idle()
      .idle()
      .idle()
      .idle()
      .by(150, 0)
      .cancel()
      .by(-20, 40)
      .end();
  expect_path(run_stage(path), path, {{100, 112}, {250, 112}, {230, 140}});
}

TEST(OffsetVector, StartWithoutMovement) {
  PathBuilder path;
  path.side(1, 5);
  path.one_shot(path.vector(150, 0)).command().by(100, 100).by(150, 0).cancel().by(10, 40).end();
  const auto out = run_stage(path);
  const auto moves = moves_of(out);
  EXPECT_NEAR(moves[0].end[0], 0, kTol);
  EXPECT_NEAR(moves[0].end[1], 5, kTol);
  EXPECT_TRUE(moves[0].connecting);
}

TEST(OffsetVector, InTheModeBeforeAFullCircle) {
  PathBuilder path(-40, 40);
  path.kind = NC_MOVE_RAPID;
  path.side(1, 10);
  path.by(40, -40)
      .one_shot(path.vector(0, 50))
      .by(150, 0)
      .arc_by(false, 0, 0, 150, 0)
      .by(-150, 0)
      .cancel()
      .by(0, -50)
      .end();
  const auto out = run_stage(path);
  expect_path(out, path, {{0, 10}, {140, 0}, {140.31281, -10}, {0, -10}, {0, -50}});
  EXPECT_LT(moves_of(out)[2].circle.sweep, -6);
}

TEST(OffsetVector, WithoutMovementInTheMode) {
  PathBuilder path;
  path.side(1, 7.5);
  path.command().by(100, 100).one_shot(path.vector(50, 0)).command().by(150, 0).cancel().by(-20, 40).end();
  const auto out = run_stage(path);
  expect_at(out, path, 3, 100, 107.5);
  expect_at(out, path, 4, 250, 107.5);
  expect_at(out, path, 5, 230, 140);
}

TEST(OffsetVector, WithMovementOffThePlaneOnly) {
  PathBuilder path;
  path.side(1, 7.5);
  path.command().by(100, 100).one_shot(path.vector(50, 0)).off_plane(-4).by(150, 0).end();
  const auto out = run_stage(path);
  expect_at(out, path, 2, 100, 107.5);
  expect_at(out, path, 3, 100, 107.5);
  EXPECT_EQ(at_block(out, path.start(), 3)[2], -4);
}

TEST(OffsetVector, RightSideAndItsOwnAmount) {
  PathBuilder path;
  path.side(1, 6);
  path.command().by(100, 100);
  path.side(-1, 9);
  path.one_shot(path.vector(100, -100)).by(100, 0).by(100, -100).cancel().by(30, -10).end();
  const auto out = run_stage(path);
  expect_at(out, path, 3, 193.63604, 93.63604);
  expect_at(out, path, 5, 330, -10);
}

TEST(OffsetVector, NoInsertedBlockAtAnAcuteCorner) {
  PathBuilder path;
  path.side(1, 11);
  path.by(200, 0)
      .by(-150, 150)
      .one_shot(path.vector(50, 0))
      .by(300, 0)
      .by(-150, -150)
      .cancel()
      .by(-200, 0)
      .end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 192.22183, -7.77817);
  expect_at(out, path, 3, 350, 161);
  for (const Item& item : out) {
    if (item.kind != ItemKind::move || item.source.line != 3) continue;
    EXPECT_FALSE(item.move.connecting);
  }
  expect_at(out, path, 5, 0, 0);
}

}  // namespace
}  // namespace nc::test
