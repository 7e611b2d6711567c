// SPDX-License-Identifier: Apache-2.0
// See shown.hpp.
#include "runtime/services/shown.hpp"

#include <algorithm>

#include "nc/run.h"
#include "runtime/command.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

template <std::size_t kSize>
std::string shown(const share::Text<kSize>& text) {
  return std::string(share::text_of(text));
}

const char* state_name(std::uint32_t state) {
  switch (state) {
    case NC_STATE_IDLE: return "idle";
    case NC_STATE_RUNNING: return "running";
    case NC_STATE_HOLD: return "hold";
    case NC_STATE_STOPPED: return "stopped";
    case NC_STATE_ALARM: return "alarm";
    case NC_STATE_MANUAL: return "manual";
    default: return "?";
  }
}

Json entry_json(const share::Entry& entry) {
  return {{"sequence", entry.sequence},   {"code", shown(entry.code)},           {"text", shown(entry.text)},
          {"axis", shown(entry.axis)},    {"system", entry.system + 1},          {"line", entry.line},
          {"warning", entry.is_warning != 0}, {"message", entry.is_message != 0}, {"raised_ns", entry.raised_ns},
          {"cleared_ns", entry.cleared_ns}};
}

Json axes_json(const share::SystemStatus& system, const std::array<share::AxisRow, NC_MAX_AXES>& rows) {
  Json axes = Json::array();
  for (unsigned a = 0; a < std::min<std::uint32_t>(system.axis_count, NC_MAX_AXES); ++a) {
    const share::AxisStatus& axis = system.axis[a];
    axes.push_back({{"name", shown(rows[a].name)},
                    {"machine", axis.commanded},
                    {"actual", axis.actual},
                    {"work", axis.work},
                    {"to_go", axis.distance_to_go},
                    {"velocity", axis.velocity}});
  }
  return axes;
}

Json system_json(const share::StatusBlock& status, unsigned s, const share::MachineBlock& machine) {
  const share::SystemStatus& system = status.system[s];
  Json json = {{"system", s + 1},
               {"state", state_name(system.run_state)},
               {"state_text", shown(system.state_text)},
               {"program", shown(system.program)},
               {"ready", system.program_ready != 0},
               {"file", shown(system.file)},
               {"line", system.line},
               {"block", shown(system.block)},
               {"main_line", system.main_line},
               {"lines", system.program_lines},
               {"percent", system.percent},
               {"runs", system.runs},
               {"run_s", system.run_s},
               {"modal", shown(system.modal)},
               {"m", system.m},
               {"t", system.t},
               {"s", system.s_commanded},
               {"feed", system.feed_mm_min},
               {"feed_commanded", system.feed_command_mm_min},
               {"feed_override_percent", 100 * system.feed_override},
               {"rapid_override_percent", 100 * system.rapid_override},
               {"single_block", (status.single_block >> s & 1u) != 0},
               {"optional_stop", (status.optional_stop >> s & 1u) != 0},
               {"message", shown(system.message)},
               {"refusal", shown(system.refusal_text)},
               {"axes", axes_json(system, machine.axis[s])}};
  if (system.spindle_measured != 0) json["spindle"] = system.spindle_rpm;
  return json;
}

}  // namespace

const char* mode_name(std::uint32_t mode) {
  switch (static_cast<Mode>(mode)) {
    case Mode::kAuto: return "auto";
    case Mode::kMdi: return "mdi";
    case Mode::kManual: return "manual";
  }
  return "?";
}

Json machine_json(const share::MachineBlock& machine) {
  Json systems = Json::array();
  for (unsigned s = 0; s < machine.system_count; ++s) {
    Json axes = Json::array();
    for (unsigned a = 0; a < machine.axis_count[s]; ++a) {
      const share::AxisRow& row = machine.axis[s][a];
      Json axis = {{"name", shown(row.name)}, {"rotary", row.rotary != 0}, {"max_velocity", row.max_velocity}};
      if (row.soft_limited != 0) axis["soft_limits"] = {row.soft_min, row.soft_max};
      axes.push_back(std::move(axis));
    }
    systems.push_back({{"axes", std::move(axes)}});
  }
  return {{"machine", shown(machine.machine)},
          {"control", shown(machine.share)},
          {"version", shown(machine.version)},
          {"cycle_us", machine.cycle_us},
          {"max_feed_override_percent", 100 * machine.max_feed_override},
          {"systems", std::move(systems)}};
}

Json status_json(const share::StatusBlock& status, const share::MachineBlock& machine, const std::string& control) {
  unsigned warnings = 0;
  const unsigned count = std::min(status.alarm_count, share::kAlarms);
  for (unsigned i = 0; i < count; ++i) warnings += status.alarm[i].is_warning != 0;
  Json forced = Json::array();
  for (unsigned i = 0; i < std::min(status.forced_count, share::kForced); ++i)
    forced.push_back({{"device", shown(status.forced[i].device)}, {"value", status.forced[i].value}});
  Json systems = Json::array();
  for (unsigned s = 0; s < status.system_count; ++s) systems.push_back(system_json(status, s, machine));
  return {{"scan", status.scan},
          {"time_ns", status.scan_time_ns},
          {"mode", mode_name(status.mode)},
          {"resetting", status.resetting != 0},
          {"alarms", count - warnings + status.alarms_left_out},
          {"warnings", warnings},
          {"control", control},
          {"forced", std::move(forced)},
          {"systems", std::move(systems)}};
}

Json alarms_json(const share::StatusBlock& status) {
  Json alarms = Json::array();
  for (unsigned i = 0; i < std::min(status.alarm_count, share::kAlarms); ++i) alarms.push_back(entry_json(status.alarm[i]));
  return {{"alarms", std::move(alarms)}, {"left_out", status.alarms_left_out}};
}

Json services_json() {
  Json services = Json::array();
  for (const ServiceRow& row : service_table()) {
    Json request = Json::array();
    for (const Wanted& wanted : row.request)
      request.push_back({{"name", row_of(wanted.field).name}, {"type", kind_name(row_of(wanted.field).kind)}, {"required", wanted.required}});
    services.push_back({{"name", row.name}, {"right", right_name(row.right)}, {"and_right", row.and_right ? right_name(*row.and_right) : ""}, {"meaning", row.meaning}, {"request", std::move(request)}});
  }
  return {{"services", std::move(services)}};
}

}  // namespace nc::rt::services
