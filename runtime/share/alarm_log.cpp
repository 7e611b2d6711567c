// SPDX-License-Identifier: Apache-2.0
// Occurrences of alarms. See alarm_log.hpp.
#include "runtime/share/alarm_log.hpp"

#include <algorithm>

#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

// The same occurrence: the same alarm, raised in the same scan.
bool same(const ActiveAlarm& a, const ActiveAlarm& b) {
  return a.id == b.id && a.axis == b.axis && a.system == b.system && a.scan == b.scan && a.detail == b.detail;
}

}  // namespace

Entry* AlarmLog::entry_of(std::uint64_t sequence) {
  if (sequence == 0 || sequence + kHistory <= history_.last_sequence) return nullptr;
  return &history_.entry[(sequence - 1) % kHistory];
}

std::uint64_t AlarmLog::append(Entry entry) {
  entry.sequence = ++history_.last_sequence;
  history_.entry[(entry.sequence - 1) % kHistory] = entry;
  return entry.sequence;
}

void AlarmLog::add_message(std::string_view text, unsigned system, std::int64_t now_ns) {
  Entry entry{};
  entry.is_message = 1;
  entry.system = system;
  entry.raised_ns = entry.cleared_ns = now_ns;
  set_text(&entry.text, text);
  append(entry);
}

bool AlarmLog::update(const AlarmList& alarms, Describer* describer, std::int64_t now_ns) {
  bool changed = false;
  const auto* begin = alarms.alarm;
  const auto* end = begin + std::min(alarms.count, kMaxActiveAlarms);
  for (std::size_t i = 0; i < active_.size();) {
    const Active& active = active_[i];
    if (std::any_of(begin, end, [&](const ActiveAlarm& a) { return same(a, active.alarm); })) {
      ++i;
      continue;
    }
    if (Entry* entry = entry_of(active.sequence); entry != nullptr) entry->cleared_ns = now_ns;
    changed |= active.sequence != 0;
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (const auto* alarm = begin; alarm != end; ++alarm)
    if (std::none_of(active_.begin(), active_.end(), [&](const Active& a) { return same(*alarm, a.alarm); }))
      active_.push_back({*alarm, now_ns, 0});
  for (Active& active : active_) {
    if (active.sequence != 0) continue;
    Entry entry{};
    entry.raised_ns = active.since_ns;
    entry.system = active.alarm.system;
    entry.line = active.alarm.source.line;
    entry.program_number = active.alarm.source.program;
    if (!describer->describe(active.alarm, &entry) && now_ns - active.since_ns < kWaitForTextNs) continue;
    active.sequence = append(entry);
    changed = true;
  }
  if (!changed) return false;
  active_entries_.clear();
  for (const Active& active : active_)
    if (const Entry* entry = entry_of(active.sequence); entry != nullptr) active_entries_.push_back(*entry);
  return true;
}

}  // namespace nc::rt::share
