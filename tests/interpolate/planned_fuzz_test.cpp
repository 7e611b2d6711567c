// SPDX-License-Identifier: Apache-2.0
// Many short programs of lines at any machine in the optimal mode, and some long ones: feeds of 1 to 30,000 mm/min that change from line to line, jerk
// of 1e3 to 1e9, acceleration of 50 to 20,000, cycles of 0.125 to 4 ms, tolerances of 0 to 1 mm, exact stops, holds in any cycle. Each takes no more than
// 1.05 of the time of a simple law (one in a thousand up to 1.25), rests only where it is programmed or the path turns back (with a tolerance of 0: at
// corners), and keeps the limits and the tolerance. The law is measured as well: it keeps what the axes have to keep.
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

constexpr double kLimit = 1.001;
// Of the time of the simple law, beyond 10 ms: what a program takes at most, and what one in a thousand may take: the curve by which the planner
// goes round corners is not always as quick as that of the law.
constexpr double kSlower = 1.05, kSlowest = 1.25, kMoreSeconds = 0.01;
constexpr uint64_t kOneSlowIn = 1000;
constexpr double kShownJerk = 8;   ///< times acceleration / cycle: the planner uses no more jerk, since positions once a cycle cannot show it
constexpr double kReversal = 2 - 1e-9, kCorner = 1e-9;  ///< |t2 - t1| of a corner that may be a rest: with a tolerance, and without
constexpr unsigned kLongOneIn = 1000;  ///< of so many programs one is long

struct Trial {
  ExecutorConfig config;
  SimpleLimits limits;
  LineProgram lines;
  Program program{standard_config()};
  double law_s = 0, law_worst = 0, spare_s = 0;
  unsigned rests = 0;  ///< number of rests that the program or its geometry allows
  bool holds = false;
  double hold_at = 0;  ///< share of the time of the law
};

ExecutorConfig random_config(std::mt19937_64& rng, bool long_one) {
  ExecutorConfig c = standard_config(3);
  c.optimal = true;
  const double cycles[] = {0.000125, 0.00025, 0.0005, 0.001, 0.002, 0.004};
  c.cycle_s = cycles[pick(rng, 6)];
  c.capacity = long_one ? 4096 : pick(rng, 2) == 0 ? 64 : 256;
  const double a = log_uniform(rng, 50, 20000), j = log_uniform(rng, 1e3, 1e9);
  for (unsigned i = 0; i < c.axis_count; ++i) c.limits[i] = {500, 500, a, j, 0.01};
  c.tolerance = pick(rng, 8) == 0 ? 0 : pick(rng, 2) == 0 ? 0.01 : log_uniform(rng, 1e-4, 1);
  return c;
}

/// One to ten lines, each of them with its own feed or all with one: along the axes, on the way back, a little bent, in any direction, in space.
LineProgram short_program(std::mt19937_64& rng, double cycle_s) {
  LineProgram p;
  const unsigned lines = 1 + pick(rng, 10), kind = pick(rng, 5);
  const bool one_feed = pick(rng, 3) != 0;
  const double most_s = cycle_s * log_uniform(rng, 20, 600), longest = log_uniform(rng, 0.02, 60);
  double feed = log_uniform(rng, 1, 30000) / 60, heading = uniform(rng, -3.2, 3.2), climb = 0;
  for (unsigned n = 0; n < lines; ++n) {
    if (!one_feed) feed = log_uniform(rng, 1, 30000) / 60;
    const double l = std::max(1e-3, std::min(longest * log_uniform(rng, 0.01, 1), feed * most_s));
    switch (kind == 4 ? pick(rng, 4) : kind) {
      case 0: heading = pick(rng, 4) * std::numbers::pi / 2; break;
      case 1: heading += pick(rng, 2) == 0 ? std::numbers::pi : uniform(rng, -0.1, 0.1); break;
      case 2: heading += uniform(rng, -0.5, 0.5); break;
      default: heading = uniform(rng, -3.2, 3.2), climb = pick(rng, 2) == 0 ? uniform(rng, -1.5, 1.5) : 0; break;
    }
    const AxisVec at = p.point.back();
    p.to(at[0] + l * std::cos(climb) * std::cos(heading), at[1] + l * std::cos(climb) * std::sin(heading), at[2] + l * std::sin(climb), feed);
    if (pick(rng, 12) == 0) p.stop.back() = true;
  }
  return p;
}

LineProgram long_program(std::mt19937_64& rng) {
  LineProgram p = line_program(static_cast<LineShape>(pick(rng, static_cast<unsigned>(LineShape::count))), rng);
  const double feed = log_uniform(rng, 60, 30000) / 60;
  if (pick(rng, 2) == 0) std::fill(p.feed.begin() + 1, p.feed.end(), feed);
  p.keep(std::min<size_t>(p.point.size(), 400));
  return p;
}

void shorten(Trial* t, double most_s) {
  for (;;) {
    SimpleLaw law(t->limits, t->lines);
    t->law_s = law.seconds();
    if (t->law_s <= most_s || t->lines.point.size() <= 2) {
      t->law_worst = worst_of(std::move(law), t->limits, t->config.cycle_s);
      return;
    }
    const double points = static_cast<double>(t->lines.point.size()) * most_s / t->law_s;
    t->lines.keep(std::clamp<size_t>(static_cast<size_t>(points), 2, t->lines.point.size() - 1));
  }
}

Trial random_trial(uint64_t seed) {
  std::mt19937_64 rng(seed);
  Trial t;
  const bool long_one = seed % kLongOneIn == 0;
  t.config = random_config(rng, long_one);
  const AxisLimits& l = t.config.limits[0];
  t.limits = {l.velocity, l.acceleration, std::min(l.jerk, kShownJerk * l.acceleration / t.config.cycle_s), t.config.tolerance};
  t.lines = long_one ? long_program(rng) : short_program(rng, t.config.cycle_s);
  shorten(&t, t.config.cycle_s * (long_one ? 20000 : 3000));
  t.program = Program(t.config);
  for (size_t k = 1; k < t.lines.point.size(); ++k) {
    Segment& s = t.program.line(t.lines.point[k], t.lines.feed[k]);
    s.exact_stop = t.lines.stop[k];
    t.program.mark();
  }
  t.program.end();
  for (size_t k = 1; k + 1 < t.lines.point.size(); ++k)
    t.rests += t.lines.stop[k] || t.lines.turn(k) > (t.config.tolerance > 0 ? kReversal : kCorner) ? 1u : 0u;
  t.spare_s = kMoreSeconds + (2 + t.rests) * t.config.cycle_s;  // where it rests a cycle may have to end
  t.holds = pick(rng, 4) == 0;
  t.hold_at = uniform(rng, 0, 1);
  return t;
}

struct Seen {
  bool ended = false, alarm = false, at_end = false;
  double seconds = 0, off = 0, limits = 0;
  unsigned rests = 0;
  std::string report;
};

/// Runs from cycle start to the end.
Seen run(const Trial& t) {
  Seen seen;
  Machine m(t.config);
  const PathDistance path(t.program, t.config.axis_count);
  m.feed(t.program);
  m.start();
  const uint64_t most = static_cast<uint64_t>(3 * t.law_s / t.config.cycle_s) + 4000, hold = static_cast<uint64_t>(t.hold_at * t.law_s / t.config.cycle_s);
  const uint64_t feed_every = std::max<uint64_t>(1, static_cast<uint64_t>(0.004 / t.config.cycle_s));
  Rests rests(m.command());
  for (uint64_t n = 0; n < most && !seen.ended && !seen.alarm; ++n) {
    if (n % feed_every == 0) m.feed(t.program);
    if (t.holds) {
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

std::string wrong_of(const Trial& t, const Seen& s) {
  const unsigned rests = t.rests + (t.holds ? 1 : 0);
  if (t.law_worst > 1.0001) return "the law itself takes " + std::to_string(t.law_worst) + " of a limit";
  if (s.alarm) return "alarm";
  if (!s.ended) return "does not end";
  if (!s.at_end) return "ends beside its end";
  if (s.limits > kLimit) return s.report;
  if (s.off > t.config.tolerance + 1e-9) return "leaves the path by " + std::to_string(1e3 * s.off) + " um";
  if (s.rests > rests) return std::to_string(s.rests) + " rests, " + std::to_string(rests) + " allowed";
  if (!t.holds && s.seconds > kSlowest * t.law_s + t.spare_s) return std::to_string(s.seconds) + " s, simply " + std::to_string(t.law_s);
  return "";
}

std::string about(const Trial& t, uint64_t seed) {
  std::ostringstream s;
  s.precision(12);
  s << "; seed " << seed << ": tolerance " << t.config.tolerance << ", cycle " << t.config.cycle_s << ", acceleration " << t.config.limits[0].acceleration
    << ", jerk " << t.config.limits[0].jerk << ", ring " << t.config.capacity << (t.holds ? ", hold, " : ", ") << t.lines.point.size() - 1 << " lines";
  for (size_t k = 1; k < std::min<size_t>(t.lines.point.size(), 11); ++k)
    s << (k > 1 ? ", (" : ": (") << t.lines.point[k][0] << ' ' << t.lines.point[k][1] << ' ' << t.lines.point[k][2] << ") F" << 60 * t.lines.feed[k]
      << (t.lines.stop[k] ? " stop" : "");
  return s.str();
}

/// In a cell in which the speed nearly doubles, the jerk of this program had its peak between two looks: 1.00124 of the limit in third differences.
TEST(PlannedFuzz, TheJerkKeepsItsLimitBetweenTheLooks) {
  const Trial t = random_trial(185629);
  EXPECT_EQ(wrong_of(t, run(t)), "") << about(t, 185629);
}

/// NC_SEEDS=1000000 runs so many seeds, NC_FIRST=7 begins with seed 7.
TEST(PlannedFuzz, ShortProgramsAtAnyMachine) {
  const uint64_t from = wish("NC_FIRST", 1), count = seeds(300, 20);
  uint64_t wrong = 0, holds = 0, slow = 0;
  double ratio = 0, limits = 0, off = 0;
  for (uint64_t seed = from; seed < from + count; ++seed) {
    const Trial t = random_trial(seed);
    const Seen seen = run(t);
    const std::string what = wrong_of(t, seen);
    EXPECT_EQ(what, "") << about(t, seed);
    wrong += what.empty() ? 0 : 1;
    holds += t.holds ? 1 : 0;
    limits = std::max(limits, seen.limits);
    if (t.config.tolerance > 0) off = std::max(off, seen.off / t.config.tolerance);
    if (t.holds) continue;
    const double takes = (seen.seconds - t.spare_s) / t.law_s;
    ratio = std::max(ratio, takes);
    if (takes <= kSlower) continue;
    ++slow;
    std::printf("%.4f of the simple time%s\n", takes, about(t, seed).c_str());
  }
  EXPECT_LE(slow, 1 + count / kOneSlowIn);
  std::printf("%llu programs, %llu with a hold, %llu wrong, %llu slow: %.5f of a limit, %.4f of the tolerance, %.4f of the simple time at most\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(holds), static_cast<unsigned long long>(wrong),
              static_cast<unsigned long long>(slow), limits, off, ratio);
}

}  // namespace
}  // namespace nc::test
