// SPDX-License-Identifier: Apache-2.0
// From the segment to the types of the IDL, and commands back.
#pragma once

#include "nc_dds.h"
#include "runtime/share/layout.hpp"

namespace nc::dds {

namespace share = nc::rt::share;

// Samples whose sequences point into themselves: filled and written, never copied.
struct MachineSample {
  nc_MachineInfo info{};
  nc_AxisInfo axes[NC_MAX_SYSTEMS * NC_MAX_AXES] = {};
  void fill(const share::MachineBlock& machine, const char* partition, bool commands);
};

struct StatusSample {
  nc_Status status{};
  nc_Axis axes[NC_MAX_AXES] = {};
  std::uint32_t input[NC_WORDS] = {}, output[NC_WORDS] = {};
  nc_ForcedDevice forced[share::kForced] = {};
  void fill(const share::MachineBlock& machine, const share::StatusBlock& block, unsigned system,
            const char* partition);
};

struct SignalTableSample {
  nc_SignalTable table{};
  nc_SignalInfo rows[nc::hal::kMaxPoints + share::kMaxSignals] = {};
  void fill(const share::MachineBlock& machine, const char* partition);
};

struct SignalSample {
  nc_SignalImage image{};
  nc_Signal signals[nc::hal::kMaxPoints] = {};
  nc_ControlSignal control[share::kMaxSignals] = {};
  void fill(const share::MachineBlock& machine, const share::PointsBlock& points,
            const share::SignalsBlock& control_signals, const char* partition);
};

nc_Status_v1 core_status(const share::MachineBlock& machine, const share::StatusBlock& block, unsigned system,
                         const char* partition);
nc_Alarm alarm(const share::Entry& entry, std::uint32_t slot, const char* partition);
nc_Alarm_v1 core_alarm(const share::Entry& entry, std::uint32_t slot, const char* partition);
nc_AlarmHistory history(const share::Entry& entry, const char* partition);
nc_CommandAck ack(const share::Ack& ack);

// A text with a NUL in its middle: what stands behind it would be lost without a word. The sample has to be zero
// before it is read.
bool has_hidden_text(const nc_Command& command);

// What is out of range in DDS's terms becomes out of range in the segment's: Intake refuses it.
share::Request request(const nc_Command& command, const share::MachineBlock& machine, std::uint64_t writer,
                       std::int64_t issued_ns);

}  // namespace nc::dds
