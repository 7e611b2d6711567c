// SPDX-License-Identifier: Apache-2.0
// Converts the contents of the segment to the types of the IDL, and commands to requests.
#pragma once

#include "nc_dds.h"
#include "runtime/share/layout.hpp"

namespace nc::dds {

namespace share = nc::rt::share;

// Samples whose sequences point to members of the sample itself, so they must not be copied.
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

// True when a text has a NUL in its middle: the part after it would be lost unnoticed. The memory of the sample must be zero
// before DDS writes the sample into it.
bool has_hidden_text(const nc_Command& command);

// Values that are out of range in the command stay out of range in the request, so that Intake refuses it.
share::Request request(const nc_Command& command, const share::MachineBlock& machine, std::uint64_t writer,
                       std::int64_t issued_ns);

}  // namespace nc::dds
