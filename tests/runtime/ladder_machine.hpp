// SPDX-License-Identifier: Apache-2.0
// The shipped machine with its ladder program, and a small machine with a ladder program of the test, on virtual time.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <deque>
#include <memory>
#include <string>

#include "hal/sim/sim_machine.hpp"
#include "places/places.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "test_config.hpp"

namespace nc::test {

class LadderMachine : public testing::Test {
 protected:
  void SetUp() override {
    const auto errors = rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config);
    ASSERT_TRUE(errors.empty()) << errors[0].text();
  }
  void build() {
    machine = std::make_unique<hal::SimMachine>(config.sim, config.points);
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void start(const std::string& source) {
    if (runtime == nullptr) build();
    unsigned file = 0;
    const std::string& text = texts.emplace_back(source);
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), rt::Answer::kDone);
    ASSERT_EQ(runtime->execute(rt::CommandKind::kCycleStart), rt::Answer::kDone);
  }
  nc_outputs out() const { return runtime->snapshot().system[0].nc; }
  std::uint32_t point(const char* name) const {
    const int index = config.points.find(name);
    EXPECT_GE(index, 0) << name;
    const bool output = config.points.at(static_cast<unsigned>(index)).direction == hal::PointDirection::kOutput;
    return output ? machine->outputs().value[index] : machine->input(static_cast<unsigned>(index));
  }
  // Steps until `done` returns true; returns the number of scans, or -1 after `most` of them (two minutes of the machine).
  template <class Done>
  int until(Done done, int most = 120000) {
    for (int n = 0; n < most; ++n) {
      if (done()) return n;
      runtime->step();
    }
    return -1;
  }
  int until_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    return until([&] { return runtime->info().system[0].runs > runs && out().state == NC_STATE_IDLE; });
  }
  int until_line(std::uint32_t line) {
    return until([&] { return out().source.line == line; });
  }
  std::string alarm() const {
    const rt::Snapshot now = runtime->snapshot();
    return now.alarms.count == 0 ? "" : runtime->alarm_text(now.alarms.alarm[0]);
  }

  rt::Config config;
  rt::VirtualClock clock;
  std::unique_ptr<hal::SimMachine> machine;
  std::unique_ptr<rt::Runtime> runtime;
  std::deque<std::string> texts;
};

class OwnLadder : public LadderMachine {
 protected:
  void use(const std::string& text) {
    config = parse_or_fail(base_toml() + "[ladder]\nprogram = \"own.il\"\n");
    const std::string folder = testing::TempDir();
    path_ = folder + "nc_own_ladder_" + std::to_string(getpid()) + ".il";
    FILE* file = std::fopen(path_.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fwrite(text.data(), 1, text.size(), file);
    std::fclose(file);
    config.ladder.program = path_;
  }
  void TearDown() override {
    if (!path_.empty()) std::remove(path_.c_str());
  }
  // Sets an input point of the machine.
  void in(const char* name, std::uint32_t value) {
    machine->set_input(static_cast<unsigned>(config.points.find(name)), value);
  }
  void steps(int n) { steps_of(*runtime, n); }
  double variable(std::uint32_t number) const { return variable_of(*runtime, number, -1e9); }
  std::int32_t device(const char* name) const {
    const ladder::Device* found = runtime->ladder()->engine().find(name);
    EXPECT_NE(found, nullptr) << name;
    const ladder::DeviceImage& image = runtime->ladder()->devices();
    return found->type == ladder::DeviceType::kBit      ? image.bit[found->index]
           : found->type == ladder::DeviceType::kWord16 ? image.word[found->index]
                                                        : image.word32(found->index);
  }
  std::string path_;
};

}  // namespace nc::test
