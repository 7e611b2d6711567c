// SPDX-License-Identifier: Apache-2.0
// Acceleration that is reserved for a corner slows the lines beside it. Nevertheless a path whose corners may be passed must not take longer than
// one that stops at each of them, except for the little that running on is worth (trapezoid, docs/motion.md).
#include <gtest/gtest.h>

#include <cmath>

#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

AxisVec at(double x, double y) {
  AxisVec p;
  p[0] = x;
  p[1] = y;
  return p;
}

/// The number of cycles of a program that `make` fills, with or without an exact stop at the end of each move.
template <class Make>
double cycles_of(bool stops, Make&& make) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  make(p);
  for (Record& r : p.records)
    if (r.kind == ItemKind::move) r.segment.exact_stop = stops;
  p.mark();
  p.end();
  Machine m(c);
  EXPECT_TRUE(m.run_to_end(p, 60000));
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  return static_cast<double>(m.cycles);
}

TEST(CornerTime, ACornerCostsNoMoreThanAStop) {
  for (const double radius : {1.0, 5.0, 20.0}) {
    const auto into_circle = [&](Program& p) {
      p.line(at(10, 0), 100);
      p.arc(0, 1, radius, 0, 2 * std::numbers::pi, 100);
    };
    EXPECT_LE(cycles_of(false, into_circle), 1.06 * cycles_of(true, into_circle)) << radius;
  }
  for (const double degrees : {1.0, 3.0, 10.0, 30.0, 80.0})
    for (const double length : {20.0, 100.0}) {
      const auto corner = [&](Program& p) {
        p.line(at(length, 0), 100);
        p.line(at(length * (1 + std::cos(to_rad(degrees))), length * std::sin(to_rad(degrees))), 100);
      };
      EXPECT_LE(cycles_of(false, corner), 1.06 * cycles_of(true, corner)) << degrees << " " << length;
    }
  for (const int corners : {36, 360}) {
    const auto polygon = [&](Program& p) {
      for (int n = 1; n <= corners; ++n) {
        const double angle = 2 * std::numbers::pi * n / corners;
        p.line(at(20 * std::cos(angle) - 20, 20 * std::sin(angle)), 100);
      }
    };
    EXPECT_LE(cycles_of(false, polygon), 1.06 * cycles_of(true, polygon)) << corners;
  }
}

}  // namespace
}  // namespace nc::test
