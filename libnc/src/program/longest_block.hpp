// SPDX-License-Identifier: Apache-2.0
// The longest block of a text.
#pragma once

#include <cstdint>

namespace nc {

/// Bytes of a block, blanks and comments among them. What is longer is a fault, also where it would have room: the text behind a comment that is not closed may have
/// gigabytes, and the feeder has to do other things meanwhile.
constexpr uint64_t kLongestBlock = 1 << 20;

}  // namespace nc
