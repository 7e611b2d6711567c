// SPDX-License-Identifier: Apache-2.0
// Writes the state of the runtime into the segment. It reads snapshots like any other reader, so the scan does
// not depend on it. It runs in one ordinary thread.
#pragma once

#include <string>

#include "runtime/runtime.hpp"
#include "runtime/share/alarm_log.hpp"
#include "runtime/share/block_text.hpp"
#include "runtime/share/layout.hpp"
#include "runtime/share/point_tap.hpp"
#include "runtime/share/program_table.hpp"

namespace nc::rt::share {

// The G codes in force: "G0 G17 G90".
std::string modal_text(const nc_control* control, const nc_modal& modal);

// The description of the machine, from its configuration.
MachineBlock machine_block(const Config& config, const std::string& name);

class Publisher final : private AlarmLog::Describer {
 public:
  // `tap` may be null (no points). `virtual_time`: the runtime's clock is not the time of day.
  Publisher(Runtime* runtime, const ProgramTable* programs, PointTap* tap, Segment* segment, bool virtual_time);
  // Writes the present state and wakes the readers.
  void publish();

 private:
  bool describe(const ActiveAlarm& alarm, Entry* entry) override;
  void fill_machine(const Snapshot& snapshot);
  void fill_system(unsigned index, const Snapshot& snapshot, const FeederInfo::System& info);
  void fill_run(const nc_outputs& nc, const FeederInfo::System& info, SystemStatus* out);
  void fill_block(unsigned index, const nc_outputs& nc, const FeederInfo::Selected& selected, SystemStatus* out);
  void fill_figures();
  void fill_alarms(const Snapshot& snapshot, const FeederInfo& info);
  void fill_points(const Snapshot& snapshot);
  void fill_signals();

  Runtime& runtime_;
  const Config& config_;
  const ProgramTable& programs_;
  PointTap* tap_;
  Segment& segment_;
  const bool virtual_time_;
  BlockText text_[NC_MAX_SYSTEMS];
  AlarmLog log_;
  FeederInfo info_;  // the info of this publication, for describe()
  std::uint64_t messages_ = 0;
  unsigned pictures_ = 0;
  StatusBlock status_{};
  PointsBlock points_{};
  SignalsBlock signals_{};
  hal::PointImage image_;
};

}  // namespace nc::rt::share
