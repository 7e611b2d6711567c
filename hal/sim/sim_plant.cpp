// SPDX-License-Identifier: Apache-2.0
#include "hal/sim/sim_plant.hpp"

#include <algorithm>
#include <cmath>

namespace nc::hal {
namespace {

constexpr double kAtSpeed = 0.03;   // fraction of the commanded speed
constexpr double kStanding = 1e-3;  // r/min

bool on(const PointImage& image, int point) noexcept {
  return point >= 0 && image.value[point] != 0;
}
void set(PointImage* image, int point, std::uint32_t value) noexcept {
  if (point >= 0) image->value[point] = value;
}

}  // namespace

void SimPlant::step(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n)
    if (config_.spindle[n].driven) turn(n, cycle_s, outputs, inputs);
  if (config_.tool_changer) change_tools(cycle_s, outputs, inputs);
}

void SimPlant::turn(unsigned number, double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  const SimSpindlePoints& points = config_.spindle[number];
  const bool forward = on(outputs, points.forward), reverse = on(outputs, points.reverse);
  const double speed = points.speed < 0 ? 0 : outputs.value[points.speed];
  const double direction = forward == reverse ? 0 : forward ? 1 : -1;
  const double wanted = direction * std::min(speed, config_.max_rpm);
  if ((followers_ >> number & 1) != 0) {
    spindle_[number].follow(turns_, cycle_s, config_.ramp_rpm_per_s);
  } else {
    spindle_[number].let_go();
    spindle_[number].step(cycle_s, wanted, config_.ramp_rpm_per_s);
  }
  const double rpm = spindle_[number].rpm();
  set(inputs, points.at_speed, wanted != 0 && std::abs(wanted - rpm) <= kAtSpeed * std::abs(wanted));
  set(inputs, points.stopped, std::abs(rpm) < kStanding);
}

void SimPlant::change_tools(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  const bool prepare = on(outputs, config_.prepare), change = on(outputs, config_.change);
  if (prepare && !was_preparing_) prepare_left_s_ = std::max(config_.prepare_s, cycle_s);  // with a time of 0 the tool waits in the same cycle
  if (prepare && prepare_left_s_ > 0) {
    prepare_left_s_ -= cycle_s;
    if (prepare_left_s_ <= 0) {
      waiting_tool_ = config_.pocket < 0 ? 0 : outputs.value[config_.pocket];
      waiting_ = true;
    }
  }
  set(inputs, config_.prepared, prepare && prepare_left_s_ <= 0 && waiting_);
  was_preparing_ = prepare;

  if (change && !was_changing_) {
    change_left_s_ = config_.change_s;
    exchanged_ = false;
  }
  const bool jammed = !waiting_ || std::abs(rpm()) >= kStanding;
  if (change && !exchanged_ && !jammed) {
    change_left_s_ -= cycle_s;
    if (change_left_s_ <= 0) {
      tool_ = waiting_tool_;
      waiting_ = false;
      exchanged_ = true;
    }
  }
  set(inputs, config_.changed, change && exchanged_);
  set(inputs, config_.tool, tool_);
  was_changing_ = change;
}

}  // namespace nc::hal
