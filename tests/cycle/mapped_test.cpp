// SPDX-License-Identifier: Apache-2.0
// Every cycle and pattern in mirror image, rotation and scaling of the program (M700 13.6, 13.19, 13.20): each stroke ends where the map takes the end of the
// stroke that is made without it, and nothing else changes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

using Place = std::array<double, 3>;

struct Map {
  const char* on;
  const char* off;
  Place (*of)(const Place&);
};
constexpr Map kMaps[] = {
    {"G51.1 X3.", "G50.1", [](const Place& p) { return Place{6 - p[0], p[1], p[2]}; }},
    {"G51.1 X0 Y1.", "G50.1", [](const Place& p) { return Place{-p[0], 2 - p[1], p[2]}; }},
    {"G68 X1. Y2. R90.", "G69", [](const Place& p) { return Place{1 - (p[1] - 2), 2 + (p[0] - 1), p[2]}; }},
    {"G68 X0 Y0 R30.", "G69", [](const Place& p) { return Place{p[0] * std::cos(M_PI / 6) - p[1] / 2, p[0] / 2 + p[1] * std::cos(M_PI / 6), p[2]}; }},
    {"G51 X1. Y1. P2.", "G50", [](const Place& p) { return Place{2 * p[0] - 1, 2 * p[1] - 1, p[2]}; }},
};

struct Run {
  std::vector<Place> ends;
  std::string aux, alarm;
  std::vector<double> dwells;
  size_t stops = 0;
};

Run run(const std::string& text) {
  Bench bench;
  const Outcome out = bench.param("8013", "0.5").param("8012", "0.3").tool(7, 1).at(0, 0, 20).run(text);
  Run all{{}, out.aux(), out.alarm, out.dwells(), 0};
  for (const nc_move& move : out.moves()) all.ends.push_back({move.machine.v[0], move.machine.v[1], move.machine.v[2]});
  for (const Step& step : out.steps) all.stops += step.item.kind == NC_ITEM_MARK && step.item.u.mark.stop ? 1u : 0u;
  return all;
}

/// `beside`: how far beside a hole a stroke goes that is shifted; the spindle stands oriented, so the map does not turn it.
void compare(const std::string& holes, const Map& map, const Place& beside = {}) {
  // The first block goes to the same programmed place in both.
  const std::string place = "G0 X5. Y7.\n", end = "\nG80\n";
  const Run plain = run("S600\nM3\n" + place + holes + end + "G4 P1\nM30");
  const Run mapped = run(std::string("S600\nM3\n") + map.on + "\n" + place + holes + end + map.off + "\nM30");
  ASSERT_EQ(plain.alarm, "") << holes;
  ASSERT_EQ(mapped.alarm, "") << map.on << "\n" << holes;
  ASSERT_EQ(mapped.ends.size(), plain.ends.size()) << map.on << "\n" << holes;
  Place hole = {NAN, NAN, NAN};
  unsigned shifted = 0;
  for (size_t i = 0; i < plain.ends.size(); ++i) {
    const Place& stroke = plain.ends[i];
    const bool out = std::hypot(stroke[0] - hole[0] - beside[0], stroke[1] - hole[1] - beside[1]) < 1e-9;
    if (!out) hole = stroke;
    shifted += out ? 1u : 0u;
    Place wanted = map.of(out ? Place{hole[0], hole[1], stroke[2]} : stroke);
    for (unsigned axis = 0; out && axis < 3; ++axis) wanted[axis] += beside[axis];
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(mapped.ends[i][axis], wanted[axis], 1e-9) << map.on << "\n" << holes << "\nmove " << i << " axis " << axis;
  }
  EXPECT_EQ(mapped.aux, plain.aux) << map.on << "\n" << holes;
  EXPECT_TRUE(beside == Place{} || shifted > 0) << holes;
}

const char* const kCycles[] = {"G73 Q2. P100", "G74 P100 ,R0", "G81", "G82 P100", "G83 Q2.", "G84 ,R0", "G85", "G86", "G88", "G89 P100"};

TEST(Mapped, EveryCycle) {
  for (const Map& map : kMaps)
    for (const char* cycle : kCycles)
      for (const char* level : {"G98 ", "G99 "}) compare(std::string(level) + cycle + " X12. Y3. Z-5. R2. F100\nX15.5\nY-4. L2\nG91 X1. Y2. Z-6. R-17. L3\nG90", map);
}

TEST(Mapped, TheShiftOfABoreIsThatOfTheOrientedSpindle) {
  for (const Map& map : kMaps) {
    for (const char* level : {"G98 ", "G99 "}) compare(std::string(level) + "G76 I1. J-0.5 X12. Y3. Z-5. R2. F100\nX15.5\nY-4. L2\nG91 X1. Y2. Z-6. R-17. L3\nG90", map, {1, -0.5, 0});
    compare("G98 G87 X12. Y3. Z-3. R-6. I1. J0.5 F100\nX15.", map, {1, 0.5, 0});
  }
}

TEST(Mapped, EveryPattern) {
  for (const Map& map : kMaps)
    for (const char* pattern : {"G34 X10. Y4. I6. J15. K5", "G35 X10. Y4. I3. J20. K4", "G36 X10. Y4. I8. J10. P25. K4", "G37.1 X10. Y4. I3. P3 J-2. K2"})
      compare(std::string("G99 G81 Z-5. R2. F100 L0\n") + pattern, map);
}

// ---- what else may stand in the mode of a cycle

TEST(InTheMode, CodesAndShiftsBetweenTheHoles) {
  Bench bench;
  const Outcome run = bench.work_offset(2, {100, 0, 0}).at(0, 0, 20).run("G54 G0 X0 Y0\nG99 G81 X1. Z-5. R2. F100 M8\nM9\nG4 P500\nG55\nX2.\nG52 X10.\nX3.\nG52 X0\nG54 X4. M3\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.aux(), "M8 M9 M3 M30");
  EXPECT_EQ(run.dwells(), std::vector<double>{0.5});
  std::vector<double> bottoms;
  for (const nc_move& move : run.moves())
    if (move.machine.v[2] == -5) bottoms.push_back(move.machine.v[0]);
  EXPECT_EQ(bottoms, (std::vector<double>{1, 102, 113, 4}));
}

TEST(InTheMode, G60GoesOverTheHoleInItsDirection) {  // 6.8 (7), (8)
  const auto path = [](const char* text) {
    Bench bench;
    return bench.param("8209", "2").at(0, 0, 10).run(std::string("G0 Y0\n") + text + "\nG80\nM30").path();
  };
  const Path first{"rapid 3 -2 10", "rapid 5 0 10", "rapid 5 0 1", "line 5 0 -5 F100", "rapid 5 0 10"};
  EXPECT_EQ(path("G60 G81 X5. Y0 Z-5. R1. F100"), first);
  Path both = first;
  for (const char* step : {"rapid 6 0 10", "rapid 8 0 10", "rapid 8 0 1", "line 8 0 -5 F100", "rapid 8 0 10"}) both.push_back(step);
  EXPECT_EQ(path("G60 G81 X5. Y0 Z-5. R1. F100\nG60 X8."), both);
}

TEST(InTheMode, AMacroThatIsCalledMakesHolesAndTheModeGoesOn) {
  Bench bench;
  bench.add("O7", "G35 X#24 Y0 I2. J90. K2\nX50.\nM99\n");
  const Outcome run = bench.at(0, 0, 20).run("G0\nG99 G81 Z-5. R2. F100 L0\nG65 P7 X10.\nX60.\nM98 P7\nG80\nM30");
  std::vector<std::pair<double, double>> bottoms;
  for (const nc_move& move : run.moves())
    if (move.machine.v[2] == -5) bottoms.emplace_back(move.machine.v[0], move.machine.v[1]);
  const std::vector<std::pair<double, double>> first{{10, 0}, {10, 2}, {50, 2}, {60, 2}};
  ASSERT_GE(bottoms.size(), first.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(bottoms[i].first, first[i].first, 1e-9) << i;
    EXPECT_NEAR(bottoms[i].second, first[i].second, 1e-9) << i;
  }
}

TEST(InTheMode, ACancelledCycleInASubprogramStaysCancelled) {
  Bench bench;
  bench.add("O7", "G80\nM99\n");
  const Outcome run = bench.at(0, 0, 20).run("G0\nG99 G81 X1. Z-5. R2. F100\nM98 P7\nX9.\nG0 Z20.\nM30");
  EXPECT_EQ(run.alarm, "");
  unsigned holes = 0;
  for (const nc_move& move : run.moves()) holes += move.machine.v[2] == -5 ? 1u : 0u;
  EXPECT_EQ(holes, 1U);
}

}  // namespace
}  // namespace nc::test
