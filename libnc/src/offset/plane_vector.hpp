// SPDX-License-Identifier: Apache-2.0
// A vector in the plane of compensation (h, v), mm. Trivially copyable, so that the stages that hold one are.
#pragma once

#include <cmath>

#include "base/units.hpp"

namespace nc {

struct Vec2 {
  double h = 0, v = 0;
  bool operator==(const Vec2&) const = default;
};

inline Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.h + b.h, a.v + b.v};
}
inline Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.h - b.h, a.v - b.v};
}
inline Vec2 operator-(Vec2 a) {
  return {-a.h, -a.v};
}
inline Vec2 operator*(double k, Vec2 a) {
  return {k * a.h, k * a.v};
}
inline double dot(Vec2 a, Vec2 b) {
  return a.h * b.h + a.v * b.v;
}
inline double cross(Vec2 a, Vec2 b) {
  return a.h * b.v - a.v * b.h;
}
/// Coordinates are neither so large nor so small that their squares could leave the range of a double; std::hypot, which guards against that,
/// takes a third of the time of a compensated block.
inline double norm(Vec2 a) {
  return std::sqrt(a.h * a.h + a.v * a.v);
}
/// norm(a) > length, nearly always without the root: that is taken where the squares are near enough to be rounded the other way.
inline bool longer_than(Vec2 a, double length) {
  const double square = dot(a, a);
  return square > 4 * length * length || std::sqrt(square) > length;
}
/// Turned 90 degrees counter-clockwise: the left normal of a direction.
inline Vec2 left_of(Vec2 a) {
  return {-a.v, a.h};
}
/// Unit vector, zero for a zero vector.
inline Vec2 unit(Vec2 a) {
  const double n = norm(a);
  return n > 0 ? (1 / n) * a : Vec2{};
}

/// Angle from one vector to the other, counter-clockwise positive. So near to half a turn that rounding would decide which way it goes, in rad, it goes the way of the sign of `way`.
inline double turned(Vec2 from, Vec2 to, double way) {
  constexpr double kNearHalfTurn = 1e-6;
  const double across = cross(from, to), along = dot(from, to);
  // Of so small a number the arc tangent is the number itself, in all the digits that a double has: the vectors at smooth joints.
  if (std::abs(across) < 1e-9 * along) return across / along;
  const double by = std::atan2(across, along);
  return kPi - std::abs(by) < kNearHalfTurn ? std::copysign(kPi, way) : by;
}

}  // namespace nc
