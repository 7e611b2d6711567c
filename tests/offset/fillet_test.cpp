// SPDX-License-Identifier: Apache-2.0
// Arcs that are as large as the tool, at any angle, in words of three, four and six digits: the tool goes into them and stands at their centre, or it is P153 because the
// last digit has made the arc smaller by more than that digit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/units.hpp"
#include "path_builder.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

struct Fillet {
  PathBuilder path;
  Point center;
  double radius = 0, off = 0;  ///< the tool's, and by how much the arc in its words is smaller or larger, at its start or its end
};

double rounded(double value, double digit) { return std::round(value / digit) * digit; }

/// Between two walls at right angles; `by_radius`: the arc is commanded by its radius, which it has exactly.
Fillet fillet(uint64_t seed, double digit, bool by_radius) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Fillet made;
  const double r = made.radius = rounded(std::exp(between(std::log(0.4), std::log(12))), 1e-3), turned = between(-kPi, kPi), mirrored = seed % 2 == 0 ? 1 : -1;
  const auto at = [&](double h, double v) {
    v *= mirrored;
    return Point{rounded(std::cos(turned) * h - std::sin(turned) * v, digit), rounded(std::sin(turned) * h + std::cos(turned) * v, digit)};
  };
  const Point start = at(-2 * r, 0), begin = at(0, 0), corner = at(4 * r, 0), from = at(4 * r, -2 * r), to = at(5 * r, -3 * r), far = at(9 * r, -3 * r), end = at(9 * r, -r);
  made.center = at(5 * r, -2 * r);
  if (by_radius) {  // on the side of the chord on which it lies, at the distance that the radius makes
    const double half = std::hypot(to.h - from.h, to.v - from.v) / 2, away = std::sqrt(r * r - half * half) / (2 * half) * mirrored;
    made.center = {(from.h + to.h) / 2 - away * (to.v - from.v), (from.v + to.v) / 2 + away * (to.h - from.h)};
  }
  for (const Point& place : {from, to}) {
    const double off = std::hypot(place.h - made.center.h, place.v - made.center.v) - r;
    if (std::abs(off) > std::abs(made.off)) made.off = off;
  }
  made.path = PathBuilder(start.h, start.v);
  made.path.side(mirrored > 0 ? 1 : -1, r);
  made.path.line(begin.h, begin.v).line(corner.h, corner.v).line(from.h, from.v);
  made.path.arc(mirrored > 0, to.h, to.v, made.center.h - from.h, made.center.v - from.v);
  made.path.line(far.h, far.v).cancel().line(end.h, end.v).end();
  return made;
}

void expect_the_tool_in_it(const Fillet& made, const std::vector<Item>& out, uint64_t seed) {
  ASSERT_EQ(alarm_of(out), nullptr) << "seed " << seed << ", off " << made.off;
  for (const unsigned block : {3u, 4u}) {  // in front of the arc, and behind it
    const AxisVec place = at_block(out, made.path.start(), block);
    ASSERT_NEAR(std::hypot(place[0] - made.center.h, place[1] - made.center.v), 0, 2e-3) << "seed " << seed << ", block " << block;
  }
  AxisVec last = made.path.start();
  for (const Move& move : moves_of(out)) {
    ASSERT_LT(std::hypot(move.start[0] - last[0], move.start[1] - last[1]), 1e-9) << "seed " << seed;
    last = move.end;
  }
}

TEST(Fillet, OfTheToolsRadiusAtAnyAngleIsGoneInto) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(20000, 1000);
  unsigned smaller = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const double digit = seed % 3 == 0 ? 1e-3 : seed % 3 == 1 ? 1e-4 : 1e-6;
    const Fillet made = fillet(seed, digit, seed % 5 < 2);
    const std::vector<Item> out = run_stage(made.path);
    if (made.off < -8.9e-4) {
      ++smaller;
      const Item* alarm = alarm_of(out);
      ASSERT_TRUE(alarm != nullptr || made.off > -9.1e-4) << "seed " << seed << ", off " << made.off;
      ASSERT_TRUE(alarm == nullptr || alarm->alarm.condition == Condition::comp_interference) << "seed " << seed;
    } else {
      expect_the_tool_in_it(made, out, seed);
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_LT(smaller, count / 50);
}

TEST(Fillet, OfASmallerRadiusIsAnAlarm) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Fillet made = fillet(seed, 1e-6, false);
    PathBuilder path = made.path;
    for (Item& item : path.items) item.move.comp.radius += 1e-3;
    const std::vector<Item> out = run_stage(path);
    const Item* alarm = alarm_of(out);
    ASSERT_NE(alarm, nullptr) << "seed " << seed;
    EXPECT_EQ(alarm->alarm.condition, Condition::comp_interference);
  }
}

}  // namespace
}  // namespace nc::test
