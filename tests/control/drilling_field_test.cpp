// SPDX-License-Identifier: Apache-2.0
// Drilled holes in the time-optimal mode with nc_config::retract_overlap: random fields, measured in every cycle by finite differences of the commanded
// positions, whatever the operator does. Every axis keeps velocity, acceleration and jerk; below R the tool does not move aside; every hole is drilled to
// its bottom at its place.
#include <gtest/gtest.h>

#include <random>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kVelocity = 250, kAcceleration = 2000, kJerk = 50000, kCycle_s = 0.001;

std::function<void(nc_config&)> drilling_machine(double overlap) {
  return [overlap](nc_config& c) {
    c.cycle_s = kCycle_s;
    c.look_ahead = 256;
    c.motion_mode = NC_MOTION_OPTIMAL;
    c.retract_overlap = overlap;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = kVelocity;
      c.system[0].axis[i].max_acceleration = kAcceleration;
      c.system[0].axis[i].max_jerk = kJerk;
    }
    c.system[0].axis[2].soft_limited = true;
    c.system[0].axis[2].soft_min = -500;
    c.system[0].axis[2].soft_max = 11;
  };
}

struct Field {
  std::string text;
  std::vector<std::pair<double, double>> holes;  ///< in their order
  double r = 0, bottom = 0;
};

/// A number with its point: without one it would count in 0.001 mm.
std::string word(double value) {
  const std::string text = brief(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

Field random_field(std::mt19937_64& rng) {
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(rng() % n); };
  const auto number = [&](double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(rng) * 1000) / 1000; };
  Field f;
  f.r = number(0, 3);
  f.bottom = -number(0.5, 6);
  const char* const codes[] = {"G81", "G82 P20", "G83 Q2.", "G73 Q1.5", "G85", "G89 P5"};
  f.text = std::string(pick(4) == 0 ? "G61" : "G64") + " G0 X0 Y0 Z10.\n" + (pick(2) == 0 ? "G98 " : "G99 ") + codes[pick(6)] + " Z" + word(f.bottom) + " R" +
           word(f.r) + " F" + brief(number(300, 4000)) + " L0\n";
  double x = 0, y = 0;
  const unsigned count = 3 + pick(5);
  for (unsigned n = 0; n < count; ++n) {
    const double step = pick(3) == 0 ? number(0.05, 2) : number(2, 40);
    const double turn = number(0, 6.28);
    x = std::round((x + step * std::cos(turn)) * 1000) / 1000;
    y = pick(3) == 0 ? y : std::round((y + step * std::sin(turn)) * 1000) / 1000;
    f.text += "X" + word(x) + " Y" + word(y) + "\n";
    f.holes.emplace_back(x, y);
  }
  f.text += "G80\nG0 Z10.\nM30";
  return f;
}

/// The largest differences of the commanded positions, divided by the limits, and what the tool does below R.
class Watch {
 public:
  void sample(const nc_outputs& out, const Field& field) {
    for (unsigned i = 0; i < 3; ++i) {
      const double x = out.command.v[i], v = (x - at_[i]) / kCycle_s, a = (v - v_[i]) / kCycle_s, j = (a - a_[i]) / kCycle_s;
      if (samples_ > 0) velocity = std::max(velocity, std::fabs(v) / kVelocity);
      if (samples_ > 1) acceleration = std::max(acceleration, std::fabs(a) / kAcceleration);
      if (samples_ > 2) jerk = std::max(jerk, std::fabs(j) / kJerk);
      if (i < 2 && samples_ > 0 && std::max(out.command.v[2], at_[2]) < field.r - 1e-9) aside = std::max(aside, std::fabs(x - at_[i]));
      v_[i] = v;
      a_[i] = a;
    }
    for (unsigned i = 0; i < 3; ++i) at_[i] = out.command.v[i];
    highest = std::max(highest, at_[2]);
    if (drilled < field.holes.size() && std::fabs(at_[2] - field.bottom) < 1e-3 && std::hypot(at_[0] - field.holes[drilled].first, at_[1] - field.holes[drilled].second) < 1e-6)
      ++drilled;
    ++samples_;
  }
  double velocity = 0, acceleration = 0, jerk = 0, aside = 0, highest = -1000;
  size_t drilled = 0;

 private:
  double at_[3] = {}, v_[3] = {}, a_[3] = {};
  unsigned samples_ = 0;
};

struct Operator {
  bool overrides = false, holds = false, single_block = false;
};

void drill(uint64_t seed, const Operator& does) {
  std::mt19937_64 rng(seed);
  const auto chance = [&](double p) { return std::uniform_real_distribution<double>(0, 1)(rng) < p; };
  const Field field = random_field(rng);
  Bench bench(NC_DIALECT_M700, drilling_machine(std::uniform_real_distribution<double>(0.05, 4)(rng)));
  bench.param("8013", "0.5").param("8012", "0.3").at(0, 0, 10);
  Drive drive(bench, field.text);
  Watch watch;
  unsigned n = 0;
  for (; n < 60000 && !drive.ended; ++n) {
    if (does.overrides && chance(0.004)) drive.in.rapid_override = chance(0.1) ? 0 : std::uniform_real_distribution<double>(0.1, 1)(rng);
    if (does.overrides && chance(0.004)) drive.in.feed_override = chance(0.1) ? 0 : std::uniform_real_distribution<double>(0.1, 2)(rng);
    if (does.holds) drive.in.feed_hold = drive.in.feed_hold ? !chance(0.05) : chance(0.01);
    if (does.holds) drive.in.interlock = drive.in.interlock ? !chance(0.05) : chance(0.002);
    if (does.single_block && chance(0.005)) drive.in.single_block = !drive.in.single_block;
    const bool waits = drive.out.state == NC_STATE_STOPPED || drive.out.state == NC_STATE_HOLD;
    drive.in.cycle_start = n == 2 || (waits && !drive.in.cycle_start && chance(0.2));
    drive.step(chance(0.7) ? 2000 : 0);
    watch.sample(drive.out, field);
  }
  EXPECT_EQ(drive.alarm(), "") << field.text;
  EXPECT_TRUE(drive.ended) << field.text;
  EXPECT_EQ(watch.drilled, field.holes.size()) << field.text;
  EXPECT_LE(watch.velocity, 1.001) << field.text;
  EXPECT_LE(watch.acceleration, 1.001) << field.text;
  EXPECT_LE(watch.jerk, 1.001) << field.text;
  EXPECT_LE(watch.aside, 1e-9) << field.text;
  EXPECT_LE(watch.highest, 11 + 1e-9) << "the limit of the stroke\n" << field.text;
}

void drill_many(uint64_t first, const Operator& does) {
  const uint64_t count = seeds(12, 3);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    drill(seed, does);
  }
}

TEST(DrillingField, KeepsTheLimits) { drill_many(1, {}); }
TEST(DrillingField, KeepsThemUnderOverrides) { drill_many(100000, {.overrides = true}); }
TEST(DrillingField, KeepsThemWhenHeld) { drill_many(200000, {.holds = true}); }
TEST(DrillingField, KeepsThemInSingleBlock) { drill_many(300000, {.single_block = true}); }
TEST(DrillingField, KeepsThemWhateverTheOperatorDoes) { drill_many(400000, {.overrides = true, .holds = true, .single_block = true}); }

double seconds(double overlap, const char* head) {
  Bench bench(NC_DIALECT_M700, drilling_machine(overlap));
  bench.at(0, 0, 10);
  std::string text = std::string(head) + " G0 Z1.\nG99 G81 Z-6. R1. F1500";
  for (unsigned n = 0; n < 12; ++n) text += "\nX" + word(12. * n);
  Drive drive(bench, text + "\nG80\nM30");
  unsigned cycles = 0;
  for (; cycles < 100000 && !drive.ended; ++cycles) {
    drive.in.cycle_start = cycles == 2;
    drive.step(5000);
  }
  return cycles * kCycle_s;
}

TEST(DrillingField, TakesLessTimeAndOnlyWhereItIsAskedFor) {
  const double plain = seconds(0, "G64");
  EXPECT_LT(seconds(0.5, "G64"), plain - 0.1) << "twelve holes";
  EXPECT_NEAR(seconds(2, "G61"), seconds(0, "G61"), 1e-9) << "exact stops";
}

/// Cycles in which the axes still move behind a hold in cycle `press`.
unsigned moves_on(unsigned press, unsigned units, double overlap) {
  Bench bench(NC_DIALECT_M700, drilling_machine(overlap));
  bench.at(0, 0, 1);
  Drive drive(bench, "G64 G0 X0 Y0 Z1.\nG99 G81 Z-3. R1. F3000 L0\nX8. Y7.\nX16. Y5.\nX24. Y17.\nX32. Y20.\nG80\nM30");
  for (unsigned n = 0; n < press; ++n) {
    drive.in.cycle_start = n == 2;
    drive.step(units);
  }
  EXPECT_FALSE(drive.ended);
  drive.in.feed_hold = true;
  unsigned moved = 0;
  nc_axes before = drive.out.command;
  for (unsigned n = 1; n < 600; ++n) {
    drive.step(units);
    for (unsigned i = 0; i < 3; ++i)
      if (drive.out.command.v[i] != before.v[i]) moved = n;
    before = drive.out.command;
  }
  return moved;
}

/// A feeder that has 0.6 to 2 million instructions for each cycle takes some cycles for each law that it tries. What it finds has to begin where the axes have not been yet,
/// a way to rest of the scan must not be one that waits for the next hole, and where there was no time to look for the shortest stop it is looked for on the way. So a hold
/// takes no longer than on other paths, and not up to the bottom of that hole.
TEST(DrillingField, AHoldIsNotWaitedForUpToTheNextHole) {
  struct Slow {
    unsigned units, longest;  // cycles of 1 ms
  };
  const unsigned step = sanitized() ? 97 : 13;
  for (const Slow slow : {Slow{30, 300}, Slow{50, 260}, Slow{100, 250}})
    for (const double overlap : {0.3, 1.0})
      for (unsigned press = 390; press < 1290; press += step)
        EXPECT_LE(moves_on(press, slow.units, overlap), slow.longest) << "pressed in cycle " << press << ", retract_overlap " << overlap << ", " << slow.units << " units";
}

/// M700 13.1.1, G84: a hold on the way in takes the tap to rest in front of its thread, or acts behind the way back. Pressed in each cycle of the way to the tap.
TEST(DrillingField, AHoldNeverRestsInTheThreadOfATap) {
  constexpr double kR = 0.5;
  unsigned rests = 0;
  bool ended = false;
  for (unsigned press = 600; !ended; press += 3) {
    Bench bench(NC_DIALECT_M700, drilling_machine(1));
    bench.at(0, 0, 10);
    Drive drive(bench, "S500 M3\nG64 G0 Z1.\nG99 G81 X0 Z-3. R0.5 F3000\nG84 X20. Z-4. R0.5 F1500 ,R0\nX40.\nG80\nM30");
    unsigned n = 0;
    for (; n < press && !drive.ended; ++n) {
      drive.in.cycle_start = n == 2;
      drive.step(5000);
    }
    ended = drive.ended;
    drive.in.feed_hold = true;
    while (!drive.ended && drive.out.state != NC_STATE_HOLD && n++ < 60000) drive.step(5000);
    if (drive.ended || drive.out.command.v[0] < 20 - 1e-6) continue;
    ++rests;
    EXPECT_GE(drive.out.command.v[2], kR - 1e-9) << "pressed in cycle " << press << ", at X" << drive.out.command.v[0];
  }
  EXPECT_GT(rests, 50u);
}

}  // namespace
}  // namespace nc::test
