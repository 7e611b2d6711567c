// SPDX-License-Identifier: Apache-2.0
// The stitches of the hx family on a machine whose ladder drives the head (HX 15.6, PM 7308 = 1): #7531 PPF, #7030 PPE and #7031 NPFIN as words of the macro
// interface. The ladder lets the head go down in automatic operation alone, and is the head as well: 20 ms down, 10 ms up.
#include <vector>

#include "ladder_machine.hpp"

namespace {

constexpr const char* kHead =
    "LD nc.macro_output.2.F\nAND nc.mode_auto\nANI in0\nOUT out0\n"      // the valve; in0: the head is stuck
    "LD out0\nOUTHS T0 K20\nLD T0\nOUT plc.macro_input.2.E\n"            // it is down: PPE
    "LD plc.macro_input.2.E\nSET M0\n"                                   // it has been down
    "LDI out0\nAND M0\nOUTHS T1 K10\nLD T1\nOUT plc.macro_input.2.F\n"   // it is up again: NPFIN
    "LD out0\nRST T1\nLD nc.m_strobe\nOUT plc.fin2\nEND\n";

class StitchHead : public nc::test::OwnLadder {
 protected:
  void sew(const std::string& program) {
    use(kHead);
    config.nc.dialect = NC_DIALECT_HX;
    config.sim.dialect = NC_DIALECT_HX;
    start("#27308=1\n" + program);
  }
  bool down() const { return point("out0") != 0; }
  double x() const { return out().command.v[0]; }
};

TEST_F(StitchHead, GoesDownOnceForEachStitchWhileTheAxesStand) {
  sew("G63.1\nG01 X2. F3000\nX4.\nX6.\nG63.2\nG01 X8.\nM30\n");
  std::vector<double> stitches;
  bool before = false;
  const std::uint64_t runs = runtime->info().system[0].runs;
  double at = 0;
  ASSERT_GE(until([&] {
              if (down() && !before) stitches.push_back(x());
              if (down() && before) {
                EXPECT_EQ(x(), at) << "the head is in the work";
              }
              before = down(), at = x();
              return runtime->info().system[0].runs > runs;
            }, 60000),
            0);
  EXPECT_EQ(alarm(), "");
  ASSERT_EQ(stitches.size(), 3u);
  for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(stitches[i], 2.0 * (i + 1), 1e-6);
  EXPECT_NEAR(x(), 8, 1e-6);
  EXPECT_FALSE(down());
}

TEST_F(StitchHead, ThatDoesNotAnswerIsAnAlarm) {
  use(kHead);
  config.nc.dialect = config.sim.dialect = NC_DIALECT_HX;
  build();
  in("in0", 1);
  start("#27308=1\nG63.1\nG01 X2. F3000\nX4.\nM30\n");
  ASSERT_GE(until([&] { return runtime->snapshot().alarmed(); }, 60000), 0);
  steps(50);
  EXPECT_STREQ(runtime->info().system[0].program_alarm.code, "NC-STITCH") << alarm();
  EXPECT_EQ(runtime->info().system[0].program_alarm.source.line, 3u);
  EXPECT_NEAR(x(), 2, 1e-6) << "no second stitch";
  EXPECT_FALSE(down());
}

TEST_F(StitchHead, RestsInAHoldAndGoesUpWhenItsModeEnds) {
  sew("G63.1\nG01 X2. F3000\nX4.\nG63.2\nM30\n");
  ASSERT_GE(until([&] { return down(); }), 0);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kFeedHold), nc::rt::Answer::kDone);
  steps(500);
  EXPECT_NEAR(x(), 2, 1e-6);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kCycleStart), nc::rt::Answer::kDone);
  ASSERT_GE(until_end(), 0);
  EXPECT_NEAR(x(), 4, 1e-6);
  // A reset leaves PPF as it is; the ladder does not let the head go down by hand.
  start("#27308=1\nG63.1\nG01 X6. F3000\nX8.\nG63.2\nM30\n");
  ASSERT_GE(until([&] { return down(); }), 0);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kReset), nc::rt::Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }), 0);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), nc::rt::Answer::kDone);
  steps(5);
  EXPECT_FALSE(down());
}

}  // namespace
