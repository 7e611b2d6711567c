// SPDX-License-Identifier: Apache-2.0
// See last_changes.hpp.
#include "runtime/services/last_changes.hpp"

#include <iterator>
#include <span>
#include <string>

namespace nc::rt::services {
namespace {

using ListTable = TablePlace::Table;

std::string text_of_value(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// What is found of the values of a row, one after the other.
class RowChange {
 public:
  RowChange(const ChangeLog& log, const WriterTable* writers) : log_(log), writers_(writers) {}

  void look(const TablePlace& place, const Json& value) {
    // What a program has written goes before: a change through the services ends it.
    Written written;
    const bool known = writers_ != nullptr && writers_->find(retained_key(place), &written);
    if (known && same_value(place, text_of_value(value), written.value)) return take(written.by, written.time_ns);
    const ChangeLog::Last* last = log_.last_change_of(place);
    const bool stands = last != nullptr && same_value(place, text_of_value(value), last->after);
    // Part systems may share a variable, which is then changed in one of them.
    if (place.table == ListTable::kVariable && !stands)
      for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
        TablePlace other = place;
        other.system = s;
        const ChangeLog::Last* const there = log_.last_change_of(other);
        if (there != nullptr && same_value(other, text_of_value(value), there->after)) return take(there->user, there->time_ns);
      }
    if (last == nullptr && !known) return;
    if (!stands) by_program_ = true;
    else take(last->user, last->time_ns);
  }
  void add_to(Json* row) const {
    (*row)["changed_by"] = by_program_ ? kByProgram : user_;
    (*row)["changed_ns"] = by_program_ ? 0 : time_ns_;
  }

 private:
  void take(const std::string& user, std::int64_t time_ns) {
    if (time_ns < time_ns_) return;
    user_ = user;
    time_ns_ = time_ns;
  }
  const ChangeLog& log_;
  const WriterTable* const writers_;
  std::string user_;
  std::int64_t time_ns_ = 0;
  bool by_program_ = false;
};

void look_at_columns(ListTable table, std::span<const Field> columns, const Json& row, RowChange* found) {
  TablePlace place;
  place.table = table;
  place.number = row["number"].get<std::uint32_t>();
  for (unsigned c = 0; c < columns.size(); ++c) {
    place.column = c;
    if (const auto value = row.find(row_of(columns[c]).name); value != row.end()) found->look(place, *value);
  }
}

void look_at_offset(const Json& row, RowChange* found) {
  TablePlace place;
  place.table = ListTable::kOffset;
  place.system = row["system"].get<unsigned>() - 1;
  place.number = row["index"].get<std::uint32_t>();
  for (const Json& axis : row["axes"]) {
    place.axis = axis["name"].get_ref<const std::string&>()[0];
    found->look(place, axis["value"]);
  }
}

void look_at_variable(const Json& row, unsigned system, RowChange* found) {
  TablePlace place;
  place.table = ListTable::kVariable;
  place.system = system;
  place.number = row["number"].get<std::uint32_t>();
  found->look(place, row["value"]);
  place.table = ListTable::kVariableName;
  place.system = 0;
  found->look(place, row["name"]);
}

void look_at_parameter(const Json& row, RowChange* found) {
  TablePlace place;
  place.table = ListTable::kParameter;
  place.system = row["system"].get<unsigned>() - 1;
  place.key = row["key"].get<std::string>();
  place.axis = row["axis"].get_ref<const std::string&>().empty() ? '\0' : row["axis"].get_ref<const std::string&>()[0];
  found->look(place, row["value"]);
}

}  // namespace

void add_last_changes(const ChangeLog& log, const WriterTable* writers, Service list, unsigned system, Json* reply) {
  const char* const name = list == Service::kTools ? "tools" : list == Service::kLives ? "lives" : list == Service::kOffsets ? "offsets" : list == Service::kVariables ? "variables" : "parameters";
  for (Json& row : (*reply)[name]) {
    RowChange found(log, writers);
    switch (list) {
      case Service::kTools:
        look_at_columns(ListTable::kTool, kToolColumns, row, &found);
        look_at_columns(ListTable::kToolLabel, kLabelColumns, row, &found);
        break;
      case Service::kLives: look_at_columns(ListTable::kToolLife, kLifeColumns, row, &found); break;
      case Service::kOffsets: look_at_offset(row, &found); break;
      case Service::kVariables: look_at_variable(row, system, &found); break;
      default: look_at_parameter(row, &found); break;
    }
    found.add_to(&row);
  }
}

}  // namespace nc::rt::services
