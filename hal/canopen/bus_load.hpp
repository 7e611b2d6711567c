// SPDX-License-Identifier: Apache-2.0
// The load of a bus of drives: the bits of its frames, with as many stuff bits as the frames can have at most.
//
// A data frame of classic CAN with an identifier of 11 bits and n bytes has 47 + 8 n bits, including the interframe space. Of these 34 + 8 n are
// subject to stuffing: in the worst case a bit is inserted after the first five and after each four that follow, floor((34 + 8 n - 1) / 4) bits.
#pragma once

#include <string>
#include <vector>

#include "hal/canopen/bus_map.hpp"

namespace nc::hal::canopen {

inline constexpr double kMostLoad = 0.80;  // the rest is for SDO, EMCY and repeated frames
inline constexpr double kMostTogether = 0.95;

constexpr unsigned worst_bits(unsigned bytes) { return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4; }

// Bytes of the PDOs of an axis.
unsigned rpdo_bytes(const AxisMap& axis);               // 6040h, 607Ah, and with a touch probe 60B8h
std::vector<unsigned> tpdo_bytes(const AxisMap& axis);  // 6041h, 6064h; with a touch probe a second PDO with 60B9h and 60BAh or 60BBh

struct BusLoad {
  double share = 0;       // fraction of a SYNC period in the worst case; heartbeats, and PDOs that come with every n-th SYNC only, count with their average
  double together = 0;    // the same of a SYNC period in which the PDOs of all modules come
  std::string arithmetic;  // the calculation as text: "SYNC 55 + 6 PDOs of 6 bytes, 115 each + heartbeats ...: 74.8 %"
};
BusLoad bus_load(const BusMap& bus);

// The number of SYNC periods from one frame of the slow part (SDO, NMT) to the next. It is chosen so that its requests and answers together with the
// cyclic frames stay below 95 % of the bus.
unsigned slow_every(const BusMap& bus);

}  // namespace nc::hal::canopen
