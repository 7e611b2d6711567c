// SPDX-License-Identifier: Apache-2.0
// Terraces: closed contours on several levels under one G41, each below the one before (CONTOUR_CHECK). What is cut on a level is compared with the walls of that level and with those above
// it; a contour that has closed on its level is a depth of its own, and what lies below it, behind a ramp no less than behind a plunge, is no wall that it cuts.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

std::string alarm_of_terraces(const std::string& text, double radius) {
  Bench bench;
  bench.tool(1, radius).param("CONTOUR_CHECK", "1");
  const Outcome run = bench.run(text);
  return run.alarm.empty() ? "" : run.alarm + " L" + std::to_string(run.alarm_line) + " " + run.alarm_detail;
}

struct Corner {
  double x = 0, y = 0;
};

/// A rectangle about zero, once round counter-clockwise from the middle of its right side.
std::vector<Corner> rectangle(double half_x, double half_y) { return {{half_x, 0}, {half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}, {half_x, -half_y}, {half_x, 0}}; }

enum class Down { plunge, first_side, round };

/// Rectangles, the first of half the size `first`, each of the others smaller by `step` (a pocket; negative: larger, a boss), cut from the top down. From one to the next a rapid leads
/// over the terrace between them.
std::string terraces(bool pocket, double first, double step, unsigned count, Down down, double radius) {
  char text[100];
  std::string all = "G90 G17 G0";
  const auto add = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
    all += text;
  };
  const double away = pocket ? -2 * radius : 2 * radius;
  add(" X%.3f Y0\nG1 Z-1. F500\n%s D1 X%.3f\n", first + away, pocket ? "G41" : "G42", first);
  double z = -1, size = first;
  for (unsigned level = 0; level < count; ++level) {
    if (level > 0) {
      size -= pocket ? step : -step;
      add("G0 X%.3f\n", size);
      const double from = z;
      z -= 1.5;
      if (down == Down::plunge) add("G1 Z%.3f\n", z);
      const std::vector<Corner> ring = rectangle(size, 0.8 * size);
      for (size_t i = 1; down != Down::plunge && i < ring.size(); ++i) {
        add("G1 X%.3f Y%.3f", ring[i].x, ring[i].y);
        if (down == Down::round) add(" Z%.3f", from + (z - from) * static_cast<double>(i) / static_cast<double>(ring.size() - 1));
        if (down == Down::first_side && i == 1) add(" Z%.3f", z);
        all += "\n";
      }
    }
    const std::vector<Corner> ring = rectangle(size, 0.8 * size);
    for (size_t i = 1; i < ring.size(); ++i) add("G1 X%.3f Y%.3f\n", ring[i].x, ring[i].y);
  }
  add("G40 X%.3f\nM30\n", size + away);
  return all;
}

TEST(Terraces, AClosedLevelIsADepthOfItsOwn) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(300, 30);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double radius = number(1, 5), size = number(12, 20) * radius, step = number(0.2, 3) * radius;
    const auto levels = static_cast<unsigned>(2 + random() % 3);
    for (const bool pocket : {true, false})
      for (const Down down : {Down::plunge, Down::first_side, Down::round}) {
        const std::string program = terraces(pocket, size, step, levels, down, radius);
        EXPECT_EQ(alarm_of_terraces(program, radius), "") << "seed " << seed << (pocket ? " pocket" : " boss") << static_cast<int>(down) << "\n" << program;
      }
  }
}

// A wall that stands above the tip, since it has been cut before, is one: a lower contour that leads back under the terrace above it cuts that.
TEST(Terraces, ALowerContourCutsTheWallsAboveIt) {
  for (const Down down : {Down::plunge, Down::first_side, Down::round})
    for (const bool pocket : {true, false}) EXPECT_NE(alarm_of_terraces(terraces(pocket, 40, -1.5, 2, down, 3), 3), "") << pocket << static_cast<int>(down);
}

}  // namespace
}  // namespace nc::test
