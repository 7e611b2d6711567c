// SPDX-License-Identifier: Apache-2.0
#include "hal/sim/sim_plant.hpp"

#include <algorithm>
#include <cmath>

namespace nc::hal {
namespace {

constexpr double kAtSpeed = 0.03;   // of the commanded speed
constexpr double kStanding = 1e-3;  // r/min

bool on(const PointImage& image, int point) noexcept {
  return point >= 0 && image.value[point] != 0;
}
void set(PointImage* image, int point, std::uint32_t value) noexcept {
  if (point >= 0) image->value[point] = value;
}

}  // namespace

void SimPlant::step(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  if (config_.spindle) turn(cycle_s, outputs, inputs);
  if (config_.tool_changer) change_tools(cycle_s, outputs, inputs);
}

void SimPlant::turn(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  const bool forward = on(outputs, config_.forward), reverse = on(outputs, config_.reverse);
  const double speed = config_.speed < 0 ? 0 : outputs.value[config_.speed];
  const double direction = forward == reverse ? 0 : forward ? 1 : -1;
  command_rpm_ = direction * std::min(speed, config_.max_rpm);
  const double step = config_.ramp_rpm_per_s * cycle_s;
  rpm_ += std::clamp(command_rpm_ - rpm_, -step, step);
  const bool there = std::abs(command_rpm_ - rpm_) <= kAtSpeed * std::abs(command_rpm_);
  set(inputs, config_.at_speed, command_rpm_ != 0 && there);
  set(inputs, config_.stopped, std::abs(rpm_) < kStanding);
}

void SimPlant::change_tools(double cycle_s, const PointImage& outputs, PointImage* inputs) noexcept {
  const bool prepare = on(outputs, config_.prepare), change = on(outputs, config_.change);
  if (prepare && !was_preparing_) prepare_left_s_ = config_.prepare_s;
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
  const bool jammed = !waiting_ || std::abs(rpm_) >= kStanding;
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
