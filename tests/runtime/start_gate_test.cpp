// SPDX-License-Identifier: Apache-2.0
// A start in the moment in which the program has just passed its check: the feeder has asked, and has not told the scan yet.
#include "runtime/start_gate.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "hal/sim/sim_machine.hpp"
#include "runtime/clock.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;

// Once the program has passed, the thread of the feeder loses the processor behind the question: that is when the start comes.
class SlowGate final : public StartGate {
 public:
  bool may_begin(unsigned, unsigned) override {
    asked = true;
    if (!passed) return false;
    told = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return true;
  }
  Looked look_again() override { return told ? Looked::kSame : Looked::kDoubtful; }
  bool waits(unsigned) override { return !told; }
  std::string remark(unsigned) override { return ""; }
  std::atomic<bool> passed = false, told = false, asked = false;
};

TEST(SlowGate, AStartRightBehindTheEndOfACheckBegins) {
  SlowGate gate;
  const Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::hal::SimMachine machine(config.sim, config.points);
  RealClock clock;
  std::vector<ConfigError> errors;
  const auto runtime = Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  const std::string text = "G0 X1.\nM30\n";
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "part.nc", text.data(), text.size(), &file), NC_OK);
  runtime->set_start_gate(&gate);
  std::string error;
  ASSERT_TRUE(runtime->start(&error)) << error;
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
  ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  while (!gate.asked) std::this_thread::yield();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kNotChecked);
  gate.passed = true;
  while (gate.waits(0)) std::this_thread::yield();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  runtime->stop();
}

}  // namespace
