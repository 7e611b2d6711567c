// SPDX-License-Identifier: Apache-2.0
// See recording.hpp.
#include "runtime/trace/recording.hpp"

#include <algorithm>
#include <utility>

namespace nc::rt::trace {

const char* plan_fault(const Plan& plan) {
  if (plan.sources.empty() || plan.sources.size() > kMostSignals) return "a recording has 1 to 64 signals";
  if (plan.rows == 0 || plan.rows > most_rows(plan.sources.size())) return "a recording has at least one sample, and its samples have room in 16 MiB";
  if (plan.before >= plan.rows) return "of the samples at least one must not stand before the trigger";
  if (plan.when == When::kAtOnce && plan.before != 0) return "without a trigger there is nothing before it";
  if (plan.trigger >= plan.sources.size()) return "the trigger must be one of the signals";
  return "";
}

Recording::Recording(Plan plan) : plan_(std::move(plan)), values_(plan_.rows * plan_.sources.size()), times_(plan_.rows) {}

bool Recording::fires(std::int32_t now) const noexcept {
  const bool high = now >= plan_.level, was_high = last_ >= plan_.level;
  switch (plan_.when) {
    case When::kAtOnce: return true;
    case When::kHigh: return high;
    case When::kLow: return !high;
    case When::kRise: return any_ && high && !was_high;
    case When::kFall: return any_ && !high && was_high;
    case When::kChange: return any_ && now != last_;
  }
  return false;
}

bool Recording::end_row(std::uint64_t scan, std::int64_t time_ns) noexcept {
  const std::int32_t now = row()[plan_.trigger];
  times_[slot_] = time_ns;
  last_scan_ = scan;
  slot_ = slot_ + 1 == plan_.rows ? 0 : slot_ + 1;
  if (!triggered_ && fires(now)) {
    triggered_ = true;
    in_front_ = kept_ = std::min(kept_, plan_.before);
    state_.store(State::kRecording, std::memory_order_relaxed);
  }
  if (kept_ < plan_.rows) ++kept_;  // before the trigger the ring runs round, and the newest rows are in it
  any_ = true;
  last_ = now;
  progress_.store(kept_, std::memory_order_relaxed);
  if (!triggered_ || kept_ - in_front_ < plan_.rows - plan_.before) return true;
  state_.store(State::kComplete, std::memory_order_relaxed);
  return false;
}

void Recording::stop() noexcept { state_.store(State::kStopped, std::memory_order_relaxed); }

Recording::Row Recording::at(std::uint32_t row) const {
  const std::uint32_t behind = kept_ - 1 - row;  // the rows behind it
  const std::size_t newest = slot_ == 0 ? plan_.rows - 1 : slot_ - 1;
  const std::size_t place = newest >= behind ? newest - behind : newest + plan_.rows - behind;
  return {last_scan_ - behind, times_[place], &values_[place * plan_.sources.size()]};
}

}  // namespace nc::rt::trace
