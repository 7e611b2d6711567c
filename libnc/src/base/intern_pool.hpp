// SPDX-License-Identifier: Apache-2.0
// Values that change rarely and are named by many items.
#pragma once

#include <cstdint>

#include "base/arena.hpp"

namespace nc {

/// Interns values that change rarely and are named by many items. Ids count up; a value stays readable until `capacity` newer ones have been entered,
/// which is more than the number of items that can be under way. After 2^31 - 1 ids begin again at 0, so id + 1 is never 0, which stands for "none".
template <class T>
class InternPool {
 public:
  void create(unsigned capacity_power_of_two, Arena& arena) {
    ring_ = arena.make<T>(capacity_power_of_two);
    mask_ = capacity_power_of_two - 1;
  }
  /// The newest value, nullptr = none yet; and its id.
  const T* newest() const { return newest_; }
  uint32_t newest_id() const { return (next_ - 1) & kIds; }
  /// Enters `value` and returns its id. When it equals the newest value, that one is used again.
  uint32_t intern(const T& value) {
    if (newest_ != nullptr && *newest_ == value) return newest_id();
    return enter(value);
  }
  const T& operator[](uint32_t id) const { return ring_[id & mask_]; }
  bool holds(uint32_t id) const { return id <= kIds && ((next_ - 1 - id) & kIds) < filled_; }
  /// For tests: ids are counted from `first`. To be called before a value is entered.
  void count_from(uint32_t first) { next_ = first & kIds; }

 private:
  /// A new value, which comes rarely: it is kept out of the way of those who ask for one that is there.
  [[gnu::noinline]] uint32_t enter(const T& value) {
    const uint32_t id = next_;
    T& place = ring_[id & mask_];
    place = value;
    newest_ = &place;
    next_ = (id + 1) & kIds;
    if (filled_ <= mask_) ++filled_;
    return id;
  }

  T* ring_ = nullptr;
  const T* newest_ = nullptr;  ///< nullptr = none yet
  static constexpr uint32_t kIds = ~0u >> 1;
  uint32_t mask_ = 0;
  uint32_t next_ = 0;    ///< id of the next new value
  uint32_t filled_ = 0;  ///< number of values that are kept
};

}  // namespace nc
