// SPDX-License-Identifier: Apache-2.0
// The trapezoid is followed exactly: the motion does not depend on how time is divided into cycles.
#include "motion/law.hpp"

#include <gtest/gtest.h>

#include <random>

namespace nc {
namespace {

/// Near rest a place is known to about 1e-14 mm, and a speed therefore to sqrt(2 a 1e-14 mm).
constexpr double kRounding = 2e-5;  ///< mm/s

double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

TEST(Law, RestToRestTakesTheTimeOfATrapezoid) {
  LawState s;
  const LawGoal goal{50, 0, 100, 2000};
  const double time = 50 / 100.0 + 100 / 2000.0;
  EXPECT_EQ(advance(s, goal, time - 1e-6), 0);
  EXPECT_LT(s.s, 50);
  EXPECT_NEAR(advance(s, goal, 1), 1 - 1e-6, 1e-9);
  EXPECT_EQ(s.s, 50);
  EXPECT_EQ(s.v, 0);
}

TEST(Law, ShortWayIsATriangle) {
  LawState s;
  const double left = advance(s, {0.5, 0, 1000, 2000}, 1);
  EXPECT_NEAR(1 - left, 2 * std::sqrt(0.5 / 2000), 1e-12);
  EXPECT_EQ(s.s, 0.5);
}

TEST(Law, DoesNotDependOnHowTimeIsCut) {
  std::mt19937_64 rng(1);
  for (int n = 0; n < 3000; ++n) {
    const double a = uniform(rng, 10, 5000), length = uniform(rng, 1e-3, 50), cap = uniform(rng, 1, 300);
    const double exit = rng() % 2 ? uniform(rng, 0, 300) : 0;
    LawState whole;
    whole.v =
        std::sqrt(uniform(rng, 0, 1) *
                  (exit * exit + 2 * a * length));  // fast enough for the exit or slower, over the cap or not
    const LawGoal goal{length, exit * exit, cap, a};
    const double time = uniform(rng, 0, 0.3);
    LawState parts = whole;
    const double left = advance(whole, goal, time);
    double todo = time, rest = 0;
    while (todo > 0) {
      const double t = std::min(todo, uniform(rng, 1e-5, 0.02));
      todo -= t;
      rest = advance(parts, goal, t);
      if (parts.s >= length) {
        rest += todo;
        break;
      }
    }
    EXPECT_NEAR(parts.s, whole.s, 1e-9 * (1 + length)) << n;
    EXPECT_NEAR(parts.v, whole.v, kRounding) << n;
    if (whole.s >= length) {
      EXPECT_NEAR(rest, left, 1e-7) << n;
    }
  }
}

TEST(Law, KeepsCapExitAndAcceleration) {
  std::mt19937_64 rng(2);
  for (int n = 0; n < 2000; ++n) {
    const double a = uniform(rng, 10, 5000), length = uniform(rng, 1e-3, 20),
                 exit = rng() % 2 ? uniform(rng, 0, 200) : 0;
    LawState s;
    double cap = uniform(rng, 1, 300);
    const double dt = 1e-3;
    for (int i = 0; i < 3000 && s.s < length; ++i) {
      if (rng() % 50 == 0) cap = rng() % 4 ? uniform(rng, 1, 300) : 0;
      if (i > 2000) cap = 300;
      const LawState before = s;
      const double left = advance(s, {length, exit * exit, cap, a}, dt);
      const double t = dt - left;
      EXPECT_LE(std::fabs(s.v - before.v), a * t + kRounding);
      EXPECT_LE(s.v, std::max(cap, before.v - a * t) + 1e-6) << "over the cap only on the way down to it";
      EXPECT_GE(s.s, before.s);
      EXPECT_LE(s.v * s.v, exit * exit + 2 * a * (length - s.s) + 1e-6) << "can always brake to the exit";
    }
    if (s.s >= length) {
      EXPECT_LE(s.v, exit + kRounding);
    }
  }
}

TEST(Law, TooFastForALoweredExitBrakesAllTheWay) {
  LawState s;
  s.v = 100;
  const double left = advance(s, {1, 0, 200, 1000}, 1);  // would need 5 mm
  EXPECT_EQ(s.s, 1);
  EXPECT_NEAR(s.v, std::sqrt(100.0 * 100 - 2 * 1000 * 1), 1e-9);
  EXPECT_NEAR(1 - left, (100 - s.v) / 1000, 1e-12);
}

TEST(Law, CapOfZeroComesToRestAndStays) {
  LawState s;
  s.v = 50;
  const LawGoal goal{100, 0, 0, 1000};
  EXPECT_EQ(advance(s, goal, 0.02), 0);
  EXPECT_NEAR(s.v, 30, 1e-9);
  EXPECT_EQ(advance(s, goal, 1), 0);
  EXPECT_EQ(s.v, 0);
  EXPECT_NEAR(s.s, 50.0 * 50 / 2000, 1e-12);
  const double at = s.s;
  EXPECT_EQ(advance(s, goal, 1), 0);
  EXPECT_EQ(s.s, at);
}

}  // namespace
}  // namespace nc
