// SPDX-License-Identifier: Apache-2.0
// The row of Modbus in the table of point buses (runtime/hal_factory.hpp, which says what each function is for).
#pragma once

#include "runtime/hal_factory.hpp"

namespace nc::rt {

// ---- the configuration: runtime/config_modbus.cpp ----
void read_modbus(TableReader* root, Config* config);  // adds the points "<link>.ok", too
PlaceOnBus read_point_modbus(TableReader* point_reader, const hal::Point& point, Config* config);
void check_modbus(TableReader* root, const Config& config);

// ---- the link: runtime/bus_modbus.cpp ----
std::unique_ptr<hal::PointBus> make_modbus(const Config& config, const PointBusConfig& bus, hal::Hal* machine, const BusReport& report);
// Each unit of a host that outputs are written to, or the serial line. Looks the host up: this may take the time of the resolver.
void modbus_resources(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources);

}  // namespace nc::rt
