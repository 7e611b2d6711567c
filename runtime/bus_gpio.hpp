// SPDX-License-Identifier: Apache-2.0
// The row of GPIO in the table of point buses (runtime/hal_factory.hpp, which says what each function is for).
#pragma once

#include "runtime/hal_factory.hpp"

namespace nc::rt {

// ---- the configuration: runtime/config_gpio.cpp ----
void read_gpio(TableReader* root, Config* config);  // adds the points "<bank>.ok", too
PlaceOnBus read_point_gpio(TableReader* point_reader, const hal::Point& point, Config* config);
void check_gpio(TableReader* root, const Config& config);

// ---- the bank: runtime/bus_gpio.cpp ----
#ifdef NC_HAVE_LIBGPIOD
std::unique_ptr<hal::PointBus> make_gpio(const Config& config, const PointBusConfig& bus, hal::Hal* machine, const BusReport& report);
#else
inline constexpr std::unique_ptr<hal::PointBus> (*make_gpio)(const Config& config, const PointBusConfig& bus, hal::Hal* machine, const BusReport& report) = nullptr;
#endif
// A lock for each line, for inputs as well: the kernel gives a line to one owner only.
void gpio_resources(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources);

}  // namespace nc::rt
