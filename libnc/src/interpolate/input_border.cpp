// SPDX-License-Identifier: Apache-2.0
#include "interpolate/input_border.hpp"

#include <cmath>

namespace nc {
namespace {

// As in nc/run.h.
constexpr double kLeastOverride = 1e-4;
constexpr double kLeastRevPerS = 1e-5, kMostRevPerS = 1e4, kMostTurns = 1e12;
constexpr double kMostPlace = 1e9;   // mm or deg
constexpr double kMostByHand = 1e6;  // mm, deg, and each of them per s
constexpr double kLeastByHand = 1e-6;
constexpr double kSpindleGoesOn_s = 0.02;

/// False for NaN, too.
bool within(double value, double most) { return std::fabs(value) <= most; }

}  // namespace

void InputBorder::create(unsigned axis_count, double max_feed_override, double cycle_s) {
  axis_count_ = axis_count;
  most_ = max_feed_override;
  cycle_s_ = cycle_s;
}

const nc_inputs& InputBorder::check(const nc_inputs& in) {
  now_ = in;
  refused_ = lost_axes_ = 0;
  override_of(&now_.feed_override, most_, &feed_, NC_INPUT_FEED_OVERRIDE);
  override_of(&now_.rapid_override, 1, &rapid_, NC_INPUT_RAPID_OVERRIDE);
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) spindle(n);
  actual();
  manual();
  return now_;
}

/// A little beside 0 is noise of a potentiometer: nothing moves with it, and no plan is made for it.
void InputBorder::override_of(double* value, double most, double* last, uint32_t bit) {
  if (!(*value >= -kLeastOverride && *value <= most)) {
    refused_ |= bit;
    *value = *last;
    return;
  }
  if (*value < kLeastOverride) *value = 0;
  *last = *value;
}

/// One that goes on as it was keeps a thread; for longer nobody knows where it is.
void InputBorder::spindle(unsigned n) {
  nc_spindle_inputs& in = now_.spindle[n];
  Spindle& last = spindle_[n];
  if (in.unmeasured) {
    in.rev_per_s = in.turns = 0;
    in.turns_valid = false;
    last = {};
    return;
  }
  if (within(in.rev_per_s, kMostRevPerS) && (!in.turns_valid || within(in.turns, kMostTurns))) {
    if (std::fabs(in.rev_per_s) < kLeastRevPerS) in.rev_per_s = 0;  // it stands: noise of its encoder
    // Without an encoder its turns are counted by its speed: from anywhere, and a thread goes by them all the same.
    last = {in.rev_per_s, in.turns_valid ? in.turns : last.turns + in.rev_per_s * cycle_s_, 0};
    in.turns = last.turns;
    return;
  }
  refused_ |= NC_INPUT_SPINDLE;
  last.bad_s += cycle_s_;
  last.turns += last.rev_per_s * cycle_s_;
  in.unmeasured = last.bad_s > kSpindleGoesOn_s;
  in.rev_per_s = in.unmeasured ? 0 : last.rev_per_s;
  in.turns = last.turns;
  if (in.unmeasured) in.turns_valid = false;
}

void InputBorder::actual() {
  if (!now_.actual_valid) return;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (within(now_.actual.v[i], kMostPlace)) {
      actual_.v[i] = now_.actual.v[i];
      continue;
    }
    refused_ |= NC_INPUT_ACTUAL;
    lost_axes_ |= 1u << i;
    now_.actual.v[i] = actual_.v[i];
  }
}

/// A step with next to no speed would be on its way for years, and nothing else could be done at the machine.
void InputBorder::manual() {
  for (unsigned i = 0; i < axis_count_; ++i) {
    nc_manual& m = now_.manual[i];
    if (m.kind == NC_MANUAL_NONE) continue;
    const bool slow = m.velocity != 0 && within(m.velocity, kLeastByHand);
    if (m.kind <= NC_MANUAL_REFERENCE && within(m.velocity, kMostByHand) && !slow && within(m.distance, kMostByHand)) continue;
    refused_ |= NC_INPUT_MANUAL;
    m = {};
  }
}

}  // namespace nc
