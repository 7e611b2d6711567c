// SPDX-License-Identifier: Apache-2.0
// Drawings: for any path the files are valid, with both colours in the right places.
#include "tools/lib/toolpath_plot.hpp"

#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>

#include "fake_items.hpp"
#include "own_folder.hpp"
#include "tools/lib/plot_pieces.hpp"

namespace nc::tools {
namespace {

class PlotTest : public OwnFolder {};

struct Pixels {
  int count = 0;
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
};

// Pixels of a PNG below the head (where the legend shows every colour) for which `is` holds.
// `column`: how many of them each column has.
Pixels pixels(const std::string& file, const std::function<bool(int r, int g, int b)>& is,
              std::map<int, int>* column = nullptr) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(file.c_str());
  Pixels found;
  EXPECT_EQ(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
  const unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 90; y < cairo_image_surface_get_height(image); ++y)
    for (int x = 0; x < cairo_image_surface_get_width(image); ++x) {
      const unsigned char* p = data + y * stride + 4 * x;  // B G R X
      if (!is(p[2], p[1], p[0])) continue;
      ++found.count;
      if (column != nullptr) ++(*column)[x];
      found.left = std::min(found.left, x);
      found.right = std::max(found.right, x);
      found.top = std::min(found.top, y);
      found.bottom = std::max(found.bottom, y);
    }
  cairo_surface_destroy(image);
  return found;
}

bool is_feed(int r, int g, int b) {
  return b > 150 && r < 120 && g < 160 && b > r + 80;
}
bool is_rapid(int r, int g, int b) {
  return r > 180 && g < 160 && b < 150 && r > b + 80;
}

ToolpathPlot square() {
  ToolpathPlot plot;
  plot.add_point(true, 0, 0, 10);
  plot.add_point(true, 100, 0, 10);
  plot.add_point(false, 100, 0, 0);
  plot.add_point(false, 100, 60, 0);
  plot.add_point(false, 0, 60, 0);
  plot.add_point(true, 0, 0, 10);
  return plot;
}

TEST_F(PlotTest, PngHasRapidAndFeedInEveryView) {
  for (const PlotView view : {PlotView::kIsometric, PlotView::kXY, PlotView::kXZ, PlotView::kYZ}) {
    ToolpathPlot plot = square();
    plot.set_view(view);
    std::string error;
    ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
    EXPECT_GT(pixels(path("a.png"), is_feed).count, 300) << static_cast<int>(view);
    EXPECT_GT(pixels(path("a.png"), is_rapid).count, 100) << static_cast<int>(view);
  }
}

TEST_F(PlotTest, SvgIsADrawingWithBothColours) {
  ToolpathPlot plot = square();
  plot.set_title("part <1> & more");
  std::string error;
  ASSERT_TRUE(plot.write_svg(path("a.svg"), &error)) << error;
  const std::string svg = content(path("a.svg"));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("stroke:rgb(85%,20%,10%)"), std::string::npos) << "rapid";
  EXPECT_NE(svg.find("stroke:rgb(5%,30%,75%)"), std::string::npos) << "feed";
}

TEST_F(PlotTest, ThePathIsDrawnToScale) {
  ToolpathPlot plot;  // 200 x 100 mm in the XY view: twice as wide as high
  plot.set_view(PlotView::kXY);
  plot.add_point(true, 0, 0, 0);
  plot.add_point(false, 200, 0, 0);
  plot.add_point(false, 200, 100, 0);
  plot.add_point(false, 0, 100, 0);
  plot.add_point(false, 0, 0, 0);
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const Pixels feed = pixels(path("a.png"), is_feed);
  EXPECT_NEAR(feed.right - feed.left, 2.0 * (feed.bottom - feed.top), 4.0);
  EXPECT_GT(feed.right - feed.left, 1000);
}

TEST_F(PlotTest, ArcsAreRound) {
  nc_move arc = {};
  arc.kind = NC_MOVE_ARC;
  arc.plane = NC_PLANE_XY;
  arc.plane_axis[1] = 1;
  arc.machine_start = arc.machine = {{10, 0, 0}};
  arc.sweep_deg = 360;
  arc.ccw = true;
  ToolpathPlot plot;
  plot.set_view(PlotView::kXY);
  plot.add_move(arc, xyz());
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const Pixels feed = pixels(path("a.png"), is_feed);
  EXPECT_NEAR(feed.right - feed.left, feed.bottom - feed.top, 4.0);
  EXPECT_GT(feed.right - feed.left, 600);
}

TEST_F(PlotTest, HelixOfSeveralTurnsEndsWhereItShould) {
  nc_move helix = {};
  helix.kind = NC_MOVE_HELIX;
  helix.plane = NC_PLANE_ZX;
  helix.plane_axis[0] = 2;
  helix.plane_axis[1] = 0;
  helix.machine_start = {{0, 0, 5}};
  helix.machine = {{5, 30, 0}};
  helix.sweep_deg = 90 + 720;
  helix.turns = 2;
  ToolpathPlot plot;
  plot.add_move(helix, xyz());
  EXPECT_EQ(plot.size(), 1 + 810 / 3u);
}

TEST_F(PlotTest, AMoveIsDrawnFromItsZero) {
  nc_move move = {};
  move.plane = NC_PLANE_NONE;
  move.kind = NC_MOVE_LINE;
  move.machine_start = {{-300, -200, -50}};
  move.machine = {{-280, -190, -60}};
  ToolpathPlot plot;
  plot.add_move(move, xyz(), {{-300, -200, -82}});
  EXPECT_EQ(plot.point(0), (std::array<double, 3>{0, 0, 32}));
  EXPECT_EQ(plot.point(1), (std::array<double, 3>{20, 10, 22}));
  ToolpathPlot machine;
  machine.add_move(move, xyz());
  EXPECT_EQ(machine.point(1), (std::array<double, 3>{-280, -190, -60}));
}

bool is_start(int r, int g, int b) {
  return g > 120 && r < 60 && b < 80;
}
bool is_alarm(int r, int g, int b) {
  return r > 180 && g < 40 && b > 110;
}
bool is_ink(int r, int g, int b) {
  return r < 60 && g < 60 && b < 60;
}

TEST_F(PlotTest, StartEndAndAlarmStandWhereTheyAre) {
  ToolpathPlot plot;
  plot.set_view(PlotView::kXY);
  plot.add_point(true, 0, 0, 0);
  plot.add_point(false, 200, 0, 0);
  plot.add_point(false, 200, 100, 0);
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const Pixels feed = pixels(path("a.png"), is_feed), start = pixels(path("a.png"), is_start);
  EXPECT_NEAR((start.left + start.right) / 2.0, feed.left, 6.0);
  EXPECT_NEAR((start.top + start.bottom) / 2.0, feed.bottom, 6.0);
  EXPECT_EQ(pixels(path("a.png"), is_alarm).count, 0);
  plot.set_alarm("P33");
  ASSERT_TRUE(plot.write_png(path("b.png"), &error)) << error;
  const Pixels alarm = pixels(path("b.png"), is_alarm);
  EXPECT_GT(alarm.count, 40);
  EXPECT_NEAR((alarm.left + alarm.right) / 2.0, feed.right, 6.0);
  EXPECT_NEAR((alarm.top + alarm.bottom) / 2.0, feed.top, 6.0);
  EXPECT_NE(pixels(path("a.png"), is_ink).count, pixels(path("b.png"), is_ink).count) << "the mark of the end goes, the code comes";
}

TEST_F(PlotTest, ArrowsPointTheWayTheToolGoes) {
  // Looks at how the height of the feed's pixels changes from one column to the next: an arrow to the right begins steeply and tapers.
  const auto steepest_rise_is_left = [this](double from, double to) {
    ToolpathPlot plot;
    plot.set_view(PlotView::kXY);
    plot.add_point(true, from, 0, 0);
    plot.add_point(false, to, 0, 0);
    std::string error;
    EXPECT_TRUE(plot.write_png(path("a.png"), &error)) << error;
    std::map<int, int> height;
    pixels(path("a.png"), is_feed, &height);
    int rise = 0, fall = 0;
    for (const auto& [x, count] : height) {
      if (height.count(x - 1) == 0 || height.count(x + 1) == 0) continue;
      rise = std::max(rise, count - height.at(x - 1));
      fall = std::max(fall, count - height.at(x + 1));
    }
    EXPECT_GE(std::max(rise, fall), 3) << "there are arrows";
    return rise > fall;
  };
  EXPECT_TRUE(steepest_rise_is_left(0, 100));
  EXPECT_FALSE(steepest_rise_is_left(100, 0));
}

TEST_F(PlotTest, NothingAndOnePointStillGiveADrawing) {
  ToolpathPlot plot;
  std::string error;
  EXPECT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  EXPECT_TRUE(plot.write_svg(path("a.svg"), &error)) << error;
  plot.add_point(false, 3, 4, 5);
  plot.set_view(PlotView::kYZ);
  EXPECT_TRUE(plot.write_png(path("a.png"), &error)) << error;
}

TEST_F(PlotTest, AMissingFolderIsAnErrorWithItsName) {
  std::string error;
  EXPECT_FALSE(square().write_png(path("none/a.png"), &error));
  EXPECT_NE(error.find("none/a.png"), std::string::npos);
}

TEST_F(PlotTest, ADenseSurfaceIsLitFromTheLeft) {
  // A ridge along Y, milled in passes of 0.1 mm: with light from the left, its left slope is lighter than its right one.
  ToolpathPlot plot;
  plot.set_view(PlotView::kXY);
  plot.add_point(true, 0, 0, 30);
  for (double y = 0; y <= 60; y += 0.2) {
    for (const double x : {0.0, 50.0, 100.0}) plot.add_point(false, x, y, x == 50.0 ? 25 : 0);
    for (const double x : {100.0, 50.0, 0.0}) plot.add_point(false, x, y + 0.1, x == 50.0 ? 25 : 0);
  }
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const auto light = [](int r, int g, int b) { return b > 215 && r > 140 && r < b - 40 && g < b; };
  const auto dark = [](int r, int g, int b) { return b > 150 && b < 200 && r < 110 && b > r + 60 && b > g + 30; };
  std::map<int, int> light_in, dark_in;
  const Pixels lit = pixels(path("a.png"), light, &light_in), shaded = pixels(path("a.png"), dark, &dark_in);
  const int middle = (lit.left + shaded.right) / 2;
  const auto before = [middle](const std::map<int, int>& columns) {
    int count = 0;
    for (const auto& [x, pixels_there] : columns) count += x < middle ? pixels_there : 0;
    return count;
  };
  EXPECT_GT(before(light_in), 200'000);
  EXPECT_LT(lit.count - before(light_in), 10'000);
  EXPECT_GT(shaded.count - before(dark_in), 200'000);
  EXPECT_LT(before(dark_in), 10'000);
}

TEST_F(PlotTest, ASurfaceHasTheColourOfWhatIsAskedFor) {
  ToolpathPlot plot;
  plot.set_view(PlotView::kXY);
  plot.set_color(PlotColor::kTool);
  plot.add_point(true, 0, 0, 30);
  for (double y = 0; y <= 60; y += 0.2) {
    plot.set_tool(y < 30 ? 1 : 2);
    plot.add_point(false, 0, y, 0);
    plot.add_point(false, 100, y, 0);
  }
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const auto blue = [](int r, int g, int b) { return b > r + 60 && b > g + 40; };
  const auto green = [](int r, int g, int b) { return g > r + 60 && g > b + 40; };
  const Pixels one = pixels(path("a.png"), blue), two = pixels(path("a.png"), green);
  EXPECT_GT(one.count, 200'000);
  EXPECT_GT(two.count, 200'000);
}

TEST_F(PlotTest, AFarRapidDoesNotShrinkThePart) {
  ToolpathPlot plot = square();
  plot.set_view(PlotView::kXZ);
  plot.add_point(true, 0, 0, 2000);
  std::string error;
  ASSERT_TRUE(plot.write_png(path("a.png"), &error)) << error;
  const Pixels feed = pixels(path("a.png"), is_feed);
  EXPECT_GT(feed.right - feed.left, 900);
  ASSERT_TRUE(plot.write_svg(path("a.svg"), &error)) << error;
}

TEST_F(PlotTest, VerticesStayBounded) {
  ToolpathPlot plot;
  for (int i = 0; i < 5'000'000; ++i) plot.add_point(i % 100'000 == 0, 0.001 * i, 0, 0);
  EXPECT_LE(plot.size(), 2'000'001u);
  EXPECT_GT(plot.size(), 10'000u);
  ToolpathPlot rapids;
  for (int i = 0; i < 4'500'000; ++i) rapids.add_point(true, 0.001 * i, i % 2, 0);
  EXPECT_LE(rapids.size(), 2'000'001u);
}

// A program with an alarm before it has moved: the marks of start and alarm are in the middle of a frame of 10 mm.
TEST_F(PlotTest, APathWithoutAMoveHasAFrameAndItsMarks) {
  ToolpathPlot plot;
  plot.set_view(PlotView::kXY);
  plot.add_point(true, 20, -3, 100);
  plot.set_alarm("P62");
  plot.set_sentence("p.nc:2: P62 No F command");
  const PlotBox box = plot_box(plot);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(box.high[i] - box.low[i], 10, 1e-5) << i;
  EXPECT_NEAR(box.low[0], 15, 1e-5);
  EXPECT_NEAR(box.high[2], 105, 1e-5);
  std::string error;
  ASSERT_TRUE(plot.write_png(path("p.png"), &error)) << error;
  const Pixels start = pixels(path("p.png"), [](int r, int g, int b) { return r < 60 && g > 110 && b < 90; });
  const Pixels alarm = pixels(path("p.png"), [](int r, int g, int b) { return r > 170 && g < 60 && b > 100; });
  EXPECT_GT(start.count, 10);
  EXPECT_GT(alarm.count, 20);
  EXPECT_NEAR((alarm.left + alarm.right) / 2, 715, 6);  // middle of the room that is left for the drawing
  EXPECT_NEAR((start.left + start.right) / 2, 715, 6);
}

// If two far starts are cut off at the same place of the frame, the drawings below their heads differ only in the words at the mark.
TEST_F(PlotTest, AStartNotFarFromThePartIsInTheFrameAndAFarOneIsNamed) {
  std::map<double, int> dark;
  for (const double z : {80.0, 500.0, 50000.0}) {
    ToolpathPlot plot;
    plot.set_view(PlotView::kXZ);
    plot.add_point(true, 0, 0, z);
    plot.add_point(true, 0, 0, 1);
    for (int i = 0; i <= 10; ++i) plot.add_point(false, 10 * i, i % 2, 0);
    EXPECT_EQ(plot_box(plot).high[2] >= z, z == 80.0);
    std::string error;
    ASSERT_TRUE(plot.write_png(path("p.png"), &error)) << error;
    dark[z] = pixels(path("p.png"), [](int r, int g, int b) { return r < 90 && g < 90 && b < 90; }).count;
  }
  EXPECT_GT(dark[50000.0], dark[500.0] + 10);
}

}  // namespace
}  // namespace nc::tools
