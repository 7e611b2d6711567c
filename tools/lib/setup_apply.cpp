// SPDX-License-Identifier: Apache-2.0
// Applies a setup to a control; see setup.hpp. libnc says what a dialect does not have, and that becomes
// an error here with the place in the setup.
#include "tools/lib/item_source.hpp"
#include "tools/lib/json_check.hpp"
#include "tools/lib/setup.hpp"

namespace nc::tools {
namespace {

bool refuse(const Setup& setup, const SetupPlace& place, const std::string& why, std::string* error) {
  *error = setup.name + ":" + std::to_string(place.line) + ": " + json::one_line(place.path + ": " + why);
  return false;
}

bool apply_parameters(const Setup& setup, nc_control* control, std::string* error) {
  for (const SetupParameter& p : setup.parameters) {
    switch (nc_parameter_set(control, kPartSystem, p.key.c_str(), p.axis, p.text.c_str())) {
      case NC_OK:
        break;
      case NC_E_NOT_FOUND:
        return refuse(setup, p.place, "the control has no such parameter", error);
      case NC_E_MEMORY:
        return refuse(setup, p.place, "too many parameters", error);
      default:
        return refuse(setup, p.place, "the parameter does not take the value \"" + p.text + "\"", error);
    }
  }
  return true;
}

bool apply_option(const Setup& setup, nc_control* control, bool on, const SetupPlace& place, const char* key,
                  std::string* error) {
  if (!on && place.line == 0) return true;  // the setup does not name the option, so that of the machine stays
  if (nc_parameter_set(control, kPartSystem, key, 0, on ? "1" : "0") == NC_OK || !on) return true;
  return refuse(setup, place, "this control does not have the option", error);
}

// Memory type II has separate columns for length and radius, type I has one value for both. // M700 12.1
bool apply_tool_offsets(const Setup& setup, nc_control* control, std::string* error) {
  bool columns = false;
  for (const SetupToolOffset& entry : setup.tool_offsets) columns = columns || !entry.plain;
  std::string memory_type;
  char key[24] = "";
  const bool has_types = nc_parameter_key_get(control, NC_PARAMETER_TOOL_MEMORY, key) == NC_OK;
  for (const SetupParameter& p : setup.parameters)
    if (p.key == key) memory_type = p.text;
  if (columns && memory_type.empty() && has_types && nc_parameter_set(control, kPartSystem, key, 0, "2") == NC_OK) memory_type = "2";
  for (const SetupToolOffset& entry : setup.tool_offsets) {
    if (!entry.plain && memory_type == "1")
      return refuse(setup, entry.place, "memory type I (params." + std::string(key) + " is 1) has one number per offset", error);
    double column[4];
    for (int c = 0; c < 4; ++c) column[c] = entry.column[c];
    int count = entry.plain ? 1 : 4;
    if (entry.plain && (memory_type == "2" || !has_types)) {  // a length or a radius, whichever the program asks for
      column[NC_TOOL_RADIUS] = column[NC_TOOL_LENGTH];
      count = 4;
    }
    for (int c = 0; c < count; ++c)
      if (nc_tool_offset_set(control, entry.number, static_cast<nc_tool_column>(c), column[c]) != NC_OK)
        return refuse(setup, entry.place, "the control has no such tool offset", error);
  }
  return true;
}

bool apply_tables(const Setup& setup, nc_control* control, std::string* error) {
  for (const SetupWorkOffset& table : setup.work_offsets)
    for (const SetupAxisValue& v : table.values)
      if (nc_work_offset_set(control, kPartSystem, table.index, v.axis, v.value) != NC_OK)
        return refuse(setup, v.place, "the control has no such work offset", error);
  for (const SetupVariable& v : setup.variables) {
    if (v.number >= 1 && v.number <= 33 && !v.vacant)  // M700 13.5.5: local variables
      return refuse(setup, v.place, "is a local variable: a program begins with vacant ones", error);
    if (nc_variable_set(control, kPartSystem, v.number, v.value, v.vacant) != NC_OK)
      return refuse(setup, v.place, "the control has no such variable, or it cannot be written", error);
  }
  return true;
}

bool apply_subprograms(const Setup& setup, nc_control* control, std::string* error) {
  for (const auto& [name, text] : setup.subprograms) {
    unsigned file = 0;
    if (nc_program_add_text(control, name.c_str(), text.data(), text.size(), &file) != NC_OK)
      return refuse(setup, {"subprograms." + name, 1}, "the program store refused it", error);
  }
  return true;
}

}  // namespace

void apply_setup(const Setup& setup, nc_config* config) {
  nc_system_config& system = config->system[0];
  system.axis_count = static_cast<uint8_t>(setup.axes.size());
  for (size_t i = 0; i < setup.axes.size(); ++i) {
    system.axis[i] = nc_axis_config{};
    system.axis[i].name = setup.axes[i].name;
    system.axis[i].rotary = setup.axes[i].rotary;
  }
  config->variable_sets = setup.option_variable_sets;
  config->extended_variables = setup.option_extended_variables;
  for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i) config->variable_ranges[i] = setup.option_variable_ranges[i];
  config->tool_offsets = setup.option_tool_offsets;
  config->work_offsets = setup.option_work_offsets;
}

bool apply_setup(const Setup& setup, nc_control* control, std::string* error) {
  if (!apply_parameters(setup, control, error) ||
      !apply_option(setup, control, setup.option_macro_extensions, setup.macro_extensions_place,
                    "macro_extensions", error) ||
      !apply_option(setup, control, setup.option_negative_count, setup.negative_count_place, "negative_count", error) ||
      !apply_tool_offsets(setup, control, error) || !apply_tables(setup, control, error) ||
      !apply_subprograms(setup, control, error))
    return false;
  nc_switches_set(control, kPartSystem, setup.optional_skip, setup.mirror_axes);
  if (nc_position_set(control, kPartSystem, &setup.start) != NC_OK)
    return refuse(setup, {"start", 1}, "the control does not take this position", error);
  return true;
}

}  // namespace nc::tools
