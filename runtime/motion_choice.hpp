// SPDX-License-Identifier: Apache-2.0
// The law of motion of a machine whose configuration names none: the time-optimal one when every axis has the limits that it needs, else the trapezoid.
#pragma once

#include <cstdint>
#include <string>

#include "nc/control.h"

namespace nc::rt {

/// Number of records between feeder and scan in the time-optimal mode when the configuration gives no look_ahead. They need 39 MB, which the computer of
/// a machine has. With 16384 records (98 MB) a program of lines of 1 um at 100 mm/s is executed 1.6 times as fast; no other program of
/// docs/benchmarks.md gains more than 2 %.
inline constexpr std::uint32_t kLookAheadOptimal = 4096;

/// Why the time-optimal mode is not possible on this machine, such as "Z has no max_jerk"; empty when every axis has the limits that it needs.
std::string optimal_lacks(const nc_config& config);

/// The law of motion of a machine whose configuration names none.
nc_motion_mode default_motion(const nc_config& config);

/// The law of motion of a machine and the reason for it, as text. `named`: the configuration or the command line names the law.
std::string motion_text(const nc_config& config, bool named);

}  // namespace nc::rt
