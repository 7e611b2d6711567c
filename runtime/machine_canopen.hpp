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
// read_drive_place(): slot, rpdo and tpdo. read_drive_point(): the name of a point that the machine of drives writes or reads.
void read_drive_place(TableReader* reader, const hal::canopen::NodeMap& node, hal::canopen::AxisMap* map);
void read_drive_point(TableReader* reader, const char* key, hal::PointType type, hal::PointDirection direction, const Config& config, int* place);
// [[canopen.drive.spindle]], in runtime/config_can_spindle.cpp; and whether a spindle is on a drive of the machine.
void read_drive_spindle(TableReader* reader, const Config& config, hal::canopen::NodeMap* node);
bool is_on_drive(const Config& config, unsigned system, unsigned number);
std::vector<std::string> eds_errors(const std::string& name, const Config& config, const hal::canopen::NodeMap& node);

// ---- the machine: runtime/machine_canopen.cpp ----
std::unique_ptr<hal::Hal> make_canopen(const Config& config);
void canopen_resources(const Config& config, std::vector<MachineResource>* resources);

}  // namespace nc::rt
