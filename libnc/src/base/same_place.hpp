// SPDX-License-Identifier: Apache-2.0
// How far apart two positions may lie that are meant to be the same. No constant is above the finest command unit, 1e-6 mm or degrees (M700 2.1); each
// says where the difference comes from.
#pragma once

namespace nc {

/// A move that is no longer than this, in mm or degrees, counts as no move: it is far below every command unit.
inline constexpr double kNoLength = 1e-9;
/// The rounding of adding coordinates of some metres in doubles, in mm or degrees. A move whose end is no farther away on an axis does not move that
/// axis.
inline constexpr double kAddingUp = 1e-9;
/// The most, in mm or degrees, between the end of a segment and the start of the next one, which went through the same maps in another order.
inline constexpr double kJoined = 1e-7;
/// The most, in mm or degrees, between a commanded position and the same position after interpolation or read back from the machine.
inline constexpr double kReached = 1e-6;

}  // namespace nc
