// SPDX-License-Identifier: Apache-2.0
// What a point of every shape costs (set-point of one cycle), with derivatives, and making one at commit.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "path/shape.hpp"

namespace {

using namespace nc;

constexpr unsigned kAxes = 4;
constexpr uint32_t kRotary = 0b1000;
const AxisVec kPlus{{1, 1, 1, 1, 1, 1, 1, 1}};

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
  make_shaped(p.what, PlainMove{&p.start, &p.end, p.circular ? &p.circle : nullptr, 0, 3}, kPlus, AxisVec{}, p.machine, kAxes, kRotary, shape,
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

#define NC_SHAPE(name, program)                     \
  BENCHMARK_CAPTURE(point, name, program);          \
  BENCHMARK_CAPTURE(derivatives, name, program);    \
  BENCHMARK_CAPTURE(commit, name, program)
NC_SHAPE(space_arc, space_arc());
NC_SHAPE(exponential, exponential());
NC_SHAPE(nurbs, nurbs());
NC_SHAPE(cylinder_line, mapped(AxisMap::Kind::cylinder, false));
NC_SHAPE(cylinder_arc, mapped(AxisMap::Kind::cylinder, true));
NC_SHAPE(polar_line, mapped(AxisMap::Kind::polar, false));
NC_SHAPE(polar_arc, mapped(AxisMap::Kind::polar, true));

}  // namespace
