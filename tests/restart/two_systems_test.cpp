// SPDX-License-Identifier: Apache-2.0
// Two part systems that are begun inside together, each with a program that writes what both share: a search in one leaves the place of the other, unless that was found with what is put back.
#include <array>
#include <random>

#include "restart_machine.hpp"
#include "runtime/test_config.hpp"
#include "support/seeds.hpp"

namespace {

using namespace nc::rt;

class TwoSystems : public testing::Test {
 protected:
  static constexpr const char* kFirst = "#500=#500+1\nG90 G54 G0 X5. Y5.\nN40 G1 X20. F1200.\nX30.\nM30\n";
  static constexpr const char* kSecond = "#501=#501+1\nG91 G10 L2 P2 X1.\nG90 G0 X5.\nN40 G1 X7. F600.\nX9.\nM30\n";

  void SetUp() override {
    config = nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n");
    machine = std::make_unique<nc::test::PathMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    ASSERT_EQ(runtime->change([](nc_control* control) {
      for (const unsigned number : {500u, 501u, 502u}) (void)nc_variable_set(control, 0, number, 7, false);
    }), Answer::kDone);
    select(0, "first.nc", kFirst);
    select(1, "second.nc", kSecond);
  }
  void select(unsigned system, const char* name, const char* text) {
    Command command;
    command.kind = CommandKind::kSelectProgram;
    command.system = static_cast<std::uint8_t>(system);
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), name, text, std::strlen(text), &file), NC_OK);
    command.number = file;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
  }
  template <class Condition>
  bool until(Condition condition, int most = 100000) {
    while (most-- > 0 && !condition()) runtime->step();
    return condition();
  }
  Answer command(CommandKind kind, std::uint8_t system, std::uint32_t number = 0) {
    Command command;
    command.kind = kind;
    command.system = system;
    command.number = number;
    return runtime->execute(command);
  }
  RestartPhase phase(unsigned system) const { return runtime->info().system[system].restart.phase; }
  std::string said(unsigned system) const { return runtime->info().system[system].restart.text; }
  void ask(unsigned system, std::uint32_t line) { ASSERT_EQ(runtime->find_restart(system, {RestartBy::kLine, line, 0, ""}), Answer::kDone); }
  void search(unsigned system, std::uint32_t line = 4, RestartPhase wanted = RestartPhase::kFound) {
    ASSERT_NO_FATAL_FAILURE(ask(system, line));
    ASSERT_TRUE(until([&] { return phase(system) != RestartPhase::kSearching; }));
    ASSERT_EQ(phase(system), wanted) << said(system);
  }
  double variable(unsigned number) {
    double value = 0;
    bool vacant = false;
    EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_variable_get(control, 0, number, &value, &vacant); }), Answer::kDone);
    return value;
  }
  double offset() {
    double value = 0;
    EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_work_offset_get(control, 1, 2, 0, &value); }), Answer::kDone);
    return value;
  }
  void expect_both_stand() {
    ASSERT_EQ(command(CommandKind::kCycleStart, kAllSystems), Answer::kDone) << said(0) << "; " << said(1);
    (void)until([&] { return phase(0) == RestartPhase::kStands && phase(1) == RestartPhase::kStands; }, 2000);
    EXPECT_EQ(phase(0), RestartPhase::kStands) << said(0);
    EXPECT_EQ(phase(1), RestartPhase::kStands) << said(1);
    EXPECT_FALSE(runtime->snapshot().alarmed());
  }

  Config config;
  std::deque<std::string> texts;  // of programs: the control refers to them
  VirtualClock clock;
  std::unique_ptr<nc::test::PathMachine> machine;
  std::unique_ptr<Runtime> runtime;
};

TEST_F(TwoSystems, BothAreBegunTogetherInEachOrder) {
  for (const unsigned first : {0u, 1u}) {
    SCOPED_TRACE(first);
    ASSERT_NO_FATAL_FAILURE(search(first));
    ASSERT_NO_FATAL_FAILURE(search(1 - first));
    EXPECT_EQ(phase(first), RestartPhase::kFound) << said(first);
    EXPECT_EQ(variable(500), 8);
    EXPECT_EQ(variable(501), 8);
    ASSERT_NO_FATAL_FAILURE(expect_both_stand());
    ASSERT_EQ(command(CommandKind::kReset, 0), Answer::kDone);
    ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
    ASSERT_TRUE(until([&] { return variable(500) == 7 && variable(501) == 7; }, 100)) << "put back by the reset";
    EXPECT_EQ(offset(), 0);
  }
}

// Asked for at the same time they are looked for one after the other, so that each knows what it has written.
TEST_F(TwoSystems, SearchesAtTheSameTimeKnowTheirOwnWrites) {
  ASSERT_NO_FATAL_FAILURE(ask(0, 4));
  ASSERT_NO_FATAL_FAILURE(ask(1, 5));
  ASSERT_TRUE(until([&] { return phase(0) != RestartPhase::kSearching && phase(1) != RestartPhase::kSearching; }));
  ASSERT_EQ(phase(0), RestartPhase::kFound) << said(0);
  ASSERT_EQ(phase(1), RestartPhase::kFound) << said(1);
  ASSERT_EQ(command(CommandKind::kCancelRestart, 1), Answer::kDone);
  ASSERT_TRUE(until([&] { return variable(501) == 7; }, 100));
  EXPECT_EQ(variable(500), 8) << "of the search whose place is still there";
  EXPECT_EQ(phase(0), RestartPhase::kFound) << said(0);
}

TEST_F(TwoSystems, ASearchThatFindsNothingLeavesThePlaceOfTheOther) {
  for (const unsigned lost : {0u, 1u}) {
    SCOPED_TRACE(lost);
    ASSERT_NO_FATAL_FAILURE(search(1 - lost));
    ASSERT_NO_FATAL_FAILURE(search(lost, 77, RestartPhase::kLost));
    for (int n = 0; n < 20; ++n) runtime->step();
    EXPECT_EQ(phase(1 - lost), RestartPhase::kFound) << said(1 - lost);
    EXPECT_EQ(variable(500 + lost), 7) << "what it has written is put back";
    EXPECT_EQ(variable(501 - lost), 8);
    ASSERT_EQ(command(CommandKind::kCancelRestart, static_cast<std::uint8_t>(lost)), Answer::kDone);
    ASSERT_EQ(command(CommandKind::kCycleStart, static_cast<std::uint8_t>(1 - lost)), Answer::kDone);
    ASSERT_TRUE(until([&] { return phase(1 - lost) != RestartPhase::kFound; }, 2000));
    EXPECT_EQ(phase(1 - lost), RestartPhase::kStands) << said(1 - lost);
    ASSERT_EQ(command(CommandKind::kReset, 0), Answer::kDone);
    ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && variable(500) == 7 && variable(501) == 7; }, 2000));
  }
}

// The second place was found with what the first search had written.
TEST_F(TwoSystems, APlaceThatWasFoundWithWhatIsPutBackIsLost) {
  ASSERT_NO_FATAL_FAILURE(search(0));
  ASSERT_NO_FATAL_FAILURE(search(1));
  ASSERT_EQ(command(CommandKind::kCancelRestart, 0), Answer::kDone);
  for (int n = 0; n < 20; ++n) runtime->step();
  EXPECT_EQ(phase(1), RestartPhase::kLost);
  EXPECT_NE(said(1).find("part system 1"), std::string::npos) << said(1);
  EXPECT_EQ(variable(500), 7);
  EXPECT_EQ(variable(501), 7);
  EXPECT_EQ(offset(), 0);
  EXPECT_NE(command(CommandKind::kCycleStart, 1), Answer::kDone);
}

TEST_F(TwoSystems, ASearchThatHasWrittenNothingTakesNoPlaceWithIt) {
  select(0, "quiet.nc", "G90 G54 G0 X5. Y5.\n\n\nN40 G1 X20. F1200.\nX30.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search(0));
  ASSERT_NO_FATAL_FAILURE(search(1));
  ASSERT_NO_FATAL_FAILURE(search(0, 5));
  EXPECT_EQ(phase(1), RestartPhase::kFound) << said(1);
  ASSERT_EQ(command(CommandKind::kCancelRestart, 0), Answer::kDone);
  for (int n = 0; n < 20; ++n) runtime->step();
  EXPECT_EQ(phase(1), RestartPhase::kFound) << said(1);
  ASSERT_EQ(command(CommandKind::kCycleStart, 1), Answer::kDone);
  ASSERT_TRUE(until([&] { return phase(1) != RestartPhase::kFound; }, 2000));
  EXPECT_EQ(phase(1), RestartPhase::kStands) << said(1);
}

// Both count in the same variable: as in a run in which the first one has come to its place before the second.
TEST_F(TwoSystems, TheSameVariableIsCountedByBoth) {
  select(1, "third.nc", "#500=#500+1\nG90 G0 X5.\n#502=#500\nN40 G1 X7. F600.\nX9.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search(0));
  ASSERT_NO_FATAL_FAILURE(search(1));
  EXPECT_EQ(variable(500), 9);
  EXPECT_EQ(variable(502), 9);
  ASSERT_NO_FATAL_FAILURE(expect_both_stand());
  ASSERT_EQ(command(CommandKind::kReset, 0), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && variable(500) == 7; }, 2000)) << variable(500);
  EXPECT_EQ(variable(502), 7);
}

// Two random programs, each with writes of what both share, also in the block in front of the place, are looked for one after the other and begun together. What is written may have been vacant, become
// vacant, or stay what it was.
TEST_F(TwoSystems, RandomWritesInFrontOfBothPlaces) {
  const std::uint64_t first_seed = nc::test::wish("NC_FIRST_SEED", 1), count = nc::test::seeds(60, 10);
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto pick = [&random](unsigned most) { return static_cast<unsigned>(random() % most); };
    std::string text[2];
    std::uint32_t place[2];
    for (unsigned s = 0; s < 2; ++s) {
      const unsigned lines = 2 + pick(8);
      for (unsigned n = 0; n < lines; ++n) {
        const std::string target = std::to_string(pick(2) == 0 ? 520 + pick(4) : 500 + pick(3)), other = std::to_string(520 + pick(4)), common = std::to_string(110 + pick(3));
        const std::string blocks[] = {"#" + target + "=0", "#" + target + "=" + std::to_string(pick(3)), "#" + target + "=#0", "#" + target + "=#" + other, "#" + target + "=#" + other + "+1", "#" + common + "=0", "#" + target + "=#" + common,
                                      "G91 G10 L2 P2 X1.", "G90 G10 L2 P1 X0", "G90 G0 X" + std::to_string(1 + pick(5)) + ".", "G4 P1", "#" + target + "=-0"};
        text[s] += blocks[pick(std::size(blocks))] + "\n";
      }
      place[s] = lines + 1;
      text[s] += "G90 G1 X7. F600.\nX9.\nM30\n";
    }
    const unsigned first = pick(2);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", first part system " + std::to_string(first + 1) + "\n" + text[0] + "----\n" + text[1]);
    for (unsigned s = 0; s < 2; ++s) select(s, s == 0 ? "first.nc" : "second.nc", texts.emplace_back(text[s]).c_str());
    const bool together = pick(4) == 0;
    ASSERT_NO_FATAL_FAILURE(ask(first, place[first]));
    if (!together) {
      ASSERT_TRUE(until([&] { return phase(first) != RestartPhase::kSearching; }));
    }
    ASSERT_NO_FATAL_FAILURE(ask(1 - first, place[1 - first]));
    ASSERT_TRUE(until([&] { return phase(0) != RestartPhase::kSearching && phase(1) != RestartPhase::kSearching; }));
    for (unsigned n = pick(30); n > 0; --n) runtime->step();
    ASSERT_EQ(phase(0), RestartPhase::kFound) << said(0);
    ASSERT_EQ(phase(1), RestartPhase::kFound) << said(1);
    ASSERT_NO_FATAL_FAILURE(expect_both_stand());
    ASSERT_FALSE(HasFailure());
    ASSERT_EQ(command(CommandKind::kReset, 0), Answer::kDone);
    ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
  }
}

// What anybody else changes makes each place out of date, as before.
TEST_F(TwoSystems, WhatSomebodyElseChangesLosesBoth) {
  ASSERT_NO_FATAL_FAILURE(search(0));
  ASSERT_NO_FATAL_FAILURE(search(1));
  ASSERT_EQ(runtime->change([](nc_control* control) { (void)nc_variable_set(control, 0, 502, 1, false); }), Answer::kDone);
  for (int n = 0; n < 20; ++n) runtime->step();
  EXPECT_EQ(phase(0), RestartPhase::kLost);
  EXPECT_EQ(phase(1), RestartPhase::kLost);
  EXPECT_EQ(variable(500), 7);
  EXPECT_EQ(variable(501), 7);
}

}  // namespace
