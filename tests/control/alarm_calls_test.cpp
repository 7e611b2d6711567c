// SPDX-License-Identifier: Apache-2.0
// An alarm of the machine (a servo, a door, the ladder) stops a program: which programs have called the block in execution? The reader is far
// ahead of that block.
#include <gtest/gtest.h>

#include "online_helpers.hpp"
#include "support/drive.hpp"

namespace nc::test {
namespace {

/// Each move goes 1 mm, so that the position of X tells which one is in execution.
const std::vector<std::string> kMain = {"G91 G1 F1500", "M98 P1", "X1.", "M98 P1 L2", "G65 P2", "X1.", "M98 P3", "X1.", "M30"};
const std::vector<std::vector<std::string>> kSubs = {{"X1.", "M98 P3", "X1.", "M99"}, {"M98 P3", "X1.", "M98 P1", "M99"}, {"X1.", "X1. M99"}};

/// The callers of each move as the texts give them, for example "4 > O1:2 > O3:1".
void expand(const std::vector<std::string>& program, const std::string& callers, const std::string& name, std::vector<std::string>* moves) {
  for (size_t line = 0; line < program.size(); ++line) {
    const std::string &text = program[line], here = callers + name + std::to_string(line + 1);
    if (text[0] == 'X') moves->push_back(here);
    const size_t called = text.find('P');
    if (called == std::string::npos) continue;
    const unsigned number = static_cast<unsigned>(text[called + 1] - '0');
    for (unsigned pass = text.find("L2") == std::string::npos ? 1 : 2; pass > 0; --pass)
      expand(kSubs[number - 1], here + " > ", "O" + std::to_string(number) + ":", moves);
  }
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string calls(Bench& bench) {
  nc_source all[NC_MAX_CALLS];
  const unsigned count = nc_alarm_calls_get(bench.control(), 0, all, NC_MAX_CALLS);
  std::string text;
  for (unsigned i = 0; i < count; ++i) {
    EXPECT_EQ(all[i].depth, i);
    text += (i == 0 ? "" : " > ") + (all[i].program == 0 ? std::string() : "O" + std::to_string(all[i].program) + ":") + std::to_string(all[i].line);
  }
  return text;
}

struct Calls : testing::TestWithParam<nc_motion_mode> {
  Calls()
      : bench(NC_DIALECT_M700, [](nc_config& c) {
          machine(64)(c);
          c.motion_mode = static_cast<uint8_t>(GetParam());
          for (unsigned i = 0; i < 3; ++i) {
            c.system[0].axis[i].max_acceleration = 5000;
            c.system[0].axis[i].max_jerk = 500000;
          }
        }) {
    for (size_t i = 0; i < kSubs.size(); ++i) bench.add("O" + std::to_string(i + 1), joined(kSubs[i]));
    expand(kMain, "", "", &moves);
  }
  /// Runs the program until X is at `x`, or to the block stop there.
  void go_to(Drive& drive, double x, bool block_stop) {
    drive.in.single_block = block_stop;
    for (unsigned n = 0; n < 20000 && (drive.out.command.v[0] < x - 1e-9 || (block_stop && drive.out.state != NC_STATE_STOPPED)); ++n) {
      drive.in.cycle_start = n == 2 || (block_stop && n % 2 == 0 && drive.out.state == NC_STATE_STOPPED);
      drive.step();
    }
    drive.in.cycle_start = false;
  }
  Bench bench;
  std::vector<std::string> moves;
};

TEST_P(Calls, OfTheBlockThatAnAlarmOfTheMachineStops) {
  ASSERT_EQ(moves.size(), 24u);
  for (const bool block_stop : {false, true}) {
    for (size_t k = 0; k < moves.size(); ++k) {
      SCOPED_TRACE((block_stop ? "block stop behind move " : "move ") + std::to_string(k));
      Drive drive(bench, joined(kMain));
      go_to(drive, static_cast<double>(k) + (block_stop ? 1 : 0.4), block_stop);
      ASSERT_EQ(drive.out.state, block_stop ? NC_STATE_STOPPED : NC_STATE_RUNNING);
      EXPECT_EQ(calls(bench), "");
      drive.in.alarm = true;
      drive.step(0);
      ASSERT_EQ(drive.out.state, NC_STATE_ALARM);
      EXPECT_EQ(calls(bench), moves[k]) << "at once";
      for (unsigned n = 0; n < 200; ++n) drive.step(n % 3 == 0 ? 50 : 0);
      EXPECT_EQ(calls(bench), moves[k]) << "and when the feeder has given up what it had read";
      drive.in.alarm = false;
      drive.in.reset = true;
      drive.step();
      drive.in.reset = false;
      for (unsigned n = 0; n < 10; ++n) drive.step();
      ASSERT_EQ(drive.out.state, NC_STATE_IDLE);
      EXPECT_EQ(calls(bench), "");
      nc_axes zero{};
      ASSERT_EQ(nc_position_set(bench.control(), 0, &zero), NC_OK);
    }
  }
}

/// Without a program in execution an alarm of the machine has no block, whatever was executed before.
TEST_P(Calls, OfNoProgram) {
  Drive drive(bench, joined(kMain));
  const auto alarm = [&](unsigned cycles) {
    drive.in.alarm = true;
    for (unsigned n = 0; n < cycles; ++n) drive.step();
    drive.in.alarm = false;
    EXPECT_EQ(drive.out.state, NC_STATE_ALARM);
    EXPECT_EQ(calls(bench), "");
    drive.in.reset = true;
    for (unsigned n = 0; n < 5; ++n) drive.step();
    drive.in.reset = false;
    for (unsigned n = 0; n < 5; ++n) drive.step();
  };
  drive.step();
  alarm(5);
  drive.in.cycle_start = true;
  drive.step();
  drive.in.cycle_start = false;
  for (unsigned n = 0; n < 30000 && !drive.ended; ++n) drive.step();
  ASSERT_TRUE(drive.ended);
  for (unsigned n = 0; n < 5; ++n) drive.step();
  alarm(5);
  drive.in.cycle_start = true;  // in the cycle of a start no block of the program has been executed yet
  drive.in.alarm = true;
  drive.step(0);
  drive.in.cycle_start = false;
  alarm(5);
}

INSTANTIATE_TEST_SUITE_P(Both, Calls, testing::Values(NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL));

}  // namespace
}  // namespace nc::test
