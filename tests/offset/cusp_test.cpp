// SPDX-License-Identifier: Apache-2.0
// Where the path of a compensated contour goes straight back, as far as the words of the program can tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "base/units.hpp"
#include "path_builder.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

/// A half round nose that stands tangentially on a plate, from the plate to the nose or the other way, turned by any angle and written with three digits.
struct Nose {
  PathBuilder path;
  Point wedge;          ///< where the tool touches the plate and the nose
  double distance = 0;  ///< ... from the nose's foot, along the plate
};

Nose nose_on_a_plate(uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Nose nose;
  const double size = std::exp(between(0, std::log(50))), r = std::exp(between(std::log(0.2), std::log(5)));
  nose.distance = 2 * std::sqrt(size * r);
  const double plate = nose.distance * between(1.1, 3), turned = between(-kPi, kPi), mirrored = seed % 4 < 2 ? 1 : -1;
  const bool back = seed % 2 == 0, ccw = (mirrored < 0) != back;
  const auto exactly = [&](double h, double v) {
    return Point{std::cos(turned) * h - std::sin(turned) * mirrored * v, std::sin(turned) * h + std::cos(turned) * mirrored * v};
  };
  const auto rounded = [](Point p) { return Point{std::round(p.h * 1e3) / 1e3, std::round(p.v * 1e3) / 1e3}; };
  const Point foot = exactly(0, 0), middle = exactly(0, size), top = exactly(0, 2 * size);
  const double far = plate + 4 * r + nose.distance;
  Point points[] = {exactly(-far, 3 * r), exactly(-far, 0), exactly(-plate, 0), foot, top, exactly(far, 2 * size), exactly(far, 2 * size + 3 * r)};
  if (back) std::reverse(std::begin(points), std::end(points));
  for (Point& point : points) point = rounded(point);
  const Point arc_from = back ? top : foot, center = rounded({middle.h - arc_from.h, middle.v - arc_from.v});
  PathBuilder& path = nose.path = PathBuilder(points[0].h, points[0].v);
  path.side(mirrored * (back ? -1 : 1) > 0 ? 1 : -1, r);
  path.line(points[1].h, points[1].v).line(points[2].h, points[2].v);
  if (!back) path.line(points[3].h, points[3].v);
  path.arc(ccw, points[back ? 3 : 4].h, points[back ? 3 : 4].v, center.h, center.v);
  for (unsigned i = back ? 4 : 5; i < 6; ++i) path.line(points[i].h, points[i].v);
  path.cancel().line(points[6].h, points[6].v).end();
  nose.wedge = exactly(-nose.distance, r);
  return nose;
}

// By the last digit of the plate's end, or of the nose's centre, the two overlap near the foot by less than a nanometre. The tool stays in front of the wedge, on the
// plate 2 sqrt(R r) in front of the foot.
TEST(Cusp, TheLastDigitsOfWordsDoNotMakeAnOuterCornerOfIt) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(4000, 400);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const Nose nose = nose_on_a_plate(seed);
    const std::vector<Item> out = run_stage(nose.path);
    ASSERT_EQ(alarm_of(out), nullptr) << "seed " << seed;
    const AxisVec at = at_block(out, nose.path.start(), 3);
    ASSERT_NEAR(at[0], nose.wedge.h, 0.02 * nose.distance) << "seed " << seed;
    ASSERT_NEAR(at[1], nose.wedge.v, 0.02 * nose.distance) << "seed " << seed;
  }
}

// Two arcs, back to back, which overlap beside the point in which they turn by less than half a micrometre: nothing that a tool could go round. It stays where it touches both.
TEST(Cusp, ArcsThatOverlapByLessThanHalfAMicrometreAreAnInnerCorner) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(4000, 400);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double r1 = std::exp(between(std::log(0.5), std::log(50))), r2 = std::exp(between(std::log(0.5), std::log(50))), r = std::min({r1, r2, 4.0}) * between(0.1, 0.5);
    const double tilt = std::sqrt(2 * between(0, 4.5e-4) * (1 / r1 + 1 / r2)), turned = between(-kPi, kPi), way = 4 * r + 5;
    const auto at = [&](double h, double v) { return Point{std::cos(turned) * h - std::sin(turned) * v, std::sin(turned) * h + std::cos(turned) * v}; };
    // The first circle lies above the corner and the second one below it; the way comes along the first and goes back along the second, with the tool between.
    const double swing = 1, back = tilt - swing;
    const double from_h = r1 * std::sin(swing), from_v = r1 - r1 * std::cos(swing), center_h = r2 * std::sin(tilt), center_v = -r2 * std::cos(tilt);
    const double to_h = center_h - r2 * std::sin(back), to_v = center_v + r2 * std::cos(back);
    const Point from = at(from_h, from_v), before = at(from_h + way * std::cos(swing), from_v + way * std::sin(swing));
    const Point start = at(from_h + way * std::cos(swing) + 2 * r * std::sin(swing), from_v + way * std::sin(swing) - 2 * r * std::cos(swing));
    const Point to = at(to_h, to_v), behind = at(to_h + way * std::cos(back), to_v + way * std::sin(back));
    const Point end = at(to_h + way * std::cos(back) - 2 * r * std::sin(back), to_v + way * std::sin(back) + 2 * r * std::cos(back));
    const Point i1 = at(-from_h, r1 - from_v), i2 = at(center_h, center_v);
    PathBuilder path(start.h, start.v);
    path.side(1, r);
    path.line(before.h, before.v).line(from.h, from.v).arc(false, 0, 0, i1.h, i1.v).arc(false, to.h, to.v, i2.h, i2.v).line(behind.h, behind.v);
    path.cancel().line(end.h, end.v).end();
    const std::vector<Item> out = run_stage(path);
    ASSERT_EQ(alarm_of(out), nullptr) << "seed " << seed;
    const AxisVec place = at_block(out, path.start(), 3);
    const Point c1 = at(0, r1);
    ASSERT_NEAR(std::hypot(place[0] - c1.h, place[1] - c1.v), r1 + r, 1e-6) << "seed " << seed;
    ASSERT_NEAR(std::hypot(place[0] - i2.h, place[1] - i2.v), r2 + r, 1e-6) << "seed " << seed;
    ASSERT_GT(std::cos(turned) * place[0] + std::sin(turned) * place[1], r) << "seed " << seed;
  }
}

// A spike of a third of a degree, one side of which bends to the other: there is room between the two, and the tool goes round the tip.
TEST(Cusp, ASpikeIsAnOuterCorner) {
  const double angle = 0.006, radius = 1000, i = -radius * std::sin(angle), j = radius * std::cos(angle), along = 10 / radius;
  PathBuilder path(-20, 10);
  path.side(1, 1);
  path.line(-20, 0).line(-10, 0).line(0, 0);
  path.arc(false, i - std::cos(along) * i - std::sin(along) * j, j + std::sin(along) * i - std::cos(along) * j, i, j);
  path.by(-10, 0).cancel().by(-10, -10).end();
  const std::vector<Item> out = run_stage(path);
  EXPECT_EQ(alarm_of(out), nullptr);
  double farthest = -100;
  for (const Move& move : moves_of(out)) farthest = std::max(farthest, move.end[0]);
  EXPECT_NEAR(farthest, 1, 1e-2);
}

}  // namespace
}  // namespace nc::test
