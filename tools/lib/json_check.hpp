// SPDX-License-Identifier: Apache-2.0
// Checks of a JsonNode against a format: each either returns the value or throws an error with its line and reason. Used for setup
// and machine files.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "tools/lib/json_tree.hpp"

namespace nc::tools::json {

using Type = JsonNode::Type;

/** A message as one line of at most 300 bytes, whatever the file contains. */
std::string one_line(std::string text);

/** An error and its line; caught by the function that knows the name of the file. */
struct JsonError {
  uint32_t line;
  std::string text;
};

[[noreturn]] inline void fail(const JsonNode& node, const std::string& path, const std::string& why) {
  throw JsonError{node.line, one_line(path.empty() ? why : path + ": " + why)};
}

inline const JsonNode& expect(const JsonNode& node, const std::string& path, Type type) {
  if (node.type == type) return node;
  JsonNode wanted;
  wanted.type = type;
  fail(node, path, std::string("must be ") + wanted.type_name() + ", is " + node.type_name());
}

inline double number(const JsonNode& node, const std::string& path) {
  return expect(node, path, Type::kNumber).number;
}
inline bool boolean(const JsonNode& node, const std::string& path) {
  return expect(node, path, Type::kBool).boolean;
}
inline const std::string& text(const JsonNode& node, const std::string& path) {
  return expect(node, path, Type::kString).text;
}

inline uint32_t whole(const JsonNode& node, const std::string& path, uint32_t low, uint32_t high) {
  const double value = number(node, path);
  if (std::floor(value) != value || value < low || value > high)
    fail(node, path, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<uint32_t>(value);
}

inline std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}
inline std::string item_path(const std::string& path, size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

inline void check_keys(const JsonNode& object, const std::string& path,
                       std::initializer_list<const char*> known) {
  for (const auto& [key, value] : object.members) {
    bool found = false;
    for (const char* k : known) found = found || key == k;
    if (!found) fail(value, join(path, key), "no such key");
  }
}

inline const JsonNode* member(const JsonNode& object, const char* key) {
  for (const auto& [name, value] : object.members)
    if (name == key) return &value;
  return nullptr;
}

inline std::string one_of(const JsonNode& node, const std::string& path,
                          std::initializer_list<const char*> words) {
  const std::string& value = text(node, path);
  std::string list;
  for (const char* word : words) {
    if (value == word) return value;
    list += std::string(list.empty() ? "" : ", ") + word;
  }
  fail(node, path, "must be one of " + list);
}

/** Reads a whole text file; one of more than 64 MiB is an error. */
bool read_text_file(const std::string& path, std::string* content, std::string* error);

}  // namespace nc::tools::json
