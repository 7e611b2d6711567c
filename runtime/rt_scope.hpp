// SPDX-License-Identifier: Apache-2.0
// A flag that says whether this thread is inside the body of a scan. A test traps allocations, locks and system calls while the flag is set, and so
// checks what NC_RT promises. Setting the flag costs two stores per scan.
#pragma once

namespace nc::rt {

// 0 = outside of a scan, 1 = inside. It is a single char because the kernel reads it, too: the test uses syscall user
// dispatch.
inline thread_local volatile unsigned char t_in_scan = 0;

class RtScope {
 public:
  RtScope() noexcept { t_in_scan = 1; }
  ~RtScope() { t_in_scan = 0; }
  RtScope(const RtScope&) = delete;
  RtScope& operator=(const RtScope&) = delete;
};

}  // namespace nc::rt
