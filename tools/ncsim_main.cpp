// SPDX-License-Identifier: Apache-2.0
// ncsim: runs NC programs without a machine. Its options are in tools/lib/sim_command_line.cpp, its subcommands in
// tools/lib/commands.cpp and machine_commands.cpp.
#include <csignal>
#include <cstdio>
#include <exception>

#include "tools/lib/sim_command_line.hpp"

int main(int argc, char** argv) {
  // When the reader of a pipe has gone, that becomes a write error with a message; otherwise SIGPIPE would end the process silently.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    nc::tools::SimCommand command;
    if (const auto status = nc::tools::parse_sim_command(argc, argv, &command)) return *status;
    return nc::tools::run_sim_command(command, stdout, stderr);
  } catch (const std::exception& error) {  // mainly out of memory
    std::fprintf(stderr, "ncsim: %s\n", error.what());
    return nc::tools::kExitError;
  }
}
