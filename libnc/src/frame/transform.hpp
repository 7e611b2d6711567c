// SPDX-License-Identifier: Apache-2.0
// The map behind tool radius compensation: from the compensation frame to machine coordinates. Moves name it by id, so that a move
// that was read long ago keeps the offsets that were in force then.
#pragma once

#include <cstring>

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

/// machine = sign * point + offset, per axis. sign is -1 on a mirrored axis. (Mirror acts behind compensation: M700 13.6.)
struct Transform {
  AxisVec offset;
  AxisVec sign{{1, 1, 1, 1, 1, 1, 1, 1}};

  AxisVec to_machine(const AxisVec& p) const {
    AxisVec m;
    for (unsigned i = 0; i < kMaxAxes; ++i) m[i] = sign[i] * p[i] + offset[i];
    return m;
  }
  AxisVec from_machine(const AxisVec& m) const {
    AxisVec p;
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = sign[i] * (m[i] - offset[i]);
    return p;
  }
  bool operator==(const Transform& other) const { return std::memcmp(this, &other, sizeof(*this)) == 0; }
};

/// Interns values that change rarely and are named by many items. Ids count up; a value stays readable until `capacity` newer ones
/// have been entered, which is more than items can be under way. By 2^31 they begin again at 0: so id + 1 is never 0, which stands for "none".
template <class T>
class InternPool {
 public:
  void create(unsigned capacity_power_of_two, Arena& arena) {
    ring_ = arena.make<T>(capacity_power_of_two);
    mask_ = capacity_power_of_two - 1;
  }
  /// Id of `value`: the newest entry again when it is equal.
  uint32_t intern(const T& value) {
    const uint32_t newest = (next_ - 1) & kIds;
    if (filled_ > 0 && ring_[newest & mask_] == value) return newest;
    const uint32_t id = next_;
    ring_[id & mask_] = value;
    next_ = (id + 1) & kIds;
    if (filled_ <= mask_) ++filled_;
    return id;
  }
  const T& operator[](uint32_t id) const { return ring_[id & mask_]; }
  bool holds(uint32_t id) const { return id <= kIds && ((next_ - 1 - id) & kIds) < filled_; }
  /// For tests: ids are counted from here. Before anything is entered.
  void count_from(uint32_t first) { next_ = first & kIds; }

 private:
  T* ring_ = nullptr;
  static constexpr uint32_t kIds = ~0u >> 1;
  uint32_t mask_ = 0;
  uint32_t next_ = 0;    ///< id of the next value that is new
  uint32_t filled_ = 0;  ///< values that are there
};

}  // namespace nc
