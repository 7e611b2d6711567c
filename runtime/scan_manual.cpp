// SPDX-License-Identifier: Apache-2.0
// Manual motion in the scan: who asks for it (buttons and handles of the machine, commands), what prevents it, and which refusals are noted.
//
// Manual motion begins only when a button is pressed. When a button, or a jog that a client repeats, was on while something refused or
// stopped the motion, it has no effect until it is released: an operator who ends a feed hold must not set an axis in motion whose button somebody else is
// pressing. A jog feed of 0 is no refusal: the axis begins to move when the feed is turned up.
#include <algorithm>
#include <cmath>

#include "runtime/axes/direction.hpp"
#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

constexpr double kAtLimit = 1e-6;           // mm or deg
constexpr double kHandleIncrement = 0.001;  // mm or deg
constexpr double kLongestStep = 1e6;        // mm or deg
constexpr unsigned kToolHandleAxis = 2;     // M700 12.3: "the 3rd axis (tool axis) is selected for the handle"

// True when the jog button must be released and pressed again after this reason has gone. A soft limit and a jog feed of 0 need no new press: the button is
// obeyed all the time, only the axis cannot move.
bool asks_for_a_new_press(Answer why) {
  return why != Answer::kDone && why != Answer::kSoftLimit && why != Answer::kNoJogFeed;
}

}  // namespace

// ---- what prevents manual motion of an axis ----

// True when the axis stands at its soft limit, so that it cannot move on in this direction.
bool Scan::at_soft_limit(unsigned system, unsigned axis, int direction) const noexcept {
  const nc_axis_config& limits = config_.nc.system[system].axis[axis];
  if (!limits.soft_limited || direction == 0 || !limits_known(system, axis)) return false;
  double now = out_[system].command.v[axis];
  if ((out_[system].turning >> axis & 1u) != 0) now -= 360 * std::floor((now - limits.soft_min) / 360);
  return direction > 0 ? now >= limits.soft_max - kAtLimit : now <= limits.soft_min + kAtLimit;
}

Answer Scan::hand_hindrance(unsigned system, unsigned axis) const noexcept {
  if (ending_) return Answer::kEnding;
  if (alarms_.stops()) return Answer::kAlarmActive;
  if (reset_phase_ != ResetPhase::kNone) return in_reset();
  if (mode_ != Mode::kManual) return Answer::kNotInThisMode;
  if (is_spindle_now(system, axis)) return Answer::kSpindleNow;
  if ((feedback_.system[system].not_following >> axis & 1u) != 0 || is_powerless(system, axis)) return Answer::kDrivesOff;
  if (!out_[system].manual_allowed) return Answer::kMiddleOfBlock;
  if ((out_[system].tap_holds >> axis & 1u) != 0) return Answer::kTapInHole;
  if (lock_left(system, axis)) return Answer::kLockLeft;
  if (in_[system].interlock) return Answer::kInterlock;
  return machine_holds_[system] ? Answer::kFeedHold : Answer::kDone;
}

Answer Scan::jog_hindrance(unsigned system, unsigned axis, int direction) const noexcept {
  if (const Answer why = hand_hindrance(system, axis); why != Answer::kDone) return why;
  const bool by_button = ((last_requests_.system[system].jog_p | last_requests_.system[system].jog_m) >> axis & 1u) != 0;
  if (by_button ? (button_refused_[system] >> axis & 1u) != 0 : jog_[system][axis].refused) return Answer::kLetGoFirst;
  if (axes_[system][axis].homing.active()) return Answer::kHoming;
  if (const Answer why = way_hindrance(system, axis, direction); why != Answer::kDone) return why;
  if (at_soft_limit(system, axis, direction)) return Answer::kSoftLimit;
  return (jog_without_feed_[system] >> axis & 1u) != 0 ? Answer::kNoJogFeed : Answer::kDone;
}

// ---- commands ----

Answer Scan::manual(const Command& command) noexcept {
  if (command.system >= systems_ || command.axis >= config_.nc.system[command.system].axis_count) return Answer::kAxisUnknown;
  return command.kind == CommandKind::kJog ? jog(command) : step_or_return(command);
}

// The jog of a client works like a button: it is on until a command with 0 comes, or until no command has come for kJogDeadManScans.
Answer Scan::jog(const Command& command) noexcept {
  Jog& jog = jog_[command.system][command.axis];
  if (command.value == 0) {  // a stop is always accepted, even where no motion is allowed
    jog = {};
    return Answer::kDone;
  }
  Answer why = hand_hindrance(command.system, command.axis);
  if (why == Answer::kDone && is_taken_back(command)) why = Answer::kTakenBack;
  if (why == Answer::kDone && axes_[command.system][command.axis].homing.active()) why = Answer::kHoming;
  if (why == Answer::kDone) why = way_hindrance(command.system, command.axis, direction_of(command.value));
  const double most = config_.nc.system[command.system].axis[command.axis].max_velocity;
  if (why == Answer::kDone && !(std::abs(command.value) <= most)) return Answer::kOutOfRange;
  const bool waits = jog.kind == NC_MANUAL_JOG && jog.refused;
  jog = {NC_MANUAL_JOG, command.value, kJogDeadManScans, waits || why != Answer::kDone};
  if (why != Answer::kDone) return why;
  if (waits) return Answer::kLetGoFirst;
  return at_soft_limit(command.system, command.axis, direction_of(command.value)) ? Answer::kSoftLimit : Answer::kDone;
}

Answer Scan::step_or_return(const Command& command) noexcept {
  const unsigned s = command.system, a = command.axis;
  if (const Answer why = hand_hindrance(s, a); why != Answer::kDone) return why;
  if (is_taken_back(command)) return Answer::kTakenBack;
  if (axes_[s][a].homing.active()) return Answer::kHoming;
  if (command.kind == CommandKind::kReference && config_.equipment[s][a].homing.present() && !axes_[s][a].homed) return begin_homing(s, a);
  if (!at_rest()) return Answer::kAxesMove;
  if (command.kind == CommandKind::kStep) {
    if (const Answer why = way_hindrance(s, a, direction_of(command.value)); why != Answer::kDone) return why;
    if (!(std::abs(command.value) <= kLongestStep)) return Answer::kOutOfRange;
    if (at_soft_limit(s, a, direction_of(command.value))) return Answer::kSoftLimit;
    jog_[s][a] = {NC_MANUAL_STEP, command.value, 2, false};  // two scans are enough: the NC takes the distance at the rising edge
    on_its_way_[s][a] = Asked::kStep;
  } else {
    jog_[s][a] = {NC_MANUAL_REFERENCE, 0, ~0u, false};  // given until the axis is there, or something stops it
    on_its_way_[s][a] = Asked::kReference;
  }
  return Answer::kDone;
}

void Scan::give_commands_by_hand(unsigned s) noexcept {
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    Jog& jog = jog_[s][a];
    nc_manual& manual = in_[s].manual[a];
    const bool acts = !ending_ && mode_ == Mode::kManual && reset_phase_ == ResetPhase::kNone && !alarms_.stops() && !is_spindle_now(s, a);
    if (!acts && jog.kind == NC_MANUAL_RETURN) jog.refused = true;
    else if (!acts && jog.kind != NC_MANUAL_JOG) jog = {};
    if (!acts && jog.kind == NC_MANUAL_JOG) jog.refused = true;
    jog_asked_[s][a] = static_cast<std::int8_t>(jog.kind == NC_MANUAL_JOG ? direction_of(jog.value) : 0);
    approach_asked_[s] = (approach_asked_[s] & ~(1u << a)) | static_cast<std::uint32_t>(jog.kind == NC_MANUAL_RETURN && !jog.refused) << a;
    manual = {};
    if (!jog.refused) {
      manual.kind = jog.kind;
      manual.velocity = jog.kind == NC_MANUAL_JOG || jog.kind == NC_MANUAL_RETURN ? jog.value : 0;
      manual.distance = jog.kind == NC_MANUAL_STEP ? jog.value : 0;
    }
    if (jog.remaining == ~0u) {
      if ((out_[s].at_reference >> a & 1u) != 0) jog = {};
    } else if (jog.remaining > 0 && --jog.remaining == 0) {
      if (jog.kind == NC_MANUAL_JOG && !jog.refused) refuse(s, Asked::kJog, Answer::kNotRepeated, static_cast<int>(a), true);
      if (jog.kind == NC_MANUAL_RETURN && !jog.refused && out_[s].velocity.v[a] != 0) refuse(s, Asked::kApproach, Answer::kNotRepeated, static_cast<int>(a), true);
      jog_asked_[s][a] = 0;
      jog = {};
    }
  }
}

// ---- buttons and handles of the machine, in manual mode; they have priority over the operator's jogs ----

// M700 12.3: in "MDI, memory or tape operation mode". Whether the program is where the length may be changed is for the NC to say.
bool Scan::handle_changes_length(const LadderRequests::System& now, unsigned axis) const noexcept {
  return axis == kToolHandleAxis && mode_ != Mode::kManual && now.length_by_handle && now.handle[axis] != 0;
}

// When the buttons of both directions are on, there is no jog.
void Scan::follow_ladder_manual(const LadderRequests& requests) noexcept {
  if (requests.home && !last_requests_.home) {
    const Command command{CommandKind::kHome, kAllSystems, 0, 0, 0, 0, machine_asker()};
    settle(Asked::kReference, home_command(command), machine_asker());
  }
  const bool acts = !ending_ && mode_ == Mode::kManual && reset_phase_ == ResetPhase::kNone && !alarms_.stops();
  for (unsigned s = 0; s < systems_; ++s) {
    const LadderRequests::System &now = requests.system[s], &before = last_requests_.system[s];
    jog_without_feed_[s] = 0;
    pulses_lost_[s] = 0;
    button_refused_[s] &= now.jog_p | now.jog_m;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      const nc_axis_config& axis = config_.nc.system[s].axis[a];
      const int direction = static_cast<int>(now.jog_p >> a & 1u) - static_cast<int>(now.jog_m >> a & 1u);
      const bool reference = ((now.reference & ~before.reference) >> a & 1u) != 0;
      const bool jogs = acts && direction != 0 && (button_refused_[s] >> a & 1u) == 0;
      const double asked = now.stick_feed[a] > 0 ? now.stick_feed[a] : button_feed(axis, now);
      if (direction != 0) {
        jog_asked_[s][a] = static_cast<std::int8_t>(direction);
        jog_without_feed_[s] = static_cast<std::uint8_t>(jog_without_feed_[s] | (asked > 0 ? 0u : 1u << a));
      }
      if (handle_changes_length(now, a)) in_[s].tool_length_handle = now.handle[a] * kHandleIncrement;
      else if (now.handle[a] != 0 && (!acts || jogs)) pulses_lost_[s] |= 1u << a;
      if (jogs) {
        in_[s].manual[a] = {NC_MANUAL_JOG, direction * std::min(asked, axis.max_velocity), 0};
      } else if (acts && now.handle[a] != 0) {
        in_[s].manual[a] = {NC_MANUAL_HANDLE, 0, now.handle[a] * kHandleIncrement};
      }
      follow_approach_button(s, a, ((now.approach >> a & 1u)) != 0, acts && !jogs && now.handle[a] == 0);
      if (reference) {
        const Command command{CommandKind::kReference, static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(a), 0, 0, 0, machine_asker()};
        const Answer answer = jogs || (acts && now.handle[a] != 0) ? Answer::kAxesMove : manual(command);
        if (answer != Answer::kDone) refuse(s, Asked::kReference, answer, static_cast<int>(a));
        else happened(s, Asked::kReference);
      }
    }
  }
}

// ---- what is noted, after the NC ----

// A feed hold of a client acts on motion by hand as that of the machine does while it is on, and goes when everything stands: then what was stopped needs a new press.
void Scan::watch_manual() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    watch_length_handle(s);
    bool stands = true;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) stands &= out_[s].velocity.v[a] == 0;
    if (stands) hands_held_ &= ~(1u << s);
    if (mode_ != Mode::kManual || (!out_[s].tap_retract_possible && out_[s].state != NC_STATE_MANUAL)) taps_drawn_ &= ~(1u << s);
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      watch_jog(s, a);
      watch_approach(s, a);
      watch_way(s, a);
      watch_handle(s, a);
    }
  }
}

// While a direction is asked for, by a button or by a client, each new reason against it is noted once. The jog counts as stopped when the axis had moved,
// and as refused otherwise.
void Scan::watch_jog(unsigned s, unsigned a) noexcept {
  JogWatch& watch = jog_watch_[s][a];
  const int direction = jog_asked_[s][a];
  const Answer why = jog_hindrance(s, a, direction);
  if (asks_for_a_new_press(why)) {
    button_refused_[s] |= (last_requests_.system[s].jog_p | last_requests_.system[s].jog_m) & 1u << a;
    if (jog_[s][a].kind == NC_MANUAL_JOG) jog_[s][a].refused = true;
  }
  if (direction == 0) {
    watch = {};
    return;
  }
  const bool moves = out_[s].velocity.v[a] * direction > 0;
  watch.went |= moves && why == Answer::kDone;  // with a reason against the jog it is a program that moves the axis
  if (why == Answer::kDone) {
    if (moves) happened(s, Asked::kJog);
  } else if (why != watch.why) {
    refuse(s, Asked::kJog, why, static_cast<int>(a), watch.went);
  }
  watch.why = why;
}

// A step or a reference return that is stopped is dropped; it does not go on when the reason has gone.
void Scan::watch_way(unsigned s, unsigned a) noexcept {
  Asked& way = on_its_way_[s][a];
  if (way == Asked::kNothing) return;
  const nc_outputs& out = out_[s];
  if (const Answer why = search_hindrance(s, a); why != Answer::kDone) return give_up_way(s, a, why);
  if (axes_[s][a].homing.active()) return;
  const bool waits = out.state == NC_STATE_MANUAL && out.cause == NC_CAUSE_FIN;  // for the clamp of an index table
  if (jog_[s][a].kind != NC_MANUAL_NONE || out.velocity.v[a] != 0 || waits) return;
  happened(s, way);
  way = Asked::kNothing;
}

void Scan::give_up_way(unsigned s, unsigned a, Answer why) noexcept {
  refuse(s, on_its_way_[s][a], why, static_cast<int>(a), true);
  on_its_way_[s][a] = Asked::kNothing;
  if (jog_[s][a].kind != NC_MANUAL_JOG) jog_[s][a] = {};
}

// Of pulses that do not become motion each reason once, until pulses act again.
void Scan::watch_handle(unsigned s, unsigned a) noexcept {
  Answer& noted = handle_noted_[s][a];
  const bool clash = (wheels_clash_[s] >> a & 1u) != 0;
  if (clash || wheel_jumped(s, a)) {
    const Answer wheel = clash ? Answer::kTwoWheels : Answer::kHandleTooFar;
    if (noted != wheel) refuse(s, Asked::kHandle, wheel, static_cast<int>(a));
    noted = wheel;
    return;
  }
  const nc_manual& given = in_[s].manual[a];
  const bool ignored = (pulses_lost_[s] >> a & 1u) != 0;
  if (!ignored && (out_[s].handle_dropped >> a & 1u) == 0) {
    if (given.kind != NC_MANUAL_HANDLE) return;
    noted = Answer::kDone;
    happened(s, Asked::kHandle);
    return;
  }
  Answer why = hand_hindrance(s, a);
  if (why == Answer::kDone) why = axes_[s][a].homing.active() ? Answer::kHoming : hindered_[s][a];
  const bool jogs = ignored || given.kind == NC_MANUAL_JOG;
  if (why == Answer::kDone) why = jogs ? Answer::kAxesMove : at_soft_limit(s, a, direction_of(given.distance)) ? Answer::kSoftLimit : Answer::kHandleTooFar;
  if (why != noted) refuse(s, Asked::kHandle, why, static_cast<int>(a), given.kind != NC_MANUAL_HANDLE && !ignored);
  noted = why;
}

// Of pulses that do not change the length along the tool axis the first is noted, until some act again.
void Scan::watch_length_handle(unsigned s) noexcept {
  const bool dropped = out_[s].tool_length_dropped;
  if (dropped && !length_handle_noted_[s]) refuse(s, Asked::kHandle, Answer::kRefusedByControl, static_cast<int>(kToolHandleAxis));
  if (!dropped && in_[s].tool_length_handle != 0) happened(s, Asked::kHandle);
  if (dropped || in_[s].tool_length_handle != 0) length_handle_noted_[s] = dropped;
}

// A command draws out the tap that a reset or a power cut has left in its hole.
Answer Scan::draw_tap(unsigned system, bool on) noexcept {
  if (system >= systems_) return Answer::kAxisUnknown;
  if (!on) {
    taps_drawn_ &= ~(1u << system);
    return Answer::kDone;
  }
  if (mode_ != Mode::kManual) return Answer::kNotInThisMode;
  if (!out_[system].tap_retract_possible) return Answer::kRefusedByControl;
  if (const Answer why = tap_hindrance(system); why != Answer::kDone) return why;
  taps_drawn_ |= 1u << system;
  return Answer::kDone;
}

// What keeps the tap in its hole: what keeps any axis of its part system from motion by hand, and, since the NC alone knows which one the tap's is, a drive or a brake of any of
// them, and a way that is barred as soon as an axis goes it.
Answer Scan::tap_hindrance(unsigned s) const noexcept {
  for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
    if (is_spindle_now(s, a)) continue;
    Answer why = hand_hindrance(s, a);
    if (why == Answer::kTapInHole) why = Answer::kDone;  // of the others
    if (why == Answer::kDone && out_[s].state == NC_STATE_MANUAL) why = way_hindrance(s, a, direction_of(out_[s].velocity.v[a]));
    if (why != Answer::kDone) return why;
  }
  return Answer::kDone;
}

// Behind the ladder. It is drawn out as long as it is asked for, from when that rises; what was refused or stopped acts again when it was let go.
void Scan::follow_tap(unsigned s) noexcept {
  const std::uint32_t bit = 1u << s;
  const bool asked = in_[s].tap_retract;
  const bool begins = asked && (taps_asked_ & bit) == 0;
  taps_asked_ = asked ? taps_asked_ | bit : taps_asked_ & ~bit;
  if (!asked) taps_refused_ &= ~bit;
  if (!asked || (!begins && (taps_refused_ & bit) != 0)) {
    in_[s].tap_retract = false;
    return;
  }
  const bool possible = out_[s].tap_retract_possible || out_[s].state == NC_STATE_MANUAL;
  const Answer why = possible ? tap_hindrance(s) : Answer::kRefusedByControl;
  if (why == Answer::kDone) return;
  taps_refused_ |= bit;
  taps_drawn_ &= ~bit;
  in_[s].tap_retract = false;
  if (!possible) return;  // there is none in its hole, or not yet for the NC: it may be so in this cycle
  refuse(s, Asked::kTapRetract, why, -1, out_[s].state == NC_STATE_MANUAL);
}

}  // namespace nc::rt
