// SPDX-License-Identifier: Apache-2.0
// Random programs of lines in the optimal mode, measured on the positions of every cycle: they rest only where the program or its geometry
// requires it, keep the limits and the tolerance, and take no longer than a simple law.
#include <gtest/gtest.h>

#include "interpolate/path_distance.hpp"
#include "interpolate/simple_law.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kLimit = 1.001;
constexpr double kSlower = 1.05, kMoreSeconds = 0.01;  ///< allowed above the time of the simple law: a factor and s
constexpr double kStill = 5e-6;    ///< mm: axes that move less in a cycle of 1 ms count as standing
constexpr double kReversal = 1.99; ///< |t2 - t1| of a corner that may be a rest

ExecutorConfig config_of(uint64_t seed) {
  ExecutorConfig config = standard_config(3);
  config.optimal = true;
  for (unsigned i = 0; i < 3; ++i) config.limits[i] = {250, 250, 2000, 50000, 0.01};
  static constexpr uint32_t kCapacity[] = {16384, 1024, 256};
  static constexpr double kTolerance[] = {0.01, 0.01, 0.01, 0.001, 0.1, 1e-4, 1, 0};
  config.capacity = kCapacity[seed / 9 % 3];
  config.tolerance = kTolerance[seed / 27 % 8];
  return config;
}

struct Seen {
  std::string wrong;
  double seconds = 0, simple = 0, velocity = 0, acceleration = 0, jerk = 0, off = 0;
  unsigned rests = 0, rests_allowed = 0;
};

Seen run(const LineProgram& lines, const ExecutorConfig& config, uint64_t plan_every) {
  Seen seen;
  Program p(config);
  for (size_t k = 1; k < lines.point.size(); ++k) {
    p.line(lines.point[k], lines.feed[k]);
    p.mark();
  }
  p.end();
  for (size_t k = 1; k + 1 < lines.point.size(); ++k)
    seen.rests_allowed += lines.turn(k) > (config.tolerance > 0 ? kReversal : 1e-9) ? 1u : 0u;
  const AxisLimits& l = config.limits[0];
  seen.simple = SimpleLaw({l.velocity, l.acceleration, l.jerk, config.tolerance}, lines).seconds();
  const PathDistance path(p, config.axis_count);
  Machine m(config);
  m.feed(p);
  m.start();
  const uint64_t most = static_cast<uint64_t>(3 * seen.simple / config.cycle_s) + 2000;
  uint64_t first = 0, last = 0, still = 0;
  AxisVec before = m.command();
  for (uint64_t n = 0; n < most; ++n) {
    if (n % plan_every == 0) m.feed(p);
    m.cycle();
    if (m.out.state == NC_STATE_ALARM) {
      seen.wrong = "alarm";
      return seen;
    }
    const AxisVec now = m.command();
    double by = 0;
    for (unsigned i = 0; i < 3; ++i) by = std::max(by, std::fabs(now[i] - before[i]));
    before = now;
    if (by > kStill) {
      if (still > 0 && first > 0) ++seen.rests;
      still = 0;
      if (first == 0) first = n;
      last = n;
    } else {
      ++still;
    }
    if (n % 3 == 0) seen.off = std::max(seen.off, path.near(m.out.serial, now, seen.off));
    if (m.out.state == NC_STATE_IDLE && m.next == p.records.size() && m.executor.drained()) break;
  }
  seen.seconds = static_cast<double>(last - first + 1) * config.cycle_s;
  seen.velocity = m.checker.worst_velocity;
  seen.acceleration = m.checker.worst_acceleration;
  seen.jerk = m.checker.worst_jerk;
  if (m.out.state != NC_STATE_IDLE) seen.wrong = "does not end in thrice the time of the simple law";
  else if (!(m.command() == p.at())) seen.wrong = "ends beside its end";
  else if (std::max({seen.velocity, seen.acceleration, seen.jerk}) > kLimit) seen.wrong = m.checker.report();
  else if (seen.off > config.tolerance + 1e-9) seen.wrong = "leaves the path by " + std::to_string(1e3 * seen.off) + " um";
  else if (seen.rests > seen.rests_allowed) seen.wrong = std::to_string(seen.rests) + " rests, " + std::to_string(seen.rests_allowed) + " allowed";
  else if (seen.seconds > kSlower * seen.simple + kMoreSeconds) seen.wrong = std::to_string(seen.seconds) + " s, simply " + std::to_string(seen.simple);
  return seen;
}

/// NC_SEEDS=10000 runs so many seeds, NC_FIRST=7 begins with seed 7.
TEST(PlannedLines, NothingStopsThemAndNothingIsBroken) {
  const uint64_t from = wish("NC_FIRST", 0), count = seeds(120, 6);
  Seen worst;
  double ratio = 0;
  uint64_t wrong = 0;
  for (uint64_t seed = from; seed < from + count; ++seed) {
    std::mt19937_64 rng(seed);
    const LineShape shape = static_cast<LineShape>(seed % static_cast<uint64_t>(LineShape::count));
    const LineProgram lines = line_program(shape, rng);
    const ExecutorConfig config = config_of(seed);
    const Seen seen = run(lines, config, 5);
    EXPECT_TRUE(seen.wrong.empty()) << seen.wrong << "; seed " << seed << ": " << name_of(shape) << ", " << lines.point.size() - 1 << " lines, tolerance " << config.tolerance
                                    << ", capacity " << config.capacity;
    wrong += seen.wrong.empty() ? 0 : 1;
    worst.velocity = std::max(worst.velocity, seen.velocity);
    worst.acceleration = std::max(worst.acceleration, seen.acceleration);
    worst.jerk = std::max(worst.jerk, seen.jerk);
    if (config.tolerance > 0) worst.off = std::max(worst.off, seen.off / config.tolerance);
    ratio = std::max(ratio, seen.seconds / (seen.simple + kMoreSeconds));
  }
  std::printf("%llu programs, %llu wrong; worst: velocity %.5f, acceleration %.5f, jerk %.5f of the limit, %.4f of the tolerance, %.3f of the simple time\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(wrong), worst.velocity, worst.acceleration, worst.jerk, worst.off, ratio);
}

LineProgram hatch_of(unsigned rows, double part, LineProgram lines = {}) {
  for (unsigned n = 0; n < rows; ++n) {
    line_program_detail::in_parts(lines, n % 2 == 0 ? 20 : -20, 0, part, 200);
    lines.by(0, 0.3, 200);
  }
  return lines;
}

/// A former fault: one row more than is smoothed at once made a rest of every corner, and rests on the straight lines where they were divided.
TEST(PlannedLines, AHatchTakesAsLongAsItsRows) {
  const ExecutorConfig config = config_of(0);
  const double few = run(hatch_of(60, 0), config, 5).seconds;
  for (const double part : {0.0, 1.0}) {
    const Seen seen = run(hatch_of(100, part), config, 5);
    EXPECT_EQ(seen.wrong, "") << part;
    EXPECT_LT(seen.seconds, few * 100 / 60 * 1.01) << part;
  }
}

/// Lines of 0.05 to 0.5 mm that turn by up to 0.6 rad are gone by the jerk alone: on the curve through their middle they took 13.2 s, and within the
/// tolerance there are quicker ones.
TEST(PlannedLines, RoughLinesUseTheWholeTolerance) {
  double seconds = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937_64 rng(seed);
    const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
    LineProgram lines;
    double heading = 0;
    for (unsigned n = 0; n < 200; ++n) {
      const double size = 0.05 * std::pow(10, draw(0, 1));
      heading += draw(-0.6, 0.6);
      lines.by(size * std::cos(heading), size * std::sin(heading), 70);
    }
    const Seen seen = run(lines, config_of(0), 5);
    EXPECT_EQ(seen.wrong, "") << "seed " << seed;
    seconds += seen.seconds;
  }
  EXPECT_LE(seconds, 11.5);
  std::printf("%.3f s\n", seconds);
}

/// A former fault: the path rested beside the end of a line, and the axes jumped to its end in the next cycle.
TEST(PlannedLines, AContourInFrontOfAHatchHasNoJump) {
  LineProgram lines;
  for (unsigned n = 1; n <= 100; ++n) lines.to(10 * std::sin(0.0628318531 * n), 10 - 10 * std::cos(0.0628318531 * n), 0, 50);
  for (const double tolerance : {0.01, 1e-4}) {
    ExecutorConfig config = config_of(0);
    config.tolerance = tolerance;
    EXPECT_EQ(run(hatch_of(90, 0, lines), config, 5).wrong, "") << tolerance;
  }
}

/// A former fault: the first lines after a slow one had a fifth of the speed of the later ones.
TEST(PlannedLines, ASlowFeedSlowsItsOwnLinesOnly) {
  const auto seconds = [](double slow) {
    LineProgram lines;
    lines.to(0, 0, 0.01, slow);
    for (unsigned n = 1; n <= 300; ++n) lines.to(0.2 * n, 1 - std::cos(0.04 * n), 0.01, 130);
    const Seen seen = run(lines, config_of(0), 5);
    EXPECT_EQ(seen.wrong, "") << slow;
    return seen.seconds - 0.01 / slow;
  };
  EXPECT_LT(seconds(1.6), seconds(130) + 0.1);
}

/// Gentle corners that have just the room for their rounding. A former fault: the knot before each corner was that of the preceding corner, up to a
/// fifth farther away than the one after it. So the corner was cut by more than the tolerance, all cells were halved, and it took 1.3 times as long.
TEST(PlannedLines, CornersWithJustTheirRoomAreGoneAsFastAsOthers) {
  const ExecutorConfig config = config_of(0);
  constexpr double kTurn = 0.428, kReach = 6 * 0.94 * 0.01 / kTurn;
  for (const double share : {0.89, 0.915, 0.93, 0.945}) {  // the part of a line that the roundings at its ends take
    LineProgram lines;
    const double length = 2 * kReach / share;
    for (unsigned n = 0; n < 100; ++n) lines.by((n % 2 == 0 ? 0.5 : -0.5) * kTurn * length, std::sqrt(1 - 0.25 * kTurn * kTurn) * length, 80);
    const Seen seen = run(lines, config, 5);
    EXPECT_EQ(seen.wrong, "") << share;
    EXPECT_LT(seen.seconds, 1.01 * seen.simple) << share;
  }
}

}  // namespace
}  // namespace nc::test
