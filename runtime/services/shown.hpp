// SPDX-License-Identifier: Apache-2.0
// The replies of the services that only show: made from the blocks that the publisher writes for the readers of the shared memory, so that every display shows
// the same.
#pragma once

#include <string>

#include "runtime/services/call.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::services {

Json machine_json(const share::MachineBlock& machine);
// `control`: the client that has control.
Json status_json(const share::StatusBlock& status, const share::MachineBlock& machine, const std::string& control);
Json alarms_json(const share::StatusBlock& status);
Json services_json();
// The name of a Mode, "?" for any other number.
const char* mode_name(std::uint32_t mode);

}  // namespace nc::rt::services
