// SPDX-License-Identifier: Apache-2.0
// A machine whose switches for trying a program (machine lock, dry run, auxiliary lock, FIN by group, codes of the feed override) are points, and what its
// drives are given in each scan.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/refusal.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "test_config.hpp"

namespace nc::test {

// The simulated machine, and the newest command that it was given.
class WatchedHal : public hal::Hal {
 public:
  WatchedHal(const hal::SimConfig& config, const hal::PointTable& table) : machine(config, table) {}
  bool start(const hal::PointImage& initial, std::string* error) override { return machine.start(initial, error); }
  void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override { machine.read(feedback, image); }
  void write(const hal::Command& command, const hal::PointImage& image) noexcept override {
    given = command;
    all.push_back(command.system[0]);
    machine.write(command, image);
  }
  void stop() noexcept override { machine.stop(); }
  hal::SimMachine machine;
  hal::Command given{};
  std::vector<hal::SystemCommand> all;  // of all scans, until somebody clears them: a command of the operator takes scans, too
};

class SwitchMachine : public testing::Test {
 protected:
  // A dot and a number behind a name would be a bit of a word in the ladder.
  static std::string point_of(std::string signal) {
    std::replace(signal.begin(), signal.end(), '.', '_');
    return signal;
  }
  static std::string switches() {
    std::string points, signals = "[signals]\n";
    const auto wire = [&](const char* signal, const char* type) {
      points += "[[point]]\nname = \"" + point_of(signal) + "\"\ntype = \"" + type + "\"\ndirection = \"input\"\n";
      signals += std::string("\"plc.") + signal + "\" = \"" + point_of(signal) + "\"\n";
    };
    for (const char* signal : {"machine_lock", "auxiliary_lock", "dry_run", "jog_rapid", "single_block", "mfin", "sfin", "tfin", "bfin"}) wire(signal, "bit");
    for (const char* signal : {"axis_lock.X", "axis_lock.Z", "feed_code.1", "feed_code.2", "feed_code.3", "feed_code.4", "feed_code.5", "skip.1", "jog_p.X", "jog_m.Y"}) wire(signal, "bit");
    for (const char* signal : {"jog_feed", "handle.Z"}) wire(signal, "word");
    return points + signals;
  }
  void build(const std::string& more = "", double start_x = 0, const char* on_from_the_start = nullptr) {
    std::string text = base_toml() + more + switches() + more_signals;
    text.insert(text.find("name = \"X\"\n"), "start = " + std::to_string(start_x) + "\n");
    if (on_from_the_start != nullptr) text.insert(text.find(std::string("name = \"") + on_from_the_start + "\"\n"), "initial = 1\n");
    runtime.reset();  // before the machine that it has
    config = parse_or_fail(text);
    config.ladder.fin_timeout_s = fin_timeout_s;
    hal = std::make_unique<WatchedHal>(config.sim, config.points);
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    steps(2);
  }
  void select(const std::string& source) {
    unsigned file = 0;
    const std::string& text = texts.emplace_back(source);
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), rt::Answer::kDone);
  }
  void start(const std::string& source) {
    select(source);
    ASSERT_EQ(runtime->execute(rt::CommandKind::kCycleStart), rt::Answer::kDone);
  }
  void turn(const std::string& signal, std::uint32_t value) {
    const int index = config.points.find(point_of(signal));
    ASSERT_GE(index, 0) << signal;
    hal->machine.set_input(static_cast<unsigned>(index), value);
  }
  void steps(int n) { steps_of(*runtime, n); }
  template <class Done>
  int until(Done done, int most = 20000) {
    for (int n = 0; n < most; ++n) {
      if (done()) return n;
      runtime->step();
    }
    return -1;
  }
  void until_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    EXPECT_GE(until([&] { return (runtime->info().system[0].runs > runs && out().state == NC_STATE_IDLE) || out().state == NC_STATE_ALARM; }), 0)
        << "cause " << int{out().cause};
    EXPECT_EQ(alarm(), "");
  }
  void reset() {
    ASSERT_EQ(runtime->execute(rt::CommandKind::kReset), rt::Answer::kDone);
    ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 3000), 0);
    steps(3);
  }
  rt::Answer ask(rt::CommandKind kind, unsigned axis = 0, double value = 0) {
    rt::Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    return runtime->execute(command);
  }
  rt::Answer mode(rt::Mode wanted) { return runtime->execute(rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(wanted)); }
  nc_outputs out() const { return runtime->snapshot().system[0].nc; }
  rt::AxisFlags flags() const { return runtime->snapshot().system[0].axes; }
  double counted(unsigned axis) const { return out().command.v[axis]; }
  double drive(unsigned axis) const { return hal->given.system[0].position.v[axis]; }  // what it is given
  std::string alarm() const {
    const rt::Snapshot now = runtime->snapshot();
    return now.alarms.count == 0 ? "" : runtime->alarm_text(now.alarms.alarm[0]);
  }

  double fin_timeout_s = 30;
  std::string more_signals;  // lines of [signals]
  rt::Config config;
  rt::VirtualClock clock;
  std::unique_ptr<WatchedHal> hal;
  std::unique_ptr<rt::Runtime> runtime;
  std::deque<std::string> texts;
};

}  // namespace nc::test
