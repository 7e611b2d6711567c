// SPDX-License-Identifier: Apache-2.0
// Whether somebody has a file open for writing.
#pragma once

namespace nc::rt {

// kNotTold: it cannot be found out, because the file belongs to another user and this process has no CAP_LEASE, or because the file system has no leases
// (as some network file systems).
enum class OpenForWriting : unsigned char { kNo, kYes, kNotTold };

// For a descriptor that is itself open for writing the answer is kNo: it is a temporary file without a name, made by this process.
OpenForWriting open_for_writing(int descriptor);

}  // namespace nc::rt
