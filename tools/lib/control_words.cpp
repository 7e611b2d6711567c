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
     "a ladder program takes the place of the one in execution, between two scans, and goes on with the state of its devices; - is standard input. It stays until ncrtd ends"},
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

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

bool is_command(const ServiceRow& row) {
  constexpr Service kOthers[] = {Service::kHistory, Service::kExport, Service::kImport, Service::kParameterExport, Service::kParameterImport, Service::kLadderSwap, Service::kWatchBegin, Service::kWatchEnd, Service::kTraceRead, Service::kTakeControl, Service::kReleaseControl, Service::kProgramRead, Service::kProgramBegin, Service::kProgramData, Service::kProgramFinish, Service::kProgramAbandon};
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
      if (row.right == static_cast<Right>(right)) text += "| `" + std::string(row.name) + "` | " + request_text(row) + " | " + row.meaning + " |\n";
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
  const auto add = [&](Right right, const std::string& words, const std::string& arguments, const std::string& meaning) {
    const std::size_t space = words.find(' ');
    if (space != std::string::npos && groups.insert(words.substr(0, space)).second)
      text += ".TP\n.B " + words.substr(0, space) + "\nIs followed by one of these words:\n";
    text += ".TP\n.B " + man(words) + (arguments.empty() ? "" : "\n.RI \"" + man(arguments) + "\"") + "\n" + man(meaning) + ". Needs the right to " + right_name(right) + ".\n";
  };
  for (const ServiceRow& row : service_table())
    if (is_command(row)) add(row.right, replaced(row.name, '.', ' '), arguments_of(row), row.meaning);
  for (const OwnCommand& own : kOwn) add(own.right, own.words, own.arguments, own.meaning);
  return text;
}

std::string services_bash() {
  const auto tree = word_tree();
  std::string text =
      "# SPDX-License-Identifier: Apache-2.0\n# Completion of ncctl for bash, made by scripts/service-tables from the table of services.\n_ncctl() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} words=() i\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case ${COMP_WORDS[i]} in\n"
      "      --socket | --control) ((i++)) ;;\n"
      "      -*) ;;\n"
      "      *) words+=(\"${COMP_WORDS[i]}\") ;;\n"
      "    esac\n"
      "  done\n"
      "  case ${#words[@]} in\n"
      "    0) COMPREPLY=($(compgen -W '--socket --control --json --help --version " + joined(tree.at("")) + "' -- \"$word\")) ;;\n"
      "    1)\n      case ${words[0]} in\n";
  for (const auto& [first, next] : tree)
    if (!first.empty()) text += "        " + first + ") COMPREPLY=($(compgen -W '" + joined(next) + "' -- \"$word\")) ;;\n";
  text += "        mode) COMPREPLY=($(compgen -W 'auto mdi manual' -- \"$word\")) ;;\n        single | optional) COMPREPLY=($(compgen -W 'on off' -- \"$word\")) ;;\n      esac\n      ;;\n"
      "    *) case \"${words[0]} ${words[1]}\" in 'programs put' | 'ladder swap' | 'tables import' | 'tables export' | 'parameters import' | 'parameters export' | 'trace save') COMPREPLY=($(compgen -f -- \"$word\")) ;; esac ;;\n"
      "  esac\n}\ncomplete -F _ncctl ncctl\n";
  return text;
}

}  // namespace nc::tools
