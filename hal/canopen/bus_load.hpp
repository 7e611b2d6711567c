// SPDX-License-Identifier: Apache-2.0
// How full a bus of drives is: the bits of its frames with as many stuff bits as their content can ask for.
//
// A data frame of classic CAN with an identifier of 11 bits and n bytes has 47 + 8 n bits, interframe space included. Stuffing acts on
// 34 + 8 n of them: in the worst case one bit behind the first five and behind each four that follow, floor((34 + 8 n - 1) / 4).
#pragma once

#include <string>
#include <vector>

#include "hal/canopen/bus_map.hpp"

namespace nc::hal::canopen {

inline constexpr double kMostLoad = 0.80;  // what is left is for SDO, EMCY and repeated frames

constexpr unsigned worst_bits(unsigned bytes) { return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4; }

// Bytes of the PDOs of an axis.
unsigned rpdo_bytes(const AxisMap& axis);               // 6040h, 607Ah
std::vector<unsigned> tpdo_bytes(const AxisMap& axis);  // 6041h, 6064h; with a touch probe another one of 60B9h, 60BAh

struct BusLoad {
  double share = 0;       // of the time of a SYNC period, worst case; heartbeats of one period per heartbeat time
  std::string arithmetic;  // "SYNC 55 + 6 PDOs of 6 bytes 115 ... = 745 bits of 1000 in 1000 us at 1000000 bit/s: 74.8 %"
};
BusLoad bus_load(const BusMap& bus);

// Between two frames of the slow part (SDO, NMT) so many SYNC periods pass, that load and exchange together stay below the whole.
unsigned slow_every(const BusMap& bus);

}  // namespace nc::hal::canopen
