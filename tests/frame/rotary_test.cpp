// SPDX-License-Identifier: Apache-2.0
// Rotary axis types (M700 14.13, #8213).
#include <gtest/gtest.h>

#include "frame/rotary.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

Bench with_rotary(const char* type, const std::function<void(nc_axis_config&)>& change = {}) {
  Bench bench(NC_DIALECT_M700, [&change](nc_config& c) {
    c.system[0].axis_count = 4;
    c.system[0].axis[3].name = 'C';
    c.system[0].axis[3].rotary = true;
    if (change) change(c.system[0].axis[3]);
  });
  bench.param("8213", type, 'C');
  return bench;
}

/// The workpiece and the machine position of C at the end of each block.
std::vector<std::pair<double, double>> counters(Bench& bench, const std::string& text) {
  std::vector<std::pair<double, double>> all;
  for (const Step& step : bench.run(text).steps) {
    if (step.item.kind != NC_ITEM_MARK) continue;
    nc_axes machine = step.machine, work = step.item.u.mark.work;
    nc_position_shown(bench.control(), 0, &machine, &work);
    all.emplace_back(work.v[3], machine.v[3]);
  }
  return all;
}

/// How far C turns in each move.
std::vector<double> turns(Bench& bench, const std::string& text) {
  std::vector<double> all;
  for (const nc_move& move : bench.run(text).moves()) all.push_back(move.machine.v[3] - move.machine_start.v[3]);
  return all;
}

constexpr const char* kPrinted = "G28 C0\nN1 G90 G0 C-270.\nN2 C405.\nN3 G91 C180.\nM30";
using Counters = std::vector<std::pair<double, double>>;

TEST(Rotary, PrintedExample) {
  Bench type0 = with_rotary("0"), type1 = with_rotary("1"), type2 = with_rotary("2"), type3 = with_rotary("3");
  EXPECT_EQ(counters(type0, kPrinted), (Counters{{0, 0}, {90, 90}, {45, 45}, {225, 225}, {225, 225}}));
  EXPECT_EQ(counters(type1, kPrinted), (Counters{{0, 0}, {90, 90}, {45, 45}, {225, 225}, {225, 225}}));
  EXPECT_EQ(counters(type2, kPrinted), (Counters{{0, 0}, {-270, 90}, {405, 45}, {585, 225}, {585, 225}}));
  EXPECT_EQ(counters(type3, kPrinted), (Counters{{0, 0}, {-270, -270}, {405, 405}, {585, 585}, {585, 585}}));
}

TEST(Rotary, WayOfAbsoluteCommands) {
  Bench type0 = with_rotary("0"), type1 = with_rotary("1"), type2 = with_rotary("2");
  // Without the shortest way: the remainder of the difference, with its sign.
  EXPECT_EQ(turns(type0, "G0 C-270.\nC405.\nC10.\nC350.\nM30"), (std::vector<double>{-270, 315, -35, 340}));
  // With it: at most half a turn.
  EXPECT_EQ(turns(type1, "G0 C-270.\nC405.\nC350.\nC10.\nC190.\nC10.\nM30"), (std::vector<double>{90, -45, -55, 20, 180, 180}));
  EXPECT_EQ(turns(type2, "G0 C-270.\nC405.\nM30"), (std::vector<double>{-270, 675}));
}

TEST(Rotary, IncrementsAreTakenAsTheyAre) {
  for (const char* type : {"0", "1", "2", "3"}) {
    Bench bench = with_rotary(type);
    EXPECT_EQ(turns(bench, "G91 G0 C725.\nC-360.\nM30"), (std::vector<double>{725, -360})) << type;
  }
}

TEST(Rotary, ReferenceReturnTurnsByLessThanATurn) {  // 14.13: the last row of the table
  Bench type0 = with_rotary("0"), type1 = with_rotary("1"), type2 = with_rotary("2"), type3 = with_rotary("3");
  EXPECT_EQ(turns(type0, "G91 G0 C585.\nG28 C0\nM30"), (std::vector<double>{585, -225}));
  EXPECT_EQ(turns(type1, "G91 G0 C585.\nG28 C0\nM30"), (std::vector<double>{585, 135}));
  EXPECT_EQ(turns(type2, "G91 G0 C585.\nG28 C0\nM30"), (std::vector<double>{585, -225}));
  EXPECT_EQ(turns(type3, "G91 G0 C585.\nG28 C0\nM30"), (std::vector<double>{585, -585}));
  EXPECT_EQ(turns(type0, "G91 G0 C585.\nG90 G28 C100.\nG29 C90.\nM30"), (std::vector<double>{585, -125, -100, 100, -10}));
}

TEST(Rotary, MachineCoordinates) {
  Bench type0 = with_rotary("0"), type1 = with_rotary("1"), type2 = with_rotary("2"), type3 = with_rotary("3");
  const char* text = "G91 G0 C710.\nG90 G53 C10.\nM30";  // shown: 350
  EXPECT_EQ(turns(type0, text), (std::vector<double>{710, -340}));
  EXPECT_EQ(turns(type1, text), (std::vector<double>{710, 20}));
  EXPECT_EQ(turns(type2, text), (std::vector<double>{710, -340}));
  EXPECT_EQ(turns(type3, text), (std::vector<double>{710, -700}));
}

TEST(Rotary, CoordinatesOfSystemsAndVariables) {
  Bench bench = with_rotary("0");
  bench.work_offset(1, {0, 0, 0, 90});
  const Outcome run = bench.run("G0 C30.\n#100=#5004\n#101=#5024\n#102=#5044\nG91 C350.\n#103=#5004\nG90 G92 C5.\n#104=#5004\nC0\n#105=#5024\nM30");
  EXPECT_NEAR(run.var(100), 30, 1e-9);
  EXPECT_NEAR(run.var(101), 120, 1e-9);
  EXPECT_NEAR(run.var(102), 30, 1e-9);
  EXPECT_NEAR(run.var(103), 20, 1e-9);
  EXPECT_NEAR(run.var(104), 5, 1e-9);
  EXPECT_NEAR(run.var(105), 105, 1e-9);
}

TEST(Rotary, ReferenceCheckKnowsWholeTurns) {
  Bench bench = with_rotary("1");
  EXPECT_EQ(bench.run("G91 G0 C700.\nG90 G27 C0\nM30").alarm, "");
  EXPECT_EQ(bench.run("G91 G0 C700.\nG90 G27 C1.\nM30").alarm, "P434");
}

TEST(Rotary, StrokeLimitsHoldWithinOneTurn) {
  const auto limited = [](nc_axis_config& axis) {
    axis.soft_limited = true;
    axis.soft_min = -30;
    axis.soft_max = 200;
  };
  Bench turning = with_rotary("0", limited);
  EXPECT_EQ(turning.run("G0 C200.\nC340.\nM30").alarm, "M01-0007");
  EXPECT_EQ(turning.run("G0 C100.\nG91 C-130.\nM30").alarm, "");
  EXPECT_EQ(turning.run("G0 C100.\nG91 C-131.\nM30").alarm, "M01-0007");
  Bench free = with_rotary("0", [](nc_axis_config& axis) {
    axis.soft_limited = true;
    axis.soft_min = -1;
    axis.soft_max = 100000;
  });
  EXPECT_EQ(free.run("G0 C200.\nG91 C350.\nC350.\nM30").alarm, "");
}

TEST(Rotary, OneTurn) {
  EXPECT_EQ(within_one_turn(0), 0);
  EXPECT_EQ(within_one_turn(360), 0);
  EXPECT_EQ(within_one_turn(-90), 270);
  EXPECT_EQ(within_one_turn(359.999), 359.999);
  EXPECT_EQ(within_one_turn(-1e-13), 0);
  for (double a = -2000; a < 2000; a += 37.125) {
    EXPECT_GE(within_one_turn(a), 0);
    EXPECT_LT(within_one_turn(a), 360);
    EXPECT_NEAR(std::remainder(within_one_turn(a) - a, 360), 0, 1e-9);
    for (double b = 0; b < 360; b += 22.5) {
      EXPECT_LT(std::fabs(turn_to(a, b, false)), 360);
      EXPECT_LE(std::fabs(turn_to(a, b, true)), 180);
      EXPECT_NEAR(std::remainder(b + turn_to(a, b, true) - a, 360), 0, 1e-9);
      EXPECT_GE(turn_to(a, b, false) * (a - b), 0);
    }
  }
}

TEST(Rotary, OnlyTypesThatExist) {
  Bench bench = with_rotary("0");
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "8213", 'C', "4"), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
