// SPDX-License-Identifier: Apache-2.0
// What the executor promises with filters behind interpolation, tested with random programs, constants, overrides, holds, single block and
// resets: no axis exceeds its velocity or its acceleration, blocks that end with a deceleration check reach their ends, and the axes come to rest
// where the program says.
#include <gtest/gtest.h>

#include "dialect/m700/filters.hpp"
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

/// Random constants of a machine: for each kind of move linear, exponential, both or none; S patterns, radius compensation.
FilterParameters random_constants(std::mt19937_64& rng, unsigned axes) {
  FilterParameters p;
  for (TimeConstants* constants : {&p.cut, &p.rapid, &p.skip}) {
    const unsigned kind = static_cast<unsigned>(rng() % 4);  // 0: none
    for (unsigned i = 0; i < axes; ++i) {
      if ((kind & 1) != 0) constants->linear_ms[i] = uniform(rng, 5, 150);
      if ((kind & 2) != 0) constants->exponential_ms[i] = uniform(rng, 3, 60);
    }
    if (kind != 0 && chance(rng, 0.2)) constants->linear_ms[0] = constants->exponential_ms[0] = 0;  // an axis without any
  }
  if (chance(rng, 0.6)) p.pattern_cut_ms = uniform(rng, 1, 80);
  if (chance(rng, 0.6)) p.pattern_rapid_ms = uniform(rng, 1, 80);
  if (chance(rng, 0.5)) p.pattern_second_ms = uniform(rng, 1, 40);
  p.rapid_before = chance(rng, 0.2);
  if (chance(rng, 0.5))
    for (unsigned i = 0; i < 3; ++i) p.round_mm[i] = uniform(rng, -0.05, 0.05);
  return p;
}

/// Sets the filters of each move as commit does; the high-accuracy mode changes now and then.
void set_filters(Program& p, const FilterParameters& constants, const ExecutorConfig& config, std::mt19937_64& rng) {
  bool high_accuracy = chance(rng, 0.3);
  for (Record& r : p.records) {
    if (r.kind == ItemKind::mark && chance(rng, 0.02)) high_accuracy = !high_accuracy;
    if (r.kind != ItemKind::move || !(r.segment.curve.length > 0)) continue;
    Segment& s = r.segment;
    FilteredMove move;
    move.kind = s.rapid ? FilteredMove::Kind::rapid : s.skip ? FilteredMove::Kind::skip : FilteredMove::Kind::cut;
    move.high_accuracy = high_accuracy;
    move.straight = !s.curve.circular && s.curve.shape == nullptr;
    AxisVec low, high;
    curve_bounds(s.curve, config.axis_count, &low, &high);
    for (unsigned i = 0; i < config.axis_count; ++i) {
      if (high[i] > low[i]) move.moving |= 1u << i;
      if (config.limits[i].acceleration > 0) move.limited |= 1u << i;
    }
    s.filter = m700::filter_times(constants, move, config.cycle_s);
    if (high_accuracy && !s.rapid) s.accuracy.acceleration = 900;
    if (s.curve.circular && move.kind == FilteredMove::Kind::cut) {
      s.round_mm[0] = static_cast<float>(constants.round_mm[s.curve.h]);
      s.round_mm[1] = static_cast<float>(constants.round_mm[s.curve.v]);
    }
  }
}

struct Disturbance {
  bool overrides = false, holds = false, single_block = false, dribble = false, resets = false;
};

/// Checks that the record behind a block with a deceleration check is executed only when the axes stand at the end of the block.
class CheckedEnds {
 public:
  explicit CheckedEnds(const Program& p) : program_(p) {}
  std::string look(const Machine& m, const AxisVec& before) {
    std::ostringstream wrong;
    for (; seen_ < m.events.size(); ++seen_) {
      const size_t serial = m.events[seen_].serial;
      if (serial < 2 || serial > program_.records.size()) continue;
      const Record& r = program_.records[serial - 2];
      if (r.kind != ItemKind::move || r.segment.filter.kind == FilterTimes::Kind::none) continue;
      if (!r.segment.rapid && !r.segment.exact_stop) continue;
      for (unsigned i = 0; i < m.config.axis_count; ++i)
        if (!(std::fabs(before[i] - r.segment.curve.end[i]) <= 1e-6)) wrong << "serial " << serial << " begins before its check on axis " << i << "\n";
    }
    return wrong.str();
  }

 private:
  const Program& program_;
  size_t seen_ = 0;
};

void disturb(Machine& m, std::mt19937_64& rng, const Disturbance& d, double& wanted_override) {
  if (d.overrides) {
    if (chance(rng, 0.02)) wanted_override = chance(rng, 0.1) ? 0 : uniform(rng, 0, 2);
    if (chance(rng, 0.5)) m.in.feed_override = wanted_override;
    if (chance(rng, 0.02)) m.in.rapid_override = uniform(rng, 0, 1);
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
}

/// Runs until the program has ended, or a reset has ended it. @return what went wrong, or an empty text
std::string run(Machine& m, const Program& p, std::mt19937_64& rng, const Disturbance& d, bool* reset) {
  CheckedEnds ends(p);
  double wanted_override = 1;
  m.next = 0;
  m.events.clear();
  m.feed(p, d.dribble ? 5 : ~0u);
  m.in.feed_hold = m.in.interlock = false;
  m.start();
  for (uint64_t n = 0; n < 3000000; ++n) {
    if (d.dribble) {
      if (chance(rng, 0.1)) m.feed(p, 1 + static_cast<unsigned>(rng() % 6));
    } else if (chance(rng, 0.5)) {
      m.feed(p);
    }
    disturb(m, rng, d, wanted_override);
    m.in.reset = d.resets && chance(rng, 0.001);
    *reset = *reset || m.in.reset;
    const AxisVec before = m.command();
    m.cycle();
    const std::string wrong = ends.look(m, before);
    if (!wrong.empty()) return wrong;
    if (m.out.state == NC_STATE_ALARM) return "alarm";
    if (*reset && m.out.state == NC_STATE_IDLE) return "";
    if (m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained()) return "";
  }
  return "did not end";
}

std::string stands(Machine& m) {
  m.in.reset = false;
  for (int i = 0; i < 5; ++i) {
    m.cycle();
    if (!m.still()) return "moves after the end";
  }
  return "";
}

std::string run_seed(uint64_t seed, const Disturbance& d, LimitChecker* worst) {
  std::mt19937_64 rng(seed);
  ExecutorConfig config = standard_config(seed % 3 == 0 ? 4 : 3);
  config.filters = true;
  if (seed % 5 == 1) config.limits[1] = {120, 80, 700, 0, 0.01};
  if (seed % 7 == 2) config.cycle_s = 0.0004;
  if (seed % 11 == 3) config.cycle_s = 0.004;
  if (seed % 17 == 5) config.limits[2] = {};  // an axis without limits
  const FilterParameters constants = random_constants(rng, config.axis_count);
  Machine m(config);
  if (m.overflowed) return "memory";
  for (int round = 0; round < (d.resets ? 4 : 1); ++round) {
    Program p = random_program(config, rng, 30, m.command());
    set_filters(p, constants, config, rng);
    bool reset = false;
    std::string wrong = run(m, p, rng, d, &reset);
    if (wrong.empty()) wrong = stands(m);
    if (!wrong.empty()) return wrong;
    *worst = m.checker;
    if (!m.checker.ok()) return m.checker.report();
    if (reset) continue;
    if (!(m.command() == p.at())) return "ends beside the last end point";
    wrong = check_events(p, m.events, config.axis_count);
    if (!wrong.empty()) return wrong;
  }
  return "";
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
  std::printf("worst over %llu seeds: velocity %.6f, acceleration %.6f of the limit\n", static_cast<unsigned long long>(count), velocity, acceleration);
}

TEST(FilterLimits, UndisturbedProgramsKeepThem) {
  run_many(1, {});
}
TEST(FilterLimits, RandomOverridesKeepThem) {
  run_many(100000, {.overrides = true});
}
TEST(FilterLimits, HoldsAndInterlocksKeepThem) {
  run_many(200000, {.holds = true});
}
TEST(FilterLimits, SingleBlockKeepsThem) {
  run_many(300000, {.single_block = true});
}
TEST(FilterLimits, LateFeedingKeepsThem) {
  run_many(400000, {.dribble = true});
}
TEST(FilterLimits, ResetsKeepThem) {
  run_many(500000, {.overrides = true, .resets = true});
}
TEST(FilterLimits, EverythingAtOnceKeepsThem) {
  run_many(600000, {.overrides = true, .holds = true, .single_block = true, .dribble = true, .resets = true});
}

}  // namespace
}  // namespace nc::test
