// SPDX-License-Identifier: Apache-2.0
// Alarms of the runtime. Those of a program come from libnc with the manual's own codes; what the machine
// around the program does wrong has codes of ours, R and a number, in this table.
#pragma once

#include <cstdint>

#include "nc/item.h"

namespace nc::rt {

enum class AlarmId : std::uint8_t {
  kScanOverrun,
  kFollowingError,
  kDriveFault,
  kSoftLimit,
  kHalLost,
  kFinTimeout,
  kLadder,         // plc.alarm.1...; the texts are the configuration's
  kLadderStopped,
  kLinkLost,       // of a Modbus link with alarm = true
  kProgram,  // an alarm of libnc; code and text come from there
  kCount
};

struct AlarmRow {
  AlarmId id;
  const char* code;
  const char* text;
};

// Every alarm stops motion and holds the machine until reset, when its cause is gone.
inline constexpr AlarmRow kAlarmTable[] = {
    {AlarmId::kScanOverrun, "R10", "Scan overrun: the cycle was missed too often"},
    {AlarmId::kFollowingError, "R11", "Following error beyond its limit"},
    {AlarmId::kDriveFault, "R12", "Drive fault"},
    {AlarmId::kSoftLimit, "R13", "Commanded position outside the soft limits"},
    {AlarmId::kHalLost, "R14", "No connection to the machine"},
    {AlarmId::kFinTimeout, "R15", "FIN does not come"},
    {AlarmId::kLadder, "R16", "Alarm of the ladder"},
    {AlarmId::kLadderStopped, "R17", "The ladder program has stopped"},
    {AlarmId::kLinkLost, "R18", "Modbus link lost"},
    {AlarmId::kProgram, "", "Program alarm"},
};

constexpr const AlarmRow& alarm_row(AlarmId id) {
  for (const AlarmRow& row : kAlarmTable)
    if (row.id == id) return row;
  return kAlarmTable[0];
}

// One active alarm, as the scan raises it.
struct ActiveAlarm {
  AlarmId id = AlarmId::kCount;
  std::int8_t axis = -1;    // index in its part system, -1 = none
  std::uint8_t system = 0;  // index of the part system
  std::uint64_t scan = 0;   // when it came
  nc_source source{};       // block in execution at that moment
  std::uint32_t detail = 0; // R15: groups that wait (bit 0 M, 1 S, 2 T, 3 B); R16: number; R17: line; R18: link
  std::uint32_t code = 0;   // R15: the M code, or the T code when there is no M
};

inline constexpr unsigned kMaxActiveAlarms = 16;

struct AlarmList {
  unsigned count = 0;
  ActiveAlarm alarm[kMaxActiveAlarms];
};

}  // namespace nc::rt
