// SPDX-License-Identifier: Apache-2.0
// The loop of the service. See serve.hpp.
#include "tools/lib/serve.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "runtime/clock.hpp"
#include "runtime/console.hpp"
#include "tools/lib/service_notify.hpp"

namespace nc::tools {
namespace {

using nc::rt::CommandKind;
using nc::rt::Snapshot;

constexpr auto kLook = std::chrono::milliseconds(5);

class Service {
 public:
  Service(nc::rt::Runtime* runtime, const ServeOptions& options) : runtime_(*runtime), options_(options) {}

  bool run() {
    const nc::rt::Config& config = runtime_.config();
    say("up: " + config.name + ", cycle " + std::to_string(config.cycle_us) + " us");
    notify_.send("READY=1\nSTATUS=ready");
    while (*options_.signal == 0) {
      look();
      if (options_.look) options_.look();
      std::this_thread::sleep_for(kLook);
    }
    return end();
  }

 private:
  void say(const std::string& text) {
    std::fprintf(options_.out, "%s\n", text.c_str());
    std::fflush(options_.out);
  }

  void look() {
    const Snapshot now = runtime_.snapshot();
    beat(now);
    tell_state(now);
    tell_alarms(now);
    tell_refusals(now);
  }

  // Reports refused cycle starts. The reason why a jog is refused is shown only on monitors.
  void tell_refusals(const Snapshot& now) {
    std::string said;  // a reason that is the same for all part systems is printed once
    for (unsigned s = 0; s < now.system_count; ++s) {
      const nc::rt::Refusal& refusal = now.system[s].refusal;
      const std::string why = "cycle start " + nc::rt::asker_text(runtime_.config(), refusal.by) + " refused: " + runtime_.explain(refusal.why);
      if (refusal.count != refusals_[s] && refusal.asked == nc::rt::Asked::kCycleStart && why != said) say(said = why);
      refusals_[s] = refusal.count;
    }
  }

  // Feeds the watchdog at a third of its interval, but only when there was a scan since the last time.
  void beat(const Snapshot& now) {
    const std::int64_t interval_ns = notify_.watchdog_ns(), time_ns = clock_.now_ns();
    if (interval_ns == 0 || time_ns - fed_ns_ < interval_ns / 3 || now.scan == fed_scan_) return;
    if (notify_.send("WATCHDOG=1")) fed_ns_ = time_ns;
    fed_scan_ = now.scan;
  }

  // Reports changes of state. Manual motion is not reported, because it begins and ends with each detent of a handwheel; monitors show it.
  void tell_state(const Snapshot& now) {
    for (unsigned s = 0; s < now.system_count; ++s) {
      const unsigned state = now.system[s].nc.state;
      if (state == state_[s] || state == NC_STATE_MANUAL) continue;
      state_[s] = state;
      std::string text = now.system_count > 1 ? "part system " + std::to_string(s + 1) + ": " : "";
      text += nc::rt::state_text(now.system[s].nc);
      say(text);
      notify_.send("STATUS=" + text);
    }
  }

  // Reports an alarm one look after it has come, because by then the feeder has its details.
  void tell_alarms(const Snapshot& now) {
    std::vector<nc::rt::ActiveAlarm> active(now.alarms.alarm, now.alarms.alarm + now.alarms.count);
    for (const nc::rt::ActiveAlarm& alarm : active) {
      const bool seen = contains(seen_, alarm);
      if (seen && !contains(told_, alarm)) {
        say((nc::rt::is_warning(alarm.id) ? "warning: " : "alarm: ") + runtime_.alarm_text(alarm));
        told_.push_back(alarm);
      }
    }
    seen_ = active;
    if (active.empty()) told_.clear();
  }
  static bool contains(const std::vector<nc::rt::ActiveAlarm>& list, const nc::rt::ActiveAlarm& alarm) {
    for (const nc::rt::ActiveAlarm& other : list)
      if (other.id == alarm.id && other.axis == alarm.axis && other.system == alarm.system &&
          other.scan == alarm.scan && other.detail == alarm.detail)
        return true;
    return false;
  }

  // Ends with feed hold, waiting for rest, and reset, so that the axes stop on their path and not because the drives lose their enable signal. The first hold waits for
  // nobody: until the commands of clients have ended some time may go by.
  bool end() {
    say("end: feed hold");
    notify_.send("STOPPING=1\nSTATUS=coming to rest");
    (void)runtime_.execute(CommandKind::kFeedHold);
    runtime_.leave();
    if (options_.leave) options_.leave();
    runtime_.execute(CommandKind::kEnd);
    const bool rest = wait_for([](const Snapshot& now) {
      for (unsigned s = 0; s < now.system_count; ++s)
        if (!now.system[s].nc.distance_zero) return false;
      return true;
    });
    runtime_.execute(CommandKind::kReset);
    const bool reset = wait_for([](const Snapshot& now) { return !now.resetting; });
    say(rest && reset ? "end: at rest" : "end: not at rest in time; the outputs are made safe all the same");
    return rest && reset;
  }
  template <class Condition>
  bool wait_for(Condition condition) {
    const std::int64_t give_up = clock_.now_ns() + options_.rest_ns;
    // The condition is looked at from the second snapshot on, which certainly contains the effect of the command.
    const std::uint64_t first = runtime_.snapshot().scan + 2;
    for (;;) {
      const Snapshot now = runtime_.snapshot();
      beat(now);
      if (now.scan >= first && condition(now)) return true;
      if (clock_.now_ns() > give_up) return false;
      std::this_thread::sleep_for(kLook);
    }
  }

  nc::rt::Runtime& runtime_;
  const ServeOptions& options_;
  ServiceNotify notify_;
  nc::rt::RealClock clock_;
  std::int64_t fed_ns_ = 0;
  std::uint64_t fed_scan_ = 0;
  unsigned state_[NC_MAX_SYSTEMS] = {};
  std::uint32_t refusals_[NC_MAX_SYSTEMS] = {};
  std::vector<nc::rt::ActiveAlarm> seen_, told_;
};

}  // namespace

bool serve(nc::rt::Runtime* runtime, const ServeOptions& options) {
  return Service(runtime, options).run();
}

}  // namespace nc::tools
