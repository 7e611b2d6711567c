// SPDX-License-Identifier: Apache-2.0
// What the tests that run a control cycle by cycle have in common.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/drive.hpp"
#include "support/random_program.hpp"

namespace nc::test {

inline std::function<void(nc_config&)> machine(uint32_t look_ahead) {
  return [look_ahead](nc_config& c) {
    c.look_ahead = look_ahead;
    c.cycle_s = 0.004;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 2000;
      c.system[0].axis[i].max_velocity = 1500;
      c.system[0].axis[i].max_acceleration = 50000;
    }
  };
}

inline void set_up(Bench& bench, const RandomProgram& program) {
  for (unsigned n = 1; n <= 9; ++n) bench.tool(n, 0.2 * n);
  bench.work_offset(1, {1, 2, 3}).param("8103", "1").param("8013", "0.5").param("8012", "0.3");
  for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
}

/// An interrupt that the machine has seen: behind which item it came, and whether it cut the block behind that item.
struct Seen {
  uint64_t behind = 0;
  bool inside = false;
};

/// The interrupts of a run: the items of the interrupt program (O1000) begin behind another item.
inline std::vector<Seen> interrupts_of(const std::vector<nc_event>& events) {
  std::vector<Seen> all;
  for (size_t i = 1; i < events.size(); ++i) {
    // The item that announces the interrupt has the source of the block before; the items of the interrupt program follow.
    if (events[i].source.program != 1000 || events[i - 1].source.program == 1000 || i < 2) continue;
    const nc_event &announced = events[i - 1], &before = events[i - 2];
    bool moved = false;
    for (unsigned axis = 0; axis < 3; ++axis) moved = moved || std::fabs(announced.machine.v[axis] - before.machine.v[axis]) > 1e-9;
    all.push_back({before.serial, moved || before.kind != NC_ITEM_MARK});
  }
  return all;
}

/// The tool offsets and common variables that a run has left, as text.
inline std::string left_by(Bench& bench) {
  std::string all;
  for (unsigned n = 1; n <= 20; ++n) all += brief(bench.tool_now(n)) + " ";
  uint32_t number = 0;
  double value = 0;
  for (; nc_variable_next(bench.control(), 0, number, &number, &value) == NC_OK; ++number) all += std::to_string(number) + "=" + brief(value) + " ";
  return all;
}

/// Tool offsets, work offsets and common variables, as text.
inline std::string tables(Bench& bench) {
  std::string all = left_by(bench);
  for (unsigned index = 0; index <= 6; ++index)
    for (unsigned axis = 0; axis < 3; ++axis) all += brief(bench.work_offset_now(index, axis)) + " ";
  return all;
}

}  // namespace nc::test
