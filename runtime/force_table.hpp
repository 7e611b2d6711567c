// SPDX-License-Identifier: Apache-2.0
// Forced devices of the ladder: held at a value whatever the machine and the program say, from the command until it
// is taken back or the control ends.
//
// The value stands in the device before the program, behind each of its instructions, and in what the machine and the
// NC get.
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
  // Numbers stand for names from their first use on. `point`: its place in the image, -1 = the device is none;
  // `output`: it goes to the machine. -1 = there were too many names.
  std::int64_t number_of(const std::string& name, const ladder::Device& device, int point, bool output);
  std::string name_of(std::uint32_t number) const;
  // A value that this device can have; words take it with or without sign.
  static bool fits(ladder::DeviceType type, std::int64_t value);

  // ---- scan. NC_RT ----
  Answer force(std::uint32_t number, std::int32_t value) noexcept;
  Answer release(std::uint32_t number) noexcept;
  void forget() noexcept { count_ = freed_ = 0; }
  bool any() const noexcept { return count_ + freed_ != 0; }
  // At the head of a scan. What was released has again what it had before: a relay, or a signal to the NC, that no
  // coil writes would stay as it was forced.
  void begin(ladder::DeviceImage* image, hal::PointImage* points) noexcept;
  // Inputs of the machine, before they are read into the devices.
  void hold_inputs(hal::PointImage* points) const noexcept { hold_points(points, false); }
  void hold_outputs(hal::PointImage* points) const noexcept { hold_points(points, true); }
  void hold_devices(ladder::DeviceImage* image) const noexcept;
  // The same for the engine, to hold them against the program; valid until the next command.
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
    bool begun = false;  // `before` is known
  };
  void hold_points(hal::PointImage* points, bool outputs) const noexcept;
  void free(unsigned place) noexcept;
  static std::int32_t get(const Place& place, const ladder::DeviceImage& image) noexcept;
  static void set(const Place& place, std::int32_t value, ladder::DeviceImage* image) noexcept;

  // Never moves: the scan reads places whose numbers came to it through the queue of commands.
  const std::unique_ptr<Place[]> places_;
  std::size_t names_ = 0;
  mutable std::mutex mutex_;  // names_ and the names; not the scan's
  std::array<Active, kMaxForces> active_, released_;
  unsigned count_ = 0, freed_ = 0;  // of them
  std::array<ladder::Hold, kMaxForces> holds_;
};

}  // namespace nc::rt
