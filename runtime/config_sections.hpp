// SPDX-License-Identifier: Apache-2.0
// The sections of the machine configuration, in the order in which they are read (later ones refer to earlier
// ones).
#pragma once

#include "runtime/toml_reader.hpp"

namespace nc::rt {

void read_machine(TableReader* root, Config* config);
void read_scheduling(TableReader* root, Config* config);
void read_axes(TableReader* root, Config* config);
void read_parameters(TableReader* root, Config* config);
void read_work_offsets(TableReader* root, Config* config);
void read_tool_offsets(TableReader* root, Config* config);
void read_points(TableReader* root, Config* config);
void read_macro_interface(TableReader* root, Config* config);
void read_sim(TableReader* root, Config* config);

// "X" = axis X of part system 1, "X2" = axis X of part system 2. False when there is none.
bool find_axis(const Config& config, std::string_view name, unsigned* system, unsigned* axis);

}  // namespace nc::rt
