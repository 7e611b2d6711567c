// SPDX-License-Identifier: Apache-2.0
// See tool_labels.hpp.
#include "runtime/tools/tool_labels.hpp"

#include "runtime/config.hpp"
#include "runtime/programs/encoding.hpp"

namespace nc::rt {
namespace {

// Controls of ASCII and of the rows behind it (U+0080 to U+009F), which some terminals obey, and the two characters of Unicode that end a line.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < ' ' || first == 0x7f;
  if (character.size() == 2) return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
  return character == "\xe2\x80\xa8" || character == "\xe2\x80\xa9";
}

}  // namespace

const ToolLabel& label_of(const ToolLabels& labels, unsigned tool) {
  static const ToolLabel kNoLabel;
  const auto found = labels.find(tool);
  return found == labels.end() ? kNoLabel : found->second;
}

std::string tool_name_trouble(std::string_view name) {
  if (name.size() > kLongestToolName) return "must have at most " + std::to_string(kLongestToolName) + " bytes";
  while (!name.empty()) {
    const std::size_t length = utf8_length(name);
    if (length == 0) return "must be a text in UTF-8";
    if (is_control(name.substr(0, length))) return "must not have control characters";
    name.remove_prefix(length);
  }
  return "";
}

unsigned other_in_pocket(const ToolLabels& labels, unsigned tool) {
  const unsigned pocket = label_of(labels, tool).pocket;
  if (pocket == 0) return 0;
  for (const auto& [number, label] : labels)
    if (number != tool && label.pocket == pocket) return number;
  return 0;
}

std::string tool_text(const ToolLabels& labels, unsigned tool) {
  const std::string& name = label_of(labels, tool).name;
  return "tool " + std::to_string(tool) + (name.empty() ? "" : " (" + name + ")");
}

ToolLabels configured_labels(const Config& config) {
  ToolLabels labels;
  for (const ToolOffsetSetting& setting : config.tool_offsets)
    if (setting.name || setting.pocket) labels[setting.number] = {setting.name.value_or(""), setting.pocket.value_or(0)};
  return labels;
}

}  // namespace nc::rt
