// SPDX-License-Identifier: Apache-2.0
// The gateway as a program: it publishes the control that the options name until a signal ends it.
#pragma once

#include <string>

#include "dds/gateway.hpp"

namespace nc::dds {

struct GatewayCommand {
  GatewayOptions gateway;
  std::string config;      // configuration that gives the name of the control; "" = gateway.share is the name
  std::string ready_file;  // written when DDS is up; "" = none
};

// Returns the exit status of ncdds. Errors are printed on standard error.
int gateway_command(const GatewayCommand& command);

}  // namespace nc::dds
