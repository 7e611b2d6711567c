// SPDX-License-Identifier: Apache-2.0
// The path of a run from its samples: places, kinds, speeds and tools.
#include "tools/lib/run_plot.hpp"

#include <gtest/gtest.h>

namespace nc::tools {
namespace {

nc_config xyz_config() {
  nc_config config;
  nc_config_init(&config);
  config.cycle_s = 0.001;
  config.system[0].axis_count = 3;
  for (int i = 0; i < 3; ++i) {
    config.system[0].axis[i] = {};
    config.system[0].axis[i].name = "XYZ"[i];
  }
  return config;
}

// A sample of a position; the workpiece origin is at machine X 100.
rt::PositionSample at(double x, double y, bool rapid = false) {
  rt::PositionSample sample;
  sample.rapid = rapid;
  sample.command = {{x + 100, y, 0}};
  sample.work = {{x, y, 0}};
  return sample;
}

TEST(RunPlot, CornersAreVerticesInTheCoordinatesAskedFor) {
  for (const PlotCoordinates coordinates : {PlotCoordinates::kWork, PlotCoordinates::kMachine}) {
    RunPlot run(xyz_config(), PlotView::kXY, coordinates, PlotColor::kKind);
    for (int i = 0; i <= 10; ++i) run.moved(at(i, 0));
    for (int i = 1; i <= 10; ++i) run.moved(at(10, i));
    run.finish();
    ASSERT_EQ(run.plot.size(), 3u);
    const double zero = coordinates == PlotCoordinates::kWork ? 0 : 100;
    EXPECT_EQ(run.plot.point(0), (std::array<double, 3>{zero, 0, 0}));
    EXPECT_EQ(run.plot.point(1), (std::array<double, 3>{zero + 10, 0, 0}));
    EXPECT_EQ(run.plot.point(2), (std::array<double, 3>{zero + 10, 10, 0}));
  }
}

TEST(RunPlot, WaitingIsNoFeed) {
  RunPlot run(xyz_config(), PlotView::kXY, PlotCoordinates::kWork, PlotColor::kKind);
  run.moved(at(0, 0));
  run.moved(at(0, 0));
  run.moved(at(5, 0, true));
  run.moved(at(5.1, 0, false));  // last step of the rapid: the next block has begun in the same scan
  run.moved(at(5.1, 0, false));  // the spindle comes to speed
  run.moved(at(9, 0, true));
  run.finish();
  for (size_t i = 1; i < run.plot.size(); ++i) EXPECT_TRUE(run.plot.vertices()[i].rapid) << i;
}

TEST(RunPlot, AToolLengthThatComesIntoForceIsNoFeed) {
  RunPlot run(xyz_config(), PlotView::kXY, PlotCoordinates::kWork, PlotColor::kFeed);
  run.moved(at(0, 0));
  for (int i = 1; i <= 5; ++i) run.moved(at(0.1 * i, 0));
  rt::PositionSample sample = at(0.5, 0);
  sample.work.v[2] = -120;
  run.moved(sample);
  for (int i = 1; i <= 5; ++i) {
    sample.command.v[0] += 0.1;
    sample.work.v[0] += 0.1;
    run.moved(sample);
  }
  run.finish();
  const auto& all = run.plot.vertices();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_TRUE(all[2].rapid);
  for (const int i : {1, 3}) {
    EXPECT_FALSE(all[i].rapid);
    EXPECT_NEAR(all[i].value, 6000, 1);
  }
}

TEST(RunPlot, TheColourByFeedIsTheSpeed) {
  RunPlot run(xyz_config(), PlotView::kXY, PlotCoordinates::kWork, PlotColor::kFeed);
  double x = 0;
  run.moved(at(x, 0));
  for (const double speed : {0.05, 0.1})
    for (int i = 0; i < 10; ++i) run.moved(at(x += speed, 0));
  run.finish();
  const auto& all = run.plot.vertices();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(all[1].value, 3000, 1);
  EXPECT_NEAR(all[1].x, 0.5, 1e-6);
  EXPECT_NEAR(all[2].value, 6000, 1);
}

TEST(RunPlot, AToolThatIsFetchedForLaterDoesNotCutYet) {
  RunPlot run(xyz_config(), PlotView::kXY, PlotCoordinates::kWork, PlotColor::kTool);
  nc_modal modal = {};
  run.set_modal([&modal](nc_modal* out) {
    *out = modal;
    return true;
  });
  run.moved(at(0, 0));
  modal.tool = 1;
  modal.m = 6;
  run.moved(at(1, 0));
  modal.m = 3;
  modal.tool = 2;
  run.moved(at(2, 0));
  modal.m = 6;
  run.moved(at(3, 0));
  run.moved(at(4, 0));
  run.finish();
  const auto& all = run.plot.vertices();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].value, 1);
  EXPECT_EQ(all[1].x, 2);
  EXPECT_EQ(all[2].value, 2);
}

}  // namespace
}  // namespace nc::tools
