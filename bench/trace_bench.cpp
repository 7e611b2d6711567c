// SPDX-License-Identifier: Apache-2.0
// What a signal trace costs the scan: the machine of etc/machine.toml with its ladder runs an endless program, and passes of scans with a recording of 64 signals
// take turns with passes without one, so that whatever else the computer does is in both. The recording waits for a trigger that does not come: its ring runs round, which
// is the most that a scan has to do. Times are those of the scan with the feeder's step before it; the figures are medians and 99 % of all scans of each kind, and
// the median of the differences of neighbouring passes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"

namespace {

constexpr unsigned kPass = 500;    // scans of one pass
constexpr unsigned kWarmUp = 50;   // of them that do not count: the caches still hold what was before
constexpr char kProgram[] = "G90 G17 G64 F6000.\nN1 G1 X5. Y1. Z-2.\nG3 X5. Y5. J2.\n#100=#100+1\nG2 X0. Y0. R6. Z0.\nGOTO 1\n";

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

// Points, devices of the ladder and signals of the NC, a third of each.
nc::rt::trace::Plan plan_of(nc::rt::Runtime* runtime, const nc::rt::Config& config) {
  nc::rt::trace::Plan plan;
  const auto take = [&](const std::string& name, std::size_t most) {
    nc::rt::trace::Source source;
    if (plan.sources.size() < most && runtime->trace()->find(name, &source)) plan.sources.push_back(source);
  };
  constexpr std::size_t kThird = nc::rt::trace::kMostSignals / 3;
  for (unsigned p = 0; p < config.points.size(); ++p) take(config.points.at(p).name, kThird);
  for (unsigned n = 0; n < kThird; ++n) take((n % 2 == 0 ? "D" : "M") + std::to_string(n), 2 * kThird);
  for (const nc::rt::Signal& signal : runtime->signals()->signals()) take(signal.name, nc::rt::trace::kMostSignals);
  plan.when = nc::rt::trace::When::kHigh;
  plan.level = 2'000'000'000;
  plan.rows = 1000;
  return plan;
}

double us(std::vector<std::int64_t>* times, double part) {
  const auto at = times->begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(times->size() - 1));
  std::nth_element(times->begin(), at, times->end());
  return static_cast<double>(*at) / 1e3;
}

void trace(benchmark::State& state) {
  nc::rt::Config config;
  for (const nc::rt::ConfigError& error : nc::rt::load_config(NC_SOURCE_DIR "/etc/machine.toml", &config)) state.SkipWithError(error.text().c_str());
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  unsigned file = 0;
  std::string error;
  if (runtime == nullptr || nc_program_add_text(runtime->control(), "bench.nc", kProgram, sizeof kProgram - 1, &file) != NC_OK || !runtime->start_stepping(&error) ||
      runtime->select_program(file) != nc::rt::Answer::kDone || runtime->execute(nc::rt::CommandKind::kCycleStart) != nc::rt::Answer::kDone) {
    state.SkipWithError(("the runtime does not start: " + error).c_str());
    return;
  }
  const nc::rt::trace::Plan plan = plan_of(runtime.get(), config);
  std::vector<std::int64_t> times[2], differences;
  const auto pass = [&](unsigned armed) {
    std::vector<std::int64_t> own;
    for (unsigned n = 0; n < kPass; ++n) {
      const std::int64_t began = now_ns();
      runtime->step();
      if (n >= kWarmUp) own.push_back(now_ns() - began);
    }
    times[armed].insert(times[armed].end(), own.begin(), own.end());
    return static_cast<std::int64_t>(us(&own, 0.5) * 1e3);
  };
  for (auto _ : state) {
    const std::int64_t without = pass(0);
    if (!runtime->trace()->arm(plan)) state.SkipWithError("the trace is not armed");
    const std::int64_t with = pass(1);
    runtime->trace()->stop();
    runtime->step();
    differences.push_back(with - without);
  }
  if (runtime->snapshot().alarmed()) state.SkipWithError("the program stopped on an alarm");
  state.counters["signals"] = static_cast<double>(plan.sources.size());
  state.counters["off_p50_us"] = us(&times[0], 0.5);
  state.counters["off_p99_us"] = us(&times[0], 0.99);
  state.counters["armed_p50_us"] = us(&times[1], 0.5);
  state.counters["armed_p99_us"] = us(&times[1], 0.99);
  state.counters["difference_p50_us"] = us(&differences, 0.5);
}
BENCHMARK(trace)->Iterations(300)->Unit(benchmark::kMillisecond);

}  // namespace
