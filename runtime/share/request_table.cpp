// SPDX-License-Identifier: Apache-2.0
// See request_table.hpp.
#include "runtime/share/request_table.hpp"

#include <iterator>

namespace nc::rt::share {
namespace {

// In the order of RequestKind.
constexpr RequestRow kRequestRows[] = {
    {RequestKind::kTakeControl, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kReleaseControl, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kCycleStart, Stop::kNo, Scope::kNamed, true, CommandKind::kCycleStart},
    {RequestKind::kFeedHold, Stop::kAtOnce, Scope::kNamed, true, CommandKind::kFeedHold},
    {RequestKind::kReset, Stop::kInTurn, Scope::kControl, true, CommandKind::kReset},
    {RequestKind::kSetMode, Stop::kNo, Scope::kControl, true, CommandKind::kSetMode},
    {RequestKind::kFeedOverride, Stop::kNo, Scope::kNamed, false, CommandKind::kFeedOverride},
    {RequestKind::kRapidOverride, Stop::kNo, Scope::kNamed, false, CommandKind::kRapidOverride},
    {RequestKind::kSingleBlock, Stop::kNo, Scope::kNamed, false, CommandKind::kSingleBlock},
    {RequestKind::kOptionalStop, Stop::kNo, Scope::kNamed, false, CommandKind::kOptionalStop},
    {RequestKind::kJog, Stop::kNo, Scope::kOne, false, CommandKind::kJog},
    {RequestKind::kMdi, Stop::kNo, Scope::kOne, false, {}},
    {RequestKind::kSelectProgram, Stop::kNo, Scope::kOne, false, {}},
    {RequestKind::kForce, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kReleaseForce, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kWriteDevice, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kRestartFind, Stop::kNo, Scope::kOne, false, {}},
    {RequestKind::kRestartConfirm, Stop::kNo, Scope::kOne, false, CommandKind::kConfirmRestart},
    {RequestKind::kRestartApproach, Stop::kNo, Scope::kOne, false, CommandKind::kApproach},
    {RequestKind::kRestartCancel, Stop::kNo, Scope::kOne, false, CommandKind::kCancelRestart},
    {RequestKind::kClientGone, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kGatewayBegan, Stop::kNo, Scope::kNamed, false, {}},
    {RequestKind::kCount, Stop::kNo, Scope::kNamed, false, {}},
};
static_assert(std::size(kRequestRows) == static_cast<std::size_t>(RequestKind::kCount) + 1);

constexpr bool requests_in_order() {
  for (std::size_t i = 0; i < std::size(kRequestRows); ++i)
    if (static_cast<std::size_t>(kRequestRows[i].kind) != i) return false;
  return true;
}
static_assert(requests_in_order());

}  // namespace

const RequestRow& request_row(RequestKind kind) { return kRequestRows[kind < RequestKind::kCount ? static_cast<std::size_t>(kind) : static_cast<std::size_t>(RequestKind::kCount)]; }

}  // namespace nc::rt::share
