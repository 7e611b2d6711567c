// SPDX-License-Identifier: Apache-2.0
// The check of the whole contour (CONTOUR_CHECK): walls that are far apart in the program, ways in and out, levels, arcs whose radii differ, what is
// longer than its memory, and going back behind a mark.
#include "offset/contour_memory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "alarm/condition.hpp"
#include "path_builder.hpp"
#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A stage with room for a contour of so many blocks.

void ask(PathBuilder* path) { path->comp.check = path->comp.walls = true; }

/// Line of the alarm, 0 without one.
unsigned line_of_alarm(const PathBuilder& path, unsigned blocks = 200) {
  StageWithMemory with(blocks);
  const std::vector<Item> out = run_stage(with, path.items);
  const Item* alarm = alarm_of(out);
  return alarm == nullptr ? 0 : alarm->source.line;
}

TEST(BoxRow, FindsWhatASearchThroughAllFinds) {
  std::mt19937 random(3);
  const auto number = [&] { return std::uniform_real_distribution<double>(-50, 50)(random); };
  std::vector<unsigned char> memory(1u << 20);
  void* at = memory.data();
  size_t room = memory.size();
  Arena arena(std::align(64, 64, at, room), room);
  BoxRow<unsigned> row;
  row.create(100, arena);
  std::vector<Box> boxes;
  uint64_t first = 0;
  unsigned found_in_all = 0;
  for (unsigned i = 0; i < 3000; ++i) {
    if (i % 50 == 17) {  // back behind a mark
      row.cut(boxes.size() - 5);
      boxes.resize(boxes.size() - 5);
    }
    Box box;
    const Vec2 low{number(), number()};
    box.take(low);
    box.take(low + Vec2{3, 2});
    first = boxes.size() > 90 ? boxes.size() - 90 : 0;
    ASSERT_TRUE(row.keeps(first));
    row.push(static_cast<unsigned>(boxes.size()), box);
    boxes.push_back(box);
    std::vector<unsigned> expected, found;
    for (uint64_t k = first; k < boxes.size(); ++k)
      if (boxes[k].touches(box)) expected.push_back(static_cast<unsigned>(k));
    row.any(first, box, [&](uint64_t place, unsigned record) {
      EXPECT_EQ(place, record);
      found.push_back(record);
      return false;
    });
    ASSERT_EQ(found, expected) << i;
    found_in_all += static_cast<unsigned>(found.size());
  }
  EXPECT_GT(found_in_all, 3100u);
  EXPECT_FALSE(row.keeps(boxes.size() - 200));
}

/// A plate with a chamber in it that a slot of this width leads to: the walls of the slot are far apart in the program.
PathBuilder keyhole(double width) {
  PathBuilder path(-70, -50);
  path.side(1, 5);  // outside, clockwise
  ask(&path);
  path.line(-60, -40).line(-60, 20).line(-width / 2, 20).line(-width / 2, 0).line(-20, 0).line(-20, -20);
  for (const double h : {-10, -5, 0, 5, 10, 20}) path.line(h, -20);
  path.line(20, 0).line(width / 2, 0).line(width / 2, 20).line(60, 20).line(60, -40).line(-60, -40);
  path.cancel().line(-80, -50);
  path.end();
  return path;
}
constexpr unsigned kSecondWall = 14;  ///< block that leads to the slot's other side

TEST(ContourCheck, WallsThatAreFarApartInTheProgram) {
  EXPECT_EQ(line_of_alarm(keyhole(10.01)), 0u);
  EXPECT_EQ(line_of_alarm(keyhole(9.99)), kSecondWall);
  PathBuilder open = keyhole(9.9);
  for (Item& item : open.items) item.move.comp.walls = false;
  EXPECT_EQ(line_of_alarm(open), 0u);  // the manual's check does not look so far
}

/// A rectangular pocket, in and out on quarter circles in the middle of a side, and a millimetre too far round before the way out.
PathBuilder pocket(bool closes) {
  PathBuilder path(0, 0);
  path.side(1, 3);
  ask(&path);
  path.line(-10, -10).arc_by(true, 10, -10, 10, 0);
  path.line(30, -20).line(30, 20).line(-30, 20).line(-30, -20);
  if (closes) path.line(0, -20).line(1, -20).arc_by(true, 10, 10, 0, 10);
  else path.line(-1, -20).line(-1, -10);
  path.cancel().line(0, 0);
  path.end();
  return path;
}

TEST(ContourCheck, TheWayInAndTheWayOutAreNoWalls) {
  EXPECT_EQ(line_of_alarm(pocket(true)), 0u);
  EXPECT_NE(line_of_alarm(pocket(false)), 0u);  // it never closes: the arc is a wall that the path has cut
}

TEST(ContourCheck, AWayOutIsShort) {  // behind the closing point the contour goes on for too long: that is a wall which the first side has cut
  PathBuilder path(0, 0);
  path.side(1, 3);
  ask(&path);
  path.line(0, -20).line(30, -20).line(30, 20).line(-30, 20).line(-30, -20).line(0, -20);
  path.line(20, -20).line(20, -15).line(15, -10).line(10, -5).line(0, -5);
  path.cancel().line(0, 0);
  path.end();
  EXPECT_NE(line_of_alarm(path), 0u);
}

TEST(ContourCheck, StartAndEndOfCompensationCutNoWall) {
  const auto square = [](double h, double v) {  // from outside of a square to its corner (20, 0), and back
    PathBuilder path(h, v);
    path.side(-1, 5);
    ask(&path);
    path.line(20, 0).line(20, 20).line(-20, 20).line(-20, -20).line(20, -20).line(20, 0);
    path.cancel().line(h, v);
    path.end();
    return line_of_alarm(path);
  };
  EXPECT_EQ(square(40, 0), 0u);
  EXPECT_EQ(square(26, -10), 0u);
  EXPECT_NE(square(22, -10), 0u);  // along the side, nearer than the radius
  EXPECT_NE(square(0, 0), 0u);     // from within the part
}

// A cutter cuts all that is above its tip: what lies below it is no wall, what lies above it is one.
TEST(ContourCheck, WallsBelowThePathAreNotCompared) {
  const auto crossing = [](double down) {
    PathBuilder path(-40, 0);
    path.side(1, 3);
    ask(&path);
    path.line(-30, 0).line(30, 0).line(30, 30).line(0, 30);
    path.off_plane(down);
    path.line(0, -30).line(-30, -30);
    path.cancel().line(-60, -30);
    path.end();
    return line_of_alarm(path);
  };
  EXPECT_NE(crossing(0), 0u);
  EXPECT_EQ(crossing(10), 0u);
  EXPECT_NE(crossing(-10), 0u);
}

TEST(ContourCheck, ArcsWhoseRadiiDiffer) {  // within #1084; the far side of the slot is such an arc
  const auto narrow = [](double gap) {
    PathBuilder path(-60, 0);
    path.side(1, 5);
    ask(&path);
    path.line(-50, 0).line(20, 0).line(20, -40).line(60, -40).line(60, 40).line(25, gap);
    // About (0, gap + 100), radius 103.08 at its start and 103.13 at its end: nearest to the first line in the middle.
    path.arc(false, -25, gap - 0.05, -25, 100);
    path.line(-50, 40);
    path.cancel().line(-80, 40);
    path.end();
    return line_of_alarm(path);
  };
  EXPECT_EQ(narrow(14), 0u);  // it ends 2 um beside its circle, which is how it is programmed
  EXPECT_NE(narrow(7), 0u);
}

TEST(ContourCheck, ALongerContourThanItsMemoryIsAnAlarm) {
  PathBuilder path(kTurn, -10);
  path.side(1, 0.5);
  ask(&path);
  path.by(1, 0.1);  // straight on into the first wall
  for (unsigned i = 1; i < 60; ++i) path.by(1, i % 2 == 0 ? -0.1 : 0.1);
  path.cancel().by(1, 1);
  path.end();
  EXPECT_EQ(line_of_alarm(path, 61), 0u);
  StageWithMemory with(16);
  const std::vector<Item> out = run_stage(with, path.items);
  ASSERT_NE(alarm_of(out), nullptr);
  EXPECT_EQ(alarm_of(out)->alarm.condition, Condition::contour_too_long);
  EXPECT_GT(alarm_of(out)->source.line, 16u);
  EXPECT_LE(alarm_of(out)->source.line, 32u);
}

TEST(ContourCheck, AHundredThousandBlocks) {  // a spiral whose turns are 4 mm apart, and at its end a line back to the inside
  for (const bool back : {false, true}) {
    constexpr unsigned kLines = 100000;
    PathBuilder path(0, 0);
    path.side(1, 1.5);  // inside of the last turn
    ask(&path);
    for (unsigned i = 0; i < kLines; ++i) {
      const double turn = 0.002 * kTurn * i, radius = 10 + 4 * turn / kTurn;
      path.line(radius * std::cos(turn), radius * std::sin(turn));
    }
    if (back) path.line(0, 0).line(0, 1);
    path.cancel().by(-1.5, 3);
    path.end();
    EXPECT_EQ(line_of_alarm(path, kLines + 10) != 0, back);
  }
}

TEST(ContourCheck, GoesOnBehindAnyMark) {
  for (const double width : {9.9, 10.2}) {
    const PathBuilder path = keyhole(width);
    const unsigned expected = line_of_alarm(path);
    for (uint32_t mark = 1; mark < 16; ++mark) {
      StageWithMemory with(200);
      OffsetResume resume;
      bool kept = false;
      size_t behind = 0;
      Item item;
      for (size_t i = 0; i < path.items.size(); ++i) {
        with.push(path.items[i]);
        while (with.pop(item)) {
          if (item.kind != ItemKind::mark || item.source.line != mark) continue;
          resume = with.resume_point();
          kept = true;
        }
        if (path.items[i].kind == ItemKind::mark && path.items[i].source.line == mark) behind = i + 1;
      }
      if (!kept) continue;
      with.restore(resume);
      const std::vector<Item> rest(path.items.begin() + static_cast<std::ptrdiff_t>(behind), path.items.end());
      const std::vector<Item> out = run_stage(with, rest);
      ASSERT_EQ(alarm_of(out) != nullptr, expected != 0) << width << " " << mark;
      if (expected != 0) {
        EXPECT_EQ(alarm_of(out)->source.line, expected) << width << " " << mark;
      }
    }
  }
}

TEST(ContourCheck, AnotherControlDoesNotKnowTheContour) {  // a contour that was begun elsewhere cannot be checked: never a silent gouge
  const PathBuilder path = keyhole(10.2);
  StageWithMemory with(200), other(200);
  Item item;
  for (const Item& in : path.items) {
    with.push(in);
    while (with.pop(item)) {
      if (item.kind != ItemKind::mark || item.source.line != 4) continue;
      other.restore(with.resume_point());
    }
  }
  size_t behind = 0;
  while (path.items[behind].kind != ItemKind::mark || path.items[behind].source.line != 4) ++behind;
  const std::vector<Item> rest(path.items.begin() + static_cast<std::ptrdiff_t>(behind + 1), path.items.end());
  const std::vector<Item> out = run_stage(other, rest);
  ASSERT_NE(alarm_of(out), nullptr);
  EXPECT_EQ(alarm_of(out)->alarm.condition, Condition::contour_too_long);
}

// ---- what the manual lets pass, by programs ----

std::string alarm_of_program(const std::string& text, double radius, const std::map<std::string, std::string>& parameters) {
  Bench bench;
  bench.tool(1, radius);
  for (const auto& [name, value] : parameters) bench.param(name.c_str(), value.c_str());
  const Outcome run = bench.run(text);
  return run.alarm;
}

/// A step that the tool does not fit into.
constexpr char kStep[] = "G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nX0\n%sY-2.\nX2.\nY0\nX30.\nG40 X50. Y20.\nM30\n";

std::string step(const char* between) {
  std::string text = kStep;
  return text.replace(text.find("%s"), 2, between);
}

TEST(ContourCheck, TheManualsExceptions) {
  EXPECT_EQ(alarm_of_program(step(""), 5, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(step(""), 5, {}), "P153");
  EXPECT_EQ(alarm_of_program(step(""), 5, {{"CONTOUR_CHECK", "1"}, {"8103", "1"}}), "");  // the check is off as a whole
}

TEST(ContourCheck, BlocksWithoutMovementBeyondThePreRead) {
  // Four of them close the contour: the vectors at their joint stand at right angles, which cuts into the wall. The manual's check does not see that.
  // With CONTOUR_CHECK the block behind them is compared with its own path, which begins in its wall.
  const std::string corner = "G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nX0\nM20\nM21\nM22\nM23\nM24\nY30.\nX-40.\nG40 X-50. Y10.\nM30\n";
  EXPECT_EQ(alarm_of_program(corner, 5, {}), "");
  EXPECT_EQ(alarm_of_program(corner, 5, {{"CONTOUR_CHECK", "1"}}), "P153");
}

TEST(ContourCheck, VectorsOfTheProgram) {  // 12.4.3: no intersection is computed for G41 I J, and the manual checks nothing beside it
  const std::string corner = "G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nG41 X0 I1. J0\nY30.\nX-40.\nG40 X-50. Y10.\nM30\n";
  EXPECT_EQ(alarm_of_program(corner, 5, {}), "");
  EXPECT_EQ(alarm_of_program(corner, 5, {{"CONTOUR_CHECK", "1"}}), "P153");  // the block behind begins in its own wall
}

// A vector that G38 holds leads the first of two blocks through the second one, whose own path lies on its far side, beyond the amount.
TEST(ContourCheck, BesideAGivenVectorTheTwoBlocksAreCompared) {
  const std::string hook = "G0 X0 Y60.\nG41 D1 G1 X-20.521 Y56.382 F500\nX0 Y0\nG38 X60.\nG38 X31.716 Y28.284\nX91.716\nG40 X100. Y60.\nM30\n";
  EXPECT_EQ(alarm_of_program(hook, 5, {}), "");
  EXPECT_EQ(alarm_of_program(hook, 5, {{"CONTOUR_CHECK", "1"}}), "P153");
}

// I J of a block without movement lead from one vector to another: the chord between them comes nearer to the corner than the ends of both, which lie where they should.
TEST(ContourCheck, TheStepBetweenTwoGivenVectors) {
  const auto corner = [](const char* steps) { return std::string("G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nG41 I1. J0 X0\n") + steps + "Y-30.\nG40 X40.\nM30\n"; };
  const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
  for (const char* const steps : {"G41 I0 J-1.\n", "G41 I1. J-0.5\nG41 I0 J-1.\n"}) {
    EXPECT_EQ(alarm_of_program(corner(steps), 5, {}), "") << steps;
    EXPECT_EQ(alarm_of_program(corner(steps), 5, check), "P153") << steps;
  }
  EXPECT_EQ(alarm_of_program(corner("G39\n"), 5, check), "P153") << "behind a given vector there is no arc, and the block behind begins there";
  EXPECT_EQ(alarm_of_program(corner("G38 I1. J1.\nG41 I0 J-1.\n"), 5, check), "P153");
  // Not where there is nothing that a step could cut: as a start, and at a change of side, where the tool crosses the contour.
  EXPECT_EQ(alarm_of_program("G0 X-30. Y0\nG41 D1 G1 F500\nG41 I1. J0\nX0\nY-30.\nG40 X40.\nM30\n", 5, check), "");
  EXPECT_EQ(alarm_of_program("G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nG41 I1. J0 X0\nG42 I1. J0\nX30.\nG40 X40. Y-30.\nM30\n", 5, check), "");
  // At an inner corner the step leads along within the contour, and the block behind has its vector at right angles: the tool has been in the wall before.
  EXPECT_EQ(alarm_of_program("G0 X-40. Y20.\nG41 D1 G1 X-30. Y0 F500\nG41 I1. J1. X0\nG41 I0 J1.\nY30.\nG40 X-40.\nM30\n", 5, check), "P153");
}

// It is the step that is too near, whatever comes behind it, and in front of it the machine stops. The block before is none of the first three, which may be a way in.
TEST(ContourCheck, TheAlarmStandsInTheBlockOfTheStep) {
  Bench bench;
  bench.tool(1, 5).param("CONTOUR_CHECK", "1");
  const Outcome run = bench.run("G0 X-90. Y20.\nG41 D1 G1 X-80. Y0 F500\nX-70.\nX-60.\nX-50.\nG41 I1. J0 X0\nG41 I0 J-1.\nX5. Y-30.\nG40 X40.\nM30\n");
  EXPECT_EQ(run.alarm, "P153");
  EXPECT_EQ(run.alarm_line, 7u);
}

// A step that comes too near to the block behind it only, since the one before is a rapid: where the program is read again from a mark between the two the
// step is still known.
TEST(ContourCheck, StepsStayBehindTheirMark) {
  const auto contour = [](bool over_corner) {
    PathBuilder path(-80, -20);
    path.side(1, 5);
    ask(&path);
    path.kind = NC_MOVE_RAPID;
    path.line(-60, 0).line(-40, 0).line(-20, 0).one_shot(path.vector(1, 0)).line(0, 0);
    path.one_shot(over_corner ? path.vector(0, -1) : path.vector(1, 0)).command().idle();
    path.kind = NC_MOVE_LINE;
    path.one_shot(path.vector(0, -1)).line(0, -30);
    path.cancel().line(40, -30);
    path.end();
    return path;
  };
  constexpr unsigned kBehind = 7;
  EXPECT_EQ(line_of_alarm(contour(true)), kBehind);
  const PathBuilder path = contour(true);
  for (uint32_t mark = 5; mark < kBehind; ++mark) {
    StageWithMemory with(200);
    OffsetResume resume;
    size_t behind = 0;
    Item item;
    for (size_t i = 0; i < path.items.size(); ++i) {
      with.push(path.items[i]);
      while (with.pop(item))
        if (item.kind == ItemKind::mark && item.source.line == mark) resume = with.resume_point();
      if (path.items[i].kind == ItemKind::mark && path.items[i].source.line == mark) behind = i + 1;
    }
    ASSERT_TRUE(resume.active) << mark;
    for (unsigned again = 0; again < 2; ++again) {  // and not twice as often
      with.restore(resume);
      const std::vector<Item> out = run_stage(with, {path.items.begin() + static_cast<std::ptrdiff_t>(behind), path.items.end()});
      ASSERT_NE(alarm_of(out), nullptr) << mark;
      EXPECT_EQ(alarm_of(out)->source.line, kBehind) << mark;
    }
  }
}

// G40 alone ends the contour, and another one starts from its vector: what was in doubt about the first is not forgotten. Here its last block, a rapid, leads
// through the first, which has not shown to be a way in.
TEST(ContourCheck, AContourThatEndsWithoutAMovement) {
  const auto two = [](const char* last) {
    return std::string("G0 X-40. Y20.\nG41 D1 G1 X-20. Y0 F500\nX30.\nY40.\nX-30.\n") + last + "G40\nG41 G1 X10. Y-30.\nX50.\nG40 X60. Y-20.\nM30\n";
  };
  EXPECT_EQ(alarm_of_program(two("G0 X10. Y-10.\n"), 3, {}), "");
  EXPECT_EQ(alarm_of_program(two("G0 X10. Y-10.\n"), 3, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(two("G0 X-50. Y40.\n"), 3, {{"CONTOUR_CHECK", "1"}}), "");
}

// Half a turn of G39 goes round the outside, also where it is looked at.
TEST(ContourCheck, HalfATurnOfACornerArc) {
  for (const int left : {1, -1})
    for (const auto& [x, y] : {std::pair{4.0, 0.0}, {-4.0, 0.0}, {2.5, 1.4}, {-0.7, 2.4}}) {
      const auto at = [dx = x, dy = y](double along, double beside) { return " X" + std::to_string(dx * along - dy * beside) + " Y" + std::to_string(dy * along + dx * beside) + "\n"; };
      std::string text = "G90 G0" + at(-6, 4 * left) + (left > 0 ? "G41" : "G42") + " D1 G1 F500" + at(0, 0);
      for (int n = 1; n < 5; ++n) text += at(n, 0);
      text += "G39" + at(5, 0) + at(4, 0) + at(0, 0) + "G40" + at(-6, -4 * left) + "M30\n";
      EXPECT_EQ(alarm_of_program(text, 2, {{"CONTOUR_CHECK", "1"}}), "") << text;
    }
}

// The vector of the start stands at right angles to a line that has no direction; the arc behind it begins there, nearer to its own wall than the radius.
TEST(ContourCheck, AnArcBesideAVectorOfTheProgramCutsItsOwnWall) {
  const auto round = [](const char* vector) {
    return std::string("G0 X-0.061154 Y-0.067259\nG42 D1 G1 X0.494681 Y0.241538 ") + vector + " F1000\nG1 X0.494686 Y0.241529\nG2 X0.494681 Y0.241538 I-0.494686 J-0.241529\nG1 G40 X-0.006274 Y0.154226\nM30\n";
  };
  EXPECT_EQ(alarm_of_program(round("I0.485643 J-0.874157"), 0.367, {}), "");
  EXPECT_EQ(alarm_of_program(round("I0.485643 J-0.874157"), 0.367, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(round("I0.241538 J-0.494681"), 0.367, {{"CONTOUR_CHECK", "1"}}), "");  // at right angles to the arc
}

// At an inner corner the arc of G39 leads the tool into the block in front of it. A movement across the plane puts the block behind on another level.
TEST(ContourCheck, ACornerArcAndItsOwnBlock) {
  const auto corner = [](const char* end) { return std::string("G0 X0 Y40.\nG41 D1 G1 X20. Y20. F500\nG39 X60.\nZ-1.\n") + end; };
  EXPECT_EQ(alarm_of_program(corner("Y-20.\nG40 X100.\nM30\n"), 5, {{"CONTOUR_CHECK", "1"}}), "");
  EXPECT_EQ(alarm_of_program(corner("Y60.\nX0\nG40 Y40.\nM30\n"), 5, {{"CONTOUR_CHECK", "1"}}), "P153");
}

// Not compared are the two blocks beside a change of side, each with the path of the other. The block behind them is a wall like any other.
// Of a hole that is hardly larger than the tool: the corner in front of the arc, or behind it, is lengthened along the arc's tangent, and the arc comes round to it.
TEST(ContourCheck, ATangentAndTheFarEndOfItsArc) {
  const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
  const std::string in_front = "G90 G17 G0 X40. Y60.\nG1 G42 D1 X20. Y25.05 F500\nX0 Y5.05\nG2 X-2.134222 Y-4.576855 I0 J-5.05\nG40 G1 X0 Y0\nM30\n";
  EXPECT_EQ(alarm_of_program(in_front, 5, {}), "") << "the check of the manual does not see it";
  EXPECT_EQ(alarm_of_program(in_front, 5, check), "P153");
  const std::string behind = "G90 G17 G0 X0 Y0\nG1 G41 D1 X-2.134222 Y-4.576855 F500\nG3 X0 Y5.05 I2.134222 J4.576855\nG1 X20. Y25.05\nG40 X40. Y60.\nM30\n";
  EXPECT_EQ(alarm_of_program(behind, 5, check), "P153") << "the same way back";
  // An arc of less than half a circle, and one that is gone round outside, stay clear of their tangents.
  EXPECT_EQ(alarm_of_program("G0 X40. Y60.\nG1 G42 D1 X20. Y28. F500\nX0 Y8.\nG2 X8. Y0 I0 J-8.\nG1 X8. Y-20.\nG40 X0 Y-20.\nM30\n", 5, check), "");
  EXPECT_EQ(alarm_of_program("G0 X-40. Y-20.\nG1 G42 D1 X-20. Y-10. F500\nX0 Y-6.\nG3 X5.196152 Y3. I0 J6.\nG1 X0 Y20.\nG40 X0 Y40.\nM30\n", 5, check), "");
}

// What is inserted at a corner and cuts one of the two blocks there is no way in or out, so nothing has to be waited for: the machine stops in front of it.
TEST(ContourCheck, WhatACornerInsertsIsNotInDoubt) {
  const auto line = [](const std::string& text) {
    Bench bench;
    bench.tool(1, 5).param("CONTOUR_CHECK", "1");
    const Outcome run = bench.run(text);
    EXPECT_EQ(run.alarm, "P153");
    return run.alarm_line;
  };
  EXPECT_EQ(line("G0 X0 Y40.\nG41 D1 G1 X20. Y20. F500\nG39 X60.\nY60.\nX0\nY80.\nG40 X-20.\nM30\n"), 3u) << "the arc of G39 at an inner corner";
  EXPECT_EQ(line("G90 G17 G0 X40. Y60.\nG1 G42 D1 X20. Y25.05 F500\nX0 Y5.05\nG2 X-2.134222 Y-4.576855 I0 J-5.05\nG40 G1 X0 Y0\nM30\n"), 3u) << "in front of a hole";
  EXPECT_EQ(line("G90 G17 G0 X0 Y0\nG1 G41 D1 X-2.134222 Y-4.576855 F500\nG3 X0 Y5.05 I2.134222 J4.576855\nG1 X20. Y25.05\nG40 X40. Y60.\nM30\n"), 3u) << "behind it";
}

TEST(ContourCheck, BesideAChangeOfSideAreTwoBlocks) {
  const auto behind = [](const char* block) {  // the tool comes up at X-5
    return std::string("G0 X-20. Y-40.\nG41 D1 G1 X0 Y-40. F500\nX0 Y0\nG42 X-20. Y10.\n") + block + "\nG40 X-60. Y40.\nM30\n";
  };
  EXPECT_EQ(alarm_of_program(behind("X-40. Y20."), 5, {{"CONTOUR_CHECK", "1"}}), "");
  EXPECT_EQ(alarm_of_program(behind("X10. Y-30."), 5, {}), "");
  EXPECT_EQ(alarm_of_program(behind("X10. Y-30."), 5, {{"CONTOUR_CHECK", "1"}}), "P153");  // across the path of the tool
}

// The tool crosses the contour at a change of side, and cuts the two blocks from the joint on, without a gap. The path of a block that is too short for that begins far from the joint and leads
// into the block in front of the change beside it: that is P153 in this block, and not only in the one behind it, which goes through that wall.
TEST(ContourCheck, BesideAChangeOfSideTheCrossingIsNoWall) {
  Bench bench;
  bench.tool(1, 4.314).param("CONTOUR_CHECK", "1");
  const Outcome run = bench.run(
      "G17 G90 G0 X-12.127908 Y-25.863789\nG1 G42 D1 X-14.253219 Y-20.941063 F1000\nX20.984399 Y-5.727766\nG41 X20.667273 Y-5.224335\nX-24.452857 Y8.940979\nX-14.904643 Y-19.032575\nX-14.253219 Y-20.941063\nG40 X-5.923201 Y-25.430481\nM30\n");
  EXPECT_EQ(run.alarm, "P153");
  EXPECT_EQ(run.alarm_line, 4u);
}

// The joint at the end of a short block behind the change leads back beside the next block, and there comes too near to the block in front of the change.
TEST(ContourCheck, TheJointBehindAShortBlockAtAChangeOfSide) {
  const auto star = [](const char* tip) {
    return std::string("G0 X40. Y40.\nG42 D1 G1 X23.904656 Y11.024765 F500\nX19.142321 Y15.831631\nX9.099936 Y22.306487\nG41 ") + tip + "\nX-12.370215 Y18.738496\nX-20.516452 Y10.972188\nG40 Y-10.\nM30\n";
  };
  EXPECT_EQ(alarm_of_program(star("X9.892601 Y20.750080"), 1.12, {}), "");
  EXPECT_EQ(alarm_of_program(star("X9.892601 Y20.750080"), 1.12, {{"CONTOUR_CHECK", "1"}}), "P153");  // 1.072 mm from the third block
  EXPECT_EQ(alarm_of_program(star("X9.6 Y20.3"), 1.12, {{"CONTOUR_CHECK", "1"}}), "");
}

// I J of a start give the vector at its end. What the tool meets on its way there, and on the way behind it, is checked.
TEST(ContourCheck, VectorOfAStart) {
  const auto hole = [](const char* from, const char* start) { return std::string("G0 ") + from + "\nG41 D1 " + start + "\nG3 J-6.\nG1 G40 X0 Y0\nM30\n"; };
  EXPECT_EQ(alarm_of_program(hole("X0 Y0", "G1 X0 Y6. I-1. J0 F500"), 5, {{"CONTOUR_CHECK", "1"}}), "");
  EXPECT_EQ(alarm_of_program(hole("X1.5 Y0", "G1 X0 Y6. I-1. J0 F500"), 5, {{"CONTOUR_CHECK", "1"}}), "P153");  // 4.5 mm beside the wall
  EXPECT_EQ(alarm_of_program(hole("X10. Y-10.", "G1 X10. Y6. I-1. J0 F500\nX0"), 5, {{"CONTOUR_CHECK", "1"}}), "P153");  // through the wall
}

// The corner where a helix begins and ends is a concave one, and the way in comes along the first block: in front of the corner the tool is 25 um too near to the
// last block, which lies 2.5 mm deeper and has its wall up to the top.
TEST(ContourCheck, AHelixHasItsWallsUpToWhereItBegins) {
  const auto round = [](const char* plunge, const char* down[4]) {
    return std::string("G0 X-28.636072 Y10.991685\nG42 D1 G1 X-23.520950 Y11.163279 F1000\nX-23.299634 Y4.565990\n") + plunge + "G1 X-22.829915 Y-9.436050" + down[0] + "\nX25.777590 Y7.728136" + down[1] +
           "\nG2 X-24.432849 Y11.783971 I-15.923018 J115.701762" + down[2] + "\nG1 X-23.299634 Y4.565990" + down[3] + "\nX-22.829915 Y-9.436050\nX25.777590 Y7.728136\n" +
           "G2 X-24.432849 Y11.783971 I-15.923018 J115.701762\nG1 X-23.299634 Y4.565990\nX-23.299634 Y-2.035010\nG1 G40 X-28.636072 Y10.991685 Z0\nM30\n";
  };
  const char* helix[4] = {" Z-0.34", " Z-1.59", " Z-2.82", " Z-3."};
  EXPECT_EQ(alarm_of_program(round("", helix), 3.412, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(round("", helix), 3.38, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(round("", helix), 3.412, {}), "");
}

// A pocket whose first round, or the first side of it, goes down: a way in from outside, at the top, leads through a side that lies lower and is cut out of the part from the
// top all the same. One from within, and the level round behind the ramp, are clear.
TEST(ContourCheck, AWayInAtTheTopOfARampIsComparedWithIt) {
  const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
  const auto pocket = [](const char* from, const char* ramp, const char* way_out) {
    return std::string("G90 G17 G0 ") + from + "Z5.\nG1 Z-1. F500\nG41 D1 X0 Y-20.\n" + ramp + "X30.\nY20.\nX-30.\nY-20.\nX0\n" + way_out + "\nG0 Z5.\nM30\n";
  };
  const char* const round = "X30. Z-1.5\nY20. Z-2.\nX-30. Z-2.5\nY-20. Z-3.\nX0 Z-3.5\n";
  const char* const first_side = "X30. Z-3.5\nY20.\nX-30.\nY-20.\nX0\n";
  for (const char* const ramp : {"", round, first_side}) {
    EXPECT_EQ(alarm_of_program(pocket("X-55. Y0 ", ramp, "G40 Y0"), 5, check), "P153") << ramp;
    EXPECT_EQ(alarm_of_program(pocket("X0 Y0 ", ramp, "G40 Y0"), 5, check), "") << ramp;
    EXPECT_EQ(alarm_of_program(pocket("X0 Y0 ", ramp, "G40 X-55. Y0"), 5, check), "P153") << ramp;
  }
  // A plunge is no ramp: what lies below it is another depth.
  EXPECT_EQ(alarm_of_program(pocket("X-55. Y0 ", "Z-3.5\n", "G40 Y0"), 5, check), "");
}

// That a contour does not close, so that its first blocks are walls, is known at its end. The fault is far in front of it, and the sentence says where.
TEST(ContourCheck, TheSentenceNamesTheLineOfTheWayIn) {
  const auto sentence = [](const char* text) {
    Bench bench;
    bench.tool(1, 8).param("CONTOUR_CHECK", "1");
    const Outcome run = bench.run(text);
    return run.alarm + " L" + std::to_string(run.alarm_line) + " " + run.alarm_detail;
  };
  const std::string in = sentence("G17 G90 G0 X0 Y2.\nF500\nG1 G41 D1 X0 Y0\nX40.\nY-40.\nX80.\nY0\nX120.\nG40 Y20.\nM30\n");
  EXPECT_EQ(in.find("P153 L9 The way in or out in line 3 leads"), 0u) << in;
  // The last side comes back to the first one, over it: that is no way in.
  const std::string side = sentence("G17 G90 G0 X-20. Y20.\nF500\nG1 G41 D1 X0 Y0\nX60.\nY60.\nX20.\nY3.\nX30. Y-30.\nX90.\nG40 Y-10.\nM30\n");
  EXPECT_EQ(side.find("P153 L"), 0u) << side;
  EXPECT_EQ(side.find("The way"), std::string::npos) << side;
}

// Whole turns of a helix behind the start come back to where it ends. They are the contour, if there is nothing else; where it closes again further on they lead to it.
TEST(ContourCheck, WholeTurnsOfAHelixOnTheWayIn) {
  const auto hole = [](const char* turns, const char* contour) {
    return std::string("G90 G17 G0 X-7. Y24. Z5.\nG1 G41 D1 X-6. Y24. F500\n") + turns + "G3 X0 Y30. J6. Z-2.\n" + contour + "G3 X-6. Y36. I-6.\nG1 G40 X-7.\nM30\n";
  };
  const char* const plate = "G1 Y60.\nX40.\nY0\nX0\nY30.\n";
  const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
  EXPECT_EQ(alarm_of_program(hole("", plate), 5, check), "");
  EXPECT_EQ(alarm_of_program(hole("G3 X-6. Y24. I0 J6. Z0\n", plate), 5, check), "");
  EXPECT_EQ(alarm_of_program(hole("G3 X-6. Y24. I0 J6. Z2.\nG3 X-6. Y24. I0 J6. Z0\n", plate), 5, check), "");
  EXPECT_EQ(alarm_of_program(hole("G3 Y36. J6. Z2.\nG3 Y24. J-6. Z0\n", plate), 5, check), "");  // in two arcs
  EXPECT_EQ(alarm_of_program(hole("G3 Y36. J6. Z2.\nG3 Y24. J-6.\n", plate), 5, check), "");
  EXPECT_EQ(alarm_of_program(hole("G3 Y36. J6.\nG3 Y24. J-6.\n", plate), 5, check), "P153");
  EXPECT_EQ(alarm_of_program(hole("G3 X-6. Y24. I0 J6.\n", plate), 5, check), "P153");  // on one level it is a contour of its own
  EXPECT_EQ(alarm_of_program(hole("G3 X-6. Y24. I0 J6. Z0\n", "G1 Y60.\nX40.\nY30.\nX5.\nY20.\nX-12.\nY30.\nX0\n"), 5, check), "P153");  // through the way in's own walls no less
}

// An arc of a micrometre comes back to where it began, as far as that is told, but goes round nothing: it closes no contour, however far from its start it lies. The walls between the helix
// and it were no walls any more, and the tool went through the first of them with its last block (oracle, seed 100544619).
TEST(ContourCheck, ABlockOfAMicrometreIsNoRing) {
  const auto around = [](const char* middle, const char* code) {
    return std::string("G90 G17 G0 X80.232151 Y11.654258 Z0\nG1 G41 D1 X84.528132 Y9.815034 F1000\nG2 X84.528132 Y9.815034 I-8.501375 J3.639666 Z-1.25\nG2 X76.536 Y4.221 I-8.501375 J3.639666 Z-2.5\nG1 X0 Y0\nX0.5505 Y-9.985\nX1.101 Y-19.97\n") +
           middle + "X33.566 Y-18.179 I16.231945 J0.895998\nG1 " + code + "\nG3 X77.637 Y-15.749 I22.036 J1.215\nG1 X76.536 Y4.221\nG40 X69.790603 Y8.099702 Z0\nM30\n";
  };
  const char* const tiny = "G3 X1.101055 Y-19.970998 I16.232 J0.895\n";
  EXPECT_EQ(alarm_of_program(around(tiny, "G42"), -3.725, {{"CONTOUR_CHECK", "1"}}), "P153");
  EXPECT_EQ(alarm_of_program(around("G3 ", "G42"), -3.725, {{"CONTOUR_CHECK", "1"}}), "P153");
}

// A second round is a part of the contour, not a way out: its wall holds for the way out behind it, which is an arc larger than the hole.
TEST(ContourMemory, ASecondRoundIsNoWayOut) {
  const auto hole = [](const char* round) {
    return std::string("G90 G0 X0 Y-1.553\nG42 D1 G1 X-9.882 F1000\nG2 X0 Y8.329 I9.882 J0 Z-2.5\n") + round + "G2 J-8.329\nG2 X9.882 Y-1.553 J-9.882\nG1 G40 X0\nM30";
  };
  for (const char* const round : {"", "G2 J-8.329 Z-0.5\n", "G2 J-8.329\n", "G2 J-8.329\nG2 J-8.329\n"})
    EXPECT_EQ(alarm_of_program(hole(round), 6.947, {{"CONTOUR_CHECK", "1"}}), "P153") << round;
}

// M700 12.4.6: in a block with another offset number the amount changes evenly, from that of the block in front to its own. So its path has less than its own amount where its
// end is led round a corner, and its wall at an inner corner has the amount of the block in front.
TEST(ContourCheck, AnAmountThatChangesAlongABlockIsAskedForAsItIsThere) {
  const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
  const auto with = [](const char* second, const char* contour) {
    return std::string("G10 L10 P2 R") + second + "\nG0 X0 Y20.\nG41 D1 G1 X0 Y0 F1000\nX20.\nX40.\nX60.\n" + contour + "X240. Y-60.\nG40 Y-30.\nM30\n";
  };
  for (const char* const second : {"1.5", "2.2", "3."}) {
    EXPECT_EQ(alarm_of_program(with(second, "D2 X100.\nY-60.\n"), 2, check), "") << second;                    // an outer corner behind the block
    EXPECT_EQ(alarm_of_program(with(second, "X100.\nD2 Y60.\nX160.\nY-60.\n"), 2, check), "") << second;      // an inner one in front of it
    EXPECT_EQ(alarm_of_program(with(second, "X100.\nD2 G3 X120. Y20. J20.\nG1 Y60.\nX160.\nY-60.\n"), 2, check), "") << second;
    EXPECT_EQ(alarm_of_program(with(second, "D2 G2 X100. Y-40. J-40.\nG1 X160.\nY-60.\n"), 2, check), "") << second;
  }
  // The other wall of a slot of 4.5 mm stands beside the middle of the block: there the amount is half way to the second one.
  const auto slot = [](const char* second, const char* width) {
    return std::string("G10 L10 P2 R") + second + "\nG0 X-20. Y20.\nG41 D1 G1 X0 Y0 F1000\nX20.\nD2 X120.\nY" + width + "\nD1 X70.\nY60.\nX0\nG40 Y30.\nM30\n";
  };
  EXPECT_EQ(alarm_of_program(slot("2.", "4.5"), 2, check), "");
  EXPECT_EQ(alarm_of_program(slot("2.2", "4.5"), 2, check), "");
  EXPECT_EQ(alarm_of_program(slot("2.4", "4.5"), 2, check), "P153");
}

// Random contours whose blocks are far longer than the tool: whatever the amounts are, the tool has room at every corner.
TEST(ContourCheck, RandomAmountsHaveRoomAtWideCorners) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(300, 30);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    std::string text = "G10 L10 P2 R" + std::to_string(number(1, 4)) + "\nG10 L10 P3 R" + std::to_string(number(1, 4)) + "\n";
    const bool left = random() % 2 == 0;
    text += std::string("G0 X-200. Y") + (left ? "40.\n" : "-40.\n") + (left ? "G41" : "G42") + " D1 G1 X-160. Y0 F1000\nX-120.\nX-80.\nX-40.\n";
    double x = -40, y = 0, heading = 0;
    for (unsigned n = 0; n < 5; ++n) {
      const double length = number(60, 90);
      if (n > 0) heading = std::clamp(heading + number(-1.9, 1.9), -1.2, 1.2);  // it never comes back
      x += length * std::cos(heading);
      y += length * std::sin(heading);
      text += "D" + std::to_string(1 + random() % 3) + " X" + std::to_string(x) + " Y" + std::to_string(y) + "\n";
    }
    text += "X" + std::to_string(x + 80) + "\nX" + std::to_string(x + 120) + "\nX" + std::to_string(x + 160) + "\nG40 X" + std::to_string(x + 200) + "\nM30\n";
    ASSERT_EQ(alarm_of_program(text, number(1, 4), {{"CONTOUR_CHECK", "1"}}), "") << "seed " << seed << "\n" << text;
  }
}

// A vector of the program may lie anywhere, and an arc from it or to it is a spiral about its centre. But a G2 is never driven the other way round for it: where the amount is more than the
// radius and the vector on the other side of the centre there is no way along the arc. Which way half a turn goes is nobody's choice.
TEST(GivenVector, TurnsNoArcTheOtherWayRound) {
  const auto corner = [](bool mirrored, const std::string& vector) {
    const std::string x = mirrored ? "" : "-";
    return std::string("G0 X0 Y-20.\n") + (mirrored ? "G42" : "G41") + " D1 G1 F1000 X0 Y0 " + vector + "\n" + (mirrored ? "G3" : "G2") + " X" + x + "3. Y3. I0 J3.\nG1 Y40.\nG40 X" + x + "20.\nM30\n";
  };
  for (const char* const vector : {"I1. J0.3", "I1. J0.6", "I1. J0.9", "I1. J0"}) {
    EXPECT_EQ(alarm_of_program(corner(false, vector), 5, {}), "P153") << vector;
    EXPECT_EQ(alarm_of_program(corner(false, vector), 5, {{"8102", "1"}}), "P153") << vector;
    EXPECT_EQ(alarm_of_program(corner(true, std::string("I-") + (vector + 1)), 5, {}), "P153") << vector;
  }
  EXPECT_EQ(alarm_of_program(corner(false, "I-1. J1."), 2, {}), "");
  EXPECT_EQ(alarm_of_program(corner(true, "I1. J1."), 2, {}), "");
}

// Behind M00 the vector is at right angles to the line in front: at a cusp it points away from the arc's own.
TEST(GivenVector, NorBehindAStopOfThePreRead) {
  const auto cusp = [](const char* stop) {
    return std::string("G0 X60. Y-20.\nG41 D1 G1 X60. Y0 F1000\nX30.\nX0\n") + stop + "\nG2 X1.016 Y-1.016 I0 J-1.016\nG1 Y-20.\nY-50.\nG40 Y-70.\nM30\n";
  };
  for (const double radius : {1.5, 1.524, 1.6}) {
    EXPECT_EQ(alarm_of_program(cusp("M0"), radius, {}), "P153") << radius;
    EXPECT_EQ(alarm_of_program(cusp("M10\nM11\nM12\nM13"), radius, {}), "P153") << radius;
  }
}

/// An open contour at any angle in words of three digits, and a way out of it (or, the other way round, a way in) that leaves its last wall by `degrees` from the way straight
/// through its end: 90 is straight on along the wall, less leads over to the other side of the wall, more to the side of the tool. The last wall is a line or an arc.
class OpenContour {
 public:
  OpenContour(double turned, double bend, bool comes) : turned_(turned), bend_(bend), comes_(comes) {}

  unsigned alarm(double degrees, double length, double radius) const {
    const double way = degrees * kTurn / 360;
    const Vec2 outside = length * Vec2{std::sin(way), -std::cos(way)}, from{-10, bend_ > 0 ? 10.0 : -10.0};
    std::vector<Vec2> points = bend_ == 0 ? std::vector<Vec2>{{-40, 0}, {-30, 0}, {-20, 0}, {-10, 0}} : std::vector<Vec2>{from + Vec2{0, 3 * from.v}, from + Vec2{0, 2 * from.v}, from + Vec2{0, from.v}, from};
    const Vec2 far = points[0] + (bend_ == 0 ? Vec2{-12, 0} : Vec2{0, 1.2 * from.v});
    return comes_ ? in(outside, points, far, radius) : out(outside, points, far, radius);
  }

 private:
  // Mirrored, a way in is the way out that is driven backwards.
  PathBuilder begun(Vec2 at, double radius) const {
    const Vec2 p = placed(at);
    PathBuilder path(p.h, p.v);
    path.side(comes_ ? -1 : 1, radius);
    ask(&path);
    return path;
  }
  unsigned out(Vec2 outside, const std::vector<Vec2>& points, Vec2 far, double radius) const {
    PathBuilder path = begun(far, radius);
    for (const Vec2 point : points) line(&path, point);
    last(&path, {0, 0}, bend_ > 0);
    path.cancel();
    line(&path, outside);
    path.end();
    return line_of_alarm(path);
  }
  unsigned in(Vec2 outside, const std::vector<Vec2>& points, Vec2 far, double radius) const {
    PathBuilder path = begun(outside, radius);
    line(&path, {0, 0});
    last(&path, points.back(), bend_ < 0);
    for (size_t i = points.size() - 1; i-- > 0;) line(&path, points[i]);
    path.cancel();
    line(&path, far);
    path.end();
    return line_of_alarm(path);
  }
  void last(PathBuilder* path, Vec2 to, bool ccw) const {
    const Vec2 p = placed(to), center = placed({0, bend_});
    if (bend_ == 0) return void(path->line(p.h, p.v));
    path->arc(ccw, p.h, p.v, center.h - path->position()[0], center.v - path->position()[1]);
  }
  void line(PathBuilder* path, Vec2 to) const {
    const Vec2 p = placed(to);
    path->line(p.h, p.v);
  }
  Vec2 placed(Vec2 point) const {
    const double c = std::cos(turned_), s = std::sin(turned_);
    const auto word = [](double value) { return std::round(value * 1000) / 1000; };
    return {word(c * point.h - s * point.v + 3.10041), word(s * point.h + c * point.v - 1.70037)};
  }
  double turned_, bend_;
  bool comes_;
};

// Whether the way straight through the end of the wall passes it by a micrometre is the last digit of the words.
TEST(ContourCheck, AWayThatSwingsOverTheEndOfTheLastWallCutsIt) {
  std::mt19937 random(1804);
  for (unsigned i = 0; i < 200; ++i) {
    const double turned = std::uniform_real_distribution<double>(0, kTurn)(random);
    for (const double bend : {0.0, 10.0, -10.0})
      for (const bool comes : {false, true}) {
        const OpenContour contour(turned, bend, comes);
        const auto where = [&] { return std::to_string(turned) + " rad, bend " + std::to_string(bend) + (comes ? ", in" : ", out"); };
        for (const double degrees : {-60.0, -10.0, 0.0, 0.01, 1.0, 10.0, 45.0, 70.0, 85.0, 92.0, 94.0}) EXPECT_NE(contour.alarm(degrees, 15, 2), 0u) << degrees << " degrees, " << where();
        for (const double degrees : {90.0, 98.0, 120.0, 180.0}) EXPECT_EQ(contour.alarm(degrees, 15, 2), 0u) << degrees << " degrees, " << where();
        EXPECT_EQ(contour.alarm(90, 4.01, 2), 0u) << "straight on, " << where();
      }
  }
}

// Whichever way it has come, where it ends nearer to the end of the wall than the radius the tool stands in the wall.
TEST(ContourCheck, AWayThatEndsInTheEndOfTheLastWallCutsIt) {
  std::mt19937 random(1805);
  for (unsigned i = 0; i < 100; ++i) {
    const double turned = std::uniform_real_distribution<double>(0, kTurn)(random), degrees = std::uniform_real_distribution<double>(-60, 180)(random);
    for (const double bend : {0.0, 10.0, -10.0})
      for (const bool comes : {false, true}) {
        const OpenContour contour(turned, bend, comes);
        const auto where = [&] { return std::to_string(degrees) + " degrees, " + std::to_string(turned) + " rad, bend " + std::to_string(bend) + (comes ? ", in" : ", out"); };
        for (const double length : {0.01, 0.1, 0.5, 1.0, 1.9, 1.99}) EXPECT_NE(contour.alarm(degrees, length, 2), 0u) << length << " mm, " << where();
        // Of ways that go away from the wall by the radius none comes nearer to its end than it does beside it.
        if (degrees > 91) {
          EXPECT_EQ(contour.alarm(degrees, 2.01 / std::sin((degrees - 90) * kTurn / 360), 2), 0u) << where();
        }
      }
  }
}

// Straight on a short way sinks into the wall more than it leads along it. The bite is R less the distance of the way from the wall's end, which lies R beside where it begins.
TEST(ContourCheck, AWayStraightOnIsAsLongAsTheToolIsThick) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(100, 20);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double turned = number(0, kTurn), radius = number(0.5, 4), length = radius * number(0.05, 6), bite = radius - radius * length / std::hypot(length, radius);
    for (const double bend : {0.0, 10.0, -10.0})
      for (const bool comes : {false, true}) {
        const unsigned line = OpenContour(turned, bend, comes).alarm(90, length, radius);
        const auto where = [&] { return std::to_string(length) + " mm, radius " + std::to_string(radius) + ", seed " + std::to_string(seed) + ", bend " + std::to_string(bend) + (comes ? ", in" : ", out"); };
        if (line == 0) {
          EXPECT_LT(bite, 0.1057 * radius + 0.002) << where();
        }
        if (length > 2 * radius + 0.002) {
          EXPECT_EQ(line, 0u) << where();
        }
      }
  }
}

// Half a disc has two blocks, with corners of a right angle: the way in and the way out, at right angles to their own walls, lie on the line of the other one. They lead away from the end of
// both, and however short they are they cut nothing. The same way the other way round leads back over the disc.
TEST(ContourCheck, AWayOnTheLineOfTheOtherWallThatEndsThereIsNotStraightOn) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(200, 20);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double turned = number(0, kTurn), radius = number(0.5, 4), disc = radius * number(1.3, 4), in = radius * number(1.02, 1.95), out = radius * number(1.02, 1.95);
    const bool mirrored = random() % 2 == 0, line_first = random() % 2 == 0;
    const auto words = [&](const char* h, const char* v, double x, double y) {
      if (mirrored) x = -x;
      char text[64];
      std::snprintf(text, sizeof text, " %s%.4f %s%.4f", h, std::cos(turned) * x - std::sin(turned) * y, v, std::sin(turned) * x + std::cos(turned) * y);
      return std::string(text);
    };
    const auto program = [&](double to) {
      const std::string round = mirrored ? "G2" : "G3", line = "G1";
      const std::string begin = line_first ? words("X", "Y", -in, disc) : words("X", "Y", 0, disc + in), end = line_first ? words("X", "Y", 0, disc + to) : words("X", "Y", to, disc);
      return "G0" + begin + "\n" + line + (mirrored ? " G41 D1" : " G42 D1") + words("X", "Y", 0, disc) + " F1000\n" + (line_first ? line : round) + words("X", "Y", 0, -disc) +
             (line_first ? "" : words("I", "J", 0, -disc)) + "\n" + (line_first ? round : line) + words("X", "Y", 0, disc) + (line_first ? words("I", "J", 0, disc) : "") + "\n" + line + " G40" + end + "\nM30\n";
    };
    EXPECT_EQ(alarm_of_program(program(out), radius, {{"CONTOUR_CHECK", "1"}}), "") << "seed " << seed << "\n" << program(out);
    EXPECT_EQ(alarm_of_program(program(-out), radius, {{"CONTOUR_CHECK", "1"}}), "P153") << "seed " << seed << "\n" << program(-out);
  }
}

TEST(ContourCheck, TheSentenceNamesTheLineOfAWayStraightOn) {
  Bench bench;
  bench.tool(1, 8).param("CONTOUR_CHECK", "1");
  const Outcome out = bench.run("G17 G90 G0 X0 Y40.\nF500\nG1 G41 D1 X0 Y0\nX40.\nX80.\nX120.\nX160.\nG40 X170.\nM30\n");
  EXPECT_EQ(out.alarm_detail.find("The way in or out in line 8 leads"), 0u) << out.alarm << out.alarm_line << out.alarm_detail;
  const Outcome in = bench.run("G17 G90 G0 X-10. Y0\nF500\nG1 G41 D1 X0 Y0\nX40.\nX80.\nX120.\nX160.\nG40 Y40.\nM30\n");
  EXPECT_EQ(in.alarm_detail.find("The way in or out in line 3 leads"), 0u) << in.alarm << in.alarm_line << in.alarm_detail;
}

// A way at right angles as long as the radius: its words and those of the wall's end have a last digit each, which together may be 1.4 um.
TEST(ContourCheck, AWayOfTheRadiusAtAnyAngle) {
  std::mt19937 random(1806);
  for (unsigned i = 0; i < 2000; ++i) {
    const OpenContour contour(std::uniform_real_distribution<double>(0, kTurn)(random), 0, i % 2 == 0);
    EXPECT_EQ(contour.alarm(180, 2, 2), 0u) << i;
    EXPECT_NE(contour.alarm(180, 1.996, 2), 0u) << i;
  }
}

// The leads of CAM systems onto an open profile: an arc of up to a quarter, in front of it (behind it) a line along its radius that is at least as long as the tool's. The arc is a wall, and
// the tool stands clear of its end; with a shorter line it stands in it.
TEST(ContourCheck, ArcsThatLeadToAnOpenProfile) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(500, 50);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double radius = number(0.5, 5), turned = number(0, kTurn), length = number(3, 20) * radius;
    const auto lead = [&](double line, double side) {  // its arc about (0, w), from its outer end; side -1: in front of the profile
      const double w = number(1.02, 3) * radius, angle = number(0.3, kTurn / 4);
      const Vec2 outer{side * w * std::sin(angle), w - w * std::cos(angle)};
      return std::array<Vec2, 3>{outer + line * radius / w * (Vec2{0, w} - outer), outer, Vec2{0, w}};
    };
    const auto program = [&](const std::array<Vec2, 3>& in, const std::array<Vec2, 3>& out) {
      std::string text;
      const auto place = [&](Vec2 p) { return Vec2{std::round(1000 * (std::cos(turned) * p.h - std::sin(turned) * p.v)) / 1000, std::round(1000 * (std::sin(turned) * p.h + std::cos(turned) * p.v)) / 1000}; };
      const auto words = [](char h, char v, Vec2 p) { return std::string(1, h) + std::to_string(p.h) + " " + v + std::to_string(p.v) + " "; };
      const auto arc = [&](Vec2 from, Vec2 to, Vec2 center) { text += "G3 " + words('X', 'Y', place(to)) + words('I', 'J', place(center) - place(from)) + "\n"; };
      const Vec2 end{length, 0};
      text = "G90 G17 G0 " + words('X', 'Y', place(in[0])) + "\nG1 G41 D1 F500 " + words('X', 'Y', place(in[1])) + "\n";
      arc(in[1], {0, 0}, in[2]);
      text += "G1 " + words('X', 'Y', place(end)) + "\n";
      arc(end, end + out[1], end + out[2]);
      return text + "G1 G40 " + words('X', 'Y', place(end + out[0])) + "\nM30\n";
    };
    const std::map<std::string, std::string> check = {{"CONTOUR_CHECK", "1"}};
    const double line = random() % 3 == 0 ? 1 : number(1, 1.5);
    EXPECT_EQ(alarm_of_program(program(lead(line, -1), lead(line, 1)), radius, check), "") << "seed " << seed;
    EXPECT_EQ(alarm_of_program(program(lead(number(0.05, 0.99), -1), lead(line, 1)), radius, check), "P153") << "seed " << seed;
    EXPECT_EQ(alarm_of_program(program(lead(line, -1), lead(number(0.05, 0.99), 1)), radius, check), "P153") << "seed " << seed;
  }
}

/// A pocket at any angle whose corners have the tool's radius, in words of four digits in inch.
std::string pocket_in_inch(uint64_t seed, double* radius_mm) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  const double r = rounded(between(0.04, 0.4)), a = between(0.1, 1.2) + 2 * r, b = between(0.1, 0.8) + 2 * r, turned = between(0, kTurn);
  *radius_mm = 25.4 * r;
  const auto place = [&](double h, double v) { return Vec2{rounded(std::cos(turned) * h - std::sin(turned) * v), rounded(std::sin(turned) * h + std::cos(turned) * v)}; };
  const auto words = [](const char* first, const char* second, Vec2 p) {
    char text[64];
    std::snprintf(text, sizeof text, " %s%.4f %s%.4f", first, p.h, second, p.v);
    return std::string(text);
  };
  const Vec2 middle = place(a, 0), lead = place(a - 1.5 * r, 0);
  std::string text = "G20 G90 G0" + words("X", "Y", lead) + "\nG41 D1 G1" + words("X", "Y", middle) + " F50.\n";
  const Vec2 corners[][3] = {{{a, b - r}, {a - r, b - r}, {a - r, b}}, {{r - a, b}, {r - a, b - r}, {-a, b - r}}, {{-a, r - b}, {r - a, r - b}, {r - a, -b}}, {{a - r, -b}, {a - r, r - b}, {a, r - b}}};
  for (const auto& corner : corners) {
    const Vec2 from = place(corner[0].h, corner[0].v), center = place(corner[1].h, corner[1].v), to = place(corner[2].h, corner[2].v);
    text += "G1" + words("X", "Y", from) + "\nG3" + words("X", "Y", to) + words("I", "J", center - from) + "\n";
  }
  return text + "G1" + words("X", "Y", middle) + "\nG40" + words("X", "Y", lead) + "\nM30\n";
}

// The last of four digits in inch is 2.54 um: by as much the tool may come nearer there, as by a micrometre in millimetres. Of the arcs one in fifty is smaller still.
TEST(ContourCheck, PocketsInInchWhoseCornersHaveTheToolsRadius) {
  unsigned alarms = 0, alarms_of_check = 0, alarms_of_avoidance = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    double radius = 0;
    const std::string pocket = pocket_in_inch(seed, &radius);
    alarms += alarm_of_program(pocket, radius, {}).empty() ? 0 : 1;
    alarms_of_check += alarm_of_program(pocket, radius, {{"CONTOUR_CHECK", "1"}}).empty() ? 0 : 1;
    alarms_of_avoidance += alarm_of_program(pocket, radius, {{"8102", "1"}}).empty() ? 0 : 1;
  }
  EXPECT_LE(alarms, 10u);
  EXPECT_LE(alarms_of_check, 10u);
  EXPECT_LE(alarms_of_avoidance, 10u);
}

}  // namespace
}  // namespace nc::test
