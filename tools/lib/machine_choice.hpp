// SPDX-License-Identifier: Apache-2.0
// Which machine a program is timed on: a machine configuration (TOML), a limits file (JSON) or a few numbers
// of the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "nc/nc.h"
#include "runtime/config.hpp"
#include "tools/lib/virtual_machine.hpp"

namespace nc::tools {

/** Velocity, acceleration and jerk that hold for every axis; mm or degrees, seconds. */
struct EveryAxis {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;  // jerk 0 = no limit
};

/** "250,2000,50000". @return nothing, with *why, for anything else. */
std::optional<EveryAxis> parse_every_axis(const std::string& text, std::string* why);

/** What the command line says of the machine. */
struct MachineOptions {
  std::string machine;      // TOML as the runtime reads it; "" = none
  std::string limits_file;  // JSON (machine_limits.hpp); "" = none
  std::string every_axis;   // as parse_every_axis(); "" = as the machine has it
  std::optional<unsigned> cycle_us;
  std::optional<nc_motion_mode> motion;  // else the machine's, and where that names none rt::default_motion()
  std::optional<double> tolerance;       // mm, of the path: the time-optimal mode unless `motion` says otherwise
};

/** Reads the TOML file and keeps what concerns its first part system. @return nothing, with every mistake in
 * *error, one a line. */
std::unique_ptr<rt::Config> load_machine(const std::string& path, std::string* error);

/** Records between feeder and scan where no machine is named: a desk has the memory for lines of 1 um at full speed. */
inline constexpr std::uint32_t kLookAheadDesk = 16384;

/** The servos of its first part system, as the runtime simulates them. */
ServoModel servo_of(const rt::Config& machine, double cycle_s);

/**
 * Rates, limits and cycle of `options` into a configuration whose axes are known; those of `machine` (may be
 * null) first, or the defaults of default_machine_limits(). The law of motion is chosen last, by the limits that came out.
 */
bool set_machine_limits(const MachineOptions& options, const rt::Config* machine, nc_config* config,
                        std::string* error);

}  // namespace nc::tools
