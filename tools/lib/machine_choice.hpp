// SPDX-License-Identifier: Apache-2.0
// The machine on which a program is timed: from a machine configuration (TOML), a limits file (JSON) or a few numbers
// of the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "nc/nc.h"
#include "runtime/config.hpp"
#include "tools/lib/virtual_machine.hpp"

namespace nc::tools {

/** Velocity, acceleration and jerk of every axis; mm or degrees, and seconds. */
struct EveryAxis {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;  // jerk 0 = no limit
};

/** Parses a text such as "250,2000,50000". @return nothing, with *why, for anything else. */
std::optional<EveryAxis> parse_every_axis(const std::string& text, std::string* why);

/** What the command line says of the machine. */
struct MachineOptions {
  std::string machine;      // TOML as the runtime reads it; "" = none
  std::string limits_file;  // JSON (machine_limits.hpp); "" = none
  std::string every_axis;   // as for parse_every_axis(); "" = the limits of the machine
  std::optional<unsigned> cycle_us;
  std::optional<nc_motion_mode> motion;  // if not given, that of the machine, and if the machine names none, rt::default_motion()
  std::optional<double> tolerance;       // path tolerance in mm; if given, the mode is the time-optimal one unless `motion` says otherwise
};

/** Reads the TOML file and keeps what concerns its first part system. @return nothing, with every mistake in
 * *error, one a line. */
std::unique_ptr<rt::Config> load_machine(const std::string& path, std::string* error);

/** Records between feeder and scan when no machine is named: a desk computer has the memory for lines of 1 um at full speed. */
inline constexpr std::uint32_t kLookAheadDesk = 16384;
/// The longest contour that CONTOUR_CHECK takes where no machine is named, blocks.
inline constexpr std::uint32_t kContourBlocksDesk = 100000;

/** The servos of the machine's first part system, as the runtime simulates them. */
ServoModel servo_of(const rt::Config& machine, double cycle_s);

/**
 * Sets rates, limits and cycle in a configuration whose axes are known: first those of `machine`, or if that is null the defaults of
 * default_machine_limits(), then those of `options`. The law of motion is chosen last, by the resulting limits.
 */
bool set_machine_limits(const MachineOptions& options, const rt::Config* machine, nc_config* config,
                        std::string* error);

}  // namespace nc::tools
