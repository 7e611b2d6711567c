// SPDX-License-Identifier: Apache-2.0
// Index tables on a machine (M700 9.3): the simulated clamp, the signals between NC and ladder, and the text of alarm R15.
#include "ladder_machine.hpp"
#include "runtime/console.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

constexpr unsigned kB = 3;

const char* const kTable = R"(
[[axis]]
name = "B"
rotary = true
max_velocity = 90.0
max_acceleration = 900.0
servo_lag_ms = 2.0
unclamp_s = 0.3
clamp_s = 0.2
[parameters]
"2076" = { B = 1 }
)";

class IndexTables : public nc::test::OwnLadder {
 protected:
  // With this ladder program, or with none; `more` is TOML that is appended to the configuration.
  void wire(const std::string& ladder, const std::string& more = {}) {
    if (!ladder.empty()) use(ladder);
    config = nc::test::parse_or_fail(nc::test::base_toml() + kTable + more +
                                     (ladder.empty() ? "" : "[ladder]\nprogram = \"own.il\"\nfin_timeout_s = 1\n"));
    if (!ladder.empty()) config.ladder.program = path_;
  }
  bool unclamp() const { return (out().unclamp >> kB & 1u) != 0; }
  double b() const { return out().command.v[kB]; }
  void expect_alarm(const std::string& text) {
    ASSERT_GT(until([&] { return !alarm().empty(); }, 6000), 0);
    EXPECT_EQ(alarm(), text);
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return !runtime->snapshot().resetting && alarm().empty(); }, 3000), 0);
  }
};

// FIN answers at once; in0 is the answer "unclamped".
const char* const kLadder = "LD nc.m_strobe\nOUT plc.fin1\nLD nc.unclamp.B\nOUT out0\nLD in0\nOUT plc.unclamped.B\nEND\n";

TEST_F(IndexTables, TheSimulatedClampTakesItsTimes) {
  wire("");
  start("G4 X0.001\nG0 B45.\nX10.\nM30\n");
  ASSERT_GT(until([&] { return unclamp(); }), 0);
  EXPECT_NEAR(until([&] { return b() > 0; }), 300, 4);
  ASSERT_GT(until([&] { return !unclamp(); }), 0);
  EXPECT_EQ(b(), 45);
  EXPECT_NEAR(machine->actual(0).v[kB], 45, 0.011) << "it is in position";
  EXPECT_EQ(out().command.v[0], 0);
  EXPECT_EQ(nc::rt::state_text(out()), "waits for the clamp of an index table");
  EXPECT_NEAR(until([&] { return out().command.v[0] > 0; }), 200, 4);
  ASSERT_GE(until_end(), 0);
}

TEST_F(IndexTables, TheLadderAnswers) {
  wire(kLadder);
  build();
  start("G0 B45. X5.\nX10.\nM30\n");
  ASSERT_GT(until([&] { return point("out0") == 1; }), 0) << "the command has reached the ladder";
  EXPECT_EQ(out().fin_wait, 0x800);
  EXPECT_EQ(device("nc.stop_cause"), 1);
  steps(500);
  EXPECT_EQ(b(), 0);
  EXPECT_EQ(out().command.v[0], 0) << "the whole block waits";
  in("in0", 1);
  ASSERT_GT(until([&] { return point("out0") == 0; }), 0);
  EXPECT_EQ(b(), 45);
  steps(500);
  EXPECT_EQ(out().command.v[0], 5) << "the next block waits for the clamp";
  in("in0", 0);
  ASSERT_GE(until_end(), 0);
}

TEST_F(IndexTables, AnAnswerThatDoesNotComeIsAnAlarmThatNamesTheAxis) {
  wire(kLadder);
  start("X1. G0\nG0 B45.\nM30\n");
  expect_alarm("R15 The index table is not unclamped, axis B (line 2)");
  reset();
  steps(5);
  EXPECT_FALSE(unclamp());
}

TEST_F(IndexTables, NorDoesOneThatStays) {
  wire(kLadder);
  build();
  in("in0", 1);
  start("G0 B45.\nM30\n");
  expect_alarm("R15 The index table is not clamped, axis B (line 1)");
  EXPECT_EQ(b(), 45);
}

TEST_F(IndexTables, AnAnswerThatIsLostOnTheWay) {
  wire(kLadder);
  build();
  in("in0", 1);
  start("G1 F1800 B45.\nM30\n");
  ASSERT_GT(until([&] { return b() > 20; }), 0);
  in("in0", 0);
  steps(300);
  const double at = b();
  EXPECT_LT(at, 30);
  EXPECT_TRUE(unclamp());
  in("in0", 1);
  steps(200);
  EXPECT_GT(b(), at) << "it goes on by itself";
  in("in0", 0);
  expect_alarm("R15 The index table is not unclamped, axis B (line 1)");
}

TEST_F(IndexTables, ATableBetweenItsPlaces) {
  wire(kLadder);
  config.parameters.push_back({"2106", 'B', 0, "15", {}});
  build();
  in("in0", 1);
  start("G1 F1800 B45.\nM30\n");
  ASSERT_GT(until([&] { return b() > 20; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 3000), 0);
  steps(20);
  EXPECT_TRUE(unclamp());
  start("G0 X10.\nM30\n");
  expect_alarm("R15 The index table stands where it cannot be clamped: move it on, axis B (line 1)");
  reset();
  start("G0 B30.\nM30\n");
  ASSERT_GT(until([&] { return point("out0") == 0; }), 0);
  in("in0", 0);
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(b(), 30);
}

TEST_F(IndexTables, JogsWaitForIt) {
  wire("");
  build();
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  ASSERT_EQ(runtime->execute({CommandKind::kStep, 0, kB, 0, 3.0, 0}), Answer::kDone);
  steps(200);
  EXPECT_TRUE(unclamp());
  EXPECT_EQ(b(), 0);
  ASSERT_GT(until([&] { return b() == 3; }, 3000), 0);
  ASSERT_GT(until([&] { return !unclamp(); }, 300), 0);
}

TEST_F(IndexTables, AJogThatGetsNoAnswerIsAnAlarmToo) {
  wire(kLadder);
  build();
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  ASSERT_EQ(runtime->execute({CommandKind::kStep, 0, kB, 0, 3.0, 0}), Answer::kDone);
  expect_alarm("R15 The index table is not unclamped, axis B");
  EXPECT_EQ(b(), 0);
}

TEST_F(IndexTables, AWireAnswersWithoutALadder) {
  wire("", "[signals]\n\"plc.unclamped.B\" = \"in0\"\n\"nc.unclamp.B\" = \"table_release\"\n"
       "[[point]]\nname = \"table_release\"\ndirection = \"output\"\n");
  build();
  start("G0 B45.\nM30\n");
  ASSERT_GT(until([&] { return point("table_release") == 1; }), 0);
  steps(500);
  EXPECT_EQ(b(), 0) << "the simulated clamp has nothing to say";
  in("in0", 1);
  ASSERT_GT(until([&] { return point("table_release") == 0; }), 0);
  in("in0", 0);
  ASSERT_GE(until_end(), 0);
}

// In a feed hold amid a block of other axes the table is turned by hand and comes back: the block goes on when it is clamped (9.3 (6)), however early the start comes.
TEST_F(IndexTables, TurnedByHandInAFeedHoldTheBlockWaitsForItsClamp) {
  wire(kLadder);
  build();
  start("G1 X100. F1200\nM30\n");
  ASSERT_GT(until([&] { return out().command.v[0] > 20; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  ASSERT_GT(until([&] { return out().state == NC_STATE_HOLD && out().manual_allowed; }), 0);
  const double stood = out().command.v[0];
  const auto mode = [&](nc::rt::Mode to) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(to)); };
  ASSERT_EQ(mode(nc::rt::Mode::kManual), Answer::kDone);
  for (const double way : {3.0, -3.0}) {
    const double to = b() + way;
    ASSERT_EQ(runtime->execute({CommandKind::kStep, 0, kB, 0, way, 0}), Answer::kDone);
    ASSERT_GE(until([&] { return unclamp(); }, 300), 0);
    in("in0", 1);
    ASSERT_GT(until([&] { return std::abs(b() - to) < 1e-9 && !unclamp(); }, 3000), 0);
    if (way < 0) break;
    in("in0", 0);
    steps(20);
  }
  ASSERT_EQ(mode(nc::rt::Mode::kAuto), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(300);
  EXPECT_EQ(out().command.v[0], stood) << "it is not clamped yet";
  EXPECT_EQ(out().fin_wait, 0x800);
  in("in0", 0);
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(out().command.v[0], 100, 1e-9);
  EXPECT_EQ(b(), 0);
}

// A table that was held on its way is turned on by hand, comes back to that place, where it could not be clamped, and goes on.
TEST_F(IndexTables, HeldOnItsWayItComesBackToItsPlaceAndGoesOn) {
  wire("", "\"2106\" = { B = 15.0 }\n");
  build();
  start("G1 F1800 B45.\nX5.\nM30\n");
  ASSERT_GT(until([&] { return b() > 20; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  ASSERT_GT(until([&] { return out().state == NC_STATE_HOLD && out().manual_allowed; }), 0);
  const double stood = b();
  const auto mode = [&](nc::rt::Mode to) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(to)); };
  ASSERT_EQ(mode(nc::rt::Mode::kManual), Answer::kDone);
  ASSERT_EQ(runtime->execute({CommandKind::kStep, 0, kB, 0, 30 - stood, 0}), Answer::kDone);
  ASSERT_GT(until([&] { return std::abs(b() - 30) < 1e-9; }, 3000), 0);
  steps(600);
  EXPECT_EQ(b(), 30);
  for (int i = 0; i < 300 && (out().restart_axes >> kB & 1u) != 0; ++i) {
    ASSERT_EQ(runtime->execute({CommandKind::kApproach, 0, kB, 0, 10.0, 0}), Answer::kDone);
    steps(20);
  }
  EXPECT_EQ(runtime->execute({CommandKind::kJog, 0, kB, 0, 0.0, 0}), Answer::kDone);
  steps(300);
  EXPECT_EQ(b(), stood);
  ASSERT_EQ(mode(nc::rt::Mode::kAuto), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(b(), 45);
  EXPECT_EQ(out().command.v[0], 5);
}

}  // namespace
