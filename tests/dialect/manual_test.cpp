// SPDX-License-Identifier: Apache-2.0
// Compares the tables with the manuals: the facts were copied here by hand from the lists of the manuals, and the alarm
// list is compared with the catalogue if that lies beside the source tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"
#include "dialect/iso_lexer.hpp"
#include "modal/modal_state.hpp"
#include "places/places.hpp"

namespace nc {
namespace {

const Dialect& m700() {
  return dialect(NC_DIALECT_M700);
}
const Dialect& dgshape() {
  return dialect(NC_DIALECT_DGSHAPE);
}
const Dialect& iso() {
  return dialect(NC_DIALECT_ISO);
}

const Dialect& hx() {
  return dialect(NC_DIALECT_HX);
}

using Groups = std::map<unsigned, std::vector<int>>;  // group -> codes times 10

// M700 3.7, row by row as in its list; G11.1, which is not in the list, is from 13.11.
const Groups kM700List = {
    {0,
     {40,  50,  51,  70,  80,  90,  100, 110, 111, 120, 130, 270, 280, 290, 300, 301, 302, 303, 304, 305, 306, 310,
      311, 312, 313, 340, 350, 360, 370, 371, 380, 390, 450, 460, 470, 480, 520, 530, 600, 650, 920, 921}},
    {1, {0, 10, 20, 30, 21, 31, 23, 33, 24, 34, 62, 330}},
    {2, {170, 180, 190}},
    {3, {900, 910}},
    {4, {220, 230}},
    {5, {930, 940, 950}},
    {6, {200, 210}},
    {7, {400, 410, 420}},
    {8, {430, 440, 431, 434, 435, 490}},
    {9, {700, 710, 720, 730, 740, 750, 760, 770, 780, 790, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890}},
    {10, {980, 990}},
    {11, {500, 510}},
    {12, {540, 550, 560, 570, 580, 590, 541}},
    {13, {610, 611, 620, 630, 631, 632, 640}},
    {14, {660, 661, 670}},
    {15, {401, 411, 421}},
    {16, {680, 690}},
    {17, {960, 970}},
    {18, {150, 160}},
    {19, {501, 511}},
    {21, {71, 1070, 121, 1120, 131, 1130}},
};

// HX 3.1, row by row. G31 to G31.4 stand in the one-shot group 23, G107 in a group of its own, 22; stitch has none (15.6).
const Groups kHxList = {
    {0,
     {40,  90,  100, 270, 280, 290, 300, 310, 311, 312, 313, 314, 370, 371, 372, 373, 374, 390, 450, 460, 470, 480, 520, 530, 600, 631, 632, 650, 920}},
    {1, {0, 10, 20, 30, 330}},
    {2, {960, 970}},
    {3, {900, 910}},
    {5, {940, 950}},
    {6, {200, 210}},
    {7, {400, 410, 420}},
    {9, {220, 230}},
    {10, {730, 740, 760, 800, 810, 820, 830, 840, 842, 843, 850, 860, 870, 880, 890}},
    {11, {500, 510}},
    {12, {660, 670}},
    {13, {430, 440, 490}},
    {14, {540, 550, 560, 570, 580, 590}},
    {15, {610, 620, 630, 640}},
    {16, {170, 180, 190}},
    {17, {150, 160}},
    {18, {680, 690}},
    {19, {980, 990}},
    {20, {1120, 1130, 1070}},
    {21, {103, 113}},
};

// DGSHAPE 2-7, with the groups of its sections.
const Groups kDgshapeList = {
    {0, {40, 100, 280, 390, 530, 920}},
    {1, {0, 10, 20, 30}},
    {2, {170, 180, 190}},
    {3, {900, 910}},
    {6, {200, 210}},
    {7, {400, 410, 420}},
    {8, {430, 490}},
    {9, {800, 810, 820, 830, 850, 860, 890}},
    {10, {980, 990}},
    {11, {500, 510}},
    {12, {540, 550, 560, 570, 580, 590}},
};

// RS-274/NGC 3.4, table 4, and the groups and the list of G codes of LinuxCNC; here the cycles have their own group.
const Groups kIsoList = {
    {0, {40, 50, 51, 52, 53, 70, 80, 100, 280, 281, 300, 301, 331, 411, 421, 432, 520, 530, 760, 920, 921, 922, 923}},
    {1, {0, 10, 20, 30, 330, 382, 383, 384, 385}},
    {2, {170, 180, 190}},
    {3, {900, 910}},
    {4, {901, 911}},
    {5, {930, 940, 950}},
    {6, {200, 210}},
    {7, {400, 410, 420}},
    {8, {430, 431, 490}},
    {9, {730, 740, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890}},
    {10, {980, 990}},
    {12, {540, 550, 560, 570, 580, 590, 591, 592, 593}},
    {13, {610, 611, 640}},
    {14, {960, 970}},
};

// The list at the head of the SERIES 8 reference; the groups are those of the M700 for the same things.
const Groups kSeries8List = {
    {0, {40, 60, 100, 340, 350, 360, 430, 490, 500, 510, 670, 680, 690, 920, 980}},
    {1, {0, 10, 20, 30, 210, 220, 230}},
    {2, {170, 180, 190}},
    {3, {900, 910}},
    {5, {930, 940, 950}},
    {6, {700, 710}},
    {7, {400, 410, 420}},
    {9, {800, 810, 820, 830, 840, 850, 860, 870, 880, 890}},
    {11, {570, 580}},
    {16, {550, 560}},
    {17, {960, 970}},
};

std::map<int, unsigned> flat(const Groups& groups) {
  std::map<int, unsigned> codes;
  for (const auto& [group, list] : groups) {
    for (int code : list) EXPECT_TRUE(codes.emplace(code, group).second) << code << " is listed twice";
  }
  return codes;
}

std::string g_text(int code) {
  char text[8];
  g_code_text('G', code, text, sizeof text);
  return text;
}

void expect_list(const Dialect& family, const std::map<int, unsigned>& listed) {
  for (const auto& [code, group] : listed) {
    const FunctionRow* row = find_function(family, code);
    ASSERT_NE(row, nullptr) << g_text(code) << " is in the manual's list and not in the table";
    EXPECT_EQ(row->group, group) << g_text(code);
  }
  for (const FunctionRow& row : family.functions) {
    EXPECT_EQ(listed.count(row.code), 1u)
        << g_text(row.code) << " is in the table and not in the manual's list";
  }
}

TEST(M700Manual, GCodesAndGroupsAreThoseOf37) {
  std::map<int, unsigned> listed = flat(kM700List);
  EXPECT_EQ(listed.size(), 133u);
  for (int code = 100; code <= 255; ++code)
    listed.emplace(code * 10, 0u);  // "100 to 255, user macro (G code call)"
  expect_list(m700(), listed);
  for (const char* unlisted : {"G14", "G24", "G25", "G26", "G32"}) {
    EXPECT_EQ(find_function(m700(), std::stoi(unlisted + 1) * 10), nullptr) << unlisted;
  }
}

TEST(DgshapeManual, GCodesAndGroupsAreThoseOf27) {
  expect_list(dgshape(), flat(kDgshapeList));
}

// The alarms of a control without a function, from the alarm list (appendix 1 and, where named, the section).
TEST(M700Manual, MissingFunctionsRaiseTheManualsAlarm) {
  const std::map<std::string, std::vector<int>> by_alarm = {
      {"P180", {720, 770, 780, 790}},
      {"P270", {1010, 1100, 2000, 2020}},
      {"P900", {411, 421}},
      {"P940", {434, 435}},
      {"P39", {631, 632, 700, 710}},
      {"P34", {1000, 1110, 1990, 2030, 2550}},
  };
  for (const auto& [alarm, codes] : by_alarm) {
    for (int code : codes) {
      const FunctionRow* row = find_function(m700(), code);
      ASSERT_NE(row, nullptr) << g_text(code);
      ASSERT_NE(row->missing, nullptr) << g_text(code);
      EXPECT_EQ(row->missing, alarm) << g_text(code);
    }
  }
  // No other row may have one of these alarms, and none may have lost it, since its code would then be executed.
  for (const FunctionRow& row : m700().functions) {
    if (row.missing == nullptr || row.function == Function::user_macro) continue;
    const auto listed = by_alarm.find(row.missing);
    ASSERT_NE(listed, by_alarm.end()) << g_text(row.code);
    EXPECT_EQ(std::count(listed->second.begin(), listed->second.end(), row.code), 1) << g_text(row.code);
  }
}

TEST(M700Manual, CodesOfOneFunctionAreBoundAlike) {
  const std::map<int, Function> bound = {
      {0, Function::rapid},
      {10, Function::linear},
      {20, Function::arc_cw},
      {30, Function::arc_ccw},
      {170, Function::plane_xy},
      {180, Function::plane_zx},
      {190, Function::plane_yz},
      {200, Function::inch},
      {210, Function::metric},
      {21, Function::spiral_cw},
      {31, Function::spiral_ccw},
      {23, Function::exponential_positive},
      {33, Function::exponential_negative},
      {24, Function::space_arc_first},
      {34, Function::space_arc_second},
      {71, Function::cylinder},
      {1070, Function::cylinder},
      {121, Function::polar_on},
      {1120, Function::polar_on},
      {131, Function::polar_off},
      {1130, Function::polar_off},
      {150, Function::polar_command_off},
      {160, Function::polar_command_on},
      {410, Function::comp_left},
      {420, Function::comp_right},
      {430, Function::length_plus},
      {440, Function::length_minus},
      {540, Function::work_system},
      {541, Function::extended_system},
      {500, Function::scaling_off},
      {510, Function::scaling_on},
      {680, Function::rotation_on},
      {690, Function::rotation_off},
      {590, Function::work_system},
      {730, Function::cycle_step},
      {810, Function::cycle_drill},
      {820, Function::cycle_spot},
      {830, Function::cycle_peck},
      {850, Function::cycle_bore_feed},
      {890, Function::cycle_bore_dwell},
      {900, Function::absolute},
      {910, Function::incremental},
      {920, Function::coordinate_set},
      {921, Function::coordinate_preset},
      {980, Function::return_initial},
      {990, Function::return_r},
  };
  for (const auto& [code, function] : bound)
    EXPECT_EQ(find_function(m700(), code)->function, function) << g_text(code);
  // The codes that both families have mean the same.
  for (const FunctionRow& row : dgshape().functions) {
    const FunctionRow* other = find_function(m700(), row.code);
    ASSERT_NE(other, nullptr) << g_text(row.code);
    EXPECT_EQ(other->group, row.group) << g_text(row.code);
    if (row.function == Function::comp_corner_turn) continue;  // G39: there it stands alone in its block, and its words go nowhere
    EXPECT_EQ(other->function, row.function) << g_text(row.code);
  }
}

TEST(M700Manual, EveryCancelCodeOfAMissingFunctionIsAccepted) {
  for (int code : {401}) {
    EXPECT_EQ(find_function(m700(), code)->function, Function::normal_line_off) << g_text(code);
  }
}

TEST(M700Manual, StateAtPowerOn) {
  const std::set<std::string> expected = {"G01", "G17", "G21",   "G90",   "G94",   "G97", "G40",
                                          "G49", "G50", "G50.1", "G54",   "G64",   "G67", "G69",
                                          "G80", "G98", "G15",   "G13.1", "G40.1", "G23"};
  std::set<std::string> active;
  for (const int16_t code : to_public(m700(), initial_modal(m700())).code) {
    if (code >= 0) active.insert(g_text(code));
  }
  EXPECT_EQ(active, expected);
}

// The rows "code <tab> message <tab> meaning" of the catalogue. A message "-" marks a code that stands in the
// text only.
TEST(M700Manual, AlarmListIsTheManuals) {
  const std::string path = nc::test::kSharedDir + "/spec/m700-program-errors.tsv";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << path << " is not here";
  std::map<std::string, std::string> ours;
  for (const AlarmText& alarm : m700().alarms) ours[alarm.code] = alarm.message;
  std::string line;
  std::getline(file, line);
  ASSERT_EQ(line.rfind("code\tmessage\t", 0), 0u);
  unsigned rows = 0;
  while (std::getline(file, line)) {
    const size_t first = line.find('\t');
    const size_t second = line.find('\t', first + 1);
    ASSERT_NE(second, std::string::npos) << line;
    const std::string code = line.substr(0, first), message = line.substr(first + 1, second - first - 1);
    ++rows;
    ASSERT_EQ(ours.count(code), 1u) << code;
    if (message != "-") {
      EXPECT_EQ(ours[code], message) << code;
    }
    ours.erase(code);
  }
  EXPECT_GE(rows, 180u);
  // These are not in the manual; m700/alarms.cpp gives the reasons.
  std::set<std::string> rest;
  for (const auto& [code, message] : ours) rest.insert(code);
  EXPECT_EQ(rest, (std::set<std::string>{"M01-0007", "NC-INTERNAL", "NC-RESTART", "NC-TAP", "NC-VENDOR", "P452"}));
}

std::string code_of(const Dialect& family, Condition condition) {
  return alarm_text(family, Fault{condition}).code;
}

TEST(M700Manual, ConditionsHaveTheCodesThatTheSectionsPrint) {
  const std::map<Condition, const char*> printed = {
      {Condition::illegal_character, "P32"},
      {Condition::illegal_address, "P32"},
      {Condition::format_error, "P33"},
      {Condition::illegal_g, "P34"},
      {Condition::value_range, "P35"},
      {Condition::program_end, "P36"},
      {Condition::number_zero, "P37"},
      {Condition::no_function, "P39"},
      {Condition::no_feed, "P62"},
      {Condition::arc_deviation, "P70"},
      {Condition::arc_center, "P71"},
      {Condition::plane_mismatch, "P113"},
      {Condition::plane_in_compensation, "P112"},
      {Condition::arc_in_compensation_start, "P151"},
      {Condition::no_offset_number, "P170"},
      {Condition::comp_no_intersection, "P152"},
      {Condition::comp_interference, "P153"},
      {Condition::cycle_in_compensation, "P155"},
      {Condition::skip_in_compensation, "P608"},
      {Condition::skip_feed_zero, "P603"},
      {Condition::data_input_kind, "P172"},
      {Condition::local_in_extended, "P438"},
      {Condition::index_increment, "P20"},
      {Condition::program_missing, "P232"},
      {Condition::sequence_missing, "P231"},
      {Condition::nesting, "P230"},
      {Condition::macro_nesting, "P273"},
      {Condition::macro_and_words, "P272"},
      {Condition::user_alarm, "P277"},
      {Condition::cancel_without_call, "P276"},
      {Condition::bracket_nesting, "P280"},
      {Condition::bracket_pair, "P281"},
      {Condition::calculation, "P282"},
      {Condition::division_by_zero, "P283"},
      {Condition::if_statement, "P290"},
      {Condition::while_statement, "P291"},
      {Condition::name_statement, "P292"},
      {Condition::loop_nesting, "P293"},
      {Condition::loop_pair, "P294"},
      {Condition::variable_number, "P241"},
      {Condition::no_equals, "P242"},
      {Condition::variable_use, "P243"},
      {Condition::read_failed, "P461"},
      {Condition::no_reference, "P430"},
  };
  for (const auto& [condition, code] : printed) EXPECT_EQ(code_of(m700(), condition), code);
}

TEST(M700Manual, WordsTakeTheDigitsOf32) {
  const auto digits = [](char letter) { return iso_rules_of(*m700().lex).word[letter - 'A'].integer_digits; };
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    EXPECT_TRUE(iso_rules_of(*m700().lex).word[letter - 'A'].known) << letter;
  EXPECT_EQ(digits('O'), 8);
  EXPECT_EQ(digits('N'), 6);
  EXPECT_EQ(digits('G'), 3);
  EXPECT_EQ(digits('L'), 4);
  for (char letter : {'M', 'S', 'T', 'P', 'F'}) EXPECT_EQ(digits(letter), 8) << letter;
  for (char letter : {'X', 'Y', 'Z', 'I', 'J', 'K', 'R', 'Q'})
    EXPECT_EQ(digits(letter), 11) << letter;  // 5.6, and 4.7 in inch
}

TEST(DgshapeManual, WordsAreThoseOf27) {
  const std::string known = "AIJKNORXYZGMFSTPDHLQ";
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    EXPECT_EQ(iso_rules_of(*dgshape().lex).word[letter - 'A'].known, known.find(letter) != std::string::npos) << letter;
  }
  EXPECT_FALSE(dgshape().lex->macros);
  EXPECT_EQ(dgshape().lex->semicolon, Semicolon::unknown);
  EXPECT_TRUE(dgshape().percent_required);
  EXPECT_TRUE(dgshape().end_code_required);
}

TEST(IsoManual, GCodesAndGroupsAreThoseOfTheLists) {
  expect_list(iso(), flat(kIsoList));
}

TEST(IsoManual, WordsAreThoseOfTable2) {  // RS-274/NGC 3.3.2; E of M66 to M68 and U V W are LinuxCNC's, O begins a control structure
  for (char letter = 'A'; letter <= 'Z'; ++letter) EXPECT_EQ(iso_rules_of(*iso().lex).word[letter - 'A'].known, letter != 'O') << letter;
  EXPECT_EQ(iso().lex->semicolon, Semicolon::comment);
  EXPECT_FALSE(iso().percent_required);
}

TEST(IsoManual, MCodesOfModalStateAndSubProgramsAreNotBuilt) {  // LinuxCNC "M-Codes"
  for (unsigned code : {0u, 1u, 2u, 30u, 48u, 49u, 50u, 51u, 52u, 53u, 60u, 61u, 62u, 63u, 64u, 65u, 66u, 67u, 68u}) {
    ASSERT_NE(find_misc(iso(), code), nullptr) << code;
    EXPECT_EQ(find_misc(iso(), code)->missing, nullptr) << code;
  }
  for (unsigned code : {70u, 71u, 72u, 73u, 98u, 99u}) {
    ASSERT_NE(find_misc(iso(), code), nullptr) << code;
    EXPECT_NE(find_misc(iso(), code)->missing, nullptr) << code;
  }
  for (unsigned code : {7u, 8u, 9u, 19u, 100u, 199u}) EXPECT_EQ(find_misc(iso(), code), nullptr) << code;
}

TEST(HxManual, GCodesAndGroupsAreThoseOfTheList) { expect_list(hx(), flat(kHxList)); }

TEST(Series8Manual, GCodesAndGroupsAreThoseOfTheList) { expect_list(dialect(NC_DIALECT_SERIES8), flat(kSeries8List)); }

TEST(HxManual, StateAtPowerOn) {  // 3.2, 5.2.1, 5.3.3
  const std::set<std::string> expected = {"G00", "G97", "G90", "G94", "G21", "G40", "G23", "G80", "G50", "G67",
                                          "G49", "G54", "G64", "G17", "G15", "G69", "G98", "G113", "G11.3"};
  std::set<std::string> active;
  for (const int16_t code : to_public(hx(), initial_modal(hx())).code)
    if (code >= 0) active.insert(g_text(code));
  EXPECT_EQ(active, expected);
}

TEST(HxManual, ConditionsHaveTheNumbersThatTheSectionsPrint) {
  const std::map<Condition, const char*> printed = {
      {Condition::illegal_character, "F_82001"}, {Condition::arc_deviation, "F_82112"},     {Condition::arc_center, "F_82100"},
      {Condition::block_too_long, "F_82111"},    {Condition::reference_compare, "F_82209"}, {Condition::no_feed, "F_84020"},
      {Condition::measure_signal, "F_84022"},    {Condition::program_end, "F_82016"},       {Condition::sequence_missing, "F_82019"},
      {Condition::polar_code, "F_82204"},        {Condition::polar_state, "F_82204"},       {Condition::mill_code, "F_82208"},         {Condition::mill_axis, "F_82208"},         {Condition::illegal_g, "F_82030"},
  };
  for (const auto& [condition, code] : printed) EXPECT_EQ(code_of(hx(), condition), code);
}

TEST(DgshapeManual, HasNoSubPrograms) {
  EXPECT_EQ(dgshape().call_depth, 0u);
  for (unsigned code : {98u, 99u}) {
    ASSERT_NE(find_misc(dgshape(), code), nullptr);
    EXPECT_NE(find_misc(dgshape(), code)->missing, nullptr);
  }
}

}  // namespace
}  // namespace nc
