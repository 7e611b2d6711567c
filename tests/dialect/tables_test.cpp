// SPDX-License-Identifier: Apache-2.0
// The tables of every family are consistent: sorted, unique and complete, and each alarm that they name is in the
// family's alarm list.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "dialect/code_index.hpp"
#include "dialect/default_alarms.hpp"
#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"
#include "modal/modal_state.hpp"

namespace nc {
namespace {

class Tables : public ::testing::TestWithParam<nc_dialect> {
 protected:
  const Dialect& family() const { return dialect(GetParam()); }
  std::set<std::string> alarm_codes() const {
    std::set<std::string> codes;
    for (unsigned i = 0; alarm_at(family(), i) != nullptr; ++i) codes.insert(alarm_at(family(), i)->code);
    return codes;
  }
};

std::string g_text(int code) {
  char text[8];
  g_code_text('G', code, text, sizeof text);
  return text;
}

TEST_P(Tables, BelongsToItsNumber) {
  EXPECT_EQ(family().id, GetParam());
}

TEST_P(Tables, FunctionsAreSortedAndUnique) {
  ASSERT_GT(family().functions.size, 0u);
  for (unsigned i = 1; i < family().functions.size; ++i) {
    EXPECT_LT(family().functions.row[i - 1].code, family().functions.row[i].code) << "row " << i;
  }
}

TEST_P(Tables, MiscIsSortedAndUnique) {
  ASSERT_GT(family().misc.size, 0u);
  for (unsigned i = 1; i < family().misc.size; ++i)
    EXPECT_LT(family().misc.row[i - 1].code, family().misc.row[i].code) << "row " << i;
}

TEST_P(Tables, EveryRowIsFoundByItsCodeAndNoOtherIs) {
  std::set<int> listed;
  for (const FunctionRow& row : family().functions) {
    EXPECT_EQ(find_function(family(), row.code), &row) << g_text(row.code);
    listed.insert(row.code);
  }
  for (int code = -20; code < 4000; ++code) {
    if (listed.count(code) == 0) {
      EXPECT_EQ(find_function(family(), code), nullptr) << code;
    }
  }
  std::set<unsigned> misc;
  for (const MiscRow& row : family().misc) {
    EXPECT_EQ(find_misc(family(), row.code), &row) << "M" << row.code;
    misc.insert(row.code);
  }
  for (unsigned code : {3u, 4u, 97u, 199u, 65535u, 65536u + 30u, 99999999u}) {
    if (misc.count(code) == 0) {
      EXPECT_EQ(find_misc(family(), code), nullptr) << "M" << code;
    }
  }
}

// The row that stands for a function is the one that is numbered 0, not the one with the smallest code.
TEST_P(Tables, RowsOfAFunctionAreNumberedFromZeroOn) {
  std::map<Function, std::set<unsigned>> numbers;
  for (const FunctionRow& row : family().functions)
    EXPECT_TRUE(numbers[row.function].insert(row.number).second) << g_text(row.code) << " has the number of another row";
  for (const auto& [function, of_rows] : numbers) {
    const FunctionRow* const row = find_function(family(), function);
    ASSERT_NE(row, nullptr) << static_cast<unsigned>(function);
    EXPECT_EQ(row->function, function);
    EXPECT_EQ(row->number, 0u) << g_text(row->code);
  }
}

TEST_P(Tables, RowsAreFilledIn) {
  for (const FunctionRow& row : family().functions) {
    const std::string code = g_text(row.code);
    EXPECT_LT(row.group, NC_GROUPS) << code;
    ASSERT_NE(row.name, nullptr) << code;
    EXPECT_NE(row.name[0], 0) << code;
    ASSERT_NE(row.section, nullptr) << code;
    EXPECT_NE(row.section[0], 0) << code;
    EXPECT_LT(row.function, Function::count_) << code;
  }
  for (const MiscRow& row : family().misc) {
    EXPECT_FALSE(goes_out(row.function) && row.missing != nullptr) << "M" << row.code;
    EXPECT_NE(row.name, nullptr) << "M" << row.code;
    EXPECT_NE(row.section, nullptr) << "M" << row.code;
  }
}

// What a family has no row for is as the common table says.
TEST_P(Tables, EveryConditionHasOneRow) {
  for (unsigned i = 1; i < static_cast<unsigned>(Condition::count_); ++i) {
    unsigned rows = 0, common = 0;
    for (const AlarmRow& row : family().conditions) rows += row.condition == static_cast<Condition>(i) ? 1u : 0u;
    for (const AlarmRow& row : kDefaultConditions) common += row.condition == static_cast<Condition>(i) ? 1u : 0u;
    EXPECT_LE(rows, 1u) << "Condition number " << i << " (in the order of alarm/condition.hpp) of " << family().name;
    EXPECT_EQ(common, 1u) << "Condition number " << i << " of dialect/default_alarms.cpp";
  }
}

TEST_P(Tables, AConditionWithoutARowHasTheCodeOfTheCommonTable) {
  for (const AlarmRow& common : kDefaultConditions) {
    const AlarmRow* own = nullptr;
    for (const AlarmRow& row : family().conditions)
      if (row.condition == common.condition) own = &row;
    EXPECT_STREQ(alarm_text(family(), Fault{common.condition}).code, own != nullptr ? own->code : common.code);
  }
}

// Its codes are listed behind those of the family, and only those that the family can raise.
TEST_P(Tables, TheListOfAlarmsHoldsWhatCanBeRaisedAndTheManualsList) {
  std::set<std::string> raised;
  for (unsigned i = 1; i < static_cast<unsigned>(Condition::count_); ++i) raised.insert(alarm_text(family(), Fault{static_cast<Condition>(i)}).code);
  for (const FunctionRow& row : family().functions)
    if (row.missing != nullptr) raised.insert(row.missing);
  for (const MiscRow& row : family().misc)
    if (row.missing != nullptr) raised.insert(row.missing);
  for (const AlarmText& alarm : family().alarms) raised.insert(alarm.code);
  EXPECT_EQ(alarm_codes(), raised);
}

TEST_P(Tables, AlarmCodesAreUniqueShortAndHaveATextWithoutMarkup) {
  std::set<std::string> seen;
  for (unsigned i = 0; alarm_at(family(), i) != nullptr; ++i) {
    const AlarmText& alarm = *alarm_at(family(), i);
    const std::string code = alarm.code, message = alarm.message;
    EXPECT_TRUE(seen.insert(code).second) << code;
    EXPECT_LT(code.size(), sizeof nc_alarm::code) << code;
    EXPECT_LT(message.size(), sizeof nc_alarm::message) << code;
    EXPECT_EQ(code.find(' '), std::string::npos) << code << ": codes are printed without blanks";
    EXPECT_FALSE(message.empty()) << code;
    EXPECT_NE(message, "-") << code;
  }
}

TEST_P(Tables, EveryAlarmNamedIsInTheList) {
  const std::set<std::string> codes = alarm_codes();
  for (const FunctionRow& row : family().functions) {
    if (row.missing != nullptr) {
      EXPECT_EQ(codes.count(row.missing), 1u) << g_text(row.code) << " names " << row.missing;
    }
  }
  for (const MiscRow& row : family().misc) {
    if (row.missing != nullptr) {
      EXPECT_EQ(codes.count(row.missing), 1u) << "M" << row.code << " names " << row.missing;
    }
  }
  for (const AlarmRow& row : family().conditions) {
    ASSERT_NE(row.code, nullptr);
    EXPECT_EQ(codes.count(row.code), 1u) << row.code;
  }
}

// The code of a mode in force is shown in its group, so modes and groups must divide the codes in the same way.
TEST_P(Tables, AGroupIsAMode) {
  std::map<unsigned, Mode> mode_of_group;
  std::map<Mode, unsigned> group_of_mode;
  for (const FunctionRow& row : family().functions) {
    const Mode mode = mode_of(row.function);
    EXPECT_EQ(row.group == 0, mode == Mode::none) << g_text(row.code);
    EXPECT_EQ(mode_of_group.emplace(row.group, mode).first->second, mode) << g_text(row.code);
    EXPECT_EQ(group_of_mode.emplace(mode, row.group).first->second, row.group) << g_text(row.code);
  }
}

TEST_P(Tables, OneFunctionOfEachModeIsInForceAtPowerOn) {
  std::set<Mode> modes, given;
  for (const FunctionRow& row : family().functions)
    if (mode_of(row.function) != Mode::none) modes.insert(mode_of(row.function));
  for (const Function function : family().initial) {
    const FunctionRow* row = find_function(family(), function);
    ASSERT_NE(row, nullptr) << "initial function number " << static_cast<unsigned>(function);
    EXPECT_EQ(row->missing, nullptr) << g_text(row->code) << " is on at power on, so it must exist";
    EXPECT_TRUE(given.insert(mode_of(function)).second) << g_text(row->code);
  }
  EXPECT_EQ(given, modes);
  const ModalState state = initial_modal(family());
  for (unsigned i = 0; i < kModes; ++i) EXPECT_EQ(mode_of(state.in_force[i]), static_cast<Mode>(i));
  for (const FunctionRow& row : family().functions)
    if (&row == find_function(family(), row.function) && mode_of(row.function) != Mode::none) {
      EXPECT_EQ(state.is(row.function), state.holds(row)) << g_text(row.code);
    }
}

TEST_P(Tables, CodesAreFoundAsTheyAreWrittenAndByWhatTheyMean) {
  CodeIndex index;
  index.create(family());
  for (const FunctionRow& row : family().functions) {
    EXPECT_EQ(index.find(row.code / 10.0), &row) << g_text(row.code);
    EXPECT_EQ(index.find(row.code / 10.0 + 1e-9), &row) << g_text(row.code) << " out of an expression";
    EXPECT_EQ(index.find(row.code / 10.0 + 0.03), nullptr) << g_text(row.code);
    const FunctionRow* first = index.row(row.function);
    ASSERT_NE(first, nullptr) << g_text(row.code);
    EXPECT_LE(first->code, row.code);
    EXPECT_EQ(first->function, row.function);
  }
  for (const double number : {-1.0, 1e9, 0.05, std::nan("")}) EXPECT_EQ(index.find(number), nullptr) << number;
  EXPECT_EQ(index.linear().function, Function::linear);
  EXPECT_EQ(index.find(index.linear_number()), &index.linear());
}

// The number of a row distinguishes G55 from G54, and G107 from G07.1 where the code in force is shown.
TEST_P(Tables, CodesOfOneFunctionCountFromZero) {
  std::map<Function, unsigned> rows;
  for (const FunctionRow& row : family().functions)
    if (row.function != Function::user_macro) {
      EXPECT_EQ(row.number, rows[row.function]++) << g_text(row.code);
    }
}

TEST_P(Tables, EveryModalCodeIsShownInItsGroup) {
  for (const FunctionRow& row : family().functions) {
    if (row.group == 0) continue;
    ModalState state = initial_modal(family());
    state.set(row);
    const nc_modal shown = to_public(family(), state), before = to_public(family(), initial_modal(family()));
    for (unsigned group = 0; group < NC_GROUPS; ++group) {
      EXPECT_EQ(shown.code[group], group == row.group ? row.code : before.code[group]) << g_text(row.code);
      EXPECT_EQ(shown.code[group], code_in_force(family(), state, group)) << g_text(row.code);
    }
    EXPECT_EQ(row_in_force(family(), state, mode_of(row.function)), &row);
  }
}

TEST_P(Tables, OutputsAreNoCodesOfTheControl) {
  for (const OutputRow& row : family().outputs) {
    EXPECT_EQ(find_misc(family(), row.code), nullptr) << "M" << row.code;
    EXPECT_TRUE(goes_out(row.function)) << "M" << row.code;
    EXPECT_EQ(misc_function(family(), row.code), row.function);
    if (row.function != MiscFunction::output) {
      EXPECT_EQ(misc_code(family(), row.function), row.code);
    }
  }
  for (const MiscRow& row : family().misc) EXPECT_EQ(misc_function(family(), row.code), row.function) << "M" << row.code;
  EXPECT_EQ(misc_function(family(), 777), MiscFunction::output);
}

TEST_P(Tables, AlarmTextsOfEveryConditionAreThere) {
  for (unsigned i = 1; i < static_cast<unsigned>(Condition::count_); ++i) {
    Fault fault;
    fault.condition = static_cast<Condition>(i);
    const AlarmText text = alarm_text(family(), fault);
    EXPECT_NE(text.code[0], 0) << i;
    EXPECT_NE(text.message[0], 0) << i;
    if (fault.condition != Condition::internal) {
      EXPECT_STRNE(text.code, "NC-INTERNAL") << i;
    }
  }
}

TEST_P(Tables, MissingFunctionRaisesTheAlarmOfItsOwnRow) {
  for (const FunctionRow& row : family().functions) {
    if (row.missing == nullptr) continue;
    const Fault fault{Condition::no_function, -1, family().addresses.letter(Role::code), true, static_cast<double>(row.code)};
    EXPECT_STREQ(alarm_text(family(), fault).code, row.missing) << g_text(row.code);
  }
  for (const MiscRow& row : family().misc) {
    if (row.missing == nullptr) continue;
    const Fault fault{Condition::no_function, -1, family().addresses.letter(Role::misc_code), true, static_cast<double>(row.code)};
    EXPECT_STREQ(alarm_text(family(), fault).code, row.missing) << "M" << row.code;
  }
}

TEST_P(Tables, FaultWithoutARowOfItsOwnFallsBackToTheCondition) {
  const char* const general = alarm_text(family(), Fault{Condition::no_function}).code;
  ASSERT_STRNE(general, "NC-INTERNAL");
  for (const double value : {-1.0, 10.0, 39990.0, 1e300}) {
    const Fault fault{Condition::no_function, -1, family().addresses.letter(Role::code), true, value};
    EXPECT_STREQ(alarm_text(family(), fault).code, general) << value;
  }
  EXPECT_STREQ(alarm_text(family(), Fault{Condition::no_function, -1, 'X', true, 50.0}).code, general);
  EXPECT_STREQ(alarm_text(family(), Fault{Condition::no_function, -1, family().addresses.letter(Role::code), false, 330.0}).code, general);
}

TEST_P(Tables, ParametersHaveUniqueKeysAndADefaultAmongTheirWords) {
  std::set<std::string> seen;
  for (const ParameterName& row : family().parameters->names) {
    EXPECT_TRUE(seen.insert(row.key).second) << row.key;
    if (row.words == nullptr) continue;
    const std::string words = row.words;
    std::set<std::string> unique;
    size_t count = 0;
    for (size_t from = 0; from <= words.size(); ++count) {
      size_t bar = words.find('|', from);
      if (bar == std::string::npos) bar = words.size();
      EXPECT_TRUE(unique.insert(words.substr(from, bar - from)).second) << row.key;
      from = bar + 1;
    }
    EXPECT_GE(row.value, 0) << row.key;
    EXPECT_LT(row.value, static_cast<double>(count)) << row.key;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Tables, ::testing::Values(NC_DIALECT_M700, NC_DIALECT_DGSHAPE, NC_DIALECT_ISO, NC_DIALECT_HX, NC_DIALECT_SERIES8),
                         [](const auto& name) { return std::string(dialect(name.param).name); });

}  // namespace
}  // namespace nc
