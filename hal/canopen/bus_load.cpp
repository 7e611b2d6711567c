// SPDX-License-Identifier: Apache-2.0
// Load of a bus of drives. See bus_load.hpp.
#include "hal/canopen/bus_load.hpp"

#include <cmath>
#include <cstdio>
#include <map>

namespace nc::hal::canopen {
namespace {

constexpr unsigned kBase = 6;        // bytes of the control or status word and the position
constexpr unsigned kProbe = 2;       // bytes of 60B8h, which an axis with a touch probe has in addition
constexpr double kFull = 0.95;       // largest load of the bus with the frames of the slow part

double module_bits(const ModuleMap& module) {
  double bits = 0;
  for (const bool output : {false, true})
    for (const ModulePdo& pdo : module_pdos(module, output)) bits += worst_bits(pdo.bytes);
  return bits;
}

double bits_of_period(const BusMap& bus) { return static_cast<double>(bus.bit_s) * bus.sync_us * 1e-6; }

}  // namespace

unsigned rpdo_bytes(const AxisMap& axis) { return kBase + (axis.has_probe() ? kProbe : 0); }

std::vector<unsigned> tpdo_bytes(const AxisMap& axis) {
  std::vector<unsigned> bytes{kBase};
  if (axis.has_probe()) bytes.push_back(kBase);
  return bytes;
}

BusLoad bus_load(const BusMap& bus) {
  std::map<unsigned, unsigned> count;  // number of PDOs for each number of bytes
  double average = 0, all = 0;         // bits of the PDOs of modules
  unsigned modules = 0;
  for (const NodeMap& node : bus.nodes) {
    if (node.module) {
      ++modules;
      const double bits = module_bits(*node.module);
      average += bits / node.module->every;
      all += bits;
    }
    for (const AxisMap& axis : node.axes) {
      ++count[rpdo_bytes(axis)];
      for (const unsigned bytes : tpdo_bytes(axis)) ++count[bytes];
    }
  }
  unsigned bits = worst_bits(0);
  std::string text = "SYNC " + std::to_string(bits);
  for (const auto& [bytes, pdos] : count) {
    bits += pdos * worst_bits(bytes);
    text += " + " + std::to_string(pdos) + " PDOs of " + std::to_string(bytes) + " bytes, " + std::to_string(worst_bits(bytes)) + " each";
  }
  const double beats = (static_cast<double>(bus.nodes.size()) + 1) * worst_bits(1) * bus.sync_us / (bus.heartbeat_ms * 1000.0);
  const double available = bits_of_period(bus);
  BusLoad load;
  load.share = (bits + average + beats) / available;
  load.together = (bits + all + beats) / available;
  char tail[300];
  if (modules > 0) {
    std::snprintf(tail, sizeof tail, " + %u modules %.1f (%.0f where all come together, %.1f %%)", modules, average, all, 100 * load.together);
    text += tail;
  }
  std::snprintf(tail, sizeof tail, " + heartbeats %.1f = %.1f bits with worst-case stuffing, of %.0f bits in %u us at %u bit/s: %.1f %%", beats,
                bits + average + beats, available, bus.sync_us, bus.bit_s, 100 * load.share);
  load.arithmetic = text + tail;
  return load;
}

unsigned slow_every(const BusMap& bus) {
  const double exchange = 2 * worst_bits(8) / bits_of_period(bus), left = kFull - bus_load(bus).share;
  return left >= exchange ? 1 : left <= 0 ? 100 : static_cast<unsigned>(std::ceil(exchange / left));
}

}  // namespace nc::hal::canopen
