// SPDX-License-Identifier: Apache-2.0
// The row of CiA 401 I/O modules in the table of point buses (runtime/hal_factory.hpp, which says what each function is for). Each module is a bus of points of its
// own, on the line of the machine's drives.
#pragma once

#include "runtime/hal_factory.hpp"

namespace nc::rt {

// ---- the configuration: runtime/config_can_io.cpp ----
void read_can_io(TableReader* root, Config* config);  // adds the points "<module>.ok", too
PlaceOnBus read_point_can_io(TableReader* point_reader, const hal::Point& point, Config* config);
void check_can_io(TableReader* root, const Config& config);

// ---- the module: runtime/bus_can_io.cpp ----
std::unique_ptr<hal::PointBus> make_can_io(const Config& config, const PointBusConfig& bus, hal::Hal* machine, const BusReport& report);

}  // namespace nc::rt
