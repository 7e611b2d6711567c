// SPDX-License-Identifier: Apache-2.0
// Input script: parser and execution. See input_script.hpp for the language.
#include "hal/sim/input_script.hpp"

#include <charconv>

namespace nc::hal {
namespace {

// A cursor over one statement.
struct Cursor {
  std::string_view rest;

  void blanks() {
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
  }
  bool word(std::string_view expected) {
    blanks();
    if (rest.substr(0, expected.size()) != expected) return false;
    rest.remove_prefix(expected.size());
    return true;
  }
  template <class T>
  bool number(T* value) {
    blanks();
    const auto result = std::from_chars(rest.data(), rest.data() + rest.size(), *value);
    if (result.ec != std::errc{}) return false;
    rest.remove_prefix(static_cast<std::size_t>(result.ptr - rest.data()));
    return true;
  }
  std::string_view name() {
    blanks();
    std::size_t n = 0;
    while (n < rest.size() && rest[n] != ' ' && rest[n] != '\t' && rest[n] != '=') ++n;
    const std::string_view result = rest.substr(0, n);
    rest.remove_prefix(n);
    return result;
  }
};

bool fail(std::string* error, std::string text) {
  *error = std::move(text);
  return false;
}

bool parse_when(Cursor* cursor, InputChange* change, std::string* error) {
  if (cursor->word("at")) {
    change->when = InputChange::When::kScan;
    if (!cursor->word("scan") || !cursor->number(&change->at))
      return fail(error, "'at' needs 'scan' and a number");
    return true;
  }
  if (!cursor->word("when"))
    return fail(error, "a statement begins with 'at scan N', 'when line N' or 'when M N'");
  if (cursor->word("line"))
    change->when = InputChange::When::kLine;
  else if (cursor->word("M"))
    change->when = InputChange::When::kM;
  else
    return fail(error, "'when' needs 'line' or 'M'");
  if (!cursor->number(&change->at)) return fail(error, "'when' needs a number");
  cursor->blanks();
  if (cursor->word("#")) {
    if (!cursor->number(&change->count) || change->count == 0)
      return fail(error, "'#' needs a number from 1");
  }
  return true;
}

}  // namespace

bool parse_input_change(std::string_view text, const PointTable& table, InputChange* change,
                        std::string* error) {
  Cursor cursor{text};
  *change = InputChange{};
  if (!parse_when(&cursor, change, error)) return false;
  if (!cursor.word(":")) return fail(error, "':' is missing before the point");
  const std::string name(cursor.name());
  const int index = table.find(name);
  if (index < 0) return fail(error, "no point is named '" + name + "'");
  if (table.at(static_cast<unsigned>(index)).direction != PointDirection::kInput)
    return fail(error, "point '" + name + "' is an output; a script changes inputs");
  if (table.at(static_cast<unsigned>(index)).bus != 0)
    return fail(error, "point '" + name + "' is carried by another bus; a script changes the machine's own");
  change->point = static_cast<unsigned>(index);
  if (!cursor.word("=") || !cursor.number(&change->value)) return fail(error, "'= value' is missing");
  if (table.at(change->point).type == PointType::kBit && change->value > 1)
    return fail(error, "point '" + name + "' is a bit: 0 or 1");
  cursor.blanks();
  if (!cursor.rest.empty()) return fail(error, "unexpected text '" + std::string(cursor.rest) + "'");
  return true;
}

InputScript::InputScript(std::vector<InputChange> changes)
    : changes_(std::move(changes)), seen_(changes_.size(), 0), done_(changes_.size(), false) {}

void InputScript::restart() noexcept {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    seen_[i] = 0;
    done_[i] = false;
  }
  last_line_ = 0;
  last_strobe_ = false;
}

void InputScript::step(std::uint64_t scan, const nc_source& source, bool m_strobe, std::uint32_t m,
                       PointImage* image) noexcept {
  // A line "comes" when it becomes the block in execution. While a sub program runs, the line of the main program does not
  // change.
  const std::uint32_t line = source.depth == 0 ? source.line : last_line_;
  const bool line_comes = line != last_line_;
  const bool strobe_comes = m_strobe && !last_strobe_;
  last_line_ = line;
  last_strobe_ = m_strobe;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (done_[i]) continue;
    const InputChange& change = changes_[i];
    bool now = false;
    switch (change.when) {
      case InputChange::When::kScan:
        now = scan >= change.at;
        break;
      case InputChange::When::kLine:
        now = line_comes && line == change.at && ++seen_[i] == change.count;
        break;
      case InputChange::When::kM:
        now = strobe_comes && m == change.at && ++seen_[i] == change.count;
        break;
    }
    if (!now) continue;
    image->value[change.point] = change.value;
    done_[i] = true;
  }
}

}  // namespace nc::hal
