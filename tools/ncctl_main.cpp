// SPDX-License-Identifier: Apache-2.0
// ncctl: shows and operates a control, through its socket on this computer, or over DDS (docs/services.md). Its commands come from the table of services.
//
//   ncctl status | watch | start | hold | reset | mode MODE | mdi BLOCKS | jog AXIS VELOCITY --for SECONDS | programs list | ...
//
// Exit status: 0 done, 1 wrong usage, 2 refused by the control, 3 this user has not the right, 4 another client has control, 5 not reached in time or failed,
// 6 no control answers.
#include <cstdio>
#include <exception>

#include "tools/lib/control_command.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/remote/remote_client.hpp"

int main(int argc, char** argv) try {
  nc::tools::keep_standard_descriptors();
  nc::tools::ControlCommand command;
  const int status = nc::tools::parse_control_command(argc, argv, &command);
  return nc::tools::status_when_written("ncctl", status >= 0 ? status : nc::tools::control_command(command, nc::tools::open_remote_client, stdin, stdout, stderr),
                                        nc::tools::kControlFailed);
} catch (const std::exception& error) {  // mainly out of memory
  return nc::tools::report_refusal({nc::tools::kControlFailed, "failed", error.what()}, nc::tools::asks_for_json(argc, argv), stdout, stderr);
}
