// SPDX-License-Identifier: Apache-2.0
// The clock of an offline run; see path_clock.hpp. The speed of the spindle is the one that the scan commands (libnc/src/interpolate/spindle.hpp).
#include "tools/lib/path_clock.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace nc::tools {
namespace {

constexpr double kSmallestRadius = 1e-3;  // mm
constexpr unsigned kSlices = 256;         // of a move along which the speed changes

/** Workpiece coordinate of an axis where this share of a move is done: on the way from its start to its end, or on its arc. */
double coordinate_on(const nc_move& move, unsigned axis, double share) {
  if (move.center_axes == 2)
    for (unsigned k = 0; k < 2; ++k) {
      if (move.plane_axis[k] != axis) continue;
      const unsigned first = move.plane_axis[0], second = move.plane_axis[1];
      const double u = move.machine_start.v[first] - move.machine_center[0], v = move.machine_start.v[second] - move.machine_center[1];
      const double turned = share * move.sweep_deg * std::numbers::pi / 180.0;
      const double at = k == 0 ? u * std::cos(turned) - v * std::sin(turned) : u * std::sin(turned) + v * std::cos(turned);
      return move.machine_center[k] + at + move.work.v[axis] - move.machine.v[axis];
    }
  return move.work.v[axis] - (1.0 - share) * (move.machine.v[axis] - move.machine_start.v[axis]);
}

}  // namespace

void PathClock::control(const nc_action& action, const nc_axes& work) {
  const unsigned axis = action.bits == 0 ? 0u : static_cast<unsigned>(std::countr_zero(action.bits)) + 1u;
  if (action.index == NC_CONTROL_SURFACE_SPEED) {
    if (axis == 0 && axis_ != 0) code_ = rev_min(work);  // a spindle that turns keeps its speed
    axis_ = axis;
    m_min_ = action.value;
  } else if (action.index == NC_CONTROL_SURFACE_RADIUS && axis != 0) {
    radius_axis_ = axis;
    radius_mm_ = action.value;
    radius_at_ = work.v[axis - 1];
  } else if (action.index == NC_CONTROL_SPINDLE_CLAMP) {
    const auto how = static_cast<uint32_t>(action.value);
    if ((how & (NC_CLAMP_S | NC_CLAMP_Q)) == 0) {
      clamp_s_ = clamp_q_ = 0.0;
      has_s_ = false;
    }
    if ((how & NC_CLAMP_S) != 0) {
      clamp_s_ = action.bits;
      has_s_ = true;
    }
    if ((how & NC_CLAMP_Q) != 0) clamp_q_ = action.mask;
    clamp_ = how;
  }
}

// M700 10.4, precaution (1): an S that was commanded and is smaller than Q changes places with it; without an S there is no upper clamp.
double PathClock::clamped(double speed) const {
  if (axis_ == 0 && (clamp_ & NC_CLAMP_ALWAYS) == 0) return speed;
  const double high = has_s_ ? std::max(clamp_s_, clamp_q_) : 0.0, low = has_s_ ? std::min(clamp_s_, clamp_q_) : clamp_q_;
  if (high > 0.0) speed = std::min(speed, high);
  return speed > 0.0 ? std::max(speed, low) : speed;
}

double PathClock::rev_min(const nc_axes& work) const {
  if (axis_ == 0) return clamped(code_);
  const double at = work.v[axis_ - 1];
  const double radius = axis_ == radius_axis_ ? radius_mm_ + (at - radius_at_) / 2.0 : at;
  return clamped(1000.0 * m_min_ / (2.0 * std::numbers::pi * std::max(std::fabs(radius), kSmallestRadius)));
}

double PathClock::arc_length(const nc_move& move) {
  const double u = move.machine.v[move.plane_axis[0]] - move.machine_center[0], v = move.machine.v[move.plane_axis[1]] - move.machine_center[1];
  return std::fabs(move.sweep_deg) * std::numbers::pi / 180.0 * (move.radius + std::hypot(u, v)) / 2.0;
}

// A feed per revolution, up to this share of the length. The lead of a thread is along the axis that goes furthest (M700 6.7.1).
double PathClock::synchronous(const nc_move& move, double share) const {
  double length = move.length;
  if (move.kind == NC_MOVE_THREAD) {
    length = 0.0;
    for (unsigned a = 0; a < NC_MAX_AXES; ++a) length = std::max(length, std::fabs(move.machine.v[a] - move.machine_start.v[a]));
  }
  const double minutes = share * length / move.feed_mm_rev;  // ... at 1 r/min
  if (is_constant()) {
    const double speed = clamped(code_);
    return speed > 0.0 ? minutes / speed * 60.0 : 0.0;
  }
  double sum = 0.0;  // of the time per revolution at the middle of each slice
  nc_axes at = move.work;
  for (unsigned i = 0; i < kSlices; ++i) {
    at.v[axis_ - 1] = coordinate_on(move, axis_ - 1, share * (i + 0.5) / kSlices);
    const double speed = rev_min(at);
    sum += speed > 0.0 ? 1.0 / speed : 0.0;
  }
  return minutes * sum / kSlices * 60.0;
}

double PathClock::share_after(const nc_move& move, double after) const {
  const double all = seconds(move);
  if (!(after < all)) return 1.0;
  if (is_constant() || !(move.feed_mm_rev > 0.0) || move.kind == NC_MOVE_TAP) return std::max(0.0, after / all);
  double low = 0.0, high = 1.0;
  for (unsigned i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2.0;
    (synchronous(move, middle) < after ? low : high) = middle;
  }
  return low;
}

}  // namespace nc::tools
