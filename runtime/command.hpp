// SPDX-License-Identifier: Apache-2.0
// What an operator (or a program in an operator's place) can ask of the runtime, and the answers.
#pragma once

#include <cstdint>

namespace nc::rt {

enum class Mode : std::uint8_t { kAuto = 0, kMdi = 1, kManual = 2 };

enum class CommandKind : std::uint8_t {
  // for the scan
  kSetMode,  // number: Mode
  kCycleStart,
  kFeedHold,
  kReset,          // also acknowledges alarms whose cause is gone
  kFeedOverride,   // value: 0..max_feed_override
  kRapidOverride,  // value: 0..1
  kSingleBlock,    // number: 0 or 1
  kOptionalStop,   // number: 0 or 1
  kJog,            // axis; value: velocity in mm/s with its sign, 0 stops. It has to be repeated within kJogDeadManScans. A jog that was refused or
                   // stopped begins again only after a command with 0, or after kJogDeadManScans without a command
  kStep,           // axis, value: distance
  kReference,      // axis: go to the first reference position
  kHome,           // axis: find its reference mark; kAllSystems: every axis that can be homed, in order
  kTapRetract,     // a synchronous tap that stands in its hole is drawn out, in mode MANUAL; number: 0 or 1, at 0 it stands where it is
  kApproach,       // axis: it goes back to where its program goes on, in mode MANUAL; value: velocity in mm/s, 0 = the jog feed. To be repeated as a jog is
  kForce,          // number: of LadderTask::force_number(), value: what the device is held at
  kRelease,        // number: the same, kAllForces
  kWriteDevice,    // number: the same, value: what the device gets once
  kEnd,            // the control is being ended: to rest, and nothing starts any more, whatever the ladder asks for
  // for the feeder
  kSelectProgram,  // number: index of the file in the program store; in mode AUTO
  kLoadMdi,        // loads the text given to Runtime::load_mdi(); in mode MDI
  kSwitches,       // number: optional skip switches (bit n = switch n)
  kFindRestart,    // looks for the place given to Runtime::find_restart(); in mode AUTO
  kConfirmRestart, // number: entry of the recovery list, kEveryEntry = all of them
  kCancelRestart,
  kLook,           // calls the function given to Runtime::look()
  kChange,         // calls the function given to Runtime::change(), while no program is in execution
};

constexpr bool for_feeder(CommandKind kind) {
  return kind >= CommandKind::kSelectProgram;
}

// Who gives a command: the program that has started the runtime, a client of the shared memory (DDS), an input point of the machine that is wired to
// a signal, or the machine's ladder program.
enum class Asker : std::uint8_t { kConsole, kClient, kPanel, kLadder };

// All part systems, in place of an index: the meaning of a button on the panel that belongs to no single part system.
inline constexpr std::uint8_t kAllSystems = 0xff;

// Commands that may name one part system or all of them. Mode and reset always concern the whole control, as their signals do
// (plc.mode_*, plc.reset); programs and manual motion always concern one part system.
constexpr bool takes_all_systems(CommandKind kind) {
  return kind <= CommandKind::kOptionalStop;
}

inline constexpr std::uint64_t kBehindAll = UINT64_MAX;

struct Command {
  CommandKind kind = CommandKind::kReset;
  std::uint8_t system = 0;  // index, or kAllSystems
  std::uint8_t axis = 0;
  std::uint32_t number = 0;
  double value = 0;
  std::uint64_t ticket = 0;  // number of the command; set by the runtime
  Asker by = Asker::kConsole;
  // Of one that moves something: the feed holds that had been asked for when it was (HoldDoor). One that came behind it takes it back. kBehindAll = none does.
  std::uint64_t holds = kBehindAll;
};

enum class Answer : std::uint8_t {
  kDone = 0,
  kQueueFull,
  kNotInThisMode,
  kNotWhileRunning,  // a program is in execution or interrupted: reset first
  kMiddleOfBlock,    // the program was stopped in the middle of a block, where this is not possible
  kNoProgram,        // nothing selected
  kAlarmActive,      // reset first
  kResetting,        // a reset is still going on
  kEnding,           // the control is being ended
  kAlreadyRunning,
  kOutOfRange,
  kAxisUnknown,
  kRefusedByControl,  // libnc said no
  kNotLoaded,         // the program was not found or cannot be read
  kNoDevice,          // no such device, or one that cannot be forced
  kTooManyForces,
  kForced,            // the device is held at a value
  kNoLadder,
  kMachineSwitch,     // a switch of the machine (plc.feed_override, plc.rapid_override) is in force
  kSpindleNow,        // the axis is a spindle as long as its servo is off
  kSoftLimit,         // the axis stands at its soft limit
  kNotRepeated,       // a jog ended because it was not repeated in time
  kNoJogFeed,         // a jog while the jog feed is 0
  kLetGoFirst,        // the jog was on while something refused it: it must go off first
  kFeedHold,          // the machine gives a feed hold
  kTakenBack,         // a feed hold came behind a cycle start or a motion by hand, before it was executed or in the same scan; whoever gave the feed hold
  kInterlock,
  kAxesMove,
  kWarningActive,     // R19, R20, printed lines are lost: reset first
  kResetHeld,         // a reset is done, and plc.reset is still on
  kDrivesOff,         // a drive does not follow (yet)
  kHandleTooFar,      // more than the axis follows
  kTwoWheels,         // two handwheels on one axis, or two axes on one
  kNotHomed,          // an axis does not know yet where it stands
  kNoHoming,          // there is no homing for it
  kHoming,            // the axis is being homed
  kLimitSwitch,       // an axis stands on its limit switch
  kTapInHole,         // a tap that was given up stands in its hole
  kLocked,            // the axis is locked (plc.machine_lock, plc.axis_lock)
  kLockLeft,          // an axis was moved in a machine lock that has been taken off
  kRestartSearch,     // a place in the program is being looked for
  kRestartLost,       // the place in the program was not found, or was forgotten
  kRestartOpen,       // entries of the recovery list are open
  kRestartAxes,       // an axis is not where a program goes on that begins inside, or that stands in a feed hold
  kNoPlace,           // there is nothing to which the axis could go back
  kNotChecked,        // the program has not passed its check (StartGate)
  kNoAnswer           // the runtime does not run
};
inline constexpr unsigned kAnswers = static_cast<unsigned>(Answer::kNoAnswer) + 1;

constexpr const char* answer_text(Answer answer) {
  switch (answer) {
    case Answer::kDone:
      return "done";
    case Answer::kQueueFull:
      return "too many commands at once";
    case Answer::kNotInThisMode:
      return "not in this mode";
    case Answer::kNotWhileRunning:
      return "a program is in execution or interrupted: reset first";
    case Answer::kMiddleOfBlock:
      return "the program is amid a block, or a tap lets its spindle go: wait, go on to the end of it (single block), or reset";
    case Answer::kNoProgram:
      return "no program is selected";
    case Answer::kAlarmActive:
      return "an alarm is active: reset first";
    case Answer::kResetting:
      return "a reset is in progress";
    case Answer::kEnding:
      return "the control is being ended";
    case Answer::kAlreadyRunning:
      return "already running";
    case Answer::kOutOfRange:
      return "value out of range";
    case Answer::kAxisUnknown:
      return "no such axis or part system";
    case Answer::kRefusedByControl:
      return "refused by the control";
    case Answer::kNotLoaded:
      return "the program cannot be loaded";
    case Answer::kNoDevice:
      return "no such device, or none that can be forced";
    case Answer::kTooManyForces:
      return "32 devices are forced already";
    case Answer::kForced:
      return "the device is forced: release it first";
    case Answer::kNoLadder:
      return "there is no ladder program";
    case Answer::kMachineSwitch:
      return "the override switch of the machine is in force";
    case Answer::kSpindleNow:
      return "the axis is a spindle now: its servo is off";
    case Answer::kSoftLimit:
      return "the axis stands at its soft limit";
    case Answer::kNotRepeated:
      return "it was not asked for again in time";
    case Answer::kNoJogFeed:
      return "the jog feed is 0";
    case Answer::kLetGoFirst:
      return "the button was on while something refused or stopped it: let it go first";
    case Answer::kFeedHold:
      return "the feed hold of the machine is on";
    case Answer::kTakenBack:
      return "a feed hold has taken it back";
    case Answer::kInterlock:
      return "the interlock of the machine is on";
    case Answer::kResetHeld:
      return "the reset of the machine is still on: let it go first";
    case Answer::kWarningActive:
      return "a warning (R19, R20, printed lines are lost) is to be acknowledged: reset first";
    case Answer::kAxesMove:
      return "an axis moves: wait until it stands";
    case Answer::kDrivesOff:
      return "the drives are off, come on or move by themselves: wait until they follow";
    case Answer::kHandleTooFar:
      return "more than the axis follows: it does not end where the wheel says";
    case Answer::kTwoWheels:
      return "two handwheels have chosen this axis, or the wheel has chosen two axes: choose one";
    case Answer::kNotHomed:
      return "an axis is not homed: home it first";
    case Answer::kNoHoming:
      return "no homing is configured";
    case Answer::kHoming:
      return "the axis is being homed";
    case Answer::kLimitSwitch:
      return "an axis is on its limit switch, or the switch cannot be read: only the other way is free";
    case Answer::kTapInHole:
      return "a tap stands in its hole: draw it out first, by the retract or by hand along its own axis";
    case Answer::kLocked:
      return "the axis is locked by the machine lock";
    case Answer::kLockLeft:
      return "an axis was moved in the machine lock and is not where it is shown: reset first";
    case Answer::kRestartSearch:
      return "a place in the program is being looked for: wait, or cancel it";
    case Answer::kRestartLost:
      return "the place at which the program was to begin was not found, or was forgotten: look for it again, or cancel it and begin at the head";
    case Answer::kRestartOpen:
      return "what the program has given to the machine before the place is not there: give it out by MDI, or confirm it";
    case Answer::kRestartAxes:
      return "an axis is not where the program goes on: bring it there by hand first";
    case Answer::kNoPlace:
      return "no program that is stopped has left the axis anywhere";
    case Answer::kNotChecked:
      return "the program has not passed its check";
    case Answer::kNoAnswer:
      return "the runtime does not answer";
  }
  return "?";
}

struct CommandAnswer {
  std::uint64_t ticket = 0;
  Answer answer = Answer::kDone;
};

// A jog command that is not repeated within this number of scans ends: a lost connection must not leave an axis moving.
inline constexpr unsigned kJogDeadManScans = 200;

inline constexpr std::uint32_t kEveryEntry = ~0u;  // of a recovery list
inline constexpr std::uint32_t kAllForces = ~0u;
inline constexpr unsigned kMaxForces = 32;  // devices that can be held at the same time

}  // namespace nc::rt
