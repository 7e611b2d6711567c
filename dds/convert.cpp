// SPDX-License-Identifier: Apache-2.0
// Conversions. See convert.hpp.
#include "dds/convert.hpp"

#include <algorithm>
#include <cstring>

#include "nc/run.h"
#include "runtime/refusal.hpp"
#include "runtime/share/text.hpp"
#include "runtime/snapshot.hpp"

namespace nc::dds {
namespace {

// Copies a text into a bounded string of the IDL, which ends with a NUL.
template <std::size_t kSize>
void set(char (&target)[kSize], std::string_view text) {
  share::Text<kSize> cut;
  share::set_text(&cut, text);
  std::memcpy(target, cut.data(), kSize);
}
template <std::size_t kSize, std::size_t kFrom>
void set(char (&target)[kSize], const share::Text<kFrom>& text) {
  set(target, share::text_of(text));
}

// Converts a value of the segment to an enumerator; a value that this IDL does not have becomes `other`.
template <class Enum>
Enum as_enum(std::uint32_t value, Enum last, Enum other) {
  return value <= static_cast<std::uint32_t>(last) ? static_cast<Enum>(value) : other;
}

double us(std::uint64_t ns) {
  return static_cast<double>(ns) / 1000.0;
}

// The number of alarms that stop the machine; the other entries are warnings.
std::uint32_t alarms_in(const share::StatusBlock& block) {
  return static_cast<std::uint32_t>(std::count_if(block.alarm.begin(), block.alarm.begin() + block.alarm_count,
                                                  [](const share::Entry& entry) { return entry.is_warning == 0; }));
}

// The switch has no default, so that the compiler reports a cause that libnc has and that is missing here. A cause of a later control is
// reported as another one.
nc_StopCause cause_of(std::uint32_t cause) {
  switch (static_cast<nc_stop_cause>(cause)) {
    case NC_CAUSE_NONE: return nc_CAUSE_NONE;
    case NC_CAUSE_FIN: return nc_CAUSE_FIN;
    case NC_CAUSE_DWELL: return nc_CAUSE_DWELL;
    case NC_CAUSE_IN_POSITION: return nc_CAUSE_IN_POSITION;
    case NC_CAUSE_PROGRAM_STOP: return nc_CAUSE_PROGRAM_STOP;
    case NC_CAUSE_SINGLE_BLOCK: return nc_CAUSE_SINGLE_BLOCK;
    case NC_CAUSE_FEED_HOLD: return nc_CAUSE_FEED_HOLD;
    case NC_CAUSE_INTERLOCK: return nc_CAUSE_INTERLOCK;
    case NC_CAUSE_OVERRIDE_ZERO: return nc_CAUSE_OVERRIDE_ZERO;
    case NC_CAUSE_STARVED: return nc_CAUSE_STARVED;
    case NC_CAUSE_ALARM: return nc_CAUSE_ALARM;
    case NC_CAUSE_FEED_ZERO: return nc_CAUSE_FEED_ZERO;
    case NC_CAUSE_SPINDLE_STOPPED: return nc_CAUSE_SPINDLE_STOPPED;
    case NC_CAUSE_SPINDLE_ANGLE: return nc_CAUSE_SPINDLE_ANGLE;
    case NC_CAUSE_SPINDLE_FAST: return nc_CAUSE_SPINDLE_FAST;
    case NC_CAUSE_SERVO_OFF: return nc_CAUSE_SERVO_OFF;
    case NC_CAUSE_TAP_SPINDLE: return nc_CAUSE_TAP_SPINDLE;
    case NC_CAUSE_SPINDLE_UNMEASURED: return nc_CAUSE_SPINDLE_UNMEASURED;
    case NC_CAUSE_NO_LAW: return nc_CAUSE_NO_LAW;
    case NC_CAUSE_RESET: return nc_CAUSE_RESET;
    case NC_CAUSE_SPINDLE_REVERSED: return nc_CAUSE_SPINDLE_REVERSED;
    case NC_CAUSE_TAP_IN_HOLE: return nc_CAUSE_TAP_IN_HOLE;
    case NC_CAUSE_MDI_ENDED: return nc_CAUSE_MDI_ENDED;
    case NC_CAUSE_MANUAL_FEED_ZERO: return nc_CAUSE_MANUAL_FEED_ZERO;
    case NC_CAUSE_RESTART: return nc_CAUSE_RESTART;
  }
  return nc_CAUSE_OTHER;
}

static_assert(static_cast<int>(nc_RUN_MANUAL) == NC_STATE_MANUAL && static_cast<int>(nc_RUN_ALARM) == NC_STATE_ALARM);
static_assert(static_cast<int>(nc_CMD_SELECT_PROGRAM) == static_cast<int>(share::RequestKind::kSelectProgram) &&
              static_cast<int>(nc_CMD_JOG) == static_cast<int>(share::RequestKind::kJog));
static_assert(static_cast<int>(nc_REFUSED_OTHER) == static_cast<int>(rt::RefusalCause::kOther) &&
              static_cast<int>(nc_REFUSED_INTERLOCK) == static_cast<int>(rt::RefusalCause::kInterlock) &&
              static_cast<int>(nc_REFUSED_NOT_LOADED) == static_cast<int>(rt::RefusalCause::kNotLoaded) &&
              static_cast<int>(nc_REFUSED_NO_ANSWER) == static_cast<int>(rt::RefusalCause::kNoAnswer) &&
              static_cast<int>(nc_REFUSED_DRIVES) == static_cast<int>(rt::RefusalCause::kDrives) &&
              static_cast<int>(nc_REFUSED_RESTART) == static_cast<int>(rt::RefusalCause::kLast) &&
              static_cast<int>(nc_REFUSED_SOFT_LIMIT) == static_cast<int>(rt::RefusalCause::kSoftLimit));
// The enumerators are greater by one than those of the runtime: a subscriber reads 0 from an older control that does not tell the source.
static_assert(static_cast<int>(nc_OVERRIDE_OPERATOR) == static_cast<int>(rt::OverrideSource::kOperator) + 1 &&
              static_cast<int>(nc_OVERRIDE_MACHINE) == static_cast<int>(rt::OverrideSource::kMachine) + 1 &&
              static_cast<int>(nc_OVERRIDE_PROGRAM) == static_cast<int>(rt::OverrideSource::kProgram) + 1);
nc_OverrideSource source_of(std::uint32_t source) {
  return source > static_cast<std::uint32_t>(rt::OverrideSource::kProgram) ? nc_OVERRIDE_NOT_KNOWN
                                                                           : static_cast<nc_OverrideSource>(source + 1);
}

static_assert(static_cast<int>(nc_ACK_FAILED) == static_cast<int>(share::AckState::kFailed));
static_assert(static_cast<int>(nc_REASON_CLIENT_IN_USE) == static_cast<int>(share::AckReason::kClientInUse));

}  // namespace

void MachineSample::fill(const share::MachineBlock& machine, const char* partition, bool commands) {
  set(info.machine, partition);
  set(info.name, machine.machine);
  set(info.version, machine.version);
  const char* const dialect = nc_dialect_name(static_cast<nc_dialect>(machine.dialect));
  set(info.dialect, dialect != nullptr ? dialect : "");  // "" = a later version of the control is running with a dialect that this version does not know
  info.part_systems = machine.system_count;
  info.cycle_us = machine.cycle_us;
  info.max_feed_override = machine.max_feed_override;
  info.commands = commands;
  std::uint32_t count = 0;
  for (unsigned s = 0; s < machine.system_count; ++s) {
    for (unsigned a = 0; a < machine.axis_count[s]; ++a) {
      const share::AxisRow& row = machine.axis[s][a];
      nc_AxisInfo& axis = axes[count++];
      axis.part_system = s + 1;
      set(axis.name, row.name);
      axis.rotary = row.rotary != 0;
      axis.soft_limited = row.soft_limited != 0;
      axis.soft_min = row.soft_min;
      axis.soft_max = row.soft_max;
      axis.max_velocity = row.max_velocity;
    }
  }
  info.axes = {NC_MAX_SYSTEMS * NC_MAX_AXES, count, axes, false};
}

void StatusSample::fill(const share::MachineBlock& machine, const share::StatusBlock& block, unsigned system,
                        const char* partition) {
  const share::SystemStatus& from = block.system[system];
  nc_Status& to = status;
  to.part_system = system + 1;
  set(to.machine, partition);
  to.scan = block.scan;
  to.time_ns = block.scan_time_ns;
  to.mode = as_enum(block.mode, nc_MODE_MANUAL, nc_MODE_AUTO);
  to.run_state = as_enum(from.run_state, nc_RUN_MANUAL, nc_RUN_IDLE);
  to.stop_cause = cause_of(from.stop_cause);
  set(to.state_text, from.state_text);
  to.resetting = block.resetting != 0;
  to.single_block = (block.single_block >> system & 1u) != 0;
  to.optional_stop = (block.optional_stop >> system & 1u) != 0;
  to.program_ready = from.program_ready != 0;
  to.rapid = from.rapid != 0;
  to.alarm = alarms_in(block) != 0;
  to.warning = alarms_in(block) != block.alarm_count;
  to.feed_override = from.feed_override;
  to.rapid_override = from.rapid_override;
  set(to.program, from.program);
  set(to.file, from.file);
  to.program_number = from.program_number;
  to.sequence_number = from.sequence_number;
  to.line = from.line;
  to.depth = from.depth;
  set(to.block, from.block);
  set(to.modal, from.modal);
  to.main_line = from.main_line;
  to.program_lines = from.program_lines;
  to.percent = from.percent;
  to.feed = from.feed_mm_min;
  to.feed_command = from.feed_command_mm_min;
  to.spindle = from.spindle_rpm;
  to.spindle_command = from.s_commanded;
  to.m = from.m;
  to.t = from.t;
  to.b = from.b;
  to.strobe = from.strobe;
  to.blocks = from.blocks;
  to.path_length = from.path_length;
  to.run_s = from.run_s;
  to.runs = from.runs;
  to.last_run_ok = from.last_run_ok != 0;
  for (unsigned a = 0; a < from.axis_count; ++a) {
    set(axes[a].name, machine.axis[system][a].name);
    axes[a].rotary = machine.axis[system][a].rotary != 0;
    axes[a].commanded = from.axis[a].commanded;
    axes[a].actual = from.axis[a].actual;
    axes[a].work = from.axis[a].work;
    axes[a].distance_to_go = from.axis[a].distance_to_go;
    axes[a].velocity = from.axis[a].velocity;
  }
  to.axes = {NC_MAX_AXES, from.axis_count, axes, false};
  std::copy(std::begin(block.interface_input), std::end(block.interface_input), input);
  std::copy(std::begin(block.interface_output), std::end(block.interface_output), output);
  to.interface_input = {NC_WORDS, NC_WORDS, input, false};
  to.interface_output = {NC_WORDS, NC_WORDS, output, false};
  const share::ScanFigures& figures = block.figures;
  to.figures = {figures.scans,
                figures.overruns,
                figures.missed_slots,
                us(figures.execution_p50_ns),
                us(figures.execution_p999_ns),
                us(figures.execution_max_ns),
                us(figures.jitter_p50_ns),
                us(figures.jitter_p999_ns),
                us(figures.jitter_max_ns)};
  to.message_count = from.message_count;
  set(to.message, from.message);
  for (unsigned i = 0; i < block.forced_count; ++i) {
    set(forced[i].device, block.forced[i].device);
    forced[i].value = block.forced[i].value;
  }
  to.forced = {share::kForced, block.forced_count, forced, false};
  to.refusals = from.refusals;
  to.refusal_cause = as_enum(from.refusal_cause, nc_REFUSED_RESTART, nc_REFUSED_OTHER);
  set(to.refusal_text, from.refusal_text);
  to.feed_override_source = source_of(from.feed_override_source);
  to.rapid_override_source = source_of(from.rapid_override_source);
  to.spindle_measured = from.spindle_measured != 0;
}

namespace {

nc_SignalDirection direction_of(const share::PointRow& point) {
  return point.is_input != 0 ? nc_SIGNAL_FROM_MACHINE : nc_SIGNAL_TO_MACHINE;
}
nc_SignalDirection direction_of(const share::SignalText& signal) {
  return signal.from_nc != 0 ? nc_SIGNAL_FROM_NC : nc_SIGNAL_TO_NC;
}
nc_SignalType type_of(const share::SignalText& signal) {
  return as_enum(signal.type, nc_SIGNAL_WORD32, nc_SIGNAL_WORD32);
}

}  // namespace

void SignalTableSample::fill(const share::MachineBlock& machine, const char* partition) {
  set(table.machine, partition);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < machine.signal_count; ++i) {
    const share::SignalText& from = machine.signal[i];
    nc_SignalInfo& to = rows[count++];
    set(to.name, from.name);
    to.direction = direction_of(from);
    to.type = type_of(from);
    to.safe = from.safe;
    set(to.meaning, from.meaning);
    set(to.timing, from.timing);
  }
  for (std::uint32_t p = 0; p < machine.point_count; ++p) {
    const share::PointRow& from = machine.point[p];
    nc_SignalInfo& to = rows[count++];
    set(to.name, from.name);
    to.direction = direction_of(from);
    to.type = from.is_word != 0 ? nc_SIGNAL_WORD32 : nc_SIGNAL_BIT;
    to.safe = from.safe;
    set(to.meaning, from.meaning);
    set(to.timing, "every scan");
  }
  table.signals = {nc::hal::kMaxPoints + share::kMaxSignals, count, rows, false};
}

void SignalSample::fill(const share::MachineBlock& machine, const share::PointsBlock& points,
                        const share::SignalsBlock& control_signals, const char* partition) {
  set(image.machine, partition);
  image.scan = points.scan;
  const std::uint32_t count = std::min(points.count, machine.point_count);
  for (std::uint32_t p = 0; p < count; ++p) {
    set(signals[p].name, machine.point[p].name);
    signals[p].is_input = machine.point[p].is_input != 0;
    signals[p].is_word = machine.point[p].is_word != 0;
    signals[p].value = points.value[p];
    signals[p].good = points.good[p] != 0;
  }
  image.signals = {nc::hal::kMaxPoints, count, signals, false};
  image.control_scan = control_signals.scan;
  const std::uint32_t controls = std::min(control_signals.count, machine.signal_count);
  for (std::uint32_t i = 0; i < controls; ++i) {
    set(control[i].name, machine.signal[i].name);
    control[i].direction = direction_of(machine.signal[i]);
    control[i].type = type_of(machine.signal[i]);
    control[i].value = control_signals.value[i];
  }
  image.control = {share::kMaxSignals, controls, control, false};
}

nc_Status_v1 core_status(const share::MachineBlock& machine, const share::StatusBlock& block, unsigned system,
                         const char* partition) {
  const share::SystemStatus& from = block.system[system];
  nc_Status_v1 to{};
  to.part_system = system + 1;
  set(to.machine, partition);
  to.scan = block.scan;
  to.time_ns = block.scan_time_ns;
  to.mode = block.mode;
  to.run_state = from.run_state;
  to.stop_cause = static_cast<std::uint32_t>(cause_of(from.stop_cause));
  set(to.program, from.program);
  to.program_number = from.program_number;
  to.line = from.line;
  to.percent = from.percent;
  to.feed_override = from.feed_override;
  to.rapid_override = from.rapid_override;
  to.feed = from.feed_mm_min;
  to.spindle = from.spindle_rpm;
  to.tool = from.t;
  to.axis_count = from.axis_count;
  std::string names;
  for (unsigned a = 0; a < from.axis_count; ++a) {
    names += share::text_of(machine.axis[system][a].name).substr(0, 1);
    to.commanded[a] = from.axis[a].commanded;
    to.actual[a] = from.axis[a].actual;
    to.work[a] = from.axis[a].work;
    to.distance_to_go[a] = from.axis[a].distance_to_go;
  }
  set(to.axis_names, names);
  to.alarm_count = alarms_in(block);
  return to;
}

namespace {

// Fills the members that all types of alarms have in common.
template <class T>
T entry_as(const share::Entry& entry, const char* partition) {
  T to{};
  to.id = entry.sequence;
  set(to.machine, partition);
  to.part_system = entry.system + 1;
  set(to.code, entry.code);
  set(to.text, entry.text);
  set(to.axis, entry.axis);
  to.line = entry.line;
  to.raised_ns = entry.raised_ns;
  return to;
}

}  // namespace

nc_Alarm alarm(const share::Entry& entry, std::uint32_t slot, const char* partition) {
  nc_Alarm to = entry_as<nc_Alarm>(entry, partition);
  to.slot = slot;
  to.program_number = entry.program_number;
  to.warning = entry.is_warning != 0;
  return to;
}

nc_Alarm_v1 core_alarm(const share::Entry& entry, std::uint32_t slot, const char* partition) {
  nc_Alarm_v1 to = entry_as<nc_Alarm_v1>(entry, partition);
  to.slot = slot;
  return to;
}

nc_AlarmHistory history(const share::Entry& entry, const char* partition) {
  nc_AlarmHistory to = entry_as<nc_AlarmHistory>(entry, partition);
  to.slot = static_cast<std::uint32_t>((entry.sequence - 1) % share::kHistory);
  to.message = entry.is_message != 0;
  to.program_number = entry.program_number;
  to.cleared_ns = entry.cleared_ns;
  to.warning = entry.is_warning != 0;
  return to;
}

nc_CommandAck ack(const share::Ack& ack) {
  nc_CommandAck to{};
  set(to.client, ack.client);
  to.seq = ack.sequence;
  to.kind = as_enum(ack.kind, nc_CMD_WRITE_DEVICE, nc_CMD_TAKE_CONTROL);
  to.state = as_enum(ack.state, nc_ACK_FAILED, nc_ACK_REJECTED);
  to.reason = as_enum(ack.reason, nc_REASON_CLIENT_IN_USE, nc_REASON_REFUSED);
  to.repeated = ack.repeated != 0;
  to.time_ns = ack.time_ns;
  set(to.text, ack.text);
  to.refusal = as_enum(ack.refusal, nc_REFUSED_RESTART, nc_REFUSED_OTHER);
  return to;
}

namespace {

template <std::size_t kSize>
bool goes_on_behind_nul(const char (&text)[kSize]) {
  const std::size_t length = strnlen(text, kSize);
  return std::any_of(text + length, text + kSize, [](char c) { return c != 0; });
}

}  // namespace

bool has_hidden_text(const nc_Command& command) {
  return goes_on_behind_nul(command.client) || goes_on_behind_nul(command.expected_program) ||
         goes_on_behind_nul(command.axis) || goes_on_behind_nul(command.text);
}

share::Request request(const nc_Command& command, const share::MachineBlock& machine, std::uint64_t writer,
                       std::int64_t issued_ns) {
  share::Request to{};
  share::set_text(&to.client, command.client);
  to.sequence = command.seq;
  to.writer = writer;
  to.issued_ns = issued_ns;
  // The kind is copied as a number, because it may not be one of the enumerators.
  static_assert(sizeof to.kind == sizeof command.kind);
  std::memcpy(&to.kind, &command.kind, sizeof to.kind);
  // The kinds that the gateway itself uses must not be sent from outside.
  if (to.kind > static_cast<std::uint32_t>(nc_CMD_WRITE_DEVICE))
    to.kind = static_cast<std::uint32_t>(share::RequestKind::kCount);
  to.lifespan_ms = command.lifespan_ms;
  to.lease_ms = command.lease_ms;
  to.expected_mode = command.expected_mode;
  to.expected_run_state = command.expected_run_state;
  share::set_text(&to.expected_program, command.expected_program);
  static_assert(share::kEverySystem == 0u - 1);
  to.system = command.part_system - 1;  // 0, all part systems, becomes kEverySystem
  to.axis = NC_MAX_AXES;
  if (to.system < machine.system_count)
    for (unsigned a = 0; a < machine.axis_count[to.system]; ++a)
      if (share::text_of(machine.axis[to.system][a].name) == command.axis) to.axis = a;
  to.number = command.number;
  to.value = command.value;
  share::set_text(&to.text, command.text);
  return to;
}

}  // namespace nc::dds
