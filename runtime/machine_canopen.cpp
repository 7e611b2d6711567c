// SPDX-License-Identifier: Apache-2.0
// Makes a machine of CANopen drives from the configuration, and names what no other control may use at the same time. See machine_canopen.hpp.
#include "runtime/machine_canopen.hpp"

#include <cstdio>

#include "hal/canopen/can_machine.hpp"
#include "runtime/machine_lock.hpp"

namespace nc::rt {

std::unique_ptr<hal::Hal> make_canopen(const Config& config) {
  return std::make_unique<hal::canopen::CanMachine>(config.canopen, hal::canopen::make_port(config.canopen.interface, config.canopen.bit_s),
                                                    [](const std::string& line) { std::fprintf(stderr, "canopen: %s\n", line.c_str()); });
}

void canopen_resources(const Config& config, std::vector<MachineResource>* resources) {
  resources->push_back({hal::canopen::device_of(config.canopen.interface), "CAN interface " + config.canopen.interface});
}

}  // namespace nc::rt
