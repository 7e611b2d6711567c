// SPDX-License-Identifier: Apache-2.0
// What the scan watches: the machine's faults, the soft limits as a last line behind the program's own check,
// overruns; and the list of alarms that follows.
#include <algorithm>
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kSoftLimitSlack = 1e-6;  // mm or deg: rounding of a position that stands on its limit

constexpr double kStandstill = 0.005;  // mm or deg: more than an encoder's noise
constexpr unsigned kStandstillScans = 5;

}  // namespace

// Bit per part system.
std::uint32_t Scan::in_state(std::uint8_t state) const noexcept {
  std::uint32_t systems = 0;
  for (unsigned s = 0; s < systems_; ++s) systems |= out_[s].state == state ? 1u << s : 0;
  return systems;
}

// Whose program is in execution or interrupted.
std::uint32_t Scan::active_systems() const noexcept {
  return in_state(NC_STATE_RUNNING) | in_state(NC_STATE_HOLD) | in_state(NC_STATE_STOPPED);
}

bool Scan::at_rest() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    if (!out_[s].distance_zero) return false;
  return true;
}

// While the drives are off the axes coast. They come on again when every axis has stayed in one place for
// some scans: the command has followed, so what an axis still moves between two scans is all that the drive
// has to catch up.
void Scan::watch_standstill() noexcept {
  if (feedback_.lost) {
    stood_scans_ = 0;
    return;
  }
  bool stands = drives_off_;
  for (unsigned s = 0; s < systems_; ++s) {
    if (!feedback_.system[s].actual_valid) continue;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      if (is_spindle_now(s, a)) continue;  // a spindle turns
      stands &= std::abs(feedback_.system[s].actual.v[a] - stood_at_[s].v[a]) <= kStandstill;
    }
  }
  if (stands) {
    stood_scans_ = std::min(stood_scans_ + 1, kStandstillScans);
    return;
  }
  stood_scans_ = 0;
  for (unsigned s = 0; s < systems_; ++s) stood_at_[s] = feedback_.system[s].actual;
}

bool Scan::axes_stand() const noexcept {
  return !drives_off_ || feedback_.lost || stood_scans_ >= kStandstillScans;
}

// A drive is off, not on yet, or moves its axis by itself.
bool Scan::drives_not_following() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    if (feedback_.system[s].not_following != 0) return true;
  return false;
}

// Faults at which the drives are switched off.
bool Scan::machine_faulty() const noexcept {
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == AlarmId::kDriveFault || alarms_.alarm[i].id == AlarmId::kHalLost) return true;
  return false;
}

void Scan::watch_machine() noexcept {
  if (feedback_.lost) {
    raise(AlarmId::kHalLost, 0, -1);
    return;
  }
  if (reset_phase_ == ResetPhase::kStopping && reset_scans_ == 0) return;  // it acknowledges what is so now; what stays comes back
  for (unsigned s = 0; s < systems_; ++s) {
    const hal::SystemFeedback& machine = feedback_.system[s];
    if ((machine.following_fault | machine.drive_fault) == 0) continue;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      if ((machine.drive_fault >> a & 1u) != 0) raise(AlarmId::kDriveFault, s, static_cast<int>(a), 0, machine.drive_fault_code[a]);
      if ((machine.following_fault >> a & 1u) != 0) raise(AlarmId::kFollowingError, s, static_cast<int>(a));
    }
  }
}

// libnc refuses a block that leaves the soft limits before it moves. This is the check behind it, on what is
// really sent: an alarm when a command is outside and goes further out. Coming back is always allowed.
void Scan::watch_soft_limits() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_system_config& system = config_.nc.system[s];
    for (unsigned a = 0; a < system.axis_count; ++a) {
      const nc_axis_config& axis = system.axis[a];
      if (!axis.soft_limited || !limits_known(s, a)) continue;
      double now = out_[s].command.v[a], before = last_command_[s].v[a];
      if ((out_[s].turning >> a & 1u) != 0) {  // the limits hold within the turn in which the axis stands
        const double turns = 360 * std::floor((before - axis.soft_min) / 360);
        now -= turns;
        before -= turns;
      }
      const bool above = now > axis.soft_max + kSoftLimitSlack && now > before;
      const bool below = now < axis.soft_min - kSoftLimitSlack && now < before;
      if (above || below) raise(AlarmId::kSoftLimit, s, static_cast<int>(a));
    }
  }
}

void Scan::watch_overruns() noexcept {
  if (missed_since_reset_ < config_.scheduling.overrun_limit) return;
  switch (config_.scheduling.overrun) {
    case OverrunReaction::kCount:
      break;
    case OverrunReaction::kFeedHold:
      hold_request_ |= active_systems();
      break;
    case OverrunReaction::kAlarm:
      raise(AlarmId::kScanOverrun, 0, -1);
      break;
  }
  missed_since_reset_ = 0;
}

// A link that has not answered yet is given some time, so that the control may be up before its devices.
void Scan::watch_links() noexcept {
  constexpr std::int64_t kGraceNs = 10'000'000'000;
  for (unsigned n = 0; n < config_.buses.size(); ++n) {
    const PointBusConfig& bus = config_.buses[n];
    if (!bus.alarm) continue;
    const bool good = points_.value[bus.ok_point] != 0;
    links_seen_ |= static_cast<std::uint32_t>(good) << n;
    const bool due = (links_seen_ >> n & 1u) != 0 || static_cast<std::int64_t>(scan_) * period_ns_ > kGraceNs;
    if (!good && due) raise(AlarmId::kLinkLost, 0, -1, n);
  }
}

// What the thread of the retained data has found. What comes again behind a reset, having gone in between, waits for one of its own.
void Scan::watch_retained() noexcept {
  std::uint32_t found = 0;
  if (retain_trouble_.load(std::memory_order_relaxed) != 0) found = retain_trouble_.exchange(0, std::memory_order_acquire);
  const auto comes_again = [found](const ActiveAlarm& alarm) {
    return alarm.id == AlarmId::kRetainedUnwritable && (found >> alarm.detail & 1u) != 0;
  };
  remove_alarms([&](const ActiveAlarm& alarm) { return alarm.acknowledged && (!holds_still(alarm) || comes_again(alarm)); });
  for (unsigned detail = 0; found != 0 && detail < 4 * kRetainedData; ++detail) {
    if ((found >> detail & 1u) == 0) continue;
    raise(is_lost(static_cast<RetainTrouble>(detail % 4)) ? AlarmId::kRetainedLost : AlarmId::kRetainedUnwritable, 0, -1, detail);
  }
}

void Scan::watch_printer() noexcept {
  std::uint32_t found = 0;
  if (print_trouble_.load(std::memory_order_relaxed) != 0) found = print_trouble_.exchange(0, std::memory_order_acquire);
  for (unsigned s = 0; s < systems_; ++s)
    if ((found >> s & 1u) != 0) raise(AlarmId::kPrinter, s, -1);
}

// The causes of alarms are looked at in every scan, and raise them again. That of a warning is told once, by a thread of its own.
bool Scan::holds_still(const ActiveAlarm& alarm) const noexcept {
  if (alarm.id == AlarmId::kLimitSwitch) return limit_holds(alarm);
  return alarm.id == AlarmId::kRetainedUnwritable && (retain_holds_.load(std::memory_order_relaxed) >> alarm.detail & 1u) != 0;
}

// A completion that does not come is named with what it is waited for. Time in a hold does not count. FIN is what
// the NC got in the scan before, the strobes are what it said to it.
void Scan::watch_fin() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint8_t strobe = out_[s].strobe;
    const bool fin = in_[s].fin || in_[s].fin2;
    if (!fin || strobe != 0) fin_taken_[s] = 0;
    else if (last_strobe_[s] != 0) fin_taken_[s] = last_strobe_[s];
    last_strobe_[s] = strobe;
  }
  if (config_.ladder.fin_timeout_s <= 0) return;
  const auto most = static_cast<std::uint64_t>(config_.ladder.fin_timeout_s * 1e9 / static_cast<double>(period_ns_));
  watch_clamps(most);
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    const bool clamps = (out.fin_wait & NC_FIN_WAIT_UNCLAMP) != 0;
    const bool waits = out.state == NC_STATE_RUNNING && out.cause == NC_CAUSE_FIN && !clamps;  // also for a FIN that is stuck on
    fin_scans_[s] = waits ? fin_scans_[s] + 1 : 0;
    if (fin_scans_[s] <= most) continue;
    std::uint32_t fault = out.fin_wait & kFinGroups;
    const bool given_out = out.strobe != 0 || (in_[s].fin && fin_taken_[s] != 0);  // else the codes are the last ones'
    if (in_[s].fin) fault |= kFinOne;
    if (in_[s].fin2) fault |= kFinTwo;
    if ((fault & (kFinOne | kFinTwo)) != 0) fault |= out.strobe == 0 && given_out ? kFinStays : kFinEarly;
    raise(AlarmId::kFinTimeout, s, -1, fault, !given_out ? ~0u : (fault & 1) != 0 ? out.m : out.t);
  }
}

// The same for the clamps of index tables (M700 9.3), also while an axis is moved by hand.
void Scan::watch_clamps(std::uint64_t most) noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    const bool moves = out.state == NC_STATE_RUNNING || out.state == NC_STATE_MANUAL;
    clamp_scans_[s] = moves && (out.fin_wait & NC_FIN_WAIT_UNCLAMP) != 0 ? clamp_scans_[s] + 1 : 0;
    if (clamp_scans_[s] <= most) continue;
    const std::uint32_t wrong = out.unclamp ^ in_[s].unclamped;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      const bool asked = (out.unclamp >> a & 1u) != 0;
      if ((wrong >> a & 1u) != 0) raise(AlarmId::kFinTimeout, s, static_cast<int>(a), asked ? kNotUnclamped : kNotClamped);
      else if (wrong == 0 && asked) raise(AlarmId::kFinTimeout, s, static_cast<int>(a), kNoClampHere);
    }
  }
}

// Each cause stands in the list once; the list is long enough for all of them on all axes that can fail
// together in practice, and what does not fit is behind sixteen others that stop the machine already.
void Scan::raise(AlarmId id, unsigned system, int axis, std::uint32_t detail, std::uint32_t code) noexcept {
  for (unsigned i = 0; i < alarms_.count; ++i) {
    const ActiveAlarm& other = alarms_.alarm[i];
    if (other.id == id && other.system == system && other.axis == axis && other.detail == detail) return;
  }
  if (alarms_.count == kMaxActiveAlarms) return;
  ActiveAlarm& alarm = alarms_.alarm[alarms_.count++];
  alarm.id = id;
  alarm.axis = static_cast<std::int8_t>(axis);
  alarm.system = static_cast<std::uint8_t>(system);
  alarm.scan = scan_;
  alarm.detail = detail;
  alarm.code = code;
  alarm.acknowledged = false;
  // What is found behind its block, or belongs to none, names none.
  if (id != AlarmId::kRetainedLost && id != AlarmId::kRetainedUnwritable && id != AlarmId::kPrinter) alarm.source = out_[system].source;
}

void Scan::acknowledge_alarms() noexcept {
  for (std::uint64_t& scans : fin_scans_) scans = 0;
  for (std::uint64_t& scans : clamp_scans_) scans = 0;
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == AlarmId::kRetainedLost && !ending_)  // the reset of the end is nobody's look
      retain_loss_seen_.store(true, std::memory_order_release);
  remove_alarms([this](const ActiveAlarm& alarm) { return !holds_still(alarm); });
  for (unsigned i = 0; i < alarms_.count; ++i) alarms_.alarm[i].acknowledged = true;
  missed_since_reset_ = 0;
}

}  // namespace nc::rt
