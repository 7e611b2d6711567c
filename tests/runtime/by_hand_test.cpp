// SPDX-License-Identifier: Apache-2.0
// Motion by hand begins with a press, and the reason that refuses or stops it is reported: buttons, handwheels and clients with every reason.
#include "ladder_machine.hpp"
#include "runtime/refusal.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::Command;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr const char* kRungs =
    "LD in0\nOUT plc.jog_p.X\nLD SM400\nDMOV K1200 plc.jog_feed\nLDI in1\nOUT plc.feed_hold_n\nLDD<> word_in K1\nOUT plc.interlock_n\n"
    "LDD= word_in K2\nOUT plc.alarm.1\nLDD= word_in K3\nOUT plc.reset\nLDD= word_in K4\nOUT plc.reference.X\nLD SM400\nMOV K0 plc.handle.X\nLDD= word_in K5\nMOV K3 plc.handle.X\n"
    "LDD= word_in K6\nMOV K30000 plc.handle.X\n";

class ByHandRuntime : public nc::test::OwnLadder {
 protected:
  void run() {
    use(std::string(kRungs) + "LD nc.m_strobe\nOUT plc.fin2\nEND\n");
    build();
    steps(2);
  }
  Answer mode(Mode wanted) {
    const Answer answer = runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(wanted));
    steps(3);
    return answer;
  }
  Answer ask(CommandKind kind, double value) {
    Command command;
    command.kind = kind;
    command.value = value;
    return runtime->execute(command);
  }
  void word(unsigned value, unsigned scans = 3) {
    in("word_in", value);
    steps(scans);
  }
  nc::rt::Refusal refusal() const { return runtime->snapshot().system[0].refusal; }
  std::string text() const { return nc::rt::refusal_text(config, 0, refusal()); }
  double x() const { return out().command.v[0]; }
};

class Hindrances : public ByHandRuntime {
 protected:
  void hinder(unsigned which, bool on) {
    if (which == 0) in("in1", on);
    if (which == 1) in("word_in", on ? 1 : 0);
    if (which == 2 || which == 3) in("word_in", on ? which : 0);
    if (which == 4) {
      ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
      steps(2);
      ASSERT_EQ(mode(on ? Mode::kAuto : Mode::kManual), Answer::kDone);
    }
    steps(300);
    if (which == 2 && !on) {
      ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
      ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 500), 0);
    }
  }
  static constexpr Answer kAnswer[] = {Answer::kFeedHold, Answer::kInterlock, Answer::kAlarmActive, Answer::kResetHeld, Answer::kNotInThisMode};
};

// A feed hold of a client, whoever moves the axis: a button, a jog that is repeated, a step, a reference return, a handle. It comes to rest, and stays.
TEST_F(Hindrances, AFeedHoldOfAClientStopsWhatMovesByHand) {
  for (unsigned by = 0; by < 5; ++by) {
    SCOPED_TRACE(by);
    run();
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    if (by == 4) {
      ASSERT_EQ(ask(CommandKind::kStep, 30), Answer::kDone);
      ASSERT_GE(until([&] { return out().distance_zero && x() > 29; }, 20000), 0);
      steps(5);
    }
    if (by == 0) in("in0", 1);
    if (by == 1) {
      ASSERT_EQ(ask(CommandKind::kJog, 20), Answer::kDone);
    }
    if (by == 2) {
      ASSERT_EQ(ask(CommandKind::kStep, 50), Answer::kDone);
    }
    if (by == 3) in("word_in", 6);
    if (by == 4) {
      ASSERT_EQ(ask(CommandKind::kReference, 0), Answer::kDone);
    }
    steps(60);
    ASSERT_NE(out().velocity.v[0], 0);
    ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
    if (by == 3) in("word_in", 0);  // a wheel that is turned on turns the axis on
    for (unsigned n = 0; n < 300; ++n) {
      if (by == 1 && n % 50 == 0) (void)ask(CommandKind::kJog, 20);
      steps(1);
    }
    const double stood = x();
    for (unsigned n = 0; n < 300; ++n) {
      if (by == 1 && n % 50 == 0) (void)ask(CommandKind::kJog, 20);
      steps(1);
    }
    EXPECT_EQ(x(), stood);
    EXPECT_NE(text().find(by == 0 || by == 1 ? "let it go first" : "feed hold"), std::string::npos) << text();
    // Let go and pressed again, it acts again.
    in("in0", 0);
    (void)ask(CommandKind::kJog, 0);
    steps(5);
    in("in0", 1);
    steps(100);
    EXPECT_GT(x(), stood + 0.1);
    in("in0", 0);
    steps(300);
    runtime.reset();
  }
}

TEST_F(Hindrances, AButtonThatWasOnWhileSomethingRefusedItWaitsToBeLetGo) {
  for (unsigned which = 0; which < 5; ++which) {
    for (const bool moves : {false, true}) {
      if (moves && which == 4) continue;  // the mode does not change while an axis moves
      SCOPED_TRACE(std::to_string(which) + (moves ? ", on its way" : ""));
      run();
      ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
      if (moves) {
        in("in0", 1);
        steps(100);
        ASSERT_GT(x(), 0.5);
      }
      hinder(which, true);
      in("in0", 1);
      steps(200);
      const std::string why = text();
      EXPECT_EQ(why, std::string("jog X ") + (moves ? "stopped: " : "refused: ") + answer_text(kAnswer[which]));
      const double there = x();
      hinder(which, false);
      steps(300);
      EXPECT_EQ(x(), there);
      EXPECT_EQ(refusal().why, Answer::kLetGoFirst);
      in("in0", 0);
      steps(3);
      in("in0", 1);
      steps(100);
      EXPECT_GT(x(), there + 0.5);
      EXPECT_EQ(text(), "");
      in("in0", 0);
      steps(3);
      runtime.reset();
    }
  }
}

// A client's jog is a button that is on as long as it is repeated. Each answer says what keeps the axis from moving.
TEST_F(Hindrances, ARepeatedJogIsAnsweredWithTheReasonAndWaitsToBeLetGo) {
  for (unsigned which = 0; which < 5; ++which) {
    for (const bool moves : {false, true}) {
      if (moves && which == 4) continue;
      SCOPED_TRACE(std::to_string(which) + (moves ? ", on its way" : ""));
      run();
      ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
      if (moves) {
        ASSERT_EQ(ask(CommandKind::kJog, 20), Answer::kDone);
        steps(100);
        ASSERT_GT(x(), 0.5);
      }
      hinder(which, true);
      EXPECT_EQ(ask(CommandKind::kJog, 20), kAnswer[which]);
      steps(100);
      EXPECT_NE(text(), "");
      const double there = x();
      const auto repeat = [&](unsigned times, Answer expected) {
        for (unsigned n = 0; n < times; ++n) {
          EXPECT_EQ(ask(CommandKind::kJog, 20), expected);
          steps(50);
        }
      };
      repeat(5, kAnswer[which]);
      if (which == 0) in("in1", 0);
      else if (which != 4) in("word_in", 0);
      if (which == 2) {
        steps(3);
        ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
      }
      if (which == 4) {
        ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
      }
      steps(100);
      repeat(10, Answer::kLetGoFirst);
      EXPECT_EQ(x(), there);
      if (moves) {
        steps(nc::rt::kJogDeadManScans + 1);  // the client repeats its jog no longer
      } else {
        ASSERT_EQ(ask(CommandKind::kJog, 0), Answer::kDone);
      }
      repeat(3, Answer::kDone);
      EXPECT_GT(x(), there + 0.5);
      runtime.reset();
    }
  }
}

TEST_F(Hindrances, AStepAReferenceReturnAndAWheelAreGivenUpWhenTheyAreStopped) {
  for (unsigned which = 0; which < 4; ++which) {
    for (const char* what : {"step", "reference return", "handle"}) {
      SCOPED_TRACE(std::string(what) + " " + std::to_string(which));
      run();
      ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
      ASSERT_EQ(ask(CommandKind::kStep, 60), Answer::kDone);
      steps(1500);
      ASSERT_EQ(x(), 60);
      EXPECT_EQ(text(), "");
      if (what == std::string("handle")) {
        word(6, 1);
        word(0, 1);
      } else {
        ASSERT_EQ(ask(what == std::string("step") ? CommandKind::kStep : CommandKind::kReference, 60), Answer::kDone);
      }
      steps(60);
      ASSERT_NE(out().velocity.v[0], 0);
      hinder(which, true);
      EXPECT_EQ(text().substr(0, text().find(':')), std::string(what) + " X stopped");
      const double there = x();
      hinder(which, false);
      steps(500);
      EXPECT_EQ(x(), there);
      EXPECT_NE(there, 0);
      runtime.reset();
    }
  }
}

TEST_F(Hindrances, AWheelThatIsTurnedInVainSaysSoOnce) {
  run();
  word(5, 20);
  EXPECT_EQ(text(), "handle X refused: not in this mode");
  EXPECT_EQ(refusal().count, 1u);
  word(0);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  in("in1", 1);
  word(5, 20);
  EXPECT_EQ(text(), "handle X refused: the feed hold of the machine is on");
  EXPECT_EQ(refusal().count, 2u);
  word(0);
  in("in1", 0);
  steps(50);
  EXPECT_EQ(x(), 0) << "nothing of it is kept";
  word(5, 20);
  EXPECT_EQ(text(), "");
  word(0, 200);
  EXPECT_NEAR(x(), 0.060, 1e-9) << "20 scans of 3 um";
  word(6, 20);
  EXPECT_EQ(text(), "handle X refused: more than the axis follows: it does not end where the wheel says");
  EXPECT_EQ(nc::rt::refusal_cause(refusal()), nc::rt::RefusalCause::kTooFar);
  EXPECT_EQ(refusal().count, 3u);
}

// A potentiometer that sets the jog feed to 0 is no reason to refuse.
TEST_F(Hindrances, AJogFeedOfZeroIsWaitedFor) {
  use("LD in0\nOUT plc.jog_p.X\nLD SM400\nDMOV word_in plc.jog_feed\nEND\n");
  build();
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  in("in0", 1);
  steps(50);
  EXPECT_EQ(text(), "jog X waits: the jog feed is 0");
  word(600, 100);
  EXPECT_GT(x(), 0.5);
  EXPECT_EQ(text(), "");
}

TEST(Asker, IsNamed) {
  const nc::rt::Config wired = nc::test::parse_or_fail(nc::test::base_toml() + "[signals]\n\"plc.cycle_start\" = \"in0\"\n");
  EXPECT_EQ(nc::rt::asker_text(wired, nc::rt::Asker::kPanel), "at point \"in0\"");
  EXPECT_EQ(nc::rt::asker_text(wired, nc::rt::Asker::kLadder), "by the ladder");
  EXPECT_EQ(nc::rt::asker_text(wired, nc::rt::Asker::kClient), "by a client");
  EXPECT_EQ(nc::rt::asker_text(wired, nc::rt::Asker::kConsole), "at the console");
}

}  // namespace
