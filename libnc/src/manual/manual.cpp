// SPDX-License-Identifier: Apache-2.0
// Every kind of manual motion goes to a target with a top speed. The target of a jog is the soft limit (or far away), that of a step or a handle is
// `distance` further on, that of a reference return is the reference position, that of a return the place that the program has left. When a jog or one
// of the returns is released the axis brakes to rest.
#include "manual/manual.hpp"

#include <algorithm>
#include <cmath>

#include "frame/rotary.hpp"

#include "motion/law.hpp"

namespace nc {
namespace {

constexpr double kFar = 1e7;        ///< mm or deg: distance to the target of a jog without soft limits
constexpr double kUnlimited = 1e9;  ///< stands for a limit that is not configured
/// The target of a handle is at most the way of this time, at the top speed of the axis, plus the braking distance ahead of the axis. So the axis comes to
/// rest soon after the wheel when the wheel was turned faster than the axis can go. nc/run.h promises it.
constexpr double kHandleAhead_s = 0.5;

}  // namespace

bool Manual::stands_at_reference(const Axis& a, double position) {
  return a.kind == NC_MANUAL_REFERENCE && a.to_reference && !a.going && a.velocity == 0 && position == a.target;
}

double Manual::top_speed(unsigned i) const {
  const AxisLimits& l = config_.limits[i];
  const double rapid = l.rapid > 0 ? l.rapid : kUnlimited;
  return std::min(rapid, l.velocity > 0 ? l.velocity : kUnlimited);
}

double Manual::acceleration(unsigned i) const {
  const double a = config_.limits[i].acceleration;
  return a > 0 ? a : kUnlimited;
}

/// A target inside the soft limits. An axis that stands outside may go inward but not further out.
double Manual::within(unsigned i, const Rules& rules, double target, double position) const {
  if (!((config_.soft_limited & ~rules.unlimited) >> i & 1)) return target;
  const bool turning = (rules.turning >> i & 1) != 0;
  const double turns = turning ? 360 * turns_outside(position, config_.soft_min[i], config_.soft_max[i]) : 0;
  const double low = std::min(config_.soft_min[i] + turns, position), high = std::max(config_.soft_max[i] + turns, position);
  return std::min(high, std::max(low, target));
}

void Manual::wish(unsigned i, const nc_manual& w, const Rules& rules, double position) {
  Axis& a = axis_[i];
  const bool turning = (rules.turning >> i & 1) != 0;
  const bool edge = w.kind != a.kind;
  const bool was = a.kind == NC_MANUAL_JOG || a.kind == NC_MANUAL_REFERENCE || a.kind == NC_MANUAL_RETURN;
  a.kind = w.kind;
  switch (w.kind) {
    case NC_MANUAL_JOG:
      give_up_handle(i);
      a.going = w.velocity != 0;
      a.cap = std::min(std::fabs(w.velocity), top_speed(i));
      a.target = within(i, rules, position + std::copysign(kFar, w.velocity), position);
      break;
    case NC_MANUAL_STEP:
      if (!edge || w.distance == 0) break;
      // A step goes from where the axis would come to rest: from its target when it still has one.
      a.target = within(i, rules, (a.going && !was ? a.target : position) + w.distance, position);
      a.by_handle = a.by_handle && a.going && !was;
      a.cap = top_speed(i);
      if (w.velocity != 0) a.cap = std::min(a.cap, std::fabs(w.velocity));
      a.going = true;
      break;
    case NC_MANUAL_HANDLE: {
      if (w.distance == 0) break;
      const double top = top_speed(i), ahead = top * kHandleAhead_s + 0.5 * top * top / acceleration(i);
      const double wanted = (a.going && !was ? a.target : position) + w.distance;
      a.target = within(i, rules, std::min(position + ahead, std::max(position - ahead, wanted)), position);
      if (a.target != wanted) handle_dropped_ |= 1u << i;
      a.by_handle = true;
      a.cap = top;
      a.going = true;
      break;
    }
    case NC_MANUAL_REFERENCE: {
      if (!edge && a.going) break;
      give_up_handle(i);
      double reference = config_.reference[i];
      // Within its limits an axis has one way only, whatever is shorter.
      if (turning) reference = position + turn_to(reference, within_one_turn(position), ((rules.short_cut & (~config_.soft_limited | rules.unlimited)) >> i & 1) != 0);
      a.target = within(i, rules, reference, position);
      a.to_reference = a.target == reference;
      a.cap = top_speed(i);
      a.going = true;
      break;
    }
    case NC_MANUAL_RETURN:
      if ((rules.returns >> i & 1) == 0) {
        a.going = a.going && !was;
        break;
      }
      give_up_handle(i);
      a.target = within(i, rules, (*rules.back)[i], position);
      a.cap = top_speed(i);
      if (w.velocity != 0) a.cap = std::min(a.cap, std::fabs(w.velocity));
      a.going = a.target != position;
      break;
    default:
      if (was) a.going = false;  // let go
      break;
  }
}

/// One cycle towards the target, or to rest. When the target lies behind the axis, it brakes to rest first and then goes back.
double Manual::move(unsigned i, const Rules& rules, double position) {
  Axis& a = axis_[i];
  const bool held = (rules.held >> i & 1) != 0;
  const bool gentle = (rules.gentle >> i & 1) != 0;
  const double accel = gentle ? std::min(acceleration(i), rules.gentle_acceleration) : acceleration(i);
  const double cap = gentle ? std::min(a.cap, rules.gentle_velocity) : a.cap;
  double time = config_.cycle_s;
  for (int leg = 0; leg < 3 && time > 0; ++leg) {
    const double ahead = a.going ? a.target - position : 0;
    if (a.velocity == 0 && (ahead == 0 || held)) {
      a.going = ahead != 0;
      break;
    }
    const double direction = a.velocity != 0 ? std::copysign(1.0, a.velocity) : std::copysign(1.0, ahead);
    const double way = direction * ahead, v = std::fabs(a.velocity);
    const double stopping = 0.5 * v * v / accel;
    const bool brake = !a.going || held || way < stopping * (1 - 1e-11);
    LawState state{0, v};
    const LawGoal goal{brake ? stopping + 1 : way, 0, brake ? 0 : cap, accel};
    const double left = advance(state, goal, time);
    const bool arrived = !brake && state.s >= way;
    position = arrived ? a.target : position + direction * state.s;
    a.velocity = arrived ? 0 : direction * state.v;
    if (arrived) a.going = false;
    if (brake && state.v == 0) {
      time = a.going ? std::max(0.0, time - v / accel) : 0;  // it goes back in what is left of the cycle
    } else {
      time = arrived ? 0 : left;
    }
  }
  return position;
}

/// Gives up the target of a handle, and notes it when a part of the way was still left.
void Manual::give_up_handle(unsigned i) {
  Axis& a = axis_[i];
  if (a.going && a.by_handle) handle_dropped_ |= 1u << i;
  a.by_handle = false;
}

/// Refuses the command of an axis: the axis brakes to rest, its target is given up, and the command that is on now does not begin later.
void Manual::refuse(unsigned i, const nc_manual& w) {
  Axis& a = axis_[i];
  const bool pulses = w.kind == NC_MANUAL_HANDLE;
  if (pulses && w.distance != 0) handle_dropped_ |= 1u << i;
  give_up_handle(i);
  a.going = false;
  a.kind = NC_MANUAL_NONE;
  if (!pulses) a.refused = w.kind == NC_MANUAL_JOG && w.velocity == 0 ? uint8_t{NC_MANUAL_NONE} : w.kind;
}

/// True when the command may act; false while it has to be released first because it was refused. Each pulse of a handle is a command of its own, and
/// does not release a refused kind.
bool Manual::let_go(unsigned i, const nc_manual& w) {
  uint8_t& refused = axis_[i].refused;
  if (w.kind == NC_MANUAL_HANDLE) return true;
  if (w.kind != refused || (w.kind == NC_MANUAL_JOG && w.velocity == 0)) refused = NC_MANUAL_NONE;
  return refused == NC_MANUAL_NONE;
}

void Manual::idle(const nc_manual* wishes) {
  moved_ = handle_dropped_ = returned_ = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) refuse(i, wishes[i]);
}

void Manual::cycle(const nc_manual* wishes, const Rules& rules, AxisVec* position) {
  active_ = moved_ = handle_dropped_ = returned_ = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const bool dropped = (rules.dropped >> i & 1) != 0;
    if (dropped || rules.stop || (rules.refused >> i & 1) != 0) refuse(i, wishes[i]);
    else if (let_go(i, wishes[i])) wish(i, wishes[i], rules, (*position)[i]);
    if (dropped) axis_[i].velocity = 0;
    const bool rests = axis_[i].velocity == 0 && !axis_[i].going;
    const double before = (*position)[i];
    if (!rests) (*position)[i] = move(i, rules, before);
    if ((*position)[i] != before) moved_ |= 1u << i;
    if (axis_[i].velocity != 0 || axis_[i].going) active_ |= 1u << i;
    if (stands_at_reference(axis_[i], (*position)[i])) returned_ |= 1u << i;
  }
}

}  // namespace nc
