// SPDX-License-Identifier: Apache-2.0
// "This thread is inside the body of a scan": what NC_RT promises is checked against this flag by the test
// that traps allocation, locks and system calls. Setting it costs two stores per scan.
#pragma once

namespace nc::rt {

// A char of its own, because the kernel reads it too (syscall user dispatch in the test): 0 = outside, 1 =
// inside.
inline thread_local volatile unsigned char t_in_scan = 0;

class RtScope {
 public:
  RtScope() noexcept { t_in_scan = 1; }
  ~RtScope() { t_in_scan = 0; }
  RtScope(const RtScope&) = delete;
  RtScope& operator=(const RtScope&) = delete;
};

}  // namespace nc::rt
