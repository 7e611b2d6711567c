// SPDX-License-Identifier: Apache-2.0
// ncdds: the DDS gateway of a control. Reads the shared memory of ncrtd and publishes it; brings commands in
// when it is told to. It waits for ncrtd, and finds it again after a restart.
//
//   ncdds --machine FILE | --share NAME [--domain N] [--rate HZ] [--commands] [--ready-file FILE]
//
// It talks on this computer only (interface lo, no multicast) unless CYCLONEDDS_URI says otherwise.
// Exit status: 0 ended by SIGTERM or SIGINT, 1 usage, configuration, or DDS that does not come up.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>

#include "dds/gateway.hpp"
#include "nc/control.h"
#include "runtime/config.hpp"
#include "runtime/share/text.hpp"
#include "tools/lib/option_values.hpp"

namespace {

nc::dds::Gateway* g_gateway = nullptr;
extern "C" void on_signal(int) {
  if (g_gateway != nullptr) g_gateway->stop();
}

int failed(const std::string& text) {
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
  return 1;
}

// The name of the segment as ncrtd takes it from the same file.
bool read_config(const std::string& path, nc::dds::GatewayOptions* options) {
  nc::rt::Config config;
  const std::vector<nc::rt::ConfigError> errors = nc::rt::load_config(path, &config);
  for (const nc::rt::ConfigError& error : errors) std::fprintf(stderr, "%s\n", error.text().c_str());
  if (!errors.empty()) return false;
  if (options->share.empty()) options->share = config.share.name.empty() ? config.name : config.share.name;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"ncdds: publishes a control over DDS"};
  nc::dds::GatewayOptions options;
  std::string config, ready_file;
  app.set_version_flag("--version", std::string("ncdds ") + nc_version());
  app.add_option("--machine,--config", config, "machine configuration (TOML), as of ncrtd: takes the name from it")->check(nc::tools::given());
  app.add_option("--share", options.share, "name of the control, as ncrtd --share")->check(nc::tools::given());
  app.add_option("--domain", options.domain, "DDS domain")->transform(nc::tools::whole(0, 230));
  app.add_option("--rate", options.rate_hz, "status per second")->transform(nc::tools::whole(1, 100));
  app.add_flag("--commands", options.commands, "bring commands in (ncrtd must take them, too)");
  app.add_option("--ready-file", ready_file, "written when DDS is up")->check(nc::tools::given());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  if (!config.empty() && !read_config(config, &options)) return 1;
  if (options.share.empty()) return failed("which control? --machine FILE or --share NAME");

  nc::dds::Gateway gateway(options);
  std::string error;
  if (!gateway.open(&error)) return failed(error);
  g_gateway = &gateway;
  std::signal(SIGTERM, on_signal);
  std::signal(SIGINT, on_signal);
  if (!ready_file.empty() && !(std::ofstream(ready_file) << getpid() << '\n').flush())
    return failed("cannot write " + ready_file);
  gateway.run();
  return 0;
}
