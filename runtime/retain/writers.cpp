// SPDX-License-Identifier: Apache-2.0
// See writers.hpp. A row of the file is a ChangedRow: key, "TIME BY", value.
#include "runtime/retain/writers.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

#include "runtime/retain/changed_rows.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"

namespace nc::rt {
namespace {

constexpr char kWritersHead[] = "nc writers 1";
constexpr char kMachineWrites[] = "machine";
constexpr std::size_t kRowBytes = 32;  // more than the time and the ends of the lines of a row

// Whether the rows of tables with this key belong to one part system: to which.
unsigned system_of_table(const std::string& key) {
  for (const std::string kind : {"work ", "parameter "})
    if (key.rfind(kind, 0) == 0 && key.size() > kind.size()) return std::min(static_cast<unsigned>(key[kind.size()] - '0'), unsigned{NC_MAX_SYSTEMS});
  return NC_MAX_SYSTEMS;
}

bool is_of_variable(const std::string& key) { return key.rfind("variable ", 0) == 0 || key.rfind("name ", 0) == 0; }

bool parse_writer(const std::string& text, Written* written) {
  const std::size_t space = text.find(' ');
  if (space == std::string::npos) return false;
  const auto result = std::from_chars(text.data(), text.data() + space, written->time_ns);
  written->by = text.substr(space + 1);
  return result.ec == std::errc{} && result.ptr == text.data() + space && !written->by.empty();
}

}  // namespace

bool WriterTable::Ran::any() const {
  return std::any_of(std::begin(by), std::end(by), [](const std::string& name) { return !name.empty(); });
}

// What part systems share may have been written by each of those that have run.
std::string WriterTable::Ran::of(unsigned system) const {
  if (system < NC_MAX_SYSTEMS && !by[system].empty()) return by[system];
  std::string all;
  for (const std::string& name : by)
    if (!name.empty() && all.find(name) == std::string::npos) all += (all.empty() ? "" : " or ") + name;
  return all.empty() ? kMachineWrites : all;
}

std::vector<WriterTable::Value> WriterTable::changed(const std::string& variables, const std::string& tables) {
  std::vector<Value> values;
  if (looked_ && tables != tables_)
    for (TableChange& change : changed_tables(tables_, tables))
      if (change.key.rfind("tap ", 0) != 0) values.push_back({change.key, change.is, system_of_table(change.key)});
  if (looked_ && variables != variables_)
    for (VariableWrite& write : written_variables(variables_, variables, local_)) values.push_back({write.key, write.value});
  looked_ = true;
  variables_ = variables;
  tables_ = tables;
  return values;
}

void WriterTable::look(const std::string& variables, const std::string& tables, const Ran& ran, std::int64_t time_ns) {
  const std::vector<Value> values = changed(variables, tables);
  if (values.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const Value& value : values) rows_[value.key] = {ran.of(value.system), time_ns, value.value};
  forget_oldest();
}

void WriterTable::look_behind_change(const std::string& variables, const std::string& tables) {
  const std::vector<Value> values = changed(variables, tables);
  const std::lock_guard lock(mutex_);
  for (const Value& value : values) rows_.erase(value.key);
}

// Both bounds, with some room so that it is not done for each further row.
void WriterTable::forget_oldest() {
  std::size_t bytes = 0;
  for (const auto& [key, written] : rows_) bytes += key.size() + written.by.size() + written.value.size() + kRowBytes;
  if (rows_.size() <= kMostRows && bytes <= kMostBytes) return;
  std::vector<Rows::iterator> oldest;
  for (auto row = rows_.begin(); row != rows_.end(); ++row) oldest.push_back(row);
  std::stable_sort(oldest.begin(), oldest.end(), [](Rows::iterator one, Rows::iterator other) { return one->second.time_ns < other->second.time_ns; });
  for (const Rows::iterator row : oldest) {
    if (rows_.size() <= kMostRows * 7 / 8 && bytes <= kMostBytes / 8 * 7) return;
    bytes -= row->first.size() + row->second.by.size() + row->second.value.size() + kRowBytes;
    rows_.erase(row);
  }
}

bool WriterTable::find(const std::string& key, Written* written) const {
  const std::lock_guard lock(mutex_);
  const auto found = rows_.find(key);
  if (found == rows_.end()) return false;
  *written = found->second;
  return true;
}

void WriterTable::keep(bool variables) {
  const std::lock_guard lock(mutex_);
  std::erase_if(kept_, [variables](const auto& row) { return is_of_variable(row.first) == variables; });
  for (const auto& row : rows_)
    if (is_of_variable(row.first) == variables) kept_.insert(row);
}

std::string WriterTable::encode() const {
  const std::lock_guard lock(mutex_);
  return encode(rows_);
}

std::string WriterTable::encode_kept() const {
  const std::lock_guard lock(mutex_);
  return encode(kept_);
}

std::string WriterTable::encode(const Rows& rows) {
  std::vector<ChangedRow> lines;
  for (const auto& [key, written] : rows) lines.push_back({key, std::to_string(written.time_ns) + " " + written.by, written.value});
  return encode_rows_of(kWritersHead, lines);
}

bool WriterTable::restore(const std::string& bytes) {
  std::vector<ChangedRow> rows;
  if (!decode_rows_of(kWritersHead, bytes, &rows)) return false;
  Rows read;
  for (const ChangedRow& row : rows) {
    Written written;
    if (!parse_writer(row.configured, &written)) return false;
    written.value = row.value;
    read[row.key] = std::move(written);
  }
  const std::lock_guard lock(mutex_);
  rows_ = std::move(read);
  forget_oldest();
  kept_ = rows_;
  return true;
}

std::string WriterData::why_refused(const std::string& bytes) const { return is_of_other_version(kWritersHead, bytes) ? kOtherVersion : RetainedData::why_refused(bytes); }

}  // namespace nc::rt
