// SPDX-License-Identifier: Apache-2.0
// Text to items through the public API: parse, interpret, compensate, commit. The claim: >= 3,000,000 blocks/s on G1 X Y Z lines.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "nc/nc.h"

namespace {

std::string surface(unsigned lines, const std::string& head = "G21 G90 G94 G64\n") {
  std::string text = head + "G0 X0 Y0 Z5.\nG1 Z0 F1000\n";
  char line[64];
  for (unsigned i = 0; i < lines; ++i) {
    const double x = 0.2 * (i % 500), y = 0.2 * (i / 500);
    std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f Z%.4f\n", x, y, 2 * std::sin(x / 7) * std::cos(y / 9));
    text += line;
  }
  return text + "M30\n";
}

std::string macro_loop(unsigned turns) {
  return "G21 G90 G94\nG1 F1000\n#1=0\nWHILE [#1 LT " + std::to_string(turns) +
         "] DO1\n#2=10*COS[#1]\n#3=10*SIN[#1]\nX#2 Y#3\n#1=#1+1\nEND1\nM30\n";
}

std::string calls(unsigned turns) {
  return "G21 G90 G94\n#100=0\nWHILE [#100 LT " + std::to_string(turns) + "] DO1\nG65 P9000 A1. B2.\n#100=#100+1\nEND1\nM30\nO9000\nM99\n";
}

/// Peck cycles: `holes` holes with ten cuts each. A cut is three strokes (down, out, down to where it left off).
constexpr unsigned kCuts = 10, kStrokesOfHole = 2 + 3 * kCuts - 1;
std::string pecks(unsigned holes) {
  std::string text = "G21 G90 G94 F600\nG0 X0 Y0 Z5.\nG99 G83 Z-10. R1. Q1.1 L0\n";
  char line[64];
  for (unsigned i = 0; i < holes; ++i) {
    std::snprintf(line, sizeof line, "X%.3f Y%.3f\n", 1.27 * (i % 250), 1.27 * (i / 250));
    text += line;
  }
  return text + "G80\nM30\n";
}

class Control {
 public:
  explicit Control(nc_dialect dialect = NC_DIALECT_M700) {
    nc_config config;
    nc_config_init(&config);
    config.dialect = static_cast<uint8_t>(dialect);
    const size_t size = nc_memory_required(&config);
    memory_ = std::aligned_alloc(64, (size + 63) / 64 * 64);
    nc_ = nc_create(&config, memory_, size, nullptr);
  }
  ~Control() { std::free(memory_); }
  Control(const Control&) = delete;

  /// Pulls a program to its end; returns the number of its blocks (marks).
  unsigned run(const std::string& text) {
    unsigned file = 0, blocks = 0;
    nc_program_add_text(nc_, "bench", text.data(), text.size(), &file);
    nc_program_select(nc_, 0, file);
    nc_item item;
    nc_status status;
    while ((status = nc_pull(nc_, 0, 1u << 30, &item)) == NC_OK) blocks += item.kind == NC_ITEM_MARK;
    if (status != NC_ENDED) std::abort();
    return blocks;
  }

 private:
  void* memory_;
  nc_control* nc_;
};

void measure(benchmark::State& state, const std::string& text) {
  Control control;
  int64_t blocks = 0;
  for (auto _ : state) blocks += control.run(text);
  state.SetItemsProcessed(blocks);
}

void lines(benchmark::State& state) { measure(state, surface(100000)); }

/// The same lines in another family: for each, lines of m700 and of it in turn, so that both see the same machine. `of_m700`: user time of m700 divided by that
/// of the family; no family is below 0.8.
double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}
void lines_of(benchmark::State& state, nc_dialect dialect, const char* head) {
  const std::string text = surface(100000, head), of_m700 = surface(100000);
  Control family(dialect), m700;
  double took[2] = {0, 0};
  int64_t blocks = 0;
  for (auto _ : state) {
    const double begin = user_seconds();
    m700.run(of_m700);
    const double between = user_seconds();
    blocks += family.run(text);
    took[0] += between - begin;
    took[1] += user_seconds() - between;
  }
  state.SetItemsProcessed(2 * blocks);
  state.counters["of_m700"] = took[0] / took[1];
}
/// Strokes of fixed cycles per second.
void strokes(benchmark::State& state) {
  constexpr unsigned kHoles = 4000;
  const std::string text = pecks(kHoles);
  Control control;
  for (auto _ : state) control.run(text);
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * kHoles * kStrokesOfHole);
}
void macro_blocks(benchmark::State& state) { measure(state, macro_loop(20000)); }
void macro_calls(benchmark::State& state) { measure(state, calls(20000)); }

BENCHMARK(lines)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines_of, hx, NC_DIALECT_HX, "G21 G90 G94 G64\n")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines_of, iso, NC_DIALECT_ISO, "G21 G90 G94 G64\n")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines_of, dgshape, NC_DIALECT_DGSHAPE, "%\nG21 G90\n")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines_of, series8, NC_DIALECT_SERIES8, "G71 G90 G94\n")->Unit(benchmark::kMillisecond);
BENCHMARK(strokes)->Unit(benchmark::kMillisecond);
BENCHMARK(macro_blocks)->Unit(benchmark::kMillisecond);
BENCHMARK(macro_calls)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
