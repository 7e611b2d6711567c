// SPDX-License-Identifier: Apache-2.0
// See alarm_entry.hpp.
#include "runtime/share/alarm_entry.hpp"

#include "runtime/alarm_message.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

// Takes code, axis and line out of a text such as "R11 Following error beyond its limit, axis X (line 7)", because they have fields of
// their own.
std::string without_place(std::string text, const std::string& code, const std::string& axis) {
  if (text.rfind(code + " ", 0) == 0) text.erase(0, code.size() + 1);
  if (const std::size_t line = text.rfind(" (line "); line != std::string::npos) text.erase(line);
  const std::string end = ", axis " + axis;
  if (!axis.empty() && text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0)
    text.erase(text.size() - end.size());
  return text;
}

}  // namespace

bool describe_alarm(const Runtime& runtime, const FeederInfo& info, const ActiveAlarm& alarm, Entry* entry) {
  const nc_system_config& system = runtime.config().nc.system[alarm.system];
  const auto axis_name = [&](int axis) {
    if (axis >= 0 && axis < static_cast<int>(system.axis_count)) set_text(&entry->axis, std::string(1, system.axis[axis].name));
  };
  const AlarmRow& row = alarm_row(alarm.id);
  entry->is_warning = is_warning(alarm.id);
  if (alarm.id != AlarmId::kProgram) {
    const std::string code = runtime.alarm_code(alarm.id);
    set_text(&entry->code, code);
    axis_name(alarm.axis);
    set_text(&entry->text, without_place(runtime.alarm_text(alarm), code, std::string(text_of(entry->axis))));
    return true;
  }
  set_text(&entry->text, row.text);
  if (!info.system[alarm.system].alarm) return false;
  const nc_alarm& details = info.system[alarm.system].program_alarm;
  set_text(&entry->code, details.code);
  set_text(&entry->text, alarm_message(details));
  if (details.source.line != 0) {
    entry->line = details.source.line;
    entry->program_number = details.source.program;
  }
  axis_name(details.axis);
  return true;
}

}  // namespace nc::rt::share
