// SPDX-License-Identifier: Apache-2.0
// The direction of a motion as the scan passes it on.
#pragma once

namespace nc::rt {

/** 1 for a way or a velocity in plus direction, -1 in minus direction, 0 for none (and for a value that is not a number). */
constexpr int direction_of(double value) { return (value > 0) - (value < 0); }

}  // namespace nc::rt
