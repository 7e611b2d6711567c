// SPDX-License-Identifier: Apache-2.0
// Makes the bus of points of a CiA 401 module from the machine of drives on whose line it is. See bus_can_io.hpp.
#include "runtime/bus_can_io.hpp"

#include "hal/canopen/can_machine.hpp"
#include "hal/canopen/module_bus.hpp"

namespace nc::rt {

// A configuration with modules has a machine of drives (read_can_io()), whose modules are in the order of the file.
std::unique_ptr<hal::PointBus> make_can_io(const Config&, const PointBusConfig& bus, hal::Hal* machine, const BusReport&) {
  return std::make_unique<hal::canopen::ModuleBus>(dynamic_cast<hal::canopen::CanMachine&>(*machine).module(static_cast<unsigned>(bus.place)));
}

}  // namespace nc::rt
