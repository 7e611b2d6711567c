// SPDX-License-Identifier: Apache-2.0
// Histogram, queue, sequence lock, clocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

#include "runtime/clock.hpp"
#include "runtime/histogram.hpp"
#include "runtime/seqlock.hpp"
#include "runtime/spsc.hpp"
#include "support/seeds.hpp"

namespace {

TEST(Histogram, PercentilesAreWithinABucketOfTheTruth) {
  nc::rt::Histogram histogram;
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> distribution(9.0, 2.0);
  std::vector<std::int64_t> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(static_cast<std::int64_t>(distribution(random)));
    histogram.record(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double fraction : {0.01, 0.5, 0.9, 0.99, 0.999}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * 20000.0)) - 1;
    const auto truth = static_cast<double>(values[rank]);
    const auto found = static_cast<double>(histogram.percentile_ns(fraction));
    EXPECT_GE(found, truth) << fraction;
    EXPECT_LE(found, truth * 1.04 + 1) << fraction;
  }
  EXPECT_EQ(histogram.max_ns(), static_cast<std::uint64_t>(values.back()));
  EXPECT_EQ(histogram.count(), 20000u);
}

TEST(Histogram, EdgesAndEmpty) {
  nc::rt::Histogram histogram;
  EXPECT_EQ(histogram.percentile_ns(0.99), 0u);
  histogram.record(-5);
  EXPECT_EQ(histogram.percentile_ns(1.0), 0u);
  histogram.record(INT64_MAX);
  EXPECT_EQ(histogram.percentile_ns(1.0), static_cast<std::uint64_t>((1ull << 40) - 1)) << "last bucket";
  EXPECT_EQ(histogram.max_ns(), static_cast<std::uint64_t>(INT64_MAX));
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
}

TEST(SpscQueue, KeepsOrderAndCapacityAcrossThreads) {
  nc::rt::SpscQueue<int, 8> queue;
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_FALSE(queue.push(8));
  int value = -1;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(queue.pop(&value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(queue.pop(&value));

  const int count = nc::test::sanitized() ? 10000 : 100000;
  std::thread producer([&] {
    for (int i = 0; i < count; ++i)
      while (!queue.push(i)) std::this_thread::yield();
  });
  bool ordered = true;
  for (int i = 0; i < count; ++i) {
    while (!queue.pop(&value)) std::this_thread::yield();
    ordered &= value == i;
  }
  producer.join();
  EXPECT_TRUE(ordered);
}

struct Wide {
  std::uint64_t a[33];
  std::uint8_t tail;
};

TEST(SeqLock, ReadersNeverSeeHalfAValue) {
  nc::rt::SeqLock<Wide> lock;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    Wide value{};
    for (std::uint64_t n = 1; n <= 200000; ++n) {
      for (auto& word : value.a) word = n;
      value.tail = static_cast<std::uint8_t>(n);
      lock.store(value);
    }
    stop = true;
  });
  std::uint64_t torn = 0, last = 0, backwards = 0;
  while (!stop) {
    const Wide value = lock.load();
    for (const std::uint64_t word : value.a) torn += word != value.a[0];
    torn += value.tail != static_cast<std::uint8_t>(value.a[0]);
    backwards += value.a[0] < last;
    last = value.a[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
  EXPECT_EQ(lock.load().a[5], 200000u);
}

TEST(VirtualClock, JumpsForwardOnly) {
  nc::rt::VirtualClock clock;
  clock.sleep_until(5'000'000);
  EXPECT_EQ(clock.now_ns(), 5'000'000);
  clock.sleep_until(1);
  EXPECT_EQ(clock.now_ns(), 5'000'000);
  EXPECT_EQ(clock.local_ms(), nc::rt::VirtualClock::kEpochMs + 5);
}

TEST(RealClock, ReachesItsDeadline) {
  nc::rt::RealClock clock;
  const std::int64_t deadline = clock.now_ns() + 2'000'000;
  clock.sleep_until(deadline);
  EXPECT_GE(clock.now_ns(), deadline);
  EXPECT_GT(clock.local_ms(), 1'577'836'800'000) << "after 2020";
}

}  // namespace
