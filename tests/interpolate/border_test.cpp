// SPDX-License-Identifier: Apache-2.0
// Inputs that are NaN, infinite or impossible: the set-points stay finite and within the limits, the input is reported, and the machine goes on
// when it is good again.
#include <gtest/gtest.h>

#include <limits>

#include "test_machine.hpp"

namespace nc::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
constexpr double kBad[] = {kNan, -kNan, kInfinite, -kInfinite, 1e300, -1e300, 1e18, -5};
constexpr double kTiny[] = {4.9e-324, 1e-310, 1e-300, 1e-30, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 9.9e-5, -1e-310, -0.0};

class Border : public ::testing::TestWithParam<bool> {
 protected:
  Border() : config(standard_config()) {
    config.optimal = GetParam();
    for (unsigned i = 0; i < 3; ++i) config.limits[i].jerk = GetParam() ? 50000 : 0;
    config.soft_limited = 7;
    for (unsigned i = 0; i < 3; ++i) config.soft_min[i] = -500, config.soft_max[i] = 500;
  }
  /// Runs so many cycles, and expects that every set-point is finite and no axis faster than its limit.
  void turn(Machine& m, const Program& p, unsigned cycles) {
    for (unsigned n = 0; n < cycles; ++n) {
      const AxisVec before = m.command();
      m.feed(p, 20);
      m.cycle();
      for (unsigned i = 0; i < 3; ++i) {
        ASSERT_TRUE(std::isfinite(m.out.command.v[i]) && std::isfinite(m.out.velocity.v[i])) << "axis " << i;
        ASSERT_LE(std::fabs(m.out.command.v[i] - before[i]), 250 * config.cycle_s * 1.001) << "axis " << i;
      }
      ASSERT_TRUE(std::isfinite(m.out.feed_mm_min) && std::isfinite(m.out.path_length));
    }
  }
  ExecutorConfig config;
};

Program lines(const ExecutorConfig& c, double per_revolution = 0) {
  Program p(c);
  for (unsigned n = 1; n <= 6; ++n) {
    AxisVec to{};
    to[0] = 4.0 * n;
    to[1] = n % 2;
    Segment& s = p.line(to, per_revolution > 0 ? 0 : 40);
    s.feed_mm_rev = per_revolution;
    p.mark();
  }
  p.end();
  return p;
}

struct Field {
  const char* name;
  void (*set)(nc_inputs&, double);
  double good;
  bool per_revolution;
  bool is_signed;  // negative values are allowed
  uint32_t says;
};

const Field kFields[] = {
    {"feed_override", [](nc_inputs& in, double v) { in.feed_override = v; }, 1, false, false, NC_INPUT_FEED_OVERRIDE},
    {"rapid_override", [](nc_inputs& in, double v) { in.rapid_override = v; }, 1, false, false, NC_INPUT_RAPID_OVERRIDE},
    {"rev_per_s", [](nc_inputs& in, double v) { in.spindle[0].rev_per_s = v; }, 10, true, true, NC_INPUT_SPINDLE},
    {"turns", [](nc_inputs& in, double v) { in.spindle[0].turns = v; }, 0, true, true, NC_INPUT_SPINDLE},
    {"spindle_age_s", [](nc_inputs& in, double v) { in.spindle_age_s[0] = v; }, 0, true, false, NC_INPUT_SPINDLE},
    {"actual", [](nc_inputs& in, double v) { in.actual.v[1] = v; }, 0, false, true, NC_INPUT_ACTUAL},
    {"skip_place", [](nc_inputs& in, double v) { in.skip_latched = 1, in.skip_place.v[2] = v; }, 0, false, true, NC_INPUT_SKIP_PLACE},
    {"velocity", [](nc_inputs& in, double v) { in.manual[0].velocity = v; }, 0, false, true, NC_INPUT_MANUAL},
    {"distance", [](nc_inputs& in, double v) { in.manual[0].distance = v; }, 0, false, true, NC_INPUT_MANUAL},
};

/// A bad input during a program, for one cycle and for many.
TEST_P(Border, DuringAProgram) {
  for (const Field& field : kFields) {
    for (const double bad : kBad) {
      const bool allowed = bad == -5 && field.is_signed;
      for (const unsigned cycles : {1u, 100u}) {
        SCOPED_TRACE(std::string(field.name) + " = " + std::to_string(bad) + " for " + std::to_string(cycles));
        Machine m(config);
        const Program p = lines(config, field.per_revolution ? 4 : 0);
        m.in.spindle[0].rev_per_s = 10;
        m.in.spindle[0].turns_valid = m.in.actual_valid = true;
        m.feed(p);
        m.start();
        ASSERT_NO_FATAL_FAILURE(turn(m, p, 150));
        m.in.manual[0].kind = field.says == NC_INPUT_MANUAL ? NC_MANUAL_JOG : NC_MANUAL_NONE;
        field.set(m.in, bad);
        ASSERT_NO_FATAL_FAILURE(turn(m, p, cycles));
        EXPECT_EQ(m.out.inputs_refused, allowed ? 0u : field.says);
        m.in.manual[0] = {};
        field.set(m.in, field.good);
        ASSERT_NO_FATAL_FAILURE(turn(m, p, 1));
        EXPECT_EQ(m.out.inputs_refused, 0u);
        ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }, 20000)) << "cause " << unsigned{m.out.cause};
        EXPECT_NEAR(m.out.command.v[0], 24, 1e-9);
        EXPECT_TRUE(m.checker.ok()) << m.checker.report();
      }
    }
  }
}

/// A step with almost no speed must not keep the machine in manual mode for ever.
TEST_P(Border, AStepThatWouldNeverArrive) {
  for (const double slow : kTiny) {
    if (slow > 1e-6 || slow == 0) continue;
    SCOPED_TRACE(slow);
    Machine m(config);
    m.in.manual[0] = {NC_MANUAL_STEP, slow, 3};
    m.cycle();
    EXPECT_EQ(m.out.inputs_refused, uint32_t{NC_INPUT_MANUAL});
    m.in.manual[0] = {};
    m.cycle();
    EXPECT_EQ(m.out.state, NC_STATE_IDLE);
    EXPECT_EQ(m.out.inputs_refused, 0u);
  }
}

/// The speed of a spindle is infinite for one cycle while a feed per revolution is read ahead.
TEST_P(Border, AnInfiniteSpindleDoesNotMakeTheFeed) {
  Machine m(config);
  const Program p = lines(config, 0.5);
  m.in.spindle[0].rev_per_s = 10;
  m.in.feed_hold = true;
  m.feed(p);
  for (unsigned n = 0; n < 5; ++n) m.cycle();
  m.in.feed_hold = false;
  m.in.spindle[0].rev_per_s = kInfinite;
  m.start();
  m.in.spindle[0].rev_per_s = 10;
  double fastest = 0;
  ASSERT_TRUE(m.until(p, [&] {
    fastest = std::max(fastest, m.out.feed_mm_min / 60);
    return m.out.state == NC_STATE_IDLE;
  }));
  EXPECT_NEAR(fastest, 5, 0.01);
}

/// An override that is almost 0 counts as 0, and the program goes on with the next one.
TEST_P(Border, OverridesThatAreAllButNothing) {
  for (const double tiny : kTiny) {
    for (const bool rapid : {false, true}) {
      SCOPED_TRACE(std::to_string(std::log10(std::fabs(tiny))) + (rapid ? " rapid" : ""));
      Machine m(config);
      Program p(config);
      rapid ? p.rapid({{50}}) : p.line({{50}}, 40);
      p.mark();
      p.end();
      m.feed(p);
      m.start();
      ASSERT_NO_FATAL_FAILURE(turn(m, p, 100));
      (rapid ? m.in.rapid_override : m.in.feed_override) = tiny;
      ASSERT_NO_FATAL_FAILURE(turn(m, p, 2000));
      EXPECT_EQ(m.out.cause, NC_CAUSE_OVERRIDE_ZERO);
      EXPECT_TRUE(m.still());
      EXPECT_EQ(m.out.inputs_refused, 0u);
      m.in.feed_override = m.in.rapid_override = 1;
      ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }, 20000)) << "cause " << unsigned{m.out.cause};
      EXPECT_NEAR(m.out.command.v[0], 50, 1e-9);
      EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    }
  }
}

/// A spindle whose encoder trembles counts as standing, and the feed goes on when it turns again.
TEST_P(Border, ASpindleThatAllButStands) {
  for (const double tiny : kTiny) {
    if (std::fabs(tiny) >= 1e-5) continue;
    SCOPED_TRACE(tiny);
    Machine m(config);
    const Program p = lines(config, 4);
    m.in.spindle[0].rev_per_s = 10;
    m.feed(p);
    m.start();
    ASSERT_NO_FATAL_FAILURE(turn(m, p, 100));
    m.in.spindle[0].rev_per_s = tiny;
    ASSERT_NO_FATAL_FAILURE(turn(m, p, 2000));
    EXPECT_EQ(m.out.cause, NC_CAUSE_SPINDLE_STOPPED);
    EXPECT_TRUE(m.still());
    m.in.spindle[0].rev_per_s = 10;
    ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }, 20000)) << "cause " << unsigned{m.out.cause};
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  }
}

/// The least override that acts: the program creeps, and goes on.
TEST_P(Border, TheLeastOverrideActs) {
  for (const double feed : {1e-3, 0.1, 40.0, 200.0}) {
    SCOPED_TRACE(feed);
    Machine m(config);
    Program p(config);
    p.line({{5}}, feed);
    p.mark();
    p.end();
    m.in.feed_override = 1e-4;
    m.feed(p);
    m.start();
    ASSERT_NO_FATAL_FAILURE(turn(m, p, 4000));
    EXPECT_NEAR(m.out.command.v[0], feed * 1e-4 * 4, feed * 1e-4 * 0.5);
    m.in.feed_override = 1;
    ASSERT_NO_FATAL_FAILURE(turn(m, p, 4000));
    EXPECT_GT(m.out.command.v[0], std::min(4.9, feed * 2));
  }
}

/// Distances and speeds of motion by hand that are no numbers.
TEST_P(Border, ByHand) {
  for (const uint8_t kind : {uint8_t{NC_MANUAL_JOG}, uint8_t{NC_MANUAL_STEP}, uint8_t{NC_MANUAL_HANDLE}, uint8_t{NC_MANUAL_REFERENCE}, uint8_t{77}}) {
    for (const double bad : kBad) {
      for (const bool velocity : {false, true}) {
        SCOPED_TRACE("kind " + std::to_string(kind) + (velocity ? " velocity " : " distance ") + std::to_string(bad));
        const Program none(config);
        Machine m(config);
        m.in.manual[1] = {kind, 20, 0.5};
        (velocity ? m.in.manual[1].velocity : m.in.manual[1].distance) = bad;
        ASSERT_NO_FATAL_FAILURE(turn(m, none, 300));
        EXPECT_LE(std::fabs(m.out.command.v[1]), 500.0);
        if (bad != -5) {
          EXPECT_EQ(m.out.inputs_refused, NC_INPUT_MANUAL);
          EXPECT_EQ(m.out.command.v[1], 0);
        }
        m.in.manual[1] = {};
        ASSERT_NO_FATAL_FAILURE(turn(m, none, 600));
        const double from = m.out.command.v[1];
        m.in.manual[1] = {NC_MANUAL_STEP, 0, 0.25};
        ASSERT_NO_FATAL_FAILURE(turn(m, none, 300));
        EXPECT_NEAR(m.out.command.v[1], from + 0.25, 1e-9);
      }
    }
  }
}

/// While the drives are off the command follows the axes, but not to a position that is no number.
TEST_P(Border, FollowUp) {
  for (const double bad : kBad) {
    if (bad == -5) continue;
    SCOPED_TRACE(bad);
    const Program none(config);
    Machine m(config);
    m.in.actual_valid = m.in.follow_up = true;
    m.in.actual.v[0] = 0.1;
    ASSERT_NO_FATAL_FAILURE(turn(m, none, 5));
    EXPECT_EQ(m.out.command.v[0], 0.1);
    m.in.actual.v[0] = bad;
    ASSERT_NO_FATAL_FAILURE(turn(m, none, 5));
    EXPECT_EQ(m.out.command.v[0], 0.1);
    EXPECT_EQ(m.out.inputs_refused, NC_INPUT_ACTUAL);
    m.in.actual.v[0] = 0.2;
    ASSERT_NO_FATAL_FAILURE(turn(m, none, 5));
    EXPECT_EQ(m.out.command.v[0], 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Border, ::testing::Bool(), [](const auto& mode) { return mode.param ? "Optimal" : "Trapezoid"; });

}  // namespace
}  // namespace nc::test
