// SPDX-License-Identifier: Apache-2.0
// The lines of one chip over time, on a clock that the test sets.
#include "hal/gpio/line_bank.hpp"

#include <gtest/gtest.h>

#include "fake_lines.hpp"

namespace {

using nc::hal::gpio::BankConfig;
using nc::hal::gpio::LineBank;
using nc::test::FakeBoard;
using nc::test::gpio_line;
using std::chrono::milliseconds;

// Inputs "stop" (0) and "door" (1), outputs "lamp" (2) and "pump" (3).
class GpioBank : public testing::Test {
 protected:
  GpioBank() {
    config.name = "board";
    config.chip = "fake";
    config.lost_after = 3;
    config.lines = {gpio_line(1, "stop", false), gpio_line(2, "door", false), gpio_line(3, "lamp", true), gpio_line(4, "pump", true)};
  }
  bool open() {
    bank = std::make_unique<LineBank>(config, std::make_unique<nc::test::FakeChip>(&board), [this](const std::string& line) { log += line + "\n"; });
    return bank->open(now, wanted, &error);
  }
  void poll(unsigned after_ms = 1, bool scanned = true) {
    now += milliseconds(after_ms);
    bank->poll(now, wanted, scanned);
  }

  FakeBoard board;
  BankConfig config;
  std::unique_ptr<LineBank> bank;
  LineBank::Values wanted = {0, 0, 0, 1};
  LineBank::Time now{std::chrono::hours(1)};
  std::string error, log;
};

TEST_F(GpioBank, AllLinesAreAskedForAtOnceWithTheirSettingsAndFirstValues) {
  config.lines[0].line.active_low = true;
  config.lines[0].line.bias = nc::hal::gpio::Bias::kPullUp;
  config.lines[2].line.drive = nc::hal::gpio::Drive::kOpenDrain;
  config.consumer = "mill";
  ASSERT_TRUE(open()) << error;
  EXPECT_EQ(board.requests, 1u);
  EXPECT_EQ(board.consumer, "mill");
  ASSERT_EQ(board.asked.size(), 4u);
  EXPECT_TRUE(board.asked[0].active_low);
  EXPECT_EQ(board.asked[0].bias, nc::hal::gpio::Bias::kPullUp);
  EXPECT_EQ(board.asked[2].drive, nc::hal::gpio::Drive::kOpenDrain);
  EXPECT_EQ(board.level["lamp"], 0u);
  EXPECT_EQ(board.level["pump"], 1u) << "without a write";
  EXPECT_EQ(board.writes, 0u);
  EXPECT_EQ(log, "");
}

TEST_F(GpioBank, InputsAreReadInEachPollAndOutputsWrittenWhenTheyChange) {
  ASSERT_TRUE(open());
  EXPECT_FALSE(bank->good(0)) << "not read yet";
  EXPECT_TRUE(bank->good(2)) << "has its value since the request";
  board.level["door"] = 1;
  poll();
  EXPECT_TRUE(bank->good(0) && bank->good(1));
  EXPECT_EQ(bank->shown(0), 0);
  EXPECT_EQ(bank->shown(1), 1);
  board.level["door"] = 0;
  poll();
  EXPECT_EQ(bank->shown(1), 0);
  EXPECT_EQ(board.reads, 2u);
  EXPECT_EQ(board.writes, 0u);
  wanted[2] = 1;
  poll();
  poll();
  EXPECT_EQ(board.level["lamp"], 1u);
  EXPECT_EQ(board.level["pump"], 1u);
  EXPECT_EQ(board.writes, 1u);
  board.level["lamp"] = 0;  // an expander that had no supply for a moment
  poll(100);
  EXPECT_EQ(board.level["lamp"], 1u) << "written again after 0.1 s";
}

TEST_F(GpioBank, ALevelCountsWhenItHasStoodForTheTimeOfTheDebounce) {
  config.lines[0].debounce_ms = 5;
  board.level["stop"] = 1;
  ASSERT_TRUE(open());
  poll();
  EXPECT_EQ(bank->shown(0), 1) << "the first level counts at once";
  for (unsigned i = 0; i < 6; ++i) {  // bounces for longer than the debounce time: every poll finds another level
    board.level["stop"] = i % 2;
    poll(2);
    EXPECT_EQ(bank->shown(0), 1) << i;
  }
  board.level["stop"] = 0;
  poll();
  poll(4);
  EXPECT_EQ(bank->shown(0), 1) << "4 ms";
  poll();
  EXPECT_EQ(bank->shown(0), 0) << "5 ms";
  board.level["stop"] = 1;
  poll();
  board.level["stop"] = 0;
  poll(4);
  poll(100);
  EXPECT_EQ(bank->shown(0), 0) << "a pulse of 4 ms is none";
}

TEST_F(GpioBank, ALineThatIsTakenAtTheStartIsAnErrorThatNamesIt) {
  board.owner["door"] = "gpio-keys";
  EXPECT_FALSE(open());
  EXPECT_EQ(error, "GPIO board: line door is taken by \"gpio-keys\"");
  EXPECT_FALSE(bank->up());
  EXPECT_EQ(log, "") << "said once";
}

TEST_F(GpioBank, AChipThatIsNotThereIsAskedForLessAndLessOften) {
  board.present = false;
  config.lines[0].loss_value = 1;
  config.lines[1].hold_on_loss = true;
  wanted[1] = 1;  // the initial value of the point
  ASSERT_TRUE(open()) << error;
  EXPECT_EQ(log, "board: there is no chip \"fake\"\n");
  EXPECT_FALSE(bank->good(0) || bank->good(1) || bank->good(2));
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->shown(1), 1);
  poll(99);
  EXPECT_EQ(board.requests, 1u);
  poll(1);
  EXPECT_EQ(board.requests, 2u) << "after 0.1 s";
  poll(199);
  EXPECT_EQ(board.requests, 2u);
  poll(1);
  EXPECT_EQ(board.requests, 3u) << "after 0.2 s more";
  for (unsigned i = 0; i < 10; ++i) poll(5000);
  EXPECT_EQ(board.requests, 13u) << "every 5 s";
  board.present = true;
  wanted[2] = 1;
  poll(5000);
  EXPECT_TRUE(bank->good(0) && bank->good(2));
  EXPECT_EQ(bank->shown(0), 0);
  EXPECT_EQ(board.level["lamp"], 1u) << "what the control wants now";
  EXPECT_EQ(log, "board: there is no chip \"fake\"\nboard: the lines of fake are there\n");
}

TEST_F(GpioBank, AChipThatVanishesTakesTheQualityOfItsPointsAndComesBack) {
  config.lines[1].hold_on_loss = true;
  ASSERT_TRUE(open());
  board.level["stop"] = board.level["door"] = 1;
  poll();
  board.present = false;
  poll();
  poll();
  EXPECT_TRUE(bank->good(0)) << "two errors";
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(board.releases, 0u);
  poll();
  EXPECT_FALSE(bank->good(0) || bank->good(1) || bank->good(2) || bank->up());
  EXPECT_EQ(bank->shown(0), 0);
  EXPECT_EQ(bank->shown(1), 1) << "holds";
  EXPECT_EQ(board.releases, 1u);
  EXPECT_EQ(log, "board: lost: chip is gone\n");
  wanted[2] = 1;
  poll(99);
  EXPECT_EQ(board.requests, 1u);
  board.present = true;
  board.level["lamp"] = 0;
  poll(1);
  EXPECT_EQ(board.requests, 2u);
  EXPECT_EQ(board.level["lamp"], 1u);
  EXPECT_TRUE(bank->good(0) && bank->good(1) && bank->good(2) && bank->up());
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(log, "board: lost: chip is gone\nboard: the lines of fake are there\n");
}

TEST_F(GpioBank, ErrorsThatAreNotInARowLoseNothing) {
  ASSERT_TRUE(open());
  for (unsigned i = 0; i < 10; ++i) {
    board.trouble = i % 3 == 2 ? "" : "Input/output error";
    poll();
    EXPECT_TRUE(bank->up()) << i;
  }
  EXPECT_EQ(board.releases, 0u);
}

TEST_F(GpioBank, ALineThatAnotherTakesInBetweenIsAskedForUntilItIsFree) {
  ASSERT_TRUE(open());
  board.present = false;
  for (unsigned i = 0; i < 3; ++i) poll();
  board.present = true;
  board.owner["pump"] = "gpioset";
  poll(100);
  poll(200);
  EXPECT_FALSE(bank->up());
  board.owner.clear();
  poll(400);
  EXPECT_TRUE(bank->up());
  EXPECT_EQ(log, "board: lost: chip is gone\nboard: line pump is taken by \"gpioset\"\nboard: the lines of fake are there\n");
}

TEST_F(GpioBank, OutputsAloneFindOutThatTheirChipIsGone) {
  config.lines.erase(config.lines.begin(), config.lines.begin() + 2);
  wanted = {0, 1};
  ASSERT_TRUE(open());
  board.present = false;
  poll(100);
  poll();
  poll();
  EXPECT_FALSE(bank->up());
  EXPECT_EQ(board.reads, 0u);
}

TEST_F(GpioBank, InputsAloneWriteNothing) {
  config.lines.erase(config.lines.begin() + 2, config.lines.end());
  wanted = {0, 0};
  ASSERT_TRUE(open());
  poll(1000);
  poll(1000);
  bank->close();
  EXPECT_EQ(board.writes, 0u);
  EXPECT_EQ(log, "");
}

TEST_F(GpioBank, TheWatchdogChangesItsLevelWithTheScanAndRestsWithIt) {
  config.has_watchdog = true;
  config.watchdog.name = "alive";
  config.watchdog.output = true;
  ASSERT_TRUE(open());
  EXPECT_EQ(board.level["alive"], 0u);
  for (unsigned i = 1; i <= 6; ++i) {
    poll();
    EXPECT_EQ(board.level["alive"], i % 2);
  }
  poll();
  poll(1, false);
  poll(1000, false);
  EXPECT_EQ(board.changes["alive"], 7u) << "the scan stands";
  EXPECT_EQ(board.level["alive"], 1u);
  bank->close();
  EXPECT_EQ(board.level["alive"], 0u);
}

TEST_F(GpioBank, AtTheEndOutputsHaveTheirValuesForItAndTheLinesAreFree) {
  config.lines[2].stop_value = 1;
  config.lines[3].stop_value = 0;
  ASSERT_TRUE(open());
  poll();
  bank->close();
  EXPECT_EQ(board.level["lamp"], 1u);
  EXPECT_EQ(board.level["pump"], 0u);
  EXPECT_EQ(board.releases, 1u);
  EXPECT_FALSE(bank->up());
  EXPECT_EQ(log, "");
}

TEST_F(GpioBank, AnEndThatCannotWriteSaysSo) {
  ASSERT_TRUE(open());
  board.trouble = "Input/output error";
  bank->close();
  EXPECT_EQ(log, "board: safe values not written: Input/output error\n");
  EXPECT_EQ(board.releases, 1u);
  board.present = false;
  log.clear();
  ASSERT_TRUE(open());
  bank->close();
  EXPECT_EQ(log, "board: there is no chip \"fake\"\nboard: safe values not written: the lines are not there\n");
}

}  // namespace
