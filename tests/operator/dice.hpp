// SPDX-License-Identifier: Apache-2.0
// The source of the decisions of a random session: first the bytes that a fuzzer gives, so that it can change one decision at a time, and
// then a generator that is seeded by those bytes, so that a short input is a whole session, too.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace nc::test {

class Dice {
 public:
  explicit Dice(uint64_t seed) : random_(seed) {}
  Dice(const uint8_t* bytes, size_t size) : bytes_(bytes), left_(size), random_(hash(bytes, size)) {}

  /// 0 to `sides` - 1.
  unsigned draw(unsigned sides) { return sides < 2 ? 0 : static_cast<unsigned>(next() % sides); }
  bool chance(double p) { return unit() < p; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Evenly distributed over the orders of magnitude; both ends are positive.
  double scale(double low, double high) { return low * std::pow(high / low, unit()); }
  template <typename T, size_t n>
  const T& one_of(const T (&list)[n]) {
    return list[draw(n)];
  }

 private:
  static uint64_t hash(const uint8_t* bytes, size_t size) {
    uint64_t h = 14695981039346656037u;  // FNV-1a
    for (size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 1099511628211u;
    return h;
  }
  double unit() { return static_cast<double>(next()) / 4294967296.0; }
  uint32_t next() {
    if (left_ < 2) return static_cast<uint32_t>(random_());
    const uint32_t value = static_cast<uint32_t>(bytes_[0] | bytes_[1] << 8);
    bytes_ += 2;
    left_ -= 2;
    return value << 16 | value;
  }

  const uint8_t* bytes_ = nullptr;
  size_t left_ = 0;
  std::mt19937_64 random_;
};

}  // namespace nc::test
