// SPDX-License-Identifier: Apache-2.0
// Paths and limits for the tests of laws: polylines in a plane, rounded as the optimal mode rounds them.
#pragma once

#include <cmath>
#include <vector>

#include "at_once.hpp"
#include "motion/optimal/smooth.hpp"
#include "motion/optimal/windows.hpp"

namespace nc::test {

/// The same limits for three axes, with a velocity of 250 mm/s.
inline optimal::Limits limits_of(double acceleration, double jerk) {
  optimal::Limits l;
  for (unsigned i = 0; i < 3; ++i) {
    l.velocity[i] = l.rapid[i] = 250;
    l.acceleration[i] = acceleration;
    l.jerk[i] = jerk;
  }
  return l;
}

/// The end of a line, and the feed of that line. The first one is the beginning of the path, whose feed is ignored.
struct Vertex {
  double x, y, feed;
};

/// The polyline, rounded within 10 um.
inline std::vector<optimal::Piece> smoothed(const std::vector<Vertex>& corner) {
  const unsigned count = static_cast<unsigned>(corner.size()), room = 64 * count + 64;
  std::vector<AxisVec> vertex(count), control(room + 3);
  std::vector<double> length(count - 1), feed(count - 1), u(count), knot(room);
  std::vector<unsigned> at(room);
  std::vector<optimal::SmoothCell> cell(room);
  for (unsigned k = 0; k < count; ++k) {
    vertex[k][0] = corner[k].x;
    vertex[k][1] = corner[k].y;
    if (k == 0) continue;
    length[k - 1] = std::hypot(corner[k].x - corner[k - 1].x, corner[k].y - corner[k - 1].y);
    feed[k - 1] = corner[k].feed;
  }
  optimal::SmoothRequest request;
  request.line = {vertex.data(), length.data(), feed.data(), count};
  request.tolerance = 0.01;
  request.spacing = 0.5;
  const optimal::SmoothRoom rooms{u.data(), count, knot.data(), control.data(), at.data(), cell.data(), room};
  std::vector<optimal::Piece> pieces(room);
  pieces.resize(at_once([&](optimal::Work& work) { return optimal::smooth(work, request, rooms, pieces.data(), room); }));
  return pieces;
}

}  // namespace nc::test
