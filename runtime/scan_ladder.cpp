// SPDX-License-Identifier: Apache-2.0
// The ladder's place in the scan, and when its requests act.
#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

// A start that is shorter is a bounce of the button.
constexpr unsigned kStartMinScans = 2;

}  // namespace

void Scan::run_ladder() noexcept {
  const LadderStatus status{mode_, alarms_.count != 0, reset_phase_ != ResetPhase::kNone, !drives_off_, scan_};
  LadderRequests requests;
  LadderImage image{&config_.points, &points_, &feedback_, out_, in_, systems_, &status, &requests};
  ladder_->scan(&image);
  follow_ladder(requests);
}

// Cycle start acts when it falls, reset and modes when they rise, alarms while they are on.
void Scan::follow_ladder(const LadderRequests& requests) noexcept {
  if (requests.cycle_start) {
    if (ladder_start_scans_ < kStartMinScans) ++ladder_start_scans_;
  } else {
    if (ladder_start_scans_ == kStartMinScans) (void)start_cycle();  // the NC sees it in the next scan
    ladder_start_scans_ = 0;
  }
  if (requests.reset && !last_requests_.reset) request_reset();
  unsigned modes = 0, chosen = 0;
  for (unsigned m = 0; m < 3; ++m) {
    if (!requests.mode[m]) continue;
    ++modes;
    chosen = m;
  }
  if (modes == 1 && !last_requests_.mode[chosen]) (void)set_mode(static_cast<Mode>(chosen));
  for (unsigned n = 0; n < kLadderAlarms; ++n)
    if ((requests.alarm >> n & 1u) != 0) raise(AlarmId::kLadder, 0, -1, n);
  if (requests.stopped) raise(AlarmId::kLadderStopped, 0, -1, requests.stopped_line);
  last_requests_ = requests;
  // An alarm that came here stops the machine in this scan.
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned i = 0; i < alarms_.count; ++i) in_[s].alarm |= alarms_.alarm[i].id != AlarmId::kProgram;
}

void Scan::request_reset() noexcept {
  if (reset_phase_ != ResetPhase::kNone) return;
  reset_phase_ = ResetPhase::kStopping;
  reset_scans_ = 0;
  for (unsigned i = 0; i < alarms_.count; ++i)  // the program gets its next try; the same fault comes back as R17
    if (alarms_.alarm[i].id == AlarmId::kLadderStopped) ladder_->restart();
  acknowledge_alarms();  // a cause that is still there brings its alarm back
}

}  // namespace nc::rt
