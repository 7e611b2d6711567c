// SPDX-License-Identifier: Apache-2.0
// What readers see of the runtime: one consistent copy per scan, through a sequence lock.
#pragma once

#include <cstdint>

#include "nc/run.h"
#include "runtime/alarms.hpp"
#include "runtime/axes/equipment.hpp"
#include "runtime/command.hpp"
#include "runtime/refusal.hpp"

namespace nc::rt {

// A device of the ladder that is held at a value.
struct ForcedDevice {
  std::uint32_t number = 0;  // LadderTask::force_name() has its name
  std::int32_t value = 0;
};
struct ForceList {
  unsigned count = 0;
  ForcedDevice device[kMaxForces];
};

// Who sets the override that is in force (docs/signals.md, "Overrides").
enum class OverrideSource : std::uint8_t { kOperator = 0, kMachine = 1, kProgram = 2 };

constexpr const char* override_source_text(OverrideSource source) {
  return source == OverrideSource::kMachine ? "machine" : source == OverrideSource::kProgram ? "program" : "operator";
}

struct SystemSnapshot {
  nc_outputs nc{};         // what libnc commands
  nc_axes actual{};        // measured
  nc_spindle_inputs spindle[NC_MAX_SPINDLES] = {};  // measured
  AxisFlags axes;          // homed, on a limit switch, ...
  nc_axes begun{};         // commanded machine position where the program was started that is in execution, or that ran last
  std::uint32_t mirror = 0;  // nc_inputs::mirror, as a start would find it
  double tool_angle[2] = {0, 0};  // nc_inputs::tool_angle
  Refusal refusal;         // of what was asked for at the panel last
  double feed_override = 1, rapid_override = 1;  // in force: a machine may have a switch for each part system ...
  OverrideSource feed_override_source = OverrideSource::kOperator, rapid_override_source = OverrideSource::kOperator;  // ... and whose they are

  // The spindle that displays show: the one whose encoder is selected.
  const nc_spindle_inputs& shown_spindle() const { return spindle[nc.spindle_encoder == 0 ? 0 : nc.spindle_encoder - 1]; }
};

struct Snapshot {
  std::uint64_t scan = 0;    // number of the scan, from 1
  std::int64_t time_ns = 0;  // time on the scan's clock at its start
  std::int64_t clock_ms = 0;  // the machine's clock, as programs read it
  Mode mode = Mode::kAuto;
  unsigned system_count = 1;
  std::uint32_t single_block = 0, optional_stop = 0;  // set by the operator; one bit per part system
  bool resetting = false;
  bool reset_held = false;  // the reset is done, but plc.reset is still on
  std::uint64_t resets = 0;  // that are done
  AlarmList alarms;
  std::uint64_t overruns = 0;      // scans that ended after the end of their slot
  std::uint64_t missed_slots = 0;  // slots without a scan
  ForceList forces;
  std::uint32_t interface_input[NC_WORDS] = {};
  std::uint32_t interface_output[NC_WORDS] = {};
  SystemSnapshot system[NC_MAX_SYSTEMS];  // the last member, so that only the part systems that exist need be copied

  // Number of bytes that are copied between scan and readers when there are `systems` part systems.
  static constexpr std::size_t bytes(unsigned systems) {
    return sizeof(Snapshot) - (NC_MAX_SYSTEMS - systems) * sizeof(SystemSnapshot);
  }
  bool alarmed() const { return alarms.count != 0; }
  // True when an alarm stops the machine; a warning does not.
  bool stopped_by_alarm() const { return alarms.stops(); }
  // True when a program is in execution or interrupted.
  bool program_active() const {
    for (unsigned s = 0; s < system_count; ++s) {
      const auto state = system[s].nc.state;
      if (state == NC_STATE_RUNNING || state == NC_STATE_HOLD || state == NC_STATE_STOPPED) return true;
    }
    return false;
  }
};

}  // namespace nc::rt
