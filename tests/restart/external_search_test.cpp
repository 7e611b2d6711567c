// SPDX-License-Identifier: Apache-2.0
// The external search (docs/signals.md): what the machine asks for by number, and each of its answers.
#include <atomic>

#include "restart_machine.hpp"

#include "runtime/start_gate.hpp"
#include "runtime/test_config.hpp"

namespace {

using namespace nc::rt;

// Answers as the test says.
class Gate : public StartGate {
 public:
  bool may_begin(unsigned, unsigned) override { return passed; }
  Looked look_again() override { return Looked::kSame; }
  bool waits(unsigned) override { return checks; }
  std::string remark(unsigned) override { return "the check says no"; }
  bool passed = true, checks = false;
};

class ExternalSearch : public testing::Test {
 protected:
  void SetUp() override {
    std::string points, signals = "[signals]\n";
    const auto wire = [&](const std::string& signal, const char* type, const char* direction) {
      const std::string name = signal.substr(signal.find('.') + 1);
      points += "[[point]]\nname = \"" + name + "\"\ntype = \"" + type + "\"\ndirection = \"" + direction + "\"\n";
      signals += "\"" + signal + "\" = \"" + name + "\"\n";
    };
    wire("plc.search", "bit", "input");
    wire("plc.search_program", "word", "input");
    wire("plc.search_sequence", "word", "input");
    wire("nc.search_finished", "bit", "output");
    wire("nc.search_result", "word", "output");
    config = nc::test::parse_or_fail(nc::test::base_toml() + points + signals + "[motion]\nmode = \"trapezoid\"\n");
    machine = std::make_unique<nc::test::PathMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    runtime->set_program_loader([this](const std::string& name, unsigned* file, std::string* error) {
      const auto found = programs.find(name);
      *error = "there is none";
      return found != programs.end() && nc_program_add_text(runtime->control(), name.c_str(), found->second.data(), found->second.size(), file) == NC_OK;
    });
    runtime->set_start_gate(&gate);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    steps(5);
  }
  void steps(int n) {
    while (n-- > 0) runtime->step();
  }
  nc_outputs out() const { return runtime->snapshot().system[0].nc; }
  void hold(const char* point, std::int32_t value) { machine->hold(config.points.find(point), value); }
  std::int32_t shown(const char* point) {
    return static_cast<std::int32_t>(machine->sim.outputs().value[config.points.find(point)]);
  }
  void ask(std::int32_t program, std::int32_t sequence) {
    hold("search_program", program);
    hold("search_sequence", sequence);
    hold("search", 1);
  }
  // What the search answers, with the signal let go behind it.
  std::int32_t search(std::int32_t program, std::int32_t sequence) {
    ask(program, sequence);
    for (int n = 0; n < 3000 && shown("search_finished") == 0; ++n) steps(1);
    const std::int32_t result = shown("search_result");
    EXPECT_EQ(shown("search_finished"), result != 0);
    hold("search", 0);
    steps(3);
    EXPECT_EQ(shown("search_finished"), 0);
    EXPECT_EQ(shown("search_result"), 0);
    return result;
  }
  std::string said() const {
    const auto now = runtime->info();
    return now.said.empty() ? "" : now.said.back().text;
  }
  Answer start() { return runtime->execute(CommandKind::kCycleStart); }

  std::map<std::string, std::string> programs{{"O1000", "O1000\nG90 G0 X7.\nN20 G1 X9. F3000\nN30 X11.\nM30\n"}, {"O7", "G90 G0 Y5.\nM30\n"}};
  Config config;
  VirtualClock clock;
  Gate gate;
  std::unique_ptr<nc::test::PathMachine> machine;
  std::unique_ptr<Runtime> runtime;
};

TEST_F(ExternalSearch, SelectsAProgramByItsNumber) {
  EXPECT_EQ(search(1000, 0), 1);
  ASSERT_EQ(start(), Answer::kDone);
  for (int n = 0; n < 5000 && (n < 10 || out().state != NC_STATE_IDLE); ++n) steps(1);
  EXPECT_NEAR(out().command.v[0], 11, 1e-9);
  EXPECT_EQ(search(7, 0), 1);
  ASSERT_EQ(start(), Answer::kDone);
  for (int n = 0; n < 5000 && (n < 10 || out().state != NC_STATE_IDLE); ++n) steps(1);
  EXPECT_NEAR(out().command.v[1], 5, 1e-9);
}

TEST_F(ExternalSearch, ASequenceNumberIsAPlaceToBeginInside) {
  EXPECT_EQ(search(1000, 30), 1);
  ASSERT_EQ(start(), Answer::kDone);
  for (int n = 0; n < 500 && out().state != NC_STATE_STOPPED; ++n) steps(1);
  EXPECT_EQ(out().cause, NC_CAUSE_RESTART);
  EXPECT_EQ(out().command.v[0], 0) << "nothing moves";
  EXPECT_EQ(start(), Answer::kRestartAxes) << "the axes are brought there by hand";
  EXPECT_EQ(search(1000, 20), 3) << "a program is in execution or interrupted";
}

TEST_F(ExternalSearch, OfTheProgramThatIsSelected) {
  EXPECT_EQ(search(0, 20), 3) << "none is selected";
  EXPECT_EQ(search(1000, 0), 1);
  EXPECT_EQ(search(0, 20), 1);
  EXPECT_EQ(runtime->info().system[0].restart.phase, RestartPhase::kFound);
}

TEST_F(ExternalSearch, SaysWhatItCannotDo) {
  EXPECT_EQ(search(0, 0), 2);
  EXPECT_EQ(search(-1, 0), 2);
  EXPECT_EQ(search(100000000, 0), 2);
  EXPECT_EQ(search(1000, -5), 2);
  EXPECT_EQ(search(INT32_MIN, INT32_MAX), 2);
  EXPECT_EQ(search(8, 0), 4);
  EXPECT_EQ(said(), "external search: there is none");
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kMdi)), Answer::kDone);
  EXPECT_EQ(search(1000, 0), 3);
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
  EXPECT_EQ(search(1000, 40), 6);
  EXPECT_EQ(start(), Answer::kRestartLost) << "and not the whole program, of which only a part was meant";
  EXPECT_EQ(search(1000, 0), 1);
  EXPECT_EQ(start(), Answer::kDone);
  EXPECT_EQ(search(7, 0), 3);
  EXPECT_EQ(runtime->info().system[0].selected.file, 0u);
}

TEST_F(ExternalSearch, WaitsForTheCheckAndIsRefusedByIt) {
  gate.passed = false;
  gate.checks = true;
  ask(1000, 30);
  steps(200);
  EXPECT_EQ(shown("search_finished"), 0);
  EXPECT_EQ(start(), Answer::kNotChecked);
  gate.checks = false;
  gate.passed = true;
  (void)start();
  for (int n = 0; n < 500; ++n) {
    steps(1);
    ASSERT_EQ(out().command.v[0], 0) << "the head is not what was asked for";
  }
  EXPECT_EQ(shown("search_result"), 1);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(50);
  hold("search", 0);
  gate.passed = false;
  steps(3);
  EXPECT_EQ(search(7, 0), 5);
  EXPECT_EQ(said(), "external search: the check says no");
  EXPECT_EQ(search(7, 10), 5);
}

TEST_F(ExternalSearch, IsGivenUpByAResetAndByAnotherSelection) {
  gate.passed = false;
  gate.checks = true;
  ask(1000, 30);
  steps(50);
  ASSERT_EQ(runtime->select_program(0, "O7"), Answer::kDone);
  for (int n = 0; n < 500 && shown("search_finished") == 0; ++n) steps(1);
  EXPECT_EQ(shown("search_result"), 3);
  gate.passed = true;
  hold("search", 0);
  steps(3);
  // A loop that is read for long.
  programs["O9"] = "O9\nWHILE[1 EQ 1] DO1\n#1=#1+1\nEND1\nN10 M30\n";
  ask(9, 10);
  steps(50);
  EXPECT_EQ(shown("search_finished"), 0);
  EXPECT_EQ(start(), Answer::kRestartSearch);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  for (int n = 0; n < 500 && shown("search_finished") == 0; ++n) steps(1);
  EXPECT_EQ(shown("search_result"), 3);
}

/// A cell that asks for the program of a pallet and does not get it does not get the one of the pallet before.
TEST_F(ExternalSearch, WhatIsNotThereLeavesNothingThatAStartWouldBegin) {
  struct Row {
    std::int32_t program, sequence, result;
  };
  for (const Row& row : {Row{7777, 0, 4}, Row{100'000'000, 0, 2}, Row{7777, 10, 4}, Row{0, 0, 2}}) {
    SCOPED_TRACE(row.program);
    for (const std::int32_t place : {0, 30}) {
      ASSERT_EQ(search(1000, place), 1);
      ASSERT_EQ(search(row.program, row.sequence), row.result);
      for (const bool behind_a_reset : {false, true}) {  // it is what is pressed first where a start is refused
        if (behind_a_reset) {
          ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
        }
        steps(20);
        EXPECT_NE(start(), Answer::kDone);
        steps(200);
        EXPECT_EQ(out().command.v[0], 0);
        EXPECT_EQ(out().state, NC_STATE_IDLE);
      }
    }
  }
  ASSERT_EQ(runtime->select_program(0, "O1000"), Answer::kDone);
  EXPECT_EQ(start(), Answer::kDone) << "who selects a program says which";
}

TEST_F(ExternalSearch, WhatWasFoundIsSaidBehindWhatWasNot) {
  ASSERT_EQ(search(7777, 0), 4);
  EXPECT_EQ(said(), "external search: there is none");
  ASSERT_EQ(search(1000, 0), 1);
  EXPECT_EQ(said(), "external search: O1000 is selected");
  ASSERT_EQ(search(7777, 0), 4);
  ASSERT_EQ(search(1000, 30), 1);
  EXPECT_EQ(said(), "external search: sequence number 30 of O1000 is found");
}

TEST_F(ExternalSearch, ANewRequestTakesThePlaceOfTheOneInFront) {
  gate.passed = false;
  gate.checks = true;
  ask(1000, 30);
  steps(20);
  hold("search", 0);
  steps(2);
  ask(7, 0);
  steps(5);
  gate.passed = true;
  for (int n = 0; n < 500 && shown("search_finished") == 0; ++n) steps(1);
  EXPECT_EQ(shown("search_result"), 1);
  EXPECT_EQ(runtime->info().system[0].restart.phase, RestartPhase::kNone);
}

}  // namespace
