// SPDX-License-Identifier: Apache-2.0
#include "rewrite.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>

#include "dialect/function_table.hpp"

namespace nc::permuted {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool blank(char c) { return c == ' ' || c == '\t'; }
char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

class Rewriter {
 public:
  Rewriter(const std::string& text, const Dialect& family, const Permutation& permutation)
      : text_(text), family_(family), permutation_(permutation) {}

  std::string run() {
    while (at_ < text_.size()) {
      const char c = upper(text_[at_]);
      if (c == '(') copy_until(')');
      else if (c == '<') copy_until('>');
      else if (c == '\n') line_end();
      else if (c == '#') variable();
      else if (c == '[') open();
      else if (c == ']') close();
      else if (digit(c) || c == '.') number();
      else if (c == 'G' && brackets_.empty() && !word("GOTO")) g_word();
      else if (c == 'P' && brackets_.empty() && parameter_input_ && begins_word()) parameter_word();
      else if (c == 'L' && brackets_.empty() && begins_word()) l_word();
      else if (word("GOTO") || word("WHILE") || word("POPEN") || word("PCLOS") || word("SETVN")) copy(4);
      else if (word("END")) copy(3);
      else if (c >= 'A' && c <= 'Z' && brackets_.empty() && begins_word()) letter();
      else copy(1);
    }
    return out_;
  }

 private:
  bool word(const char* name) const {
    for (size_t i = 0; name[i] != 0; ++i)
      if (at_ + i >= text_.size() || upper(text_[at_ + i]) != name[i]) return false;
    return true;
  }
  // Whether a letter with a value behind it begins here, and is not part of a name.
  bool begins_word() const {
    if (at_ > 0 && std::isalpha(static_cast<unsigned char>(text_[at_ - 1])) != 0) return false;
    size_t next = at_ + 1;
    while (next < text_.size() && (blank(text_[next]) || text_[next] == '-' || text_[next] == '+')) ++next;
    return next < text_.size() && (digit(text_[next]) || text_[next] == '.' || text_[next] == '#' || text_[next] == '[');
  }
  void letter() {
    const char c = text_[at_++];
    const char moved = Permutation::letter(upper(c));
    out_ += c == upper(c) ? moved : static_cast<char>(std::tolower(moved));
  }
  void copy(size_t count) {
    for (; count > 0 && at_ < text_.size(); --count) out_ += text_[at_++];
  }
  void copy_until(char end) {
    while (at_ < text_.size() && text_[at_] != end && text_[at_] != '\n') copy(1);
    if (at_ < text_.size() && text_[at_] == end) copy(1);
  }
  void skip_blanks() {
    while (at_ < text_.size() && blank(text_[at_])) copy(1);
  }
  std::string digits() const {
    size_t end = at_;
    while (end < text_.size() && digit(text_[end])) ++end;
    return text_.substr(at_, end - at_);
  }

  void line_end() {
    brackets_.clear();
    selects_parameter_ = false;
    if (g10_ && (l_ == 50 || l_ == 70)) parameter_input_ = true;
    g10_ = false;
    l_ = -1;
    copy(1);
  }
  void open() {
    brackets_ += of_variable_ ? '#' : '[';
    of_variable_ = false;
    copy(1);
  }
  void close() {
    if (!brackets_.empty()) brackets_.pop_back();
    copy(1);
  }

  void g_word() {
    copy(1);
    skip_blanks();
    const std::string whole = digits();
    const size_t behind = at_ + whole.size();
    const bool computed = whole.empty() && behind < text_.size() && (text_[behind] == '#' || text_[behind] == '[' || text_[behind] == '-');
    if (computed || whole.size() > 3) return;
    const int code = whole.empty() ? 0 : std::atoi(whole.c_str());
    at_ = behind;
    char moved[8];
    g_code_text('G', permutation_.code(code * 10), moved, sizeof moved);
    out_ += moved + 1;
    std::string decimals;
    while (at_ < text_.size() && (digit(text_[at_]) || text_[at_] == '.')) {
      decimals += text_[at_];
      copy(1);
    }
    const int tenths = decimals.size() > 1 ? decimals[1] - '0' : 0;
    const FunctionRow* row = find_function(family_, code * 10 + tenths);
    if (row != nullptr && row->function == Function::data_input) g10_ = true;
    if (row != nullptr && ends_data_input(row->function)) parameter_input_ = false;
  }
  void l_word() {
    letter();
    skip_blanks();
    const std::string value = digits();
    if (!value.empty()) l_ = std::atoi(value.c_str());
    copy(value.size());
  }
  void parameter_word() {
    letter();
    skip_blanks();
    const std::string value = digits();
    at_ += value.size();
    if (!value.empty()) out_ += std::to_string(permutation_.parameter(static_cast<uint32_t>(std::atoi(value.c_str()))));
  }

  void variable() {
    copy(1);
    skip_blanks();
    const std::string name = digits();
    if (name.empty()) {
      of_variable_ = at_ < text_.size() && text_[at_] == '[';
      return;
    }
    at_ += name.size();
    const auto number = static_cast<uint32_t>(std::strtoul(name.c_str(), nullptr, 10));
    const VariableRow* row = name.size() < 8 ? find_variable(*family_.variables, number) : nullptr;
    selects_parameter_ = brackets_.empty() && row != nullptr && row->what == SystemVariable::parameter_select && number == row->first;
    if (name.size() < 8 && permutation_.variable(number) != number) out_ += std::to_string(permutation_.variable(number));
    else out_ += name;
  }
  // A number like that in #[10000+#1] is one less than the first of a range.
  uint32_t moved_base(uint32_t number) const {
    const bool in_front = find_variable(*family_.variables, number) == nullptr && find_variable(*family_.variables, number + 1) != nullptr;
    return in_front ? permutation_.variable(number + 1) - 1 : permutation_.variable(number);
  }
  // A number that does not belong to a word which is rewritten.
  void number() {
    const std::string whole = digits();
    const size_t behind = at_ + whole.size();
    const bool constant = !whole.empty() && whole.size() < 8;
    const bool of_variable = constant && !brackets_.empty() && brackets_.back() == '#' && std::atoi(whole.c_str()) >= 1000;
    const bool of_parameter = constant && selects_parameter_ && brackets_.empty();
    const auto value = static_cast<uint32_t>(std::strtoul(whole.c_str(), nullptr, 10));
    at_ = behind;
    if (of_variable) out_ += std::to_string(moved_base(value));
    else if (of_parameter) out_ += std::to_string(permutation_.parameter(value));
    else out_ += whole;
    if (of_parameter) selects_parameter_ = false;
    while (at_ < text_.size() && (digit(text_[at_]) || text_[at_] == '.')) copy(1);
  }

  const std::string& text_;
  const Dialect& family_;
  const Permutation& permutation_;
  std::string out_;
  size_t at_ = 0;
  std::string brackets_;             // the open brackets: '#' around a variable's number, '[' any other
  bool of_variable_ = false;         // the next bracket is around a variable's number
  bool selects_parameter_ = false;   // the value of "#100000=" comes next
  bool g10_ = false;                 // G10 is in this block
  int l_ = -1;                       // L of this block, -1 = none
  bool parameter_input_ = false;
};

nlohmann::ordered_json moved_value(const nlohmann::ordered_json& value, Parameter what, const Permutation& permutation) {
  if (value.is_object()) return value;
  const double number = value.is_string() ? std::atof(value.get<std::string>().c_str()) : value.get<double>();
  if (what == Parameter::g_call_code) return permutation.code(static_cast<int>(std::lround(number * 10))) / 10.0;
  if (what == Parameter::ascii_call_letter && value.is_string() && value.get<std::string>().size() == 1)
    return std::string(1, Permutation::letter(value.get<std::string>()[0]));
  if (what == Parameter::ascii_call_variable && number >= 0) return permutation.variable(static_cast<uint32_t>(number));
  return value;
}

}  // namespace

std::string rewritten(const std::string& program, const Dialect& family, const Permutation& permutation) {
  return Rewriter(program, family, permutation).run();
}

nlohmann::ordered_json rewritten(const nlohmann::ordered_json& setup, const Dialect& family, const Permutation& permutation) {
  nlohmann::ordered_json out = setup;
  if (setup.contains("params")) {
    out["params"] = nlohmann::ordered_json::object();
    for (const auto& [key, value] : setup["params"].items()) {
      ParameterKey parsed;
      if (!parse_parameter_key(key.c_str(), &parsed)) {
        out["params"][key] = value;
        continue;
      }
      const ParameterRow* row = find_parameter(family, parsed);
      out["params"][std::to_string(permutation.parameter(parsed.number)) + key.substr(parsed.digits)] =
          row == nullptr ? value : moved_value(value, row->what, permutation);
    }
  }
  // Objects whose keys are numbers of variables.
  const auto move_keys = [&](nlohmann::ordered_json& owner, const char* name) {
    if (!owner.contains(name)) return;
    const nlohmann::ordered_json before = owner[name];
    owner[name] = nlohmann::ordered_json::object();
    for (const auto& [key, value] : before.items()) owner[name][std::to_string(permutation.variable(static_cast<uint32_t>(std::stoul(key))))] = value;
  };
  move_keys(out, "vars");
  move_keys(out, "inputs");
  if (setup.contains("events")) {
    for (nlohmann::ordered_json& event : out["events"]) move_keys(event, "inputs");
  }
  if (setup.contains("subprograms"))
    for (auto& [name, text] : out["subprograms"].items()) text = rewritten(text.get<std::string>(), family, permutation);
  return out;
}

}  // namespace nc::permuted
