// SPDX-License-Identifier: Apache-2.0
// ncsim: NC programs without a machine. This file is the command line; what the subcommands do is in
// tools/lib/commands.cpp.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "tools/lib/commands.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/option_values.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/plot_options.hpp"
#include "tools/lib/variable_use.hpp"

namespace {

using nc::tools::MachineOptions;
using nc::tools::MotionFormat;
using nc::tools::RunLimits;
using nc::tools::SessionOptions;

void add_tape(CLI::App* command, SessionOptions* options) {
  command->add_option("--tape", options->tape, "PROGRAM is the image of a tape: iso or eia with parity, text (docs/trace.md)")
      ->transform(nc::tools::one_of({"text", "iso", "eia"}));
}

void add_program_texts(CLI::App* command, SessionOptions* options) {
  command->add_option("--programs", options->programs, "folder of sub programs (default: PROGRAM's own)")->check(nc::tools::given());
  command->add_option("--external", options->external, "folder of the programs that M198 calls (default: that of sub programs)")
      ->check(nc::tools::given());
  command->add_flag("--semicolon-comments", options->semicolon_comments, "what stands behind ';' in a line is a comment (m700; else P33)");
  command->add_option("--encoding", "of PROGRAM and its sub programs: utf-8, latin-1 or shift-jis (default: the machine's, else utf-8)")
      ->transform(nc::tools::one_of({"utf-8", "latin-1", "shift-jis"}))
      ->each([options](const std::string& name) {
        options->encoding = *nc::rt::encoding_from_name(name);
        options->encoding_given = true;
      });
}

void add_program(CLI::App* command, SessionOptions* options) {
  command->add_option("PROGRAM", options->program, "NC program, - for standard input")->required()->check(nc::tools::given());
  command->add_option("--setup", options->setup, "setup of control and machine, JSON (docs/trace.md)")->check(nc::tools::given());
  command->add_option("--dialect", options->dialect, nc::tools::dialect_list("or"))->capture_default_str()->check(nc::tools::given());
  add_program_texts(command, options);
  add_tape(command, options);
}

constexpr const char* kMachineHelp = "machine configuration, TOML, as ncrtd reads it";

void add_machine_file(CLI::App* command, SessionOptions* options) {
  command->add_option("--machine", options->machine, kMachineHelp)->check(nc::tools::given());
}

void add_print(CLI::App* command, SessionOptions* options) {
  command->add_option("--print", options->print, "file to which DPRNT of user macros is appended")->check(nc::tools::given());
}

void add_pass_limit(CLI::App* command, RunLimits* limits) {
  command
      ->add_option_function<uint64_t>(
          "--max-passes", [limits](const uint64_t& passes) { limits->loops = nc::tools::LoopLimits::all(passes); },
          "passes in a row after which a loop is given up, 0 = no limit (default: 10000000, and 100 in which nothing changes, 10000 in sub programs)")
      ->transform(nc::tools::whole(0, 1'000'000'000'000'000'000));
}

void add_loop_limit(CLI::App* command, RunLimits* limits) {
  add_pass_limit(command, limits);
  command
      ->add_option("--max-silent-blocks", limits->silent_blocks,
                   "blocks that only calculate after which it is an endless loop, 0 = no limit")
      ->capture_default_str()
      ->transform(nc::tools::whole(0, 1'000'000'000'000'000'000));
}

/// What can be said of a machine; the texts of numbers stay texts until the axes are known.
struct MachineArguments {
  MachineOptions options;
  unsigned cycle_us = 0;
};

void add_machine(CLI::App* command, MachineArguments* machine, RunLimits* limits) {
  auto* file = command->add_option("--machine", machine->options.machine, kMachineHelp)->check(nc::tools::given());
  command->add_option("--limits-file,--config", machine->options.limits_file, "limits of the machine, JSON (docs/trace.md)")
      ->check(nc::tools::given())
      ->excludes(file);
  const auto every_axis = [](std::string& text) {
    std::string why;
    return nc::tools::parse_every_axis(text, &why) ? std::string() : why;
  };
  command->add_option("--tolerance", machine->options.tolerance, "the time-optimal mode, mm that lines may leave the path by; 0: with a rest at each corner")
      ->check(CLI::Range(0.0, 0.0) | CLI::Range(1e-4, 1.0));
  command->add_option("--limits", machine->options.every_axis, "velocity, acceleration, jerk of every axis, as 250,2000,50000")
      ->check(CLI::Validator(every_axis, "V,A,J"));
  command->add_option("--cycle-us", machine->cycle_us, "servo cycle in microseconds (default: the machine's, else 1000)")
      ->transform(nc::tools::whole(10, 100'000));
  command->add_option("--max-seconds", limits->seconds, "machine time after which the run is given up")
      ->capture_default_str()
      ->check(nc::tools::seconds(false, "1e9"));
}

int run(int argc, char** argv) {
  CLI::App app{"ncsim: run NC programs without a machine"};
  app.set_version_flag("--version", std::string("ncsim ") + nc_version());
  app.require_subcommand(1);
  SessionOptions options;
  RunLimits limits;

  CLI::App* trace = app.add_subcommand("trace", "every event of the program as JSON Lines");
  add_program(trace, &options);
  add_machine_file(trace, &options);
  add_print(trace, &options);
  add_loop_limit(trace, &limits);

  CLI::App* check = app.add_subcommand("check", "the alarm that stops the program, if one does");
  add_program(check, &options);
  add_machine_file(check, &options);
  add_print(check, &options);
  add_loop_limit(check, &limits);

  MachineArguments machine;
  CLI::App* time = app.add_subcommand("time", "cycle time on a simulated machine");
  add_program(time, &options);
  add_machine(time, &machine, &limits);
  add_pass_limit(time, &limits);

  std::string rows, format = "csv";
  CLI::App* motion = app.add_subcommand("motion", "commanded position of every axis in every servo cycle");
  add_program(motion, &options);
  add_machine(motion, &machine, &limits);
  add_pass_limit(motion, &limits);
  motion->add_option("--format", format, "csv, or f64: raw little-endian doubles, t and the axes")
      ->capture_default_str()
      ->transform(nc::tools::one_of({"csv", "f64"}));
  motion->add_option("-o,--output", rows, "file for the rows (default: standard output)")->check(nc::tools::given());

  std::string base, view = "iso";
  CLI::App* plot = app.add_subcommand("plot", "the tool path as SVG and PNG");
  add_program(plot, &options);
  add_loop_limit(plot, &limits);
  plot->add_option("-o,--output", base, "writes OUTPUT.svg and OUTPUT.png (default: toolpath; with --profile: profile)")
      ->check(nc::tools::given());
  bool profile = false;
  auto* profile_flag = plot->add_flag("--profile", profile, "path speed, acceleration and jerk of every axis over time instead of the path");
  std::string coordinates = "work", color = "kind";
  nc::tools::add_plot_options(plot, &view, &coordinates, &color, [profile_flag](CLI::Option* option) { option->excludes(profile_flag); });
  CLI::App* const profile_machine = plot->add_option_group("machine", "of --profile, but for --machine");
  add_machine(profile_machine, &machine, &limits);
  for (CLI::Option* option : profile_machine->get_options())
    if (option->get_name() != "--machine") option->needs(profile_flag);

  bool markdown = false;
  CLI::App* functions = app.add_subcommand("functions", "the G and M codes of a dialect");
  CLI::App* alarms = app.add_subcommand("alarms", "the alarms of a dialect");
  CLI::App* variables = app.add_subcommand("variables", "the system variables of a dialect");
  auto* variables_markdown = variables->add_flag("--markdown", markdown, "as a Markdown table");
  auto* of = variables->add_option("--of", options.program, "instead: the variables that this program and those that it calls read and write")
                 ->type_name("PROGRAM")
                 ->check(nc::tools::given())
                 ->excludes(variables_markdown);
  auto* const of_texts = variables->add_option_group("texts", "of --of");
  add_program_texts(of_texts, &options);
  variables->add_option("--dialect", options.dialect, nc::tools::dialect_list("or"))->capture_default_str()->check(nc::tools::given());
  for (CLI::Option* option : of_texts->get_options()) option->needs(of);
  CLI::App* parameters = app.add_subcommand("parameters", "the parameters of a dialect that the control asks for");
  for (CLI::App* table : {functions, alarms, parameters}) {
    table->add_option("--dialect", options.dialect, nc::tools::dialect_list("or"))->capture_default_str()->check(nc::tools::given());
    table->add_flag("--markdown", markdown, "as a Markdown table");
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      const int code = app.exit(error);
      if (nc::tools::standard_output_written()) return code;
      std::fprintf(stderr, "ncsim: the output cannot be written\n");
      return nc::tools::kExitError;
    }
    // The parser's own words for a subcommand that does not exist are that one is missing.
    const bool unknown = app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
    if (unknown) std::fprintf(stderr, "ncsim: there is no subcommand '%s' (ncsim --help)\n", argv[1]);
    else std::fprintf(stderr, "ncsim: %s (ncsim --help)\n", error.what());
    return nc::tools::kExitError;
  }
  options.dialect_given = false;
  for (CLI::App* command : {trace, check, time, motion, plot})
    if (command->count("--dialect") != 0) options.dialect_given = true;
  if (machine.cycle_us != 0) machine.options.cycle_us = machine.cycle_us;
  if (trace->parsed()) return nc::tools::trace_command(options, limits, STDOUT_FILENO, stderr);
  if (check->parsed()) return nc::tools::check_command(options, limits, stdout, stderr);
  if (time->parsed()) return nc::tools::time_command(options, machine.options, limits, stdout, stderr);
  if (motion->parsed())
    return nc::tools::motion_command(options, machine.options, format == "f64" ? MotionFormat::kF64 : MotionFormat::kCsv, rows,
                                     limits, STDOUT_FILENO, stderr);
  if (plot->parsed() && profile)
    return nc::tools::profile_command(options, machine.options, limits, base.empty() ? "profile" : base, stdout, stderr);
  options.machine = plot->parsed() ? machine.options.machine : options.machine;
  if (plot->parsed())
    return nc::tools::plot_command(options, limits, {nc::tools::plot_views().at(view), nc::tools::plot_coordinates().at(coordinates), nc::tools::plot_colors().at(color)},
                                   base.empty() ? "toolpath" : base, stdout, stderr);
  if (functions->parsed()) return nc::tools::functions_command(options.dialect, markdown, stdout, stderr);
  if (parameters->parsed()) return nc::tools::parameters_command(options.dialect, markdown, stdout, stderr);
  if (variables->parsed() && !options.program.empty()) return nc::tools::variable_use_command(options, stdout, stderr);
  if (variables->parsed()) return nc::tools::variables_command(options.dialect, markdown, stdout, stderr);
  return nc::tools::alarms_command(options.dialect, markdown, stdout, stderr);
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that goes away is a write error with a message, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // out of memory, above all
    std::fprintf(stderr, "ncsim: %s\n", error.what());
    return nc::tools::kExitError;
  }
}
