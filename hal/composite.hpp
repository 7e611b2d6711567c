// SPDX-License-Identifier: Apache-2.0
// One machine (its axes, and the points of bus 0) and any number of buses that carry points only, as one Hal.
#pragma once

#include <vector>

#include "hal/bus_thread.hpp"
#include "hal/edge_latch.hpp"
#include "hal/hal.hpp"
#include "hal/point_bus.hpp"

namespace nc::hal {

class Composite final : public Hal {
 public:
  // Points name a bus by its place in `buses`, counted from 1. All of them must outlive this object.
  // `now_ns` gives the time of CLOCK_MONOTONIC, by which buses say when an edge came.
  Composite(Hal* machine, std::vector<PointBus*> buses, const PointTable& table, std::int64_t (*now_ns)() noexcept = monotonic_ns);

  bool start(const PointImage& initial, std::string* error) override;
  void read(Feedback* feedback, PointImage* image) noexcept override;
  void write(const Command& command, const PointImage& image) noexcept override;
  // Stops the machine first, then all buses at the same time, because each of them may wait for a device.
  void stop() noexcept override;

 private:
  Hal* machine_;
  std::vector<PointBus*> buses_;
  std::vector<std::uint16_t> own_points_;  // the points of the machine itself, with bus 0
  std::int64_t (*now_ns_)() noexcept;
  bool has_probes_ = false;
  EdgeLatch latch_;
};

}  // namespace nc::hal
