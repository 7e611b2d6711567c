// SPDX-License-Identifier: Apache-2.0
// Lines of some micrometres in which a rotary axis turns by some ten degrees. A feed goes by the linear axes, so a millionth of a millimetre of such
// a line is a part of a degree: what counts as the same place must be measured by each axis and not by the length of the path.
#include <gtest/gtest.h>

#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using random_program_detail::log_uniform;
using random_program_detail::pick;
using random_program_detail::uniform;

constexpr unsigned kRotary = 3, kLines = 6;
constexpr uint64_t kMostCycles = 30000;

ExecutorConfig config_of(uint64_t seed) {
  ExecutorConfig c = standard_config(4);
  c.optimal = true;
  for (unsigned i = 0; i < 3; ++i) c.limits[i] = {250, 200, 2000, 50000, 0.01};
  c.limits[kRotary] = {180, 150, 3000, 90000, 0.01};
  c.cycle_s = seed % 2 == 0 ? 0.0005 : 0.001;
  if (seed % 3 == 0) c.tolerance = 0;
  return c;
}

/// Lines of all lengths along X, there and back, with a turn, without one, or with nothing else.
Program turning_program(const ExecutorConfig& config, std::mt19937_64& rng) {
  Program p(config);
  for (unsigned n = 0; n < kLines; ++n) {
    AxisVec end = p.at();
    const unsigned kind = pick(rng, 4);
    if (kind != 0) end[0] += (pick(rng, 2) == 0 ? -1 : 1) * log_uniform(rng, 1e-4, 0.3);
    if (kind != 1) end[kRotary] += uniform(rng, -90, 90);
    p.line(end, kind == 0 ? 150 : log_uniform(rng, 0.3, 30)).exact_stop = pick(rng, 8) == 0;
    p.mark();
  }
  p.end();
  return p;
}

/// Holds now and then, each for a while. With `hangs` nothing feeds meanwhile, so that the scan stops by itself, wherever that is. @return what is wrong, or an empty text
std::string run_seed(uint64_t seed, bool hangs, double* jerk) {
  std::mt19937_64 rng(seed);
  const ExecutorConfig config = config_of(seed);
  const Program p = turning_program(config, rng);
  Machine m(config);
  m.feed(p);
  m.start();
  for (uint64_t n = 0; n < kMostCycles; ++n) {
    if (pick(rng, 150) == 0) m.in.feed_hold = true;
    if (pick(rng, 30) == 0) m.in.feed_hold = false;
    m.in.cycle_start = m.out.state == NC_STATE_HOLD && !m.in.feed_hold && !m.in.cycle_start;
    if (!(hangs && m.in.feed_hold)) m.feed(p);
    m.cycle();
    *jerk = std::max(*jerk, m.checker.worst_jerk);
    if (!m.checker.ok()) return m.checker.report();
    if (m.out.state == NC_STATE_ALARM) return "alarm";
    if (m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained()) return m.command() == p.at() ? "" : "ends beside its last point";
  }
  return "did not end";
}

void run_many(uint64_t usual, bool hangs) {
  const uint64_t first = 1 + wish("NC_SKIP", 0), count = seeds(usual, 3);
  double jerk = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) EXPECT_EQ(run_seed(seed, hangs, &jerk), "") << "seed " << seed;
  std::printf("%llu programs, jerk %.6f of the limit\n", static_cast<unsigned long long>(count), jerk);
}

TEST(PlannedTurning, ShortLinesThatTurnARotaryAxisFarKeepTheLimitsOfAllAxesInHolds) {
  run_many(40, false);
}

TEST(PlannedTurning, AStopWithoutAFeederRightInFrontOfAnEndIsGoneOnWith) {
  run_many(40, true);
}

}  // namespace
}  // namespace nc::test
