// SPDX-License-Identifier: Apache-2.0
// The rules of a family that are functions, and the table of the data that data setting (G10) can set.
#include <gtest/gtest.h>

#include <cmath>

#include "dialect/dialect.hpp"

namespace nc {
namespace {

const Rules& rules_of(nc_dialect id) { return dialect(id).rules; }

TEST(Rules, SpeedIsTheValueOrACodeOfTheSeries) {
  const auto m700 = rules_of(NC_DIALECT_M700).spindle.speed_of_word;
  for (const uint32_t s : {0u, 1u, 60u, 99u, 100u, 99999999u}) EXPECT_DOUBLE_EQ(m700(s), s);
  const auto dgshape = rules_of(NC_DIALECT_DGSHAPE).spindle.speed_of_word;
  // The manual's table of numerical S codes, read by hand.
  const struct {
    uint32_t code;
    double speed;
  } kPrinted[] = {{0, 1}, {1, 1.12}, {19, 9}, {20, 10}, {40, 100}, {60, 1000},
                  {65, 1800}, {80, 10000}, {98, 80000}};
  for (const auto& row : kPrinted) EXPECT_NEAR(dgshape(row.code), row.speed, 1e-9 * row.speed) << row.code;
  for (uint32_t code = 0; code < 100; ++code)  // the series is 10^(n/20), its rounding at most 2 %
    EXPECT_NEAR(dgshape(code) / std::pow(10, code / 20.0), 1, 0.02) << code;
  EXPECT_DOUBLE_EQ(dgshape(100), 100);  // from here on the code is the speed in r/min
  EXPECT_DOUBLE_EQ(dgshape(12345), 12345);
}

// M700 alone has the management of tool lives (10.15).
TEST(Rules, OnlyAFamilyThatManagesTheLivesOfToolsHasANumberForTheOneInTheSpindle) {
  for (const nc_dialect id : {NC_DIALECT_M700, NC_DIALECT_DGSHAPE, NC_DIALECT_ISO, NC_DIALECT_HX, NC_DIALECT_SERIES8})
    EXPECT_EQ(rules_of(id).compensation.number_of_managed_tool, id == NC_DIALECT_M700 ? 99u : 0u) << id;
}

TEST(Rules, ScalingFactorIsRefusedOrHeld) {
  const auto m700 = rules_of(NC_DIALECT_M700).scaling.factor_of_word;
  double factor = 0;
  const RangeRules &millionths = rules_of(NC_DIALECT_M700).range, &thousandths = rules_of(NC_DIALECT_DGSHAPE).range;
  EXPECT_TRUE(m700(500000, false, millionths, &factor));
  EXPECT_DOUBLE_EQ(factor, 0.5);
  EXPECT_TRUE(m700(0.5, true, millionths, &factor));
  EXPECT_DOUBLE_EQ(factor, 0.5);
  EXPECT_TRUE(m700(99999999, false, millionths, &factor));
  EXPECT_FALSE(m700(100, true, millionths, &factor));
  EXPECT_FALSE(m700(0, false, millionths, &factor));
  const auto dgshape = rules_of(NC_DIALECT_DGSHAPE).scaling.factor_of_word;
  for (const bool pointed : {false, true}) {
    EXPECT_TRUE(dgshape(2, pointed, thousandths, &factor));
    EXPECT_DOUBLE_EQ(factor, 2);
    EXPECT_TRUE(dgshape(0, pointed, thousandths, &factor));
    EXPECT_DOUBLE_EQ(factor, 0.001);
    EXPECT_TRUE(dgshape(1000, pointed, thousandths, &factor));
    EXPECT_DOUBLE_EQ(factor, 999.999);
  }
}

TEST(Rules, EachLSetsOneThing) {
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    const Dialect& family = dialect(static_cast<nc_dialect>(id));
    const bool sets = [&family] {
      for (const FunctionRow& row : family.functions)
        if (row.function == Function::data_input) return true;
      return false;
    }();
    EXPECT_EQ(family.data_input.size != 0, sets) << family.name;
    for (const DataInputRow& row : family.data_input) {
      unsigned same = 0;
      for (const DataInputRow& other : family.data_input) same += row.l == other.l ? 1u : 0u;
      EXPECT_EQ(same, 1u) << family.name << " L" << row.l;
    }
  }
}

}  // namespace
}  // namespace nc
