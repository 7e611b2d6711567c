// SPDX-License-Identifier: Apache-2.0
// Makes a machine of CANopen drives from the configuration, and names what no other control may use at the same time. See machine_canopen.hpp.
#include "runtime/machine_canopen.hpp"

#include <cstdio>

#include "hal/canopen/bus_load.hpp"
#include "hal/canopen/can_machine.hpp"
#include "runtime/machine_lock.hpp"
#include "runtime/toml_reader.hpp"

namespace nc::rt {

std::unique_ptr<hal::Hal> make_canopen(const Config& config) {
  return std::make_unique<hal::canopen::CanMachine>(config.canopen, hal::canopen::make_port(config.canopen.interface, config.canopen.bit_s),
                                                    [](const std::string& line) { std::fprintf(stderr, "canopen: %s\n", line.c_str()); });
}

std::string canopen_load(const Config& config) {
  using hal::canopen::kMostLoad, hal::canopen::kMostTogether;
  const hal::canopen::BusLoad load = hal::canopen::bus_load(config.canopen);
  std::string text = config.canopen.interface + ": " + load.arithmetic + "; at most " + number_text(100 * kMostLoad) + " %";
  if (!config.can_io.empty()) text += ", " + number_text(100 * kMostTogether) + " % where all modules come together";
  return text;
}

void canopen_resources(const Config& config, std::vector<MachineResource>* resources) {
  resources->push_back({hal::canopen::device_of(config.canopen.interface), "CAN interface " + config.canopen.interface});
}

}  // namespace nc::rt
