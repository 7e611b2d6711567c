// SPDX-License-Identifier: Apache-2.0
// One frame of classic CAN with an identifier of 11 bits, as CANopen uses it; numbers in its data are little endian (CiA 301).
#pragma once

#include <cstdint>

namespace nc::hal::canopen {

inline constexpr unsigned kMaxData = 8;

// What the CAN controller reports about the bus, in place of a frame.
enum class BusEvent : std::uint8_t { kNone, kBusOff, kErrorPassive, kRestarted, kOverflow };

struct CanFrame {
  std::uint16_t id = 0;
  std::uint8_t length = 0;
  BusEvent event = BusEvent::kNone;  // unless it is kNone, `id` and `data` have no meaning
  std::uint8_t data[kMaxData] = {};
};

inline std::uint32_t get_le(const std::uint8_t* data, unsigned bytes) noexcept {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) value |= static_cast<std::uint32_t>(data[i]) << 8 * i;
  return value;
}
inline void put_le(std::uint8_t* data, unsigned bytes, std::uint32_t value) noexcept {
  for (unsigned i = 0; i < bytes; ++i) data[i] = static_cast<std::uint8_t>(value >> 8 * i);
}

// Identifiers of the predefined connection set (CiA 301).
inline constexpr unsigned kNmtId = 0x000, kSyncId = 0x080, kEmergencyId = 0x080, kTpdoId = 0x180, kRpdoId = 0x200, kPdoStep = 0x100,
                          kSdoAnswerId = 0x580, kSdoRequestId = 0x600, kHeartbeatId = 0x700;
inline constexpr unsigned kFirstNode = 1, kLastNode = 127;

}  // namespace nc::hal::canopen
