// SPDX-License-Identifier: Apache-2.0
// Parses JSON text into a tree with line numbers; see json_tree.hpp. The SAX parser of nlohmann-json
// reads through an iterator that counts the line ends it passes, so in a callback the count is the line of the
// token that was just read.
#include "tools/lib/json_tree.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/lib/json_check.hpp"

namespace nc::tools {

const char* JsonNode::type_name() const {
  switch (type) {
    case Type::kNull:
      return "null";
    case Type::kBool:
      return "true or false";
    case Type::kNumber:
      return "a number";
    case Type::kString:
      return "a string";
    case Type::kArray:
      return "a list";
    case Type::kObject:
      return "an object";
  }
  return "";
}

namespace {

constexpr size_t kMaxLevels = 32;

// Input iterator over bytes that counts lines in a variable shared by all its copies.
class LineCounting {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineCounting(const char* at, uint32_t* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  LineCounting& operator++() {
    if (*at_++ == '\n') ++*line_;
    return *this;
  }
  LineCounting operator++(int) {
    LineCounting before = *this;
    ++*this;
    return before;
  }
  bool operator==(const LineCounting& other) const { return at_ == other.at_; }
  bool operator!=(const LineCounting& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  uint32_t* line_;
};

class TreeBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(JsonNode* root, const uint32_t* line) : root_(root), line_(line) {}
  std::string error;

  bool null() override { return place({}); }
  bool boolean(bool value) override {
    JsonNode node;
    node.type = JsonNode::Type::kBool;
    node.boolean = value;
    return place(std::move(node));
  }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value), true); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value), true); }
  bool number_float(number_float_t value, const string_t&) override { return number(value, false); }
  bool string(string_t& value) override {
    JsonNode node;
    node.type = JsonNode::Type::kString;
    node.text = value;
    return place(std::move(node));
  }
  bool binary(binary_t&) override { return fail("binary values have no place here"); }
  bool start_object(std::size_t) override { return open(JsonNode::Type::kObject); }
  bool start_array(std::size_t) override { return open(JsonNode::Type::kArray); }
  bool end_object() override { return shut(); }
  bool end_array() override { return shut(); }
  bool key(string_t& value) override {
    for (const char c : value)
      if (static_cast<unsigned char>(c) < 0x20) return fail("a key has a control character");
    for (const auto& member : open_.back()->members)
      if (member.first == value) return fail("the key \"" + value + "\" stands here twice");
    key_ = value;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& why) override {
    if (!error.empty()) return false;
    if (dynamic_cast<const nlohmann::detail::out_of_range*>(&why) != nullptr) {  // "... parsing '1e400'"
      const std::string what = why.what();
      const size_t quote = what.find('\'');
      const bool value = !open_.empty() && open_.back()->type == JsonNode::Type::kObject && !key_.empty();
      return fail((value ? key_ + ": " : "") + "the number " +
                  (quote == std::string::npos ? "" : what.substr(quote) + " ") + "is too large");
    }
    // From "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..." only the part after the
    // place is kept.
    std::string text = why.what();
    const size_t colon = text.find(": ");
    if (colon != std::string::npos) text = text.substr(colon + 2);
    return fail(text);
  }

 private:
  bool fail(const std::string& why) {
    error = "line " + std::to_string(*line_) + ": " + json::one_line(why);
    return false;
  }
  bool number(double value, bool integer) {
    if (!std::isfinite(value)) return fail("a number is too large");
    JsonNode node;
    node.type = JsonNode::Type::kNumber;
    node.number = value;
    node.integer = integer;
    return place(std::move(node));
  }
  JsonNode* put(JsonNode&& node) {
    node.line = *line_;
    if (open_.empty()) return &(*root_ = std::move(node));
    JsonNode* parent = open_.back();
    if (parent->type == JsonNode::Type::kArray) {
      parent->items.push_back(std::move(node));
      return &parent->items.back();
    }
    parent->members.push_back({std::move(key_), std::move(node)});
    return &parent->members.back().second;
  }
  bool place(JsonNode&& node) {
    put(std::move(node));
    return true;
  }
  bool open(JsonNode::Type type) {
    if (open_.size() >= kMaxLevels) return fail("nested too deep");
    JsonNode node;
    node.type = type;
    open_.push_back(put(std::move(node)));  // the pointer stays valid, because nothing is added to the parent while this node is open
    return true;
  }
  bool shut() {
    open_.pop_back();
    return true;
  }

  JsonNode* root_;
  const uint32_t* line_;
  std::vector<JsonNode*> open_;
  std::string key_;
};

}  // namespace

bool parse_json(const std::string& text, JsonNode* root, std::string* error) {
  uint32_t line = 1;
  *root = JsonNode();
  TreeBuilder builder(root, &line);
  const LineCounting begin(text.data(), &line), end(text.data() + text.size(), &line);
  if (nlohmann::json::sax_parse(begin, end, &builder)) return true;
  *error = builder.error.empty() ? "line " + std::to_string(line) + ": not JSON" : builder.error;
  return false;
}

std::string json::one_line(std::string text) {
  constexpr size_t kMost = 300;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  return text;
}

bool json::read_text_file(const std::string& path, std::string* content, std::string* error) {
  constexpr size_t kMaxBytes = size_t{64} << 20;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    *error = path + ": is a folder";
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    *error = path + ": cannot be opened";
    return false;
  }
  content->clear();
  char buffer[65536];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0) {
    content->append(buffer, static_cast<size_t>(file.gcount()));
    if (content->size() > kMaxBytes) {
      *error = path + ": larger than 64 MiB";
      return false;
    }
  }
  if (file.bad()) {
    *error = path + ": cannot be read";
    return false;
  }
  return true;
}

}  // namespace nc::tools
