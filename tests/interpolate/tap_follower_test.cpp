// SPDX-License-Identifier: Apache-2.0
// The axis of a synchronous tap beside its path (M700 13.1.1): it follows the spindle, comes back when the spindle is let go, and never asks more of the
// axis than that can.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "interpolate/tap_follower.hpp"

namespace nc::test {
namespace {

constexpr double kCycle_s = 0.001, kPerMm = 1 / 1.5;  // a lead of 1.5 mm

TapFollower::Limits limits(double acceleration = 1000, double jerk = 0) {
  TapFollower::Limits all{100, acceleration, jerk, kCycle_s};
  return all;
}

/// What is added to the path in each cycle, of a path that rests at 0.
class Axis {
 public:
  explicit Axis(const TapFollower::Limits& limits) : limits_(limits) { follower.begin(0, 0); }
  void step(bool measured, double turns, double commanded, double age_s = 0) {
    limits_.before = added.empty() ? 0 : added.back();
    added.push_back(follower.step(measured, turns, age_s, commanded, kPerMm, 0, limits_));
  }
  /// The spindle stands `turns` beside its command until the axis has gone there.
  void stand_beside(double turns) {
    for (unsigned n = 0; n < 2000 && !(n > 10 && follower.arrived()); ++n) step(true, turns, 0);
  }
  /// From the cycle before `first` on.
  double greatest(unsigned difference, size_t first) const {
    double most = 0;
    for (size_t i = std::max<size_t>(first, difference); i < added.size(); ++i) {
      const double a = added[i], b = added[i - 1], c = added[i - 2], d = difference == 3 ? added[i - 3] : 0;
      const double value = difference == 2 ? (a - 2 * b + c) / std::pow(kCycle_s, 2) : (a - 3 * b + 3 * c - d) / std::pow(kCycle_s, 3);
      most = std::max(most, std::fabs(value));
    }
    return most;
  }
  TapFollower follower;
  std::vector<double> added;

 private:
  TapFollower::Limits limits_;
};

TEST(TapFollower, GoesWithASpindleThatLags) {
  Axis axis(limits());
  double turns = 0;
  for (unsigned n = 0; n < 1000; ++n) {
    axis.step(true, turns, 0.01 * n);
    turns = 0.01 * n - 0.03;  // as it was commanded, 0.03 turns behind
  }
  EXPECT_NEAR(axis.added.back(), -0.03 / kPerMm, 1e-9) << "by what the spindle is behind its command of the cycle before";
  EXPECT_EQ(axis.follower.trouble(), TapFollower::Trouble::none);
}

// An encoder behind a bus: each measurement comes five cycles late, and stays for four cycles. The spindle turns as commanded, so the axis stays on its path.
TEST(TapFollower, ComparesAnOldMeasurementWithTheCommandOfItsTime) {
  Axis axis(limits());
  const auto commanded = [](int n) { return n < 0 ? 0 : 2e-5 * n * n; };  // of the end of cycle n
  for (int n = 0; n < 1000; ++n) {
    const int measured_in = (n / 4) * 4 - 5;
    axis.step(true, commanded(measured_in - 1), commanded(n), (n - measured_in) * kCycle_s);
    ASSERT_NEAR(axis.added.back(), 0, 1e-9) << n;
  }
  EXPECT_EQ(axis.follower.trouble(), TapFollower::Trouble::none) << "40 turns a second, and 0.16 turns from one measurement to the next";
}

TEST(TapFollower, ASpindleStandsWhereItsNewMeasurementsAreTheSame) {
  Axis axis(limits());
  for (int n = 0; n < 400; ++n) {  // 0.05 turns a second, seen in every fourth cycle
    axis.step(true, 0.0002 * (n / 4), 0.00005 * n, (n % 4) * kCycle_s);
    ASSERT_FALSE(n > 8 && axis.follower.rests_beside()) << n;
  }
}

TEST(TapFollower, ASpindleThatDoesWhatItIsToldChangesNothing) {
  Axis axis(limits());
  for (unsigned n = 0; n < 1000; ++n) axis.step(true, 0, 0);
  EXPECT_EQ(axis.greatest(2, 2), 0);
  EXPECT_TRUE(axis.follower.on_path());
}

TEST(TapFollower, KeepsTheAccelerationOfTheAxisAndItsStroke) {
  for (const double low : {-HUGE_VAL, -0.5}) {
    TapFollower::Limits all = limits();
    all.low = low;
    Axis axis(all);
    double turns = 0, speed = 0;
    for (unsigned n = 0; n < 1000; ++n) {
      speed += n < 300 ? -0.00002 : 0;  // turns per cycle
      turns += speed;
      axis.step(true, turns, 0);
    }
    EXPECT_LE(axis.greatest(2, 2), 1000 * (low < -1 ? 1 + 1e-9 : 1.001)) << low;
    for (const double place : axis.added) EXPECT_GE(place, low);
    EXPECT_EQ(axis.follower.trouble(), TapFollower::Trouble::apart);
  }
}

TEST(TapFollower, SaysThatTheEncoderHasJumped) {
  Axis axis(limits());
  axis.step(true, 0, 0);
  axis.step(true, 1000, 0);
  axis.step(true, 1000, 0);
  EXPECT_EQ(axis.follower.trouble(), TapFollower::Trouble::jumped);
  EXPECT_EQ(axis.added.back(), 0) << "the axis does not follow a jump";
}

/// The spindle has come to its place but for the resolution of its encoder. What is left fades beside moves that use all of the jerk.
TEST(TapFollower, WhatIsLeftFadesUnfelt) {
  for (const double jerk : {50.0, 1000.0, 20000.0, 1e6}) {
    Axis axis(limits(1000, jerk));
    for (unsigned n = 0; n < 3000; ++n) axis.step(true, -0.0006 * std::min(1.0, n / 1500.0), 0);
    ASSERT_TRUE(axis.follower.on_path());
    const size_t from = axis.added.size();
    axis.follower.end();
    for (unsigned n = 0; n < 20000 && axis.follower.active(); ++n) axis.step(true, -0.0006, 0);
    EXPECT_FALSE(axis.follower.active()) << jerk;
    EXPECT_EQ(axis.added.back(), 0) << jerk;
    for (unsigned n = 0; n < 5; ++n) axis.added.push_back(0);
    EXPECT_LE(axis.greatest(3, from), 1e-3 * jerk) << jerk;
    EXPECT_LE(axis.greatest(2, from), 1e-3 * 1000) << jerk;
  }
}

/// A spindle whose lag dies away passes its place with a speed. The axis may only be said to be on its path when that carries it no farther away than the
/// resolution of an encoder, however slowly it fades.
TEST(TapFollower, WhatIsLeftIsNotCarriedAway) {
  for (const double jerk : {0.0, 50.0, 1000.0, 20000.0, 1e6}) {
    Axis axis(limits(1000, jerk));
    double lag = 0.05;
    for (unsigned n = 0; n < 3000 && (n < 10 || !axis.follower.on_path()); ++n) axis.step(true, -(lag *= 0.95), 0);
    ASSERT_TRUE(axis.follower.on_path()) << jerk;
    const size_t from = axis.added.size();
    axis.follower.end();
    for (unsigned n = 0; n < 20000 && axis.follower.active(); ++n) axis.step(true, 0, 0);
    for (size_t i = from; i < axis.added.size(); ++i) ASSERT_LE(std::fabs(axis.added[i]), 1.05e-3) << jerk;
  }
}

/// A lag that dies away slowly leaves the axis an acceleration where its place and its speed are nothing any more. It fades beside moves that use all that the axis
/// can, so it is a thousandth of that as well.
TEST(TapFollower, AnAccelerationThatIsLeftFadesUnfelt) {
  for (const double acceleration : {500.0, 3000.0}) {
    for (const double keeps : {0.8, 0.9, 0.95, 0.98}) {
      Axis axis(limits(acceleration));
      double lag = 0.05;
      for (unsigned n = 0; n < 3000 && (n < 10 || !axis.follower.on_path()); ++n) axis.step(true, -(lag *= keeps), 0);
      ASSERT_TRUE(axis.follower.on_path()) << keeps;
      const size_t from = axis.added.size();
      axis.follower.end();
      for (unsigned n = 0; n < 20000 && axis.follower.active(); ++n) axis.step(true, -(lag *= keeps), 0);
      for (unsigned n = 0; n < 5; ++n) axis.added.push_back(0);
      EXPECT_LE(axis.greatest(2, from), 1e-3 * acceleration) << acceleration << " " << keeps;
    }
  }
}

/// The spindle stands 0.018 turns beside its place, 0.027 mm of the axis: unfelt that would take seconds where the jerk is low, so it is done while the path
/// rests, within the limits.
TEST(TapFollower, WhatASpindleThatStandsHasLeftFadesAtRest) {
  for (const double jerk : {50.0, 1000.0, 20000.0, 1e6}) {
    Axis axis(limits(1000, jerk));
    axis.stand_beside(0.018);
    ASSERT_TRUE(axis.follower.arrived());
    ASSERT_FALSE(axis.follower.on_path());
    const size_t from = axis.added.size();
    axis.follower.end_at_rest();
    while (axis.follower.waited_for() && axis.added.size() < from + 5000) axis.step(true, 0.018, 0);
    EXPECT_FALSE(axis.follower.active()) << jerk;
    EXPECT_LE(static_cast<double>(axis.added.size() - from) * kCycle_s, 0.02 + std::cbrt(60 * 0.027 / (0.25 * jerk))) << jerk;
    for (unsigned n = 0; n < 5; ++n) axis.added.push_back(0);
    EXPECT_LE(axis.greatest(3, from), jerk) << jerk;
    EXPECT_LE(axis.greatest(2, from), 1000) << jerk;
  }
}

// The next tap takes its spindle in the cycle in which the axis comes to R, braking with all that it can, while what the tap before has left still fades.
TEST(TapFollower, TheNextTapBeginsAmidTheFadeOfTheOneBefore) {
  const TapFollower::Limits all = limits(500);
  TapFollower follower;
  follower.begin(0, 0);
  double place = 0, before = 0, most = 0;
  unsigned n = 0;
  const auto step = [&](double path, bool measured) {
    TapFollower::Limits now = all;
    now.before = place;
    const double added = follower.step(measured, 0.0005, 0, 0, kPerMm, path, now), next = path + added;
    if (n++ > 1) most = std::max(most, std::fabs(next - 2 * place + before) / (kCycle_s * kCycle_s));
    before = place;
    place = next;
  };
  for (unsigned k = 0; k < 500; ++k) step(0, true);
  follower.end();
  for (unsigned k = 0; k < 10; ++k) step(0, true);
  ASSERT_TRUE(follower.active()) << "it fades";
  const unsigned ramp = 40;  // up and down again, each within 500 mm/s^2
  double path = 0, speed = 0;
  for (unsigned k = 0; k < 2 * ramp; ++k) {
    speed += (k < ramp ? 1 : -1) * 0.498 * kCycle_s * 1000;
    path += speed * kCycle_s;
    if (k + 1 == 2 * ramp) follower.begin(0.0005, 0);
    step(path, true);
  }
  for (unsigned k = 0; k < 200; ++k) step(path, true);
  EXPECT_LE(most, 500 * 1.001);
  EXPECT_NEAR(place, path, 1e-3);
}

}  // namespace
}  // namespace nc::test
