// SPDX-License-Identifier: Apache-2.0
// See gateway_command.hpp.
#include "dds/gateway_command.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <vector>

#include "dds/gateway_keeper.hpp"
#include "runtime/config.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

Gateway* g_gateway = nullptr;
GatewayKeeper* g_keeper = nullptr;
extern "C" void stop_gateway(int) {
  if (g_gateway != nullptr) g_gateway->stop();
  if (g_keeper != nullptr) g_keeper->stop();
}
extern "C" void look_at_files(int) {
  if (g_keeper != nullptr) g_keeper->look_now();
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
  if (options->socket.empty()) options->socket = config.services.socket;
  return true;
}

void catch_end() {
  std::signal(SIGTERM, stop_gateway);
  std::signal(SIGINT, stop_gateway);
}

bool write_ready(const std::string& file) {
  return file.empty() || (std::ofstream(file) << getpid() << '\n').flush();
}

int run_secured(const GatewayOptions& options, const std::string& ready_file) {
  GatewayKeeper keeper(options);
  std::string error;
  if (!keeper.open(&error)) return failed(error);
  g_keeper = &keeper;
  catch_end();
  if (!write_ready(ready_file)) return failed("cannot write " + ready_file);
  keeper.run();
  g_keeper = nullptr;
  return 0;
}

}  // namespace

int gateway_command(const GatewayCommand& command) {
  GatewayOptions options = command.gateway;
  if (!command.config.empty() && !read_config(command.config, &options)) return 1;
  if (options.share.empty()) return failed("which control? --machine FILE or --share NAME");
  std::string error;
  if (!may_access(options.access, options.commands, &error)) return failed(error);
  std::signal(SIGHUP, look_at_files);
  if (!options.access.security.empty()) return run_secured(options, command.ready_file);
  Gateway gateway(options);
  if (!gateway.open(&error)) return failed(error);
  g_gateway = &gateway;
  catch_end();
  if (!write_ready(command.ready_file)) return failed("cannot write " + command.ready_file);
  gateway.run();
  g_gateway = nullptr;  // from here on a second signal has no effect
  return 0;
}

}  // namespace nc::dds
