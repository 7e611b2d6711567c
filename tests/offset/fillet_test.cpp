// SPDX-License-Identifier: Apache-2.0
// Arcs that are as large as the tool, at any angle, in words of three, four and six digits: the tool goes into them and stands at their centre, or it is P153 because the
// last digit has made the arc smaller by more than that digit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>
#include <utility>
#include <vector>

#include "alarm/condition.hpp"
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
    ASSERT_NEAR(std::hypot(place[0] - made.center.h, place[1] - made.center.v), 0, made.path.items[0].move.inch ? 5e-3 : 2e-3) << "seed " << seed << ", block " << block;
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

// In inch the last of four digits is 2.54 um, and makes an arc smaller by so much more than the last of three in millimetres.
TEST(Fillet, InInchIsGoneIntoAsInMillimetres) {
  constexpr double kDigit = 2.54e-3;
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(20000, 1000);
  unsigned smaller = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Fillet made = fillet(seed, kDigit, seed % 5 < 2);
    for (Item& item : made.path.items) item.move.inch = true;
    const std::vector<Item> out = run_stage(made.path);
    if (made.off < -0.89 * kDigit) {
      ++smaller;
      ASSERT_TRUE(alarm_of(out) != nullptr || made.off > -0.91 * kDigit) << "seed " << seed << ", off " << made.off;
    } else {
      expect_the_tool_in_it(made, out, {3, 4}, seed);
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

double length_of(uint64_t seed) { return std::pow(10, -3.5 + 0.15 * static_cast<double>(seed % 13)); }

// Wherever the digits of its words lead it, it is a part of the arc. It is an alarm where digits lead it aside by more than one of them, and never another path.
TEST(Fillet, OfTheToolsRadiusWithALineOfAMicrometreInsideIsGoneInto) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(20000, 1000);
  unsigned alarms = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const double digit = seed % 3 == 0 ? 1e-3 : seed % 3 == 1 ? 1e-4 : 1e-6;
    const Fillet made = with_a_line_inside(seed, digit, length_of(seed));
    const std::vector<Item> out = run_stage(made.path);
    if (alarm_of(out) == nullptr) expect_the_tool_in_it(made, out, {3, 4, 5, 6}, seed);
    else ++alarms;
    if (HasFatalFailure()) return;
  }
  EXPECT_LT(alarms, count / 40);
}

/// A fillet that is larger than the tool by this share of it, with the line inside.
Fillet larger_than_the_tool(uint64_t seed, double share) {
  Fillet made = with_a_line_inside(seed, seed % 2 == 0 ? 1e-3 : 1e-4, length_of(seed));
  for (Item& item : made.path.items) {
    item.move.comp.radius = made.radius * (1 - share);
    item.move.comp.check = true;
  }
  return made;
}

// Of a larger fillet such a line turned the tool to both sides by half a millimetre, P152 and P153.
TEST(Fillet, LargerThanTheToolWithALineOfAMicrometreInsideIsGoneAlong) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(20000, 1000);
  unsigned alarms = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const double share = std::array{0.001, 0.01, 0.1, 0.3}[seed % 4];
    const Fillet made = larger_than_the_tool(seed, share);
    const std::vector<Item> out = run_stage(made.path);
    if (alarm_of(out) != nullptr) {
      ++alarms;
      continue;
    }
    for (const unsigned block : {4u, 5u, 6u}) {  // beside the arc, and the line
      const AxisVec place = at_block(out, made.path.start(), block);
      ASSERT_NEAR(std::hypot(place[0] - made.center.h, place[1] - made.center.v), share * made.radius, 3e-3) << "seed " << seed << ", block " << block;
    }
  }
  EXPECT_LT(alarms, count / 40);
}

// Between the line and the arc in front of it the path hangs on the arc behind, so there it cannot be read again from; everywhere else it goes on the same way.
TEST(Fillet, WithALineOfAMicrometreInsideCanBeReadAgain) {
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    const std::vector<Item> items = larger_than_the_tool(seed, 0.1).path.items;
    StageWithMemory stage;
    std::vector<Item> whole;
    std::vector<std::pair<Item, OffsetResume>> marks;
    std::vector<size_t> behind;
    Item item;
    for (size_t i = 0; i <= items.size(); ++i) {
      while (stage.pop(item)) {
        whole.push_back(item);
        if (item.kind != ItemKind::mark || !item.mark.resume) continue;
        marks.emplace_back(item, stage.resume_point());
        behind.push_back(whole.size());
      }
      if (i < items.size()) stage.push(items[i]);
    }
    if (alarm_of(whole) != nullptr) continue;
    for (size_t m = 0; m < marks.size(); ++m) {
      StageWithMemory again;
      again.restore(marks[m].second);
      const auto next = std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.kind == ItemKind::mark && i.source.line == marks[m].first.source.line; }) + 1;
      const std::vector<Move> moves = moves_of(run_stage(again, {next, items.end()})), of_whole = moves_of({whole.begin() + static_cast<std::ptrdiff_t>(behind[m]), whole.end()});
      ASSERT_EQ(moves.size(), of_whole.size()) << "seed " << seed << ", mark " << m;
      for (size_t i = 0; i < moves.size(); ++i) ASSERT_EQ(moves[i].end, of_whole[i].end) << "seed " << seed << ", mark " << m;
    }
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
