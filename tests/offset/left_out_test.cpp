// SPDX-License-Identifier: Apache-2.0
// What the avoidance of interference (M700 12.4.8, #8102) leaves out is not cut by any block of the pre-read: stepped profiles, whose paths are measured against
// the programmed contour by short straight pieces, which share nothing with the control.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "path_builder.hpp"
#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

const double kHalf = std::acos(-1.0);  // a turn

Outcome with_avoidance(const char* radius, const std::string& contour) {
  Bench bench;
  bench.tool(1, std::strtod(radius, nullptr)).param("8102", "1");
  return bench.run("G17 G90 G94\n" + contour + "M30");
}

void expect_alarm(const char* radius, const std::string& contour, unsigned line) {
  const Outcome run = with_avoidance(radius, contour);
  EXPECT_EQ(run.alarm, "P153") << contour;
  EXPECT_EQ(run.alarm_line, line) << contour;
}

// The block behind the next one comes down at the step that has been left out, past the block that was joined.
TEST(LeftOut, TheBlockAfterTheNextKeepsTheAmountToIt) {
  expect_alarm("5", "G0 X0 Y12.5\nG1 G42 D1 X0 Y5. F500\nX0 Y0\nX-30.61965 Y-0.90684\nX-30.60856 Y-1.70939\nX-30.61501 Y-1.70375\nX-33.36756 Y-4.72823\nX-51.05733 Y25.63259\nG40 X-40.25689 Y31.92548\n", 5);
}

// A circle behind a step: how it goes on is not known yet when the step is left out.
TEST(LeftOut, AnArcBehindTheJoinedBlocksKeepsTheAmountToIt) {
  expect_alarm("1", "G0 X1.70427 Y-1.82906\nG1 G42 D1 X0 Y0 F500\nX5.72225 Y5.33183\nX6.5341 Y4.9676\nG2 X6.53986 Y4.98045 I.1 J-.0374\nG1 X6.54056 Y4.98007\nG2 X14.36627 Y6.55756 R8.07389\nG40 G1 X13.58411 Y4.18307\n", 5);
}

// The first wall of a groove that narrows behind a step, and the last: the block in front of what is left out passes the block behind it.
TEST(LeftOut, TheBlockBeforeTheJoinedOnesKeepsTheAmountToThem) {
  expect_alarm("5", "G0 X11.55896 Y4.75821\nG1 G41 D1 X0 Y0 F500\nX7.95867 Y-19.33374\nX8.67189 Y-19.63029\nX15.32311 Y-3.63362\nX15.32614 Y-3.6315\nX-1.76998 Y14.68206\nX16.45013 Y31.13338\nG40 X8.07311 Y40.41107\n", 4);
}

// An arc bends to the tool beyond a step that is lower than the tool: the vectors at the two ends of the step do not cross.
TEST(LeftOut, ALineBeyondAStepKeepsTheAmountToAnArc) {
  expect_alarm("1", "G0 X-1.24692 Y2.16684\nG1 G42 D1 X0 Y0 F500\nG3 X-1.61432 Y-3.27113 R3.27740\nG1 X-1.61495 Y-3.27124\nX-1.51596 Y-10.78174\nG40 X-3. Y-10.8\n", 4);
}

// Ways in and out of small pockets: their blocks are crossed by the path of the contour, which closes where they end.
TEST(LeftOut, AWayInIsNoWall) {
  for (const std::string contour : {"G3 X10. Y0 R5.\nG3 X-10. Y0 R10.\nG3 X10. Y0 R10.\nG3 X5. Y5. R5.\n", "G3 X10. Y0 R5.\nG3 I-10.\nG3 X5. Y5. R5.\n",
                                    "G3 X10. Y0 R5.\nG1 Y9.98\nX9.98 Y10.\nG3 Y-10. R10.\nG1 X10. Y0\nG3 X5. Y5. R5.\n"}) {
    const Outcome run = with_avoidance("2", "G0 X0 Y0\nG41 D1 G1 X5. Y-5. F500\n" + contour + "G40 G1 X0 Y0\n");
    EXPECT_EQ(run.alarm, "") << contour << run.alarm_detail;
  }
}

/// A block as a row of points.
using Row = std::vector<Point>;

double cross(Point a, Point b, Point c) { return (b.h - a.h) * (c.v - a.v) - (b.v - a.v) * (c.h - a.h); }
double from_point(Point p, Point a, Point b) {
  const double h = b.h - a.h, v = b.v - a.v, squares = h * h + v * v;
  const double t = squares > 0 ? std::clamp(((p.h - a.h) * h + (p.v - a.v) * v) / squares, 0.0, 1.0) : 0;
  return std::hypot(p.h - a.h - t * h, p.v - a.v - t * v);
}
bool cross_each_other(Point a, Point b, Point c, Point d) { return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0; }
double apart(Point a, Point b, Point c, Point d) {
  if (cross_each_other(a, b, c, d)) return 0;
  return std::min({from_point(a, c, d), from_point(b, c, d), from_point(c, a, b), from_point(d, a, b)});
}
/// The distance of two rows, where it is less than `least`; else `least`.
double apart(const Row& one, const Row& other, double least) {
  for (size_t i = 0; i + 1 < one.size(); ++i) {
    const double length = std::hypot(one[i + 1].h - one[i].h, one[i + 1].v - one[i].v);
    for (size_t k = 0; k + 1 < other.size(); ++k) {
      if (from_point(one[i], other[k], other[k + 1]) > least + length) continue;
      least = std::min(least, apart(one[i], one[i + 1], other[k], other[k + 1]));
    }
  }
  return least;
}
bool cross_each_other(const Row& one, const Row& other) {
  for (size_t i = 0; i + 1 < one.size(); ++i)
    for (size_t k = 0; k + 1 < other.size(); ++k)
      if (cross_each_other(one[i], one[i + 1], other[k], other[k + 1])) return true;
  return false;
}

/// Points of an arc so near to each other that a chord lies no more than 20 nm beside it.
void add_arc(Row* row, Point center, double radius, double angle, double sweep) {
  const double step = 2 * std::sqrt(4e-5 / std::max(radius, 1e-3));
  const int n = 1 + static_cast<int>(std::abs(sweep) / step);
  for (int i = 0; i <= n; ++i) row->push_back({center.h + radius * std::cos(angle + sweep * i / n), center.v + radius * std::sin(angle + sweep * i / n)});
}
Row row_of(const Move& move) {
  Row row;
  if (move.circular) {
    add_arc(&row, {move.circle.center[0], move.circle.center[1]}, move.circle.radius_start, move.circle.angle_start, move.circle.sweep);
  } else {
    row = {{move.start[0], move.start[1]}, {move.end[0], move.end[1]}};
  }
  return row;
}

/// Long blocks with steps between them that are lower than the tool's radius; some of the blocks bend.
struct Profile {
  PathBuilder path;
  double radius = 1;
  unsigned blocks = 0;
  bool simple = true;  ///< the contour, lengthened at both ends, does not cross itself
};

Profile stepped_profile(uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  Profile profile;
  PathBuilder& path = profile.path;
  const double r = profile.radius = one_of(4) == 0 ? 5 : one_of(3) == 0 ? 0.5 : 1;
  const int side = one_of(2) == 0 ? 1 : -1;
  const double arcs = one_of(4) == 0 ? 0.4 : 0;
  profile.blocks = 3 + static_cast<unsigned>(one_of(5));
  double heading = between(-kHalf, kHalf);
  const Point away{2.5 * r * -side * std::sin(heading), 2.5 * r * side * std::cos(heading)};
  path = PathBuilder(away.h, away.v);
  path.side(side, r);
  path.comp.check = path.comp.avoid = true;
  path.line(0, 0);
  int back = 0;
  std::vector<Row> rows;
  rows.push_back({{-60 * r * std::cos(heading), -60 * r * std::sin(heading)}, {0, 0}});
  for (unsigned i = 0; i < profile.blocks; ++i) {
    const bool step = i > 0 && i + 1 < profile.blocks && (i % 2 == 1 || one_of(3) == 0);
    const double length = std::max(6e-4, (step ? std::pow(10, between(-4, 0.3)) : between(3, 8)) * r);
    if (i > 0) {
      const int sign = back != 0 && one_of(5) != 0 ? -back : one_of(2) == 0 ? 1 : -1;
      back = sign;
      const double turns[] = {between(80, 100), between(88, 92), between(30, 150), 90};
      heading += sign * turns[one_of(4)] * kHalf / 180;
    }
    const AxisVec at = path.position();
    if (between(0, 1) < arcs) {
      const double sense = one_of(2) == 0 ? 1 : -1, sweep = between(0.1, 1.5), radius = length / (2 * std::sin(sweep / 2));
      const double i_word = -sense * std::sin(heading) * radius, j_word = sense * std::cos(heading) * radius;
      const Point center{at[0] + i_word, at[1] + j_word};
      const double end = heading + sense * (sweep - kHalf / 2);
      path.arc(sense > 0, center.h + radius * std::cos(end), center.v + radius * std::sin(end), i_word, j_word);
      heading += sense * sweep;
    } else {
      path.by(length * std::cos(heading), length * std::sin(heading));
    }
    rows.push_back(row_of(path.items[path.items.size() - 2].move));
  }
  const AxisVec at = path.position();
  rows.push_back({{at[0], at[1]}, {at[0] + 60 * r * std::cos(heading), at[1] + 60 * r * std::sin(heading)}});
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t k = i + 1; k < rows.size(); ++k) profile.simple = profile.simple && !cross_each_other(rows[i], rows[k]);
  path.cancel().by(2.5 * r * -side * std::sin(heading), 2.5 * r * side * std::cos(heading)).end();
  return profile;
}

TEST(LeftOut, NoPathOfASteppedProfileComesNearerThanTheRadius) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(4000, 200);
  uint64_t driven = 0, tried = 0, left_out = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const Profile profile = stepped_profile(seed);
    if (!profile.simple) continue;
    ++tried;
    const std::vector<Item> out = run_stage(profile.path);
    if (alarm_of(out) != nullptr) continue;
    ++driven;
    std::vector<Row> walls(1);  // by line: 1 is the start
    for (const Item& item : profile.path.items)
      if (item.kind == ItemKind::move) walls.push_back(row_of(item.move));
    uint32_t line = 1;
    for (const Item& item : out) {
      if (item.kind != ItemKind::move || item.source.line == 1 || item.source.line == profile.blocks + 2) continue;
      left_out += item.source.line > line + 1 ? 1u : 0u;
      line = item.source.line;
      const Row path = row_of(item.move);
      for (unsigned wall = std::max(2u, line < 4 ? 0u : line - 4); wall <= std::min(profile.blocks + 1, line + 4); ++wall)
        ASSERT_GT(apart(path, walls[wall], 2 * profile.radius), profile.radius - 1.05e-3) << "seed " << seed << ": the path of line " << line << " cuts into line " << wall;
    }
  }
  EXPECT_GT(tried, count / 3);
  EXPECT_GT(driven, tried * 7 / 10) << "of " << tried;
  EXPECT_GT(left_out, tried / 20);
}

}  // namespace
}  // namespace nc::test
