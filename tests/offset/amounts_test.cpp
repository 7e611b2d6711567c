// SPDX-License-Identifier: Apache-2.0
// Amounts that change in radius compensation, the infeed behind its start, and zeros that are shifted in it (M700 12.4.5 to 12.4.7).
#include "rules.hpp"

namespace nc::test {
namespace {

TEST(OffsetAmount, ChangedInTheModeInnerCorners) {
  PathBuilder path(-30, 30);
  path.side(1, 5);
  path.line(0, 0).line(60, 0);
  path.side(1, 9);
  path.line(80, 60).line(20, 80).cancel().line(0, 20).end();
  expect_path(run_stage(path), path,
              {{0, 5}, {56.3962, 5}, {68.6158, 54.3079}, {17.15395, 71.46185}, {0, 20}});
}

TEST(OffsetAmount, ChangedInTheModeOuterCorners) {
  PathBuilder path(-40, -20, 1, 2);
  path.side(-1, 8);
  path.by(40, 20).by(50, 0);
  path.side(-1, 3);
  path.by(40, 30).by(10, 60).cancel().by(40, 10).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 0, -8);
  expect_at(out, path, 2, 52.66667, -8);
  expect_at(out, path, 3, 92.76158, 28.32118);
  expect_at(out, path, 4, 102.95918, 89.5068);
  expect_at(out, path, 5, 140, 100);
}

TEST(OffsetInfeed, ThreeBlocksAfterTheStart) {
  PathBuilder path;
  path.side(1, 30);
  path.by(500, 500).idle().idle().off_plane(-300).by(0, 100).cancel().by(-50, 0).end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 470, 500);
  expect_at(out, path, 4, 470, 500);
  EXPECT_EQ(at_block(out, path.start(), 4)[2], -300);
  expect_at(out, path, 5, 470, 600);
  expect_at(out, path, 6, 450, 600);
}

TEST(OffsetInfeed, FourBlocksAfterTheStartMakeNoVector) {
  PathBuilder path;
  path.side(1, 30);
  path.by(500, 500)
      .idle()
      .idle()
      .off_plane(-250)
      .off_plane(-50)
      .by(0, 100)
      .by(-100, 0)
      .cancel()
      .by(0, -50)
      .end();
  const auto out = run_stage(path);
  expect_at(out, path, 1, 500, 500);
  expect_at(out, path, 5, 500, 500);
  expect_at(out, path, 6, 470, 570);
  expect_at(out, path, 7, 400, 570);
  expect_at(out, path, 8, 400, 550);
}

TEST(OffsetInfeed, Helix) {
  PathBuilder path(20, -10);
  path.side(1, 7);
  path.line(30, 0).arc(true, 30, 0, -30, 0, -5).cancel().line(20, 10).end();
  const auto out = run_stage(path);
  const auto moves = moves_of(out);
  EXPECT_EQ(moves[1].kind, NC_MOVE_HELIX);
  EXPECT_EQ(moves[1].end[2], -5);
  EXPECT_NEAR(moves[1].end[0], 23, 1e-12);
}

TEST(OffsetFrames, AShiftedZeroInTheContourKeepsTheVector) {
  PathBuilder plain(-20, 0), shifted(-20, 0);
  for (PathBuilder* path : {&plain, &shifted}) {
    path->side(1, 5);
    path->by(20, 0).by(50, 0).by(0, -30);
    if (path == &shifted) path->shift_zero(1000, -400);
    path->by(40, 0).cancel().by(0, 20).end();
  }
  const auto a = moves_of(run_stage(plain)), b = moves_of(run_stage(shifted));
  ASSERT_EQ(a.size(), b.size());
  EXPECT_NEAR(a[3].end[0] + 1000, b[3].end[0], 1e-9);
  EXPECT_NEAR(a[3].start[1] - 400, b[3].start[1], 1e-9);
}

}  // namespace
}  // namespace nc::test
