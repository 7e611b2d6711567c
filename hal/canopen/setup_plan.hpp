// SPDX-License-Identifier: Apache-2.0
// The SDO transfers with which a drive is set up, in this order: identity, heartbeats, PDOs, units of time, homing, and the objects of the configuration.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/canopen/bus_map.hpp"

namespace nc::hal::canopen {

struct SetupStep {
  enum class Kind : std::uint8_t {
    kWrite,
    kWriteIfThere,  // skipped when the drive does not have this object, or does not let it be written
    kIsZero,        // 0 is written; a drive that does not have this object has 0
    kCheck          // the object is read, and its bits in `mask` must be those of `value`
  };
  Kind kind = Kind::kWrite;
  ObjectValue object;
  std::uint32_t mask = 0xFFFFFFFF;
};

std::vector<SetupStep> setup_plan(const BusMap& bus, const NodeMap& node);

// Of that the objects 6000h to 9FFFh of one axis, without its PDOs.
std::vector<SetupStep> axis_setup(const AxisMap& axis, unsigned sync_us);

// 60C2h: a period as mantissa x 10^exponent seconds. The mantissa must fit into one byte.
struct InterpolationTime {
  unsigned mantissa = 1;
  int exponent = -3;
};
InterpolationTime interpolation_time_of(unsigned us);

// The objects in one PDO, each as the mapping parameter has it: index << 16 | sub-index << 8 | bits.
std::vector<std::uint32_t> rpdo_mapping(const AxisMap& axis);
std::vector<std::uint32_t> tpdo_mapping(const AxisMap& axis);
std::vector<std::uint32_t> probe_mapping(const AxisMap& axis);

// What the control sets in a node by itself, in its set-up, with its command PDOs and by the service, whatever `objects` of the node says: only index and sub count.
std::vector<ObjectValue> own_objects(const BusMap& bus, NodeMap node);

}  // namespace nc::hal::canopen
