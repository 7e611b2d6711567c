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
  drawing.line({20, 0}, {20, 3});   // the start
  drawing.line({40, 0}, {40, 3});   // beside its block
  drawing.line({60, 0}, {60, -3});  // to the other side
  drawing.line({60, 20}, {63, 20});
  drawing.line({60, 40}, {60, 40});  // the cancel
  const std::vector<PlotVertex>& all = drawing.plot.vertices();
  const float sides[] = {kSideNone, kSideLeft, kSideLeft, kSideRight, kSideRight, kSideRight};
  ASSERT_EQ(all.size(), 7u);
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(all[i + 1].value, i == 3 ? all[i + 1].value : sides[i]) << i;
  ASSERT_EQ(drawing.plot.discs().size(), 1u);  // only of the block between two vectors of the same length
  EXPECT_NEAR(drawing.plot.discs()[0].radius, 3, 1e-9);
  EXPECT_NEAR(drawing.plot.discs()[0].x[0], 40, 1e-9);
  EXPECT_NEAR(drawing.plot.discs()[0].x[1], 3, 1e-9);
  const std::vector<ProgrammedVertex>& programmed = drawing.plot.programmed();
  ASSERT_EQ(programmed.size(), 7u);
  EXPECT_FALSE(programmed[1].beside);
  for (size_t i = 2; i < 7; ++i) EXPECT_TRUE(programmed[i].beside) << i;
  EXPECT_NEAR(programmed[3].x[0], 40, 1e-9);
  EXPECT_NEAR(programmed[3].x[1], 0, 1e-9);
}

TEST(PlotSide, AnArcByTheDifferenceOfItsRadii) {
  for (const double tool : {7.0, 13.0}) {
    Drawing drawing;
    drawing.line({0, -10}, {0, -10});
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

TEST(PlotSide, InAPlaneWithZ) {
  Drawing drawing;
  drawing.line({0, 0, 5}, {0, 0, 7});
  drawing.line({20, 0, 5}, {20, 0, 7});
  ASSERT_EQ(drawing.plot.discs().size(), 1u);
  EXPECT_EQ(drawing.plot.discs()[0].axis[0], 2);
  EXPECT_EQ(drawing.plot.discs()[0].axis[1], 0);
  EXPECT_EQ(drawing.plot.vertices().back().value, kSideRight);  // in ZX the way along X has the larger Z on its right
}

}  // namespace
}  // namespace nc::tools
