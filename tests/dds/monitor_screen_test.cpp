// SPDX-License-Identifier: Apache-2.0
// Which part of a page is on the screen of ncmon, and the line that --latency prints.
#include "dds/monitor_screen.hpp"

#include <gtest/gtest.h>

#include "dds/monitor_command.hpp"

namespace {

using nc::dds::fitted;
using nc::dds::from_line;

TEST(MonitorScreen, APageBeginsAtALine) {
  const std::string page = "one\ntwo\nthree\n";
  std::size_t line = 0;
  EXPECT_EQ(from_line(page, &line), page);
  line = 2;
  EXPECT_EQ(from_line(page, &line), "three\n");
  EXPECT_EQ(line, 2u);
}

TEST(MonitorScreen, BehindItsEndAPageBeginsAgain) {
  const std::string page = "one\ntwo\n";
  for (std::size_t line : {2u, 3u, 1000u}) {
    EXPECT_EQ(from_line(page, &line), page);
    EXPECT_EQ(line, 0u);
  }
}

TEST(MonitorScreen, LinesAndColumnsThatDoNotFitAreLeftOut) {
  EXPECT_EQ(fitted("abcdef\ngh\nij\n", 3, 4), "\033[Habcd\033[K\r\ngh\033[K\r\n\033[J");
  EXPECT_EQ(fitted("ab", 3, 4), "\033[Hab\033[K\r\n\033[J") << "a last line without its end";
  EXPECT_EQ(fitted("ab\n", 1, 4), "\033[H\033[J") << "the last row stays free";
}

TEST(MonitorLatency, IsTheShareOfTheTimes) {
  std::vector<std::int64_t> times;
  for (int n = 101; n > 0; --n) times.push_back((n - 1) * 1'000'000ll);
  EXPECT_EQ(nc::dds::latency_text(times), "scan to subscriber, 101 samples: p50 50.000 ms   p90 90.000 ms   p99 99.000 ms   max 100.000 ms");
  EXPECT_EQ(nc::dds::latency_text({2'500'000}), "scan to subscriber, 1 samples: p50 2.500 ms   p90 2.500 ms   p99 2.500 ms   max 2.500 ms");
}

}  // namespace
