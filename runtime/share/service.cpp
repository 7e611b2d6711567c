// SPDX-License-Identifier: Apache-2.0
// Threads of the segment. See service.hpp.
#include "runtime/share/service.hpp"

#include "runtime/share/alarm_entry.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

constexpr std::int64_t kPublishNs = 10'000'000;
constexpr std::int64_t kIntakeNs = 5'000'000;  // interval at which leases and pending commands are looked at; a new command wakes the thread at once
constexpr std::int64_t kLookNs = 100'000'000;   // a gateway that ends between a command and its wake costs no more
constexpr unsigned kCommandsPerTurn = 32;

void sleep_until(std::int64_t when_ns) {
  const timespec when{when_ns / 1'000'000'000, when_ns % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr);
}

}  // namespace

Machine::State RuntimeMachine::state() {
  const Snapshot snapshot = runtime_.snapshot();
  const FeederInfo info = runtime_.info();
  const Config& config = runtime_.config();
  State state;
  state.mode = snapshot.mode;
  state.resetting = snapshot.resetting;
  state.reset_held = snapshot.reset_held;
  state.alarmed = snapshot.stopped_by_alarm();
  state.resets = snapshot.resets;
  state.system_count = config.nc.system_count;
  state.max_feed_override = config.nc.max_feed_override;
  for (unsigned s = 0; s < state.system_count; ++s) {
    state.axis_count[s] = config.nc.system[s].axis_count;
    const nc_outputs& out = snapshot.system[s].nc;
    state.run_state[s] = out.state;
    for (unsigned a = 0; a < state.axis_count[s]; ++a) state.moves[s] = state.moves[s] || out.velocity.v[a] != 0;
    state.runs[s] = info.system[s].runs;
    const FeederInfo::Selected& selected = info.system[s].selected;
    if (selected.any) state.program[s] = selected.mdi ? "MDI" : file_name(programs_.at(selected.file).path);
  }
  return state;
}

std::string RuntimeMachine::alarm() {
  const Snapshot snapshot = runtime_.snapshot();
  const FeederInfo info = runtime_.info();
  for (unsigned i = 0; i < snapshot.alarms.count; ++i) {
    const ActiveAlarm& alarm = snapshot.alarms.alarm[i];
    Entry entry{};
    if (alarm.acknowledged || is_warning(alarm.id) || !describe_alarm(runtime_, info, alarm, &entry)) continue;
    const std::string axis(text_of(entry.axis));
    return std::string(text_of(entry.code)) + " " + std::string(text_of(entry.text)) + (axis.empty() ? "" : ", axis " + axis);
  }
  return {};
}

Answer RuntimeMachine::load_mdi(unsigned system, const std::string& blocks) {
  const Answer answer = runtime_.load_mdi(blocks, system);
  if (answer == Answer::kDone) programs_.set_mdi(system, blocks);
  return answer;
}

Service::Service(Runtime* runtime, ProgramTable* programs, PointTap* tap, const ServiceOptions& options)
    : runtime_(*runtime),
      options_(options),
      machine_(runtime, programs),
      desk_(&machine_),
      programs_(*programs),
      tap_(tap) {}

bool Service::create(std::string* error) {
  const MachineBlock machine = machine_block(runtime_.config(), options_.name);
  if (!segment_.create(options_.name, options_.group, options_.commands, machine, error)) return false;
  publisher_ = std::make_unique<Publisher>(&runtime_, &programs_, tap_, segment_.get(), options_.virtual_time);
  return true;
}

bool Service::start(std::string* error) {
  started_ = true;
  publisher_->publish();
  if (!publisher_thread_.start([this] { publisher_thread(); }, error)) return false;
  if (options_.commands && !arrival_thread_.start([this] { arrival_thread(); }, error)) return false;
  return !(options_.commands || options_.local) || intake_thread_.start([this] { intake_thread(); }, error);
}

void Service::stop() {
  if (!started_) return;
  started_ = false;
  stop_ = true;
  wake(&segment_.get()->wake_intake);
  arrival_thread_.join();
  waiting_.wake();
  intake_thread_.join();
  publisher_thread_.join();
  publisher_->publish();
  segment_.remove();
}

void Service::publisher_thread() {
  std::int64_t next_ns = RealClock().now_ns();
  while (!stop_) {
    publisher_->publish();
    next_ns += kPublishNs;
    const std::int64_t now_ns = RealClock().now_ns();
    if (next_ns < now_ns) next_ns = now_ns;
    sleep_until(next_ns);
  }
}

// A hold does not wait for the commands before it: at its turn only its answer is left.
void Service::arrived(const Request& request) {
  const Arrival arrival = desk_.arrived(request, {wall_ns(), RealClock().now_ns()});
  if (waiting_.push(request, arrival) || is_from_gateway(request)) return;
  answers_.add_if_room(refusal_of(request, wall_ns(), AckReason::kOverflow, "too many commands at once"));
}

void Service::arrival_thread() {
  Segment& segment = *segment_.get();
  const auto request = std::make_unique<Request>();
  while (!stop_) {
    const std::uint32_t seen = segment.wake_intake.load(std::memory_order_acquire);
    bool any = false;
    for (unsigned i = 0; i < kCommandRing && segment.commands.pop(request.get()); ++i) {
      arrived(*request);
      any = true;
    }
    if (any) give_answers();
    else wait_for_change(&segment.wake_intake, seen, kLookNs);
  }
}

void Service::give_answers() {
  if (answers_.give(&segment_.get()->acks)) wake(&segment_.get()->wake_reader);
}

void Service::intake_thread() {
  std::vector<Ack> acks;
  RequestQueue::Waiting next;
  while (!stop_) {
    // Answers are never lost: while many of them wait for room in the ring, no more commands are executed.
    for (unsigned i = 0; i < kCommandsPerTurn && answers_.size() < kCommandsPerTurn && waiting_.pop(&next); ++i) {
      desk_.take(next.request, {wall_ns(), RealClock().now_ns()}, Way::kGateway, &acks, next.arrival);
      answers_.add(&acks);
    }
    desk_.tick({wall_ns(), RealClock().now_ns()}, &acks);
    answers_.add(&acks);
    give_answers();
    if (answers_.size() >= kCommandsPerTurn) sleep_until(RealClock().now_ns() + kIntakeNs);
    else waiting_.wait(std::chrono::nanoseconds(kIntakeNs));
  }
}

}  // namespace nc::rt::share
