// SPDX-License-Identifier: Apache-2.0
// Texts for persons: code texts, the sentence for the operator, and the public functions that show the tables.
#include "dialect/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"

namespace nc {
namespace {

std::string number(double value) {
  char text[64];
  TextWriter(text, sizeof text).put_number(value);
  return text;
}

std::string detail(const Fault& fault, const char* axis = nullptr) {
  char text[NC_MAX_TEXT];
  alarm_detail(dialect(NC_DIALECT_M700), fault, axis, text, sizeof text);
  return text;
}

TEST(TextWriter, WritesNumbersWithoutALocale) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(12.5), "12.5");
  EXPECT_EQ(number(-0.0001), "-0.0001");
  EXPECT_EQ(number(100), "100");
  EXPECT_EQ(number(1.05), "1.05");
  EXPECT_EQ(number(0.99999), "1");
  EXPECT_EQ(number(99999999), "99999999");
  EXPECT_EQ(number(-1234.5678), "-1234.5678");
  EXPECT_EQ(number(1e300), "very large");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "very large");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "not a number");
}

TEST(TextWriter, NeverWritesBehindItsBuffer) {
  for (size_t size = 0; size < 12; ++size) {
    std::vector<char> text(size + 4, '\x7f');
    TextWriter(text.data(), size).put("abcdefgh").put_number(-12.25);
    for (size_t i = size; i < text.size(); ++i) EXPECT_EQ(text[i], '\x7f') << size;
    if (size > 0) {
      EXPECT_LT(std::strlen(text.data()), size);
    }
  }
}

TEST(CodeText, IsWrittenAsTheManualsPrintIt) {
  const auto g = [](int code) {
    char text[8];
    g_code_text('G', code, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(g(0), "G00");
  EXPECT_EQ(g(21), "G02.1");
  EXPECT_EQ(g(541), "G54.1");
  EXPECT_EQ(g(1070), "G107");
  EXPECT_EQ(g(-1), "");
  char m[8];
  m_code_text('M', 3, m, sizeof m);
  EXPECT_STREQ(m, "M03");
  m_code_text('M', 198, m, sizeof m);
  EXPECT_STREQ(m, "M198");
  m_code_text('M', 99999999, m, sizeof m);  // longer than the buffer: cut, not overrun
  EXPECT_EQ(std::strlen(m), 7u);
}

TEST(AlarmDetail, NamesTheWordTheAxisAndTheValue) {
  EXPECT_EQ(detail({Condition::value_range, -1, 'X', true, 123456.5}),
            "The value of X123456.5 is outside its range.");
  EXPECT_EQ(detail({Condition::value_range, -1, 'X', true, -1e15}), "The value of X (a very large number) is outside its range.");
  EXPECT_EQ(detail({Condition::value_range}), "A value in the block is outside its range.");
  EXPECT_EQ(detail({Condition::soft_limit, 0, 0, true, 512.25}, "X"),
            "Axis X would go to 512.25, beyond its stroke limit.");
  EXPECT_EQ(detail({Condition::soft_limit, 0, 0, false, 0}, "X"), "Axis X would go beyond its stroke limit.");
  EXPECT_EQ(detail({Condition::soft_limit}), "An axis would go beyond its stroke limit.");
  EXPECT_EQ(detail({Condition::program_missing, -1, 'P', true, 1000}),
            "The program O1000 is not in the memory.");
  EXPECT_EQ(detail({Condition::variable_number, -1, 0, true, 400}), "There is no variable #400.");
  EXPECT_EQ(detail({Condition::illegal_character, -1, '?', false, 0}),
            "The character '?' has no meaning here.");
  EXPECT_EQ(detail({Condition::illegal_character, -1, '\xc3', false, 0}),
            "The block holds a character that is not part of the code.");
  EXPECT_EQ(detail({Condition::words_missing, -1, 'Q', false, 0}), "The block needs the word Q.");
  EXPECT_EQ(detail({Condition::value_range, -1, '#', true, -1}),
            "The value of the variable is outside its range.");
  EXPECT_EQ(detail({Condition::no_function, -1, 'L', true, 10}),
            "The function that L10 asks for is not fitted.");
}

TEST(AlarmDetail, WritesCodesAsCodes) {
  // no_function carries the code of the table row (times 10), every other fault the number as programmed.
  EXPECT_EQ(detail({Condition::no_function, -1, 'G', true, 23}),
            "G02.3 is not available on this control.");
  EXPECT_EQ(detail({Condition::no_function, -1, 'M', true, 96}),
            "M96 is not available on this control.");
  EXPECT_EQ(detail({Condition::program_end}), "The text of the program ends without M02 or M30.");
  EXPECT_EQ(detail({Condition::spindle_not_turning}), "The spindle has to turn, for a tap the way of its thread. Program S and M03 (or the reverse) before it.");
  EXPECT_EQ(detail({Condition::data_input_kind, -1, 'L', true, 9}), "G10 does not know L9.");
  EXPECT_EQ(detail({Condition::center_missing}), "The centre is missing: the block needs I, J or K, one of the two of its plane.");
  EXPECT_EQ(detail({Condition::illegal_g, -1, 'G', true, 54.2}), "G54.2 is not a code of this control.");
  // Of a code that the control has it does not say so: G92.1 while coordinates are rotated (M700 14.12).
  EXPECT_EQ(detail({Condition::illegal_g, -1, 'G', true, 92.1}), "G92.1 is not possible in the modes that are in force, or a parameter switches it off.");
  EXPECT_EQ(detail({Condition::words_missing, -1, 'G', true, 4}), "G04 needs a word that is not there.");
  // A number that is no code is shown as it was programmed, not rounded to one that is.
  EXPECT_EQ(detail({Condition::illegal_g, -1, 'G', true, 0.15}), "G0.15 is not a code of this control.");
  EXPECT_EQ(detail({Condition::value_range, -1, 'M', true, 3.5}), "The value of M3.5 is outside its range.");
  // The number of a code is not a value that the sentence may quote.
  EXPECT_EQ(detail({Condition::arc_deviation, -1, 'G', true, 2}),
            "Start and end of the arc are not on one circle about its centre.");
  EXPECT_EQ(detail({Condition::arc_deviation, -1, 'I', true, 0.25}),
            "Start and end of the arc are not on one circle: the radius at the end would be 0.25 mm.");
  EXPECT_EQ(detail({Condition::illegal_g, -1, 'G', true, 1e9}),
            "G1000000000 is not a code of this control.");
}

TEST(AlarmDetail, CodesHaveTheLettersOfTheirFamily) {
  Dialect family = dialect(NC_DIALECT_M700);
  family.addresses.bind(Role::code, 'P');
  family.addresses.bind(Role::misc_code, 'A');
  const auto sentence = [&](const Fault& fault) {
    char text[NC_MAX_TEXT];
    alarm_detail(family, fault, nullptr, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(sentence({Condition::no_function, -1, 'P', true, 720}), "P72 is not available on this control.");
  EXPECT_STREQ(alarm_text(family, {Condition::no_function, -1, 'P', true, 720}).code, "P180");
  EXPECT_EQ(sentence({Condition::words_missing, -1, 'A', true, 3}), "A03 needs a word that is not there.");
  EXPECT_EQ(sentence({Condition::cycle_in_compensation}),
            "Fixed cycles and tool radius compensation exclude each other. Cancel with P80 or P40 first.");
  EXPECT_EQ(sentence({Condition::value_range, -1, 'G', true, 340}), "The value of G340 is outside its range.");
}

TEST(AlarmDetail, EveryConditionHasASentenceHoweverLittleTheFaultCarries) {
  std::set<std::string> sentences;
  for (unsigned i = 1; i < static_cast<unsigned>(Condition::count_); ++i) {
    const auto condition = static_cast<Condition>(i);
    for (const char letter : {'\0', 'X', 'G', 'M', '#', '\xe4'}) {
      for (const bool has_value : {false, true}) {
        for (const char* axis : {static_cast<const char*>(nullptr), "", "X"}) {
          char text[1024];
          alarm_detail(dialect(NC_DIALECT_M700), {condition, -1, letter, has_value, 12.5}, axis, text, sizeof text);
          const std::string sentence = text;
          ASSERT_FALSE(sentence.empty())
              << "Condition number " << i << " (in the order of dialect/alarms.hpp)";
          EXPECT_LT(sentence.size(), size_t{NC_MAX_TEXT}) << sentence;
          EXPECT_EQ(sentence.back(), '.') << sentence;
          EXPECT_EQ(sentence.find_first_of("{}"), std::string::npos) << sentence;
          EXPECT_TRUE((sentence[0] >= 'A' && sentence[0] <= 'Z') || sentence[0] == '\'') << sentence;
        }
      }
    }
    sentences.insert(detail({condition}));
  }
  EXPECT_EQ(sentences.size(), static_cast<size_t>(Condition::count_) - 1)
      << "two conditions have the same sentence";
}

TEST(AlarmDetail, NamesTheCodesThatTheFamilyHas) {
  const FunctionRow functions[] = {{70, 1, Function::comp_off, nullptr, "off", "1"}, {995, 1, Function::comp_left, nullptr, "left", "1"}};
  const VariableRow variables[] = {{1717, 1717, SystemVariable::alarm, 0, 0, "-", "alarm", "1"}};
  FamilyVariables numbers;
  numbers.rows = {variables, 1};
  Dialect family = dialect(NC_DIALECT_M700);
  family.functions = {functions, 2};
  family.variables = &numbers;
  const auto sentence = [&](Condition condition) {
    char text[NC_MAX_TEXT];
    alarm_detail(family, {condition}, nullptr, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(sentence(Condition::skip_in_compensation), "Skip is not possible while tool radius compensation is on. Cancel it with G07 first.");
  EXPECT_EQ(sentence(Condition::outside_compensation), "This acts in radius compensation. Program G99.5 or its code first.");
  EXPECT_EQ(sentence(Condition::user_alarm), "The program has raised an alarm itself (#1717).");
}

TEST(AlarmDetail, NeverOverrunsASmallBuffer) {
  for (unsigned i = 0; i <= static_cast<unsigned>(Condition::count_); ++i) {
    const Fault fault{static_cast<Condition>(i), 1, 'X', true, -99999.9999};
    for (size_t size = 0; size < 140; ++size) {
      std::vector<char> text(size + 8, '\x7f');
      alarm_detail(dialect(NC_DIALECT_M700), fault, "X", text.data(), size);
      for (size_t k = size; k < text.size(); ++k) ASSERT_EQ(text[k], '\x7f') << i << " size " << size;
      if (size > 0) {
        ASSERT_LT(std::strlen(text.data()), size);
      }
    }
  }
}

TEST(PublicTables, ShowEveryRowOnce) {
  for (int id = 0; id < NC_DIALECT_COUNT; ++id) {
    const auto family = static_cast<nc_dialect>(id);
    const Dialect& tables = dialect(family);
    std::set<std::string> codes;
    nc_function row;
    unsigned count = 0;
    while (nc_function_row(family, count, &row) == NC_OK) {
      EXPECT_TRUE(codes.insert(row.code).second) << row.code;
      EXPECT_EQ(row.supported, row.alarm[0] == 0) << row.code;
      ++count;
    }
    EXPECT_EQ(count, tables.functions.size + tables.misc.size);
    EXPECT_EQ(nc_function_row(family, count, &row), NC_E_NOT_FOUND);
    char text[12];
    for (const FunctionRow& code : tables.functions) {
      g_code_text(tables.addresses.letter(Role::code), code.code, text, sizeof text);
      EXPECT_EQ(codes.count(text), 1u) << text;
    }
    for (const MiscRow& code : tables.misc) {
      m_code_text(tables.addresses.letter(Role::misc_code), code.code, text, sizeof text);
      EXPECT_EQ(codes.count(text), 1u) << text;
    }

    char code[16];
    const char* message = nullptr;
    unsigned alarms = 0;
    while (nc_alarm_row(family, alarms, code, &message) == NC_OK) {
      const AlarmText* const alarm = alarm_at(tables, alarms);
      ASSERT_NE(alarm, nullptr);
      EXPECT_STREQ(code, alarm->code);
      EXPECT_STREQ(message, alarm->message);
      ++alarms;
    }
    EXPECT_GE(alarms, tables.alarms.size);
    EXPECT_EQ(alarm_at(tables, alarms), nullptr);
    EXPECT_EQ(nc_alarm_row(family, alarms, code, &message), NC_E_NOT_FOUND);
  }
}

TEST(PublicTables, SayWhatAMissingFunctionRaises) {
  nc_function row;
  for (unsigned i = 0; nc_function_row(NC_DIALECT_M700, i, &row) == NC_OK; ++i) {
    if (std::string(row.code) == "G77") {
      EXPECT_FALSE(row.supported);
      EXPECT_STREQ(row.alarm, "P180");
      EXPECT_EQ(row.group, 9);
      EXPECT_STREQ(row.section, "3.7");
      return;
    }
  }
  FAIL() << "no G77";
}

TEST(PublicTables, RefuseWhatIsNoDialect) {
  nc_function row;
  char code[16];
  const char* message = nullptr;
  EXPECT_EQ(nc_function_row(NC_DIALECT_COUNT, 0, &row), NC_E_ARGUMENT);
  EXPECT_EQ(nc_function_row(static_cast<nc_dialect>(-1), 0, &row), NC_E_ARGUMENT);
  EXPECT_EQ(nc_function_row(NC_DIALECT_M700, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_row(NC_DIALECT_COUNT, 0, code, &message), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_row(NC_DIALECT_M700, 0, nullptr, &message), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_row(NC_DIALECT_M700, 0, code, nullptr), NC_E_ARGUMENT);
}

TEST(PublicTables, DialectsHaveANameEach) {
  std::set<std::string> names;
  for (int id = 0; id < NC_DIALECT_COUNT; ++id) {
    const auto family = static_cast<nc_dialect>(id);
    const char* const name = nc_dialect_name(family);
    ASSERT_NE(name, nullptr);
    EXPECT_TRUE(names.insert(name).second) << name;
    nc_dialect back = NC_DIALECT_COUNT;
    EXPECT_EQ(nc_dialect_get(name, &back), NC_OK);
    EXPECT_EQ(back, family);
  }
  EXPECT_EQ(names.count("m700"), 1u);
  EXPECT_EQ(nc_dialect_name(NC_DIALECT_COUNT), nullptr);
  EXPECT_EQ(nc_dialect_name(static_cast<nc_dialect>(-1)), nullptr);
  nc_dialect kept = NC_DIALECT_DGSHAPE;
  EXPECT_EQ(nc_dialect_get("M700", &kept), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_dialect_get("", &kept), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_dialect_get(nullptr, &kept), NC_E_ARGUMENT);
  EXPECT_EQ(kept, NC_DIALECT_DGSHAPE);
  EXPECT_EQ(nc_dialect_get("m700", nullptr), NC_E_ARGUMENT);
}

TEST(PublicTables, SayWhatACodeIsFor) {
  const auto role = [](char letter, uint32_t number) { return nc_code_role_get(NC_DIALECT_M700, letter, number); };
  EXPECT_EQ(role('M', 0), NC_CODE_PROGRAM_STOP);
  EXPECT_EQ(role('M', 1), NC_CODE_OPTIONAL_STOP);
  EXPECT_EQ(role('M', 2), NC_CODE_PROGRAM_END);
  EXPECT_EQ(role('M', 30), NC_CODE_PROGRAM_END);
  EXPECT_EQ(role('M', 3), NC_CODE_SPINDLE_FORWARD);
  EXPECT_EQ(role('M', 4), NC_CODE_SPINDLE_REVERSE);
  EXPECT_EQ(role('M', 5), NC_CODE_SPINDLE_STOP);
  EXPECT_EQ(role('M', 98), NC_CODE_CALL);
  EXPECT_EQ(role('M', 198), NC_CODE_CALL_EXTERNAL);
  EXPECT_EQ(role('M', 96), NC_CODE_INTERRUPT);
  EXPECT_EQ(role('M', 97), NC_CODE_OTHER);
  EXPECT_EQ(role('M', 99), NC_CODE_RETURN);
  EXPECT_EQ(role('M', 8), NC_CODE_OTHER);
  EXPECT_EQ(role('M', 4294967295u), NC_CODE_OTHER);
  EXPECT_EQ(role('G', 40), NC_CODE_DWELL);
  EXPECT_EQ(role('G', 100), NC_CODE_DATA_INPUT);
  EXPECT_EQ(role('G', 661), NC_CODE_MACRO_CALL);
  EXPECT_EQ(role('G', 10), NC_CODE_OTHER);
  EXPECT_EQ(role('G', 4294967295u), NC_CODE_OTHER);
  EXPECT_EQ(role('X', 30), NC_CODE_OTHER);
  EXPECT_EQ(nc_code_role_get(NC_DIALECT_DGSHAPE, 'M', 6), NC_CODE_TOOL_CHANGE);
  EXPECT_EQ(nc_code_role_get(NC_DIALECT_COUNT, 'M', 30), NC_CODE_OTHER);
}

TEST(PublicTables, VersionIsThreeNumbers) {
  const std::string version = nc_version();
  EXPECT_EQ(version.find_first_not_of("0123456789."), std::string::npos);
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2);
}

// The codes and words that a sentence names are those of the family.
TEST(AlarmDetail, NamesTheLettersAndCodesOfTheFamily) {
  Dialect other = dialect(NC_DIALECT_M700);
  other.addresses.bind(Role::feed, 'E');
  other.addresses.bind(Role::misc_code, 'W');
  other.addresses.bind(Role::program_number, 'Q');
  const auto says = [&](const Fault& fault) {
    char text[NC_MAX_TEXT];
    alarm_detail(other, fault, nullptr, text, sizeof text);
    return std::string(text);
  };
  EXPECT_EQ(says({Condition::no_feed}), "No feed rate is in force. Program E before or in this block.");
  EXPECT_EQ(says({Condition::program_end}), "The text of the program ends without W02 or W30.");
  EXPECT_EQ(says({Condition::program_missing, -1, 'P', true, 1000}), "The program Q1000 is not in the memory.");
}

}  // namespace
}  // namespace nc
