// SPDX-License-Identifier: Apache-2.0
// See table_toml.hpp.
#include "runtime/services/table_toml.hpp"

#include <map>
#include <memory>
#include <set>

#include "nc/nc.h"
#include "runtime/config_sections.hpp"
#include "runtime/nc_system.hpp"
#include "runtime/toml_reader.hpp"
#include "runtime/work_offset_name.hpp"

namespace nc::rt::services {
namespace {

using Table = TablePlace::Table;

constexpr std::size_t kMostErrors = 5;  // that a refusal names
constexpr unsigned kLargest = 2147483647;
constexpr double kLargestNumber = 1e9;  // of tool life; the control knows the range of each column
constexpr std::string_view kVacant = "vacant", kNames = "variable_names", kLives = "tool_life", kParameters = "parameters", kAll = "all";
constexpr std::size_t kLongestValue = 63;  // of a parameter, bytes

// "X", in part system 2 "X2"
std::string suffix(unsigned system) { return system == 0 ? "" : std::to_string(system + 1); }

// ---- export ----

// As a key or a text of TOML.
std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return safe + "\"";
}

void write_tools(const nc_control* control, const nc_config& config, const ToolLabels& labels, std::string* text) {
  *text += "[tool_offsets]\n";
  double value = 0;
  for (unsigned number = 1; number <= config.tool_offsets; ++number) {
    std::string row;
    for (unsigned c = 0; c < std::size(kToolColumns); ++c)
      if (nc_tool_offset_get(control, number, static_cast<nc_tool_column>(c), &value) == NC_OK)
        row += std::string(row.empty() ? "" : ", ") + row_of(kToolColumns[c]).name + " = " + number_text(value);
    const ToolLabel& label = label_of(labels, number);
    row += std::string(", ") + row_of(Field::kToolName).name + " = " + quoted(label.name) + ", " + row_of(Field::kPocket).name + " = " + std::to_string(label.pocket);
    *text += std::to_string(number) + " = { " + row + " }\n";
  }
}

void write_offsets(const nc_control* control, const nc_config& config, std::string* text) {
  *text += "\n[work_offsets]\n";
  double value = 0;
  for (unsigned set = 0; set <= kPlainWorkOffsets + config.work_offsets; ++set) {
    const unsigned index = set <= kPlainWorkOffsets ? set : kExtendedWorkOffset + set - kPlainWorkOffsets;
    std::string row;
    for (unsigned s = 0; s < config.system_count; ++s)
      for (unsigned a = 0; a < config.system[s].axis_count; ++a)
        if (nc_work_offset_get(control, api_system(s), index, a, &value) == NC_OK)
          row += std::string(row.empty() ? "" : ", ") + config.system[s].axis[a].name + suffix(s) + " = " + number_text(value);
    *text += "\"" + work_offset_name(index) + "\" = { " + row + " }\n";
  }
}

// The rows with a tool.
void write_lives(const nc_control* control, std::string* text) {
  *text += "\n[" + std::string(kLives) + "]\n";
  double value = 0;
  for (unsigned number = 1; number <= NC_TOOL_LIVES; ++number) {
    if (nc_tool_life_get(control, number, NC_LIFE_GROUP, &value) != NC_OK || value == 0) continue;
    std::string row;
    for (unsigned c = 0; c < std::size(kLifeColumns); ++c)
      if (nc_tool_life_get(control, number, static_cast<nc_life_column>(c), &value) == NC_OK)
        row += std::string(row.empty() ? "" : ", ") + row_of(kLifeColumns[c]).name + " = " + number_text(value);
    *text += std::to_string(number) + " = { " + row + " }\n";
  }
}

void write_variables(const nc_control* control, const nc_config& config, std::string* text) {
  for (unsigned s = 0; s < config.system_count; ++s) {
    *text += "\n[variables" + suffix(s) + "]\n";
    double value = 0;
    for (std::uint32_t number = 0; nc_variable_next(control, api_system(s), number, &number, &value) == NC_OK; ++number)
      *text += std::to_string(number) + " = " + number_text(value) + "\n";
  }
  *text += "\n[" + std::string(kNames) + "]\n";
  nc_variable_range named{};
  (void)nc_variable_kind_get(nc_control_dialect(control), NC_VARIABLES_NAMED, &named);
  char name[8] = "";
  for (std::uint32_t number = named.first; number != 0 && number <= named.last; ++number)
    if (nc_variable_name_get(control, number, name) == NC_OK && name[0] != '\0') *text += std::to_string(number) + " = \"" + name + "\"\n";
}

// A number as one, another value as a text.
std::string quoted_value(const std::string& value) {
  double number = 0;
  return parse_number(value, &number) ? number_text(number) : quoted(value);
}

// ---- import ----

// The values of one import, each of them once.
class Values {
 public:
  Values(std::vector<TableValue>* values, ErrorList* errors) : values_(*values), errors_(*errors) {}
  void add(const TablePlace& place, std::string value, const ConfigPlace& at) {
    const auto [there, first] = places_.emplace(place_key(place), at);
    if (first) values_.push_back({place, std::move(value), at.line});
    else errors_.add_twice(at, there->second, "stands twice");
  }

 private:
  std::vector<TableValue>& values_;
  ErrorList& errors_;
  std::map<std::string, ConfigPlace> places_;
};

void read_variables(TableReader* root, unsigned system, Values* values) {
  const FieldInfo& range = row_of(Field::kVariableValue);
  root->table("variables" + suffix(system), [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node& node) {
      TablePlace place;
      place.table = Table::kVariable;
      place.system = system;
      const auto number = whole_number(key, 1, kLargest);
      if (!number) return reader.error(key, "must be the number of a common variable");
      place.number = *number;
      double value = 0;
      const auto* word = node.as_string();
      const bool vacant = word != nullptr && word->get() == kVacant;
      if (!vacant && !node_number(node, &value)) return reader.error(key, std::string("must be a finite number, or \"vacant\", not ") + shown_type(node));
      if (value < range.least || value > range.most) return reader.error(key, "must be " + number_text(range.least) + " to " + number_text(range.most) + ", as with variables.set");
      values->add(place, vacant ? "" : number_text(value), {line_of(node), reader.path(key)});
    });
  });
}

void read_lives(TableReader* root, Values* values) {
  root->table(kLives, [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node& node) {
      TablePlace place;
      place.table = Table::kToolLife;
      const auto number = whole_number(key, 1, NC_TOOL_LIVES);
      if (!number) return reader.error(key, "must be a row of the table of tool life, 1 to " + std::to_string(NC_TOOL_LIVES));
      place.number = *number;
      const toml::table* const row = node.as_table();
      if (row == nullptr) return reader.error(key, std::string("must be a table of columns, not ") + shown_type(node));
      TableReader columns(*row, reader.path(key), reader.errors());
      for (place.column = 0; place.column < std::size(kLifeColumns); ++place.column) {
        const FieldInfo& field = row_of(kLifeColumns[place.column]);
        double value = 0;
        if (columns.number(field.name, &value, -kLargestNumber, kLargestNumber)) values->add(place, number_text(value), {columns.line(field.name), columns.path(field.name)});
      }
      columns.finish();
    });
  });
}

// One value of a parameter. *axis gets the letter that `name` stands for, 0 = all axes.
void read_parameter(TableReader* reader, const std::string& name, const toml::node& node, const TablePlace& place, Values* values) {
  const auto text = parameter_text(node);
  if (!text) return reader->error(name, std::string("must be a number or a word, not ") + shown_type(node));
  if (text->empty() || text->size() > kLongestValue) return reader->error(name, "must have 1 to " + std::to_string(kLongestValue) + " bytes");
  values->add(place, *text, {line_of(node), reader->path(name)});
}

void read_parameters_of(TableReader* root, const nc_system_config& system, unsigned index, Values* values) {
  const auto has_axis = [&](const std::string& name) {
    bool found = false;
    for (unsigned a = 0; a < system.axis_count; ++a) found = found || (name.size() == 1 && system.axis[a].name == name[0]);
    return found;
  };
  root->table(std::string(kParameters) + suffix(index), [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node& node) {
      TablePlace place;
      place.table = Table::kParameter;
      place.system = index;
      place.key = key;
      if (key.empty() || key.find(' ') != std::string::npos) return reader.error(key, "cannot be the key of a parameter");
      const toml::table* const by_axis = node.as_table();
      if (by_axis == nullptr) return read_parameter(&reader, key, node, place, values);
      TableReader axes(*by_axis, reader.path(key), reader.errors());
      axes.each([&](const std::string& name, const toml::node& value) {
        if (name != kAll && !has_axis(name)) return axes.error(name, "no axis \"" + name + "\" is configured");
        place.axis = name == kAll ? '\0' : name[0];
        read_parameter(&axes, name, value, place, values);
      });
    });
  });
}

void read_names(TableReader* root, const nc_variable_range& named, Values* values) {
  root->table(kNames, [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node& node) {
      TablePlace place;
      place.table = Table::kVariableName;
      const auto number = whole_number(key, 1, kLargest);
      if (!number || *number < named.first || *number > named.last)
        return reader.error(key, "must be the number of a variable that can have a name, " + std::to_string(named.first) + " to " + std::to_string(named.last));
      place.number = *number;
      const auto* word = node.as_string();
      const std::string name = word != nullptr ? word->get() : "?";
      bool good = name.size() < sizeof(char[8]);
      for (std::size_t i = 0; i < name.size(); ++i) good = good && ((name[i] >= 'A' && name[i] <= 'Z') || (i > 0 && name[i] >= '0' && name[i] <= '9'));
      if (!good) return reader.error(key, "must be a name of at most 7 capital letters and digits, a letter first, or \"\"");
      values->add(place, name, {line_of(node), reader.path(key)});
    });
  });
}

// The sections that the configuration has as well.
void read_offsets(TableReader* root, const Config& machine, Values* values) {
  const auto read = std::make_unique<Config>();  // larger than what a thread's stack is for
  read->nc = machine.nc;
  read_tool_offsets(root, read.get());
  read_work_offsets(root, read.get());
  for (const ToolOffsetSetting& setting : read->tool_offsets) {
    for (unsigned c = 0; c < std::size(kToolColumns); ++c) {
      TablePlace place;
      place.number = setting.number;
      place.column = c;
      if (setting.given[c]) values->add(place, number_text(setting.column[c]), setting.place);
    }
    TablePlace label;
    label.table = Table::kToolLabel;
    label.number = setting.number;
    label.column = kNameColumn;
    if (setting.name) values->add(label, *setting.name, setting.place);
    label.column = kPocketColumn;
    if (setting.pocket) values->add(label, std::to_string(*setting.pocket), setting.place);
  }
  for (const WorkOffsetSetting& setting : read->work_offsets) {
    TablePlace place;
    place.table = Table::kOffset;
    place.system = setting.system;
    place.number = setting.index;
    place.axis = machine.nc.system[setting.system].axis[setting.axis].name;
    values->add(place, number_text(setting.value), setting.place);
  }
}

// The line on which more brackets are open than any table here needs, 0 = none. The parser calls itself for each of them, on the stack of a thread of the services.
// `text` has no text of several lines, so every line begins outside of texts and comments.
unsigned line_of_nesting(std::string_view text) {
  constexpr unsigned kMostOpen = 8;
  unsigned line = 1, open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      for (++i; i < text.size() && text[i] != c && text[i] != '\n'; ++i)
        if (c == '"' && text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == '[' || c == '{') {
      if (++open > kMostOpen) return line;
    } else if ((c == ']' || c == '}') && open > 0) {
      --open;
    }
    if (i < text.size() && text[i] == '\n') ++line;
  }
  return 0;
}

bool is_twice(const toml::parse_error& error) { return error.description().find("cannot redefine") != std::string_view::npos; }

// The line of the key or table that the parser has found a second time, 0 = none. The parser names the second line alone, so lines above it are taken away from the top
// until it finds nothing twice any more. Headers of tables stay where a key stands twice, because they say where it belongs.
unsigned first_of_twice(std::string_view text, const toml::parse_error& error) {
  if (!is_twice(error)) return 0;
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size() && lines.size() < error.source().begin.line; at += lines.back().size() + 1) lines.push_back(text.substr(at, text.find('\n', at) - at));
  const auto is_header = [](std::string_view line) { return line.find_first_not_of(" \t") != std::string_view::npos && line[line.find_first_not_of(" \t")] == '['; };
  const bool header = is_header(lines.back());
  const auto stays_twice = [&](std::size_t without) {
    std::string rest;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (i >= without || (!header && is_header(lines[i]))) rest.append(lines[i]).push_back('\n');
    try {
      (void)toml::parse(rest);
    } catch (const toml::parse_error& left) {
      return is_twice(left);
    }
    return false;
  };
  std::size_t good = 0, bad = lines.size();  // so many lines can be taken away, so many cannot
  while (bad - good > 1) (stays_twice((good + bad) / 2) ? good : bad) = (good + bad) / 2;
  return static_cast<unsigned>(good + 1);
}

std::string sentence(const std::vector<ConfigError>& errors) {
  std::string text;
  for (std::size_t i = 0; i < errors.size() && i < kMostErrors; ++i) {
    const ConfigError& error = errors[i];
    text += (text.empty() ? "" : "; ") + (error.line != 0 ? "line " + std::to_string(error.line) + ": " : "") + (error.key.empty() ? "" : error.key + ": ") + error.message;
  }
  if (errors.size() > kMostErrors) text += "; and " + std::to_string(errors.size() - kMostErrors) + " more";
  return text;
}

// Reads the sections with `read`. "" = they are good, else what is wrong with them, with lines; `sections` are those that there could be.
template <class Read>
std::string parse_sections(std::string_view text, std::vector<TableValue>* values, const char* sections, Read read) {
  ErrorList errors("");
  // A text of several lines could hide a key of too many parts from the line below, and nothing here needs one.
  for (const std::string_view mark : {"\"\"\"", "'''"})
    if (text.find(mark) != std::string_view::npos) return "holds a text of several lines";
  if (const unsigned line = line_of_too_deep_key(text)) return "line " + std::to_string(line) + ": a key of too many parts";
  if (const unsigned line = line_of_nesting(text)) return "line " + std::to_string(line) + ": values are nested too deep";
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const unsigned first = first_of_twice(text, error);
    return "line " + std::to_string(error.source().begin.line) + ": " + std::string(error.description()) + (first != 0 ? ", first in line " + std::to_string(first) : "");
  }
  Values all(values, &errors);
  TableReader reader(root, "", &errors);
  read(&reader, &all);
  reader.finish();
  if (!errors.empty()) return sentence(errors.take());
  return values->empty() ? std::string("holds none of ") + sections : "";
}

}  // namespace

std::string tables_toml(const nc_control* control, const nc_config& config, const ToolLabels& labels, const TomlTables& tables) {
  std::string text;
  if (tables.tools) write_tools(control, config, labels, &text);
  if (tables.offsets) write_offsets(control, config, &text);
  if (tables.lives) write_lives(control, &text);
  if (tables.variables) write_variables(control, config, &text);
  return text[0] == '\n' ? text.substr(1) : text;
}

std::string parameters_toml(const std::vector<TableValue>& values) {
  std::map<unsigned, std::map<std::string, std::vector<const TableValue*>>> systems;
  for (const TableValue& value : values) systems[value.place.system][value.place.key].push_back(&value);
  std::string text;
  for (const auto& [system, keys] : systems) {
    text += (text.empty() ? "[" : "\n[") + std::string(kParameters) + suffix(system) + "]\n";
    for (const auto& [key, rows] : keys) {
      std::string row;
      for (const TableValue* value : rows) row += (row.empty() ? "" : ", ") + (value->place.axis != 0 ? std::string(1, value->place.axis) : std::string(kAll)) + " = " + quoted_value(value->value);
      const bool single = rows.size() == 1 && rows[0]->place.axis == 0;
      text += quoted(key) + " = " + (single ? quoted_value(rows[0]->value) : "{ " + row + " }") + "\n";
    }
  }
  return text;
}

std::string parse_tables_toml(const Config& machine, std::string_view text, std::vector<TableValue>* values) {
  return parse_sections(text, values, "[tool_offsets], [work_offsets], [tool_life], [variables], [variable_names]", [&](TableReader* reader, Values* all) {
    nc_variable_range named{};
    (void)nc_variable_kind_get(static_cast<nc_dialect>(machine.nc.dialect), NC_VARIABLES_NAMED, &named);
    read_offsets(reader, machine, all);
    for (unsigned s = 0; s < machine.nc.system_count; ++s) read_variables(reader, s, all);
    read_lives(reader, all);
    read_names(reader, named, all);
  });
}

std::string parse_parameters_toml(const Config& machine, std::string_view text, std::vector<TableValue>* values) {
  return parse_sections(text, values, "[parameters]", [&](TableReader* reader, Values* all) {
    for (unsigned s = 0; s < machine.nc.system_count; ++s) read_parameters_of(reader, machine.nc.system[s], s, all);
  });
}

}  // namespace nc::rt::services
