// SPDX-License-Identifier: Apache-2.0
// The interpreter with computed goto, an extension of GCC and Clang; other compilers use the portable one.
#include "ladder/machine.hpp"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpedantic"

namespace nc::ladder {
#define NC_LADDER_THREADED
#define NC_LADDER_EXECUTE execute_threaded
#include "ladder/execute_body.hpp"
}  // namespace nc::ladder

#else

namespace nc::ladder {
Outcome execute_threaded(const Code& code, DeviceImage* image) noexcept {
  return execute_portable(code, image);
}
}  // namespace nc::ladder

#endif
