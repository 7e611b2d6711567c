// SPDX-License-Identifier: Apache-2.0
// The command of a block: its codes and words by what they mean, whatever letters a family has for them.
#include "command/reader.hpp"

#include "front_end_helpers.hpp"

namespace nc::test {
namespace {

class ReaderTest : public FrontEndTest {};

TEST_F(ReaderTest, CodesAreWhatTheyMean) {
  ASSERT_EQ(read("G90 G2 G41 X10. I5. D1 M3"), Reading::done);
  ASSERT_EQ(command.functions.size(), 3u);
  EXPECT_EQ(command.functions[0]->function, Function::absolute);
  EXPECT_EQ(command.functions[2]->function, Function::comp_left);
  ASSERT_NE(command.motion, nullptr);
  EXPECT_EQ(command.motion->function, Function::arc_cw);
  EXPECT_EQ(command.one_shot, nullptr);
  EXPECT_EQ(command.cycle, nullptr);
  ASSERT_EQ(command.auxiliary.size(), 1u);
  EXPECT_EQ(command.auxiliary[0].number, 3u);
  EXPECT_EQ(command.auxiliary[0].function, MiscFunction::spindle_forward);
  ASSERT_EQ(read("G4 P500"), Reading::done);
  EXPECT_EQ(command.one_shot->function, Function::dwell);
  ASSERT_EQ(read("G9 G1 X1."), Reading::done);
  EXPECT_TRUE(command.exact_stop);
}

TEST_F(ReaderTest, WordsAreAskedForByTheirMeaningOrByTheirAxis) {
  ASSERT_EQ(read("G1 X10 Y-0. R2.5 F300"), Reading::done);
  EXPECT_TRUE(command.has(axis_words.word(0)));
  EXPECT_FALSE(command.has(axis_words.word(2)));
  EXPECT_EQ(command.get(axis_words.word(0)), 10);
  EXPECT_FALSE(command.written(axis_words.word(0)).has_point());
  EXPECT_TRUE(command.written(axis_words.word(1)).has_sign_or_exponent());
  EXPECT_EQ(command.get(Role::arc_radius), 2.5);
  EXPECT_TRUE(command.pointed(Role::arc_radius));
  EXPECT_EQ(command.get(Role::feed), 300);
  EXPECT_TRUE(command.any({Role::feed, Role::tool}));
  EXPECT_FALSE(command.any({Role::spindle_speed, Role::tool}));
  EXPECT_FALSE(command.has(kNoWord));
}

/// The same command in other letters: those of radius, feed and centre, and of the axes' parameters, change places.
TEST_F(ReaderTest, LettersAreOfTheFamilyAlone) {
  ASSERT_EQ(read("G2 X1. R7. F200 Q3"), Reading::done);
  const double radius = command.get(Role::arc_radius), feed = command.get(Role::feed), depth = command.get(Role::cycle_depth_step);
  Dialect moved = nc::dialect(NC_DIALECT_M700);
  for (const auto& [role, letter] : {RoleRow{Role::arc_radius, 'Q'}, RoleRow{Role::cycle_depth_step, 'F'}, RoleRow{Role::feed, 'R'}}) moved.addresses.bind(role, letter);
  use(moved);
  ASSERT_EQ(read("G2 X1. Q7. R200 F3"), Reading::done);
  EXPECT_EQ(command.get(Role::arc_radius), radius);
  EXPECT_EQ(command.get(Role::feed), feed);
  EXPECT_EQ(command.get(Role::cycle_depth_step), depth);
  EXPECT_EQ(command.motion->function, Function::arc_cw);
}

TEST_F(ReaderTest, ARefusalNamesTheWordAndItsValue) {
  EXPECT_EQ(read("G1 X1. G777"), Reading::refused);
  EXPECT_EQ(front.refusal.condition, Condition::illegal_g);
  EXPECT_EQ(front.refusal.word, word(Role::code));
  EXPECT_TRUE(front.refusal.has_value);
  EXPECT_EQ(front.refusal.value, 777);
  EXPECT_EQ(read("G1 X1. ,I2000."), Reading::refused);  // M700 13.1.1: 0.001 to 999.999
  EXPECT_EQ(front.refusal.condition, Condition::value_range);
  EXPECT_EQ(front.refusal.word, word(Role::option_in_position));
  EXPECT_EQ(read("F"), Reading::refused);  // only an axis may be named without a number
  EXPECT_EQ(front.refusal.condition, Condition::format_error);
  EXPECT_FALSE(front.refusal.has_value);
}

TEST_F(ReaderTest, OptionsBehindCommasAreNoWords) {
  ASSERT_EQ(read("G1 X10. ,C2.5"), Reading::done);
  EXPECT_EQ(command.corner, Corner::chamfer);
  EXPECT_EQ(command.corner_size.value, 2.5);
  EXPECT_TRUE(command.corner_size.pointed());
  EXPECT_EQ(command.present, set_of(axis_words.word(0)));
  ASSERT_EQ(read("G1 X10. ,A30 ,I0.5"), Reading::done);
  EXPECT_TRUE(command.has_angle);
  EXPECT_EQ(command.angle.value, 30);
  EXPECT_EQ(command.in_position, 0.5);
  EXPECT_EQ(command.corner, Corner::none);
}

TEST_F(ReaderTest, ExpressionsAreEvaluatedAndVacantWordsAreLeftOut) {
  variables[1] = 12;
  ASSERT_EQ(read("G1 X[#1*2] Y#2 F#3"), Reading::done);
  EXPECT_EQ(command.get(axis_words.word(0)), 24);
  EXPECT_TRUE(command.written(axis_words.word(0)).is_expression());
  EXPECT_EQ(command.present, set_of(axis_words.word(0)));
  EXPECT_EQ(command.vacant_feed, 3u);
  ASSERT_EQ(read("G1 X1. F100"), Reading::done);
  EXPECT_EQ(command.vacant_feed, Command::kNoVariable);
  waits_for = 7;
  EXPECT_EQ(read("X#7"), Reading::sync);
  EXPECT_EQ(sync, 4u);
  EXPECT_EQ(read("X[1/0]"), Reading::fault);
  EXPECT_EQ(fault.condition, Condition::division_by_zero);
}

TEST_F(ReaderTest, TheCoreIsAskedAboutCodesThatAreNotBuiltAndIfItWantsAboutAll) {
  ASSERT_EQ(read("G90 G1 X1."), Reading::done);
  EXPECT_TRUE(asked.empty());
  front.checks_codes = true;
  ASSERT_EQ(read("G90 G1 X1."), Reading::done);
  EXPECT_EQ(asked, (std::vector{Function::absolute, Function::linear}));
  refused = Function::linear;
  EXPECT_EQ(read("G90 G1 X1."), Reading::fault);
  front.checks_codes = false;
  asked.clear();
  for (const FunctionRow& row : front.dialect->functions) {
    if (row.missing == nullptr) continue;
    refused = row.function;
    EXPECT_EQ(read("G" + std::to_string(row.code / 10) + (row.code % 10 != 0 ? "." + std::to_string(row.code % 10) : "")), Reading::fault) << row.code;
    break;
  }
  EXPECT_EQ(asked.size(), 1u);
}

/// M700 13.5.1: G67 needs a call that it could cancel.
TEST_F(ReaderTest, OnlyTheCoreKnowsWhetherACallIsInForce) {
  EXPECT_EQ(read("G67"), Reading::refused);
  EXPECT_EQ(front.refusal.condition, Condition::cancel_without_call);
  modal_call = true;
  EXPECT_EQ(read("G67"), Reading::done);
}

/// M700 5.1: for each axis word the G90 or G91 before it counts.
TEST_F(ReaderTest, IncrementsGoByTheOrderOfTheWords) {
  const Block& block = compile("G90 X1. G91 Y2. Z3.");
  ASSERT_EQ(read_command(block, front, command), Reading::done);
  EXPECT_EQ(incremental_axes(block, axis_words, command, true), 6u);
  const Block& mixed = compile("X1. G90 Y2. G91 Z3.");
  ASSERT_EQ(read_command(mixed, front, command), Reading::done);
  EXPECT_EQ(incremental_axes(mixed, axis_words, command, true), 5u);
  EXPECT_EQ(incremental_axes(mixed, axis_words, command, false), 4u);
}

TEST_F(ReaderTest, AModeMayGiveAnAxisAnotherWord) {
  EXPECT_EQ(axis_words.axis_named('Q'), -1);
  EXPECT_EQ(axis_words.axis_named('y'), -1);
  EXPECT_EQ(axis_words.axis_named('C'), 3);
  axis_words.add(word(Role::basic_y), 3);
  EXPECT_EQ(axis_words.axis(word(Role::basic_y)), 3);
  EXPECT_EQ(axis_words.word(3), word_named('C'));
  EXPECT_EQ(axis_words.axis(kNoWord), -1);
}

/// Words of later blocks do not see those of the ones before.
TEST_F(ReaderTest, NothingOfTheBlockBeforeIsLeft) {
  ASSERT_EQ(read("G91 G81 G9 X1. R2. F3. M4 ,I0.1"), Reading::done);
  ASSERT_EQ(read("Y1."), Reading::done);
  EXPECT_EQ(command.present, set_of(axis_words.word(1)));
  EXPECT_TRUE(command.functions.empty());
  EXPECT_TRUE(command.auxiliary.empty());
  EXPECT_EQ(command.cycle, nullptr);
  EXPECT_FALSE(command.exact_stop);
  EXPECT_EQ(command.in_position, 0);
  EXPECT_EQ(command.incremental_at, 0u);
}

}  // namespace
}  // namespace nc::test
