// SPDX-License-Identifier: Apache-2.0
// The inputs and outputs of one CiA 401 module at run time: the bus's thread exchanges PDOs with the module, the scan exchanges points with the bus's thread.
//
// A module is there while its node is operational and each of its PDOs with inputs has come within `lost_after` of its periods. Else no point of it is good,
// and its inputs show what is configured for that case.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "hal/canopen/bus_map.hpp"
#include "hal/canopen/frame.hpp"
#include "hal/points.hpp"
#include "hal/triple_buffer.hpp"

namespace nc::hal::canopen {

class ModuleIo {
 public:
  // `node` has a module, and lives longer than this object.
  ModuleIo(const NodeMap& node, unsigned lost_after);

  // ---- bus's thread ----
  enum class Taken : std::uint8_t { kNotMine, kTaken, kStrange };  // kStrange: a PDO of this module that does not have the mapping written into it
  Taken take(const CanFrame& frame, bool operational) noexcept;
  // With each SYNC, behind the frames that have come. False when inputs have not come for too long.
  bool sync(bool operational) noexcept;
  // The PDOs with outputs that are to be sent with this SYNC. `send` takes each frame.
  template <class Send>
  void give(const Send& send) noexcept {
    for (unsigned n = 0; due_ && n < kModulePdos; ++n)
      if (takes_[n].bytes > 0) send(frame_of(n));
  }

  // ---- scan ----
  void read(PointImage* image) noexcept;
  void write(const PointImage& image) noexcept;

  // ---- an ordinary thread, before and behind the scans ----
  void begin(const PointImage& initial) noexcept;
  // From now on the outputs have their values for the end. ended(): the module has been sent them, or is not there.
  void end() noexcept { ending_.store(true, std::memory_order_release); }
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }

 private:
  struct Channels {
    std::uint64_t digital = 0;
    std::array<std::int16_t, kMostAnalog> analog{};
  };
  struct Shown {
    Channels in;
    bool ok = false;
  };
  struct Pdo {
    std::uint16_t id = 0;
    unsigned bytes = 0;    // 0 = there is none
    unsigned silent = 0;   // SYNCs since the last one
    bool come = false;     // since the node is operational
  };

  void set(Channels* channels, const IoPoint& point, std::uint32_t value) const noexcept;
  std::uint32_t get(const Channels& channels, const IoPoint& point) const noexcept;
  CanFrame frame_of(unsigned pdo) const noexcept;

  const ModuleMap& module_;
  const unsigned lost_after_;
  TripleBuffer<Channels> outputs_{Channels{}};
  TripleBuffer<Shown> shown_{Shown{}};
  std::atomic<bool> ending_{false}, ended_{false};

  // ---- bus's thread ----
  std::array<Pdo, kModulePdos> sends_{}, takes_{};  // as seen from the module
  Channels in_, out_, stop_;
  unsigned count_ = 0;      // SYNCs since the outputs were sent
  unsigned ended_syncs_ = 0;
  bool due_ = false, was_operational_ = false;
};

}  // namespace nc::hal::canopen
