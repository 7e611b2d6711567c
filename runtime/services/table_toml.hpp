// SPDX-License-Identifier: Apache-2.0
// Tool offsets, work offsets, tool life and common variables as TOML. [tool_offsets] and [work_offsets] are those of the configuration; [tool_life] has a row for
// each registered tool; [variables], [variables2] ... hold the
// common variables of part system 1, 2 ..., and [variable_names] their names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/config.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

// Which tables an export holds.
struct TomlTables {
  bool tools = true, lives = true, offsets = true, variables = true;
};
// The tables as the control has them. In its thread. The same tables give the same bytes.
std::string tables_toml(const nc_control* control, const nc_config& config, const ToolLabels& labels, const TomlTables& tables);

// Reads such a text. "" = it is good and *values has what it gives, else what is wrong with it, with lines. Whether the control has a variable is not asked here.
std::string parse_tables_toml(const Config& machine, std::string_view text, std::vector<TableValue>* values);

// The parameters as the section [parameters] of the configuration, of further part systems as [parameters2] ..., in which an axis has no number. A parameter that has a
// value for all axes and others for some is a table in which that one is `all`.
std::string parameters_toml(const std::vector<TableValue>& values);
// As parse_tables_toml().
std::string parse_parameters_toml(const Config& machine, std::string_view text, std::vector<TableValue>* values);

}  // namespace nc::rt::services
