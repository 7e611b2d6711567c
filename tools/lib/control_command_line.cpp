// SPDX-License-Identifier: Apache-2.0
// The command line of ncctl, from the table of services. See control_command.hpp.
#include <CLI/CLI.hpp>

#include <ctime>
#include <string_view>

#include "nc/control.h"
#include "runtime/programs/encoding.hpp"
#include "runtime/services/service_table.hpp"
#include "tools/lib/control_command.hpp"
#include "tools/lib/control_words.hpp"
#include "tools/lib/option_values.hpp"

namespace nc::tools {
namespace {

using rt::services::FieldInfo;
using rt::services::Kind;
using rt::services::ServiceRow;
using rt::services::Wanted;
using What = ControlCommand::What;

// Takes one value of the command line as the kind that the table says. What is out of range the control refuses.
std::string take(const FieldInfo& row, const std::string& text, Json* args) {
  if (rt::valid_utf8(text) != text) return "must be UTF-8";
  switch (row.kind) {
    case Kind::kNumber:
    case Kind::kWhole: {
      const Json number = Json::parse(text, nullptr, false);
      const Json plain = Json::parse(!text.empty() && text[0] == '+' ? text.substr(1) : text, nullptr, false);
      const Json& value = number.is_number() ? number : plain;
      if (!value.is_number()) return "must be a number, is " + (text.empty() ? "empty" : text);
      (*args)[row.name] = value;
      return "";
    }
    case Kind::kFlag:
      if (text != "on" && text != "off") return "must be on or off, is " + (text.empty() ? "empty" : text);
      (*args)[row.name] = text == "on";
      return "";
    default:
      (*args)[row.name] = text;
      return "";
  }
}

void add_field(CLI::App* app, const Wanted& wanted, ControlCommand* command) {
  const FieldInfo& row = row_of(wanted.field);
  const std::string name = wanted.required ? argument_name(row) : option_name(row);
  const std::string meaning = std::string(row.meaning) + (row.unit[0] != '\0' ? ", " + std::string(row.unit) : "");
  if (row.kind == Kind::kFlag && !wanted.required) {
    app->add_flag_function(name, [command, &row](std::int64_t) { command->args[row.name] = true; }, meaning);
    return;
  }
  if (row.kind == Kind::kList) {
    app->add_option_function<std::vector<std::string>>(name, [command, &row](const std::vector<std::string>& texts) { command->args[row.name] = texts; }, meaning)
        ->required(wanted.required)
        ->expected(-1)  // how many there may be the control knows
        ->each([name](const std::string& text) {
          if (rt::valid_utf8(text) != text) throw CLI::ValidationError(name, "must be UTF-8");
        });
    return;
  }
  CLI::Option* option = app->add_option_function<std::string>(
      name,
      [command, &row, name](const std::string& text) {
        if (const std::string wrong = take(row, text, &command->args); !wrong.empty()) throw CLI::ValidationError(name, wrong);
      },
      meaning);
  option->required(wanted.required);
}

// The subcommand of these words, separated by points; it is made where it is not there yet.
CLI::App* subcommand(CLI::App* app, const std::string& words, const std::string& meaning) {
  const std::size_t point = words.find('.');
  const std::string first = words.substr(0, point);
  CLI::App* sub = nullptr;
  for (CLI::App* there : app->get_subcommands([](CLI::App*) { return true; }))
    if (there->get_name() == first) sub = there;
  if (sub == nullptr) sub = app->add_subcommand(first, point == std::string::npos ? meaning : group_meaning(first));
  if (point == std::string::npos) return sub;
  sub->require_subcommand(1);
  return subcommand(sub, words.substr(point + 1), meaning);
}

// First the members that must be there, which are arguments.
void add_fields(CLI::App* app, const ServiceRow& row, ControlCommand* command) {
  for (const bool required : {true, false})
    for (const Wanted& wanted : row.request)
      if (wanted.required == required) add_field(app, wanted, command);
}

void add_service(CLI::App* app, const ServiceRow& row, ControlCommand* command) {
  CLI::App* sub = subcommand(app, row.name, std::string(row.meaning) + " (" + rights_text(row) + ")");
  add_fields(sub, row, command);
  sub->callback([command, &row] { command->service = row.name; });
  if (row.service == rt::services::Service::kJog) {
    sub->add_option("--for", command->seconds, "how long the axis moves, at most 60")->required()->check(seconds(false, "60"));
    sub->callback([command, &row] { command->service = row.name, command->what = What::kJog; });
  }
  if (row.service == rt::services::Service::kRestartApproach) sub->callback([command, &row] { command->service = row.name, command->what = What::kApproach; });
  if (row.service == rt::services::Service::kMdi) {
    sub->add_flag("--start", command->start, "start them as well");
    sub->callback([command, &row] { command->service = row.name, command->what = What::kMdi; });
  }
}

void add_own_commands(CLI::App* app, ControlCommand* command) {
  CLI::App* watch = app->add_subcommand("watch", "the status again and again, or the values of devices, until Ctrl-C (view)");
  watch->add_option_function<std::vector<std::string>>("DEVICES", [command](const std::vector<std::string>& names) { command->args["devices"] = names; }, "devices of the ladder, signals and points; without them, the status")
      ->expected(-1)
      ->each([](const std::string& text) {
        if (rt::valid_utf8(text) != text) throw CLI::ValidationError("DEVICES", "must be UTF-8");
      });
  watch->add_option("--rate", command->rate, "lines per second, at most 50")->check(CLI::Range(0.1, 50.0));
  watch->add_option("--for", command->seconds, "seconds, then end")->check(CLI::Range(0.01, 1e6));
  watch->callback([command] { command->what = What::kWatch; });

  // Without one of its words it is the list.
  CLI::App* history = subcommand(app, "history.counters", "")->get_parent();
  history->description("the memory of the machine, the newest last; or one of these words (view)");
  history->require_subcommand(0, 1);
  const auto time = [command, history](const std::string& name, const char* member, const char* meaning) {
    history->add_option_function<std::string>(
        name,
        [command, name, member](const std::string& text) {
          double seconds = 0;
          if (const std::string wrong = time_of(text, static_cast<double>(std::time(nullptr)), &seconds); !wrong.empty()) throw CLI::ValidationError(name, wrong);
          command->args[member] = seconds;
        },
        meaning);
  };
  time("--since", "since", "only what came since this time: 15m, 8h, 7d ago, or a local date, '2026-01-31' or '2026-01-31 08:00'");
  time("--until", "until", "only what came until this time");
  history->add_option_function<std::string>("--kind", [command](const std::string& kind) { command->args["kind"] = kind; }, "alarm, message, action, change, run or system")
      ->check(CLI::IsMember({"alarm", "message", "action", "change", "run", "system"}));
  history->add_option_function<std::string>("--user", [command](const std::string& user) { command->args["user"] = user; }, "only what this user has done")->check(given());
  CLI::Option* count = history->add_option_function<unsigned>("--count", [command](unsigned entries) { command->args["count"] = entries; }, "the newest ones, at most 500; 50 without it")->transform(whole(1, 500));
  history->add_flag("--all", command->all, "all of them")->excludes(count);
  history->callback([command, history] {
    if (!history->get_subcommands().empty()) return;
    command->service = "history.list";
    if (!command->all && !command->args.contains("count")) command->args["count"] = 50;
  });

  CLI::App* restart = subcommand(app, "restart.find", "")->get_parent();
  restart->description("begins a program inside; without one of these words it shows how far that is (view)");
  restart->require_subcommand(0, 1);
  restart->callback([command, restart] {
    if (restart->get_subcommands().empty()) command->service = "restart.status";
  });

  CLI::App* put = subcommand(app, "programs.put", "writes a file into the folder of programs (set up)");
  put->add_option("FILE", command->file, "file on this side")->required()->check(given());
  put->add_option_function<std::string>("--name", [command](const std::string& name) { command->args["name"] = name; }, "its name there; without it, that of the file");
  put->add_flag_function("--replace", [command](std::int64_t) { command->args["replace"] = true; }, "a program of this name is replaced");
  put->callback([command] { command->what = What::kPut; });

  CLI::App* get = subcommand(app, "programs.get", "reads a program (view)");
  get->add_option_function<std::string>("NAME", [command](const std::string& name) { command->args["name"] = name; }, "name of a program")->required();
  get->add_option("FILE", command->file, "file on this side; - or nothing: standard output")->check(given());
  get->callback([command] { command->what = What::kGet; });

  CLI::App* tables = subcommand(app, "tables.export", "tool offsets, work offsets, tool life and common variables as TOML (view)");
  tables->add_option("FILE", command->file, "file on this side; - or nothing: standard output")->check(given());
  tables->add_option_function<std::string>("--table", [command](const std::string& table) { command->args["table"] = table; }, "tools, life, offsets or variables; without it, all of them")
      ->check(CLI::IsMember({"tools", "life", "offsets", "variables"}));
  tables->callback([command] {
    command->what = What::kExport;
    command->service = "tables.export";
  });
  CLI::App* import = subcommand(app, "tables.import", "sets what the sections of the file name and leaves everything else as it is (set up)");
  import->add_option("FILE", command->file, "file on this side; - is standard input")->required()->check(given());
  import->callback([command] {
    command->what = What::kImport;
  command->service = "tables.import";
});

CLI::App* parameters = subcommand(app, "parameters.export", "the parameters that are set as TOML (view)");
parameters->add_option("FILE", command->file, "file on this side; - or nothing: standard output")->check(given());
parameters->callback([command] {
  command->what = What::kExport;
  command->service = "parameters.export";
});
CLI::App* set = subcommand(app, "parameters.import", "sets the parameters that the sections of the file name and leaves the others as they are (maintain)");
set->add_option("FILE", command->file, "file on this side; - is standard input")->required()->check(given());
set->callback([command] {
  command->what = What::kImport;
  command->service = "parameters.import";
});

CLI::App* swap = subcommand(app, "ladder.swap", "a ladder program takes the place of the one in execution (maintain and operate)");
swap->add_option("FILE", command->file, "file on this side; - is standard input")->required()->check(given());
swap->add_option_function<std::string>("--name", [command](const std::string& name) { command->args["name"] = name; }, "its name in messages; without it, that of the file");
swap->callback([command] { command->what = What::kSwap; });

CLI::App* record = subcommand(app, "trace.record", "records signals in each scan and writes them as CSV; Ctrl-C ends the recording (maintain)");
add_fields(record, rt::services::row_of(rt::services::Service::kTraceArm), command);
record->add_option("--file", command->file, "file on this side; - or nothing: standard output")->check(given());
record->callback([command] { command->what = What::kRecord; });
CLI::App* save = subcommand(app, "trace.save", "the recording that has ended as CSV (view)");
save->add_option("FILE", command->file, "file on this side; - or nothing: standard output")->check(given());
save->callback([command] { command->what = What::kSave; });

CLI::App* pipe = app->add_subcommand("pipe", "requests from standard input over one connection, one object of JSON in a line: {\"service\": \"mode\", \"args\": {...}}");
pipe->callback([command] { command->what = What::kPipe; });

CLI::App* document = app->add_subcommand("document", "prints what is made from the table of services: markdown, man, bash, idl or python")->group("");
document->add_option("FORM", command->document, "markdown, man, bash, idl or python")->required()->check(CLI::IsMember({"markdown", "man", "bash", "idl", "python"}));
document->callback([command] { command->what = What::kDocument; });
}

}  // namespace

// The words themselves are asked, because a line that cannot be read may have no options yet. What stands behind "--" may be an argument.
bool asks_for_json(int argc, const char* const* argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i)
    if (std::string_view(argv[i]) == "--json" || std::string_view(argv[i]) == "--json=true") return true;
  return false;
}

int parse_control_command(int argc, const char* const* argv, ControlCommand* command) {
  CLI::App app{"ncctl: shows and operates a control, on this computer or over DDS"};
  app.set_version_flag("--version", std::string("ncctl ") + nc_version());
  CLI::Option* socket = app.add_option("--socket", command->socket, "path of the socket of the control")->envname("NC_SOCKET")->check(given());
  app.add_option("--control", command->control, "name of the control, as in DDS; default: the only one that runs")->check(given())->excludes(socket);
  // Each of them means DDS.
  const auto over_dds = [&](CLI::Option* option) {
    option->excludes(socket)->each([command](const std::string&) { command->remote.used = true; });
  };
  over_dds(app.add_option("--domain", command->remote.domain, "over DDS, in this domain, in place of the socket: ncdds passes it on")->check(CLI::Range(0, 230)));
  over_dds(app.add_option("--security", command->remote.security, "over DDS with DDS Security: folder of an identity that nc-keys has made")->check(given()));
  over_dds(app.add_option("--network", command->remote.network, "interface of the network, with --security; default: this computer only")->check(given()));
  over_dds(app.add_option("--client", command->remote.client, "over DDS the name of this client; default: a name of its own")->check(given()));
  const CLI::Option* json = app.add_flag("--json", command->json, "replies as JSON, one object in a line");
  app.require_subcommand(1);
  app.fallthrough();
  for (const ServiceRow& row : rt::services::service_table())
    if (is_command(row)) add_service(&app, row, command);
  add_own_commands(&app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool wrong = error.get_exit_code() != 0;
    if (wrong && ((json->count() > 0 && json->as<bool>()) || asks_for_json(argc, argv))) return report_refusal({kControlUsage, "usage", error.what()}, true, stdout, stderr);
    (void)app.exit(error);
    return wrong ? kControlUsage : 0;
  }
  return -1;
}

}  // namespace nc::tools
