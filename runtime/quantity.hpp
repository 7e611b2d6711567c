// SPDX-License-Identifier: Apache-2.0
// What a machine can mean by a number of its file: from the least to the most of each kind of quantity, whichever key it stands at. Beyond these it is a typing error, or a value
// that a program has computed wrongly; a number such as 1e-320 is none at all. Lengths are mm or deg.
#pragma once

namespace nc::rt {

// `or_zero`: 0 is taken, too, and means that there is no such thing.
struct Quantity {
  double least, most;
  bool or_zero = false;
};

// No number of a file lies nearer to 0 than this without being 0, a factor between units included.
inline constexpr double kLeastMeant = 1e-9;

namespace quantity {

inline constexpr Quantity kSpeed{1e-3, 1e6};            // mm/s: 1,000 m/s
inline constexpr Quantity kAcceleration{1e-3, 1e9};     // mm/s^2
inline constexpr Quantity kJerk{1e-3, 1e9, true};       // mm/s^3
inline constexpr Quantity kWay{1e-3, 1e6};              // a way that an axis goes: 1,000 m
inline constexpr Quantity kWindow{1e-6, 1e6};           // within which an axis is where it should be
inline constexpr Quantity kErrorLimit{1e-3, 1e6, true}; // of the following error; a thousandth is less than an encoder resolves in motion
inline constexpr Quantity kPathTolerance{1e-6, 1, true};
inline constexpr Quantity kOverlap{1e-3, 100, true};
inline constexpr Quantity kWeight{1e-3, 1e6, true};     // mm/s^2, of an axis that falls in the simulation
inline constexpr Quantity kBrakeTime{1e-4, 10, true};   // s
inline constexpr Quantity kDelay{1e-4, 10, true};       // s
inline constexpr Quantity kActionTime{1e-4, 3600, true};  // s, of something that the machine does
inline constexpr Quantity kLag{1e-3, 1000, true};       // ms
inline constexpr Quantity kAxisLag{1e-3, 50, true};     // ms, of an axis behind its set-points
inline constexpr Quantity kSpindleSpeed{0.1, 1e6, true};  // r/min
inline constexpr Quantity kBacklash{1e-6, 1, true};

}  // namespace quantity

}  // namespace nc::rt
