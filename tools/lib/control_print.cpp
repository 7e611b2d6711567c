// SPDX-License-Identifier: Apache-2.0
// See control_print.hpp.
#include "tools/lib/control_print.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <vector>

#include "runtime/programs/encoding.hpp"

namespace nc::tools {
namespace {

using Json = nlohmann::json;
using rt::services::ReplyRow;
using rt::services::Service;
using rt::services::ServiceRow;

std::string shown_number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string time_text(std::int64_t ns) {
  if (ns <= 0) return ns == 0 ? "-" : "?";
  const std::time_t seconds = static_cast<std::time_t>(ns / 1'000'000'000);
  std::tm local{};
  char text[32];
  if (localtime_r(&seconds, &local) == nullptr || std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local) == 0) return std::to_string(seconds);
  return text;
}

bool is_time(std::string_view key) { return key.size() > 3 && key.substr(key.size() - 3) == "_ns"; }

std::string value_text(std::string_view key, const Json& value) {
  if (value.is_string()) return terminal_text(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return is_time(key) ? time_text(value.get<std::int64_t>()) : value.dump();
  if (value.is_number()) return shown_number(value.get<double>());
  std::string text;
  if (value.is_array())
    for (const Json& element : value) {
      const bool pair = element.is_object() && element.contains("name") && element.contains("value");
      const bool single = element.is_object() && element.contains("name") && element.size() == 1;
      text += (text.empty() ? "" : " ") + (pair ? value_text("", element["name"]) + " " + value_text("", element["value"]) + (element.value("forced", false) ? kForcedMark : "") : value_text("", single ? element["name"] : element));
    }
  if (value.is_object())
    for (const auto& [name, member] : value.items()) text += (text.empty() ? "" : " ") + name + "=" + value_text(name, member);
  return text;
}

// The columns of a list: the members of its elements, in the order of the table of services.
std::vector<std::string> columns_of(const ServiceRow& row, std::string_view list) {
  std::vector<std::string> columns;
  const std::string prefix = std::string(list) + "[].";
  for (const ReplyRow& member : row.reply) {
    const std::string_view path = member.path;
    if (path.substr(0, prefix.size()) != prefix) continue;
    std::string name(path.substr(prefix.size()));
    name = name.substr(0, name.find("[]"));
    if (columns.empty() || columns.back() != name) columns.push_back(name);
  }
  return columns;
}

// The number of places that a text takes on a terminal: characters and not bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], width(row[c]));
    }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += row[c] + (c + 1 < row.size() ? std::string(widths[c] - width(row[c]) + 2, ' ') : "");
    text += "\n";
  }
  return text;
}

std::string list_text(const ServiceRow& row, const std::string& name, const Json& list) {
  const std::vector<std::string> columns = columns_of(row, name);
  if (columns.empty()) return name + "  " + value_text("", list) + "\n";
  std::vector<std::vector<std::string>> rows = {columns};
  for (const Json& element : list) {
    auto& cells = rows.emplace_back();
    for (const std::string& column : columns) cells.push_back(element.contains(column) ? value_text(column, element[column]) : "");
  }
  return table_text(rows);
}

std::string text_at(const Json& json, const char* key) { return json.contains(key) ? value_text(key, json[key]) : ""; }

std::string status_text(const Json& status) {
  std::string text = "mode " + text_at(status, "mode") + ", alarms " + text_at(status, "alarms") + ", warnings " + text_at(status, "warnings");
  const std::string control = text_at(status, "control");
  text += control.empty() ? ", nobody has control\n" : ", control: " + control + "\n";
  for (const Json& forced : status.value("forced", Json::array())) text += "forced " + text_at(forced, "device") + " = " + text_at(forced, "value") + "\n";
  const Json systems = status.value("systems", Json::array());
  for (const Json& system : systems) {
    if (systems.size() > 1) text += "part system " + text_at(system, "system") + "\n";
    text += text_at(system, "state_text") + "\n";
    const std::string program = text_at(system, "program");
    text += program.empty() ? "no program\n" : program + " line " + text_at(system, "line") + " (" + text_at(system, "percent") + " %): " + text_at(system, "block") + "\n";
    text += "feed " + text_at(system, "feed") + " mm/min, override " + text_at(system, "feed_override_percent") + " %, rapid " +
            text_at(system, "rapid_override_percent") + " %, S" + text_at(system, "s") + "\n";
    if (const std::string refusal = text_at(system, "refusal"); !refusal.empty()) text += refusal + "\n";
    std::vector<std::vector<std::string>> rows = {{"axis", "work", "machine", "to go"}};
    for (const Json& axis : system.value("axes", Json::array()))
      rows.push_back({text_at(axis, "name"), text_at(axis, "work"), text_at(axis, "machine"), text_at(axis, "to_go")});
    text += table_text(rows);
  }
  return text;
}

// Where each axis has to be, and where it is.
std::string axes_text(const Json& reply) {
  std::vector<std::vector<std::string>> axes = {{"axis", "place", "machine", "to go", ""}};
  for (const Json& axis : reply.value("axes", Json::array()))
    axes.push_back({text_at(axis, "name"), text_at(axis, "place"), text_at(axis, "machine"), text_at(axis, "to_go"), axis.value("away", false) ? "away" : ""});
  return table_text(axes);
}

// A program that is begun inside: what is to be done next, the place, and the two tables that an operator works through.
std::string restart_text(const Json& reply) {
  const std::string phase = text_at(reply, "phase"), what = text_at(reply, "text");
  const bool held = phase != "found" && phase != "stands" && reply.value("axes", Json::array()).size() > 0 && reply["axes"][0].contains("place");
  if (held) return "a feed hold: cycle start goes on from where the path has stopped\n" + axes_text(reply);
  if (phase == "none") return "no place has been looked for\n";
  if (phase == "ended") return "ended: " + what + "\n";
  if (phase == "lost") return "lost: " + what + ". No cycle start: look for the place again, or cancel it; then the program begins at its head\n";
  if (phase == "searching") return "searching: " + what + ", " + text_at(reply, "read") + " blocks so far\n";
  std::string text = phase == "found" ? "found: " + what + ". Cycle start comes to the place, and moves nothing\n" : "stands at the place: " + what + "\n";
  text += text_at(reply, "file") + " line " + text_at(reply, "line") + ", behind " + text_at(reply, "blocks") + " blocks\n" + text_at(reply, "modal") + "\n";
  if (const std::string asked = text_at(reply, "asked"); !asked.empty()) text += "the program has asked for: " + asked + "; it was answered with the present state\n";
  text += axes_text(reply);
  std::vector<std::vector<std::string>> codes = {{"entry", "code", "state"}};
  for (const Json& code : reply.value("codes", Json::array())) codes.push_back({text_at(code, "entry"), text_at(code, "code"), text_at(code, "state")});
  if (codes.size() > 1) text += table_text(codes);
  if (reply.value("left_out", 0) != 0) text += text_at(reply, "left_out") + " older M codes are not in the list\n";
  return text + (reply.value("open", 0) == 0 ? "nothing is open\n" : text_at(reply, "open") + " open: cycle start does not go on before they are given out or confirmed\n");
}

// One line for each entry, the newest last, as in a journal.
std::string history_text(const Json& reply) {
  std::vector<std::vector<std::string>> rows;
  const Json entries = reply.value("entries", Json::array());
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    const std::string kind = text_at(*entry, "kind");
    std::string who = text_at(*entry, "user");
    if (who.empty()) who = text_at(*entry, "client");
    std::string what;
    const auto add = [&what](const std::string& before, const std::string& text) {
      if (!text.empty()) what += (what.empty() ? "" : before) + text;
    };
    if (kind == "alarm") add("", entry->value("warning", false) ? "warning" : "");
    if (kind != "system") add(" ", text_at(*entry, "code"));
    add(" ", text_at(*entry, "service"));
    add(" ", text_at(*entry, "text"));
    add(", axis ", text_at(*entry, "axis"));
    if (const std::string program = text_at(*entry, "program"); !program.empty()) {
      const std::int64_t line = entry->value("line", std::int64_t{0});
      add(", ", program + (line == 0 ? "" : " line " + std::to_string(line)));
    }
    add(": ", text_at(*entry, "outcome"));
    const std::int64_t end = entry->value("end_ns", std::int64_t{0});
    if (kind == "run" && end > 0) add(", ", text_at(*entry, "seconds") + " s");
    if (kind == "alarm" || kind == "run") add(", ", end > 0 ? "until " + time_text(end) : end == 0 ? "until now" : "end not known");
    rows.push_back({text_at(*entry, "time_ns"), kind, who, what});
  }
  std::string text = table_text(rows);
  if (const std::uint64_t missing = reply.value("missing", std::uint64_t{0}); missing != 0) text += std::to_string(missing) + " entries are missing since ncrtd began\n";
  return text;
}

}  // namespace

std::string terminal_text(const std::string& text) { return rt::seen_text(text); }

std::string json_text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  for (std::string_view rest = plain; !rest.empty();) {
    const std::size_t unseen = rt::unseen_length(rest);
    if (unseen == 0) {
      text += rest[0];
      rest.remove_prefix(1);
      continue;
    }
    text += Json(std::string(rest.substr(0, unseen))).dump(-1, ' ', true).substr(1);  // as \u009b
    text.pop_back();
    rest.remove_prefix(unseen);
  }
  return text;
}

std::string status_line(const Json& status) {
  std::string text = text_at(status, "mode");
  for (const Json& system : status.value("systems", Json::array())) {
    text += "  " + text_at(system, "state") + " " + text_at(system, "program") + ":" + text_at(system, "line");
    for (const Json& axis : system.value("axes", Json::array())) text += " " + text_at(axis, "name") + text_at(axis, "work");
  }
  return text + "  alarms " + text_at(status, "alarms");
}

std::string reply_text(const ServiceRow& row, const Json& reply) {
  if (row.service == Service::kStatus) return status_text(reply);
  if (row.service == Service::kRestartStatus) return restart_text(reply);
  if (row.service == Service::kHistory) return history_text(reply);
  std::string text;
  for (const auto& [key, value] : reply.items()) {
    if (key == "next") continue;  // ncctl has fetched the rest already
    if (value.is_array()) text += list_text(row, key, value);
    else if (key == "text" && value.is_string()) text += value.get<std::string>().empty() ? "" : value_text(key, value) + "\n";
    else text += key + "  " + value_text(key, value) + "\n";
  }
  return text;
}

}  // namespace nc::tools
