// SPDX-License-Identifier: Apache-2.0
// Each range of each family (dialect/<family>/ranges.hpp) is the one that its programs are held to: with another value in the family's row, and nothing else
// changed, the same program gets the alarm or no longer gets it.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <variant>

#include "families.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

using Member = std::variant<uint32_t RangeRules::*, double RangeRules::*>;
using R = RangeRules;

double value_of(const RangeRules& ranges, const Member& member) {
  return std::visit([&](auto which) { return static_cast<double>(ranges.*which); }, member);
}

struct NamedMember {
  const char* name;
  Member member;
};
const NamedMember kMembers[] = {
    {"largest_program", &R::largest_program},
    {"largest_misc", &R::largest_misc},
    {"largest_second_misc", &R::largest_second_misc},
    {"largest_spindle_value", &R::largest_spindle_value},
    {"largest_tool", &R::largest_tool},
    {"end_of_positions_mm", &R::end_of_positions_mm},
    {"end_of_positions_inch", &R::end_of_positions_inch},
    {"end_of_radius_mm", &R::end_of_radius_mm},
    {"end_of_radius_inch", &R::end_of_radius_inch},
    {"end_of_revolution_feed", &R::end_of_revolution_feed},
    {"end_of_inverse_time", &R::end_of_inverse_time},
    {"end_of_lead_mm", &R::end_of_lead_mm},
    {"end_of_lead_inch", &R::end_of_lead_inch},
    {"end_of_fine_lead_inch", &R::end_of_fine_lead_inch},
    {"end_of_ridges_mm", &R::end_of_ridges_mm},
    {"end_of_ridges_inch", &R::end_of_ridges_inch},
    {"most_arc_turns", &R::most_arc_turns},
    {"most_call_repeats", &R::most_call_repeats},
    {"most_hole_repeats", &R::most_hole_repeats},
    {"most_holes", &R::most_holes},
    {"most_pitches", &R::most_pitches},
    {"least_curve_weight", &R::least_curve_weight},
    {"most_curve_weight", &R::most_curve_weight},
    {"steepest_exponential_deg", &R::steepest_exponential_deg},
    {"most_current_percent", &R::most_current_percent},
    {"least_scale", &R::least_scale},
    {"most_scale", &R::most_scale},
    {"least_in_position_mm", &R::least_in_position_mm},
    {"most_in_position_mm", &R::most_in_position_mm},
    {"most_return_speed", &R::most_return_speed},
    {"largest_turn_vector", &R::largest_turn_vector},
    {"largest_turn_deg", &R::largest_turn_deg},
    {"longest_input_wait_s", &R::longest_input_wait_s},
    {"largest_calling_value", &R::largest_calling_value},
    {"largest_alarm", &R::largest_alarm},
    {"most_workpieces", &R::most_workpieces},
    {"longest_counter_ms", &R::longest_counter_ms},
    {"first_year", &R::first_year},
    {"last_year", &R::last_year},
    {"largest_parameter", &R::largest_parameter},
    {"largest_device", &R::largest_device},
    {"largest_life_number", &R::largest_life_number},
    {"most_life_minutes", &R::most_life_minutes},
    {"most_life_times", &R::most_life_times},
};

using Parameters = std::map<std::string, std::string>;

/// A program whose last line has the alarm of `condition` where the member of the family has the value `moved`, and another alarm, or none, where it has its
/// own.
struct Row {
  const char* member;
  double moved;
  const char* program;
  Parameters parameters{};
  const char* axes = "XYZ";
  Condition condition = Condition::value_range;
};

const std::map<nc_dialect, std::vector<Row>> kRows = {
    {NC_DIALECT_M700,
     {
         {"largest_program", 4, "M98 P5"},
         {"largest_misc", 76, "M77"},
         {"largest_second_misc", 4, "B5"},
         {"largest_spindle_value", 499, "S500"},
         {"largest_spindle_value", 499, "G92 S500", {{"1146", "1"}}},
         {"largest_tool", 4, "T5"},
         {"end_of_positions_mm", 50, "G0 X50."},
         {"end_of_positions_inch", 2, "G20\nG0 X2."},
         {"end_of_radius_mm", 50, "G10 L12 P1 R50.", {{"1037", "2"}}},
         {"end_of_radius_inch", 2, "G20\nG10 L12 P1 R2.", {{"1037", "2"}}},
         {"end_of_revolution_feed", 2, "G95 G1 X1. F2."},
         {"end_of_inverse_time", 2, "G93 G1 X1. F2."},
         {"end_of_lead_mm", 2, "G33 Z-20. F2.", {}, "XYZ", Condition::thread_lead},
         {"end_of_lead_mm", 2, "G84 Z-5. R-1. F2. S500 ,R1", {}, "XYZ", Condition::tap_pitch},
         {"end_of_lead_inch", 2, "G20\nG33 Z-1. F2.", {}, "XYZ", Condition::thread_lead},
         {"end_of_lead_inch", 2, "G20\nG84 Z-1. R-.5 F2. S500 ,R1", {}, "XYZ", Condition::tap_pitch},
         {"end_of_fine_lead_inch", 2, "G20\nG33 Z-1. E2.", {{"1229/bit1", "1"}}, "XYZ", Condition::thread_lead},
         {"end_of_ridges_mm", 3, "G33 Z-20. E3.", {}, "XYZ", Condition::thread_lead},
         {"end_of_ridges_inch", 3, "G20\nG33 Z-1. E3.", {}, "XYZ", Condition::thread_lead},
         {"most_arc_turns", 2, "G17 G2 X0 Y0 I5. P3 F100"},
         {"most_call_repeats", 2, "M98 P5 L3"},
         {"most_hole_repeats", 2, "G91 G81 X1. Z-1. R-1. F100 L3"},
         {"most_holes", 9, "G81 Z-1. R0 F100 L0\nG34 X0 Y0 I10. J0 K10"},
         {"most_pitches", 1, "G2.1 X60. I100. P2 F300"},
         {"least_curve_weight", 2, "G5 P10000\nG1 X0 F300\nG6.2 P2 K0 X0 Y0 R1."},
         {"most_curve_weight", 0.5, "G5 P10000\nG1 X0 F300\nG6.2 P2 K0 X0 Y0 R1."},
         {"steepest_exponential_deg", 40, "G91 G2.3 X10. I50. J30. R105. F500", {{"1514", "X"}, {"1515", "C"}}, "XYZc"},
         {"most_current_percent", 49, "G10 L14 X50"},
         {"least_scale", 3, "G51 X0 Y0 P2."},
         {"most_scale", 1, "G51 X0 Y0 P2."},
         {"least_in_position_mm", 1, "G0 X1. ,I0.5"},
         {"most_in_position_mm", 0.1, "G0 X1. ,I0.5"},
         {"most_return_speed", 299, "G84 Z-5. R-1. F1. S500 ,R1 ,S300"},
         {"largest_turn_vector", 1, "G10 I2. J0"},
         {"largest_turn_deg", 20, "G10 K30."},
         {"largest_calling_value", 1000, "D2000", {{"7401", "1"}, {"7402", "68"}, {"7403", "1"}, {"7404", "3000"}}},
         {"largest_alarm", 49, "#3000=50"},
         {"most_workpieces", 49, "#3901=50"},
         {"longest_counter_ms", 49, "#3001=50"},
         {"first_year", 2027, "#3011=20261128"},
         {"last_year", 2025, "#3011=20261128"},
         {"largest_parameter", 1999, "#100000=2000", {}, "XYZ", Condition::no_such_data},
         {"largest_device", 49, "#100101=50", {}, "XYZ", Condition::no_such_data},
         {"largest_life_number", 4, "#60000=5"},
         {"largest_life_number", 4, "G10 L3\nP5 L1"},
         {"largest_life_number", 4, "G10 L3\nP1 L1\nT5"},
         {"most_life_minutes", 9, "G10 L3\nP1 L10 Q2"},
         {"most_life_times", 9, "G10 L3\nP1 L10 Q1"},
         {"most_life_times", 9, "G10 L3\nP1 L10 Q3"},
     }},
    {NC_DIALECT_DGSHAPE,
     {
         {"largest_misc", 2, "S1000\nM03"},
         {"largest_spindle_value", 499, "S500"},
         {"largest_tool", 4, "T5 M06"},
         {"end_of_positions_mm", 50, "G0 X50."},
         {"end_of_positions_inch", 2, "G20\nG0 X2."},
         {"end_of_radius_mm", 50, "G10 P1 R50."},
         {"end_of_radius_inch", 2, "G20\nG10 P1 R2."},
         {"most_hole_repeats", 2, "S1000\nM03\nG91 G81 X1. Z-1. R1. F100 K3"},
     }},
    {NC_DIALECT_HX,
     {
         {"largest_program", 4, "M98 P5"},
         {"largest_misc", 76, "M77"},
         {"largest_spindle_value", 499, "S500"},
         {"largest_tool", 4, "T5"},
         {"end_of_positions_mm", 50, "G0 X50."},
         {"end_of_positions_inch", 2, "G20\nG0 X2."},
         {"end_of_radius_mm", 50, "G10 L12 P1 R50."},
         {"end_of_radius_inch", 2, "G20\nG10 L12 P1 R2."},
         {"end_of_revolution_feed", 2, "G95 G1 X1. F2."},
         {"end_of_lead_mm", 2, "G33 Z-20. F2.", {}, "XYZ", Condition::thread_lead},
         {"end_of_lead_inch", 2, "G20\nG33 Z-1. F2.", {}, "XYZ", Condition::thread_lead},
         {"most_call_repeats", 2, "M98 P5 L3"},
         {"most_hole_repeats", 2, "G91 G81 X1. Z-1. R-1. F100 K3"},
         {"most_hole_repeats", 2, "G91 G81 X1. Z-1. R-1. F100 L3"},
         {"least_scale", 3, "G51 X0 Y0 Z0 P2000"},
         {"most_scale", 1, "G51 X0 Y0 Z0 P2000"},
     }},
    {NC_DIALECT_SERIES8,
     {
         {"largest_misc", 76, "M77"},
         {"largest_spindle_value", 499, "S500"},
         {"largest_tool", 4, "T5"},
         {"end_of_positions_mm", 50, "G0 X50."},
         {"end_of_positions_inch", 2, "G70\nG0 X2."},
         {"end_of_revolution_feed", 2, "G95\nG1 X1. F2."},
         {"end_of_inverse_time", 2, "G93 F2."},
         {"end_of_lead_mm", 2, "M03 S500\nG84 Z-1. R1. K2.", {}, "XYZ", Condition::tap_pitch},
         {"most_holes", 9, "G81 Z-1. R1. F100\nG49 I1. J1. K10 L2"},
         {"least_scale", 3, "G57 R2."},
         {"most_scale", 1, "G57 R2."},
     }},
    {NC_DIALECT_ISO,
     {
         {"largest_misc", 76, "M77"},
         {"largest_spindle_value", 499, "S500"},
         {"largest_spindle_value", 499, "G96 S100 D500"},
         {"largest_tool", 4, "T5"},
         {"largest_tool", 4, "M61 Q5"},
         {"end_of_positions_mm", 50, "G0 X50"},
         {"end_of_positions_inch", 2, "G20\nG0 X2"},
         {"end_of_revolution_feed", 2, "G95 G1 X1 F2"},
         {"end_of_inverse_time", 2, "G93 G1 X1 F2"},
         {"end_of_lead_mm", 2, "M3 S500\nG33 Z-20 K2", {}, "XYZ", Condition::thread_lead},
         {"end_of_lead_inch", 2, "G20\nM3 S500\nG33 Z-1 K2", {}, "XYZ", Condition::thread_lead},
         {"longest_input_wait_s", 2, "M66 P0 L3 Q3"},
         {"most_arc_turns", 2, "G2 X0 Y0 I5 P3 F100"},
         {"most_hole_repeats", 2, "G91 G81 X1 Z-1 R1 L3 F100"},
     }},
};

std::string program_of(nc_dialect id, const Row& row) { return std::string(families()[id].percent_required ? "%\n" : "") + row.program; }

/// Runs a program on a control of the family. `line` becomes the line of its alarm.
std::string alarm_of(nc_dialect id, const Row& row, unsigned* line) {
  Bench bench(id, axes(row.axes));
  for (const auto& [key, value] : row.parameters) bench.param(key.c_str(), value.c_str());
  const Outcome run = bench.at(0, 0, 0).run(program_of(id, row));
  *line = run.alarm_line;
  return run.alarm;
}

TEST(Ranges, EachIsThatOfTheFamilysRow) {
  for (const auto& [id, rows] : kRows) {
    RangeRules& ranges = families()[id].rules.range;
    const RangeRules own = ranges;
    std::set<std::string> tried{"largest_program"};  // all families have it, for names of files (below)
    if (id == NC_DIALECT_DGSHAPE) tried.insert({"least_scale", "most_scale"});  // a factor beyond them is no fault (below)
    for (const Row& row : rows) {
      const std::string text = program_of(id, row);
      SCOPED_TRACE(std::string(families()[id].name) + " " + row.member + ": " + text);
      tried.insert(row.member);
      unsigned line = 0;
      const std::string alarm = alarm_text(families()[id], Fault{.condition = row.condition}).code;
      EXPECT_NE(alarm_of(id, row, &line), alarm) << "with the family's own value";
      for (const NamedMember& named : kMembers)
        if (std::string(named.name) == row.member) std::visit([&](auto which) { ranges.*which = static_cast<std::remove_reference_t<decltype(ranges.*which)>>(row.moved); }, named.member);
      EXPECT_EQ(alarm_of(id, row, &line), alarm);
      EXPECT_EQ(line, 1 + std::count(text.begin(), text.end(), '\n'));
      ranges = own;
    }
    for (const NamedMember& named : kMembers) EXPECT_EQ(value_of(own, named.member) != 0, tried.count(named.name) != 0) << families()[id].name << " " << named.name;
  }
}

// HX 11: M00 to M999. DGSHAPE, K of cycles: 0 to 9999.
TEST(Ranges, EndWhereTheManualsPrintIt) {
  const auto alarm = [](nc_dialect id, const std::string& program) {
    Bench bench(id);
    return bench.at(0, 0, 0).run(program).alarm;
  };
  EXPECT_EQ(alarm(NC_DIALECT_HX, "M999\nM30"), "");
  EXPECT_EQ(alarm(NC_DIALECT_HX, "M1000\nM30"), "F_82002");
  const std::string cycle = "%\nS1000\nM03\nG81 X1. Z-1. R1. F100 K";
  EXPECT_NE(alarm(NC_DIALECT_DGSHAPE, cycle + "9999\nM02"), "NC-RANGE");
  EXPECT_EQ(alarm(NC_DIALECT_DGSHAPE, cycle + "10000\nM02"), "NC-RANGE");
}

TEST(Ranges, ALongerNumberInTheNameOfAFileIsNoNumberOfAProgram) {
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    RangeRules& ranges = families()[id].rules.range;
    const RangeRules own = ranges;
    for (const uint32_t largest : {own.largest_program, 1233u}) {
      ranges.largest_program = largest;
      Bench bench(static_cast<nc_dialect>(id));
      const char letter = families()[id].lex->program_letter;
      const std::string name = std::string(1, letter != 0 ? letter : 'O') + "1234.nc";
      unsigned place = 0;
      ASSERT_EQ(nc_program_add_text(bench.control(), name.c_str(), "", 0, &place), NC_OK);
      nc_program_info info;
      nc_program_info_init(&info);
      ASSERT_EQ(nc_program_get(bench.control(), place, &info), NC_OK);
      EXPECT_EQ(info.number, largest == 1233 ? 0u : 1234u) << families()[id].name;
      ranges = own;
    }
  }
}

TEST(Ranges, AFactorBeyondThemIsHeldWhereItIsNoFault) {  // DGSHAPE G51
  RangeRules& ranges = families()[NC_DIALECT_DGSHAPE].rules.range;
  const RangeRules own = ranges;
  const auto end = [](const char* factor) {
    Bench bench(NC_DIALECT_DGSHAPE);
    const Outcome run = bench.at(0, 0, 0).run(std::string("%\nG51 X0 Y0 Z0 P") + factor + "\nG0 X10.");
    return run.moves().empty() ? run.alarm : brief(run.moves().back().machine.v[0]);
  };
  EXPECT_EQ(end("2."), "20");
  EXPECT_EQ(end("0.5"), "5");
  ranges.most_scale = 1.5;
  ranges.least_scale = 0.8;
  EXPECT_EQ(end("2."), "15");
  EXPECT_EQ(end("0.5"), "8");
  ranges = own;
}

// The parameters of the factors (M700 #8072; HX PI 108 to 110): one beyond the range counts as 1.
TEST(Ranges, AParameterBeyondThemCountsAsOne) {
  for (const auto& [id, key, value, code] : {std::tuple{NC_DIALECT_M700, "8072", "2", "G51 X0 Y0"}, {NC_DIALECT_HX, "3108", "2000", "G51 X0 Y0 Z0"}}) {
    RangeRules& ranges = families()[id].rules.range;
    const RangeRules own = ranges;
    for (const double most : {own.most_scale, 1.5}) {
      ranges.most_scale = most;
      Bench bench(id);
      const Outcome run = bench.param(key, value).at(0, 0, 0).run(std::string(code) + "\nG0 X10.");
      ASSERT_FALSE(run.moves().empty()) << run.alarm;
      EXPECT_EQ(run.moves().back().machine.v[0], most == 1.5 ? 10 : 20) << families()[id].name;
      ranges = own;
    }
  }
}

TEST(Ranges, TheHostIsHeldToThoseOfTheLivesOfTools) {
  RangeRules& ranges = families()[NC_DIALECT_M700].rules.range;
  const RangeRules own = ranges;
  constexpr double kMounts = 16;  // NC_LIFE_FLAGS
  const auto set = [](Bench& bench, nc_life_column column, double value) { return nc_tool_life_set(bench.control(), 1, column, value) == NC_OK; };
  for (const bool moved : {false, true}) {
    if (moved) ranges.largest_life_number = 10, ranges.most_life_minutes = 20, ranges.most_life_times = 30;
    for (const nc_life_column column : {NC_LIFE_GROUP, NC_LIFE_TOOL, NC_LIFE_LIFE, NC_LIFE_USED}) {
      for (const double flags : {0.0, kMounts}) {
        Bench bench;
        ASSERT_TRUE(set(bench, NC_LIFE_FLAGS, flags));
        const double most = column <= NC_LIFE_TOOL ? (moved ? 10 : 99999999) : flags == 0 ? (moved ? 20 : 4000) : moved ? 30 : 9999;
        EXPECT_FALSE(set(bench, column, most + 1)) << column;
        EXPECT_TRUE(set(bench, column, most)) << column;
        ASSERT_TRUE(set(bench, NC_LIFE_GROUP, 1));
        EXPECT_EQ(set(bench, NC_LIFE_FLAGS, 0), column <= NC_LIFE_TOOL || flags == 0) << "what is longer than minutes can be does not become minutes";
        for (const nc_life_column cleared : {NC_LIFE_GROUP, NC_LIFE_TOOL, NC_LIFE_FLAGS}) EXPECT_TRUE(set(bench, cleared, 0)) << "a row is cleared in the order of its columns";
        EXPECT_EQ(set(bench, NC_LIFE_GROUP, 1), column <= NC_LIFE_TOOL || flags == 0) << "nor is a tool registered with it";
      }
    }
  }
  ranges = own;
}

}  // namespace
}  // namespace nc::test
