// SPDX-License-Identifier: Apache-2.0
// Runs the ladder within the scan, and carries out its requests.
#include <algorithm>

#include "runtime/scan.hpp"

namespace nc::rt {
namespace {

// A cycle start that is on for fewer scans is taken for a bounce of the button and ignored.
constexpr unsigned kStartMinScans = 2;

// A switch that gives the feed override as a code of five bits, each of them inverted, in steps of 10 %. All bits off is the code of no place of the switch: a
// broken cable, so nothing cuts.
double share_of_code(std::uint8_t bits) {
  constexpr std::uint8_t kBits = 0x1f;
  return (bits & kBits) == 0 ? 0 : (~bits & kBits) * 0.1;
}

}  // namespace

void Scan::run_ladder() noexcept {
  const bool stopped = alarms_.stops();
  const LadderStatus status{mode_,       stopped, !stopped && alarms_.count != 0, reset_phase_ != ResetPhase::kNone,
                            !drives_off_, scan_,   macro_.output(),                           flags_,
                            all_homed(),  power_.failed(),  power_.phase() == PowerWatch::Phase::kDone, scan_time_ns_,
                            restart_stands_.load(std::memory_order_acquire), restart_bars_.load(std::memory_order_acquire),
                            search_};
  LadderRequests requests;
  LadderImage image{&config_.points, &points_, &feedback_, out_, in_, systems_, &status, &requests, &config_.nc};
  for (unsigned s = 0; s < systems_; ++s) in_[s].feed_hold = false;
  ladder_->scan(&image);
  turn_handwheels(&requests);
  move_joysticks(&requests);
  for (unsigned s = 0; s < systems_; ++s) {
    in_[s].feed_hold |= (hands_held_ >> s & 1u) != 0;
    machine_holds_[s] = in_[s].feed_hold;
    in_[s].feed_hold |= (hold_request_ >> s & 1u) != 0;
  }
  decide_overrides(requests);
  for (unsigned s = 0; s < systems_; ++s) {
    in_[s].manual_feed = std::max(0, requests.system[s].jog_feed) / 60.0;
    in_[s].manual_rapid = requests.system[s].rapid;
  }
  follow_ladder(requests);
}

// Cycle start acts on its falling edge, reset and modes on their rising edge, alarms while they are on. While reset is on nothing starts.
void Scan::follow_ladder(const LadderRequests& requests) noexcept {
  if (requests.cycle_start) {
    if (ladder_start_scans_ < kStartMinScans) ++ladder_start_scans_;
  } else {
    if (ladder_start_scans_ == kStartMinScans) {  // the start goes to the NC in the next scan
      const Answer answer = start_cycle(all_systems(), true, machine_asker());
      // For kDone start_cycle() has noted the result for each part system. A start button that is pressed while the program runs is not worth a note.
      if (answer != Answer::kDone && answer != Answer::kAlreadyRunning) settle(Asked::kCycleStart, answer, machine_asker());
    }
    ladder_start_scans_ = 0;
  }
  if (requests.reset && !last_requests_.reset) request_reset();
  for (unsigned s = 0; s < systems_; ++s) in_[s].reset = reset_phase_ == ResetPhase::kStopping;  // a reset wins over a start in the same scan
  unsigned modes = 0, chosen = 0;
  for (unsigned m = 0; m < 3; ++m) {
    if (!requests.mode[m]) continue;
    ++modes;
    chosen = m;
  }
  if (modes == 1 && !last_requests_.mode[chosen]) settle(Asked::kMode, set_mode(static_cast<Mode>(chosen)), machine_asker());
  for (unsigned n = 0; n < kLadderAlarms; ++n)
    if ((requests.alarm >> n & 1u) != 0 && !is_of_lost_link(n)) raise(AlarmId::kLadder, 0, -1, n);
  if (requests.stopped) raise(AlarmId::kLadderStopped, 0, -1, requests.stopped_line, requests.stopped_fault);
  watch_power(requests.power_fails);
  // Alarms that were raised above stop the machine already in this scan.
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned i = 0; i < alarms_.count; ++i) in_[s].alarm |= stops_the_nc(alarms_.alarm[i]);
  follow_ladder_manual(requests);
  for (unsigned s = 0; s < systems_; ++s) {
    const LadderRequests::System &now = requests.system[s], &before = last_requests_.system[s];
    skip_switches_[s].store(now.skip_switches, std::memory_order_relaxed);
    if (now.recalculate && !before.recalculate) recalculations_[s].fetch_add(1, std::memory_order_release);
    search_[s].follow(now.search, now.search_for);
    in_[s].recalculate = now.recalculate;  // for a program that runs; when it is stopped, the feeder recalculates
  }
  last_requests_ = requests;
}

// Only this function decides which override is in force. A switch of the machine wins, because the operator who stands beside the tool must be able to
// rely on it; a client elsewhere is told that its override has no effect. What a program sets for itself (#3004) is decided in libnc.
void Scan::decide_overrides(const LadderRequests& requests) noexcept {
  constexpr double kHundredth = 1e-4;  // 0.01 %
  for (unsigned s = 0; s < systems_; ++s) {
    const LadderRequests::System& asked = requests.system[s];
    feed_codes_[s] |= static_cast<bool>(asked.feed_code);
    const bool by_code = feed_codes_[s] && asked.feed_override == -1;
    machine_feeds_[s] = asked.feed_override != -1 || by_code;
    machine_rapids_[s] = asked.rapid_override != -1;
    if (by_code) in_[s].feed_override = std::min(share_of_code(asked.feed_code), config_.nc.max_feed_override);
    else if (machine_feeds_[s]) in_[s].feed_override = std::min(std::max(asked.feed_override, 0) * kHundredth, config_.nc.max_feed_override);
    if (machine_rapids_[s]) in_[s].rapid_override = std::min(std::max(asked.rapid_override, 0) * kHundredth, 1.0);
  }
}

// Sets an override of the operator. It is refused when switches of the machine are in force in all the part systems that are named.
Answer Scan::set_override(std::uint32_t systems, double value, double most, const bool* machines, double* operators) noexcept {
  if (!(value >= 0 && value <= most)) return Answer::kOutOfRange;
  bool acts = false;
  for (unsigned s = 0; s < systems_; ++s) acts |= (systems >> s & 1u) != 0 && !machines[s];
  if (!acts) return Answer::kMachineSwitch;
  for (unsigned s = 0; s < systems_; ++s)
    if ((systems >> s & 1u) != 0) operators[s] = value;
  return Answer::kDone;
}

void Scan::request_reset() noexcept {
  if (reset_phase_ == ResetPhase::kStopping || reset_phase_ == ResetPhase::kFeeder) return;
  reset_phase_ = ResetPhase::kStopping;
  reset_scans_ = 0;
  ask_to_set_back();
  for (unsigned i = 0; i < alarms_.count; ++i)  // the ladder program starts again; if the fault is still there, R17 comes back
    if (alarms_.alarm[i].id == AlarmId::kLadderStopped) ladder_->restart();
  acknowledge_alarms();  // an alarm whose cause is still there is raised again
}

}  // namespace nc::rt
