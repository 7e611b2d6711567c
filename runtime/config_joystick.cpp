// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[joystick]]: analog inputs that jog axes without a ladder program. docs/connecting-a-machine.md.
#include <algorithm>

#include "runtime/axes/joystick.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

void read_counts(TableReader* reader, JoystickConfig* entry) {
  for (const char* const key : {"low", "middle", "high"}) reader->require(key);
  bool whole = reader->integer("low", &entry->low, INT32_MIN, INT32_MAX);
  whole = reader->integer("middle", &entry->middle, INT32_MIN, INT32_MAX) && whole;
  whole = reader->integer("high", &entry->high, INT32_MIN, INT32_MAX) && whole;
  const bool rises = entry->low < entry->middle && entry->middle<entry->high, falls = entry->low> entry->middle && entry->middle > entry->high;
  if (whole && !rises && !falls) reader->error("middle", "must lie between low and high");
}

void read_stick(TableReader* reader, Config* config) {
  JoystickConfig entry;
  for (const char* const key : {"axis", "input", "dead_man", "top_speed"}) reader->require(key);
  std::string name;
  unsigned system = 0, axis = 0;
  if (reader->string("axis", &name)) {
    if (find_axis(*config, name, &system, &axis)) entry.system = static_cast<std::uint8_t>(system), entry.axis = static_cast<std::uint8_t>(axis);
    else reader->error("axis", "no axis is named \"" + name + "\"");
  }
  entry.input = static_cast<unsigned>(std::max(read_input(reader, "input", hal::PointType::kWord, PointRole::kStick, 0, config), 0));
  entry.dead_man = static_cast<unsigned>(std::max(read_input(reader, "dead_man", hal::PointType::kBit, PointRole::kFree, 0, config), 0));
  entry.chosen_by = read_input(reader, "chosen_by", hal::PointType::kBit, PointRole::kFree, 0, config);
  read_counts(reader, &entry);
  reader->number("dead_band", &entry.dead_band, 0.01, 0.9);
  const double most = config->nc.system[entry.system].axis[entry.axis].max_velocity;
  if (reader->number("top_speed", &entry.top_speed, quantity::kSpeed) && entry.top_speed > most)
    reader->error("top_speed", "is more than the axis can do (max_velocity " + number_text(most) + ")");
  for (const JoystickConfig& other : config->joysticks)
    if (other.system == entry.system && other.axis == entry.axis && !name.empty()) reader->error("axis", "has a joystick already");
  config->joysticks.push_back(entry);
}

}  // namespace

void read_joysticks(TableReader* root, Config* config) {
  root->tables("joystick", [&](TableReader& reader, std::size_t) { read_stick(&reader, config); });
}

}  // namespace nc::rt
