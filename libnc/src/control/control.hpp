// SPDX-License-Identifier: Apache-2.0
// The members of an nc_control.
#pragma once

#include <cmath>

#include "control/joints.hpp"
#include "control/part_system.hpp"

struct nc_control {
  nc_config config;
  const nc::Dialect* dialect;
  nc::ProgramStore store;
  nc::CommonVariables common[NC_MAX_SYSTEMS];  // as each part system sees them
  nc::SharedTables shared;
  nc::VendorCodes vendor;
  nc::PartSystem system[NC_MAX_SYSTEMS];
  nc::Joints joints[NC_MAX_SYSTEMS];
  bool any_joints;
  char mdi[NC_MAX_SYSTEMS][1024 + 6];  // the MDI blocks of each part system; 6 bytes for what is put before and behind them
};

/// Whether the host's answer has angles of a tool (nc_world::tool_angle); false for NaN, too.
inline bool are_tool_angles(const double (&angle)[2]) { return std::fabs(angle[0]) <= NC_TOOL_ANGLE_MAX && std::fabs(angle[1]) <= NC_TOOL_ANGLE_MAX; }

/// Whether there is a control, with this part system (from 0).
inline bool has_system(const nc_control* control, unsigned system) { return control != nullptr && system < control->config.system_count; }
