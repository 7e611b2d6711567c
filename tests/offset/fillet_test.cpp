// SPDX-License-Identifier: Apache-2.0
// Arcs that are as large as the tool, at any angle, in words of three, four and six digits: the tool goes into them and stands at their centre, or it is P153 because the
// last digit has made the arc smaller by more than that digit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

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

/// What the seed decides: the tool's radius, and how the places of a contour are turned and mirrored. `digit`: the last one of their words.
struct Setting {
  Setting(uint64_t seed, double last_digit) : random(seed), digit(last_digit), mirrored(seed % 2 == 0 ? 1 : -1) {
    radius = rounded(std::exp(between(std::log(0.4), std::log(12))), 1e-3);
    turned = between(-kPi, kPi);
  }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Point at(double h, double v) const {
    v *= mirrored;
    return {rounded(std::cos(turned) * h - std::sin(turned) * v, digit), rounded(std::sin(turned) * h + std::cos(turned) * v, digit)};
  }

  std::mt19937_64 random;
  double digit, mirrored, radius = 0, turned = 0;
};

/// Between two walls at right angles; `by_radius`: the arc is commanded by its radius, which it has exactly.
Fillet fillet(uint64_t seed, double digit, bool by_radius) {
  Setting setting(seed, digit);
  Fillet made;
  const double r = made.radius = setting.radius, mirrored = setting.mirrored;
  const auto at = [&](double h, double v) { return setting.at(h, v); };
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

/// At the ends of these blocks, and its path has no gap.
void expect_the_tool_in_it(const Fillet& made, const std::vector<Item>& out, std::initializer_list<unsigned> blocks, uint64_t seed) {
  ASSERT_EQ(alarm_of(out), nullptr) << "seed " << seed << ", off " << made.off;
  for (const unsigned block : blocks) {
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
      expect_the_tool_in_it(made, out, {3, 4}, seed);  // in front of the arc, and behind it
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_LT(smaller, count / 50);
}

/// The same fillet in two arcs with a line between them, a chord of this length; `digit` is that of all words.
Fillet with_a_line_inside(uint64_t seed, double digit, double length) {
  Setting setting(seed, digit);
  Fillet made;
  const double r = made.radius = setting.radius, mirrored = setting.mirrored;
  const auto at = [&](double h, double v) { return setting.at(h, v); };
  const double angle = kPi + setting.between(0.1, 1.4), chord = length / r;
  const auto on_arc = [&](double a) { return at(r * std::cos(a), r * std::sin(a)); };
  const Point start = at(-7 * r, 2 * r), begin = at(-5 * r, 2 * r), corner = at(-r, 2 * r), from = at(-r, 0), first = on_arc(angle), second = on_arc(angle + chord), to = at(0, -r), far = at(4 * r, -r), end = at(4 * r, r);
  made.center = at(0, 0);
  made.path = PathBuilder(start.h, start.v);
  made.path.side(mirrored > 0 ? 1 : -1, r);
  made.path.line(begin.h, begin.v).line(corner.h, corner.v).line(from.h, from.v);
  made.path.arc(mirrored > 0, first.h, first.v, made.center.h - from.h, made.center.v - from.v);
  made.path.line(second.h, second.v);
  made.path.arc(mirrored > 0, to.h, to.v, made.center.h - second.h, made.center.v - second.v);
  made.path.line(far.h, far.v).cancel().line(end.h, end.v).end();
  return made;
}

// Where the digits of its words lead it elsewhere than along the arc it is an alarm, and never another path.
TEST(Fillet, OfTheToolsRadiusWithALineOfAMicrometreInsideIsGoneIntoOrAnAlarm) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(20000, 1000);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const double digit = seed % 3 == 0 ? 1e-3 : seed % 3 == 1 ? 1e-4 : 1e-6;
    const Fillet made = with_a_line_inside(seed, digit, std::pow(10, -3.5 + 0.15 * static_cast<double>(seed % 13)));
    const std::vector<Item> out = run_stage(made.path);
    if (alarm_of(out) == nullptr) expect_the_tool_in_it(made, out, {3, 4, 5, 6}, seed);
    if (HasFatalFailure()) return;
  }
}

// A line of a micrometre in front of a notch of the tool's radius leads nowhere into it: both of its ends lie on the arc but for the last digit, and the tool has to go round the corner.
TEST(Fillet, ANotchOfTheToolsRadiusBehindALineOfAMicrometre) {
  PathBuilder path(-9.858452, 0.708265);
  path.side(1, 0.536);
  path.line(-9.25448, -1e-6).line(-9.25448, 5.069457).line(8.719016, 5.069457).line(8.719016, -5.069457).line(-8.718016, -5.069457).line(-8.719016, -5.069457);
  path.arc(true, -9.25448, -4.533993, -0.535464, 0).line(-9.25448, -1e-6).cancel().line(-9.858452, 0.708265).end();
  const std::vector<Item> out = run_stage(path);
  ASSERT_EQ(alarm_of(out), nullptr);
  for (const Item& item : out) {
    if (item.kind != ItemKind::move || item.move.circular) continue;
    const Vec2 from{item.move.start[0] + 8.719016, item.move.start[1] + 5.069457}, to{item.move.end[0] + 8.719016, item.move.end[1] + 5.069457}, way = to - from;
    const double share = dot(way, way) > 0 ? std::clamp(-dot(from, way) / dot(way, way), 0.0, 1.0) : 0;
    EXPECT_GE(norm(from + share * way), 0.536 - 2e-3) << item.source.line;  // from the corner
  }
}

// A longer line lies inside of the circle of the arc, so the tool does not fit.
TEST(Fillet, OfTheToolsRadiusWithALongerLineInsideIsAnAlarm) {
  for (uint64_t seed = 1; seed <= 200; ++seed) EXPECT_NE(alarm_of(run_stage(with_a_line_inside(seed, 1e-6, 0.4).path)), nullptr) << "seed " << seed;
}

/// A wall with a notch in front of a fillet of the tool's radius.
Fillet behind_a_notch(uint64_t seed, double digit, bool reversed) {
  Setting setting(seed, digit);
  Fillet made;
  const double r = made.radius = setting.radius, mirrored = setting.mirrored;
  const auto at = [&](double h, double v) { return setting.at(reversed ? -h : h, v); };
  std::vector<Point> way = {at(-9 * r, r), at(-8 * r, -r), at(-0.4 * r, -r), at(-0.2 * r, -1.1 * r), at(0, -r), at(r, 0), at(r, 4 * r), at(-r, 5 * r)};
  made.center = at(0, 0);
  const unsigned arc_at = reversed ? 3 : 5;
  if (reversed) std::reverse(way.begin(), way.end());
  made.path = PathBuilder(way[0].h, way[0].v);
  made.path.side(mirrored > 0 ? 1 : -1, r);
  made.path.comp.check = made.path.comp.avoid = true;
  for (unsigned i = 1; i < way.size(); ++i) {
    if (i + 1 == way.size()) made.path.cancel();
    if (i == arc_at) {
      made.path.arc(mirrored > 0, way[i].h, way[i].v, made.center.h - way[i - 1].h, made.center.v - way[i - 1].v);
    } else {
      made.path.line(way[i].h, way[i].v);
    }
  }
  made.path.end();
  return made;
}

// #8102 joins the wall in front of the notch to the arc, in its centre.
TEST(Fillet, OfTheToolsRadiusIsJoinedByTheAvoidance) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(10000, 500);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const bool reversed = seed % 4 < 2;
    const Fillet made = behind_a_notch(seed, seed % 3 == 0 ? 1e-6 : 1e-4, reversed);
    expect_the_tool_in_it(made, run_stage(made.path), {reversed ? 3u : 5u}, seed);
    if (HasFatalFailure()) return;
  }
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
