// SPDX-License-Identifier: Apache-2.0
// How soon a feed hold brings the axes to rest in the optimal mode, compared with the stop on a straight line along the tangent of the path. That
// stop is computed here, from the positions of the last cycles before the hold. bench/motion/holds does the same with whole programs.
#include <gtest/gtest.h>

#include <algorithm>

#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kFeed = 100, kAcceleration = 2000, kJerk = 50000;
constexpr uint64_t kBefore = 3000;  ///< a hold may begin in the first so many cycles of a program, and must end within so many

ExecutorConfig config_of() {
  ExecutorConfig c = standard_config();
  c.optimal = true;
  c.capacity = 4096;
  for (unsigned i = 0; i < c.axis_count; ++i) c.limits[i] = {250, 250, kAcceleration, kJerk, 0.01};
  return c;
}

/// The shortest time in which speed v and acceleration a come to 0: the acceleration goes with the full jerk to a peak, stays there for a while if
/// the peak is its limit, `most`, and goes back to 0.
double to_rest(double v, double a, double most, double jerk) {
  const double sign = v + a * std::fabs(a) / (2 * jerk) > 0 ? -1 : 1, from = sign * a, gain = -sign * v;
  double peak = std::sqrt(std::max(0.0, jerk * gain + 0.5 * from * from)), stays = 0;
  if (peak > most) {
    peak = std::max(most, from);
    stays = std::max(0.0, gain / peak - (2 * peak * peak - from * from) / (2 * jerk * peak));
  }
  return (2 * peak - from) / jerk + stays;
}

/// The time of this stop on a line along the tangent, in ms, from the positions of three cycles; negative if the axes rest.
double ideal_ms(const AxisVec& before, const AxisVec& last, const AxisVec& now, double dt) {
  double v[3], a[3], speed = 0, along = 0, most = HUGE_VAL, jerk = HUGE_VAL;
  for (unsigned i = 0; i < 3; ++i) {
    v[i] = (now[i] - last[i]) / dt;
    a[i] = (now[i] - 2 * last[i] + before[i]) / (dt * dt);
    speed += v[i] * v[i];
  }
  speed = std::sqrt(speed);
  if (!(speed > 1e-3)) return -1;
  for (unsigned i = 0; i < 3; ++i) {
    const double d = std::fabs(v[i]) / speed;
    along += a[i] * v[i] / speed;
    if (most * d > kAcceleration) most = kAcceleration / d;
    if (jerk * d > kJerk) jerk = kJerk / d;
  }
  return 1e3 * to_rest(speed, along, most, jerk);
}

/// By how many ms the axes stand later than that. Without `moved` the program had ended, or the axes rested in any case.
struct Late {
  bool moved = false, stood = false;
  double ms = 0;
};
/// Runs a program with a hold in cycle `hold`, and measures it.
Late late(const Program& program, uint64_t hold) {
  Machine m(config_of());
  m.feed(program);
  m.start();
  Late out;
  AxisVec place[3];
  double ideal = 0;
  for (uint64_t n = 0; n < hold + kBefore; ++n) {
    if (n == hold) {
      ideal = ideal_ms(place[2], place[1], place[0], m.config.cycle_s);
      if (ideal < 0 || m.out.state != NC_STATE_RUNNING) return out;
      out.moved = m.in.feed_hold = true;
    }
    m.feed(program);
    m.cycle();
    place[2] = place[1];
    place[1] = place[0];
    place[0] = m.command();
    if (n >= hold && place[0] == place[1]) {
      out.stood = true;
      out.ms = 1e3 * m.config.cycle_s * static_cast<double>(n - hold) - ideal;
      break;
    }
  }
  EXPECT_LE(std::max({m.checker.worst_velocity, m.checker.worst_acceleration, m.checker.worst_jerk}), 1.001) << "hold in cycle " << hold;
  return out;
}

struct Holds {
  std::vector<double> ms;  ///< sorted, the least first
  double quantile(double share) const { return ms[std::min(ms.size() - 1, static_cast<size_t>(share * static_cast<double>(ms.size())))]; }
};
Holds holds_in(const char* name, const Program& program, uint64_t from, uint64_t every) {
  Holds all;
  for (uint64_t n = from; n < kBefore; n += sanitized() ? 2 * every : every) {
    const Late one = late(program, n);
    if (!one.moved) continue;
    EXPECT_TRUE(one.stood) << name << ", hold in cycle " << n;
    all.ms.push_back(one.ms);
  }
  std::sort(all.ms.begin(), all.ms.end());
  EXPECT_GT(all.ms.size(), 15u) << name;
  if (!all.ms.empty()) std::printf("%s: %zu holds, later than on a line by %.1f ms, 95 %% by %.1f, the worst by %.1f\n", name, all.ms.size(), all.quantile(0.5), all.quantile(0.95), all.ms.back());
  return all;
}

Program ended(Program p) {
  p.end();
  return p;
}
void to(Program* p, double x, double y, double z, double feed) {
  AxisVec end;
  end[0] = x;
  end[1] = y;
  end[2] = z;
  p->line(end, feed);
  p->mark();
}

/// Without a bend a hold is later only by the time that the change of the plan needs: a cycle, since cells are cut where it has come to.
TEST(PlannedHold, OnAStraightLineItIsTheStopOfTheAxes) {
  Program p(config_of());
  for (unsigned n = 1; n <= 100; ++n) to(&p, n, 0.5 * n, 0, kFeed);
  const Holds all = holds_in("line", ended(p), 20, 37);
  EXPECT_LE(all.quantile(0.5), 3);
  EXPECT_LE(all.quantile(0.9), 3);
  EXPECT_LE(all.ms.back(), 12);
}

/// On these circles the curvature uses all of the axes' limits at every place.
TEST(PlannedHold, OnCirclesThatUseAllLimitsAStopIsFoundSoon) {
  Program p(config_of());
  for (unsigned n = 1; n <= 600; ++n) {
    const double angle = 2 * std::numbers::pi * n / 60;
    to(&p, 3 * std::sin(angle) + 0.01 * n, 3 * (1 - std::cos(angle)), 0, kFeed);
  }
  const Holds all = holds_in("circles", ended(p), 25, 29);
  EXPECT_LE(all.quantile(0.5), 96);
  EXPECT_LE(all.ms.back(), 118);  // seen: 111.1
}

TEST(PlannedHold, OnANoisySurfaceAStopIsFoundSoon) {
  std::mt19937_64 rng(5);
  Program p(config_of());
  for (unsigned n = 1; n <= 3000; ++n) {
    const double x = 0.05 * n;
    to(&p, x, 0, 3 * std::sin(0.6 * x) + std::uniform_real_distribution<double>(-0.001, 0.001)(rng), kFeed);
  }
  const Holds all = holds_in("surface", ended(p), 25, 29);
  EXPECT_LE(all.quantile(0.5), 45);
  EXPECT_LE(all.ms.back(), 80);
}

TEST(PlannedHold, InAWildPolylineAStopIsFoundSoon) {
  std::mt19937_64 rng(7);
  Program p(config_of());
  double heading = 0, x = 0, y = 0;
  for (unsigned n = 1; n <= 400; ++n) {
    heading += std::uniform_real_distribution<double>(-1.2, 1.2)(rng);
    const double l = std::uniform_real_distribution<double>(0.05, 1)(rng);
    to(&p, x += l * std::cos(heading), y += l * std::sin(heading), 0, kFeed);
  }
  const Holds all = holds_in("polyline", ended(p), 25, 29);
  EXPECT_LE(all.quantile(0.95), 22);
  EXPECT_LE(all.ms.back(), 35);
}

/// On its way down to a sharp corner the machine uses the whole acceleration and then the whole jerk, so there is hardly another law than the one
/// that it follows up to the corner. A stop behind it has to be found all the same, and not one some rows farther on.
TEST(PlannedHold, OnTheWayDownToACornerAStopIsFoundRightBehindIt) {
  Program p(config_of());
  for (unsigned n = 1; n <= 40; ++n) {
    to(&p, n % 2 == 0 ? 0 : 12, 0.6 * (n - 1), 0, 1.5 * kFeed);
    to(&p, n % 2 == 0 ? 0 : 12, 0.6 * n, 0, 1.5 * kFeed);
  }
  const Holds all = holds_in("hatch", ended(p), 25, 29);
  EXPECT_LE(all.quantile(0.5), 20);
  EXPECT_LE(all.ms.back(), 46);
}

/// A trochoid of arcs: where one axis has turned, the circular motion leaves nothing of the jerk for a while.
TEST(PlannedHold, InATrochoidAStopIsFoundSoon) {
  Program p(config_of());
  for (unsigned n = 1; n <= 720; ++n) {
    const double angle = 2 * std::numbers::pi * n / 48;
    to(&p, 2.5 * std::sin(angle) + 0.02 * n, 2.5 * (1 - std::cos(angle)), 0, 1.5 * kFeed);
  }
  const Holds all = holds_in("trochoid", ended(p), 25, 29);
  EXPECT_LE(all.quantile(0.5), 90);
  EXPECT_LE(all.ms.back(), 124);
}

/// Two slow lines, one behind the other, that meet at `joint`.
Program joined_at(const ExecutorConfig& config, double joint) {
  Program p(config);
  to(&p, joint, 0, 0, 2);
  to(&p, 1, 0, 0, 2);
  return ended(p);
}
/// The X positions of the last cycles of a hold that begins in cycle `hold`; from there on the feeder is not called.
std::vector<double> held_silently(Machine* m, const Program& p, uint64_t hold) {
  m->feed(p);
  m->start();
  while (m->cycles < hold) {
    m->feed(p);
    m->cycle();
  }
  m->in.feed_hold = true;
  std::vector<double> x;
  for (unsigned n = 0; n < 40; ++n) {
    m->cycle();
    if (x.empty() || m->command()[0] != x.back()) x.push_back(m->command()[0]);
  }
  m->in.feed_hold = false;
  return x;
}

// The stop that the scan makes by itself may pass the end of a line in its last cycle: then that line is executed, the next one has begun, and the
// program goes on in the next one.
TEST(PlannedHold, EndsInTheMoveInWhichTheAxesStand) {
  ExecutorConfig c = config_of();
  c.cycle_s = 0.004;
  c.tolerance = 0;
  unsigned passed = 0;
  for (uint64_t hold = 30; hold < 60; ++hold) {
    Machine any(c);
    const std::vector<double> x = held_silently(&any, joined_at(c, 0.9), hold);
    ASSERT_GT(x.size(), 2u);
    const double joint = (x.back() + x[x.size() - 2]) / 2;
    const Program p = joined_at(c, joint);
    Machine m(c);
    const double stop = held_silently(&m, p, hold).back();
    ASSERT_EQ(m.out.state, NC_STATE_HOLD);
    passed += stop > joint + 2e-6 ? 1 : 0;
    EXPECT_EQ(m.out.source.line, stop > joint ? 2u : 1u) << "hold in cycle " << hold;
    ASSERT_FALSE(m.events.empty());
    EXPECT_EQ(m.events[0].machine.v[0], joint) << "it has been executed to its end";
    m.in.cycle_start = true;
    nc_source where;
    for (unsigned n = 0; n < 500 && m.out.state != NC_STATE_IDLE; ++n) {
      m.feed(p);
      m.cycle();
      ASSERT_FALSE(m.executor.faulted(&where)) << "hold in cycle " << hold << " at X" << stop;
    }
    EXPECT_EQ(m.out.state, NC_STATE_IDLE);
    EXPECT_NEAR(m.command()[0], 1, 1e-9);
    EXPECT_TRUE(m.checker.ok()) << m.checker.report();
    for (size_t n = 0; n < m.events.size(); ++n) EXPECT_EQ(m.events[n].serial, n + 1);
  }
  EXPECT_GT(passed, 5u);
}

}  // namespace
}  // namespace nc::test
