// SPDX-License-Identifier: Apache-2.0
// A drawing by sides: on which side of the programmed path the tool goes, how large it is, and the programmed path itself.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {
namespace {

struct Place {
  double x = 0, y = 0, z = 0;
};

nc_axes at(const Place& p) {
  nc_axes axes = {};
  axes.v[0] = p.x;
  axes.v[1] = p.y;
  axes.v[2] = p.z;
  return axes;
}

nc_system_config system_xyz() {
  nc_system_config system = {};
  system.axis_count = 3;
  for (unsigned i = 0; i < 3; ++i) system.axis[i].name = "XYZ"[i];
  return system;
}

/// Draws lines from programmed ends and the places where the tool goes.
class Drawing {
 public:
  Drawing() { plot.set_color(PlotColor::kSide); }
  /// What is in force in the moves that follow, in the plane of these axes.
  void side(nc_side side, uint8_t first = 0, uint8_t second = 1) { plot.set_side({side, {first, second}}); }
  void line(const Place& work, const Place& tool) {
    nc_move move = {};
    move.kind = NC_MOVE_LINE;
    move.plane = NC_PLANE_NONE;
    move.machine_start = last_;
    move.work = at(work);
    last_ = move.machine = at(tool);
    plot.add_move(move, system_);
  }
  /// A quarter circle about (x, y), counter-clockwise, of this radius; the tool goes on another one.
  void quarter(double x, double y, double radius, double tool) {
    nc_move move = {};
    move.kind = NC_MOVE_ARC;
    move.plane = NC_PLANE_XY;
    move.center_axes = 2;
    move.plane_axis[1] = 1;
    move.ccw = true;
    move.center[0] = move.machine_center[0] = x;
    move.center[1] = move.machine_center[1] = y;
    move.sweep_deg = 90;
    move.machine_start = last_;
    move.work = at({x + radius, y});
    last_ = move.machine = at({x + tool, y});
    plot.add_move(move, system_);
  }
  ToolpathPlot plot;

 private:
  nc_system_config system_ = system_xyz();
  nc_axes last_ = {};
};

TEST(PlotSide, LinesToTheLeftAndToTheRight) {
  Drawing drawing;
  drawing.line({10, 0}, {10, 0});   // without compensation
  drawing.side(NC_SIDE_LEFT);
  drawing.line({20, 0}, {20, 3});   // the start
  drawing.line({40, 0}, {40, 3});   // beside its block
  drawing.side(NC_SIDE_RIGHT);
  drawing.line({60, 0}, {60, -3});  // to the other side
  drawing.line({60, 20}, {63, 20});
  drawing.side(NC_SIDE_NONE);
  drawing.line({60, 40}, {60, 40});  // the cancel
  drawing.line({60, 50}, {60, 50});
  const std::vector<PlotVertex>& all = drawing.plot.vertices();
  const float sides[] = {kSideNone, kSideLeft, kSideLeft, kSideRight, kSideRight, kSideRight, kSideNone};
  ASSERT_EQ(all.size(), 8u);
  for (size_t i = 0; i < 7; ++i) EXPECT_EQ(all[i + 1].value, sides[i]) << i;
  ASSERT_EQ(drawing.plot.discs().size(), 1u);  // only of the block between two vectors of the same length
  EXPECT_NEAR(drawing.plot.discs()[0].radius, 3, 1e-9);
  EXPECT_NEAR(drawing.plot.discs()[0].x[0], 40, 1e-9);
  EXPECT_NEAR(drawing.plot.discs()[0].x[1], 3, 1e-9);
  const std::vector<ProgrammedVertex>& programmed = drawing.plot.programmed();
  ASSERT_EQ(programmed.size(), 8u);
  EXPECT_FALSE(programmed[1].beside);
  for (size_t i = 2; i < 7; ++i) EXPECT_TRUE(programmed[i].beside) << i;
  EXPECT_FALSE(programmed[7].beside);
  EXPECT_NEAR(programmed[3].x[0], 40, 1e-9);
  EXPECT_NEAR(programmed[3].x[1], 0, 1e-9);
}

TEST(PlotSide, AnArcByTheDifferenceOfItsRadii) {
  for (const double tool : {7.0, 13.0}) {
    Drawing drawing;
    drawing.line({0, -10}, {0, -10});
    drawing.side(tool < 10 ? NC_SIDE_LEFT : NC_SIDE_RIGHT);
    drawing.line({0, -10}, {0, -tool});  // a vector without movement
    drawing.quarter(0, 0, 10, tool);
    ASSERT_EQ(drawing.plot.discs().size(), 1u);
    EXPECT_NEAR(drawing.plot.discs()[0].radius, 3, 1e-9);
    EXPECT_EQ(drawing.plot.vertices().back().value, tool < 10 ? kSideLeft : kSideRight);
    EXPECT_GT(drawing.plot.programmed().size(), 25u);
    for (size_t i = 3; i < drawing.plot.programmed().size(); ++i)
      EXPECT_NEAR(std::hypot(drawing.plot.programmed()[i].x[0], drawing.plot.programmed()[i].x[1]), 10, 1e-9) << i;
  }
}

// The vectors of a way in, of a cut and of the way out tell other sides, or none, or the plane of another one; the code in force decides.
TEST(PlotSide, TheVectorsDoNotDecide) {
  Drawing drawing;
  drawing.line({-10, 20}, {-10, 20});
  drawing.side(NC_SIDE_LEFT);
  drawing.line({0, 0}, {-3, 0});  // from the far side of the wall
  drawing.line({0, 0, -5}, {-3, 0, -5});
  drawing.line({0, 20, -9}, {-3, 20, -9});  // a ramp
  drawing.side(NC_SIDE_NONE);
  drawing.line({-10, 30, -9}, {-10, 30, -9});
  const std::vector<PlotVertex>& all = drawing.plot.vertices();
  ASSERT_EQ(all.size(), 6u);
  for (size_t i = 2; i < 6; ++i) EXPECT_EQ(all[i].value, kSideLeft) << i;
  ASSERT_EQ(drawing.plot.discs().size(), 1u);
  EXPECT_EQ(drawing.plot.discs()[0].axis[0], 0);
  EXPECT_EQ(drawing.plot.discs()[0].axis[1], 1);
}

TEST(PlotSide, AVectorInSpaceHasAColourAndNoDisc) {
  Drawing drawing;
  drawing.line({0, 0}, {0, 0});
  drawing.side(NC_SIDE_SPACE);
  for (int i = 1; i < 4; ++i) drawing.line({10.0 * i, 0}, {10.0 * i, 3});
  drawing.side(NC_SIDE_NONE);
  drawing.line({40, 0}, {40, 0});
  const std::vector<PlotVertex>& all = drawing.plot.vertices();
  ASSERT_EQ(all.size(), 6u);
  for (size_t i = 2; i < 6; ++i) EXPECT_EQ(all[i].value, kSideSpace) << i;
  EXPECT_TRUE(drawing.plot.discs().empty());
  EXPECT_TRUE(drawing.plot.programmed()[3].beside);
}

// The part of the programmed path that is kept is bounded, the sides are not.
TEST(PlotSide, ALongProgramEndsWithoutASide) {
  Drawing drawing;
  drawing.side(NC_SIDE_LEFT);
  for (size_t i = 0; i <= ToolpathPlot::kMostBeside + 10; ++i) drawing.line({0.01 * static_cast<double>(i), 0}, {0.01 * static_cast<double>(i), 3});
  EXPECT_FALSE(drawing.plot.beside_all());
  EXPECT_EQ(drawing.plot.vertices().back().value, kSideLeft);
  drawing.side(NC_SIDE_NONE);
  drawing.line({3000, 0}, {3000, 0});
  EXPECT_EQ(drawing.plot.vertices().back().value, kSideLeft);
  drawing.line({3010, 0}, {3010, 0});
  EXPECT_EQ(drawing.plot.vertices().back().value, kSideNone);
}

TEST(PlotSide, InAPlaneWithZ) {
  Drawing drawing;
  drawing.side(NC_SIDE_RIGHT, 2, 0);
  drawing.line({0, 0, 5}, {0, 0, 7});
  drawing.line({20, 0, 5}, {20, 0, 7});
  ASSERT_EQ(drawing.plot.discs().size(), 1u);
  EXPECT_EQ(drawing.plot.discs()[0].axis[0], 2);
  EXPECT_EQ(drawing.plot.discs()[0].axis[1], 0);
  EXPECT_EQ(drawing.plot.vertices().back().value, kSideRight);
}

}  // namespace
}  // namespace nc::tools
