// SPDX-License-Identifier: Apache-2.0
// The lines of one chip over time, on a clock that the test sets.
#include "hal/gpio/line_bank.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

// A loose contact at the chip's bus: some lines a minute, one for all the others, and at the end what has not been said yet.
TEST_F(GpioBank, AChipThatComesAndGoesFillsNoLog) {
  ASSERT_TRUE(open());
  const auto lines = [this] { return std::count(log.begin(), log.end(), '\n'); };
  const LineBank::Time begin = now;
  unsigned times = 0;
  for (; now - begin < std::chrono::minutes(10); ++times) {
    board.present = false;
    for (unsigned i = 0; i < 3; ++i) poll();
    ASSERT_FALSE(bank->up());
    board.present = true;
    poll(100);
    ASSERT_TRUE(bank->up());
  }
  EXPECT_GT(times, 5000u);
  EXPECT_GE(lines(), 20);
  EXPECT_LE(lines(), 20 + 10);
  EXPECT_NE(log.find("board: 1"), std::string::npos) << log;
  EXPECT_NE(log.find(" more of these, the last one: "), std::string::npos) << log;
  const auto before = lines();
  bank->close();
  EXPECT_EQ(lines(), before + 1) << log;
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

// ---- edges ----

// The input "stop" notes edges and is the probe; "a" and "b" are an encoder.
class GpioEdges : public GpioBank {
 protected:
  GpioEdges() {
    config.lines[0].line.edges = true;
    config.probes.push_back({0, 0, 0, false});
    nc::hal::gpio::Encoder encoder;
    encoder.point = 9;
    encoder.a.name = "a";
    encoder.b.name = "b";
    encoder.a.edges = encoder.b.edges = true;
    config.encoders.push_back(encoder);
  }
  std::int64_t ns(double after_ms = 0) const {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now.time_since_epoch()).count() + static_cast<std::int64_t>(after_ms * 1e6);
  }
  std::int64_t last_edge() const { return bank->probe(0).time_ns[(bank->probe(0).count - 1) % LineBank::kProbeEdges]; }
  // The wheel goes to a place, in quarters of a period, with an edge each so many milliseconds, which the kernel notes before the next poll.
  void turn_to(int to, double each_ms = 0.1) {
    const int way = to > place ? 1 : -1;
    for (double at = each_ms; place != to; at += each_ms) {
      const int before = (place % 4 + 4) % 4;
      place += way;
      const int next = (place % 4 + 4) % 4;
      const auto a = [](int p) { return p == 1 || p == 2; };
      if (a(before) != a(next)) board.turn("a", a(next), ns(at));
      else board.turn("b", next >= 2, ns(at));
    }
  }
  int place = 0;
};

TEST_F(GpioEdges, AnEdgeOfAProbeHasTheTimeOfTheKernel) {
  ASSERT_TRUE(open()) << error;
  EXPECT_TRUE(board.asked[0].edges);
  EXPECT_FALSE(board.asked[1].edges);
  board.level["stop"] = 1;
  poll();
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->probe(0).count, 0u) << "the first level is no edge";
  board.turn("stop", false, ns(0.3));
  poll();
  EXPECT_EQ(bank->shown(0), 0);
  EXPECT_EQ(bank->probe(0).count, 0u) << "a falling edge";
  const std::int64_t when = ns(0.7);
  board.turn("stop", true, when);
  poll();
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(last_edge(), when);
  const std::int64_t pulse = ns(0.2);
  board.turn("stop", false, ns(0.1));
  board.turn("stop", true, pulse);
  board.turn("stop", false, ns(0.3));
  poll();
  EXPECT_EQ(bank->shown(0), 0);
  EXPECT_EQ(bank->probe(0).count, 2u) << "a pulse between two polls";
  EXPECT_EQ(last_edge(), pulse);
  EXPECT_EQ(log, "");
}

TEST_F(GpioEdges, ALevelIsNotSeenBeforeItsEdge) {
  ASSERT_TRUE(open());
  poll();
  board.level["stop"] = 1;  // read; the edge comes behind it
  poll();
  EXPECT_EQ(bank->shown(0), 0);
  board.turn("stop", true, ns());
  poll();
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(log, "");
}

TEST_F(GpioEdges, AProbeThatBouncesHasThePlaceOfItsFirstEdge) {
  config.lines[0].debounce_ms = 3;
  board.debounces = true;
  ASSERT_TRUE(open());
  EXPECT_EQ(board.asked[0].debounce_ms, 0u) << "the kernel would give the time behind the bouncing";
  poll();
  const std::int64_t first = ns(0.2);
  board.turn("stop", true, first);
  board.turn("stop", false, ns(0.4));
  poll();
  board.turn("stop", true, ns(0.5));
  poll();
  poll(2);
  EXPECT_EQ(bank->probe(0).count, 0u);
  EXPECT_EQ(bank->shown(0), 0);
  poll();
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(last_edge(), first);
  EXPECT_EQ(bank->shown(0), 1);
}

TEST_F(GpioEdges, TheKernelDebouncesWhatIsNoProbeWhereItCan) {
  for (const bool can : {false, true}) {
    board.debounces = can;
    board.level.clear();
    config.lines[1].debounce_ms = 5;
    ASSERT_TRUE(open());
    EXPECT_EQ(board.asked[1].debounce_ms, can ? 5u : 0u);
    poll();
    board.level["door"] = 1;
    poll();
    EXPECT_EQ(bank->shown(1), can ? 1 : 0);
    poll(5);
    EXPECT_EQ(bank->shown(1), 1);
    bank->close();
  }
}

TEST_F(GpioEdges, LostEdgesAreSeenAndSaid) {
  ASSERT_TRUE(open());
  poll();
  board.level["stop"] = 1;  // the kernel had no room for the edge
  poll();
  poll();
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(last_edge(), 0) << "nobody knows when it was";
  EXPECT_EQ(log, "board: edges were lost 1 times: a contact bounces, or edges come faster than they are read\n");
  board.edges.push_back({"stop", true, ns(0.5)});
  poll();
  poll();
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << "not again within 10 s";
  poll(10000);
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2);
}

TEST_F(GpioEdges, TimesOfAnotherClockAreNone) {
  ASSERT_TRUE(open());
  poll();
  board.turn("stop", true, 1'700'000'000'000'000'000);  // CLOCK_REALTIME, of a kernel before 5.7
  poll();
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->probe(0).count, 1u);
  EXPECT_EQ(last_edge(), 0);
  EXPECT_EQ(log, "board: the kernel does not give the times of edges by CLOCK_MONOTONIC, as Linux does from 5.7 on: skip positions are those of the scan\n");
}

TEST_F(GpioEdges, TimesThatGoBackAreNone) {
  ASSERT_TRUE(open());
  poll();
  board.turn("stop", true, ns(0.7));
  board.turn("stop", false, ns(0.8));
  board.turn("stop", true, ns(0.1));
  board.turn("a", true, ns(0.6));
  board.turn("a", false, ns(0.4));
  poll();
  EXPECT_EQ(bank->shown(0), 1);
  EXPECT_EQ(bank->probe(0).count, 2u);
  EXPECT_EQ(last_edge(), 0) << "the skip position would be where the axes were not";
  poll();
  EXPECT_EQ(bank->count(0), 0u) << "the wheel has gone to and fro";
  EXPECT_TRUE(bank->count_good(0));
  EXPECT_EQ(log, "");
}

TEST_F(GpioEdges, AnEncoderCountsToAndFroInTheOrderOfTheTimes) {
  board.level["a"] = 1;  // amid a period
  place = 1;
  ASSERT_TRUE(open());
  EXPECT_FALSE(bank->count_good(0));
  poll();
  EXPECT_TRUE(bank->count_good(0));
  EXPECT_EQ(bank->count(0), 0u);
  turn_to(8);
  std::stable_partition(board.edges.begin(), board.edges.end(), [](const FakeBoard::Edge& edge) { return edge.line == "b"; });  // one line behind the other
  poll();
  poll();
  EXPECT_EQ(bank->count(0), 7u);
  turn_to(-3);
  poll(2);
  poll();
  EXPECT_EQ(bank->count(0), static_cast<std::uint32_t>(-4));
  EXPECT_TRUE(bank->count_good(0));
  EXPECT_EQ(log, "");
}

TEST_F(GpioEdges, AnEdgeOfOneLineThatIsReadBehindALaterOneOfTheOtherCountsInItsPlace) {
  ASSERT_TRUE(open());
  poll();
  const FakeBoard::Edge late{"a", true, ns(0.95)};
  board.turn("b", true, ns(0.98));
  poll();
  board.level["a"] = 1;
  board.edges.push_back(late);
  poll();
  poll();
  EXPECT_EQ(bank->count(0), 2u) << "and not two to and fro";
}

TEST_F(GpioEdges, ACountThatHasLostItsWayIsNotGoodForAWhile) {
  ASSERT_TRUE(open());
  poll();
  turn_to(5);
  board.edges.erase(board.edges.begin() + 2);  // a goes off
  poll();
  poll();
  EXPECT_FALSE(bank->count_good(0)) << "a has come on twice";
  poll(499);
  EXPECT_FALSE(bank->count_good(0));
  poll(1);
  EXPECT_TRUE(bank->count_good(0));
}

TEST_F(GpioEdges, AnEncoderGoesOnCountingBehindALoss) {
  ASSERT_TRUE(open());
  poll();
  turn_to(4);
  poll();
  poll();
  EXPECT_EQ(bank->count(0), 4u);
  board.present = false;
  for (unsigned i = 0; i < 3; ++i) poll();
  EXPECT_FALSE(bank->count_good(0));
  EXPECT_EQ(bank->count(0), 4u);
  board.edges.clear();
  turn_to(6);  // unseen
  board.edges.clear();
  board.present = true;
  poll(100);
  EXPECT_TRUE(bank->count_good(0));
  EXPECT_EQ(bank->count(0), 4u);
  turn_to(8);
  poll();
  poll();
  EXPECT_EQ(bank->count(0), 6u);
}

}  // namespace
