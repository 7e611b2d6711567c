// SPDX-License-Identifier: Apache-2.0
// A hold, a reset, another override or single block comes while the feeder is in the middle of planning, which it does in slices. Whatever the
// size of the slices and the instant: the positions of every cycle keep the limits and the tolerance, the axes come to rest, and the program goes
// on from there to its end, with each record once and in order.
#include <gtest/gtest.h>

#include "interpolate/path_distance.hpp"
#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using random_program_detail::log_uniform;
using random_program_detail::pick;
using random_program_detail::uniform;

constexpr double kLeast = 1;            // instructions: one pause of the planner after the other
constexpr double kMostBudget = 1e6;     // that is a plan or some
constexpr uint64_t kWaits = 2000;       // cycles, for the feeder to be amid a plan
constexpr uint64_t kMostCycles = 60000;

ExecutorConfig config_of(uint64_t seed) {
  ExecutorConfig c = standard_config();
  c.optimal = true;
  c.capacity = seed % 4 == 0 ? 256 : 2048;
  for (unsigned i = 0; i < c.axis_count; ++i) c.limits[i] = {250, 250, 2000, 50000, 0.01};
  if (seed % 5 == 1) c.limits[1] = {120, 80, 700, 20000, 0.01};
  if (seed % 7 == 2) c.cycle_s = 0.004;
  return c;
}

/// A hang is a hold during which nothing feeds, so that the scan stops by itself.
enum class Event : unsigned { hold, interlock, override, single_block, reset, hang, count };
const char* name_of(Event e) {
  static constexpr const char* kName[] = {"hold", "interlock", "override", "single block", "reset", "hang"};
  return kName[static_cast<unsigned>(e)];
}

/// A machine whose feeder has `instructions` for each cycle.
class Sliced {
 public:
  Sliced(const ExecutorConfig& config, const Program& program, int64_t instructions) : m(config), path_(program, config.axis_count), p_(program), left_(instructions) {
    for (const Record& r : program.records) moves_ = moves_ || r.kind == ItemKind::move;
  }
  /// One cycle of the feeder and one of the scan. @return what is wrong, or an empty text
  std::string cycle() {
    if (!m.executor.slices()) return "it does not plan in slices";
    if (!hangs) feed();
    m.cycle();
    if (m.out.state == NC_STATE_ALARM) return "alarm";
    const double most = m.config.tolerance + 1e-9;
    if (moves_ && path_.near(m.out.serial, m.command(), most) > most) return "leaves the path";
    return m.checker.ok() ? "" : m.checker.report();
  }
  bool amid() const { return amid_; }
  bool ended() const { return m.out.state == NC_STATE_IDLE && m.next == p_.records.size() && m.executor.drained(); }
  /// Presses start where the machine waits for it.
  void go_on() { m.in.cycle_start = (m.out.state == NC_STATE_STOPPED || m.out.state == NC_STATE_HOLD) && !m.in.cycle_start; }

  Machine m;
  uint64_t amid_planning = 0;  ///< cycles in which a plan was not finished
  bool hangs = false;          ///< nothing feeds

 private:
  void feed() {
    m.executor.run_taken(m.executor.run());
    int64_t left = left_;
    if (m.executor.answer(&left)) {
      if (!amid_) {
        for (; m.next < p_.records.size() && m.executor.room() > 0; ++m.next) {
          Record r = p_.records[m.next];
          r.epoch = m.epoch();
          m.executor.push(r);
        }
      }
      amid_ = !m.executor.plan(&left);
    }
    amid_planning += amid_ ? 1 : 0;
  }

  PathDistance path_;
  const Program& p_;
  int64_t left_;
  bool amid_ = false, moves_ = false;
};

void press(Sliced& s, Event e, double override) {
  nc_inputs& in = s.m.in;
  switch (e) {
    case Event::hang: s.hangs = true; [[fallthrough]];
    case Event::hold: in.feed_hold = true; break;
    case Event::interlock: in.interlock = true; break;
    case Event::override: in.feed_override = override; break;
    case Event::single_block: in.single_block = true; break;
    case Event::reset: in.reset = true; break;
    case Event::count: break;
  }
}

void release(Sliced& s) {
  nc_inputs& in = s.m.in;
  s.hangs = false;
  in.feed_hold = in.interlock = in.single_block = in.reset = false;
  in.feed_override = 1;
}

std::string in_order(const Program& p, const std::vector<nc_event>& events) {
  if (events.size() != p.records.size()) return std::to_string(events.size()) + " events for " + std::to_string(p.records.size()) + " records";
  for (size_t n = 0; n < events.size(); ++n)
    if (events[n].serial != p.records[n].serial) return "event " + std::to_string(n) + " out of order";
  return "";
}

/// The event comes in cycle `instant`, as soon as the feeder is amid a plan, and is taken back `length` cycles later.
std::string run(Sliced& s, const Program& p, Event e, uint64_t instant, uint64_t length, double override, bool* was_amid) {
  s.m.start();
  uint64_t since = 0;
  for (uint64_t n = 0; n < kMostCycles; ++n) {
    if (since == 0 && n >= instant && (s.amid() || n >= instant + kWaits)) {
      *was_amid = s.amid();
      press(s, e, override);
      since = n;
    }
    const bool over = since > 0 && n >= since + length;
    if (over) release(s);
    s.m.in.cycle_start = false;
    if (n > 0 && (since == 0 || over)) s.go_on();
    const std::string wrong = s.cycle();
    if (!wrong.empty()) return wrong + " in cycle " + std::to_string(n);
    if (e == Event::reset && since > 0) {
      if (s.m.still() && n > since + 2) return "";
      if (n > since + 20000) return "a reset does not bring it to rest";
      continue;
    }
    if (s.ended()) {
      if (!(s.m.command() == p.at())) return "ends beside its last point";
      return in_order(p, s.m.events);
    }
  }
  return "did not end";
}

/// `instant` is counted from the start.
void check(uint64_t seed, int64_t budget, Event e, uint64_t instant, uint64_t length, double override, unsigned* amid) {
  std::mt19937_64 rng(seed);
  const ExecutorConfig config = config_of(seed);
  Program p = random_program(config, rng, 3);
  for (Record& r : p.records)
    if (r.kind == ItemKind::move && !r.segment.rapid) r.segment.feed_mm_s = std::max(r.segment.feed_mm_s, 40.0);
  Sliced s(config, p, budget);
  bool was_amid = false;
  const std::string wrong = run(s, p, e, instant, length, override, &was_amid);
  EXPECT_EQ(wrong, "") << "seed " << seed << ", " << budget << " instructions a cycle, " << name_of(e) << " in cycle " << instant << " for " << length << " cycles, override " << override;
  *amid += was_amid ? 1 : 0;
}

TEST(PlannedAmid, WhateverComesAmidAPlanTheLimitsAreKeptAndTheProgramGoesOn) {
  unsigned amid = 0;
  const uint64_t count = seeds(60, 10);
  for (uint64_t seed = 1; seed <= count; ++seed) {
    std::mt19937_64 rng(seed + 7000000);
    const auto budget = static_cast<int64_t>(log_uniform(rng, kLeast, kMostBudget));
    const auto e = static_cast<Event>(pick(rng, static_cast<unsigned>(Event::count)));
    const auto instant = static_cast<uint64_t>(uniform(rng, 2, 400)), length = static_cast<uint64_t>(log_uniform(rng, 1, 800));
    const double override = pick(rng, 4) == 0 ? 0 : uniform(rng, 0.2, 2);
    check(seed, budget, e, instant, length, override, &amid);
    if (HasFailure()) return;
  }
  EXPECT_GT(amid, count / 4);
}

/// One program, a hold at one instant after the other, with budgets from one pause of the planner to whole plans.
TEST(PlannedAmid, AHoldAtEveryInstantOfASlice) {
  unsigned amid = 0, holds = 0;
  for (const int64_t budget : {int64_t{1}, int64_t{50000}, int64_t{300000}, int64_t{2000000}}) {
    for (uint64_t instant = 20; instant < 400; instant += sanitized() ? 97 : 19, ++holds) {
      check(3, budget, Event::hold, instant, 150, 1, &amid);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(amid, holds / 3);
}

/// Short lines of a wave: their path is given out in many pieces while the axes move.
Program wave(const ExecutorConfig& config) {
  Program p(config);
  for (unsigned n = 1; n <= 240; ++n) {
    AxisVec end = p.at();
    end[0] = 0.4 * n;
    end[1] = n % 2 == 0 ? 0.05 : 0.0;
    p.line(end, 40);
  }
  p.end();
  return p;
}

/// Nothing feeds from one instant after the other on, until the scan has come to rest by itself: what was under way for the path goes on then, and
/// comes once.
TEST(PlannedAmid, AHangAtEveryInstantOfASlice) {
  ExecutorConfig config = config_of(3);
  config.capacity = 64;
  const Program p = wave(config);
  unsigned amid = 0, hangs = 0;
  const uint64_t step = wish("NC_STEP", sanitized() ? 107 : 12);
  for (uint64_t instant = 60; instant < 1500; instant += step, ++hangs) {
    Sliced s(config, p, 1 + static_cast<int64_t>(instant % 5 * 700));
    bool was_amid = false;
    ASSERT_EQ(run(s, p, Event::hang, instant, 400, 1, &was_amid), "") << "cycle " << instant;
    amid += was_amid ? 1 : 0;
  }
  EXPECT_GT(amid, hangs / 3);
}

/// A wave of short lines that are all blocks: the next end of one is always near, and its bends take all of the limits.
Program blocks(const ExecutorConfig& config) {
  Program p(config);
  for (unsigned n = 1; n <= 1500; ++n) {
    AxisVec end = p.at();
    end[0] = 0.1 * n;
    end[1] = std::sin(2 * end[0]);
    p.line(end, 100);
    p.mark();
  }
  p.end();
  return p;
}

/// Where the axes rest, in mm of X behind the place of the press.
struct Ways {
  double mean = 0, most = 0;
};
Ways of_single_block(int64_t budget) {
  const ExecutorConfig config = config_of(3);
  const Program p = blocks(config);
  Ways ways;
  unsigned presses = 0;
  for (uint64_t instant = 700; instant < 1500; instant += sanitized() ? 161 : 23) {
    Sliced s(config, p, budget);
    s.m.start();
    for (uint64_t n = 0; n < instant; ++n) EXPECT_EQ(s.cycle(), "");
    s.m.in.single_block = true;
    const double from = s.m.command()[0];
    for (uint64_t n = 0; n < kWaits && s.m.out.state != NC_STATE_STOPPED; ++n) EXPECT_EQ(s.cycle(), "") << "cycle " << n << " behind a press in cycle " << instant;
    EXPECT_EQ(s.m.out.state, NC_STATE_STOPPED) << "cycle " << instant;
    const double x = s.m.command()[0], way = x - from;
    EXPECT_NEAR(x, 0.1 * std::round(10 * x), config.tolerance) << "not at the end of a block, cycle " << instant;
    ways.mean += way;
    ways.most = std::max(ways.most, way);
    ++presses;
  }
  ways.mean /= presses;
  std::printf("%lld instructions a cycle: single block rests %.2f mm behind the press, at most %.2f\n", static_cast<long long>(budget), ways.mean, ways.most);
  return ways;
}

/// A former fault: each end of a block that could not be reached was looked for with all effort, some of them up to six times, and meanwhile the ends
/// of blocks went by: 177 of them on average, with 300,000 instructions a cycle.
TEST(PlannedAmid, SingleBlockRestsAtOneOfTheNextEndsOfBlocks) {
  const Ways at_once = of_single_block(1000000000), some = of_single_block(1000000), few = of_single_block(300000);
  EXPECT_LE(at_once.mean, 1.75);  // seen: 1.61; a stop takes 0.3 to 1.2 mm of the path on a straight line
  EXPECT_LE(some.mean, 3);
  EXPECT_LE(few.mean, 6);
  EXPECT_LE(few.most, 12);
}

}  // namespace
}  // namespace nc::test
