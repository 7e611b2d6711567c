// SPDX-License-Identifier: Apache-2.0
// An I/O module of CiA 401 on the bus of the drives, as plain data: which points lie on which of its inputs and outputs, and the PDOs that follow from that.
//
// CiA 401 gives a module one PDO for up to 64 digital inputs and three for up to 12 analog ones, and the same for its outputs:
//   PDO 1       6000h (inputs), 6200h (outputs), sub-index 1 ... 8: eight bits each
//   PDO 2 to 4  6401h (inputs), 6411h (outputs), sub-index 1 ... 12: signed numbers of 16 bits, four in a PDO
#pragma once

#include <cstdint>
#include <vector>

namespace nc::hal::canopen {

inline constexpr unsigned kMaxModules = 16;
inline constexpr unsigned kMostDigital = 64, kMostAnalog = 12, kAnalogPerPdo = 4;  // of one module and direction
inline constexpr unsigned kModulePdos = 4;

struct IoPoint {
  unsigned point = 0;    // index in the image
  unsigned channel = 0;  // from 0
  bool output = false, analog = false;
  bool active_low = false;     // digital: the point is 1 while the signal is off
  bool hold_on_loss = false;   // input: keeps its value when the module is lost, in place of loss_value
  std::uint32_t loss_value = 0;
  std::uint32_t stop_value = 0;  // output: at the end of the control; a digital one also by the module itself, when it does not hear the control any more
};

struct ModuleMap {
  std::vector<IoPoint> points;
  unsigned every = 1;    // SYNCs from one PDO to the next, as its transmission type (1 to 240) says
  unsigned ok_point = 0;

  // Number of channels up to the last one that has a point.
  unsigned channels(bool output, bool analog) const {
    unsigned most = 0;
    for (const IoPoint& point : points)
      if (point.output == output && point.analog == analog && point.channel >= most) most = point.channel + 1;
    return most;
  }
};

// One PDO of a module; `number` counts from 1. Only what has points is in a PDO.
struct ModulePdo {
  unsigned number = 1;
  std::vector<std::uint32_t> mapping;  // index << 16 | sub-index << 8 | bits
  unsigned bytes = 0;
};
inline std::vector<ModulePdo> module_pdos(const ModuleMap& module, bool output) {
  std::vector<ModulePdo> pdos;
  const unsigned bytes = (module.channels(output, false) + 7) / 8, words = module.channels(output, true);
  if (bytes > 0) {
    pdos.push_back({1, {}, bytes});
    for (unsigned n = 0; n < bytes; ++n) pdos.back().mapping.push_back((output ? 0x6200u : 0x6000u) << 16 | (n + 1) << 8 | 8);
  }
  for (unsigned first = 0; first < words; first += kAnalogPerPdo) {
    pdos.push_back({2 + first / kAnalogPerPdo, {}, 0});
    for (unsigned n = first; n < words && n < first + kAnalogPerPdo; ++n) {
      pdos.back().mapping.push_back((output ? 0x6411u : 0x6401u) << 16 | (n + 1) << 8 | 16);
      pdos.back().bytes += 2;
    }
  }
  return pdos;
}

}  // namespace nc::hal::canopen
