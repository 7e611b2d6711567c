// SPDX-License-Identifier: Apache-2.0
// What relax() makes of a smoothed polyline: it stays within the tolerance, goes on where it is cut as it did, and is gone faster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "law_paths.hpp"
#include "motion/optimal/profile.hpp"
#include "motion/optimal/relax.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::Piece;

constexpr double kTolerance = 0.01, kFeed = 100;

/// A polyline, and all that one smoothing works in.
struct Line {
  std::vector<AxisVec> vertex, control;
  std::vector<double> length, feed, u, knot;
  std::vector<unsigned> corner;
  std::vector<optimal::SmoothCell> cell;
  std::vector<Piece> pieces;
  optimal::SmoothRequest request;
  optimal::SmoothRoom room;

  void to(double x, double y, double z) {
    AxisVec p;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    if (!vertex.empty()) {
      const AxisVec& q = vertex.back();
      length.push_back(std::hypot(x - q[0], y - q[1], z - q[2]));
      feed.push_back(kFeed);
    }
    vertex.push_back(p);
  }
  bool smooth() {
    const unsigned count = static_cast<unsigned>(vertex.size()), knots = 64 * count + 64;
    u.resize(count);
    knot.resize(knots);
    control.resize(knots + 3);
    corner.resize(knots);
    cell.resize(knots);
    pieces.resize(knots);
    request.line = {vertex.data(), length.data(), feed.data(), count};
    request.tolerance = kTolerance;
    request.spacing = 0.5;
    room = {u.data(), count, knot.data(), control.data(), corner.data(), cell.data(), knots};
    pieces.resize(at_once([&](optimal::Work& work) { return optimal::smooth(work, request, room, pieces.data(), knots); }));
    return !pieces.empty();
  }
  bool relax(const optimal::Limits& limits, unsigned to) {
    const auto relaxation = std::make_unique<optimal::Relaxation>();
    std::vector<optimal::PieceSpeed> speed(knot.size());
    std::vector<AxisVec> before(knot.size() + 3);
    relaxation->speed = speed.data();
    relaxation->before = before.data();
    const unsigned cells = static_cast<unsigned>(pieces.size());
    return at_once([&](optimal::Work& work) {
      return optimal::relax(work, request, room, relaxation.get(), {&limits, 1}, pieces.data(), cells, to);
    });
  }
  /// The largest distance from the line at the same u, and the largest jump between pieces.
  void measure(double* off, double* jump) const {
    unsigned edge = 0;
    *off = *jump = 0;
    for (size_t k = 0; k < pieces.size(); ++k) {
      for (int n = 0; n <= 40; ++n) {
        const double x = pieces[k].length * n / 40, at = std::min(knot[k] + x, u.back());
        while (edge + 1 < length.size() && u[edge + 1] < at) ++edge;
        const AxisVec q = evaluate(pieces[k], x, 3).position;
        double sum = 0;
        for (unsigned i = 0; i < 3; ++i) {
          const double p = vertex[edge][i] + (at - u[edge]) / length[edge] * (vertex[edge + 1][i] - vertex[edge][i]);
          sum += (q[i] - p) * (q[i] - p);
        }
        *off = std::max(*off, std::sqrt(sum));
      }
      if (k + 1 == pieces.size()) continue;
      const CurvePoint a = evaluate(pieces[k], pieces[k].length, 3), b = evaluate(pieces[k + 1], 0, 3);
      for (unsigned i = 0; i < 3; ++i)
        *jump = std::max({*jump, std::fabs(a.position[i] - b.position[i]), std::fabs(a.d1[i] - b.d1[i]),
                          std::fabs(a.d2[i] - b.d2[i]) / (1 + std::fabs(a.d2[i]))});
    }
  }
};

/// Lines of 0.05 to 0.5 mm with headings by chance.
Line rough(unsigned seed, unsigned count, double sharpest) {
  std::mt19937_64 rng(seed);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
  Line line;
  double x = 0, y = 0, z = 0, heading = 0;
  line.to(0, 0, 0);
  for (unsigned n = 0; n < count; ++n) {
    const double size = 0.05 * std::pow(10, draw(0, 1));
    heading += draw(-sharpest, sharpest);
    x += size * std::cos(heading);
    y += size * std::sin(heading);
    z += size * draw(-0.4, 0.4);
    line.to(x, y, z);
  }
  return line;
}

double seconds_of(const std::vector<Piece>& pieces, const optimal::Limits& limits) {
  const auto windows = std::make_unique<optimal::Windows>();
  double seconds = 0;
  windows->start(pieces.data(), static_cast<unsigned>(pieces.size()), limits);
  while (at_once([&](optimal::Work& work) { return windows->next(work); }))
    for (unsigned k = 0; k < windows->keep(); ++k) seconds += cell_seconds(windows->law(), windows->mesh(), k);
  EXPECT_FALSE(windows->failed());
  return seconds;
}

TEST(Relax, RoughLinesAreGoneFasterWithinTheTolerance) {
  const optimal::Limits limits = limits_of(2000, 50000);
  double all = 0, all_before = 0, most = 0;
  for (unsigned seed = 1; seed <= seeds(20, 5); ++seed) {
    Line line = rough(seed, 150, seed % 2 == 0 ? 0.6 : 0.2);
    ASSERT_TRUE(line.smooth()) << "seed " << seed;
    const double before = seconds_of(line.pieces, limits);
    EXPECT_TRUE(line.relax(limits, static_cast<unsigned>(line.pieces.size()))) << "seed " << seed;
    const double now = seconds_of(line.pieces, limits);
    double off = 0, jump = 0;
    line.measure(&off, &jump);
    EXPECT_LE(off, kTolerance * (1 + 1e-9)) << "seed " << seed;
    EXPECT_LE(jump, 1e-7) << "seed " << seed;
    EXPECT_LE(now, before) << "seed " << seed;
    most = std::max(most, now / before);
    all += now;
    all_before += before;
  }
  EXPECT_LE(all, 0.9 * all_before);
  std::printf("%.3f of the time without it, %.3f at most\n", all / all_before, most);
}

TEST(Relax, WhereTheLineIsCutItIsAsItWas) {
  const optimal::Limits limits = limits_of(2000, 50000);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Line line = rough(seed, 60, 0.5);
    ASSERT_TRUE(line.smooth()) << "seed " << seed;
    const unsigned cells = static_cast<unsigned>(line.pieces.size()), to = cells / 2;
    const std::vector<Piece> before = line.pieces;
    line.relax(limits, to);
    const CurvePoint a = evaluate(before[to], 0, 3), b = evaluate(line.pieces[to - 1], line.pieces[to - 1].length, 3);
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_NEAR(a.position[i], b.position[i], 1e-11) << "seed " << seed;
      EXPECT_NEAR(a.d1[i], b.d1[i], 1e-9) << "seed " << seed;
      EXPECT_NEAR(a.d2[i], b.d2[i], 1e-7 * (1 + std::fabs(a.d2[i]))) << "seed " << seed;
    }
  }
}

/// Each corner of such a polygon has knots of its own and is near enough at once; a spline through the whole tube is far gentler.
TEST(Relax, BluntCornersAreGoneFasterWhereNothingWasHalved) {
  Line line;
  for (int n = 0; n <= 72; ++n) line.to(50 * std::cos(n * 0.0872664626), 50 * std::sin(n * 0.0872664626), 0);
  ASSERT_TRUE(line.smooth());
  for (size_t k = 0; k < line.pieces.size(); ++k) ASSERT_EQ(line.cell[k].halved & 0x7f, 0) << k;
  const optimal::Limits limits = limits_of(2000, 50000);
  const double before = seconds_of(line.pieces, limits);
  EXPECT_TRUE(line.relax(limits, static_cast<unsigned>(line.pieces.size())));
  const double now = seconds_of(line.pieces, limits);
  double off = 0, jump = 0;
  line.measure(&off, &jump);
  EXPECT_LE(off, kTolerance * (1 + 1e-9));
  EXPECT_LE(jump, 1e-7);
  EXPECT_LT(now, 0.95 * before);
  std::printf("%.3f of the time without it\n", now / before);
}

TEST(Relax, WhatHasNothingToGainStaysToTheLastBit) {
  Line line;
  for (int n = 0; n <= 400; ++n) line.to(0.1 * n, std::sin(0.02 * n), 0);  // gone at its feed
  ASSERT_TRUE(line.smooth());
  const std::vector<Piece> before = line.pieces;
  EXPECT_FALSE(line.relax(limits_of(2000, 50000), static_cast<unsigned>(line.pieces.size())));
  for (size_t k = 0; k < before.size(); ++k)
    for (unsigned d = 0; d < 4; ++d)
      for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(before[k].c[d][i], line.pieces[k].c[d][i]) << k;
}

}  // namespace
}  // namespace nc::test
