// SPDX-License-Identifier: Apache-2.0
// How far apart two positions may lie that are meant to be one. None is above the finest command unit, 1e-6 mm or degrees
// (M700 2.1); each says what the difference comes from.
#pragma once

namespace nc {

/// A way no longer than this is none, in mm or degrees: it is below every command unit.
inline constexpr double kNoLength = 1e-9;
/// What adding up coordinates of some metres in doubles leaves, in mm or degrees. A move whose end is no farther away on an axis does not move it.
inline constexpr double kAddingUp = 1e-9;
/// Two segments that follow one another: the end and the start went through the same maps in another order, in mm or degrees.
inline constexpr double kJoined = 1e-7;
/// A position that was interpolated, or read back from the machine, beside one that was commanded, in mm or degrees.
inline constexpr double kReached = 1e-6;

}  // namespace nc
