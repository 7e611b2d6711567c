// SPDX-License-Identifier: Apache-2.0
// What the scan notes of things that were asked for by hand and do not happen. See refusal.hpp.
#include <cmath>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kAtLimit = 1e-6;  // mm or deg

}  // namespace

void Scan::refuse(unsigned system, Asked asked, Answer why, int axis, bool stopped) noexcept {
  Refusal& refusal = refusal_[system];
  refusal = {refusal.count + 1, asked, why, stopped, static_cast<std::int8_t>(axis)};
}

void Scan::settle(Asked asked, Answer answer) noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    if (answer != Answer::kDone) refuse(s, asked, answer);
    else happened(s, asked);
  }
}

void Scan::happened(unsigned system, Asked asked) noexcept {
  Refusal& refusal = refusal_[system];
  if (refusal.asked == asked) refusal = {refusal.count, Asked::kNothing, Answer::kDone, false, -1};
}

// Where a soft limit ends every motion in this direction.
bool Scan::at_soft_limit(unsigned system, unsigned axis, int direction) const noexcept {
  const nc_axis_config& limits = config_.nc.system[system].axis[axis];
  if (!limits.soft_limited) return false;
  double now = out_[system].command.v[axis];
  if ((out_[system].turning >> axis & 1u) != 0) now -= 360 * std::floor((now - limits.soft_min) / 360);
  return direction > 0 ? now >= limits.soft_max - kAtLimit : now <= limits.soft_min + kAtLimit;
}

// Level signals of the machine in which no axis moves by hand.
Answer Scan::machine_hindrance(unsigned system) const noexcept {
  return in_[system].interlock ? Answer::kInterlock : machine_holds_[system] ? Answer::kFeedHold : Answer::kDone;
}

Answer Scan::jog_hindrance(unsigned system, unsigned axis, int direction) const noexcept {
  if (ending_) return Answer::kEnding;
  if (alarms_.stops()) return Answer::kAlarmActive;
  if (reset_phase_ != ResetPhase::kNone) return in_reset();
  if (mode_ != Mode::kManual) return Answer::kNotInThisMode;
  if (is_spindle_now(system, axis)) return Answer::kSpindleNow;
  if (at_soft_limit(system, axis, direction)) return Answer::kSoftLimit;
  if (!out_[system].manual_allowed) return Answer::kMiddleOfBlock;
  if ((jog_over_reset_[system] >> axis & 1u) != 0) return Answer::kLetGoFirst;
  if (const Answer hindrance = machine_hindrance(system); hindrance != Answer::kDone) return hindrance;
  return (jog_without_feed_[system] >> axis & 1u) != 0 ? Answer::kNoJogFeed : Answer::kDone;
}

// Once for each reason while a direction is asked for, be it by a button or by a client; what has moved before was stopped.
void Scan::watch_jogs() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      JogWatch& watch = jog_watch_[s][a];
      const int direction = jog_asked_[s][a];
      const Answer held = jog_[s][a].kind == NC_MANUAL_REFERENCE ? machine_hindrance(s) : Answer::kDone;
      if (held != Answer::kDone && !watch.held) refuse(s, Asked::kReference, held, static_cast<int>(a), true);
      watch.held = held != Answer::kDone;
      if (direction == 0) {
        watch = {Answer::kDone, false, watch.held};
        continue;
      }
      const Answer why = jog_hindrance(s, a, direction);
      const bool moves = out_[s].velocity.v[a] * direction > 0;
      watch.went |= moves && why == Answer::kDone;  // a program may move it, too
      if (why == Answer::kDone) {
        if (moves) happened(s, Asked::kJog);
      } else if (why != watch.why) {
        refuse(s, Asked::kJog, why, static_cast<int>(a), watch.went);
      }
      watch.why = why;
    }
  }
}

}  // namespace nc::rt
