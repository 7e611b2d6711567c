// SPDX-License-Identifier: Apache-2.0
// A press of cycle start after a cycle whose state allows one (nc_outputs::state is IDLE, STOPPED or HOLD) is never lost: the program begins or
// goes on, or the cause in the status tells why it is refused.
#include <gtest/gtest.h>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

class StartPress : public ::testing::TestWithParam<nc_motion_mode> {
 protected:
  StartPress()
      : bench_(NC_DIALECT_M700,
               [](nc_config& c) {
                 machine(64)(c);
                 c.motion_mode = static_cast<uint8_t>(GetParam());
                 c.cycle_s = 0.001;
                 for (unsigned i = 0; i < 3; ++i) {
                   nc_axis_config& axis = c.system[0].axis[i];
                   axis.max_velocity = axis.rapid = 200;
                   axis.max_acceleration = 1990;
                   axis.max_jerk = 200000;
                 }
               }),
        file_(bench_.add("O1", "G91 G1 X0.5 F6000.\nM0\nX1.\nM30\n")) {
    nc_inputs_init(&in_);
    nc_outputs_init(&out_);
    nc_program_select(control(), 0, file_);
  }

  nc_control* control() { return bench_.control(); }
  void cycle() { nc_cycle(control(), &in_, &out_); }
  void turn() {
    nc_feed(control(), 20);
    in_.fin = out_.strobe != 0;
    cycle();
  }
  void press(bool* button) {
    *button = true;
    cycle();
    *button = false;
  }
  bool comes_to(nc_run_state state) {
    for (unsigned n = 0; n < 1000 && out_.state != state; ++n) turn();
    return out_.state == state;
  }

  Bench bench_;
  unsigned file_;
  nc_inputs in_{};
  nc_outputs out_{};
};

/// A reset ends a jog. The speed of the axis may become 0 in a cycle in which its position does not change any more, so that this cycle shows
/// IDLE while the reset still waits for the rest; how often that happens depends on the rounding of speed and position.
TEST_P(StartPress, BehindAResetThatEndsAJog) {
  for (unsigned attempt = 0; attempt < 400; ++attempt) {
    in_.manual[0].kind = NC_MANUAL_JOG;
    in_.manual[0].velocity = (attempt % 2 != 0 ? -1 : 1) * (20 + 0.37 * attempt);
    for (unsigned n = 0; n < 20 + attempt % 7; ++n) turn();
    in_.manual[0].kind = NC_MANUAL_NONE;
    press(&in_.reset);
    ASSERT_TRUE(comes_to(NC_STATE_IDLE)) << attempt;
    const double from = out_.command.v[0];
    press(&in_.cycle_start);
    ASSERT_TRUE(comes_to(NC_STATE_STOPPED)) << "attempt " << attempt << ": the press is lost";
    EXPECT_NEAR(out_.command.v[0], from + 0.5, 1e-9);
    press(&in_.reset);
    ASSERT_TRUE(comes_to(NC_STATE_IDLE));
  }
}

/// Cycle start after manual motion in a block stop waits for the feeder, and so does a reset after it. Meanwhile the block stop is still shown;
/// a start would go on with the program that the reset gives up, so it is refused, and the cause says so.
TEST_P(StartPress, IsRefusedWhileAResetWaitsForTheFeeder) {
  turn();
  press(&in_.cycle_start);
  ASSERT_TRUE(comes_to(NC_STATE_STOPPED));
  in_.manual[0].kind = NC_MANUAL_JOG;
  in_.manual[0].velocity = 10;
  for (unsigned n = 0; n < 20; ++n) turn();
  in_.manual[0].kind = NC_MANUAL_NONE;
  ASSERT_TRUE(comes_to(NC_STATE_STOPPED));
  press(&in_.cycle_start);
  cycle();
  press(&in_.reset);
  cycle();
  ASSERT_EQ(out_.state, NC_STATE_STOPPED);
  EXPECT_EQ(out_.cause, NC_CAUSE_RESET);
  const double from = out_.command.v[0];
  press(&in_.cycle_start);
  EXPECT_EQ(out_.cause, NC_CAUSE_RESET);
  for (unsigned n = 0; n < 300; ++n) turn();
  EXPECT_EQ(out_.state, NC_STATE_IDLE);
  EXPECT_EQ(out_.cause, NC_CAUSE_NONE);
  EXPECT_EQ(out_.command.v[0], from);
}

/// The same while the axes brake.
TEST_P(StartPress, IsRefusedWhileAResetBrakes) {
  turn();
  press(&in_.cycle_start);
  for (unsigned n = 0; n < 500 && out_.velocity.v[0] < 20; ++n) turn();
  ASSERT_GE(out_.velocity.v[0], 20);
  press(&in_.feed_hold);
  press(&in_.reset);
  ASSERT_EQ(out_.state, NC_STATE_HOLD);
  EXPECT_EQ(out_.cause, NC_CAUSE_RESET);
  press(&in_.cycle_start);
  ASSERT_TRUE(comes_to(NC_STATE_IDLE));
  const double at = out_.command.v[0];
  for (unsigned n = 0; n < 300; ++n) turn();
  EXPECT_EQ(out_.state, NC_STATE_IDLE);
  EXPECT_EQ(out_.command.v[0], at);
}

/// A reset or an alarm that follows a press takes it back.
TEST_P(StartPress, IsTakenBack) {
  for (bool nc_inputs::*const button : {&nc_inputs::reset, &nc_inputs::alarm}) {
    turn();
    press(&in_.cycle_start);
    ASSERT_TRUE(comes_to(NC_STATE_STOPPED));
    press(&in_.reset);  // the feeder has not seen the reset when the next press comes, so the press waits
    ASSERT_EQ(out_.state, NC_STATE_IDLE);
    press(&in_.cycle_start);
    press(&(in_.*button));
    press(&in_.reset);
    const double from = out_.command.v[0];
    for (unsigned n = 0; n < 300; ++n) turn();
    EXPECT_EQ(out_.state, NC_STATE_IDLE);
    EXPECT_EQ(out_.command.v[0], from);
  }
}

/// While feed hold is on a start is refused, and the cause says so.
TEST_P(StartPress, IsRefusedByFeedHold) {
  turn();
  in_.feed_hold = true;
  cycle();
  EXPECT_EQ(out_.cause, NC_CAUSE_NONE) << "nothing has been refused yet";
  press(&in_.cycle_start);
  for (unsigned n = 0; n < 20; ++n) turn();
  EXPECT_EQ(out_.state, NC_STATE_IDLE);
  EXPECT_EQ(out_.cause, NC_CAUSE_FEED_HOLD);
  in_.feed_hold = false;
  for (unsigned n = 0; n < 20; ++n) turn();
  EXPECT_EQ(out_.state, NC_STATE_IDLE);
  EXPECT_EQ(out_.cause, NC_CAUSE_NONE);

  press(&in_.cycle_start);
  ASSERT_TRUE(comes_to(NC_STATE_STOPPED));
  in_.feed_hold = true;
  press(&in_.cycle_start);
  for (unsigned n = 0; n < 20; ++n) turn();
  EXPECT_EQ(out_.state, NC_STATE_STOPPED);
  EXPECT_EQ(out_.cause, NC_CAUSE_FEED_HOLD);
  in_.feed_hold = false;
  turn();
  EXPECT_EQ(out_.cause, NC_CAUSE_PROGRAM_STOP);
}

/// A start waits until the feeder has seen the end or the reset before it: a feed hold of one cycle takes it back.
TEST_P(StartPress, ThatWaitsIsTakenBackByFeedHold) {
  for (unsigned between = 0; between < 4; ++between) {
    press(&in_.cycle_start);
    for (unsigned n = 0; n < 10; ++n) turn();
    ASSERT_TRUE(out_.state == NC_STATE_RUNNING || out_.state == NC_STATE_STOPPED);
    press(&in_.reset);
    for (unsigned n = 0; n < 300 && out_.state != NC_STATE_IDLE; ++n) cycle();  // the feeder is not called
    press(&in_.cycle_start);
    for (unsigned n = 0; n < between; ++n) cycle();
    ASSERT_EQ(out_.state, NC_STATE_IDLE);
    press(&in_.feed_hold);
    EXPECT_EQ(out_.cause, NC_CAUSE_FEED_HOLD);
    const double from = out_.command.v[0];
    for (unsigned n = 0; n < 300; ++n) turn();
    EXPECT_EQ(out_.state, NC_STATE_IDLE) << between;
    EXPECT_EQ(out_.command.v[0], from);
    ASSERT_EQ(nc_program_select(control(), 0, file_), NC_OK);
    turn();
  }
  press(&in_.cycle_start);
  EXPECT_TRUE(comes_to(NC_STATE_STOPPED)) << "the next press begins";
}

INSTANTIATE_TEST_SUITE_P(Both, StartPress, ::testing::Values(NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL),
                         [](const auto& mode) { return mode.param == NC_MOTION_OPTIMAL ? "Optimal" : "Trapezoid"; });

}  // namespace
}  // namespace nc::test
