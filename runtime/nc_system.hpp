// SPDX-License-Identifier: Apache-2.0
// Converts the runtime's index of a part system, which counts from 0, to that of the C API.
#pragma once

namespace nc::rt {

// Calls of the API count part systems from 0, as the arrays of nc_cycle() do; only nc_source::system counts
// from 1.
constexpr unsigned api_system(unsigned index) {
  return index;
}

}  // namespace nc::rt
