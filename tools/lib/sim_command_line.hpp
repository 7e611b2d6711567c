// SPDX-License-Identifier: Apache-2.0
// The command line of ncsim: which subcommand, and everything that was said to it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "tools/lib/commands.hpp"

namespace nc::tools {

struct SimCommand {
  enum class What : std::uint8_t { kTrace, kCheck, kTime, kMotion, kPlot, kProfile, kFunctions, kAlarms, kVariables, kVariableUse, kParameters };
  What what = What::kTrace;
  SessionOptions session;
  RunLimits limits;
  MachineOptions machine;                   ///< kTime, kMotion, kProfile
  MotionFormat format = MotionFormat::kCsv; ///< kMotion
  std::string output;                       ///< kMotion: "" = standard output; kPlot, kProfile: name without ending
  PlotOptions plot;
  bool markdown = false;                    ///< of a table
};

/**
 * Reads the words of a command line.
 * @return the exit status when there is nothing more to do: after --help and --version, which go to standard output, and after a mistake, which
 * goes to standard error. Nothing else: *command says what to do.
 */
std::optional<int> parse_sim_command(int argc, const char* const* argv, SimCommand* command);

/** Calls the subcommand. @return its exit status. */
int run_sim_command(const SimCommand& command, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
