// SPDX-License-Identifier: Apache-2.0
// What a ladder costs: the time per instruction in rungs of contacts and in a program with timers, edges and words, and
// the compilation of a program. `s_per_instruction` is the figure to look at. The inputs change in every scan, so that
// the branch prediction of the processor cannot learn the results.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "ladder/code.hpp"

namespace {

using namespace nc::ladder;

constexpr unsigned kInputs = 256;

struct Random {
  std::uint32_t state = 12345;
  std::uint32_t operator()(std::uint32_t n) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % n;
  }
};

DeviceTable machine() {
  DeviceTable table;
  for (unsigned i = 0; i < kInputs; ++i) table.add("x" + std::to_string(i), DeviceType::kBit, false);
  return table;
}

std::string device(Random& random) {
  return random(2) == 0 ? "x" + std::to_string(random(kInputs)) : "M" + std::to_string(random(2000));
}

// Rungs of two to eight contacts and a coil; one in four has a block of two parallel contacts (ANB) besides.
std::string contacts(unsigned instructions) {
  static const char* const kNames[] = {"AND ", "ANI ", "OR ", "ORI "};
  Random random;
  std::string text;
  unsigned coil = 2000;
  for (unsigned n = 0; n < instructions;) {
    text += "LD " + device(random) + "\n";
    ++n;
    for (unsigned i = 1 + random(7); i > 0; --i, ++n) text += kNames[random(4)] + device(random) + "\n";
    if (random(4) == 0) {
      text += "LDI " + device(random) + "\nOR " + device(random) + "\nANB\n";
      n += 3;
    }
    text += "OUT M" + std::to_string(coil++ % 8192) + "\n";
    ++n;
    if (coil == 8192) coil = 2000;
  }
  return text;
}

// A mixture as in the program of a machine: of ten rungs seven have contacts only, one has a timer, one a compare with a
// move, and one an edge.
std::string mixed(unsigned instructions) {
  Random random;
  std::string text;
  unsigned rung = 0;
  for (unsigned n = 0; n < instructions; ++rung) {
    const std::string number = std::to_string(rung % 500);
    switch (rung % 10) {
      case 3:
        text += "LD " + device(random) + "\nANI T" + number + "\nOUT T" + number + " K50\n";
        n += 3;
        break;
      case 6:
        text += "LD= D" + number + " K" + std::to_string(random(4)) + "\nAND " + device(random) +
                "\nMOV K7 D" + std::to_string(1000 + random(500)) + "\n";
        n += 3;
        break;
      case 8:
        text += "LDP " + device(random) + "\nINC D" + number + "\nSET M" +
                std::to_string(4000 + rung % 4000) + "\n";
        n += 3;
        break;
      default:
        text += "LD " + device(random) + "\nOR M" + std::to_string(4000 + rung % 4000) + "\nANI " +
                device(random) + "\nAND " + device(random) + "\nOUT M" + std::to_string(4000 + rung % 4000) +
                "\n";
        n += 5;
    }
  }
  return text;
}

Program compiled(const std::string& text) {
  Program program;
  std::vector<Error> errors;
  if (!compile(text, "bench.il", machine(), {}, &program, &errors)) {
    std::fprintf(stderr, "%s\n", errors.front().text().c_str());
    std::exit(1);
  }
  return program;
}

void run(benchmark::State& state, const std::string& text,
         Outcome (*execute)(const Code&, DeviceImage*) noexcept) {
  const Program program = compiled(text);
  DeviceImage image = Engine(program).make_image();
  Random random;
  for (auto _ : state) {
    for (unsigned i = 0; i < 8; ++i) image.bit[random(kInputs)] ^= 1u;
    if (execute(*program.code(), &image).fault != kNoFault) state.SkipWithError("fault");
    benchmark::ClobberMemory();
  }
  // Shown in units of 1e-9: "4.2n" = 4.2 ns.
  state.counters["s_per_instruction"] =
      benchmark::Counter(static_cast<double>(program.instruction_count()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void contacts_threaded(benchmark::State& state) {
  run(state, contacts(static_cast<unsigned>(state.range(0))), execute_threaded);
}
void contacts_portable(benchmark::State& state) {
  run(state, contacts(static_cast<unsigned>(state.range(0))), execute_portable);
}
void mixed_threaded(benchmark::State& state) {
  run(state, mixed(static_cast<unsigned>(state.range(0))), execute_threaded);
}
BENCHMARK(contacts_threaded)->Arg(1000)->Arg(20000);
BENCHMARK(contacts_portable)->Arg(1000)->Arg(20000);
BENCHMARK(mixed_threaded)->Arg(1000)->Arg(20000);

void compilation(benchmark::State& state) {
  const std::string text = mixed(static_cast<unsigned>(state.range(0)));
  const DeviceTable table = machine();
  for (auto _ : state) {
    Program program;
    std::vector<Error> errors;
    benchmark::DoNotOptimize(compile(text, "bench.il", table, {}, &program, &errors));
  }
}
BENCHMARK(compilation)->Arg(20000)->Unit(benchmark::kMillisecond);

}  // namespace
