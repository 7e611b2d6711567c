// SPDX-License-Identifier: Apache-2.0
// Terraces: closed contours on several levels under one G41, each below the one before (CONTOUR_CHECK). What is cut on a level is compared with the walls of that level and with those above
// it; a contour that has closed on its level is a depth of its own, and what lies below it, behind a ramp no less than behind a plunge, is no wall that it cuts.
#include <gtest/gtest.h>

#include <algorithm>
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
enum class Across { rapid, line, two_lines, way_in };

/// Rectangles, the first of half the size `first`, each of the others smaller by `step` (a pocket; of a boss larger), cut from the top down. From one to the next a rapid leads
/// over the terrace between them, or one or two lines in cutting feed; or it leads beyond that, and a line at right angles is the way in.
std::string terraces(bool pocket, double first, double step, unsigned count, Down down, double radius, Across across = Across::rapid, const char* last = nullptr) {
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
      if (across == Across::two_lines) add("G1 X%.3f\n", size - (pocket ? -step : step) / 2);
      add("%s X%.3f\n", across == Across::line || across == Across::two_lines ? "G1" : "G0", across == Across::way_in ? size + 1.5 * away : size);
      const double from = z;
      z -= 1.5;
      if (down == Down::plunge) add("G1 Z%.3f\n", z);
      if (across == Across::way_in) add("G1 X%.3f\n", size);
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
  if (last == nullptr)
    add("G40 X%.3f\nM30\n", size + away);
  else
    all += std::string(last) + "\nM30\n";
  return all;
}

TEST(Terraces, AClosedLevelIsADepthOfItsOwn) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(40, 10);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double radius = number(1, 5), size = number(12, 20) * radius, step = number(0.2, 3) * radius;
    const auto levels = static_cast<unsigned>(2 + random() % 3);
    for (const bool pocket : {true, false})
      for (const Down down : {Down::plunge, Down::first_side, Down::round}) {
        for (const Across across : {Across::rapid, Across::line, Across::two_lines, Across::way_in}) {
          const double room = across == Across::two_lines ? std::max(step, 2.1 * radius) : step;  // the corner at its end takes the radius from each of the two
          const std::string program = terraces(pocket, size, room, levels, down, radius, across);
          EXPECT_EQ(alarm_of_terraces(program, radius), "") << "seed " << seed << (pocket ? " pocket" : " boss") << static_cast<int>(down) << "\n" << program;
        }
      }
  }
}

// The last contour of some is no way out: one that leads through its sides is P153, also where it ends on the terrace outside of them.
TEST(Terraces, AWayOutThroughTheLastContourCutsIt) {
  for (const Across across : {Across::rapid, Across::line, Across::two_lines, Across::way_in})
    for (const Down down : {Down::plunge, Down::first_side})
      for (const char* const last : {"G40 X10. Y41.", "G40 X10. Y-41.", "G40 X-51. Y5."}) {
        const std::string program = terraces(true, 80, 40, 2, down, 4, across, last);
        EXPECT_NE(alarm_of_terraces(program, 4), "") << program;
      }
}

// From a disc that has been cut in two half circles the way to the other side leads through it, and the next level begins there: in the joint of the half circles, one of the first three behind
// the start. The contour has closed before, so nothing of it is a way in, whatever comes back to this joint later; and the machine stops in front of the line, not when all is cut.
TEST(Terraces, AWayThroughAContourThatHasClosedCutsIt) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(60, 10);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::round(1000 * std::uniform_real_distribution<double>(low, high)(random)) / 1000; };
    const double radius = number(1, 5), disc = number(2, 8) * radius, lead = number(1.05, 1.6) * radius, away = disc + 2 * radius;
    for (const bool round_it : {false, true}) {
      const auto word = [](char letter, double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%c%.3f ", letter, value);
        return std::string(text);
      };
      const double far = disc + lead;
      const std::string start = "G90 G17 G0 " + word('X', away) + "Y0\nG1 Z-1. F500\nG42 D1 " + word('X', disc) + "\n", halves = "G3 " + word('X', -disc) + word('I', -disc) + "\n" + word('X', disc) + word('I', disc) + "\n";
      const std::string way = "G2 " + word('X', far) + word('Y', lead) + word('I', lead) + "J0\n", across = (round_it ? "G3 " + word('R', -1.05 * far) : std::string("G1 ")) + word('X', -far) + word('Y', lead) + "\n";
      const std::string back = "G2 " + word('X', -disc) + "Y0 I0 " + word('J', -lead) + "\nG3 " + word('X', disc) + word('I', disc) + "\n" + word('X', -disc) + word('I', -disc) + "\nG1 G40 " + word('X', -away) + "\nM30\n";
      const std::string text = start + halves + way + across + "G1 Z-2.\n" + back;
      EXPECT_EQ(alarm_of_terraces(text, radius).substr(0, 7), round_it ? "" : "P153 L7") << "seed " << seed << "\n" << text;
    }
  }
}

// A second contour on the level of the first, larger and round it: the way to its first corner leads out of it again through its last side. It has closed when the cancel comes, so none of its
// sides is a way out.
TEST(Terraces, AWayThroughTheLastSideOfASecondContourCutsIt) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(60, 10);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const double radius = number(1, 4), size = number(4, 8) * radius, large = size + number(3.4, 4) * radius, lead = 1.5 * radius;
    const auto at = [](const char* code, double x, double y) {
      char block[80];
      std::snprintf(block, sizeof block, "%s X%.3f Y%.3f\n", code, x, y);
      return std::string(block);
    };
    const std::string in = at("G90 G17 G0", -size - 3 * lead, -size - lead) + "G1 Z-1. F500\n" + at("G41 D1", -size - lead, -size - lead) + at("G3", -size, -size) + "I0 J" + brief(lead) + "\n";
    const std::string first_ring = at("G1", -size, size) + at("", size, size) + at("", size, -size) + at("", -size, -size);
    const std::string way = at("", large, -large), second = at("", -large, -large) + at("", -large, large) + at("", large, large) + at("", large, -large);
    std::string program = in + first_ring + way + second + at("G40", large + 3 * radius, -large) + "M30\n";
    program.erase(program.find("\nI0"), 1);
    EXPECT_EQ(alarm_of_terraces(program, radius).substr(0, 4), "P153") << "seed " << seed << "\n" << program;
  }
}

/// A word of a program in mm.
std::string word(char letter, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%c%.3f ", letter, value);
  return text;
}

// Behind a square, on its level, a disc of one or two arcs: no turn of a way out, since the tool goes round its outside, or comes to it in a corner. A cancel through it is P153, one away from it is none.
TEST(Terraces, AWayThroughASecondContourOfArcsCutsIt) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(60, 10);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::round(1000 * std::uniform_real_distribution<double>(low, high)(random)) / 1000; };
    const double radius = number(1, 4), size = number(3, 8) * radius, disc = number(1.5, 5) * radius, lead = 1.2 * radius, center = size + disc + number(4.5, 9) * radius;
    const std::string start = "G90 G17 G0 " + word('X', -size - lead) + word('Y', -lead) + "\nG1 Z-1. F500\nG41 D1 " + word('Y', 0) + "\nG1 " + word('X', -size) + "\n";
    const std::string square = word('Y', size) + "\n" + word('X', size) + "\n" + word('Y', -size) + "\n" + word('X', -size) + "\nY0\n";
    for (const char* const link : {"G0 ", "G1 "})
      for (const bool halves : {false, true})
        for (const bool through : {false, true}) {
          const std::string way = link + word('Y', size + 3 * radius) + "\n" + word('X', center) + "\nG1 " + word('Y', disc) + "\n";
          const std::string ring = halves ? "G2 " + word('Y', -disc) + word('J', -disc) + "\n" + word('Y', disc) + word('J', disc) + "\n" : "G2 " + word('J', -disc) + "\n";
          const std::string text = start + square + way + ring + "G1 G40 " + word('Y', through ? -disc - 3 * radius : disc + 1.5 * radius) + "\nM30\n";
          EXPECT_EQ(alarm_of_terraces(text, radius).substr(0, 4), through ? "P153" : "") << "seed " << seed << "\n" << text;
        }
  }
}

// From one contour to another on its level lead up to three blocks in cutting feed, on it or above it: they are no walls, whatever the paths of the two come near to.
TEST(Terraces, ALinkBetweenTwoContoursOnOneLevelIsNoWall) {
  const uint64_t first_seed = wish("NC_FIRST_SEED", 1), count = seeds(60, 10);
  for (uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::round(1000 * std::uniform_real_distribution<double>(low, high)(random)) / 1000; };
    const double radius = number(1, 4), size = number(3, 8) * radius, lead = number(1.1, 2) * radius, far = 2 * size + number(4.5, 9) * radius;
    const auto square = [&](double x) { return "G1 " + word('X', x + size) + "\n" + word('Y', -size) + "\n" + word('X', x - size) + "\n" + word('Y', size) + "\n" + word('X', x) + "\n"; };
    const auto out = [&](double x) { return "G3 " + word('X', x + lead) + word('Y', size + lead) + word('J', lead) + "\n"; };
    const auto in = [&](double x, const char* up = "", const char* down = "") { return up + ("G1 " + word('X', x - lead)) + "\n" + down + "G3 " + word('X', x) + word('Y', size) + word('I', lead) + "\n"; };
    const std::string start = "G90 G17 G0 X0 " + word('Y', size + lead) + "\nG1 Z-1. F500\nG41 D1 " + in(0).substr(3);
    for (const bool above : {false, true}) {
      std::string text = start;
      for (unsigned k = 0; k < 3; ++k) text += (k == 0 ? "" : above ? in(k * far, "G1 Z5.\n", "G1 Z-1.\n") : in(k * far)) + square(k * far) + out(k * far);
      text += "G1 G40 " + word('X', 2 * far) + "\nM30\n";
      EXPECT_EQ(alarm_of_terraces(text, radius), "") << "seed " << seed << "\n" << text;
    }
  }
}

// A spike behind the start comes back to it, and is no contour: what lies behind it is an open profile, all of it walls.
TEST(Terraces, ASpikeBehindTheStartIsNoContour) {
  for (const char* const spike : {"X0.04\nX0\n", "Y0.04\nY0\n", "X5.\nX0\n", "X0.04 Y0.001\nX0 Y0\n", "X-0.04 Y0.02\nX-0.04 Y0\nX0\n", ""})
    for (const char* const profile : {"X60.\nX30. Y40.\nY-40.\n", "X60.\nX30. Y-40.\nY40.\n", "Y60.\nX60. Y30.\nX-60.\n"})
      for (const double radius : {1.0, 3.0}) {
        const std::string text = std::string("G90 G17 G0 X-20. Y20.\nG1 Z-1. F500\nG41 D1 X0 Y0\n") + spike + profile + "G40 X150.\nM30\n";
        EXPECT_EQ(alarm_of_terraces(text, radius).substr(0, 4), "P153") << text;
      }
}

// A wall that stands above the tip, since it has been cut before, is one: a lower contour that leads back under the terrace above it cuts that.
TEST(Terraces, ALowerContourCutsTheWallsAboveIt) {
  for (const Down down : {Down::plunge, Down::first_side, Down::round})
    for (const bool pocket : {true, false}) EXPECT_NE(alarm_of_terraces(terraces(pocket, 40, -1.5, 2, down, 3), 3), "") << pocket << static_cast<int>(down);
}

}  // namespace
}  // namespace nc::test
