// SPDX-License-Identifier: Apache-2.0
// See daemon_sharing.hpp.
#include "tools/lib/daemon_sharing.hpp"

#include <unistd.h>

#include <cstdio>
#include <vector>

#include "tools/lib/program_check.hpp"

namespace nc::tools {

namespace {

// The file of this name; where there is none, `O1000` is the program with this number, as for a call.
std::string path_of_program(const std::string& folder, const std::string& name) {
  const std::string path = folder + "/" + name;
  const bool number = name.size() > 1 && (name[0] == 'O' || name[0] == 'o') && name.find_first_not_of("0123456789", 1) == std::string::npos;
  if (!number || access(path.c_str(), F_OK) == 0) return path;
  const std::string found = ProgramFiles(folder).find(name);
  return found.empty() ? path : found;
}

}  // namespace

DaemonSharing::DaemonSharing(const DaemonOptions& options, const rt::Config& config, hal::Hal* machine)
    : config_(config),
      asked_(config.share.enabled || !options.share.empty()),
      wanted_(asked_ || options.command == DaemonOptions::Command::kServe),
      tap_(machine, config.points.size()),
      programs_(static_cast<nc_dialect>(config.nc.dialect)) {
  share_.name = !options.share.empty()        ? options.share
                : !config.share.name.empty() ? config.share.name
                                             : config.name;
  share_.commands = options.commands;
  share_.group = config.share.group;
  share_.virtual_time = options.fast;
  share_.local = config.services.enabled && options.command == DaemonOptions::Command::kServe;
}

bool DaemonSharing::prepare(rt::Runtime* runtime, ProgramFiles* files, const std::string& folder, std::string* error) {
  if (!wanted_) return true;
  files_ = files;
  // A called program has its name before its first block is executed, and one that is gone gives it to no blocks of MDI that get its place.
  files->set_watch([this](unsigned file, const std::string& path, const ProgramFiles::Text& text) { programs_.add_name(file, path, text); }, [this](unsigned file) { programs_.drop(file); });
  runtime->set_program_loader([this, runtime, folder](const std::string& name, unsigned* file, std::string* why) {
    const std::string path = path_of_program(folder, name);
    if (files_->add(runtime->control(), path, file, why) != NC_OK) {
      // The folder is removed from the text, because the client has given only a name in it.
      if (why->rfind(folder + "/", 0) == 0) why->erase(0, folder.size() + 1);
      return false;
    }
    programs_.add(*file, path, files_->text_of(*file));
    return true;
  });
  service_ = std::make_unique<rt::share::Service>(runtime, &programs_, &tap_, share_);
  if (service_->create(error)) {
    open_history(runtime);
    return open_services(runtime, error);
  }
  service_.reset();
  if (asked_) return false;
  std::fprintf(stderr, "warning: no shared memory, nothing for ncdds: %s\n", error->c_str());
  return true;
}

// Only a machine that is served has a history: it takes what operators do, and what runs on virtual time has no time of day.
void DaemonSharing::open_history(rt::Runtime* runtime) {
  if (!share_.local || share_.virtual_time) return;
  const rt::ServicesConfig& limits = config_.services;
  history_ = std::make_unique<rt::history::Recorder>(
      runtime, &programs_, config_.history_path(), rt::history::StoreLimits{limits.history_entries, limits.history_days, std::uint64_t{limits.history_mb} << 20}, [](const std::string& what) {
        std::fprintf(stderr, "warning: %s\n", what.c_str());
        std::fflush(stderr);
      });
  runtime->set_history(history_->tap());
}

// A socket that the configuration does not name may be missing; the services are then not there, which is said.
bool DaemonSharing::open_services(rt::Runtime* runtime, std::string* error) {
  if (!share_.local) return true;
  const std::string path = rt::services::socket_path(config_.services, share_.name);
  std::vector<std::string> unknown;
  const rt::services::RightGroups groups = rt::services::find_groups(config_.services, &unknown);
  for (const std::string& name : unknown) std::fprintf(stderr, "warning: [services]: there is no group \"%s\": nobody has a right by it\n", name.c_str());
  services_ = std::make_unique<rt::services::Services>(runtime, &programs_, service_->desk(), service_->segment(), history_.get());
  if (!share_.virtual_time) {
    checks_ = std::make_unique<rt::services::ProgramChecks>(config_, &programs_, [this, runtime](const rt::services::CheckOrder& order, const std::atomic<bool>& given_up) {
      return check_program(config_, machine_tables(runtime), order, given_up);
    });
    services_->set_checks(checks_.get());
    runtime->set_start_gate(checks_.get());
  }
  server_ = std::make_unique<rt::services::LocalServer>(services_.get(), share_.name, [groups, owner = geteuid()](const rt::services::Credentials& peer) {
    return rt::services::rights_of(peer, groups, owner);
  });
  std::string why = "neither RUNTIME_DIRECTORY nor XDG_RUNTIME_DIR says where, and [services] socket does not";
  if (!path.empty() && server_->open(path, &why)) {
    service_->desk()->set_local([this](const rt::share::Ack& ack) { server_->settled(ack); });
    why.clear();
    services_->open(&why);
    if (!why.empty()) std::fprintf(stderr, "warning: %s\n", why.c_str());
    return true;
  }
  server_.reset();
  runtime->set_start_gate(nullptr);
  checks_.reset();
  *error = "no services on a socket, nothing for ncctl: " + why;
  if (!config_.services.socket.empty()) return false;
  std::fprintf(stderr, "warning: %s\n", error->c_str());
  return true;
}

bool DaemonSharing::start(std::string* error) {
  if (history_ != nullptr && !history_->start(error)) return false;
  if (service_ == nullptr) return true;
  if (checks_ != nullptr && !checks_->start(error)) return false;
  return service_->start(error) && (server_ == nullptr || server_->start(error));
}

void DaemonSharing::stop() {
  if (server_ != nullptr) server_->stop();
  if (checks_ != nullptr) checks_->stop();
  if (service_ != nullptr) service_->stop();
}

void DaemonSharing::stop_history() {
  if (history_ != nullptr) history_->stop();
}

}  // namespace nc::tools
