// SPDX-License-Identifier: Apache-2.0
// See program_run.hpp.
#include "tools/lib/program_run.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "runtime/end_signal.hpp"
#include "runtime/hal_factory.hpp"

namespace nc::tools {
namespace {

using rt::Answer;
using rt::CommandKind;
using rt::end_signal;
using rt::FeederInfo;
using rt::Snapshot;

constexpr auto kPeriod = std::chrono::milliseconds(50);  // period of the display
constexpr std::chrono::milliseconds kDrivesPatience{10000};
constexpr unsigned kStepsPerLook = 500;                  // on virtual time: number of scans between two updates of the display

// True when an alarm or a warning is active, which is shown instead of the refusal.
bool by_alarm(Answer answer) {
  return answer == Answer::kAlarmActive || answer == Answer::kWarningActive;
}

int refused(const std::string& what, const std::string& why) {
  std::fprintf(stderr, "ncrtd: %s\n", rt::valid_utf8(what + why).c_str());
  return kDaemonUsage;
}

}  // namespace

ProgramRun::ProgramRun(rt::Runtime* runtime, const DaemonOptions& options, rt::Progress* progress, PrintLines* printed)
    : runtime_(*runtime), options_(options), progress_(*progress), printed_(*printed), looks_(options.fast ? 100000 : 400) {}

int ProgramRun::to_end(Answer selected) {
  if (by_alarm(selected)) return stop_by_alarm();
  if (selected != Answer::kDone) return refused("not started: ", runtime_.explain(selected));
  return start_to_end();
}

int ProgramRun::start_to_end() {
  Answer answer = start_waiting();
  if (answer == Answer::kNotHomed && runtime_.config().machine_kind->name == "sim") {
    answer = home_simulated();
    if (answer == Answer::kDone) answer = start_waiting();
  }
  if (by_alarm(answer)) return stop_by_alarm();
  if (answer != Answer::kDone) return refused("cycle start: ", runtime_.explain(answer));
  int status = 0;
  do wait();
  while (!ended(&status));
  return status;
}

// A simulated machine is homed by who runs a program on it; beside a real one an operator stands, who does.
Answer ProgramRun::home_simulated() {
  const rt::Mode mode = runtime_.snapshot().mode;
  note("the machine is homed first");
  Answer answer = runtime_.execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(rt::Mode::kManual));
  if (answer != Answer::kDone) return answer;
  rt::Command home;
  home.kind = CommandKind::kHome;
  home.system = rt::kAllSystems;
  answer = runtime_.execute(home);
  const auto homing = [this] {
    const Snapshot now = runtime_.snapshot();
    bool any = false;
    for (unsigned s = 0; s < now.system_count; ++s) any |= now.system[s].axes.homing != 0;
    return any && !now.stopped_by_alarm();
  };
  while (answer == Answer::kDone && end_signal() == 0) {
    wait();
    if (!homing()) break;
  }
  if (runtime_.snapshot().stopped_by_alarm()) return Answer::kAlarmActive;
  if (answer != Answer::kDone) return answer;
  return runtime_.execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode));
}

Answer ProgramRun::start_waiting() {
  Answer answer = runtime_.execute(CommandKind::kCycleStart);
  // Drives that are coming on are waited for: nobody presses the button again here.
  for (auto left = kDrivesPatience; answer == Answer::kDrivesOff && left.count() > 0 && end_signal() == 0; left -= kPeriod) {
    wait();
    answer = runtime_.execute(CommandKind::kCycleStart);
  }
  return answer;
}

// One look; true with the exit status when the run is over.
bool ProgramRun::ended(int* status) {
  if (!options_.no_progress) progress_.show(runtime_);
  const Snapshot now = runtime_.snapshot();
  const FeederInfo info = runtime_.info();
  show_message(info);
  show_printed();
  show_again(info);
  if (end_signal() != 0) *status = stop_by_signal();
  else if (now.stopped_by_alarm()) *status = stop_by_alarm();
  else if (info.system[0].runs > 0 && now.system[0].nc.state == NC_STATE_IDLE) *status = stop_at_end(now);
  else if (given_up(now)) *status = stop_by_reset();
  else {
    continue_stop(now);
    return false;
  }
  return true;
}

// Continues a program stop at once, because there is no operator. When clients may give commands, it is left to them.
void ProgramRun::continue_stop(const Snapshot& now) {
  if (now.system[0].nc.state != NC_STATE_STOPPED || options_.commands) return;
  const Answer again = runtime_.execute(CommandKind::kCycleStart);
  if (again != refused_ || again == Answer::kDone)  // the same refusal is shown only once
    note("stop in line " + std::to_string(now.system[0].nc.source.line) + " (" + rt::state_text(now.system[0].nc) + "): " +
         (again == Answer::kDone ? "continued" : std::string("waits: ") + runtime_.explain(again)));
  refused_ = again;
}

// ---- time ----

// Waits for the time between two looks.
void ProgramRun::wait() {
  if (!options_.fast) {
    usleep(static_cast<useconds_t>(std::chrono::microseconds(kPeriod).count()));  // a signal ends it early
    return;
  }
  const std::uint64_t runs = runtime_.info().system[0].runs;
  for (unsigned i = 0; i < kStepsPerLook && end_signal() == 0 && runtime_.info().system[0].runs == runs; ++i) runtime_.step();
  runtime_.step();
}

void ProgramRun::rest() {
  for (unsigned i = 0; i < looks_ && !runtime_.snapshot().system[0].nc.distance_zero; ++i) wait();
}

// ---- what is shown ----

void ProgramRun::show_message(const FeederInfo& info) {
  for (const FeederInfo::Message& message : info.messages_since(messages_)) note("message: " + message.text);
  messages_ = info.messages;
}

// M700 13.3.1: M99 of a main program, also of MDI, begins it again. Such a run has no end of its own, which is shown once.
void ProgramRun::show_again(const FeederInfo& info) {
  if (info.system[0].begun_again == 0 || said_again_) return;
  said_again_ = true;
  note("line " + std::to_string(info.system[0].again_line) + ": begins again from the head, until a reset or a signal (Ctrl-C) ends it");
}

// M700 13.5.8: shows what programs print when the configuration names no file for it.
void ProgramRun::show_printed() {
  for (const std::string& line : printed_.take()) note("print: " + line);
}

void ProgramRun::show_summary(const nc_outputs& outputs) const {
  std::printf("%s", rt::summary_text(runtime_, outputs, options_.since_ns).c_str());
}

void ProgramRun::note(const std::string& text) {
  if (!options_.quiet) progress_.note(text);
}

// ---- ends ----

int ProgramRun::stop_at_end(const Snapshot& now) {
  show_printed();
  progress_.finish();
  show_summary(now.system[0].nc);
  return 0;
}

// Prints the active alarms and the summary.
int ProgramRun::stop_by_alarm() {
  rest();
  wait();  // the details of a program alarm come from the feeder
  show_printed();
  const Snapshot now = runtime_.snapshot();
  progress_.finish();
  bool lost = false;
  for (unsigned i = 0; i < now.alarms.count; ++i) {
    const std::string text = runtime_.alarm_text(now.alarms.alarm[i]);
    const bool warning = rt::is_warning(now.alarms.alarm[i].id);
    std::fprintf(stderr, "%s: %s\n", warning ? "warning" : "alarm", text.c_str());
    if (!warning && alarm_code_.empty()) alarm_code_ = text.substr(0, text.find(' '));
    lost |= now.alarms.alarm[i].id == rt::AlarmId::kRetainedLost;
  }
  show_summary(now.system[0].nc);
  if (lost) runtime_.execute(CommandKind::kReset);  // the user has read the message now, and there is nobody else who could acknowledge it
  return kDaemonAlarm;
}

// True when the control has been idle for a while although the run has not come to its end: the ladder or a client has reset it.
bool ProgramRun::given_up(const Snapshot& now) {
  constexpr unsigned kLooks = 20;
  if (now.system[0].nc.state != NC_STATE_IDLE) last_line_ = now.system[0].nc.source.line;
  idle_looks_ = now.system[0].nc.state == NC_STATE_IDLE && !now.resetting ? idle_looks_ + 1 : 0;
  return idle_looks_ > kLooks;
}

int ProgramRun::stop_by_reset() {
  progress_.finish();
  std::fprintf(stderr, "reset%s, before the end of the program\n", last_line_ == 0 ? "" : (" in line " + std::to_string(last_line_)).c_str());
  show_summary(runtime_.snapshot().system[0].nc);
  return kDaemonAlarm;
}

int ProgramRun::stop_by_signal() {
  const int signal = end_signal();
  note("signal: feed hold");
  runtime_.execute(CommandKind::kEnd);
  rest();
  const nc_outputs stopped = runtime_.snapshot().system[0].nc;
  runtime_.execute(CommandKind::kReset);
  for (unsigned i = 0; i < looks_ && runtime_.snapshot().resetting; ++i) wait();
  progress_.finish();
  std::printf("interrupted  by %s in line %u, before the end of the program\n", rt::signal_name(signal), stopped.source.line);
  show_summary(stopped);
  return rt::exit_status_of_signal(signal);
}

}  // namespace nc::tools
