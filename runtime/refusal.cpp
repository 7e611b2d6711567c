// SPDX-License-Identifier: Apache-2.0
// The reasons in words and as numbers. See refusal.hpp.
#include "runtime/refusal.hpp"

#include "runtime/config.hpp"

namespace nc::rt {
namespace {

struct Row {
  Answer why;
  RefusalCause cause;
};
constexpr Row kRows[] = {
    {Answer::kNotInThisMode, RefusalCause::kMode},         {Answer::kNotWhileRunning, RefusalCause::kRunning},
    {Answer::kAlreadyRunning, RefusalCause::kRunning},     {Answer::kMiddleOfBlock, RefusalCause::kMiddleOfBlock},
    {Answer::kNoProgram, RefusalCause::kNoProgram},        {Answer::kAlarmActive, RefusalCause::kAlarm},
    {Answer::kResetting, RefusalCause::kResetting},        {Answer::kEnding, RefusalCause::kEnding},
    {Answer::kSpindleNow, RefusalCause::kSpindle},         {Answer::kSoftLimit, RefusalCause::kSoftLimit},
    {Answer::kNotRepeated, RefusalCause::kNotRepeated},    {Answer::kNoJogFeed, RefusalCause::kNoFeed},
};

const char* asked_text(Asked asked) {
  switch (asked) {
    case Asked::kNothing: return "";
    case Asked::kCycleStart: return "cycle start";
    case Asked::kMode: return "mode";
    case Asked::kJog: return "jog";
    case Asked::kReference: return "reference return";
  }
  return "";
}

}  // namespace

RefusalCause refusal_cause(const Refusal& refusal) {
  if (refusal.asked == Asked::kNothing) return RefusalCause::kNone;
  for (const Row& row : kRows)
    if (row.why == refusal.why) return row.cause;
  return RefusalCause::kOther;
}

std::string refusal_text(const Config& config, unsigned system, const Refusal& refusal) {
  if (refusal.asked == Asked::kNothing) return "";
  std::string text = asked_text(refusal.asked);
  const nc_system_config& axes = config.nc.system[system];
  if (refusal.axis >= 0 && refusal.axis < static_cast<int>(axes.axis_count)) text += std::string(" ") + axes.axis[refusal.axis].name;
  return text + (refusal.stopped ? " stopped: " : " refused: ") + answer_text(refusal.why);
}

}  // namespace nc::rt
