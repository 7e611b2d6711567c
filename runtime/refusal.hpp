// SPDX-License-Identifier: Apache-2.0
// Why something that was asked for at the machine's panel did not happen: a start, a change of mode, a jog that does not begin or that ends by itself. A
// program that gives a command gets an answer. A button gets none, so the reason is kept for displays.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/command.hpp"

namespace nc::rt {

struct Config;

enum class Asked : std::uint8_t { kNothing, kCycleStart, kMode, kJog, kReference, kStep, kHandle, kApproach, kTapRetract };

// The last refusal of a part system.
struct Refusal {
  std::uint32_t count = 0;         // number of refusals since power on
  Asked asked = Asked::kNothing;   // what was refused; kNothing: it has happened since
  Answer why = Answer::kDone;
  bool stopped = false;            // the motion had begun and was stopped
  std::int8_t axis = -1;           // index, -1 = none
  Asker by = Asker::kConsole;      // who asked for a cycle start or a mode
  std::int8_t of = -1;             // part system of the axis, where it is another one
};

// The reason as a number for monitors. Numbers never change; new ones are added at the end. The names are those of RefusalCause in dds/nc_dds.idl.
enum class RefusalCause : std::uint8_t {
  kNone, kMode, kRunning, kMiddleOfBlock, kNoProgram, kAlarm, kResetting, kEnding, kSpindle, kSoftLimit, kNotRepeated, kNoFeed, kOther,
  kFeedHold, kInterlock, kResetHeld, kWarning, kMachineSwitch, kRange, kAxis, kControl, kNotLoaded, kNoDevice, kTooMany, kNoLadder, kNoAnswer,
  kLetGo, kTooFar, kDrives, kNotHomed, kHoming, kLimitSwitch, kTapInHole, kMachineLock,
  kRestart,
  kLast = kRestart
};
// kNone for Answer::kDone. Every other answer has a cause, which is never kOther: that one stands for a cause that only a later version knows.
RefusalCause refusal_cause(Answer why);
RefusalCause refusal_cause(const Refusal& refusal);

// Who has asked for a cycle start, as text: "by the ladder", "at point \"start\"".
std::string asker_text(const Config& config, Asker by);

// The refusal as a sentence, such as "jog X refused: an alarm is active: reset first"; "" when there is none.
std::string refusal_text(const Config& config, unsigned system, const Refusal& refusal);

}  // namespace nc::rt
