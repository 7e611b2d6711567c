// SPDX-License-Identifier: Apache-2.0
// A program on the time-optimal mode with nc_feed in small slices, to be counted by callgrind (tests/motion/feed_slices_test.py):
//
//   feed_slices BUDGET CALLS CYCLES_PER_HOLD PROGRAM.nc [GROUP [CALL...]]
//
// In each cycle nc_feed(BUDGET) is called until it does not ask for more, at most CALLS times, so the axes go on while something is planned.
// In every CYCLES_PER_HOLD-th cycle of the motion a feed hold begins, and it ends when the axes stand; the override changes in between.
// The counter writes down what has gathered each time that group_ends() is called: behind every GROUPth call of nc_feed, and behind each call of the
// groups that begin with one of the CALLs, counted from 0.
// Standard output: the cycles and the calls. Exit status: 0; 1 with a sentence, where the program does not come to its end.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>

#include "nc/nc.h"

namespace {

constexpr unsigned kAxes = 3;
constexpr long kMostCycles = 200000;

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

int complain(const std::string& what) {
  std::fprintf(stderr, "feed_slices: %s\n", what.c_str());
  return 1;
}

bool read_file(const char* name, std::string* text) {
  std::FILE* in = std::fopen(name, "rb");
  if (in == nullptr) return false;
  char part[65536];
  for (size_t n = 0; (n = std::fread(part, 1, sizeof part, in)) > 0;) text->append(part, n);
  const bool read = std::ferror(in) == 0;
  std::fclose(in);
  return read;
}

void configure(nc_config* config) {
  nc_config_init(config);
  for (unsigned i = 0; i < kAxes; ++i) {
    nc_axis_config& axis = config->system[0].axis[i];
    axis.max_velocity = 250;
    axis.max_acceleration = 2000;
    axis.max_jerk = 50000;
    axis.in_position = 0.01;
  }
  config->motion_mode = NC_MOTION_OPTIMAL;
  config->path_tolerance = 0.01;
  config->look_ahead = 4096;
}

}  // namespace

// Has a name of its own in the binary, by which callgrind knows it.
extern "C" __attribute__((noinline)) void group_ends() { __asm__ volatile(""); }

int main(int argc, char** argv) {
  if (argc < 5) return complain("BUDGET CALLS CYCLES_PER_HOLD PROGRAM.nc [GROUP [CALL...]]");
  const auto budget = static_cast<uint32_t>(std::strtoul(argv[1], nullptr, 10));
  const long calls_of_cycle = std::strtol(argv[2], nullptr, 10), hold_every = std::max(1L, std::strtol(argv[3], nullptr, 10));
  const long group = argc > 5 ? std::max(1L, std::strtol(argv[5], nullptr, 10)) : 1;
  std::set<long> apart;
  for (int n = 6; n < argc; ++n) apart.insert(std::strtol(argv[n], nullptr, 10));
  std::string text;
  if (!read_file(argv[4], &text)) return complain(std::string("cannot read ") + argv[4]);
  nc_config config;
  configure(&config);
  const size_t size = (nc_memory_required(&config) + 63) / 64 * 64;
  const std::unique_ptr<void, FreeAligned> memory(std::aligned_alloc(64, size));
  nc_status status = NC_E_MEMORY;
  nc_control* const control = memory ? nc_create(&config, memory.get(), size, &status) : nullptr;
  unsigned file = 0;
  // With fine segments and splines (M700 13.17, 13.18).
  if (control == nullptr || nc_parameter_set(control, 0, "1267/bit0", 0, "1") != NC_OK || nc_parameter_set(control, 0, "8025", 0, "1") != NC_OK ||
      nc_program_add_text(control, "PART", text.data(), text.size(), &file) != NC_OK ||
      nc_program_select(control, 0, file) != NC_OK)
    return complain("the control does not take the program");
  nc_inputs in;
  nc_outputs out;
  nc_inputs_init(&in);
  nc_outputs_init(&out);
  in.actual_valid = true;
  long calls = 0, cycle = 0, moved = 0;
  bool ended = false;
  for (; cycle < kMostCycles && !ended; ++cycle) {
    for (long n = 0; n < calls_of_cycle; ++n) {
      const bool asks = nc_feed(control, budget) == NC_BUDGET;
      const long begin = calls / group * group;
      if (++calls == begin + group || apart.count(begin) != 0) group_ends();
      if (!asks) break;
    }
    const nc_axes before = out.command;
    in.cycle_start = !in.feed_hold && cycle % 4 == 2;
    if (nc_cycle(control, &in, &out) != NC_OK || out.state == NC_STATE_ALARM) return complain("an alarm in cycle " + std::to_string(cycle));
    const bool stands = std::equal(before.v, before.v + kAxes, out.command.v);
    if (in.feed_hold && stands) in.feed_hold = false;
    if (!stands && ++moved % hold_every == 0) {
      in.feed_hold = true;
      in.feed_override = in.feed_override < 1 ? 1.2 : 0.6;
    }
    in.fin = out.strobe != 0;
    in.actual = out.command;
    ended = out.state == NC_STATE_IDLE && out.blocks > 0;
  }
  if (calls % group != 0) group_ends();
  if (!ended) return complain("the program does not come to its end");
  std::printf("%ld cycles, %ld calls\n", cycle, calls);
  return 0;
}
