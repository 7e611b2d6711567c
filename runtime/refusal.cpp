// SPDX-License-Identifier: Apache-2.0
// The reasons in words and as numbers. See refusal.hpp.
#include "runtime/refusal.hpp"

#include <algorithm>

#include "runtime/config.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {
namespace {

const char* asked_text(Asked asked) {
  switch (asked) {
    case Asked::kNothing: return "";
    case Asked::kCycleStart: return "cycle start";
    case Asked::kMode: return "mode";
    case Asked::kJog: return "jog";
    case Asked::kReference: return "reference return";
    case Asked::kStep: return "step";
    case Asked::kHandle: return "handle";
    case Asked::kApproach: return "return to the path";
    case Asked::kTapRetract: return "drawing out of the tap";
  }
  return "";
}

}  // namespace

// The switch has no default, so that the compiler reports a new answer that is missing here.
RefusalCause refusal_cause(Answer why) {
  switch (why) {
    case Answer::kDone: return RefusalCause::kNone;
    case Answer::kNotInThisMode: return RefusalCause::kMode;
    case Answer::kNotWhileRunning:
    case Answer::kAlreadyRunning:
    case Answer::kAxesMove: return RefusalCause::kRunning;
    case Answer::kMiddleOfBlock: return RefusalCause::kMiddleOfBlock;
    case Answer::kNoProgram: return RefusalCause::kNoProgram;
    case Answer::kAlarmActive: return RefusalCause::kAlarm;
    case Answer::kResetting: return RefusalCause::kResetting;
    case Answer::kLetGoFirst: return RefusalCause::kLetGo;
    case Answer::kHandleTooFar: return RefusalCause::kTooFar;
    case Answer::kDrivesOff: return RefusalCause::kDrives;
    case Answer::kEnding: return RefusalCause::kEnding;
    case Answer::kSpindleNow: return RefusalCause::kSpindle;
    case Answer::kSoftLimit: return RefusalCause::kSoftLimit;
    case Answer::kNotRepeated: return RefusalCause::kNotRepeated;
    case Answer::kNoJogFeed: return RefusalCause::kNoFeed;
    case Answer::kFeedHold:
    case Answer::kTakenBack: return RefusalCause::kFeedHold;
    case Answer::kInterlock: return RefusalCause::kInterlock;
    case Answer::kResetHeld: return RefusalCause::kResetHeld;
    case Answer::kWarningActive: return RefusalCause::kWarning;
    case Answer::kMachineSwitch: return RefusalCause::kMachineSwitch;
    case Answer::kOutOfRange: return RefusalCause::kRange;
    case Answer::kTwoWheels:
    case Answer::kAxisUnknown: return RefusalCause::kAxis;
    case Answer::kRefusedByControl: return RefusalCause::kControl;
    case Answer::kNotChecked:
    case Answer::kNotLoaded: return RefusalCause::kNotLoaded;
    case Answer::kForced:
    case Answer::kNoDevice: return RefusalCause::kNoDevice;
    case Answer::kQueueFull:
    case Answer::kTooManyForces: return RefusalCause::kTooMany;
    case Answer::kNoLadder: return RefusalCause::kNoLadder;
    case Answer::kNotHomed: return RefusalCause::kNotHomed;
    case Answer::kNoHoming: return RefusalCause::kAxis;
    case Answer::kHoming: return RefusalCause::kHoming;
    case Answer::kLimitSwitch: return RefusalCause::kLimitSwitch;
    case Answer::kTapInHole: return RefusalCause::kTapInHole;
    case Answer::kLocked:
    case Answer::kLockLeft: return RefusalCause::kMachineLock;
    case Answer::kRestartSearch:
    case Answer::kRestartLost:
    case Answer::kRestartOpen:
    case Answer::kRestartAxes:
    case Answer::kNoPlace: return RefusalCause::kRestart;
    case Answer::kNoAnswer: return RefusalCause::kNoAnswer;
  }
  return RefusalCause::kOther;
}

RefusalCause refusal_cause(const Refusal& refusal) {
  return refusal.asked == Asked::kNothing ? RefusalCause::kNone : refusal_cause(refusal.why);
}

std::string asker_text(const Config& config, Asker by) {
  switch (by) {
    case Asker::kConsole: return "at the console";
    case Asker::kClient: return "by a client";
    case Asker::kLadder: return "by the ladder";
    case Asker::kPanel: break;
  }
  const std::vector<Signal> signals = machine_signals(config.nc);
  const auto wire = std::find_if(config.wires.begin(), config.wires.end(), [&](const SignalWire& each) { return signals[each.signal].name == "plc.cycle_start"; });
  return wire == config.wires.end() ? "at the panel" : "at point \"" + config.points.at(wire->point).name + "\"";
}

std::string refusal_text(const Config& config, unsigned system, const Refusal& refusal) {
  if (refusal.asked == Asked::kNothing) return "";
  std::string text = asked_text(refusal.asked);
  const nc_system_config& axes = config.nc.system[refusal.of >= 0 ? static_cast<unsigned>(refusal.of) : system];
  const bool named = refusal.axis >= 0 && refusal.axis < static_cast<int>(axes.axis_count), start = refusal.asked == Asked::kCycleStart;
  const std::string axis(named ? 1 : 0, named ? axes.axis[refusal.axis].name : ' ');
  if (named && !start) text += " " + axis;
  const bool waits = refusal.why == Answer::kNoJogFeed;  // the jog begins as soon as the feed is turned up
  text += std::string(waits ? " waits: " : refusal.stopped ? " stopped: " : " refused: ") + answer_text(refusal.why);
  if (!named || !start) return text;
  return text + " (" + axis + (refusal.of >= 0 ? " of part system " + std::to_string(refusal.of + 1) : "") + ")";
}

}  // namespace nc::rt
