// SPDX-License-Identifier: Apache-2.0
// Curves in short lines: the last digit of their words turns each line, and the vectors with it. As long as a line is longer than what that makes of the vectors they stand in their order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

struct Place {
  double x = 0, y = 0;
};

double from_way(Place p, const nc_move& way) {
  const double x = way.machine_start.v[0], y = way.machine_start.v[1], dx = way.machine.v[0] - x, dy = way.machine.v[1] - y, square = dx * dx + dy * dy;
  const double part = square > 0 ? std::clamp(((p.x - x) * dx + (p.y - y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - x - part * dx, p.y - y - part * dy);
}

/// Part of an ellipse (a circle, every other time) in lines, cut from its outside or from its inside by a tool of up to half of its smallest radius.
struct EllipseInLines {
  double radius = 0;
  bool inside = false;
  std::vector<Place> places;
  std::string text;

  /// Lines of so many times the square root of the radius and the last digit, measured beside the ellipse.
  EllipseInLines(uint64_t seed, int digits, double times) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double b = number(15, 20), a = random() % 2 == 0 ? b : number(20, 40), smallest = b * b / a;
    inside = random() % 2 == 0;
    radius = std::exp(number(0, std::log(8)));
    if (inside) radius = std::min(radius, smallest / 2);
    const double length = times * std::sqrt(radius * std::pow(10, -digits)) / (inside ? 1 - radius / smallest : 1);
    double angle = number(0, 6.28);
    char block[64];
    const auto line = [&](const char* code, Place p) {
      std::snprintf(block, sizeof block, "%s X%.*f Y%.*f\n", code, digits, p.x, digits, p.y);
      return std::string(block);
    };
    const auto rounded = [&](double value) { return std::round(value * std::pow(10, digits)) * std::pow(10, -digits); };
    std::string contour;
    Place outside;
    for (unsigned n = 0; n < 300; ++n) {
      places.push_back({rounded(a * std::cos(angle)), rounded(b * std::sin(angle))});
      const double along = std::hypot(a * std::sin(angle), b * std::cos(angle));  // of its length by angle
      const double side = (inside ? -1.5 : 1.5) * radius;
      outside = {places.back().x + side * b * std::cos(angle) / along, places.back().y + side * a * std::sin(angle) / along};
      if (n == 0) text = line("G17 G90 G0", outside) + line(inside ? "G41 D1 G1 F1000" : "G42 D1 G1 F1000", places.back());
      if (n > 0) contour += line("", places.back());
      angle += length / along;
    }
    text += contour + line("G40", outside) + "M30\n";
  }
};

TEST(ShortLines, OfTwiceTheRootOfRadiusAndDigitAreCut) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(60, 6);
  for (uint64_t seed = first; seed < first + count; ++seed)
    for (const int digits : {3, 4}) {
      const EllipseInLines ellipse(seed, digits, 2);
      Bench bench;
      bench.tool(1, ellipse.radius);
      const Outcome run = bench.run(ellipse.text);
      EXPECT_EQ(run.alarm, "") << "seed " << seed << ", " << digits << " digits, radius " << ellipse.radius << ", line " << run.alarm_line;
      double nearest = 1e9, farthest = 0;
      const std::vector<nc_move> moves = run.moves();
      for (const Place place : ellipse.places) {
        double way = 1e9;
        for (size_t k = 1; k < moves.size(); ++k) way = std::min(way, from_way(place, moves[k]));
        nearest = std::min(nearest, way);
        farthest = std::max(farthest, way);
      }
      EXPECT_GT(nearest, ellipse.radius - 0.001) << "seed " << seed << ", " << digits << " digits";
      EXPECT_LT(farthest, ellipse.radius + 0.001) << "seed " << seed << ", " << digits << " digits";
    }
}

// Lines of half the root lie within what the digits decide.
TEST(ShortLines, OfHalfTheRootOfRadiusAndDigitInterfere) {
  unsigned alarms = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const EllipseInLines ellipse(seed, 3, 0.5);
    Bench bench;
    bench.tool(1, ellipse.radius);
    alarms += bench.run(ellipse.text).alarm == "P153";
  }
  EXPECT_GT(alarms, 15u);
}

}  // namespace
}  // namespace nc::test
