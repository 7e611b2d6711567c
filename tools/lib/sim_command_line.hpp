// SPDX-License-Identifier: Apache-2.0
// The command line of ncsim: the subcommand and all its options.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "tools/lib/commands.hpp"

namespace nc::tools {

struct SimCommand {
  enum class What : std::uint8_t { kTrace, kCheck, kTime, kMotion, kPlot, kProfile, kDialects, kFunctions, kAlarms, kVariables, kVariableUse, kParameters };
  What what = What::kTrace;
  SessionOptions session;
  RunLimits limits;
  MachineOptions machine;                   ///< for kTime, kMotion, kProfile
  MotionFormat format = MotionFormat::kCsv; ///< for kMotion
  std::string output;                       ///< for kMotion a file, "" = standard output; for kPlot, kProfile the name without its ending
  PlotOptions plot;
  bool markdown = false;                    ///< a table is printed as Markdown
};

/**
 * Reads a command line.
 * @return the exit status when there is nothing more to do: after --help and --version, which print on standard output, and after a mistake, which
 * is reported on standard error. Nothing otherwise; then *command says what to do.
 */
std::optional<int> parse_sim_command(int argc, const char* const* argv, SimCommand* command);

/** Runs the subcommand. @return its exit status. */
int run_sim_command(const SimCommand& command, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
