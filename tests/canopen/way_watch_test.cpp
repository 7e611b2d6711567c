// SPDX-License-Identifier: Apache-2.0
// The way of the speeds that are given against the way that is measured (way_watch.hpp), with random axes in the loop that holds their positions: no sound one is lost though its limit is hardly more than its distance, and
// one whose encoder does not count the turns of its motor is lost before that has gone far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <vector>

#include "hal/canopen/way_watch.hpp"
#include "support/seeds.hpp"

namespace {

using nc::hal::canopen::WayWatch;

constexpr double kPerMm = 2000;  // increments

struct Axis {
  double gain = 30, sync_s = 0.001, delay = 3;
  double scale = 1;       // of the speed that its drive makes
  double lag_s = 0;       // time constant of its loop of the speed
  double dead = 0;        // mm/s that friction takes away
  double velocity = 100, acceleration = 1000;  // of the set-points
  double still = 0;       // share of the time in which they rest
};

enum class Encoder { kCounts, kStands, kSlips, kBackwards };

struct Seen {
  double most_distance = 0;  // mm
  bool lost = false;
  double motor = 0;          // mm by which the motor has left the set-points since the fault
};

// Set-points that go from one random place to the next, with stops and reversals on the way.
class SetPoints {
 public:
  SetPoints(const Axis& axis, unsigned seed) : axis_(axis), random_(seed) {}
  double next() {
    if (left_ == 0) {
      left_ = 20 + random_() % 2000;
      const double share = static_cast<double>(random_() % 2001) / 1000 - 1;
      wanted_ = static_cast<double>(random_() % 1000) < 1000 * axis_.still ? 0 : axis_.velocity * (random_() % 4 == 0 ? share * 0.01 : share);
    }
    --left_;
    const double change = axis_.acceleration * axis_.sync_s;
    speed += std::clamp(wanted_ - speed, -change, change);
    return place_ += speed * axis_.sync_s;
  }
  double speed = 0;

 private:
  const Axis axis_;
  std::mt19937 random_;
  double place_ = 0, wanted_ = 0;
  unsigned left_ = 0;
};

// The loop of cyclic_axis.cpp with the axis in it, for `syncs`. `feed`: constant speed of the set-points in place of random ones.
Seen run(const Axis& axis, double limit, unsigned seed, unsigned syncs, Encoder encoder = Encoder::kCounts, double feed = 0, double counted = 0) {
  SetPoints points(axis, seed);
  WayWatch watch(axis.gain, axis.sync_s, limit * kPerMm, axis.delay);
  watch.rest(0);
  const auto delay = static_cast<std::size_t>(std::lround(axis.delay));
  std::deque<double> targets(delay + 2, 0), speeds(delay - 1, 0);
  double motor = 0, measured = 0, made = 0, at_fault = 0, from = 0, turned = 0;
  const unsigned fault = encoder == Encoder::kCounts || feed != 0 ? 0 : syncs / 2;
  Seen seen;
  for (unsigned n = 0; n < syncs; ++n) {
    const double position = std::round(measured * kPerMm) / kPerMm;
    targets.push_front(feed != 0 ? feed * axis.sync_s * (n + 1) : points.next());
    targets.pop_back();
    const double distance = targets[delay] - position;
    seen.most_distance = std::max(seen.most_distance, std::abs(distance));
    if (watch.step(std::llround(position * kPerMm)) || (limit < 1e8 && std::abs(distance) > limit * 1.0000001)) {
      seen.lost = true;
      seen.motor = turned;
      return seen;
    }
    const double speed = (targets[0] - targets[1]) / axis.sync_s + axis.gain * distance;
    watch.give(std::round(speed * kPerMm) * axis.sync_s);
    speeds.push_front(speed);
    const double taken = speeds.back();
    speeds.pop_back();
    const double wanted = axis.scale * (taken > axis.dead ? taken - axis.dead : taken < -axis.dead ? taken + axis.dead : 0);
    made += (wanted - made) * (axis.lag_s <= 0 ? 1 : 1 - std::exp(-axis.sync_s / axis.lag_s));
    const double way = made * axis.sync_s;
    motor += way;
    if (n == fault) at_fault = motor - way;
    if (n == fault) from = targets[delay];
    if (n >= fault) turned = std::max(turned, std::abs(motor - at_fault - (targets[delay] - from)));
    const bool bad = encoder != Encoder::kCounts && n >= fault;
    measured += !bad ? way : encoder == Encoder::kStands ? 0 : encoder == Encoder::kSlips ? counted * way : -way;
  }
  seen.motor = turned;
  return seen;
}

Axis random_axis(std::mt19937* random) {
  const auto between = [&](double least, double most) { return least + (most - least) * static_cast<double>((*random)() % 100001) / 100000; };
  Axis axis;
  axis.sync_s = std::vector<double>{0.001, 0.002, 0.004, 0.01}[(*random)() % 4];
  axis.delay = 1 + static_cast<double>((*random)() % 8);
  axis.gain = std::exp(between(std::log(1.0), std::log(0.1 / axis.sync_s)));
  axis.gain = std::min(axis.gain, 0.3 / (axis.delay * axis.sync_s));
  axis.scale = between(0.6, 1.6);
  axis.lag_s = between(0, 0.25 / axis.gain);
  axis.velocity = std::exp(between(std::log(0.5), std::log(500.0)));
  axis.acceleration = axis.velocity * between(1, 60);
  axis.still = between(0, 0.8);
  return axis;
}

TEST(WayWatch, LosesNoSoundAxisWhoseLimitIsTight) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(60, 10);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    const Axis axis = random_axis(&random);
    const Seen free = run(axis, 1e9, static_cast<unsigned>(seed), 20000);
    const Seen tight = run(axis, 1.1 * free.most_distance + 2 / kPerMm, static_cast<unsigned>(seed), 20000);
    EXPECT_FALSE(tight.lost) << "gain " << axis.gain << " lag " << axis.lag_s << " scale " << axis.scale << " limit " << free.most_distance;
  }
}

// With friction the axis stands beside its set-points, as far as its drive makes nothing of the speed. That may be an eighth of the limit, in any motion, also with a drive that makes little of the rest.
TEST(WayWatch, LosesNoAxisThatStandsBesideItsSetPointByFriction) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(60, 10);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    Axis axis = random_axis(&random);
    axis.dead = axis.velocity * static_cast<double>(random() % 1000) / 2000;
    const Seen free = run(axis, 1e9, static_cast<unsigned>(seed), 20000);
    EXPECT_FALSE(run(axis, std::max(free.most_distance, 8 * axis.dead / axis.gain), static_cast<unsigned>(seed), 20000).lost) << "gain " << axis.gain << " dead " << axis.dead << " lag " << axis.lag_s << " scale " << axis.scale;
  }
}

// At rest for ten minutes, as far beside its set-point as is allowed by what way_watch.hpp says.
TEST(WayWatch, LosesNoAxisThatRests) {
  Axis axis;
  WayWatch watch(axis.gain, axis.sync_s, 2 * kPerMm, axis.delay);
  watch.rest(0);
  for (unsigned n = 0; n < 600'000; ++n) {
    ASSERT_FALSE(watch.step(0)) << n;
    watch.give(axis.gain * (2.0 * 3 / 16) * kPerMm * axis.sync_s);
  }
}

// What the head of way_watch.hpp says of it, for feeds from creeping to fast ones.
TEST(WayWatch, AnEncoderThatStandsIsFoundBeforeTheMotorHasGoneFar) {
  for (const double gain : {5.0, 30.0, 100.0})
    for (const double limit : {0.2, 2.0})
      for (const double feed : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0}) {
        SCOPED_TRACE("gain " + std::to_string(gain) + " limit " + std::to_string(limit) + " feed " + std::to_string(feed));
        Axis axis;
        axis.gain = gain;
        const Seen seen = run(axis, limit, 1, 400000, Encoder::kStands, feed);
        ASSERT_TRUE(seen.lost);
        EXPECT_LE(seen.motor, 4.5 * limit + gain * limit * limit / (22 * feed) + (axis.delay + 1) * axis.sync_s * (feed + gain * limit));
      }
}

// It stands, or counts backwards, amid random motion. One that counts backwards is hidden by the way of before for a part of the memory, where the set-points turn just then.
TEST(WayWatch, FindsAnEncoderThatDoesNotCount) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(60, 10);
  unsigned lost = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    Axis axis = random_axis(&random);
    axis.scale = 1;
    axis.still = 0;
    const double limit = 2 * run(axis, 1e9, static_cast<unsigned>(seed), 20000).most_distance + 4 / kPerMm;
    const Encoder encoder = seed % 2 == 0 ? Encoder::kStands : Encoder::kBackwards;
    const Seen seen = run(axis, limit, static_cast<unsigned>(seed), 40000, encoder);
    lost += seen.lost;
    const double hidden = encoder == Encoder::kBackwards ? 5 * axis.velocity / axis.gain : 0;
    EXPECT_LE(seen.motor, 12 * limit + axis.velocity * (axis.delay + 2) * axis.sync_s + hidden) << "gain " << axis.gain << " limit " << limit << " velocity " << axis.velocity;
  }
  EXPECT_GE(lost, seeds * 9 / 10) << "else it shows little";
}

// One that counts a part of the turns is as a drive that makes less of its speed: below a quarter it is found, at a feed of which it takes more than kWay limits in the memory.
TEST(WayWatch, FindsAnEncoderThatCountsLessThanAQuarter) {
  for (const double gain : {5.0, 30.0, 100.0})
    for (const double counted : {0.05, 0.1, 0.2}) {
      SCOPED_TRACE("gain " + std::to_string(gain) + " counted " + std::to_string(counted));
      Axis axis;
      axis.gain = gain;
      const double limit = 2;
      EXPECT_TRUE(run(axis, limit, 1, 400000, Encoder::kSlips, 0.4 * limit * counted * gain, counted).lost);
      EXPECT_FALSE(run(axis, limit, 1, 400000, Encoder::kSlips, 0.2 * limit * counted * gain, counted).lost);
      EXPECT_FALSE(run(axis, limit, 1, 400000, Encoder::kSlips, 0.2 * limit * gain, 0.5).lost) << "half";
    }
}

}  // namespace
