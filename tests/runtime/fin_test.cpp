// SPDX-License-Identifier: Apache-2.0
// Everything that can be wrong with a FIN: alarm R15 says what it is, and names the function that waits.
#include "ladder_machine.hpp"
#include "runtime/console.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

class FinFaults : public nc::test::OwnLadder {
 protected:
  // in0 is FIN1, in1 is FIN2.
  void wire() {
    use("LD in0\nOUT plc.fin1\nLD in1\nOUT plc.fin2\nEND\n");
    config.ladder.fin_timeout_s = 1;
  }
  void expect_alarm(const std::string& text) {
    ASSERT_GT(until([&] { return !alarm().empty(); }, 5000), 0);
    EXPECT_EQ(alarm(), text);
    steps(5);
    EXPECT_EQ(out().strobe, 0) << "an alarm takes the strobes off";
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return !runtime->snapshot().resetting && alarm().empty(); }, 3000), 0);
  }
};

TEST_F(FinFaults, None) {
  wire();
  start("M8\nM30\n");
  expect_alarm("R15 FIN does not come: M8 (line 1)");
}

TEST_F(FinFaults, SeveralGroups) {
  wire();
  start("T12 S500 M3\nM30\n");
  expect_alarm("R15 FIN does not come: M3 S T (line 1)");
}

TEST_F(FinFaults, Fin1StaysOn) {
  wire();
  start("M8\nM9\nM30\n");
  ASSERT_GT(until([&] { return out().strobe == 1; }), 0);
  in("in0", 1);
  steps(5);
  EXPECT_EQ(out().strobe, 0);
  EXPECT_EQ(nc::rt::state_text(out()), "waits for FIN of M to go off");
  expect_alarm("R15 FIN1 does not go off: M8 is done, and the program waits for that (line 1)");
}

TEST_F(FinFaults, BothStayOn) {
  wire();
  start("T5\nM30\n");
  ASSERT_GT(until([&] { return out().strobe == 4; }), 0);
  in("in0", 1);
  in("in1", 1);
  expect_alarm("R15 FIN1 and FIN2 do not go off: T5 is done, and the program waits for that (line 1)");
}

TEST_F(FinFaults, OnBeforeTheStrobe) {
  wire();
  build();
  in("in0", 1);
  start("G4 X0.01\nM50\nM30\n");
  steps(100);
  EXPECT_EQ(out().strobe, 0) << "the strobe is held back";
  EXPECT_EQ(out().fin_wait, 1) << "but what waits is known";
  expect_alarm("R15 FIN1 was on before the strobe: M waits until it has been off (line 2)");
}

// FIN2 completes M8 at its rising edge, and is still on when the strobe of T5 should come.
TEST_F(FinFaults, Fin2StaysOnForTheNextOne) {
  wire();
  start("M8\nT5\nM30\n");
  ASSERT_GT(until([&] { return out().strobe == 1; }), 0);
  in("in1", 1);
  expect_alarm("R15 FIN2 was on before the strobe: T waits until it has been off (line 2)");
}

// A strobe that comes during a motion finds FIN on: this FIN is stale, and does not count until it has been off.
TEST_F(FinFaults, StaleInMotion) {
  wire();
  build();
  in("in0", 1);
  start("G91 G1 X20. F1200 M50\nM30\n");
  ASSERT_GT(until([&] { return out().cause == NC_CAUSE_FIN; }), 0);
  expect_alarm("R15 FIN1 was on before the strobe: M" +
               std::string(out().strobe != 0 ? "50" : "") + " waits until it has been off (line 1)");
}

// A stale FIN counts again as soon as it has been off.
TEST_F(FinFaults, AStaleOneCountsWhenItHasBeenOff) {
  wire();
  build();
  in("in0", 1);
  start("M50\nM30\n");
  steps(300);
  in("in0", 0);
  ASSERT_GT(until([&] { return out().strobe == 1; }, 500), 0);
  in("in0", 1);
  ASSERT_GT(until([&] { return out().strobe == 0; }, 500), 0);
  in("in0", 0);
  ASSERT_GT(until([&] { return out().m == 30; }, 500), 0);
  EXPECT_EQ(alarm(), "");
}

TEST_F(FinFaults, AResetInTheWaitIsNoFaultAndALateFinCompletesNothing) {
  wire();
  start("M8\nM30\n");
  ASSERT_GT(until([&] { return out().strobe == 1; }), 0);
  steps(900);  // nearly the time-out
  reset();
  EXPECT_EQ(out().fin_wait, 0);
  in("in0", 1);  // late
  steps(50);
  start("M9\nM30\n");
  steps(900);
  EXPECT_EQ(alarm(), "") << "the time of the next wait is its own";
  EXPECT_EQ(out().m, 8u) << "the late FIN has completed nothing";
  expect_alarm("R15 FIN1 was on before the strobe: M waits until it has been off (line 1)");
  in("in0", 0);
  reset();
}

TEST_F(FinFaults, TimeInAHoldDoesNotCount) {
  wire();
  start("M8\nM30\n");
  ASSERT_GT(until([&] { return out().strobe == 1; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
  steps(3000);
  EXPECT_EQ(alarm(), "");
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  expect_alarm("R15 FIN does not come: M8 (line 1)");
}

}  // namespace
