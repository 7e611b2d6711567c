// SPDX-License-Identifier: Apache-2.0
// What the executor promises, tested with random programs: no axis ever exceeds its velocity or acceleration, every
// record is executed in order and ends at its place, and the machine is at rest at the end, whatever the operator and
// the feeder do.
#include <gtest/gtest.h>

#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
bool chance(std::mt19937_64& rng, double p) {
  return uniform(rng, 0, 1) < p;
}

struct Disturbance {
  bool overrides = false, holds = false, single_block = false, dribble = false, dry = false;
};

/// Runs one seed to its end; returns what went wrong, or an empty text.
std::string run_seed(uint64_t seed, const Disturbance& d, LimitChecker* worst = nullptr) {
  std::mt19937_64 rng(seed);
  ExecutorConfig config = standard_config(seed % 3 == 0 ? 4 : 3);
  if (seed % 5 == 1) config.limits[1] = {120, 80, 700, 0, 0.01};  // unequal axes
  if (seed % 7 == 2) config.cycle_s = 0.0004;
  if (seed % 11 == 3) config.cycle_s = 0.004;
  if (seed % 13 == 4) config.capacity = 64;
  if (seed % 17 == 5) config.limits[2] = {};  // an axis without limits
  Program p = random_program(config, rng, 30);
  Machine m(config);
  if (m.overflowed) return "memory";
  if (d.dry) {
    m.in.manual_feed = 100;
    for (Record& r : p.records) r.segment.dry = r.kind == ItemKind::move && (!r.segment.rapid || seed % 2 == 0);
  }
  m.feed(p, d.dribble ? 5 : ~0u);
  m.start();
  uint64_t idle = 0, n = 0;
  double target_override = 1;
  for (; n < 3000000; ++n) {
    if (d.dribble) {
      if (chance(rng, 0.1)) m.feed(p, 1 + static_cast<unsigned>(rng() % 6));
    } else if (chance(rng, 0.5)) {
      m.feed(p);
    }
    if (d.overrides) {
      if (chance(rng, 0.02)) target_override = chance(rng, 0.1) ? 0 : uniform(rng, 0, 2);
      if (chance(rng, 0.5)) m.in.feed_override = target_override;
      if (chance(rng, 0.02)) m.in.rapid_override = uniform(rng, 0, 1);
    }
    if (d.dry) {
      if (chance(rng, 0.01)) m.in.dry_run = !m.in.dry_run;
      if (chance(rng, 0.02)) m.in.manual_feed = chance(rng, 0.1) ? 0 : uniform(rng, 5, 300);
      if (chance(rng, 0.01)) m.in.manual_rapid = !m.in.manual_rapid;
    }
    if (d.holds) {
      if (chance(rng, 0.01)) m.in.feed_hold = true;
      if (chance(rng, 0.05)) m.in.feed_hold = false;
      if (chance(rng, 0.005)) m.in.interlock = true;
      if (chance(rng, 0.05)) m.in.interlock = false;
    }
    if (d.single_block && chance(rng, 0.01)) m.in.single_block = !m.in.single_block;
    const bool waits = m.out.state == NC_STATE_STOPPED || m.out.state == NC_STATE_HOLD;
    m.in.cycle_start = waits && chance(rng, 0.2) && !m.in.cycle_start;
    m.cycle();
    if (m.out.state == NC_STATE_ALARM) return "alarm";
    idle = m.still() ? idle + 1 : 0;
    if (m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained()) break;
  }
  if (n == 3000000) return "did not end";
  for (int i = 0; i < 3; ++i) {
    m.cycle();
    if (!m.still()) return "moves after the end";
  }
  if (worst) *worst = m.checker;
  if (!m.checker.ok()) return m.checker.report();
  if (!(m.command() == p.at())) return "ends beside the last end point";
  return check_events(p, m.events, config.axis_count);
}

void run_many(uint64_t first, const Disturbance& d) {
  const uint64_t count = seeds(20, 2);
  double velocity = 0, acceleration = 0;
  for (uint64_t s = first; s < first + count; ++s) {
    LimitChecker worst{standard_config()};
    const std::string wrong = run_seed(s, d, &worst);
    ASSERT_EQ(wrong, "") << "seed " << s;
    velocity = std::max(velocity, worst.worst_velocity);
    acceleration = std::max(acceleration, worst.worst_acceleration);
  }
  std::printf("worst over %llu seeds: velocity %.6f, acceleration %.6f of the limit\n",
              static_cast<unsigned long long>(count), velocity, acceleration);
}

TEST(Limits, UndisturbedProgramsKeepThem) {
  run_many(1, {});
}
TEST(Limits, RandomOverridesKeepThem) {
  run_many(100000, {.overrides = true});
}
TEST(Limits, HoldsAndInterlocksKeepThem) {
  run_many(200000, {.holds = true});
}
TEST(Limits, SingleBlockKeepsThem) {
  run_many(300000, {.single_block = true});
}
TEST(Limits, DryRunKeepsThem) {  // M700 7.4 note 4
  run_many(600000, {.overrides = true, .dry = true});
}
TEST(Limits, DryRunAndEverythingElseKeepThem) {
  run_many(700000, {.overrides = true, .holds = true, .single_block = true, .dribble = true, .dry = true});
}
TEST(Limits, LateFeedingKeepsThem) {
  run_many(400000, {.dribble = true});
}
TEST(Limits, EverythingAtOnceKeepsThem) {
  run_many(500000, {.overrides = true, .holds = true, .single_block = true, .dribble = true});
}

}  // namespace
}  // namespace nc::test
