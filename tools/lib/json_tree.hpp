// SPDX-License-Identifier: Apache-2.0
// A JSON text as a small tree with the line of each value, for error messages.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nc::tools {

struct JsonMember;

/** One JSON value. */
struct JsonNode {
  enum class Type { kNull, kBool, kNumber, kString, kArray, kObject };

  Type type = Type::kNull;
  bool boolean = false;
  bool integer = false;  // the number was written without point and exponent, and fits into 64 bits
  double number = 0.0;
  std::string text;
  std::vector<JsonNode> items;      // elements of an array
  std::vector<JsonMember> members;  // members of an object, in the order of the text
  uint32_t line = 0;

  /** The type in words: "an object", "a number", ... */
  const char* type_name() const;
};

/** One key of an object with its value. A struct and not a std::pair, because a vector may have an incomplete element type, but a
 * std::pair may not. */
struct JsonMember {
  std::string first;
  JsonNode second;
};

/**
 * Parses `text`. Numbers that do not fit into a double, keys given twice or with control characters, more than 32
 * levels and everything that is not JSON are errors. @return false with "line N: why" in *error.
 */
bool parse_json(const std::string& text, JsonNode* root, std::string* error);

}  // namespace nc::tools
