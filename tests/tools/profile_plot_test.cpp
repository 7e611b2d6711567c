// SPDX-License-Identifier: Apache-2.0
// The curves of a profile are finite differences of the positions, for any number of cycles.
#include "tools/lib/profile_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nc::tools {
namespace {

nc_config two_axes() {
  nc_config config;
  nc_config_init(&config);
  config.cycle_s = 0.001;
  config.system[0].axis_count = 2;
  config.system[0].axis[0] = {};
  config.system[0].axis[0].name = 'X';
  config.system[0].axis[1] = {};
  config.system[0].axis[1].name = 'C';
  config.system[0].axis[1].rotary = true;
  return config;
}

nc_outputs at(double x, double c, double run_s) {
  nc_outputs out{};
  out.command.v[0] = x;
  out.command.v[1] = c;
  out.run_s = run_s;
  return out;
}

TEST(ProfilePlot, DifferencesOfOneStep) {
  const nc_config config = two_axes();
  ProfilePlot plot(config);
  plot.begin({});
  plot.cycle(at(0.5, -2.0, 0.001));
  EXPECT_NEAR(plot.peak(0), 500.0, 1e-9) << "the path speed is that of the linear axes";
  EXPECT_NEAR(plot.peak(1), 5e5, 1.0);
  EXPECT_NEAR(plot.peak(2), 5e8, 1e3);
  EXPECT_NEAR(plot.peak(3), 2e6, 1.0);
  plot.end();
  EXPECT_NEAR(plot.peak(1), 5e5, 1.0);
  EXPECT_NEAR(plot.peak(2), 1e9, 1e3) << "the stop counts: third difference 1 -2 1 of the step";
  EXPECT_EQ(plot.cycles(), 4u);
}

TEST(ProfilePlot, ALimitIsNamedOnlyWhereTheModeKeepsIt) {
  nc_config config = two_axes();
  config.system[0].axis[0].max_acceleration = 1000;
  config.system[0].axis[0].max_jerk = 50000;
  config.motion_mode = NC_MOTION_TRAPEZOID;
  EXPECT_EQ(ProfilePlot(config).limit(1), 1000.0);
  EXPECT_EQ(ProfilePlot(config).limit(2), 0.0) << "the trapezoid changes its acceleration at once";
  config.motion_mode = NC_MOTION_OPTIMAL;
  EXPECT_EQ(ProfilePlot(config).limit(1), 1000.0);
  EXPECT_EQ(ProfilePlot(config).limit(2), 50000.0);
}

TEST(ProfilePlot, AStopThatWaitsIsNoCycle) {
  const nc_config config = two_axes();
  ProfilePlot plot(config);
  plot.begin({});
  plot.cycle(at(0.5, 0, 0.001));
  for (int i = 0; i < 10; ++i) plot.cycle(at(0.5, 0, 0.001));
  EXPECT_EQ(plot.cycles(), 1u);
}

TEST(ProfilePlot, APeakOfOneCycleSurvivesAnyLength) {
  const nc_config config = two_axes();
  ProfilePlot plot(config);
  plot.begin({});
  double x = 0;
  constexpr size_t kCycles = 20 * ProfilePlot::kBuckets + 7;
  for (size_t i = 0; i < kCycles; ++i) {
    x += i == 12345 ? 0.2 : 0.1;
    plot.cycle(at(x, 0, 0.001 * static_cast<double>(i + 1)));
  }
  EXPECT_EQ(plot.cycles(), kCycles);
  EXPECT_NEAR(plot.peak(0), 200.0, 1e-3);
  EXPECT_NEAR(plot.peak(1), 1e5, 1.0) << "the start and the peak are steps of 100 mm/s";
}

}  // namespace
}  // namespace nc::tools
