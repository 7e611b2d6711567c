// SPDX-License-Identifier: Apache-2.0
// Single values of the tables of the control: where each stands, how it is read and written. A value is a text that gives the same number when it is read back;
// "" is a vacant variable, a variable or a tool without a name, a parameter that is not set.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/services/call.hpp"
#include "runtime/tools/tool_labels.hpp"

struct nc_control;
struct nc_config;

namespace nc::rt::services {

// Columns of the table of tool offsets, in the order of nc_tool_column.
inline constexpr Field kToolColumns[] = {Field::kLength, Field::kLengthWear, Field::kRadius, Field::kRadiusWear};

// Columns of a tool that the control does not know, in the order of LabelColumn.
inline constexpr Field kLabelColumns[] = {Field::kToolName, Field::kPocket};
enum LabelColumn : unsigned { kNameColumn, kPocketColumn };

// Columns of the table of tool life, in the order of nc_life_column.
inline constexpr Field kLifeColumns[] = {Field::kLifeGroup, Field::kLifeTool,   Field::kLifeFlags,  Field::kLifeStatus,   Field::kLife,
                                         Field::kLifeUsed,  Field::kLifeLength, Field::kLifeRadius, Field::kLifeAuxiliary};

struct TablePlace {
  enum class Table : std::uint8_t { kTool, kOffset, kVariable, kVariableName, kParameter, kToolLife, kToolLabel };
  Table table = Table::kTool;
  unsigned system = 0;       // index of the part system, for kOffset, kVariable and kParameter
  std::uint32_t number = 0;  // of the tool, the set of work offsets, the variable, the row of tool life
  unsigned column = 0;       // kTool: nc_tool_column; kToolLife: nc_life_column; kToolLabel: LabelColumn
  char axis = 0;             // kOffset; kParameter: 0 = all axes
  std::string key = {};      // kParameter
};

struct TableValue {
  TablePlace place;
  std::string value;
  unsigned line = 0;  // of the text that gives it, 0 = none
};
// What a change has done to a value.
struct ValueChange {
  TablePlace place;
  std::string before, after;
  bool lost = false;  // a power cut has taken it: the table was not kept in time (lost_changes.hpp)
  bool apart = false;  // a change between this one and the next that is remembered is not: what they found says nothing of this one
};

// The place in the file of the changes, and back. The texts never change: "tool 3 radius_wear", "offset 1 102 X", "variable 1 501", "name 501", "life 3 used", "parameter 1 X 2001"
// with "-" for all axes.
std::string place_key(const TablePlace& place);
bool parse_place(const std::string& text, TablePlace* place);
// The place in retained data (runtime/retain/writers.hpp).
std::string retained_key(const TablePlace& place);
// Whether `text` is such a place, or the beginning of some with all of its words whole: "tool 3" for all columns of the tool.
bool is_of(const TablePlace& place, const std::string& text);
// Whether it begins as such a place does.
bool names_table(const std::string& text);
// The same for people: "tool 3 radius_wear", "offset 102 X of part system 1", "#501 of part system 1".
std::string place_text(const TablePlace& place);

// The number that the whole text is. False when it is none, or not finite.
bool parse_number(const std::string& text, double* value);
// The same value of this place: the same text, or the same number where it is one.
bool same_value(const TablePlace& place, const std::string& one, const std::string& other);

// The value of a parameter that nc_parameter_next() gives.
std::string parameter_value(double value, const char* text);

// Adds the parameters of the part system that are set. In the thread of the control.
void add_parameters(const nc_control* control, unsigned system, std::vector<TableValue>* values);

// In the thread of the control. The outcome is a refusal when there is no such place, or when it does not take the value.
Outcome read_value(const nc_control* control, const nc_config& config, const TablePlace& place, std::string* value);
Outcome write_value(nc_control* control, const nc_config& config, const TablePlace& place, const std::string& value);
// The same for places of Table::kToolLabel. Whether two tools are in one pocket is not looked at.
Outcome read_label(const ToolLabels& labels, const nc_config& config, const TablePlace& place, std::string* value);
Outcome write_label(ToolLabels* labels, const nc_config& config, const TablePlace& place, const std::string& value);

}  // namespace nc::rt::services
