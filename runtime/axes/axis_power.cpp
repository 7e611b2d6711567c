// SPDX-License-Identifier: Apache-2.0
// See axis_power.hpp.
#include "runtime/axes/axis_power.hpp"

namespace nc::rt {
namespace {

constexpr double kScans = 2.5;  // until what a drive says belongs to what it was told last
constexpr double kRounding = 1e-9;

}  // namespace

void AxisPower::step(const Seen& seen) noexcept {
  time_s_ += seen.cycle_s;
  if (seen.dead && has_brake()) {  // the brake alone holds
    if (phase_ != Phase::kOff) enter(Phase::kOff);
    return;
  }
  switch (phase_) {
    case Phase::kOff:
      if (!seen.off && seen.stands) enter(Phase::kStarting);
      break;
    case Phase::kStarting:
      if (seen.off) enter(Phase::kOff);
      else if (seen.follows && time_s_ > kScans * seen.cycle_s) enter(has_brake() ? Phase::kOpening : Phase::kOn);
      break;
    case Phase::kOpening:
      if (seen.off) enter(Phase::kClosing);
      else if (time_s_ + kRounding >= brake_.open_s) enter(Phase::kOn);
      break;
    case Phase::kOn:
      if (seen.off) enter(has_brake() ? Phase::kClosing : Phase::kOff);
      break;
    case Phase::kClosing:
      if (time_s_ + kRounding >= brake_.close_s) enter(Phase::kOff);
      break;
  }
}

}  // namespace nc::rt
