// SPDX-License-Identifier: Apache-2.0
// What the command line of ncrtd says, and what it ends with.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/clock.hpp"
#include "runtime/config.hpp"

namespace nc::tools {

/** Exit statuses of ncrtd; one that a signal has ended has 128 + its number (runtime/end_signal.hpp). */
inline constexpr int kDaemonUsage = 1, kDaemonAlarm = 2, kDaemonInUse = 3;

struct DaemonOptions {
  enum class Command : std::uint8_t { kCheck, kRun, kMdi, kServe };
  Command command = Command::kCheck;
  std::string config;                                              ///< file of the machine
  std::string program;                                             ///< of kRun
  std::string mdi;                                                 ///< blocks of kMdi
  std::string dialect;                                             ///< instead of the configured one; "" = that one
  std::string plot;                                                ///< BASE of the drawing; "" = none
  std::string view = "iso", coordinates = "work", color = "kind";  ///< of the drawing (plot_options.hpp)
  std::string share;                                               ///< name of the shared memory; "" = as configured
  bool fast = false;                                               ///< virtual time
  bool no_progress = false, quiet = false;
  bool commands = false;                              ///< taken from the shared memory; also by the configuration
  std::int64_t since_ns = rt::RealClock().now_ns();   ///< start of the process, for the start-up time
};

/** What the options ask for that does not go together, with each other or with the configuration: a sentence; "" = nothing. */
std::string conflict_of(const DaemonOptions& options, const rt::Config& config);

/**
 * Another dialect than the configured one. Parameters are numbers of one manual: with another dialect they would mean something else, or nothing,
 * and are left out.
 * @return true when there were some.
 */
bool change_dialect(const std::string& name, rt::Config* config);

}  // namespace nc::tools
