// SPDX-License-Identifier: Apache-2.0
// Entry of the compiler: it reads the text line by line, and completes the code when all of it was read.
#include <algorithm>
#include <cmath>

#include "ladder/compiler.hpp"

namespace nc::ladder {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

std::string_view without_comment(std::string_view line) {
  line = line.substr(0, line.find(';'));
  return line.substr(0, line.find("//"));
}

// Replaces control characters, so that a text of the program cannot control a terminal.
void printable(std::string* text) {
  for (char& c : *text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
}

}  // namespace

void Compiler::error(std::string message) {
  error_at(line_, std::move(message));
}

void Compiler::error_at(unsigned line, std::string message) {
  if (errors_.size() >= kMaxErrors) return;
  printable(&message);
  errors_.push_back({file_, line, source_of(line), std::move(message)});
}

void Compiler::warning(std::string message) {
  if (code_.warnings.size() < kMaxErrors)
    code_.warnings.push_back({file_, line_, source_of(line_), std::move(message)});
}

std::string Compiler::source_of(unsigned line) const {
  return line == 0 || line > code_.source.size() ? std::string() : code_.source[line - 1];
}

// Splits a line into words, and keeps the line in the form that messages show.
void Compiler::read_line(std::string_view text) {
  constexpr std::size_t kShown = 80;
  words_.clear();
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    while (i < text.size() && is_blank(text[i])) ++i;
    const std::size_t start = i;
    while (i < text.size() && !is_blank(text[i])) ++i;
    if (i == start) break;
    words_.push_back(text.substr(start, i - start));
    if (shown.size() >= kShown) continue;
    if (!shown.empty()) shown += ' ';
    shown += words_.back().substr(0, kShown);
  }
  printable(&shown);
  code_.source.push_back(shown);
}

bool Compiler::options_hold() {
  const double ns = options_.scan_s * 1e9;
  if (!(ns >= 1e3 && ns <= 1e9)) {
    error_at(0, "the period of the scan must be from 1 us to 1 s");
    return false;
  }
  code_.scan_ns = static_cast<std::uint32_t>(std::llround(ns));
  if (options_.retain_d_first > kD || options_.retain_d_count > kD - options_.retain_d_first) {
    error_at(0, "the retained D devices must lie within D0 to D" + std::to_string(kD - 1));
    return false;
  }
  return true;
}

bool Compiler::run(std::string_view text) {
  if (!options_hold()) return false;
  if (text.size() > kMaxTextBytes) {
    error_at(0, "the program has more than " + std::to_string(kMaxTextBytes) + " bytes");
    return false;
  }
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);  // byte order mark
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    error_at(1 + static_cast<unsigned>(lines), "a byte 0 stands here: a ladder program is text, in ASCII or UTF-8 and not in UTF-16");
    return false;
  }
  for (std::size_t at = 0; at < text.size() && errors_.size() < kMaxErrors;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++line_;
    read_line(without_comment(text.substr(at, end - at)));
    at = end + 1;
    if (words_.empty()) continue;
    if (ended_) {
      warning("text behind END is not read");
      break;
    }
    if (code_.instructions >= kMaxInstructions) {
      error("the program has more than " + std::to_string(kMaxInstructions) + " instructions");
      break;
    }
    statement();
  }
  if (errors_.size() >= kMaxErrors) {
    errors_.push_back({file_, 0, "", "more errors than these are not reported"});
    return false;
  }
  finish();
  return errors_.empty();
}

void Compiler::finish() {
  if (!ended_) end_of_text();
  resolve_labels();
  if (!errors_.empty()) return;
  std::vector<std::uint32_t> targets;
  for (const auto& [number, label] : labels_) targets.push_back(label.step);
  finish_memories();
  lower(&code_, targets, main_end_);
  if (code_.layout.edges + code_.edge_start.size() > kMaxBits)
    return error_at(0, "more than " + std::to_string(kMaxBits) + " bits");
  code_.layout.bits += static_cast<std::uint32_t>(code_.edge_start.size());
  code_.layout.words += 2 * loops_;
  code_.table = table_;
  code_.aliases = names_.aliases();
  code_.step_budget = options_.step_budget;
  code_.retain_counters = options_.retain_counters;
  code_.retained_d = {options_.retain_d_first, options_.retain_d_count};
  code_.file = file_;
}

bool compile(std::string_view text, const std::string& file, const DeviceTable& table,
             const CompileOptions& options, Program* program, std::vector<Error>* errors) {
  Compiler compiler(file, table, options);
  const bool good = compiler.run(text);
  if (errors != nullptr) *errors = compiler.take_errors();
  if (good) program->code_ = std::make_shared<const Code>(compiler.take_code());
  return good;
}

}  // namespace nc::ladder
