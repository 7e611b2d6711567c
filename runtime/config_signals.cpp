// SPDX-License-Identifier: Apache-2.0
// Configuration section [signals]: signals of the table (docs/signals.md) that are connected directly to points of the machine,
// without a ladder program between them.
#include <algorithm>

#include "runtime/config_sections.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {
namespace {

PointRole role_of(const Signal& signal) {
  if (signal.row->direction == SignalDirection::kFromNc) return PointRole::kSignalOutput;
  return signal.name == "plc.power_fail_n" ? PointRole::kSupply : PointRole::kFree;
}

// `called`: the name of the signal, which a family may have a name of its own for, the key.
void connect(TableReader* reader, const std::string& key, const std::string& called, const std::vector<Signal>& signals, Config* config) {
  std::string name;
  if (!reader->string(key, &name)) return;
  const auto signal =
      std::find_if(signals.begin(), signals.end(), [&](const Signal& each) { return each.name == called; });
  if (signal == signals.end())
    return reader->error(key, "no signal of this machine has this name; docs/signals.md lists them");
  const int index = config->points.find(name);
  if (index < 0) return reader->error(key, "no point is named \"" + name + "\"");
  const hal::Point& point = config->points.at(static_cast<unsigned>(index));
  const bool to_nc = signal->row->direction == SignalDirection::kToNc;
  if ((point.direction == hal::PointDirection::kInput) != to_nc)
    return reader->error(key, to_nc ? "goes to the NC, but point \"" + name + "\" is an output"
                                    : "comes from the NC, but point \"" + name + "\" is an input");
  if ((point.type == hal::PointType::kBit) != (signal->row->type == ladder::DeviceType::kBit))
    return reader->error(key, point.type == hal::PointType::kBit ? "is a word, but point \"" + name + "\" is a bit"
                                                                 : "is a bit, but point \"" + name + "\" is a word");
  if (to_nc && !config->ladder.program.empty())
    return reader->error(key, "is given by the ladder program: connect it there");
  config->wires.push_back({static_cast<unsigned>(signal - signals.begin()), static_cast<unsigned>(index)});
  config->point_uses.push_back({role_of(*signal), index, {reader->line(key), reader->path(key)}});
}

}  // namespace

void read_signals(TableReader* root, Config* config) {
  root->table("signals", [&](TableReader& reader) {
    const std::vector<Signal> signals = machine_signals(config->nc);
    reader.each([&](const std::string& key, const toml::node&) { connect(&reader, key, key, signals, config); });
  });
}

void connect_signal(TableReader* reader, const std::string& key, const std::string& signal, Config* config) {
  connect(reader, key, signal, machine_signals(config->nc), config);
}

bool Config::is_set_for_axis(unsigned point) const {
  return std::any_of(point_uses.begin(), point_uses.end(), [point](const PointUse& use) {
    return (use.role == PointRole::kBrake || use.role == PointRole::kHomingRequest) && use.point == static_cast<int>(point);
  });
}

bool Config::is_wired_output(unsigned point) const {
  if (points.at(point).direction != hal::PointDirection::kOutput) return false;
  return std::any_of(wires.begin(), wires.end(), [point](const SignalWire& wire) { return wire.point == point; });
}

}  // namespace nc::rt
