// SPDX-License-Identifier: Apache-2.0
// Random programs of lines at any machine: feeds of 1 to 30,000 mm/min, jerk of 1e3 to 1e9, acceleration of 50 to 20,000, cycles of 0.125 to
// 4 ms, tolerances of 0 to 1 mm, 1 to 100,000 lines. They take no longer than a simple law that is made here, rest only where the geometry
// requires it, and keep the limits and the tolerance, also with a changing override, and with a hold in any cycle.
#include <gtest/gtest.h>

#include "interpolate/path_distance.hpp"
#include "interpolate/rests.hpp"
#include "interpolate/simple_law.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using line_program_detail::log_uniform;
using line_program_detail::pick;
using line_program_detail::uniform;

constexpr double kLimit = 1.001, kSlower = 1.05;
constexpr double kShownJerk = 8;   ///< times acceleration / cycle: the planner uses no more jerk, since positions once a cycle cannot show it
constexpr double kReversal = 1.99, kCorner = 1e-9;  ///< |t2 - t1| of a corner that may be a rest: with a tolerance, and without
constexpr uint64_t kMostCycles = 20000, kMostWithHolds = 250;

struct Trial {
  ExecutorConfig config;
  LineProgram lines;
  Program program{standard_config()};
  LineShape shape = LineShape::walk;
  double law_s = 0, spare_s = 0;
  unsigned rests = 0;  ///< number of rests that the geometry allows
};

ExecutorConfig random_config(std::mt19937_64& rng) {
  ExecutorConfig c = standard_config(3);
  c.optimal = true;
  const double cycles[] = {0.000125, 0.00025, 0.0005, 0.001, 0.002, 0.004};
  const uint32_t capacities[] = {16384, 1024, 256};
  c.cycle_s = cycles[pick(rng, 6)];
  c.capacity = capacities[pick(rng, 3)];
  const double a = log_uniform(rng, 50, 20000), j = log_uniform(rng, 1e3, 1e9);
  for (unsigned i = 0; i < c.axis_count; ++i) c.limits[i] = {500, 500, a, j, 0.01};
  c.tolerance = pick(rng, 8) == 0 ? 0 : pick(rng, 2) == 0 ? 0.01 : log_uniform(rng, 1e-4, 1);
  return c;
}

LineProgram many_lines(std::mt19937_64& rng, double feed) {
  LineProgram p;
  double heading = uniform(rng, -3, 3), bend = 0;
  const double step = log_uniform(rng, 0.01, 0.05);
  for (unsigned n = 0; n < 100000; ++n) {
    if (n % 50 == 0) bend = uniform(rng, -0.02, 0.02);
    heading += bend;
    p.by(step * std::cos(heading), step * std::sin(heading), feed);
  }
  return p;
}

/// The first lines of a program that together take `most_s`; if the first one alone takes longer, so much of it.
LineProgram begin_of(const LineProgram& all, double most_s) {
  LineProgram p;
  double seconds = 0;
  for (size_t k = 1; k < all.point.size(); ++k) {
    const double takes = all.length(k) / all.feed[k];
    AxisVec to = all.point[k];
    if (seconds + takes > most_s) {
      if (k > 1) break;
      for (unsigned i = 0; i < 3; ++i) to[i] *= most_s / takes;
    }
    seconds += takes;
    p.to(to[0], to[1], to[2], all.feed[k]);
  }
  return p;
}

/// The additional time for passing the corners between two feeds at the lower one, over the length that the tolerance allows for the rounding.
double lower_feeds(const LineProgram& p, double tolerance) {
  double sum = 0;
  for (size_t k = 1; k + 1 < p.point.size(); ++k) {
    const double turn = p.turn(k), fast = p.feed[k] > p.feed[k + 1] ? p.length(k) : p.length(k + 1);
    const double reach = turn > kCorner ? std::min(6 * tolerance / turn, 0.5 * fast) : 0;
    sum += reach * std::fabs(1 / p.feed[k] - 1 / p.feed[k + 1]);
  }
  return sum;
}

Trial random_trial(uint64_t seed, uint64_t most_cycles, bool many) {
  std::mt19937_64 rng(seed);
  Trial t;
  t.config = random_config(rng);
  const double feed = log_uniform(rng, 1, 30000) / 60, most_s = static_cast<double>(most_cycles) * t.config.cycle_s;
  t.shape = static_cast<LineShape>(seed % static_cast<uint64_t>(LineShape::count));
  LineProgram all = many ? many_lines(rng, std::max(feed, 50.0)) : line_program(t.shape, rng);
  if (!many && t.shape != LineShape::mixed_feeds) std::fill(all.feed.begin() + 1, all.feed.end(), feed);
  if (!many && t.shape == LineShape::mixed_feeds)
    for (size_t k = 1; k < all.feed.size(); ++k) all.feed[k] = log_uniform(rng, 1, 30000) / 60;
  t.lines = many ? all : begin_of(all, most_s);
  const AxisLimits& l = t.config.limits[0];
  const SimpleLimits limits{l.velocity, l.acceleration, std::min(l.jerk, kShownJerk * l.acceleration / t.config.cycle_s), t.config.tolerance};
  const auto simply = [&] { return SimpleLaw(limits, t.lines).seconds(); };
  for (t.law_s = simply(); !many && t.law_s > most_s && t.lines.point.size() > 2; t.law_s = simply()) {
    const size_t keep = std::max<size_t>(2, static_cast<size_t>(static_cast<double>(t.lines.point.size()) * most_s / t.law_s));
    t.lines.keep(std::min(keep, t.lines.point.size() - 1));
  }
  t.program = Program(t.config);
  for (size_t k = 1; k < t.lines.point.size(); ++k) {
    t.program.line(t.lines.point[k], t.lines.feed[k]);
    t.program.mark();
  }
  t.program.end();
  for (size_t k = 1; k + 1 < t.lines.point.size(); ++k) t.rests += t.lines.turn(k) > (t.config.tolerance > 0 ? kReversal : kCorner) ? 1u : 0u;
  t.law_s += lower_feeds(t.lines, t.config.tolerance);
  t.spare_s = (4 + t.rests) * t.config.cycle_s + 0.01;
  return t;
}

enum class Operator : uint8_t { none, turns_override, holds };

struct Seen {
  bool ended = false, alarm = false, at_end = false;
  double seconds = 0, off = 0, limits = 0;
  unsigned rests = 0;
  std::string report;
};

/// Runs from cycle start to the end. A hold begins in cycle `hold` and lasts until the axes stand.
Seen run(const Trial& t, const PathDistance& path, Operator who, uint64_t hold = 0) {
  Seen seen;
  Machine m(t.config);
  std::mt19937_64 rng(hold);
  m.feed(t.program);
  m.start();
  const uint64_t most = static_cast<uint64_t>((who == Operator::turns_override ? 20 : 3) * t.law_s / t.config.cycle_s) + 4000;
  const uint64_t feed_every = std::max<uint64_t>(1, static_cast<uint64_t>(0.004 / t.config.cycle_s));
  Rests rests(m.command());
  for (uint64_t n = 0; n < most && !seen.ended && !seen.alarm; ++n) {
    if (n % feed_every == 0) m.feed(t.program);
    if (who == Operator::turns_override && pick(rng, 300) == 0) m.in.feed_override = uniform(rng, 0.2, 2);
    if (who == Operator::holds) {
      if (n == hold) m.in.feed_hold = true;
      if (m.in.feed_hold && rests.still() > 20) m.in.feed_hold = false;
      m.in.cycle_start = m.out.state == NC_STATE_HOLD && !m.in.feed_hold && !m.in.cycle_start;
    }
    m.cycle();
    const AxisVec now = m.command();
    rests.see(now);
    if (n % 3 == 0) seen.off = std::max(seen.off, path.near(m.out.serial, now, seen.off));
    seen.alarm = m.out.state == NC_STATE_ALARM;
    seen.ended = m.out.state == NC_STATE_IDLE && m.next == t.program.records.size() && m.executor.drained();
  }
  seen.at_end = true;
  for (unsigned i = 0; i < t.config.axis_count; ++i) seen.at_end = seen.at_end && std::fabs(m.command()[i] - t.program.at()[i]) <= 1e-6;
  seen.rests = rests.count();
  seen.seconds = static_cast<double>(rests.cycles()) * t.config.cycle_s;
  seen.limits = std::max({m.checker.worst_velocity, m.checker.worst_acceleration, m.checker.worst_jerk});
  seen.report = m.checker.report();
  return seen;
}

std::string wrong_of(const Trial& t, const Seen& s, Operator who) {
  if (s.alarm) return "alarm";
  if (!s.ended) return "does not end";
  if (!s.at_end) return "ends beside its end";
  if (s.limits > kLimit) return s.report;
  if (s.off > t.config.tolerance + 1e-9) return "leaves the path by " + std::to_string(1e3 * s.off) + " um";
  if (who != Operator::holds && s.rests > t.rests) return std::to_string(s.rests) + " rests, " + std::to_string(t.rests) + " allowed";
  if (who == Operator::none && s.seconds > kSlower * t.law_s + t.spare_s) return std::to_string(s.seconds) + " s, simply " + std::to_string(t.law_s);
  return "";
}

std::string about(const Trial& t, uint64_t seed) {
  std::ostringstream s;
  s << "; seed " << seed << ": " << name_of(t.shape) << ", " << t.lines.point.size() - 1 << " lines, F" << 60 * t.lines.feed[1] << ", tolerance "
    << t.config.tolerance << ", cycle " << t.config.cycle_s << ", acceleration " << t.config.limits[0].acceleration << ", jerk "
    << t.config.limits[0].jerk << ", ring " << t.config.capacity;
  return s.str();
}

/// The number of seeds: with NC_SEEDS=10000 so many. NC_FIRST=7 begins with seed 7.
uint64_t seeds_of(uint64_t plain) {
  return seeds(plain, plain / 20 + 1);
}

void run_many(uint64_t plain, Operator who) {
  const uint64_t from = wish("NC_FIRST", 0), seeds = seeds_of(plain);
  uint64_t wrong = 0;
  double ratio = 0, limits = 0;
  for (uint64_t seed = from; seed < from + seeds; ++seed) {
    const Trial t = random_trial(seed, kMostCycles, false);
    const PathDistance path(t.program, t.config.axis_count);
    const Seen seen = run(t, path, who, seed);
    const std::string what = wrong_of(t, seen, who);
    EXPECT_EQ(what, "") << about(t, seed);
    wrong += what.empty() ? 0 : 1;
    ratio = std::max(ratio, (seen.seconds - t.spare_s) / t.law_s);
    limits = std::max(limits, seen.limits);
  }
  std::printf("%llu programs, %llu wrong: %.5f of a limit, %.3f of the simple time at most\n", static_cast<unsigned long long>(seeds),
              static_cast<unsigned long long>(wrong), limits, ratio);
}

TEST(PlannedAny, NothingIsSlowStopsOrLeavesThePath) {
  run_many(100, Operator::none);
}

TEST(PlannedAny, AnOverrideThatChangesStopsNothing) {
  run_many(60, Operator::turns_override);
}

TEST(PlannedAny, AHundredThousandLines) {
  const uint64_t from = wish("NC_FIRST", 0);
  for (uint64_t seed = from; seed < from + wish("NC_SEEDS", 1); ++seed) {
    const Trial t = random_trial(seed, kMostCycles, true);
    const PathDistance path(t.program, t.config.axis_count);
    EXPECT_EQ(wrong_of(t, run(t, path, Operator::none), Operator::none), "") << about(t, seed);
  }
}

TEST(PlannedAny, AHoldInAnyCycleKeepsTheLimits) {
  const uint64_t from = wish("NC_FIRST", 0), seeds = seeds_of(10);
  uint64_t holds = 0;
  double limits = 0;
  for (uint64_t seed = from; seed < from + seeds; ++seed) {
    const Trial t = random_trial(seed, kMostWithHolds, false);
    const PathDistance path(t.program, t.config.axis_count);
    const auto cycles = static_cast<uint64_t>(run(t, path, Operator::none).seconds / t.config.cycle_s);
    for (uint64_t hold = 1; hold < cycles; ++hold, ++holds) {
      const Seen seen = run(t, path, Operator::holds, hold);
      const std::string what = wrong_of(t, seen, Operator::holds);
      EXPECT_EQ(what, "") << "hold in cycle " << hold << about(t, seed);
      limits = std::max(limits, seen.limits);
    }
  }
  std::printf("%llu holds: %.5f of a limit\n", static_cast<unsigned long long>(holds), limits);
}

}  // namespace
}  // namespace nc::test
