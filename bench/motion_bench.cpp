// SPDX-License-Identifier: Apache-2.0
// What motion costs: the evaluation of a curve, the planning of a segment (limits, joints, backward pass,
// publication), the interpolation of a cycle.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

#include "interpolate/executor.hpp"
#include "interpolate/run_word.hpp"

namespace {

using namespace nc;

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

ExecutorConfig config_of(uint32_t capacity, unsigned axes = 3) {
  ExecutorConfig c;
  c.axis_count = axes;
  for (unsigned i = 0; i < axes; ++i) c.limits[i] = {250, 250, 2000, 50000, 0.01};
  c.capacity = capacity;
  return c;
}

struct Machine {
  explicit Machine(const ExecutorConfig& setup) : config(setup) {
    Arena measure;
    Executor().create(config, measure);
    const size_t size = (measure.used() + 127) / 64 * 64;
    memory.reset(std::aligned_alloc(64, size));
    Arena arena(memory.get(), size);
    executor.create(config, arena);
    in.feed_override = in.rapid_override = 1;
  }
  void cycle() { executor.cycle(in, out); }
  ExecutorConfig config;
  std::unique_ptr<void, FreeAligned> memory;
  Executor executor;
  nc_inputs in{};
  nc_outputs out{};
};

/// A wavy path of straight pieces as in a surface program; the last of the kPieces ends where the first begins.
constexpr unsigned kPieces = 4096;
std::vector<Record> surface(double step, double feed) {
  std::vector<Record> records;
  AxisVec at;
  double heading = 0;
  for (unsigned i = 0; i < kPieces; ++i) {
    AxisVec end = at;
    heading = 0.6 * std::sin(i * 0.05);
    const double way = i < kPieces / 2 ? step : -step;
    end[0] += way * std::cos(heading);
    end[1] += way * std::sin(heading);
    end[2] = 0.2 * std::sin(i * 2 * 3.14159265358979 / kPieces);
    if (i + 1 == kPieces) end = AxisVec{};
    Record r;
    r.kind = ItemKind::move;
    r.segment = Segment{};
    r.segment.curve = make_line(at, end, 3, 0);
    r.segment.feed_mm_s = feed;
    records.push_back(r);
    at = end;
  }
  return records;
}

Curve arc_curve(double spiral, bool helix) {
  Circle k;
  k.radius_start = 10;
  k.radius_end = 10 + spiral;
  k.sweep = 5;
  AxisVec a, b;
  a[0] = 10;
  b[0] = k.radius_end * std::cos(5.0);
  b[1] = k.radius_end * std::sin(5.0);
  b[2] = helix ? 7 : 0;
  return make_arc(a, b, 0, 1, k, 3, 0);
}

void curve(benchmark::State& state, const Curve& c) {
  double s = 0;
  for (auto _ : state) {
    s += 0.001;
    if (s > c.length) s = 0;
    benchmark::DoNotOptimize(curve_position(c, s, 3));
  }
}
void BM_CurveLine(benchmark::State& state) {
  AxisVec b;
  b[0] = 50;
  b[1] = 20;
  curve(state, make_line({}, b, 3, 0));
}
void BM_CurveArc(benchmark::State& state) {
  curve(state, arc_curve(0, false));
}
void BM_CurveHelix(benchmark::State& state) {
  curve(state, arc_curve(0, true));
}
void BM_CurveSpiral(benchmark::State& state) {
  curve(state, arc_curve(0.05, true));
}
void BM_CurveDerivatives(benchmark::State& state) {
  const Curve c = arc_curve(0, true);
  double s = 0;
  for (auto _ : state) {
    s += 0.001;
    if (s > c.length) s = 0;
    benchmark::DoNotOptimize(curve_evaluate(c, s, 3));
  }
}
BENCHMARK(BM_CurveLine);
BENCHMARK(BM_CurveArc);
BENCHMARK(BM_CurveHelix);
BENCHMARK(BM_CurveSpiral);
BENCHMARK(BM_CurveDerivatives);

/// push() and plan() until the ring is full, with a plan() after every `batch` segments. In between, and not
/// measured, a reset empties the ring. Argument 0: batch; 1: segment length in um (with short segments the backward
/// pass goes back far).
void BM_Plan(benchmark::State& state) {
  const unsigned batch = static_cast<unsigned>(state.range(0));
  const std::vector<Record> records = surface(static_cast<double>(state.range(1)) * 1e-3, 100);
  Machine m(config_of(4096));
  uint64_t pushed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    m.in.reset = true;  // a new epoch: what is in the ring is void
    m.cycle();
    m.in.reset = false;
    m.cycle();
    while (!m.executor.drained()) {
      m.executor.plan();
      m.cycle();
    }
    const uint32_t epoch = nc::RunWord(m.executor.run()).epoch();
    std::vector<Record> now = records;
    for (Record& r : now) r.epoch = epoch;
    state.ResumeTiming();
    for (unsigned i = 0; i < kPieces; ++i) {
      m.executor.push(now[i]);
      if (i % batch == batch - 1) m.executor.plan();
    }
    m.executor.plan();
    pushed += kPieces;
  }
  state.counters["segments/s"] = benchmark::Counter(static_cast<double>(pushed), benchmark::Counter::kIsRate);
}
BENCHMARK(BM_Plan)->Args({64, 200})->Args({16, 200})->Args({64, 10})->Args({64, 1})->Args({1, 200});

/// Replanning of a full ring after a change of the override.
void BM_ReplanOverride(benchmark::State& state) {
  const std::vector<Record> records = surface(0.05, 100);
  Machine m(config_of(4096));
  for (unsigned i = 0; i < kPieces; ++i) m.executor.push(records[i]);
  for (auto _ : state) {
    state.PauseTiming();
    m.in.feed_override = m.in.feed_override > 0.75 ? 0.5 : 1;
    m.cycle();
    state.ResumeTiming();
    m.executor.plan();
  }
}
BENCHMARK(BM_ReplanOverride);

/// plan() of the time-optimal mode on an endless path, called every five cycles as a feeder does. Segments a second are those that were gone and the time of
/// planning behind the first 1,000 calls: in the first ones the ring is read ahead once, which is a share of the time that only the length of the run decides.
void plan_optimal(benchmark::State& state, const std::vector<Record>& records, uint32_t capacity) {
  ExecutorConfig config = config_of(capacity);
  config.optimal = true;
  config.tolerance = 0.01;
  Machine m(config);
  constexpr uint64_t kReadAhead = 1000;
  uint64_t pushed = 0, cycles = 0, calls = 0, gone_before = 0;
  double longest = 0, planning = 0, planning_before = 0;
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const auto gone = [&] { return pushed - (config.capacity - m.executor.room()); };  // without the segments that still wait in the ring
  for (auto _ : state) {
    if (calls++ == kReadAhead) {
      gone_before = gone();
      planning_before = planning;
    }
    while (m.executor.room() > 0) m.executor.push(records[pushed++ % records.size()]);
    const double from = now();
    m.executor.plan();
    const double took = now() - from;
    planning += took;
    longest = std::max(longest, took);
    state.SetIterationTime(took);
    for (unsigned n = 0; n < 5; ++n, ++cycles) {
      m.in.cycle_start = cycles == 5;
      m.cycle();
    }
  }
  state.counters["segments/s"] = static_cast<double>(gone() - gone_before) / (planning - planning_before);
  state.counters["real time x"] = static_cast<double>(cycles) * config.cycle_s / planning;
  state.counters["path_mm/s"] = m.out.path_length / (static_cast<double>(cycles) * config.cycle_s);
  state.counters["longest ms"] = longest * 1e3;
}
/// A path whose waves have 126 lines each, whatever their length: shorter lines make smaller waves. Argument: segment length in um.
void BM_PlanOptimal(benchmark::State& state) {
  plan_optimal(state, surface(static_cast<double>(state.range(0)) * 1e-3, 100), 4096);
}
// Laws reach over seconds, so a few of them would decide a run of ten.
BENCHMARK(BM_PlanOptimal)->Arg(200)->Arg(50)->Arg(10)->UseManualTime()->Iterations(31000);
BENCHMARK(BM_PlanOptimal)->Arg(1)->UseManualTime()->Iterations(11000);

/// A circle of radius 10 mm in lines, on which the full feed is reached. Argument: segment length in um.
void BM_PlanOptimalCircle(benchmark::State& state) {
  constexpr double kRadius = 10;
  const unsigned count = static_cast<unsigned>(2 * 3.14159265358979 * kRadius * 1e3 / static_cast<double>(state.range(0)));
  std::vector<Record> records;
  AxisVec at;
  for (unsigned i = 1; i <= count; ++i) {
    AxisVec end;
    const double angle = 2 * 3.14159265358979 * i / count;
    if (i < count) end[0] = kRadius * (std::cos(angle) - 1), end[1] = kRadius * std::sin(angle);
    Record r;
    r.kind = ItemKind::move;
    r.segment = Segment{};
    r.segment.curve = make_line(at, end, 3, 0);
    r.segment.feed_mm_s = 100;
    records.push_back(r);
    at = end;
  }
  plan_optimal(state, records, 65536);
}
BENCHMARK(BM_PlanOptimalCircle)->Arg(200)->Arg(50)->Arg(10)->UseManualTime()->Iterations(7000);
BENCHMARK(BM_PlanOptimalCircle)->Arg(1)->UseManualTime()->Iterations(2500);

/// One servo cycle on an endless path; feeding the executor is not measured. Argument: segment length in um.
void BM_Cycle(benchmark::State& state, bool arcs) {
  const double step = static_cast<double>(state.range(0)) * 1e-3;
  Machine m(config_of(8192));
  std::vector<Record> records = surface(step, 100);
  if (arcs) {
    records.clear();
    AxisVec at;
    for (int i = 0; i < 64; ++i) {  // helices up and down
      Circle k;
      k.center[0] = -10;
      k.radius_start = k.radius_end = 10;
      k.sweep = (i & 1 ? -1 : 1) * 6.283185307179586 * step / 60;
      k.angle_start = i & 1 ? -k.sweep : 0;
      AxisVec end = at;
      end[0] = -10 + 10 * std::cos(k.angle_start + k.sweep);
      end[1] = 10 * std::sin(k.angle_start + k.sweep);
      end[2] = i & 1 ? 0 : 5;
      Record r;
      r.kind = ItemKind::move;
      r.segment = Segment{};
      r.segment.curve = make_arc(at, end, 0, 1, k, 3, 0);
      r.segment.feed_mm_s = 100;
      records.push_back(r);
      at = end;
    }
  }
  size_t next = 0;
  const auto feed = [&] {
    while (m.executor.room() > 1) {
      m.executor.push(records[next]);
      next = (next + 1) % records.size();
    }
    m.executor.plan();
  };
  feed();
  m.in.cycle_start = true;
  m.cycle();
  uint64_t cycles = 0;
  while (state.KeepRunningBatch(256)) {
    state.PauseTiming();
    feed();
    state.ResumeTiming();
    for (int i = 0; i < 256; ++i) m.cycle();
    cycles += 256;
  }
  state.counters["path_mm/s"] = m.out.path_length / (static_cast<double>(cycles) * 1e-3);
}
void BM_CycleLines(benchmark::State& state) {
  BM_Cycle(state, false);
}
void BM_CycleHelices(benchmark::State& state) {
  BM_Cycle(state, true);
}
BENCHMARK(BM_CycleLines)->Arg(5000)->Arg(200)->Arg(10)->Arg(1);
BENCHMARK(BM_CycleHelices)->Arg(60000);

}  // namespace
