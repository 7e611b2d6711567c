// SPDX-License-Identifier: Apache-2.0
// Converts registers to values of points and back: word order, sign, scaling, saturation.
#pragma once

#include <cstdint>

#include "hal/modbus/map.hpp"

namespace nc::hal::modbus {

// The 32 bits of a point are a signed number when the raw value is signed or a float, or when scale
// or offset are negative; otherwise they are an unsigned number. Values saturate at the ends of that range.
bool point_is_signed(const PointMap& map) noexcept;

// `cells`: the registers (or bits as 0 and 1) from map.address on. False when they are a float NaN.
bool decode(const PointMap& map, const std::uint16_t* cells, std::uint32_t* value) noexcept;

// The inverse of decode(), for outputs. The value saturates at the range of the raw value. A bit of a register changes only that bit.
void encode(const PointMap& map, std::uint32_t value, std::uint16_t* cells) noexcept;

// The whole numbers that a point can have: the range of its raw value, scaled and limited to 32 bits.
struct ValueRange {
  std::int64_t min = 0, max = 1;
  bool holds(std::int64_t value) const { return value >= min && value <= max; }
};
ValueRange value_range(const PointMap& map) noexcept;

}  // namespace nc::hal::modbus
