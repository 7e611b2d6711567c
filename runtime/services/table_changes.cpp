// SPDX-License-Identifier: Apache-2.0
// See table_changes.hpp.
#include "runtime/services/table_changes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "runtime/services/parameter_rehearsal.hpp"
#include "runtime/services/refusals.hpp"
#include "runtime/services/table_toml.hpp"
#include "runtime/services/tables.hpp"
#include "runtime/toml_reader.hpp"

namespace nc::rt::services {
namespace {

using Table = TablePlace::Table;

constexpr std::size_t kNamed = 4;  // values that a change names one by one

// What the job in the feeder thread has been given and has found. The job may outlive the one who waits for it, so both own this.
struct ValueJob {
  std::vector<TableValue> wanted;
  std::vector<std::string> expected;  // the values that must be there now; empty = any
  const nc_config* config = nullptr;
  ToolLabelTable* labels = nullptr;
  std::vector<ValueChange> done;
  Outcome outcome = Outcome::refused(Refused::kFailed, "?");
};

// The tables that a change reads and writes. The labels are a copy, which takes the place of all when the change is whole.
struct Tables {
  nc_control* control;
  const nc_config& config;
  ToolLabels labels;

  Outcome read(const TablePlace& place, std::string* value) const {
    return place.table == Table::kToolLabel ? read_label(labels, config, place, value) : read_value(control, config, place, value);
  }
  Outcome write(const TablePlace& place, const std::string& value) {
    return place.table == Table::kToolLabel ? write_label(&labels, config, place, value) : write_value(control, config, place, value);
  }
};

std::string shown(const std::string& value) { return value.empty() ? "nothing" : value; }

// Values of one row may bind one another (9000 mounts cannot become minutes before they are 100), so that no order of them is right for every change: what is refused
// is tried again behind the others, as long as that helps.
Refusals write_in_any_order(Tables* tables, std::vector<TableValue> pending) {
  for (;;) {
    std::vector<TableValue> rest;
    Refusals refusals;
    for (const TableValue& value : pending) {
      const Outcome written = tables->write(value.place, value.value);
      if (written.ok) continue;
      refusals.add(value, written);
      rest.push_back(value);
    }
    if (rest.empty() || rest.size() == pending.size()) return refusals;
    pending = std::move(rest);
  }
}

// Writes the values that were there before.
void give_back(Tables* tables, const std::vector<ValueChange>& all) {
  std::vector<TableValue> before;
  for (auto value = all.rbegin(); value != all.rend(); ++value) before.push_back({value->place, value->before});
  (void)write_in_any_order(tables, std::move(before));
}

// What is there now, in the order of what is wanted. False when a place does not exist, or is not as it is expected.
bool read_all(const Tables& tables, ValueJob* job, std::vector<ValueChange>* all) {
  Refusals refusals;
  for (std::size_t i = 0; i < job->wanted.size(); ++i) {
    const TableValue& wanted = job->wanted[i];
    ValueChange change{wanted.place, "", wanted.value};
    if (const Outcome read = tables.read(wanted.place, &change.before); !read.ok) {
      refusals.add(wanted, read);
    } else if (!job->expected.empty() && !same_value(wanted.place, change.before, job->expected[i])) {
      job->outcome = Outcome::refused(Refused::kState, place_text(wanted.place) + " was changed since: it is " + shown(change.before) + ", and not " + shown(job->expected[i]));
      return false;
    }
    all->push_back(std::move(change));
  }
  if (!refusals.empty()) job->outcome = refusals.outcome();
  return refusals.empty();
}

// Those of the values that have brought a tool into the pocket of another one. They are looked at when all are written, so that two tools can change places.
Refusals taken_pockets(const ToolLabels& labels, const std::vector<TableValue>& wanted) {
  Refusals refusals;
  for (const TableValue& value : wanted) {
    if (value.place.table != Table::kToolLabel || value.place.column != kPocketColumn) continue;
    if (const unsigned other = other_in_pocket(labels, value.place.number); other != 0)
      refusals.add(value, Outcome::refused(Refused::kState, "pocket " + value.value + " has " + tool_text(labels, other)));
  }
  return refusals;
}

// Those of the values that have given a variable the name of another one: a program that asks by the name would find one of the two. They are looked at when all are written,
// so that two variables can change names.
Refusals taken_names(const nc_control* control, const std::vector<TableValue>& wanted) {
  Refusals refusals;
  const auto names_one = [](const TableValue& value) { return value.place.table == Table::kVariableName && !value.value.empty(); };
  if (std::none_of(wanted.begin(), wanted.end(), names_one)) return refusals;
  nc_variable_range named{};
  (void)nc_variable_kind_get(nc_control_dialect(control), NC_VARIABLES_NAMED, &named);
  std::multimap<std::string, std::uint32_t> by_name;
  char name[8] = "";
  for (std::uint32_t number = named.first; number != 0 && number <= named.last; ++number)
    if (nc_variable_name_get(control, number, name) == NC_OK && name[0] != 0) by_name.emplace(name, number);
  for (const TableValue& value : wanted) {
    if (!names_one(value)) continue;
    const auto [first, last] = by_name.equal_range(value.value);
    for (auto other = first; other != last; ++other)
      if (other->second != value.place.number) refusals.add(value, Outcome::refused(Refused::kState, "#" + std::to_string(other->second) + " has the name " + value.value));
  }
  return refusals;
}

// In the feeder thread.
void write_all(nc_control* control, ValueJob* job) {
  Tables tables{control, *job->config, job->labels->read()};
  std::vector<ValueChange> all;
  if (!read_all(tables, job, &all)) return;
  Refusals refusals = write_in_any_order(&tables, job->wanted);
  if (refusals.empty()) refusals = taken_pockets(tables.labels, job->wanted);
  if (refusals.empty()) refusals = taken_names(control, job->wanted);
  if (!refusals.empty()) {
    give_back(&tables, all);
    job->outcome = refusals.outcome();
    return;
  }
  for (ValueChange& change : all) {
    std::string now;
    (void)tables.read(change.place, &now);
    if (change.place.table == Table::kParameter) {
      if (!now.empty()) change.after = now;  // as the control writes it: "1" for "1.0"
    } else if (!same_value(change.place, now, change.after)) {
      job->outcome = Outcome::refused(Refused::kMalformed, place_text(change.place) + " is shared by part systems, and is given twice with different values");
      give_back(&tables, all);
      return;
    }
  }
  job->labels->replace(std::move(tables.labels));
  job->done = std::move(all);
  job->outcome = Outcome::done();
}

// Executes a change of these values; *done gets what it has done. Names and pockets of tools hurt no program, so they can be set while one is in execution.
Outcome change_values(Runtime* runtime, std::vector<TableValue> wanted, std::vector<std::string> expected, std::vector<ValueChange>* done) {
  auto job = std::make_shared<ValueJob>();
  job->wanted = std::move(wanted);
  job->expected = std::move(expected);
  job->config = &runtime->config().nc;
  job->labels = runtime->tool_labels();
  const bool labels_only = std::all_of(job->wanted.begin(), job->wanted.end(), [](const TableValue& value) { return value.place.table == Table::kToolLabel; });
  ControlJob write = [job](nc_control* control) { write_all(control, job.get()); };
  const Answer answer = labels_only ? runtime->look(std::move(write)) : runtime->change(std::move(write));
  if (answer != Answer::kDone) return refused_by(*runtime, answer);
  *done = std::move(job->done);
  return std::move(job->outcome);
}

std::string joined(const std::vector<ValueChange>& values, std::string (*text)(const ValueChange&)) {
  std::string all;
  for (const ValueChange& value : values) all += (all.empty() ? "" : ", ") + text(value);
  return all;
}

// "12 tool offsets, 1 work offset"
std::string counts(const std::vector<ValueChange>& values) {
  constexpr const char* kNames[] = {"tool offset", "work offset", "common variable", "name of a variable", "parameter", "entry of tool life", "name or pocket of a tool"};  // in the order of Table
  constexpr const char* kMany[] = {"tool offsets", "work offsets", "common variables", "names of variables", "parameters", "entries of tool life", "names and pockets of tools"};
  std::array<unsigned, std::size(kNames)> count{};
  for (const ValueChange& value : values) ++count[static_cast<unsigned>(value.place.table)];
  std::string text;
  for (unsigned i = 0; i < count.size(); ++i)
    if (count[i] != 0) text += (text.empty() ? "" : ", ") + std::to_string(count[i]) + " " + (count[i] == 1 ? kNames[i] : kMany[i]);
  return text;
}

// Says in words what was done. One value has its own old and new one; of several a vacant one has a word for it, and many are only counted.
void describe(std::vector<ValueChange> values, Change* change) {
  if (values.size() == 1) {
    change->what = place_text(values[0].place);
    change->before = values[0].before;
    change->after = values[0].after;
  } else if (values.size() <= kNamed) {
    change->what = joined(values, [](const ValueChange& value) { return place_text(value.place); });
    change->before = joined(values, [](const ValueChange& value) { return shown(value.before); });
    change->after = joined(values, [](const ValueChange& value) { return shown(value.after); });
  } else {
    change->what = counts(values);
  }
  change->values = std::move(values);
}

Outcome set(Runtime* runtime, std::vector<TableValue> wanted, Change* change) {
  std::vector<ValueChange> done;
  Outcome outcome = change_values(runtime, std::move(wanted), {}, &done);
  if (outcome.ok) describe(std::move(done), change);
  return outcome;
}

// Sets what a file gives; only what is another value than before is a change.
Outcome import_values(Runtime* runtime, std::vector<TableValue> wanted, Change* change) {
  std::vector<ValueChange> done;
  Outcome outcome = change_values(runtime, std::move(wanted), {}, &done);
  if (!outcome.ok) return outcome;
  const std::size_t all = done.size();
  std::erase_if(done, [](const ValueChange& value) { return same_value(value.place, value.before, value.after); });
  outcome = Outcome::done(std::to_string(all) + (all == 1 ? " value" : " values") + " as in the file, " + (done.empty() ? "none of them another one than before" : "changed: " + counts(done)));
  if (!done.empty()) describe(std::move(done), change);
  return outcome;
}

// Those columns of a row that a request has.
class ColumnsOf {
 public:
  ColumnsOf(const Call& call, Field number) : call_(call), number_(static_cast<std::uint32_t>(call.value(number))) {}
  void take(Table table, std::span<const Field> columns) {
    for (unsigned c = 0; c < columns.size(); ++c) {
      const FieldInfo& field = row_of(columns[c]);
      names_ += (names_.empty() ? "" : ", ") + std::string(field.name);
      if (!call_.has(columns[c])) continue;
      TableValue& value = wanted_.emplace_back();
      value.place.table = table;
      value.place.number = number_;
      value.place.column = c;
      value.value = field.kind == Kind::kText ? call_.words(columns[c]) : number_text(call_.value(columns[c]));
    }
  }
  Outcome set_in(Runtime* runtime, Change* change) {
    if (wanted_.empty()) return Outcome::refused(Refused::kMalformed, call_.row->name + std::string(" needs at least one of ") + names_);
    return set(runtime, std::move(wanted_), change);
  }

 private:
  const Call& call_;
  const std::uint32_t number_;
  std::vector<TableValue> wanted_;
  std::string names_;
};

}  // namespace

Outcome set_tool(Runtime* runtime, const Call& call, Change* change) {
  ColumnsOf columns(call, Field::kTool);
  columns.take(Table::kTool, kToolColumns);
  columns.take(Table::kToolLabel, kLabelColumns);
  return columns.set_in(runtime, change);
}

Outcome set_life(Runtime* runtime, const Call& call, Change* change) {
  ColumnsOf columns(call, Field::kLifeRow);
  columns.take(Table::kToolLife, kLifeColumns);
  return columns.set_in(runtime, change);
}

Outcome set_offset(Runtime* runtime, const Call& call, Change* change) {
  TableValue value;
  value.place.table = Table::kOffset;
  if (!system_of(*runtime, call, &value.place.system)) return no_system();
  value.place.number = static_cast<std::uint32_t>(call.value(Field::kOffset));
  value.place.axis = call.words(Field::kAxis)[0];
  value.value = number_text(call.value(Field::kValue));
  return set(runtime, {value}, change);
}

Outcome set_variable(Runtime* runtime, const Call& call, Change* change) {
  TableValue value;
  value.place.table = Table::kVariable;
  if (!system_of(*runtime, call, &value.place.system)) return no_system();
  const bool vacant = call.has(Field::kVacant) && call.flag(Field::kVacant), given = call.has(Field::kVariableValue), named = call.has(Field::kVariableName);
  if ((vacant && given) || !(vacant || given || named)) return Outcome::refused(Refused::kMalformed, "variables.set needs a value, or vacant and no value, or a name");
  value.place.number = static_cast<std::uint32_t>(call.value(Field::kVariable));
  if (given) value.value = number_text(call.value(Field::kVariableValue));
  std::vector<TableValue> wanted;
  if (vacant || given) wanted.push_back(value);
  if (named) {
    TableValue& name = wanted.emplace_back();
    name.place.table = Table::kVariableName;
    name.place.number = value.place.number;
    name.value = call.words(Field::kVariableName);
  }
  return set(runtime, std::move(wanted), change);
}

Outcome set_parameter(Runtime* runtime, const Call& call, Change* change) {
  TableValue value;
  value.place.table = Table::kParameter;
  if (!system_of(*runtime, call, &value.place.system)) return no_system();
  value.place.key = call.words(Field::kParameter);
  value.place.axis = call.has(Field::kAxis) ? call.words(Field::kAxis)[0] : '\0';
  value.value = call.words(Field::kText);
  return set(runtime, {value}, change);
}

Outcome import_tables(Runtime* runtime, const Call& call, Change* change) {
  std::vector<TableValue> wanted;
  if (const std::string wrong = parse_tables_toml(runtime->config(), call.words(Field::kToml), &wanted); !wrong.empty()) return Outcome::refused(Refused::kMalformed, wrong);
  return import_values(runtime, std::move(wanted), change);
}

Outcome import_parameters(Runtime* runtime, const Call& call, Change* change) {
  std::vector<TableValue> wanted;
  if (const std::string wrong = parse_parameters_toml(runtime->config(), call.words(Field::kParameterToml), &wanted); !wrong.empty()) return Outcome::refused(Refused::kMalformed, wrong);
  if (Outcome tried = rehearse_parameters(runtime, wanted); !tried.ok) return tried;
  return import_values(runtime, std::move(wanted), change);
}

void find_lost(Runtime* runtime, ChangeLog* log) {
  struct Look {
    std::vector<TablePlace> places;
    const nc_config* config = nullptr;
    ToolLabelTable* labels = nullptr;
    std::map<std::string, std::string> values;
  };
  auto look = std::make_shared<Look>();  // the job may outlive the one who waits for it
  look->places = log->places();
  look->config = &runtime->config().nc;
  look->labels = runtime->tool_labels();
  if (look->places.empty()) return;
  const Answer answer = runtime->look([look](nc_control* control) {
    const Tables tables{control, *look->config, look->labels->read()};
    std::string value;
    for (const TablePlace& place : look->places)
      if (tables.read(place, &value).ok) look->values[place_key(place)] = value;
  });
  if (answer != Answer::kDone) return;
  log->compare([&](const TablePlace& place, std::string* value) {
    const auto found = look->values.find(place_key(place));
    if (found == look->values.end()) return false;
    *value = found->second;
    return true;
  });
}

Outcome take_back(Runtime* runtime, const Change& before, Change* change) {
  std::vector<TableValue> wanted;
  std::vector<std::string> expected;
  std::string kept;  // what stays as it is
  for (auto value = before.values.rbegin(); value != before.values.rend(); ++value) {
    if (value->lost) continue;
    // The control has no way to take the setting of a parameter away. It is said, and keeps nobody from taking back the others and what was changed before.
    if (value->place.table == Table::kParameter && value->before.empty()) {
      kept += (kept.empty() ? "" : ", ") + place_text(value->place);
      continue;
    }
    wanted.push_back({value->place, value->before});
    expected.push_back(value->after);
  }
  std::vector<ValueChange> done;
  Outcome outcome = change_values(runtime, std::move(wanted), std::move(expected), &done);
  if (!outcome.ok) return outcome;
  const bool some = !done.empty();
  describe(std::move(done), change);
  if (!some) change->what.clear();
  if (!kept.empty()) change->what += (some ? "; " : "") + kept + " was not set before, and what is set stays set: give it the value that is wanted";
  change->what = "undo of " + std::to_string(before.number) + ": " + change->what;
  change->undoes = before.number;
  return Outcome::done(change->what);
}

}  // namespace nc::rt::services
