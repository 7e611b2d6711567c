// SPDX-License-Identifier: Apache-2.0
// The hardware layer that a configuration asks for. Two tables say what there is: one row for each kind of machine with axes, one for each kind
// of bus that carries points. A new kind consists of a folder in hal/, a file beside this one that reads its section, and a row. No other code of the
// runtime and no program distinguishes the kinds. The tables are here and not in hal/, because a row uses the configuration, which
// includes hal/ and not the other way round.
//
// When a kind needs a library that is missing at build time, its row stays, but with make = null. A user who configures that kind is then told which
// library the build needs.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/composite.hpp"
#include "runtime/config.hpp"

namespace nc::rt {

class TableReader;
struct MachineResource;

// Takes one line for the operator's log; the line begins with the kind of the bus. Called from the threads of the buses, possibly several at a time.
using BusReport = std::function<void(const std::string& line)>;

// The result of reading the table of a [[point]] that names its bus. The point may still be refused, for example for its name. Therefore `add`, which makes
// the point part of the bus, is called only after PointTable::add(): a bus never refers to a point that does not exist.
struct PlaceOnBus {
  std::uint8_t bus = 0;                       // 0 = the machine itself: there is no such table, or it has an error
  std::function<void(Config* config)> add{};  // adds the last point of the point table to the bus; set when bus != 0
};

// A machine with axes: [machine] hal = "<name>".
struct MachineKind {
  std::string_view name;
  std::string_view needs;  // library that it is built with, empty = none
  // Reads the section of this kind, which may stand in the file even when another kind is chosen. Null = it has no section.
  void (*read)(TableReader* root, Config* config);
  // Null = not built in. The machine keeps no reference to the configuration.
  std::unique_ptr<hal::Hal> (*make)(const Config& config);
  // Lists what only one control may use at a time (runtime/machine_lock.hpp). Null = nothing.
  void (*resources)(const Config& config, std::vector<MachineResource>* resources);
  // Why it cannot run on virtual time; empty = it can.
  std::string_view no_virtual_time;
  // How full the bus of its axes is, with the arithmetic, for whoever checks the configuration. Null = it has no bus.
  std::string (*load)(const Config& config) = nullptr;
};

// A bus that carries points: each [[<name>]] is one, and the table `<name>` of a [[point]] puts the point on it.
struct PointBusKind {
  std::string_view name;
  std::string_view needs;
  // Reads the sections [[<name>]], before the points are read, and appends to Config::buses.
  void (*read)(TableReader* root, Config* config);
  PlaceOnBus (*read_point)(TableReader* point, const hal::Point& point_so_far, Config* config);
  // Called after all points have been read; looks for mistakes that a single point does not show. May be null.
  void (*check)(TableReader* root, const Config& config);
  // Lists what only one control may use at a time (runtime/machine_lock.hpp). Null = nothing.
  void (*resources)(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources);
  // Null = not built in. A bus keeps no reference to the configuration. `machine` is the machine with the axes, for a bus that shares its line; it lives longer.
  std::unique_ptr<hal::PointBus> (*make)(const Config& config, const PointBusConfig& bus, hal::Hal* machine, const BusReport& report);
  // Shown once when a program runs on virtual time, because a bus always works in real time. Empty = nothing is shown.
  std::string_view on_virtual_time;
};

// A configuration that names no kind of machine gets the first one.
std::span<const MachineKind> machine_kinds();
std::span<const PointBusKind> point_bus_kinds();

// ---- reading, in the order of parse_config() ----

// Reads the key `hal` of [machine]. A kind that does not exist or is not built in is an error, whose text lists the kinds that are built in.
void read_machine_kind(TableReader* machine, std::span<const MachineKind> kinds, Config* config);
void read_point_buses(TableReader* root, std::span<const PointBusKind> kinds, Config* config);
PlaceOnBus read_place_on_bus(TableReader* point, std::span<const PointBusKind> kinds, const hal::Point& point_so_far, Config* config);
void check_point_buses(TableReader* root, const Config& config);
void read_machine_sections(TableReader* root, Config* config);

// ---- making ----

// The parts of a machine, and `hal`, which joins them. The struct owns all of them and must live longer than the Runtime that gets `hal`. Its members
// are destroyed from the last to the first, so `hal` goes before the parts that it refers to. It is made and destroyed in an ordinary thread. In between
// Runtime calls start() and stop() of `hal` in the thread that calls its own start() and stop(), and read() and write() in the scan thread. A bus has
// threads of its own between start() and stop().
struct MadeMachine {
  std::unique_ptr<hal::Hal> axes;
  std::vector<std::unique_ptr<hal::PointBus>> buses;  // points name a bus by its place in here, counted from 1
  std::unique_ptr<hal::Composite> hal;
};

// Makes the machine of a configuration that parse_config() has accepted. Nothing is opened yet; start() does that.
MadeMachine make_machine(const Config& config, const BusReport& report);
// Makes the machine without its buses, for a check whether the control accepts the configuration.
std::unique_ptr<hal::Hal> make_axes(const Config& config);

// Waits until the outputs that keep their value from one control to the next (docs/modbus.md, on_stop = "hold") have been read back: a program that
// starts at once would otherwise read them too early. The wait ends after five seconds even when a device does not answer, because the bus itself
// reports that; and it ends when `give_up`, which is called every 5 ms, returns true.
void wait_for_held_outputs(const MadeMachine& machine, const std::function<bool()>& give_up);

}  // namespace nc::rt
