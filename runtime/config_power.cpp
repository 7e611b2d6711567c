// SPDX-License-Identifier: Apache-2.0
// Configuration section [power]: what happens when the supply says that it fails.
#include <algorithm>
#include <cmath>

#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

constexpr double kBrakesWithin_s = 0.03;  // a law of motion begins to brake within that time (docs/motion-optimal.md)

// Null: no input says that the supply fails, or the ladder program does.
const PointUse* supply_of(const Config& config) {
  const auto found = std::find_if(config.point_uses.begin(), config.point_uses.end(), [](const PointUse& use) { return use.role == PointRole::kSupply; });
  return found == config.point_uses.end() ? nullptr : &*found;
}

}  // namespace

void read_power(TableReader* root, Config* config) {
  const PointUse* const supply = supply_of(*config);
  if (supply != nullptr) config->stop_s_place = supply->place;
  root->table("power", [&](TableReader& reader) {
    PowerConfig& power = config->power;
    config->stop_s_place = {reader.line("stop_s"), reader.path("stop_s")};
    reader.number("stop_s", &power.stop_s, 0.001, 60);
    reader.number("delay_s", &power.delay_s, quantity::kDelay);
    reader.number("settle_s", &power.settle_s, 0.001, 60);
    reader.string("place", &config->place, TableReader::Empty::kTaken);
    config->place_place = {reader.line("place"), reader.path("place")};
    for (const auto& [other, what] : {std::pair<const std::string&, const char*>{config->variables, "common variables too: [machine] variables"},
                                      {config->offsets, "offsets too: [machine] offsets"},
                                      {config->ladder.retain, "devices of the ladder too: [ladder] retain"}})
      if (same_file(config->place, other)) reader.error("place", std::string("is the file of the ") + what);
    if (config->ladder.program.empty() && supply == nullptr)
      reader.errors()->add(reader.line(), reader.path(), "nothing gives plc.power_fail_n: connect an input with it under [signals]");
  });
}

// From its rapid rate an axis needs v/a, and a/j more with a limited jerk. In the corner of a path each axis has its own share of that.
std::vector<std::string> power_warnings(const Config& config) {
  std::vector<std::string> warnings;
  if (supply_of(config) == nullptr) return warnings;
  for (unsigned s = 0; s < config.nc.system_count; ++s) {
    for (unsigned a = 0; a < config.nc.system[s].axis_count; ++a) {
      const nc_axis_config& axis = config.nc.system[s].axis[a];
      const double needs = axis.max_velocity / axis.max_acceleration + (axis.max_jerk > 0 ? axis.max_acceleration / axis.max_jerk : 0) + kBrakesWithin_s;
      if (needs <= config.power.stop_s) continue;
      warnings.push_back(ConfigError{config.file, config.stop_s_place.line, config.stop_s_place.key, "axis " + std::string(1, axis.name) + " needs up to " + number_text(std::ceil(needs * 1000) / 1000) +
                                                                         " s to stop: when the power fails its drive goes off after " + number_text(config.power.stop_s) + " s"}.text());
    }
  }
  return warnings;
}

}  // namespace nc::rt
