// SPDX-License-Identifier: Apache-2.0
// Registers to point values and back: word order, sign, scaling, saturation.
#pragma once

#include <cstdint>

#include "hal/modbus/map.hpp"

namespace nc::hal::modbus {

// The 32 bits of a point are read as a signed number when the raw value is signed or a float, or when scale
// or offset are negative; otherwise as an unsigned one. It saturates at the ends of that range.
bool point_is_signed(const PointMap& map) noexcept;

// `cells`: the registers (or bits, 0 and 1) from map.address on. False when they are no number: a float NaN.
bool decode(const PointMap& map, const std::uint16_t* cells, std::uint32_t* value) noexcept;

// The inverse, for outputs; a bit of a register changes that bit only. Saturates at the raw range.
void encode(const PointMap& map, std::uint32_t value, std::uint16_t* cells) noexcept;

// The whole numbers that a point can have: its raw range, scaled, within its 32 bits.
struct ValueRange {
  std::int64_t min = 0, max = 1;
  bool holds(std::int64_t value) const { return value >= min && value <= max; }
};
ValueRange value_range(const PointMap& map) noexcept;

}  // namespace nc::hal::modbus
