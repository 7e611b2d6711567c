// SPDX-License-Identifier: Apache-2.0
// Why a drive does not do its work, in one number that travels with the alarm, and the sentence that it means.
#pragma once

#include <cstdint>
#include <string>

namespace nc::hal {

enum class DriveTrouble : std::uint8_t {
  kNone,         // the drive says only that it has a fault
  kEmergency,    // with its EMCY code and error register
  kHeartbeat,    // its node is silent
  kNoPosition,   // its positions do not come
  kRestarted,    // its node has begun anew by itself
  kNotEnabled,   // it does not come to "operation enabled" in time
  kLeftEnabled,  // it has left that state by itself
  kNoCommand,    // the scan has given no positions
  kNotConfigured,  // what the bus has said while the drive was set up again is in the log
  kHoming,       // its homing has ended with an error, or in no time
  kMode,         // it is in another mode of operation than it was told
  kTwice,        // two nodes send what only one may
  kJump          // the scan has asked for more in one SYNC than the axis can ever do
};

// Bits 0 to 15 the EMCY code, 16 to 23 the error register, 24 to 30 the trouble.
constexpr std::uint32_t drive_fault_code(DriveTrouble trouble, unsigned code = 0, unsigned error_register = 0) noexcept {
  return static_cast<std::uint32_t>(trouble) << 24 | (error_register & 0xFF) << 16 | (code & 0xFFFF);
}

// "EMCY 8611h: following error (error register 21h)"; empty for kNone.
std::string drive_fault_text(std::uint32_t code);

// The class of an EMCY code, as CiA 301 and CiA 402 name it: "following error".
const char* emergency_text(unsigned emergency) noexcept;

}  // namespace nc::hal
