// SPDX-License-Identifier: Apache-2.0
// Subscriber of status and alarms. See monitor.hpp.
#include "dds/monitor.hpp"

#include <chrono>
#include <ctime>
#include <thread>

#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr int kTaken = 32;

const char* mode_name(nc_Mode mode) {
  switch (mode) {
    case nc_MODE_AUTO: return "auto";
    case nc_MODE_MDI: return "MDI";
    case nc_MODE_MANUAL: return "manual";
    default: return "?";
  }
}

const char* state_name(nc_RunState state) {
  switch (state) {
    case nc_RUN_IDLE: return "idle";
    case nc_RUN_RUNNING: return "running";
    case nc_RUN_HOLD: return "hold";
    case nc_RUN_STOPPED: return "stopped";
    case nc_RUN_ALARM: return "alarm";
    case nc_RUN_MANUAL: return "manual";
    default: return "?";
  }
}

const char* cause_name(nc_StopCause cause) {
  switch (cause) {
    case nc_CAUSE_NONE: return "none";
    case nc_CAUSE_FIN: return "FIN";
    case nc_CAUSE_DWELL: return "dwell";
    case nc_CAUSE_IN_POSITION: return "in-position";
    case nc_CAUSE_PROGRAM_STOP: return "program stop";
    case nc_CAUSE_SINGLE_BLOCK: return "single block";
    case nc_CAUSE_FEED_HOLD: return "feed hold";
    case nc_CAUSE_INTERLOCK: return "interlock";
    case nc_CAUSE_OVERRIDE_ZERO: return "override 0";
    case nc_CAUSE_STARVED: return "starved";
    case nc_CAUSE_ALARM: return "alarm";
    case nc_CAUSE_FEED_ZERO: return "F1 to F5 is 0";
    case nc_CAUSE_SPINDLE_STOPPED: return "spindle stopped";
    case nc_CAUSE_SPINDLE_ANGLE: return "spindle angle";
    case nc_CAUSE_SPINDLE_FAST: return "thread too fast";
    case nc_CAUSE_SERVO_OFF: return "servo off";
    case nc_CAUSE_TAP_SPINDLE: return "spindle of a tap";
    case nc_CAUSE_SPINDLE_UNMEASURED: return "spindle not measured";
    case nc_CAUSE_NO_LAW: return "no motion within the limits";
    case nc_CAUSE_RESET: return "reset";
    case nc_CAUSE_SPINDLE_REVERSED: return "spindle turns the wrong way";
    case nc_CAUSE_TAP_IN_HOLE: return "tap in its hole";
    case nc_CAUSE_MDI_ENDED: return "MDI done";
    case nc_CAUSE_RESTART: return "restart";
    case nc_CAUSE_MANUAL_FEED_ZERO: return "manual feed 0";
    default: return "other";
  }
}

const char* refusal_name(nc_RefusalCause cause) {
  switch (cause) {
    case nc_REFUSED_NOT: return "none";
    case nc_REFUSED_MODE: return "mode";
    case nc_REFUSED_RUNNING: return "running";
    case nc_REFUSED_MIDDLE_OF_BLOCK: return "middle of block";
    case nc_REFUSED_NO_PROGRAM: return "no program";
    case nc_REFUSED_ALARM: return "alarm";
    case nc_REFUSED_RESETTING: return "resetting";
    case nc_REFUSED_ENDING: return "ending";
    case nc_REFUSED_SPINDLE: return "spindle";
    case nc_REFUSED_SOFT_LIMIT: return "soft limit";
    case nc_REFUSED_NOT_REPEATED: return "not repeated";
    case nc_REFUSED_NO_FEED: return "no feed";
    case nc_REFUSED_FEED_HOLD: return "feed hold";
    case nc_REFUSED_INTERLOCK: return "interlock";
    case nc_REFUSED_RESET_HELD: return "reset held";
    case nc_REFUSED_WARNING: return "warning";
    case nc_REFUSED_MACHINE_SWITCH: return "machine switch";
    case nc_REFUSED_RANGE: return "range";
    case nc_REFUSED_AXIS: return "axis";
    case nc_REFUSED_CONTROL: return "control";
    case nc_REFUSED_NOT_LOADED: return "not loaded";
    case nc_REFUSED_NO_DEVICE: return "no device";
    case nc_REFUSED_TOO_MANY: return "too many";
    case nc_REFUSED_NO_LADDER: return "no ladder";
    case nc_REFUSED_NO_ANSWER: return "no answer";
    case nc_REFUSED_LET_GO: return "let go first";
    case nc_REFUSED_TOO_FAR: return "too far";
    case nc_REFUSED_DRIVES: return "drives off";
    case nc_REFUSED_NOT_HOMED: return "not homed";
    case nc_REFUSED_HOMING: return "homing";
    case nc_REFUSED_LIMIT_SWITCH: return "limit switch";
    case nc_REFUSED_TAP_IN_HOLE: return "tap in its hole";
    case nc_REFUSED_MACHINE_LOCK: return "machine lock";
    case nc_REFUSED_RESTART: return "restart";
    default: return "other";
  }
}

const char* source_name(nc_OverrideSource source) {
  switch (source) {
    case nc_OVERRIDE_OPERATOR: return "operator";
    case nc_OVERRIDE_MACHINE: return "machine";
    case nc_OVERRIDE_PROGRAM: return "program";
    default: return "not known";
  }
}

const char* direction_name(nc_SignalDirection direction) {
  switch (direction) {
    case nc_SIGNAL_FROM_NC: return "from NC";
    case nc_SIGNAL_TO_NC: return "to NC";
    case nc_SIGNAL_FROM_MACHINE: return "from machine";
    case nc_SIGNAL_TO_MACHINE: return "to machine";
    default: return "?";
  }
}

const char* type_name(nc_SignalType type) {
  switch (type) {
    case nc_SIGNAL_BIT: return "bit";
    case nc_SIGNAL_WORD16: return "16 bit";
    case nc_SIGNAL_WORD32: return "32 bit";
    default: return "?";
  }
}

StatusView view_of(const nc_Status& s) {
  StatusView v;
  v.part_system = s.part_system;
  v.machine = s.machine;
  v.scan = s.scan;
  v.time_ns = s.time_ns;
  v.mode = mode_name(s.mode);
  v.run_state = state_name(s.run_state);
  v.stop_cause = cause_name(s.stop_cause);
  v.state_text = s.state_text;
  v.resetting = s.resetting;
  v.single_block = s.single_block;
  v.optional_stop = s.optional_stop;
  v.program_ready = s.program_ready;
  v.rapid = s.rapid;
  v.alarm = s.alarm;
  v.warning = s.warning;
  v.refusals = s.refusals;
  v.refusal_cause = refusal_name(s.refusal_cause);
  v.refusal_text = s.refusal_text;
  v.feed_override = s.feed_override;
  v.rapid_override = s.rapid_override;
  v.feed_override_source = source_name(s.feed_override_source);
  v.rapid_override_source = source_name(s.rapid_override_source);
  v.spindle_measured = s.spindle_measured;
  v.program = s.program;
  v.file = s.file;
  v.block = s.block;
  v.modal = s.modal;
  v.program_number = s.program_number;
  v.sequence_number = s.sequence_number;
  v.line = s.line;
  v.depth = s.depth;
  v.main_line = s.main_line;
  v.program_lines = s.program_lines;
  v.percent = s.percent;
  v.feed = s.feed;
  v.feed_command = s.feed_command;
  v.spindle = s.spindle;
  v.spindle_command = s.spindle_command;
  v.m = s.m;
  v.t = s.t;
  v.b = s.b;
  v.strobe = s.strobe;
  v.blocks = s.blocks;
  v.runs = s.runs;
  v.last_run_ok = s.last_run_ok;
  v.path_length = s.path_length;
  v.run_s = s.run_s;
  for (std::uint32_t a = 0; a < s.axes._length; ++a) {
    const nc_Axis& axis = s.axes._buffer[a];
    v.axes.push_back({axis.name, axis.rotary, axis.commanded, axis.actual, axis.work, axis.distance_to_go,
                      axis.velocity});
  }
  v.interface_input.assign(s.interface_input._buffer, s.interface_input._buffer + s.interface_input._length);
  v.interface_output.assign(s.interface_output._buffer, s.interface_output._buffer + s.interface_output._length);
  v.scans = s.figures.scans;
  v.overruns = s.figures.overruns;
  v.missed_slots = s.figures.missed_slots;
  v.execution_p50_us = s.figures.execution_p50_us;
  v.execution_p999_us = s.figures.execution_p999_us;
  v.execution_max_us = s.figures.execution_max_us;
  v.jitter_p50_us = s.figures.jitter_p50_us;
  v.jitter_p999_us = s.figures.jitter_p999_us;
  v.jitter_max_us = s.figures.jitter_max_us;
  v.message_count = s.message_count;
  v.message = s.message;
  for (std::uint32_t i = 0; i < s.forced._length; ++i)
    v.forced.emplace_back(s.forced._buffer[i].device, s.forced._buffer[i].value);
  return v;
}

}  // namespace

Monitor::Monitor(Access access, std::string machine, std::function<void(const std::string&)> tell)
    : access_(std::move(access)),
      partition_(machine.empty() ? "*" : machine),
      machine_(std::move(machine)),
      tell_(std::move(tell)),
      keeper_({access_.security, "shows nothing", [this](bool, std::string* error) { return make(error); },
               [this](SecuredPart* from, SecuredPart* to) { change(static_cast<MonitorLink*>(from), static_cast<MonitorLink*>(to)); },
               [this](const std::string& text, bool) {
                 if (opened_) tell_(text);
               }}) {}

std::unique_ptr<SecuredPart> Monitor::make(std::string* error) const {
  auto made = std::make_unique<MonitorLink>(partition_);
  if (!made->open(access_, signals_, error)) return nullptr;
  return made;
}

bool Monitor::open(std::string* error) {
  if (!access_.security.empty()) {
    opened_ = keeper_.open(false, error);
    return opened_;
  }
  open_link_ = std::make_unique<MonitorLink>(partition_);
  return open_link_->open(access_, signals_, error);
}

const MonitorLink* Monitor::link() const {
  return access_.security.empty() ? open_link_.get() : static_cast<const MonitorLink*>(keeper_.current());
}

bool Monitor::watch_signals(bool on, std::string* error) {
  signals_ = on;
  if (!on) view_.signals.clear();
  for (MonitorLink* one : {open_link_.get(), static_cast<MonitorLink*>(keeper_.current()), static_cast<MonitorLink*>(keeper_.next())})
    if (one != nullptr && !one->watch_signals(on, error)) return false;
  return true;
}

// What the readers of the new link have is all that is so now. The end of an alarm that came before they were there is not in it, and neither is the end of
// the status.
void Monitor::change(const MonitorLink* from, const MonitorLink* to) {
  if (from != nullptr) take(*from);
  alarms_of_.clear();
  view_.alarms.clear();
  if (to != nullptr) take(*to);
  if (!heard_ || (to != nullptr && MonitorLink::partners_of(to->status()) != 0)) return;
  view_.alive = false;
  ++changes_;
}

bool Monitor::wait(std::int64_t timeout_ns) {
  if (!access_.security.empty()) keeper_.look();
  const std::uint64_t before = changes_;
  if (const MonitorLink* current = link(); current != nullptr) {
    if (!current->wait(timeout_ns)) return changes_ != before;
    take(*current);
    return true;
  }
  std::this_thread::sleep_for(std::chrono::nanoseconds(timeout_ns));
  return false;
}

void Monitor::take(const MonitorLink& link) {
  while (take_status(link.status()) == kTaken) {}
  while (take_alarms(link.alarm()) == kTaken) {}
  if (link.signals() > 0) take_signals(link);
}

int Monitor::take_status(dds_entity_t reader) {
  void* samples[kTaken] = {};
  dds_sample_info_t infos[kTaken];
  const int count = dds_take(reader, samples, infos, kTaken, kTaken);
  for (int i = 0; i < count; ++i) {
    const auto& status = *static_cast<const nc_Status*>(samples[i]);
    const bool alive = infos[i].valid_data && infos[i].instance_state == DDS_IST_ALIVE;
    if (machine_.empty() && alive) {
      machine_ = status.machine;
      view_.systems.clear();
    }
    // Samples of several controls may come, but this monitor shows only one. The keys are valid even in a sample without data.
    if (!machine_.empty() && machine_ != status.machine) continue;
    if (alive) {
      view_.systems[status.part_system] = view_of(status);
      view_.alive = heard_ = true;
      view_.ended = false;
      latency_ns_ = nc::rt::share::wall_ns() - status.time_ns;
      ++samples_;
      ++changes_;
    } else if (infos[i].valid_data && (heard_ || infos[i].instance_state == DDS_IST_NOT_ALIVE_DISPOSED)) {
      view_.systems[status.part_system] = view_of(status);  // the last value of an instance that has already been disposed
    }
    if (infos[i].instance_state != DDS_IST_ALIVE && heard_) {
      view_.alive = false;
      view_.ended |= infos[i].instance_state == DDS_IST_NOT_ALIVE_DISPOSED;
      ++changes_;
    }
  }
  if (count > 0) (void)dds_return_loan(reader, samples, count);
  return count;
}

bool Monitor::gateway_there() const {
  const MonitorLink* current = link();
  return current != nullptr && MonitorLink::partners_of(current->status()) > 0;
}

int Monitor::take_alarms(dds_entity_t reader) {
  void* samples[kTaken] = {};
  dds_sample_info_t infos[kTaken];
  const int count = dds_take(reader, samples, infos, kTaken, kTaken);
  for (int i = 0; i < count; ++i) {
    const auto& alarm = *static_cast<const nc_Alarm*>(samples[i]);
    if (!machine_.empty() && machine_ != alarm.machine) continue;
    std::map<unsigned, AlarmView>& alarms = alarms_of_[alarm.machine];
    if (infos[i].instance_state != DDS_IST_ALIVE) {
      alarms.erase(alarm.slot);  // the keys are valid even without data
    } else if (infos[i].valid_data) {
      alarms[alarm.slot] = {alarm.id,   alarm.part_system, alarm.code,     alarm.text,
                            alarm.axis, alarm.line,        alarm.raised_ns, alarm.warning};
    }
  }
  if (!machine_.empty()) view_.alarms = alarms_of_[machine_];
  if (count > 0) (void)dds_return_loan(reader, samples, count);
  return count;
}

// The image has the values of the signals, and the table has their meanings. Until the table has come, only names and values are shown.
void Monitor::take_signals(const MonitorLink& link) {
  void* samples[1] = {};
  dds_sample_info_t infos[1];
  while (dds_take(link.signal_table(), samples, infos, 1, 1) > 0) {
    const auto& table = *static_cast<const nc_SignalTable*>(samples[0]);
    if (infos[0].valid_data && (machine_.empty() || machine_ == table.machine)) {
      signal_rows_.clear();
      for (std::uint32_t i = 0; i < table.signals._length; ++i) {
        const nc_SignalInfo& row = table.signals._buffer[i];
        signal_rows_[row.name] = {row.name, "", "", 0, row.safe, true, row.meaning, row.timing};
      }
    }
    (void)dds_return_loan(link.signal_table(), samples, 1);
    samples[0] = nullptr;
  }
  while (dds_take(link.signals(), samples, infos, 1, 1) > 0) {
    const auto& image = *static_cast<const nc_SignalImage*>(samples[0]);
    if (infos[0].valid_data && (machine_.empty() || machine_ == image.machine)) show_signals(image);
    (void)dds_return_loan(link.signals(), samples, 1);
    samples[0] = nullptr;
  }
}

void Monitor::show_signals(const nc_SignalImage& image) {
  view_.signals.clear();
  view_.signals_scan = image.scan;
  const auto add = [&](const char* name, const char* direction, const char* type, std::int64_t value, bool good) {
    const auto row = signal_rows_.find(name);
    SignalView view = row == signal_rows_.end() ? SignalView{} : row->second;
    view.name = name;
    view.direction = direction;
    view.type = type;
    view.value = value;
    view.good = good;
    view_.signals.push_back(std::move(view));
  };
  for (std::uint32_t i = 0; i < image.control._length; ++i) {
    const nc_ControlSignal& s = image.control._buffer[i];
    add(s.name, direction_name(s.direction), type_name(s.type), s.value, true);
  }
  for (std::uint32_t i = 0; i < image.signals._length; ++i) {
    const nc_Signal& s = image.signals._buffer[i];
    add(s.name, s.is_input ? "from machine" : "to machine", s.is_word ? "32 bit" : "bit", s.value, s.good);
  }
  ++changes_;
}

}  // namespace nc::dds
