// SPDX-License-Identifier: Apache-2.0
// See scan_tap.hpp. Everything here is called by the scan: no memory, no lock, no system call.
#include "runtime/history/scan_tap.hpp"

#include <cmath>

namespace nc::rt::history {
namespace {

constexpr double kStands = 1e-5;  // rev/s; below it a spindle counts as standing (nc_spindle_inputs)

void count_up(std::atomic<std::uint64_t>* counter) noexcept { counter->store(counter->load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }

}  // namespace

bool ScanTap::tell(ScanEvent::Kind kind, const ActiveAlarm& alarm, std::int64_t time_ns) noexcept {
  ScanEvent event;
  event.kind = kind;
  event.system = alarm.system;
  event.time_ns = time_ns;
  event.alarm = alarm;
  return events_.push(event);
}

void ScanTap::look_at_alarms(const Snapshot& now) noexcept {
  if (now.alarms.count == 0 && known_count_ == 0) return;
  // What goes is told before what comes.
  for (unsigned i = 0; i < known_count_; ++i) {
    Known& known = known_[i];
    if (known.gone) continue;
    bool there = false;
    for (unsigned a = 0; a < now.alarms.count; ++a) there = there || same_alarm(now.alarms.alarm[a], known.alarm);
    known.gone = !there;
  }
  unsigned kept = 0;
  for (unsigned i = 0; i < known_count_; ++i) {
    const Known known = known_[i];
    if (known.gone && !known.told) count_up(&lost_);
    const bool done = known.gone && (!known.told || tell(ScanEvent::Kind::kCleared, known.alarm, now.time_ns));
    if (!done) known_[kept++] = known;
  }
  known_count_ = kept;
  for (unsigned a = 0; a < now.alarms.count; ++a) {
    const ActiveAlarm& alarm = now.alarms.alarm[a];
    bool there = false;
    for (unsigned i = 0; i < known_count_ && !there; ++i) there = same_alarm(alarm, known_[i].alarm);
    if (there) continue;
    if (known_count_ == known_.size()) {  // only when the ends of as many alarms wait for room in the queue
      count_up(&lost_);
      continue;
    }
    known_[known_count_++] = {alarm, false, false};
  }
  for (unsigned i = 0; i < known_count_; ++i)
    if (!known_[i].told && !known_[i].gone) known_[i].told = tell(ScanEvent::Kind::kRaised, known_[i].alarm, now.time_ns);
}

void ScanTap::look_at_system(const Snapshot& now, unsigned s) noexcept {
  const SystemSnapshot& system = now.system[s];
  const auto state = static_cast<nc_run_state>(system.nc.state);
  if (state == NC_STATE_RUNNING) count_up(&running_[s]);
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n)
    if (!system.spindle[n].unmeasured && std::fabs(system.spindle[n].rev_per_s) > kStands) count_up(&turning_[s][n]);
  if (state == state_[s]) return;
  ScanEvent event;
  event.system = static_cast<std::uint8_t>(s);
  event.before = state_[s];
  event.state = state;
  event.time_ns = now.time_ns;
  event.run_s = system.nc.run_s;
  if (events_.push(event)) state_[s] = state;
}

void ScanTap::look(const Snapshot& now) noexcept {
  count_up(&scans_);
  look_at_alarms(now);
  for (unsigned s = 0; s < now.system_count; ++s) look_at_system(now, s);
}

}  // namespace nc::rt::history
