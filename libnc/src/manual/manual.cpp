// SPDX-License-Identifier: Apache-2.0
// Every kind of manual motion is "go to a target with a top speed": a jog's target is the soft limit (or far
// away), a step's and a handle's are `distance` further, a reference return's the reference position. Letting
// go of a jog brakes to rest.
#include "manual/manual.hpp"

#include <algorithm>
#include <cmath>

#include "frame/rotary.hpp"

#include "motion/law.hpp"

namespace nc {
namespace {

constexpr double kFar = 1e7;        ///< mm or deg: a jog without soft limits
constexpr double kUnlimited = 1e9;  ///< stands for a limit that is not configured
constexpr double kHandleLag_s =
    0.1;  ///< a handle turned faster than the axis can go runs at most this far ahead of it

}  // namespace

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
double Manual::within(unsigned i, bool turning, double target, double position) const {
  if (!(config_.soft_limited >> i & 1)) return target;
  const double turns = turning ? 360 * turns_outside(position, config_.soft_min[i], config_.soft_max[i]) : 0;
  const double low = std::min(config_.soft_min[i] + turns, position), high = std::max(config_.soft_max[i] + turns, position);
  return std::min(high, std::max(low, target));
}

void Manual::wish(unsigned i, const nc_manual& w, const Rules& rules, double position) {
  Axis& a = axis_[i];
  const bool turning = (rules.turning >> i & 1) != 0;
  const bool edge = w.kind != a.kind;
  const bool was = a.kind == NC_MANUAL_JOG || a.kind == NC_MANUAL_REFERENCE;
  a.kind = w.kind;
  switch (w.kind) {
    case NC_MANUAL_JOG:
      a.going = w.velocity != 0;
      a.cap = std::min(std::fabs(w.velocity), top_speed(i));
      a.target = within(i, turning, position + std::copysign(kFar, w.velocity), position);
      break;
    case NC_MANUAL_STEP:
      if (!edge || w.distance == 0) break;
      // A step goes from where the axis would come to rest: from its target when it still has one.
      a.target = within(i, turning, (a.going && !was ? a.target : position) + w.distance, position);
      a.cap = top_speed(i);
      if (w.velocity != 0) a.cap = std::min(a.cap, std::fabs(w.velocity));
      a.going = true;
      break;
    case NC_MANUAL_HANDLE: {
      if (w.distance == 0) break;
      const double top = top_speed(i), ahead = top * kHandleLag_s + 0.5 * top * top / acceleration(i);
      double target = (a.going && !was ? a.target : position) + w.distance;
      target = std::min(position + ahead, std::max(position - ahead, target));
      a.target = within(i, turning, target, position);
      a.cap = top;
      a.going = true;
      break;
    }
    case NC_MANUAL_REFERENCE:
      if (!edge && a.going) break;
      a.target = config_.reference[i];
      // Within its limits an axis has one way only, whatever is shorter.
      if (turning) a.target = position + turn_to(a.target, within_one_turn(position), ((rules.short_cut & ~config_.soft_limited) >> i & 1) != 0);
      a.target = within(i, turning, a.target, position);
      a.cap = top_speed(i);
      a.going = true;
      break;
    default:
      if (was) a.going = false;  // let go
      break;
  }
}

/// One cycle towards the target, or to rest. The way to a target behind the axis leads over rest.
double Manual::move(unsigned i, bool held, double position) {
  Axis& a = axis_[i];
  const double accel = acceleration(i);
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
    const LawGoal goal{brake ? stopping + 1 : way, 0, brake ? 0 : a.cap, accel};
    const double left = advance(state, goal, time);
    const bool arrived = !brake && state.s >= way;
    position = arrived ? a.target : position + direction * state.s;
    a.velocity = arrived ? 0 : direction * state.v;
    if (arrived) a.going = false;
    if (brake && state.v == 0) {
      time = a.going ? std::max(0.0, time - v / accel) : 0;  // turn round with what is left of the cycle
    } else {
      time = arrived ? 0 : left;
    }
  }
  return position;
}

void Manual::idle(const nc_manual* wishes) {
  moved_ = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) axis_[i].kind = wishes[i].kind;
}

void Manual::cycle(const nc_manual* wishes, const Rules& rules, AxisVec* position) {
  active_ = moved_ = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    if ((rules.dropped >> i & 1) != 0) {
      axis_[i] = {.kind = wishes[i].kind};
      continue;
    }
    if (rules.stop) {
      axis_[i].going = false;
      axis_[i].kind = wishes[i].kind;
    } else {
      wish(i, wishes[i], rules, (*position)[i]);
    }
    if (axis_[i].velocity == 0 && !axis_[i].going) continue;
    const double before = (*position)[i];
    (*position)[i] = move(i, (rules.held >> i & 1) != 0, before);
    if ((*position)[i] != before) moved_ |= 1u << i;
    if (axis_[i].velocity != 0 || axis_[i].going) active_ |= 1u << i;
  }
}

}  // namespace nc
