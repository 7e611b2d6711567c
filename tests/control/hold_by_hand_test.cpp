// SPDX-License-Identifier: Apache-2.0
// Axes are moved by hand in a feed hold amid a block, and come back to where the path has stopped: from there the program goes on as if nobody had moved them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/drive.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kCycle = 0.001, kVelocity = 100, kAcceleration = 2000, kSoft = 120;
constexpr unsigned kAxes = 3, kLongest = 60000;

std::function<void(nc_config&)> limits(bool optimal) {
  return [optimal](nc_config& c) {
    axes("XYZ")(c);
    c.cycle_s = kCycle;
    c.motion_mode = optimal ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
    for (unsigned i = 0; i < kAxes; ++i) {
      nc_axis_config& axis = c.system[0].axis[i];
      axis.rapid = axis.max_velocity = kVelocity;
      axis.max_acceleration = kAcceleration;
      axis.max_jerk = optimal ? 40000 : 0;
      axis.soft_limited = true;
      axis.soft_min = -kSoft;
      axis.soft_max = kSoft;
      axis.reference[0] = 5.0 * i;
    }
  };
}

/// A program on its machine, whose axes are measured in every cycle.
class HeldMachine {
 public:
  using Parameters = std::vector<std::pair<const char*, const char*>>;
  HeldMachine(bool optimal, const std::string& text, const Parameters& parameters = {})
      : bench(NC_DIALECT_M700, limits(optimal)), drive(prepared(bench, parameters), text) {}

  void step(unsigned cycles = 1) {
    for (; cycles > 0; --cycles) {
      drive.step();
      for (unsigned i = 0; i < kAxes; ++i) {
        const double v = (at(i) - before_[i]) / kCycle, a = (v - velocity_[i]) / kCycle;
        if (seen_ > 0) worst = std::max(worst, std::fabs(v) / kVelocity);
        if (seen_ > 1) worst = std::max(worst, std::fabs(a) / kAcceleration);
        if (std::fabs(at(i)) > kSoft) worst = HUGE_VAL;
        before_[i] = at(i);
        velocity_[i] = v;
      }
      ++seen_;
    }
  }
  void press() {
    drive.in.cycle_start = true;
    step();
    drive.in.cycle_start = false;
  }
  /// Starts, and holds in this cycle. True when the axes stand in a hold in which hands may move them.
  bool hold_in(unsigned cycle) {
    step(2);
    press();
    while (drive.cycle < cycle && !drive.ended) step();
    drive.in.feed_hold = true;
    for (unsigned n = 0; n < 4000 && !drive.ended && !drive.out.manual_allowed; ++n) step();
    drive.in.feed_hold = false;
    step(3);
    if (drive.ended || drive.out.state != NC_STATE_HOLD || !drive.out.manual_allowed) return false;
    stood = drive.out.command;
    return true;
  }
  /// Asks an axis to move by hand for so many cycles, and waits until it stands.
  void by_hand(unsigned axis, const nc_manual& wish, unsigned cycles) {
    for (unsigned n = 0; n < cycles; ++n) {
      drive.in.manual[axis] = wish;
      step();
    }
    drive.in.manual[axis] = {};
    for (unsigned n = 0; n < 20000 && (n < 2 || !drive.out.distance_zero); ++n) step();
  }
  /// Leads an axis back.
  void back(unsigned axis, double velocity = 0) {
    drive.in.manual[axis] = {NC_MANUAL_RETURN, velocity, 0};
    for (unsigned n = 0; n < 20000 && (n < 2 || !drive.out.distance_zero); ++n) step();
    drive.in.manual[axis] = {};
    step(2);
  }
  /// The places of all cycles up to the end of the program.
  std::vector<nc_axes> rest() {
    std::vector<nc_axes> all;
    for (unsigned n = 0; n < kLongest && !drive.ended; ++n) {
      step();
      all.push_back(drive.out.command);
      if (!drive.alarm().empty()) break;
    }
    EXPECT_TRUE(drive.ended) << drive.alarm();
    return all;
  }
  double at(unsigned axis) const { return drive.out.command.v[axis]; }
  uint32_t away() const {
    uint32_t bits = 0;
    for (unsigned i = 0; i < kAxes; ++i)
      if (std::fabs(at(i) - stood.v[i]) > 1e-9) bits |= 1u << i;
    return bits;
  }

  Bench bench;
  Drive drive;
  nc_axes stood{};   ///< where the path has stopped
  double worst = 0;  ///< largest velocity or acceleration of an axis, divided by its limit

 private:
  static Bench& prepared(Bench& bench, const Parameters& parameters) {
    for (const auto& [key, value] : parameters) bench.param(key, value);
    return bench.at(0, 0, 50).tool(1, 3).tool(2, 7.5);
  }
  double before_[kAxes] = {}, velocity_[kAxes] = {};
  unsigned seen_ = 0;
};

const char* const kPrograms[] = {
    "G90 G54 G0 X10. Y5.\nG1 X60. Y40. F3000\nX20. Y70.\nG2 X50. Y80. R30. F2000\nG1 Z30. X0\nG4 X0.2\nM8\nG0 X0 Y0 Z50.\nM30",
    "G91 G1 X5. F1500\nX5. Y0.5\nX5. Y1.\nX5. Y2.\nG2 X8. Y8. R8.\nG3 X-8. Y8. R8.\nG1 G61 X-10.\nG64 Y-10.\nG0 Z-20.\nM30",
    "G41 D1 G1 X20. Y10. F2400\nX60.\nY40.\nG2 X40. Y60. R20.\nG1 X10.\nG40 X0 Y0\nM30",
    "G43 H2 G0 Z30. X10. Y10.\nG81 X20. Y20. Z5. R20. F1200\nX30.\nG83 X40. Z0 R20. Q5. F1200\nG80\nG49 G0 Z50.\nM30",
    "G31 X40. F600\nG1 X0 Y20. F3000\nG28 Z50.\nG3 X0 Y20. I-10. Z20. F3000\nG1 X-40.\nM30",
};

/// What a random operator does in the hold: jogs, steps, turns handles, goes to the reference position, presses start, which is refused as long as an axis is away,
/// and leads the axes back in an order of his own.
void hands(HeldMachine& m, std::mt19937& random) {
  const auto uniform = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (unsigned round = 1 + random() % 6; round > 0; --round) {
    const unsigned axis = random() % kAxes;
    switch (random() % 5) {
      case 0: m.by_hand(axis, {NC_MANUAL_JOG, uniform(-150, 150), 0}, 1 + random() % 600); break;
      case 1: m.by_hand(axis, {NC_MANUAL_STEP, 0, uniform(-40, 40)}, 2); break;
      case 2: m.by_hand(axis, {NC_MANUAL_HANDLE, 0, 0.001 * static_cast<double>(random() % 200)}, 1 + random() % 100); break;
      case 3: m.by_hand(axis, {NC_MANUAL_REFERENCE, 0, 0}, 1 + random() % 2000); break;
      default: m.back(axis, random() % 2 == 0 ? 0 : uniform(1, 50)); break;
    }
    ASSERT_EQ(m.drive.out.restart_axes, m.away());
    for (unsigned i = 0; i < kAxes; ++i) ASSERT_EQ(m.drive.out.return_place.v[i], m.stood.v[i]);
    ASSERT_EQ(m.drive.out.state, NC_STATE_HOLD);
    if (m.away() == 0) continue;
    const nc_axes before = m.drive.out.command;
    m.press();
    m.step(5);
    ASSERT_EQ(m.drive.out.state, NC_STATE_HOLD) << "started beside the path";
    for (unsigned i = 0; i < kAxes; ++i) ASSERT_EQ(m.at(i), before.v[i]);
  }
  unsigned order[kAxes] = {0, 1, 2};
  std::shuffle(order, order + kAxes, random);
  for (const unsigned axis : order) m.back(axis);
  ASSERT_EQ(m.drive.out.restart_axes, 0u);
}

class HoldByHand : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, HoldByHand, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

// The run in which the axes were moved by hand is compared with one in which the program stood in the hold as long: behind the start every axis has the same place in
// every cycle, to the last bit.
TEST_P(HoldByHand, BehindTheReturnThePathIsTheSameToTheLastBit) {
  unsigned compared = 0;
  const uint64_t count = seeds(80, 20);
  for (unsigned seed = 0; seed < count; ++seed) {
    std::mt19937 random(seed);
    const std::string text = kPrograms[seed % (sizeof kPrograms / sizeof kPrograms[0])];
    const unsigned hold = 20 + random() % 2500;
    const bool shifts = random() % 2 == 0;
    SCOPED_TRACE("seed " + std::to_string(seed) + ", hold in cycle " + std::to_string(hold));
    HeldMachine moved(GetParam(), text), held(GetParam(), text);
    moved.drive.in.manual_absolute_off = shifts;
    if (!moved.hold_in(hold)) continue;
    ASSERT_TRUE(held.hold_in(hold));
    ASSERT_NO_FATAL_FAILURE(hands(moved, random));
    while (held.drive.cycle < moved.drive.cycle) held.step();
    moved.press();
    held.press();
    ASSERT_EQ(moved.drive.out.state, NC_STATE_RUNNING);
    const std::vector<nc_axes> after = moved.rest(), expected = held.rest();
    ASSERT_EQ(after.size(), expected.size());
    for (size_t n = 0; n < after.size(); ++n)
      for (unsigned i = 0; i < kAxes; ++i) ASSERT_EQ(after[n].v[i], expected[n].v[i]) << "cycle " << n << " behind the start, axis " << i;
    ASSERT_EQ(moved.drive.events.size(), held.drive.events.size());
    EXPECT_LE(moved.worst, 1.001);
    ++compared;
  }
  EXPECT_GT(compared, count / 2);
}

// Jogs beyond the soft limits stop at them, in a hold as elsewhere.
TEST_P(HoldByHand, SoftLimitsInterlockAndFeedHoldAct) {
  HeldMachine m(GetParam(), "G1 X60. F3000\nX0\nM30");
  ASSERT_TRUE(m.hold_in(200));
  m.by_hand(1, {NC_MANUAL_JOG, 100, 0}, 3000);
  EXPECT_EQ(m.at(1), kSoft);
  m.drive.in.interlock = true;
  m.by_hand(2, {NC_MANUAL_JOG, 50, 0}, 50);
  EXPECT_EQ(m.at(2), m.stood.v[2]);
  m.drive.in.interlock = false;
  m.drive.in.feed_hold = true;
  m.by_hand(2, {NC_MANUAL_JOG, 50, 0}, 50);
  EXPECT_EQ(m.at(2), m.stood.v[2]);
  m.drive.in.feed_hold = false;
  EXPECT_EQ(m.drive.out.restart_axes, 2u);
  m.back(1, 20);
  m.press();
  m.rest();
  EXPECT_EQ(m.at(0), 0);
  EXPECT_LE(m.worst, 1.001);
}

// A reset and an alarm leave the axes where the hands have brought them, and the next program begins there.
TEST_P(HoldByHand, AResetOrAnAlarmEndsTheHoldWhereTheAxesAre) {
  for (const bool alarm : {false, true}) {
    for (const bool moving : {false, true}) {
      SCOPED_TRACE(std::string(alarm ? "alarm" : "reset") + (moving ? ", an axis moves" : ""));
      HeldMachine m(GetParam(), "G90 G1 X60. F3000\nX0\nM30");
      ASSERT_TRUE(m.hold_in(200));
      m.by_hand(2, {NC_MANUAL_STEP, 0, 12.5}, 2);
      if (moving) m.drive.in.manual[1] = {NC_MANUAL_JOG, 40, 0};
      m.step(80);
      m.drive.in.alarm = alarm;
      m.drive.in.reset = !alarm;
      m.step(200);
      EXPECT_EQ(m.drive.out.state, alarm ? NC_STATE_ALARM : NC_STATE_IDLE);
      m.drive.in.alarm = false;
      m.drive.in.reset = true;
      m.drive.in.manual[1] = {};
      m.step(20);
      m.drive.in.reset = false;
      m.step(20);
      ASSERT_EQ(m.drive.out.state, NC_STATE_IDLE);
      EXPECT_EQ(m.drive.out.restart_axes, 0u);
      EXPECT_NEAR(m.at(2), 62.5, 1e-9);
      EXPECT_EQ(m.at(1) > 1, moving);
      const double z = m.at(2);
      m.press();
      for (unsigned n = 0; n < kLongest && m.drive.out.state != NC_STATE_IDLE; ++n) m.step();
      EXPECT_EQ(m.drive.alarm(), "");
      EXPECT_EQ(m.at(2), z);
      EXPECT_LE(m.worst, 1.001);
    }
  }
}

// What was read ahead is read again in the hold, with axes away: the hold, the place and the program stay.
TEST_P(HoldByHand, ARecalculationForgetsNothing) {
  HeldMachine m(GetParam(), "G90 G1 X60. F3000\nY30.\nX0\nY0\nM30");
  ASSERT_TRUE(m.hold_in(300));
  m.by_hand(2, {NC_MANUAL_STEP, 0, 8}, 2);
  m.by_hand(0, {NC_MANUAL_STEP, 0, -3}, 2);
  unsigned tries = 0;
  while (nc_recalculate(m.bench.control(), 0) != NC_OK && ++tries < 100) m.step();
  EXPECT_LT(tries, 100u);
  m.step(10);
  EXPECT_EQ(m.drive.out.restart_axes, 5u);
  m.press();
  m.step(5);
  ASSERT_EQ(m.drive.out.state, NC_STATE_HOLD);
  m.back(0);
  m.back(2);
  m.press();
  m.rest();
  for (unsigned i = 0; i < 2; ++i) EXPECT_EQ(m.at(i), 0);
  EXPECT_EQ(m.at(2), 50);
  EXPECT_LE(m.worst, 1.001);
}

// Filters behind interpolation, and the radius of an arc that is compensated (M700 7.7, 13.15): the axes stand beside the interpolated place, and come back to there.
TEST_P(HoldByHand, BehindFiltersTheAxesComeBackToWhereTheyStood) {
  unsigned held = 0;
  for (unsigned hold = 100; hold < 5000; hold += 370) {
    SCOPED_TRACE(hold);
    const bool rounds = hold % 2 == 0;
    const HeldMachine::Parameters parameters = rounds ? HeldMachine::Parameters{{"8107", "1"}, {"8108", "1"}, {"2069", "0.03"}} : HeldMachine::Parameters{{"2007", "60"}};
    HeldMachine m(GetParam(), "G90 G1 X30. F3000\nG2 X30. Y0 I-15. F3000\nG1 Y30.\nX0 Y0\nM30", parameters);
    if (!m.hold_in(hold)) continue;
    ++held;
    m.by_hand(0, {NC_MANUAL_JOG, 30, 0}, 100);
    m.by_hand(1, {NC_MANUAL_STEP, 0, -6}, 2);
    m.back(1);
    m.back(0);
    for (unsigned i = 0; i < kAxes; ++i) ASSERT_EQ(m.at(i), m.stood.v[i]);
    m.press();
    m.rest();
    EXPECT_NEAR(m.at(0), 0, 1e-9);
    EXPECT_NEAR(m.at(1), 0, 1e-9);
    EXPECT_LE(m.worst, 1.001);
  }
  EXPECT_GT(held, 5u);
}

// M700 13.1.1: between R and R the tap goes on to R, and stands out of its hole then; 6.7.1: a thread goes on to its end.
TEST_P(HoldByHand, NotWhereItWouldBreakTheTool) {
  const char* const cases[] = {"G0 Z30.\nM3 S600\nG84 X5. Z10. R25. F1. ,R1\nG80\nM30", "G0 Z30.\nG33 Z10. F2.\nG1 Z30. F3000\nM30"};
  for (const char* text : cases) {
    for (unsigned hold = 100; hold < 3000; hold += 290) {
      SCOPED_TRACE(std::string(text) + " in cycle " + std::to_string(hold));
      HeldMachine m(GetParam(), text);
      m.step(2);
      m.press();
      while (m.drive.cycle < hold && !m.drive.ended) m.step();
      m.drive.in.feed_hold = true;
      for (unsigned n = 0; n < 6000 && !m.drive.ended && m.drive.out.state != NC_STATE_HOLD; ++n) {
        m.step();
        ASSERT_FALSE(m.drive.out.state == NC_STATE_RUNNING && m.drive.out.manual_allowed);
      }
    }
  }
}

// M700 6.7.1 (6): the block behind the thread takes the tool out of the groove, also where the hold stays on.
TEST_P(HoldByHand, OneThatStaysOnInAThreadActsBehindTheNextBlock) {
  for (const char* behind : {"G0 X30.", "G1 X30. F3000", "#100=1\nG0 X30.", "N10\nG0 X30."}) {
    SCOPED_TRACE(behind);
    HeldMachine m(GetParam(), std::string("G90 G0 Z30.\nG33 Z10. F1.\n") + behind + "\nX20. Y10. Z5.\nM30");
    m.step(2);
    m.press();
    for (unsigned n = 0; n < 8000 && (m.drive.out.source.line != 2 || std::fabs(m.drive.out.distance_to_go.v[2] + 10) > 5); ++n) m.step();
    m.drive.in.feed_hold = true;
    for (unsigned n = 0; n < 8000 && !m.drive.out.manual_allowed && !m.drive.ended; ++n) m.step();
    ASSERT_EQ(m.drive.out.state, NC_STATE_STOPPED);
    EXPECT_EQ(m.drive.out.cause, NC_CAUSE_FEED_HOLD);
    EXPECT_NEAR(m.at(0), 30, 0.01) << "within the tolerance of its corner";
    EXPECT_NEAR(m.at(2), 10, 0.01);
    m.drive.in.feed_hold = false;
    m.press();
    m.rest();
    EXPECT_NEAR(m.at(0), 20, 1e-9);
  }
}

// A hold amid a thread acts behind it (M700 6.7.1), as a block stop, and bars as a hold does: the next block begins where the thread has ended, or not at all. A return to the
// reference position in it ends nothing that the program has in force, and blocks of MDI take the bar away as little as at the place of a restart.
TEST_P(HoldByHand, BehindAThreadTheStartIsBarredUntilTheAxesAreBack) {
  for (const bool shifts : {false, true}) {
    SCOPED_TRACE(shifts);
    HeldMachine m(GetParam(), "G90 G43 H2 G0 Z30.\nG33 Z10. F1.\nG1 X30. F3000\nX20. Y10. Z5.\nM30");
    m.drive.in.manual_absolute_off = shifts;
    m.step(2);
    m.press();
    for (unsigned n = 0; n < 8000 && (m.drive.out.source.line != 2 || std::fabs(m.drive.out.distance_to_go.v[2] + 10) > 5); ++n) m.step();
    m.drive.in.feed_hold = true;
    m.step(5);
    m.drive.in.feed_hold = false;
    for (unsigned n = 0; n < 8000 && !m.drive.out.manual_allowed && !m.drive.ended; ++n) m.step();
    ASSERT_FALSE(m.drive.ended);
    ASSERT_EQ(m.drive.out.state, NC_STATE_STOPPED);
    ASSERT_EQ(m.drive.out.cause, NC_CAUSE_FEED_HOLD);
    m.stood = m.drive.out.command;
    EXPECT_EQ(m.drive.out.restart_axes, 0u);
    m.by_hand(2, {NC_MANUAL_STEP, 0, 7.5}, 2);
    m.by_hand(1, {NC_MANUAL_REFERENCE, 0, 0}, 2000);
    m.by_hand(2, {NC_MANUAL_REFERENCE, 0, 0}, 2000);
    EXPECT_EQ(m.drive.out.restart_axes, m.away());
    ASSERT_EQ(m.away(), 6u);
    for (const unsigned axis : {2u, 1u}) {
      m.press();
      m.step(400);
      ASSERT_EQ(m.drive.out.state, NC_STATE_STOPPED) << "started beside the path";
      EXPECT_EQ(m.drive.out.return_place.v[axis], m.stood.v[axis]);
      m.back(axis);
    }
    EXPECT_EQ(m.away(), 0u);
    EXPECT_EQ(m.drive.out.restart_axes, 0u);
    m.press();
    m.step(1);
    for (unsigned n = 0; n < 8000 && m.at(0) < 25; ++n) {
      m.step();
      ASSERT_EQ(m.at(2), m.stood.v[2]);
      ASSERT_EQ(m.at(1), m.stood.v[1]);
    }
    m.rest();
    EXPECT_NEAR(m.at(0), 20, 1e-9);
    EXPECT_NEAR(m.at(1), 10, 1e-9);
    EXPECT_NEAR(m.at(2), 12.5, 1e-9) << "with the tool length of the program";
    EXPECT_LE(m.worst, 1.001);
  }
}

// A skip move whose signal has come in the hold, or just before, has its end there. As long as its path still leads to that end nobody moves an axis.
TEST_P(HoldByHand, ASkipMoveWhoseSignalHasComeEndsFirst) {
  HeldMachine m(GetParam(), "G31 X60. F3000\nG1 X0 F3000\nM30");
  m.step(2);
  m.press();
  while (m.at(0) < 20) m.step();
  m.drive.in.skip = 1;
  m.drive.in.feed_hold = true;
  m.step(400);
  m.drive.in.feed_hold = false;
  m.drive.in.skip = 0;
  ASSERT_EQ(m.drive.out.state, NC_STATE_HOLD);
  m.stood = m.drive.out.command;
  const bool frees = m.drive.out.manual_allowed;
  EXPECT_EQ(frees, !GetParam()) << "the trapezoid ends the move as it comes to rest";
  m.by_hand(1, {NC_MANUAL_JOG, 50, 0}, 50);
  EXPECT_EQ(m.away(), frees ? 2u : 0u);
  m.back(1);
  m.press();
  m.rest();
  EXPECT_EQ(m.at(0), 0);
  EXPECT_EQ(m.at(1), 0);
  EXPECT_LE(m.worst, 1.001);
}

}  // namespace
}  // namespace nc::test
