// SPDX-License-Identifier: Apache-2.0
// The machine configuration: a TOML file as plain data, and everything that can be wrong with it.
//
// Units are mm, degrees, seconds and those made of them; a key with another unit has it in its name. etc/machine.toml explains every key.
// Parsing has no side effects. Every error names file, line and key, and all errors are reported, not only the first. Only a syntax
// error ends the reading, because nothing behind it can be trusted.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
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
#include "runtime/axes/handwheel.hpp"
#include "runtime/axes/joystick.hpp"
#include "runtime/power/power_watch.hpp"
#include "runtime/programs/program_text.hpp"

namespace nc::rt {

struct ConfigError {
  std::string file;
  unsigned line = 0;  // 1-based; 0 = the file as a whole
  std::string key;    // path: axis[1].soft_limits
  std::string message;

  std::string text() const;  // "machine.toml:12: axis[1].rapid: must be ..."
};

// What happens when scans have ended too late (SchedulingConfig::overrun_limit).
enum class OverrunReaction : std::uint8_t { kCount, kFeedHold, kAlarm };

// Where a value stands in the file, for errors that are found after parsing, as when the control refuses a parameter.
struct ConfigPlace {
  unsigned line = 0;
  std::string key;
};

struct ParameterSetting {
  std::string key;      // number or name in the manual
  char axis = 0;        // letter of the axis; 0 = all axes
  unsigned system = 0;  // part system of the axis; without an axis the setting holds for all part systems
  std::string text;
  ConfigPlace place;
};

struct WorkOffsetSetting {
  unsigned index = 0;  // counted as by nc_work_offset_set()
  unsigned system = 0;
  unsigned axis = 0;
  double value = 0;
  ConfigPlace place;
};

struct ToolOffsetSetting {
  unsigned number = 0;
  std::array<double, 4> column = {};  // indexed by nc_tool_column
  std::array<bool, 4> given = {};
  std::optional<std::string> name;  // as in ToolLabel
  std::optional<unsigned> pocket;
  ConfigPlace place;
};

// The macro interface: the point that each bit and each word is connected with; -1 = none.
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

// What a point is used for (runtime/point_uses.hpp has a row for each).
enum class PointRole : std::uint8_t {
  kMacroOutput, kSignalOutput, kHomingRequest, kBrake,                                        // sets an output
  kDriveHoming, kSpindleTurn, kSpindleOrient, kSpindleGear, kSimulatedCommand,                // obeys an output
  kDriveHomed, kSpindleOriented, kSimulatedAnswer,                                            // gives an input
  kHomingDone, kDog, kIndex, kLimit, kWheelCounter, kWheelTimes10, kWheelTimes100, kStick, kMeasuredSpeed, kSupply, kFree  // goes by an input
};

struct PointUse {
  PointRole role = PointRole::kFree;
  int point = -1;
  ConfigPlace place;
  std::uint8_t system = 0;
  std::uint8_t number = 0;  // of the axis or spindle in its part system, of the handwheel; from 0
};

// What measures the speed of a spindle.
struct SpindleFeedback {
  enum class By : std::uint8_t { kSimulation, kPoint, kNothing };
  enum class Sign : std::uint8_t { kAsPoint, kYes, kNo };  // kAsPoint: signed when the register of the point is
  By by = By::kSimulation;
  Sign sign = Sign::kAsPoint;
  bool given = false;       // the file names the feedback; else read_spindle_feedback() chooses it
  ConfigPlace given_place;  // where it stands; else what makes the spindle one that is not simulated
  int point = -1;           // word input that gives the speed
  double rpm_per_count = 1;
  ConfigPlace place;        // where the name of the point stands
};

struct SchedulingConfig {
  ConfigPlace cpu_place;
  bool fifo = true;         // SCHED_FIFO, else SCHED_OTHER
  int priority = 80;        // of the scan thread
  int cpu = -1;             // core of the scan thread; -1 = any
  bool lock_memory = true;  // mlockall
  unsigned feeder_us = 1000;
  OverrunReaction overrun = OverrunReaction::kAlarm;
  unsigned overrun_limit = 10;  // slots missed since the last reset or the last reaction that bring the reaction
};

// The machine's ladder program.
struct LadderConfig {
  std::string program;      // file, relative to the configuration's folder unless absolute; empty = none
  ConfigPlace program_place;
  double fin_timeout_s = 0; // a FIN that does not come within this time is an alarm; 0 = wait without limit
  std::array<std::string, 8> alarm;  // texts of plc.alarm.1 ... .8
  std::string retain;                // file of the retained devices, relative like `program`; empty = see retain_path()
  ConfigPlace retain_place;
  bool retain_counters = false;      // the counters C are retained
  unsigned retain_d_first = 0, retain_d_count = 0;  // the registers D that are retained
};

struct MachineKind;   // runtime/hal_factory.hpp
struct PointBusKind;

// A bus that carries points, of any kind. The points name their bus by its place in Config::buses, counted from 1.
struct PointBusConfig {
  const PointBusKind* kind = nullptr;
  std::size_t place = 0;  // index among the buses of its kind: in Config::modbus, Config::gpio or Config::can_io
  std::string name;
  std::string device;     // what is at its other end, for the alarm of its loss: "chip pinctrl-bcm2711", "192.168.1.20 port 502", "node 10"
  unsigned ok_point = 0;  // the input point "<name>.ok"
  ConfigPlace named_at;   // where its name stands
  bool alarm = false;     // the loss of this bus is alarm R18
};
inline constexpr std::size_t kMaxPointBuses = 32;  // the scan keeps a bit for each in a word; each has a thread of its own

// A Modbus link.
struct ModbusLinkConfig {
  hal::modbus::LinkConfig link;
  std::uint8_t bus = 0;   // number of the bus in its points
  std::uint8_t unit = 1;  // unit of the points that name none
  bool named = false;     // some point names this link, even a point with an error
  ConfigPlace place;
};

// A bank of GPIO lines, which are lines of one chip.
struct GpioBankConfig {
  hal::gpio::BankConfig bank;
  std::uint8_t bus = 0;  // number of the bus in its points
  bool named = false;    // some point names this bank, even a point with an error, or the bank has a watchdog
  ConfigPlace place;
};

// An I/O module of CiA 401 on the bus of the machine's drives.
struct CanIoConfig {
  std::size_t node = 0;  // in hal::canopen::BusMap::nodes
  std::uint8_t bus = 0;  // number of the bus in its points
  bool named = false;    // some point names this module, even a point with an error
  std::string name, eds;
  ConfigPlace place;     // of its node number
  ConfigPlace eds_place;
  std::vector<ConfigPlace> objects;  // of each of its own objects
};

// The shared-memory segment for readers in other processes (runtime/share/).
struct ShareConfig {
  bool enabled = false;
  std::string name;            // empty = made from the machine's name
  bool commands = false;       // commands are taken from the segment
  ConfigPlace commands_place;
  bool group = false;          // readers of the same group are admitted, not only those of the same user
};

// The socket of the services for programs on this computer (runtime/services/).
// Whether programs are checked before they run: one that has not passed may not begin; it begins with a message; or they are checked when somebody asks for it.
enum class ProgramCheck : std::uint8_t { kRequired, kWarn, kOff };

struct ServicesConfig {
  bool enabled = true;
  std::string socket;          // path of the socket; empty = see services::socket_path()
  ConfigPlace socket_place;
  // Names of the groups that may view, operate, set up and maintain, in the order of services::Right.
  std::array<std::vector<std::string>, 4> holders = {{{"nc-view"}, {"nc-operate"}, {"nc-setup"}, {"nc-maintain"}}};
  std::string changes;         // file of the changes, relative like Config::print; empty = see Config::changes_path()
  std::string history;         // file of the history, likewise; empty = see Config::history_path()
  unsigned history_entries = 200'000, history_days = 730, history_mb = 256;  // its bounds
  unsigned program_mb = 4096;  // size that one program may have
  unsigned programs_mb = 16384;  // size that all programs in the folder may have together
  ProgramCheck check = ProgramCheck::kRequired;
  unsigned check_seconds = 60;   // processor time that the check of one program may take
};

// A signal that is connected directly to a point of the machine, without a ladder program between them.
struct SignalWire {
  unsigned signal = 0;  // index in machine_signals()
  unsigned point = 0;
};

// The common variables from `first` to `last`, both included.
struct VariableRangeSetting {
  std::uint32_t first = 0, last = 0;
};

struct Config {
  std::string file;  // name of the file, for messages
  std::string name = "machine";
  std::string programs = ".";  // folder of programs, relative to the file's folder unless absolute
  ConfigPlace programs_place;
  ProgramText::Options program_text;  // encoding of programs, and up to which size they are copied
  std::string external;        // folder of the programs that M198 calls, relative like `programs`; empty = the folder of programs
  std::string variables;       // file of the common variables, relative like `print`; empty = see variables_path()
  ConfigPlace variables_place;
  std::string offsets;         // file of the offsets and parameters that differ from the configuration, relative like `print`; empty = see offsets_path()
  ConfigPlace offsets_place;
  double retain_every_s = 1;   // interval at which retained data are looked at and written when they have changed
  std::string print;           // file that programs print to, relative to the file's folder unless absolute; empty = nowhere
  bool macro_extensions = false, negative_count = false;  // options of macros (docs/macros.md)
  ConfigPlace macro_extensions_place, negative_count_place;
  std::vector<VariableRangeSetting> not_kept;  // ranges of common variables that are vacant after each start
  unsigned cycle_us = 1000;
  nc_config nc;  // everything that libnc is created with
  bool look_ahead_given = false;
  bool motion_given = false;  // the file names the law of motion
  unsigned tool_axes_given = 0;  // number of part systems for which machine.tool_axis has a word
  ConfigPlace tool_axes_place;
  unsigned spindles_given = 0;  // number of part systems for which machine.spindles gives a count
  ConfigPlace spindles_place;
  SchedulingConfig scheduling;
  std::array<nc_axes, NC_MAX_SYSTEMS> start = {};  // where the axes stand at start-up
  std::vector<ParameterSetting> parameters;
  std::vector<WorkOffsetSetting> work_offsets;
  std::vector<ToolOffsetSetting> tool_offsets;
  hal::PointTable points;
  MacroMap macro;
  const MachineKind* machine_kind = nullptr;  // kind of the machine that has the axes; never null after parse_config()
  std::vector<PointBusConfig> buses;
  std::vector<ModbusLinkConfig> modbus;
  std::vector<GpioBankConfig> gpio;
  std::vector<CanIoConfig> can_io;
  LadderConfig ladder;
  PowerConfig power;
  ConfigPlace stop_s_place;  // where power.stop_s stands; else the section, or the line of the input
  std::vector<HandwheelConfig> handwheels;
  std::vector<JoystickConfig> joysticks;
  std::string place;           // file of the places in the programs when the power failed, relative like `print`; empty = see place_path()
  ConfigPlace place_place;
  std::vector<SignalWire> wires;
  std::array<std::array<SpindleFeedback, NC_MAX_SPINDLES>, NC_MAX_SYSTEMS> spindle_feedback;
  std::array<std::array<AxisEquipment, NC_MAX_AXES>, NC_MAX_SYSTEMS> equipment;
  std::array<std::array<ConfigPlace, NC_MAX_AXES>, NC_MAX_SYSTEMS> homing_place;
  std::vector<EquipmentName> equipment_names;
  std::vector<PointUse> point_uses;  // of the machine that is chosen
  hal::SimConfig sim;
  hal::canopen::BusMap canopen;
  ShareConfig share;
  ServicesConfig services;

  Config();
  // Folder of programs as a path that can be opened; external_folder() is the same for the programs that M198 calls.
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
  // File of the places in the programs when the power failed, in the same way.
  std::string place_path() const;
  // File in which the services write who has changed what, in the same way.
  std::string changes_path() const;
  std::string history_path() const;
  // True when the point is an output that a wire connects with a signal of the NC.
  bool is_wired_output(unsigned point) const;
  // True when the control sets the output for an axis: its brake, or the request to its drive to home it.
  bool is_set_for_axis(unsigned point) const;
};

// Parse a text. `file` is the path for messages, and the paths in the text are relative to its folder. Returns the errors; when there are none, *config
// is valid. `partial` (may be null) gets everything that could be read, even when there are errors, for callers that look for further mistakes.
std::vector<ConfigError> parse_config(std::string_view text, const std::string& file, Config* config,
                                      Config* partial = nullptr);

// Settings of the spindles that are allowed but probably not intended, each as a sentence with its line.
std::vector<std::string> spindle_warnings(const Config& config);

// What the configuration promises of a failing supply and cannot keep, each as a sentence with its line.
std::vector<std::string> power_warnings(const Config& config);
// What nc_parameter_note_row() says about this part system, with the line of the parameter that it speaks of.
std::string parameter_note_text(const Config& config, unsigned system, const nc_parameter_note& note);

// Read and parse a file.
std::vector<ConfigError> load_config(const std::string& path, Config* config, Config* partial = nullptr);

// Checks what the file requires of the computer on which it is used: its processors and folders.
std::vector<ConfigError> check_host(const Config& config);

// Writes parameters, offsets and start position into a control. What the control refuses is reported as an error with its place
// in the file.
std::vector<ConfigError> apply_config(const Config& config, nc_control* control);

}  // namespace nc::rt
