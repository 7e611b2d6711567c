// SPDX-License-Identifier: Apache-2.0
// What shares a block and what a mode bars: the rows that all families have in common, and those that one has of its own.
#include "dialect/precedence.hpp"

#include <gtest/gtest.h>

#include <set>

#include "dialect/default_precedence.hpp"
#include "dialect/dialect.hpp"

namespace nc {
namespace {

const Dialect& m700() { return dialect(NC_DIALECT_M700); }

TEST(Precedence, BarredByModesInEveryFamily) {  // M700 6.12, 6.14 (a), 13.3.3
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    const Dialect& family = dialect(static_cast<nc_dialect>(id));
    EXPECT_EQ(barred(family, kInPolarCommand, Function::high_speed_accuracy), Condition::illegal_g);
    EXPECT_EQ(barred(family, kInPolarCommand, Function::high_speed), Condition::none);
    EXPECT_EQ(barred(family, kInSpaceArc, Function::high_speed), Condition::illegal_g);
    EXPECT_EQ(barred(family, kInSpaceArc, Function::macro_modal_off), Condition::cancel_without_call);
    EXPECT_EQ(barred(family, kInSpaceArc, Function::cycle_off), Condition::none);
    EXPECT_EQ(barred(family, kInSpaceArc, Function::cycle_bore_stop), Condition::space_arc_mode);
    EXPECT_EQ(barred(family, kInFigure, Function::rotation_off), Condition::rotation_in_figure);
    EXPECT_EQ(barred(family, kInFigure | kInSpaceArc, Function::linear), Condition::none);
    EXPECT_EQ(barred(family, 0, Function::rotation_on), Condition::none);
  }
}

/// The rows by which families differ belong to the family that has them.
TEST(Precedence, BarredInOneFamilyAlone) {
  for (const nc_dialect id : {NC_DIALECT_DGSHAPE, NC_DIALECT_SERIES8}) {  // DGSHAPE G40-G42
    EXPECT_EQ(barred(dialect(id), kInCompensation, Function::scaling_on), Condition::not_in_compensation);
    EXPECT_EQ(barred(dialect(id), kInCompensation, Function::scaling_off), Condition::not_in_compensation);
    EXPECT_EQ(barred(dialect(id), kInCompensation, Function::cycle_off), Condition::cycle_in_compensation);
    EXPECT_EQ(barred(dialect(id), kInMap, Function::scaling_on), Condition::none);
  }
  const Function returns[] = {Function::reference_check, Function::reference_return, Function::start_return, Function::second_reference, Function::coordinate_set};
  for (const Function function : returns) {  // HX 15.2.2, 15.4.2
    EXPECT_EQ(barred(dialect(NC_DIALECT_HX), kInMap, function), Condition::not_accepted);
    EXPECT_EQ(barred(dialect(NC_DIALECT_HX), kInCompensation, function), Condition::none);
    EXPECT_EQ(barred(m700(), kInMap, function), Condition::none);
  }
  for (const nc_dialect id : {NC_DIALECT_M700, NC_DIALECT_ISO, NC_DIALECT_HX})
    for (unsigned f = 0; f < static_cast<unsigned>(Function::count_); ++f)
      EXPECT_EQ(barred(dialect(id), kInCompensation, static_cast<Function>(f)), Condition::none) << f;
}

TEST(Precedence, RowsOfAFamilyStandBeforeThoseOfAll) {
  constexpr Function f = Function::dwell;
  ASSERT_EQ(precedence_of(m700(), f).length, Precedence::ignored);
  constexpr PrecedenceRow kRow[] = {{f, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both}};
  constexpr BarredRow kBars[] = {{kInSpaceArc, Function::comp_left, Condition::not_accepted, "1"}, {kInMap, f, Condition::not_accepted, "1"}};
  Dialect family = m700();
  family.precedence = kRow;
  family.barred = kBars;
  EXPECT_EQ(precedence_of(family, f).length, Precedence::both);
  EXPECT_EQ(precedence_of(family, Function::data_input).length, Precedence::ignored);
  EXPECT_EQ(barred(family, kInSpaceArc, Function::comp_left), Condition::not_accepted);
  EXPECT_EQ(barred(family, kInSpaceArc, Function::comp_right), Condition::space_arc_mode);
  EXPECT_EQ(barred(family, kInMap, f), Condition::not_accepted);
  EXPECT_EQ(barred(family, kInMap | kInSpaceArc, Function::comp_right), Condition::space_arc_mode);
  EXPECT_EQ(barred(m700(), kInMap, f), Condition::none);
}

TEST(Precedence, AFunctionWithoutARowStandsBesideAllButMirror) {
  const PrecedenceRow& row = precedence_of(m700(), Function::linear);
  EXPECT_EQ(row.motion, Precedence::both);
  EXPECT_EQ(row.macro, Precedence::both);
  EXPECT_EQ(row.mirror, Precedence::ignored);
}

/// A family has codes for what it has rows of, and each row counts.
TEST(Precedence, RowsAreOfFunctionsThatTheFamilyHas) {
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    const Dialect& family = dialect(static_cast<nc_dialect>(id));
    for (const PrecedenceRow& row : family.precedence) EXPECT_NE(find_function(family, row.function), nullptr) << family.name;
    std::set<std::pair<unsigned, Function>> seen;
    for (const BarredRow& row : family.barred) {
      EXPECT_NE(find_function(family, row.function), nullptr) << family.name;
      EXPECT_TRUE(seen.insert({row.mode, row.function}).second) << family.name;
      EXPECT_NE(row.section[0], 0);
    }
  }
  std::set<Function> once;
  for (const PrecedenceRow& row : kDefaultPrecedence) EXPECT_TRUE(once.insert(row.function).second);
}

}  // namespace
}  // namespace nc
