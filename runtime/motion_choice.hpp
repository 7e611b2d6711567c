// SPDX-License-Identifier: Apache-2.0
// Which law moves a machine that names none: the time-optimal one where every axis has the limits that it needs, else the trapezoid.
#pragma once

#include <cstdint>
#include <string>

#include "nc/control.h"

namespace nc::rt {

/// Records between feeder and scan in the time-optimal mode of a machine that gives no number: 39 MB, which the computer of a machine bears. Lines of
/// 1 um at 100 mm/s take 1.6 times as long as with 16384 (98 MB), no other program of docs/benchmarks.md takes more than 1.02 times.
inline constexpr std::uint32_t kLookAheadOptimal = 4096;

/// What keeps the time-optimal mode from this machine, as "Z has no max_jerk"; empty where every axis has all that it needs.
std::string optimal_lacks(const nc_config& config);

/// The law of a machine that names none.
nc_motion_mode default_motion(const nc_config& config);

/// The law of a machine and why it is that one, for those who check it. `named`: by the machine's file or the command line.
std::string motion_text(const nc_config& config, bool named);

}  // namespace nc::rt
