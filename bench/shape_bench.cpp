// SPDX-License-Identifier: Apache-2.0
// For every shape of a curve: what a point (the set-point of one cycle) costs, with derivatives, and what making the shape at commit costs.
// And what the filters behind the interpolation cost for five axes per cycle.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "filter/position_filter.hpp"
#include "path/shape.hpp"

namespace {

using namespace nc;

constexpr unsigned kAxes = 4;
constexpr uint32_t kRotary = 0b1000;

struct Program {
  MoveShape what;
  AxisVec start, end, machine;
  Circle circle;
  bool circular = false;
};

Program space_arc() {
  Program p;
  p.what.kind = ShapeKind::space_arc;
  p.what.arc = SpaceArc{{0, 0, 0}, {-1, 0, 0}, {0, 0.6, 0.8}, 20, 3, {0, 1, 2}};
  p.start[0] = -20;
  p.end[0] = -20 * std::cos(3.0);
  p.end[1] = 12 * std::sin(3.0);
  p.end[2] = 16 * std::sin(3.0);
  p.machine = p.start;
  return p;
}

Program exponential() {
  Program p;
  const double k = 105 / std::tan(50 * std::numbers::pi / 180), d = std::tan(80 * std::numbers::pi / 180) / std::tan(50 * std::numbers::pi / 180);
  p.what.kind = ShapeKind::exponential;
  p.what.exponential = Exponential{k, d, d * std::log(100 / k + 1), 180 / std::numbers::pi, 0, 3};
  p.end[0] = 100;
  p.end[2] = 100;
  p.end[3] = p.what.exponential.end * 180 / std::numbers::pi;
  return p;
}

Program nurbs() {
  Program p;
  p.what.kind = ShapeKind::rational;
  p.what.span = RationalSpan{{{0, 0, 0}, {4, 6, 1}, {9, 5, 2}, {12, 0, 1}}, {1, 0.8, 1.3, 1}, {0, 1, 2}, 3};
  for (unsigned i = 0; i < 3; ++i) p.end[i] = p.what.span.point[3][i];
  return p;
}

/// A span that nearly has a cusp in its middle: the worst case for finding the parameter that belongs to a length.
Program cusp(double gap) {
  Program p;
  p.what.kind = ShapeKind::rational;
  p.what.span = RationalSpan{{{0, 0, 0}, {10 + gap, 10, 1}, {-gap, 10, 2}, {10, 0, 1}}, {1, 1, 1, 1}, {0, 1, 2}, 3};
  for (unsigned i = 0; i < 3; ++i) p.end[i] = p.what.span.point[3][i];
  return p;
}

Program mapped(AxisMap::Kind kind, bool circular) {
  Program p;
  p.what.map.kind = kind;
  p.what.map.linear = 0;
  p.what.map.rotary = 3;
  p.what.map.scale = 0.5;
  p.circular = circular;
  p.circle.center[0] = 5;
  p.circle.radius_start = p.circle.radius_end = 20;
  p.circle.sweep = 2;
  p.start[0] = 25;
  p.end[0] = 5 + 20 * std::cos(2.0);
  p.end[3] = 20 * std::sin(2.0);
  p.machine = p.start;
  return p;
}

void make(const Program& p, CurveShape* shape, Curve* curve) {
  make_shaped(p.what, PlainMove{&p.start, &p.end, p.circular ? &p.circle : nullptr, 0, 3}, Affine{}, p.machine, kAxes, kRotary, shape,
              curve);
}

void point(benchmark::State& state, const Program& p) {
  CurveShape shape;
  Curve c;
  make(p, &shape, &c);
  double s = 0;
  for (auto _ : state) {
    s += 0.001;
    if (s > c.length) s = 0;
    benchmark::DoNotOptimize(curve_position(c, s, kAxes));
  }
}
void derivatives(benchmark::State& state, const Program& p) {
  CurveShape shape;
  Curve c;
  make(p, &shape, &c);
  double s = 0;
  for (auto _ : state) {
    s += 0.001;
    if (s > c.length) s = 0;
    benchmark::DoNotOptimize(curve_evaluate(c, s, kAxes));
  }
}
void commit(benchmark::State& state, const Program& p) {
  CurveShape shape;
  Curve c;
  for (auto _ : state) {
    make(p, &shape, &c);
    benchmark::DoNotOptimize(c.length);
  }
}

/// The time of a point where the curve costs most: of 4,096 places, each of which has the best mean of 16 points in 50 tries.
void worst(benchmark::State& state, const Program& p) {
  constexpr unsigned kPlaces = 4096, kTimes = 50, kPoints = 16;
  CurveShape shape;
  Curve c;
  make(p, &shape, &c);
  for (auto _ : state) {
    double most = 0;
    for (unsigned k = 0; k < kPlaces; ++k) {
      const double s = c.length * k / kPlaces;
      double best = HUGE_VAL;
      for (unsigned n = 0; n < kTimes; ++n) {
        const auto begin = std::chrono::steady_clock::now();
        for (unsigned m = 0; m < kPoints; ++m) benchmark::DoNotOptimize(curve_position(c, s, kAxes));
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / kPoints);
      }
      most = std::max(most, best);
    }
    state.SetIterationTime(most);
  }
}

#define NC_SHAPE(name, program)                     \
  BENCHMARK_CAPTURE(point, name, program);          \
  BENCHMARK_CAPTURE(derivatives, name, program);    \
  BENCHMARK_CAPTURE(worst, name, program)->UseManualTime()->Iterations(1); \
  BENCHMARK_CAPTURE(commit, name, program)
NC_SHAPE(space_arc, space_arc());
NC_SHAPE(exponential, exponential());
NC_SHAPE(nurbs, nurbs());
NC_SHAPE(cusp_100um, cusp(0.1));
NC_SHAPE(cusp_1um, cusp(0.001));
NC_SHAPE(cylinder_line, mapped(AxisMap::Kind::cylinder, false));
NC_SHAPE(cylinder_arc, mapped(AxisMap::Kind::cylinder, true));
NC_SHAPE(polar_line, mapped(AxisMap::Kind::polar, false));
NC_SHAPE(polar_arc, mapped(AxisMap::Kind::polar, true));

/// One cycle of five axes. Kind `after`: each axis has a mean over first_ms and behind it a lag of second_ms. Otherwise all axes have two means,
/// over first_ms and over second_ms.
void filters(benchmark::State& state, FilterTimes::Kind kind, double first_ms, double second_ms) {
  constexpr unsigned kFilteredAxes = 5;
  constexpr uint32_t kPlaces = 4000;
  std::vector<double> rings(size_t{kFilteredAxes} * kPlaces);
  nc::PositionFilter filter;
  filter.create(kFilteredAxes, 0.001, rings.data(), kPlaces);
  FilterTimes times;
  times.kind = kind;
  const bool after = kind == FilterTimes::Kind::after;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    times.mean[i] = static_cast<uint16_t>(filter_cycles(first_ms, 0.001));
    times.lag_s[i] = after ? static_cast<float>(second_ms / 1000) : 0;
  }
  if (!after) times.second = static_cast<uint16_t>(filter_cycles(second_ms, 0.001));
  if (!filter.use(times)) state.SkipWithError("too long");
  AxisVec at;
  for (auto _ : state) {
    for (unsigned i = 0; i < kFilteredAxes; ++i) at[i] += 0.01 * (i + 1);
    benchmark::DoNotOptimize(filter.filter(at, false));
  }
}
BENCHMARK_CAPTURE(filters, none, FilterTimes::Kind::none, 0, 0);
BENCHMARK_CAPTURE(filters, linear, FilterTimes::Kind::after, 100, 0);
BENCHMARK_CAPTURE(filters, exponential, FilterTimes::Kind::after, 0, 50);
BENCHMARK_CAPTURE(filters, linear_exponential, FilterTimes::Kind::after, 100, 50);
BENCHMARK_CAPTURE(filters, longest, FilterTimes::Kind::after, 4000, 5000);
BENCHMARK_CAPTURE(filters, s_pattern, FilterTimes::Kind::before, 50, 30);

}  // namespace
