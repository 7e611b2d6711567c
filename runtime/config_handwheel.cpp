// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[handwheel]]: wheels that turn axes without a ladder program. docs/connecting-a-machine.md.
#include "runtime/axes/handwheel.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

// Why this input can never choose: it would choose another axis of the wheel, or two wheels on the axis, at the same time. "" = it can.
std::string chosen_twice(const Config& config, const HandwheelConfig& wheel, unsigned system, unsigned axis, int point) {
  const std::string input = "\"" + config.points.at(static_cast<unsigned>(point)).name + "\"";
  for (const HandwheelConfig::Choice& other : wheel.axes)
    if (other.point == point) return input + " chooses another axis of this wheel, too: neither would ever turn";
  for (std::size_t n = 0; n < config.handwheels.size(); ++n)
    for (const HandwheelConfig::Choice& other : config.handwheels[n].axes)
      if (other.point == point && other.system == system && other.axis == axis)
        return input + " chooses this axis for handwheel[" + std::to_string(n + 1) + "], too: it would be turned by neither";
  return "";
}

void read_axes_of(TableReader* wheel, Config* config, HandwheelConfig* entry) {
  wheel->require("axes");
  wheel->table("axes", [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node&) {
      unsigned system = 0, axis = 0;
      if (!find_axis(*config, key, &system, &axis)) return reader.error(key, "no axis has this name");
      const int point = read_input(&reader, key, hal::PointType::kBit, PointRole::kFree, 0, config);
      if (point < 0) return;
      const std::string twice = chosen_twice(*config, *entry, system, axis, point);
      if (!twice.empty()) return reader.error(key, twice);
      entry->axes.push_back({static_cast<std::uint8_t>(system), static_cast<std::uint8_t>(axis), point});
    });
  });
}

void read_wheel(TableReader* reader, Config* config) {
  HandwheelConfig entry;
  const auto number = static_cast<std::uint8_t>(config->handwheels.size());
  reader->require("counter");
  const int counter = read_input(reader, "counter", hal::PointType::kWord, PointRole::kWheelCounter, number, config);
  if (counter >= 0) entry.counter = static_cast<unsigned>(counter);
  reader->integer("counts", &entry.counts, 1, 1000);
  unsigned bits = entry.bits;
  if (reader->integer("bits", &bits, 8, 32)) entry.bits = bits;
  entry.times_10 = read_input(reader, "times_10", hal::PointType::kBit, PointRole::kWheelTimes10, number, config);
  entry.times_100 = read_input(reader, "times_100", hal::PointType::kBit, PointRole::kWheelTimes100, number, config);
  read_axes_of(reader, config, &entry);
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
  root->tables("handwheel", [&](TableReader& reader, std::size_t) { read_wheel(&reader, config); });
}

}  // namespace nc::rt
