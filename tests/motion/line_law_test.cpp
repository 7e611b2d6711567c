// SPDX-License-Identifier: Apache-2.0
// The law of a straight line: it ends at rest at the right place, keeps its limits, and no law is shorter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "motion/optimal/line_law.hpp"

namespace nc::test {
namespace {

using optimal::LineLaw;
using optimal::LineLimits;
using optimal::LineState;

constexpr double kNoEnd = 1e9;  ///< s

/// The time of a change of speed, from one constant speed to another.
double ramp(double change, const LineLimits& l) {
  const double most = l.acceleration * l.acceleration / l.jerk;
  return change >= most ? change / l.acceleration + l.acceleration / l.jerk : 2 * std::sqrt(change / l.jerk);
}
double seven_phases(double length, LineLimits l) {
  double v = l.speed;
  if (v * ramp(v, l) > length) {
    double low = 0, high = v;
    for (int n = 0; n < 200; ++n) (0.5 * (low + high) * ramp(0.5 * (low + high), l) > length ? high : low) = 0.5 * (low + high);
    v = low;
  }
  return 2 * ramp(v, l) + (length - v * ramp(v, l)) / v;
}

/// The state `t` seconds after the start.
LineState at(const LineLaw& law, double t) {
  LineState q = law.start();
  for (unsigned k = 0; k < law.count(); ++k) {
    const double part = std::min(t, law.phase(k).seconds);
    q = q.behind(law.phase(k).jerk, part);
    t -= part;
  }
  return q;
}

/// Checks that a law keeps the limits (that of the speed only if it began below it) and ends at rest.
void check(const LineLaw& law, const LineLimits& l, double most_speed) {
  LineState q = law.start();
  for (unsigned k = 0; k < law.count(); ++k) {
    EXPECT_LE(std::fabs(law.phase(k).jerk), 1.0006 * l.jerk);
    EXPECT_GT(law.phase(k).seconds, 0);
    for (int n = 0; n <= 8; ++n) {
      const LineState x = q.behind(law.phase(k).jerk, law.phase(k).seconds * n / 8);
      EXPECT_LE(x.v, most_speed * (1 + 1e-9) + 1e-9);
      EXPECT_GE(x.v, -1e-9 * (1 + most_speed));
      EXPECT_LE(std::fabs(x.a), l.acceleration * (1 + 1e-9) + 1e-9);
    }
    q = q.behind(law.phase(k).jerk, law.phase(k).seconds);
  }
  EXPECT_NEAR(q.v, 0, 1e-9 * (1 + most_speed));
  EXPECT_NEAR(q.a, 0, 1e-6 * l.acceleration);
  EXPECT_NEAR(q.s, law.distance(), 1e-9 * (1 + law.distance()));
}

TEST(LineLaw, FromRestToRestItHasTheSevenPhases) {
  LineLaw law;
  for (const double length : {1e-6, 0.001, 0.1, 3.0, 50.0, 500.0})
    for (const double v : {5.0, 50.0, 1000.0})
      for (const double a : {500.0, 20000.0})
        for (const double j : {5000.0, 50000.0, 1e6}) {
          SCOPED_TRACE(testing::Message() << length << " " << v << " " << a << " " << j);
          const LineLimits l{v, a, j};
          ASSERT_TRUE(law.reach(length, 0, 0, l, kNoEnd));
          EXPECT_TRUE(law.whole());
          EXPECT_NEAR(law.seconds(), seven_phases(length, l), 1e-9 * law.seconds());
          EXPECT_NEAR(law.distance(), length, 1e-10 * (1 + length));
          check(law, l, v);
        }
}

/// The rest of the shortest law is the shortest law from there (else the whole would not be the shortest), wherever it is planned again.
TEST(LineLaw, TheRestOfTheShortestWayIsTheShortestFromThere) {
  std::mt19937_64 rng(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); };
  LineLaw law, rest;
  for (int n = 0; n < 3000; ++n) {
    const LineLimits l{uniform(5, 300), uniform(300, 5000), std::exp(uniform(8, 14))};
    const double length = std::exp(uniform(-6, 6));
    ASSERT_TRUE(law.reach(length, 0, 0, l, kNoEnd));
    const double t = uniform(0, 0.99) * law.seconds();
    const LineState q = at(law, t);
    ASSERT_TRUE(rest.reach(length - q.s, q.v, q.a, l, kNoEnd)) << n;
    EXPECT_NEAR(rest.seconds(), law.seconds() - t, 2e-4 * law.seconds()) << n;
    check(rest, l, l.speed);
  }
}

/// From any state within the limits to any end that is far enough, with any speed limit.
TEST(LineLaw, AnyStateComesToRestWhereItShall) {
  std::mt19937_64 rng(8);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); };
  LineLaw law, stop;
  unsigned slowed = 0, late = 0;
  for (int n = 0; n < 5000; ++n) {
    const LineLimits l{uniform(5, 300), uniform(300, 5000), std::exp(uniform(8, 14))};
    const double a = uniform(-1, 1) * l.acceleration, v = uniform(0, 400) + (a < 0 ? 0.5 * a * a / l.jerk : 0);
    ASSERT_TRUE(stop.stop(v, a, l));
    check(stop, l, v + std::max(0.0, a) * a / (2 * l.jerk));
    const double length = stop.distance() + std::exp(uniform(-6, 8));
    const double level = v + a * std::fabs(a) / (2 * l.jerk);
    EXPECT_FALSE(law.reach(stop.distance() - 1e-3, v, a, l, kNoEnd));
    if (!law.reach(length, v, a, l, kNoEnd)) {
      EXPECT_LT(l.speed, level);  // so near that the lower speed cannot be reached before the end
      ++late;
      continue;
    }
    slowed += l.speed < level;
    EXPECT_NEAR(law.distance(), length, 1e-9 * (1 + length));
    EXPECT_GE(law.seconds(), stop.seconds() * (1 - 1e-9));
    check(law, l, std::max({l.speed, v, level}));
  }
  EXPECT_GT(slowed, 500u);
  EXPECT_LT(late, 2000u);
}

/// A rotary axis may turn by thousands of degrees for each mm of a line, whose jerk is then some mm/s3: there 1e-10 mm beside the end are as far as the axis
/// goes in a cycle. A stop that ends so far behind it is none.
TEST(LineLaw, AStopThatAnAxisShowsBesideItsEndIsNone) {
  const LineLimits turning{0.01, 0.15, 4.5}, straight{250, 2000, 50000};
  for (const LineLimits& l : {turning, straight}) {
    LineLaw law;
    ASSERT_TRUE(law.stop(0.2 * l.speed, 0, l));
    const double way = law.distance(), seen = 1.5 * optimal::unseen(l, way);
    EXPECT_TRUE(law.reach(way, 0.2 * l.speed, 0, l, kNoEnd));
    EXPECT_FALSE(law.reach(way - seen, 0.2 * l.speed, 0, l, kNoEnd));
    EXPECT_LT(seen, 1e-14 * l.jerk + 1e-13 * way) << "a millionth of the way of a cycle of 0.4 ms, or rounding";
  }
}

TEST(LineLaw, WhatTakesTooLongEndsEarlierAndKeepsItsSpeedUntilThen) {
  const LineLimits l{50, 2000, 50000};
  LineLaw law;
  ASSERT_TRUE(law.reach(5000, 0, 0, l, 2));
  EXPECT_FALSE(law.whole());
  EXPECT_NEAR(law.seconds(), 2, 1e-9);
  check(law, l, 50);
  double t = 0;
  for (unsigned k = 0; k < law.last_part(); ++k) t += law.phase(k).seconds;
  EXPECT_NEAR(at(law, t).v, 50, 1e-9);
  EXPECT_NEAR(at(law, t).a, 0, 1e-9);
}

}  // namespace
}  // namespace nc::test
