// SPDX-License-Identifier: Apache-2.0
// Dense passes become a surface, single lines do not; passes that were cut away later, or that lie above, do not belong to it. And which parts
// of a path a drawing shows.
#include "tools/lib/relief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "support/seeds.hpp"
#include "tools/lib/plot_pieces.hpp"

namespace nc::tools {
namespace {

using Height = std::function<double(double x, double y)>;
constexpr double kSize = 100;  // side of the milled square, mm

// Passes along X, `step` mm apart.
void raster(Relief* relief, double step, const Height& z, float value) {
  for (double y = 0; y <= kSize; y += step)
    for (double x = 0; x < kSize; x += 0.5) relief->add({x, y, z(x, y)}, {x + 0.5, y, z(x + 0.5, y)}, value);
}

double height_at(const Relief& relief, double x, double y) {
  double best = 1e9, z = NAN;
  for (unsigned row = 0; row < relief.rows(); ++row)
    for (unsigned column = 0; column < relief.columns(); ++column) {
      if (!relief.covered(column, row)) continue;
      const Relief::Place p = relief.place(column, row);
      const double distance = std::hypot(p.x - x, p.y - y);
      if (distance >= best) continue;
      best = distance;
      z = p.z;
    }
  return best < 1.0 ? z : NAN;
}

double dome(double x, double y) { return 10 * std::exp(-(std::pow(x - 50, 2) + std::pow(y - 50, 2)) / 400) - 10; }

TEST(Relief, DensePassesAreASurfaceWithTheirHeights) {
  for (const double step : {0.05, 0.1, 0.2, 0.5}) {
    if (test::sanitized() && step < 0.2) continue;
    Relief relief(0, 0, kSize, kSize);
    raster(&relief, step, dome, 1.0F);
    relief.finish();
    ASSERT_TRUE(relief.any()) << step;
    for (const double x : {5.0, 35.0, 50.0, 64.0, 95.0}) {
      EXPECT_TRUE(relief.covers(x, 50.2)) << step;
      EXPECT_NEAR(height_at(relief, x, 50.2), dome(x, 50.2), 0.15) << step;
    }
    EXPECT_FALSE(relief.covers(-3, 50)) << step;
  }
}

TEST(Relief, PassesWithGapsAreLines) {
  Relief relief(0, 0, kSize, kSize);
  raster(&relief, 4.0, dome, 1.0F);
  relief.finish();
  EXPECT_FALSE(relief.any());
  EXPECT_FALSE(relief.covers(50, 48));
}

TEST(Relief, ABundleOfContoursIsNoSurface) {
  Relief relief(0, 0, kSize, kSize);
  for (int k = 0; k < 8; ++k) relief.add({0, 50 + 0.5 * k, 0}, {kSize, 50 + 0.5 * k, 0}, 1.0F);
  relief.finish();
  EXPECT_FALSE(relief.any());
}

TEST(Relief, RoughingLeavesNothingWhereFinishingHasCutDeeper) {
  Relief relief(0, 0, kSize, kSize);
  raster(&relief, 3.17, [](double, double) { return 5.0; }, 1.0F);  // 3.17, so that they lie between the passes of finishing
  raster(&relief, 0.4, [](double, double) { return -5.0; }, 2.0F);
  relief.finish();
  ASSERT_TRUE(relief.any());
  for (unsigned row = 0; row < relief.rows(); ++row)
    for (unsigned column = 0; column < relief.columns(); ++column) {
      if (!relief.covered(column, row)) continue;
      ASSERT_NEAR(relief.place(column, row).z, -5.0, 1e-3) << column << ' ' << row;
      ASSERT_EQ(relief.value(column, row), 2.0F);
    }
}

TEST(Relief, AFeedMoveAboveTheSurfaceIsNoWall) {
  Relief relief(0, 0, kSize, kSize);
  raster(&relief, 0.4, [](double, double) { return -5.0; }, 2.0F);
  relief.add({3, 3, 20}, {90, 80, 20}, 2.0F);
  relief.finish();
  EXPECT_NEAR(height_at(relief, 46.5, 41.5), -5.0, 1e-3);
}

TEST(Relief, AnEdgeStaysAnEdge) {
  Relief relief(0, 0, kSize, kSize);
  const auto step = [](double x, double) { return x < 50 ? 0.0 : -20.0; };
  raster(&relief, 0.2, step, 1.0F);
  relief.finish();
  EXPECT_NEAR(height_at(relief, 49.0, 50), 0.0, 0.05);
  EXPECT_NEAR(height_at(relief, 51.0, 50), -20.0, 0.05);
}

TEST(Relief, AThinRibStaysARib) {
  Relief relief(0, 0, kSize, kSize);
  const auto rib = [](double, double y) { return y > 49.7 && y < 50.3 ? 0.0 : -20.0; };
  raster(&relief, 0.1, rib, 1.0F);
  relief.finish();
  EXPECT_NEAR(height_at(relief, 50, 50), 0.0, 4.0) << "it is five cells wide";
  EXPECT_NEAR(height_at(relief, 50, 52), -20.0, 0.05);
}

TEST(Relief, ADrilledHoleIsAHole) {
  Relief relief(0, 0, kSize, kSize);
  raster(&relief, 0.2, dome, 1.0F);
  relief.add({20, 20, 5}, {20, 20, -30}, 2.0F);
  relief.finish();
  EXPECT_TRUE(relief.is_hole(20, 20, -30));
  EXPECT_FALSE(relief.is_hole(40, 20, dome(40, 20))) << "a tool that goes down to the surface";
}

ToolpathPlot with_home_far_away() {
  ToolpathPlot plot;
  plot.add_point(true, -400, -300, 500);
  plot.add_point(true, 0, 0, 10);
  plot.add_point(false, 0, 0, -2);
  plot.add_point(false, 100, 0, -2);
  plot.add_point(false, 100, 60, -2);
  plot.add_point(true, 100, 60, 500);
  return plot;
}

TEST(PlotPieces, TheFrameFitsTheFeedMoves) {
  const PlotBox box = plot_box(with_home_far_away());
  EXPECT_GE(box.low[0], -30);
  EXPECT_LE(box.low[0], 0);
  EXPECT_EQ(box.high[0], 100);
  EXPECT_EQ(box.low[2], -2);
  EXPECT_GE(box.high[2], 10) << "rapids nearby are in it";
  EXPECT_LE(box.high[2], 40);
  EXPECT_TRUE(goes_outside(with_home_far_away(), box));
}

TEST(PlotPieces, WithoutFeedMovesTheFrameFitsAll) {
  ToolpathPlot plot;
  plot.add_point(true, -400, 0, 500);
  plot.add_point(true, 0, 20, 10);
  const PlotBox box = plot_box(plot);
  EXPECT_EQ(box.low[0], -400);
  EXPECT_EQ(box.high[2], 500);
  EXPECT_FALSE(goes_outside(plot, box));
}

TEST(PlotPieces, RapidsEndAtTheFrameAndFeedsAreWhole) {
  const ToolpathPlot plot = with_home_far_away();
  const PlotBox box = plot_box(plot);
  const std::vector<InkVertex> ink = ink_of(plot, box, plot_relief(plot, box));
  double feed = 0, rapid = 0;
  for (size_t i = 1; i < ink.size(); ++i) {
    if (ink[i].ink == Ink::kNone) continue;
    for (const InkVertex& v : {ink[i - 1], ink[i]}) {
      EXPECT_GE(v.x, box.low[0] - 1e-3);
      EXPECT_LE(v.z, box.high[2] + 1e-3);
    }
    (ink[i].ink == Ink::kFeed ? feed : rapid) += std::hypot(ink[i].x - ink[i - 1].x, ink[i].y - ink[i - 1].y, ink[i].z - ink[i - 1].z);
  }
  EXPECT_NEAR(feed, 12 + 100 + 60, 1e-3);
  EXPECT_GT(rapid, 20.0);
  EXPECT_LT(rapid, 80.0);
}

TEST(PlotPieces, FeedsAreLinesOutsideOfTheSurfaceOnly) {
  ToolpathPlot plot;
  plot.add_point(true, 0, 0, 0);
  bool back = false;
  for (double y = 0; y <= kSize; y += 0.25, back = !back) {
    plot.add_point(false, back ? kSize : 0, y, -1);
    plot.add_point(false, back ? 0 : kSize, y, -1);
  }
  plot.add_point(true, 150, 50, 5);
  plot.add_point(false, 150, 50, -1);
  plot.add_point(false, 50, 50, -1);
  const PlotBox box = plot_box(plot);
  const Relief relief = plot_relief(plot, box);
  ASSERT_TRUE(relief.any());
  const std::vector<InkVertex> ink = ink_of(plot, box, relief);
  double feed = 0;
  for (size_t i = 1; i < ink.size(); ++i)
    if (ink[i].ink == Ink::kFeed) feed += std::hypot(ink[i].x - ink[i - 1].x, ink[i].y - ink[i - 1].y, ink[i].z - ink[i - 1].z);
  EXPECT_NEAR(feed, 6 + 50, 2.5) << "the plunge beside it, and the way to its edge";
}

}  // namespace
}  // namespace nc::tools
