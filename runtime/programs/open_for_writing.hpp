// SPDX-License-Identifier: Apache-2.0
// Whether somebody has a file open for writing.
#pragma once

namespace nc::rt {

// kNotTold: the file belongs to another user and this process has no CAP_LEASE, or the file system knows no leases (some network ones).
enum class OpenForWriting : unsigned char { kNo, kYes, kNotTold };

// A descriptor that is open for writing too is one's own: a file without a name, and kNo.
OpenForWriting open_for_writing(int descriptor);

}  // namespace nc::rt
