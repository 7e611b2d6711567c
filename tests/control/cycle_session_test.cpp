// SPDX-License-Identifier: Apache-2.0
// Every fixed cycle and pattern of M700 13.1 and 13.2 at random machines, with both laws and with retract_overlap, under an operator who overrides from 0 to 200 %,
// holds, locks, goes block by block, resets amid a hole, draws the tool out by hand and begins anew, while the machine answers M codes late. Measured in every cycle:
// the axes keep their limits; below R nothing moves aside, but on the circle of G75 and beside the hole while the spindle is oriented; the spindle turns as the
// stroke wants it; no hold stands in the thread of a tap; and every hole is made to its bottom, once and in order. Synchronous taps have tests of their own
// (tap_session_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kInitialLevel = 10, kLevelR = 2, kFastest = 150, kUnderR = kLevelR - 1e-6;
constexpr double kInACycle = 0.03;  ///< mm: it may turn back within a cycle
constexpr double kRoundedBy = 0.0101;  ///< mm: between the half circles and the circle
constexpr double kDegree = std::numbers::pi / 180, kAtHole = 1e-5;  ///< mm
constexpr double kCircle = 3;  // Q5 and an offset of 2

struct MadeHole {
  int code = 0;
  double x = 0, y = 0, bottom = 0;
};

struct DrilledPart {
  std::string text;
  std::vector<MadeHole> holes;      ///< in their order
  std::vector<int> code_of_line;    ///< the cycle of each line, 0 = none
};

std::string with_point(double value) {
  const std::string text = brief(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

class PartWriter {
 public:
  explicit PartWriter(std::mt19937_64& random) : random_(random) {
    line(pick(3) == 0 ? "G90 G94 G61 G0 Z10." : "G90 G94 G64 G0 Z10.");
    line("X0. Y0.");
    line("S600");
    line("M3");
    const unsigned blocks = 1 + pick(4);
    for (unsigned n = 0; n < blocks; ++n) cycle();
    line("G80");
    line("M30");
  }
  DrilledPart part;

 private:
  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 100) / 100; }
  void line(const std::string& block, int code = 0) {
    if (part.code_of_line.empty()) part.code_of_line.push_back(0);  // lines count from 1
    part.code_of_line.push_back(code);
    part.text += block + "\n";
  }
  void hole(int code) {
    part.holes.push_back({code, x_, y_, bottom_});
  }
  void cycle() {
    static constexpr int kCodes[] = {81, 82, 83, 73, 85, 86, 88, 89, 76, 87, 75, 84, 74};
    const int code = kCodes[pick(13)];
    const bool dwells = pick(2) == 0;
    bottom_ = code == 87 ? -9 : -number(0.5, 5);
    std::string block = std::string(pick(2) == 0 ? "G98" : "G99") + " G" + std::to_string(code);
    x_ = number(-30, 30), y_ = number(-30, 30);
    block += " X" + with_point(x_) + " Y" + with_point(y_) + " Z" + with_point(code == 87 ? -6 : bottom_) + " R" + with_point(code == 87 ? bottom_ : kLevelR);
    block += " F" + std::to_string(300 + 100 * pick(30));
    if (code == 83 || code == 73) block += " Q" + with_point(number(0.6, 3));
    if (code == 75) block += pick(2) == 0 ? " Q5. P7" : " Q-5. P7";
    if (code == 76 || code == 87) block += " I0.5 J-0.25";
    if (code == 84 || code == 74) block += " ,R0";
    if (dwells && code != 75) block += " P" + std::to_string(10 + 10 * pick(9));
    if (code == 74) line("M4");  // it goes in to the left
    if (pick(5) == 0 && code != 87) {
      block += " ,I0.2 ,J0.1";
      if (code == 75 || code == 76 || code == 86 || code == 88) block.erase(block.find(" ,I"));
    }
    line(block, code);
    hole(code);
    for (unsigned n = pick(3); n > 0; --n) next_places(code);
    if (code == 74) line("G80"), line("M3");
  }
  void next_places(int code) {
    if (pick(3) == 0 && code != 75) return pattern(code);
    const unsigned repeats = 1 + pick(2);
    if (repeats == 1) {
      x_ = number(-30, 30);
      line("X" + with_point(x_), code);
      return hole(code);
    }
    const double by = number(0.3, 9);
    line("G91 Y" + with_point(by) + " L2", code);
    for (unsigned n = 0; n < repeats; ++n) y_ += by, hole(code);
    line("G90");
  }
  /// M700 13.2: the places as the figures have them. The tool is over the last one behind it.
  void pattern(int code) {
    const double x = number(-30, 30), y = number(-30, 30), first = number(-180, 180), radius = number(2, 15);
    const int sign = pick(2) == 0 ? 1 : -1;
    const unsigned count = 1 + pick(5);
    const std::string at = " X" + with_point(x) + " Y" + with_point(y), turned = " J" + with_point(first);
    const auto on_circle = [&](double angle) { hole_at(code, x + radius * std::cos(angle * kDegree), y + radius * std::sin(angle * kDegree)); };
    switch (pick(4)) {
      case 0: {
        line("G34" + at + " I" + with_point(radius) + turned + " K" + std::to_string(sign * static_cast<int>(count)), code);
        for (unsigned n = 0; n < count; ++n) on_circle(first + sign * 360. * n / count);
        break;
      }
      case 1: {
        const double interval = sign * number(0.5, 8);
        line("G35" + at + " I" + with_point(interval) + turned + " K" + std::to_string(count), code);
        for (unsigned n = 0; n < count; ++n) hole_at(code, x + interval * n * std::cos(first * kDegree), y + interval * n * std::sin(first * kDegree));
        break;
      }
      case 2: {
        const double apart = sign * number(5, 60);
        line("G36" + at + " I" + with_point(radius) + turned + " P" + with_point(apart) + " K" + std::to_string(count), code);
        for (unsigned n = 0; n < count; ++n) on_circle(first + apart * n);
        break;
      }
      default: grid(code, at, x, y);
    }
  }
  /// Rows to and fro, as docs/decisions.md has them.
  void grid(int code, const std::string& at, double x, double y) {
    const double dx = number(0.5, 6), dy = -number(0.5, 6);
    const unsigned columns = 1 + pick(3), rows = 1 + pick(3);
    line("G37.1" + at + " I" + with_point(dx) + " P" + std::to_string(columns) + " J" + with_point(dy) + " K" + std::to_string(rows), code);
    for (unsigned row = 0; row < rows; ++row)
      for (unsigned n = 0; n < columns; ++n) hole_at(code, x + dx * (row % 2 == 0 ? n : columns - 1 - n), y + dy * row);
  }
  void hole_at(int code, double x, double y) {
    x_ = x, y_ = y;
    hole(code);
  }

  std::mt19937_64& random_;
  double x_ = 0, y_ = 0, bottom_ = 0;
};

class CycleSession {
 public:
  CycleSession(uint64_t seed, bool optimal) : random_(seed), optimal_(optimal), part_(PartWriter(random_).part) {
    const double cycles[] = {0.001, 0.002, 0.004};
    cycle_s_ = cycles[random_() % 3];
    acceleration_ = uniform(500, 3000);
    jerk_ = optimal ? uniform(20, 100) * acceleration_ : 0;
    const double overlap = optimal && chance(0.5) ? uniform(0.1, 2) : 0;
    bench_ = std::make_unique<Bench>(NC_DIALECT_M700, [&](nc_config& c) {
      c.cycle_s = cycle_s_;
      c.look_ahead = 256;
      c.retract_overlap = overlap;
      if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
      for (unsigned i = 0; i < 3; ++i) {
        c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = kFastest;
        c.system[0].axis[i].max_acceleration = acceleration_;
        c.system[0].axis[i].max_jerk = jerk_;
      }
    });
    bench_->param("8013", "0.5").param("8012", "0.3").tool(7, 2).at(0, 0, kInitialLevel);
    drive_ = std::make_unique<Drive>(*bench_, part_.text);
    drive_->fin_cycles = 1 + static_cast<unsigned>(random_() % 20);
    at_[2] = kInitialLevel;
  }

  /// "" = all was as it should be.
  std::string run() {
    const unsigned most = static_cast<unsigned>(200 / cycle_s_);
    for (unsigned n = 0; n < most && !drive_->ended && wrong_.empty(); ++n) {
      operate(n);
      drive_->step(chance(0.8) ? (slow_ ? 60 : 2000) : 0);
      watch();
    }
    if (wrong_.empty() && !drive_->ended) wrong_ = "the program does not end: state " + std::to_string(drive_->out.state) + " cause " + std::to_string(drive_->out.cause) + " " + drive_->alarm() + (broken_ ? " behind a reset" : "") + " at Z" + brief(at_[2]) + " in cycle " + std::to_string(drive_->cycle);
    if (wrong_.empty() && made_ != part_.holes.size()) wrong_ = std::to_string(made_) + " holes of " + std::to_string(part_.holes.size());
    return wrong_.empty() ? "" : wrong_ + "\n" + part_.text;
  }
  unsigned resets = 0, holds = 0;

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0, 1) < p; }

  void operate(unsigned n) {
    nc_inputs& in = drive_->in;
    const nc_outputs& out = drive_->out;
    in.cycle_start = false;
    in.manual[2] = {};
    const double dt = cycle_s_;
    if (chance(3 * dt)) in.feed_override = chance(0.2) ? 0 : uniform(0.3, 2);
    if (chance(3 * dt)) in.rapid_override = chance(0.2) ? 0 : uniform(0.1, 1);
    if (in.feed_override == 0 && chance(10 * dt)) in.feed_override = 1;
    if (in.rapid_override == 0 && chance(10 * dt)) in.rapid_override = 1;
    in.feed_hold = in.feed_hold ? !chance(15 * dt) : chance(2 * dt);
    in.interlock = in.interlock ? !chance(20 * dt) : chance(0.5 * dt);
    if (chance(dt)) in.single_block = !in.single_block;
    if (chance(dt)) slow_ = !slow_;
    in.reset = in.reset ? !chance(50 * dt) : resets < 3 && chance(0.1 * dt);
    if (in.reset && !broken_) ++resets, broken_ = true;
    jogs_ = broken_ && (out.state == NC_STATE_IDLE || out.state == NC_STATE_MANUAL) && !in.reset && at_[2] < kInitialLevel && (jogs_ ? !chance(dt) : chance(10 * dt));
    if (jogs_) in.manual[2] = {NC_MANUAL_JOG, 20, 0};
    const bool waits = out.state == NC_STATE_STOPPED || out.state == NC_STATE_HOLD || (out.state == NC_STATE_IDLE && (!broken_ || at_[2] >= kInitialLevel));
    if (n > 2 && waits && !in.reset && chance(20 * dt)) in.cycle_start = true;
    if (in.cycle_start && broken_ && out.state == NC_STATE_IDLE) begin_anew();
  }
  void begin_anew() {
    broken_ = false;
    made_ = 0;
    turning_ = 0;
  }

  void watch() {
    const nc_outputs& out = drive_->out;
    limits();
    const double z = out.command.v[2], dz = z - last_[2];
    if (out.state == NC_STATE_ALARM) fail("alarm " + drive_->alarm(), z);
    if (out.state == NC_STATE_HOLD) ++holds;
    const unsigned in_line = out.source.line;
    const int code = in_line < part_.code_of_line.size() ? part_.code_of_line[in_line] : 0;
    if (!broken_ && code != 0 && made_ < part_.holes.size()) bottom(code);
    if (std::max(z, last_[2]) < kUnderR) below(code, dz);
    const bool taps = code == 84 || code == 74;
    if (taps && z < kUnderR && (out.state == NC_STATE_HOLD || out.state == NC_STATE_STOPPED) && !broken_) fail("stands in its thread", z);
    for (unsigned i = 0; i < 3; ++i) last_[i] = out.command.v[i];
    // From the next cycle on: the strobe may come in the cycle in which the stroke before it ends.
    if ((out.strobe & ~strobe_ & 1) != 0 && (out.m == 3 || out.m == 4 || out.m == 5 || out.m == 19)) turning_ = static_cast<int>(out.m);
    strobe_ = out.strobe;
  }
  void limits() {
    if (drive_->out.state == NC_STATE_MANUAL) by_hand_ = 4;
    for (unsigned i = 0; i < 3; ++i) {
      const double x = drive_->out.command.v[i], v = (x - at_[i]) / cycle_s_, a = (v - v_[i]) / cycle_s_, j = (a - a_[i]) / cycle_s_;
      if (samples_ > 0 && std::fabs(v) > 1.001 * kFastest) fail("velocity", v);
      if (samples_ > 1 && std::fabs(a) > 1.001 * acceleration_) fail("acceleration", a);
      if (samples_ > 2 && optimal_ && by_hand_ == 0 && std::fabs(j) > 1.001 * jerk_) fail("jerk (" + brief(jerk_) + ")", j);
      at_[i] = x, v_[i] = v, a_[i] = a;
    }
    ++samples_;
    by_hand_ -= by_hand_ > 0 ? 1 : 0;
  }
  /// The next hole has come to its bottom.
  void bottom(int code) {
    const MadeHole& hole = part_.holes[made_];
    if (hole.code == code && std::fabs(at_[2] - hole.bottom) < kInACycle && std::hypot(at_[0] - hole.x, at_[1] - hole.y) < kAtHole) ++made_;
  }
  void below(int code, double dz) {
    if (code == 0 || made_ > part_.holes.size()) return;
    const bool moves_aside = std::fabs(at_[0] - last_[0]) > 1e-9 || std::fabs(at_[1] - last_[1]) > 1e-9;
    if (moves_aside && code == 75) {
      const MadeHole& hole = part_.holes[made_ - 1];
      if (std::hypot(at_[0] - hole.x, at_[1] - hole.y) > kCircle + kRoundedBy || std::fabs(at_[2] - hole.bottom) > kInACycle) fail("leaves the circle", at_[2]);
    } else if (moves_aside && ((code != 76 && code != 87) || turning_ != 19)) {
      fail("moves aside below R with M" + std::to_string(turning_), at_[2]);
    }
    if (std::fabs(dz) < 1e-9 || broken_) return;
    const bool in = dz < 0;
    int wants = 3;
    if (code == 84) wants = in ? 3 : 4;
    if (code == 74) wants = in ? 4 : 3;
    if ((code == 86 || code == 88) && !in) wants = 5;
    if (code == 76 && !in) wants = 19;
    if (code == 87) wants = over_a_hole() ? 3 : 19;
    if (turning_ != wants) fail(std::string(in ? "down" : "up") + " with M" + std::to_string(turning_) + " and not M" + std::to_string(wants) + ", G" + std::to_string(code), at_[2]);
  }
  bool over_a_hole() const {
    return std::any_of(part_.holes.begin(), part_.holes.end(), [this](const MadeHole& hole) { return std::hypot(at_[0] - hole.x, at_[1] - hole.y) < 1e-3; });
  }
  void fail(const std::string& what, double value) {
    if (wrong_.empty()) wrong_ = what + " " + brief(value) + " in cycle " + std::to_string(drive_->cycle) + " at " + brief(at_[0]) + " " + brief(at_[1]) + " " + brief(at_[2]) + ", state " + std::to_string(drive_->out.state) + (broken_ ? " behind a reset" : "") + ", line " + std::to_string(drive_->out.source.line) + ", hole " + std::to_string(made_);
  }

  std::mt19937_64 random_;
  bool optimal_ = false;
  DrilledPart part_;
  double cycle_s_ = 0, acceleration_ = 0, jerk_ = 0;
  std::unique_ptr<Bench> bench_;
  std::unique_ptr<Drive> drive_;
  std::string wrong_;
  bool broken_ = false, jogs_ = false, slow_ = false;
  int turning_ = 0;  ///< the last of M3, M4, M5 and M19
  uint8_t strobe_ = 0;
  size_t made_ = 0;
  unsigned samples_ = 0, by_hand_ = 0;  ///< cycles in which motion by hand, which has no limit of jerk, still acts on the differences
  double at_[3] = {}, v_[3] = {}, a_[3] = {}, last_[3] = {0, 0, kInitialLevel};
};

void operate_cycles(bool optimal) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(60, 5);
  unsigned resets = 0, holds = 0;
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    CycleSession session(seed, optimal);
    EXPECT_EQ(session.run(), "") << "seed " << seed;
    resets += session.resets, holds += session.holds;
  }
  if (count < 30) return;
  EXPECT_GT(resets, 3U) << "the sessions are not what they should be";
  EXPECT_GT(holds, 100U);
}

TEST(CycleOperator, KeepsEveryCycleWhateverHappens) { operate_cycles(false); }
TEST(CycleOperator, KeepsThemInTheTimeOptimalMode) { operate_cycles(true); }

}  // namespace
}  // namespace nc::test
