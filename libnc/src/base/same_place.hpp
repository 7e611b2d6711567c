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
/// Lengths of a contour that differ by less, in mm, are one where something is decided by them: where the contour lies on the table makes some 1e-10 of its coordinates,
/// and up to a few 1e-9 of what lies millimetres beside a line of half a micrometre; the finest digit of a word makes seven times as much. What a rule allows it allows
/// with this on top, since words are as often exactly as long as a rule says as they are equal. It is no round number: a micrometre beside the middle of an arc of five
/// millimetres makes 1e-7.
inline constexpr double kOneLength_mm = 1.3e-7;
/// The most, in mm or degrees, between the end of a segment and the start of the next one, which went through the same maps in another order.
inline constexpr double kJoined = 1e-7;
/// The most, in mm or degrees, between a commanded position and the same position after interpolation or read back from the machine.
inline constexpr double kReached = 1e-6;

}  // namespace nc
