// SPDX-License-Identifier: Apache-2.0
// Synchronous taps (M700 13.1.1) at random machines with an operator who overrides, holds, resets, jogs, draws the tap out, switches single block on and off, and
// with power cuts. In each cycle: while the tap is below R, the place of its axis is that of its thread, which is what the angle of the spindle says since
// the tap went in, whatever has happened between; nothing moves aside; a hold does not leave it there; its axis keeps velocity and acceleration; and no program
// begins. A hole that is made is as deep as it was programmed, to a quarter of a turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "online_helpers.hpp"
#include "real_spindle.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kTop = 10, kR = 2, kVelocity = 150;
constexpr double kOut = 3e-3;  ///< mm: what is no deeper below R is out of its hole: 1 um beside, 1 um that it is carried on, and rounding

/// What a session is drawn of.
struct Draw {
  std::mt19937_64 random;
  bool chance(double p) { return uniform(0, 1) < p; }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  unsigned pick(unsigned n) { return static_cast<unsigned>(random() % n); }
  double rounded(double low, double high, double to) { return std::round(uniform(low, high) / to) * to; }
};

std::string word(double value) {
  const std::string text = brief(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

struct Machine {
  bool optimal = false;
  double cycle_s = 0.001, acceleration = 1000;
  double ramp_rev_s2 = 25, lag_s = 0.02;  ///< of the spindle
};

struct Hole {
  unsigned line = 0;
  double bottom = 0, lead = 0, hand = 0;
};

struct Part {
  std::string text;
  unsigned axis = 2;  ///< that drills
  std::vector<Hole> holes;
};

Part random_part(Draw& draw) {
  const char* const planes[] = {"G19", "G18", "G17"};
  const char letters[] = "XYZ";
  Part part;
  part.axis = draw.pick(3);
  const char drills = letters[part.axis], aside = letters[(part.axis + 1) % 3];
  part.text = std::string(planes[part.axis]) + " G90 G94 G0 " + drills + word(kTop) + "\n" + aside + "0.\n";
  const unsigned count = 1 + draw.pick(3);
  for (unsigned n = 0; n < count; ++n) {
    Hole hole;
    hole.line = 3 + n;
    hole.bottom = -draw.rounded(1, 8, 0.5);
    hole.lead = draw.rounded(0.5, 2.5, 0.25);
    hole.hand = draw.chance(0.3) ? -1 : 1;
    std::string block = std::string(draw.chance(0.5) ? "G98 " : "G99 ") + (hole.hand > 0 ? "G84 " : "G74 ") + aside + word(5. * n + 5) + " " + drills + word(hole.bottom) + " R" + word(kR);
    block += " S" + std::to_string(100 * (2 + draw.pick(9))) + " F" + word(hole.lead) + " ,R1";
    if (draw.chance(0.3)) block += " ,S" + std::to_string(100 * (2 + draw.pick(12)));
    if (draw.chance(0.3)) block += " Q" + word(draw.rounded(1, 4, 0.5));
    if (draw.chance(0.3)) block += " P" + std::to_string(10 * draw.pick(20));
    part.text += block + "\n";
    part.holes.push_back(hole);
  }
  if (draw.chance(0.4)) {  // M700 13.2: places of a pattern, each with the tap that is in force
    Hole hole = part.holes.back();
    hole.line = 3 + count;
    const std::string many = std::to_string(1 + draw.pick(3)), radius = word(draw.rounded(2, 9, 0.5));
    const std::string patterns[] = {"G34 " + std::string(1, aside) + "20. I" + radius + " J30. K" + many, "G35 I" + radius + " J0. K" + many, "G36 I" + radius + " J0. P40. K" + many, "G37.1 I" + radius + " P2 J-3. K" + many};
    part.text += patterns[draw.pick(4)] + "\n";
    part.holes.push_back(hole);
  }
  part.text += "G80\nM30";
  return part;
}

class Session {
 public:
  Session(uint64_t seed, bool optimal) : draw_{std::mt19937_64(seed)}, machine_(random_machine(draw_, optimal)), part_(random_part(draw_)), spindle_(machine_.ramp_rev_s2, machine_.lag_s, machine_.cycle_s) {
    percent_ = std::to_string(draw_.chance(0.5) ? 0 : 50 + 10 * draw_.pick(15));
    back_to_r_ = draw_.chance(0.5);
    if (std::getenv("NC_LOG") != nullptr) std::printf("cycle %g acceleration %g ramp %g lag %g\n", machine_.cycle_s, machine_.acceleration, machine_.ramp_rev_s2, machine_.lag_s);
    power_on({0, 0, 0});
    load();
  }

  /// "" = all was as it should be.
  std::string run() {
    const unsigned most = static_cast<unsigned>(120 / machine_.cycle_s);
    for (unsigned n = 0; n < most && !drive_->ended && wrong_.empty(); ++n) {
      operate(n);
      cycle();
    }
    if (wrong_.empty() && !drive_->ended) wrong_ = "the program does not end: state " + std::to_string(drive_->out.state) + " cause " + std::to_string(drive_->out.cause) + " " + drive_->alarm();
    return wrong_.empty() ? "" : wrong_ + "\n" + part_.text;
  }
  unsigned resets = 0, cuts = 0, retracts = 0, made = 0;

 private:
  static Machine random_machine(Draw& draw, bool optimal) {
    const double cycles[] = {0.001, 0.002, 0.004};
    Machine m;
    m.optimal = optimal;
    m.cycle_s = cycles[draw.pick(3)];
    m.acceleration = draw.uniform(500, 3000);
    m.ramp_rev_s2 = draw.uniform(15, 60);
    m.lag_s = draw.uniform(0.005, 0.03);
    return m;
  }

  void power_on(const std::array<double, 3>& place) {
    bench_ = std::make_unique<Bench>(NC_DIALECT_M700, [this](nc_config& c) {
      c.cycle_s = machine_.cycle_s;
      c.look_ahead = 256;
      for (unsigned i = 0; i < 3; ++i) {
        c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = kVelocity;
        c.system[0].axis[i].max_acceleration = machine_.acceleration;
        c.system[0].axis[i].max_jerk = machine_.optimal ? 100 * machine_.acceleration : 0;
      }
      if (machine_.optimal) c.motion_mode = NC_MOTION_OPTIMAL;
    });
    // Each stage of acceleration has four fifths of what the motor can do.
    const double slope = 0.8 * machine_.ramp_rev_s2;
    const auto ms = [&](double rev_min) { return std::to_string(static_cast<int>(std::ceil(rev_min / 60 / slope * 1000))); };
    bench_->param("3013", "600").param("3017", ms(600).c_str()).param("3037", "1000").param("3041", ms(400).c_str()).param("3005", "3000").param("3045", ms(2000).c_str());
    bench_->param("8018", "0.5").param("1172", percent_.c_str()).param("1272", back_to_r_ ? "16" : "0");
    bench_->at(place[0], place[1], place[2]);
  }
  void load() {
    drive_ = std::make_unique<Drive>(*bench_, part_.text);
    fresh_ = true;
    read();
  }

  double place() const { return drive_->out.command.v[part_.axis]; }
  bool in_hole() const { return known_ && place() < kR - kOut; }
  const Hole& hole() const { return part_.holes[hole_]; }
  double at_beside() const { return place() - (thread_ - hole().hand * hole().lead * spindle_.turns()); }

  void operate(unsigned n) {
    nc_inputs& in = drive_->in;
    const nc_outputs& out = drive_->out;
    in.cycle_start = false;
    in.manual[part_.axis] = {};
    const double dt = machine_.cycle_s;
    if (draw_.chance(2 * dt)) in.feed_override = draw_.chance(0.2) ? 0 : draw_.uniform(0.3, 2);
    if (draw_.chance(2 * dt)) in.rapid_override = draw_.uniform(0.1, 1);
    if (in.feed_override == 0 && draw_.chance(10 * dt)) in.feed_override = 1;
    in.feed_hold = in.feed_hold ? !draw_.chance(20 * dt) : draw_.chance(dt);
    in.interlock = in.interlock ? !draw_.chance(20 * dt) : draw_.chance(0.3 * dt);
    if (draw_.chance(0.5 * dt)) in.single_block = !in.single_block;
    in.reset = in.reset ? !draw_.chance(50 * dt) : draw_.chance((in_hole() ? 0.5 : 0.02) * dt) && resets < 6;
    if (in.reset) ++resets;
    if (in_hole() && cuts < 3 && draw_.chance(0.3 * dt)) return cut_power();
    if (out.tap_retract_possible && out.state != NC_STATE_RUNNING) {
      if (draw_.chance(4 * dt)) in.tap_retract = !in.tap_retract;
      if (in.tap_retract) ++retracts;
      by_hand_ = !in.tap_retract && (by_hand_ ? !draw_.chance(3 * dt) : draw_.chance(0.5 * dt));
      if (by_hand_) in.manual[part_.axis] = {NC_MANUAL_JOG, 4, 0};
    } else {
      in.tap_retract = false;
      by_hand_ = false;
    }
    const bool waits = out.state == NC_STATE_STOPPED || out.state == NC_STATE_HOLD || out.state == NC_STATE_IDLE;
    if (n > 2 && waits && draw_.chance(20 * dt)) in.cycle_start = true;
  }

  /// The machine goes dark in the middle of a hole; what the host has kept of the tap is there again.
  void cut_power() {
    ++cuts;
    nc_tap tap = NC_INIT(nc_tap);
    if (nc_tap_get(bench_->control(), 0, &tap) != NC_OK) return fail("nc_tap_get", 0, 0);
    const nc_axes& at = drive_->out.command;
    const std::array<double, 3> stands{at.v[0], at.v[1], at.v[2]};
    spindle_.power_cut();
    thread_ = place() + hole().hand * hole().lead * spindle_.turns();  // both stand where they have come to
    drive_.reset();
    power_on(stands);
    if (nc_tap_set(bench_->control(), 0, &tap) != NC_OK) return fail("nc_tap_set", 0, 0);
    load();
  }

  void read() { spindle_.show(drive_->in); }

  void cycle() {
    if (!wrong_.empty()) return;
    drive_->step(draw_.chance(0.8) ? 50 : 0);  // the feeder is late now and then
    const bool taken = spindle_.taken();
    const double turns = spindle_.turns();
    spindle_.step(drive_->out);
    if (spindle_.taken() && !taken && !in_hole()) begin_hole(turns);
    read();
    watch();
    if (std::getenv("NC_LOG") != nullptr) log();
  }

  void log() const {
    const nc_inputs& in = drive_->in;
    const nc_outputs& out = drive_->out;
    std::printf("%u state %d cause %d line %u place %.6f turns %.6f commanded %.7f synchronous %d tapping %d possible %d holds %d | start %d hold %d interlock %d reset %d retract %d jog %d single %d feed %.2f | apart %.6f changed %.6f\n", drive_->cycle, out.state,
                out.cause, out.source.line, place(), spindle_.turns(), out.spindle_turns, out.spindle_synchronous, out.tapping, out.tap_retract_possible, out.tap_holds, in.cycle_start, in.feed_hold, in.interlock, in.reset,
                in.tap_retract, by_hand_, in.single_block, in.feed_override, at_beside(), hole().lead * spindle_.behind_changed());
  }

  /// The spindle goes with a tap that stands at R: from here on both are in one thread.
  void begin_hole(double turns) {
    for (unsigned i = 0; i < part_.holes.size(); ++i)
      if (part_.holes[i].line == drive_->out.source.line) hole_ = i;
    known_ = true;
    broken_ = false;
    thread_ = kR + hole().hand * hole().lead * turns;
    deepest_ = kTop;
    for (unsigned i = 0; i < 3; ++i) over_[i] = drive_->out.command.v[i];
  }

  void watch() {
    const nc_outputs& out = drive_->out;
    const double dt = machine_.cycle_s, at = place();
    if (!fresh_) {
      const double v = (at - last_) / dt, a = (v - velocity_) / dt;
      if (std::fabs(v) > kVelocity * 1.001) fail("velocity", v, kVelocity);
      if (std::fabs(a) > machine_.acceleration * 1.001) fail("acceleration", a, machine_.acceleration);
      velocity_ = v;
    } else {
      velocity_ = 0;
    }
    fresh_ = false;
    last_ = at;
    if (out.state == NC_STATE_ALARM) fail("alarm " + drive_->alarm(), at, spindle_.turns());
    broken_ = broken_ || drive_->in.reset || drive_->cycle < 3;
    if (!in_hole()) {
      if (known_ && deepest_ < kR && (out.spindle_synchronous & 1) == 0) finish_hole();
      return;
    }
    deepest_ = std::min(deepest_, at);
    // The axis follows what the spindle was behind its command a cycle ago. That changes in a cycle by the lag times the acceleration, and by a quarter more while
    // the acceleration changes.
    const double beside = std::fabs(at - (thread_ - hole().hand * hole().lead * spindle_.turns()));
    const double changes = 1.25 * std::max({machine_.ramp_rev_s2 * machine_.lag_s * dt, spindle_.behind_changed(), changed_});
    changed_ = spindle_.behind_changed();
    worst = std::max(worst, beside);
    if (beside > 1e-3 + hole().lead * changes) fail("beside the thread", beside, 1e-3 + hole().lead * changes);
    if (spindle_.behind_changed() > 2 * machine_.ramp_rev_s2 * machine_.lag_s * dt + 1e-6) fail("the spindle is asked for more than it can", changes, machine_.ramp_rev_s2 * machine_.lag_s * dt);
    if ((out.spindle_synchronous & 1) == 0 && drive_->cycle > 2) fail("the spindle is let go in the hole", at, 0);
    for (unsigned i = 0; i < 3; ++i)
      if (i != part_.axis && std::fabs(out.command.v[i] - over_[i]) > 1e-9) fail("moves aside in the hole", out.command.v[i], over_[i]);
    if (out.state == NC_STATE_HOLD || out.state == NC_STATE_STOPPED) fail("stops in the hole", at, out.state);
    if (broken_ && out.state == NC_STATE_RUNNING && drive_->in.cycle_start) fail("a program begins in the hole", at, 0);
  }

  /// The spindle is let go: unless something was given up the hole is as deep as it was programmed.
  void finish_hole() {
    ++made;
    if (!broken_ && std::fabs(deepest_ - hole().bottom) > 0.25 * hole().lead) fail("depth", deepest_, hole().bottom);
    deepest_ = kTop;
    broken_ = false;
  }

  void fail(const std::string& what, double value, double limit) {
    if (wrong_.empty()) wrong_ = what + " " + brief(value) + " (" + brief(limit) + ") in cycle " + std::to_string(drive_ ? drive_->cycle : 0) + ", place " + brief(last_) + ", state " + std::to_string(drive_ ? drive_->out.state : 0);
  }

 public:
  double worst = 0;  ///< mm beside the thread

 private:
  Draw draw_;
  Machine machine_;
  Part part_;
  RealSpindle spindle_;
  std::string percent_;
  bool back_to_r_ = false;
  std::unique_ptr<Bench> bench_;
  std::unique_ptr<Drive> drive_;
  std::string wrong_;
  unsigned hole_ = 0;
  bool known_ = false, broken_ = false, by_hand_ = false, fresh_ = true;
  double thread_ = 0, deepest_ = kTop, over_[3] = {}, last_ = 0, velocity_ = 0, changed_ = 0;
};

void sessions(bool optimal, uint64_t first) {
  const uint64_t count = seeds(100, 6);
  unsigned resets = 0, cuts = 0, retracts = 0, made = 0;
  double worst = 0;
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    Session session(seed, optimal);
    EXPECT_EQ(session.run(), "") << "seed " << seed;
    resets += session.resets, cuts += session.cuts, retracts += session.retracts, made += session.made;
    worst = std::max(worst, session.worst);
  }
  if (std::getenv("NC_SHOW") != nullptr) std::printf("%u holes, %u cycles of reset, %u power cuts, %u cycles of retract, at most %.3g mm beside the thread\n", made, resets, cuts, retracts, worst);
  if (count < 60) return;
  EXPECT_GT(cuts, 3U) << "the sessions are not what they should be";
  EXPECT_GT(retracts, 100U);
  EXPECT_GT(made, 60U);
}

TEST(TapSession, KeepsItsThreadWhateverHappens) { sessions(false, wish("NC_FIRST_SEED", 1)); }
TEST(TapSession, KeepsItsThreadInTheTimeOptimalMode) { sessions(true, wish("NC_FIRST_SEED", 1)); }

}  // namespace
}  // namespace nc::test
