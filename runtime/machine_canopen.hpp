// SPDX-License-Identifier: Apache-2.0
// The row of CANopen in the table of machines (runtime/hal_factory.hpp, which says what each function is for).
#pragma once

#include "runtime/hal_factory.hpp"

namespace nc::rt {

class ErrorList;

// ---- the configuration: runtime/config_canopen.cpp ----
void read_canopen(TableReader* root, Config* config);
// Parts of it that the I/O modules on the same bus have, too. read_identity(): vendor, product and objects, and where each object stands. check_objects(): those that the
// control sets by itself, when all PDOs of the node are known. eds_errors(): what is wrong with the data sheet `name`,
// or what of the node does not fit it.
void read_identity(TableReader* reader, hal::canopen::NodeMap* node, std::vector<ConfigPlace>* objects);
void check_objects(ErrorList* errors, const hal::canopen::BusMap& bus, const hal::canopen::NodeMap& node, const std::vector<ConfigPlace>& objects);
// read_drive_place(): slot, rpdo and tpdo. read_drive_point(): the name of a point that the machine of drives writes or reads, for `role` of the axis or spindle of `owner`.
void read_drive_place(TableReader* reader, const hal::canopen::NodeMap& node, hal::canopen::AxisMap* map);
void read_drive_point(TableReader* reader, const char* key, hal::PointType type, hal::PointDirection direction, PointRole role, const hal::canopen::AxisMap& owner, Config* config, int* place);
// The gain of a loop that is closed here over the bus. Where the file gives none it is the usual one, or what the SYNC allows. `moves`: "the axis", for the error.
void read_loop_gain(TableReader* reader, const char* key, double least, double most, unsigned sync_us, const char* moves, double* gain);
// [[canopen.drive.spindle]], in runtime/config_can_spindle.cpp; and whether a spindle is on a drive of the machine.
void read_drive_spindle(TableReader* reader, Config* config, hal::canopen::NodeMap* node);
bool is_on_drive(const Config& config, unsigned system, unsigned number);
std::vector<std::string> eds_errors(const std::string& name, const Config& config, const hal::canopen::NodeMap& node);

// ---- the machine: runtime/machine_canopen.cpp ----
std::unique_ptr<hal::Hal> make_canopen(const Config& config);
std::string canopen_load(const Config& config);  // the load of the bus, with its arithmetic
void canopen_resources(const Config& config, std::vector<MachineResource>* resources);

}  // namespace nc::rt
