// SPDX-License-Identifier: Apache-2.0
// The rings of a cavity (docs/series8.md): they are closed, lie in one another no farther apart than the step, and reach the walls.
#include "cycle/cavity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nc {
namespace {

Cavity rectangle(double h, double v, double corner, double step, bool ccw = true) {
  Cavity cavity;
  cavity.half[0] = h;
  cavity.half[1] = v;
  cavity.corner = corner;
  cavity.ccw = ccw;
  cavity.rings = rings_of_cavity(cavity, step);
  return cavity;
}

struct Ring {
  double first[2] = {0, 0}, last[2] = {0, 0}, most[2] = {0, 0};
  double area = 0;  ///< of the polygon of its points, counter-clockwise positive
  unsigned pieces = 0, arcs = 0;
};
Ring ring_of(const Cavity& cavity, uint32_t number) {
  Ring ring;
  CavityPiece piece;
  double at[2] = {0, 0};
  for (; piece_of_cavity(cavity, number, ring.pieces, &piece); ++ring.pieces) {
    for (unsigned i = 0; i < 2 && ring.pieces == 0; ++i) ring.first[i] = piece.to[i];
    if (ring.pieces != 0) ring.area += (at[0] * piece.to[1] - at[1] * piece.to[0]) / 2;
    ring.arcs += piece.arc ? 1u : 0u;
    if (piece.arc) {
      EXPECT_NEAR(std::hypot(at[0] - piece.center[0], at[1] - piece.center[1]), std::hypot(piece.to[0] - piece.center[0], piece.to[1] - piece.center[1]), 1e-9);
    }
    for (unsigned i = 0; i < 2; ++i) {
      at[i] = ring.last[i] = piece.to[i];
      ring.most[i] = std::fmax(ring.most[i], std::fabs(piece.to[i]));
    }
  }
  return ring;
}

TEST(Cavity, RingsAreClosedAndReachTheWalls) {
  const Cavity cavity = rectangle(25, 15, 3, 4);
  EXPECT_EQ(cavity.rings, 4u);  // 15 in steps of 3.75
  for (uint32_t n = 1; n <= cavity.rings; ++n) {
    const Ring ring = ring_of(cavity, n);
    EXPECT_EQ(ring.first[0], ring.last[0]) << n;
    EXPECT_EQ(ring.first[1], ring.last[1]) << n;
    EXPECT_NEAR(ring.most[0], 25 - (4 - n) * 3.75, 1e-9) << n;
    EXPECT_NEAR(ring.most[1], 15 - (4 - n) * 3.75, 1e-9) << n;
    EXPECT_GT(ring.area, 0) << n;
  }
  EXPECT_NEAR(ring_of(cavity, 0).most[0], 10, 1e-9);  // what the innermost ring leaves between the long walls
  EXPECT_EQ(ring_of(cavity, 0).most[1], 0);
}

struct Point {
  double h, v;
};

/// The way of the cutter's centre through all rings, in short steps.
std::vector<Point> way_of(const Cavity& cavity) {
  constexpr double kStep = 0.05;
  std::vector<Point> way{{0, 0}};
  for (uint32_t ring = 0; ring <= cavity.rings; ++ring) {
    CavityPiece piece;
    for (unsigned n = 0; piece_of_cavity(cavity, ring, n, &piece); ++n) {
      const Point from = way.back();
      const double length = std::hypot(piece.to[0] - from.h, piece.to[1] - from.v);
      const double radius = piece.arc ? std::hypot(from.h - piece.center[0], from.v - piece.center[1]) : 0, sense = piece.ccw ? 1 : -1;
      const double begin = std::atan2(from.v - piece.center[1], from.h - piece.center[0]), end = std::atan2(piece.to[1] - piece.center[1], piece.to[0] - piece.center[0]);
      const double sweep = sense * std::fmod(sense * (end - begin) + 4 * std::acos(-1.0), 2 * std::acos(-1.0));
      const int steps = static_cast<int>(std::ceil((piece.arc ? std::fabs(sweep) * radius : length) / kStep));
      for (int i = 1; i <= steps; ++i) {
        const double part = static_cast<double>(i) / steps, angle = begin + part * sweep;
        if (piece.arc) way.push_back({piece.center[0] + radius * std::cos(angle), piece.center[1] + radius * std::sin(angle)});
        else way.push_back({from.h + part * (piece.to[0] - from.h), from.v + part * (piece.to[1] - from.v)});
      }
    }
  }
  return way;
}

/// How far a point lies inside the wall of a rectangle with round corners; below 0 it is outside.
double inside_by(const Point& at, double half_h, double half_v, double corner) {
  const double h = std::fabs(at.h) - (half_h - corner), v = std::fabs(at.v) - (half_v - corner);
  return corner - (h > 0 && v > 0 ? std::hypot(h, v) : std::fmax(h, v));
}

// The cutter takes all that it can reach, and nothing of the walls, whatever the corners and the step are.
TEST(Cavity, IsClearedUpToItsWallsAndNotBeyondThem) {
  constexpr double kCutter = 2, kSlack = 0.02;
  for (const double corner : {2.0, 3.0, 6.0, 10.0})
    for (const double step : {0.7, 2.0, 3.4, 4.0}) {
      Cavity cavity = rectangle(13 - kCutter, 10 - kCutter, corner - kCutter, std::fmin(step, widest_step_round_corners(kCutter)));
      const std::vector<Point> way = way_of(cavity);
      for (const Point& at : way) EXPECT_GE(inside_by(at, 13, 10, corner), kCutter - 1e-6) << corner << " " << step << " at " << at.h << " " << at.v;
      for (double h = 0; h < 13; h += 0.4)
        for (double v = 0; v < 10; v += 0.4) {
          if (inside_by({h, v}, 13, 10, corner) < 0.01) continue;
          const auto reaches = [h, v](const Point& at) { return (at.h - h) * (at.h - h) + (at.v - v) * (at.v - v) <= (kCutter + kSlack) * (kCutter + kSlack); };
          EXPECT_TRUE(std::any_of(way.begin(), way.end(), reaches)) << corner << " " << step << " leaves " << h << " " << v;
        }
    }
}

TEST(Cavity, GoesTheOtherWayRoundByItsCode) {
  EXPECT_LT(ring_of(rectangle(25, 15, 3, 4, false), 4).area, 0);
}

TEST(Cavity, ASlotIsALineAndASquareHasNoneInTheMiddle) {
  const Cavity slot = rectangle(20, 0, 0, 4);
  EXPECT_EQ(slot.rings, 0u);
  EXPECT_EQ(ring_of(slot, 0).pieces, 3u);
  EXPECT_EQ(ring_of(rectangle(9, 9, 0, 4), 0).pieces, 0u);
  EXPECT_EQ(ring_of(rectangle(5, 9, 0, 5), 0).most[1], 4);
}

TEST(Cavity, ACircleIsMadeOfCircles) {
  Cavity circle;
  circle.circle = true;
  circle.half[0] = 10;
  circle.rings = rings_of_cavity(circle, 3);
  EXPECT_EQ(circle.rings, 4u);
  CavityPiece piece;
  EXPECT_FALSE(piece_of_cavity(circle, 0, 0, &piece));
  ASSERT_TRUE(piece_of_cavity(circle, 3, 1, &piece));
  EXPECT_TRUE(piece.arc);
  EXPECT_EQ(piece.to[0], 7.5);
  EXPECT_FALSE(piece_of_cavity(circle, 3, 2, &piece));
}

}  // namespace
}  // namespace nc
