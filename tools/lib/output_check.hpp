// SPDX-License-Identifier: Apache-2.0
// Output that can fail: asked before a long run, and looked at behind it.
#pragma once

#include <string>

namespace nc::tools {

/** Can `path` be written? Leaves nothing behind and changes nothing. On failure *error names the path. */
bool can_be_written(const std::string& path, std::string* error);

/** Everything printed so far has gone out through standard output. */
bool standard_output_written();

/** The exit status of a program when everything printed has gone out; a full disk or a closed pipe is no success: 1, and a sentence. */
int status_when_written(const char* program, int status);

}  // namespace nc::tools
