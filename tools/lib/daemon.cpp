// SPDX-License-Identifier: Apache-2.0
// See daemon.hpp.
#include "tools/lib/daemon.hpp"

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "runtime/console.hpp"
#include "runtime/end_signal.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/machine_lock.hpp"
#include "runtime/motion_choice.hpp"
#include "runtime/runtime.hpp"
#include "tools/lib/daemon_sharing.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/plot_names.hpp"
#include "tools/lib/print_file.hpp"
#include "tools/lib/program_files.hpp"
#include "tools/lib/program_run.hpp"
#include "tools/lib/run_plot.hpp"
#include "tools/lib/serve.hpp"

namespace nc::tools {
namespace {

using rt::Answer;
using rt::ConfigError;

constexpr const char* kPlotEndings[] = {".svg", ".png"};

int failed(const std::string& text) {
  std::fprintf(stderr, "ncrtd: %s\n", rt::valid_utf8(text).c_str());
  return kDaemonUsage;
}

void warn(const std::string& text) {
  std::fprintf(stderr, "warning: %s\n", text.c_str());
}

int config_failed(const std::vector<ConfigError>& errors) {
  for (const ConfigError& error : errors) std::fprintf(stderr, "%s\n", error.text().c_str());
  return kDaemonUsage;
}

// Called in the threads of the buses.
void report_bus(const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
}

// The machine of a configuration from its start to its end. Members that the runtime uses are declared before it, so that they outlive it.
class Daemon {
 public:
  Daemon(const DaemonOptions& options, rt::Config* config)
      : options_(options),
        config_(*config),
        files_(config->programs_folder(), config->program_text),
        path_(config->nc, plot_views().at(options.view), plot_coordinates().at(options.coordinates), plot_colors().at(options.color)) {}

  // Also after a start that has failed half way: the threads are ended before the members that they use are destroyed.
  ~Daemon() {
    if (sharing_ != nullptr) sharing_->stop();
    if (runtime_ != nullptr) runtime_->stop();
    if (sharing_ != nullptr) sharing_->stop_history();
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  int run() {
    int status = prepare();
    if (status != 0) return status;
    status = start();
    if (status != 0) return status;
    return options_.command == DaemonOptions::Command::kServe ? serve_to_signal() : run_to_end();
  }

 private:
  bool has_program() const { return options_.command == DaemonOptions::Command::kRun; }
  int prepare();
  int make_runtime();
  int load_program();
  int open_printer();
  int start();
  int serve_to_signal();
  int run_to_end();
  Answer select();
  int write_plot(const std::string& alarm_code);

  const DaemonOptions& options_;
  rt::Config& config_;
  rt::RealClock real_clock_;
  rt::VirtualClock virtual_clock_;
  rt::MadeMachine machine_;
  ProgramFiles files_;
  unsigned file_ = 0;  // index of the program in the store
  PrintFile print_;
  PrintLines printed_;
  RunPlot path_;
  std::unique_ptr<DaemonSharing> sharing_;
  std::unique_ptr<rt::Runtime> runtime_;
};

int Daemon::prepare() {
  for (int (Daemon::*const step)() : {&Daemon::make_runtime, &Daemon::load_program, &Daemon::open_printer})
    if (const int status = (this->*step)(); status != 0) return status;
  path_.set_modal([this](nc_modal* modal) {
    const rt::FeederInfo info = runtime_->info();
    *modal = info.system[0].modal;
    return info.system[0].modal_known;
  });
  if (!options_.plot.empty()) runtime_->set_path_sink(&path_);
  return 0;
}

int Daemon::make_runtime() {
  machine_ = rt::make_machine(config_, report_bus);
  if (options_.fast)
    for (const rt::PointBusKind& kind : rt::point_bus_kinds()) {
      bool used = false;
      for (const rt::PointBusConfig& bus : config_.buses) used |= bus.kind == &kind;
      if (used && !kind.on_virtual_time.empty()) report_bus(std::string(kind.name) + ": " + std::string(kind.on_virtual_time));
    }
  sharing_ = std::make_unique<DaemonSharing>(options_, config_, machine_.hal.get());
  rt::RuntimeParts parts;
  parts.clock = options_.fast ? static_cast<rt::Clock*>(&virtual_clock_) : &real_clock_;
  parts.hal = sharing_->hal(machine_.hal.get());
  std::vector<ConfigError> errors;
  runtime_ = rt::Runtime::create(config_, parts, &errors);
  return runtime_ == nullptr ? config_failed(errors) : 0;
}

int Daemon::load_program() {
  std::string error;
  files_.set_external(config_.external_folder());
  files_.set_remembered([this](unsigned file) { return runtime_->remembers(file); });
  files_.set_stop([this] { return runtime_->reads_too_long(); });
  files_.set_report([](const std::string& why) { warn(rt::valid_utf8(why)); });
  files_.attach(runtime_->control());
  runtime_->set_program_refresh([this] { files_.look_again(runtime_->control()); });
  runtime_->set_program_hash([this](unsigned file) { return files_.hash_of(file); });
  runtime_->set_changed_programs([this] { return rt::valid_utf8(files_.changed()); });
  if (has_program()) {
    if (files_.add(runtime_->control(), options_.program, &file_, &error) != NC_OK) return failed(error);
    sharing_->programs().add(file_, options_.program, files_.text_of(file_));
  }
  sharing_->programs().set_mdi(0, options_.mdi);
  return sharing_->prepare(runtime_.get(), &files_, config_.programs_folder(), &error) ? 0 : failed(error);
}

// M700 13.5.8: what programs print goes into the file that the configuration names, or else to the terminal.
int Daemon::open_printer() {
  std::string error;
  if (config_.print.empty()) {
    if (options_.command != DaemonOptions::Command::kServe)
      runtime_->set_printer([this](const nc_text& text) {
        printed_.write(text);
        return std::string();
      });
    return 0;
  }
  if (!print_.open(config_.print_file(), &error)) return failed(error);
  runtime_->set_printer([this](const nc_text& text) { return print_.write(text) ? std::string() : config_.print_file() + ": " + print_.error(); });
  return 0;
}

int Daemon::start() {
  std::string error;
  rt::catch_end_signals({SIGINT, SIGTERM, SIGHUP, SIGQUIT});  // SIGHUP comes when the terminal is closed
  if (!(options_.fast ? runtime_->start_stepping(&error) : runtime_->start(&error))) return failed(error);
  for (const std::string& warning : runtime_->warnings()) warn(warning);
  if (const std::string kept = options_.fast ? rt::not_read_text(config_) : ""; !kept.empty())
    std::fprintf(stderr, "note: %s\n", rt::valid_utf8(kept).c_str());
  return sharing_->start(&error) ? 0 : failed(error);
}

int Daemon::serve_to_signal() {
  ServeOptions service;
  service.signal = rt::end_signal_place();
  service.leave = [this] { sharing_->stop(); };  // ends the commands as well
  const bool rest = serve(runtime_.get(), service);
  runtime_->stop();
  if (options_.summary) std::printf("%s", rt::summary_text(*runtime_, runtime_->snapshot().system[0].nc, options_.since_ns).c_str());
  sharing_->stop_history();
  return rest ? 0 : kDaemonAlarm;
}

Answer Daemon::select() {
  if (has_program()) return runtime_->select_program(file_);
  const Answer answer = runtime_->execute(rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(rt::Mode::kMdi));
  return answer == Answer::kDone ? runtime_->load_mdi(options_.mdi + "\n") : answer;
}

int Daemon::run_to_end() {
  const std::uint64_t lines = has_program() ? rt::estimate_lines(files_.text_of(file_).get(), static_cast<nc_dialect>(config_.nc.dialect)) : 0;
  rt::Progress progress(stdout, isatty(STDOUT_FILENO) != 0, lines);
  rt::wait_for_held_outputs(machine_, [] { return rt::end_signal() != 0; });
  ProgramRun program(runtime_.get(), options_, &progress, &printed_);
  int status = program.to_end(select());
  sharing_->stop();
  runtime_->stop();
  if (!print_.good()) {
    failed(config_.print_file() + ": not all that the program printed is there: " + print_.error());
    if (status == 0) status = kDaemonUsage;
  }
  if (options_.plot.empty() || status == kDaemonUsage) return status;
  const int drawn = write_plot(program.alarm_code());
  return drawn == 0 ? status : drawn;
}

int Daemon::write_plot(const std::string& alarm_code) {
  path_.finish();
  path_.plot.set_title(options_.program);
  path_.plot.set_alarm(alarm_code);
  std::string error;
  for (const char* ending : kPlotEndings) {
    const std::string name = options_.plot + ending;
    if (!(ending[1] == 's' ? path_.plot.write_svg(name, &error) : path_.plot.write_png(name, &error))) return failed(error);
    std::printf("plot         %s\n", name.c_str());
  }
  return 0;
}

int operate(const DaemonOptions& options, rt::Config* config) {
  std::string error;
  rt::MachineLock lock;  // declared first, so that it is released last, after the outputs have their safe values
  if (!lock.take_machine(*config, options.fast, &error)) {
    std::fprintf(stderr, "ncrtd: %s\n", error.c_str());
    return kDaemonInUse;
  }
  if (!options.plot.empty())
    for (const char* ending : kPlotEndings)
      if (!can_be_written(options.plot + ending, &error)) return failed(error);
  if (!options.dialect.empty() && change_dialect(options.dialect, config))
    warn("[parameters] of " + config->file + " are those of another dialect: not used");
  return Daemon(options, config).run();
}

// Checks the ladder program even when the configuration has errors, so that all errors are reported at once.
void check_ladder(const rt::Config& config, bool whole, std::vector<ConfigError>* errors) {
  if (config.ladder.program.empty()) return;
  const std::size_t before = errors->size();
  std::vector<ConfigError> found;
  (void)rt::LadderTask::create(config, &found);
  errors->insert(errors->end(), found.begin(), found.end());
  if (errors->size() != before && !whole)
    errors->push_back({config.ladder_file(), 0, "", "its errors may follow from those of the configuration, which says what devices there are"});
}

// Finds the errors that only the control finds: a runtime is made but not started.
int check(const DaemonOptions& options, const rt::Config& config) {
  const std::unique_ptr<hal::Hal> machine = rt::make_axes(config);
  rt::VirtualClock clock;
  std::vector<ConfigError> refused;
  const auto runtime = rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &refused);
  if (runtime == nullptr) return config_failed(refused);
  for (const std::string& warning : runtime->warnings()) warn(warning);
  std::printf("%s: %s, %u us, %u points: no errors\n", options.config.c_str(), config.name.c_str(), config.cycle_us, config.points.size());
  std::printf("motion: %s; look_ahead %u\n", rt::motion_text(config.nc, config.motion_given).c_str(), config.nc.look_ahead);
  if (config.machine_kind->load != nullptr) std::printf("load of the bus %s\n", config.machine_kind->load(config).c_str());
  return 0;
}

}  // namespace

int daemon_command(const DaemonOptions& given) {
  DaemonOptions options = given;
  const bool only_check = options.command == DaemonOptions::Command::kCheck;
  rt::Config config, partial;
  std::vector<ConfigError> errors = rt::load_config(options.config, &config, &partial);
  const bool whole = errors.empty();  // the text has no errors; check_host() then checks what it requires of the computer
  if (whole) errors = rt::check_host(config);
  if (!errors.empty() && only_check) check_ladder(whole ? config : partial, whole, &errors);
  if (!errors.empty()) return config_failed(errors);
  if (const std::string conflict = conflict_of(options, config); !conflict.empty()) return failed(conflict);
  options.commands |= config.share.commands && !options.fast;
  return only_check ? check(options, config) : operate(options, &config);
}

}  // namespace nc::tools
