// SPDX-License-Identifier: Apache-2.0
// Axes are moved by hand in a block stop with manual absolute on, and the next block says something by the end of the block before: the direction of G45 to G48,
// a line by its angle, a pair of blocks that meet, a corner. It counts from the programmed end, and the tool is on its path again where the next block ends (M700 12.4.4 (2)).
#include <gtest/gtest.h>

#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

/// Runs a program in single block; behind the stops it is told to, an axis is moved by hand.
class StoppedMachine : public WatchedMachine {
 public:
  explicit StoppedMachine(bool optimal) : WatchedMachine(NC_DIALECT_M700, "XYZ", {100, 100, 100}, optimal, 20) { bench.param("1084", "0.1").tool(4, 1.5); }

  struct Hand {
    unsigned line = 0, axis = 0;
    double by = 0;
  };
  /// Where the axes stand behind the block of line `of`.
  nc_axes at_end_of(unsigned of, const std::string& program, std::initializer_list<Hand> hands) {
    start(program);
    for (unsigned n = 0; n < 200000; ++n) {
      step();
      if (n < 15 || drive->out.state == NC_STATE_RUNNING) continue;
      if (drive->out.state != NC_STATE_STOPPED || drive->out.source.line == of) break;
      for (const Hand& hand : hands)
        if (hand.line == drive->out.source.line) move(hand.axis, hand.by);
      press();
    }
    step(30);
    return drive->out.command;
  }

 private:
  void move(unsigned axis, double by) {
    drive->in.manual[axis] = {NC_MANUAL_STEP, 0, by};
    step();
    drive->in.manual[axis] = {};
    step(static_cast<unsigned>(std::fabs(by) / 100 / kCycle) + 400);
  }
};

class WayByHand : public testing::TestWithParam<bool> {
 protected:
  struct Case {
    const char* program;
    StoppedMachine::Hand hand;
    unsigned line;
    double x, y;
  };
  void expect(std::initializer_list<Case> cases) {
    for (const Case& one : cases) {
      SCOPED_TRACE(std::string(one.program) + "\naxis " + std::to_string(one.hand.axis) + " by " + std::to_string(one.hand.by));
      StoppedMachine m(GetParam());
      const nc_axes at = m.at_end_of(one.line, one.program, {one.hand});
      EXPECT_NEAR(at.v[0], one.x, 1e-6);
      EXPECT_NEAR(at.v[1], one.y, 1e-6);
      EXPECT_EQ(m.drive->alarm(), "");
      EXPECT_LT(m.worst, 1.001) << "axis " << m.worst_axis << " line " << m.worst_line;
    }
  }
};
INSTANTIATE_TEST_SUITE_P(BothLaws, WayByHand, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

// 12.6: "the direction of movement from the end point of the preceding block". A tool that stops in front of a wall does so from whatever side the hand has led it back.
TEST_P(WayByHand, OfAPositionOffsetTheDirectionIsTheProgrammedOne) {
  expect({
      {"G90 G61 G1 X10. F6000\nG46 D4 X20.\nX30.\nM30", {1, 0, 20}, 2, 18.5, 0},
      {"G90 G61 G1 X10. F6000\nG46 D4 X20.\nX30.\nM30", {1, 0, 10}, 2, 18.5, 0},
      {"G90 G61 G1 X10. F6000\nG47 D4 X20.\nX30.\nM30", {1, 0, 20}, 2, 23, 0},
      {"G90 G61 G1 X10. F6000\nG45 D4 X10. Y5.\nX30.\nM30", {1, 0, 20}, 2, 10, 6.5},  // no way by the program, and so none by the amount
      {"G90 G61 G1 X10. F6000\nG91 G46 D4 X10.\nX30.\nM30", {1, 0, 20}, 2, 38.5, 0},
      {"G90 G61 G1 X10. F6000\nG92 X0\nG46 D4 X20.\nX30.\nM30", {1, 0, 20}, 3, 48.5, 0},
      {"G90 G61 G1 X10. F6000\nG28 X0\nG46 D4 X-20.\nX30.\nM30", {1, 0, 20}, 3, -18.5, 0},
      {"G90 G61 G51.1 X50.\nG1 X10. F6000\nG46 D4 X20.\nX30.\nM30", {2, 0, -20}, 3, 81.5, 0},
      {"G90 G61 G1 X10. F6000\nG1 Y5.\nG46 D4 X20.\nX30.\nM30", {1, 0, 20}, 3, 18.5, 5},  // a block that does not name the axis leaves it there
  });
}

// 13.8: the end that the angle gives belongs to the line as it is programmed.
TEST_P(WayByHand, ALineByItsAngleEndsWhereItIsProgrammed) {
  for (const double by : {5.0, -3.0})
    for (const unsigned axis : {0u, 1u})
      expect({
          {"G90 G61 G1 X10. Y10. F6000\nX30. ,A45.\nX60.\nM30", {1, axis, by}, 2, 30, 30},
          {"G90 G61 G1 X10. Y10. F6000\nY30. A45.\nX60.\nM30", {1, axis, by}, 2, 30, 30},
          {"G90 G61 G68 X0 Y0 R90.\nG1 X10. Y10. F6000\nX30. ,A45.\nX60.\nM30", {2, axis, by}, 3, -30, 30},
          {"G90 G61 G0 X10. Y-20.\nG41 D4 G1 X10. Y0 F6000\nX10. Y20.\nX30. Y40.\nX50. ,A45.\nX70. Y60.\nG40 X80.\nM30", {4, axis, by}, 6, 70, 61.5},
      });
}

// 13.9: the blocks meet where the programmed ones do, also where the hand has moved the axes in the meeting point.
TEST_P(WayByHand, BlocksThatMeetDoSoWhereTheyAreProgrammed) {
  for (const unsigned axis : {0u, 1u})
    expect({
        {"G90 G61 G1 X10. Y10. F6000\nG1 A45.\nX40. Y10. A135.\nX60.\nM30", {1, axis, 5}, 2, 25, 25},
        {"G90 G61 G1 X10. Y10. F6000\nG1 A45.\nX40. Y10. A135.\nX60.\nM30", {2, axis, 5}, 3, 40, 10},
        {"G90 G61 G0 X10. Y-20.\nG41 D4 G1 X10. Y0 F6000\nX10. Y10.\nG1 A45.\nX40. Y10. A135.\nY-20.\nG40 X80.\nM30", {3, axis, 3}, 5, 41.5, 10 + 1.5 * 0.41421356237},
        {"G90 G61 G0 X10. Y-20.\nG41 D4 G1 X10. Y0 F6000\nX10. Y10.\nG1 A45.\nX40. Y10. A135.\nY-20.\nG40 X80.\nM30", {4, axis, 3}, 5, 41.5, 10 + 1.5 * 0.41421356237},
    });
}

TEST_P(WayByHand, AnArcThatBeginsBesideItsStartMeetsNothing) {
  for (const double by : {0.0, 2.0}) {
    StoppedMachine m(GetParam());
    const nc_axes at = m.at_end_of(3, "G90 G61 G1 X10. Y0 F6000\nG3 J10.\nG1 X0 Y30. A90.\nX-20.\nM30", {{1, 0, by}});
    EXPECT_EQ(m.drive->alarm(), by == 0 ? "" : "P70");
    EXPECT_NEAR(at.v[0], by == 0 ? 0 : 10 + by, 1e-6);
    EXPECT_NEAR(at.v[1], by == 0 ? 30 : 0, 1e-6);
  }
}

// 13.7: the corner is that of the programmed lines. A chamfer is a line of its own, which begins where the path has been reached.
TEST_P(WayByHand, UnderCompensationACornerIsThatOfTheProgrammedLines) {
  for (const char* corner : {"", " ,R3.", " ,C3."})
    for (const char* turn : {"Y20.", "Y-20.", "X50. Y10."})
      for (const double by : {8.0, 1.0}) {
        const std::string program = std::string("G90 G61 G0 X0 Y10.\nG41 D4 G1 X0 Y0 F6000\nX10. Y0\nX30. Y0") + corner + "\n" + turn + "\nG40 X90.\nM30";
        SCOPED_TRACE(program);
        for (const unsigned line : {4u, 5u}) {
          StoppedMachine straight(GetParam()), moved(GetParam());
          const nc_axes at = straight.at_end_of(line, program, {}), by_hand = moved.at_end_of(line, program, {{3, 1, by}, {3, 0, -by}});
          for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(by_hand.v[i], at.v[i], 1e-6) << line;
          EXPECT_EQ(moved.drive->alarm(), "");
          EXPECT_EQ(straight.drive->alarm(), "");
        }
      }
}

// Who moves the axes by hand to where the next block ends has not left it out: it has a corner, and a direction that the next one counts from.
TEST_P(WayByHand, ABlockWhoseWayTheHandHasGoneIsABlockAllTheSame) {
  const char* const outer = "G90 G61 G0 X0 Y10.\nG41 D4 G1 X0 Y0 F6000\nX10. Y0\nX30. Y0\nX40. Y-20.\nX60. Y-20.\nG40 X90.\nM30";
  for (const double by : {0.0, 19.9, 20.0, 20.0002, 20.001}) {
    SCOPED_TRACE(by);
    StoppedMachine first(GetParam()), m(GetParam());
    const nc_axes corner = first.at_end_of(4, outer, {{3, 0, by}}), end = m.at_end_of(5, outer, {{3, 0, by}});
    EXPECT_NEAR(corner.v[0], 30 + 1.5 * 0.61803398875, 1e-6);
    EXPECT_NEAR(corner.v[1], 1.5, 1e-6);
    EXPECT_NEAR(end.v[0], 40 + 1.5 * 0.61803398875, 1e-6);
    EXPECT_NEAR(end.v[1], -18.5, 1e-6);
    EXPECT_EQ(m.drive->alarm(), "");
  }
  // At an inner corner the way there leads back, as from anywhere else beyond the corner.
  const char* const inner = "G90 G61 G0 X0 Y10.\nG41 D4 G1 X0 Y0 F6000\nX10. Y0\nX30. Y0\nX40. Y20.\nX60. Y20.\nG40 X90.\nM30";
  for (const double by : {19.9, 20.0, 20.001}) {
    StoppedMachine m(GetParam());
    const nc_axes at = m.at_end_of(5, inner, {{3, 0, by}});
    EXPECT_EQ(m.drive->alarm(), "P153") << by;
    EXPECT_NEAR(at.v[0], 10 + by, 1e-6);
  }
  expect({{"G90 G61 G1 X10. F6000\nX30.\nX50. ,A45.\nX60.\nM30", {1, 0, 20}, 3, 50, 20}});
}

}  // namespace
}  // namespace nc::test
