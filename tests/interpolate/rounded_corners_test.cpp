// SPDX-License-Identifier: Apache-2.0
// Corners that the mean of high-accuracy control rounds in the trapezoid mode (M700 13.15): random programs of lines keep velocity and acceleration
// of every axis in every cycle and stay within the tolerance, with any overrides and holds, and short lines are no stops.
#include "motion/rounding.hpp"
#include "support/seeds.hpp"

#include <gtest/gtest.h>

#include "interpolate/line_program.hpp"
#include "interpolate/path_distance.hpp"
#include "interpolate/test_machine.hpp"
#include "motion/limits.hpp"

namespace nc::test {
namespace {

ExecutorConfig config_of(uint64_t seed) {
  static constexpr double kTolerance[] = {0.01, 0.01, 0.002, 0.05, 0.2};
  static constexpr double kCycle[] = {0.001, 0.001, 0.0005, 0.002};
  ExecutorConfig config = standard_config(3);
  for (unsigned i = 0; i < 3; ++i) config.limits[i] = {250, 250, i == 2 && seed % 3 == 0 ? 1200.0 : 2000.0, 0, 0.01};
  config.filters = true;
  config.tolerance = kTolerance[seed / 9 % 5];
  config.cycle_s = kCycle[seed / 45 % 4];
  return config;
}

FilterTimes rounding_of(const ExecutorConfig& config) {
  MotionLimits limits;
  limits.axis_count = config.axis_count;
  for (unsigned i = 0; i < config.axis_count; ++i) limits.axis[i] = config.limits[i];
  limits.cycle_s = config.cycle_s;
  limits.tolerance = config.tolerance;
  return rounding_filter(limits);
}

struct Seen {
  double seconds = 0, off = 0;
  bool ends = false, keeps = false;
  std::string report;
};

Seen run(const LineProgram& lines, const ExecutorConfig& config, const FilterTimes& filter, uint64_t disturbed) {
  Seen seen;
  Program p(config);
  for (size_t k = 1; k < lines.point.size(); ++k) {
    p.line(lines.point[k], lines.feed[k]);
    p.records.back().segment.filter = filter;
    p.mark();
  }
  p.end();
  const PathDistance path(p, config.axis_count);
  Machine m(config);
  m.feed(p);
  m.start();
  std::mt19937_64 rng(disturbed);
  uint64_t n = 0;
  for (; n < 4000000; ++n) {
    if (n % 5 == 0) m.feed(p);
    if (disturbed != 0 && rng() % 64 == 0) m.in.feed_override = static_cast<double>(rng() % 200) / 100;
    if (disturbed != 0 && rng() % 200 == 0) m.in.feed_hold = true;
    if (disturbed != 0 && rng() % 20 == 0) m.in.feed_hold = false;
    m.in.cycle_start = m.out.state == NC_STATE_HOLD && !m.in.cycle_start;
    m.cycle();
    if (m.out.state == NC_STATE_ALARM) return seen;
    if (n % 3 == 0) seen.off = std::max(seen.off, path.near(m.out.serial, m.command(), seen.off));
    if (m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained()) break;
  }
  seen.seconds = static_cast<double>(n) * config.cycle_s;
  seen.ends = m.command() == p.at();
  seen.keeps = m.checker.worst_velocity <= 1.001 && m.checker.worst_acceleration <= 1.001;
  seen.report = m.checker.report();
  return seen;
}

/// NC_SEEDS=1000 runs so many seeds, NC_FIRST=7 begins with seed 7.
TEST(RoundedCorners, RandomLinesKeepTheLimitsAndTheTolerance) {
  const uint64_t from = wish("NC_FIRST", 0), count = seeds(90, 9);
  for (uint64_t seed = from; seed < from + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng(seed);
    const LineProgram lines = line_program(static_cast<LineShape>(seed % static_cast<uint64_t>(LineShape::count)), rng);
    const ExecutorConfig config = config_of(seed);
    const Seen seen = run(lines, config, rounding_of(config), seed % 2 == 0 ? 0 : seed);
    EXPECT_TRUE(seen.ends);
    EXPECT_TRUE(seen.keeps) << seen.report;
    EXPECT_LE(seen.off, config.tolerance);
  }
}

// 1 um of noise in lines of 0.05 mm: without rounding each vertex would be a step within one cycle, and be passed at about 20 mm/s.
TEST(RoundedCorners, NoiseIsNoStop) {
  LineProgram lines;
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> noise(-0.001, 0.001);
  for (int k = 1; k <= 2000; ++k) lines.to(0.05 * k, 0, noise(rng), 130);
  ExecutorConfig config = config_of(1);
  config.tolerance = 0.01;
  config.capacity = 16384;
  const Seen rounded = run(lines, config, rounding_of(config), 0), sharp = run(lines, config, {}, 0);
  EXPECT_TRUE(rounded.keeps) << rounded.report;
  EXPECT_LT(rounded.seconds, 1.75 * 100 / 130);
  EXPECT_GT(sharp.seconds, 3 * 100.0 / 130);
}

// Each corner takes the axis that turns there, and leaves the acceleration of the other one to the path: 1.3 mm along X between corners in Z. With
// the same share kept of every axis it took 5.1 s.
TEST(RoundedCorners, ACornerOfOneAxisLeavesTheOtherOnes) {
  LineProgram lines;
  for (int k = 1; k <= 100; ++k) lines.to(1.3 * k, 0, 0.25 * (k % 2), 150);
  ExecutorConfig config = config_of(1);
  config.tolerance = 0.01;
  const Seen seen = run(lines, config, rounding_of(config), 0);
  EXPECT_TRUE(seen.ends && seen.keeps) << seen.report;
  EXPECT_LE(seen.off, config.tolerance);
  EXPECT_LT(seen.seconds, 3.5);
}

TEST(RoundedCorners, WithoutAToleranceOrALimitThereIsNoMean) {
  ExecutorConfig config = config_of(0);
  EXPECT_EQ(rounding_of(config).kind, FilterTimes::Kind::before);
  config.tolerance = 0;
  EXPECT_EQ(rounding_of(config).kind, FilterTimes::Kind::none);
  config.tolerance = 1e-9;  // less than a cycle
  EXPECT_EQ(rounding_of(config).kind, FilterTimes::Kind::none);
  config.tolerance = 0.01;
  config.limits[1].acceleration = 0;
  EXPECT_EQ(rounding_of(config).kind, FilterTimes::Kind::none);
}

}  // namespace
}  // namespace nc::test
