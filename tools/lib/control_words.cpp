// SPDX-License-Identifier: Apache-2.0
// See control_words.hpp.
#include "tools/lib/control_words.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <map>
#include <set>
#include <vector>

namespace nc::tools {
namespace {

using namespace rt::services;

struct OwnCommand {
  const char* words;
  const char* arguments;
  Right right;
  const char* meaning;
  std::optional<Right> and_right = {};
};
// Commands that are no single service.
constexpr OwnCommand kOwn[] = {
    {"history", "[--since TIME] [--until TIME] [--kind KIND] [--user USER] [--count N | --all]", Right::kView,
     "the memory of the machine, the newest last: alarms, messages, actions of operators, changes, runs of programs; 50 entries without --count. TIME is 90s, 15m, 8h or 7d ago, or a date and time as '2026-01-31 08:00' or '2026-01-31'"},
    {"restart", "", Right::kView, "restart status: where a program that is begun inside stands, the recovery list, and how far the axes are away"},
    {"watch", "[DEVICES...] [--rate N] [--for SECONDS]", Right::kView, "the status again and again, or the values of devices of the ladder, signals and points, until Ctrl-C"},
    {"programs get", "NAME [FILE]", Right::kView, "reads a program, to standard output without FILE"},
    {"programs put", "FILE [--name NAME] [--replace]", Right::kSetUp, "writes a file into the folder of programs"},
    {"parameters export", "[FILE]", Right::kView, "the parameters that are set as TOML, to standard output without FILE"},
    {"parameters import", "FILE", Right::kMaintain, "sets the parameters that the sections of the file name and leaves the others as they are; - is standard input"},
    {"tables export", "[FILE] [--table TABLE]", Right::kView, "tool offsets, work offsets, tool life and common variables as TOML, to standard output without FILE"},
    {"tables import", "FILE", Right::kSetUp, "sets what the sections of the file name and leaves everything else as it is; - is standard input"},
    {"ladder swap", "FILE [--name NAME]", Right::kMaintain,
     "a ladder program takes the place of the one in execution, between two scans, and goes on with the state of its devices; - is standard input. It stays until ncrtd ends", Right::kOperate},
    {"trace record", "SIGNALS... [--trigger TRIGGER] [--when WHEN] [--level LEVEL] [--samples SAMPLES] [--before BEFORE] [--file FILE]", Right::kMaintain,
     "records signals in each scan and writes them as CSV, to standard output without --file. Ctrl-C ends the recording, and what it has is written"},
    {"trace save", "[FILE]", Right::kView, "the recording that has ended as CSV, to standard output without FILE"},
    {"pipe", "", Right::kView, "requests from standard input over one connection, one object of JSON in a line; replies likewise. Control stays from line to line"},
};

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

std::string arguments_of(const ServiceRow& row) {
  std::string text;
  for (const Wanted& wanted : row.request)
    if (wanted.required) text += " " + argument_name(row_of(wanted.field)) + (row_of(wanted.field).kind == Kind::kList ? "..." : "");
  for (const Wanted& wanted : row.request) {
    if (wanted.required) continue;
    const FieldInfo& field = row_of(wanted.field);
    text += " [" + option_name(field) + (field.kind == Kind::kFlag ? "" : " " + argument_name(field)) + "]";
  }
  if (row.service == Service::kJog) text += " --for SECONDS";
  if (row.service == Service::kMdi) text += " [--start]";
  return text.empty() ? text : text.substr(1);
}

std::string limit_text(double value) {
  if (value == std::floor(value) && std::fabs(value) < 1e16) return std::to_string(static_cast<long long>(value));
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string range_text(const FieldInfo& row) {
  if (row.kind == Kind::kFlag) return "";
  const std::string range = row.least == row.most ? limit_text(row.least) : limit_text(row.least) + " to " + limit_text(row.most);
  if (row.kind == Kind::kList) return range + " texts of at most " + std::to_string(kLongestText) + " bytes";
  return row.kind == Kind::kNumber || row.kind == Kind::kWhole ? range + (row.unit[0] != '\0' ? std::string(" ") + row.unit : "") : range + " bytes";
}

std::string request_text(const ServiceRow& row) {
  std::string text;
  for (const Wanted& wanted : row.request) text += (text.empty() ? "`" : ", `") + std::string(row_of(wanted.field).name) + "`" + (wanted.required ? "" : " (may)");
  return text.empty() ? "-" : text;
}

std::string reply_list(const ServiceRow& row) {
  std::string text;
  for (const ReplyRow& member : row.reply) text += "| `" + std::string(member.path) + "` | " + member.type + " | " + member.meaning + " |\n";
  return text;
}

// A word in the source of a manual page.
std::string man(std::string text) {
  std::string safe;
  for (const char c : text) safe += c == '-' ? std::string("\\-") : c == '\\' ? "\\e" : std::string(1, c);
  return safe;
}

// The next words of each beginning of a command: "" -> status, programs ...; "programs" -> list, put ...
std::map<std::string, std::set<std::string>> word_tree() {
  std::map<std::string, std::set<std::string>> tree;
  const auto add = [&](const std::string& words) {
    const std::size_t space = words.find(' ');
    tree[""].insert(words.substr(0, space));
    if (space != std::string::npos) tree[words.substr(0, space)].insert(words.substr(space + 1));
  };
  for (const ServiceRow& row : service_table())
    if (is_command(row)) add(replaced(row.name, '.', ' '));
  for (const OwnCommand& own : kOwn) add(own.words);
  return tree;
}

template <class Words>
std::string joined(const Words& words, const char* between) {
  std::string text;
  for (const auto& word : words) text.append(text.empty() ? "" : between).append(word);
  return text;
}

// ---- completion ----

// Options that say where the control is, each with a value.
constexpr const char* kAccess[] = {"--socket", "--control", "--domain", "--security", "--network", "--client"};

// Words that can stand for an argument or be the value of an option.
struct WordChoice {
  const char *of, *words;
};
constexpr WordChoice kWordChoices[] = {{"MODE", "auto mdi manual"}, {"ON", "on off"}, {"--kind", "alarm message action change run system"}, {"--table", "tools life offsets variables"}, {"--when", "rise fall change high low"}};

// A command as its line in the manual page has it.
struct CompletedCommand {
  std::string words;
  std::vector<std::string> arguments, options;
  std::set<std::string> with_values;  // those of the options
};

// `arguments`: such as "NAME [FILE] [--count N | --all]".
CompletedCommand completed_command(std::string words, const std::string& arguments) {
  CompletedCommand command;
  command.words = std::move(words);
  bool is_value = false;
  for (std::size_t at = 0; at < arguments.size();) {
    const std::size_t end = std::min(arguments.find(' ', at), arguments.size());
    const std::string word = arguments.substr(at, end - at);
    const std::size_t begin = word.find_first_not_of('[');
    const std::string bare = word.substr(begin, word.find_first_of("].", begin) - begin);
    at = end + 1;
    if (bare.rfind("--", 0) == 0) {
      command.options.push_back(bare);
      is_value = word.back() != ']';
      if (is_value) command.with_values.insert(bare);
    } else if (bare != "|") {
      if (!is_value) command.arguments.push_back(bare);
      is_value = false;
    }
  }
  return command;
}

// Those of two words first: a command of one word may begin as they do.
std::vector<CompletedCommand> completed_commands() {
  std::vector<CompletedCommand> all;
  for (const ServiceRow& row : service_table())
    if (is_command(row)) all.push_back(completed_command(replaced(row.name, '.', ' '), arguments_of(row)));
  for (const OwnCommand& own : kOwn) all.push_back(completed_command(own.words, own.arguments));
  std::stable_sort(all.begin(), all.end(), [](const CompletedCommand& one, const CompletedCommand& other) {
    const bool two = one.words.find(' ') != std::string::npos, other_two = other.words.find(' ') != std::string::npos;
    return two != other_two ? two : one.words < other.words;
  });
  return all;
}

std::set<std::string> options_with_values() {
  std::set<std::string> all;
  for (const CompletedCommand& command : completed_commands()) all.insert(command.with_values.begin(), command.with_values.end());
  return all;
}

}  // namespace

bool is_command(const ServiceRow& row) {
  constexpr Service kOthers[] = {Service::kLimit, Service::kHistory, Service::kExport, Service::kImport, Service::kParameterExport, Service::kParameterImport, Service::kLadderSwap, Service::kWatchBegin, Service::kWatchEnd, Service::kTraceRead, Service::kTakeControl, Service::kReleaseControl, Service::kProgramRead, Service::kProgramBegin, Service::kProgramData, Service::kProgramFinish, Service::kProgramAbandon};
  return std::find(std::begin(kOthers), std::end(kOthers), row.service) == std::end(kOthers);
}

std::string argument_name(const FieldInfo& row) {
  std::string name = replaced(row.name, '_', '-');
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string option_name(const FieldInfo& row) { return "--" + replaced(row.name, '_', '-'); }

std::string time_of(const std::string& text, double now, double* seconds) {
  const std::string wrong = "must be a time such as 15m, 8h, 7d, '2026-01-31' or '2026-01-31 08:00', is " + (text.empty() ? "empty" : text);
  constexpr std::string_view kUnits = "smhd";
  constexpr double kSeconds[] = {1, 60, 3600, 86400};
  const std::size_t unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
  if (unit != std::string_view::npos && text.size() < 11 && text.find_first_not_of("0123456789") == text.size() - 1) {
    *seconds = std::max(0.0, now - std::stod(text.substr(0, text.size() - 1)) * kSeconds[unit]);
    return "";
  }
  for (const char* form : {"%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M", "%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M", "%Y-%m-%d"}) {
    std::tm local{};
    local.tm_isdst = -1;
    const char* end = strptime(text.c_str(), form, &local);
    if (end == nullptr || *end != '\0') continue;
    const std::tm meant = local;
    const std::time_t time = std::mktime(&local);
    // A day that is not there (31 February) would silently become another one.
    if (time < 0 || meant.tm_mday != local.tm_mday || meant.tm_mon != local.tm_mon) return wrong;
    *seconds = static_cast<double>(time);
    return "";
  }
  return wrong;
}

std::string group_meaning(const std::string& word) {
  return "services whose names begin with " + word;
}

std::string services_markdown() {
  std::string text;
  for (unsigned right = 0; right < kRightCount; ++right) {
    text += "## Services that need the right to " + std::string(right_name(static_cast<Right>(right))) + "\n\n| service | request | meaning |\n|---|---|---|\n";
    for (const ServiceRow& row : service_table())
      if (row.right == static_cast<Right>(right)) text += "| `" + std::string(row.name) + "` | " + request_text(row) + " | " + row.meaning + (row.and_right ? "; needs the right to " + rights_text(row) : "") + " |\n";
    text += "\n";
  }
  text += "## Members of requests\n\n| member | type | range | meaning |\n|---|---|---|---|\n";
  for (unsigned i = 0; i < kFields; ++i) {
    const FieldInfo& row = row_of(static_cast<Field>(i));
    text += "| `" + std::string(row.name) + "` | " + kind_name(row.kind) + " | " + range_text(row) + " | " + row.meaning + " |\n";
  }
  text += "\n## Replies\n\nA service that is not here replies with `text`: what there is to say about it, often nothing.\n";
  for (const ServiceRow& row : service_table())
    if (row.reply.size() > 1 || std::string(row.reply[0].path) != "text")
      text += "\n### `" + std::string(row.name) + "`\n\n| member | type | meaning |\n|---|---|---|\n" + reply_list(row);
  return text;
}

std::string services_man() {
  std::string text;
  std::set<std::string> groups;
  const auto add = [&](const std::string& rights, const std::string& words, const std::string& arguments, const std::string& meaning) {
    const std::size_t space = words.find(' ');
    if (space != std::string::npos && groups.insert(words.substr(0, space)).second)
      text += ".TP\n.B " + words.substr(0, space) + "\nIs followed by one of these words:\n";
    text += ".TP\n.B " + man(words) + (arguments.empty() ? "" : "\n.RI \"" + man(arguments) + "\"") + "\n" + man(meaning) + ". Needs the right to " + rights + ".\n";
  };
  for (const ServiceRow& row : service_table())
    if (is_command(row)) add(rights_text(row), replaced(row.name, '.', ' '), arguments_of(row), row.meaning);
  for (const OwnCommand& own : kOwn) add(std::string(right_name(own.right)) + (own.and_right ? std::string(" and ") + right_name(*own.and_right) : ""), own.words, own.arguments, own.meaning);
  return text;
}

std::string services_bash() {
  std::string text =
      "# SPDX-License-Identifier: Apache-2.0\n# Completion of ncctl for bash, made by scripts/service-tables from the table of services.\n"
      "# The names of the programs, from the control that the line is about: those that come within a second.\n"
      "_ncctl_programs() {\n"
      "  local word=$1 self=ncctl name\n"
      "  shift\n"
      "  if [[ ${COMP_WORDS[0]} == */* && -x ${COMP_WORDS[0]} ]]; then self=${COMP_WORDS[0]}; fi\n"
      "  while IFS= read -r name; do\n"
      "    name=${name#'\"name\":\"'}\n"
      "    name=${name%'\"'}\n"
      "    if [[ $name == \"$word\"* ]]; then COMPREPLY+=(\"$(printf '%q' \"$name\")\"); fi\n"
      "  done < <(timeout 1 \"$self\" \"$@\" --json programs list 2>/dev/null </dev/null | grep -o '\"name\":\"[^\"\\]*\"')\n"
      "}\n"
      "_ncctl() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} words=() access=() value= options= arguments=() used=0 i\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case ${COMP_WORDS[i]} in\n"
      "      " + joined(kAccess, " | ") + ") access+=(\"${COMP_WORDS[i]}\" \"${COMP_WORDS[i + 1]-}\") value=${COMP_WORDS[i]}; ((i++)) ;;\n"
      "      " + joined(options_with_values(), " | ") + ") value=${COMP_WORDS[i]}; ((i++)) ;;\n"
      "      -*) ;;\n"
      "      *) words+=(\"${COMP_WORDS[i]}\") ;;\n"
      "    esac\n"
      "  done\n"
      "  COMPREPLY=()\n"
      "  if ((i > COMP_CWORD)); then  # the word is the value of an option\n"
      "    case $value in\n";
  for (const WordChoice& choice : kWordChoices)
    if (choice.of[0] == '-') text += std::string("      ") + choice.of + ") COMPREPLY=($(compgen -W '" + choice.words + "' -- \"$word\")) ;;\n";
  text += "      --socket | --security | --file) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;\n"
      "    esac\n"
      "    return 0\n"
      "  fi\n"
      "  case \"${words[0]-} ${words[1]-}\" in\n";
  for (const CompletedCommand& command : completed_commands()) {
    const bool two = command.words.find(' ') != std::string::npos;
    text += "    '" + command.words + (two ? "'" : " '*") + ") used=" + (two ? "2" : "1") + " options='" + joined(command.options, " ") + "' arguments=(" + joined(command.arguments, " ") + ") ;;\n";
  }
  text += "  esac\n"
      "  if [[ $word == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$options " + joined(kAccess, " ") + " --json --help --version\" -- \"$word\"))\n"
      "    return 0\n"
      "  fi\n"
      "  case ${#words[@]} in\n";
  const auto tree = word_tree();
  text += "    0) COMPREPLY=($(compgen -W '" + joined(tree.at(""), " ") + "' -- \"$word\")) ;;\n    1)\n      case ${words[0]} in\n";
  for (const auto& [first, next] : tree)
    if (!first.empty()) text += "        " + first + ") COMPREPLY=($(compgen -W '" + joined(next, " ") + "' -- \"$word\")) ;;\n";
  text += "      esac\n      ;;\n  esac\n"
      "  ((used > 0)) || return 0\n"
      "  case ${arguments[${#words[@]} - used]-} in\n"
      "    NAME) _ncctl_programs \"$word\" \"${access[@]}\" ;;\n"
      "    FILE) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;\n";
  for (const WordChoice& choice : kWordChoices)
    if (choice.of[0] != '-') text += std::string("    ") + choice.of + ") COMPREPLY=($(compgen -W '" + choice.words + "' -- \"$word\")) ;;\n";
  text += "  esac\n}\ncomplete -F _ncctl ncctl\n";
  return text;
}

}  // namespace nc::tools
