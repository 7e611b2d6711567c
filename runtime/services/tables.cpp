// SPDX-License-Identifier: Apache-2.0
// See tables.hpp.
#include "runtime/services/tables.hpp"

#include <charconv>
#include <cmath>
#include <memory>

#include "runtime/nc_system.hpp"
#include "runtime/retain/variables.hpp"

namespace nc::rt::services {
namespace {

constexpr unsigned kDefaultRows = 500;
constexpr unsigned kPlainSets = 6, kExtended = 100;  // as nc_work_offset_set() counts
constexpr Field kColumnFields[] = {Field::kLength, Field::kLengthWear, Field::kRadius, Field::kRadiusWear};  // in the order of nc_tool_column

// What a job in the feeder thread has found. The job may outlive the one who waits for it, so both own this.
struct Found {
  Outcome outcome = Outcome::refused(Refused::kFailed, "?");
  Changes changes;
};

struct Page {
  unsigned from, count;
};
Page page_of(const Call& call) {
  return {static_cast<unsigned>(call.value_or(Field::kFrom, 0)), static_cast<unsigned>(call.value_or(Field::kCount, kDefaultRows))};
}

std::string shown(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// The part system of a request that must name one; the first one when none is named. False when there is no such part system.
bool system_of(const Runtime& runtime, const Call& call, unsigned* system) {
  const auto number = static_cast<unsigned>(call.value_or(Field::kSystem, 1));
  *system = number == 0 ? 0 : number - 1;
  return number != 0 && *system < runtime.config().nc.system_count;
}

Outcome no_system() { return Outcome::refused(Refused::kNotFound, "there is no such part system"); }

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

// Changes tables. `write` is called with the control, says whether it was done, and adds to the changes.
template <class Write>
Outcome change(Runtime* runtime, Changes* changes, Write write) {
  auto found = std::make_shared<Found>();
  const Answer answer = runtime->change([found, write = std::move(write)](nc_control* control) mutable {
    found->outcome = write(control, &found->changes);
  });
  if (answer != Answer::kDone) return refused_by(*runtime, answer);
  changes->insert(changes->end(), found->changes.begin(), found->changes.end());
  return found->outcome;
}

Change changed(std::string what, std::string before, std::string after) {
  Change change;
  change.what = std::move(what);
  change.before = std::move(before);
  change.after = std::move(after);
  return change;
}

std::string parameter_text(double value, const char* text) {
  return text[0] != '\0' ? text : std::isfinite(value) ? shown(value) : "";
}

// The value of a parameter, "" when it is not set.
std::string parameter_now(const nc_control* control, unsigned system, const std::string& key, char axis) {
  char name[24], text[64], of_axis = 0;
  double value = 0;
  for (unsigned place = 0; nc_parameter_next(control, api_system(system), place, &place, name, &of_axis, &value, text) == NC_OK; ++place)
    if (key == name && of_axis == axis) return parameter_text(value, text);
  return "";
}

}  // namespace

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
  return look(runtime, [page = page_of(call), last = runtime->config().nc.tool_offsets](const nc_control* control) {
    Json tools = Json::array();
    unsigned number = page.from == 0 ? 1 : page.from;
    for (; number <= last && tools.size() < page.count; ++number) {
      Json tool = {{"number", number}};
      double value = 0;
      for (unsigned c = 0; c < std::size(kColumnFields); ++c)
        if (nc_tool_offset_get(control, number, static_cast<nc_tool_column>(c), &value) == NC_OK) tool[row_of(kColumnFields[c]).name] = value;
      tools.push_back(std::move(tool));
    }
    return Json{{"tools", std::move(tools)}, {"next", number <= last ? number : 0}};
  });
}

Outcome list_offsets(Runtime* runtime, const Call& call) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  const nc_config& config = runtime->config().nc;
  return look(runtime, [page = page_of(call), system, &config](const nc_control* control) {
    Json offsets = Json::array();
    const unsigned sets = kPlainSets + 1 + config.work_offsets;
    unsigned set = page.from;  // counts the sets without the gap between the plain and the extended ones
    for (; set < sets && offsets.size() < page.count; ++set) {
      const unsigned index = set <= kPlainSets ? set : kExtended + set - kPlainSets;
      Json axes = Json::array();
      double value = 0;
      for (unsigned a = 0; a < config.system[system].axis_count; ++a)
        if (nc_work_offset_get(control, api_system(system), index, a, &value) == NC_OK)
          axes.push_back({{"name", std::string(1, config.system[system].axis[a].name)}, {"value", value}});
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
      variables.push_back({{"number", number}, {"value", value}, {"name", std::string(name)}});
    }
    return Json{{"variables", std::move(variables)}, {"next", next}};
  });
}

Outcome list_parameters(Runtime* runtime, const Call& call) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  return look(runtime, [page = page_of(call), system](const nc_control* control) {
    Json parameters = Json::array();
    unsigned place = page.from, next = 0;
    char key[24], text[64], axis = 0;
    double value = 0;
    for (; nc_parameter_next(control, api_system(system), place, &place, key, &axis, &value, text) == NC_OK; ++place) {
      if (parameters.size() == page.count) {
        next = place;
        break;
      }
      parameters.push_back({{"key", std::string(key)},
                            {"system", system + 1},
                            {"axis", axis != 0 ? std::string(1, axis) : std::string()},
                            {"value", parameter_text(value, text)}});
    }
    return Json{{"parameters", std::move(parameters)}, {"next", next}};
  });
}

Outcome set_tool(Runtime* runtime, const Call& call, Changes* changes) {
  bool any = false;
  for (const Field field : kColumnFields) any = any || call.has(field);
  if (!any) return Outcome::refused(Refused::kMalformed, "tools.set needs at least one of length, length_wear, radius, radius_wear");
  if (call.value(Field::kTool) > runtime->config().nc.tool_offsets) return Outcome::refused(Refused::kNotFound, "there is no such tool offset set");
  return change(runtime, changes, [call](nc_control* control, Changes* done) {
    const auto number = static_cast<unsigned>(call.value(Field::kTool));
    for (unsigned c = 0; c < std::size(kColumnFields); ++c) {
      const auto column = static_cast<nc_tool_column>(c);
      double before = 0;
      if (!call.has(kColumnFields[c])) continue;
      if (nc_tool_offset_get(control, number, column, &before) != NC_OK || nc_tool_offset_set(control, number, column, call.value(kColumnFields[c])) != NC_OK)
        return Outcome::refused(Refused::kState, "refused by the control");
      done->push_back(changed("tool " + std::to_string(number) + " " + row_of(kColumnFields[c]).name, shown(before), shown(call.value(kColumnFields[c]))));
    }
    return Outcome::done();
  });
}

Outcome set_offset(Runtime* runtime, const Call& call, Changes* changes) {
  unsigned system = 0, axis = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  const nc_system_config& axes = runtime->config().nc.system[system];
  while (axis < axes.axis_count && call.words(Field::kAxis)[0] != axes.axis[axis].name) ++axis;
  if (axis == axes.axis_count) return Outcome::refused(Refused::kNotFound, "there is no such axis");
  return change(runtime, changes, [call, system, axis](nc_control* control, Changes* done) {
    const auto index = static_cast<unsigned>(call.value(Field::kOffset));
    double before = 0;
    if (nc_work_offset_get(control, api_system(system), index, axis, &before) != NC_OK) return Outcome::refused(Refused::kNotFound, "there is no such set of work offsets");
    if (nc_work_offset_set(control, api_system(system), index, axis, call.value(Field::kValue)) != NC_OK)
      return Outcome::refused(Refused::kState, "refused by the control");
    done->push_back(changed("offset " + std::to_string(index) + " " + call.words(Field::kAxis) + " of part system " + std::to_string(system + 1), shown(before),
                            shown(call.value(Field::kValue))));
    return Outcome::done();
  });
}

Outcome set_variable(Runtime* runtime, const Call& call, Changes* changes) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  const bool vacant = call.has(Field::kVacant) && call.flag(Field::kVacant);
  if (vacant == call.has(Field::kVariableValue)) return Outcome::refused(Refused::kMalformed, "variables.set needs a value, or vacant and no value");
  return change(runtime, changes, [call, system, vacant](nc_control* control, Changes* done) {
    const auto number = static_cast<std::uint32_t>(call.value(Field::kVariable));
    double before = 0;
    bool was_vacant = false;
    if (is_local_variable(control, number) || nc_variable_get(control, api_system(system), number, &before, &was_vacant) != NC_OK ||
        nc_variable_set(control, api_system(system), number, call.value_or(Field::kVariableValue, 0), vacant) != NC_OK)
      return Outcome::refused(Refused::kNotFound, "there is no such common variable");
    done->push_back(changed("#" + std::to_string(number) + " of part system " + std::to_string(system + 1), was_vacant ? "" : shown(before),
                            vacant ? "" : shown(call.value(Field::kVariableValue))));
    return Outcome::done();
  });
}

Outcome set_parameter(Runtime* runtime, const Call& call, Changes* changes) {
  unsigned system = 0;
  if (!system_of(*runtime, call, &system)) return no_system();
  return change(runtime, changes, [call, system](nc_control* control, Changes* done) {
    const std::string& key = call.words(Field::kParameter);
    const char axis = call.has(Field::kAxis) ? call.words(Field::kAxis)[0] : '\0';
    const std::string before = parameter_now(control, system, key, axis);
    switch (nc_parameter_set(control, api_system(system), key.c_str(), axis, call.words(Field::kText).c_str())) {
      case NC_OK:
        break;
      case NC_E_NOT_FOUND:
        return Outcome::refused(Refused::kNotFound, "there is no such parameter");
      case NC_E_MEMORY:
        return Outcome::refused(Refused::kState, "too many parameters are set");
      default:
        return Outcome::refused(Refused::kState, "no such axis, or the value is out of the range of the parameter");
    }
    done->push_back(changed("parameter " + key + (axis != 0 ? std::string(" ") + axis : "") + " of part system " + std::to_string(system + 1), before,
                            call.words(Field::kText)));
    return Outcome::done();
  });
}

}  // namespace nc::rt::services
