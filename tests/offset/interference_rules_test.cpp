// SPDX-License-Identifier: Apache-2.0
// The interference check by the manual's examples: alarm, avoidance, no check (M700 12.4.8).
#include <string>
#include <utility>

#include "rules.hpp"
#include "support/pull.hpp"

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

/// A face, a groove of these blocks from X40. on, and a face behind it, with the avoidance: "" or the alarm.
std::string groove_avoided(double radius, const std::string& blocks) {
  Bench bench;
  bench.tool(1, radius).param("8102", "1");
  return bench.run("G0 X-20. Y20.\nG1 G41 D1 X0 Y0 F500\nX40.\n" + blocks + "X120.\nG40 X140. Y20.\nM30").alarm;
}

// (2)(c): "grooves which are narrower than the tool or which have parallel or widening walls". One whose walls close towards its bottom is left uncut.
TEST(OffsetInterference, TheAvoidanceLeavesAGrooveUncutOnlyWhereItsWallsClose) {
  for (const double radius : {4.1, 5.0, 30.0}) {
    EXPECT_EQ(groove_avoided(radius, "Y-40.\nX48.\nY0\n"), "P153") << "parallel, " << radius;
    EXPECT_EQ(groove_avoided(radius, "Y-2.\nX48.\nY0\n"), "P153") << "parallel and lower than the tool, " << radius;
    EXPECT_EQ(groove_avoided(radius, "X39. Y-40.\nX49.\nX48. Y0\n"), "P153") << "widening, " << radius;
    EXPECT_EQ(groove_avoided(radius, "Y-40.\nG3 X48. I4.\nG1 Y0\n"), "P153") << "a round bottom, " << radius;
  }
  EXPECT_EQ(groove_avoided(3.9, "Y-40.\nX48.\nY0\n"), "");
  EXPECT_EQ(groove_avoided(3.9, "Y-40.\nG3 X48. I4.\nG1 Y0\n"), "");
  EXPECT_EQ(groove_avoided(5, "X43. Y-40.\nX45.\nX48. Y0\n"), "") << "closing walls";
}

/// The printed example with blocks without movement in front of N3: the alarm, and where N2 ends.
std::pair<std::string, double> with_idle_blocks(const char* idle, const char* check, const char* avoid) {
  Bench bench;
  bench.at(0, 50, 0).tool(1, 20).param("CONTOUR_CHECK", check).param("8102", avoid);
  const Outcome run = bench.run(std::string("G90 G1 G41 X0 Y0 D1 F500\nX50. Y-100.\nX70.\n") + idle + "X120. Y0\nG40 Y50.\nM30");
  return {run.alarm, run.moves().size() > 2 ? run.moves()[2].machine.v[0] : 0.0};
}

// "When interference check cannot be executed (1)": three or more of the five blocks that are read do not move. What looks at the whole contour does not hang on that.
TEST(OffsetInterference, CannotBeExecutedWhereFewerThanThreeOfTheFiveBlocksMove) {
  for (const char* avoid : {"0", "1"}) {
    const auto [alarm, x] = with_idle_blocks("M3\nM8\nS100\n", "0", avoid);
    EXPECT_EQ(alarm, "");
    EXPECT_NEAR(x, 57.63932, kTol);
    EXPECT_EQ(with_idle_blocks("M3\nM8\nS100\n", "1", avoid).first, "P153");
  }
  EXPECT_EQ(with_idle_blocks("M3\nM8\n", "0", "0").first, "P153");
  EXPECT_EQ(with_idle_blocks("M3\nM8\n", "0", "1").first, "");
}

// Three blocks of a contour that closes, but for the last digit of its words.
TEST(OffsetInterference, VectorsOfOnePlaceDoNotCross) {
  for (const char* end : {"X20. Y0", "X20.0004 Y-.0007", "X19.9996 Y-.0007", "X20.0004 Y.0007", "X19.9996 Y.0007"}) {
    for (const char* avoid : {"0", "1"}) {
      Bench bench;
      bench.tool(1, 2).param("8102", avoid);
      EXPECT_EQ(bench.run(std::string("G0 X35. Y-20.\nG1 G41 D1 X20. Y0 F100\nX-10. Y17.321\nY-17.321\n") + end + "\nX21. Y30.\nG40 X50. Y40.\nM30").alarm, "") << end;
    }
  }
}

}  // namespace
}  // namespace nc::test
