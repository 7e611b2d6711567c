// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, in the scan (runtime/restart/): which start is refused, what the machine has got, and the return of an axis to where its
// program goes on. The return is of any block stop and of any feed hold in which an axis was moved by hand.
#include <algorithm>
#include <cmath>

#include "runtime/axes/direction.hpp"
#include "runtime/scan.hpp"

namespace nc::rt {

// Of a start in AUTO that goes on from the place. The first start, which only comes to the place, and blocks of MDI in the stop are free.
Answer Scan::restart_hindrance(std::uint32_t ready) const noexcept {
  if ((ready & restart_searches_.load(std::memory_order_acquire)) != 0) return Answer::kRestartSearch;
  if (mode_ == Mode::kAuto && (ready & restart_lost_.load(std::memory_order_acquire)) != 0) return Answer::kRestartLost;
  const std::uint32_t goes_on = mode_ == Mode::kAuto ? ready & in_state(NC_STATE_STOPPED) : 0;
  if ((goes_on & restart_bars_.load(std::memory_order_acquire)) != 0) return Answer::kRestartOpen;
  for (unsigned s = 0; s < systems_; ++s)
    if ((ready >> s & 1u) != 0 && goes_on_from_path(s) && out_[s].restart_axes != 0) return Answer::kRestartAxes;
  return Answer::kDone;
}

// Behind a feed hold the path goes on from where it has stopped, also that of MDI, and so it does from the block stop that a hold is behind a thread.
bool Scan::goes_on_from_path(unsigned s) const noexcept {
  if (out_[s].state != NC_STATE_STOPPED) return out_[s].state == NC_STATE_HOLD;
  return mode_ == program_mode_ || (out_[s].cause == NC_CAUSE_FEED_HOLD && (mdi_waiting() >> s & 1u) == 0);
}

// Each code with the scan in which its strobe comes on, the M code of a scan behind the others: a tool change takes the T that stands in its block. A full queue loses codes: the feeder has not run for hundreds of them, and their entries
// of the recovery list stay open.
void Scan::note_given() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    const unsigned come = out.strobe & ~static_cast<unsigned>(given_strobe_[s]);
    given_strobe_[s] = out.strobe;
    const double values[] = {static_cast<double>(out.m), out.s, static_cast<double>(out.t), static_cast<double>(out.b)};
    for (const unsigned g : {1u, 2u, 3u, 0u})
      if ((come >> g & 1u) != 0) (void)given_.push({static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(1u << g), values[g]});
  }
}

// ---- the return to the path ----

// The operator's order: one axis after the other.
bool Scan::others_move(unsigned system, unsigned axis) const noexcept {
  const unsigned count = config_.nc.system[system].axis_count;
  for (unsigned a = 0; a < count; ++a)
    if (a != axis && (out_[system].velocity.v[a] != 0 || in_[system].manual[a].kind != NC_MANUAL_NONE)) return true;
  return false;
}

Answer Scan::approach_hindrance(unsigned system, unsigned axis) const noexcept {
  if (const Answer why = hand_hindrance(system, axis); why != Answer::kDone) return why;
  if (others_move(system, axis)) return Answer::kAxesMove;
  const bool goes = out_[system].state == NC_STATE_MANUAL && (approach_asked_[system] >> axis & 1u) != 0;  // by hand, in the stop
  if (out_[system].state != NC_STATE_STOPPED && out_[system].state != NC_STATE_HOLD && !goes) return Answer::kNoPlace;
  if (axes_[system][axis].homing.active()) return Answer::kHoming;
  const int direction = direction_of(out_[system].return_place.v[axis] - out_[system].command.v[axis]);
  if (const Answer why = way_hindrance(system, axis, direction); why != Answer::kDone) return why;
  if (at_soft_limit(system, axis, direction)) return Answer::kSoftLimit;
  return hindered_[system][axis];
}

double Scan::approach_feed(unsigned system, unsigned axis, const LadderRequests& requests) const noexcept {
  const nc_axis_config& limits = config_.nc.system[system].axis[axis];
  return std::min(button_feed(limits, requests.system[system]), limits.max_velocity);
}

// The command of a client works like a button, as a jog does.
Answer Scan::approach(const Command& command) noexcept {
  const unsigned s = command.system, a = command.axis;
  if (s >= systems_ || a >= config_.nc.system[s].axis_count) return Answer::kAxisUnknown;
  Jog& jog = jog_[s][a];
  Answer why = approach_hindrance(s, a);
  if (why == Answer::kDone && is_taken_back(command)) why = Answer::kTakenBack;
  const double velocity = command.value == 0 ? approach_feed(s, a, last_requests_) : command.value;
  if (!(velocity >= 0 && velocity <= config_.nc.system[s].axis[a].max_velocity)) return Answer::kOutOfRange;
  if (why == Answer::kDone && velocity == 0) return Answer::kNoJogFeed;
  const bool waits = jog.kind == NC_MANUAL_RETURN && jog.refused;
  jog = {NC_MANUAL_RETURN, velocity, kJogDeadManScans, waits || why != Answer::kDone};
  return why == Answer::kDone && waits ? Answer::kLetGoFirst : why;
}

// `free`: neither a jog nor a handle of the machine moves the axis.
void Scan::follow_approach_button(unsigned s, unsigned a, bool on, bool free) noexcept {
  const std::uint32_t bit = 1u << a;
  if (!on) approach_buttons_refused_[s] &= ~bit;
  if (!on || (approach_buttons_refused_[s] & bit) != 0) return;
  approach_asked_[s] |= bit;
  const double feed = approach_feed(s, a, last_requests_);
  if (!free || feed == 0 || approach_hindrance(s, a) != Answer::kDone) return;  // watch_approach() says why
  in_[s].manual[a] = {NC_MANUAL_RETURN, feed, 0};
}

// What prevents it is noted once, and it does not go on when that has gone, before the button or the client has let go.
void Scan::watch_approach(unsigned s, unsigned a) noexcept {
  const std::uint32_t bit = 1u << a;
  if ((approach_asked_[s] & bit) == 0) return;
  Answer why = approach_hindrance(s, a);
  if (why == Answer::kDone && in_[s].manual[a].kind != NC_MANUAL_RETURN) why = approach_feed(s, a, last_requests_) == 0 ? Answer::kNoJogFeed : Answer::kAxesMove;
  if (why == Answer::kDone) return happened(s, Asked::kApproach);
  refuse(s, Asked::kApproach, why, static_cast<int>(a), out_[s].velocity.v[a] != 0);
  if (jog_[s][a].kind == NC_MANUAL_RETURN) jog_[s][a].refused = true;
  else approach_buttons_refused_[s] |= bit;
}

}  // namespace nc::rt
