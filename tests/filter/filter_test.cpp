// SPDX-License-Identifier: Apache-2.0
// The filters behind interpolation, compared with the formulas of 13.15; how they end, and that nothing is lost in them however long they run.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "dialect/m700/accuracy.hpp"
#include "filter/position_filter.hpp"

namespace nc {
namespace {

constexpr double kCycle = 0.001;

/// Filters of `axes` axes with their memory.
struct Filters {
  explicit Filters(unsigned axes = 1, uint32_t places = 4000) : rings(size_t{axes} * places) { filter.create(axes, kCycle, rings.data(), places); }
  std::vector<double> rings;
  PositionFilter filter;
};

FilterTimes after(double linear_ms, double exponential_ms) {
  FilterTimes times;
  times.kind = FilterTimes::Kind::after;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    times.mean[i] = static_cast<uint16_t>(filter_cycles(linear_ms, kCycle));
    times.lag_s[i] = static_cast<float>(exponential_ms / 1000);
  }
  return times;
}

FilterTimes before(double first_ms, double second_ms) {
  FilterTimes times;
  times.kind = FilterTimes::Kind::before;
  for (uint16_t& mean : times.mean) mean = static_cast<uint16_t>(filter_cycles(first_ms, kCycle));
  times.second = static_cast<uint16_t>(filter_cycles(second_ms, kCycle));
  return times;
}

AxisVec at(double x) {
  AxisVec a;
  a[0] = x;
  return a;
}

/// Mean of a share over the cycle that ends at `end` ms.
double over_cycle(const std::function<double(double)>& share, double end) {
  constexpr int kParts = 32;
  double sum = 0;
  for (int k = 0; k < kParts; ++k) sum += share(end - 1 + (k + 0.5) / kParts);
  return sum / kParts;
}

/// Expects how far the axis moves in each cycle of a path that begins with its full speed.
void expect_rise(const FilterTimes& times, unsigned cycles, double tolerance, const std::function<double(double)>& share) {
  Filters f;
  ASSERT_TRUE(f.filter.use(times));
  f.filter.reset(at(17));
  constexpr double kWay = 0.125;
  double last = 17;
  for (unsigned n = 1; n <= cycles; ++n) {
    const double x = f.filter.filter(at(17 + n * kWay), false)[0];
    ASSERT_NEAR((x - last) / kWay, over_cycle(share, n), tolerance) << "cycle " << n;
    last = x;
  }
}

TEST(Filters, LinearRise) {
  expect_rise(after(50, 0), 120, 1e-9, [](double t) { return m700::linear_rise(t, 50); });
}
TEST(Filters, ExponentialRise) {
  expect_rise(after(0, 40), 400, 1e-5, [](double t) { return m700::exponential_rise(t, 40); });
}
TEST(Filters, LinearAndExponentialRise) {
  expect_rise(after(50, 30), 400, 2e-4, [](double t) { return m700::combined_rise(t, 50, 30); });
}
TEST(Filters, SPattern) {
  expect_rise(before(30, 20), 80, 2e-4, [](double t) { return m700::s_filter(t, 30, 20); });
  expect_rise(before(0, 20), 80, 1e-9, [](double t) { return m700::s_filter(t, 0, 20); });
}

TEST(Filters, LagAtConstantSpeedIsThatOfTheManual) {
  Filters f;
  ASSERT_TRUE(f.filter.use(after(80, 25)));
  double x = 0;
  for (unsigned n = 0; n < 2000; ++n) x = f.filter.filter(at((n + 1) * 0.1), false)[0];
  EXPECT_NEAR(200 - x, m700::smoothing_lag_mm(6000, 80, 25), 1e-6);  // 0.1 mm in a cycle: 6000 mm/min
}

/// M700 7.7: Td = Ts, 2 Ts, or their sum for both filters in series; after that the axis is where the path is, to the last bit.
TEST(Filters, EndsWithTheDecelerationCheckTime) {
  struct Case {
    FilterTimes times;
    unsigned cycles;
  };
  for (const Case& c : {Case{after(60, 0), 60}, Case{after(0, 40), 80}, Case{after(60, 40), 140}, Case{before(30, 20), 50}}) {
    Filters f;
    ASSERT_TRUE(f.filter.use(c.times));
    f.filter.reset(at(0));
    double x = 0;
    for (unsigned n = 0; n < 1000; ++n) f.filter.filter(at(x += 0.1), false);
    for (unsigned n = 1; n < c.cycles; ++n) {
      f.filter.filter(at(x), true);
      ASSERT_FALSE(f.filter.drained(at(x))) << n << " of " << c.cycles;
    }
    EXPECT_EQ(f.filter.filter(at(x), true)[0], x);
    EXPECT_TRUE(f.filter.drained(at(x)));
    EXPECT_TRUE(f.filter.settled(at(x)));
  }
}

/// The deceleration to a rest is constant: speed / (2 tau).
TEST(Filters, ExponentialLandsLinearly) {
  Filters f;
  ASSERT_TRUE(f.filter.use(after(0, 40)));
  double x = 0, y = 0, last = 0, v = 0;
  for (unsigned n = 0; n < 2000; ++n) f.filter.filter(at(x += 0.1), false);
  y = last = f.filter.filter(at(x), true)[0];
  for (unsigned n = 1; n < 79; ++n) {
    const double before = v;
    y = f.filter.filter(at(x), true)[0];
    v = (y - last) / kCycle;
    last = y;
    if (n > 1) {
      EXPECT_NEAR((v - before) / kCycle, -100 / 0.08, 1e-3) << n;
    }
  }
}

TEST(Filters, NothingIsLostInAMillionCycles) {
  for (const FilterTimes& times : {after(37, 0), after(0, 23), after(37, 23), before(50, 21)}) {
    Filters f;
    ASSERT_TRUE(f.filter.use(times));
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> way(-0.05, 0.1);
    AxisVec x;
    f.filter.reset(x);
    for (unsigned n = 0; n < 1000000; ++n) {
      x[0] += way(rng);
      f.filter.filter(x, false);
    }
    // Whatever the filter was given before: at constant speed the lag is that of the formula.
    double lag = 0;
    for (unsigned n = 0; n < 1000; ++n) {
      x[0] += 0.05;
      lag = x[0] - f.filter.filter(x, false)[0];
    }
    const double mean = times.mean[0] + times.second;
    EXPECT_NEAR(lag, 0.05 * (mean / 2 + static_cast<double>(times.lag_s[0]) / kCycle), 2e-9);
    for (unsigned n = 0; n < 200; ++n) f.filter.filter(x, true);
    EXPECT_EQ(f.filter.filter(x, true)[0], x[0]);
  }
}

TEST(Filters, WithoutConstantsThePlaceGoesThrough) {
  Filters f(2, 0);
  EXPECT_TRUE(f.filter.use({}));
  AxisVec x;
  x[0] = 0.1, x[1] = 1e9 / 3;
  EXPECT_EQ(f.filter.filter(x, false), x);
  EXPECT_TRUE(f.filter.drained(x));
  EXPECT_TRUE(f.filter.settled(x));
  x[1] = 2;
  EXPECT_FALSE(f.filter.settled(x));  // the filter has not been given this place yet
}

TEST(Filters, TooLongAMeanIsRefused) {
  Filters f(1, 100);
  EXPECT_TRUE(f.filter.use(after(100, 0)));
  EXPECT_FALSE(f.filter.use(after(101, 0)));
  EXPECT_FALSE(f.filter.use(before(60, 41)));
}

TEST(Filters, AxesAreApart) {
  Filters f(3);
  FilterTimes times = after(10, 0);
  times.mean[1] = 20;
  times.mean[2] = 0;
  ASSERT_TRUE(f.filter.use(times));
  AxisVec x, y;
  for (unsigned n = 0; n < 100; ++n) {
    for (unsigned i = 0; i < 3; ++i) x[i] += 1;
    y = f.filter.filter(x, false);
  }
  EXPECT_NEAR(x[0] - y[0], 5, 1e-12);
  EXPECT_NEAR(x[1] - y[1], 10, 1e-12);
  EXPECT_EQ(x[2], y[2]);
}

/// When the origin of the positions changes, the motion that is still in the filter stays.
TEST(Filters, RelocationKeepsWhatIsOnItsWay) {
  Filters f;
  ASSERT_TRUE(f.filter.use(after(20, 0)));
  double x = 0;
  for (unsigned n = 0; n < 30; ++n) f.filter.filter(at(x += 0.5), false);
  f.filter.relocate(at(x + 360));
  EXPECT_NEAR(f.filter.position()[0], x + 360 - 5, 1e-12);
  EXPECT_NEAR(f.filter.filter(at(x + 360), true)[0], x + 360 - 5 + 0.5 * (1 - 0.5 / 20), 1e-12);
}

/// Constants in cycles: the nearest whole number, and never none.
TEST(Filters, ConstantsAreWholeCycles) {
  EXPECT_EQ(filter_cycles(0, 0.001), 0u);
  EXPECT_EQ(filter_cycles(0.2, 0.001), 1u);
  EXPECT_EQ(filter_cycles(100.4, 0.001), 100u);
  EXPECT_EQ(filter_cycles(100, 0.004), 25u);
  EXPECT_EQ(filter_cycles(30, 0.0004), 75u);
  EXPECT_EQ(filter_cycles(4000, 1e-9), kMostFilterCycles);
}

}  // namespace
}  // namespace nc
