// SPDX-License-Identifier: Apache-2.0
// See machine_choice.hpp.
#include "tools/lib/machine_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/motion_choice.hpp"
#include "tools/lib/machine_limits.hpp"

namespace nc::tools {
namespace {

constexpr double kMicro = 1e-6;

// Reads one number at *at and moves *at past it.
bool take_number(const char** at, double* value) {
  if (**at == ' ' || **at == '\0') return false;
  char* end = nullptr;
  *value = std::strtod(*at, &end);
  if (end == *at || !std::isfinite(*value)) return false;
  *at = end;
  return true;
}

// Chooses the law of motion: the one of the command line, or else of the machine, or else the one that the limits allow.
bool set_motion(const MachineOptions& options, const rt::Config* machine, nc_config* config, std::string* error) {
  if (machine == nullptr) config->contour_blocks = kContourBlocksDesk;
  const bool by_machine = machine != nullptr && machine->motion_given;
  if (options.tolerance) config->path_tolerance = *options.tolerance;
  if (options.motion) config->motion_mode = static_cast<std::uint8_t>(*options.motion);
  else if (options.tolerance) config->motion_mode = NC_MOTION_OPTIMAL;
  else if (!by_machine) config->motion_mode = static_cast<std::uint8_t>(rt::default_motion(*config));
  if (config->motion_mode != NC_MOTION_OPTIMAL) return true;
  if (machine == nullptr) config->look_ahead = kLookAheadDesk;
  else if (!machine->look_ahead_given) config->look_ahead = rt::kLookAheadOptimal;
  const std::string lacks = rt::optimal_lacks(*config);
  if (lacks.empty()) return true;
  const std::string who = options.motion ? "--motion optimal" : options.tolerance || machine == nullptr ? "--tolerance" : machine->file + ": [motion] mode";
  *error = who + ": the time-optimal mode needs limits of velocity, acceleration and jerk of every axis, " + lacks;
  return false;
}

}  // namespace

std::optional<EveryAxis> parse_every_axis(const std::string& text, std::string* why) {
  EveryAxis all;
  const char* at = text.c_str();
  double* const values[] = {&all.velocity, &all.acceleration, &all.jerk};
  bool good = true;
  for (int i = 0; good && i < 3; ++i) good = (i == 0 || *at++ == ',') && take_number(&at, values[i]);
  if (!good || *at != '\0') {
    *why = "must be three numbers, velocity,acceleration,jerk, is " + (text.empty() ? "empty" : text);
    return std::nullopt;
  }
  const auto in_range = [](double v) { return v >= kSlowest && v <= kFastest; };
  if (in_range(all.velocity) && in_range(all.acceleration) && (all.jerk == 0 || in_range(all.jerk)))
    return all;
  *why = "each must be from 0.001 to 1e9 (jerk 0: no limit), is " + text;
  return std::nullopt;
}

std::unique_ptr<rt::Config> load_machine(const std::string& path, std::string* error) {
  auto config = std::make_unique<rt::Config>();
  const std::vector<rt::ConfigError> errors = rt::load_config(path, config.get());
  if (!errors.empty()) {
    error->clear();
    for (const rt::ConfigError& e : errors) *error += (error->empty() ? "" : "\n") + e.text();
    return nullptr;
  }
  config->nc.system_count = 1;  // a program of the command line runs in the first one
  // There is no PLC here that selects spindles or switches one to an axis, so there is one spindle, and a C axis is always an axis.
  config->nc.system[0].spindle_count = 1;
  for (nc_axis_config& axis : config->nc.system[0].axis) axis.spindle = 0;
  std::erase_if(config->work_offsets, [](const rt::WorkOffsetSetting& w) { return w.system != 0; });
  std::erase_if(config->parameters,
                [](const rt::ParameterSetting& p) { return p.axis != 0 && p.system != 0; });
  return config;
}

ServoModel servo_of(const rt::Config& machine, double cycle_s) {
  ServoModel servo = {};
  for (unsigned i = 0; i < machine.nc.system[0].axis_count; ++i) {
    const double lag = machine.sim.axis[0][i].lag_s;
    servo.clamp[i] = machine.sim.axis[0][i].clamp;
    servo.follow[i] = lag > 0 ? 1.0 - std::exp(-cycle_s / lag) : 1.0;
  }
  return servo;
}

bool set_machine_limits(const MachineOptions& options, const rt::Config* machine, nc_config* config,
                        std::string* error) {
  nc_system_config& system = config->system[0];
  if (machine) {
    system = machine->nc.system[0];
    config->cycle_s = machine->nc.cycle_s;
    config->motion_mode = machine->nc.motion_mode;
    config->path_tolerance = machine->nc.path_tolerance;
  } else {
    default_machine_limits(config);
  }
  if (!options.limits_file.empty() && !load_machine_limits(options.limits_file, config, error)) return false;
  if (!options.every_axis.empty()) {
    const auto all = parse_every_axis(options.every_axis, error);
    if (!all) return false;
    for (unsigned i = 0; i < system.axis_count; ++i) {
      system.axis[i].rapid = system.axis[i].max_velocity = all->velocity;
      system.axis[i].max_acceleration = all->acceleration;
      system.axis[i].max_jerk = all->jerk;
    }
  }
  if (options.cycle_us) config->cycle_s = *options.cycle_us * kMicro;
  return set_motion(options, machine, config, error);
}

}  // namespace nc::tools
