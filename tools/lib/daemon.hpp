// SPDX-License-Identifier: Apache-2.0
// The commands of ncrtd: check a configuration; or start its machine, run a program, MDI blocks or a service, and stop the machine again.
#pragma once

#include "tools/lib/daemon_options.hpp"

namespace nc::tools {

/** Reads the configuration and does what the options say. Errors are printed on standard error. @return the exit status of ncrtd. */
int daemon_command(const DaemonOptions& options);

}  // namespace nc::tools
