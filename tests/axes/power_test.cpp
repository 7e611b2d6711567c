// SPDX-License-Identifier: Apache-2.0
// The supply says that it fails: rest, drives off behind their brakes, alarm R24. The rows of docs/safety.md. What is written then: tests/runtime/power_keep_test.cpp.
#include "axes_machine.hpp"
#include "runtime/power/power_watch.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::rt::PowerWatch;

class PowerFail : public nc::test::AxesMachine {
 protected:
  static std::string with_power(const char* keys) {
    std::string text = changed({{"[signals]\n", "[[point]]\nname = \"power_good\"\ndirection = \"input\"\ninitial = 1\n[signals]\n\"plc.power_fail_n\" = \"power_good\"\n"}});
    return text + "[power]\n" + keys;
  }
  std::string power_alarm() const {
    const nc::rt::Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i)
      if (now.alarms.alarm[i].id == nc::rt::AlarmId::kPowerFails) return runtime->alarm_text(now.alarms.alarm[i]);
    return "";
  }
  bool drives_off() const { return !measured->last.enable || (measured->last.off & 7u) == 7u; }
  void expect_done(const char* how = "came to rest on their paths") {
    ASSERT_GE(until([&] { return power_alarm().find("brakes have closed") != std::string::npos; }, 3000), 0) << power_alarm();
    EXPECT_NE(power_alarm().find(how), std::string::npos) << power_alarm();
    EXPECT_NE(power_alarm().find("no retained data are configured"), std::string::npos) << power_alarm();
    EXPECT_FALSE(brake_open());
    EXPECT_TRUE(drives_off());
    EXPECT_TRUE(out().distance_zero);
  }
  // The power is back: nothing moves by itself, a reset makes the machine ready.
  void expect_back() {
    const std::uint64_t moved = measured->moved;
    in("power_good", 1);
    steps(1500);
    EXPECT_NE(power_alarm(), "") << "until an operator has seen it";
    EXPECT_NE(ask(CommandKind::kCycleStart), Answer::kDone);
    reset();
    EXPECT_EQ(power_alarm(), "");
    ASSERT_GE(until([&] { return brake_open(); }, 1000), 0);
    steps(300);
    EXPECT_EQ(measured->moved, moved) << "nothing moves until somebody starts it";
  }
};

TEST_F(PowerFail, AProgramComesToRestOnItsPathAndNothingMovesUntilItIsStarted) {
  build(with_power("stop_s = 0.5\n"));
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X0. Y0.\nG1 X200. Y100. F6000.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return out().command.v[kX] > 60; }, 20000), 0);
  in("power_good", 0);
  ASSERT_GE(until([&] { return out().distance_zero; }, 500), 0);
  EXPECT_NEAR(out().command.v[kY], out().command.v[kX] / 2, 0.02) << "on the path";
  EXPECT_LT(out().command.v[kX], 200);
  expect_done();
  EXPECT_EQ(flags().homed, 7u) << "the encoders count on";
  expect_limits_kept();
  expect_back();
  EXPECT_EQ(start_program("G90 G53 G0 X0. Y0.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return runtime->info().system[0].ended; }, 20000), 0);
}

TEST_F(PowerFail, WhoseAxesNeedLongerHasItsDrivesTakenOff) {
  build(with_power("stop_s = 0.02\n"));
  home_machine();
  ASSERT_EQ(start_program("G90 G53 G0 X250.\nM30\n"), Answer::kDone);
  ASSERT_GE(until([&] { return out().velocity.v[kX] > 190; }, 20000), 0);
  in("power_good", 0);
  EXPECT_LE(until([&] { return drives_off() || !measured->last.enable || (measured->last.off & 1u) != 0; }, 500), 24) << "20 ms, and what a scan sees of another";
  expect_done("were not at rest within 20 ms");
  expect_back();
}

TEST_F(PowerFail, MotionByHandAndHomingEndAndDoNotGoOn) {
  build(with_power("stop_s = 0.5\n"));
  manual_mode();
  (void)ask(CommandKind::kJog, kX, 40);
  steps(50);
  EXPECT_NE(out().velocity.v[kX], 0);
  in("power_good", 0);
  expect_done();
  expect_back();
  ASSERT_EQ(home_all(), Answer::kDone);
  steps(300);
  EXPECT_NE(flags().homing, 0u);
  in("power_good", 0);
  expect_done();
  EXPECT_EQ(flags().homing, 0u);
  EXPECT_NE(flags().homed, 7u);
  expect_back();
  EXPECT_EQ(flags().homing, 0u);
  home_machine();
  expect_limits_kept();
}

TEST_F(PowerFail, AResetBeforeThePowerIsBackChangesNothing) {
  build(with_power("stop_s = 0.5\n"));
  home_machine();
  in("power_good", 0);
  steps(2);
  (void)ask(CommandKind::kReset);
  expect_done();
  reset();
  EXPECT_NE(power_alarm(), "");
  EXPECT_FALSE(brake_open());
  EXPECT_EQ(ask(CommandKind::kJog, kX, 10), Answer::kAlarmActive);
  in("power_good", 1);
  steps(500);
  reset();
  EXPECT_NE(power_alarm(), "") << "it is good only when it has been on for settle_s";
  expect_back();
}

TEST_F(PowerFail, EachErrorOfItsSectionNamesItsPlace) {
  for (const auto& [keys, says] : {std::pair{"stop_s = 0\n", "power.stop_s: "}, std::pair{"delay_s = -1\n", "power.delay_s: "}, std::pair{"settle_s = \"long\"\n", "power.settle_s: "},
                                   std::pair{"hold = 1\n", "power.hold: "}}) {
    nc::rt::Config read;
    const auto errors = nc::rt::parse_config(with_power(keys), "axes.toml", &read);
    ASSERT_EQ(errors.size(), 1u) << keys;
    EXPECT_NE(errors[0].text().find(says), std::string::npos) << errors[0].text();
    EXPECT_GT(errors[0].line, 0u);
  }
  nc::rt::Config read;
  const auto errors = nc::rt::parse_config(toml() + "[power]\n", "axes.toml", &read);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("nothing gives plc.power_fail_n"), std::string::npos) << errors[0].text();
  EXPECT_TRUE(nc::rt::parse_config(with_power("stop_s = 0.05\n"), "axes.toml", &read).empty());
  EXPECT_EQ(nc::rt::power_warnings(read).size(), 3u) << "100 ms of braking, 40 ms of jerk, 30 ms";
  EXPECT_TRUE(nc::rt::parse_config(with_power("stop_s = 0.2\n"), "axes.toml", &read).empty());
  EXPECT_TRUE(nc::rt::power_warnings(read).empty());
}

// ---- the input alone ----

struct Input {
  PowerWatch watch;
  bool alarm = false;
  unsigned saves = 0;
  explicit Input(const nc::rt::PowerConfig& config) { watch.create(config, false); }
  // `times` scans of 1 ms; the axes stand and everything is written at once.
  void give(bool fails, unsigned times) {
    for (unsigned n = 0; n < times; ++n) {
      PowerWatch::Seen seen;
      seen.fails = fails;
      seen.at_rest = seen.braked = seen.saved = true;
      seen.acknowledged = !alarm;
      const PowerWatch::Wish wish = watch.step(seen);
      alarm |= wish.raise;
      saves += wish.save;
    }
  }
};

TEST(PowerInput, ChatterTripsOnceAndIsWaitedFor) {
  Input input({1, 0, 0.5});
  input.give(false, 100);
  EXPECT_FALSE(input.watch.failed());
  for (int n = 0; n < 200; ++n) {
    input.give(true, 1);
    input.give(false, 3);
  }
  EXPECT_TRUE(input.watch.failed());
  EXPECT_EQ(input.saves, 2u) << "at once, and at rest";
  input.alarm = false;  // a reset
  input.give(false, 400);
  EXPECT_TRUE(input.watch.failed()) << "0.4 s without an edge";
  EXPECT_EQ(input.saves, 2u) << "a reset before that begins nothing anew";
  EXPECT_TRUE(input.alarm);
  input.give(false, 200);
  EXPECT_TRUE(input.watch.failed()) << "good, and not acknowledged";
  input.alarm = false;
  input.give(false, 1);
  EXPECT_FALSE(input.watch.failed());
}

TEST(PowerInput, WhatIsShorterThanTheDelayDoesNotCountAndChatterAddsUp) {
  Input input({1, 0.02, 0.1});
  input.give(true, 20);
  input.give(false, 150);
  input.give(true, 20);
  EXPECT_FALSE(input.watch.failed());
  input.give(false, 150);
  for (int n = 0; n < 19; ++n) {
    input.give(true, 1);
    input.give(false, 5);
  }
  EXPECT_FALSE(input.watch.failed());
  input.give(true, 2);
  EXPECT_TRUE(input.watch.failed());
}

}  // namespace
