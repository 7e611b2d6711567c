// SPDX-License-Identifier: Apache-2.0
// The hardware layer that a configuration asks for. Two tables say what there is: one row for each kind of machine with axes, one for each kind
// of bus that carries points. A new kind is a folder in hal/, a file beside this one that reads its section, and a row; no program and nothing
// else of the runtime asks which kind it has before it. The tables stand here and not in hal/, because a row knows the configuration, which
// stands above hal/ in the order of includes.
//
// A kind that needs a library keeps its row where the library is missing, without its functions: whoever configures it is told what to build with.
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

// Takes one line for the operator's log, which begins with the kind of the bus. Called in the threads of the buses, several at a time.
using BusReport = std::function<void(const std::string& line)>;

// What the table of a [[point]] that names its bus has said. The point may still be refused, for its name above all: `add` makes it part of the bus
// behind PointTable::add(), so that a bus never names a point that does not exist.
struct PlaceOnBus {
  std::uint8_t bus = 0;                       // 0 = the machine's own: there is no such table, or an error in it
  std::function<void(Config* config)> add{};  // of the point that was added last; with bus != 0
};

// A machine with axes: [machine] hal = "<name>".
struct MachineKind {
  std::string_view name;
  std::string_view needs;  // library that it is built with, empty = none
  // Its own section, which may stand in the file whatever machine is chosen. Null = it has none.
  void (*read)(TableReader* root, Config* config);
  // Null = not built in. The machine keeps no reference to the configuration.
  std::unique_ptr<hal::Hal> (*make)(const Config& config);
  // What the machine has for itself alone (runtime/machine_lock.hpp). May be null: nothing.
  void (*resources)(const Config& config, std::vector<MachineResource>* resources);
  // Why it cannot run on virtual time; empty = it can.
  std::string_view no_virtual_time;
};

// A bus that carries points: each [[<name>]] is one, and the table `<name>` of a [[point]] puts the point on it.
struct PointBusKind {
  std::string_view name;
  std::string_view needs;
  // [[<name>]], before the points: appends to Config::buses.
  void (*read)(TableReader* root, Config* config);
  PlaceOnBus (*read_point)(TableReader* point, const hal::Point& point_so_far, Config* config);
  // Looks, after all points have been read, for mistakes that one point alone does not show. May be null.
  void (*check)(TableReader* root, const Config& config);
  // What the bus has for itself alone (runtime/machine_lock.hpp). May be null: nothing.
  void (*resources)(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources);
  // Null = not built in. A bus keeps no reference to the configuration.
  std::unique_ptr<hal::PointBus> (*make)(const Config& config, const PointBusConfig& bus, const BusReport& report);
  // Said once when a program runs on virtual time, which a bus does not have. Empty = nothing.
  std::string_view on_virtual_time;
};

// The first machine is that of a configuration which names none.
std::span<const MachineKind> machine_kinds();
std::span<const PointBusKind> point_bus_kinds();

// ---- reading, in the order of parse_config() ----

// [machine] hal. A kind that is not there, or not built in, is an error that lists those that are.
void read_machine_kind(TableReader* machine, std::span<const MachineKind> kinds, Config* config);
void read_point_buses(TableReader* root, std::span<const PointBusKind> kinds, Config* config);
PlaceOnBus read_place_on_bus(TableReader* point, std::span<const PointBusKind> kinds, const hal::Point& point_so_far, Config* config);
void check_point_buses(TableReader* root, const Config& config);
void read_machine_sections(TableReader* root, Config* config);

// ---- making ----

// The parts and what joins them. It is the owner of all three and lives longer than the Runtime that gets `hal`; its members let go of each other
// in the order from the last to the first. Made and destroyed in an ordinary thread; in between Runtime calls start() and stop() in the thread of its
// own start() and stop(), and read() and write() in the scan's. A bus has threads of its own between start() and stop().
struct MadeMachine {
  std::unique_ptr<hal::Hal> axes;
  std::vector<std::unique_ptr<hal::PointBus>> buses;  // the n-th is bus n of the points, counted from 1
  std::unique_ptr<hal::Composite> hal;
};

// Of a configuration that parse_config() has accepted. Nothing is opened yet: that is start().
MadeMachine make_machine(const Config& config, const BusReport& report);
// The machine without its buses, for those who only want to see whether the control takes the configuration.
std::unique_ptr<hal::Hal> make_axes(const Config& config);

// Waits for the outputs that hold their value from one control to the next (docs/modbus.md, on_stop = "hold") to be read back: a program that begins
// at once would read them before. A partner that does not answer within five seconds is no reason to wait for ever, the bus says what it lacks; nor
// is one when `give_up` says so, which is asked every 5 ms.
void wait_for_held_outputs(const MadeMachine& machine, const std::function<bool()>& give_up);

}  // namespace nc::rt
