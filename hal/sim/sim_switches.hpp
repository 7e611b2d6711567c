// SPDX-License-Identifier: Apache-2.0
// What stands along an axis of the simulated machine: dog, limit switches, zero mark of the encoder; and what holds it: its brake.
//
// Places are those of the machine. The encoder counts from where the axis stood when it was switched on, so the control does not know them.
#pragma once

#include <cmath>

#include "hal/points.hpp"
#include "hal/sim/sim_clamp.hpp"

namespace nc::hal {

// A contact that is on from one place to another; a closed one is 1 elsewhere.
struct SimSwitch {
  int point = -1;
  bool closed = false;
  double from = 0, to = 0;
};

struct SimSwitches {
  double offset = 0;  // place on the machine less what the encoder counts
  SimSwitch dog, minus, plus;
  int index = -1;           // input: on in the scan in which the axis passes a zero mark
  double pitch = 10, mark = 0;  // mm or deg: from mark to mark, and the place of one of them
  int brake = -1;           // output: 1 opens it
  SimClamp brake_times{0.1, 0.05};
  double weight = 0;        // mm/s^2: so it falls in - when neither drive nor brake hold it
};

struct SimSwitchState {
  bool open = false;  // the brake

  void step(const SimSwitches& config, double place, double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
    for (const SimSwitch* each : {&config.dog, &config.minus, &config.plus})
      if (each->point >= 0) inputs->value[each->point] = (place >= each->from && place <= each->to) != each->closed ? 1 : 0;
    const double turn = std::floor((place - config.mark) / config.pitch);
    if (config.index >= 0) inputs->value[config.index] = counted_ && turn != turn_ ? 1 : 0;
    turn_ = turn;
    counted_ = true;
    if (config.brake >= 0) open = clamp_.step(config.brake_times, outputs.value[config.brake] != 0, cycle_s);
  }

 private:
  double turn_ = 0;
  bool counted_ = false;
  SimClampState clamp_;
};

}  // namespace nc::hal
