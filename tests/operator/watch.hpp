// SPDX-License-Identifier: Apache-2.0
// What must be true in every cycle of any machine, whatever the program and the operator do, measured on the outputs of the control: finite
// numbers, limits of the axes by finite differences, stored stroke limits, the state, rest in the states of rest, serials.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "nc/nc.h"

namespace nc::test {

class Watch {
 public:
  explicit Watch(const nc_config& config) : config_(config) {}

  /// The host has changed the position of the axes: the next difference does not count.
  void forget() { samples_ = 0; }

  /// Checks the outputs of one cycle; what() tells what is wrong.
  void cycle(const nc_inputs& in, const nc_outputs& out) {
    ++cycles_;
    const bool hand_now = out.state == NC_STATE_MANUAL || std::any_of(in.manual, in.manual + NC_MAX_AXES, [](const nc_manual& m) { return m.kind != NC_MANUAL_NONE; });
    if (hand_now) hand_ = 4;
    const nc_system_config& system = config_.system[0];
    rapid_ = out.rapid ? 4 : rapid_ > 0 ? rapid_ - 1 : 0;
    if (out.state > NC_STATE_MANUAL) fail("state", out.state, 0, 0);
    if (out.cause > NC_CAUSE_TAP_SPINDLE + 8) fail("cause", out.cause, 0, 0);
    bool moved = false;
    for (unsigned i = 0; i < system.axis_count; ++i) {
      const nc_axis_config& axis = system.axis[i];
      const double x = out.command.v[i];
      if (!std::isfinite(x) || !std::isfinite(out.velocity.v[i]) || !std::isfinite(out.work.v[i]) || !std::isfinite(out.distance_to_go.v[i])) {
        fail("a value that is no number", x, i, 0);
        continue;
      }
      difference(i, x, axis);
      moved = moved || (samples_ >= 1 && std::fabs(v_[i]) > 1e-6 * axis.max_velocity);
      if (axis.soft_limited && (x > axis.soft_max + 1e-6 || x < axis.soft_min - 1e-6)) fail("stored stroke limit", x, i, axis.soft_max);
      last_[i] = x;
    }
    ++samples_;
    // Axes that are moved by hand have no jerk limit, and come to rest in this way in whatever state follows.
    hand_ = hand_now || (hand_ > 0 && moved) ? 4 : hand_ > 0 ? hand_ - 1 : 0;
    // In these states the axes stand, whatever buttons are pressed, since motion by hand has its own state. But in the first cycle of the state the
    // move may still end, and a block may be so short that it begins and ends in one cycle.
    const bool rests = out.state == NC_STATE_IDLE || out.state == NC_STATE_STOPPED;
    const bool stood = out.state == state_ || state_ == NC_STATE_MANUAL;
    if (rests && stood && out.serial == item_ && moved) fail("moves at rest in state", out.state, 0, 0);
    // An alarm may come while the axes move, and they may reverse while they stop; when they have come to rest they stay there.
    alarm_cycles_ = out.state == NC_STATE_ALARM && moved ? alarm_cycles_ + 1 : 0;
    if (alarm_cycles_ > 20 / config_.cycle_s) fail("moves 20 s in an alarm", 0, 0, 0);
    alarm_rest_ = out.state != NC_STATE_ALARM ? 0 : moved ? alarm_rest_ : alarm_rest_ + 1;
    if (moved && alarm_rest_ > kAlarmRest) fail("moves again in an alarm", 0, 0, 0);
    state_ = out.state;
    item_ = out.serial;
  }

  /// The serials of the executed items come one after the other, until the program begins again or is read again.
  void event(const nc_event& e, bool may_jump) {
    if (serial_ != 0 && e.serial != serial_ + 1 && e.serial != 1 && !may_jump) fail("serial", static_cast<double>(e.serial), 0, static_cast<double>(serial_));
    serial_ = e.serial;
    for (const double v : e.machine.v)
      if (!std::isfinite(v)) fail("an event that is no number", v, 0, 0);
  }

  const std::string& what() const { return what_; }
  double worst_velocity = 0, worst_acceleration = 0, worst_jerk = 0;

 private:
  void difference(unsigned i, double x, const nc_axis_config& axis) {
    const double dt = config_.cycle_s;
    if (samples_ >= 1) {
      const double rapid = axis.rapid > 0 ? axis.rapid : axis.max_velocity;
      const double top = hand_ > 0 || rapid_ > 0 ? std::max(rapid, axis.max_velocity) : axis.max_velocity;
      const double v = (x - last_[i]) / dt;
      // A difference within the rounding of a number of this size is no velocity, and still less an acceleration or a jerk.
      const double noise = 4e-16 * (1 + std::fabs(x)) / dt;
      judge("velocity", std::fabs(v) - noise, top, i, worst_velocity);
      if (samples_ >= 2) {
        const double a = (v - v_[i]) / dt;
        judge("acceleration", std::fabs(a) - 4 * noise / dt, axis.max_acceleration, i, worst_acceleration);
        if (samples_ >= 3 && config_.motion_mode == NC_MOTION_OPTIMAL && hand_ == 0)
          judge("jerk", std::fabs(a - a_[i]) / dt - 8 * noise / dt / dt, axis.max_jerk, i, worst_jerk);
        a_[i] = a;
      }
      v_[i] = v;
    }
  }
  void judge(const char* name, double value, double limit, unsigned axis, double& worst) {
    worst = std::max(worst, value / limit);
    if (value > 1.001 * limit) fail(name, value, axis, limit);
  }
  void fail(const char* name, double value, unsigned axis, double limit) {
    if (!what_.empty()) return;
    std::ostringstream text;
    text << name << ' ' << value << " (" << limit << ") on axis " << axis << " in cycle " << cycles_;
    what_ = text.str();
  }

  static constexpr unsigned kAlarmRest = 10;  ///< cycles: longer than the filters delay a rest

  nc_config config_;
  double last_[NC_MAX_AXES] = {}, v_[NC_MAX_AXES] = {}, a_[NC_MAX_AXES] = {};
  uint64_t samples_ = 0, cycles_ = 0, serial_ = 0, item_ = 0;
  unsigned hand_ = 0, rapid_ = 0;  ///< cycles in which manual or rapid motion still acts on the differences
  uint8_t state_ = 0;
  double alarm_cycles_ = 0;
  unsigned alarm_rest_ = 0;  ///< cycles in which the axes stood in the alarm
  std::string what_;
};

}  // namespace nc::test
