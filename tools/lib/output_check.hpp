// SPDX-License-Identifier: Apache-2.0
// Output that can fail: asked before a long run, and looked at behind it.
#pragma once

#include <string>

namespace nc::tools {

/** Can `path` be written? Leaves nothing behind and changes nothing. On failure *error names the path. */
bool can_be_written(const std::string& path, std::string* error);

/** Everything printed so far has gone out through standard output. */
bool standard_output_written();

}  // namespace nc::tools
