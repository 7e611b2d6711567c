// SPDX-License-Identifier: Apache-2.0
// The Modbus codec: word orders, signs, scaling, saturation, and that values which are written are read back the same.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "hal/modbus/codec.hpp"

namespace {

using namespace nc::hal::modbus;
using Cells = std::array<std::uint16_t, 2>;

PointMap word(Format format, double scale = 1, double offset = 0, WordOrder order = WordOrder::kAbcd) {
  PointMap map;
  map.format = format;
  map.scale = scale;
  map.offset = offset;
  map.order = order;
  return map;
}

std::uint32_t decoded(const PointMap& map, Cells cells) {
  std::uint32_t value = 0xDEADBEEF;
  EXPECT_TRUE(decode(map, cells.data(), &value));
  return value;
}
std::int32_t decoded_signed(const PointMap& map, Cells cells) {
  return static_cast<std::int32_t>(decoded(map, cells));
}
Cells encoded(const PointMap& map, std::int64_t value) {
  Cells cells{};
  encode(map, static_cast<std::uint32_t>(value), cells.data());
  return cells;
}
Cells of_float(float value) {
  const auto raw = std::bit_cast<std::uint32_t>(value);
  return {static_cast<std::uint16_t>(raw >> 16), static_cast<std::uint16_t>(raw)};
}

TEST(ModbusCodec, WordOrders) {
  // Bytes on the wire 0x11 0x22 0x33 0x44, two registers.
  const Cells wire{0x1122, 0x3344};
  EXPECT_EQ(decoded(word(Format::kU32, 1, 0, WordOrder::kAbcd), wire), 0x11223344u);
  EXPECT_EQ(decoded(word(Format::kU32, 1, 0, WordOrder::kCdab), wire), 0x33441122u);
  EXPECT_EQ(decoded(word(Format::kU32, 1, 0, WordOrder::kBadc), wire), 0x22114433u);
  EXPECT_EQ(decoded(word(Format::kU32, 1, 0, WordOrder::kDcba), wire), 0x44332211u);
  EXPECT_EQ(encoded(word(Format::kU32, 1, 0, WordOrder::kAbcd), 0x0A0B0C0D), (Cells{0x0A0B, 0x0C0D}));
  EXPECT_EQ(encoded(word(Format::kU32, 1, 0, WordOrder::kCdab), 0x0A0B0C0D), (Cells{0x0C0D, 0x0A0B}));
  EXPECT_EQ(encoded(word(Format::kU32, 1, 0, WordOrder::kBadc), 0x0A0B0C0D), (Cells{0x0B0A, 0x0D0C}));
  EXPECT_EQ(encoded(word(Format::kU32, 1, 0, WordOrder::kDcba), 0x0A0B0C0D), (Cells{0x0D0C, 0x0B0A}));
}

TEST(ModbusCodec, SignsAndWidths) {
  EXPECT_EQ(decoded(word(Format::kU16), {0xFFFE, 0}), 65534u);
  EXPECT_EQ(decoded_signed(word(Format::kS16), {0xFFFE, 0}), -2);
  EXPECT_EQ(decoded(word(Format::kU32), {0xFFFF, 0xFFFE}), 4294967294u);
  EXPECT_EQ(decoded_signed(word(Format::kS32), {0xFFFF, 0xFFFE}), -2);
  EXPECT_EQ(encoded(word(Format::kS16), -2)[0], 0xFFFE);
  EXPECT_EQ(encoded(word(Format::kS32), -2), (Cells{0xFFFF, 0xFFFE}));
}

TEST(ModbusCodec, Scaling) {
  EXPECT_EQ(decoded(word(Format::kU16, 0.1), {1234, 0}), 123u);
  EXPECT_EQ(decoded(word(Format::kU16, 0.1), {1235, 0}), 124u) << "halves away from zero";
  EXPECT_EQ(decoded_signed(word(Format::kS16, 0.5), {0xFFFD, 0}), -2) << "-1.5";
  EXPECT_EQ(decoded_signed(word(Format::kU16, 1, -40), {10, 0}), -30)
      << "a negative offset makes a signed point";
  EXPECT_EQ(decoded_signed(word(Format::kU16, -2), {10, 0}), -20);
  EXPECT_EQ(decoded_signed(word(Format::kF32, 1000), of_float(-12.3456f)), -12346);
  EXPECT_EQ(encoded(word(Format::kU16, 0.1), 123)[0], 1230);
  EXPECT_EQ(encoded(word(Format::kU16, 1, -40), -30)[0], 10);
  EXPECT_EQ(encoded(word(Format::kF32, 1000), -12346), of_float(-12.346f));
}

TEST(ModbusCodec, Saturation) {
  EXPECT_EQ(decoded(word(Format::kU16, 1e6), {0xFFFF, 0}), 0xFFFFFFFFu);
  EXPECT_EQ(decoded_signed(word(Format::kS16, 1e6), {0x7FFF, 0}), 2147483647);
  EXPECT_EQ(decoded_signed(word(Format::kS16, 1e6), {0x8000, 0}), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(decoded_signed(word(Format::kF32), of_float(1e30f)), 2147483647);
  EXPECT_EQ(decoded_signed(word(Format::kF32), of_float(-std::numeric_limits<float>::infinity())),
            std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(encoded(word(Format::kU16), 70000)[0], 65535);
  EXPECT_EQ(encoded(word(Format::kS16), -40000)[0], 0x8000);
  EXPECT_EQ(encoded(word(Format::kS16), 40000)[0], 0x7FFF);
  EXPECT_EQ(encoded(word(Format::kU16, 1, -10), -20)[0], 0) << "raw -10 is below the register";
  EXPECT_EQ(encoded(word(Format::kF32, 1e-9, 0), 4294967295), of_float(-1e9f)) << "-1 / 1e-9";
}

TEST(ModbusCodec, NoNumberIsNoValue) {
  std::uint32_t value = 7;
  const Cells nan = of_float(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(decode(word(Format::kF32), nan.data(), &value));
  EXPECT_EQ(value, 7u);
}

TEST(ModbusCodec, Bits) {
  PointMap map;
  map.table = Table::kHolding;
  map.bit = 9;
  std::uint16_t cell = 0xF00F;
  EXPECT_EQ(decoded(map, {cell, 0}), 0u);
  encode(map, 1, &cell);
  EXPECT_EQ(cell, 0xF20F) << "only its own bit";
  EXPECT_EQ(decoded(map, {cell, 0}), 1u);
  encode(map, 0, &cell);
  EXPECT_EQ(cell, 0xF00F);
  map.table = Table::kCoil;
  encode(map, 5, &cell);
  EXPECT_EQ(cell, 1) << "a coil holds 0 or 1";
}

RC_GTEST_PROP(ModbusCodec, WhatGoesOutComesBack, (std::uint32_t value)) {
  const auto format = *rc::gen::element(Format::kU16, Format::kS16, Format::kU32, Format::kS32);
  const auto order =
      *rc::gen::element(WordOrder::kAbcd, WordOrder::kCdab, WordOrder::kBadc, WordOrder::kDcba);
  const double offset = *rc::gen::inRange(-1000, 1000);
  const PointMap map = word(format, 1, offset, order);
  Cells cells{};
  encode(map, value, cells.data());
  std::uint32_t back = 0;
  RC_ASSERT(decode(map, cells.data(), &back));
  // The nearest number that the register and the point can hold.
  const bool is_signed = point_is_signed(map);
  const double wanted = is_signed ? static_cast<double>(static_cast<std::int32_t>(value)) : value;
  const double got = is_signed ? static_cast<double>(static_cast<std::int32_t>(back)) : back;
  const double low = format == Format::kS16 ? -32768 : format == Format::kS32 ? -2147483648.0 : 0;
  const double high = format == Format::kU16   ? 65535
                      : format == Format::kS16 ? 32767
                      : format == Format::kU32 ? 4294967295.0
                                               : 2147483647.0;
  const double point_low = is_signed ? -2147483648.0 : 0,
               point_high = is_signed ? 2147483647.0 : 4294967295.0;
  const double raw = std::fmin(std::fmax(wanted - offset, low), high);
  RC_ASSERT(got == std::fmin(std::fmax(raw + offset, point_low), point_high));
}

}  // namespace
