// SPDX-License-Identifier: Apache-2.0
// Keys of [[axis]] that stand for what is beside the axis: homing, limit_switches, brake, screw. The first three name points, which are read behind the axes, so
// the names wait in `EquipmentName` until then.
#pragma once

#include "runtime/config_sections.hpp"

namespace nc::rt {

// Of one axis, from its table; the axis is `axis` of part system `system` already.
void read_equipment(TableReader* axis, Config* config, unsigned system, unsigned axis_index);
// screw, of an axis whose other keys are read.
void read_screw(TableReader* reader, const nc_axis_config& axis, double cycle_s, ScrewConfig* screw);
// Behind the points and the signals: the names become points.
void resolve_equipment(TableReader* root, Config* config);
// [[sim.axis]]; called by read_sim() with the reader of [sim].
void read_sim_axes(TableReader* sim, Config* config);

}  // namespace nc::rt
