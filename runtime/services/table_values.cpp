// SPDX-License-Identifier: Apache-2.0
// See table_values.hpp.
#include "runtime/services/table_values.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "nc/nc.h"
#include "runtime/nc_system.hpp"
#include "runtime/retain/variables.hpp"
#include "runtime/services/parameter_meaning.hpp"
#include "runtime/toml_reader.hpp"

namespace nc::rt::services {
namespace {

using Table = TablePlace::Table;

constexpr char kAllAxes = '-';

Outcome no_tool() { return Outcome::refused(Refused::kNotFound, "there is no such tool offset set"); }
Outcome no_variable() { return Outcome::refused(Refused::kNotFound, "there is no such common variable"); }

// The index of an axis in its part system. False when there is none.
bool find_axis(const nc_config& config, const TablePlace& place, unsigned* axis) {
  if (place.system >= config.system_count) return false;
  const nc_system_config& system = config.system[place.system];
  for (*axis = 0; *axis < system.axis_count; ++*axis)
    if (system.axis[*axis].name == place.axis) return true;
  return false;
}

bool same_key(const std::string& one, const char* other) {
  std::size_t i = 0;
  for (; i < one.size() && other[i] != '\0'; ++i)
    if (std::toupper(static_cast<unsigned char>(one[i])) != std::toupper(static_cast<unsigned char>(other[i]))) return false;
  return i == one.size() && other[i] == '\0';
}

// A parameter as it is listed, "" when it is not set. One bit of a parameter ("1267/bit0") is set when the parameter is.
std::string parameter_now(const nc_control* control, const TablePlace& place) {
  const std::string whole = place.key.substr(0, place.key.find('/'));
  char key[24], text[64], axis = 0;
  double value = 0;
  for (unsigned at = 0; nc_parameter_next(control, api_system(place.system), at, &at, key, &axis, &value, text) == NC_OK; ++at) {
    if (axis != place.axis || !same_key(whole, key)) continue;
    if (whole.size() == place.key.size()) return parameter_value(value, text);
    return nc_parameter_get(control, api_system(place.system), place.key.c_str(), place.axis, &value) == NC_OK ? number_text(value) : "";
  }
  return "";
}

Outcome write_parameter(nc_control* control, const TablePlace& place, const std::string& value) {
  if (place.axis != '\0') {
    const ParameterMeaning meaning = parameter_meaning(nc_control_dialect(control), place.key);
    if (!meaning.name.empty() && !meaning.by_axis) return Outcome::refused(Refused::kState, "the parameter is the same for all axes: leave the axis out (" + meaning.name + ")");
  }
  switch (nc_parameter_set(control, api_system(place.system), place.key.c_str(), place.axis, value.c_str())) {
    case NC_OK: return Outcome::done();
    case NC_E_NOT_FOUND: return Outcome::refused(Refused::kNotFound, "there is no such parameter");
    case NC_E_MEMORY: return Outcome::refused(Refused::kState, "too many parameters are set");
    default: {
      const std::string range = parameter_range_text(nc_control_dialect(control), place.key);
      return Outcome::refused(Refused::kState, "no such axis, or the value is out of the range of the parameter" + (range.empty() ? "" : ": " + range));
    }
  }
}

// The column with this name; the number of columns when there is none.
template <std::size_t kCount>
unsigned column_named(const Field (&columns)[kCount], const std::string& name) {
  unsigned column = 0;
  while (column < kCount && name != row_of(columns[column]).name) ++column;
  return column;
}

}  // namespace

bool parse_number(const std::string& text, double* value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, *value);
  return result.ec == std::errc{} && result.ptr == end && std::isfinite(*value);
}

bool same_value(const TablePlace& place, const std::string& one, const std::string& other) {
  double a = 0, b = 0;
  if (place.table == Table::kToolLabel) return one == other;  // a name may look like a number
  return one == other || (parse_number(one, &a) && parse_number(other, &b) && a == b);
}

std::string parameter_value(double value, const char* text) { return text[0] != '\0' ? text : std::isfinite(value) ? number_text(value) : ""; }

std::string place_key(const TablePlace& place) {
  const std::string number = std::to_string(place.number), system = std::to_string(place.system + 1);
  switch (place.table) {
    case Table::kTool: return "tool " + number + " " + row_of(kToolColumns[place.column]).name;
    case Table::kToolLabel: return "tool " + number + " " + row_of(kLabelColumns[place.column]).name;
    case Table::kOffset: return "offset " + system + " " + number + " " + place.axis;
    case Table::kVariable: return "variable " + system + " " + number;
    case Table::kVariableName: return "name " + number;
    case Table::kToolLife: return "life " + number + " " + row_of(kLifeColumns[place.column]).name;
    case Table::kParameter: return "parameter " + system + " " + (place.axis != 0 ? place.axis : kAllAxes) + " " + place.key;
  }
  return "";
}

std::string retained_key(const TablePlace& place) {
  const std::string number = std::to_string(place.number), system = std::to_string(place.system);
  switch (place.table) {
    case Table::kTool: return "tool " + number + " " + std::to_string(place.column);
    case Table::kOffset: return "work " + system + " " + number + " " + place.axis;
    case Table::kVariable: return "variable " + system + " " + number;
    case Table::kVariableName: return "name " + number;
    case Table::kToolLife: return "life " + number + " " + std::to_string(place.column);
    case Table::kParameter: return "parameter " + system + " " + (place.axis != 0 ? place.axis : kAllAxes) + " " + place.key;
    case Table::kToolLabel: break;  // no program writes it
  }
  return "";
}

bool is_of(const TablePlace& place, const std::string& text) {
  const std::string key = place_key(place);
  return key == text || key.compare(0, text.size() + 1, text + " ") == 0;
}

bool names_table(const std::string& text) {
  for (const char* kind : {"tool ", "life ", "offset ", "variable ", "name ", "parameter "})
    if (text.rfind(kind, 0) == 0) return true;
  return false;
}

bool parse_place(const std::string& text, TablePlace* place) {
  std::istringstream words(text);
  std::string kind, column;
  unsigned system = 1;
  *place = TablePlace();
  words >> kind;
  if (kind == "tool") {
    words >> place->number >> column;
    place->column = column_named(kToolColumns, column);
    if (place->column == std::size(kToolColumns)) {
      place->table = Table::kToolLabel;
      place->column = column_named(kLabelColumns, column);
      if (place->column == std::size(kLabelColumns)) return false;
    }
  } else if (kind == "life") {
    place->table = Table::kToolLife;
    words >> place->number >> column;
    place->column = column_named(kLifeColumns, column);
    if (place->column == std::size(kLifeColumns)) return false;
  } else if (kind == "offset") {
    place->table = Table::kOffset;
    words >> system >> place->number >> place->axis;
  } else if (kind == "variable") {
    place->table = Table::kVariable;
    words >> system >> place->number;
  } else if (kind == "name") {
    place->table = Table::kVariableName;
    words >> place->number;
  } else if (kind == "parameter") {
    place->table = Table::kParameter;
    words >> system >> place->axis >> place->key;
    if (place->axis == kAllAxes) place->axis = 0;
  } else {
    return false;
  }
  if (words.fail() || system < 1 || system > NC_MAX_SYSTEMS) return false;
  place->system = system - 1;
  return place_key(*place) == text;
}

std::string place_text(const TablePlace& place) {
  const std::string number = std::to_string(place.number), system = " of part system " + std::to_string(place.system + 1);
  const std::string axis = place.axis != 0 ? std::string(" ") + place.axis : "";
  switch (place.table) {
    case Table::kTool:
    case Table::kToolLabel: return place_key(place);
    case Table::kOffset: return "offset " + number + axis + system;
    case Table::kVariable: return "#" + number + system;
    case Table::kVariableName: return "name of #" + number;
    case Table::kToolLife: return "tool " + place_key(place);
    case Table::kParameter: return "parameter " + place.key + axis + system;
  }
  return "";
}

void add_parameters(const nc_control* control, unsigned system, std::vector<TableValue>* values) {
  char key[24], text[64], axis = 0;
  double value = 0;
  for (unsigned at = 0; nc_parameter_next(control, api_system(system), at, &at, key, &axis, &value, text) == NC_OK; ++at) {
    TablePlace place;
    place.table = Table::kParameter;
    place.system = system;
    place.axis = axis;
    place.key = key;
    values->push_back({place, parameter_value(value, text)});
  }
}

Outcome read_value(const nc_control* control, const nc_config& config, const TablePlace& place, std::string* value) {
  double number = 0;
  bool vacant = false;
  unsigned axis = 0;
  char name[8] = "";
  switch (place.table) {
    case Table::kTool:
      if (nc_tool_offset_get(control, place.number, static_cast<nc_tool_column>(place.column), &number) != NC_OK)
        return no_tool();
      *value = number_text(number);
      return Outcome::done();
    case Table::kOffset:
      if (!find_axis(config, place, &axis)) return Outcome::refused(Refused::kNotFound, "there is no such axis");
      if (nc_work_offset_get(control, api_system(place.system), place.number, axis, &number) != NC_OK)
        return Outcome::refused(Refused::kNotFound, "there is no such set of work offsets");
      *value = number_text(number);
      return Outcome::done();
    case Table::kVariable:
      if (is_local_variable(control, place.number) || nc_variable_get(control, api_system(place.system), place.number, &number, &vacant) != NC_OK) return no_variable();
      *value = vacant ? "" : number_text(number);
      return Outcome::done();
    case Table::kVariableName:
      (void)nc_variable_name_get(control, place.number, name);
      *value = name;
      return Outcome::done();
    case Table::kToolLife:
      if (nc_tool_life_get(control, place.number, static_cast<nc_life_column>(place.column), &number) != NC_OK)
        return Outcome::refused(Refused::kNotFound, "there is no such row of tool life");
      *value = number_text(number);
      return Outcome::done();
    case Table::kParameter:
      *value = parameter_now(control, place);
      return Outcome::done();
    case Table::kToolLabel: break;
  }
  return Outcome::refused(Refused::kNotFound, "there is no such table");
}

Outcome write_value(nc_control* control, const nc_config& config, const TablePlace& place, const std::string& value) {
  double number = 0;
  unsigned axis = 0;
  nc_status status = NC_E_ARGUMENT;
  if (place.table == Table::kParameter) return write_parameter(control, place, value);
  const bool empty = place.table == Table::kVariable && value.empty();
  if (place.table != Table::kVariableName && !empty && !parse_number(value, &number)) return Outcome::refused(Refused::kState, "\"" + value + "\" is no number");
  switch (place.table) {
    case Table::kTool: status = nc_tool_offset_set(control, place.number, static_cast<nc_tool_column>(place.column), number); break;
    case Table::kOffset:
      if (find_axis(config, place, &axis)) status = nc_work_offset_set(control, api_system(place.system), place.number, axis, number);
      break;
    case Table::kVariable: status = nc_variable_set(control, api_system(place.system), place.number, number, empty); break;
    case Table::kVariableName: status = nc_variable_name_set(control, place.number, value.c_str()); break;
    case Table::kToolLife: status = nc_tool_life_set(control, place.number, static_cast<nc_life_column>(place.column), number); break;
    case Table::kParameter:
    case Table::kToolLabel: break;
  }
  if (status == NC_OK) return Outcome::done();
  if (place.table == Table::kVariableName) return Outcome::refused(Refused::kState, "the variable can have no name, or not this one: at most 7 capital letters and digits, a letter first, and not the name of a function at the beginning");
  if (place.table == Table::kToolLife) return Outcome::refused(Refused::kState, "out of the range of the column: a life and what is used of it have at most 4000 minutes or 9999 times");
  return Outcome::refused(Refused::kState, "refused by the control");
}

Outcome read_label(const ToolLabels& labels, const nc_config& config, const TablePlace& place, std::string* value) {
  if (place.number < 1 || place.number > config.tool_offsets) return no_tool();
  const ToolLabel& label = label_of(labels, place.number);
  *value = place.column == kNameColumn ? label.name : std::to_string(label.pocket);
  return Outcome::done();
}

Outcome write_label(ToolLabels* labels, const nc_config& config, const TablePlace& place, const std::string& value) {
  if (place.number < 1 || place.number > config.tool_offsets) return no_tool();
  ToolLabel label = label_of(*labels, place.number);
  double pocket = 0;
  if (place.column == kNameColumn) {
    if (const std::string trouble = tool_name_trouble(value); !trouble.empty()) return Outcome::refused(Refused::kMalformed, trouble);
    label.name = value;
  } else if (parse_number(value, &pocket) && pocket >= 0 && pocket <= kMostPocket && pocket == std::floor(pocket)) {
    label.pocket = static_cast<unsigned>(pocket);
  } else {
    return Outcome::refused(Refused::kMalformed, "must be a whole number from 0 to " + std::to_string(kMostPocket));
  }
  if (label == ToolLabel()) labels->erase(place.number);
  else (*labels)[place.number] = std::move(label);
  return Outcome::done();
}

}  // namespace nc::rt::services
