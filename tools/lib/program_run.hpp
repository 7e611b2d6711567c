// SPDX-License-Identifier: Apache-2.0
// One run of a program or of MDI, from cycle start to its end, an alarm, a reset or a signal, with what is shown of it meanwhile.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/console.hpp"
#include "runtime/runtime.hpp"
#include "tools/lib/daemon_options.hpp"
#include "tools/lib/print_file.hpp"

namespace nc::tools {

class ProgramRun {
 public:
  /** All of them outlive the run; what to run is selected already. */
  ProgramRun(rt::Runtime* runtime, const DaemonOptions& options, rt::Progress* progress, PrintLines* printed);

  /** What `selected` was answered with, then the run. @return the exit status of ncrtd. */
  int to_end(rt::Answer selected);

  /** Of the alarm that has stopped the run; empty when none has. */
  const std::string& alarm_code() const { return alarm_code_; }

 private:
  int start_to_end();
  rt::Answer start_waiting();
  rt::Answer home_simulated();
  bool ended(int* status);
  void continue_stop(const rt::Snapshot& now);
  void wait();
  void rest();
  void show_message(const rt::FeederInfo& info);
  void show_again(const rt::FeederInfo& info);
  void show_printed();
  void show_summary(const nc_outputs& outputs) const;
  void note(const std::string& text);
  bool given_up(const rt::Snapshot& now);
  int stop_at_end(const rt::Snapshot& now);
  int stop_by_alarm();
  int stop_by_reset();
  int stop_by_signal();

  rt::Runtime& runtime_;
  const DaemonOptions& options_;
  rt::Progress& progress_;
  PrintLines& printed_;
  std::uint64_t messages_ = 0;
  bool said_again_ = false;
  unsigned idle_looks_ = 0;
  rt::Answer refused_ = rt::Answer::kDone;  // the last continuation of a stop
  std::string alarm_code_;
  std::uint32_t last_line_ = 0;
  const unsigned looks_;  // for the machine to come to rest; a look may be one scan
};

}  // namespace nc::tools
