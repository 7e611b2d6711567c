// SPDX-License-Identifier: Apache-2.0
// Configuration sections [parameters], [work_offsets], [tool_offsets].
#include <algorithm>
#include <charconv>
#include <optional>

#include "runtime/config_sections.hpp"
#include "runtime/tools/tool_labels.hpp"
#include "runtime/work_offset_name.hpp"

namespace nc::rt {
namespace {

constexpr double kMaxOffset = 1e6;
constexpr std::string_view kColumns[] = {"length", "length_wear", "radius", "radius_wear"};

std::string no_axis(std::string_view name) {
  return "no axis \"" + std::string(name) + "\" is configured";
}

// Name and pocket of a tool. The pocket is one in which none of the tools before it is.
void read_label(TableReader* columns, const Config& config, ToolOffsetSetting* setting) {
  std::string name;
  if (columns->string("name", &name, TableReader::Empty::kTaken)) {
    const std::string trouble = tool_name_trouble(name);
    if (trouble.empty()) setting->name = name;
    else columns->error("name", trouble);
  }
  unsigned pocket = 0;
  if (!columns->integer("pocket", &pocket, 0, kMostPocket)) return;
  setting->pocket = pocket;
  for (const ToolOffsetSetting& other : config.tool_offsets)
    if (pocket != 0 && other.pocket == pocket) columns->error("pocket", "pocket " + std::to_string(pocket) + " has tool " + std::to_string(other.number) + (other.name.value_or("").empty() ? "" : " (" + *other.name + ")"));
}

// "X" and "X1" are one axis. Where this parameter of the axis stands already, null: nowhere.
const ConfigPlace* place_of_parameter(const Config& config, const std::string& key, char axis, unsigned system) {
  for (const ParameterSetting& other : config.parameters)
    if (other.key == key && other.axis == axis && other.system == system) return &other.place;
  return nullptr;
}

const ConfigPlace* place_of_offset(const Config& config, const WorkOffsetSetting& setting) {
  for (const WorkOffsetSetting& other : config.work_offsets)
    if (other.index == setting.index && other.system == setting.system && other.axis == setting.axis) return &other.place;
  return nullptr;
}

}  // namespace

std::string parameter_text(double number) {  // nc_parameter_set() reads no exponent
  char buffer[400];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::fixed);
  return {buffer, result.ptr};
}

std::optional<std::string> parameter_text(const toml::node& node) {
  double number = 0;
  if (node_number(node, &number)) return parameter_text(number);
  if (const auto* text = node.as_string()) return text->get();
  return {};
}

// The line is that of the first of the note's parameters that is set for its axis or for all, else of one that is set for another axis, which is what makes the difference.
std::string parameter_note_text(const Config& config, unsigned system, const nc_parameter_note& note) {
  const ParameterSetting* found = nullptr;
  bool exact = false;
  for (unsigned k = 0; k < note.key_count && !exact; ++k) {
    for (const ParameterSetting& parameter : config.parameters) {
      if (exact || parameter.key != note.key[k] || (parameter.axis != 0 && parameter.system != system)) continue;
      exact = note.axis == 0 || parameter.axis == 0 || parameter.axis == note.axis;
      if (exact || found == nullptr) found = &parameter;
    }
  }
  const ConfigPlace place = found != nullptr ? found->place : ConfigPlace{0, "parameters"};
  return ConfigError{config.file, place.line, place.key, note.text}.text();
}

void read_parameters(TableReader* root, Config* config) {
  root->table("parameters", [&](TableReader& reader) {
    reader.each([&](const std::string& key, const toml::node& node) {
      if (const toml::table* by_axis = node.as_table()) {
        for (const auto& [axis_name, value] : *by_axis) {
          unsigned system = 0, axis = 0;
          const auto text = parameter_text(value);
          const ConfigPlace place{line_of(value), reader.path(key) + "." + std::string(axis_name.str())};
          if (!find_axis(*config, axis_name.str(), &system, &axis))
            reader.errors()->add(place.line, place.key, no_axis(axis_name.str()));
          else if (!text)
            reader.errors()->add(place.line, place.key,
                                 std::string("must be a finite number or a word, not ") + shown_type(value));
          else if (const ConfigPlace* const other = place_of_parameter(*config, key, axis_name.str()[0], system); other != nullptr)
            reader.errors()->add_twice(place, *other, "parameter " + key + " of this axis is already there");
          else
            config->parameters.push_back({key, axis_name.str()[0], system, *text, place});
        }
        return;
      }
      const auto text = parameter_text(node);
      if (!text)
        reader.error(
            key, std::string("must be a finite number, a word, or a table by axis, not ") + shown_type(node));
      else
        config->parameters.push_back({key, 0, 0, *text, {line_of(node), reader.path(key)}});
    });
  });
}

void read_work_offsets(TableReader* root, Config* config) {
  root->table("work_offsets", [&](TableReader& reader) {
    reader.each([&](const std::string& name, const toml::node& node) {
      const auto index = work_offset_index(name, config->nc.work_offsets);
      if (!index) {
        reader.error(name, "must be EXT, G54 to G59, or \"G54.1P1\" to \"G54.1P" +
                               std::to_string(config->nc.work_offsets) + "\"");
        return;
      }
      const toml::table* table = node.as_table();
      if (table == nullptr) {
        reader.error(name, std::string("must be a table by axis, not ") + shown_type(node));
        return;
      }
      TableReader by_axis(*table, reader.path(name), reader.errors());
      by_axis.each([&](const std::string& axis_name, const toml::node& value) {
        WorkOffsetSetting setting;
        setting.index = *index;
        setting.place = {line_of(value), by_axis.path(axis_name)};
        if (!find_axis(*config, axis_name, &setting.system, &setting.axis))
          by_axis.error(axis_name, no_axis(axis_name));
        else if (const ConfigPlace* const other = place_of_offset(*config, setting); other != nullptr)
          by_axis.errors()->add_twice(setting.place, *other, name + " of this axis is already there");
        else if (by_axis.computed(axis_name, &setting.value, -kMaxOffset, kMaxOffset))
          config->work_offsets.push_back(setting);
      });
    });
  });
}

void read_tool_offsets(TableReader* root, Config* config) {
  root->table("tool_offsets", [&](TableReader& reader) {
    reader.each([&](const std::string& name, const toml::node& node) {
      const auto number = whole_number(name, 1, config->nc.tool_offsets);
      if (!number) {
        reader.error(name, "must be an offset number from 1 to " + std::to_string(config->nc.tool_offsets));
        return;
      }
      ToolOffsetSetting setting;
      setting.number = *number;
      setting.place = {line_of(node), reader.path(name)};
      for (const ToolOffsetSetting& other : config->tool_offsets)
        if (other.number == *number)
          reader.errors()->add_twice(setting.place, other.place, "offset " + std::to_string(*number) + " is already there");
      if (const toml::table* table = node.as_table()) {
        TableReader columns(*table, reader.path(name), reader.errors());
        for (unsigned c = 0; c < 4; ++c)
          setting.given[c] = columns.computed(kColumns[c], &setting.column[c], -kMaxOffset, kMaxOffset);
        read_label(&columns, *config, &setting);
        columns.finish();
      } else {
        setting.given[NC_TOOL_LENGTH] =
            reader.computed(name, &setting.column[NC_TOOL_LENGTH], -kMaxOffset, kMaxOffset);
      }
      config->tool_offsets.push_back(setting);
    });
  });
}

}  // namespace nc::rt
