// SPDX-License-Identifier: Apache-2.0
// What the subcommands of ncsim print alike: errors, alarms, numbers of summaries.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/session.hpp"

namespace nc::tools {

/** "ncsim: WHAT" on `err`. @return the exit code of an error. */
int complain(std::FILE* err, const std::string& what);

/** "12.3456" with a fixed number of decimals: for summaries, where columns matter more than exactness. */
std::string decimals(double value, int count);

/** FILE:LINE: CODE MESSAGE - DETAIL, on one line of a terminal; under it a line for each block that called the program of the alarm,
 * outermost first. */
std::string alarm_line(const Session& session, const nc_alarm& alarm);

/** A note on `err` for each sentence about what the setup gives and the run had no use for. */
void note_unused(const std::vector<std::string>& sentences, std::FILE* err);

/** `code` when everything printed has gone out, else the exit code of an error, said on `err`. */
int close_output(std::FILE* out, std::FILE* err, int code);

}  // namespace nc::tools
