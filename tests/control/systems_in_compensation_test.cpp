// SPDX-License-Identifier: Apache-2.0
// Three part systems in radius compensation at once, each in a plane of its own, stopped and slowed down as an operator may: in each cycle each of them is on the path that a
// second writing of the corners (12.4.1) gives, two linear equations solved for each, and no axis gets a larger step than it can do.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr unsigned kSystems = 3;
constexpr double kVelocity = 200, kCycle = 0.002;
using Place = std::array<double, 3>;

double apart(const Place& a, const Place& b) { return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2])); }

double from_line(const Place& p, const Place& a, const Place& b) {
  double along = 0, squares = 0;
  for (unsigned i = 0; i < 3; ++i) {
    along += (p[i] - a[i]) * (b[i] - a[i]);
    squares += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double t = squares > 0 ? std::fmin(1, std::fmax(0, along / squares)) : 0;
  Place foot{};
  for (unsigned i = 0; i < 3; ++i) foot[i] = a[i] + t * (b[i] - a[i]);
  return apart(p, foot);
}

/// A contour of lines that turn by less than a right angle, several times as long as the tool is wide.
struct Contour {
  std::string text;
  std::vector<Place> path;  ///< of the tool's centre, from where the machine stands
  size_t at = 0;            ///< the machine has come so far

  Contour(std::mt19937_64& random, unsigned system) {
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const unsigned plane = std::uniform_int_distribution<unsigned>(0, 2)(random), axes[3][2] = {{0, 1}, {2, 0}, {1, 2}};
    const unsigned h = axes[plane][0], v = axes[plane][1];
    const double amount = std::round(between(0.5, 4) * 1e3) / 1e3, side = between(0, 1) < 0.5 ? 1 : -1;
    const unsigned edges = std::uniform_int_distribution<unsigned>(4, 12)(random);
    double heading = between(-3, 3);
    std::vector<std::array<double, 2>> corners{{between(-50, 50), between(-50, 50)}};
    for (unsigned i = 0; i < edges; ++i) {
      const double length = between(20, 40);
      corners.push_back({corners.back()[0] + length * std::cos(heading), corners.back()[1] + length * std::sin(heading)});
      heading += between(-1.4, 1.4);
    }
    for (auto& corner : corners)
      for (double& x : corner) x = std::round(x * 1e3) / 1e3;
    char words[120];
    const auto line = [&](const char* codes, const std::array<double, 2>& to) {
      std::snprintf(words, sizeof words, "%s%c%.3f %c%.3f\n", codes, "XYZ"[h], to[0], "XYZ"[v], to[1]);
      text += words;
    };
    const auto go = [&](double x, double y) {
      Place place = path.empty() ? Place{} : path.back();
      place[h] = x;
      place[v] = y;
      path.push_back(place);
    };
    const auto normal = [&](unsigned edge) {
      const double x = corners[edge + 1][0] - corners[edge][0], y = corners[edge + 1][1] - corners[edge][1], size = std::hypot(x, y);
      return std::array<double, 2>{-y / size, x / size};
    };
    std::snprintf(words, sizeof words, "G90 G94 G1%u\nG10 L10 P%u R%.3f\nF6000\n", 7 + plane, system + 1, amount);
    text = words;
    path.push_back({});
    const double o = side * amount;
    const auto first = normal(0), last = normal(edges - 1);
    const std::array<double, 2> in{std::round(corners[0][0] + 3 * o * first[0]), std::round(corners[0][1] + 3 * o * first[1])};
    line("G0 ", in);
    go(in[0], in[1]);
    std::snprintf(words, sizeof words, "G1 G4%u D%u ", side > 0 ? 1 : 2, system + 1);
    line(std::string(words).c_str(), corners[0]);
    go(corners[0][0] + o * first[0], corners[0][1] + o * first[1]);
    for (unsigned i = 1; i < edges; ++i) {
      line("", corners[i]);
      const auto a = normal(i - 1), b = normal(i);  // w.a = o, w.b = o
      const double d = a[0] * b[1] - a[1] * b[0];
      if (std::fabs(d) < 1e-9) go(corners[i][0] + o * a[0], corners[i][1] + o * a[1]);
      else go(corners[i][0] + o * (b[1] - a[1]) / d, corners[i][1] + o * (a[0] - b[0]) / d);
    }
    line("", corners[edges]);
    go(corners[edges][0] + o * last[0], corners[edges][1] + o * last[1]);
    const std::array<double, 2> out{std::round(corners[edges][0] + 3 * o * last[0]), std::round(corners[edges][1] + 3 * o * last[1])};
    line("G40 ", out);
    go(out[0], out[1]);
    text += "M30";
  }

  /// How far the place is from the path, at the line where the machine has come to or the next ones.
  double beside(const Place& place) {
    double best = 1e9;
    for (size_t i = at; i + 1 < path.size() && i < at + 3; ++i) {
      const double d = from_line(place, path[i], path[i + 1]);
      if (d < best - 1e-9) {
        best = d;
        at = i;
      }
    }
    return best;
  }
};

void three_systems(nc_config& c, bool optimal) {
  axes("XYZ")(c);
  c.cycle_s = kCycle;
  c.look_ahead = 64;
  c.motion_mode = optimal ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
  for (unsigned i = 0; i < 3; ++i) {
    nc_axis_config& axis = c.system[0].axis[i];
    axis.rapid = axis.max_velocity = kVelocity;
    axis.max_acceleration = 20 * kVelocity;
    axis.max_jerk = optimal ? 400 * kVelocity : 0;
  }
  c.system_count = kSystems;
  for (unsigned i = 1; i < kSystems; ++i) c.system[i] = c.system[0];
}

void run(uint64_t seed, bool optimal) {
  std::mt19937_64 random(seed);
  const auto one_in = [&](unsigned n) { return std::uniform_int_distribution<unsigned>(1, n)(random) == 1; };
  Bench bench(NC_DIALECT_M700, [optimal](nc_config& c) { three_systems(c, optimal); });
  std::vector<Contour> contours;
  for (unsigned i = 0; i < kSystems; ++i) {
    contours.emplace_back(random, i);
    ASSERT_EQ(nc_program_select(bench.control(), i, bench.add("main" + std::to_string(i), contours[i].text)), NC_OK);
  }
  nc_inputs in[kSystems] = {};
  nc_outputs out[kSystems] = {};
  Place before[kSystems] = {};
  bool ended[kSystems] = {};
  const double allowed = optimal ? 0.0101 : 1e-6;
  for (auto& inputs : in) inputs.feed_override = inputs.rapid_override = 1;
  for (unsigned cycle = 0; cycle < 60000 && !(ended[0] && ended[1] && ended[2]); ++cycle) {
    if (!one_in(3)) nc_feed(bench.control(), 1 + static_cast<unsigned>(random() % 20));
    for (unsigned i = 0; i < kSystems; ++i) {
      nc_inputs& of = in[i];
      if (one_in(200)) of.feed_override = 0.1 * static_cast<double>(random() % 13);
      if (one_in(400)) of.single_block = !of.single_block;
      of.feed_hold = one_in(500);
      const bool stands = out[i].state == NC_STATE_STOPPED || out[i].state == NC_STATE_HOLD || (out[i].state == NC_STATE_IDLE && cycle < 10);
      of.fin = out[i].strobe != 0;
      of.cycle_start = stands && cycle % 4 == 1;
      if (of.feed_override == 0 && one_in(50)) of.feed_override = 1;
    }
    nc_cycle(bench.control(), in, out);
    nc_event event;
    uint64_t dropped = 0;
    for (unsigned i = 0; i < kSystems; ++i) {
      while (nc_event_poll(bench.control(), i, &event, &dropped) == NC_OK) {
        ended[i] = ended[i] || event.kind == NC_ITEM_END;
        ASSERT_NE(event.kind, NC_ITEM_ALARM) << contours[i].text;
      }
      const Place place{out[i].command.v[0], out[i].command.v[1], out[i].command.v[2]};
      ASSERT_LE(contours[i].beside(place), allowed) << "part system " << i + 1 << ", cycle " << cycle << ", line " << out[i].source.line << "\n" << contours[i].text;
      for (unsigned axis = 0; axis < 3; ++axis) ASSERT_LE(std::fabs(place[axis] - before[i][axis]), kVelocity * kCycle * 1.001) << "part system " << i + 1 << ", axis " << axis;
      before[i] = place;
    }
  }
  for (unsigned i = 0; i < kSystems; ++i) {
    EXPECT_TRUE(ended[i]) << "part system " << i + 1 << ", state " << int{out[i].state} << "\n" << contours[i].text;
    EXPECT_LT(apart(before[i], contours[i].path.back()), 1e-6);
  }
}

class SystemsInCompensation : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, SystemsInCompensation, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(SystemsInCompensation, EachStaysOnItsOwnPath) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(6, 1);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run(seed, GetParam());
  }
}

}  // namespace
}  // namespace nc::test
