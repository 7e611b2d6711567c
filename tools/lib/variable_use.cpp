// SPDX-License-Identifier: Apache-2.0
// Finds the variables that programs use; see variable_use.hpp.
#include "tools/lib/variable_use.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tools/lib/command_text.hpp"
#include "tools/lib/commands.hpp"
#include "tools/lib/program_files.hpp"

namespace nc::tools {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return c >= 'A' && c <= 'Z'; }

/** A block as the lexer sees it: in capitals, without blanks and comments. `name` gets the text between < and >. */
std::string condensed(const std::string& line, std::string* name) {
  std::string out;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '(') {
      i = std::min(line.find(')', i), line.size());
    } else if (c == '<') {
      const size_t end = std::min(line.find('>', i), line.size());
      *name = line.substr(i + 1, end - i - 1);
      i = end;
    } else if (c != ' ' && c != '\t' && c != '\r' && c != '\0' && c != '\x7f') {
      out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    }
  }
  return out;
}

/** The position after the operand of a '#'. The operand begins at `at` and is digits, a name, an expression in brackets or another '#'. */
size_t behind_operand(const std::string& s, size_t at) {
  if (at < s.size() && s[at] == '#') return behind_operand(s, at + 1);
  if (at < s.size() && s[at] == '[') {
    int depth = 0;
    for (; at < s.size(); ++at) {
      depth += s[at] == '[' ? 1 : s[at] == ']' ? -1 : 0;
      if (depth == 0) return at + 1;
    }
    return at;
  }
  const bool name = at < s.size() && letter(s[at]);
  while (at < s.size() && (digit(s[at]) || (name && letter(s[at])))) ++at;
  return at;
}

class TextReader {
 public:
  TextReader(std::string file, nc_dialect dialect) : file_(std::move(file)), dialect_(dialect) { (void)nc_variable_kind_get(dialect, NC_VARIABLES_LOCAL, &local_); }

  TextUses read(const std::string& text) {
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size());
      ++line_;
      std::string name;
      const std::string block = condensed(text.substr(begin, end - begin), &name);
      variables(block);
      calls(block, name);
      begin = end + 1;
    }
    return std::move(found_);
  }

 private:
  void variables(const std::string& block) {
    for (size_t at = block.find('#'); at != std::string::npos; at = block.find('#', at + 1)) {
      const size_t end = behind_operand(block, at + 1);
      const std::string text = block.substr(at, end - at);
      VariableUse use;
      use.text = text;
      const bool plain = text.size() > 1 && text.size() <= 9 && std::all_of(text.begin() + 1, text.end(), digit);
      if (plain) use.number = static_cast<uint32_t>(std::stoul(text.substr(1)));
      if (text.size() == 1 || (plain && use.number <= local_.last)) continue;
      // A name may be in brackets, as in [#DEPTH]=5.
      const bool in_brackets = letter(text[1]) && end < block.size() && block[end] == ']';
      const size_t behind = in_brackets ? end + 1 : end;
      const bool target = at == 0 || block[at - 1] != '#';  // in ##120= the variable #120 is only read: it has the number of the one that is written
      const bool written = target && behind < block.size() && block[behind] == '=';
      (written ? use.written : use.read) = {file_, line_};
      found_.uses.push_back(use);
    }
  }

  // Finds calls of programs: P and a number, or a name.
  void calls(const std::string& block, const std::string& name) {
    if (!block.empty() && block[0] == 'O' && block.size() > 1 && digit(block[1])) found_.programs.push_back(number(block, 1));
    const bool external = has_code(block, NC_CODE_CALL_EXTERNAL);
    const bool call = external || has_code(block, NC_CODE_CALL) || has_code(block, NC_CODE_MACRO_CALL) || has_code(block, NC_CODE_INTERRUPT);
    if (!call) return;
    const size_t device = block.find(",D");
    const std::string place = external                                                               ? "198:"
                              : device != std::string::npos && device + 2 < block.size() && block[device + 2] != '0' ? "D" + block.substr(device + 2, 1) + ":"
                                                                                                     : "";
    const size_t p = block.find('P');
    if (!name.empty()) {
      found_.calls.push_back({place + name, line_});
    } else if (p != std::string::npos) {
      const bool plain = p + 1 < block.size() && digit(block[p + 1]);
      found_.calls.push_back({plain ? place + "O" + std::to_string(number(block, p + 1)) : "", line_});
    }
  }

  static uint32_t number(const std::string& block, size_t at) {
    uint64_t n = 0;
    for (; at < block.size() && digit(block[at]); ++at) n = std::min<uint64_t>(n * 10 + static_cast<uint64_t>(block[at] - '0'), 999999999);
    return static_cast<uint32_t>(n);
  }

  /** A code of the block has this role in the dialect. */
  bool has_code(const std::string& block, nc_code_role role) const {
    for (size_t at = block.find_first_of("GM"); at != std::string::npos; at = block.find_first_of("GM", at + 1)) {
      if (at + 1 == block.size() || !digit(block[at + 1])) continue;
      const uint32_t whole = number(block, at + 1);
      const size_t point = std::min(block.find_first_not_of("0123456789", at + 1), block.size());
      const bool tenth = point + 1 < block.size() && block[point] == '.' && digit(block[point + 1]);
      const auto times_ten = std::min<uint64_t>(uint64_t{whole} * 10 + (tenth ? static_cast<uint64_t>(block[point + 1] - '0') : 0), UINT32_MAX);
      if (nc_code_role_get(dialect_, block[at], block[at] == 'G' ? static_cast<uint32_t>(times_ten) : whole) == role) return true;
    }
    return false;
  }

  const std::string file_;
  const nc_dialect dialect_;
  nc_variable_range local_{};
  uint32_t line_ = 0;
  TextUses found_;
};

/** Collects the main program and the programs that it calls, each text once. */
class Collector {
 public:
  Collector(const SessionOptions& options, nc_dialect dialect, std::FILE* err)
      : err_(err), dialect_(dialect), files_(options.programs ? *options.programs : folder_of(options.program)) {
    files_.set_external(options.external);
    text_.encoding = options.encoding;
  }

  bool add(const std::string& path, std::string* error) {
    if (!seen_.insert(path).second) return true;
    const auto program = rt::ProgramText::open_file(path, text_, error);
    if (program == nullptr) {
      *error = path + ": " + *error;
      return false;
    }
    std::string text(static_cast<size_t>(program->size()), '\0');
    const long got = program->read(0, text.data(), text.size());
    if (got < 0) {
      *error = path + ": cannot be read";
      return false;
    }
    const TextUses found = uses_of(text, path, dialect_);
    for (const VariableUse& use : found.uses) keep(use);
    for (const TextUses::Call& call : found.calls) follow(call, path, found.programs);
    return true;
  }
  const std::vector<VariableUse>& uses() const { return uses_; }

  static std::string folder_of(const std::string& path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
  }

 private:
  void keep(const VariableUse& use) {
    const auto there = places_.try_emplace(use.text, uses_.size());
    if (there.second) return uses_.push_back(use);
    VariableUse& known = uses_[there.first->second];
    if (known.read.line == 0) known.read = use.read;
    if (known.written.line == 0) known.written = use.written;
  }

  void follow(const TextUses::Call& call, const std::string& path, const std::vector<uint32_t>& own) {
    for (const uint32_t number : own)
      if (call.name == "O" + std::to_string(number)) return;  // the called program is in this text
    const std::string where = rt::valid_utf8(path + ":" + std::to_string(call.line));
    std::string error;
    if (call.name.empty()) {
      std::fprintf(err_, "note: %s: the number of the program called is computed: not followed\n", where.c_str());
    } else if (const std::string found = files_.find_called(call.name); found.empty()) {
      std::fprintf(err_, "note: %s: %s is not there: not followed\n", where.c_str(), rt::valid_utf8(call.name).c_str());
    } else if (!add(found, &error)) {
      std::fprintf(err_, "note: %s: %s\n", where.c_str(), rt::valid_utf8(error).c_str());
    }
  }

  std::FILE* err_;
  nc_dialect dialect_;
  ProgramFiles files_;
  rt::ProgramText::Options text_;
  std::set<std::string> seen_;
  std::vector<VariableUse> uses_;
  std::map<std::string, size_t> places_;
};

/** The meaning of a number according to the tables of the dialect. A common variable that no option brings is there if the machine has a range with it. */
std::string meaning(const VariableUse& use, nc_dialect dialect) {
  if (use.number == 0) {
    const char first = use.text.size() > 1 ? use.text[1] : '\0';
    return letter(first) ? "by its name" : digit(first) ? "" : "computed";  // a number of more digits than any variable has
  }
  nc_system_variable row;
  for (unsigned i = 0; nc_system_variable_row(dialect, i, &row) == NC_OK; ++i)
    if (use.number >= row.first && use.number <= row.last) return row.name;
  nc_config config;
  nc_config_init(&config);
  config.dialect = dialect;
  config.extended_variables = true;
  config.variable_ranges[0] = {use.number, use.number};
  uint32_t taken = 0;
  if (nc_variable_range_check(&config, 0, &taken) == NC_OK) return "common variable of a machine";
  return taken != 0 ? "common variable" : "";
}

std::string place_text(const TextPlace& place) {
  return place.line == 0 ? "" : rt::valid_utf8(place.file) + ":" + std::to_string(place.line);
}

}  // namespace

TextUses uses_of(const std::string& text, const std::string& file, nc_dialect dialect) { return TextReader(file, dialect).read(text); }

int variable_use_command(const SessionOptions& options, std::FILE* out, std::FILE* err) {
  const std::optional<nc_dialect> dialect = dialect_from_name(options.dialect);
  if (!dialect) return complain(err, no_dialect(options.dialect));
  Collector collector(options, *dialect, err);
  std::string error;
  if (!collector.add(options.program, &error)) return complain(err, error);
  std::vector<VariableUse> uses = collector.uses();
  std::stable_sort(uses.begin(), uses.end(), [](const VariableUse& a, const VariableUse& b) {
    return (a.number == 0) != (b.number == 0) ? b.number == 0 : a.number != b.number ? a.number < b.number : a.text < b.text;
  });
  std::fprintf(out, "variable\twhat\tread first\twritten first\n");
  for (const VariableUse& use : uses)
    std::fprintf(out, "%s\t%s\t%s\t%s\n", use.text.c_str(), meaning(use, *dialect).c_str(), place_text(use.read).c_str(), place_text(use.written).c_str());
  return close_output(out, err, kExitEnded);
}

}  // namespace nc::tools
