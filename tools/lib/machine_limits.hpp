// SPDX-License-Identifier: Apache-2.0
// Limits of the machine for `ncsim time`: a small JSON file, or the same values for every axis.
#pragma once

#include <string>

#include "nc/nc.h"

namespace nc::tools {

// With smaller rates a run would never end; with larger ones a step would be too large for a double to hold a position beside it.
inline constexpr double kSlowest = 1e-3, kFastest = 1e9;  // mm, deg per second, second squared, cubed

/**
 * Sets for every axis of the first part system velocity 250 mm/s (also for rapids), acceleration 2000 mm/s^2, jerk 50000 mm/s^3 and
 * in-position width 0.02 mm; for rotary axes the same numbers in degrees.
 */
void default_machine_limits(nc_config* config);

/**
 * {"cycle_s": 0.001, "axes": {"X": {"velocity": 250, "rapid": 300, "acceleration": 2000, "jerk": 50000,
 * "in_position": 0.02, "stroke": [-10, 500]}}}: values in the file replace the defaults; an axis that the setup
 * does not have is an error.
 */
bool load_machine_limits(const std::string& path, nc_config* config, std::string* error);

/** The same from a text; `name` for messages. */
bool parse_machine_limits(const std::string& text, const std::string& name, nc_config* config,
                          std::string* error);

}  // namespace nc::tools
