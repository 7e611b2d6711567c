// SPDX-License-Identifier: Apache-2.0
// Numbers that units are converted by.
#pragma once

#include <numbers>

namespace nc {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kMillimetresPerInch = 25.4;
inline constexpr double kDegreesOfTurn = 360;

}  // namespace nc
