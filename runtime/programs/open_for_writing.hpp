// SPDX-License-Identifier: Apache-2.0
// Whether somebody has a file open for writing.
#pragma once

namespace nc::rt {

// `descriptor` is open for reading only. False also where the system does not tell: files of another user, some network file systems.
bool is_open_for_writing(int descriptor);

}  // namespace nc::rt
