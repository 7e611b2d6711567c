// SPDX-License-Identifier: Apache-2.0
// G06 of the Series 8 cycle by cycle: the loop goes on while its input is on, its speed is a sine, and it ends at its start; hold and reset in it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/drive.hpp"

namespace nc::test {
namespace {

constexpr double kCycle_s = 0.001;

void machine(nc_config& c) {
  c.cycle_s = kCycle_s;
  for (unsigned i = 0; i < 3; ++i) {
    c.system[0].axis[i].rapid = 500;
    c.system[0].axis[i].max_velocity = 500;
    c.system[0].axis[i].max_acceleration = 5000;
  }
}

/// A loop from X10 to X30, twice 20 mm, at F3000: what has been seen of it.
struct Loop {
  Bench bench{NC_DIALECT_SERIES8, machine};
  Drive drive{bench, "F3000\nG00X10\nG06X30\nG00X0Y5\nM30\n"};
  unsigned passes = 0;        ///< times that the far end has been passed
  double fastest = 0, nearest = 1e9, farthest = -1e9;
  bool far = false;

  Loop() { bench.at(0, 0, 0); }
  void step(bool runs) {
    drive.press_start();
    drive.in.input[0] = runs ? 1 : 0;
    drive.step();
    if (drive.out.source.line != 3) return;
    const double x = drive.out.command.v[0];
    fastest = std::fmax(fastest, std::fabs(drive.out.velocity.v[0]));
    nearest = std::fmin(nearest, x);
    farthest = std::fmax(farthest, x);
    if (!far && x > 29) ++passes, far = true;
    if (x < 11) far = false;
  }
};

TEST(SineLoopOnline, GoesOnUntilItsInputIsOff) {
  Loop loop;
  unsigned cycles = 0;
  while (loop.passes < 4 && ++cycles < 20000) loop.step(true);
  ASSERT_EQ(loop.passes, 4u);
  EXPECT_FALSE(loop.drive.ended);
  for (cycles = 0; !loop.drive.ended && cycles < 20000; ++cycles) loop.step(false);
  EXPECT_TRUE(loop.drive.ended);
  EXPECT_LE(loop.passes, 5u);  // the pass under way is made to its end, and one that has been asked for
  EXPECT_NEAR(loop.fastest, 50, 1);  // F in the middle of the way
  EXPECT_NEAR(loop.nearest, 10, 0.01);
  EXPECT_NEAR(loop.farthest, 30, 0.01);
  EXPECT_NEAR(loop.drive.out.command.v[0], 0, 1e-9);
  EXPECT_NEAR(loop.drive.out.command.v[1], 5, 1e-9);
  EXPECT_EQ(loop.drive.alarm(), "");
}

TEST(SineLoopOnline, AnInputThatIsOffMakesOnePass) {
  Loop loop;
  for (unsigned cycles = 0; !loop.drive.ended && cycles < 20000; ++cycles) loop.step(false);
  EXPECT_TRUE(loop.drive.ended);
  EXPECT_EQ(loop.passes, 1u);
}

TEST(SineLoopOnline, AHoldRestsInItAndAStartGoesOn) {
  Loop loop;
  unsigned cycles = 0;
  while (loop.passes < 2 && ++cycles < 20000) loop.step(true);
  loop.drive.in.feed_hold = true;
  for (cycles = 0; cycles < 600; ++cycles) loop.step(true);
  const double held = loop.drive.out.command.v[0];
  EXPECT_EQ(loop.drive.out.state, NC_STATE_HOLD);
  for (cycles = 0; cycles < 200; ++cycles) loop.step(true);
  EXPECT_EQ(loop.drive.out.command.v[0], held);
  loop.drive.in.feed_hold = false;
  loop.drive.in.cycle_start = true;
  loop.drive.step();
  loop.drive.in.cycle_start = false;
  for (cycles = 0; loop.passes < 4 && cycles < 20000; ++cycles) loop.step(true);
  EXPECT_EQ(loop.passes, 4u);
}

TEST(SineLoopOnline, AResetEndsIt) {
  Loop loop;
  unsigned cycles = 0;
  while (loop.passes < 2 && ++cycles < 20000) loop.step(true);
  loop.drive.in.reset = true;
  for (cycles = 0; cycles < 5; ++cycles) loop.step(true);
  loop.drive.in.reset = false;
  for (cycles = 0; cycles < 2000; ++cycles) loop.step(true);
  EXPECT_EQ(loop.drive.out.state, NC_STATE_IDLE);
  const double at = loop.drive.out.command.v[0];
  for (cycles = 0; cycles < 500; ++cycles) loop.step(true);
  EXPECT_EQ(loop.drive.out.command.v[0], at);
  EXPECT_EQ(loop.drive.alarm(), "");
}

}  // namespace
}  // namespace nc::test
