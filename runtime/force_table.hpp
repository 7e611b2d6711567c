// SPDX-License-Identifier: Apache-2.0
// Forced devices of the ladder. A forced device is held at a value, whatever the machine and the program write, until it is
// released or the control ends.
//
// The device has the value before the program runs and after each of its instructions, and the machine and the NC get the
// value as well.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "hal/points.hpp"
#include "ladder/ladder.hpp"
#include "runtime/command.hpp"
#include "runtime/snapshot.hpp"

namespace nc::rt {

class ForceTable {
 public:
  ForceTable();

  // ---- any thread but the scan's ----
  // The number of a device; a device gets its number when it is first asked for. `point`: index of the device's point in the image, -1 when the
  // device is no point; `output`: the point is an output. Returns -1 when there are too many devices.
  std::int64_t number_of(const std::string& name, const ladder::Device& device, int point, bool output);
  std::string name_of(std::uint32_t number) const;
  // True when a device of this type can have the value; words accept it with or without sign.
  static bool fits(ladder::DeviceType type, std::int64_t value);

  // ---- scan. NC_RT ----
  Answer force(std::uint32_t number, std::int32_t value) noexcept;
  Answer release(std::uint32_t number) noexcept;
  // The device gets the value at the beginning of the next scan, once. kForced while it is held.
  Answer write(std::uint32_t number, std::int32_t value) noexcept;
  void forget() noexcept { count_ = freed_ = 0; }
  bool any() const noexcept { return count_ + freed_ != 0; }
  // To be called at the beginning of a scan. A released device gets back the value that it had before: without that, a relay or a signal to the
  // NC that no coil writes would keep the forced value.
  void begin(ladder::DeviceImage* image, hal::PointImage* points) noexcept;
  // Holds the input points, before they are read into the devices.
  void hold_inputs(hal::PointImage* points) const noexcept { hold_points(points, false); }
  void hold_outputs(hal::PointImage* points) const noexcept { hold_points(points, true); }
  void hold_devices(ladder::DeviceImage* image) const noexcept;
  // The forced devices in the form that the engine needs to hold them while the program runs; valid until the next command.
  const ladder::Hold* holds(unsigned* count) noexcept;
  void list(ForceList* list) const noexcept;

 private:
  static constexpr std::size_t kMaxNames = 4096;
  struct Place {
    ladder::DeviceType type = ladder::DeviceType::kBit;
    bool output = false;
    std::uint32_t index = 0;
    int point = -1;
    std::string name;
  };
  struct Active {
    std::uint32_t number = 0;
    std::int32_t value = 0;
    std::int32_t before = 0;
    bool begun = false;  // `before` holds the value that the device had
  };
  void hold_points(hal::PointImage* points, bool outputs) const noexcept;
  void free(unsigned place) noexcept;

  // Never reallocated: the scan reads entries without a lock, by the numbers that reach it through the queue of commands.
  const std::unique_ptr<Place[]> places_;
  std::size_t names_ = 0;
  mutable std::mutex mutex_;  // guards names_ and the names; never taken by the scan
  std::array<Active, kMaxForces> active_, released_;
  unsigned count_ = 0, freed_ = 0;  // entries in use of active_ and released_
  std::array<ladder::Hold, kMaxForces> holds_;
};

}  // namespace nc::rt
