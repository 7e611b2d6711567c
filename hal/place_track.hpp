// SPDX-License-Identifier: Apache-2.0
// The places of the axes of a part system over the last scans. They say where the axes were at the time of an edge, on a straight line between two of them.
#pragma once

#include <array>
#include <cstdint>

#include "nc/run.h"

namespace nc::hal {

class PlaceTrack {
 public:
  static constexpr unsigned kPlaces = 256;
  enum class Found : std::uint8_t { kYes, kNotYet, kTooOld };

  void clear() noexcept { count_ = 0; }

  // A second place with the time of the newest one replaces it. A time before that begins the track anew, because its places do not belong together.
  void note(std::int64_t time_ns, const nc_axes& place) noexcept {
    if (count_ > 0 && time_ns < time_ns_[newest_]) count_ = 0;
    if (count_ == 0 || time_ns != time_ns_[newest_]) {
      newest_ = (newest_ + 1) % kPlaces;
      if (count_ < kPlaces) ++count_;
    }
    time_ns_[newest_] = time_ns;
    place_[newest_] = place;
  }

  // *place is set only with kYes. kNotYet: the axes have not been measured at that time yet.
  Found at(std::int64_t time_ns, nc_axes* place) const noexcept {
    if (count_ == 0 || time_ns > time_ns_[newest_]) return Found::kNotYet;
    for (unsigned back = 0; back < count_; ++back) {
      const unsigned older = (newest_ + kPlaces - back) % kPlaces;
      if (time_ns_[older] > time_ns) continue;
      if (back == 0) {
        *place = place_[older];
        return Found::kYes;
      }
      const unsigned newer = (older + 1) % kPlaces;
      const double part = static_cast<double>(time_ns - time_ns_[older]) / static_cast<double>(time_ns_[newer] - time_ns_[older]);
      for (unsigned a = 0; a < NC_MAX_AXES; ++a) place->v[a] = place_[older].v[a] + part * (place_[newer].v[a] - place_[older].v[a]);
      return Found::kYes;
    }
    return Found::kTooOld;
  }

 private:
  std::array<std::int64_t, kPlaces> time_ns_{};
  std::array<nc_axes, kPlaces> place_{};
  unsigned newest_ = 0, count_ = 0;
};

}  // namespace nc::hal
