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
/// have been entered, which is more than items can be under way.
template <class T>
class InternPool {
 public:
  void create(unsigned capacity_power_of_two, Arena& arena) {
    ring_ = arena.make<T>(capacity_power_of_two);
    mask_ = capacity_power_of_two - 1;
  }
  /// Id of `value`: the newest entry again when it is equal.
  uint32_t intern(const T& value) {
    if (count_ > 0 && ring_[(count_ - 1) & mask_] == value) return count_ - 1;
    ring_[count_ & mask_] = value;
    return count_++;
  }
  const T& operator[](uint32_t id) const { return ring_[id & mask_]; }
  bool holds(uint32_t id) const { return id < count_ && count_ - id <= mask_ + 1; }

 private:
  T* ring_ = nullptr;
  uint32_t mask_ = 0;
  uint32_t count_ = 0;
};

}  // namespace nc
