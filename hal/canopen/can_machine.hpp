// SPDX-License-Identifier: Apache-2.0
// A machine whose axes are drives on a CANopen bus: the interface to the scan, and two threads.
//
//   scan             read(), write(): exchange images, no system call
//   bus's thread     Cyclic::cycle() once per servo cycle, half a period after the scan, under SCHED_FIFO if that is allowed
//   service thread   Service::step() every two milliseconds
//
// The caller can drive both parts itself instead (stepping). So a test has a single thread and its own time.
#pragma once

#include <pthread.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>

#include "hal/canopen/bus_map.hpp"
#include "hal/canopen/can_port.hpp"
#include "hal/canopen/cyclic.hpp"
#include "hal/canopen/let_go.hpp"
#include "hal/canopen/service.hpp"
#include "hal/hal.hpp"

namespace nc::hal::canopen {

class CanMachine final : public Hal {
 public:
  CanMachine(const BusMap& bus, std::unique_ptr<CanPort> port, Report report = {});
  ~CanMachine() override;

  // Opens the port and waits until all drives are operational. False when they are not in time, as for any machine that cannot be reached. An I/O module that
  // does not answer is waited for shortly, and its points are not good until it does; one that cannot be set up is an error, too.
  bool start(const PointImage& initial, std::string* error) override;
  void read(Feedback* feedback, PointImage* image) noexcept override;
  void write(const Command& command, const PointImage& image) noexcept override;
  // Stops the drives by quick stop, takes their torque away, and switches the nodes to pre-operational.
  void stop() noexcept override;

  // ---- without threads ----
  bool start_stepping(std::string* error);
  void step_bus(std::int64_t now_ns);  // one servo cycle of the bus and one step of the service

  // ---- any thread ----
  // The inputs and outputs of the n-th I/O module, for its bus of points.
  ModuleIo* module(unsigned index) const { return cyclic_.module(index); }
  Service& service() { return service_; }
  const Cyclic& cyclic() const { return cyclic_; }

 private:
  bool make_threads(std::string* error);
  void bus_thread();
  void service_thread();
  void end_threads();
  void stop_nodes();
  void end_modules();
  void read_spindle(unsigned index, const AxisMap& map, const BusShown& shown, Feedback* feedback, PointImage* image) noexcept;
  std::int64_t spindle_target(unsigned index, const AxisMap& map, const SystemCommand& system, const PointImage& image) noexcept;
  SpindleAsked asked_of(unsigned index, const AxisMap& map, const SystemCommand& system, const PointImage& image) noexcept;
  void say_what_waits();
  bool asks_for_homing(unsigned index, const AxisMap& map, const PointImage& image) noexcept;

  const BusMap bus_;
  const Report report_;
  std::unique_ptr<CanPort> port_;
  Cyclic cyclic_;
  Service service_;

  // ---- scan ----
  std::uint64_t serial_ = 0, reset_serial_ = 0;  // serial number of the last command, and of the one with which the last reset began
  bool resetting_ = false;
  struct HomingRequest {
    bool on = false, waits = false, begun = false;
  };
  std::array<HomingRequest, kMaxAxes> homing_{};
  std::array<unsigned, kMaxAxes> places_lost_{};  // AxisShown::places_lost of the last scan
  bool strobe_[NC_MAX_SYSTEMS] = {};
  static constexpr unsigned kSpeedScans = 8;  // over which the speed of a spindle is measured
  struct Spindle {
    SpindleLoop loop;
    LetGoFirst forward, backward, orient;
    bool speed_given = false;  // an S command was there in the last scan
    std::int64_t position = 0;
    double turns = 0;
    std::array<double, kSpeedScans> before{};  // turns in the last scans
    unsigned scan = 0, gear = 0;
    bool known = false;
  };
  std::array<Spindle, kMaxAxes> spindle_{};
  std::array<std::atomic<bool>, kMaxAxes> waits_{};  // its drive is on, and its points must be let go first

  // ---- service thread ----
  std::array<bool, kMaxAxes> waits_said_{};

  pthread_t bus_pthread_{}, service_pthread_{};
  bool has_bus_thread_ = false, has_service_thread_ = false, open_ = false;
  std::atomic<bool> ending_{false};
};

}  // namespace nc::hal::canopen
