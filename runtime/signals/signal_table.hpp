// SPDX-License-Identifier: Apache-2.0
// The signals between NC and ladder: one table of name, direction, type, meaning, timing and safe value. The
// devices of the ladder and docs/signals.md come from it.
//
// Names: "nc." is what the NC says, "plc." what the ladder tells it. A second part system is "nc2." and
// "plc2.". A signal of an axis carries the axis letter behind a point (nc.in_position.X), a numbered one its
// number from 1 (plc.skip.1). Signals that are active when off, so that a broken wire stops the machine, have
// a name that ends in _n.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/devices.hpp"
#include "runtime/ladder_hook.hpp"

namespace nc::rt {

enum class SignalDirection : std::uint8_t { kFromNc, kToNc };
// kControl: once for the machine; the others once for each part system, its axes, or the numbers 1...count. kSpindle: the spindles of a
// part system that has more than one; kSpindleAxis: its axes that are a spindle, too.
enum class SignalScope : std::uint8_t { kControl, kNumberedControl, kSystem, kAxis, kNumbered, kSpindle, kSpindleAxis };

struct SignalRow {
  const char* name;  // without the prefix
  ladder::DeviceType type;
  SignalDirection direction;
  SignalScope scope;
  unsigned count;     // numbered ones: how many
  std::int32_t safe;  // kToNc: until the program writes it, and when it does not run
  const char* meaning;
  const char* timing;
  // One of them. `index`: axis, or number from 0. NC_RT.
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

// The tables of docs/signals.md, in Markdown.
std::string signal_document();

}  // namespace nc::rt
