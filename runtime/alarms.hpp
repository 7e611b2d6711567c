// SPDX-License-Identifier: Apache-2.0
// Alarms of the runtime. The alarms of a program come from libnc with the codes of the manual. What goes wrong in the machine
// around the program has codes of this project, R and a number, and they stand in this table.
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
  kLadder,         // the ladder has switched on plc.alarm.1 ... .8; the text stands in the configuration
  kLadderStopped,
  kLinkLost,       // the link of a bus of points that has `alarm = true` in the configuration
  kRetainedLost,   // retained data could not be read back at the start
  kRetainedUnwritable,
  kBadInput,  // the detail of the alarm is nc_input_bits
  kPrinter,   // what a program prints (DPRNT) does not arrive
  kLimitSwitch,  // detail: LimitDetail
  kHoming,       // detail: HomingFault
  kPowerFails,   // detail: PowerDetail; code: PowerWatch::times()
  kPowerFailedBefore,  // the power failed in a program before this start
  kProgram,  // an alarm of libnc; code and text come from there
  kCount
};

struct AlarmRow {
  AlarmId id;
  const char* code;
  const char* text;
  // false = a warning: a running program goes on to its end, and nothing new starts until a reset acknowledges the warning.
  bool stops = true;
};

// An alarm that is not a warning stops the motion and keeps the machine stopped until a reset is made after its cause has gone.
inline constexpr AlarmRow kAlarmTable[] = {
    {AlarmId::kScanOverrun, "R10", "Scan overrun: the cycle was missed too often"},
    {AlarmId::kFollowingError, "R11", "Following error beyond its limit"},
    {AlarmId::kDriveFault, "R12", "Drive fault"},
    {AlarmId::kSoftLimit, "R13", "Commanded position outside the soft limits"},
    {AlarmId::kHalLost, "R14", "No connection to the machine"},
    {AlarmId::kFinTimeout, "R15", "FIN does not come"},
    {AlarmId::kLadder, "R16", "Alarm of the ladder"},
    {AlarmId::kLadderStopped, "R17", "The ladder program has stopped"},
    {AlarmId::kLinkLost, "R18", "Link lost"},
    {AlarmId::kRetainedLost, "R19", "Retained data lost", false},
    {AlarmId::kRetainedUnwritable, "R20", "Retained data are not kept", false},
    {AlarmId::kBadInput, "R21", "The machine gives a value that is no number or out of its range"},
    // Found behind the block, when the axes may be in a thread already, so the program comes to its end; the next one does not begin. Code
    // and short text are the family's (nc_alarm_role_get).
    {AlarmId::kPrinter, "", "lines of the external output are lost", false},
    {AlarmId::kLimitSwitch, "R22", "Limit switch"},
    {AlarmId::kHoming, "R23", "Homing has failed"},
    {AlarmId::kPowerFails, "R24", "The power fails"},
    {AlarmId::kPowerFailedBefore, "R25", "The power failed in a program", false},
    {AlarmId::kProgram, "", "Program alarm"},
};

constexpr const AlarmRow& alarm_row(AlarmId id) {
  for (const AlarmRow& row : kAlarmTable)
    if (row.id == id) return row;
  return kAlarmTable[0];
}

// A warning lets a program go on to its end; an alarm stops the machine. Both prevent the next start until a reset acknowledges them. After the
// reset an alarm whose cause is still there comes back at once. A warning whose cause is still there stays in the list as acknowledged: the
// machine can be used, and an operator who comes later still sees the warning.
constexpr bool is_warning(AlarmId id) { return !alarm_row(id).stops; }

// What has gone wrong with retained data (R19, R20). The `detail` of the alarm holds it together with the number of the data.
enum class RetainTrouble : std::uint8_t { kLost, kOlder, kNotKept, kUnwritable };
inline constexpr unsigned kRetainedData = 6;  // 0 devices of the ladder, 1 common variables, 2 offsets and parameters, 3 places in programs, 4 where programs have stopped, 5 names and pockets of tools
// The troubles of R19: something was lost in the past. The others are of R20, which describes a condition that lasts.
constexpr bool is_lost(RetainTrouble trouble) { return trouble == RetainTrouble::kLost || trouble == RetainTrouble::kOlder; }
constexpr unsigned retain_detail(unsigned data, RetainTrouble trouble) {
  return data * 4 + static_cast<unsigned>(trouble);
}

// Bits of the detail of R15: what is wrong with the handshake of FIN, and whether it concerns FIN1, FIN2 or both.
enum FinFault : std::uint32_t {
  kFinGroups = 0xf,    // mask of the groups that wait (bit 0 M, 1 S, 2 T, 3 B)
  kFinStays = 1 << 4,  // FIN has completed the codes and does not go off again
  kFinEarly = 1 << 5,  // FIN was on before the strobe came
  kFinOne = 1 << 6,    // FIN1 is on
  kFinTwo = 1 << 7,    // FIN2 is on
  // With one of these bits the control waits for the clamp of an index table (M700 9.3), not for a FIN:
  kNotUnclamped = 1 << 8,
  kNotClamped = 1 << 9,
  kNoClampHere = 1 << 10,  // the axis stands where it cannot be clamped
  kFinOwn = 1 << 11        // it is the FIN of the group itself (plc.mfin ...) that is on, and neither FIN1 nor FIN2
};

// Which limit switch of the axis (R22). Both at once: wiring.
enum LimitDetail : std::uint32_t { kLimitMinus = 1, kLimitPlus = 2, kBothLimits = 3 };

// One active alarm, as the scan raises it.
struct ActiveAlarm {
  AlarmId id = AlarmId::kCount;
  std::int8_t axis = -1;    // index in its part system, -1 = none
  std::uint8_t system = 0;  // index of the part system
  std::uint64_t scan = 0;   // when it came
  nc_source source{};       // block in execution at that moment
  std::uint32_t detail = 0; // R12: number of the spindle, from 1, 0 = an axis; R15: FinFault; R16: number; R17: line; R18: link; R19, R20: retain_detail(); R21: nc_input_bits; R22: LimitDetail; R23: HomingFault; R24: PowerDetail
  std::uint32_t code = 0;   // R15: the M code, or the T code when there is no M; ~0 = not given out yet; R12: hal/drive_fault.hpp; R24: PowerWatch::times(); R17: ladder::Fault
  bool acknowledged = false;  // a warning, or a limit switch, whose cause goes on: a reset has been made since, and it stops nothing any more
};

// What the machine does by an alarm, so which gives way when the list is full: an acknowledged one and a warning stop nothing, one that stops brings to rest on the path, at
// some the drives go off, and what the control does in a failure of the power goes on until its alarm is acknowledged.
constexpr unsigned alarm_weight(const ActiveAlarm& alarm) {
  if (alarm.id == AlarmId::kPowerFails) return 4;
  if (alarm.id == AlarmId::kDriveFault || alarm.id == AlarmId::kHalLost) return 3;
  if (!alarm_row(alarm.id).stops) return 1;
  return alarm.acknowledged ? 0 : 2;
}

inline constexpr unsigned kMaxActiveAlarms = 16;

struct AlarmList {
  unsigned count = 0;
  ActiveAlarm alarm[kMaxActiveAlarms];

  // At least one of them has not been acknowledged, so nothing new starts.
  bool waits_for_reset() const {
    for (unsigned i = 0; i < count; ++i)
      if (!alarm[i].acknowledged) return true;
    return false;
  }

  // At least one of them stops the machine.
  bool stops() const {
    for (unsigned i = 0; i < count; ++i)
      if (alarm_row(alarm[i].id).stops && !alarm[i].acknowledged) return true;
    return false;
  }
};

}  // namespace nc::rt
