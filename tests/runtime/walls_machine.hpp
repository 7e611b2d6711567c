// SPDX-License-Identifier: Apache-2.0
// The machine side of walls_test.cpp: runs one program through the whole runtime on the simulated machine, checks every
// scan against the limits of the axes, and records every executed item.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/config.hpp"
#include "runtime/runtime.hpp"

namespace nc::test {

// One item that the machine has executed to its end.
struct Executed {
  std::uint64_t serial = 0;
  std::uint8_t kind = 0;
  std::uint32_t line = 0;
  nc_axes machine{};
};

// The state of the machine when a sync was answered; the offline run gets the same answer.
struct SkipRecord {
  nc_axes machine{};       // where the axes came to rest
  nc_axes skip_machine{};  // measured position when the signal was seen
};

struct Recording {
  std::vector<Executed> items;
  std::map<std::uint64_t, SkipRecord> syncs;          // by serial
  std::vector<std::string> violations;                // of limits; only the first few
  double velocity_ratio = 0, acceleration_ratio = 0;  // largest value divided by its limit, of all axes
  std::uint64_t scans = 0, holds = 0, block_stops = 0, override_changes = 0, dropped = 0;
  std::uint32_t interface_output[NC_WORDS] = {};
  std::map<std::uint32_t, double> variables;  // common variables at the end
  bool ended = false, ended_ok = false;
  std::string alarm;  // code of the alarm of the program or of the runtime
  std::uint32_t alarm_line = 0;
};

// What the operator does while the program runs.
struct Operator {
  std::uint32_t seed = 1;
  bool overrides = false, holds = false, single_block = false, optional_stop = false;
  std::uint32_t optional_skip = 0;
  std::uint64_t max_scans = 3'000'000;
  bool threads = false;  // in real time, with scan and feeder in their threads
};

// The simulated machine with the limits of the axes watched in every scan.
class WatchedMachine final : public hal::Hal {
 public:
  WatchedMachine(const rt::Config& config, Recording* recording);
  bool start(const hal::PointImage& initial, std::string* error) override {
    return sim.start(initial, error);
  }
  void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override;
  void write(const hal::Command& command, const hal::PointImage& image) noexcept override;
  void stop() noexcept override { sim.stop(); }
  // The axes stand at `position`: until now the drives did not follow the command.
  void take(const nc_axes& position) noexcept;

  hal::SimMachine sim;
  rt::SeqLock<nc_axes> skip_position;  // measured position at the last rise of the skip signal

 private:
  void check(unsigned axis, double position);
  void violation(unsigned axis, const char* what, double value, double limit);

  const rt::Config& config_;
  Recording* recording_;
  nc_axes before_{};
  double velocity_before_[NC_MAX_AXES] = {};
  std::uint32_t skip_before_ = 0;
  nc_source source_{};
};

// Runs `text` in AUTO from cycle start to its end, or to an alarm.
Recording run_online(const rt::Config& config, const std::string& text, const Operator& op);

}  // namespace nc::test
