// SPDX-License-Identifier: Apache-2.0
// ncsim: NC programs without a machine. What can be said to it is in tools/lib/sim_command_line.cpp, what the subcommands do in
// tools/lib/commands.cpp.
#include <csignal>
#include <cstdio>
#include <exception>

#include "tools/lib/sim_command_line.hpp"

int main(int argc, char** argv) {
  // A reader that goes away is a write error with a message, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    nc::tools::SimCommand command;
    if (const auto status = nc::tools::parse_sim_command(argc, argv, &command)) return *status;
    return nc::tools::run_sim_command(command, stdout, stderr);
  } catch (const std::exception& error) {  // out of memory, above all
    std::fprintf(stderr, "ncsim: %s\n", error.what());
    return nc::tools::kExitError;
  }
}
