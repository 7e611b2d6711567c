// SPDX-License-Identifier: Apache-2.0
// See daemon_options.hpp.
#include "tools/lib/daemon_options.hpp"

#include "runtime/hal_factory.hpp"
#include "tools/lib/dialect_names.hpp"

namespace nc::tools {

std::string conflict_of(const DaemonOptions& options, const rt::Config& config) {
  if (options.commands && options.fast) return "--commands is for a machine in real time, not for --fast";
  // A machine that is served has shared memory in any case, so a configuration alone says nothing wrong.
  const bool begins = options.command == DaemonOptions::Command::kRun || options.command == DaemonOptions::Command::kMdi;
  if (begins && options.share.empty() && !config.share.enabled) {
    if (options.commands) return "--commands needs shared memory: --share NAME, or enabled = true in [share]";
    if (config.share.commands && !options.fast)
      return rt::ConfigError{config.file, config.share.commands_place.line, config.share.commands_place.key, "needs shared memory: enabled = true beside it, or --share NAME"}.text();
  }
  if (options.fast && config.machine_kind != nullptr && !config.machine_kind->no_virtual_time.empty())
    return "--fast cannot be: " + std::string(config.machine_kind->no_virtual_time) + " (hal = \"" + std::string(config.machine_kind->name) + "\")";
  return "";
}

bool change_dialect(const std::string& name, rt::Config* config) {
  const std::uint8_t dialect = static_cast<std::uint8_t>(*dialect_from_name(name));  // the command line accepts only known dialects
  if (config->nc.dialect == dialect) return false;
  config->nc.dialect = config->sim.dialect = dialect;
  if (config->parameters.empty()) return false;
  config->parameters.clear();
  return true;
}

}  // namespace nc::tools
