// SPDX-License-Identifier: Apache-2.0
// Whoever has the answer to a command finds its effect in the snapshot: answers are sent after the snapshot of their scan, and the feeder
// looks at the newest snapshot before each of its own commands.
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "fake_nc.hpp"
#include "hal/sim/sim_machine.hpp"
#include "runtime/feeder.hpp"
#include "runtime/scan.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandAnswer;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::rt::Snapshot;

// It is called while a snapshot is being made, which readers do not have yet.
class LookingLadder final : public nc::rt::LadderHook {
 public:
  void list_forces(nc::rt::ForceList* list) const noexcept override {
    list->count = 0;
    if (on_publish) on_publish();
  }
  std::function<void()> on_publish;
};

// It is called in the middle of a step of the feeder, after its look at the snapshot and before its commands.
class FedNc final : public nc::test::FakeNc {
 public:
  nc_status feed(std::uint32_t budget) override {
    if (on_feed) std::exchange(on_feed, nullptr)();
    return FakeNc::feed(budget);
  }
  void shown(unsigned system, nc_axes* machine, nc_axes* work) override {  // called after the commands
    if (on_shown) std::exchange(on_shown, nullptr)();
    FakeNc::shown(system, machine, work);
  }
  std::function<void()> on_feed, on_shown;
};

class AnswerTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    nc::hal::PointImage initial;
    ASSERT_TRUE(hal.start(initial, &error)) << error;
    scan.begin();
    scan.run_once();
  }
  bool post(CommandKind kind, double value, std::uint32_t number) {
    Command command;
    command.ticket = ++ticket;
    command.kind = kind;
    command.value = value;
    command.number = number;
    return nc::rt::for_feeder(kind) ? feeder.post(command) : scan.post(command);
  }

  nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::rt::VirtualClock clock;
  nc::hal::SimMachine hal{config.sim, config.points};
  LookingLadder ladder;
  FedNc nc;
  nc::rt::Scan scan{config, &clock, &hal, &ladder, &nc};
  nc::rt::Feeder feeder{1, &nc, &scan};
  std::uint64_t ticket = 0;
};

TEST_F(AnswerTest, GoesOutBehindTheSnapshotThatShowsWhatWasDone) {
  struct Row {
    const char* name;
    CommandKind kind;
    double value;
    std::uint32_t number;
    bool (*shown)(const Snapshot&);
  };
  const Row rows[] = {
      {"mode", CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kMdi), [](const Snapshot& s) { return s.mode == Mode::kMdi; }},
      {"feed override", CommandKind::kFeedOverride, 0.5, 0, [](const Snapshot& s) { return s.system[0].feed_override == 0.5; }},
      {"rapid override", CommandKind::kRapidOverride, 0.25, 0, [](const Snapshot& s) { return s.system[0].rapid_override == 0.25; }},
      {"single block", CommandKind::kSingleBlock, 0, 1, [](const Snapshot& s) { return s.single_block != 0; }},
      {"optional stop", CommandKind::kOptionalStop, 0, 1, [](const Snapshot& s) { return s.optional_stop != 0; }},
      {"reset", CommandKind::kReset, 0, 0, [](const Snapshot& s) { return s.resetting; }},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    ASSERT_FALSE(row.shown(scan.snapshot()));
    ASSERT_TRUE(post(row.kind, row.value, row.number));
    CommandAnswer answer;
    unsigned looks = 0;
    ladder.on_publish = [&] {
      ++looks;
      EXPECT_FALSE(row.shown(scan.snapshot())) << "readers have the snapshot of the scan before";
      EXPECT_FALSE(scan.poll_answer(&answer)) << "an answer in front of its snapshot";
    };
    scan.run_once();
    EXPECT_EQ(looks, 1u);
    ladder.on_publish = nullptr;
    ASSERT_TRUE(scan.poll_answer(&answer));
    EXPECT_EQ(answer.ticket, ticket);
    EXPECT_EQ(answer.answer, Answer::kDone);
    EXPECT_TRUE(row.shown(scan.snapshot()));
  }
}

// More commands than one scan answers: none is lost, and their answers come in order.
TEST_F(AnswerTest, EachCommandOfAFullRingIsAnsweredInOrder) {
  unsigned posted = 0, answered = 0;
  for (; post(CommandKind::kSingleBlock, 0, posted & 1); ++posted) ASSERT_LT(posted, 1000u);
  EXPECT_GE(posted, 63u);
  CommandAnswer answer;
  for (unsigned i = 0; i < 3; ++i) {
    scan.run_once();
    while (scan.poll_answer(&answer)) EXPECT_EQ(answer.ticket, ++answered);
  }
  EXPECT_EQ(answered, posted);
}

TEST_F(AnswerTest, ACommandForTheFeederFindsWhatTheScanHasAnsweredDuringItsStep) {
  nc.on_feed = [&] {
    ASSERT_TRUE(post(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kMdi)));
    scan.run_once();
    CommandAnswer answer;
    ASSERT_TRUE(scan.poll_answer(&answer));
    ASSERT_EQ(answer.answer, Answer::kDone);
    feeder.set_mdi_text("G0 X1.\n");
    ASSERT_TRUE(post(CommandKind::kLoadMdi, 0, 0));  // in the same step
  };
  feeder.step();
  CommandAnswer answer;
  ASSERT_TRUE(feeder.poll_answer(&answer));
  EXPECT_EQ(answer.ticket, ticket);
  EXPECT_EQ(answer.answer, Answer::kDone) << "MDI right behind its mode";
  EXPECT_EQ(nc.mdi, "G0 X1.\n");
}

// The opposite direction: the scan can start what the feeder has reported as loaded.
TEST_F(AnswerTest, WhatTheFeederHasAnsweredCanBeStarted) {
  for (const CommandKind kind : {CommandKind::kSelectProgram, CommandKind::kLoadMdi}) {
    const Mode mode = kind == CommandKind::kLoadMdi ? Mode::kMdi : Mode::kAuto;
    ASSERT_TRUE(post(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode)));
    scan.run_once();
    CommandAnswer answer;
    ASSERT_TRUE(scan.poll_answer(&answer));
    ASSERT_TRUE(post(kind, 0, 0));
    bool answered = false;
    const auto start = [&] {
      if (answered || !feeder.poll_answer(&answer)) return;
      answered = true;
      ASSERT_EQ(answer.answer, Answer::kDone);
      ASSERT_TRUE(post(CommandKind::kCycleStart, 0, 0));
      scan.run_once();
      ASSERT_TRUE(scan.poll_answer(&answer));
      EXPECT_EQ(answer.answer, Answer::kDone);
      EXPECT_TRUE(scan.snapshot().program_active());
    };
    nc.on_shown = start;
    feeder.step();
    start();
    EXPECT_TRUE(answered);
    ASSERT_TRUE(post(CommandKind::kReset, 0, 0));
    for (unsigned i = 0; i < 20; ++i) {
      scan.run_once();
      feeder.step();
    }
    while (scan.poll_answer(&answer)) continue;
  }
}

// A program takes long to be found, and its client does not wait any longer: the program must not be selected afterwards.
TEST_F(AnswerTest, ACommandThatWasGivenUpDoesNothing) {
  bool given_up = false;
  feeder.set_program_loader([&](const std::string&, unsigned* file, std::string*) {
    *file = 3;
    given_up = feeder.take_back(ticket);
    return true;
  });
  feeder.set_program_name("slow.nc");
  CommandAnswer answer;
  ASSERT_TRUE(post(CommandKind::kSelectProgram, 0, nc::rt::kProgramByName));
  feeder.step();
  EXPECT_TRUE(given_up);
  ASSERT_TRUE(feeder.poll_answer(&answer));
  EXPECT_EQ(answer.answer, Answer::kNoAnswer);
  EXPECT_EQ(nc.selects, 0u);
  EXPECT_FALSE(feeder.info().system[0].selected.any);

  feeder.set_program_loader([&](const std::string&, unsigned* file, std::string*) {
    *file = 3;
    return true;
  });
  ASSERT_TRUE(post(CommandKind::kSelectProgram, 0, nc::rt::kProgramByName));
  feeder.step();
  EXPECT_FALSE(feeder.take_back(ticket)) << "it has acted";
  ASSERT_TRUE(feeder.poll_answer(&answer));
  EXPECT_EQ(answer.answer, Answer::kDone);
  EXPECT_EQ(nc.selects, 1u);
}

}  // namespace
