// SPDX-License-Identifier: Apache-2.0
// Auxiliary lock, FIN by group, the code of the feed override and dry run, from the points of a machine to what its axes do.
#include "runtime/console.hpp"
#include "switch_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::OverrideSource;

class Trial : public nc::test::SwitchMachine {
 protected:
  void SetUp() override {
    fin_timeout_s = 0;  // none
    build();
  }
};

// ---- auxiliary lock

TEST_F(Trial, AuxiliaryLockGivesOutWhatStopsAndEndsAlone) {
  hal->machine.hold_fin(true);  // the machine would never answer
  turn("auxiliary_lock", 1);
  start("M8\nT5 S900 M3\nG91 G1 X2. M9 F1200\nM0\nM30\n");
  std::uint32_t strobes = 0;
  ASSERT_GE(until([&] {
              strobes |= out().strobe;
              return out().strobe == 1;
            }),
            0);
  EXPECT_EQ(out().m, 0u) << "M00";
  EXPECT_EQ(strobes, 1u);
  EXPECT_NEAR(counted(0), 2, 1e-9);
  EXPECT_EQ(out().t, 0u);
  EXPECT_EQ(out().s, 0);
  EXPECT_EQ(out().spindle_rev_min[0], 0);
  hal->machine.hold_fin(false);
  ASSERT_GE(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until([&] { return out().strobe == 1 && out().m == 30; }), 0);
  until_end();
}

TEST_F(Trial, AuxiliaryLockLeavesWhatWaitsAlready) {
  hal->machine.hold_fin(true);
  start("M8\nM9\nM30\n");
  ASSERT_GE(until([&] { return out().strobe == 1; }), 0);
  turn("auxiliary_lock", 1);
  steps(100);
  EXPECT_EQ(out().strobe, 1) << "M8 is waited for";
  hal->machine.hold_fin(false);
  until_end();
  EXPECT_EQ(out().m, 30u);
}

// ---- FIN by group

TEST_F(Trial, EachGroupHasItsOwnFin) {
  hal->machine.hold_fin(true);
  start("T5 S900 M3\nG91 G1 X1. F1200\nM30\n");
  ASSERT_GE(until([&] { return out().strobe == 7; }), 0);
  turn("tfin", 1);
  steps(3);
  EXPECT_EQ(out().strobe, 3);
  EXPECT_EQ(out().fin_wait, 7) << "as FIN1: complete when it falls";
  turn("tfin", 0);
  steps(3);
  EXPECT_EQ(out().fin_wait, 3);
  turn("sfin", 1);
  turn("mfin", 1);
  steps(3);
  EXPECT_EQ(out().strobe, 0);
  turn("sfin", 0);
  steps(50);
  EXPECT_EQ(out().fin_wait, 1);
  EXPECT_EQ(counted(0), 0);
  turn("mfin", 0);
  ASSERT_GE(until([&] { return counted(0) > 0.5; }), 0);
}

TEST_F(Trial, AFinOfItsOwnThatIsOnAlreadyDoesNotCount) {
  hal->machine.hold_fin(true);
  turn("mfin", 1);
  start("T5\nM8\nM30\n");
  ASSERT_GE(until([&] { return out().strobe == 4; }), 0) << "that of M does not concern T";
  turn("tfin", 1);
  steps(3);
  turn("tfin", 0);
  steps(100);
  EXPECT_EQ(out().strobe, 0) << "but the strobe of M is held back";
  EXPECT_EQ(out().fin_wait, 1);
  turn("mfin", 0);
  ASSERT_GE(until([&] { return out().strobe == 1; }, 10), 0);
}

// The strobe of a code that is given out on the way rises at once; a FIN that was on before does not complete it.
TEST_F(Trial, AllGroupsGoByTheirOwnBits) {
  hal->machine.hold_fin(true);
  start("B7\nM30\n");
  ASSERT_GE(until([&] { return out().strobe == 8; }), 0);
  for (const char* other : {"mfin", "sfin", "tfin"}) {
    turn(other, 1);
    steps(3);
    turn(other, 0);
    steps(3);
    EXPECT_EQ(out().strobe, 8) << other;
  }
  turn("bfin", 1);
  steps(3);
  EXPECT_EQ(out().strobe, 0);
  turn("bfin", 0);
  ASSERT_GE(until([&] { return out().strobe == 1 && out().m == 30; }, 10), 0);
}

class OwnFinFault : public nc::test::SwitchMachine {};

TEST_F(OwnFinFault, IsNamed) {
  fin_timeout_s = 1;
  build();
  hal->machine.hold_fin(true);
  start("T5 M8\nM30\n");
  ASSERT_GE(until([&] { return out().strobe == 5; }), 0);
  turn("tfin", 1);
  steps(3);
  turn("tfin", 0);
  turn("mfin", 1);
  ASSERT_GE(until([&] { return !alarm().empty(); }), 0);
  EXPECT_EQ(alarm(), "R15 MFIN does not go off: M8 is done, and the program waits for that (line 1)");
  reset();
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_GE(until([&] { return !alarm().empty(); }), 0);
  EXPECT_EQ(alarm(), "R15 MFIN was on before the strobe: M waits until it has been off (line 1)");
}

// ---- code of the feed override

class FeedCode : public Trial {
 protected:
  void code(unsigned percent) {
    const unsigned bits = ~(percent / 10) & 0x1f;
    for (unsigned n = 0; n < 5; ++n) turn("feed_code." + std::to_string(n + 1), bits >> n & 1u);
    steps(400);
  }
  nc::rt::SystemSnapshot now() const { return runtime->snapshot().system[0]; }
};

TEST_F(FeedCode, StepsOfTenPercentInverted) {
  start("G91 G1 X450. F600\nM30\n");
  steps(100);
  EXPECT_EQ(now().feed_override_source, OverrideSource::kOperator) << "no switch has been seen";
  for (const unsigned percent : {100u, 10u, 150u, 0u, 80u, 200u}) {
    code(percent);
    EXPECT_NEAR(now().feed_override, percent / 100.0, 1e-12);
    EXPECT_EQ(now().feed_override_source, OverrideSource::kMachine);
    EXPECT_NEAR(out().feed_mm_min, 6.0 * percent, 1e-3);
  }
  code(300);
  EXPECT_NEAR(now().feed_override, config.nc.max_feed_override, 1e-12) << "at most the machine's";
  EXPECT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.5), Answer::kMachineSwitch);
  code(310);  // all off
  EXPECT_EQ(now().feed_override, 0) << "a broken cable";
}

// ---- dry run

TEST_F(Trial, DryRunGoesAtTheManualFeed) {
  turn("jog_feed", 3000);
  start("G91 G1 X100. F600\nG0 X-50.\nM30\n");
  steps(400);
  EXPECT_NEAR(out().feed_mm_min, 600, 1e-6);
  turn("dry_run", 1);
  steps(400);
  EXPECT_NEAR(out().feed_mm_min, 3000, 1e-6);
  EXPECT_NEAR(out().feed_command_mm_min, 3000, 1e-6);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedOverride, 0.5), Answer::kDone);
  steps(400);
  EXPECT_NEAR(out().feed_mm_min, 1500, 1e-6);
  ASSERT_EQ(runtime->execute(CommandKind::kFeedOverride, 1), Answer::kDone);
  turn("jog_feed", 0);
  steps(400);
  EXPECT_EQ(out().feed_mm_min, 0);
  EXPECT_EQ(out().cause, NC_CAUSE_MANUAL_FEED_ZERO);
  EXPECT_EQ(nc::rt::state_text(out()), "dry run: the manual feed rate is 0");
  turn("jog_feed", 100);
  turn("jog_rapid", 1);  // as fast as the axes may cut
  steps(300);
  EXPECT_NEAR(out().feed_mm_min, 200 * 60, 1e-6);
  ASSERT_GE(until([&] { return out().rapid; }), 0);
  turn("jog_rapid", 0);
  ASSERT_GE(until([&] { return out().feed_mm_min > 5000; }), 0) << "rapid traverse is not concerned";
  until_end();
}

// M700 13.1.1, #1085.
TEST_F(Trial, DryRunOfRapidTraverseByItsParameter) {
  ASSERT_EQ(nc_parameter_set(runtime->control(), 0, "1085", 0, "1"), NC_OK);
  turn("jog_feed", 3000);
  turn("dry_run", 1);
  start("G91 G0 X100.\nM30\n");
  steps(400);
  EXPECT_NEAR(out().feed_mm_min, 3000, 1e-6);
  turn("jog_rapid", 1);
  steps(300);
  EXPECT_GT(out().feed_mm_min, 3001) << "with rapid it is rapid traverse";
}

}  // namespace
