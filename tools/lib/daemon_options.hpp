// SPDX-License-Identifier: Apache-2.0
// The options of ncrtd and its exit statuses.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/clock.hpp"
#include "runtime/config.hpp"

namespace nc::tools {

/** Exit statuses of ncrtd. When a signal has ended it, the status is 128 + the number of the signal (runtime/end_signal.hpp). */
inline constexpr int kDaemonUsage = 1, kDaemonAlarm = 2, kDaemonInUse = 3;

struct DaemonOptions {
  enum class Command : std::uint8_t { kCheck, kRun, kMdi, kServe };
  Command command = Command::kCheck;
  std::string config;                                              ///< file of the machine's configuration
  std::string program;                                             ///< program, for kRun
  std::string mdi;                                                 ///< blocks, for kMdi
  std::string dialect;                                             ///< replaces the configured dialect; "" = the configured one
  std::string plot;                                                ///< name of the drawing without its ending; "" = no drawing
  std::string view = "iso", coordinates = "work", color = "kind";  ///< how the path is drawn (plot_options.hpp)
  std::string share;                                               ///< name of the shared memory; "" = the configured one
  bool fast = false;                                               ///< virtual time
  bool no_progress = false, quiet = false;
  bool summary = false;                               ///< of kServe: at its end, how long the scans took
  bool commands = false;                              ///< commands are taken from the shared memory; the configuration may say so, too
  std::int64_t since_ns = rt::RealClock().now_ns();   ///< start of the process, for the start-up time
};

/** A sentence when options contradict each other or the configuration; "" = they do not. */
std::string conflict_of(const DaemonOptions& options, const rt::Config& config);

/**
 * Sets another dialect than the configured one. The configured parameters are removed, because their numbers belong to one manual and would have
 * another meaning, or none, in another dialect.
 * @return true when there were parameters.
 */
bool change_dialect(const std::string& name, rt::Config* config);

}  // namespace nc::tools
