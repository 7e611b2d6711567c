// SPDX-License-Identifier: Apache-2.0
// One run of a program or of MDI, from cycle start to its end, an alarm, a reset or a signal, and its display.
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
  /** All of them must outlive the run, and the program must be selected already. */
  ProgramRun(rt::Runtime* runtime, const DaemonOptions& options, rt::Progress* progress, PrintLines* printed);

  /** Runs to the end. `selected`: the answer to the selection of the program. @return the exit status of ncrtd. */
  int to_end(rt::Answer selected);

  /** Code of the alarm that has stopped the run; empty = none has. */
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
  rt::Answer refused_ = rt::Answer::kDone;  // answer to the last attempt to continue a stop
  std::string alarm_code_;
  std::uint32_t last_line_ = 0;
  const unsigned looks_;  // number of looks within which the machine must come to rest; a look may be one scan
};

}  // namespace nc::tools
