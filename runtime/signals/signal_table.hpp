// SPDX-License-Identifier: Apache-2.0
// The signals between NC and ladder: one table of name, direction, type, meaning, timing and safe value. The
// devices of the ladder and docs/signals.md are made from it.
//
// Names: signals from the NC begin with "nc.", signals to the NC with "plc."; those of the second part system with "nc2." and
// "plc2.". The name of a signal of an axis ends with a point and the letter of the axis (nc.in_position.X), that of a numbered one with a point and its
// number from 1 (plc.skip.1). A signal that is active when it is off, so that a broken wire stops the machine, has
// a name that ends in _n.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/devices.hpp"
#include "runtime/ladder_hook.hpp"

namespace nc::rt {

enum class SignalDirection : std::uint8_t { kFromNc, kToNc };
// How often a signal exists. kControl: once for the machine; kNumberedControl: `count` times for the machine. kSystem: once for each part system. kAxis,
// kNumbered, kSpindle and kSpindleAxis: in each part system once for each axis, `count` times, once for each spindle (what goes to the control only if there is
// more than one), and once for each axis that is also a spindle.
enum class SignalScope : std::uint8_t { kControl, kNumberedControl, kSystem, kAxis, kNumbered, kSpindle, kSpindleAxis };

struct SignalRow {
  const char* name;  // without the prefix
  ladder::DeviceType type;
  SignalDirection direction;
  SignalScope scope;
  unsigned count;     // number of signals, for the numbered scopes
  std::int32_t safe;  // kToNc: value until the ladder program writes it, and while the program does not run
  const char* meaning;
  const char* timing;
  // read: signals from the NC; write: signals to the NC; the other one is null. `index`: axis, or number from 0. NC_RT.
  std::int32_t (*read)(const LadderImage& image, unsigned system, unsigned index);
  void (*write)(std::int32_t value, LadderImage* image, unsigned system, unsigned index);
};

extern const SignalRow kSignals[];
extern const unsigned kSignalCount;

// One signal of this machine.
struct Signal {
  const SignalRow* row = nullptr;
  std::uint8_t system = 0, index = 0;
  std::string name;
};

// Every signal that a machine with these part systems and axes has, in the order of the table.
std::vector<Signal> machine_signals(const nc_config& nc);

// The tables of docs/signals.md in Markdown.
std::string signal_document();

}  // namespace nc::rt
