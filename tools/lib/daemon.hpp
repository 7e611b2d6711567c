// SPDX-License-Identifier: Apache-2.0
// The commands of ncrtd: check a configuration; bring its machine up, run a program, blocks or a service, and take it down again.
#pragma once

#include "tools/lib/daemon_options.hpp"

namespace nc::tools {

/** Reads the configuration and does what the options say. What is wrong goes to standard error. @return the exit status of ncrtd. */
int daemon_command(const DaemonOptions& options);

}  // namespace nc::tools
