// SPDX-License-Identifier: Apache-2.0
// Writes a configuration into a control: parameters, offset tables, start position.
#include "runtime/config.hpp"
#include "runtime/nc_system.hpp"

namespace nc::rt {
namespace {

std::string reason(nc_status status, const char* what) {
  switch (status) {
    case NC_E_NOT_FOUND:
      return std::string("the control has no such ") + what;
    case NC_E_ARGUMENT:
      return std::string("the control refuses this value for the ") + what;
    case NC_E_MEMORY:
      return std::string("no room in the control for the ") + what;
    default:
      return std::string("the control refuses the ") + what + " (status " + std::to_string(status) + ")";
  }
}

}  // namespace

std::vector<ConfigError> apply_config(const Config& config, nc_control* control) {
  std::vector<ConfigError> errors;
  auto check = [&](nc_status status, const ConfigPlace& place, const char* what) {
    if (status < 0) errors.push_back({config.file, place.line, place.key, reason(status, what)});
  };
  const struct {
    bool on;
    const char* key;
    const ConfigPlace& place;
  } options[] = {{config.macro_extensions, "macro_extensions", config.macro_extensions_place},
                 {config.negative_count, "negative_count", config.negative_count_place}};
  for (const auto& option : options)  // a dialect may lack such an option: then the control refuses it
    for (unsigned s = 0; option.on && s < config.nc.system_count; ++s) {
      const nc_status status = nc_parameter_set(control, api_system(s), option.key, 0, "1");
      check(status, option.place, "option");
      if (status < 0) break;
    }
  for (const ParameterSetting& parameter : config.parameters) {
    for (unsigned s = 0; s < config.nc.system_count; ++s) {
      if (parameter.axis != 0 && parameter.system != s) continue;
      const nc_status status = nc_parameter_set(control, api_system(s), parameter.key.c_str(), parameter.axis,
                                                parameter.text.c_str());
      check(status, parameter.place, "parameter");
      if (status < 0) break;  // one message for each line of the file, not one for each part system
    }
  }
  for (const WorkOffsetSetting& offset : config.work_offsets)
    check(nc_work_offset_set(control, api_system(offset.system), offset.index, offset.axis, offset.value),
          offset.place, "work offset");
  for (const ToolOffsetSetting& offset : config.tool_offsets)
    for (unsigned c = 0; c < 4; ++c)
      if (offset.given[c])
        check(nc_tool_offset_set(control, offset.number, static_cast<nc_tool_column>(c), offset.column[c]),
              offset.place, "tool offset");
  for (unsigned s = 0; s < config.nc.system_count; ++s)
    check(nc_position_set(control, api_system(s), &config.start[s]), {0, "axis.start"}, "start position");
  return errors;
}

}  // namespace nc::rt
