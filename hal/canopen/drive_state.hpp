// SPDX-License-Identifier: Apache-2.0
// The state machine of CiA 402, without a bus: the meaning of the status word, and the control word that leads to the state that is wanted.
#pragma once

#include <cstdint>

namespace nc::hal::canopen {

enum class DriveState : std::uint8_t {
  kNotReady,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReaction,
  kFault
};

// The state that the status word 6041h means (CiA 402-2, table "state coding").
DriveState drive_state(std::uint16_t status) noexcept;
const char* drive_state_name(DriveState state) noexcept;

// Bits of the status word that this control looks at.
inline constexpr std::uint16_t kStatusRemote = 1u << 9, kStatusReached = 1u << 10, kStatusLimit = 1u << 11,
                               kStatusFollows = 1u << 12,  // cyclic position and velocity: the drive follows the command; homing: attained
    kStatusError = 1u << 13;    // cyclic position: following error; homing: error

// Control words (CiA 402-2, "command coding").
inline constexpr std::uint16_t kDisableVoltage = 0x0000, kQuickStop = 0x0002, kShutdown = 0x0006, kSwitchOn = 0x0007, kEnableOperation = 0x000F,
                               kFaultReset = 0x0080, kStartHoming = 0x0010, kHalt = 0x0100;

enum class DriveWish : std::uint8_t {
  kOff,     // stop by the drive's quick stop, then no torque
  kOn,      // operation enabled
  kReset    // leave a fault; without a fault the same as kOff
};

// Leads a drive from its state to the one that is wanted, with one control word per SYNC.
class DriveWay {
 public:
  // `stop_syncs`: after this number of SYNCs a quick stop that has not ended is ended by switching the voltage off.
  explicit DriveWay(unsigned stop_syncs = 1000) : stop_syncs_(stop_syncs) {}
  std::uint16_t next(std::uint16_t status, DriveWish wish) noexcept;

 private:
  std::uint16_t off(DriveState state) noexcept;
  std::uint16_t on(DriveState state) const noexcept;

  unsigned stop_syncs_;
  unsigned stopping_ = 0;
  unsigned reset_phase_ = 0;
};

}  // namespace nc::hal::canopen
