// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) whose spindle is a C axis (10.5): the commands of that axis keep its limits, and an axis that fails in the hole is the alarm of a
// spindle that does not follow. Neither may tear the tap.
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr unsigned kZ = 2, kC = 3;
constexpr uint8_t kServoC = 1 << kC;
constexpr double kLead = 1.5, kCycle_s = 0.001, kTurn = 360;

struct AxisOf {
  double velocity = 0, acceleration = 0, jerk = 0;
};
constexpr AxisOf kLinear{150, 1500, 40000};

std::function<void(nc_config&)> machine_with(const AxisOf& c_axis, bool optimal) {
  return [c_axis, optimal](nc_config& c) {
    c.cycle_s = kCycle_s;
    c.look_ahead = 256;
    c.system[0].axis_count = 4;
    c.system[0].axis[kC].name = 'C';
    c.system[0].axis[kC].rotary = true;
    c.system[0].axis[kC].spindle = 1;
    for (unsigned i = 0; i < 4; ++i) {
      const AxisOf& of = i == kC ? c_axis : kLinear;
      c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = of.velocity;
      c.system[0].axis[i].max_acceleration = of.acceleration;
      c.system[0].axis[i].max_jerk = optimal ? of.jerk : 0;
    }
    c.motion_mode = optimal ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
  };
}

/// The greatest velocity, acceleration and jerk of the commands of an axis, from cycle to cycle.
class Greatest {
 public:
  void see(double place) {
    const double velocity = (place - place_) / kCycle_s, acceleration = (velocity - velocity_) / kCycle_s, jerk = (acceleration - acceleration_) / kCycle_s;
    if (seen_ > 0) most.velocity = std::max(most.velocity, std::fabs(velocity));
    if (seen_ > 1) most.acceleration = std::max(most.acceleration, std::fabs(acceleration));
    if (seen_ > 2) most.jerk = std::max(most.jerk, std::fabs(jerk));
    place_ = place, velocity_ = velocity, acceleration_ = acceleration;
    ++seen_;
  }
  /// The counter of the axis has taken another place, at which it stands.
  void begin() { seen_ = 0; }
  AxisOf most;

 private:
  double place_ = 0, velocity_ = 0, acceleration_ = 0;
  unsigned seen_ = 0;
};

/// A drive of the C axis that does what it is told while it is ready and sound; as a spindle it stands, and goes with the tap.
class CTap : public testing::TestWithParam<bool> {
 protected:
  void make(const AxisOf& c_axis, const std::string& text) {
    limits = c_axis;
    bench = std::make_unique<Bench>(NC_DIALECT_M700, machine_with(c_axis, GetParam()));
    bench->at(0, 0, 10);
    load(text);
  }
  void load(const std::string& text) {
    const nc_outputs before = drive != nullptr ? drive->out : nc_outputs{};
    drive = std::make_unique<Drive>(*bench, text);
    drive->out = before;
  }
  void step() {
    const nc_outputs& out = drive->out;
    const bool follows = (out.servo_ready & kServoC) != 0 && ready, goes = (out.spindle_synchronous & 1) != 0;
    const double before = measured;
    if (!sound) measured += coasts * kCycle_s;
    if (sound && follows) measured += (c() - measured) * reaches();
    z_measured += (z() - z_measured) * reaches();
    if (goes && !taken) taken_at = measured - (out.state == NC_STATE_RUNNING ? 0 : kTurn * out.spindle_turns);  // in a hole it is already
    if (sound && !follows && goes) measured = taken_at + kTurn * out.spindle_turns;
    taken = goes;
    drive->in.servo_on = servo_on ? kServoC : 0;
    drive->in.actual_valid = shows_places;
    drive->in.actual = out.command;
    drive->in.actual.v[kZ] = z_measured;
    drive->in.actual.v[kC] = measured;
    nc_spindle_inputs& spindle = drive->in.spindle[0];
    spindle.servo_ready = ready && (out.servo_on & kServoC) != 0;
    spindle.zero_passed = true;
    spindle.turns_valid = true;
    spindle.turns = measured / kTurn;
    spindle.rev_per_s = (measured - before) / kTurn / kCycle_s;
    const bool was_ready = (out.servo_ready & kServoC) != 0;
    drive->press_start();
    drive->step(50);
    if ((drive->out.servo_ready & kServoC) != 0 && !was_ready) of_c.begin();
    of_c.see(c());
    of_z.see(z());
    if (drive->out.tapping) deepest = std::min(deepest, z());
  }
  template <class Done>
  bool until(Done done, unsigned most = 60000) {
    for (unsigned n = 0; n < most; ++n) {
      if (done()) return true;
      step();
    }
    return false;
  }
  bool until_end() {
    return until([&] { return drive->ended; });
  }
  void rest(unsigned cycles = 500) {
    for (unsigned n = 0; n < cycles; ++n) step();
  }
  void acknowledge() {
    drive->in.reset = true;
    rest(20);
    drive->in.reset = false;
    rest(20);
  }
  void expect_limits(const std::string& what) const {
    const auto kept = [&](const AxisOf& most, const AxisOf& limit, const char* axis) {
      EXPECT_LE(most.velocity, limit.velocity * 1.001) << axis << " " << what;
      EXPECT_LE(most.acceleration, limit.acceleration * 1.001) << axis << " " << what;
      if (GetParam()) {
        EXPECT_LE(most.jerk, limit.jerk * 1.001) << axis << " " << what;
      }
    };
    kept(of_c.most, limits, "C");
    kept(of_z.most, kLinear, "Z");
  }
  /// The part of the way to their commands that the drives go in a cycle.
  double reaches() const { return lag_s > 0 ? 1 - std::exp(-kCycle_s / lag_s) : 1; }
  double c() const { return drive->out.command.v[kC]; }
  double z() const { return drive->out.command.v[kZ]; }

  std::unique_ptr<Bench> bench;
  std::unique_ptr<Drive> drive;
  AxisOf limits;
  Greatest of_c, of_z;
  double measured = 0;  ///< place of C, deg
  double z_measured = 0;
  double lag_s = 0;     ///< by which both drives are behind their commands
  double coasts = 0;    ///< deg/s of a C axis that is not sound
  double deepest = 10, taken_at = 0;
  bool servo_on = true, ready = true, sound = true, taken = false;
  bool shows_places = true;  ///< the machine measures the places of its axes, and not the turns of the spindle alone
};

INSTANTIATE_TEST_SUITE_P(BothLaws, CTap, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

constexpr AxisOf kFast{36000, 36000, 1e6};
const char* const kOneHole = "G17 G90 G94 G98 G0 Z10.\nC90.\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nG80\nM30";

TEST_P(CTap, ItsCommandsKeepTheLimitsOfC) {
  struct Case {
    AxisOf c;
    const char* hole;
  };
  const Case cases[] = {
      {kFast, "G84 X5. Z-8. R2. S600 F1.5 ,R1"},
      {{3000, 36000, 1e6}, "G84 X5. Z-8. R2. S600 F1.5 ,R1"},
      {{36000, 360000, 1e6}, "G84 X5. Z-8. R2. S600 F1.5 ,R1 ,S900"},
      {{36000, 5000, 5e4}, "G74 X5. Z-8. R2. S300 F1. ,R1"},
      {{9000, 20000, 3e5}, "G84 X5. Z-8. R2. Q3. S900 F2. ,R1"},
      {{36000, 36000, 1e6}, "G84 X5. Z-8. R2. S600 F1.5 ,R1\nX10.\nX15. Z-4."},
  };
  for (const Case& n : cases) {
    of_c = of_z = {};
    measured = 0, deepest = 10;
    make(n.c, std::string("G17 G90 G94 G98 G0 Z10.\nC90.\n") + n.hole + "\nG80\nM30");
    ASSERT_TRUE(until_end()) << n.hole << " cause " << unsigned{drive->out.cause};
    EXPECT_EQ(drive->alarm(), "");
    expect_limits(n.hole);
    EXPECT_NEAR(deepest, -8, 1e-3) << n.hole;
    EXPECT_NEAR(c(), 90, 1e-6) << "it has turned back";
  }
}

// As fast as the C axis can, and no slower: at S where its limits leave room for that.
TEST_P(CTap, ItTurnsAsFastAsItWasToldWhereItCan) {
  make(kFast, "G84 X5. Z-20. R2. S600 F1.5 ,R1\nG80\nM30");
  ASSERT_TRUE(until_end());
  EXPECT_NEAR(of_c.most.velocity, 3600, 4);
  EXPECT_GT(of_c.most.acceleration, 0.9 * kFast.acceleration);
}

TEST_P(CTap, ATapWithItsSpindleIsNoSlowerWhereThatCouldBeAnAxis) {
  const auto cycles = [&](bool with_c) {
    drive.reset();
    const AxisOf slow{2000, 2000, 20000};
    bench = std::make_unique<Bench>(NC_DIALECT_M700, [&](nc_config& c) {
      machine_with(slow, GetParam())(c);
      if (!with_c) c.system[0].axis[kC].spindle = 0;
    });
    bench->at(0, 0, 10);
    servo_on = false;
    load("G17 G90 G94 G98 G0 Z10.\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nX10.\nG80\nM30");
    EXPECT_TRUE(until_end());
    EXPECT_EQ(drive->alarm(), "");
    return drive->cycle;
  };
  const auto alone = cycles(false);
  EXPECT_EQ(cycles(true), alone);
}

// The drive of C trips in the hole: both come to rest, it is an alarm, and the tap can be drawn out when the drive works again.
TEST_P(CTap, ACAxisThatIsLostInTheHoleIsAnAlarm) {
  for (const bool places : {true, false}) {
    drive.reset();
    shows_places = places;
    ready = sound = true;
    of_c = of_z = {};
    measured = 0;
    make({36000, 36000, 1e6}, kOneHole);
    ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
    const double thread = z() + kLead * measured / kTurn;  // what a tap keeps in its thread
    ready = sound = false;
    coasts = 0;
    rest();
    EXPECT_EQ(drive->out.state, NC_STATE_ALARM);
    EXPECT_EQ(drive->alarm(), "NC-TAP");
    EXPECT_NEAR(z() + kLead * measured / kTurn, thread, 0.12) << "mm beside the thread: what Z needs to stand, and no more";
    const double stands = z();
    // READY comes back: the command of C goes on from where it stands.
    ready = sound = true;
    step();
    EXPECT_NEAR(c(), measured, 1e-6);
    rest();
    EXPECT_NEAR(c(), measured, 1e-6);
    EXPECT_NEAR(z(), stands, 1e-6);
    acknowledge();
    EXPECT_EQ(drive->out.state, NC_STATE_IDLE);
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_NEAR(c(), measured, 1e-6);
    ASSERT_TRUE(drive->out.tap_retract_possible);
    const double turned = c(), depth = z();
    of_c.most = of_z.most = {};
    drive->in.tap_retract = true;
    double worst = 0;
    ASSERT_TRUE(until([&] {
      worst = std::max(worst, std::fabs(z() - depth + kLead * (c() - turned) / kTurn));
      return z() > 2 - 1e-6;
    }, 8000));
    drive->in.tap_retract = false;
    EXPECT_LT(worst, 1e-6) << "mm beside the thread";
    EXPECT_LE(of_c.most.velocity, limits.velocity * 1.001);
    EXPECT_LE(of_c.most.acceleration, limits.acceleration * 1.001);
    step();
    EXPECT_FALSE(drive->out.tap_retract_possible);
  }
}

// ... also when it comes back while Z still brakes, and whatever it did meanwhile.
TEST_P(CTap, ACAxisThatComesBackAtOnceIsAnAlarmAsWell) {
  for (const unsigned cycles : {1u, 3u, 10u, 40u}) {
    drive.reset();
    ready = sound = true;
    of_c = of_z = {};
    measured = 0;
    make(kFast, kOneHole);
    ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
    ready = sound = false;
    coasts = 0;
    rest(cycles);
    ready = sound = true;
    const double stood = measured;
    step();
    EXPECT_NEAR(c(), stood, 5) << "deg, in the cycle of READY: no more than it turns in one";
    rest();
    EXPECT_EQ(drive->alarm(), "NC-TAP") << cycles;
    EXPECT_LE(of_z.most.acceleration, kLinear.acceleration * 1.001) << cycles;
    EXPECT_LE(of_c.most.acceleration, limits.acceleration * 1.001) << cycles;
    acknowledge();
    EXPECT_TRUE(drive->out.tap_retract_possible);
    EXPECT_NEAR(c(), measured, 1e-6);
  }
}

// C stands though its drive is ready.
TEST_P(CTap, ACAxisThatDoesNotFollowIsAnAlarm) {
  make(kFast, kOneHole);
  ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
  const double thread = z() + kLead * measured / kTurn;
  sound = false;
  rest();
  EXPECT_EQ(drive->out.state, NC_STATE_ALARM);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_NEAR(z() + kLead * measured / kTurn, thread, 0.6) << "mm beside the thread";
  EXPECT_LE(of_z.most.acceleration, kLinear.acceleration * 1.001);
  acknowledge();
  EXPECT_TRUE(drive->out.tap_retract_possible);
  // It still stands: drawing the tap out is an alarm as well, and does not tear it.
  const double stands = z();
  drive->in.tap_retract = true;
  rest(2000);
  EXPECT_EQ(drive->alarm(), "NC-TAP");
  EXPECT_NEAR(z(), stands, 0.6);
  drive->in.tap_retract = false;
  acknowledge();
  EXPECT_EQ(drive->out.tap_holds, 0u) << "it has to be freed by hand, and the machine moved for that";
}

// Without its drive it is not drawn out: neither by the signal nor by a jog, both of which say why.
TEST_P(CTap, ATapIsNotDrawnOutWithoutTheServoOfC) {
  for (const bool jogs : {false, true}) {
    drive.reset();
    ready = sound = true;
    measured = 0;
    make(kFast, kOneHole);
    ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
    ready = sound = false;
    rest();
    acknowledge();
    const double stands = z();
    drive->in.tap_retract = !jogs;
    if (jogs) drive->in.manual[kZ] = {NC_MANUAL_JOG, 20, 0};
    rest(2000);
    EXPECT_EQ(drive->alarm(), "NC-TAP");
    EXPECT_NEAR(z(), stands, 0.1);
    drive->in.tap_retract = false;
    drive->in.manual[kZ] = {};
  }
}

// A jog of the axis of a tap in its hole turns C no faster than C may.
TEST_P(CTap, ByHandItsCommandsKeepTheLimitsOfC) {
  make({3000, 9000, 1e6}, kOneHole);
  ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
  drive->in.reset = true;
  rest(1000);
  drive->in.reset = false;
  rest(20);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  of_c.most = {};
  for (const double velocity : {100., -100., 100.}) {
    drive->in.manual[kZ] = {NC_MANUAL_JOG, velocity, 0};
    rest(150);
  }
  EXPECT_GT(of_c.most.velocity, 1000);
  EXPECT_LE(of_c.most.velocity, limits.velocity * 1.001);
  EXPECT_LE(of_c.most.acceleration, limits.acceleration * 1.001);
}

// Between holes a C axis that is lost makes the next tap wait.
TEST_P(CTap, ItIsWaitedForInFrontOfAHole) {
  make(kFast, "G17 G90 G94 G98 G0 Z10.\nC90.\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nX10.\nG80\nM30");
  ASSERT_TRUE(until([&] { return drive->out.command.v[0] > 6; }));
  ready = false;
  rest(2000);
  EXPECT_EQ(drive->out.state, NC_STATE_RUNNING);
  EXPECT_EQ(drive->out.cause, NC_CAUSE_SERVO_OFF);
  EXPECT_NEAR(z(), 2, 1e-6);
  ready = true;
  deepest = 10;
  ASSERT_TRUE(until_end());
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(deepest, -8, 1e-3);
  expect_limits("both");
}

// The servo is switched on and off at any time in front of a tap: the tap goes by the limits of what it turns.
TEST_P(CTap, WhateverTheSpindleIsWhenTheTapBegins) {
  std::mt19937_64 random(GetParam() ? 3 : 4);
  unsigned as_axis = 0, as_spindle = 0;
  for (unsigned n = 0; n < 30; ++n) {
    drive.reset();
    of_c = of_z = {};
    measured = 0, deepest = 10;
    servo_on = random() % 2 == 0;
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const AxisOf c_axis{uniform(1500, 9000), uniform(5000, 50000), uniform(1e5, 1e6)};
    make(c_axis, "G17 G90 G94 G98 G0 Z10.\nG1 X1. F3000\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nX10.\nG80\nX12. F1000\nG84 X5. Z-8. R2. S600 F1.5 ,R1\nG80\nM30");
    bool turned = false;
    const bool ended = until([&] {
      if (random() % 100 == 0) servo_on = !servo_on;
      if (drive->out.cause == NC_CAUSE_TAP_SPINDLE) servo_on = false;  // the mode keeps what it has begun with
      turned = drive->out.tapping && z() < 0;
      if (turned) ++((drive->out.spindle_synchronous & 1) != 0 ? as_spindle : as_axis);
      return drive->ended;
    });
    ASSERT_TRUE(ended) << n << " cause " << unsigned{drive->out.cause} << " " << drive->alarm();
    EXPECT_EQ(drive->alarm(), "") << n;
    EXPECT_NEAR(deepest, -8, 1e-2) << n;
    expect_limits(std::to_string(n));
  }
  EXPECT_GT(as_axis, 100u);
  EXPECT_GT(as_spindle, 100u);
}

// The check of #1223 at the bottom is one of the C axis as well: where it has been turned to.
TEST_P(CTap, ItIsInPositionAtTheBottom) {
  make(kFast, "M30");
  bench = std::make_unique<Bench>(NC_DIALECT_M700, [&](nc_config& c) {
    machine_with(kFast, GetParam())(c);
    for (unsigned i = 0; i < 4; ++i) c.system[0].axis[i].in_position = 0.01;
  });
  drive.reset();
  bench->at(0, 0, 10).param("1223", "56");
  load("G17 G90 G94 G98 G0 Z10.\nC90.\nG84 X5. Z-8. R2. P50 S600 F1.5 ,R1\nG80\nM30");
  ASSERT_TRUE(until_end()) << "cause " << unsigned{drive->out.cause} << " at Z" << z();
  EXPECT_EQ(drive->alarm(), "");
  EXPECT_NEAR(deepest, -8, 1e-6);
}

// Behind a power cut the tap is drawn out by C where its spindle is that.
TEST_P(CTap, BehindAPowerCutItIsDrawnOutByC) {
  make(kFast, kOneHole);
  ASSERT_TRUE(until([&] { return drive->out.tapping && z() < -3; }));
  nc_tap tap = NC_INIT(nc_tap);
  ASSERT_EQ(nc_tap_get(bench->control(), 0, &tap), NC_OK);
  const double stands = z(), angle = std::fmod(measured, kTurn);
  drive.reset();
  measured = angle, z_measured = stands;
  bench = std::make_unique<Bench>(NC_DIALECT_M700, machine_with(kFast, GetParam()));
  bench->at(0, 0, stands);
  ASSERT_EQ(nc_tap_set(bench->control(), 0, &tap), NC_OK);
  load("M30");
  of_c = of_z = {};
  rest(200);
  ASSERT_TRUE(drive->out.tap_retract_possible);
  EXPECT_NEAR(z(), stands, 1e-9) << "nothing moves by itself";
  EXPECT_NEAR(c(), angle, 1e-9);
  drive->in.tap_retract = true;
  double worst = 0;
  ASSERT_TRUE(until([&] {
    worst = std::max(worst, std::fabs(z() - stands + kLead * (c() - angle) / kTurn));
    return z() > 2 - 1e-6;
  }, 8000)) << z() << drive->alarm();
  EXPECT_LT(worst, 1e-6);
  EXPECT_NEAR(c() - angle, (stands - 2) / kLead * kTurn, 1e-3);
  EXPECT_LE(of_c.most.velocity, limits.velocity * 1.001);
  EXPECT_LE(of_c.most.acceleration, limits.acceleration * 1.001);
}

// Random machines and holes, drives that lag, trip and coast, an operator who resets and draws out: C keeps its limits in every cycle, and a tap is never torn.
TEST_P(CTap, WhateverHappensInTheHole) {
  const uint64_t count = seeds(60, 8);
  unsigned made = 0, failed = 0, drawn = 0;
  for (uint64_t seed = 1; seed <= count && !HasFailure(); ++seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto chance = [&](double p) { return uniform(0, 1) < p; };
    drive.reset();
    of_c = of_z = {};
    measured = z_measured = coasts = 0, deepest = 10;
    ready = sound = true;
    lag_s = chance(0.5) ? uniform(0.002, 0.03) : 0;
    const double hand = chance(0.3) ? -1 : 1, turns = std::round(uniform(100, 1500));
    const bool trips = chance(0.5);
    const std::string cuts = chance(0.3) ? " Q2." : "";
    const AxisOf c_axis{uniform(1500, 20000), uniform(4000, 60000), uniform(1e5, 2e6)};
    make(c_axis, std::string("G17 G90 G94 G98 G0 Z10.\nC90.\n") + (hand > 0 ? "G84" : "G74") + " X5. Z-8. R2. F1.5 ,R1 S" + brief(turns) + cuts + "\nX10.\nG80\nM30");
    const auto thread = [&] { return z_measured + hand * kLead * measured / kTurn; };
    bool in_hole = false, spoilt = false;
    double in_thread = 0, speed = 0;
    AxisOf planned;
    for (unsigned n = 0; n < 40000 && !drive->ended && !HasFailure(); ++n) {
      const double before = measured;
      step();
      if (sound) speed = (measured - before) / kCycle_s;
      const bool below = z() < 2 - 1e-3;
      if (below && !in_hole) in_thread = thread();
      in_hole = below;
      if (!below) in_thread = thread();
      // Apart by a quarter of a turn until it is seen, by what Z needs to come to rest, and by what it is behind its own command.
      const double v = kLead * std::max(of_c.most.velocity, std::fabs(speed)) / kTurn, bound = 0.25 * kLead + 2 * v * v / (2 * kLinear.acceleration) + v * (lag_s + 3 * kCycle_s) + 0.02;
      EXPECT_LT(std::fabs(thread() - in_thread), bound) << "seed " << seed << " cycle " << drive->cycle << " z " << z();
      EXPECT_LE(of_c.most.velocity, c_axis.velocity * 1.001) << seed;
      EXPECT_LE(of_c.most.acceleration, c_axis.acceleration * 1.001) << seed << " cycle " << drive->cycle;
      EXPECT_LE(of_z.most.velocity, kLinear.velocity * 1.001) << seed;
      EXPECT_LE(of_z.most.acceleration, kLinear.acceleration * 1.001) << seed << " cycle " << drive->cycle;
      spoilt = spoilt || !ready || drive->in.reset || drive->out.state == NC_STATE_ALARM;
      if (!spoilt) planned = of_c.most;
      drive->in.feed_override = chance(0.01) ? uniform(0.1, 2) : drive->in.feed_override;
      if (trips && below && chance(0.003)) {
        ready = sound = false;
        coasts = speed;
      }
      coasts *= 0.99;
      if (!ready && chance(0.01)) ready = sound = true;
      const bool waits = drive->out.state == NC_STATE_ALARM || drive->out.tap_retract_possible;
      drive->in.reset = drive->in.reset ? !chance(0.05) : chance(drive->out.state == NC_STATE_ALARM ? 0.01 : below ? 0.00005 : 0);
      failed += drive->out.state == NC_STATE_ALARM ? 1 : 0;
      drive->in.tap_retract = waits && ready && (drive->in.tap_retract ? !chance(0.002) : chance(0.01));
      drawn += drive->in.tap_retract ? 1 : 0;
      if (spoilt && !below && drive->out.state == NC_STATE_IDLE) break;
    }
    made += drive->ended && !spoilt ? 1 : 0;
    if (GetParam()) {
      EXPECT_LE(planned.jerk, c_axis.jerk * 1.001) << seed;
    }
    if (!spoilt) {
      EXPECT_EQ(drive->alarm(), "") << seed;
      EXPECT_NEAR(deepest, -8, 1e-3) << seed;
    }
  }
  if (count < 60) return;
  EXPECT_GT(made, 10u);
  EXPECT_GT(failed, 1000u);
  EXPECT_GT(drawn, 1000u);
}

}  // namespace
}  // namespace nc::test
