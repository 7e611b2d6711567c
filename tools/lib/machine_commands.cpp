// SPDX-License-Identifier: Apache-2.0
// The subcommands of ncsim that run a program on the virtual machine: time, motion, plot --profile; see
// commands.hpp.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <system_error>

#include "tools/lib/command_text.hpp"
#include "tools/lib/commands.hpp"
#include "tools/lib/output_check.hpp"
#include "tools/lib/output_file.hpp"
#include "tools/lib/profile_plot.hpp"
#include "tools/lib/virtual_machine.hpp"

namespace nc::tools {
namespace {

bool open_session(Session* session, const SessionOptions& options, const MachineOptions& machine,
                  std::string* error) {
  std::unique_ptr<rt::Config> config;
  if (!machine.machine.empty() && !(config = load_machine(machine.machine, error))) return false;
  if (!session->configure(options, error, std::move(config))) return false;
  return set_machine_limits(machine, session->machine(), &session->config(), error) &&
         session->start(options, error);
}

int exit_code(MachineResult::How how) {
  return how == MachineResult::How::kAlarmed ? kExitAlarm : how == MachineResult::How::kEndless ? kExitEndless : kExitEnded;
}

// Prints how far the machine is after one hour of its time, after two, four and so on: a user who waits sees the place, and that the program may not end.
class LongRun {
 public:
  LongRun(double cycle_s, std::FILE* err) : cycle_s_(cycle_s), err_(err) {}
  void cycle(const nc_outputs& out) {
    if (static_cast<double>(++cycles_) * cycle_s_ < 3600.0 * hours_) return;
    std::fprintf(err_, "note: line %u after %.0f h of machine time; --max-seconds gives the run up earlier\n", out.source.line, hours_);
    hours_ *= 2.0;
  }

 private:
  double cycle_s_, hours_ = 1.0;
  uint64_t cycles_ = 0;
  std::FILE* err_;
};

MachineResult run(Session* session, const RunLimits& limits, std::FILE* err, const CycleObserver& each = {}) {
  LongRun long_run(session->config().cycle_s, err);
  const CycleObserver observe = [&](const nc_outputs& out) {
    long_run.cycle(out);
    return !each || each(out);
  };
  if (session->machine() == nullptr)
    return run_machine(session->control(), session->config(), session->setup(), session->decides(), limits.seconds, limits.loops, observe);
  const ServoModel servo = servo_of(*session->machine(), session->config().cycle_s);
  return run_machine(session->control(), session->config(), session->setup(), session->decides(), limits.seconds, limits.loops, observe, &servo);
}

// The number of decimals for times in seconds: three, and more if the cycle needs them.
int time_decimals(double cycle_s) {
  int count = 3;
  for (double rest = cycle_s * 1e3; count < 9 && std::fabs(rest - std::round(rest)) > 1e-7; rest *= 10)
    ++count;
  return count;
}

std::string short_name(const std::string& program) {
  const size_t slash = program.find_last_of('/');
  return program == "-" ? "standard input" : rt::valid_utf8(program.substr(slash == std::string::npos ? 0 : slash + 1));
}

// The descriptor of the file for rows, which is closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int given) : value_(given) {}
  ~Descriptor() {
    if (owned_) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool open(const std::string& path, std::string* error) {
    value_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    owned_ = value_ >= 0;
    if (!owned_) *error = path + ": cannot be written: " + std::generic_category().message(errno);
    return owned_;
  }
  int value() const { return value_; }

 private:
  int value_;
  bool owned_ = false;
};

}  // namespace

int time_command(const SessionOptions& options, const MachineOptions& machine, const RunLimits& limits, std::FILE* out,
                 std::FILE* err) {
  Session session;
  std::string error;
  if (!open_session(&session, options, machine, &error)) return complain(err, error);
  const MachineResult result = run(&session, limits, err);
  if (result.how == MachineResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  if (result.how == MachineResult::How::kEndless) complain(err, options.program + ": " + result.error);
  note_unused(result.unused, err);
  if (result.how == MachineResult::How::kAlarmed)
    std::fprintf(out, "%s\n", alarm_line(session, result.alarm).c_str());
  const uint64_t whole = static_cast<uint64_t>(result.seconds);
  std::fprintf(out, "cycle time   %s s (%llu:%02llu:%02llu)%s\n",
               decimals(result.seconds, time_decimals(session.config().cycle_s)).c_str(),
               static_cast<unsigned long long>(whole / 3600),
               static_cast<unsigned long long>(whole / 60 % 60), static_cast<unsigned long long>(whole % 60),
               result.how == MachineResult::How::kEndless ? " until it was given up"
               : result.one_pass                          ? " of one pass (it begins again by itself)"
                                                          : "");
  std::fprintf(out, "path length  %s mm\n", decimals(result.path_length, 3).c_str());
  std::fprintf(out, "blocks       %llu\n", static_cast<unsigned long long>(result.blocks));
  return close_output(out, err, exit_code(result.how));
}

int motion_command(const SessionOptions& options, const MachineOptions& machine, MotionFormat format,
                   const std::string& path, const RunLimits& limits, int out, std::FILE* err) {
  Session session;
  std::string error;
  if (!path.empty() && !can_be_written(path, &error)) return complain(err, error);
  if (!open_session(&session, options, machine, &error)) return complain(err, error);
  Descriptor target(out);
  if (!path.empty() && !target.open(path, &error)) return complain(err, error);
  OutputFile file(target.value());
  MotionWriter writer(&file, session.config(), format);
  writer.begin(session.setup().start);
  const MachineResult result = run(&session, limits, err, [&](const nc_outputs& cycle) {
    writer.cycle(cycle);
    return !file.failed();
  });
  if (!file.flush())
    return complain(
        err, (path.empty() ? "the motion" : path) + std::string(" cannot be written: ") + file.error_text());
  if (result.how == MachineResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  if (result.how == MachineResult::How::kEndless) complain(err, options.program + ": " + result.error);
  note_unused(result.unused, err);
  if (result.how != MachineResult::How::kAlarmed) return exit_code(result.how);
  std::fprintf(err, "%s\n", alarm_line(session, result.alarm).c_str());
  return kExitAlarm;
}

int profile_command(const SessionOptions& options, const MachineOptions& machine, const RunLimits& limits,
                    const std::string& base, std::FILE* out, std::FILE* err) {
  Session session;
  std::string error;
  if (!can_be_written(base + ".svg", &error) || !can_be_written(base + ".png", &error))
    return complain(err, error);
  if (!open_session(&session, options, machine, &error)) return complain(err, error);
  ProfilePlot plot(session.config());
  plot.set_title(short_name(options.program));
  plot.begin(session.setup().start);
  const MachineResult result = run(&session, limits, err, [&](const nc_outputs& cycle) {
    plot.cycle(cycle);
    return true;
  });
  if (result.how == MachineResult::How::kFailed) return complain(err, options.program + ": " + result.error);
  if (result.how == MachineResult::How::kEndless) complain(err, options.program + ": " + result.error);
  note_unused(result.unused, err);
  plot.end();
  if (!plot.write_svg(base + ".svg", &error) || !plot.write_png(base + ".png", &error))
    return complain(err, error);
  const bool alarmed = result.how == MachineResult::How::kAlarmed;
  if (alarmed) std::fprintf(out, "%s\n", alarm_line(session, result.alarm).c_str());
  std::fprintf(out, "%s.svg %s.png: %s s\n", base.c_str(), base.c_str(),
               decimals(result.seconds, time_decimals(session.config().cycle_s)).c_str());
  return close_output(out, err, exit_code(result.how));
}

}  // namespace nc::tools
