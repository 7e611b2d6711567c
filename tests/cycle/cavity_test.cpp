// SPDX-License-Identifier: Apache-2.0
// The rings of a cavity (docs/series8.md): they are closed, lie in one another no farther apart than the step, and reach the walls.
#include "cycle/cavity.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
