// SPDX-License-Identifier: Apache-2.0
// Fine boring and back boring (M700 13.1.1, G76, G87) under an operator who stops them anywhere, also amid the strokes that shift the tool aside: it stays on the
// strokes of the cycle, and is off the axis of its hole only while the spindle is oriented.
#include <gtest/gtest.h>

#include <array>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kAcceleration = 1000, kVelocity = 100, kCycle_s = 0.004;

struct Place {
  double x, y, z;
};
Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Place& a, const Place& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double apart(const Place& a, const Place& b) { return std::sqrt(dot(a - b, a - b)); }

/// How far `p` is from the line between two places.
double beside(const Place& p, const Place& from, const Place& to) {
  const Place way = to - from;
  const double length = dot(way, way);
  const double t = length > 0 ? std::clamp(dot(p - from, way) / length, 0.0, 1.0) : 0;
  return apart(p, {from.x + t * way.x, from.y + t * way.y, from.z + t * way.z});
}

// Two holes, shifted by (1, -0.5): G76 from R2 to -8, then G87 from -8 up to -4.
constexpr const char* kProgram =
    "G90 G94 G0 X0 Y0\nS600\nM3\nG99 G76 X5. Y3. Z-8. R2. I1. J-0.5 F900\nG87 X25. R-8. Z-4. I1. J-0.5 F900\nG80\nM30";
const std::array<Place, 14> kStrokes = {{{0, 0, 10}, {5, 3, 10}, {5, 3, 2}, {5, 3, -8}, {6, 2.5, -8}, {6, 2.5, 2}, {5, 3, 2},
                                         {25, 3, 2}, {26, 2.5, 2}, {26, 2.5, -8}, {25, 3, -8}, {25, 3, -4}, {26, 2.5, -4}, {26, 2.5, 10}}};
const Place kEnd = {25, 3, 10};

std::function<void(nc_config&)> boring_machine(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = kCycle_s;
    c.look_ahead = 256;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = c.system[0].axis[i].max_velocity = kVelocity;
      c.system[0].axis[i].max_acceleration = kAcceleration;
      c.system[0].axis[i].max_jerk = optimal ? 100000 : 0;
    }
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

/// What the operator does with the control, beginning in one cycle and for some.
enum class Stop { none, hold, interlock, override, reset };

class BoringHold : public testing::TestWithParam<bool> {
 protected:
  /// Runs the program with one stop; the number of cycles that it has taken.
  unsigned run(Stop stop, unsigned at, unsigned cycles) {
    Bench bench(NC_DIALECT_M700, boring_machine(GetParam()));
    bench.at(0, 0, 10);
    Drive drive(bench, kProgram);
    bool oriented = false, stopped = false;
    uint8_t strobe = 0;
    Place last = {0, 0, 10}, speed = {0, 0, 0};
    unsigned n = 0, rests = 0;
    for (; n < 20000 && !drive.ended; ++n) {
      const bool on = n >= at && n < at + cycles;
      drive.in.feed_hold = on && stop == Stop::hold;
      drive.in.interlock = on && stop == Stop::interlock;
      drive.in.feed_override = drive.in.rapid_override = on && stop == Stop::override ? 0 : 1;
      drive.in.reset = on && stop == Stop::reset;
      drive.in.cycle_start = n == 2 || (!on && stop != Stop::reset && drive.out.state == NC_STATE_HOLD && !drive.in.cycle_start);
      drive.step();
      const nc_outputs& out = drive.out;
      if ((out.strobe & ~strobe & 1) != 0) oriented = out.m == 19 || (oriented && out.m != 3);
      strobe = out.strobe;
      const Place now = {out.command.v[0], out.command.v[1], out.command.v[2]};
      judge(now, oriented, n);
      const Place moved = now - last, change = moved - speed;
      for (const double c : {change.x, change.y, change.z}) EXPECT_LE(std::fabs(c), 1.001 * kAcceleration * kCycle_s * kCycle_s) << "cycle " << n;
      stopped = stopped || (on && n > at + 5 && apart(now, last) == 0);
      rests = apart(now, last) == 0 ? rests + 1 : 0;
      last = now;
      speed = moved;
      if (stop == Stop::reset && n > at + cycles + 200) break;
      if (testing::Test::HasFailure()) return n;
    }
    if (stop == Stop::reset) {
      EXPECT_GT(rests, 100U) << "nothing moves behind a reset";
      return n;
    }
    EXPECT_TRUE(drive.ended);
    EXPECT_EQ(drive.alarm(), "");
    EXPECT_LT(apart(last, kEnd), 1e-9);
    EXPECT_EQ(stopped, stop != Stop::none);
    return n;
  }

 private:
  static void judge(const Place& p, bool oriented, unsigned cycle) {
    double off = beside(p, kStrokes.back(), kEnd);
    for (size_t i = 0; i + 1 < kStrokes.size(); ++i) off = std::min(off, beside(p, kStrokes[i], kStrokes[i + 1]));
    EXPECT_LE(off, p.z > 2.5 ? 0.01 : 1e-9) << "cycle " << cycle << ": " << p.x << " " << p.y << " " << p.z << " is on none of the strokes";
    const bool first = p.x < 15;
    const double aside = std::hypot(p.x - (first ? 5 : 25), p.y - 3);
    EXPECT_TRUE(oriented || p.z >= 2 - 1e-9 || aside <= 1e-9) << "cycle " << cycle << ": " << p.x << " " << p.y << " " << p.z << " with a spindle that turns";
  }
};

INSTANTIATE_TEST_SUITE_P(BothLaws, BoringHold, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(BoringHold, StaysOnTheStrokesWhereverItIsStopped) {
  const unsigned whole = run(Stop::none, 0, 0);
  ASSERT_FALSE(HasFailure());
  const unsigned step = sanitized() ? 41 : 5;
  for (const Stop stop : {Stop::hold, Stop::interlock, Stop::override, Stop::reset})
    for (unsigned at = 5 + static_cast<unsigned>(stop); at + 10 < whole; at += step) {
      SCOPED_TRACE("stop " + std::to_string(static_cast<int>(stop)) + " in cycle " + std::to_string(at));
      run(stop, at, 60);
      if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace nc::test
