// SPDX-License-Identifier: Apache-2.0
// What a drive is told before its PDOs count, in order: identity, heartbeats, PDOs, units of time, homing, and what the configuration adds.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/canopen/bus_map.hpp"

namespace nc::hal::canopen {

struct SetupStep {
  enum class Kind : std::uint8_t {
    kWrite,
    kWriteIfThere,  // a drive without this object does without it
    kCheck          // read; `mask` of it must be `value`
  };
  Kind kind = Kind::kWrite;
  ObjectValue object;
  std::uint32_t mask = 0xFFFFFFFF;
};

std::vector<SetupStep> setup_plan(const BusMap& bus, const NodeMap& node);

// 60C2h: a period as mantissa x 10^exponent seconds. It can be told when the mantissa fits into one byte.
struct InterpolationTime {
  unsigned mantissa = 1;
  int exponent = -3;
};
InterpolationTime interpolation_time_of(unsigned us);

// One PDO as its mapping parameter says: index << 16 | sub-index << 8 | bits.
std::vector<std::uint32_t> rpdo_mapping(const AxisMap& axis);
std::vector<std::uint32_t> tpdo_mapping(const AxisMap& axis);
std::vector<std::uint32_t> probe_mapping(const AxisMap& axis);

}  // namespace nc::hal::canopen
