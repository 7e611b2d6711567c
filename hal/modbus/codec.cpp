// SPDX-License-Identifier: Apache-2.0
// Converts registers to values of points and back. See codec.hpp.
#include "hal/modbus/codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace nc::hal::modbus {
namespace {

std::uint16_t swap_bytes(std::uint16_t word) {
  return static_cast<std::uint16_t>((word << 8 | word >> 8) & 0xFFFF);
}

// BADC and DCBA swap the bytes in both words; CDAB and DCBA swap the words. Each swap is its own inverse.
void reorder(WordOrder order, std::uint16_t* high, std::uint16_t* low) {
  if (order == WordOrder::kBadc || order == WordOrder::kDcba) {
    *high = swap_bytes(*high);
    *low = swap_bytes(*low);
  }
  if (order == WordOrder::kCdab || order == WordOrder::kDcba) std::swap(*high, *low);
}

// Rounds to the nearest number of type T, halves away from zero, and saturates. `value` must not be NaN.
template <class T>
T saturated(double value) {
  constexpr double kMin = std::numeric_limits<T>::min(), kMax = std::numeric_limits<T>::max();
  return static_cast<T>(std::clamp(std::round(value), kMin, kMax));
}

}  // namespace

bool point_is_signed(const PointMap& map) noexcept {
  return map.format == Format::kS16 || map.format == Format::kS32 || map.format == Format::kF32 ||
         map.scale < 0 || map.offset < 0;
}

bool decode(const PointMap& map, const std::uint16_t* cells, std::uint32_t* value) noexcept {
  std::uint32_t raw32 = 0;
  if (map.width() == 2) {
    std::uint16_t high = cells[0], low = cells[1];
    reorder(map.order, &high, &low);
    raw32 = static_cast<std::uint32_t>(high) << 16 | low;
  }
  double raw = 0;
  switch (map.format) {
    case Format::kBit:
      *value = is_bit_table(map.table) ? (cells[0] != 0 ? 1u : 0u) : cells[0] >> map.bit & 1u;
      return true;
    case Format::kU16:
      raw = cells[0];
      break;
    case Format::kS16:
      raw = static_cast<std::int16_t>(cells[0]);
      break;
    case Format::kU32:
      raw = raw32;
      break;
    case Format::kS32:
      raw = static_cast<std::int32_t>(raw32);
      break;
    case Format::kF32:
      raw = static_cast<double>(std::bit_cast<float>(raw32));
      break;
  }
  const double scaled = raw * map.scale + map.offset;
  if (std::isnan(scaled)) return false;
  *value = point_is_signed(map) ? static_cast<std::uint32_t>(saturated<std::int32_t>(scaled))
                                : saturated<std::uint32_t>(scaled);
  return true;
}

void encode(const PointMap& map, std::uint32_t value, std::uint16_t* cells) noexcept {
  if (map.format == Format::kBit) {
    if (is_bit_table(map.table)) {
      cells[0] = value != 0 ? 1 : 0;
    } else {
      const auto mask = static_cast<std::uint16_t>(1u << map.bit);
      cells[0] = static_cast<std::uint16_t>(value != 0 ? cells[0] | mask : cells[0] & ~mask);
    }
    return;
  }
  const double number = point_is_signed(map) ? static_cast<double>(static_cast<std::int32_t>(value))
                                             : static_cast<double>(value);
  const double raw = (number - map.offset) / map.scale;
  std::uint32_t raw32 = 0;
  switch (map.format) {
    case Format::kBit:
      return;
    case Format::kU16:
      cells[0] = saturated<std::uint16_t>(raw);
      return;
    case Format::kS16:
      cells[0] = static_cast<std::uint16_t>(saturated<std::int16_t>(raw));
      return;
    case Format::kU32:
      raw32 = saturated<std::uint32_t>(raw);
      break;
    case Format::kS32:
      raw32 = static_cast<std::uint32_t>(saturated<std::int32_t>(raw));
      break;
    case Format::kF32: {
      constexpr double kMax = std::numeric_limits<float>::max();
      raw32 = std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(raw, -kMax, kMax)));
      break;
    }
  }
  auto high = static_cast<std::uint16_t>(raw32 >> 16), low = static_cast<std::uint16_t>(raw32 & 0xFFFF);
  reorder(map.order, &high, &low);
  cells[0] = high;
  cells[1] = low;
}

ValueRange value_range(const PointMap& map) noexcept {
  const bool is_signed = point_is_signed(map);
  const double low = is_signed ? -2147483648.0 : 0, high = is_signed ? 2147483647.0 : 4294967295.0;
  const auto scaled = [&](double from, double to) -> ValueRange {
    const double a = from * map.scale + map.offset, b = to * map.scale + map.offset;
    // Rounded in the same way as in decode(), so that every value that decode() can give is in the range.
    return {static_cast<std::int64_t>(std::clamp(std::round(std::min(a, b)), low, high)),
            static_cast<std::int64_t>(std::clamp(std::round(std::max(a, b)), low, high))};
  };
  switch (map.format) {
    case Format::kBit: return {0, 1};
    case Format::kU16: return scaled(0, 65535);
    case Format::kS16: return scaled(-32768, 32767);
    case Format::kU32: return scaled(0, 4294967295.0);
    case Format::kS32: return scaled(-2147483648.0, 2147483647.0);
    case Format::kF32: return scaled(-std::numeric_limits<float>::max(), std::numeric_limits<float>::max());
  }
  return scaled(low, high);
}

}  // namespace nc::hal::modbus
