// SPDX-License-Identifier: Apache-2.0
// See daemon_sharing.hpp.
#include "tools/lib/daemon_sharing.hpp"

#include <cstdio>

namespace nc::tools {

DaemonSharing::DaemonSharing(const DaemonOptions& options, const rt::Config& config, hal::Hal* machine)
    : asked_(config.share.enabled || !options.share.empty()),
      wanted_(asked_ || options.command == DaemonOptions::Command::kServe),
      tap_(machine, config.points.size()),
      programs_(static_cast<nc_dialect>(config.nc.dialect)) {
  share_.name = !options.share.empty()        ? options.share
                : !config.share.name.empty() ? config.share.name
                                             : config.name;
  share_.commands = options.commands;
  share_.group = config.share.group;
  share_.virtual_time = options.fast;
}

bool DaemonSharing::prepare(rt::Runtime* runtime, ProgramFiles* files, const std::string& folder, std::string* error) {
  if (!wanted_) return true;
  files_ = files;
  runtime->set_sink(this);
  runtime->set_program_loader([this, runtime, folder](const std::string& name, unsigned* file, std::string* why) {
    const std::string path = folder + "/" + name;
    if (files_->add(runtime->control(), path, file, why) != NC_OK) {
      // The folder is removed from the text, because the client has given only a name in it.
      if (why->rfind(folder + "/", 0) == 0) why->erase(0, folder.size() + 1);
      return false;
    }
    programs_.add(*file, path, files_->text_of(*file));
    return true;
  });
  service_ = std::make_unique<rt::share::Service>(runtime, &programs_, &tap_, share_);
  if (service_->create(error)) return true;
  service_.reset();
  if (asked_) return false;
  std::fprintf(stderr, "warning: no shared memory, nothing for ncdds: %s\n", error->c_str());
  return true;
}

void DaemonSharing::stop() {
  if (service_ != nullptr) service_->stop();
}

void DaemonSharing::executed(unsigned, const nc_event& event) {
  // An entry of the store may have got another program since the last time; entered() counts that.
  if (event.source.file == last_file_ && files_->entered() == last_entered_) return;
  last_file_ = event.source.file;
  last_entered_ = files_->entered();
  const std::string path = files_->path_of(event.source.file);
  if (!path.empty()) programs_.add_name(event.source.file, path, files_->text_of(event.source.file));
}

}  // namespace nc::tools
