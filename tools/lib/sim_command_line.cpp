// SPDX-License-Identifier: Apache-2.0
// See sim_command_line.hpp.
#include "tools/lib/sim_command_line.hpp"

#include <CLI/CLI.hpp>

#include "tools/lib/dialect_names.hpp"
#include "tools/lib/option_values.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/plot_names.hpp"
#include "tools/lib/plot_options.hpp"
#include "tools/lib/variable_use.hpp"

namespace nc::tools {
namespace {

using What = SimCommand::What;

// ---- options that several subcommands have ----

void add_tape(CLI::App* command, SessionOptions* options) {
  command->add_option("--tape", options->tape, "PROGRAM is the image of a tape: iso or eia with parity, text (docs/trace.md)")
      ->transform(one_of({"text", "iso", "eia"}));
}

void add_program_texts(CLI::App* command, SessionOptions* options) {
  command->add_option("--programs", options->programs, "folder of sub programs (default: PROGRAM's own)")->check(given());
  command->add_option("--external", options->external, "folder of the programs that M198 calls (default: that of sub programs)")
      ->check(given());
  command->add_flag("--semicolon-comments", options->semicolon_comments, "what stands behind ';' in a line is a comment (m700; else P33)");
  command->add_option("--encoding", "of PROGRAM and its sub programs: utf-8, latin-1 or shift-jis (default: the machine's, else utf-8)")
      ->transform(one_of({"utf-8", "latin-1", "shift-jis"}))
      ->each([options](const std::string& name) {
        options->encoding = *nc::rt::encoding_from_name(name);
        options->encoding_given = true;
      });
}

void add_program(CLI::App* command, SessionOptions* options) {
  command->add_option("PROGRAM", options->program, "NC program, - for standard input")->required()->check(given());
  command->add_option("--setup", options->setup, "setup of control and machine, JSON (docs/trace.md)")->check(given());
  command->add_option("--dialect", options->dialect, dialect_list("or"))->capture_default_str()->check(given());
  add_program_texts(command, options);
  add_tape(command, options);
}

constexpr const char* kMachineHelp = "machine configuration, TOML, as ncrtd reads it";

void add_machine_file(CLI::App* command, SessionOptions* options) {
  command->add_option("--machine", options->machine, kMachineHelp)->check(given());
}

void add_print(CLI::App* command, SessionOptions* options) {
  command->add_option("--print", options->print, "file to which DPRNT of user macros is appended")->check(given());
}

void add_pass_limit(CLI::App* command, RunLimits* limits) {
  command
      ->add_option_function<uint64_t>(
          "--max-passes", [limits](const uint64_t& passes) { limits->loops = LoopLimits::all(passes); },
          "passes in a row after which a loop is given up, 0 = no limit (default: 10000000, and 100 in which nothing changes, 10000 in sub programs)")
      ->transform(whole(0, 1'000'000'000'000'000'000));
}

void add_loop_limit(CLI::App* command, RunLimits* limits) {
  add_pass_limit(command, limits);
  command
      ->add_option("--max-silent-blocks", limits->silent_blocks,
                   "blocks that only calculate after which it is an endless loop, 0 = no limit")
      ->capture_default_str()
      ->transform(whole(0, 1'000'000'000'000'000'000));
}

void add_machine(CLI::App* command, SimCommand* sim) {
  auto* file = command->add_option("--machine", sim->machine.machine, kMachineHelp)->check(given());
  command->add_option("--limits-file,--config", sim->machine.limits_file, "limits of the machine, JSON (docs/trace.md)")
      ->check(given())
      ->excludes(file);
  const auto every_axis = [](std::string& text) {
    std::string why;
    return parse_every_axis(text, &why) ? std::string() : why;
  };
  command
      ->add_option_function<std::string>(
          "--motion", [sim](const std::string& mode) { sim->machine.motion = mode == "optimal" ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID; },
          "law of motion: optimal or trapezoid (default: the machine's, else optimal where every axis has a limit of jerk)")
      ->transform(one_of({"optimal", "trapezoid"}));
  command->add_option("--tolerance", sim->machine.tolerance, "mm that lines may leave the path by in the time-optimal mode, which this option asks for; 0: with a rest at each corner")
      ->check(CLI::Range(0.0, 0.0) | CLI::Range(1e-4, 1.0));
  command->add_option("--limits", sim->machine.every_axis, "velocity, acceleration, jerk of every axis, as 250,2000,50000")
      ->check(CLI::Validator(every_axis, "V,A,J"));
  command->add_option_function<unsigned>("--cycle-us", [sim](const unsigned& us) { sim->machine.cycle_us = us; }, "servo cycle in microseconds (default: the machine's, else 1000)")
      ->transform(whole(10, 100'000));
  command->add_option("--max-seconds", sim->limits.seconds, "machine time after which the run is given up")
      ->capture_default_str()
      ->check(seconds(false, "1e9"));
}

// ---- the subcommands ----

/// A subcommand of the parser, and what it means.
struct Chosen {
  CLI::App* app;
  What what;
};

CLI::App* add_reading(CLI::App* app, const char* name, const char* help, SimCommand* sim) {
  CLI::App* command = app->add_subcommand(name, help);
  add_program(command, &sim->session);
  add_machine_file(command, &sim->session);
  add_print(command, &sim->session);
  add_loop_limit(command, &sim->limits);
  return command;
}

CLI::App* add_running(CLI::App* app, const char* name, const char* help, SimCommand* sim) {
  CLI::App* command = app->add_subcommand(name, help);
  add_program(command, &sim->session);
  add_machine(command, sim);
  add_pass_limit(command, &sim->limits);
  return command;
}

CLI::App* add_motion(CLI::App* app, SimCommand* sim) {
  CLI::App* motion = add_running(app, "motion", "commanded position of every axis in every servo cycle", sim);
  motion->add_option_function<std::string>(
            "--format", [sim](const std::string& name) { sim->format = name == "f64" ? MotionFormat::kF64 : MotionFormat::kCsv; },
            "csv, or f64: raw little-endian doubles, t and the axes")
      ->default_str("csv")
      ->transform(one_of({"csv", "f64"}));
  motion->add_option("-o,--output", sim->output, "file for the rows (default: standard output)")->check(given());
  return motion;
}

/// The words of the options that say how a path is drawn.
struct PlotWords {
  std::string view = "iso", coordinates = "work", color = "kind";
  bool profile = false, compensation = false;
};

CLI::App* add_plot(CLI::App* app, PlotWords* words, SimCommand* sim) {
  CLI::App* plot = app->add_subcommand("plot", "the tool path as SVG and PNG");
  add_program(plot, &sim->session);
  add_loop_limit(plot, &sim->limits);
  plot->add_option("-o,--output", sim->output, "writes OUTPUT.svg and OUTPUT.png (default: toolpath; with --profile: profile)")->check(given());
  CLI::Option* profile = plot->add_flag("--profile", words->profile, "path speed, acceleration and jerk of every axis over time instead of the path");
  CLI::Option* side = plot->add_flag("--compensation", words->compensation,
                                     "radius compensation, of a program that does not rotate, scale or mirror: the programmed path as well, the tool's disc at the ends of "
                                     "its blocks, colours by side");
  side->excludes(profile);
  add_plot_options(plot, &words->view, &words->coordinates, &words->color, [profile, side](CLI::Option* option) {
    option->excludes(profile);
    if (option->get_name() != "--view") option->excludes(side);
  });
  CLI::App* const machine = plot->add_option_group("machine", "of --profile, but for --machine");
  add_machine(machine, sim);
  for (CLI::Option* option : machine->get_options())
    if (option->get_name() != "--machine") option->needs(profile);
  return plot;
}

void add_dialect(CLI::App* command, SimCommand* sim) {
  command->add_option("--dialect", sim->session.dialect, dialect_list("or"))->capture_default_str()->check(given());
}

CLI::App* add_table(CLI::App* app, const char* name, const char* help, SimCommand* sim) {
  CLI::App* table = app->add_subcommand(name, help);
  add_dialect(table, sim);
  table->add_flag("--markdown", sim->markdown, "as a Markdown table");
  return table;
}

CLI::App* add_dialects(CLI::App* app, SimCommand* sim) {
  CLI::App* dialects = app->add_subcommand("dialects", "the dialects, and how much of each there is");
  dialects->add_flag("--markdown", sim->markdown, "as a Markdown table");
  return dialects;
}

CLI::App* add_variables(CLI::App* app, SimCommand* sim) {
  CLI::App* variables = app->add_subcommand("variables", "the system variables of a dialect");
  CLI::Option* markdown = variables->add_flag("--markdown", sim->markdown, "as a Markdown table");
  CLI::Option* of = variables->add_option("--of", sim->session.program, "instead: the variables that this program and those that it calls read and write")
                        ->type_name("PROGRAM")
                        ->check(given())
                        ->excludes(markdown);
  CLI::App* const texts = variables->add_option_group("texts", "of --of");
  add_program_texts(texts, &sim->session);
  add_dialect(variables, sim);
  for (CLI::Option* option : texts->get_options()) option->needs(of);
  return variables;
}

int parse_failed(CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  if (error.get_exit_code() == 0) {
    const int code = app.exit(error);
    if (standard_output_written()) return code;
    std::fprintf(stderr, "ncsim: the output cannot be written\n");
    return kExitError;
  }
  // For an unknown subcommand the parser would say that a subcommand is missing.
  const bool unknown = app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
  if (unknown) std::fprintf(stderr, "ncsim: there is no subcommand '%s' (ncsim --help)\n", argv[1]);
  else std::fprintf(stderr, "ncsim: %s (ncsim --help)\n", error.what());
  return kExitError;
}

/// Sets what depends on the subcommand and on several options together.
void settle(const PlotWords& words, SimCommand* sim) {
  if (sim->what == What::kPlot && words.profile) sim->what = What::kProfile;
  if (sim->what == What::kVariables && !sim->session.program.empty()) sim->what = What::kVariableUse;
  if (sim->what == What::kPlot) sim->session.machine = sim->machine.machine;
  if (sim->what == What::kPlot && sim->output.empty()) sim->output = "toolpath";
  if (sim->what == What::kProfile && sim->output.empty()) sim->output = "profile";
  sim->plot = {plot_views().at(words.view), plot_coordinates().at(words.coordinates), words.compensation ? PlotColor::kSide : plot_colors().at(words.color)};
}

}  // namespace

std::optional<int> parse_sim_command(int argc, const char* const* argv, SimCommand* sim) {
  CLI::App app{"ncsim: run NC programs without a machine"};
  app.set_version_flag("--version", std::string("ncsim ") + nc_version());
  app.require_subcommand(1);
  PlotWords words;
  const Chosen commands[] = {  // in the order in which --help lists them
      {add_reading(&app, "trace", "every event of the program as JSON Lines", sim), What::kTrace},
      {add_reading(&app, "check", "the alarm that stops the program, if one does", sim), What::kCheck},
      {add_running(&app, "time", "cycle time on a simulated machine", sim), What::kTime},
      {add_motion(&app, sim), What::kMotion},
      {add_plot(&app, &words, sim), What::kPlot},
      {add_dialects(&app, sim), What::kDialects},
      {add_table(&app, "functions", "the G and M codes of a dialect", sim), What::kFunctions},
      {add_table(&app, "alarms", "the alarms of a dialect", sim), What::kAlarms},
      {add_variables(&app, sim), What::kVariables},
      {add_table(&app, "parameters", "the parameters of a dialect that the control asks for", sim), What::kParameters},
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_failed(app, error, argc, argv);
  }
  for (const Chosen& command : commands) {
    if (!command.app->parsed()) continue;
    sim->what = command.what;
    const bool takes_program = command.what <= What::kProfile;
    sim->session.dialect_given = takes_program && command.app->count("--dialect") != 0;
  }
  settle(words, sim);
  return std::nullopt;
}

int run_sim_command(const SimCommand& sim, std::FILE* out, std::FILE* err) {
  switch (sim.what) {
    case What::kTrace: return trace_command(sim.session, sim.limits, fileno(out), err);
    case What::kCheck: return check_command(sim.session, sim.limits, out, err);
    case What::kTime: return time_command(sim.session, sim.machine, sim.limits, out, err);
    case What::kMotion: return motion_command(sim.session, sim.machine, sim.format, sim.output, sim.limits, fileno(out), err);
    case What::kPlot: return plot_command(sim.session, sim.limits, sim.plot, sim.output, out, err);
    case What::kProfile: return profile_command(sim.session, sim.machine, sim.limits, sim.output, out, err);
    case What::kDialects: return dialects_command(sim.markdown, out, err);
    case What::kFunctions: return functions_command(sim.session.dialect, sim.markdown, out, err);
    case What::kAlarms: return alarms_command(sim.session.dialect, sim.markdown, out, err);
    case What::kVariables: return variables_command(sim.session.dialect, sim.markdown, out, err);
    case What::kVariableUse: return variable_use_command(sim.session, out, err);
    case What::kParameters: return parameters_command(sim.session.dialect, sim.markdown, out, err);
  }
  return kExitError;
}

}  // namespace nc::tools
