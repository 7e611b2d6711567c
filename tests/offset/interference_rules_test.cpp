// SPDX-License-Identifier: Apache-2.0
// The interference check by the manual's examples: alarm, avoidance, no check (M700 12.4.8).
#include "rules.hpp"

namespace nc::test {
namespace {

PathBuilder v_shape(bool check, bool avoid) {
  PathBuilder path(0, 50);
  path.side(1, 20);
  path.comp.check = check;
  path.comp.avoid = avoid;
  path.line(0, 0).line(50, -100).line(70, -100).line(120, 0).cancel().line(120, 50).end();
  return path;
}

TEST(OffsetInterference, AlarmBeforeTheBlock) {
  const auto out = run_stage(v_shape(true, false));
  expect_alarm(out, Condition::comp_interference);
  EXPECT_EQ(alarm_of(out)->source.line, 2u);
}

TEST(OffsetInterference, AvoidanceJoinsTheNeighbours) {
  const PathBuilder path = v_shape(true, true);
  expect_path(run_stage(path), path, {{17.88854, 8.94427}, {60, -75.27864}, {102.11146, 8.94427}, {120, 50}});
}

TEST(OffsetInterference, InvalidCheckRunsBackwards) {
  const PathBuilder path = v_shape(false, false);
  expect_path(run_stage(path), path,
              {{17.88854, 8.94427}, {62.36068, -80}, {57.63932, -80}, {102.11146, 8.94427}, {120, 50}});
}

TEST(OffsetInterference, EditedProgramPasses) {
  PathBuilder path(0, 50);
  path.side(1, 20);
  path.comp.check = true;
  path.line(0, 0).line(20, -40).line(70, -100).line(120, 0).cancel().line(120, 50).end();
  expect_path(
      run_stage(path), path,
      {{17.88854, 8.94427}, {36.85045, -28.97954}, {65.78739, -63.70387}, {102.11146, 8.94427}, {120, 50}});
}

TEST(OffsetInterference, UnsymmetricalGroove) {
  PathBuilder path(10, 60, 1, 2);
  path.side(-1, 18);
  path.comp.check = path.comp.avoid = true;
  path.by(-10, -60).by(-40, -100).by(-15, 5).by(-35, 95).cancel().by(0, 40).end();
  const auto out = run_stage(path);
  EXPECT_EQ(alarm_of(out), nullptr);
  expect_path(out, path, {{-16.71258, 6.68503}, {-46.15872, -66.93031}, {-73.10982, 6.2227}, {-90, 40}});
}

TEST(OffsetInterference, TwoShortBlocksAreLeftOut) {
  PathBuilder path(0, 50);
  path.side(1, 20);
  path.comp.check = path.comp.avoid = true;
  path.line(0, 0).line(50, -100).line(60, -104).line(70, -100).line(120, 0).cancel().line(120, 50).end();
  const auto out = run_stage(path);
  EXPECT_EQ(alarm_of(out), nullptr);
  expect_path(out, path, {{17.88854, 8.94427}, {60, -75.27864}, {102.11146, 8.94427}, {120, 50}});
}

TEST(OffsetInterference, NarrowGrooveWithParallelWallsIsAnAlarm) {
  PathBuilder path(0, 50);
  path.side(1, 20);
  path.comp.check = path.comp.avoid = true;
  path.line(0, 0).line(0, -100).line(30, -100).line(30, 0).cancel().line(30, 50).end();
  expect_alarm(run_stage(path), Condition::comp_interference);
}

TEST(OffsetInterference, SmallArcIsLeftOutByTheAvoidance) {
  PathBuilder path(-20, 0);
  path.side(1, 12);
  path.comp.check = path.comp.avoid = true;
  path.line(0, 0).line(30, 0).arc(true, 40, 10, 0, 10).line(40, 60).line(0, 60).cancel().line(0, 90).end();
  const auto out = run_stage(path);
  EXPECT_EQ(alarm_of(out), nullptr);
  expect_path(out, path, {{0, 12}, {28, 12}, {28, 48}, {0, 48}, {0, 90}});
}

}  // namespace
}  // namespace nc::test
