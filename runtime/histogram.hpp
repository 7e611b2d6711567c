// SPDX-License-Identifier: Apache-2.0
// Histogram of times in a fixed array: every power of two is divided into 32 equal buckets, so that any value from 1 ns
// to 1000 s is known to about 3 %, in 9 KB. One writer (the scan); readers may look at any time.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nc::rt {

class Histogram {
 public:
  void record(std::int64_t ns) noexcept {
    const std::uint64_t value = ns > 0 ? static_cast<std::uint64_t>(ns) : 0;
    bump(buckets_[index_of(value)]);
    bump(count_);
    if (value > max_.load(std::memory_order_relaxed)) max_.store(value, std::memory_order_relaxed);
    sum_.store(sum_.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
  }

  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
  std::uint64_t max_ns() const { return max_.load(std::memory_order_relaxed); }
  double mean_ns() const {
    const std::uint64_t n = count();
    return n == 0 ? 0.0 : static_cast<double>(sum_.load(std::memory_order_relaxed)) / static_cast<double>(n);
  }

  // The smallest value that at least `fraction` of all records do not exceed, to the resolution of the buckets: the upper edge of its bucket, at
  // most the maximum.
  std::uint64_t percentile_ns(double fraction) const {
    const std::uint64_t n = count();
    if (n == 0) return 0;
    const std::uint64_t wanted =
        std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(n))));
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      seen += buckets_[i].load(std::memory_order_relaxed);
      if (seen >= wanted) return std::min(upper_edge(i), max_ns());
    }
    return max_ns();
  }

  void clear() noexcept {
    for (auto& bucket : buckets_) bucket.store(0, std::memory_order_relaxed);
    count_.store(0, std::memory_order_relaxed);
    max_.store(0, std::memory_order_relaxed);
    sum_.store(0, std::memory_order_relaxed);
  }

 private:
  static constexpr unsigned kSubBits = 5;
  static constexpr std::uint64_t kSub = 1u << kSubBits;
  static constexpr unsigned kPowers = 40 - kSubBits;
  static constexpr std::size_t kBuckets = (kPowers + 1) * kSub;

  // Values below kSub have a bucket each; for larger values the top kSubBits + 1 bits choose the bucket.
  static std::size_t index_of(std::uint64_t value) noexcept {
    if (value < kSub) return static_cast<std::size_t>(value);
    const unsigned power =
        static_cast<unsigned>(std::bit_width(value)) - 1 - kSubBits;  // 0 for kSub..2*kSub-1
    const std::size_t index = (power + 1) * kSub + static_cast<std::size_t>((value >> power) - kSub);
    return std::min(index, kBuckets - 1);
  }
  static std::uint64_t upper_edge(std::size_t index) {
    if (index < kSub) return index;
    const unsigned power = static_cast<unsigned>(index / kSub) - 1;
    return ((kSub + index % kSub + 1) << power) - 1;
  }
  static void bump(std::atomic<std::uint64_t>& value) noexcept {
    value.store(value.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0}, max_{0}, sum_{0};
};

}  // namespace nc::rt
