// SPDX-License-Identifier: Apache-2.0
// Positions that a program reads are whole units (M700 2.1), whatever was added up to get there, because programs compare them with decimal
// numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kOffsets[] = {0, -1149.974, -0.1, 33.3, 1234.567, -987.6543, 0.0007, -99999.9};

std::string decimal(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// Goes to each of `count` places, one unit apart, and counts in #100 where EQ does not hold, in #101 where NE does, in #102 GT, in #103
/// LT, in #104 where GE does not, in #105 where LE does not: six zeros are right.
std::string every_place(const std::string& head, unsigned count, int digits, double step, const std::string& variable) {
  static constexpr struct {
    const char* name;
    bool holds;
  } kComparisons[] = {{"EQ", true}, {"NE", false}, {"GT", false}, {"LT", false}, {"GE", true}, {"LE", true}};
  std::string text = head + "#100=0 #101=0 #102=0 #103=0 #104=0 #105=0\n";
  unsigned n = 1;
  for (unsigned i = 1; i <= count; ++i) {
    const std::string place = decimal(i * step, digits);
    text += "G1 Z" + place + " F1000\n";
    for (unsigned c = 0; c < 6; ++c) {
      const std::string right = std::to_string(n), counter = "#" + std::to_string(100 + c), wrong = std::to_string(n + 1);
      text += "IF [" + variable + " " + kComparisons[c].name + " " + place + "] GOTO " + (kComparisons[c].holds ? right : wrong) + "\n";
      if (!kComparisons[c].holds) text += "GOTO " + right + "\n";
      text += "N" + wrong + " " + counter + "=" + counter + "+1\nN" + right + "\n";
      n += 2;
    }
  }
  return text + "M30\n";
}

void expect_no_mistake(const Outcome& run, const std::string& what) {
  EXPECT_EQ(run.alarm, "") << what << ": " << run.alarm_detail;
  for (uint32_t c = 0; c < 6; ++c) EXPECT_EQ(run.var(100 + c), 0) << what << ", comparison " << c;
}

TEST(PositionRead, EveryThousandthComparesRightWithEveryOffset) {
  for (const double offset : kOffsets) {
    for (const char* variable : {"#5003", "#5043"}) {
      Bench bench;
      bench.work_offset(1, {0, 0, offset});
      const unsigned count = *variable == '#' && variable[3] == '0' ? 2000 : 400;  // #5043 waits for the machine each time
      expect_no_mistake(bench.run(every_place("G90 G94 G21 G54\n", count, 3, 0.001, variable), 1000, 1000000),
                        std::string(variable) + " G54 Z" + decimal(offset, 4));
    }
  }
}

TEST(PositionRead, EveryTenthousandthOfAnInch) {
  for (const double offset : kOffsets) {
    Bench bench;
    bench.work_offset(1, {0, 0, offset});
    expect_no_mistake(bench.run(every_place("G90 G94 G20 G54\n", 2000, 4, 0.0001, "#5003"), 1000, 1000000), "inch, G54 Z" + decimal(offset, 4));
  }
}

TEST(PositionRead, FinerUnits) {  // M700 2.1, #1003
  const char* const letters[] = {"C", "D", "E"};
  for (int finer = 1; finer <= 3; ++finer) {
    Bench bench;
    bench.param("1003", letters[finer - 1]).work_offset(1, {0, 0, -1149.974});
    expect_no_mistake(bench.run(every_place("G90 G94 G21 G54\n", 300, 3 + finer, std::pow(10, -3 - finer), "#5003"), 1000, 1000000), letters[finer - 1]);
  }
}

/// Two places that are one unit apart are different, over the whole range of positions.
TEST(PositionRead, NeighboursStayDifferent) {
  for (const char* unit : {"B", "C", "D", "E"}) {
    const int digits = 3 + (unit[0] - 'B');
    for (const double place : {0.0, 1.0, 999.0, 10000.0, 99998.0}) {
      Bench bench;
      bench.param("1003", unit).work_offset(1, {0, 0, -0.3});
      const std::string here = decimal(place, digits), next = decimal(place + std::pow(10, -digits), digits);
      const Outcome run = bench.run("G90 G21 G94\nG1 Z" + next + " F100\n#100=1\nIF [#5003 GT " + here + "] GOTO 1\n#100=2\nN1 IF [#5003 NE " + here +
                                    "] GOTO 2\n#100=3\nN2\nM30");
      EXPECT_EQ(run.alarm, "") << run.alarm_detail;
      EXPECT_EQ(run.var(100), 1) << unit << ' ' << here;
    }
  }
}

TEST(PositionRead, TheShopsBlock) {
  Bench bench;
  bench.work_offset(1, {0, 0, -1149.974});
  EXPECT_EQ(bench.run("G90 G54\nG01 Z0.2 F100\n#500=1\nIF[#5003GT0.2]GOTO9\n#500=2\nN9 M30").var(500), 2);
}

/// A reading is, to the last bit, the double that is nearest to the decimal number.
TEST(PositionRead, IsADecimalNumber) {
  Bench bench(NC_DIALECT_M700, [](nc_config& config) {
    config.system[0].axis_count = 4;
    config.system[0].axis[3].name = 'C';
    config.system[0].axis[3].rotary = true;
  });
  bench.work_offset(1, {-0.1, 7.7, -1149.974, 33.3}).tool(1, 123.456);
  bench.skip_at = [](const nc_item&) { return 1.0 / 3; };
  const Outcome run = bench.run(
      "G90 G54 G43 H1 G1 X0.3 Y-0.7 Z0.2 C0.1 F100\n"
      "#100=#5001 #101=#5002 #102=#5003 #103=#5004\n#104=#5021 #105=#5022 #106=#5023 #107=#5024\n#108=#5041 #109=#5042 #110=#5043 #111=#5044\n#112=#5083\n"
      "G31 X1. F10\n#113=#5061 #114=#5001\nM30");
  const double expected[] = {0.3, -0.7, 0.2, 0.1, 0.2, 7, -1026.318, 33.4, 0.3, -0.7, 123.656, 0.1, 123.456, 0.533, 0.533};
  for (uint32_t i = 0; i < sizeof expected / sizeof expected[0]; ++i) EXPECT_EQ(run.var(100 + i), expected[i]) << i;
}

/// A skip may come anywhere. A position in the middle of a unit is rounded away from zero, whatever offset was added.
TEST(PositionRead, IsRoundedHalfAwayFromZero) {
  for (const double offset : kOffsets) {
    Bench bench;
    bench.work_offset(1, {offset, 0, 0});
    const Outcome run = bench.run("G90 G54\nG1 X0.0005 F100\n#100=#5001\nX-0.0015\n#101=#5001\nX0.00049\n#102=#5001\nX-0.0004\n#103=#5001\nM30");
    EXPECT_EQ(run.var(100), 0.001) << offset;
    EXPECT_EQ(run.var(101), -0.002) << offset;
    EXPECT_EQ(run.var(102), 0) << offset;
    EXPECT_EQ(run.var(103), 0) << offset;
    EXPECT_FALSE(std::signbit(run.var(103))) << offset;
  }
}

TEST(PositionRead, ATurnEndsAtZero) {  // M700 14.13: 0 <= angle < 360
  for (const char* type : {"0", "1"}) {
    Bench bench(NC_DIALECT_M700, [](nc_config& config) {
      config.system[0].axis_count = 4;
      config.system[0].axis[3].name = 'C';
      config.system[0].axis[3].rotary = true;
    });
    bench.param("8213", type);
    const Outcome run = bench.run("G90 G1 C359.9996 F100\n#100=#5004 #101=#5024\nC359.999\n#102=#5004\nG91 C360.1\n#103=#5004\nM30");
    EXPECT_EQ(run.alarm, "") << run.alarm_detail;
    EXPECT_EQ(run.var(100), 0) << type;
    EXPECT_EQ(run.var(101), 0) << type;
    EXPECT_EQ(run.var(102), 359.999) << type;
    EXPECT_EQ(run.var(103), 0.099) << type;
  }
}

/// Rotated and scaled figures: the workpiece coordinates of the end point (M700 13.5.5), compared with those in long double.
TEST(PositionRead, RotatedAndScaledFrames) {
  constexpr long double kDegree = 3.14159265358979323846264338327950288L / 180;
  for (const double offset : kOffsets) {
    for (const int angle : {90, 30, 45, 180, 17}) {
      Bench bench;
      bench.work_offset(1, {offset, -offset, 0});
      std::string text = "G90 G54 G21\nG1 X0 Y0 F100\nG68 X0 Y0 R" + std::to_string(angle) + ".\n";
      for (int i = 1; i <= 20; ++i)
        text += "X" + decimal(i * 0.7, 3) + " Y0\n#" + std::to_string(100 + i) + "=#5001\n#" + std::to_string(500 + i) + "=#5002\n";
      const Outcome run = bench.run(text + "M30\n");
      ASSERT_EQ(run.alarm, "") << run.alarm_detail;
      for (int i = 1; i <= 20; ++i) {
        const long double x = i * 0.7L * std::cos(angle * kDegree), y = i * 0.7L * std::sin(angle * kDegree);
        EXPECT_EQ(run.var(100 + static_cast<uint32_t>(i)), std::strtod(decimal(static_cast<double>(x), 3).c_str(), nullptr) + 0.0) << angle << ' ' << i;
        EXPECT_EQ(run.var(500 + static_cast<uint32_t>(i)), std::strtod(decimal(static_cast<double>(y), 3).c_str(), nullptr) + 0.0) << angle << ' ' << i;
      }
    }
    Bench bench;
    bench.work_offset(1, {0, 0, offset});
    const Outcome run = bench.run("G90 G54 G21\nG1 X0 Y0 Z0 F100\nG51 X0 Y0 Z0 P1.1\nZ0.3\n#100=#5003\nZ0.7\n#101=#5003\nM30");
    EXPECT_EQ(run.var(100), 0.33) << offset;
    EXPECT_EQ(run.var(101), 0.77) << offset;
  }
}

/// Values that a program calculates and stores are not rounded; only comparisons ignore their last digits.
TEST(PositionRead, StoredValuesKeepTheirDigits) {
  const Outcome run = Bench().run("#100=1/3\n#500=0.1+0.2\n#101=1\nIF [#500 EQ 0.3] GOTO 1\n#101=2\nN1 IF [#100*3 NE 1] GOTO 2\n#101=#101+10\nN2 M30");
  EXPECT_EQ(run.var(100), 1.0 / 3);
  EXPECT_EQ(run.var(500), 0.1 + 0.2);
  EXPECT_EQ(run.var(101), 11);
}

TEST(PositionRead, LoopsThatCountInFractionsEndWhereTheyShould) {
  // 0.1 added up twenty times is 2.0000000000000004.
  EXPECT_EQ(Bench().run("#100=0 #101=0\nWHILE [#101 LT 2] DO1\n#101=#101+0.1 #100=#100+1\nEND1\nM30").var(100), 20);
  EXPECT_EQ(Bench().run("#100=0 #101=1\nWHILE [#101 GT 0] DO1\n#101=#101-0.1 #100=#100+1\nEND1\nM30").var(100), 10);
}

}  // namespace
}  // namespace nc::test
