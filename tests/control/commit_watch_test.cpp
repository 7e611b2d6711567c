// SPDX-License-Identifier: Apache-2.0
// nc_commit_watch_set(): the watch sees the executed stream item by item, and an item that it postpones is not executed meanwhile.
#include <gtest/gtest.h>

#include "support/drive.hpp"
#include "support/random_program.hpp"

namespace nc::test {
namespace {

struct Seen {
  uint64_t serial = 0;
  uint8_t kind = 0;
  uint32_t line = 0, main_line = 0;
};

struct Watch {
  nc_control* control = nullptr;
  uint64_t hold = 0;  ///< serial of the item that is postponed
  unsigned asked = 0;
  std::vector<Seen> seen;
};

bool watch(void* user, const nc_item* item) {
  Watch& w = *static_cast<Watch*>(user);
  if (item->serial == w.hold) {
    ++w.asked;
    return false;
  }
  uint32_t line = 0;
  EXPECT_EQ(nc_main_line_get(w.control, 0, &item->source, &line), NC_OK);
  w.seen.push_back({item->serial, item->kind, item->source.line, line});
  return true;
}

TEST(CommitWatch, IsShownTheStreamThatIsExecuted) {
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    Bench bench;
    const RandomProgram program = ProgramMaker(seed, false).make();
    for (unsigned n = 1; n <= 9; ++n) bench.tool(n, 0.2 * n);
    for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
    Watch w{bench.control(), 0, 0, {}};
    ASSERT_EQ(nc_commit_watch_set(bench.control(), 0, watch, &w), NC_OK);
    Drive drive(bench, program.main);
    for (unsigned n = 0; n < 200'000 && !drive.ended && drive.out.state != NC_STATE_ALARM; ++n) {
      drive.press_start();
      if (drive.out.state == NC_STATE_STOPPED) drive.in.cycle_start = drive.cycle % 2 == 0;
      drive.step();
    }
    ASSERT_GT(drive.events.size(), 10u) << seed;
    ASSERT_LE(drive.events.size(), w.seen.size()) << seed;
    for (size_t i = 0; i < drive.events.size(); ++i) {
      ASSERT_EQ(drive.events[i].serial, w.seen[i].serial) << seed;
      ASSERT_EQ(drive.events[i].kind, w.seen[i].kind) << seed;
      ASSERT_EQ(drive.events[i].source.line, w.seen[i].line) << seed;
    }
  }
}

TEST(CommitWatch, WhatItPutsOffIsNotExecuted) {
  const char* const text = "G1 X1. F600\nG1 X2.\nG2 X4. I1.\nM3\nM30\n";
  for (uint64_t hold = 1; hold <= 8; ++hold) {
    Bench bench;
    Watch w{bench.control(), hold, 0, {}};
    ASSERT_EQ(nc_commit_watch_set(bench.control(), 0, watch, &w), NC_OK);
    Drive drive(bench, text);
    const auto run = [&] {
      for (unsigned n = 0; n < 3000; ++n) {
        drive.press_start();
        drive.step();
      }
    };
    run();
    EXPECT_FALSE(drive.ended) << hold;
    ASSERT_EQ(drive.events.size(), hold - 1);
    EXPECT_GT(w.asked, 1000u);
    w.hold = 0;
    run();
    EXPECT_TRUE(drive.ended) << hold;
    for (size_t i = 0; i < drive.events.size(); ++i) EXPECT_EQ(drive.events[i].serial, i + 1);
    EXPECT_NEAR(drive.out.command.v[0], 4, 1e-9);
  }
}

TEST(CommitWatch, KnowsTheLineThatCalls) {
  Bench bench;
  bench.add("O5", "G91 G1 Y1. F600\nM98 P6\nM99\n");
  bench.add("O6", "G91 G1 Y2. F600\nM99\n");
  Watch w{bench.control(), 0, 0, {}};
  ASSERT_EQ(nc_commit_watch_set(bench.control(), 0, watch, &w), NC_OK);
  Drive drive(bench, "GOTO 9\nN2 M98 P6\nM30\nN9 M98 P5\nGOTO 2\n");
  for (unsigned n = 0; n < 5000 && !drive.ended; ++n) {
    drive.press_start();
    drive.step();
  }
  ASSERT_TRUE(drive.ended);
  std::string lines;
  for (const Seen& s : w.seen)
    if (s.kind == NC_ITEM_MOVE) lines += std::to_string(s.main_line) + " ";
  EXPECT_EQ(lines, "4 4 2 ");
  uint32_t line = 0;
  const nc_source source{};
  EXPECT_EQ(nc_main_line_get(bench.control(), 7, &source, &line), NC_E_ARGUMENT);
  EXPECT_EQ(nc_main_line_get(bench.control(), 0, nullptr, &line), NC_E_ARGUMENT);
  EXPECT_EQ(nc_commit_watch_set(bench.control(), 7, watch, &w), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
