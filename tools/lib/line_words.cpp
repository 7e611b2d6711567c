// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/line_words.hpp"

#include <charconv>
#include <limits>
#include <system_error>

namespace nc::tools {
namespace {

bool is_number(std::string_view text) { return !text.empty() && text.find_first_not_of("+-.0123456789") == std::string_view::npos; }

}  // namespace

void LineWords::read(std::string_view line) {
  words_.clear();
  digits_.clear();
  assigns_ = false;
  if (!gather(line)) words_.clear();
  std::erase_if(words_, [this](const PlainWord& word) { return !is_number(number(word)); });
}

bool LineWords::gather(std::string_view line) {
  bool comment = false, comma = false;
  int depth = 0;
  for (const char raw : line) {
    const char c = raw >= 'a' && raw <= 'z' ? static_cast<char>(raw - 32) : raw;
    if (comment || c == '(') {
      comment = c != ')';
      continue;
    }
    if (c == ';') break;
    depth += c == '[' || c == '<' ? 1 : c == ']' || c == '>' ? -1 : 0;
    if (depth > 0 || c == ' ' || c == '\t' || c == '\r') continue;
    assigns_ = assigns_ || c == '=';
    if (c >= 'A' && c <= 'Z') {
      if (!words_.empty() && words_.back().end == words_.back().begin) return false;  // two letters in a row are a keyword of a macro statement
      words_.push_back({c, comma, digits_.size(), digits_.size()});
    } else if (c != ',' && !words_.empty()) {
      digits_ += c;
      words_.back().end = digits_.size();
    }
    comma = c == ',';
  }
  return true;
}

double LineWords::value(const PlainWord& word) const {
  std::string_view text = number(word);
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace nc::tools
