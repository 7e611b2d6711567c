// SPDX-License-Identifier: Apache-2.0
// A random machine: axes, limits over the range of real machines, cycle, mode of motion, sizes, parameters; and a control with its memory.
#pragma once

#include <cstdlib>
#include <cstring>
#include <memory>

#include "nc/nc.h"
#include "operator/dice.hpp"

namespace nc::test {

inline nc_config random_machine(Dice& dice) {
  nc_config config;
  nc_config_init(&config);
  static constexpr const char* kAxes[] = {"XYZ", "XYZA", "XYZC", "XYZAC"};
  const char* names = dice.one_of(kAxes);
  nc_system_config& system = config.system[0];
  system.axis_count = static_cast<uint8_t>(std::strlen(names));
  const double velocity = dice.scale(20, 600), acceleration = dice.scale(200, 15000), jerk = acceleration * dice.scale(15, 3000);
  const bool limited = dice.chance(0.5);
  for (unsigned i = 0; i < system.axis_count; ++i) {
    nc_axis_config& axis = system.axis[i];
    const double weaker = dice.chance(0.3) ? dice.uniform(0.2, 1) : 1;
    axis.name = names[i];
    axis.rotary = axis.name == 'A' || axis.name == 'C';
    axis.max_velocity = velocity * weaker;
    axis.rapid = dice.chance(0.3) ? axis.max_velocity * dice.uniform(0.5, 1.5) : 0;
    axis.max_acceleration = acceleration * weaker;
    axis.max_jerk = jerk * weaker;
    axis.in_position = 0.01;
    axis.reference[0] = dice.uniform(-10, 10);
    axis.reference[1] = dice.uniform(-10, 10);
    if (limited && !axis.rotary) {
      axis.soft_limited = true;
      axis.soft_min = -70;
      axis.soft_max = 70;
    }
  }
  static constexpr double kCycles[] = {0.001, 0.001, 0.0005, 0.002, 0.004, 0.00025};
  config.cycle_s = dice.one_of(kCycles);
  config.motion_mode = dice.chance(0.6) ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
  static constexpr double kTolerances[] = {0.01, 0.01, 0.002, 0.05, 0.3};
  config.path_tolerance = dice.one_of(kTolerances);
  static constexpr uint32_t kLookAheads[] = {64, 128, 256, 1024};
  config.look_ahead = dice.one_of(kLookAheads);
  config.programs = 8;
  config.tool_offsets = 20;
  config.work_offsets = 8;
  config.window_bytes = dice.chance(0.5) ? 512 : 4096;
  return config;
}

/// A control with its memory.
class Control {
 public:
  explicit Control(const nc_config& config) {
    const size_t size = nc_memory_required(&config);
    memory_.reset(std::aligned_alloc(64, (size + 63) / 64 * 64));
    handle_ = nc_create(&config, memory_.get(), size, nullptr);
  }
  operator nc_control*() const { return handle_; }  // NOLINT: it stands for the handle of the C API

 private:
  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Release> memory_;
  nc_control* handle_ = nullptr;
};

/// Sets parameters and tables that change what programs mean and how the machine moves, the same in both controls; the
/// second one may be missing.
inline void random_settings(Dice& dice, nc_control* machine, nc_control* traced) {
  const std::initializer_list<nc_control*> both = {machine, traced};
  const auto set = [&](const char* key, const char* text) {
    for (nc_control* control : both)
      if (control != nullptr) nc_parameter_set(control, 0, key, 0, text);
  };
  static constexpr const char* kSwitches[] = {"1078", "8102", "8103", "1112", "1113", "1229/bit0", "1229/bit2", "1223/bit1", "1080", "1205"};
  for (const char* key : kSwitches)
    if (dice.chance(0.25)) set(key, "1");
  set("macro_extensions", "1");
  set("1084", dice.chance(0.3) ? "0.1" : "0.01");
  if (dice.chance(0.2)) {  // filters behind interpolation
    set("2004", "30");
    set("2007", "40");
    if (dice.chance(0.5)) set("1568", "10");
  }
  for (unsigned n = 1; n <= 20; ++n) {
    const double length = dice.uniform(-5, 5), radius = dice.chance(0.3) ? dice.uniform(0, 0.3) : dice.uniform(0, 4);
    for (nc_control* control : both) {
      if (control == nullptr) continue;
      nc_tool_offset_set(control, n, NC_TOOL_LENGTH, length);
      nc_tool_offset_set(control, n, NC_TOOL_RADIUS, radius);
    }
  }
}

}  // namespace nc::test
