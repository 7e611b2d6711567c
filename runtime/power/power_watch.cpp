// SPDX-License-Identifier: Apache-2.0
// See power_watch.hpp.
#include "runtime/power/power_watch.hpp"

#include <algorithm>
#include <cmath>

namespace nc::rt {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kMostMs = 0xffff;

}  // namespace

std::uint32_t PowerWatch::now_ms() const noexcept { return static_cast<std::uint32_t>(std::min(std::round(since_s_ * 1000), kMostMs)); }

PowerWatch::Wish PowerWatch::step(const Seen& seen) noexcept {
  on_s_ = seen.fails ? 0 : on_s_ + seen.cycle_s;
  if (seen.fails) off_s_ += seen.cycle_s;
  else if (on_s_ + kRounding >= config_.settle_s) off_s_ = 0;
  const bool fails = off_s_ > config_.delay_s + kRounding;
  since_s_ += seen.cycle_s;
  Wish wish;
  switch (phase_) {
    case Phase::kGood:
      if (!fails) return wish;
      phase_ = Phase::kStopping;
      since_s_ = 0;
      detail_ = 0;
      return {true, true};
    case Phase::kStopping:
      // A cycle start of the scan before may still be on its way to the NC, so rest counts from the next scan on.
      if (seen.at_rest || since_s_ + kRounding >= config_.stop_s) {
        if (!seen.at_rest) detail_ |= kPowerLate;
        rest_ms_ = now_ms();
        phase_ = Phase::kClosing;
        wish.save = true;  // what the last blocks have left, and the place where the axes stand
        wish.raise = seen.acknowledged;
        return wish;
      }
      break;
    case Phase::kClosing:
      if (seen.braked && seen.saved) {
        saved_ms_ = now_ms();
        detail_ |= kPowerDone | (has_brakes_ ? kPowerBrakes : 0u);
        if (seen.result == SaveResult::kNotSaved) detail_ |= kPowerNotSaved;
        if (seen.result == SaveResult::kNothingKept) detail_ |= kPowerNothingKept;
        phase_ = Phase::kDone;
        wish.raise = true;
        return wish;
      }
      break;
    case Phase::kDone:
      if (!fails && seen.acknowledged) {
        phase_ = Phase::kGood;
        return wish;
      }
      break;
  }
  wish.raise = seen.acknowledged;  // a reset came before everything was done, or before the power was back
  return wish;
}

}  // namespace nc::rt
