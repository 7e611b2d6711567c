// SPDX-License-Identifier: Apache-2.0
// One line about this program for `systemctl status`.
#pragma once

#include <string>

namespace nc::dds {

// Tells systemd; nothing happens where it has not started this program, or does not listen (NotifyAccess=).
void tell_state(const std::string& text);

}  // namespace nc::dds
