// SPDX-License-Identifier: Apache-2.0
// A vector in the plane of compensation (h, v), mm. Trivially copyable, so that the stages that hold one are.
#pragma once

#include <cmath>

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

}  // namespace nc
