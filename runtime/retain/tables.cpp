// SPDX-License-Identifier: Apache-2.0
// Offsets and parameters as text. See tables.hpp.
#include "runtime/retain/tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "runtime/nc_system.hpp"
#include "runtime/retain/changed_rows.hpp"

namespace nc::rt {
namespace {

constexpr char kHead[] = "nc tables 1";
constexpr unsigned kColumns = 4, kLifeColumns = NC_LIFE_AUXILIARY + 1;
constexpr unsigned kTapNumbers = 7;  // axis, entry, turns per mm, speed, acceleration, spindles, encoder
constexpr unsigned kPlainSets = 6, kExtended = 100;  // indices as nc_work_offset_set() counts: G54 to G59 are 1 to 6, G54.1P<n> is 100 + n
constexpr char kAllAxes = '-';

// The number as a text without an exponent, because nc_parameter_set() accepts none.
std::string plain(double value) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr;
  return {text, end};
}

bool parse(const std::string& text, double* value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, *value);
  return result.ec == std::errc{} && result.ptr == end && std::isfinite(*value);
}

void read_work_offsets(const nc_control* control, const nc_config& config, TableRows* rows) {
  double value = 0;
  for (unsigned s = 0; s < config.system_count; ++s)
    for (unsigned set = 0; set <= kPlainSets + config.work_offsets; ++set) {
      const unsigned index = set <= kPlainSets ? set : kExtended + set - kPlainSets;
      for (unsigned a = 0; a < config.system[s].axis_count; ++a)
        if (nc_work_offset_get(control, api_system(s), index, a, &value) == NC_OK && value != 0 && std::isfinite(value))
          (*rows)["work " + std::to_string(s) + " " + std::to_string(index) + " " + config.system[s].axis[a].name] = plain(value);
    }
}

void read_tool_offsets(const nc_control* control, TableRows* rows) {
  double value = 0;
  for (unsigned number = 1; nc_tool_offset_get(control, number, NC_TOOL_LENGTH, &value) == NC_OK; ++number)
    for (unsigned c = 0; c < kColumns; ++c)
      if (nc_tool_offset_get(control, number, static_cast<nc_tool_column>(c), &value) == NC_OK && value != 0 && std::isfinite(value))
        (*rows)["tool " + std::to_string(number) + " " + std::to_string(c)] = plain(value);
}

void read_parameters(const nc_control* control, const nc_config& config, TableRows* rows) {
  char key[24] = "", text[64] = "", axis = 0;
  double value = 0;
  for (unsigned s = 0; s < config.system_count; ++s)
    for (unsigned place = 0; nc_parameter_next(control, api_system(s), place, &place, key, &axis, &value, text) == NC_OK; ++place)
      if (text[0] != '\0' || std::isfinite(value))
        (*rows)["parameter " + std::to_string(s) + " " + (axis != 0 ? axis : kAllAxes) + " " + key] = text[0] != '\0' ? text : plain(value);
}

void read_tool_lives(const nc_control* control, TableRows* rows) {
  double value = 0;
  for (unsigned number = 1; number <= NC_TOOL_LIVES; ++number)
    for (unsigned c = 0; c < kLifeColumns; ++c)
      if (nc_tool_life_get(control, number, static_cast<nc_life_column>(c), &value) == NC_OK && value != 0 && std::isfinite(value))
        (*rows)["life " + std::to_string(number) + " " + std::to_string(c)] = plain(value);
}

// The tap that stands in a hole, or could.
void read_taps(const nc_control* control, const nc_config& config, TableRows* rows) {
  for (unsigned s = 0; s < config.system_count; ++s) {
    nc_tap tap = NC_INIT(nc_tap);
    if (nc_tap_get(control, api_system(s), &tap) != NC_OK || tap.axis == 0) continue;
    const double numbers[kTapNumbers] = {static_cast<double>(tap.axis), tap.entry, tap.turns_per_mm, tap.speed, tap.acceleration,
                                         static_cast<double>(tap.spindles), static_cast<double>(tap.encoder)};
    for (unsigned n = 0; n < kTapNumbers; ++n) (*rows)["tap " + std::to_string(s) + " " + std::to_string(n)] = plain(numbers[n]);
  }
}

std::string value_of(const TableRows& rows, const std::string& key) {
  const auto found = rows.find(key);
  if (found != rows.end()) return found->second;
  return key.rfind("parameter ", 0) == 0 ? "" : "0";
}

// What is counted of a tool decides which lives it may have, so that it changes while the tool has none; a life that the new one may have stays.
void apply_life_flags(nc_control* control, unsigned number, double flags) {
  double life = 0, used = 0;
  (void)nc_tool_life_get(control, number, NC_LIFE_LIFE, &life);
  (void)nc_tool_life_get(control, number, NC_LIFE_USED, &used);
  (void)nc_tool_life_set(control, number, NC_LIFE_LIFE, 0);
  (void)nc_tool_life_set(control, number, NC_LIFE_USED, 0);
  (void)nc_tool_life_set(control, number, NC_LIFE_FLAGS, flags);
  (void)nc_tool_life_set(control, number, NC_LIFE_LIFE, life);
  (void)nc_tool_life_set(control, number, NC_LIFE_USED, used);
}

// Writes one value into the control. A value that this control does not have is skipped. The flags of a life come before the life, as in the order of its columns.
void apply(nc_control* control, const nc_config& config, const std::string& key, const std::string& text) {
  std::istringstream words(key);
  std::string kind, number;
  unsigned first = 0, second = 0;
  char axis = 0;
  double value = 0;
  words >> kind >> first;
  if (kind == "work" && words >> second >> axis && first < config.system_count && parse(text, &value)) {
    for (unsigned a = 0; a < config.system[first].axis_count; ++a)
      if (config.system[first].axis[a].name == axis) (void)nc_work_offset_set(control, api_system(first), second, a, value);
  } else if (kind == "tool" && words >> second && second < kColumns && parse(text, &value)) {
    (void)nc_tool_offset_set(control, first, static_cast<nc_tool_column>(second), value);
  } else if (kind == "life" && words >> second && second < kLifeColumns && parse(text, &value)) {
    if (second == NC_LIFE_FLAGS) apply_life_flags(control, first, value);
    else (void)nc_tool_life_set(control, first, static_cast<nc_life_column>(second), value);
  } else if (kind == "parameter" && words >> axis >> number) {
    (void)nc_parameter_set(control, api_system(first), number.c_str(), axis == kAllAxes ? '\0' : axis, text.c_str());
  }
}

bool decode(const std::string& bytes, std::vector<ChangedRow>* changes) {
  if (!decode_rows_of(kHead, bytes, changes)) return false;
  for (const ChangedRow& change : *changes) {
    const auto begins = [&change](const char* kind) { return change.key.rfind(kind, 0) == 0; };
    double number = 0;
    if (!begins("parameter ") && !((begins("work ") || begins("tool ") || begins("life ") || begins("tap ")) && parse(change.value, &number))) return false;
  }
  return true;
}

// Gives back the taps, whose numbers belong together.
void apply_taps(nc_control* control, const nc_config& config, const std::vector<ChangedRow>& changes) {
  for (unsigned s = 0; s < config.system_count; ++s) {
    double numbers[kTapNumbers] = {};
    for (const ChangedRow& change : changes)
      for (unsigned n = 0; n < kTapNumbers; ++n)
        if (change.key == "tap " + std::to_string(s) + " " + std::to_string(n)) (void)parse(change.value, &numbers[n]);
    if (!(numbers[0] >= 1 && numbers[0] <= NC_MAX_AXES)) continue;
    nc_tap tap = NC_INIT(nc_tap);
    tap.axis = static_cast<std::uint8_t>(numbers[0]);
    tap.entry = numbers[1];
    tap.turns_per_mm = numbers[2];
    tap.speed = numbers[3];
    tap.acceleration = numbers[4];
    const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
    tap.spindles = byte(numbers[5]);  // an older file does not know them
    tap.encoder = byte(numbers[6]);
    (void)nc_tap_set(control, api_system(s), &tap);  // one that this machine cannot have is dropped
  }
}

}  // namespace

TableRows read_tables(const nc_control* control, const nc_config& config) {
  TableRows rows;
  read_work_offsets(control, config, &rows);
  read_tool_offsets(control, &rows);
  read_tool_lives(control, &rows);
  read_taps(control, config, &rows);
  read_parameters(control, config, &rows);
  return rows;
}

TableRows executed_tables(nc_control* control, const nc_config& config) {
  struct Look {
    const nc_config& config;
    TableRows rows;
  } look{config, {}};
  nc_look_executed(
      control,
      [](void* user, const nc_control* seen) {
        Look& to = *static_cast<Look*>(user);
        to.rows = read_tables(seen, to.config);
      },
      &look);
  return look.rows;
}

std::string table_text(const TableRows& rows) {
  std::string text;
  for (const auto& [key, value] : rows) text.append(key).append("=").append(value).append("\n");
  return text;
}

bool parse_tables(const std::string& text, TableRows* rows) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) return false;
    (*rows)[line.substr(0, sign)] = line.substr(sign + 1);
  }
  return true;
}

std::string encode_changes(const TableRows& now, const TableRows& configured) {
  TableRows all = configured;  // becomes the set of the keys of both tables
  all.insert(now.begin(), now.end());
  std::vector<ChangedRow> rows;
  for (const auto& [key, ignored] : all) {
    const std::string before = value_of(configured, key), value = value_of(now, key);
    if (value != before) rows.push_back({key, before, value});
  }
  return encode_rows_of(kHead, rows);
}

bool restore_changes(nc_control* control, const nc_config& config, const TableRows& configured, const std::string& bytes) {
  std::vector<ChangedRow> changes;
  if (!decode(bytes, &changes)) return false;
  for (const ChangedRow& change : changes)
    if (change.configured == value_of(configured, change.key)) apply(control, config, change.key, change.value);
  apply_taps(control, config, changes);
  return true;
}

std::string tables_without(const std::string& before, const std::string& after, const std::string& now) {
  TableRows was, left, rows;
  if (!parse_tables(before, &was) || !parse_tables(after, &left) || !parse_tables(now, &rows)) return now;
  TableRows all = was;  // becomes the set of the keys of both tables
  all.insert(left.begin(), left.end());
  for (const auto& [key, ignored] : all) {
    if (value_of(was, key) == value_of(left, key) || value_of(rows, key) != value_of(left, key)) continue;
    if (const auto old = was.find(key); old != was.end()) rows[key] = old->second;
    else rows.erase(key);
  }
  return table_text(rows);
}

std::vector<TableChange> changed_tables(const std::string& before, const std::string& after) {
  TableRows was, left;
  std::vector<TableChange> changes;
  if (!parse_tables(before, &was) || !parse_tables(after, &left)) return changes;
  TableRows all = was;  // becomes the set of the keys of both tables
  all.insert(left.begin(), left.end());
  for (const auto& [key, ignored] : all)
    if (value_of(was, key) != value_of(left, key)) changes.push_back({key, value_of(was, key), value_of(left, key)});
  return changes;
}

bool TableData::take(std::string* bytes) {
  std::string text;
  TableRows now;
  if (!feeder_.take(Feeder::kTables, &text) || !parse_tables(text, &now)) return false;
  *bytes = encode_changes(now, configured_);
  return true;
}

std::string TableData::why_refused(const std::string& bytes) const { return is_of_other_version(kHead, bytes) ? kOtherVersion : RetainedData::why_refused(bytes); }

}  // namespace nc::rt
