// SPDX-License-Identifier: Apache-2.0
// ncrtd: the runtime as a program. It runs an NC program (or MDI blocks) on the configured machine.
//
//   ncrtd --machine FILE check                        --machine may also come after the command; --config is the same
//   ncrtd --machine FILE run [--fast] [--dialect D] [--plot BASE [--view V] [--coordinates C] [--color C]] [--no-progress] PROGRAM
//   ncrtd --machine FILE mdi [--fast] "G0 X10"
//   ncrtd --machine FILE serve                       runs until a signal ends it, for a service manager
//   run, mdi and serve:  [--share NAME] [--commands]   --share: shared memory for ncdds (serve always has it);
//                                                      --commands: take commands from it
//
// Exit status: 0 the program ended, 2 it stopped on an alarm, 1 wrong usage or configuration, or output that cannot be
// written, 3 another process runs this machine, 128+n ended by signal n (130 SIGINT, 143 SIGTERM); then the machine was brought to rest and the summary
// printed. `serve` ends with 0 when the axes stood before the outputs were switched off, otherwise with 2.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "runtime/rt_thread.hpp"
#include "tools/lib/daemon.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/option_values.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/plot_options.hpp"

using namespace nc::tools;

int main(int argc, char** argv) try {
  nc::rt::limit_allocator();
  CLI::App app{"ncrtd: runs NC programs on a machine, or on a simulated one"};
  DaemonOptions options;
  app.set_version_flag("--version", std::string("ncrtd ") + nc_version());
  app.add_option("--machine,--config", options.config, "machine configuration (TOML)")->required()->check(given());
  app.require_subcommand(1);
  app.fallthrough();  // --machine FILE may come before or after the command
  app.add_subcommand("check", "read the configuration, report every error, do nothing");
  CLI::App* run = app.add_subcommand("run", "run a program from cycle start to its end");
  run->add_option("PROGRAM", options.program, "NC program")->required()->check(given());
  run->add_option("--dialect", options.dialect, "instead of the configured one")
      ->transform(one_of(dialect_names()));
  run->add_option("--plot", options.plot, "write BASE.svg and BASE.png of the executed path")
      ->type_name("BASE")
      ->check(given());
  add_plot_options(run, &options.view, &options.coordinates, &options.color, [run](CLI::Option* option) { option->needs(run->get_option("--plot")); });
  CLI::App* mdi = app.add_subcommand("mdi", "execute blocks");
  mdi->add_option("BLOCKS", options.mdi, "blocks, separated by line ends")->required()->check(given());
  for (CLI::App* sub : {run, mdi}) {
    sub->add_flag("--fast", options.fast, "virtual time: as fast as the processor; retained data is neither read nor written");
    sub->add_flag("--no-progress", options.no_progress, "no live line");
    sub->add_flag("--quiet", options.quiet, "only the summary: no messages, no stops");
  }
  CLI::App* service = app.add_subcommand("serve", "bring the machine up and stay until SIGTERM or SIGINT");
  service->add_flag("--summary", options.summary, "at the end, how long the scans took");
  for (CLI::App* sub : {run, mdi, service}) {
    sub->add_option("--share", options.share, "shared memory of this name, for ncdds")->check(given());
    sub->add_flag("--commands", options.commands, "take commands from it");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return status_when_written("ncrtd", app.exit(error) == 0 ? 0 : kDaemonUsage);
  }

  using Command = DaemonOptions::Command;
  options.command = run->parsed() ? Command::kRun : mdi->parsed() ? Command::kMdi : service->parsed() ? Command::kServe : Command::kCheck;
  return status_when_written("ncrtd", daemon_command(options));
} catch (const std::exception& error) {  // mainly out of memory
  std::fprintf(stderr, "ncrtd: %s\n", error.what());
  return 1;
}
