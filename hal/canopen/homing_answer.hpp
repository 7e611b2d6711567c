// SPDX-License-Identifier: Apache-2.0
// What a drive says of the homing that it was asked for. Bits 12 (attained) and 13 (error) of its status are those of the homing before until it has begun, and how long that takes
// is the drive's own matter. So they count only behind a status in which both were 0: the last one before the start bit, or one behind it.
//
// A homing where the axis stands (methods 35 and 37) may have come to its end between two SYNCs. As 607Ch is 0, its end shows in the position, too: it is 0 then.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "hal/canopen/drive_state.hpp"

namespace nc::hal::canopen {

class HomingAnswer {
 public:
  enum class Says : std::uint8_t { kNothing, kAttained, kFailed, kNotBegun };

  // The start bit goes out behind this status.
  void start(std::uint16_t status, std::int8_t method) noexcept {
    begun_ = is_clear(status);
    stands_ = method == kStands || method == kStandsBefore;
    syncs_ = 0;
  }

  // A status of a later SYNC with its position. `still`: increments within which an axis that stands keeps its place; `most`: SYNCs in which the homing has to begin.
  Says step(std::uint16_t status, std::int64_t position, std::int64_t still, std::int64_t most) noexcept {
    begun_ |= is_clear(status);
    const bool counts = begun_ || (stands_ && std::abs(position) <= still);
    const bool attained = (status & (kStatusFollows | kStatusReached)) == (kStatusFollows | kStatusReached);
    if (begun_ && (status & kStatusError) != 0) return Says::kFailed;
    if (counts && attained && (status & kStatusError) == 0) return Says::kAttained;
    return begun_ || ++syncs_ <= most ? Says::kNothing : Says::kNotBegun;
  }

 private:
  static constexpr std::int8_t kStands = 37, kStandsBefore = 35;  // of CiA 402, and of its versions before 3

  static bool is_clear(std::uint16_t status) noexcept { return (status & (kStatusFollows | kStatusError)) == 0; }

  bool begun_ = false, stands_ = false;
  std::int64_t syncs_ = 0;
};

}  // namespace nc::hal::canopen
