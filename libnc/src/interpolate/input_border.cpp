// SPDX-License-Identifier: Apache-2.0
#include "interpolate/input_border.hpp"

#include <cmath>

namespace nc {
namespace {

// The ranges that nc/run.h documents for the inputs.
constexpr double kLeastOverride = 1e-4;
constexpr double kLeastRevPerS = 1e-5, kMostRevPerS = 1e4, kMostTurns = 1e12;
constexpr double kMostPlace = 1e9;   // mm or deg
constexpr double kMostByHand = 1e6;  // mm, deg, and each of them per s
constexpr double kLeastByHand = 1e-6;
constexpr double kSpindleGoesOn_s = 0.02;

/// False for NaN, too.
bool within(double value, double most) { return std::fabs(value) <= most; }
bool within_age(double age) { return age >= 0 && age <= NC_SPINDLE_AGE_MAX; }

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
  manual_feed();
  actual();
  skip_place();
  manual();
  tool_length();
  tool_angle();
  return now_;
}

/// A value next to 0 is noise of a potentiometer: it counts as 0, so that nothing moves with it and no plan is made for it.
void InputBorder::override_of(double* value, double most, double* last, uint32_t bit) {
  if (!(*value >= -kLeastOverride && *value <= most)) {
    refused_ |= bit;
    *value = *last;
    return;
  }
  if (*value < kLeastOverride) *value = 0;
  *last = *value;
}

/// A machine without dry run need not give it, so nothing is refused while the switch is off. It is kept then, because a thread that has begun in dry run ends so.
void InputBorder::manual_feed() {
  if (!now_.dry_run) {
    if (!(now_.manual_feed >= kLeastByHand && now_.manual_feed <= kMostByHand)) now_.manual_feed = 0;
    return;
  }
  if (!(now_.manual_feed >= 0 && now_.manual_feed <= kMostByHand)) {
    refused_ |= NC_INPUT_MANUAL_FEED;
    now_.manual_feed = manual_feed_;
  }
  if (now_.manual_feed < kLeastByHand) now_.manual_feed = 0;
  manual_feed_ = now_.manual_feed;
}

/// While the inputs of a spindle are refused it counts as turning on with its last speed, which keeps a thread. After kSpindleGoesOn_s its position
/// cannot be known any more, and it counts as not measured.
void InputBorder::spindle(unsigned n) {
  nc_spindle_inputs& in = now_.spindle[n];
  Spindle& last = spindle_[n];
  if (in.unmeasured) {
    in.rev_per_s = in.turns = 0;
    in.turns_valid = false;
    last = {};
    return;
  }
  if (within(in.rev_per_s, kMostRevPerS) && (!in.turns_valid || within(in.turns, kMostTurns)) && within_age(now_.spindle_age_s[n])) {
    if (std::fabs(in.rev_per_s) < kLeastRevPerS) in.rev_per_s = 0;  // the spindle stands: this is noise of its encoder
    // If the turns are not measured, they are calculated from the speed and begin at any angle. A thread can be cut with them, too.
    last = {in.rev_per_s, in.turns_valid ? in.turns : last.turns + in.rev_per_s * cycle_s_, now_.spindle_age_s[n], 0};
    in.turns = last.turns;
    return;
  }
  refused_ |= NC_INPUT_SPINDLE;
  last.bad_s += cycle_s_;
  last.turns += last.rev_per_s * cycle_s_;
  in.unmeasured = last.bad_s > kSpindleGoesOn_s;
  in.rev_per_s = in.unmeasured ? 0 : last.rev_per_s;
  in.turns = last.turns;
  now_.spindle_age_s[n] = last.age_s;
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

void InputBorder::skip_place() {
  if (now_.skip_latched == 0) return;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (within(now_.skip_place.v[i], kMostPlace)) continue;
    refused_ |= NC_INPUT_SKIP_PLACE;
    now_.skip_latched = 0;
  }
}

/// A velocity next to 0 is refused, too: such a step would take years, and nothing else could be done at the machine meanwhile.
void InputBorder::manual() {
  for (unsigned i = 0; i < axis_count_; ++i) {
    nc_manual& m = now_.manual[i];
    if (m.kind == NC_MANUAL_NONE) continue;
    const bool slow = m.velocity != 0 && within(m.velocity, kLeastByHand);
    if (m.kind <= NC_MANUAL_RETURN && within(m.velocity, kMostByHand) && !slow && within(m.distance, kMostByHand)) continue;
    refused_ |= NC_INPUT_MANUAL;
    m = {};
  }
}

void InputBorder::tool_length() {
  if (within(now_.tool_length_handle, kMostByHand)) return;
  refused_ |= NC_INPUT_TOOL_LENGTH;
  now_.tool_length_handle = 0;
}

void InputBorder::tool_angle() {
  for (unsigned i = 0; i < 2; ++i) {
    if (within(now_.tool_angle[i], NC_TOOL_ANGLE_MAX)) {
      tool_angle_[i] = now_.tool_angle[i];
    } else {
      refused_ |= NC_INPUT_TOOL_ANGLE;
      now_.tool_angle[i] = tool_angle_[i];
    }
  }
}

}  // namespace nc
