// SPDX-License-Identifier: Apache-2.0
// Acceleration after interpolation, S-pattern filters and radius compensation on the machine, one promise per test (M700 7.7, 7.9, 13.15).
#include <gtest/gtest.h>

#include "dialect/m700/accuracy.hpp"
#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kCycle = 0.001;

AxisVec xyz(double x, double y, double z) {
  AxisVec a;
  a[0] = x, a[1] = y, a[2] = z;
  return a;
}

ExecutorConfig filtered_config() {
  ExecutorConfig c = standard_config();
  c.filters = true;
  for (unsigned i = 0; i < 3; ++i) c.limits[i] = {400, 400, 5000, 0, 0.01};
  return c;
}

FilterTimes after(unsigned linear, double exponential_s = 0, bool one_way = false) {
  FilterTimes times;
  times.kind = FilterTimes::Kind::after;
  times.one_way = one_way;
  for (unsigned i = 0; i < kMaxAxes; ++i) times.mean[i] = static_cast<uint16_t>(linear), times.lag_s[i] = static_cast<float>(exponential_s);
  return times;
}

FilterTimes before(unsigned first, unsigned second) {
  FilterTimes times;
  times.kind = FilterTimes::Kind::before;
  for (uint16_t& mean : times.mean) mean = static_cast<uint16_t>(first);
  times.second = static_cast<uint16_t>(second);
  return times;
}

/// All commanded places from the start to the end of the program.
std::vector<AxisVec> course(Machine& m, const Program& p) {
  std::vector<AxisVec> all;
  m.feed(p);
  m.start();
  EXPECT_TRUE(m.until(p, [&] {
    all.push_back(m.command());
    return m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained();
  }));
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  return all;
}

/// Seconds up to the last motion of an axis.
double moving_s(const std::vector<AxisVec>& places) {
  size_t last = 0;
  for (size_t n = 1; n < places.size(); ++n)
    if (!(places[n] == places[n - 1])) last = n;
  return static_cast<double>(last + 1) * kCycle;
}

TEST(Filtered, BlockTakesItsLengthAndTheConstant) {  // L/F + T: the path has no acceleration of its own
  for (const auto& [times, check_s] : {std::pair{after(100), 0.1}, std::pair{after(0, 0.05), 0.1}, std::pair{after(100, 0.05), 0.2}}) {
    Program p(filtered_config());
    p.line(xyz(100, 0, 0), 50).filter = times;
    p.mark();
    p.end();
    Machine m(filtered_config());
    const std::vector<AxisVec> places = course(m, p);
    EXPECT_NEAR(moving_s(places), 2 + check_s, 0.0021);
    EXPECT_EQ(places.back()[0], 100);
  }
}

TEST(Filtered, RiseIsThatOfTheFormula) {
  Program p(filtered_config());
  p.line(xyz(100, 0, 0), 50).filter = after(80, 0.03);
  p.mark();
  p.end();
  Machine m(filtered_config());
  m.feed(p);
  m.start();
  for (double t = 1; t < 400; ++t) {
    ASSERT_NEAR(m.out.velocity.v[0] / 50, m700::combined_rise(t - 0.5, 80, 30), 1e-3) << t;
    m.cycle();
  }
}

double nearest(const std::vector<AxisVec>& places, const AxisVec& point) {
  double best = 1e9;
  for (const AxisVec& at : places) best = std::min(best, std::hypot(at[0] - point[0], at[1] - point[1]));
  return best;
}

TEST(Filtered, CornerIsRoundedAndAnExactStopIsNot) {  // 7.7 figures 1 and 2
  const auto run = [](bool exact, std::vector<AxisVec>* places) {
    Program p(filtered_config());
    Segment& first = p.line(xyz(50, 0, 0), 50);
    first.filter = after(100);
    first.exact_stop = exact;
    p.mark();
    p.line(xyz(50, 50, 0), 50).filter = after(100);
    p.mark();
    p.end();
    Machine m(filtered_config());
    *places = course(m, p);
    return moving_s(*places);
  };
  std::vector<AxisVec> rounded, exact;
  const double fast = run(false, &rounded), slow = run(true, &exact);
  EXPECT_NEAR(fast, 2.1, 0.0021);
  EXPECT_NEAR(slow, 2.2, 0.0031);  // the next block begins Td later
  EXPECT_LT(nearest(exact, xyz(50, 0, 0)), 1e-6);
  // Half of the time constant after the corner each axis is F T / 8 from it.
  EXPECT_NEAR(nearest(rounded, xyz(50, 0, 0)), 50 * 0.1 / 8 * std::numbers::sqrt2, 0.03);
}

TEST(Filtered, CircleComesOutAsMuchTooSmallAsTheManualSays) {  // 13.15 (2) with Tp = 0
  const double radius = 20, feed = 70;
  for (const double ts : {0.06, 0.1}) {
    for (const bool linear : {true, false}) {
      Program p(filtered_config(), xyz(radius, 0, 0));
      p.arc(0, 1, radius, 0, 8 * std::numbers::pi, feed).filter = linear ? after(static_cast<unsigned>(ts * 1000)) : after(0, ts / 2);
      p.mark();
      p.end();
      Machine m(filtered_config());
      m.executor.set_position(xyz(radius, 0, 0));
      m.feed(p);
      m.start();
      while (m.cycles < 3500) m.cycle();  // in the middle, long after the acceleration
      const double shrunk = radius - std::hypot(m.out.command.v[0], m.out.command.v[1]);
      const double wanted = linear ? m700::radius_error_linear(feed * 60, radius, {ts, 0, 0}) : m700::radius_error_exponential(feed * 60, radius, {ts / 2, 0, 0});
      EXPECT_NEAR(shrunk / wanted, 1, 0.04) << ts << (linear ? " linear" : " exponential");
    }
  }
}

/// After a deceleration check every record waits, not only a move: an M code of the next block goes out when the axes stand.
TEST(Filtered, EverythingBehindACheckWaits) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.rapid(xyz(30, 0, 0)).filter = after(100, 0, true);
  p.mark();
  p.action(NC_ACTION_M, 8);
  p.gate(NC_GATE_FIN);
  p.mark();
  p.rapid(xyz(0, 0, 0)).filter = after(100, 0, true);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.strobe != 0; }));
  EXPECT_EQ(m.out.command.v[0], 30);
  EXPECT_EQ(m.out.velocity.v[0], 0);
  EXPECT_NEAR(static_cast<double>(m.cycles) * kCycle, 30 / 400.0 + 0.1, 0.004);
  ASSERT_TRUE(m.run_to_end(p));
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

/// A code for which the program waits goes out when the axes stand at its block, also after a cutting move; one without waiting goes out in motion.
TEST(Filtered, CodesGoOutWhenTheAxesStandWhereThePathRestsForThem) {
  const ExecutorConfig c = filtered_config();
  for (const bool awaited : {true, false}) {
    Program p(c);
    p.line(xyz(20, 0, 0), 50).filter = after(100);
    p.mark();
    p.action(NC_ACTION_M, 8);
    if (awaited) p.gate(NC_GATE_FIN);
    p.mark();
    p.line(xyz(40, 0, 0), 50).filter = after(100);
    p.mark();
    p.end();
    Machine m(c);
    m.feed(p);
    m.start();
    ASSERT_TRUE(m.until(p, [&] { return m.out.strobe != 0; }));
    EXPECT_NEAR(m.out.command.v[0], awaited ? 20 : 20 - 50 * 0.1 / 2, awaited ? 0 : 0.06);
    EXPECT_NEAR(m.out.velocity.v[0], awaited ? 0 : 50, 1e-6);
  }
}

TEST(Filtered, RapidSpeedIsWhatTheConstantAllows) {  // A T, from rest to rest; a cut of any shape A T / 2
  ExecutorConfig c = filtered_config();
  Program p(c);
  p.rapid(xyz(60, 0, 0)).filter = after(40, 0, true);
  p.mark();
  p.line(xyz(0, 0, 0), 300).filter = after(40);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  double rapid = 0, cut = 0;
  ASSERT_TRUE(m.until(p, [&] {
    rapid = std::max(rapid, m.out.velocity.v[0]);
    cut = std::max(cut, -m.out.velocity.v[0]);
    return m.out.state == NC_STATE_IDLE;
  }));
  EXPECT_NEAR(rapid, 5000 * 0.04, 1e-6);
  EXPECT_NEAR(cut, 5000 * 0.04 / 2, 1e-6);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
  EXPECT_NEAR(m.checker.worst_acceleration, 1, 0.001);
}

TEST(Filtered, HoldStopsThePathAndTheAxesDrain) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(100, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 40; }));
  const double at = m.out.command.v[0];
  m.in.feed_hold = true;
  m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_HOLD);
  EXPECT_GT(m.out.feed_mm_min, 2500);  // the feed of the axes, not of the path
  EXPECT_GT(m.out.distance_to_go.v[0], 0);
  unsigned still = 0;
  while (!m.still() && still < 500) m.cycle(), ++still;
  EXPECT_NEAR(still, 100, 2);
  EXPECT_NEAR(m.out.command.v[0], at + 50 * 0.1 / 2, 0.06);
  EXPECT_EQ(m.out.feed_mm_min, 0);
  m.in.feed_hold = false;
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_IDLE; }));
  EXPECT_EQ(m.out.command.v[0], 100);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Filtered, ResetIsDoneWhenTheAxesStand) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(100, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 40; }));
  const uint32_t epoch = m.epoch();
  m.reset();
  unsigned n = 0;
  for (; m.epoch() == epoch && n < 500; ++n) {
    EXPECT_FALSE(m.out.manual_allowed);
    m.cycle();
  }
  EXPECT_NEAR(n, 100, 3);
  EXPECT_TRUE(m.still());
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.executor.commanded()[0], m.out.command.v[0]);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Filtered, ManualMotionHasItsOwnAcceleration) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(20, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  ASSERT_TRUE(m.run_to_end(p));
  m.in.manual[0] = {.kind = NC_MANUAL_STEP, .velocity = 0, .distance = 10};
  unsigned n = 0;
  do m.cycle(), ++n;
  while (m.out.state == NC_STATE_MANUAL || n < 3);
  m.in.manual[0] = {};
  EXPECT_EQ(m.out.command.v[0], 30);
  EXPECT_NEAR(n * kCycle, 2 * std::sqrt(10 / 5000.0), 0.003);  // the velocity is a triangle
  m.cycle();
  Program q(c, m.command());
  q.line(xyz(0, 0, 0), 50).filter = after(100);
  q.mark();
  q.end();
  m.next = 0;
  ASSERT_TRUE(m.run_to_end(q));
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Filtered, BlockStopIsWhereTheAxesStand) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(20, 0, 0), 50).filter = after(100);
  p.mark();
  p.line(xyz(40, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  m.in.single_block = true;
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.state == NC_STATE_STOPPED; }));
  EXPECT_EQ(m.out.command.v[0], 20);
  EXPECT_TRUE(m.still());
  EXPECT_NEAR(static_cast<double>(m.cycles) * kCycle, 0.5, 0.005);  // 0.4 s and the time constant
}

TEST(Filtered, NothingIsGivenUpWhileTheAxesMove) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(100, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[0] > 40; }));
  m.in.feed_hold = true;
  for (unsigned n = 0; n < 20; ++n) m.cycle();
  Serial last = 0;
  EXPECT_FALSE(m.executor.truncate(&last));
  m.cycle();
  EXPECT_FALSE(m.executor.truncate(&last)) << "the axes move";
  for (unsigned n = 0; n < 120; ++n) m.cycle();
  EXPECT_FALSE(m.executor.truncate(&last));
  m.cycle();
  EXPECT_TRUE(m.executor.truncate(&last));
}

TEST(Filtered, SkipPositionIsThatOfTheAxes) {  // 15.5 (12): #2102
  const ExecutorConfig c = filtered_config();
  Program p(c);
  Segment& s = p.line(xyz(0, 0, -20), 40);
  s.skip = true;
  s.skip_mask = 2;
  s.filter = after(50, 0, true);
  p.mark();
  p.sync(NC_SYNC_SKIP);
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= -5; }));
  const double z = m.out.command.v[2];
  m.in.skip = 2;
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }));
  EXPECT_TRUE(w.skipped);
  EXPECT_EQ(w.skip_machine.v[2], z);
  EXPECT_NEAR(w.machine.v[2], z - 40 * 0.05 / 2, 0.05);  // and what was still in the filters
  EXPECT_EQ(w.machine.v[2], m.out.command.v[2]);
  EXPECT_TRUE(m.still());
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

TEST(Filtered, ALatchedPlaceIsTheSkipPositionWhileTheAxesDrain) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  Segment& s = p.line(xyz(0, 0, -20), 40);
  s.skip = true;
  s.skip_mask = 2;
  s.filter = after(100, 0, true);
  p.mark();
  p.sync(NC_SYNC_SKIP);
  Machine m(c);
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= -19; }));
  for (unsigned n = 0; n < 30; ++n) m.cycle();
  EXPECT_FALSE(m.still());
  m.in.skip = m.in.skip_latched = 2;
  m.in.skip_place.v[2] = -19.25;
  nc_world w{};
  ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }, 500));
  EXPECT_TRUE(w.skipped);
  EXPECT_EQ(w.skip_machine.v[2], -19.25);
}

/// The signal counts as long as the axes move: also in a hold, and after the end of the path.
TEST(Filtered, SkipSignalWhileTheAxesDrain) {
  for (const bool held : {true, false}) {
    const ExecutorConfig c = filtered_config();
    Program p(c);
    Segment& s = p.line(xyz(0, 0, -20), 40);
    s.skip = true;
    s.skip_mask = 2;
    s.filter = after(100, 0, true);
    p.mark();
    p.sync(NC_SYNC_SKIP);
    Machine m(c);
    m.feed(p);
    m.start();
    const double from = held ? -8 : -19;
    ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[2] <= from; }));
    m.in.feed_hold = held;
    for (unsigned n = 0; n < 30; ++n) m.cycle();
    EXPECT_FALSE(m.still());
    const double z = m.out.command.v[2];
    m.in.skip = 2;
    m.cycle();
    m.in.skip = 0;
    for (unsigned n = 0; n < 150; ++n) m.cycle();
    m.in.feed_hold = false;
    if (held) m.start();
    nc_world w{};
    ASSERT_TRUE(m.until(p, [&] { return m.executor.sync_reached(3, &w); }, 500)) << held;
    EXPECT_TRUE(w.skipped) << held;
    EXPECT_EQ(w.skip_machine.v[2], z) << held;
    EXPECT_EQ(w.machine.v[2], m.out.command.v[2]) << held;
    EXPECT_TRUE(held ? w.machine.v[2] > -13 : w.machine.v[2] == -20);
  }
}

TEST(Filtered, DwellBeginsWhenTheAxesStand) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  p.line(xyz(20, 0, 0), 50).filter = after(100);
  p.mark();
  p.gate(NC_GATE_DWELL_SECONDS, 0.2);
  p.mark();
  p.line(xyz(0, 0, 0), 50).filter = after(100);
  p.mark();
  p.end();
  Machine m(c);
  const std::vector<AxisVec> places = course(m, p);
  EXPECT_NEAR(moving_s(places), 0.4 + 0.1 + 0.2 + 0.4 + 0.1, 0.006);
}

// ---- before interpolation --------------------------------------------------------------------------------------------------

TEST(Filtered, HighAccuracyHasOneSlopeAndSmoothChanges) {  // 13.15 "pre-interpolation acceleration", "S-pattern filter control"
  const ExecutorConfig c = filtered_config();
  Program p(c);
  Segment& s = p.line(xyz(60, 80, 0), 100);
  s.accuracy.acceleration = 1000;
  s.filter = before(30, 20);
  p.mark();
  p.end();
  Machine m(c);
  m.feed(p);
  m.start();
  double last_v = 0, last_a = 0, most_a = 0, most_change = 0;
  ASSERT_TRUE(m.until(p, [&] {
    const double v = std::hypot(m.out.velocity.v[0], m.out.velocity.v[1]), a = (v - last_v) / kCycle;
    most_a = std::max(most_a, std::fabs(a));
    most_change = std::max(most_change, std::fabs(a - last_a));
    last_v = v, last_a = a;
    return m.out.state == NC_STATE_IDLE;
  }));
  EXPECT_NEAR(most_a, 1000, 0.01);               // not the 5000 of the axes
  EXPECT_LT(most_change, 1000 / 30.0 + 0.01);    // change in a cycle, with the longer filter
  EXPECT_NEAR(static_cast<double>(m.cycles) * kCycle, 1 + 0.1 + 0.05, 0.006);  // L/F + F/a + both filters
  EXPECT_EQ(m.out.command.v[0], 60);
}

TEST(Filtered, CornersOfHighAccuracyDoNotWaitForTheFilters) {
  const ExecutorConfig c = filtered_config();
  Program p(c);
  for (unsigned n = 0; n < 4; ++n) {
    Segment& s = p.line(xyz(n % 2 == 0 ? 10 : 0, 0, 0), 100);
    s.filter = before(100, 0);
    p.mark();
  }
  p.end();
  Machine m(c);
  const std::vector<AxisVec> places = course(m, p);
  EXPECT_NEAR(moving_s(places), 4 * (0.1 + 100 / 5000.0) + 0.1, 0.006);  // the filter time counts once, at the end
}

// ---- circular error radius compensation ------------------------------------------------------------------------------------

/// By how much the place at which the arc has turned by so many degrees lies outside the circle, mm.
double outwards(const std::vector<AxisVec>& places, double radius, double turned_deg) {
  double best = 1e9, result = 0;
  for (const AxisVec& at : places) {
    double angle = std::atan2(at[1], at[0]) * 180 / std::numbers::pi;
    if (angle < -1e-6) angle += 360;
    if (std::fabs(angle - turned_deg) < best) best = std::fabs(angle - turned_deg), result = std::hypot(at[0], at[1]) - radius;
  }
  return result;
}

std::vector<AxisVec> compensated(double sweep, double kx, double ky, Machine* m) {
  Program p(m->config, xyz(10, 0, 0));
  Segment& s = p.arc(0, 1, 10, 0, sweep, 20);
  s.round_mm[0] = static_cast<float>(kx);
  s.round_mm[1] = static_cast<float>(ky);
  p.mark();
  p.end();
  m->executor.set_position(xyz(10, 0, 0));
  return course(*m, p);
}

TEST(Rounding, FullCircle) {  // 13.15: the whole from 90 degrees on, nothing at the ends
  Machine m(filtered_config());
  const std::vector<AxisVec> places = compensated(2 * std::numbers::pi, 0.02, 0.04, &m);
  EXPECT_NEAR(outwards(places, 10, 90), 0.04, 2e-4);
  EXPECT_NEAR(outwards(places, 10, 180), 0.02, 2e-4);
  EXPECT_NEAR(outwards(places, 10, 270), 0.04, 2e-4);
  // At 45 degrees half of the compensation acts, and each axis has its squared cosine, 1/2: 0.5 (0.02 / 2 + 0.04 / 2).
  EXPECT_NEAR(outwards(places, 10, 45), 0.015, 2e-4);
  EXPECT_NEAR(outwards(places, 10, 135), 0.03, 2e-4);
  EXPECT_EQ(places.back()[0], 10);
  EXPECT_NEAR(places.back()[1], 0, 1e-12);
}

TEST(Rounding, ShortArc) {  // 60 degrees: the smaller of both shares, a third of the whole in the middle
  Machine m(filtered_config());
  const std::vector<AxisVec> places = compensated(std::numbers::pi / 3, 0.06, 0.06, &m);
  EXPECT_NEAR(outwards(places, 10, 30), 0.02, 2e-4);
  EXPECT_NEAR(outwards(places, 10, 15), 0.01, 2e-4);
  EXPECT_NEAR(outwards(places, 10, 60), 0, 2e-4);
}

/// Tangent lines and arcs of all sizes: where the compensation begins and ends, the derivative of the path has a step, perhaps during an
/// acceleration.
TEST(Rounding, KeepsTheLimitsAtTangentJoints) {
  const auto log_uniform = [](std::mt19937_64& rng, double low, double high) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(rng));
  };
  double worst = 0;
  for (uint64_t seed = 1; seed <= seeds(60, 9); ++seed) {
    std::mt19937_64 rng(seed);
    ExecutorConfig c = standard_config();
    if (seed % 3 == 0) c.cycle_s = 0.004;
    Program p(c);
    double heading = 0;
    const double k = log_uniform(rng, 0.01, 1);
    for (unsigned n = 0; n < 40; ++n) {
      const double feed = log_uniform(rng, 5, 300);
      if (rng() % 2 == 0) {
        const double length = log_uniform(rng, 0.05, 20);
        AxisVec end = p.at();
        end[0] += length * std::cos(heading);
        end[1] += length * std::sin(heading);
        p.line(end, feed);
      } else {
        const double sweep = (rng() % 2 == 0 ? 1 : -1) * log_uniform(rng, 0.1, 7);
        Segment& s = p.arc(0, 1, log_uniform(rng, 0.1, 30), heading + (sweep > 0 ? -1 : 1) * std::numbers::pi / 2, sweep, feed);
        s.round_mm[0] = static_cast<float>(k);
        s.round_mm[1] = static_cast<float>(rng() % 2 == 0 ? k : -k);
        heading += sweep;
      }
      p.mark();
    }
    p.end();
    Machine m(c);
    ASSERT_TRUE(m.run_to_end(p)) << seed;
    ASSERT_TRUE(m.checker.ok()) << seed << ": " << m.checker.report();
    worst = std::max(worst, m.checker.worst_acceleration);
  }
  EXPECT_GT(worst, 0.9);
}

TEST(Rounding, StopInsideAnArcAndResetKeepThePlace) {
  const ExecutorConfig c = filtered_config();
  Machine m(c);
  Program p(c, xyz(10, 0, 0));
  Segment& s = p.arc(0, 1, 10, 0, std::numbers::pi, 20);
  s.round_mm[0] = s.round_mm[1] = 0.05f;
  p.mark();
  p.end();
  m.executor.set_position(xyz(10, 0, 0));
  m.feed(p);
  m.start();
  ASSERT_TRUE(m.until(p, [&] { return m.out.command.v[1] > 9; }));
  m.in.feed_hold = true;
  for (unsigned n = 0; n < 50; ++n) m.cycle();
  const AxisVec held = m.command();
  EXPECT_GT(std::hypot(held[0], held[1]), 10.03);
  m.in.feed_hold = false;
  m.reset();
  for (unsigned n = 0; n < 5; ++n) m.cycle();
  EXPECT_EQ(m.out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.command(), held);
  EXPECT_EQ(m.executor.commanded(), held);
  // The next program begins where the axes are.
  Program q(c, held);
  q.line(xyz(0, 0, 0), 20);
  q.mark();
  q.end();
  m.next = 0;
  ASSERT_TRUE(m.run_to_end(q));
  EXPECT_EQ(m.out.command.v[0], 0);
  EXPECT_TRUE(m.checker.ok()) << m.checker.report();
}

}  // namespace
}  // namespace nc::test
