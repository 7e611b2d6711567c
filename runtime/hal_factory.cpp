// SPDX-License-Identifier: Apache-2.0
// The hardware layer that a configuration asks for. See hal_factory.hpp.
#include "runtime/hal_factory.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "hal/sim/sim_machine.hpp"
#include "runtime/bus_can_io.hpp"
#include "runtime/bus_gpio.hpp"
#include "runtime/bus_modbus.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/machine_canopen.hpp"

namespace nc::rt {
namespace {

std::unique_ptr<hal::Hal> make_sim(const Config& config) {
  return std::make_unique<hal::SimMachine>(config.sim, config.points);
}

constexpr MachineKind kMachines[] = {
    {.name = "sim", .needs = "", .read = read_sim, .make = make_sim, .resources = nullptr, .no_virtual_time = ""},
    {.name = "canopen",
     .needs = "",
     .read = read_canopen,
     .make = make_canopen,
     .resources = canopen_resources,
     .no_virtual_time = "the drives of a bus run in real time",
     .load = canopen_load},
};

constexpr PointBusKind kPointBuses[] = {
    {.name = "modbus",
     .needs = "libmodbus",
     .read = read_modbus,
     .read_point = read_point_modbus,
     .check = check_modbus,
     .resources = modbus_resources,
     .make = make_modbus,
     .on_virtual_time = "the links run in real time, whatever the speed of the program"},
    {.name = "gpio",
     .needs = "libgpiod 1.6 or 2",
     .read = read_gpio,
     .read_point = read_point_gpio,
     .check = check_gpio,
     .resources = gpio_resources,
     .make = make_gpio,
     .on_virtual_time = "the lines are polled in real time, whatever the speed of the program"},
    {.name = "can_io",
     .needs = "",
     .read = read_can_io,
     .read_point = read_point_can_io,
     .check = check_can_io,
     .resources = nullptr,
     .make = make_can_io,
     .on_virtual_time = ""},
};

// The names of the kinds that are built in, as "sim", "canopen" in quotes.
template <class Kind>
std::string built_in(std::span<const Kind> kinds) {
  std::string list;
  for (const Kind& kind : kinds)
    if (kind.make != nullptr) list += (list.empty() ? "\"" : ", \"") + std::string(kind.name) + "\"";
  return list.empty() ? "none" : list;
}

template <class Kind>
std::string not_built_in(const Kind& kind, std::span<const Kind> kinds) {
  return "\"" + std::string(kind.name) + "\" is not built in, it needs " + std::string(kind.needs) + "; built in: " + built_in(kinds);
}

}  // namespace

std::span<const MachineKind> machine_kinds() { return kMachines; }
std::span<const PointBusKind> point_bus_kinds() { return kPointBuses; }

void read_machine_kind(TableReader* machine, std::span<const MachineKind> kinds, Config* config) {
  config->machine_kind = &kinds.front();
  std::string name;
  if (!machine->string("hal", &name)) return;
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const MachineKind& each) { return each.name == name; });
  if (kind == kinds.end()) return machine->error("hal", "must be " + built_in(kinds) + ", not \"" + name + "\"; no other machine is built in");
  if (kind->make == nullptr) return machine->error("hal", not_built_in(*kind, kinds));
  config->machine_kind = &*kind;
}

void read_point_buses(TableReader* root, std::span<const PointBusKind> kinds, Config* config) {
  for (const PointBusKind& kind : kinds) {
    if (kind.make == nullptr) {
      if (root->find(kind.name) != nullptr) root->error(kind.name, not_built_in(kind, kinds));
      continue;
    }
    const std::size_t before = config->buses.size();
    kind.read(root, config);
    for (std::size_t n = before; n < config->buses.size(); ++n) config->buses[n].kind = &kind;
  }
}

PlaceOnBus read_place_on_bus(TableReader* point, std::span<const PointBusKind> kinds, const hal::Point& point_so_far, Config* config) {
  PlaceOnBus place;
  const PointBusKind* first = nullptr;
  for (const PointBusKind& kind : kinds) {
    if (point->find(kind.name) == nullptr) continue;
    if (kind.make == nullptr) {
      point->error(kind.name, not_built_in(kind, kinds));
    } else if (first != nullptr) {
      point->error(kind.name, "is a second bus: " + std::string(first->name) + " carries this point already");
    } else {
      first = &kind;
      place = kind.read_point(point, point_so_far, config);
    }
  }
  return place;
}

void check_point_buses(TableReader* root, const Config& config) {
  for (const PointBusKind& kind : point_bus_kinds())
    if (kind.make != nullptr && kind.check != nullptr) kind.check(root, config);
}

void read_machine_sections(TableReader* root, Config* config) {
  for (const MachineKind& kind : machine_kinds())
    if (kind.make != nullptr && kind.read != nullptr) kind.read(root, config);
}

std::unique_ptr<hal::Hal> make_axes(const Config& config) {
  return config.machine_kind->make(config);
}

MadeMachine make_machine(const Config& config, const BusReport& report) {
  MadeMachine machine;
  machine.axes = make_axes(config);
  std::vector<hal::PointBus*> buses;
  for (const PointBusConfig& bus : config.buses) {
    BusReport with_kind;
    if (report) with_kind = [report, prefix = std::string(bus.kind->name) + ": "](const std::string& line) { report(prefix + line); };
    machine.buses.push_back(bus.kind->make(config, bus, machine.axes.get(), with_kind));
    buses.push_back(machine.buses.back().get());
  }
  machine.hal = std::make_unique<hal::Composite>(machine.axes.get(), buses, config.points);
  return machine;
}

void wait_for_held_outputs(const MadeMachine& machine, const std::function<bool()>& give_up) {
  constexpr std::chrono::seconds kPatience{5};
  constexpr std::chrono::milliseconds kLook{5}, kTaken{20};  // kTaken: time for some scans and a step of the feeder, which take over what was found
  const auto end = std::chrono::steady_clock::now() + kPatience;
  const auto waits = [](const std::unique_ptr<hal::PointBus>& bus) { return !bus->held_outputs_known(); };
  while (!give_up() && std::any_of(machine.buses.begin(), machine.buses.end(), waits) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(kLook);
  if (!machine.buses.empty()) std::this_thread::sleep_for(kTaken);
}

}  // namespace nc::rt
