// SPDX-License-Identifier: Apache-2.0
// A sharp corner between straight sides in short lines is passed as one between two long lines (docs/motion-optimal.md, "Geometry").
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "law_paths.hpp"
#include "motion/optimal/profile.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::Piece;

constexpr double kWithin = 0.01;  // the tolerance of smoothed()

double seconds_along(const std::vector<Piece>& pieces) {
  const auto windows = std::make_unique<optimal::Windows>();
  double seconds = 0;
  windows->start(pieces.data(), static_cast<unsigned>(pieces.size()), limits_of(2000, 50000));
  while (at_once([&](optimal::Work& work) { return windows->next(work); }))
    for (unsigned k = 0; k < windows->keep(); ++k) seconds += cell_seconds(windows->law(), windows->mesh(), k);
  EXPECT_FALSE(windows->failed());
  return seconds;
}

/// The largest distance from the polyline at the same length, and the largest step of position, direction and curvature from piece to piece.
void measure_corners(const std::vector<Piece>& pieces, const std::vector<Vertex>& line, double* off, double* step) {
  double u = 0, from = 0;
  size_t edge = 0;
  *off = *step = 0;
  const auto length = [&](size_t e) { return std::hypot(line[e + 1].x - line[e].x, line[e + 1].y - line[e].y); };
  for (size_t k = 0; k < pieces.size(); u += pieces[k++].length) {
    for (int n = 0; n <= 40; ++n) {
      const double x = pieces[k].length * n / 40;
      while (edge + 2 < line.size() && from + length(edge) < u + x) from += length(edge++);
      const double share = (u + x - from) / length(edge);
      const CurvePoint q = evaluate(pieces[k], x, 3);
      *off = std::max(*off, std::hypot(q.position[0] - std::lerp(line[edge].x, line[edge + 1].x, share),
                                       q.position[1] - std::lerp(line[edge].y, line[edge + 1].y, share)));
    }
    if (k + 1 == pieces.size()) continue;
    const CurvePoint a = evaluate(pieces[k], pieces[k].length, 3), b = evaluate(pieces[k + 1], 0, 3);
    for (unsigned i = 0; i < 2; ++i)
      *step = std::max({*step, std::fabs(a.position[i] - b.position[i]), std::fabs(a.d1[i] - b.d1[i]),
                        std::fabs(a.d2[i] - b.d2[i]) / (1 + std::fabs(a.d2[i]))});
  }
}

/// Two sides of about 6 mm, each in lines of that length, whose ends lie beside it by up to `noise`.
std::vector<Vertex> two_sides(double degrees, double length, double noise, double feed, std::mt19937_64* rng) {
  const double turn = degrees * M_PI / 180;
  const int lines = static_cast<int>(6 / length);
  std::uniform_real_distribution<double> beside(-noise, noise);
  std::vector<Vertex> out;
  for (int n = -lines; n <= lines; ++n) {
    const double off = n == 0 ? 0 : beside(*rng), heading = n < 0 ? 0 : turn, way = n * length;
    out.push_back({way * std::cos(heading) - off * std::sin(heading), way * std::sin(heading) + off * std::cos(heading), feed});
  }
  return out;
}

TEST(CornerOfLines, ShortLinesArePassedAsLongOnes) {
  double most = 0, all = 0, all_long = 0, furthest = 0;
  for (unsigned seed = 1; seed <= seeds(200, 40); ++seed) {
    std::mt19937_64 rng(seed);
    const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
    const double degrees = draw(40, 150), length = draw(0.02, 0.2), noise = seed % 2 == 0 ? 0 : draw(0, 0.0005);
    const std::vector<Vertex> line = two_sides(degrees, length, noise, 100, &rng);
    const std::vector<Vertex> sides = {line.front(), {0, 0, 100}, {line.back().x, line.back().y, 100}};
    const std::vector<Piece> pieces = smoothed(line);
    ASSERT_FALSE(pieces.empty()) << "seed " << seed;
    double off = 0, step = 0;
    measure_corners(pieces, line, &off, &step);
    EXPECT_LE(off, kWithin * (1 + 1e-9)) << "seed " << seed;
    EXPECT_LE(step, 1e-7) << "seed " << seed;
    const double now = seconds_along(pieces), of_long = seconds_along(smoothed(sides));
    EXPECT_LE(now, of_long + 0.004) << "seed " << seed << ": " << degrees << " degrees, lines of " << length << " mm, noise of " << noise;
    most = std::max(most, now - of_long);
    furthest = std::max(furthest, off);
    all += now;
    all_long += of_long;
  }
  EXPECT_LE(all, 1.003 * all_long);
  std::printf("%.4f of the time between long lines, %.2f ms more at most, %.3f of the tolerance\n", all / all_long, 1e3 * most, furthest / kWithin);
}

/// Where the feed changes beside a corner the place of that counts, and no curve is laid over it.
TEST(CornerOfLines, AFeedThatChangesBesideItKeepsItsPlace) {
  for (const size_t slow : {size_t{2}, size_t{1}}) {
    std::vector<Vertex> line;
    for (int n = -60; n <= 60; ++n) line.push_back({std::min(n, 0) * 0.05, std::max(n, 0) * 0.05, 100});
    line[60 - slow].feed = 5;
    double way = 0;
    for (const Piece& p : smoothed(line))
      if (p.feed == 5)
        for (int n = 0; n < 100; ++n) {
          const CurvePoint q = evaluate(p, p.length * (n + 0.5) / 100, 3);
          way += std::hypot(q.d1[0], q.d1[1]) * p.length / 100;
        }
    EXPECT_GT(way, 0.02) << slow;
    EXPECT_LE(way, 1.0001 * 0.05) << slow;
  }
}

}  // namespace
}  // namespace nc::test
