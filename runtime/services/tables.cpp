// SPDX-License-Identifier: Apache-2.0
// See tables.hpp.
#include "runtime/services/tables.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>

#include "runtime/nc_system.hpp"
#include "runtime/services/parameter_meaning.hpp"
#include "runtime/services/table_toml.hpp"
#include "runtime/services/table_values.hpp"
#include "runtime/work_offset_name.hpp"

namespace nc::rt::services {
namespace {

constexpr unsigned kDefaultRows = 500;

// A program may have left the zero that has a sign; there is one for those who read the tables.
double unsigned_zero(double value) { return value + 0.0; }

// What a job in the feeder thread has found. The job may outlive the one who waits for it, so both own this.
struct Found {
  Outcome outcome = Outcome::refused(Refused::kFailed, "?");
};

struct Page {
  unsigned from, count;
};
Page page_of(const Call& call) {
  return {static_cast<unsigned>(call.value_or(Field::kFrom, 0)), static_cast<unsigned>(call.value_or(Field::kCount, kDefaultRows))};
}

// Reads the tables as the executed blocks have left them. `read` is called with the control and fills the reply.
template <class Read>
Outcome look(Runtime* runtime, Read read) {
  struct Job {
    std::shared_ptr<Found> found;
    Read read;
  };
  auto found = std::make_shared<Found>();
  const Answer answer = runtime->look([job = Job{found, std::move(read)}](nc_control* control) mutable {
    nc_look_executed(
        control,
        [](void* user, const nc_control* seen) {
          auto* to = static_cast<Job*>(user);
          to->found->outcome = Outcome::with(to->read(seen));
        },
        &job);
  });
  return answer == Answer::kDone ? found->outcome : refused_by(*runtime, answer);
}

}  // namespace

bool system_of(const Runtime& runtime, const Call& call, unsigned* system) {
  const auto number = static_cast<unsigned>(call.value_or(Field::kSystem, 1));
  *system = number == 0 ? 0 : number - 1;
  return number != 0 && *system < runtime.config().nc.system_count;
}

Outcome no_system() { return Outcome::refused(Refused::kNotFound, "there is no such part system"); }

Outcome refused_by(const Runtime& runtime, Answer answer) {
  switch (answer) {
    case Answer::kQueueFull:
      return Outcome::refused(Refused::kBusy, answer_text(answer));
    case Answer::kNoAnswer:
      return Outcome::refused(Refused::kFailed, answer_text(answer));
    default:
      return Outcome::refused(Refused::kState, runtime.explain(answer));
  }
}

Outcome list_tools(Runtime* runtime, const Call& call) {
  return look(runtime, [page = page_of(call), last = runtime->config().nc.tool_offsets, table = runtime->tool_labels()](const nc_control* control) {
    const ToolLabels labels = table->read();
    Json tools = Json::array();
    unsigned number = page.from == 0 ? 1 : page.from;
    for (; number <= last && tools.size() < page.count; ++number) {
      Json tool = {{"number", number}};
      double value = 0;
      for (unsigned c = 0; c < std::size(kToolColumns); ++c)
        if (nc_tool_offset_get(control, number, static_cast<nc_tool_column>(c), &value) == NC_OK) tool[row_of(kToolColumns[c]).name] = unsigned_zero(value);
      const ToolLabel& label = label_of(labels, number);
      tool[row_of(Field::kToolName).name] = label.name;
      tool[row_of(Field::kPocket).name] = label.pocket;
      tools.push_back(std::move(tool));
    }
    return Json{{"tools", std::move(tools)}, {"next", number <= last ? number : 0}};
  });
}

Outcome list_lives(Runtime* runtime, const Call& call) {
  return look(runtime, [page = page_of(call)](const nc_control* control) {
    constexpr const char* kCounts[] = {"minutes", "mounts", "uses", "uses"};  // bits 4 and 5 of the flags
    constexpr const char* kStates[] = {"not used", "in use", "ended", "not to be used", "not to be used"};
    Json lives = Json::array();
    unsigned number = page.from == 0 ? 1 : page.from;
    for (; number <= NC_TOOL_LIVES && lives.size() < page.count; ++number) {
      Json life = {{"number", number}};
      double value[std::size(kLifeColumns)] = {};
      for (unsigned c = 0; c < std::size(kLifeColumns); ++c) {
        (void)nc_tool_life_get(control, number, static_cast<nc_life_column>(c), &value[c]);
        life[row_of(kLifeColumns[c]).name] = unsigned_zero(value[c]);
      }
      life["counts"] = kCounts[static_cast<unsigned>(value[NC_LIFE_FLAGS]) >> 4 & 3u];
      life["state"] = kStates[std::min(static_cast<std::size_t>(value[NC_LIFE_STATUS]), std::size(kStates) - 1)];
      lives.push_back(std::move(life));
    }
    return Json{{"lives", std::move(lives)}, {"next", number <= NC_TOOL_LIVES ? number : 0}};
  });
}

Outcome list_offsets(Runtime* runtime, const Call& call) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  const nc_config& config = runtime->config().nc;
  return look(runtime, [page = page_of(call), system, &config](const nc_control* control) {
    Json offsets = Json::array();
    const unsigned sets = kPlainWorkOffsets + 1 + config.work_offsets;
    unsigned set = page.from;  // counts the sets without the gap between the plain and the extended ones
    for (; set < sets && offsets.size() < page.count; ++set) {
      const unsigned index = set <= kPlainWorkOffsets ? set : kExtendedWorkOffset + set - kPlainWorkOffsets;
      Json axes = Json::array();
      double value = 0;
      for (unsigned a = 0; a < config.system[system].axis_count; ++a)
        if (nc_work_offset_get(control, api_system(system), index, a, &value) == NC_OK)
          axes.push_back({{"name", std::string(1, config.system[system].axis[a].name)}, {"value", unsigned_zero(value)}});
      offsets.push_back({{"system", system + 1}, {"index", index}, {"axes", std::move(axes)}});
    }
    return Json{{"offsets", std::move(offsets)}, {"next", set < sets ? set : 0}};
  });
}

Outcome list_variables(Runtime* runtime, const Call& call) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  return look(runtime, [page = page_of(call), system](const nc_control* control) {
    Json variables = Json::array();
    std::uint32_t number = page.from, next = 0;
    double value = 0;
    for (; nc_variable_next(control, api_system(system), number, &number, &value) == NC_OK; ++number) {
      if (variables.size() == page.count) {
        next = number;
        break;
      }
      char name[8] = "";
      (void)nc_variable_name_get(control, number, name);
      variables.push_back({{"number", number}, {"value", unsigned_zero(value)}, {"name", std::string(name)}});
    }
    return Json{{"variables", std::move(variables)}, {"next", next}};
  });
}

// The parameters that are set, in the order of the control; with `all` those of the family's table that are not set behind them, without a value.
Outcome list_parameters(Runtime* runtime, const Call& call) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  Outcome outcome = look(runtime, [system](const nc_control* control) {
    Json set = Json::array();
    char key[24], text[64], axis = 0;
    double value = 0;
    for (unsigned place = 0; nc_parameter_next(control, api_system(system), place, &place, key, &axis, &value, text) == NC_OK; ++place)
      set.push_back({{"key", std::string(key)}, {"axis", axis != 0 ? std::string(1, axis) : std::string()}, {"value", parameter_value(value, text)}, {"set", true}});
    return set;
  });
  if (!outcome.ok) return outcome;
  const auto dialect = static_cast<nc_dialect>(runtime->config().nc.dialect);
  Json rows = std::move(outcome.reply);
  if (call.has(Field::kAll) && call.flag(Field::kAll)) {
    std::set<std::string> set;
    for (const Json& row : rows) set.insert(row["key"].get<std::string>());
    for (const ParameterMeaning& meaning : parameter_meanings(dialect))
      if (set.count(meaning.key.substr(0, meaning.key.find('/'))) == 0) rows.push_back({{"key", meaning.key}, {"axis", ""}, {"value", ""}, {"set", false}});
  }
  const Page page = page_of(call);
  Json parameters = Json::array();
  std::size_t at = page.from;
  for (; at < rows.size() && parameters.size() < page.count; ++at) {
    const ParameterMeaning meaning = parameter_meaning(dialect, rows[at]["key"].get<std::string>());
    parameters.push_back(std::move(rows[at]));
    parameters.back().update({{"system", system + 1}, {"name", meaning.name}, {"values", meaning.values}, {"by_axis", meaning.by_axis}, {"section", meaning.section}});
  }
  return Outcome::with({{"parameters", std::move(parameters)}, {"next", at < rows.size() ? at : 0}});
}

bool read_parameters(Runtime* runtime, std::vector<TableValue>* values, Outcome* outcome) {
  const auto found = std::make_shared<std::vector<TableValue>>();
  *outcome = look(runtime, [found, systems = runtime->config().nc.system_count](const nc_control* control) {
    for (unsigned s = 0; s < systems; ++s) add_parameters(control, s, found.get());
    return Json::object();
  });
  *values = std::move(*found);
  return outcome->ok;
}

Outcome export_parameters(Runtime* runtime) {
  std::vector<TableValue> values;
  Outcome outcome;
  if (!read_parameters(runtime, &values, &outcome)) return outcome;
  return Outcome::with({{"toml", parameters_toml(values)}});
}

Outcome export_tables(Runtime* runtime, const Call& call) {
  constexpr const char* kTables[] = {"tools", "life", "offsets", "variables"};
  TomlTables tables;
  if (call.has(Field::kTable)) {
    const auto* const found = std::find(std::begin(kTables), std::end(kTables), call.words(Field::kTable));
    if (found == std::end(kTables)) return Outcome::refused(Refused::kMalformed, "table must be tools, life, offsets or variables");
    tables = {found == kTables, found == kTables + 1, found == kTables + 2, found == kTables + 3};
  }
  return look(runtime, [tables, &config = runtime->config().nc, labels = runtime->tool_labels()](const nc_control* control) {
    return Json{{"toml", tables_toml(control, config, labels->read(), tables)}};
  });
}

}  // namespace nc::rt::services
