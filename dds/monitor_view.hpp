// SPDX-License-Identifier: Apache-2.0
// The texts with which a monitor shows a control. They do not depend on DDS; monitor.cpp fills the view.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nc::dds {

struct AxisView {
  std::string name;
  bool rotary = false;
  double commanded = 0, actual = 0, work = 0, distance_to_go = 0, velocity = 0;
};

struct StatusView {
  unsigned part_system = 0;
  std::string machine;
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  std::string mode, run_state, stop_cause, state_text;
  bool resetting = false, single_block = false, optional_stop = false, program_ready = false, rapid = false;
  bool alarm = false, warning = false;
  unsigned refusals = 0;
  std::string refusal_cause = "none", refusal_text;
  double feed_override = 1, rapid_override = 1;
  std::string feed_override_source = "not known", rapid_override_source = "not known";
  bool spindle_measured = true;
  std::string program, file, block, modal;
  unsigned program_number = 0, sequence_number = 0, line = 0, depth = 0;
  unsigned main_line = 0, program_lines = 0, percent = 0;
  double feed = 0, feed_command = 0, spindle = 0, spindle_command = 0;
  unsigned m = 0, t = 0, b = 0, strobe = 0;
  std::uint64_t blocks = 0, runs = 0;
  bool last_run_ok = false;
  double path_length = 0, run_s = 0;
  std::vector<AxisView> axes;
  std::vector<std::uint32_t> interface_input, interface_output;
  std::uint64_t scans = 0, overruns = 0, missed_slots = 0;
  double execution_p50_us = 0, execution_p999_us = 0, execution_max_us = 0;
  double jitter_p50_us = 0, jitter_p999_us = 0, jitter_max_us = 0;
  std::uint64_t message_count = 0;
  std::string message;
  std::vector<std::pair<std::string, std::int64_t>> forced;  // devices of the ladder and the values at which they are held
};

struct AlarmView {
  std::uint64_t id = 0;
  unsigned part_system = 0;
  std::string code, text, axis;
  unsigned line = 0;
  std::int64_t raised_ns = 0;
  bool warning = false;
};

// One row of the table of signals, with its value.
struct SignalView {
  std::string name, direction, type;
  std::int64_t value = 0, safe = 0;
  bool good = true;
  std::string meaning, timing;
};

struct MonitorView {
  std::vector<SignalView> signals;  // filled when signals are watched
  std::uint64_t signals_scan = 0;
  std::map<unsigned, StatusView> systems;  // keyed by part system
  std::map<unsigned, AlarmView> alarms;  // keyed by slot
  bool alive = false;  // the scan runs and is published
  bool ended = false;  // the control has ended
};

// The text without control characters: texts from the network must not control the terminal.
std::string printable(const std::string& text);
// A line such as "P62 No feed command, axis X (line 7)".
std::string alarm_line(const AlarmView& alarm);
// A line such as "  43 %  line 27    X  -12.345 ...  F4800   S8000   T2    running".
std::string progress_line(const StatusView& status, const std::map<unsigned, AlarmView>& alarms);
// The whole status in several lines, for a terminal and for --once.
std::string page(const MonitorView& view);
// The table of signals with their values. `columns`: width of the terminal, 0 = one signal in each line, with its meaning.
std::string signal_page(const MonitorView& view, unsigned columns);
// The view as one line of JSON, with the alarms, and with the signals when they are watched.
std::string json_line(const MonitorView& view);

}  // namespace nc::dds
