// SPDX-License-Identifier: Apache-2.0
// The stop that the scan makes by itself: at every moment, not only at those that Brake examines, the axes keep their limits, also where the path
// begins to bend between two of these.
#include "interpolate/brake.hpp"
#include "support/seeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace nc {
namespace {

/// A plan at a constant speed: a line, then a bend whose curvature grows by `growth` per mm up to its middle and falls again, then a line.
/// With `stop` it comes to rest at the end of the bend by a constant deceleration, as in the last cell of a plan.
struct BendPlan {
  double line = 10, half = 2, growth = 0.1;  // mm, mm, 1/mm^2
  double v = 100;                            // mm/s
  double cell = 0.7;                         // mm

  /// Angle of the direction, its first and second derivative by the length.
  void direction(double u, double* angle, double* curvature, double* change) const {
    const double x = u - line, most = growth * half;
    if (x <= 0 || x >= 2 * half) {
      *angle = x <= 0 ? 0 : most * half;
      *curvature = *change = 0;
    } else if (x < half) {
      *angle = growth * x * x / 2, *curvature = growth * x, *change = growth;
    } else {
      const double left = 2 * half - x;
      *angle = most * half - growth * left * left / 2, *curvature = growth * left, *change = -growth;
    }
  }
  PlanMoment moment(double u) const {
    PlanMoment m;
    double angle = 0, k = 0, dk = 0;
    direction(u, &angle, &k, &dk);
    const double c = std::cos(angle), s = std::sin(angle);
    m.path.d1[0] = c, m.path.d1[1] = s;
    m.path.d2[0] = -k * s, m.path.d2[1] = k * c;
    m.path.d3[0] = -dk * s - k * k * c, m.path.d3[1] = dk * c - k * k * s;
    m.v = v;
    return m;
  }
};

/// The plan as Brake sees it: cells of one length, with additional ends where the curvature begins to change.
struct Ahead {
  const BendPlan* plan;
  std::vector<double> edges;  ///< s
  size_t next = 0;

  Ahead(const BendPlan& of, double from) : plan(&of) {
    for (double u = 0; u < 1000; u += of.cell) edges.push_back((u - from) / of.v);
    for (const double u : {of.line, of.line + of.half, of.line + 2 * of.half}) edges.push_back((u - from) / of.v);
    std::sort(edges.begin(), edges.end());
    while (edges[next] <= 0) ++next;
    start = from;
  }
  double start = 0;
  double cell_end() const { return edges[next]; }
  PlanMoment at(double tau) {
    while (tau >= cell_end()) ++next;
    return plan->moment(start + plan->v * tau);
  }
  PlanMoment at_cell_end() const { return plan->moment(std::nextafter(start + plan->v * cell_end(), 0)); }
  PlanMoment at_next_cell() { return plan->moment(std::nextafter(start + plan->v * edges[next++], 1e9)); }
};

struct Worst {
  double acceleration = 0, jerk = 0;  ///< largest values, divided by their limits
  unsigned stops = 0;
};

/// Stops from many places before the bend and in it, and measures every 100 us by differences.
Worst measure(const BendPlan& plan, const optimal::Limits& limits) {
  constexpr double dt = 1e-4;
  Worst worst;
  for (double from = 0; from < plan.line + 2 * plan.half; from += (plan.line + 2 * plan.half) / 25) {
    Brake brake;
    if (!brake.find(Ahead(plan, from), limits, 1)) continue;
    ++worst.stops;
    // Velocities by the moments of the plan; one difference gives the acceleration, two the jerk.
    double u = from, v[2] = {}, a[2] = {};
    for (unsigned n = 0; !brake.done() && n < 8000; ++n) {
      u += plan.v * brake.advance(dt);
      const PlanMoment m = plan.moment(u);
      for (unsigned i = 0; i < 2; ++i) {
        const double now = m.path.d1[i] * m.v * brake.sigma(), accel = (now - v[i]) / dt;
        if (n > 0) worst.acceleration = std::max(worst.acceleration, std::fabs(accel) / limits.acceleration[i]);
        if (n > 1) worst.jerk = std::max(worst.jerk, std::fabs(accel - a[i]) / dt / limits.jerk[i]);
        v[i] = now, a[i] = accel;
      }
    }
  }
  return worst;
}

TEST(Brake, KeepsTheLimitsBetweenThePlacesItLooksAt) {
  std::mt19937 random(14);
  const auto scale = [&](double low, double high) { return low * std::pow(high / low, std::uniform_real_distribution<>(0, 1)(random)); };
  unsigned stops = 0;
  double acceleration = 0, jerk = 0;
  const unsigned plans = test::sanitized() ? 6 : 60;
  for (unsigned n = 0; n < plans; ++n) {
    BendPlan plan;
    optimal::Limits limits;
    limits.axis_count = 2;
    const double most = scale(500, 15000), jerks = most * scale(15, 3000);
    plan.v = scale(20, 400);
    for (unsigned i = 0; i < 2; ++i) {
      limits.acceleration[i] = most * (i == 0 ? 1 : scale(0.3, 1));
      limits.jerk[i] = jerks * (i == 0 ? 1 : scale(0.3, 1));
    }
    // Up to bends for which the plan would already have to be slower.
    plan.half = scale(0.02, 3);
    plan.growth = scale(1, 30) * std::min({limits.acceleration[1] / (plan.v * plan.v * plan.half), limits.jerk[1] / (plan.v * plan.v * plan.v)});
    plan.growth = std::min(plan.growth, 1.2 / (plan.half * plan.half));
    plan.line = 0.5 * plan.v * plan.v / most + plan.v * most / jerks;  // about the distance of a stop
    plan.cell = scale(0.05, 3);
    const Worst worst = measure(plan, limits);
    stops += worst.stops;
    acceleration = std::max(acceleration, worst.acceleration);
    jerk = std::max(jerk, worst.jerk);
    EXPECT_LE(worst.acceleration, 1.001) << n << " v " << plan.v << " A " << most << " J " << jerks << " half " << plan.half;
    EXPECT_LE(worst.jerk, 1.001) << n << " v " << plan.v << " A " << most << " J " << jerks << " half " << plan.half;
  }
  std::printf("%u stops, acceleration %.5f, jerk %.5f\n", stops, acceleration, jerk);
  EXPECT_GT(stops, (test::sanitized() ? 2 : 5) * plans);
}

/// Seconds that a stop takes; infinite if none is found. The limits are measured every `cycle` seconds.
double stops_after(const BendPlan& plan, const optimal::Limits& limits, double cycle, Worst* worst) {
  Brake brake;
  if (!brake.find(Ahead(plan, 0), limits, 1)) return INFINITY;
  double v = plan.v, a = 0;
  for (unsigned n = 1; n < 100000; ++n) {
    const double gone = plan.v * brake.advance(cycle) / cycle, accel = (gone - v) / cycle;
    worst->acceleration = std::max(worst->acceleration, std::fabs(accel) / limits.acceleration[0]);
    worst->jerk = std::max(worst->jerk, std::fabs(accel - a) / cycle / limits.jerk[0]);
    v = gone, a = accel;
    if (brake.done() && gone == 0) return n * cycle;
  }
  return INFINITY;
}

// With slow axes a stop may take less time than one of the steps in which a stop of fast axes is computed.
TEST(Brake, FindsAWayToRestHoweverSlowlyTheAxesGo) {
  for (const double cycle : {0.00025, 0.001}) {
    for (const double acceleration : {500.0, 2000.0, 20000.0}) {
      for (const double rise : {0.05, 0.01, 0.0003}) {  // s in which the acceleration is reached
        for (double v = 1e-12; v < 30; v *= 1.7) {
          BendPlan plan;
          plan.growth = 0;
          plan.v = v;
          optimal::Limits limits;
          limits.axis_count = 2;
          for (unsigned i = 0; i < 2; ++i) limits.acceleration[i] = acceleration, limits.jerk[i] = acceleration / rise;
          Worst worst;
          const double soonest = v / acceleration + std::min(rise, 2 * std::sqrt(v * rise / acceleration));
          EXPECT_LT(stops_after(plan, limits, cycle, &worst), 2 * soonest + 2.5 * cycle) << v << " mm/s, " << acceleration << " mm/s2 in " << rise << " s";
          EXPECT_LE(worst.acceleration, 1.001) << v << " mm/s, " << acceleration << " mm/s2 in " << rise << " s";
          EXPECT_LE(worst.jerk, 1.001) << v << " mm/s, " << acceleration << " mm/s2 in " << rise << " s";
        }
      }
    }
  }
}

}  // namespace
}  // namespace nc
