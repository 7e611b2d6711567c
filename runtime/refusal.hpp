// SPDX-License-Identifier: Apache-2.0
// Why what was asked for at the machine's panel did not happen: a start, a mode, a jog that does not begin or ends by itself. A
// command of an operator's program has its answer; a button has none, and whoever presses it wants to read the reason.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/command.hpp"

namespace nc::rt {

struct Config;

enum class Asked : std::uint8_t { kNothing, kCycleStart, kMode, kJog, kReference, kStep, kHandle };

// The last one of a part system.
struct Refusal {
  std::uint32_t count = 0;         // of all since power on
  Asked asked = Asked::kNothing;   // kNothing: what was refused has happened since
  Answer why = Answer::kDone;
  bool stopped = false;            // it had begun, and was ended
  std::int8_t axis = -1;           // index, -1 = none
  Asker by = Asker::kConsole;      // of a cycle start and a mode
};

// What monitors know the reason by; numbers never change, new ones come at the end. The names are those of RefusalCause in dds/nc_dds.idl.
enum class RefusalCause : std::uint8_t {
  kNone, kMode, kRunning, kMiddleOfBlock, kNoProgram, kAlarm, kResetting, kEnding, kSpindle, kSoftLimit, kNotRepeated, kNoFeed, kOther,
  kFeedHold, kInterlock, kResetHeld, kWarning, kMachineSwitch, kRange, kAxis, kControl, kNotLoaded, kNoDevice, kTooMany, kNoLadder, kNoAnswer,
  kLetGo, kTooFar, kDrives, kNotHomed, kHoming, kLimitSwitch,
  kLast = kLimitSwitch
};
// kNone for what has been done. Every other answer has one, and none is kOther: that is for what a later control may say.
RefusalCause refusal_cause(Answer why);
RefusalCause refusal_cause(const Refusal& refusal);

// "by the ladder", "at point \"start\"": who has asked for a cycle start.
std::string asker_text(const Config& config, Asker by);

// "jog X refused: an alarm is active: reset first"; "" when there is none.
std::string refusal_text(const Config& config, unsigned system, const Refusal& refusal);

}  // namespace nc::rt
