// SPDX-License-Identifier: Apache-2.0
// Execution time of a scan with three axes, 64 points and a ladder program: inputs, ladder, NC, outputs, snapshot, on the
// simulated machine. The distribution comes from the runtime's own histogram (p50, p99, p99.9, max); wake-up
// jitter is another figure, see runtime_process.py. Goal: at most 50 us at p99.9.
#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"

namespace {

std::string configuration(unsigned points) {
  std::string text = "[machine]\n";
  for (const char* name : {"X", "Y", "Z"})
    text += std::string("[[axis]]\nname = \"") + name +
            "\"\nmax_velocity = 500.0\nmax_acceleration = 5000.0\nmax_jerk = 100000.0\nsoft_limits = "
            "[-1000.0, 1000.0]\n";
  std::string map = "[macro_interface]\n";
  for (unsigned p = 0; p < points; ++p) {
    const bool input = p < points / 2;
    const std::string name = (input ? "in" : "out") + std::to_string(p);
    text += "[[point]]\nname = \"" + name + "\"\ndirection = \"" + (input ? "input" : "output") + "\"\n";
    map += "\"#" + std::to_string((input ? 1000 : 1100) + p % (points / 2)) + "\" = \"" + name + "\"\n";
  }
  return text + map;
}

// Lines, arcs, outputs, and an input read in a loop that never ends.
constexpr char kProgram[] =
    "G90 G17 G64 F6000.\n"
    "N1 G1 X50. Y10. Z-5.\n"
    "G3 X50. Y50. J20.\n"
    "#1132=#1132+1\n"
    "G2 X0. Y0. R60. Z0.\n"
    "G0 X-20. Y-20.\n"
    "#100=#1032\n"
    "X0. Y0.\n"
    "GOTO 1\n";

// A ladder program of so many instructions over the points and the NC's signals: contacts, coils, timers, compares,
// moves and arithmetic as a machine's program mixes them; and the completion of M, S, T.
std::string ladder(unsigned instructions) {
  std::string text = "LD nc.m_strobe\nOR nc.s_strobe\nOR nc.t_strobe\nOUT plc.fin2\n";
  unsigned count = 5;  // with END
  for (unsigned n = 0; count + 10 <= instructions; ++n, count += 10) {
    const std::string in = "in" + std::to_string(n % 32), other = "in" + std::to_string((n + 7) % 32);
    const std::string out = "out" + std::to_string(32 + n % 30), m = "M" + std::to_string(n), k = std::to_string(n);
    text += "LD " + in + "\nAND " + other + "\nOR " + m + "\nANI nc.alarm\nOUT " + m + "\nLD " + m + "\nOUT T" + k +
            " K5\nAND> D" + k + " K100\nMOV K" + k + " D" + k + "\nSET " + out + "\n";
  }
  return text + "END\n";
}

// Scans with 3 axes and 64 points mapped to the macro interface; range(0): instructions of the ladder, 0 = none.
void scan(benchmark::State& state) {
  nc::rt::Config config;
  const auto instructions = static_cast<unsigned>(state.range(0));
  const std::string path = std::string(std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "/tmp") +
                           "/nc_scan_bench_" + std::to_string(getpid()) + ".il";
  std::string text = configuration(64);
  if (instructions != 0) {
    std::ofstream(path) << ladder(instructions);
    text += "[ladder]\nprogram = \"" + path + "\"\n";
  }
  for (const nc::rt::ConfigError& error : nc::rt::parse_config(text, "bench.toml", &config)) {
    state.SkipWithError(error.text().c_str());
    return;
  }
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  if (instructions != 0) std::remove(path.c_str());
  for (const nc::rt::ConfigError& e : errors) state.SkipWithError(e.text().c_str());
  unsigned file = 0;
  std::string error;
  if (runtime == nullptr ||
      nc_program_add_text(runtime->control(), "bench.nc", kProgram, sizeof kProgram - 1, &file) != NC_OK ||
      !runtime->start_stepping(&error) || runtime->select_program(file) != nc::rt::Answer::kDone ||
      runtime->execute(nc::rt::CommandKind::kCycleStart) != nc::rt::Answer::kDone) {
    state.SkipWithError("the runtime does not start");
    return;
  }
  for (auto _ : state) runtime->step();
  if (runtime->snapshot().alarmed()) state.SkipWithError("the program stopped on an alarm");
  const nc::rt::Histogram& execution = runtime->statistics().execution;
  state.counters["scan_p50_us"] = static_cast<double>(execution.percentile_ns(0.5)) / 1e3;
  state.counters["scan_p99_us"] = static_cast<double>(execution.percentile_ns(0.99)) / 1e3;
  state.counters["scan_p99.9_us"] = static_cast<double>(execution.percentile_ns(0.999)) / 1e3;
  state.counters["scan_max_us"] = static_cast<double>(execution.max_ns()) / 1e3;
}
// One iteration is a feeder step and a scan; the counters are of the scan alone.
BENCHMARK(scan)->Arg(0)->Arg(1000)->Iterations(200000)->Unit(benchmark::kMicrosecond);

}  // namespace
