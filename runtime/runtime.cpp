// SPDX-License-Identifier: Apache-2.0
// The runtime: creation, threads, commands. See runtime.hpp.
#include "runtime/runtime.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace nc::rt {
namespace {

constexpr std::size_t kControlAlignment = 64;
constexpr unsigned kAnswerSteps = 100;  // virtual time: scans until an answer must be there
constexpr auto kAnswerTime = std::chrono::milliseconds(500);  // real time

// "M6", "M3 S": the groups that wait; the code of the first of M and T.
std::string fin_text(std::uint32_t groups, std::uint32_t code) {
  std::string text;
  bool coded = false;
  for (unsigned g = 0; g < 4; ++g) {
    if ((groups >> g & 1u) == 0) continue;
    if (!text.empty()) text += ' ';
    text += "MSTB"[g];
    if (!coded && (g == 0 || g == 2)) {
      text += std::to_string(code);
      coded = true;
    }
  }
  return text;
}

}  // namespace

void Runtime::FreeMemory::operator()(void* memory) const {
  std::free(memory);
}

Runtime::Runtime(const Config& config, const RuntimeParts& parts) : config_(config), parts_(parts) {
  if (parts_.ladder == nullptr) parts_.ladder = &empty_ladder_;
}

std::unique_ptr<Runtime> Runtime::create(const Config& config, const RuntimeParts& parts,
                                         std::vector<ConfigError>* errors) {
  std::unique_ptr<Runtime> runtime(new Runtime(config, parts));
  // Both are looked at, so that every mistake is reported at once.
  bool good = parts.nc != nullptr || runtime->make_control(errors);
  if (parts.ladder == nullptr && !config.ladder.program.empty()) {
    runtime->own_ladder_ = LadderTask::create(config, errors);
    good = good && runtime->own_ladder_ != nullptr;
  }
  if (!good) return nullptr;
  if (runtime->own_ladder_ != nullptr) {
    runtime->parts_.ladder = runtime->own_ladder_.get();
    for (const std::string& warning : runtime->own_ladder_->warnings()) runtime->warnings_.push_back(warning);
  }
  runtime->board_ = std::make_unique<SignalBoard>(config, runtime->parts_.ladder, runtime->own_ladder_.get());
  runtime->parts_.ladder = runtime->board_.get();
  runtime->scan_ =
      std::make_unique<Scan>(config, parts.clock, parts.hal, runtime->parts_.ladder, runtime->parts_.nc);
  runtime->feeder_ =
      std::make_unique<Feeder>(config.nc.system_count, runtime->parts_.nc, runtime->scan_.get());
  return runtime;
}

bool Runtime::make_control(std::vector<ConfigError>* errors) {
  const std::size_t size = nc_memory_required(&config_.nc);
  if (size == 0) {
    errors->push_back({config_.file, 0, "", "the control refuses this combination of axes and sizes"});
    return false;
  }
  const std::size_t rounded = (size + kControlAlignment - 1) / kControlAlignment * kControlAlignment;
  memory_.reset(std::aligned_alloc(kControlAlignment, rounded));
  nc_status status = NC_E_MEMORY;
  if (memory_ != nullptr) control_ = nc_create(&config_.nc, memory_.get(), rounded, &status);
  if (control_ == nullptr) {
    errors->push_back({config_.file, 0, "",
                       "the control cannot be made (status " + std::to_string(status) + ", " +
                           std::to_string(rounded) + " bytes)"});
    return false;
  }
  std::vector<ConfigError> refused = apply_config(config_, control_);
  errors->insert(errors->end(), refused.begin(), refused.end());
  if (!refused.empty()) return false;
  own_nc_ = std::make_unique<LibNc>(control_);
  parts_.nc = own_nc_.get();
  return true;
}

Runtime::~Runtime() {
  stop();
  if (wake_fd_ >= 0) close(wake_fd_);
}

bool Runtime::bring_up(std::string* error) {
  hal::PointImage initial;
  for (unsigned p = 0; p < config_.points.size(); ++p) initial.value[p] = config_.points.at(p).initial;
  if (parts_.hal->start(initial, error)) return true;
  parts_.hal->stop();
  return false;
}

// ---- virtual time ----

bool Runtime::start_stepping(std::string* error) {
  if (!bring_up(error)) return false;
  scan_->begin();
  stepping_ = true;
  return true;
}

void Runtime::step() {
  feeder_->step();
  scan_->loop_step();
}

// ---- real time ----

bool Runtime::start(std::string* error) {
  wake_fd_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_fd_ < 0) {
    *error = std::string("eventfd: ") + std::strerror(errno);
    return false;
  }
  if (!bring_up(error)) return false;
  stop_scan_ = stop_feeder_ = false;
  if (own_ladder_ != nullptr && !config_.retain_path().empty()) {
    keeper_ = std::make_unique<RetainKeeper>(own_ladder_.get(), config_.retain_path());
    keeper_->restore(&warnings_);
  }
  feeder_->step();  // the first blocks are there before the first scan
  if (!feeder_thread_.start([this] { feeder_thread(); }, error)) {
    parts_.hal->stop();
    return false;
  }
  running_ = true;
  if (!scan_thread_.start([this] { scan_thread(); }, error)) {
    stop();
    return false;
  }
  if (keeper_ != nullptr && !keeper_->start(error)) {
    stop();
    return false;
  }
  // Last, when every stack and buffer is there.
  if (config_.scheduling.lock_memory) lock_memory(&warnings_);
  while (!thread_warnings_ready_.load(std::memory_order_acquire))
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  return true;
}

void Runtime::stop() {
  if (running_) {
    stop_scan_ = true;
    scan_thread_.join();
    stop_feeder_ = true;
    wake_feeder();
    feeder_thread_.join();
    running_ = false;
    parts_.hal->stop();
    keeper_.reset();  // writes what the last scan left
  } else if (stepping_) {
    stepping_ = false;
    parts_.hal->stop();
  }
}

void Runtime::scan_thread() {
  promote_scan_thread(config_.scheduling, &thread_warnings_);
  scan_->begin();
  scan_->loop_step();
  first_scan_ns_ = RealClock().now_ns();
  thread_warnings_ready_.store(true, std::memory_order_release);
  while (!stop_scan_.load(std::memory_order_relaxed)) scan_->loop_step();
}

void Runtime::feeder_thread() {
  sharpen_timers();
  const long period_ns = static_cast<long>(config_.scheduling.feeder_us) * 1000;
  while (!stop_feeder_.load(std::memory_order_relaxed)) {
    feeder_->step();
    pollfd wake{wake_fd_, POLLIN, 0};
    const timespec timeout{0, period_ns};
    if (ppoll(&wake, 1, &timeout, nullptr) <= 0) continue;
    std::uint64_t count = 0;
    if (read(wake_fd_, &count, sizeof count) < 0) continue;  // someone else's wake-up: nothing to take
  }
  feeder_->step();  // what the last scans executed
}

void Runtime::wake_feeder() {
  const std::uint64_t one = 1;
  if (wake_fd_ >= 0 && write(wake_fd_, &one, sizeof one) < 0) return;  // full: it is awake already
}

std::vector<std::string> Runtime::warnings() const {
  std::vector<std::string> all = warnings_;
  if (thread_warnings_ready_.load(std::memory_order_acquire))
    all.insert(all.end(), thread_warnings_.begin(), thread_warnings_.end());
  return all;
}

// ---- commands ----

bool Runtime::find_answer(std::uint64_t ticket, bool from_feeder, Answer* answer) {
  CommandAnswer found;
  while (from_feeder ? feeder_->poll_answer(&found) : scan_->poll_answer(&found)) {
    if (found.ticket != ticket) continue;  // of a command that was given up
    *answer = found.answer;
    return true;
  }
  return false;
}

Answer Runtime::execute(Command command) {
  const std::lock_guard lock(operator_);
  return execute_alone(command);
}

Answer Runtime::execute_alone(Command command) {
  if (!running_ && !stepping_) return Answer::kNoAnswer;
  command.ticket = next_ticket_++;
  const bool feeder = for_feeder(command.kind);
  if (!(feeder ? feeder_->post(command) : scan_->post(command))) return Answer::kQueueFull;
  Answer answer = Answer::kNoAnswer;
  if (stepping_) {
    for (unsigned i = 0; i < kAnswerSteps; ++i) {
      step();
      if (find_answer(command.ticket, feeder, &answer)) break;
    }
    return answer;
  }
  wake_feeder();
  const auto give_up = std::chrono::steady_clock::now() + kAnswerTime;
  while (!find_answer(command.ticket, feeder, &answer)) {
    if (std::chrono::steady_clock::now() > give_up) return Answer::kNoAnswer;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return answer;
}

Answer Runtime::execute(CommandKind kind, double value, std::uint32_t number) {
  Command command;
  command.kind = kind;
  command.value = value;
  command.number = number;
  return execute(command);
}

Answer Runtime::load_mdi(const std::string& text, unsigned system) {
  const std::lock_guard lock(operator_);
  feeder_->set_mdi_text(text);
  Command command;
  command.kind = CommandKind::kLoadMdi;
  command.system = static_cast<std::uint8_t>(system);
  return execute_alone(command);
}

Answer Runtime::select_program(unsigned system, const std::string& name) {
  const std::lock_guard lock(operator_);
  feeder_->set_program_name(name);
  Command command;
  command.kind = CommandKind::kSelectProgram;
  command.system = static_cast<std::uint8_t>(system);
  command.number = kProgramByName;
  return execute_alone(command);
}

std::string Runtime::alarm_text(const ActiveAlarm& alarm) const {
  if (alarm.id == AlarmId::kProgram) {
    const FeederInfo now = info();
    if (!now.alarm) return "program alarm";
    std::string text = std::string(now.program_alarm.code) + " " + now.program_alarm.message;
    if (now.program_alarm.detail.s[0] != 0) text += std::string(": ") + now.program_alarm.detail.s;
    const nc_source& source = now.program_alarm.source;
    if (source.line != 0) text += " (line " + std::to_string(source.line) + ")";
    return text;
  }
  const AlarmRow& row = alarm_row(alarm.id);
  std::string text = std::string(row.code) + " " + row.text;
  if (alarm.id == AlarmId::kFinTimeout)
    text += alarm.detail != 0 ? ": " + fin_text(alarm.detail, alarm.code) : ": it is stuck on, so that no strobe can rise";
  if (alarm.id == AlarmId::kLadder) {
    const std::string& own = config_.ladder.alarm[alarm.detail % config_.ladder.alarm.size()];
    text += " " + std::to_string(alarm.detail + 1) + (own.empty() ? "" : ": " + own);
  }
  if (alarm.id == AlarmId::kLinkLost) text += ": " + config_.modbus[alarm.detail % config_.modbus.size()].link.name;
  if (alarm.id == AlarmId::kLadderStopped)
    text += ": " + config_.ladder.program + ", line " + std::to_string(alarm.detail);
  if (alarm.axis >= 0) text += std::string(", axis ") + config_.nc.system[alarm.system].axis[alarm.axis].name;
  if (alarm.source.line != 0) text += " (line " + std::to_string(alarm.source.line) + ")";
  return text;
}

}  // namespace nc::rt
