// SPDX-License-Identifier: Apache-2.0
// The shared memory of ncrtd, if it is wanted, the programs that it shows, and the socket of the services, which need it.
#pragma once

#include <memory>
#include <string>

#include "runtime/history/recorder.hpp"
#include "runtime/runtime.hpp"
#include "runtime/services/local_server.hpp"
#include "runtime/share/service.hpp"
#include "tools/lib/daemon_options.hpp"
#include "tools/lib/program_files.hpp"

namespace nc::tools {

class DaemonSharing {
 public:
  DaemonSharing(const DaemonOptions& options, const rt::Config& config, hal::Hal* machine);

  /** The machine that the runtime gets: the tap of the shared memory if there is one, otherwise the machine itself. */
  hal::Hal* hal(hal::Hal* machine) { return wanted_ ? &tap_ : machine; }
  /** To be called before the start of the runtime. When the shared memory was not asked for, a failure is only a warning. */
  bool prepare(rt::Runtime* runtime, ProgramFiles* files, const std::string& folder, std::string* error);
  /** To be called after the start of the runtime. */
  bool start(std::string* error);
  void stop();
  /** Writes the end of the history. To be called after the runtime has stopped. */
  void stop_history();
  rt::share::ProgramTable& programs() { return programs_; }

 private:
  void open_history(rt::Runtime* runtime);
  bool open_services(rt::Runtime* runtime, std::string* error);

  const rt::Config& config_;
  const bool asked_, wanted_;  // asked for by option or configuration; a service wants it even without
  rt::share::PointTap tap_;
  rt::share::ServiceOptions share_;
  rt::share::ProgramTable programs_;
  ProgramFiles* files_ = nullptr;
  std::unique_ptr<rt::share::Service> service_;
  std::unique_ptr<rt::history::Recorder> history_;
  std::unique_ptr<rt::services::ProgramChecks> checks_;
  std::unique_ptr<rt::services::Services> services_;
  std::unique_ptr<rt::services::LocalServer> server_;
};

}  // namespace nc::tools
