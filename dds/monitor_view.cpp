// SPDX-License-Identifier: Apache-2.0
// Texts of the monitor. See monitor_view.hpp.
#include "dds/monitor_view.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "runtime/programs/encoding.hpp"

namespace nc::dds {
namespace {

__attribute__((format(printf, 2, 3))) void append(std::string* text, const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);  // measured first, because 1e308 with three decimals has 313 characters
  va_end(arguments);
  const std::size_t begin = text->size();
  text->resize(begin + static_cast<std::size_t>(std::max(length, 0)));
  std::vsnprintf(text->data() + begin, text->size() - begin + 1, format, again);
  va_end(again);
}

std::string time_text(std::int64_t ns) {
  const std::time_t seconds = static_cast<std::time_t>(ns / 1'000'000'000);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%H:%M:%S", &parts);
  return text;
}

nlohmann::json axis_json(const AxisView& axis) {
  return {{"name", axis.name},     {"rotary", axis.rotary},
          {"commanded", axis.commanded}, {"actual", axis.actual},
          {"work", axis.work},     {"distance_to_go", axis.distance_to_go},
          {"velocity", axis.velocity}};
}

nlohmann::json status_json(const StatusView& s) {
  nlohmann::json axes = nlohmann::json::array();
  for (const AxisView& axis : s.axes) axes.push_back(axis_json(axis));
  nlohmann::json forced = nlohmann::json::array();
  for (const auto& [device, value] : s.forced) forced.push_back({{"device", device}, {"value", value}});
  return {{"part_system", s.part_system},
          {"machine", s.machine},
          {"scan", s.scan},
          {"time_ns", s.time_ns},
          {"mode", s.mode},
          {"run_state", s.run_state},
          {"stop_cause", s.stop_cause},
          {"state_text", s.state_text},
          {"resetting", s.resetting},
          {"single_block", s.single_block},
          {"optional_stop", s.optional_stop},
          {"program_ready", s.program_ready},
          {"rapid", s.rapid},
          {"alarm", s.alarm},
          {"warning", s.warning},
          {"refusals", s.refusals},
          {"refusal_cause", s.refusal_cause},
          {"refusal_text", s.refusal_text},
          {"feed_override", s.feed_override},
          {"rapid_override", s.rapid_override},
          {"feed_override_source", s.feed_override_source},
          {"rapid_override_source", s.rapid_override_source},
          {"program", s.program},
          {"file", s.file},
          {"program_number", s.program_number},
          {"sequence_number", s.sequence_number},
          {"line", s.line},
          {"depth", s.depth},
          {"block", s.block},
          {"modal", s.modal},
          {"main_line", s.main_line},
          {"program_lines", s.program_lines},
          {"percent", s.percent},
          {"feed", s.feed},
          {"feed_command", s.feed_command},
          {"spindle", s.spindle},
          {"spindle_command", s.spindle_command},
          {"spindle_measured", s.spindle_measured},
          {"m", s.m},
          {"t", s.t},
          {"b", s.b},
          {"strobe", s.strobe},
          {"blocks", s.blocks},
          {"path_length", s.path_length},
          {"run_s", s.run_s},
          {"runs", s.runs},
          {"last_run_ok", s.last_run_ok},
          {"axes", axes},
          {"interface_input", s.interface_input},
          {"interface_output", s.interface_output},
          {"scans", s.scans},
          {"overruns", s.overruns},
          {"missed_slots", s.missed_slots},
          {"execution_us", {{"p50", s.execution_p50_us}, {"p99.9", s.execution_p999_us}, {"max", s.execution_max_us}}},
          {"jitter_us", {{"p50", s.jitter_p50_us}, {"p99.9", s.jitter_p999_us}, {"max", s.jitter_max_us}}},
          {"message_count", s.message_count},
          {"message", s.message},
          {"forced", forced}};
}

void append_place(std::string* text, const StatusView& s) {
  append(text, "  Program  %s", printable(s.program.empty() ? "-" : s.program).c_str());
  if (s.program_number != 0) append(text, "  O%u", s.program_number);
  if (s.sequence_number != 0) append(text, "  N%u", s.sequence_number);
  append(text, "  line %u", s.line);
  if (s.depth != 0) append(text, " of %s (call depth %u)", printable(s.file).c_str(), s.depth);
  append(text, "  %u %%\n", s.percent);
  append(text, "  Block    %s\n", printable(s.block).c_str());
  append(text, "  Modal    %s\n", printable(s.modal).c_str());
}

// The source of an override as text, such as " (machine)"; "" for the operator.
std::string by(const std::string& source) {
  return source == "machine" || source == "program" ? " (" + source + ")" : "";
}

void append_system(std::string* text, const StatusView& s) {
  append(text, "%s  part system %u  %s  %s (%s)%s%s%s\n", printable(s.machine).c_str(), s.part_system, s.mode.c_str(),
         s.run_state.c_str(), printable(s.state_text).c_str(), s.resetting ? "  RESET" : "",
         s.single_block ? "  SBK" : "", s.optional_stop ? "  OPT STOP" : "");
  append_place(text, s);
  append(text, "  %-6s %12s %12s %12s %12s\n", "", "work", "machine", "actual", "to go");
  for (const AxisView& axis : s.axes)
    append(text, "  %-4s %s %12.3f %12.3f %12.3f %12.3f\n", printable(axis.name).c_str(), axis.rotary ? "°" : " ",
           axis.work, axis.commanded, axis.actual, axis.distance_to_go);
  append(text, "  F %.0f of %.0f mm/min x %.0f %%%s   rapid %.0f %%%s   S ", s.feed, s.feed_command, 100 * s.feed_override,
         by(s.feed_override_source).c_str(), 100 * s.rapid_override, by(s.rapid_override_source).c_str());
  if (s.spindle_measured) append(text, "%.0f", s.spindle);
  else *text += "not measured";
  append(text, " of %.0f 1/min   T%u   M%u%s\n", s.spindle_command, s.t, s.m, s.strobe != 0 ? "   waits for FIN" : "");
  append(text, "  Run      %.1f s   %llu blocks   %.1f mm\n", s.run_s, static_cast<unsigned long long>(s.blocks),
         s.path_length);
  append(text, "  Scan     %llu   overruns %llu   slots missed %llu   execution p50 %.1f p99.9 %.1f max %.1f us\n",
         static_cast<unsigned long long>(s.scans), static_cast<unsigned long long>(s.overruns),
         static_cast<unsigned long long>(s.missed_slots), s.execution_p50_us, s.execution_p999_us, s.execution_max_us);
  if (s.message_count != 0) append(text, "  Message  %s\n", printable(s.message).c_str());
  if (!s.forced.empty()) {
    *text += "  FORCED  ";
    for (const auto& [device, value] : s.forced) *text += " " + printable(device) + " = " + std::to_string(value);
    *text += "\n";
  }
}

nlohmann::json signals_json(const MonitorView& view) {
  nlohmann::json rows = nlohmann::json::array();
  for (const SignalView& s : view.signals)
    rows.push_back({{"name", s.name},
                    {"direction", s.direction},
                    {"type", s.type},
                    {"value", s.value},
                    {"good", s.good},
                    {"safe", s.safe},
                    {"meaning", s.meaning},
                    {"timing", s.timing}});
  return {{"scan", view.signals_scan}, {"values", rows}};
}

}  // namespace

// ECMA-48: a terminal obeys the control characters C0, DEL and C1. C1 are U+0080 to U+009F, in UTF-8 two bytes of which the first is C2; a terminal without
// UTF-8 obeys the second byte alone.
std::string printable(const std::string& text) { return rt::seen_text(text); }

std::string alarm_line(const AlarmView& alarm) {
  std::string text = alarm.code.empty() ? alarm.text : alarm.code + " " + alarm.text;
  if (!alarm.axis.empty()) text += ", axis " + alarm.axis;
  if (alarm.line != 0) append(&text, " (line %u)", alarm.line);
  return printable(text);
}

std::string progress_line(const StatusView& s, const std::map<unsigned, AlarmView>& alarms) {
  std::string text;
  append(&text, "%3u %%  ", s.percent);
  if (s.depth == 0) append(&text, "line %-5u", s.line);
  else append(&text, "O%u:%-4u", s.program_number, s.line);
  for (const AxisView& axis : s.axes) append(&text, " %s%9.3f", printable(axis.name).c_str(), axis.work);
  append(&text, "  F%-6.0f S%-6.0f T%-3u ", s.feed, s.spindle, s.t);
  text += printable(s.state_text);
  if (!alarms.empty()) text += "  " + alarm_line(alarms.begin()->second);
  if (!s.block.empty() && alarms.empty()) text += "  " + printable(s.block);
  return text;
}

std::string page(const MonitorView& view) {
  std::string text;
  for (const auto& [number, status] : view.systems) append_system(&text, status);
  if (view.ended) text += "  THE CONTROL HAS ENDED: these are its last values\n";
  else if (!view.alive && !view.systems.empty())
    text += "  NO STATUS ANY MORE: ncdds is gone, or the scan stands still; these values are old\n";
  for (const auto& [number, status] : view.systems)
    if (!status.refusal_text.empty()) text += "  REFUSED  " + printable(status.refusal_text) + "\n";
  for (const auto& [slot, alarm] : view.alarms)
    text += (alarm.warning ? "  WARNING  " : "  ALARM    ") + time_text(alarm.raised_ns) + "  " + alarm_line(alarm) + "\n";
  if (view.alarms.empty()) text += "  no alarms\n";
  return text;
}

std::string signal_page(const MonitorView& view, unsigned columns) {
  constexpr unsigned kName = 26, kValue = 11, kColumn = kName + kValue + 4;
  std::string text;
  if (view.signals.empty()) return "  no signals have come yet\n";
  const unsigned in_line = columns == 0 ? 1 : std::max(1u, columns / kColumn);
  const std::size_t lines = (view.signals.size() + in_line - 1) / in_line;
  for (std::size_t line = 0; line < lines; ++line) {
    for (unsigned column = 0; column < in_line; ++column) {
      const std::size_t place = line + column * lines;
      if (place >= view.signals.size()) break;
      const SignalView& s = view.signals[place];
      const std::string name = printable(s.name);
      if (columns == 0)
        append(&text, "%-32s %-12s %-6s %11lld%s  %s\n", name.c_str(), s.direction.c_str(), s.type.c_str(),
               static_cast<long long>(s.value), s.good ? " " : "!", printable(s.meaning).c_str());
      else
        append(&text, "%-*s %*lld%s  ", kName, std::string(rt::cut_utf8(name, kName)).c_str(), kValue,
               static_cast<long long>(s.value), s.good ? " " : "!");
    }
    if (columns != 0) text += '\n';
  }
  return text;
}

std::string json_line(const MonitorView& view) {
  nlohmann::json systems = nlohmann::json::array(), alarms = nlohmann::json::array();
  for (const auto& [number, status] : view.systems) systems.push_back(status_json(status));
  for (const auto& [slot, alarm] : view.alarms)
    alarms.push_back({{"id", alarm.id},
                      {"part_system", alarm.part_system},
                      {"code", alarm.code},
                      {"text", alarm.text},
                      {"axis", alarm.axis},
                      {"line", alarm.line},
                      {"raised_ns", alarm.raised_ns},
                      {"warning", alarm.warning}});
  nlohmann::json all = {{"alive", view.alive}, {"ended", view.ended}, {"systems", systems}, {"alarms", alarms}};
  if (!view.signals.empty()) all["signals"] = signals_json(view);
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace nc::dds
