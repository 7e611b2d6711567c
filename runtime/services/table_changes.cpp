// SPDX-License-Identifier: Apache-2.0
// See table_changes.hpp.
#include "runtime/services/table_changes.hpp"

#include <array>
#include <memory>
#include <span>
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
  std::vector<ValueChange> done;
  Outcome outcome = Outcome::refused(Refused::kFailed, "?");
};

std::string shown(const std::string& value) { return value.empty() ? "nothing" : value; }

// Values of one row may bind one another (9000 mounts cannot become minutes before they are 100), so that no order of them is right for every change: what is refused
// is tried again behind the others, as long as that helps.
Refusals write_in_any_order(nc_control* control, const nc_config& config, std::vector<TableValue> pending) {
  for (;;) {
    std::vector<TableValue> rest;
    Refusals refusals;
    for (const TableValue& value : pending) {
      const Outcome written = write_value(control, config, value.place, value.value);
      if (written.ok) continue;
      refusals.add(value, written);
      rest.push_back(value);
    }
    if (rest.empty() || rest.size() == pending.size()) return refusals;
    pending = std::move(rest);
  }
}

// Writes the values that were there before.
void give_back(nc_control* control, const nc_config& config, const std::vector<ValueChange>& all) {
  std::vector<TableValue> before;
  for (auto value = all.rbegin(); value != all.rend(); ++value) before.push_back({value->place, value->before});
  (void)write_in_any_order(control, config, std::move(before));
}

// What is there now, in the order of what is wanted. False when a place does not exist, or is not as it is expected.
bool read_all(const nc_control* control, ValueJob* job, std::vector<ValueChange>* all) {
  Refusals refusals;
  for (std::size_t i = 0; i < job->wanted.size(); ++i) {
    const TableValue& wanted = job->wanted[i];
    ValueChange change{wanted.place, "", wanted.value};
    if (const Outcome read = read_value(control, *job->config, wanted.place, &change.before); !read.ok) {
      refusals.add(wanted, read);
    } else if (!job->expected.empty() && !same_value(change.before, job->expected[i])) {
      job->outcome = Outcome::refused(Refused::kState, place_text(wanted.place) + " was changed since: it is " + shown(change.before) + ", and not " + shown(job->expected[i]));
      return false;
    }
    all->push_back(std::move(change));
  }
  if (!refusals.empty()) job->outcome = refusals.outcome();
  return refusals.empty();
}

// In the feeder thread.
void write_all(nc_control* control, ValueJob* job) {
  const nc_config& config = *job->config;
  std::vector<ValueChange> all;
  if (!read_all(control, job, &all)) return;
  if (const Refusals refusals = write_in_any_order(control, config, job->wanted); !refusals.empty()) {
    give_back(control, config, all);
    job->outcome = refusals.outcome();
    return;
  }
  for (ValueChange& change : all) {
    std::string now;
    (void)read_value(control, config, change.place, &now);
    if (change.place.table == Table::kParameter) {
      if (!now.empty()) change.after = now;  // as the control writes it: "1" for "1.0"
    } else if (!same_value(now, change.after)) {
      job->outcome = Outcome::refused(Refused::kMalformed, place_text(change.place) + " is shared by part systems, and is given twice with different values");
      give_back(control, config, all);
      return;
    }
  }
  job->done = std::move(all);
  job->outcome = Outcome::done();
}

// Executes a change of these values; *done gets what it has done.
Outcome change_values(Runtime* runtime, std::vector<TableValue> wanted, std::vector<std::string> expected, std::vector<ValueChange>* done) {
  auto job = std::make_shared<ValueJob>();
  job->wanted = std::move(wanted);
  job->expected = std::move(expected);
  job->config = &runtime->config().nc;
  const Answer answer = runtime->change([job](nc_control* control) { write_all(control, job.get()); });
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
  constexpr const char* kNames[] = {"tool offset", "work offset", "common variable", "name of a variable", "parameter", "entry of tool life"};  // in the order of Table
  constexpr const char* kMany[] = {"tool offsets", "work offsets", "common variables", "names of variables", "parameters", "entries of tool life"};
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
  std::erase_if(done, [](const ValueChange& value) { return same_value(value.before, value.after); });
  outcome = Outcome::done(std::to_string(all) + (all == 1 ? " value" : " values") + " as in the file, " + (done.empty() ? "none of them another one than before" : "changed: " + counts(done)));
  if (!done.empty()) describe(std::move(done), change);
  return outcome;
}

// Those columns of a row that the request has.
Outcome set_columns(Runtime* runtime, const Call& call, Table table, Field number, std::span<const Field> columns, Change* change) {
  std::vector<TableValue> wanted;
  std::string names;
  for (unsigned c = 0; c < columns.size(); ++c) {
    names += (names.empty() ? "" : ", ") + std::string(row_of(columns[c]).name);
    if (!call.has(columns[c])) continue;
    TableValue& value = wanted.emplace_back();
    value.place.table = table;
    value.place.number = static_cast<std::uint32_t>(call.value(number));
    value.place.column = c;
    value.value = number_text(call.value(columns[c]));
  }
  if (wanted.empty()) return Outcome::refused(Refused::kMalformed, call.row->name + std::string(" needs at least one of ") + names);
  return set(runtime, std::move(wanted), change);
}

}  // namespace

Outcome set_tool(Runtime* runtime, const Call& call, Change* change) {
  return set_columns(runtime, call, Table::kTool, Field::kTool, kToolColumns, change);
}

Outcome set_life(Runtime* runtime, const Call& call, Change* change) {
  return set_columns(runtime, call, Table::kToolLife, Field::kLifeRow, kLifeColumns, change);
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

Outcome take_back(Runtime* runtime, const Change& before, Change* change) {
  std::vector<TableValue> wanted;
  std::vector<std::string> expected;
  for (auto value = before.values.rbegin(); value != before.values.rend(); ++value) {
    // The control has no way to take the setting of a parameter away.
    if (value->place.table == Table::kParameter && value->before.empty())
      return Outcome::refused(Refused::kState, place_text(value->place) + " was not set before, and what is set stays set: give it the value that is wanted");
    wanted.push_back({value->place, value->before});
    expected.push_back(value->after);
  }
  std::vector<ValueChange> done;
  Outcome outcome = change_values(runtime, std::move(wanted), std::move(expected), &done);
  if (!outcome.ok) return outcome;
  describe(std::move(done), change);
  change->what = "undo of " + std::to_string(before.number) + ": " + change->what;
  change->undoes = before.number;
  return Outcome::done(change->what);
}

}  // namespace nc::rt::services
