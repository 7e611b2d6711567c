// SPDX-License-Identifier: Apache-2.0
// What a search for a place has written into variables, offsets, tool lives and outputs: it stays only where the program goes on from that place.
#include "restart_fixture.hpp"

namespace {

using namespace nc::rt;
using namespace nc::test::inside;

// A search reads the program with what it writes. Where the program does not go on from its place, nothing of that stays.
class SearchedWrites : public Restart {
 protected:
  void begin(const std::string& more = "") {
    build(more);
    ASSERT_EQ(runtime->change([](nc_control* control) {
      (void)nc_work_offset_set(control, 0, 1, 0, -3);
      (void)nc_variable_set(control, 0, 500, 7, false);
      (void)nc_variable_set(control, 0, 501, 0, true);
    }), Answer::kDone);
    select("G90 G54\nG91 G10 L2 P1 X1.\n#500=#500+1\n#501=5\nG90 G0 X5.\nX6.\nM30\n");
  }
  void search(unsigned line = 6, RestartPhase phase = RestartPhase::kFound) {
    ASSERT_EQ(find(RestartBy::kLine, line), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == phase; })) << restart().text;
  }
  // Offset, the variable that is counted, and whether the other one is vacant.
  std::string values() {
    double offset = 0, counted = 0, other = 0;
    bool vacant = false, other_vacant = false;
    EXPECT_EQ(runtime->look([&](nc_control* control) {
      (void)nc_work_offset_get(control, 0, 1, 0, &offset);
      (void)nc_variable_get(control, 0, 500, &counted, &vacant);
      (void)nc_variable_get(control, 0, 501, &other, &other_vacant);
    }), Answer::kDone);
    char text[64];
    std::snprintf(text, sizeof text, "%g %g %s", offset, counted, other_vacant ? "vacant" : "set");
    return text;
  }
};

TEST_F(SearchedWrites, ArePutBackWhenThePlaceIsGivenUp) {
  ASSERT_NO_FATAL_FAILURE(begin());
  const std::string before = "-3 7 vacant";
  ASSERT_EQ(values(), before);
  ASSERT_NO_FATAL_FAILURE(search());
  EXPECT_EQ(values(), "-2 8 set");
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(values(), before) << "cancelled";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(values(), before) << "a reset";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(values(), before) << "another program";
  ASSERT_NO_FATAL_FAILURE(search(99, RestartPhase::kLost));
  EXPECT_EQ(values(), before) << "not found";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(search(5));
  EXPECT_EQ(values(), "-2 8 set") << "another search begins with what was there before the first one";
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kStands; }));
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(values(), before) << "a reset at the place";
}

// What counts once more is named, and nobody goes on without having seen it. A variable that was vacant cannot have counted, and what has the same value behind the search does not.
TEST_F(SearchedWrites, AreAnEntryToBeConfirmedWhereTheyHaveChangedAnything) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  EXPECT_EQ(now.list.text(now.list.entries()[0]), "written in front of the place: #500 = 8 (it was 7), work offset 1 X = -2 (it was -3)");
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_NO_FATAL_FAILURE(reset());
  select("G90 G54\nG10 L2 P1 X-3.\n#500=7\n#501=5\nG90 G0 X5.\nX6.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search());
  EXPECT_TRUE(restart().list.entries().empty());
}

TEST_F(SearchedWrites, OfManyTheFirstAreNamedAndTheRestCounted) {
  build();
  ASSERT_EQ(runtime->change([](nc_control* control) {
    for (unsigned n = 0; n < 40; ++n) (void)nc_variable_set(control, 0, 500 + n, 1, false);
  }), Answer::kDone);
  select("#1=0\nWHILE[#1LT40]DO1\n#[500+#1]=#1+10\n#1=#1+1\nEND1\nN6G90 G0 X5.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  const std::string text = now.list.text(now.list.entries()[0]);
  EXPECT_NE(text.find("#500 = 10 (it was 1), #501 = 11 (it was 1)"), std::string::npos) << text;
  EXPECT_NE(text.find("and 32 more"), std::string::npos) << text;
}

// The search executes what the program writes, so it needs what a start needs.
TEST_F(SearchedWrites, AProgramThatMayNotBeginIsNotSearched) {
  struct Refuses : StartGate {
    bool may_begin(unsigned, unsigned) override { return false; }
    Looked look_again() override { return Looked::kSame; }
    bool waits(unsigned) override { return false; }
    std::string remark(unsigned) override { return "line 3: the axis is not there"; }
  } gate;
  ASSERT_NO_FATAL_FAILURE(begin());
  runtime->set_start_gate(&gate);
  EXPECT_EQ(find(RestartBy::kLine, 6), Answer::kNotChecked);
  EXPECT_EQ(runtime->explain(Answer::kNotChecked), "line 3: the axis is not there");
  steps(20);
  EXPECT_EQ(restart().phase, RestartPhase::kNone);
  EXPECT_EQ(values(), "-3 7 vacant");
  runtime->set_start_gate(nullptr);
}

TEST_F(SearchedWrites, StayWhereTheProgramGoesOnOrSomebodyElseHasWritten) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_EQ(runtime->change([](nc_control* control) { (void)nc_work_offset_set(control, 0, 1, 0, -8); }), Answer::kDone);
  steps(3);
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(values(), "-8 7 vacant");
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {2u, 1u, 0u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_EQ(values(), "-7 8 set");
}

// The search takes tools of groups, counts their mounts, and registers tools anew.
class SearchedLives : public SearchedWrites {
 protected:
  using Rows = std::map<std::string, double>;
  void begin_lives(const std::string& source, const Rows& rows) {
    build("[parameters]\n\"1103\" = 1\n");
    ASSERT_EQ(runtime->change([&](nc_control* control) {
      for (const auto& [key, value] : rows) EXPECT_EQ(nc_tool_life_set(control, static_cast<unsigned>(key[0] - '0'), static_cast<nc_life_column>(key[2] - '0'), value), NC_OK) << key;
    }), Answer::kDone);
    select(source);
  }
  // "1 5" is the column NC_LIFE_USED of the first tool.
  Rows lives() {
    Rows rows;
    EXPECT_EQ(runtime->look([&](nc_control* control) {
      for (unsigned number = 1; number <= 9; ++number)
        for (unsigned column = 0; column <= NC_LIFE_AUXILIARY; ++column) {
          double value = 0;
          if (nc_tool_life_get(control, number, static_cast<nc_life_column>(column), &value) == NC_OK && value != 0) rows[std::to_string(number) + " " + std::to_string(column)] = value;
        }
    }), Answer::kDone);
    return rows;
  }
};

TEST_F(SearchedLives, ArePutBackWhenThePlaceIsGivenUp) {
  const Rows before = {{"1 0", 7}, {"1 1", 11}, {"1 2", 16}, {"1 4", 3}, {"1 5", 1}, {"2 0", 7}, {"2 1", 12}, {"2 2", 16}, {"2 4", 3}};
  ASSERT_NO_FATAL_FAILURE(begin_lives("T7 M6\nT7 M6\nT7 M6\nG0 X5.\nX6.\nM30\n", before));
  ASSERT_EQ(lives(), before);
  ASSERT_NO_FATAL_FAILURE(search(5));
  EXPECT_NE(lives(), before) << "else it shows nothing";
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(lives(), before) << "cancelled";
  ASSERT_NO_FATAL_FAILURE(search(5));
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(lives(), before) << "a reset";
  ASSERT_NO_FATAL_FAILURE(search(99, RestartPhase::kLost));
  EXPECT_EQ(lives(), before) << "not found";
}

// What is counted decides which lives a tool may have, so no order of the columns fits every change.
TEST_F(SearchedLives, OfMinutesComeBackBehindOnesOfTimesAndTheOtherWayRound) {
  const Rows minutes = {{"1 0", 7}, {"1 1", 11}, {"1 4", 100}, {"1 5", 20.5}}, times = {{"1 0", 7}, {"1 1", 11}, {"1 2", 16}, {"1 4", 9000}, {"1 5", 8000}};
  for (const Rows& before : {minutes, times}) {
    const char* const other = before == minutes ? "G10 L3\nP7 L9000 Q1\nT11\nG11\nT7 M6\nX6.\nM30\n" : "G10 L3\nP7 L100 Q2\nT11\nG11\nT7 M6\nX6.\nM30\n";
    ASSERT_NO_FATAL_FAILURE(begin_lives(other, before));
    ASSERT_EQ(lives(), before);
    ASSERT_NO_FATAL_FAILURE(search(6));
    EXPECT_NE(lives(), before);
    ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
    EXPECT_EQ(lives(), before);
  }
}

// The outputs that the search has written were given out by nobody: a program that writes one bit of their word later gives out that one.
TEST_F(SearchedWrites, OutputsOfASearchThatIsGivenUpAreNotGivenOutLater) {
  build();
  select("#1100=1\n#1101=1\nG0 X5.\nX6.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search(4));
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  select("#1102=1\n#500=#1100\nG0 X1.\nM30\n", "other.nc");
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_EQ(runtime->snapshot().interface_output[0], 4u);
  double read = 0;
  EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_variable_get(control, 0, 500, &read, nullptr); }), Answer::kDone);
  EXPECT_EQ(read, 0);
}

}  // namespace
