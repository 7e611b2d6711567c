// SPDX-License-Identifier: Apache-2.0
// ncmon: a monitor on the terminal. It is only a DDS subscriber that shows what ncdds publishes.
//
//   ncmon [--control NAME] [--domain N]      full screen; q ends it, s shows the signals, space their next page
//   ncmon --view signals                     begins with the signals; also for --once and --json
//   ncmon --once [--json] [--wait SECONDS]   one status
//   ncmon --json                             a line of JSON for each status
//   ncmon --progress                         one line that is rewritten, until the control ends
//   ncmon --latency N                        times of N samples from the scan to here
//
// Exit status: 0 success, 1 wrong usage, or DDS cannot be started, 2 nothing was published within --wait.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "dds/monitor_command.hpp"
#include "nc/control.h"
#include "tools/lib/option_values.hpp"

int main(int argc, char** argv) try {
  CLI::App app{"ncmon: shows a control that ncdds publishes"};
  nc::dds::MonitorOptions options;
  std::string view = "status";
  app.set_version_flag("--version", std::string("ncmon ") + nc_version());
  app.add_option("--control", options.machine, "name of the control (ncdds --share); default: the first that is heard")->check(nc::tools::given());
  // These options are not listed in --help; they only give a hint.
  for (const std::string option : {"--machine", "--config"})
    app.add_option_function<std::string>(option, [option](const std::string&) {
         throw CLI::ValidationError(option, "is the file of a machine, which ncmon does not read: the name of a control is --control NAME");
       })->group("");
  app.add_option("--domain", options.access.domain, "DDS domain")->transform(nc::tools::whole(0, 230));
  app.add_option("--security", options.access.security, "DDS Security: folder of an identity that nc-keys has made")->check(nc::tools::given());
  app.add_option("--network", options.access.network, "interface of the network, with --security; default: this computer only")->check(nc::tools::given());
  CLI::Option* once_flag = app.add_flag("--once", options.once, "one status, then end");
  app.add_flag("--json", options.json, "as JSON, one object in a line");
  app.add_option("--view", view, "status, or the signals between NC, ladder and machine")
      ->check(CLI::IsMember({"status", "signals"}));
  CLI::Option* progress_flag = app.add_flag("--progress", options.progress, "one live line, until the control ends");
  app.add_option("--wait", options.wait_s, "seconds for the first status")->check(nc::tools::seconds(true, "86400"));
  CLI::Option* latency_option = app.add_option("--latency", options.latency, "times of so many samples")
                                    ->transform(nc::tools::whole(1, 1000000));
  once_flag->excludes(progress_flag);
  latency_option->excludes(once_flag)->excludes(progress_flag);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  options.signals = view == "signals";
  return nc::dds::monitor_command(options);
} catch (const std::exception& error) {  // mainly out of memory
  std::fprintf(stderr, "ncmon: %s\n", error.what());
  return 1;
}
