// SPDX-License-Identifier: Apache-2.0
// TOML table reader. See toml_reader.hpp.
#include "runtime/toml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace nc::rt {

void ErrorList::add_twice(const ConfigPlace& one, const ConfigPlace& other, const std::string& what) {
  const bool lower = one.line > other.line || (one.line == other.line && one.key > other.key);
  const ConfigPlace &first = lower ? other : one, &second = lower ? one : other;
  add(second.line, second.key, what + (first.line == second.line ? ", also in this line" : ", first in line " + std::to_string(first.line)) + (first.key == second.key ? "" : " as " + first.key));
}

std::vector<ConfigError> ErrorList::take() {
  std::stable_sort(errors_.begin(), errors_.end(),
                   [](const ConfigError& a, const ConfigError& b) { return a.line < b.line; });
  return std::move(errors_);
}

unsigned line_of_too_deep_key(std::string_view text) {
  constexpr unsigned kMostParts = 64;
  unsigned line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {  // skips a text up to its end on this line, because a dot in it does not separate parts of a key
      for (++i; i < text.size() && text[i] != c && text[i] != '\n'; ++i)
        if (c == '"' && text[i] == '\\') ++i;
      if (i < text.size() && text[i] == '\n') --i;
    } else if (c == '#') {
      while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (c == '\n') {
      ++line;
      dots = 0;
    } else if (c == '.') {
      if (++dots >= kMostParts) return line;
    } else if (c == '=' || c == ',' || c == '[' || c == '{') {
      dots = 0;
    }
  }
  return 0;
}

// Only plain files are read here: a key in front of the first '=' of the line in which the value begins, and the last header above it.
std::string key_at(std::string_view text, unsigned line, unsigned column) {
  const auto trimmed = [](std::string_view part) {
    const std::size_t begin = part.find_first_not_of(" \t\r"), end = part.find_last_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view() : part.substr(begin, end - begin + 1);
  };
  std::string header, key;
  std::vector<std::string> arrays;
  for (unsigned n = 1; n <= line && !text.empty(); ++n) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (n == line) row = row.substr(0, std::min<std::size_t>(row.size(), column));
    const std::string_view plain = trimmed(row);
    const std::size_t equals = row.find('=');
    if (plain.starts_with("[") && equals == std::string_view::npos && n != line) {
      const bool several = plain.starts_with("[[");
      const std::size_t close = plain.find(']');
      if (close == std::string_view::npos) continue;  // a row of an array
      header = std::string(trimmed(plain.substr(several ? 2 : 1, close - (several ? 2 : 1))));
      if (several) arrays.push_back(header);
      if (several) header += "[" + std::to_string(std::count(arrays.begin(), arrays.end(), header)) + "]";
      key.clear();
    } else if (equals != std::string_view::npos && !plain.starts_with("#")) {
      key = std::string(trimmed(row.substr(0, equals)));
    }
  }
  return key.empty() || header.empty() ? key : header + "." + key;
}

const char* type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

bool node_number(const toml::node& node, double* value) {
  if (const auto* integer = node.as_integer()) {
    *value = static_cast<double>(integer->get());
    return true;
  }
  if (const auto* real = node.as_floating_point()) {
    if (!std::isfinite(real->get())) return false;
    *value = real->get() + 0.0;  // zero has no sign
    return true;
  }
  return false;
}

std::string number_text(double value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value + 0.0);  // zero has no sign
  return std::string(buffer, result.ptr);
}

const toml::node* TableReader::find(std::string_view key) {
  asked_.emplace_back(key);
  return table_.get(key);
}

std::string TableReader::path(std::string_view key) const {
  const bool plain = !key.empty() && key.find_first_of(". \"#/*") == std::string_view::npos;
  const std::string shown = plain ? std::string(key) : "\"" + std::string(key) + "\"";
  return path_.empty() ? shown : path_ + "." + shown;
}

unsigned TableReader::line(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr ? line_of(*node) : line();
}

void TableReader::error(std::string_view key, std::string message) {
  errors_->add(line(key), path(key), std::move(message));
}

// As type_name(), but nan and inf are named: "a number" would not explain why they are refused.
std::string shown_type(const toml::node& node) {
  const auto* real = node.as_floating_point();
  if (real == nullptr || std::isfinite(real->get())) return type_name(node);
  return std::isnan(real->get()) ? "nan" : real->get() < 0 ? "-inf" : "inf";
}

void TableReader::wrong_type(std::string_view key, const toml::node& node, const char* wanted) {
  error(key, std::string("must be ") + wanted + ", not " + shown_type(node));
}

// Nor is any farther from 0 than this: ranges of single keys are far nearer, and lists have none.
constexpr double kMostMeant = 1e12;

bool TableReader::is_meant(const toml::node& node, std::string_view key, double value) {
  if (value == 0 || (std::abs(value) >= kLeastMeant && std::abs(value) <= kMostMeant)) return true;
  errors_->add(line_of(node), path(key), "must not be " + number_text(value) + ", which is neither 0 nor anything that a machine can mean");
  return false;
}

bool TableReader::number(std::string_view key, double* value, const Quantity& quantity) {
  double read = 0;
  if (!number(key, &read, quantity.or_zero ? 0 : quantity.least, quantity.most)) return false;
  if (read < quantity.least && !(quantity.or_zero && read == 0)) {
    error(key, "must be 0, or from " + number_text(quantity.least) + " to " + number_text(quantity.most) + ", not " + number_text(read));
    return false;
  }
  *value = read;
  return true;
}

bool TableReader::computed(std::string_view key, double* value, double min, double max) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  double read = 0;
  if (!node_number(*node, &read)) {
    wrong_type(key, *node, "a finite number");
    return false;
  }
  if (read < min || read > max) {
    error(key, "must be from " + number_text(min) + " to " + number_text(max) + ", not " + number_text(read));
    return false;
  }
  *value = read;
  return true;
}

bool TableReader::number(std::string_view key, double* value, double min, double max) {
  double read = 0;
  if (!computed(key, &read, min, max) || !is_meant(*table_.get(key), key, read)) return false;
  *value = read;
  return true;
}

bool TableReader::integer64(std::string_view key, std::int64_t* value, std::int64_t min, std::int64_t max) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const auto* integer = node->as_integer();
  if (integer == nullptr) {
    wrong_type(key, *node, "an integer");
    return false;
  }
  if (integer->get() < min || integer->get() > max) {
    error(key, "must be from " + std::to_string(min) + " to " + std::to_string(max) + ", not " +
                   std::to_string(integer->get()));
    return false;
  }
  *value = integer->get();
  return true;
}

bool TableReader::boolean(std::string_view key, bool* value) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const auto* read = node->as_boolean();
  if (read == nullptr) {
    wrong_type(key, *node, "true or false");
    return false;
  }
  *value = read->get();
  return true;
}

bool TableReader::string(std::string_view key, std::string* value, Empty empty) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const auto* read = node->as_string();
  if (read == nullptr) {
    wrong_type(key, *node, "a string");
    return false;
  }
  if (read->get().find('\0') != std::string::npos) {  // a path or a name would end at the NUL
    error(key, "must not hold a NUL");
    return false;
  }
  if (read->get().empty() && empty == Empty::kRefused) {
    error(key, "must not be empty");
    return false;
  }
  *value = read->get();
  return true;
}

bool TableReader::choice(std::string_view key, std::span<const std::string_view> words, unsigned* index) {
  std::string word;
  if (!string(key, &word, Empty::kTaken)) return false;
  unsigned i = 0;
  std::string list;
  for (const std::string_view candidate : words) {
    if (candidate == word) {
      *index = i;
      return true;
    }
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + ("\"" + std::string(candidate) + "\"");
    ++i;
  }
  error(key, "must be " + list + ", not \"" + word + "\"");
  return false;
}

bool TableReader::numbers(std::string_view key, std::vector<double>* values, std::size_t min_size,
                          std::size_t max_size) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    wrong_type(key, *node, "an array of numbers");
    return false;
  }
  if (array->size() < min_size || array->size() > max_size) {
    error(key, "must have " +
                   (min_size == max_size ? std::to_string(min_size)
                                         : std::to_string(min_size) + " to " + std::to_string(max_size)) +
                   " numbers, not " + std::to_string(array->size()));
    return false;
  }
  std::vector<double> read;
  for (const toml::node& element : *array) {
    double number = 0;
    if (!node_number(element, &number)) {
      errors_->add(line_of(element), path(key),
                   std::string("must hold finite numbers, not ") + shown_type(element));
      return false;
    }
    if (!is_meant(element, key, number)) return false;
    read.push_back(number);
  }
  *values = std::move(read);
  return true;
}

bool TableReader::strings(std::string_view key,
                          std::vector<std::pair<std::string, unsigned>>* values_and_lines) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    wrong_type(key, *node, "an array of strings");
    return false;
  }
  for (const toml::node& element : *array) {
    if (const auto* text = element.as_string())
      values_and_lines->emplace_back(text->get(), line_of(element));
    else
      errors_->add(line_of(element), path(key), std::string("must hold strings, not ") + type_name(element));
  }
  return true;
}

bool TableReader::table(std::string_view key, const std::function<void(TableReader&)>& read) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  const toml::table* sub = node->as_table();
  if (sub == nullptr) {
    wrong_type(key, *node, "a table");
    return false;
  }
  TableReader reader(*sub, path(key), errors_);
  read(reader);
  reader.finish();
  return true;
}

void TableReader::tables(std::string_view key, const std::function<void(TableReader&, std::size_t)>& read) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    wrong_type(key, *node, "an array of tables ([[...]])");
    return;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string place = path(key) + "[" + std::to_string(i + 1) + "]";
    const toml::table* sub = array->get(i)->as_table();
    if (sub == nullptr) {
      errors_->add(line_of(*array->get(i)), place,
                   std::string("must be a table, not ") + type_name(*array->get(i)));
      continue;
    }
    TableReader reader(*sub, place, errors_);
    read(reader, i);
    reader.finish();
  }
}

void TableReader::each(const std::function<void(const std::string& key, const toml::node&)>& read) {
  all_asked_ = true;
  for (const auto& [key, node] : table_) read(std::string(key.str()), node);
}

void TableReader::require(std::string_view key) {
  if (table_.get(key) == nullptr) errors_->add(line(), path(key), "is missing");
}

void TableReader::finish() {
  if (all_asked_) return;
  for (const auto& [key, node] : table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
    std::string known;
    std::vector<std::string> names = asked_;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    errors_->add(static_cast<unsigned>(key.source().begin.line), path(key.str()),
                 "unknown key" + (known.empty() ? std::string() : " (known here: " + known + ")"));
  }
}

}  // namespace nc::rt
