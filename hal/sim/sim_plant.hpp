// SPDX-License-Identifier: Apache-2.0
// The part of the simulated machine that a ladder program drives through points: spindles with drives and a
// tool changer. It does not know M, S and T codes; the ladder makes commands from them.
//
//  * spindles: `forward` and `reverse` (bits) and `speed` (r/min) command a spindle, which follows with a ramp. `at_speed` is on while
//    the speed is within 3 % of the commanded one, `stopped` while the spindle stands. Both directions at once stop it.
//  * tool changer: `prepare` with `pocket` brings that tool to the change position; when it is there, `prepared` is on as long
//    as `prepare` is on. `change` exchanges it with the tool in the spindle, and `changed` answers in the same way.
//    A change while the spindle turns, or of a tool that was not prepared, jams: there is no answer.
#pragma once

#include <cstdint>

#include "hal/points.hpp"
#include "hal/sim/sim_spindle.hpp"
#include "nc/types.h"

namespace nc::hal {

// Indices of points, -1 = not used. Outputs of the control come first.
struct SimSpindlePoints {
  bool driven = false;
  int forward = -1, reverse = -1, speed = -1;
  int at_speed = -1, stopped = -1;
};

struct SimPlantConfig {
  SimSpindlePoints spindle[NC_MAX_SPINDLES];
  bool tool_changer = false;
  int prepare = -1, pocket = -1, change = -1;
  int prepared = -1, changed = -1, tool = -1;
  double ramp_rpm_per_s = 3000, max_rpm = 12000;
  double prepare_s = 0.1, change_s = 1.2;
};

class SimPlant {
 public:
  explicit SimPlant(const SimPlantConfig& config) : config_(config) {}

  bool present() const {
    bool any = config_.tool_changer;
    for (const SimSpindlePoints& points : config_.spindle) any |= points.driven;
    return any;
  }
  bool turns_spindle(unsigned number = 0) const { return config_.spindle[number].driven; }
  SimSpindle& spindle(unsigned number) { return spindle_[number]; }
  const SimSpindle& spindle(unsigned number) const { return spindle_[number]; }
  double rpm(unsigned number = 0) const { return spindle_[number].rpm(); }  // signed, + is forward
  unsigned tool() const { return tool_; }
  // From now on bit n: spindle n+1 follows the angle of a synchronous tap, whatever its points say.
  void follow(std::uint8_t spindles, double turns) noexcept {
    followers_ = spindles;
    turns_ = turns;
  }
  // Simulates one cycle: takes the outputs of the control and sets its inputs.
  void step(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept;

 private:
  void turn(unsigned number, double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept;
  void change_tools(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept;

  SimPlantConfig config_;
  SimSpindle spindle_[NC_MAX_SPINDLES];
  unsigned tool_ = 0, waiting_tool_ = 0;
  bool waiting_ = false, was_preparing_ = false, was_changing_ = false, exchanged_ = false;
  std::uint8_t followers_ = 0;
  double turns_ = 0;
  double prepare_left_s_ = 0, change_left_s_ = 0;
};

}  // namespace nc::hal
