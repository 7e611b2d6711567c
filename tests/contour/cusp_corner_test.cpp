// SPDX-License-Identifier: Apache-2.0
// Roundings where the path goes straight back, or nearly (corner_ii): compared with the touching circle that a search along the first block finds, which shares
// nothing with the control but the moves that the same program gives without the rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <optional>
#include <random>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using Point = std::complex<double>;
const double kPi = std::acos(-1.0);
constexpr double kOnePoint = 0.0005;  // mm

double dot(Point a, Point b) { return a.real() * b.real() + a.imag() * b.imag(); }

/// A block by what the trace says of it.
struct Track {
  Point start, end, center;
  bool round = false;
  double sense = 1, radius = 0;
  /// Its radius is the one at the corner: at both ends of an arc they differ by the last digits of the words.
  Track(const nc_move& move, bool corner_at_end)
      : start(move.machine_start.v[0], move.machine_start.v[1]), end(move.machine.v[0], move.machine.v[1]), center(move.machine_center[0], move.machine_center[1]), round(move.plane != NC_PLANE_NONE), sense(move.ccw ? 1 : -1), radius(std::abs((corner_at_end ? end : start) - center)) {}
  double sweep_to(Point place) const {
    double angle = sense * std::arg((place - center) / (start - center));
    if (angle < -1e-9) angle += 2 * kPi;
    return angle;
  }
  double length() const { return round ? radius * sweep_to(end) : std::abs(end - start); }
  Point at(double way) const {
    if (!round) return start + way * (end - start) / std::abs(end - start);
    return center + radius * (start - center) / std::abs(start - center) * std::polar(1.0, sense * way / radius);
  }
  Point direction(double way) const {
    if (!round) return (end - start) / std::abs(end - start);
    return Point(0, sense) * (at(way) - center) / std::abs(at(way) - center);
  }
  /// How far the point lies beside the block, to the left of travel.
  double beside(Point place) const {
    if (!round) return dot(place - start, Point(0, 1) * direction(0));
    return sense * (radius - std::abs(place - center));
  }
  /// The way to the foot of a point, if that is on the block.
  std::optional<double> foot(Point place) const {
    const double way = round ? radius * sweep_to(place) : dot(place - start, direction(0));
    if (way < -1e-7 || way > length() + 1e-7) return std::nullopt;
    return way;
  }
};

struct Touching {
  Point center;
  double before = 0, behind = 0;  ///< how far from the corner it touches
};

/// The circle of this radius that touches both blocks on one side of travel, nearest to the corner.
std::optional<Touching> search(const Track& first, const Track& second, double radius, double left) {
  if (second.round && second.sense * left > 0 && second.radius < radius) return std::nullopt;
  if (first.round && first.sense * left > 0 && first.radius < radius) return std::nullopt;
  const double whole = first.length();
  const auto center_at = [&](double back) { return first.at(whole - back) + Point(0, left * radius) * first.direction(whole - back); };
  const auto off = [&](double back) { return left * second.beside(center_at(back)) - radius; };
  constexpr int kSteps = 2000;
  double from = 1e-7, value = off(from);
  for (int i = 1; i <= kSteps; ++i) {
    const double to = whole * i / kSteps, next = off(to);
    if ((value < 0) != (next < 0)) {
      double low = from, high = to;
      for (int k = 0; k < 80; ++k) {
        const double middle = (low + high) / 2;
        ((off(middle) < 0) == (value < 0) ? low : high) = middle;
      }
      // Where the last digit lets the blocks cross, a circle may touch both in one point: that one turns by nothing, and the way back stays.
      if (const auto behind = second.foot(center_at(low)); behind && std::abs(second.at(*behind) - first.at(whole - low)) > kOnePoint)
        return Touching{center_at(low), low, *behind};
    }
    from = to;
    value = next;
  }
  return std::nullopt;
}

struct Chosen {
  double k = 0;  ///< signed curvature
  double way = 0;
  std::string block(Point from, Point u, const char* word, Point* to) const {
    char text[200];
    if (k == 0) {
      *to = from + way * u;
      std::snprintf(text, sizeof text, "G1 X%.6f Y%.6f%s\n", to->real(), to->imag(), word);
    } else {
      const Point center = from + Point(0, 1 / k) * u;
      *to = center + (from - center) * std::polar(1.0, way * k);
      std::snprintf(text, sizeof text, "G%d X%.6f Y%.6f I%.6f J%.6f%s\n", k > 0 ? 3 : 2, to->real(), to->imag(), (center - from).real(), (center - from).imag(), word);
    }
    return text;
  }
};

Outcome run_of(const std::string& text) {
  Bench bench;
  bench.param("corner_ii", "1");
  return bench.run(text);
}

TEST(CuspCorner, TwoHumpsAreRoundedInTheGrooveBetweenThem) {
  const Outcome run = run_of("F100\nG2 X10. Y0 I5. J0 ,R2.\nG2 X20. Y0 I5. J0\nM30");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  const std::vector<nc_move> moves = run.moves();
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_NEAR(moves[1].machine_center[0], 10, 1e-9);
  EXPECT_NEAR(moves[1].machine_center[1], std::sqrt(24.0), 1e-9);  // 7 from (5, 0) and from (15, 0)
  EXPECT_EQ(moves[1].ccw, 1);
}

TEST(CuspCorner, AWallAtTheFootOfAHump) {
  const Outcome run = run_of("F100\nG2 X10. Y0 I5. J0 ,R2.\nG1 Y20.\nM30");
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  ASSERT_EQ(run.moves().size(), 3u);
  EXPECT_NEAR(run.moves()[1].machine_center[0], 8, 1e-9) << "to the right of the wall is the air, to its left the hump";
}

// The words have four digits, by which line and arc cross once more. A circle of about the radius of the arc touches both there in one point.
TEST(CuspCorner, ARoundingThatDoesNotFitIsNotLeftOut) {
  for (const char* radius : {"15.", "18.", "19.9", "20.", "20.1", "25."}) {
    const std::string text = std::string("F1000\nG1 X-7.5221 Y22.2780\nG1 X0 Y0 ,R") + radius + "\nG2 X29.7282 Y23.2447 I18.9490 J6.3981\nM30";
    EXPECT_EQ(run_of(text).alarm, "P383") << radius;
  }
  for (const char* radius : {"5.", "18."}) {
    const std::string text = std::string("F1000\nG1 X27.1038 Y-21.8871\nG3 X0 Y0 I-19.7263 J3.2975 ,R") + radius + "\nG1 X13.5486 Y5.3769\nM30";
    EXPECT_EQ(run_of(text).alarm, "P384") << radius;
  }
  const Outcome run = run_of("F1000\nG1 X-30.0884 Y89.1120\nG1 X0 Y0 ,R18.\nG2 X29.7282 Y23.2447 I18.9490 J6.3981\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.moves().size(), 4u);
}

TEST(CuspCorner, RoundAHalfTurnEveryRoundingIsTheNearestTouchingCircle) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), cases = seeds(1000, 200);
  uint64_t cut = 0, alarms = 0;
  for (uint64_t i = first_seed; i < first_seed + cases; ++i) {
    std::mt19937_64 random(i);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto chosen = [&](bool round) {
      Chosen c;
      const double radius = number(1, 20);
      c.k = round ? (random() % 2 == 0 ? 1 : -1) / radius : 0;
      c.way = round ? radius * number(0.2, 0.95 * kPi) : number(1, 40);
      return c;
    };
    const bool first_round = i % 3 != 1, second_round = i % 3 != 2;
    const Chosen before = chosen(first_round);
    Chosen behind = chosen(second_round);
    if (first_round && second_round && random() % 8 == 0) behind.k = before.k;  // two equal humps, or (seen from behind) one and its own way back
    const double beside = number(-0.02, 0.02) * kPi / 180 * (random() % 3 == 0 ? 0 : 1);
    const Point u = std::polar(1.0, number(-kPi, kPi));
    const double own = std::abs(1 / (first_round ? before.k : behind.k)) * number(0.9, 1.0001);  // about the radius of an arc itself
    const double radius = std::round((random() % 4 == 0 ? own : number(0.05, 4)) * 1e3) / 1e3;
    char word[30];
    std::snprintf(word, sizeof word, " ,R%.3f", radius);
    Point corner, end;
    const std::string first = before.block({}, u, "", &corner), first_rounded = before.block({}, u, word, &corner);
    const Point second_u = -u * std::polar(1.0, before.way * before.k + beside);
    const std::string second = behind.block(corner, second_u, "", &end);
    const std::vector<nc_move> plain = run_of("F100\n" + first + second + "M30").moves();
    ASSERT_EQ(plain.size(), 2u) << first << second;
    const Track one(plain[0], true), two(plain[1], false);
    const std::string text = "F100\n" + first_rounded + second + "M30";
    const Outcome run = run_of(text);
    const auto left = search(one, two, radius, 1), right = search(one, two, radius, -1);
    SCOPED_TRACE(text);
    if (run.alarm != "") {
      ++alarms;
      EXPECT_TRUE(run.alarm == "P383" || run.alarm == "P384") << run.alarm;
      EXPECT_TRUE(!left && !right) << (left ? left->center : right->center);
      continue;
    }
    ++cut;
    const std::vector<nc_move> moves = run.moves();
    ASSERT_GT(moves.size(), 2u) << "it is cut, or an alarm, and never left out";
    ASSERT_TRUE(left || right);
    const double side = !right || (left && left->before < right->before) ? 1 : -1;
    const Touching& touching = side > 0 ? *left : *right;
    unsigned rounding = 0;
    while (rounding + 1 < moves.size() && !(moves[rounding].plane != NC_PLANE_NONE && std::abs(moves[rounding].radius - radius) < 1e-9)) ++rounding;
    const Track arc(moves[rounding], false);
    EXPECT_LT(std::abs(arc.center - touching.center), 1e-5) << arc.center << touching.center;
    EXPECT_EQ(arc.sense, side);
    EXPECT_LT(std::abs(arc.start - one.at(one.length() - touching.before)), 1e-5);
    EXPECT_LT(std::abs(arc.end - two.at(touching.behind)), 1e-5);
  }
  EXPECT_GT(cut, cases / 4);
  EXPECT_GT(alarms, cases / 20);
}

}  // namespace
}  // namespace nc::test
