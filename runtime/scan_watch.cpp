// SPDX-License-Identifier: Apache-2.0
// What the scan watches: faults of the machine, the soft limits as a second check after that of libnc,
// overruns, links, FIN; and the list of the alarms that are raised.
#include <algorithm>
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kSoftLimitSlack = 1e-6;  // mm or deg: allows for the rounding of a position that is on the limit

constexpr double kStandstill = 0.005;  // mm or deg: more than the noise of an encoder
constexpr unsigned kStandstillScans = 5;

}  // namespace

// The part systems that are in this state, one bit each.
std::uint32_t Scan::in_state(std::uint8_t state) const noexcept {
  std::uint32_t systems = 0;
  for (unsigned s = 0; s < systems_; ++s) systems |= out_[s].state == state ? 1u << s : 0;
  return systems;
}

// The part systems whose program is in execution or interrupted, one bit each.
std::uint32_t Scan::active_systems() const noexcept {
  return in_state(NC_STATE_RUNNING) | in_state(NC_STATE_HOLD) | in_state(NC_STATE_STOPPED);
}

bool Scan::at_rest() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    if (!out_[s].distance_zero) return false;
  return true;
}

// While the drives are off the axes coast. The drives are switched on again only when every axis has stayed in one place for
// some scans. The commanded position has followed the measured one until then, so the distance that a drive has to catch up is only what its
// axis moves between two scans.
void Scan::watch_standstill() noexcept {
  if (feedback_.lost) {
    stood_scans_ = 0;
    return;
  }
  bool stands = drives_off_;
  for (unsigned s = 0; s < systems_; ++s) {
    if (!feedback_.system[s].actual_valid) continue;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      if (is_spindle_now(s, a)) continue;  // an axis that turns as a spindle need not stand
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

// True when a drive is off, is not on yet, or moves its axis by itself.
bool Scan::drives_not_following() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    if (feedback_.system[s].not_following != 0) return true;
  return false;
}

// True when an alarm is active at which the drives are switched off.
bool Scan::machine_faulty() const noexcept {
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == AlarmId::kDriveFault || alarms_.alarm[i].id == AlarmId::kHalLost) return true;
  return power_.drives_off();
}

void Scan::watch_machine() noexcept {
  if (feedback_.lost) {
    raise(AlarmId::kHalLost, 0, -1);
    return;
  }
  if (reset_phase_ == ResetPhase::kStopping && reset_scans_ == 0) return;  // a reset has just acknowledged the faults; those that stay are raised again in the next scan
  for (unsigned s = 0; s < systems_; ++s) {
    const hal::SystemFeedback& machine = feedback_.system[s];
    for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n)
      if ((machine.spindle_fault >> n & 1u) != 0) raise(AlarmId::kDriveFault, s, -1, n + 1, machine.spindle_fault_code[n]);
    if ((machine.following_fault | machine.drive_fault) == 0) continue;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      if ((machine.drive_fault >> a & 1u) != 0) raise(AlarmId::kDriveFault, s, static_cast<int>(a), 0, machine.drive_fault_code[a]);
      if ((machine.following_fault >> a & 1u) != 0) raise(AlarmId::kFollowingError, s, static_cast<int>(a));
    }
  }
}

// libnc refuses a block that would leave the soft limits before it begins to move. This is a second check, on the positions that
// are really sent: an alarm is raised when a command is outside and moves further out. Moving back is always allowed.
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

// A link that has never answered is given some time after the start, so that the control may start before its devices.
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

bool Scan::is_raised(AlarmId id, std::uint32_t detail) const noexcept {
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == id && alarms_.alarm[i].detail == detail) return true;
  return false;
}

// A link that is lost is one alarm, and what the lost values of its points would be as alarms belongs to it. R18 stops the machine as those do.
bool Scan::is_of_lost_link(unsigned ladder_alarm) const noexcept {
  const int point = alarm_point_[ladder_alarm];
  if (point < 0) return false;
  const unsigned bus = config_.points.at(static_cast<unsigned>(point)).bus;
  return bus != 0 && points_.good[point] == 0 && is_raised(AlarmId::kLinkLost, bus - 1);
}

// Raises the alarms that the thread of the retained data has reported, those without room in the list later. A trouble that comes again after it had ended needs another reset, even when its
// first occurrence had been acknowledged.
void Scan::watch_retained() noexcept {
  std::uint32_t found = 0;
  if (retain_trouble_.load(std::memory_order_relaxed) != 0) found = retain_trouble_.exchange(0, std::memory_order_acquire);
  if (found_place_.load(std::memory_order_relaxed) && found_place_.exchange(false, std::memory_order_acquire) && !raise(AlarmId::kPowerFailedBefore, 0, -1)) post_found_place();
  const auto comes_again = [found](const ActiveAlarm& alarm) {
    return alarm.id == AlarmId::kRetainedUnwritable && (found >> alarm.detail & 1u) != 0;
  };
  remove_alarms([&](const ActiveAlarm& alarm) { return alarm.acknowledged && (!holds_still(alarm) || comes_again(alarm)); });
  for (unsigned detail = 0; found != 0 && detail < 4 * kRetainedData; ++detail) {
    if ((found >> detail & 1u) == 0) continue;
    const AlarmId id = is_lost(static_cast<RetainTrouble>(detail % 4)) ? AlarmId::kRetainedLost : AlarmId::kRetainedUnwritable;
    if (!raise(id, 0, -1, detail)) retain_trouble_.fetch_or(1u << detail, std::memory_order_relaxed);
  }
}

void Scan::watch_printer() noexcept {
  std::uint32_t found = 0;
  if (print_trouble_.load(std::memory_order_relaxed) != 0) found = print_trouble_.exchange(0, std::memory_order_acquire);
  for (unsigned s = 0; s < systems_; ++s)
    if ((found >> s & 1u) != 0 && !raise(AlarmId::kPrinter, s, -1)) post_print_trouble(s);
}

// True when the cause of an acknowledged alarm is known to last. Only R20 needs this: the thread of the retained data reports it once, whereas the causes of
// the other alarms are looked at in every scan and raise them again.
bool Scan::holds_still(const ActiveAlarm& alarm) const noexcept {
  if (alarm.id == AlarmId::kLimitSwitch) return limit_holds(alarm);
  return alarm.id == AlarmId::kRetainedUnwritable && (retain_holds_.load(std::memory_order_relaxed) >> alarm.detail & 1u) != 0;
}

// Raises an alarm for a FIN that does not come in time; the alarm names the codes that wait. Time in a hold does not count. in_ holds the FIN
// that the NC got in the previous scan, and out_ the strobes with which it answered.
void Scan::watch_fin() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint8_t strobe = out_[s].strobe;
    const bool fin = in_[s].fin || in_[s].fin2;
    if (!fin || strobe != 0) fin_taken_[s] = 0;
    else if (last_strobe_[s] != 0) fin_taken_[s] = last_strobe_[s];
    fin_own_taken_[s] = static_cast<std::uint8_t>(in_[s].fin_groups & (fin_own_taken_[s] | (last_strobe_[s] & ~strobe)));
    if ((active_systems() >> s & 1u) == 0) fin_own_taken_[s] = 0;  // a reset has taken the strobes away
    last_strobe_[s] = strobe;
  }
  if (config_.ladder.fin_timeout_s <= 0) return;
  const auto most = static_cast<std::uint64_t>(config_.ladder.fin_timeout_s * 1e9 / static_cast<double>(period_ns_));
  watch_clamps(most);
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    const bool clamps = (out.fin_wait & NC_FIN_WAIT_UNCLAMP) != 0;
    const bool waits = out.state == NC_STATE_RUNNING && out.cause == NC_CAUSE_FIN && !clamps;  // true also while a FIN stays on
    fin_scans_[s] = waits ? fin_scans_[s] + 1 : 0;
    if (fin_scans_[s] <= most) continue;
    std::uint32_t fault = out.fin_wait & kFinGroups;
    const std::uint32_t own = fault & in_[s].fin_groups;
    const bool by_own = own != 0 && !in_[s].fin && !in_[s].fin2;
    if (by_own) fault = own | kFinOwn | ((own & fin_own_taken_[s]) != 0 ? kFinStays : kFinEarly);
    // Otherwise out.m and out.t are those of the codes before.
    const bool given_out = by_own ? (own & (out.strobe | fin_own_taken_[s])) != 0 : out.strobe != 0 || (in_[s].fin && fin_taken_[s] != 0);
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

// Where another alarm goes when sixteen are in the list: in place of the newest of those that matter least to what the machine does, null when it matters no more than they
// do. An alarm that gives way comes back when there is room, as long as its cause is there.
ActiveAlarm* Scan::alarm_to_replace(const ActiveAlarm& by) noexcept {
  ActiveAlarm* least = &alarms_.alarm[0];
  for (ActiveAlarm& other : alarms_.alarm)
    if (alarm_weight(other) <= alarm_weight(*least)) least = &other;
  return alarm_weight(*least) < alarm_weight(by) ? least : nullptr;
}

// What is told once and gives way to another alarm is told again when there is room.
void Scan::tell_later(const ActiveAlarm& alarm) noexcept {
  if (alarm.id == AlarmId::kRetainedLost || alarm.id == AlarmId::kRetainedUnwritable) retain_trouble_.fetch_or(1u << alarm.detail, std::memory_order_relaxed);
  if (alarm.id == AlarmId::kPowerFailedBefore) post_found_place();
  if (alarm.id == AlarmId::kPrinter) post_print_trouble(alarm.system);
  if (alarm.id == AlarmId::kLimitSwitch) axes_[alarm.system][alarm.axis].limit_told[0] = axes_[alarm.system][alarm.axis].limit_told[1] = false;
}

// Each cause is in the list once. False when there is no room for it.
bool Scan::raise(AlarmId id, unsigned system, int axis, std::uint32_t detail, std::uint32_t code) noexcept {
  for (unsigned i = 0; i < alarms_.count; ++i) {
    ActiveAlarm& other = alarms_.alarm[i];
    if (other.id != id || other.system != system || other.axis != axis || other.detail != detail) continue;
    if (id == AlarmId::kDriveFault && other.code == 0 && code != 0) {  // a drive may say why behind its fault: who has been told of it is told again, with the reason
      other.code = code;
      other.scan = scan_;
    }
    return true;
  }
  ActiveAlarm fresh;
  fresh.id = id;
  const bool full = alarms_.count == kMaxActiveAlarms;
  ActiveAlarm* const place = full ? alarm_to_replace(fresh) : &alarms_.alarm[alarms_.count++];
  if (place == nullptr) return false;
  if (full) tell_later(*place);
  ActiveAlarm& alarm = *place;
  alarm = fresh;
  alarm.id = id;
  alarm.axis = static_cast<std::int8_t>(axis);
  alarm.system = static_cast<std::uint8_t>(system);
  alarm.scan = scan_;
  alarm.detail = detail;
  alarm.code = code;
  alarm.acknowledged = false;
  // Alarms that belong to no block, or are found only after their block has been executed, get no source.
  if (id != AlarmId::kRetainedLost && id != AlarmId::kRetainedUnwritable && id != AlarmId::kPrinter && id != AlarmId::kPowerFailedBefore) alarm.source = out_[system].source;
  return true;
}

void Scan::acknowledge_alarms() noexcept {
  for (std::uint64_t& scans : fin_scans_) scans = 0;
  for (std::uint64_t& scans : clamp_scans_) scans = 0;
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == AlarmId::kPowerFailedBefore && !ending_) place_seen_.store(true, std::memory_order_release);
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (alarms_.alarm[i].id == AlarmId::kRetainedLost && !ending_)  // the reset at the end of the control is not an operator's acknowledgement
      retain_loss_seen_.store(true, std::memory_order_release);
  remove_alarms([this](const ActiveAlarm& alarm) { return !holds_still(alarm); });
  for (unsigned i = 0; i < alarms_.count; ++i) alarms_.alarm[i].acknowledged = true;
  missed_since_reset_ = 0;
}

}  // namespace nc::rt
