// SPDX-License-Identifier: Apache-2.0
// Checks of output that can fail: before a long run and after it.
#pragma once

#include <string>

namespace nc::tools {

/** Whether `path` can be written. Changes nothing and leaves no file behind. On failure *error names the path. */
bool can_be_written(const std::string& path, std::string* error);

/** True when everything printed so far has been written to standard output. */
bool standard_output_written();

/**
 * `status` when everything printed has been written, or when it is a failure already, which has said what it is; else `unwritten` with a sentence: because of a full disk or a
 * closed pipe.
 */
int status_when_written(const char* program, int status, int unwritten = 1);

}  // namespace nc::tools
