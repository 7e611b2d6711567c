// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[handwheel]]: wheels that turn axes without a ladder program. docs/connecting-a-machine.md.
#include "runtime/axes/handwheel.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

constexpr unsigned kBitsOfRegister = 16, kMostCounterBits = 32;

// As many bits of an input word come over its bus: the counter behind it wraps there, or earlier. A register, and an analog channel of a CAN module, have 16.
unsigned bits_of_word(const Config& config, unsigned point) {
  for (const ModbusLinkConfig& link : config.modbus)
    for (const hal::modbus::PointMap& map : link.link.points)
      if (map.point == point && map.width() == 1) return kBitsOfRegister;
  for (const hal::canopen::NodeMap& node : config.canopen.nodes) {
    if (!node.module) continue;
    for (const hal::canopen::IoPoint& io : node.module->points)
      if (io.point == point && io.analog && !io.output) return kBitsOfRegister;
  }
  return kMostCounterBits;
}

// An entry of `axes` of some wheel, with its place in the file.
struct ChosenAxis {
  HandwheelConfig::Choice choice;
  std::size_t wheel = 0;  // from 0
  ConfigPlace place;
};

// True where this one can never choose, which is told with the lines of both: its axis stands under its other name already ("X" and "X1"), or its input would choose another
// axis of the wheel, or two wheels on the axis, at the same time.
bool chosen_twice(const Config& config, const std::vector<ChosenAxis>& others, const ChosenAxis& one, ErrorList* errors) {
  const std::string input = "\"" + config.points.at(static_cast<unsigned>(one.choice.point)).name + "\"";
  for (const ChosenAxis& other : others) {
    const bool same_axis = other.choice.system == one.choice.system && other.choice.axis == one.choice.axis, same_point = other.choice.point == one.choice.point;
    std::string what;
    if (other.wheel == one.wheel && same_axis) what = "this wheel has this axis already";
    else if (other.wheel == one.wheel && same_point) what = input + " chooses another axis of this wheel, too: neither would ever turn";
    else if (same_axis && same_point) what = input + " chooses this axis for handwheel[" + std::to_string(other.wheel + 1) + "], too: it would be turned by neither";
    else continue;
    errors->add_twice(one.place, other.place, what);
    return true;
  }
  return false;
}

void read_axes_of(TableReader* wheel, Config* config, HandwheelConfig* entry, std::vector<ChosenAxis>* chosen) {
  wheel->require("axes");
  wheel->table("axes", [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node&) {
      unsigned system = 0, axis = 0;
      if (!find_axis(*config, key, &system, &axis)) return reader.error(key, "no axis has this name");
      const int point = read_input(&reader, key, hal::PointType::kBit, PointRole::kFree, 0, config);
      if (point < 0) return;
      const ChosenAxis one{{static_cast<std::uint8_t>(system), static_cast<std::uint8_t>(axis), point}, config->handwheels.size(), {reader.line(key), reader.path(key)}};
      if (chosen_twice(*config, *chosen, one, reader.errors())) return;
      entry->axes.push_back(one.choice);
      chosen->push_back(one);
    });
  });
}

void read_wheel(TableReader* reader, Config* config, std::vector<ChosenAxis>* chosen) {
  HandwheelConfig entry;
  const auto number = static_cast<std::uint8_t>(config->handwheels.size());
  reader->require("counter");
  const int counter = read_input(reader, "counter", hal::PointType::kWord, PointRole::kWheelCounter, number, config);
  if (counter >= 0) entry.counter = static_cast<unsigned>(counter);
  reader->integer("counts", &entry.counts, 1, 1000);
  const unsigned most = counter >= 0 ? bits_of_word(*config, entry.counter) : kMostCounterBits;
  unsigned bits = entry.bits = most;
  if (reader->integer("bits", &bits, 8, kMostCounterBits)) {
    if (bits > most) reader->error("bits", "the counter is an input of " + std::to_string(most) + " bits");
    entry.bits = bits;
  }
  entry.times_10 = read_input(reader, "times_10", hal::PointType::kBit, PointRole::kWheelTimes10, number, config);
  entry.times_100 = read_input(reader, "times_100", hal::PointType::kBit, PointRole::kWheelTimes100, number, config);
  read_axes_of(reader, config, &entry, chosen);
  if (config->handwheels.size() == kMostHandwheels) return reader->error("counter", "there are more than " + std::to_string(kMostHandwheels) + " handwheels");
  config->handwheels.push_back(std::move(entry));
}

}  // namespace

int read_input(TableReader* reader, const std::string& key, hal::PointType type, PointRole role, std::uint8_t number, Config* config) {
  std::string name;
  if (!reader->string(key, &name)) return -1;
  const int index = config->points.find(name);
  const bool fits = index >= 0 && config->points.at(static_cast<unsigned>(index)).direction == hal::PointDirection::kInput && config->points.at(static_cast<unsigned>(index)).type == type;
  if (index < 0) reader->error(key, "no point is named \"" + name + "\"");
  else if (!fits) reader->error(key, std::string("must be an input that is a ") + (type == hal::PointType::kWord ? "word" : "bit"));
  if (!fits) return -1;
  config->point_uses.push_back({role, index, {reader->line(key), reader->path(key)}, 0, number});
  return index;
}

void read_handwheels(TableReader* root, Config* config) {
  std::vector<ChosenAxis> chosen;
  root->tables("handwheel", [&](TableReader& reader, std::size_t) { read_wheel(&reader, config, &chosen); });
}

}  // namespace nc::rt
