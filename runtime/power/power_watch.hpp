// SPDX-License-Identifier: Apache-2.0
// What the control does when the supply says that it fails (plc.power_fail_n = 0), as steps in time.
//
//   good ─▶ (the input has been off for delay_s in all) ─▶ stopping: all paths come to rest, retained data are written
//   stopping ─▶ (at rest, or stop_s is over) ─▶ closing: drives off behind their brakes, retained data are written once more
//   closing ─▶ (brakes closed, data written) ─▶ done ─▶ (the input has been on for settle_s in a row, and a reset) ─▶ good
//
// The input may chatter: what it was off counts up over its edges, so that a contact that flutters trips as one that is off does, and nothing is good again
// before it has been on for a while without an edge. docs/safety.md.
#pragma once

#include <cstdint>

namespace nc::rt {

// How a request to write the retained data at once has ended.
enum class SaveResult : std::uint8_t { kSaved, kNotSaved, kNothingKept };

// Section [power].
struct PowerConfig {
  double stop_s = 1;    // time within which the axes come to rest on their paths; then the drives go off
  double delay_s = 0;   // so long the input may be off, in all, before that counts
  double settle_s = 1;  // so long it must be on in a row before it counts as good again
};

// Bits of the detail of alarm R24. 0: what is to be done is being done.
enum PowerDetail : std::uint32_t {
  kPowerDone = 1,         // everything is done; the alarm's code has the times (power_times())
  kPowerLate = 2,         // the axes were not at rest in time, and the drives went off
  kPowerNotSaved = 4,     // retained data could not be written
  kPowerNothingKept = 8,  // the configuration names no file of retained data
  kPowerBrakes = 16       // brakes have closed
};

class PowerWatch {
 public:
  enum class Phase : std::uint8_t { kGood, kStopping, kClosing, kDone };
  struct Seen {
    bool fails = false;          // the input
    bool at_rest = false;        // no axis is commanded to move
    bool braked = false;         // every axis that has a brake is held by it
    bool saved = false;          // the last request to write has been answered ...
    SaveResult result = SaveResult::kSaved;  // ... in this way
    bool acknowledged = false;   // the alarm is not there any more
    double cycle_s = 0.001;
  };

  void create(const PowerConfig& config, bool has_brakes) noexcept {
    config_ = config;
    has_brakes_ = has_brakes;
  }
  // What the caller is to do now.
  struct Wish {
    bool raise = false;  // the alarm is new, or has another detail
    bool save = false;   // the retained data are to be written at once
  };
  Wish step(const Seen& seen) noexcept;

  Phase phase() const noexcept { return phase_; }
  bool failed() const noexcept { return phase_ != Phase::kGood; }
  bool drives_off() const noexcept { return phase_ == Phase::kClosing || phase_ == Phase::kDone; }
  std::uint32_t detail() const noexcept { return phase_ == Phase::kDone ? detail_ : 0; }
  // Milliseconds until the axes were at rest (low half) and until everything was written (high half).
  std::uint32_t times() const noexcept { return phase_ == Phase::kDone ? rest_ms_ | saved_ms_ << 16 : 0; }

 private:
  std::uint32_t now_ms() const noexcept;

  PowerConfig config_;
  bool has_brakes_ = false;
  Phase phase_ = Phase::kGood;
  double off_s_ = 0, on_s_ = 0;  // the input was off in all, and has been on in a row
  double since_s_ = 0;           // since it has failed
  std::uint32_t detail_ = 0, rest_ms_ = 0, saved_ms_ = 0;
};

}  // namespace nc::rt
