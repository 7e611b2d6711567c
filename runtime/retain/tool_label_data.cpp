// SPDX-License-Identifier: Apache-2.0
// See tool_label_data.hpp. Keys are "tool 3 name" and "tool 3 pocket".
#include "runtime/retain/tool_label_data.hpp"

#include <charconv>
#include <set>

#include "runtime/retain/changed_rows.hpp"

namespace nc::rt {
namespace {

constexpr char kLabelsHead[] = "nc tools 1";
constexpr std::string_view kTool = "tool ", kName = " name", kPocket = " pocket";

bool parse(std::string_view text, unsigned most, unsigned* number) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, *number);
  return result.ec == std::errc{} && result.ptr == end && *number <= most;
}

struct Key {
  unsigned tool = 0;
  bool is_pocket = false;
};

bool parse_key(std::string_view text, Key* key) {
  if (text.substr(0, kTool.size()) != kTool) return false;
  text.remove_prefix(kTool.size());
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return false;
  key->is_pocket = text.substr(space) == kPocket;
  return (key->is_pocket || text.substr(space) == kName) && text[0] != '0' && parse(text.substr(0, space), ~0u, &key->tool);
}

bool is_good(const Key& key, const std::string& value) {
  unsigned pocket = 0;
  return key.is_pocket ? parse(value, kMostPocket, &pocket) && std::to_string(pocket) == value : tool_name_trouble(value).empty();
}

void add_changes(unsigned tool, const ToolLabel& before, const ToolLabel& now, std::vector<ChangedRow>* rows) {
  const std::string key = std::string(kTool) + std::to_string(tool);
  if (now.name != before.name) rows->push_back({key + std::string(kName), before.name, now.name});
  if (now.pocket != before.pocket) rows->push_back({key + std::string(kPocket), std::to_string(before.pocket), std::to_string(now.pocket)});
}

}  // namespace

std::string encode_tool_labels(const ToolLabels& now, const ToolLabels& configured) {
  std::set<unsigned> tools;
  for (const ToolLabels* labels : {&now, &configured})
    for (const auto& [tool, label] : *labels) tools.insert(tool);
  std::vector<ChangedRow> rows;
  for (const unsigned tool : tools) add_changes(tool, label_of(configured, tool), label_of(now, tool), &rows);
  return encode_rows_of(kLabelsHead, rows);
}

bool restore_tool_labels(const std::string& bytes, unsigned most, ToolLabels* labels, std::vector<std::string>* remarks) {
  std::vector<ChangedRow> rows;
  if (!decode_rows_of(kLabelsHead, bytes, &rows)) return false;
  ToolLabels read = *labels;
  std::set<unsigned> kept;  // tools whose pocket is that of the file
  std::set<std::string> keys, pockets;
  for (const ChangedRow& row : rows) {
    Key key;
    if (!parse_key(row.key, &key) || !is_good(key, row.value) || !keys.insert(row.key).second) return false;
    if (key.is_pocket && row.value != "0" && !pockets.insert(row.value).second) return false;
    if (key.tool > most) continue;
    const ToolLabel& configured = label_of(*labels, key.tool);
    if (row.configured != (key.is_pocket ? std::to_string(configured.pocket) : configured.name)) continue;
    ToolLabel& label = read[key.tool];
    if (!key.is_pocket) {
      label.name = row.value;
    } else if (parse(row.value, kMostPocket, &label.pocket)) {
      kept.insert(key.tool);
    }
  }
  for (const unsigned tool : kept) {
    const unsigned other = other_in_pocket(read, tool);
    if (other == 0) continue;
    remarks->push_back(tool_text(read, tool) + " was in pocket " + std::to_string(read[tool].pocket) + ", which the configuration gives to " + tool_text(read, other) + ": it is in none");
    read[tool].pocket = 0;
  }
  *labels = std::move(read);
  return true;
}

bool ToolLabelData::restore(const std::string& bytes) {
  ToolLabels labels = configured_;
  remarks_.clear();
  if (!restore_tool_labels(bytes, most_, &labels, &remarks_)) return false;
  table_.replace(std::move(labels));
  return true;
}

std::string ToolLabelData::why_refused(const std::string& bytes) const {
  return is_of_other_version(kLabelsHead, bytes) ? kOtherVersion : RetainedData::why_refused(bytes);
}

}  // namespace nc::rt
