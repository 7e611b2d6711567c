// SPDX-License-Identifier: Apache-2.0
// Reads typed values from a TOML table and collects errors: unknown keys, wrong types, values out of
// range. Only the files that read the configuration include this.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/config.hpp"
#include "runtime/quantity.hpp"

namespace nc::rt {

// Errors of one file.
class ErrorList {
 public:
  explicit ErrorList(std::string file) : file_(std::move(file)) {}
  void add(unsigned line, std::string key, std::string message) {
    errors_.push_back({file_, line, std::move(key), std::move(message)});
  }
  // Two keys that mean the same. The one that stands lower in the file is wrong, and the sentence names the line of the other one: keys are not read in the order
  // of the file.
  void add_twice(const ConfigPlace& one, const ConfigPlace& other, const std::string& what);
  std::vector<ConfigError> take();  // sorted by line
  bool empty() const { return errors_.empty(); }

 private:
  std::string file_;
  std::vector<ConfigError> errors_;
};

// Line of the first key with far too many parts (a.b.c...), 0 = none. The parser nests a table for each part and would run out of stack when it
// frees them.
unsigned line_of_too_deep_key(std::string_view text);

inline unsigned line_of(const toml::node& node) {
  return static_cast<unsigned>(node.source().begin.line);
}
const char* type_name(const toml::node& node);
std::string shown_type(const toml::node& node);  // as type_name(), but nan and inf are named

// One table. Every key is asked for by name; finish() reports the keys that nobody asked for.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string path, ErrorList* errors)
      : table_(table), path_(std::move(path)), errors_(errors) {}

  // The value when the key is there, of the right type and in range; otherwise the target keeps its default.
  bool number(std::string_view key, double* value, double min, double max);
  bool computed(std::string_view key, double* value, double min, double max);  // one that a program may have computed, as near to 0 as it likes
  bool number(std::string_view key, double* value, const Quantity& quantity);
  template <class T>
  bool integer(std::string_view key, T* value, std::int64_t min, std::int64_t max) {
    std::int64_t read = 0;
    if (!integer64(key, &read, min, max)) return false;
    *value = static_cast<T>(read);
    return true;
  }
  bool boolean(std::string_view key, bool* value);
  // A text of no letters is no name: only where it says that there is none it is taken.
  enum class Empty : bool { kRefused, kTaken };
  bool string(std::string_view key, std::string* value, Empty empty = Empty::kRefused);
  // One word of a list; *index gets its index in the list.
  bool choice(std::string_view key, std::span<const std::string_view> words, unsigned* index);
  bool choice(std::string_view key, std::initializer_list<std::string_view> words, unsigned* index) {
    return choice(key, std::span(words.begin(), words.size()), index);
  }
  // An array of numbers with a length from min_size to max_size.
  bool numbers(std::string_view key, std::vector<double>* values, std::size_t min_size, std::size_t max_size);
  bool strings(std::string_view key, std::vector<std::pair<std::string, unsigned>>* values_and_lines);

  // Tables inside this table: `read` is called with a reader for the table, or for each table of the array.
  bool table(std::string_view key, const std::function<void(TableReader&)>& read);
  void tables(std::string_view key, const std::function<void(TableReader&, std::size_t)>& read);
  // Calls `read` for every key of this table, for tables whose keys are data.
  void each(const std::function<void(const std::string& key, const toml::node&)>& read);

  void require(std::string_view key);
  void finish();

  const toml::node* find(std::string_view key);
  std::string path(std::string_view key) const;
  const std::string& path() const { return path_; }
  unsigned line() const { return line_of(table_); }
  unsigned line(std::string_view key) const;
  void error(std::string_view key, std::string message);
  ErrorList* errors() { return errors_; }

 private:
  bool integer64(std::string_view key, std::int64_t* value, std::int64_t min, std::int64_t max);
  bool is_meant(const toml::node& node, std::string_view key, double value);
  void wrong_type(std::string_view key, const toml::node& node, const char* wanted);

  const toml::table& table_;
  std::string path_;
  ErrorList* errors_;
  std::vector<std::string> asked_;
  bool all_asked_ = false;  // each() has asked for every key there is
};

// The key whose value stands at a place of a text that is no TOML, as path() would write it: tables of an array are counted. Empty where no value stands there.
std::string key_at(std::string_view text, unsigned line, unsigned column);
// A finite number of a node (integer or float).
bool node_number(const toml::node& node, double* value);
// The shortest text that is read back as the same number.
std::string number_text(double value);

}  // namespace nc::rt
