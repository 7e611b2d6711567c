// SPDX-License-Identifier: Apache-2.0
// The machine configuration: a TOML file as plain data, and everything that can be wrong with it.
//
// Units: mm, degrees, seconds in the file's names where they are not mm or mm/s; see etc/machine.toml, which
// explains every key. Parsing has no side effects. Every error names file, line and key; all are reported,
// not only the first (a syntax error ends the file: nothing behind it can be trusted).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/canopen/bus_map.hpp"
#include "hal/gpio/bank_config.hpp"
#include "hal/modbus/map.hpp"
#include "hal/points.hpp"
#include "hal/sim/sim_machine.hpp"
#include "nc/control.h"
#include "runtime/axes/equipment.hpp"
#include "runtime/programs/program_text.hpp"

namespace nc::rt {

struct ConfigError {
  std::string file;
  unsigned line = 0;  // 1-based; 0 = the file as a whole
  std::string key;    // path: axis[1].soft_limits
  std::string message;

  std::string text() const;  // "machine.toml:12: axis[1].rapid: must be ..."
};

// What happens when a scan ends behind its slot.
enum class OverrunReaction : std::uint8_t { kCount, kFeedHold, kAlarm };

// Where a value stands, for errors that are found later (the control refuses a parameter).
struct ConfigPlace {
  unsigned line = 0;
  std::string key;
};

struct ParameterSetting {
  std::string key;      // manual's number or name
  char axis = 0;        // 0 = all axes
  unsigned system = 0;  // part system of the axis; without an axis the setting holds for all
  std::string text;
  ConfigPlace place;
};

struct WorkOffsetSetting {
  unsigned index = 0;  // as nc_work_offset_set()
  unsigned system = 0;
  unsigned axis = 0;
  double value = 0;
  ConfigPlace place;
};

struct ToolOffsetSetting {
  unsigned number = 0;
  std::array<double, 4> column = {};  // by nc_tool_column
  std::array<bool, 4> given = {};
  ConfigPlace place;
};

// Macro interface: which point a bit or a word stands for; -1 = none.
struct MacroMap {
  std::array<std::array<int, 32>, NC_WORDS> input_bit, output_bit;
  std::array<int, NC_WORDS> input_word, output_word;
  MacroMap();
};

// A point that an axis has something on, by its name: it is looked up when the points have been read (config_equipment.hpp).
struct EquipmentName {
  enum class Part : std::uint8_t { kDog, kIndex, kRequest, kDone, kMinus, kPlus, kBrake };
  std::string name;
  ConfigPlace place;
  Part part = Part::kDog;
  hal::PointDirection direction = hal::PointDirection::kInput;
  std::uint8_t system = 0, axis = 0;
};

// What measures the speed of a spindle.
struct SpindleFeedback {
  enum class By : std::uint8_t { kSimulation, kPoint, kNothing };
  enum class Sign : std::uint8_t { kAsPoint, kYes, kNo };  // kAsPoint: as the register of the point has one
  By by = By::kSimulation;
  Sign sign = Sign::kAsPoint;
  bool given = false;       // by the file; else see read_spindle_feedback()
  int point = -1;           // word input: speed
  double rpm_per_count = 1;
  ConfigPlace place;        // of the point's name
};

struct SchedulingConfig {
  ConfigPlace cpu_place;
  bool fifo = true;         // SCHED_FIFO, else SCHED_OTHER
  int priority = 80;        // of the scan thread
  int cpu = -1;             // core of the scan thread; -1 = any
  bool lock_memory = true;  // mlockall
  unsigned feeder_us = 1000;
  OverrunReaction overrun = OverrunReaction::kAlarm;
  unsigned overrun_limit = 10;  // the reaction comes when so many slots were missed since the last reset
};

// The machine's ladder program.
struct LadderConfig {
  std::string program;      // file, relative to the configuration's folder unless absolute; empty = none
  ConfigPlace program_place;
  double fin_timeout_s = 0; // FIN that does not come within this time is an alarm; 0 = wait for ever
  std::array<std::string, 8> alarm;  // texts of plc.alarm.1 ... .8
  std::string retain;                // file of the retained devices, relative as `program`; empty = see retain_path()
  ConfigPlace retain_place;
  bool retain_counters = false;      // C among them
  unsigned retain_d_first = 0, retain_d_count = 0;  // D among them
};

struct MachineKind;   // runtime/hal_factory.hpp
struct PointBusKind;

// A bus that carries points, of whatever kind; the n-th is bus n of the points, counted from 1.
struct PointBusConfig {
  const PointBusKind* kind = nullptr;
  std::size_t place = 0;  // among the buses of its kind: Config::modbus, Config::gpio
  std::string name;
  unsigned ok_point = 0;  // the input point "<name>.ok"
  bool alarm = false;     // a bus that is lost is alarm R18
};
inline constexpr std::size_t kMaxPointBuses = 32;  // threads and sockets of their own; the scan keeps a bit for each

// A Modbus link.
struct ModbusLinkConfig {
  hal::modbus::LinkConfig link;
  std::uint8_t bus = 0;   // of its points
  std::uint8_t unit = 1;  // of points that name none
  bool named = false;     // by a point, be it a wrong one
  ConfigPlace place;
};

// A bank of GPIO lines: a chip.
struct GpioBankConfig {
  hal::gpio::BankConfig bank;
  std::uint8_t bus = 0;  // of its points
  bool named = false;    // by a point, be it a wrong one, or it has a watchdog
  ConfigPlace place;
};

// The shared-memory segment for readers in other processes (runtime/share/).
struct ShareConfig {
  bool enabled = false;
  std::string name;            // empty = from the machine's name
  bool commands = false;       // take commands from it
  bool group = false;          // readers of the same group too, not of the user alone
};

// A signal that is a point of the machine, without a ladder program between them.
struct SignalWire {
  unsigned signal = 0;  // place in machine_signals()
  unsigned point = 0;
};

// Common variables from the first to the last.
struct VariableRangeSetting {
  std::uint32_t first = 0, last = 0;
};

struct Config {
  std::string file;  // name of the file, for messages
  std::string name = "machine";
  std::string programs = ".";  // folder of programs, relative to the file's folder unless absolute
  ConfigPlace programs_place;
  ProgramText::Options program_text;  // encoding of programs, and up to which size they are copied
  std::string external;        // folder of the programs of M198, in the same way; empty = the folder of programs
  std::string variables;       // file of the common variables, relative as `print`; empty = see variables_path()
  ConfigPlace variables_place;
  std::string offsets;         // file of the offsets and parameters that were changed since the configuration; as `variables`
  ConfigPlace offsets_place;
  double retain_every_s = 1;   // retained data are looked at so often
  std::string print;           // file that programs print to, relative to the file's folder unless absolute; empty = nowhere
  bool macro_extensions = false, negative_count = false;  // options of macros (docs/macros.md)
  ConfigPlace macro_extensions_place, negative_count_place;
  std::vector<VariableRangeSetting> not_kept;  // ranges of common variables that begin vacant with the power
  unsigned cycle_us = 1000;
  nc_config nc;  // everything that libnc is created with
  bool look_ahead_given = false;
  bool motion_given = false;  // the file names the law of motion
  unsigned spindles_given = 0;  // part systems whose spindles are counted
  ConfigPlace spindles_place;
  SchedulingConfig scheduling;
  std::array<nc_axes, NC_MAX_SYSTEMS> start = {};  // where the axes stand at start-up
  std::vector<ParameterSetting> parameters;
  std::vector<WorkOffsetSetting> work_offsets;
  std::vector<ToolOffsetSetting> tool_offsets;
  hal::PointTable points;
  MacroMap macro;
  const MachineKind* machine_kind = nullptr;  // of the axes; never null in a configuration that was read
  std::vector<PointBusConfig> buses;
  std::vector<ModbusLinkConfig> modbus;
  std::vector<GpioBankConfig> gpio;
  LadderConfig ladder;
  std::vector<SignalWire> wires;
  std::array<std::array<SpindleFeedback, NC_MAX_SPINDLES>, NC_MAX_SYSTEMS> spindle_feedback;
  std::array<std::array<AxisEquipment, NC_MAX_AXES>, NC_MAX_SYSTEMS> equipment;
  std::array<std::array<ConfigPlace, NC_MAX_AXES>, NC_MAX_SYSTEMS> homing_place;
  std::vector<EquipmentName> equipment_names;
  hal::SimConfig sim;
  hal::canopen::BusMap canopen;
  ShareConfig share;

  Config();
  // Folder of programs as a path that can be opened.
  std::string programs_folder() const;
  std::string external_folder() const;
  // File that programs print to; empty = none.
  std::string print_file() const;
  // The ladder program in the same way.
  std::string ladder_file() const;
  // File of the retained devices: as configured, else in the folder that a service manager gives
  // (STATE_DIRECTORY); empty = they are not kept.
  std::string retain_path() const;
  // File of the common variables in the same way.
  std::string variables_path() const;
  // File of the changed offsets and parameters in the same way.
  std::string offsets_path() const;
  // An output that follows a signal of the NC.
  bool is_wired_output(unsigned point) const;
};

// Parse a text. `file` is used in messages only. Returns the errors; empty = *config is valid. `partial` (may be
// null) gets what could be read in any case, for those who want to look further.
std::vector<ConfigError> parse_config(std::string_view text, const std::string& file, Config* config,
                                      Config* partial = nullptr);

// Read and parse a file.
// What of the spindles is allowed and hardly meant, with its line.
std::vector<std::string> spindle_warnings(const Config& config);

std::vector<ConfigError> load_config(const std::string& path, Config* config, Config* partial = nullptr);

// What the file asks of the computer that it is used on: processors, folders.
std::vector<ConfigError> check_host(const Config& config);

// Parameters, offsets and start position into a control. What the control refuses is an error with its place
// in the file.
std::vector<ConfigError> apply_config(const Config& config, nc_control* control);

}  // namespace nc::rt
