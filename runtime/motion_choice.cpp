// SPDX-License-Identifier: Apache-2.0
// See motion_choice.hpp.
#include "runtime/motion_choice.hpp"

namespace nc::rt {

std::string optimal_lacks(const nc_config& config) {
  struct Limit {
    const char* key;
    double nc_axis_config::*value;
  };
  constexpr Limit kNeeded[] = {{"max_velocity", &nc_axis_config::max_velocity},
                               {"max_acceleration", &nc_axis_config::max_acceleration},
                               {"max_jerk", &nc_axis_config::max_jerk}};
  for (unsigned s = 0; s < config.system_count; ++s)
    for (unsigned i = 0; i < config.system[s].axis_count; ++i)
      for (const Limit& limit : kNeeded) {
        const nc_axis_config& axis = config.system[s].axis[i];
        if (axis.*limit.value > 0) continue;
        const std::string system = config.system_count > 1 ? " of part system " + std::to_string(s + 1) : "";
        return std::string(1, axis.name) + system + " has no " + limit.key;
      }
  return {};
}

nc_motion_mode default_motion(const nc_config& config) { return optimal_lacks(config).empty() ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID; }

std::string motion_text(const nc_config& config, bool named) {
  const bool optimal = config.motion_mode == NC_MOTION_OPTIMAL;
  const std::string mode = optimal ? "optimal" : "trapezoid", lacks = optimal_lacks(config);
  if (named) return mode + ", as it is configured";
  return mode + (optimal ? ": every axis has limits of velocity, acceleration and jerk" : ": " + lacks);
}

}  // namespace nc::rt
