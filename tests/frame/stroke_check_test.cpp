// SPDX-License-Identifier: Apache-2.0
// Stroke check before travel (M700 15.7), and stored stroke limits of an axis that is held (6.16).
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr const char* kBox = "G22 X60. Y60. Z60. I40. J40. K40.\n";

TEST(StrokeCheck, NoBlockEndsInTheArea) {
  const Outcome run = m700(std::string("G0 X50. Z50.\n") + kBox + "Y39.\nY50.\nX0\nM30");
  EXPECT_EQ(run.alarm, "P452");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.path(), (Path{"rapid 50 0 50", "rapid 50 39 50"}));  // nothing of the block has moved
}

TEST(StrokeCheck, NoBlockStartsInTheArea) {
  EXPECT_EQ(m700(std::string("G0 X50. Y50. Z50.\n") + kBox + "X0\nM30").alarm, "P452");
  EXPECT_EQ(m700(std::string("G0 X50. Y50. Z50.\n") + kBox + "G23\nX0\nM30").alarm, "");
}

TEST(StrokeCheck, TheBorderBelongsToTheArea) {
  EXPECT_EQ(m700(std::string(kBox) + "G0 X40. Y40. Z40.\nM30").alarm, "P452");
  EXPECT_EQ(m700(std::string(kBox) + "G0 X39.999 Y40. Z40.\nM30").alarm, "");
}

TEST(StrokeCheck, SameCoordinatesAreNotChecked) {  // (3)
  EXPECT_EQ(m700("G22 X60. I40.\nG0 X50. Y1000.\nM30").alarm, "P452");
  EXPECT_EQ(m700("G22 X60. I60.\nG0 X60.\nM30").alarm, "");
}

TEST(StrokeCheck, OmittedWordsAreZero) {  // (2)
  EXPECT_EQ(m700("G22 X60.\nG0 X30.\nM30").alarm, "P452");
  EXPECT_EQ(m700("G22 X60.\nG0 X-1.\nX61.\nM30").alarm, "P452");  // starts on the border, 0
  EXPECT_EQ(m700("G0 X-1.\nG22 X60.\nX61.\nM30").alarm, "");
  EXPECT_EQ(m700("G0 X-1.\nG22\nX61.\nM30").alarm, "");
}

TEST(StrokeCheck, MachineCoordinatesWithEveryCompensation) {  // (4)
  Bench bench;
  bench.work_offset(1, {100, 0, 0}).tool(1, 10);
  EXPECT_EQ(bench.run("G0 X0\nG22 X60. I40.\nX-50.\nM30").alarm, "P452");
  EXPECT_EQ(bench.at(0, 0, 0).run("G22 X-60. I-40.\nG0 X-50.\nM30").alarm, "");
  EXPECT_EQ(bench.run("G22 Z60. K40.\nG43 H1 G0 Z35.\nM30").alarm, "P452");
  EXPECT_EQ(bench.run("G49 G0 Z0\nG22 Z60. K40.\nG0 Z35.\nM30").alarm, "");
}

TEST(StrokeCheck, FollowsTheCompensatedPath) {
  Bench bench;
  bench.tool(1, 5);
  const std::string contour = "G1 G41 D1 X20. Y0 F100\nX40.\nY40.\nG40 X60.\nM30";
  EXPECT_EQ(bench.run("G22 Y6. J4.\n" + contour).alarm, "P452");  // the path runs along Y5
  EXPECT_EQ(bench.at(0, 0, 0).run("G22 Y4. J2.\n" + contour).alarm, "");
}

TEST(StrokeCheck, NotTowardsTheReferencePosition) {  // (6)
  Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.system[0].axis[0].reference[0] = 50; });
  EXPECT_EQ(bench.run("G22 X60. I40.\nG28 X0\nG29 X10.\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G22 X60. I40.\nG28 X45.\nM30").alarm, "P452");
  EXPECT_EQ(bench.at(0, 0, 0).run("G22 X60. I40.\nG53 X50.\nM30").alarm, "P452");
}

TEST(StrokeCheck, CodesAndWords) {
  const Outcome run = m700("G1 X1. F250\nG22 X60. Y60. Z60. I40. J40. K40.\nG23 X10. Y5.\nM30");  // (5)
  EXPECT_EQ(run.path(), (Path{"line 1 0 0 F250", "line 10 5 0 F250"}));
  EXPECT_EQ(run.last_modal().code[4], 230);
  EXPECT_EQ(m700("G22 X1. I0\nM30").last_modal().code[4], 220);
  EXPECT_EQ(m700("G22 X1. R5.\nM30").alarm, "P32");  // (7)
  EXPECT_EQ(Bench().run("G20\nG22 X2. I1.\nG21 G0 X30.\nM30").alarm, "P452");
  EXPECT_EQ(m700("G91 G22 X60. I40.\nG0 X50.\nM30").alarm, "P452");  // whatever G90 and G91 say
}

TEST(StrokeCheck, TurningAxis) {  // (8): examples (a) and (c), on the third basic axis
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system[0].axis[2].name = 'C';
    c.system[0].axis[2].rotary = true;
  });
  bench.param("1028", "C").param("8213", "0", 'C');
  EXPECT_EQ(bench.run("G22 C45. K315.\nG0 C44.\nC-44.\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 0).run("G22 C45. K315.\nG0 C-46.\nM30").alarm, "P452");
  EXPECT_EQ(bench.at(0, 0, 100).run("G22 C45. K-45.\nG0 C46.\nC314.\nM30").alarm, "");
  EXPECT_EQ(bench.at(0, 0, 100).run("G22 C45. K-45.\nG0 C316.\nM30").alarm, "P452");
  EXPECT_EQ(bench.at(0, 0, 100).run("G22 C45. K-45.\nG0 C720.\nM30").alarm, "P452");
}

TEST(StrokeLimit, HoldsForAnAxisThatIsHeld) {  // M700 6.16 (5)
  const auto limited = [](nc_config& c) {
    c.system[0].axis[1].soft_limited = true;
    c.system[0].axis[1].soft_min = -10;
    c.system[0].axis[1].soft_max = 10;
  };
  Bench bench(NC_DIALECT_M700, limited);
  EXPECT_EQ(bench.run("G7 Y0\nG1 X5. Y9. F100\nY-9.\nG7 Y1\nM30").alarm, "");
  EXPECT_EQ(bench.run("G7 Y0\nG1 X5. Y11. F100\nM30").alarm, "M01-0007");
  EXPECT_EQ(bench.at(0, 0, 0).run("G7 Y0\nG17 G2 X0 Y0 I0 J9. F100\nM30").alarm, "M01-0007");  // up to Y18 on the way
  EXPECT_EQ(bench.at(0, 0, 0).run("G7 Y0\nG17 G2 X0 Y0 I0 J4. F100\nM30").alarm, "");
}

}  // namespace
}  // namespace nc::test
