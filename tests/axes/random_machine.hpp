// SPDX-License-Identifier: Apache-2.0
// A machine for random operators and random causes of docs/safety.md: its dice, what is held for so many scans (inputs, jogs, faults of drives), and what holds in every scan, whatever
// anybody does: a brake is open only where its drive holds, and the drive goes off only behind the brake.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "axes_machine.hpp"
#include "support/seeds.hpp"

namespace nc::test {

// Input points that are on at rest, and those that are off.
inline std::string input_points(std::initializer_list<const char*> on, std::initializer_list<const char*> off) {
  std::string text;
  for (const char* name : on) text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\ninitial = 1\n";
  for (const char* name : off) text += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\n";
  return text;
}

class RandomMachine : public AxesMachine {
 protected:
  static constexpr unsigned kMostSystems = 2, kMostAxes = 3;
  static constexpr int kStopScans = 1500;

  // What differs: the machine at the beginning of a seed, what an operator does at once, what goes wrong, and what is looked at behind a scan.
  virtual void begin() = 0;
  virtual void operate() = 0;
  virtual void cause() = 0;
  virtual void look() = 0;

  // Each seed is a new machine, for so many turns of one scan or of one thing that an operator does.
  void run_seeds(std::uint64_t first, std::uint64_t seeds, unsigned turns) {
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      random.seed(static_cast<std::mt19937::result_type>(seed));
      forget();
      ASSERT_NO_FATAL_FAILURE(begin());
      scan_ = runtime->snapshot().scan;
      for (unsigned n = 0; n < turns; ++n) {
        SCOPED_TRACE(n);
        turn(n);
        if (HasFatalFailure()) std::printf("seed %u turn %u: %s\n", static_cast<unsigned>(seed), n, alarm().c_str());
        if (HasFatalFailure()) return;
      }
    }
  }
  void scan() {
    go_on();
    runtime->step();
    if (!HasFatalFailure()) look();
  }

  // ---- the operator ----

  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }
  double either_way(double value) { return below(2) == 0 ? value : -value; }
  rt::Answer give(rt::CommandKind kind, unsigned system = 0, unsigned axis = 0, double value = 0, std::uint32_t number = 0) {
    rt::Command command;
    command.kind = kind;
    command.system = static_cast<std::uint8_t>(system);
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    command.number = number;
    const rt::Answer answer = runtime->execute(command);
    if (log_) std::printf("  %u: kind %u axis %u value %g number %u: %s\n", system, static_cast<unsigned>(kind), axis, value, number, rt::answer_text(answer));
    return answer;
  }
  rt::Answer mode(rt::Mode to) { return give(rt::CommandKind::kSetMode, 0, 0, 0, static_cast<std::uint32_t>(to)); }
  // Of what moves something: from now on it may.
  void asked(rt::Answer answer) { quiet_ &= answer != rt::Answer::kDone; }
  void press(const char* name, unsigned scans = 4) { hold(name, 1, scans); }
  void hold(const char* name, std::uint32_t value, unsigned scans) {
    if (log_) std::printf("  %s = %u for %u\n", name, value, scans);
    in(name, value);
    held_.push_back({name, value == 0 ? 1u : 0u, scans});
  }

  // ---- what is looked at ----

  // The vertical axis of a part system. `scans`: since it was looked at last; a command takes some, too.
  void look_at_brake(unsigned s, unsigned z, const hal::SystemCommand& given, const nc_outputs& nc, bool open, int close, int scans) {
    const bool on = given.enable && (given.off >> z & 1u) == 0, failed = drive_[s][z] > 0 || bus_ > 0;
    Brake& brake = brake_[s];
    brake.since_fault = failed ? 0 : brake.since_fault + scans;
    const bool fault = failed || brake.since_fault < 5;
    ASSERT_TRUE(!open || on || fault) << "the brake is open, and the drive does not hold";
    brake.closed_for = open ? 0 : brake.closed_for + scans;
    ASSERT_TRUE(!brake.was_on || on || fault || brake.closed_for >= close) << "the drive has gone off " << brake.closed_for << " scans behind the brake";
    brake.was_on = on;
    ASSERT_TRUE(nc.velocity.v[z] == 0 || open || !on || nc.followed || brake.closed_for <= close) << "Z is led against its brake";
  }
  int scans_since(const rt::Snapshot& now) {
    const auto scans = static_cast<int>(now.scan - scan_);
    scan_ = now.scan;
    return scans;
  }

  struct HeldJog {
    unsigned system = 0, axis = 0;
    double velocity = 0;
    unsigned left = 0;
  };
  std::mt19937 random;
  std::vector<std::string> moving_buttons;  // they move something as long as they are held
  HeldJog jog_;
  std::array<std::array<unsigned, kMostAxes>, kMostSystems> drive_{};  // so many scans a drive is in fault
  std::array<unsigned, kMostSystems> blocked_{};                        // and X is blocked
  unsigned bus_ = 0;                                                    // and the bus is lost
  bool quiet_ = false;  // nobody has asked for motion since everything was stopped
  int stopped_for_ = 0;
  const bool log_ = wish("NC_LOG", 0) != 0;

 private:
  struct Held {
    const char* name;
    std::uint32_t back;
    unsigned scans;
  };
  struct Brake {
    bool was_on = false;
    int since_fault = 100, closed_for = 0;
  };

  void forget() {
    held_.clear();
    jog_ = {};
    for (auto& system : drive_) system = {};
    blocked_ = {};
    bus_ = 0;
    brake_ = {};
    quiet_ = false;
    stopped_for_ = 0;
  }
  // Quiet times between the troubles, or nothing would come to its end.
  void turn(unsigned n) {
    const unsigned busy = n / 3000 % 3 == 2 ? 4000 : 150;
    if (below(busy) == 0) operate();
    if (below(8 * busy) == 0) {
      cause();
      if (below(3) == 0) cause();
    }
    if (!HasFatalFailure()) scan();
  }
  void go_on() {
    if (jog_.left > 0 && --jog_.left % 50 == 0) asked(give(rt::CommandKind::kJog, jog_.system, jog_.axis, jog_.left == 0 ? 0 : jog_.velocity));
    for (unsigned s = 0; s < config.nc.system_count; ++s) {
      for (unsigned a = 0; a < config.nc.system[s].axis_count; ++a)
        if (drive_[s][a] > 0) machine->fail_drive(s, a, --drive_[s][a] > 0);
      if (blocked_[s] > 0) machine->block_axis(s, kX, --blocked_[s] > 0);
    }
    if (bus_ > 0) machine->fail_bus(--bus_ > 0);
    for (std::size_t n = 0; n < held_.size();) {
      if (--held_[n].scans > 0) {
        ++n;
        continue;
      }
      in(held_[n].name, held_[n].back);
      quiet_ &= std::string(held_[n].name) != "start";  // a start acts when its button is let go
      held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(n));
    }
    for (const Held& each : held_) quiet_ &= std::find(moving_buttons.begin(), moving_buttons.end(), each.name) == moving_buttons.end();
  }

  std::vector<Held> held_;
  std::array<Brake, kMostSystems> brake_{};
  std::uint64_t scan_ = 0;
};

}  // namespace nc::test
