// SPDX-License-Identifier: Apache-2.0
// Configuration section [power]: what happens when the supply says that it fails.
#include <algorithm>
#include <cmath>

#include "runtime/config_sections.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {
namespace {

constexpr double kBrakesWithin_s = 0.03;  // a law of motion begins to brake within that time (docs/motion-optimal.md)

bool is_wired(const Config& config) {
  const std::vector<Signal> signals = machine_signals(config.nc);
  return std::any_of(config.wires.begin(), config.wires.end(), [&](const SignalWire& wire) { return signals[wire.signal].name == "plc.power_fail_n"; });
}

}  // namespace

void read_power(TableReader* root, Config* config) {
  for (const PointUse& use : config->point_uses)
    if (use.place.key.find("plc.power_fail_n") != std::string::npos) config->stop_s_place = use.place;
  root->table("power", [&](TableReader& reader) {
    PowerConfig& power = config->power;
    config->stop_s_place = {reader.line("stop_s"), reader.path("stop_s")};
    reader.number("stop_s", &power.stop_s, 0.001, 60);
    reader.number("delay_s", &power.delay_s, 0, 10);
    reader.number("settle_s", &power.settle_s, 0.001, 60);
    reader.string("place", &config->place);
    config->place_place = {reader.line("place"), reader.path("place")};
    for (const auto& [other, what] : {std::pair<const std::string&, const char*>{config->variables, "common variables too: [machine] variables"},
                                      {config->offsets, "offsets too: [machine] offsets"},
                                      {config->ladder.retain, "devices of the ladder too: [ladder] retain"}})
      if (same_file(config->place, other)) reader.error("place", std::string("is the file of the ") + what);
    if (config->ladder.program.empty() && !is_wired(*config))
      reader.errors()->add(reader.line(), reader.path(), "nothing gives plc.power_fail_n: connect an input with it under [signals]");
  });
}

// From its rapid rate an axis needs v/a, and a/j more with a limited jerk. In the corner of a path each axis has its own share of that.
std::vector<std::string> power_warnings(const Config& config) {
  std::vector<std::string> warnings;
  if (!is_wired(config)) return warnings;
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
