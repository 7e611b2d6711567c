// SPDX-License-Identifier: Apache-2.0
// The row of CANopen in the table of machines (runtime/hal_factory.hpp, which says what each function is for).
#pragma once

#include "runtime/hal_factory.hpp"

namespace nc::rt {

// ---- the configuration: runtime/config_canopen.cpp ----
void read_canopen(TableReader* root, Config* config);
// Parts of it that the I/O modules on the same bus have, too. read_identity(): vendor, product and objects. eds_errors(): what is wrong with the data sheet `name`,
// or what of the node does not fit it.
void read_identity(TableReader* reader, hal::canopen::NodeMap* node);
std::vector<std::string> eds_errors(const std::string& name, const Config& config, const hal::canopen::NodeMap& node);

// ---- the machine: runtime/machine_canopen.cpp ----
std::unique_ptr<hal::Hal> make_canopen(const Config& config);
void canopen_resources(const Config& config, std::vector<MachineResource>* resources);

}  // namespace nc::rt
