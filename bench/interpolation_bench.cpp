// SPDX-License-Identifier: Apache-2.0
// What one servo cycle of one part system with five axes costs the scan: everything from the inputs to the commanded positions. Each
// program is run many times in the same way, and for each of its cycles the shortest time of all runs counts: an interruption by the computer
// hardly ever hits the same cycle in every run. `worst` is the longest of these times, the time of a benchmark their mean.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "interpolate/executor.hpp"
#include "interpolate/run_word.hpp"
#include "path/shape.hpp"

namespace {

using namespace nc;

constexpr unsigned kAxes = 5;
constexpr uint32_t kRotary = 0b11000;
constexpr unsigned kRuns = 15;
constexpr unsigned kMostCycles = 20000;

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

struct Program {
  std::vector<Record> records;
  std::vector<std::unique_ptr<CurveShape>> shapes;
  AxisVec at;

  Segment& add(const Curve& curve, double feed) {
    Record r;
    r.kind = ItemKind::move;
    r.serial = records.size() + 1;
    r.segment = Segment{};
    r.segment.curve = curve;
    r.segment.feed_mm_s = feed;
    at = curve.end;
    records.push_back(r);
    return records.back().segment;
  }
  void line(const AxisVec& to, double feed) { add(make_line(at, to, kAxes, kRotary), feed); }
};

AxisVec place(double x, double y, double z, double a, double c) { return AxisVec{{x, y, z, a, c}}; }

/// A wave in all five axes.
Program wave(double step, double length) {
  Program p;
  for (double s = step; s < length; s += step)
    p.line(place(s, 3 * std::sin(s), std::cos(0.7 * s) - 1, 5 * std::sin(0.2 * s), 8 * std::sin(0.15 * s)), 100);
  return p;
}

Program helices() {
  Program p;
  for (int i = 0; i < 8; ++i) {
    Circle k;
    k.center[0] = -10;
    k.radius_start = k.radius_end = 10;
    k.sweep = i & 1 ? -6 : 6;
    k.angle_start = i & 1 ? 6 : 0;
    AxisVec end = p.at;
    end[0] = -10 + 10 * std::cos(k.angle_start + k.sweep);
    end[1] = 10 * std::sin(k.angle_start + k.sweep);
    end[2] = i & 1 ? 0 : 5;
    end[3] = i & 1 ? 0 : 20;
    end[4] = i & 1 ? 0 : -30;
    p.add(make_arc(p.at, end, 0, 1, k, kAxes, kRotary), 100);
  }
  return p;
}

/// Spans of a cubic, each of which nearly has a cusp in its middle; the smaller `gap` (mm), the sharper it is.
Program spans(double gap) {
  Program p;
  for (int i = 0; i < 6; ++i) {
    MoveShape what;
    what.kind = ShapeKind::rational;
    what.span = RationalSpan{{{0, 0, 0}, {10 + gap, 10, 1}, {-gap, 10, 2}, {10, 0, 1}}, {1, 1, 1, 1}, {0, 1, 2}, 3};
    for (auto& point : what.span.point)
      for (unsigned n = 0; n < 3; ++n) point[n] += p.at[n];
    AxisVec end;
    for (unsigned n = 0; n < 3; ++n) end[n] = what.span.point[3][n];
    p.shapes.push_back(std::make_unique<CurveShape>());
    Curve curve;
    const AxisVec start = p.at;
    make_shaped(what, PlainMove{&start, &end, nullptr, 0, 1}, Affine{}, start, kAxes, kRotary, p.shapes.back().get(), &curve);
    p.add(curve, 100);
  }
  return p;
}

/// A line in the plane of polar coordinate interpolation (G12.1) that passes the pole at a distance, in mm.
Program polar(double distance) {
  Program p;
  MoveShape what;
  what.map.kind = AxisMap::Kind::polar;
  what.map.linear = 0;
  what.map.rotary = 4;
  AxisVec start = place(20, distance, 0, 0, 0), end = place(-20, distance, 0, 0, 0), machine;
  start[4] = distance, start[1] = 0;
  end[4] = distance, end[1] = 0;
  p.at[0] = machine[0] = std::hypot(20, distance);
  p.at[4] = machine[4] = std::atan2(distance, 20) * 57.29577951308232;
  p.shapes.push_back(std::make_unique<CurveShape>());
  Curve curve;
  make_shaped(what, PlainMove{&start, &end, nullptr, 0, 4}, Affine{}, machine, kAxes, kRotary, p.shapes.back().get(), &curve);
  p.at = curve.start;
  p.add(curve, 100);
  return p;
}

struct Machine {
  Machine(bool optimal, uint32_t capacity) {
    config.axis_count = kAxes;
    for (unsigned i = 0; i < kAxes; ++i) config.limits[i] = {250, 250, 2000, 50000, 0.01};
    config.limits[3] = config.limits[4] = {360, 360, 4000, 100000, 0.01};
    config.rotary = kRotary;
    config.capacity = capacity;
    config.optimal = optimal;
    Arena measure;
    Executor().create(config, measure);
    const size_t size = (measure.used() + 127) / 64 * 64;
    memory.reset(std::aligned_alloc(64, size));
    Arena arena(memory.get(), size);
    executor.create(config, arena);
    in.feed_override = in.rapid_override = 1;
  }
  ExecutorConfig config;
  std::unique_ptr<void, FreeAligned> memory;
  Executor executor;
  nc_inputs in{};
  nc_outputs out{};
};

/// One run; `best` keeps for each cycle the shortest time of the runs so far, in s.
void run(const Program& p, bool optimal, std::vector<double>* best) {
  Machine m(optimal, 4096);
  const AxisVec& start = p.records.front().segment.curve.start;
  m.executor.set_position(start);
  size_t next = 0;
  for (unsigned n = 0; n < kMostCycles; ++n) {
    while (next < p.records.size() && m.executor.room() > 0) {
      Record r = p.records[next++];
      r.epoch = nc::RunWord(m.executor.run()).epoch();
      m.executor.push(r);
    }
    m.executor.plan();
    m.in.cycle_start = n == 5;
    const auto from = std::chrono::steady_clock::now();
    m.executor.cycle(m.in, m.out);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
    if (n < best->size()) {
      (*best)[n] = std::min((*best)[n], took);
    } else {
      best->push_back(took);
    }
    if (n > 20 && next == p.records.size() && m.executor.drained()) break;
  }
}

void cycle(benchmark::State& state, const Program& p, bool optimal) {
  for (auto _ : state) {
    std::vector<double> best;
    for (unsigned n = 0; n < kRuns; ++n) run(p, optimal, &best);
    std::vector<double> sorted = best;
    std::sort(sorted.begin(), sorted.end());
    double sum = 0;
    for (const double t : best) sum += t;
    state.SetIterationTime(sum / static_cast<double>(best.size()));
    state.counters["cycles"] = static_cast<double>(best.size());
    state.counters["median ns"] = 1e9 * sorted[sorted.size() / 2];
    state.counters["99 % ns"] = 1e9 * sorted[sorted.size() * 99 / 100];
    state.counters["worst ns"] = 1e9 * sorted.back();
  }
}

#define NC_CYCLE(name, program)                                                                   \
  BENCHMARK_CAPTURE(cycle, trapezoid_##name, program, false)->UseManualTime()->Iterations(1); \
  BENCHMARK_CAPTURE(cycle, optimal_##name, program, true)->UseManualTime()->Iterations(1)
NC_CYCLE(lines_20mm, wave(20, 400));
NC_CYCLE(lines_200um, wave(0.2, 100));
NC_CYCLE(lines_10um, wave(0.01, 40));
NC_CYCLE(lines_1um, wave(0.001, 10));
NC_CYCLE(helices, helices());
NC_CYCLE(nurbs, spans(2));
NC_CYCLE(nurbs_cusp, spans(0.01));
NC_CYCLE(polar_1mm, polar(1));
NC_CYCLE(polar_50um, polar(0.05));

}  // namespace
