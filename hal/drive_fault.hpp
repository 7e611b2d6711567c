// SPDX-License-Identifier: Apache-2.0
// The reason of a drive fault as one number, which is stored in the alarm, and its meaning as a sentence.
#pragma once

#include <cstdint>
#include <string>

namespace nc::hal {

enum class DriveTrouble : std::uint8_t {
  kNone,         // the drive says only that it has a fault
  kEmergency,    // with its EMCY code and error register
  kHeartbeat,    // the node of the drive sends no heartbeat
  kNoPosition,   // the drive sends no positions
  kRestarted,    // the node of the drive has restarted by itself
  kNotEnabled,   // the drive does not reach "operation enabled" in time
  kLeftEnabled,  // the drive has left that state by itself
  kNoCommand,    // the scan has given no positions
  kNotConfigured,  // the drive could not be set up again; the log says why
  kHoming,       // homing has ended with an error, or has not ended in time
  kTwice,        // two nodes send frames with the same identifier
  kJump,         // the set-point of one SYNC is farther than the axis can ever move in it
  kProbe,        // its touch probe has latched a place at which the axis was not
  kHomingNotBegun,  // its status stays that of the homing before
  kStep          // its measured position has made a step that the axis cannot make
};

// Bits 0 to 15 are the EMCY code, 16 to 23 the error register, 24 to 30 the DriveTrouble.
constexpr std::uint32_t drive_fault_code(DriveTrouble trouble, unsigned code = 0, unsigned error_register = 0) noexcept {
  return static_cast<std::uint32_t>(trouble) << 24 | (error_register & 0xFF) << 16 | (code & 0xFFFF);
}

// The sentence for a code, such as "EMCY 8611h: following error (error register 21h)"; empty for kNone.
std::string drive_fault_text(std::uint32_t code);

// The name of an EMCY code or of its class in CiA 301 and CiA 402, such as "following error".
const char* emergency_text(unsigned emergency) noexcept;

}  // namespace nc::hal
