// SPDX-License-Identifier: Apache-2.0
// Special fixed cycles (M700 13.2).
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/pattern.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kTolerance_mm = 1e-9;

/// Where the tool stands at the bottom of each hole, in order.
std::vector<std::array<double, 2>> bottoms(const Outcome& run, double level) {
  std::vector<std::array<double, 2>> all;
  for (const nc_move& move : run.moves())
    if (move.kind == NC_MOVE_LINE && move.machine.v[2] == level) all.push_back({move.machine.v[0], move.machine.v[1]});
  return all;
}

Outcome holes(const std::string& pattern, const std::string& before = "") {
  return Bench().at(0, 0, 20).run("G0 G90\n" + before + "G98 G81 Z-8. R3. L0 F150\n" + pattern + "\nG80\nM30");
}

void expect_holes(const Outcome& run, const std::vector<std::array<double, 2>>& wanted) {
  ASSERT_EQ(run.alarm, "");
  const auto got = bottoms(run, -8);
  ASSERT_EQ(got.size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(got[i][0], wanted[i][0], kTolerance_mm) << i;
    EXPECT_NEAR(got[i][1], wanted[i][1], kTolerance_mm) << i;
  }
}

TEST(Pattern, CircleG34) {  // the example of 13.2 and the other way round
  for (const int sense : {1, -1}) {
    std::vector<std::array<double, 2>> wanted;
    for (int i = 0; i < 6; ++i) {
      const double angle = (20 + sense * 60 * i) * M_PI / 180;
      wanted.push_back({200 + 100 * std::cos(angle), 100 + 100 * std::sin(angle)});
    }
    expect_holes(holes("G34 X200. Y100. I100. J20. K" + std::to_string(6 * sense)), wanted);
  }
  expect_holes(holes("G34 X0 Y0 I5. K4"), {{5, 0}, {0, 5}, {-5, 0}, {0, -5}});  // J omitted: 0
  expect_holes(holes("G34 X1. Y2. I5. J90000 K1"), {{1, 7}});                   // without a point J counts in 0.001 deg
}

TEST(Pattern, LineG35) {
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  expect_holes(holes("G35 X200. Y100. I100. J30. K3"), {{200, 100}, {200 + 100 * c, 100 + 100 * s}, {200 + 200 * c, 100 + 200 * s}});
  expect_holes(holes("G35 X200. Y100. I-100. J30. K2"), {{200, 100}, {200 - 100 * c, 100 - 100 * s}});
  expect_holes(holes("G35 X1. Y1. I1. J0 K10002"), {{1, 1}, {2, 1}});  // note 2: the last four digits
}

TEST(Pattern, ArcG36) {
  const auto at = [](double degrees) { return std::array<double, 2>{300 + 300 * std::cos(degrees * M_PI / 180), 100 + 300 * std::sin(degrees * M_PI / 180)}; };
  expect_holes(holes("G36 X300. Y100. I300. J10. P15. K3"), {at(10), at(25), at(40)});
  expect_holes(holes("G36 X300. Y100. I300. J10. P-15000 K3"), {at(10), at(-5), at(-20)});
}

TEST(Pattern, GridG371) {  // to and fro
  expect_holes(holes("G37.1 X10. Y20. I5. P3 J-2. K2"), {{10, 20}, {15, 20}, {20, 20}, {20, 18}, {15, 18}, {10, 18}});
  expect_holes(holes("G37.1 X10. Y20. P1 J-2. K2"), {{10, 20}, {10, 18}});  // one column has no interval
}

TEST(Pattern, CentreByIncrementAndWithoutWords) {  // "X, Y: this will be affected by G90/G91"
  const Outcome run = Bench().at(10, 20, 20).run("G0 G91\nG98 G81 Z-11. R-17. L0 F150\nG34 X5. Y-5. I5. K2\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  ASSERT_EQ(bottoms(run, -8).size(), 2U);
  EXPECT_NEAR(bottoms(run, -8)[0][0], 20, kTolerance_mm);
  EXPECT_NEAR(bottoms(run, -8)[1][0], 10, kTolerance_mm);
  expect_holes(holes("X7. Y8.\nG98 G81 Z-8. R3. L0\nG34 I5. K1", ""), {{7, 8}, {12, 8}});  // where the tool stands: the first is that of X Y
}

TEST(Pattern, TheCycleStaysAndThePatternDoesNot) {
  expect_holes(holes("G35 X10. Y0 I5. K2\nX50."), {{10, 0}, {15, 0}, {50, 0}});
}

TEST(Pattern, PlanesFollowTheirAxes) {
  const Outcome run = Bench().at(0, 20, 0).run("G0 G18\nG98 G81 Y-8. R3. L0 F150\nG35 X1. Z2. I5. J90. K2\nG80\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path().at(2), "line 1 -8 2 F150");
  EXPECT_EQ(run.path().at(6), "line 6 -8 2 F150");  // the angle counts from Z to X
}

TEST(Pattern, RotationTurnsIt) {  // 13.20
  expect_holes(holes("G35 X10. Y0 I5. K2", "G68 X0 Y0 R90.\n"), {{0, 10}, {0, 15}});
}

TEST(Pattern, WithoutACyclePositionsByTheMotionInForce) {
  EXPECT_EQ(m700("G0 G90\nG35 X10. Y0 I5. J0 K2\nM30").path(), (Path{"rapid 10 0 0", "rapid 15 0 0"}));
  EXPECT_EQ(m700("G1 F50 G90\nG35 X10. Y0 I5. J0 K2\nM30").path(), (Path{"line 10 0 0 F50", "line 15 0 0 F50"}));
  EXPECT_EQ(m700("G1 G90\nG35 X10. Y0 I5. J0 K2\nM30").alarm, "P62");
  const Outcome many = m700("G0 G90\nG37.1 X0 Y0 I1. P100 J1. K50\nM30");  // more than any queue holds
  EXPECT_EQ(many.alarm, "");
  EXPECT_EQ(many.moves().size(), 4999U);
}

TEST(Pattern, SharesItsBlock) {  // notes 4 and 5
  expect_holes(holes("G35 G81 X10. Y0 I5. K1"), {{10, 0}});
  expect_holes(holes("G37.1 G23 X10. Y0 P1 K1"), {{10, 0}});
  expect_holes(holes("G22 G37.1 X10. Y0 P1 K1"), {{10, 0}});
  expect_holes(holes("G37.1 G22 X10. Y0 P1 K1"), {{10, 0}});
  EXPECT_EQ(Bench().at(3, 4, 20).run("G35 G28 X10. Y0 I5. J0 K2\nM30").path(), (Path{"rapid 10 0 20", "rapid 0 0 20"}));
  EXPECT_EQ(Bench().at(3, 4, 20).run("G0 G28 G35 X10. Y0 I5. J0 K1\nM30").path(), (Path{"rapid 10 0 20"}));
}

TEST(Pattern, MCodesGoOutOnce) { EXPECT_EQ(holes("G35 X10. Y0 I5. K3 M8").aux(), "M8 M30"); }

TEST(Pattern, Alarms) {
  const struct {
    const char* block;
    const char* alarm;
  } kRows[] = {
      {"G34 X0 Y0 I5. K0", "P221"},     {"G34 X0 Y0 I5.", "P221"},        {"G35 X0 Y0 I5. K0", "P221"},    {"G35 X0 Y0 I5.", "P221"},
      {"G35 X0 Y0 I5. K10000", "P221"}, {"G36 X0 Y0 I5. P10. K0", "P221"}, {"G37.1 X0 Y0 I5. P0 J5. K2", "P221"},
      {"G37.1 X0 Y0 I5. P2 J5.", "P221"}, {"G37.1 X0 Y0 I5. J5. K2", "P221"}, {"G36 X0 Y0 I5. P0 K2", "P222"}, {"G36 X0 Y0 I5. K2", "P222"},
      {"G34 X0 Y0 K4", "P33"},          {"G35 X0 Y0 K4", "P33"},          {"G37.1 X0 Y0 P2 J5. K2", "P33"}, {"G37.1 X0 Y0 P2 I5. K2", "P33"},
      {"G34 X0 Y0 I0 K4", "P35"},       {"G34 X0 Y0 I-5. K4", "P35"},     {"G36 X0 Y0 I-5. P10. K4", "P35"}, {"G34 X0 Y0 I5. K10000", "P35"},
      {"G35 X0 Y0 I5. K-1", "P35"},     {"G34 X0 Y0 I5. K4 Z1.", "P32"},  {"G35 X0 Y0 I5. K4 R1.", "P32"}, {"G36 X0 Y0 I5. P10. K4 Q1.", "P32"},
      {"G37.1 X0 Y0 I5. P2 J5. K2 L2", "P32"}, {"G34 X0 Y0 I5. K4 D1", "P32"}, {"G34 X0 Y0 I5. K4 T1", "P32"}, {"G34 X0 Y0 I5. K4 H1 S100 M8", ""},
  };
  for (const auto& row : kRows) EXPECT_EQ(holes(row.block).alarm, row.alarm) << row.block;
}

}  // namespace
}  // namespace nc::test
