// SPDX-License-Identifier: Apache-2.0
// Dry run in both modes of motion: which moves it concerns, when it is taken over, and that it changes the feed within the limits of the axes.
#include <gtest/gtest.h>

#include <limits>

#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

AxisVec dry_place(double x, double z = 0) {
  AxisVec a;
  a[0] = x;
  a[2] = z;
  return a;
}

class DryRun : public testing::TestWithParam<bool> {
 protected:
  DryRun() : config(standard_config()), program(config), dry{&program} {
    config.optimal = GetParam();
    if (GetParam())
      for (unsigned i = 0; i < 3; ++i) config.limits[i] = {250, 250, 2000, 50000, 0.01};
    program = Program(config);
  }
  struct Adds {
    Program* p;
    Segment& operator()(const AxisVec& end, double feed) const {
      Segment& s = p->line(end, feed);
      s.dry = true;
      return s;
    }
  };
  void run() {
    machine = std::make_unique<Machine>(config);
    machine->in.manual_feed = 40;
    machine->in.spindle[0].turns_valid = true;
    machine->feed(program);
    machine->start();
  }
  double after(unsigned cycles) {
    for (unsigned n = 0; n < cycles; ++n) {
      machine->in.spindle[0].turns += machine->in.spindle[0].rev_per_s * config.cycle_s;
      machine->feed(program);
      machine->cycle();
    }
    return machine->out.feed_mm_min / 60;
  }
  /// Runs with the spindle turning until the axis has passed this place in -.
  bool below(double z) {
    for (unsigned n = 0; n < 200000; ++n) {
      if (machine->out.command.v[2] < z) return true;
      (void)after(1);
    }
    return false;
  }
  void ends_well() {
    EXPECT_TRUE(machine->checker.ok()) << machine->checker.report();
  }
  ExecutorConfig config;
  Program program;
  Adds dry;
  std::unique_ptr<Machine> machine;
};

TEST_P(DryRun, ReplacesTheFeedOfACutOnTheWay) {
  dry(dry_place(300), 10);
  program.end();
  run();
  EXPECT_NEAR(after(400), 10, 1e-6);
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 40, 1e-6);
  machine->in.manual_feed = 100;
  EXPECT_NEAR(after(400), 100, 1e-6);
  machine->in.feed_override = 0.25;
  EXPECT_NEAR(after(400), 25, 1e-6);
  machine->in.manual_rapid = true;
  EXPECT_NEAR(after(400), GetParam() ? 250 : 200, 1e-3) << "the most that the axis may cut with";
  machine->in.feed_override = 0;
  EXPECT_NEAR(after(400), 0, 1e-6);
  EXPECT_EQ(machine->out.cause, NC_CAUSE_OVERRIDE_ZERO);
  machine->in.feed_override = 1;
  machine->in.manual_rapid = false;
  machine->in.manual_feed = 0;
  EXPECT_NEAR(after(400), 0, 1e-6);
  EXPECT_EQ(machine->out.cause, NC_CAUSE_MANUAL_FEED_ZERO);
  machine->in.dry_run = false;
  EXPECT_NEAR(after(400), 10, 1e-6);
  ends_well();
}

TEST_P(DryRun, DoesNotConcernWhatTheManualExcepts) {
  Segment& skip = program.line(dry_place(20), 10);  // M700 15.2
  skip.skip = true;
  skip.skip_mask = 1;
  skip.start_feed_mm_s = 10;
  program.line(dry_place(40), 10).fixed_override = true;  // M700 7.11, 13.1.1
  program.rapid(dry_place(140));
  program.end();
  run();
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 10, 1e-6);
  ASSERT_TRUE(machine->until(program, [&] { return machine->out.command.v[0] > 25; }));
  EXPECT_NEAR(machine->out.feed_mm_min / 60, 10, 1e-6);
  double fastest = 0;
  ASSERT_TRUE(machine->until(program, [&] {
    fastest = std::max(fastest, machine->out.feed_mm_min / 60);
    return machine->out.state == NC_STATE_IDLE;
  }));
  EXPECT_GT(fastest, 200);
  ends_well();
}

TEST_P(DryRun, OfRapidTraverse) {  // M700 13.1.1, #1085
  for (const bool rapid : {false, true}) {
    program = Program(config);
    program.rapid(dry_place(100)).dry = true;
    program.end();
    run();
    machine->in.dry_run = true;
    machine->in.manual_rapid = rapid;
    machine->in.feed_override = 0.5;
    double fastest = 0;
    ASSERT_TRUE(machine->until(program, [&] {
      fastest = std::max(fastest, machine->out.feed_mm_min / 60);
      return machine->out.state == NC_STATE_IDLE && machine->cycles > 100;
    }));
    if (rapid) EXPECT_GT(fastest, 200);
    else EXPECT_NEAR(fastest, 20, 1e-6);
    ends_well();
  }
}

TEST_P(DryRun, OfAFeedByRevolutionNeedsNoSpindle) {  // M700 7.4 note 4
  dry(dry_place(100), 0).feed_mm_rev = 0.1;
  program.end();
  run();
  EXPECT_EQ(after(200), 0);
  EXPECT_EQ(machine->out.cause, NC_CAUSE_SPINDLE_STOPPED);
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 40, 1e-6);
  machine->in.dry_run = false;
  EXPECT_NEAR(after(400), 0, 1e-6);
  ends_well();
}

TEST_P(DryRun, OfAThreadCountsWhereItBegins) {  // M700 6.7.1 (12)
  for (const bool begins_dry : {true, false}) {
    SCOPED_TRACE(begins_dry);
    program = Program(config);
    for (int n = 1; n <= 2; ++n) {
      Segment& s = dry(dry_place(0, -20 * n), 0);
      s.thread = true;
      s.feed_mm_rev = 2;
      program.mark();
    }
    dry(dry_place(0, -80), 10);
    program.end();
    run();
    machine->in.dry_run = begins_dry;
    machine->in.spindle[0].rev_per_s = begins_dry ? 0 : 8;
    const double feed = begins_dry ? 40 : 16;
    ASSERT_TRUE(below(-5));
    EXPECT_NEAR(machine->out.feed_mm_min / 60, feed, 0.05);
    machine->in.dry_run = !begins_dry;
    for (const double z : {-10.0, -19.0, -25.0, -37.0}) {
      ASSERT_TRUE(below(z));
      EXPECT_NEAR(machine->out.feed_mm_min / 60, feed, 0.05) << z;
    }
    ASSERT_TRUE(below(-55));
    EXPECT_NEAR(machine->out.feed_mm_min / 60, begins_dry ? 10 : 40, 1e-6) << "behind it the switch counts again";
    ends_well();
  }
}

TEST_P(DryRun, AnInterlockStopsAThreadInDryRun) {
  Segment& s = dry(dry_place(0, -60), 0);
  s.thread = true;
  s.feed_mm_rev = 2;
  program.end();
  run();
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 40, 1e-6);
  machine->in.interlock = true;
  EXPECT_EQ(after(200), 0);
  machine->in.dry_run = false;
  machine->in.interlock = false;
  EXPECT_NEAR(after(400), 40, 1e-6) << "it ends as it has begun";
  ends_well();
}

/// The switch that goes off in a thread does not end its dry run, and does not keep the feed that it had then either: a thread that stood at a manual feed of 0
/// would stand for ever.
TEST_P(DryRun, AThreadInDryRunGoesByTheManualFeedUntilItsEnd) {
  Segment& s = dry(dry_place(0, -60), 0);
  s.thread = true;
  s.feed_mm_rev = 2;
  program.end();
  run();
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 40, 1e-6);
  machine->in.manual_feed = 0;
  EXPECT_EQ(after(200), 0);
  machine->in.dry_run = false;
  EXPECT_EQ(after(200), 0);
  EXPECT_EQ(machine->out.cause, NC_CAUSE_MANUAL_FEED_ZERO);
  machine->in.manual_feed = 20;
  EXPECT_NEAR(after(200), 20, 1e-6);
  machine->in.feed_override = 0;
  EXPECT_EQ(after(200), 0);
  machine->in.feed_override = 1;
  ends_well();
}

TEST_P(DryRun, TheHandleAndTheCornerOverrideDoNotAct) {  // M700 7.3 (5), 7.10
  Segment& digit = dry(dry_place(50), 20);
  digit.feed_digit = 2;
  digit.digit_most_mm_s = 50;
  digit.digit_step_mm_s = 0.5F;
  program.mark();
  Segment& corner = dry(dry_place(100), 20);
  corner.slow_zone = 40;
  corner.slow_factor = 0.5F;
  program.mark();
  program.end();
  run();
  machine->in.dry_run = true;
  machine->in.manual_feed = 30;
  (void)after(200);
  machine->in.feed_pulses = 40;
  (void)after(3);
  machine->in.feed_pulses = 0;
  machine->in.dry_run = false;
  EXPECT_NEAR(after(200), 20, 1e-6) << "the pulses of the handle are lost";
  machine->in.dry_run = true;
  ASSERT_TRUE(machine->until(program, [&] { return machine->out.command.v[0] > 80; }));
  EXPECT_NEAR(machine->out.feed_mm_min / 60, 30, 1e-6);
  ends_well();
}

// An arc whose feed is slow has most of the acceleration of its axes for its ends. In dry run it may go no faster than leaves that.
TEST_P(DryRun, OfASlowArcKeepsTheLimits) {
  for (const bool from_the_start : {false, true}) {
    program = Program(config, dry_place(0));
    for (int n = 0; n < 8; ++n) program.arc(0, 1, 4, n % 2 == 0 ? 3.0 : 0.0, n % 2 == 0 ? -2.5 : 2.5, 2).dry = true;
    program.end();
    machine = std::make_unique<Machine>(config);
    machine->in.manual_feed = 1000;
    machine->in.dry_run = from_the_start;
    machine->cycle();
    machine->feed(Program(config));  // the planner has heard of it
    machine->feed(program);
    machine->start();
    double fastest = 0;
    for (unsigned n = 0; n < 4000 && machine->out.state != NC_STATE_IDLE; ++n) {
      if (!from_the_start && n % 97 == 96) machine->in.dry_run = !machine->in.dry_run;
      machine->feed(program);
      machine->cycle();
      fastest = std::max(fastest, machine->out.feed_mm_min / 60);
    }
    EXPECT_GT(fastest, from_the_start || GetParam() ? 40 : 3.9);
    ends_well();
  }
}

TEST_P(DryRun, AManualFeedThatIsNoNumberIsRefused) {
  dry(dry_place(300), 10);
  program.end();
  run();
  machine->in.dry_run = true;
  EXPECT_NEAR(after(400), 40, 1e-6);
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), -1.0, 1e300}) {
    machine->in.manual_feed = wrong;
    EXPECT_NEAR(after(200), 40, 1e-6);
    EXPECT_EQ(machine->out.inputs_refused, static_cast<uint32_t>(NC_INPUT_MANUAL_FEED));
  }
  machine->in.dry_run = false;  // it is not read then
  (void)after(1);
  EXPECT_EQ(machine->out.inputs_refused, 0u);
  ends_well();
}

INSTANTIATE_TEST_SUITE_P(Modes, DryRun, testing::Bool(), [](const auto& mode) { return mode.param ? "Optimal" : "Trapezoid"; });

}  // namespace
}  // namespace nc::test
