// SPDX-License-Identifier: Apache-2.0
// Skip signals of point buses that know the time of an edge. The skip position is where the axes were at that time: measured, or commanded where nothing
// measures. docs/gpio.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/hal.hpp"
#include "hal/place_track.hpp"
#include "hal/point_bus.hpp"

namespace nc::hal {

class EdgeLatch {
 public:
  // Room for `probes` signals. Not NC_RT.
  explicit EdgeLatch(std::size_t probes) : waiting_(probes) {}

  // ---- NC_RT ----
  // Begins a scan at `now_ns` of CLOCK_MONOTONIC, with what the machine has measured.
  void begin(std::int64_t now_ns, const Feedback& feedback) noexcept;
  // Adds the signal of probe `index`. A signal comes only when the place at its edge is known, or will not be known.
  void add(std::size_t index, const ProbeSeen& seen, Feedback* feedback) noexcept;
  // What the axes are commanded to be at when the next scan begins.
  void commanded(const Command& command) noexcept;

 private:
  // An edge whose signal has not been given yet.
  struct Waiting {
    bool on = false;
    std::int64_t edge_ns = 0;
    unsigned scans = 0;
  };
  struct System {
    PlaceTrack track;
    nc_axes commanded{};
    bool known = false;         // `commanded` has been given
    std::int64_t latched_ns = 0;  // time of the edge whose place the feedback of this scan has; 0 = none
  };

  void latch(unsigned system, std::uint32_t signal, std::int64_t edge_ns, const nc_axes& place, SystemFeedback* out) noexcept;

  std::array<System, NC_MAX_SYSTEMS> system_{};
  std::vector<Waiting> waiting_;
};

}  // namespace nc::hal
