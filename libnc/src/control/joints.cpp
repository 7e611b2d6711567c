// SPDX-License-Identifier: Apache-2.0
#include "control/joints.hpp"

#include <cmath>

#include "base/struct_size.hpp"

namespace nc {
namespace {

/// Share by which a velocity or acceleration may exceed its limit. At 1e6 mm rounding changes the difference of two positions one micrometre apart
/// by about this much, and a limit that is just kept must not be reported.
constexpr double kRounding = 1e-6;

bool above(double value, double limit) { return limit > 0 && std::fabs(value) > limit * (1 + kRounding) + kRounding; }

}  // namespace

void Joints::create(const nc_kinematics* kinematics, double cycle_s) {
  any_ = kinematics != nullptr;
  cycle_s_ = cycle_s;
  if (any_) take_struct(kinematics, &kinematics_);
}

void Joints::before(nc_inputs* in) {
  actual_fault_ = 0;
  if (stops_) in->alarm = true;
  if (kinematics_.forward == nullptr) return;
  if (in->actual_valid && !turn(&in->actual)) {
    in->actual_valid = false;
    actual_fault_ = NC_JOINT_ACTUAL;
  }
  if (in->skip_latched != 0 && !turn(&in->skip_place)) {
    in->skip_latched = 0;
    actual_fault_ = NC_JOINT_ACTUAL;
  }
}

/// Measured joints into a machine position; false where there is none.
bool Joints::turn(nc_axes* place) const {
  nc_axes machine{};
  bool finite = kinematics_.forward(kinematics_.user, place, &machine);
  for (const double v : machine.v) finite = finite && std::isfinite(v);
  if (finite) *place = machine;
  return finite;
}

void Joints::after(nc_outputs* out) {
  const uint8_t faults = follow(out->command);
  stops_ = (faults & (NC_JOINT_UNREACHABLE | NC_JOINT_RANGE)) != 0;
  out->joint = joint_;
  out->joint_velocity = velocity_;
  out->joint_faults = static_cast<uint8_t>(faults | actual_fault_);
}

uint8_t Joints::follow(const nc_axes& machine) {
  nc_axes next{};
  bool good = kinematics_.inverse(kinematics_.user, &machine, &next);
  for (unsigned i = 0; i < kinematics_.joint_count; ++i) good = good && std::isfinite(next.v[i]);
  uint8_t faults = good ? 0 : NC_JOINT_UNREACHABLE;
  for (unsigned i = 0; i < kinematics_.joint_count && good; ++i) {
    const nc_joint_config& joint = kinematics_.joint[i];
    if ((joint.min != 0 || joint.max != 0) && (next.v[i] < joint.min || next.v[i] > joint.max)) faults = NC_JOINT_RANGE;
  }
  if (faults != 0) {
    known_ = known_ != 0 ? 1 : 0;
    velocity_ = {};
    return faults;
  }
  nc_axes velocity{};
  for (unsigned i = 0; i < kinematics_.joint_count; ++i) {
    const nc_joint_config& joint = kinematics_.joint[i];
    velocity.v[i] = known_ != 0 ? (next.v[i] - joint_.v[i]) / cycle_s_ : 0;
    if (above(velocity.v[i], joint.max_velocity)) faults |= NC_JOINT_VELOCITY;
    if (known_ == 2 && above((velocity.v[i] - velocity_.v[i]) / cycle_s_, joint.max_acceleration)) faults |= NC_JOINT_ACCELERATION;
  }
  for (unsigned i = 0; i < NC_MAX_AXES; ++i) joint_.v[i] = i < kinematics_.joint_count ? next.v[i] : 0;
  velocity_ = velocity;
  if (known_ < 2) ++known_;
  return faults;
}

}  // namespace nc
