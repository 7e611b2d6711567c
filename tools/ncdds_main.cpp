// SPDX-License-Identifier: Apache-2.0
// ncdds: the DDS gateway of a control. It reads the shared memory of ncrtd and publishes it, and passes on commands
// if it is told to. It waits for ncrtd, and finds it again after a restart.
//
//   ncdds --machine FILE | --share NAME [--domain N] [--rate HZ] [--commands] [--services SOCKET | --no-services]
//         [--security FOLDER [--network INTERFACE]] [--ready-file FILE]
//
// It communicates only on this computer (interface lo, no multicast) unless CYCLONEDDS_URI is set,
// or --network with DDS Security.
// Exit status: 0 ended by SIGTERM or SIGINT, 1 wrong usage or configuration, or DDS cannot be started.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "dds/gateway_command.hpp"
#include "nc/control.h"
#include "tools/lib/option_values.hpp"

int main(int argc, char** argv) try {
  CLI::App app{"ncdds: publishes a control over DDS"};
  nc::dds::GatewayCommand command;
  nc::dds::GatewayOptions& options = command.gateway;
  app.set_version_flag("--version", std::string("ncdds ") + nc_version());
  app.add_option("--machine,--config", command.config, "machine configuration (TOML), as of ncrtd: takes the name from it")->check(nc::tools::given());
  app.add_option("--share", options.share, "name of the control, as ncrtd --share")->check(nc::tools::given());
  app.add_option("--domain", options.access.domain, "DDS domain")->transform(nc::tools::whole(0, 230));
  app.add_option("--security", options.access.security, "DDS Security: folder of an identity that nc-keys has made")->check(nc::tools::given());
  app.add_option("--network", options.access.network, "interface of the network, with --security; default: this computer only")->check(nc::tools::given());
  app.add_option("--rate", options.rate_hz, "status per second")->transform(nc::tools::whole(1, 100));
  app.add_flag("--commands", options.commands, "bring commands in (ncrtd must take them, too)");
  bool off = false;
  auto* socket = app.add_option("--services", options.socket, "socket of the services of ncrtd, when it is not where it usually is")->check(nc::tools::given());
  app.add_flag("--no-services", off, "no services over DDS")->excludes(socket);
  app.add_option("--ready-file", command.ready_file, "written when DDS is up")->check(nc::tools::given());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  options.services = !off;
  return nc::dds::gateway_command(command);
} catch (const std::exception& error) {  // mainly out of memory
  std::fprintf(stderr, "ncdds: %s\n", error.what());
  return 1;
}
