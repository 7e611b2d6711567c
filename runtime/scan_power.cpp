// SPDX-License-Identifier: Apache-2.0
// The power-fail input in the scan (runtime/power/power_watch.hpp): the alarm that stops the axes, the drives behind it, and the requests to the thread of the
// retained data.
#include "runtime/scan.hpp"

namespace nc::rt {

bool Scan::all_braked() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (axes_[s][a].power.has_brake() && axes_[s][a].power.drive_on()) return false;
  return true;
}

bool Scan::has_brakes() const noexcept {
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a)
      if (axes_[s][a].power.has_brake()) return true;
  return false;
}

// Called with what the ladder and the wires have given in this scan, before the alarms go to the NC.
void Scan::watch_power(bool fails) noexcept {
  const auto is_power = [](const ActiveAlarm& alarm) { return alarm.id == AlarmId::kPowerFails; };
  const std::uint32_t answered = save_answered_.load(std::memory_order_acquire), asked = save_asked_.load(std::memory_order_relaxed);
  PowerWatch::Seen seen;
  seen.fails = fails;
  seen.at_rest = at_rest() && !any_homes_by_drive();
  seen.braked = all_braked();
  seen.saved = answered / kSaveResults == asked;
  seen.result = static_cast<SaveResult>(answered % kSaveResults);
  seen.acknowledged = true;
  for (unsigned i = 0; i < alarms_.count; ++i) seen.acknowledged &= !is_power(alarms_.alarm[i]);
  seen.cycle_s = config_.nc.cycle_s;
  const bool failed = power_.failed();
  const PowerWatch::Wish wish = power_.step(seen);
  if (!failed && power_.failed()) power_in_.store(kPowerFailed | active_systems(), std::memory_order_relaxed);
  if (failed && !power_.failed()) power_in_.store(0, std::memory_order_relaxed);
  if (wish.save) save_asked_.store(asked + 1, std::memory_order_release);
  drives_off_ |= power_.drives_off();
  if (!wish.raise) return;
  nc_source source = out_[0].source;
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (is_power(alarms_.alarm[i])) source = alarms_.alarm[i].source;  // the block in which the power failed
  remove_alarms(is_power);
  raise(AlarmId::kPowerFails, 0, -1, power_.detail(), power_.times());
  for (unsigned i = 0; i < alarms_.count; ++i)
    if (is_power(alarms_.alarm[i])) alarms_.alarm[i].source = source;
}

}  // namespace nc::rt
