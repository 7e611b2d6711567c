// SPDX-License-Identifier: Apache-2.0
// The state machine of CiA 402. See drive_state.hpp.
#include "hal/canopen/drive_state.hpp"

namespace nc::hal::canopen {
namespace {

constexpr unsigned kResetHalf = 4;  // number of SYNCs for which bit 7 is off and then on: a drive needs its rising edge and may sample it more slowly

}  // namespace

DriveState drive_state(std::uint16_t status) noexcept {
  switch (status & 0x4F) {
    case 0x00: return DriveState::kNotReady;
    case 0x40: return DriveState::kSwitchOnDisabled;
    case 0x0F: return DriveState::kFaultReaction;
    case 0x08: return DriveState::kFault;
    default: break;
  }
  switch (status & 0x6F) {
    case 0x21: return DriveState::kReadyToSwitchOn;
    case 0x23: return DriveState::kSwitchedOn;
    case 0x27: return DriveState::kOperationEnabled;
    case 0x07: return DriveState::kQuickStopActive;
    default: return DriveState::kNotReady;
  }
}

const char* drive_state_name(DriveState state) noexcept {
  constexpr const char* kNames[] = {"not ready", "switch on disabled", "ready to switch on", "switched on",
                                    "operation enabled", "quick stop active", "fault reaction active", "fault"};
  return kNames[static_cast<unsigned>(state)];
}

std::uint16_t DriveWay::next(std::uint16_t status, DriveWish wish) noexcept {
  const DriveState state = drive_state(status);
  if (wish == DriveWish::kReset && state == DriveState::kFault) {
    const bool on = reset_phase_ >= kResetHalf;
    reset_phase_ = (reset_phase_ + 1) % (2 * kResetHalf);
    return on ? kFaultReset : kDisableVoltage;
  }
  reset_phase_ = 0;
  if (wish != DriveWish::kOn) return off(state);
  stopping_ = 0;  // each quick stop has its whole time
  return on(state);
}

// A drive that controls its axis stops it by its own quick stop and then leaves the state by itself, or stays in it, depending on its object 605Ah. When the time
// for stopping is over, the voltage is switched off.
std::uint16_t DriveWay::off(DriveState state) noexcept {
  if (state == DriveState::kOperationEnabled || state == DriveState::kQuickStopActive)
    return stopping_ < stop_syncs_ ? (++stopping_, kQuickStop) : kDisableVoltage;
  stopping_ = 0;
  return state == DriveState::kFault || state == DriveState::kFaultReaction ? kDisableVoltage : kShutdown;
}

std::uint16_t DriveWay::on(DriveState state) const noexcept {
  switch (state) {
    case DriveState::kSwitchOnDisabled: return kShutdown;
    case DriveState::kReadyToSwitchOn: return kSwitchOn;
    case DriveState::kSwitchedOn:
    case DriveState::kOperationEnabled: return kEnableOperation;
    case DriveState::kQuickStopActive:
    case DriveState::kNotReady:
    case DriveState::kFaultReaction:
    case DriveState::kFault: break;
  }
  return kDisableVoltage;
}

}  // namespace nc::hal::canopen
