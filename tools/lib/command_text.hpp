// SPDX-License-Identifier: Apache-2.0
// Texts that several subcommands of ncsim print: errors, alarms, numbers in summaries.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/session.hpp"

namespace nc::tools {

/** Prints "ncsim: WHAT" on `err`. @return the exit code of an error. */
int complain(std::FILE* err, const std::string& what);

/** A number with a fixed number of decimals, such as "12.3456": for summaries, where columns matter more than exactness. */
std::string decimals(double value, int count);

/** An alarm as FILE:LINE: CODE MESSAGE - DETAIL on one line, followed by a line for each block that called the program of the alarm,
 * outermost first. */
std::string alarm_line(const Session& session, const nc_alarm& alarm);

/** Prints on `err` a note for each sentence about something in the setup that the run did not use. */
void note_unused(const std::vector<std::string>& sentences, std::FILE* err);

/** @return `code` when everything printed has been written; otherwise the exit code of an error, which is reported on `err`. */
int close_output(std::FILE* out, std::FILE* err, int code);

}  // namespace nc::tools
