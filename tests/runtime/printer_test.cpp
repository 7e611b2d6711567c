// SPDX-License-Identifier: Apache-2.0
// A printed line that cannot be written is reported to everybody who watches the control (P460, M700 appendix 1).
#include <gtest/gtest.h>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

class Printing : public testing::Test {
 protected:
  void SetUp() override {
    config = nc::test::parse_or_fail(nc::test::base_toml());
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    runtime->set_printer([this](const nc_text& text) {
      printed += text.s;
      return trouble;
    });
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", kProgram.data(), kProgram.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  }
  void run() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    for (unsigned n = 0; n < 20000 && runtime->info().system[0].runs == runs; ++n) runtime->step();
    ASSERT_EQ(runtime->info().system[0].runs, runs + 1) << "the program comes to its end";
    for (unsigned n = 0; n < 5; ++n) runtime->step();
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned n = 0; n < 3000 && runtime->snapshot().resetting; ++n) runtime->step();
  }
  const std::string kProgram = "POPEN\nDPRNT[FIRST]\nG1 X5. F6000\nDPRNT[SECOND]\nG1 X10.\nPCLOS\nM30\n";
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<nc::hal::SimMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::string trouble, printed;
};

TEST_F(Printing, NothingIsToldOfWhatArrives) {
  run();
  EXPECT_NE(printed.find("FIRST"), std::string::npos);
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
}

TEST_F(Printing, ALineThatIsLostIsAWarning) {
  trouble = "out.txt: No space left on device";
  run();
  EXPECT_NEAR(runtime->snapshot().system[0].nc.command.v[0], 10, 1e-9);
  nc::rt::AlarmList alarms = runtime->snapshot().alarms;
  ASSERT_EQ(alarms.count, 1u) << "one for all of its lines";
  EXPECT_EQ(runtime->alarm_text(alarms.alarm[0]), "P460 Tape I/O error: lines of the external output are lost: out.txt: No space left on device");
  EXPECT_TRUE(nc::rt::is_warning(alarms.alarm[0].id));
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive);
  reset();
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
  trouble = "out.txt: Input/output error";
  run();
  alarms = runtime->snapshot().alarms;
  ASSERT_EQ(alarms.count, 1u) << "it is so again";
  EXPECT_NE(runtime->alarm_text(alarms.alarm[0]).find("Input/output error"), std::string::npos) << "for the reason of now";
  reset();
  trouble.clear();
  run();
  EXPECT_EQ(runtime->snapshot().alarms.count, 0u);
}

}  // namespace
