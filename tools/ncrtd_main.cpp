// SPDX-License-Identifier: Apache-2.0
// ncrtd: the runtime as a program. Runs an NC program (or MDI blocks) on the configured machine.
//
//   ncrtd --machine FILE check                        --machine may stand behind the command, too; --config is the same
//   ncrtd --machine FILE run [--fast] [--dialect D] [--plot BASE [--view V] [--coordinates C] [--color C]] [--no-progress] PROGRAM
//   ncrtd --machine FILE mdi [--fast] "G0 X10"
//   ncrtd --machine FILE serve                       up until SIGTERM or SIGINT, for a service manager
//   run, mdi and serve:  [--share NAME] [--commands]   shared memory for ncdds (serve has it anyway);
//                                                      takes commands from it
//
// Exit status: 0 the program ended, 2 it stopped on an alarm, 1 usage, configuration or output that cannot be
// written, 3 another process runs this machine, 128+n ended by signal n (130 SIGINT, 143 SIGTERM): the machine is brought to rest and the summary
// printed. `serve` ends with 0 when the axes stood before the outputs went off, else with 2.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <thread>
#include <vector>

#include "hal/composite.hpp"
#include "hal/modbus/link.hpp"
#include "runtime/console.hpp"
#include "runtime/machine_lock.hpp"
#include "runtime/runtime.hpp"
#include "runtime/share/service.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/option_values.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/plot_options.hpp"
#include "tools/lib/print_file.hpp"
#include "tools/lib/program_files.hpp"
#include "tools/lib/run_plot.hpp"
#include "tools/lib/serve.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

constexpr int kExitUsage = 1, kExitAlarm = 2, kExitInUse = 3, kExitSignal = 128;
constexpr auto kPeriod = std::chrono::milliseconds(50);  // of the display
constexpr unsigned kStepsPerLook = 500;                  // virtual time: scans between two looks

volatile std::sig_atomic_t g_signal = 0;
extern "C" void on_signal(int number) {
  g_signal = number;
}

const char* signal_name(int number) {
  switch (number) {
    case SIGINT: return "SIGINT";
    case SIGHUP: return "SIGHUP";
    case SIGQUIT: return "SIGQUIT";
    default: return "SIGTERM";
  }
}

struct Options {
  std::string config, program, mdi, dialect, plot, share;
  std::string view = "iso", coordinates = "work", color = "kind";  // of the plot
  bool fast = false, no_progress = false, quiet = false, serve = false, commands = false;
  std::int64_t since_ns = nc::rt::RealClock().now_ns();  // start of the process, for the start-up time
};

int config_failed(const std::vector<nc::rt::ConfigError>& errors) {
  for (const nc::rt::ConfigError& error : errors) std::fprintf(stderr, "%s\n", error.text().c_str());
  return kExitUsage;
}

// Mistakes of the ladder program, although the configuration has mistakes too: all of them in one go.
void check_ladder(const nc::rt::Config& config, bool whole, std::vector<nc::rt::ConfigError>* errors) {
  if (config.ladder.program.empty()) return;
  const std::size_t before = errors->size();
  std::vector<nc::rt::ConfigError> found;
  (void)nc::rt::LadderTask::create(config, &found);
  errors->insert(errors->end(), found.begin(), found.end());
  if (errors->size() != before && !whole)
    errors->push_back({config.ladder_file(), 0, "",
                       "its errors may follow from those of the configuration, which says what devices there are"});
}

int failed(const std::string& text) {
  std::fprintf(stderr, "ncrtd: %s\n", nc::rt::valid_utf8(text).c_str());
  return kExitUsage;
}

// A program that begins at once would read its outputs that hold (on_stop = "hold") before they were read back. A partner that does not
// answer so soon is no reason to wait for ever: the link says what it lacks.
void wait_for_outputs(const std::vector<std::unique_ptr<nc::hal::modbus::ModbusLink>>& links) {
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  const auto waits = [](const std::unique_ptr<nc::hal::modbus::ModbusLink>& link) {
    const auto& points = link->config().points;
    return std::any_of(points.begin(), points.end(), [](const nc::hal::modbus::PointMap& map) { return map.holds(); }) &&
           link->statistics().state != nc::hal::modbus::LinkState::kOk;
  };
  while (g_signal == 0 && std::any_of(links.begin(), links.end(), waits) && std::chrono::steady_clock::now() < patience)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(links.empty() ? 0 : 20));  // some scans and a turn of the feeder
}

// Called in the threads of the links.
void report_link(const std::string& line) {
  std::fprintf(stderr, "modbus: %s\n", line.c_str());
}

// The exit status when everything printed has gone out; a full disk or a closed pipe is no success.
int written(int status) {
  if (nc::tools::standard_output_written()) return status;
  std::fprintf(stderr, "ncrtd: standard output cannot be written\n");
  return status == 0 ? kExitUsage : status;
}

// Parameters are numbers of one manual: with another dialect they would mean something else, or nothing.
void change_dialect(const std::string& name, nc::rt::Config* config) {
  const std::uint8_t dialect = static_cast<std::uint8_t>(*nc::tools::dialect_from_name(name));  // the option takes no other word
  if (config->nc.dialect == dialect) return;
  config->nc.dialect = config->sim.dialect = dialect;
  if (config->parameters.empty()) return;
  std::fprintf(stderr, "warning: [parameters] of %s are those of another dialect: not used\n",
               config->file.c_str());
  config->parameters.clear();
}

// An alarm or a warning that the operator has to see first.
bool by_alarm(Answer answer) {
  return answer == Answer::kAlarmActive || answer == Answer::kWarningActive;
}

// One run from cycle start to the end, an alarm or a signal.
class Run {
 public:
  Run(nc::rt::Runtime* runtime, const Options& options, nc::rt::Progress* progress, nc::tools::PrintLines* printed)
      : runtime_(*runtime), options_(options), progress_(*progress), printed_(*printed) {}

  int to_end() {
    const Answer answer = runtime_.execute(CommandKind::kCycleStart);
    if (by_alarm(answer)) return stop_by_alarm();
    if (answer != Answer::kDone)
      return failed(std::string("cycle start: ") + runtime_.explain(answer));
    for (;;) {
      wait();
      show();
      const nc::rt::Snapshot now = runtime_.snapshot();
      const nc::rt::FeederInfo info = runtime_.info();
      show_message(info);
      show_printed();
      show_again(info);
      if (g_signal != 0) return stop_by_signal();
      if (now.stopped_by_alarm()) return stop_by_alarm();
      if (info.runs > 0 && now.system[0].nc.state == NC_STATE_IDLE) return ended(now);
      if (given_up(now)) return stop_by_reset();
      // Someone who gives commands continues it himself.
      if (now.system[0].nc.state == NC_STATE_STOPPED && !options_.commands) {
        const Answer again = runtime_.execute(CommandKind::kCycleStart);
        if (again != refused_ || again == Answer::kDone)  // not again and again that it is not
          note("stop in line " + std::to_string(now.system[0].nc.source.line) + " (" + nc::rt::state_text(now.system[0].nc) + "): " +
               (again == Answer::kDone ? "continued" : std::string("waits: ") + runtime_.explain(again)));
        refused_ = again;
      }
    }
  }

  // That has stopped the run; empty when none has.
  const std::string& alarm_code() const { return alarm_code_; }

  // Prints the active alarms and the summary.
  int stop_by_alarm() {
    rest();
    wait();  // the details of a program alarm come from the feeder
    show_printed();
    const nc::rt::Snapshot now = runtime_.snapshot();
    progress_.finish();
    bool lost = false;
    for (unsigned i = 0; i < now.alarms.count; ++i) {
      const std::string text = runtime_.alarm_text(now.alarms.alarm[i]);
      const bool warning = nc::rt::is_warning(now.alarms.alarm[i].id);
      std::fprintf(stderr, "%s: %s\n", warning ? "warning" : "alarm", text.c_str());
      if (!warning && alarm_code_.empty()) alarm_code_ = text.substr(0, text.find(' '));
      lost |= now.alarms.alarm[i].id == nc::rt::AlarmId::kRetainedLost;
    }
    std::printf("%s", nc::rt::summary_text(runtime_, now.system[0].nc, options_.since_ns).c_str());
    if (lost) runtime_.execute(CommandKind::kReset);  // whoever started it has read it now; nobody else could acknowledge it
    return kExitAlarm;
  }

 private:
  // One look's worth of time.
  void wait() {
    if (!options_.fast) {
      usleep(static_cast<useconds_t>(std::chrono::microseconds(kPeriod).count()));
      return;
    }
    const std::uint64_t runs = runtime_.info().runs;
    for (unsigned i = 0; i < kStepsPerLook && g_signal == 0 && runtime_.info().runs == runs; ++i)
      runtime_.step();
    runtime_.step();
  }
  void show() {
    if (!options_.no_progress) progress_.show(runtime_);
  }
  void show_message(const nc::rt::FeederInfo& info) {
    if (info.messages == messages_) return;
    messages_ = info.messages;
    note("message: " + info.last_message);
  }
  // M700 13.3.1: M99 of a main program, also of MDI, begins it again. That has no end of its own, which is said once.
  void show_again(const nc::rt::FeederInfo& info) {
    if (info.begun_again == 0 || said_again_) return;
    said_again_ = true;
    note("M99 in line " + std::to_string(info.again_line) + ": begins again from the head, until a reset or a signal (Ctrl-C) ends it");
  }
  // M700 13.5.8: what programs print, where the configuration names no file for it.
  void show_printed() {
    for (const std::string& line : printed_.take()) note("print: " + line);
  }
  void note(const std::string& text) {
    if (!options_.quiet) progress_.note(text);
  }
  void rest() {
    for (unsigned i = 0; i < looks_ && !runtime_.snapshot().system[0].nc.distance_zero; ++i) wait();
  }
  int ended(const nc::rt::Snapshot& now) {
    show_printed();
    progress_.finish();
    std::printf("%s", nc::rt::summary_text(runtime_, now.system[0].nc, options_.since_ns).c_str());
    return 0;
  }
  // Idle for a while though the run has not come to its end: somebody else (the ladder, a client) has reset it.
  bool given_up(const nc::rt::Snapshot& now) {
    constexpr unsigned kLooks = 20;
    if (now.system[0].nc.state != NC_STATE_IDLE) last_line_ = now.system[0].nc.source.line;
    idle_looks_ = now.system[0].nc.state == NC_STATE_IDLE && !now.resetting ? idle_looks_ + 1 : 0;
    return idle_looks_ > kLooks;
  }
  int stop_by_reset() {
    progress_.finish();
    std::fprintf(stderr, "reset%s, before the end of the program\n", last_line_ == 0 ? "" : (" in line " + std::to_string(last_line_)).c_str());
    std::printf("%s", nc::rt::summary_text(runtime_, runtime_.snapshot().system[0].nc, options_.since_ns).c_str());
    return kExitAlarm;
  }
  int stop_by_signal() {
    const int signal = g_signal;
    note("signal: feed hold");
    runtime_.execute(CommandKind::kEnd);
    rest();
    const nc_outputs stopped = runtime_.snapshot().system[0].nc;
    runtime_.execute(CommandKind::kReset);
    for (unsigned i = 0; i < looks_ && runtime_.snapshot().resetting; ++i) wait();
    progress_.finish();
    std::printf("interrupted  by %s in line %u, before the end of the program\n",
                signal_name(signal), stopped.source.line);
    std::printf("%s", nc::rt::summary_text(runtime_, stopped, options_.since_ns).c_str());
    return kExitSignal + signal;
  }

  nc::rt::Runtime& runtime_;
  const Options& options_;
  nc::rt::Progress& progress_;
  nc::tools::PrintLines& printed_;
  std::uint64_t messages_ = 0;
  bool said_again_ = false;
  unsigned idle_looks_ = 0;
  Answer refused_ = Answer::kDone;  // the last continuation of a stop
  std::string alarm_code_;
  std::uint32_t last_line_ = 0;
  const unsigned looks_ =
      options_.fast ? 100000 : 400;  // for the machine to come to rest; a look may be one scan
};

// The shared memory, where it is asked for, and what it shows of the programs.
class Sharing final : public nc::rt::EventSink {
 public:
  Sharing(const Options& options, const nc::rt::Config& config, nc::hal::Hal* machine)
      : asked_(config.share.enabled || !options.share.empty()),
        wanted_(asked_ || options.serve),
        tap_(machine, config.points.size()),
        programs_(static_cast<nc_dialect>(config.nc.dialect)) {
    share_.name = !options.share.empty()        ? options.share
                  : !config.share.name.empty() ? config.share.name
                                               : config.name;
    share_.commands = options.commands;
    share_.group = config.share.group;
    share_.virtual_time = options.fast;
  }
  nc::hal::Hal* hal(nc::hal::Hal* machine) { return wanted_ ? &tap_ : machine; }

  // Before the start of the runtime.
  bool prepare(nc::rt::Runtime* runtime, nc::tools::ProgramFiles* files, const std::string& folder,
               std::string* error) {
    if (!wanted_) return true;
    files_ = files;
    runtime->set_sink(this);
    runtime->set_program_loader([this, runtime, folder](const std::string& name, unsigned* file, std::string* why) {
      const std::string path = folder + "/" + name;
      if (files_->add(runtime->control(), path, file, why) != NC_OK) {
        // The folder is the control's affair; the client has given a name in it.
        if (why->rfind(folder + "/", 0) == 0) why->erase(0, folder.size() + 1);
        return false;
      }
      programs_.add(*file, path, files_->text_of(*file));
      return true;
    });
    service_ = std::make_unique<nc::rt::share::Service>(runtime, &programs_, &tap_, share_);
    if (service_->create(error)) return true;
    service_.reset();
    if (asked_) return false;
    std::fprintf(stderr, "warning: no shared memory, nothing for ncdds: %s\n", error->c_str());
    return true;
  }
  bool start(std::string* error) { return service_ == nullptr || service_->start(error); }
  void stop() {
    if (service_ != nullptr) service_->stop();
  }
  nc::rt::share::ProgramTable& programs() { return programs_; }

  // Feeder thread, to which the files belong: a sub program gets its name when its first block is done.
  void executed(unsigned, const nc_event& event) override {
    // A place may have got another program since: of that it says the number of texts entered.
    if (event.source.file == last_file_ && files_->entered() == last_entered_) return;
    last_file_ = event.source.file;
    last_entered_ = files_->entered();
    const std::string path = files_->path_of(event.source.file);
    if (!path.empty()) programs_.add_name(event.source.file, path, files_->text_of(event.source.file));
  }

 private:
  const bool asked_, wanted_;  // a service shows itself where it can: without being asked, failure is a warning
  nc::rt::share::PointTap tap_;
  nc::rt::share::ServiceOptions share_;
  nc::rt::share::ProgramTable programs_;
  nc::tools::ProgramFiles* files_ = nullptr;
  unsigned last_file_ = ~0u;
  std::uint64_t last_entered_ = 0;
  std::unique_ptr<nc::rt::share::Service> service_;
};

// One control for one machine, for as long as the lock lives. On virtual time a machine without a bus has no outputs: whoever
// wants may simulate it as often as he likes.
bool lock_machine(const Options& options, const nc::rt::Config& config, nc::rt::MachineLock* lock, std::string* error) {
  if (options.fast && config.modbus.empty()) return true;
  return lock->take(nc::rt::machine_resources(config, !options.fast), error) && lock->take_file(config.file, error);
}

// The machine, its control and the program, brought up and taken down.
int operate(const Options& options, nc::rt::Config* config) {
  std::string error;
  nc::rt::MachineLock lock;  // first, so that it is given back last: behind the safe values of the outputs
  if (!lock_machine(options, *config, &lock, &error)) {
    std::fprintf(stderr, "ncrtd: %s\n", error.c_str());
    return kExitInUse;
  }
  if (!options.plot.empty())
    for (const char* ending : {".svg", ".png"})
      if (!nc::tools::can_be_written(options.plot + ending, &error)) return failed(error);
  if (!options.dialect.empty()) change_dialect(options.dialect, config);
  nc::hal::SimMachine machine(config->sim, config->points);
  const auto links = nc::hal::modbus::make_links(config->modbus_links(), report_link);
  if (options.fast && !links.empty())
    report_link("the links run in real time, whatever the speed of the program");
  std::vector<nc::hal::PointBus*> buses;
  for (const auto& link : links) buses.push_back(link.get());
  nc::hal::Composite hal(&machine, buses, config->points);
  nc::rt::RealClock real;
  nc::rt::VirtualClock virtual_clock;
  nc::rt::RuntimeParts parts;
  parts.clock = options.fast ? static_cast<nc::rt::Clock*>(&virtual_clock) : &real;
  Sharing sharing(options, *config, &hal);
  parts.hal = sharing.hal(&hal);
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(*config, parts, &errors);
  if (runtime == nullptr) return config_failed(errors);

  nc::tools::ProgramFiles files(config->programs_folder(), config->program_text);
  files.set_external(config->external_folder());
  files.set_remembered([&runtime](unsigned file) { return runtime->remembers(file); });
  files.set_report([](const std::string& why) { std::fprintf(stderr, "warning: %s\n", nc::rt::valid_utf8(why).c_str()); });
  files.attach(runtime->control());
  unsigned file = 0;
  if (!options.program.empty() && files.add(runtime->control(), options.program, &file, &error) != NC_OK)
    return failed(error);
  if (!options.program.empty()) sharing.programs().add(file, options.program, files.text_of(file));
  sharing.programs().set_mdi(options.mdi);
  if (!sharing.prepare(runtime.get(), &files, config->programs_folder(), &error)) return failed(error);
  nc::tools::PrintFile print;
  nc::tools::PrintLines printed;
  if (config->print.empty()) {
    if (!options.serve) runtime->set_printer([&printed](const nc_text& text) { printed.write(text); });
  } else {
    if (!print.open(config->print_file(), &error)) return failed(error);
    runtime->set_printer([&print](const nc_text& text) {
      const bool was_good = print.good();
      print.write(text);
      if (was_good && !print.good()) std::fprintf(stderr, "warning: external output: %s\n", print.error().c_str());
    });
  }
  nc::tools::RunPlot path(config->nc, nc::tools::plot_views().at(options.view), nc::tools::plot_coordinates().at(options.coordinates),
                          nc::tools::plot_colors().at(options.color));
  path.set_modal([&runtime](nc_modal* modal) {
    const nc::rt::FeederInfo info = runtime->info();
    *modal = info.modal[0];
    return info.modal_known[0];
  });
  if (!options.plot.empty()) runtime->set_path_sink(&path);
  nc::rt::Progress progress(stdout, isatty(STDOUT_FILENO) != 0, options.program.empty() ? 0 : nc::rt::estimate_lines(files.text_of(file).get(), static_cast<nc_dialect>(config->nc.dialect)));

  std::signal(SIGPIPE, SIG_IGN);  // a reader of the progress that goes away must not stop a machine in motion
  for (const int ending : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(ending, on_signal);  // HUP: a terminal that goes away
  if (!(options.fast ? runtime->start_stepping(&error) : runtime->start(&error))) return failed(error);
  for (const std::string& warning : runtime->warnings())
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  if (const std::string kept = options.fast ? nc::rt::not_read_text(*config) : ""; !kept.empty())
    std::fprintf(stderr, "note: %s\n", nc::rt::valid_utf8(kept).c_str());
  if (!sharing.start(&error)) return failed(error);
  if (options.serve) {
    nc::tools::ServeOptions service;
    service.signal = &g_signal;
    service.leave = [&sharing] { sharing.stop(); };  // and with it the commands
    const bool rest = nc::tools::serve(runtime.get(), service);
    runtime->stop();
    return rest ? 0 : kExitAlarm;
  }
  wait_for_outputs(links);
  Answer answer = Answer::kDone;
  if (!options.program.empty()) {
    answer = runtime->select_program(file);
  } else {
    answer = runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kMdi));
    if (answer == Answer::kDone) answer = runtime->load_mdi(options.mdi + "\n");
  }
  Run run(runtime.get(), options, &progress, &printed);
  int result = answer == Answer::kDone          ? run.to_end()
               : by_alarm(answer)             ? run.stop_by_alarm()
                                              : failed(std::string("not started: ") + runtime->explain(answer));
  sharing.stop();
  runtime->stop();
  if (!print.good()) {
    std::fprintf(stderr, "ncrtd: %s: not all that the program printed is there: %s\n", config->print_file().c_str(), print.error().c_str());
    if (result == 0) result = kExitUsage;
  }
  if (options.plot.empty() || result == kExitUsage) return result;
  path.finish();
  path.plot.set_title(options.program);
  path.plot.set_alarm(run.alarm_code());
  for (const char* ending : {".svg", ".png"}) {
    const std::string name = options.plot + ending;
    const bool written =
        ending[1] == 's' ? path.plot.write_svg(name, &error) : path.plot.write_png(name, &error);
    if (!written) return failed(error);
    std::printf("plot         %s\n", name.c_str());
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  nc::rt::limit_allocator();
  CLI::App app{"ncrtd: runs NC programs on a machine, or on a simulated one"};
  Options options;
  app.set_version_flag("--version", std::string("ncrtd ") + nc_version());
  app.add_option("--machine,--config", options.config, "machine configuration (TOML)")->required()->check(nc::tools::given());
  app.require_subcommand(1);
  app.fallthrough();  // --machine FILE before or behind the command
  CLI::App* check = app.add_subcommand("check", "read the configuration, report every error, do nothing");
  CLI::App* run = app.add_subcommand("run", "run a program from cycle start to its end");
  run->add_option("PROGRAM", options.program, "NC program")->required()->check(nc::tools::given());
  run->add_option("--dialect", options.dialect, "instead of the configured one")
      ->transform(nc::tools::one_of(nc::tools::dialect_names()));
  run->add_option("--plot", options.plot, "write BASE.svg and BASE.png of the executed path")
      ->type_name("BASE")
      ->check(nc::tools::given());
  nc::tools::add_plot_options(run, &options.view, &options.coordinates, &options.color, [run](CLI::Option* option) { option->needs(run->get_option("--plot")); });
  CLI::App* mdi = app.add_subcommand("mdi", "execute blocks");
  mdi->add_option("BLOCKS", options.mdi, "blocks, separated by line ends")->required()->check(nc::tools::given());
  for (CLI::App* sub : {run, mdi}) {
    sub->add_flag("--fast", options.fast, "virtual time: as fast as the processor; retained data is neither read nor written");
    sub->add_flag("--no-progress", options.no_progress, "no live line");
    sub->add_flag("--quiet", options.quiet, "only the summary: no messages, no stops");
  }
  CLI::App* service = app.add_subcommand("serve", "bring the machine up and stay until SIGTERM or SIGINT");
  for (CLI::App* sub : {run, mdi, service}) {
    sub->add_option("--share", options.share, "shared memory of this name, for ncdds")->check(nc::tools::given());
    sub->add_flag("--commands", options.commands, "take commands from it");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return written(app.exit(error) == 0 ? 0 : kExitUsage);
  }

  options.serve = service->parsed();
  nc::rt::Config config;
  nc::rt::Config partial;
  std::vector<nc::rt::ConfigError> errors = nc::rt::load_config(options.config, &config, &partial);
  const bool whole = errors.empty();  // as a text; what it asks of the computer is another matter
  if (whole) errors = nc::rt::check_host(config);
  if (!errors.empty() && check->parsed()) check_ladder(whole ? config : partial, whole, &errors);
  if (!errors.empty()) return config_failed(errors);
  options.commands |= config.share.commands && !options.fast;
  if (options.commands && options.fast) return failed("--commands is for a machine in real time, not for --fast");
  if (options.commands && options.share.empty() && !options.serve && !config.share.enabled)
    return failed("--commands needs shared memory: --share NAME, or enabled = true in [share]");
  if (!check->parsed()) return written(operate(options, &config));
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> refused;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &refused);
  if (runtime == nullptr) return config_failed(refused);
  for (const std::string& warning : runtime->warnings()) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::printf("%s: %s, %u us, %u points: no errors\n", options.config.c_str(), config.name.c_str(),
              config.cycle_us, config.points.size());
  return written(0);
}
