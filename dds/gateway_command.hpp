// SPDX-License-Identifier: Apache-2.0
// The gateway as a program: which control it is for, until a signal ends it.
#pragma once

#include <string>

#include "dds/gateway.hpp"

namespace nc::dds {

struct GatewayCommand {
  GatewayOptions gateway;
  std::string config;      // file of the machine that names the control; "" = gateway.share does
  std::string ready_file;  // written when DDS is up; "" = none
};

// The exit status of ncdds. What is wrong goes to standard error.
int gateway_command(const GatewayCommand& command);

}  // namespace nc::dds
