// SPDX-License-Identifier: Apache-2.0
// See gateway_command.hpp.
#include "dds/gateway_command.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <vector>

#include "runtime/config.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

Gateway* g_gateway = nullptr;
extern "C" void stop_gateway(int) {
  if (g_gateway != nullptr) g_gateway->stop();
}

int failed(const std::string& text) {
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
  return 1;
}

// Takes the name of the segment from the file of the configuration, in the same way as ncrtd.
bool read_config(const std::string& path, GatewayOptions* options) {
  rt::Config config;
  const std::vector<rt::ConfigError> errors = rt::load_config(path, &config);
  for (const rt::ConfigError& error : errors) std::fprintf(stderr, "%s\n", error.text().c_str());
  if (!errors.empty()) return false;
  if (options->share.empty()) options->share = config.share.name.empty() ? config.name : config.share.name;
  return true;
}

}  // namespace

int gateway_command(const GatewayCommand& command) {
  GatewayOptions options = command.gateway;
  if (!command.config.empty() && !read_config(command.config, &options)) return 1;
  if (options.share.empty()) return failed("which control? --machine FILE or --share NAME");
  std::string error;
  if (!may_access(options.access, options.commands, &error)) return failed(error);
  Gateway gateway(options);
  if (!gateway.open(&error)) return failed(error);
  g_gateway = &gateway;
  std::signal(SIGTERM, stop_gateway);
  std::signal(SIGINT, stop_gateway);
  if (!command.ready_file.empty() && !(std::ofstream(command.ready_file) << getpid() << '\n').flush())
    return failed("cannot write " + command.ready_file);
  gateway.run();
  g_gateway = nullptr;  // from here on a second signal has no effect
  return 0;
}

}  // namespace nc::dds
