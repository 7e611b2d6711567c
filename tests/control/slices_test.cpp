// SPDX-License-Identifier: Apache-2.0
// The time-optimal mode is planned in slices (nc_feed()). Where they end changes nothing of what is planned: a control that is given one unit
// at a time gives out the same positions, to the last bit, as one that is given as much as it wants.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

std::function<void(nc_config&)> optimal(uint32_t look_ahead) {
  return [look_ahead](nc_config& c) {
    machine(look_ahead)(c);
    c.cycle_s = 0.001;
    c.motion_mode = NC_MOTION_OPTIMAL;
    for (unsigned i = 0; i < 3; ++i) {
      nc_axis_config& axis = c.system[0].axis[i];
      axis.rapid = axis.max_velocity = 250;
      axis.max_acceleration = 2000;
      axis.max_jerk = 50000;
    }
  };
}

/// Lines of all kinds: noisy ones and long ones, gentle and sharp corners, arcs, NURBS, and feeds of all sizes.
std::string lines(uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const double step = std::exp(uniform(std::log(0.02), std::log(5)));
  std::string text = "G90 G54 G0 X0 Y0 Z0\nG1 F" + brief(std::round(uniform(300, 9000))) + "\n";
  double x = 0, y = 0, z = 0, heading = uniform(-3, 3);
  const unsigned count = 30 + random() % 200;
  for (unsigned n = 0; n < count; ++n) {
    heading += random() % 4 == 0 ? uniform(-2.5, 2.5) : uniform(-0.1, 0.1);
    const double length = step * uniform(0.3, 2);
    x += length * std::cos(heading);
    y += length * std::sin(heading);
    z += random() % 3 == 0 ? uniform(-0.005, 0.005) : 0;
    text += "X" + brief(std::round(1e4 * x) / 1e4) + " Y" + brief(std::round(1e4 * y) / 1e4) + " Z" + brief(std::round(1e4 * z) / 1e4);
    if (random() % 20 == 0) text += " F" + brief(std::round(uniform(200, 9000)));
    text += "\n";
    if (random() % 40 == 0) {
      text += "G3 X" + brief(std::round(1e4 * (x + 4)) / 1e4) + " R2.5\nG1\n";
      x = std::round(1e4 * (x + 4)) / 1e4;
    }
    if (random() % 60 == 0) {
      const double end = std::round(1e4 * (x + 6)) / 1e4;
      x = std::round(1e4 * x) / 1e4;
      y = std::round(1e4 * y) / 1e4;
      text += "G5 P10000\nG1 X" + brief(x) + " Y" + brief(y) + "\nG6.2 P4 K0 X" + brief(x) + " Y" + brief(y) + "\nK0 X" + brief(x + 2) + " Y" + brief(y + 3) + "\nK0 X" + brief(x + 4) +
              " Y" + brief(y - 3) + "\nK0 X" + brief(end) + " Y" + brief(y) + "\nK1\nK1\nK1\nK1\nG5 P0\nG1\n";
      x = end;
    }
    if (random() % 100 == 0) text += "G4 P20\n";
  }
  return text + "M30\n";
}

/// One unit after the other until the round is at its end.
unsigned feed(nc_control* control, uint32_t budget) {
  constexpr unsigned kMost = 2000000;
  unsigned calls = 1;
  while (nc_feed(control, budget) == NC_BUDGET && calls < kMost) ++calls;
  EXPECT_LT(calls, kMost);
  return calls;
}

/// The operator holds, turns the override and uses single block.
void disturb(std::mt19937& random, unsigned cycle, nc_inputs& in) {
  in.cycle_start = cycle == 2 || cycle % 50 == 0;
  in.feed_hold = random() % 150 == 0 || (in.feed_hold && random() % 20 != 0);
  if (random() % 200 == 0) in.single_block = random() % 3 == 0;
  if (random() % 100 == 0) in.feed_override = 0.1 + static_cast<double>(random() % 19) / 10;
}

void compare(uint32_t seed, const RandomProgram& program) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Bench slow(NC_DIALECT_M700, optimal(256)), fast(NC_DIALECT_M700, optimal(256));
  set_up(slow, program);
  set_up(fast, program);
  Drive one(slow, program.main), all(fast, program.main);
  std::mt19937 random(seed);
  unsigned calls = 0, rounds = 0;
  for (unsigned n = 0; n < 4000 && !one.ended && one.out.state != NC_STATE_ALARM; ++n) {
    disturb(random, n, one.in);
    all.in.cycle_start = one.in.cycle_start;
    all.in.feed_hold = one.in.feed_hold;
    all.in.single_block = one.in.single_block;
    all.in.feed_override = one.in.feed_override;
    calls += feed(slow.control(), 1);
    rounds += feed(fast.control(), UINT32_MAX);
    one.step(0);
    all.step(0);
    ASSERT_EQ(std::memcmp(&one.out.command, &all.out.command, sizeof one.out.command), 0) << "cycle " << n << " line " << all.out.source.line;
    ASSERT_EQ(one.out.state, all.out.state) << "cycle " << n;
    ASSERT_EQ(one.out.source.line, all.out.source.line) << "cycle " << n;
  }
  EXPECT_GT(calls, rounds + 100);  // there were slices
}

TEST(Slices, ChangeNothingOfWhatIsPlanned) {
  for (uint32_t seed = 1; seed <= seeds(12, 3); ++seed) {
    RandomProgram program;
    program.main = lines(seed);
    ASSERT_NO_FATAL_FAILURE(compare(seed, program));
  }
}

TEST(Slices, ChangeNothingOfProgramsOfAllKinds) {
  for (uint32_t seed = 1; seed <= seeds(12, 3); ++seed) ASSERT_NO_FATAL_FAILURE(compare(seed, ProgramMaker(seed + 9000, false).make()));
}

/// A feeder that gets few slices, beside an operator who holds in ever the same rhythm: what is under way for axes that rest goes on through the holds. It was
/// begun anew with each of them, and where a law took more than the slices between two holds nothing ever moved.
TEST(Slices, HoldsDoNotKeepAProgramFromBeginning) {
  constexpr unsigned kHold = 100;  // cycles that it stays on, and off
  RandomProgram program;
  program.main = lines(3);
  Bench bench(NC_DIALECT_M700, optimal(256));
  set_up(bench, program);
  Drive drive(bench, program.main);
  unsigned moving = 0;
  for (unsigned n = 0; n < 400 * kHold && !drive.ended; ++n) {
    drive.in.cycle_start = n % kHold == 2;
    drive.in.feed_hold = n / kHold % 2 == 1;
    if (n % 8 == 0) nc_feed(bench.control(), 1);
    const nc_axes before = drive.out.command;
    drive.step(0);
    if (std::memcmp(&before, &drive.out.command, sizeof before) != 0) ++moving;
  }
  EXPECT_TRUE(drive.ended) << "moved in " << moving << " cycles";
}

}  // namespace
}  // namespace nc::test
