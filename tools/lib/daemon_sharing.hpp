// SPDX-License-Identifier: Apache-2.0
// The shared memory of ncrtd, where it is asked for, and what it shows of the programs.
#pragma once

#include <memory>
#include <string>

#include "runtime/runtime.hpp"
#include "runtime/share/service.hpp"
#include "tools/lib/daemon_options.hpp"
#include "tools/lib/program_files.hpp"

namespace nc::tools {

/** Must outlive the runtime, which reports to it. */
class DaemonSharing final : public rt::EventSink {
 public:
  DaemonSharing(const DaemonOptions& options, const rt::Config& config, hal::Hal* machine);

  /** The machine as the runtime is to see it: through the tap of the shared memory where there is one. */
  hal::Hal* hal(hal::Hal* machine) { return wanted_ ? &tap_ : machine; }
  /** Before the start of the runtime. Without having been asked for it, failure is a warning. */
  bool prepare(rt::Runtime* runtime, ProgramFiles* files, const std::string& folder, std::string* error);
  /** Behind it. */
  bool start(std::string* error) { return service_ == nullptr || service_->start(error); }
  void stop();
  rt::share::ProgramTable& programs() { return programs_; }

  /** Thread of the feeder, to which the files belong: a sub program gets its name when its first block is done. */
  void executed(unsigned system, const nc_event& event) override;

 private:
  const bool asked_, wanted_;  // a service shows itself where it can
  rt::share::PointTap tap_;
  rt::share::ServiceOptions share_;
  rt::share::ProgramTable programs_;
  ProgramFiles* files_ = nullptr;
  unsigned last_file_ = ~0u;
  std::uint64_t last_entered_ = 0;
  std::unique_ptr<rt::share::Service> service_;
};

}  // namespace nc::tools
