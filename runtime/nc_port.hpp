// SPDX-License-Identifier: Apache-2.0
// The NC as the scan and the feeder see it. One implementation is libnc; tests put a recorder in its place to
// prove the order of a scan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "nc/nc.h"

namespace nc::rt {

// Copies of NcPort::variables() and NcPort::tables().
struct KeptValues {
  std::string variables, tables;
};

class NcPort {
 public:
  virtual ~NcPort() = default;
  virtual void cycle(const nc_inputs* in, nc_outputs* out) noexcept = 0;  // scan thread, NC_RT
  // Feeder thread.
  virtual nc_status feed(std::uint32_t budget) = 0;
  virtual nc_status poll_event(unsigned system, nc_event* event, std::uint64_t* dropped) = 0;
  virtual nc_status select(unsigned system, unsigned file) = 0;
  virtual nc_status load_mdi(unsigned system, const char* text, std::size_t length) = 0;
  virtual nc_status reset(unsigned system) = 0;
  virtual void switches(unsigned system, std::uint32_t optional_skip) = 0;
  virtual nc_status alarm(unsigned system, nc_alarm* alarm) = 0;
  // The blocks that led to it (nc_alarm_calls_get).
  virtual unsigned alarm_calls(unsigned /*system*/, nc_source* /*calls*/, unsigned /*capacity*/) { return 0; }
  virtual nc_status modal(unsigned system, std::uint32_t id, nc_modal* modal) = 0;
  virtual nc_status text(unsigned system, std::uint32_t id, nc_text* text) = 0;
  // Drops what was read ahead of the block in execution, so that it is read again. NC_WAITING: call again.
  virtual nc_status recalculate(unsigned system) {
    (void)system;
    return NC_OK;
  }
  // Gives the values that the bits in `mask` of a word #1132 to #1135 have until a block writes them. To be called before select() and load_mdi().
  virtual void outputs(unsigned system, unsigned word, std::uint32_t mask, std::uint32_t bits) { (void)system, (void)word, (void)mask, (void)bits; }
  // Changes positions to what the counters show: the position of a rotary axis that is shown within one turn is reduced to that turn.
  virtual void shown(unsigned system, nc_axes* machine, nc_axes* work) {
    (void)system, (void)machine, (void)work;
  }
  // The data that are kept while the power is off, as the executed blocks have left them: the common variables
  // (runtime/retain/variables.hpp); offsets and parameters (runtime/retain/tables.hpp).
  virtual std::string variables() { return {}; }
  virtual std::string tables() { return {}; }
  // Values that have changed from `before` to `after` become those of `before` again where they are still those of `after`. Only while no program is in execution.
  virtual void put_back(const KeptValues& before, const KeptValues& after) { (void)before, (void)after; }
  // Letters of the axes, and the name of a program in the store; "" when they are not known.
  virtual std::string axis_letters(unsigned /*system*/) { return {}; }
  virtual std::string program_name(unsigned /*file*/) { return {}; }
  virtual nc_dialect dialect() const { return {}; }
  // The program in the store that has this name; -1 = there is none. Below, the bytes of a program.
  virtual int program_of(const std::string& /*name*/) { return -1; }
  virtual std::uint64_t program_size(unsigned /*file*/) { return 0; }
  // nc/restart.h; the coordinates are those of the executed blocks, or, with `begun`, those with which the program in execution, or the last one, was begun.
  virtual nc_restart_coordinates coordinates(unsigned /*system*/, bool /*begun*/) { return {}; }
  virtual nc_status set_coordinates(unsigned /*system*/, const nc_restart_coordinates& /*coordinates*/) { return NC_OK; }
  virtual nc_status restart_begin(unsigned /*system*/, const nc_restart_place& /*place*/, const nc_world& /*world*/) { return NC_E_NOT_FOUND; }
  virtual nc_status restart_find(unsigned /*system*/, std::uint32_t /*budget*/, nc_restart_found* /*found*/) { return NC_E_STATE; }
  virtual nc_status restart_cancel(unsigned /*system*/) { return NC_OK; }
  // Calls `job` with the control, to read its tables or to write into them. False when there is no control behind this port.
  virtual bool with_control(const std::function<void(nc_control*)>& job) {
    (void)job;
    return false;
  }
};

// The port implemented by libnc; `system` counts from 0.
class LibNc final : public NcPort {
 public:
  LibNc(nc_control* control, const nc_config& config) : control_(control), config_(config) {}
  void cycle(const nc_inputs* in, nc_outputs* out) noexcept override { nc_cycle(control_, in, out); }
  nc_status feed(std::uint32_t budget) override { return nc_feed(control_, budget); }
  nc_status poll_event(unsigned system, nc_event* event, std::uint64_t* dropped) override;
  nc_status select(unsigned system, unsigned file) override;
  nc_status load_mdi(unsigned system, const char* text, std::size_t length) override;
  nc_status reset(unsigned system) override;
  void switches(unsigned system, std::uint32_t optional_skip) override;
  nc_status alarm(unsigned system, nc_alarm* alarm) override;
  unsigned alarm_calls(unsigned system, nc_source* calls, unsigned capacity) override;
  nc_status modal(unsigned system, std::uint32_t id, nc_modal* modal) override;
  nc_status text(unsigned system, std::uint32_t id, nc_text* text) override;
  nc_status recalculate(unsigned system) override;
  void outputs(unsigned system, unsigned word, std::uint32_t mask, std::uint32_t bits) override;
  void shown(unsigned system, nc_axes* machine, nc_axes* work) override;
  std::string variables() override;
  std::string tables() override;
  void put_back(const KeptValues& before, const KeptValues& after) override;
  std::string axis_letters(unsigned system) override;
  std::string program_name(unsigned file) override;
  nc_dialect dialect() const override { return static_cast<nc_dialect>(config_.dialect); }
  int program_of(const std::string& name) override;
  std::uint64_t program_size(unsigned file) override;
  nc_restart_coordinates coordinates(unsigned system, bool begun) override;
  nc_status set_coordinates(unsigned system, const nc_restart_coordinates& coordinates) override;
  nc_status restart_begin(unsigned system, const nc_restart_place& place, const nc_world& world) override;
  nc_status restart_find(unsigned system, std::uint32_t budget, nc_restart_found* found) override;
  nc_status restart_cancel(unsigned system) override;
  bool with_control(const std::function<void(nc_control*)>& job) override {
    job(control_);
    return true;
  }

 private:
  nc_control* control_;
  const nc_config& config_;
};

}  // namespace nc::rt
