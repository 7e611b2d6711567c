// SPDX-License-Identifier: Apache-2.0
// MDI blocks call a program as its file is when they are entered; a part program keeps the files as they were when it was selected.
#include <gtest/gtest.h>

#include <fstream>

#include "hal/sim/sim_machine.hpp"
#include "own_folder.hpp"
#include "runtime/runtime.hpp"
#include "runtime/test_config.hpp"
#include "tools/lib/program_files.hpp"

namespace nc::tools {
namespace {

using rt::Answer;
using rt::CommandKind;
using rt::Mode;

class MdiPrograms : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    config_ = test::parse_or_fail(test::base_toml());
    machine_ = std::make_unique<hal::SimMachine>(config_.sim, config_.points);
    files_ = std::make_unique<ProgramFiles>(folder_);
    std::vector<rt::ConfigError> errors;
    runtime_ = rt::Runtime::create(config_, {&clock_, machine_.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime_, nullptr);
    files_->set_remembered([this](unsigned file) { return runtime_->remembers(file); });
    files_->attach(runtime_->control());
    runtime_->set_program_refresh([this] { files_->look_again(runtime_->control()); });
    runtime_->set_changed_programs([this] { return files_->changed(); });
    runtime_->set_program_loader([this](const std::string& name, unsigned* file, std::string* why) {
      return files_->add(runtime_->control(), folder_ + "/" + name, file, why) == NC_OK;
    });
    std::string error;
    ASSERT_TRUE(runtime_->start_stepping(&error)) << error;
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ + "/next") << text;
    std::filesystem::rename(folder_ + "/next", folder_ + "/" + name);
  }
  double run() {
    const std::uint64_t runs = runtime_->info().system[0].runs;
    EXPECT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
    for (unsigned n = 0; n < 20000 && runtime_->info().system[0].runs == runs; ++n) runtime_->step();
    for (unsigned n = 0; n < 5; ++n) runtime_->step();
    EXPECT_EQ(runtime_->info().system[0].runs, runs + 1);
    return runtime_->snapshot().system[0].nc.command.v[0];
  }
  void mode(Mode to) {
    ASSERT_EQ(runtime_->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(to)), Answer::kDone);
    for (unsigned n = 0; n < 5; ++n) runtime_->step();
  }

  rt::Config config_;
  rt::VirtualClock clock_;
  std::unique_ptr<hal::SimMachine> machine_;
  std::unique_ptr<ProgramFiles> files_;
  std::unique_ptr<rt::Runtime> runtime_;
};

TEST_F(MdiPrograms, CallWhatStandsInTheFileNow) {
  write("m.nc", "G90\nM98 P77\nM30\n");
  write("O77", "G1 X8. F6000\nM99\n");
  ASSERT_EQ(runtime_->select_program(0, "m.nc"), Answer::kDone);
  EXPECT_NEAR(run(), 8, 1e-9);
  mode(Mode::kMdi);
  write("O77", "G1 X11. F6000\nM99\n");
  ASSERT_EQ(runtime_->load_mdi("M98 P77\n"), Answer::kDone);
  EXPECT_NEAR(run(), 11, 1e-9) << "not what the part program has called";
  write("O77", "G1 X14. F6000\nM99\n");
  ASSERT_EQ(runtime_->load_mdi("M98 P77\n"), Answer::kDone);
  EXPECT_NEAR(run(), 14, 1e-9) << "nor what the blocks before have called";
  mode(Mode::kAuto);
  EXPECT_NEAR(run(), 14, 1e-9) << "the part program is there again";
}

// A restart without a new selection runs the program as it was selected, and a message, no alarm, names the files that have changed.
TEST_F(MdiPrograms, ARestartSaysWhichFileHasChanged) {
  write("m.nc", "G90\nM98 P77\nM30\n");
  write("O77", "G1 X8. F6000\nM99\n");
  ASSERT_EQ(runtime_->select_program(0, "m.nc"), Answer::kDone);
  EXPECT_NEAR(run(), 8, 1e-9);
  EXPECT_NEAR(run(), 8, 1e-9);
  EXPECT_EQ(runtime_->info().messages, 0u) << "nothing has changed";
  write("m.nc", "G90 G1 X1. F6000\nM30\n");
  EXPECT_NEAR(run(), 8, 1e-9);
  EXPECT_EQ(runtime_->info().messages, 1u);
  EXPECT_EQ(runtime_->info().said.back().text, "changed since it was selected, runs as it was then: m.nc");
  EXPECT_FALSE(runtime_->snapshot().alarmed());
  ASSERT_EQ(runtime_->select_program(0, "m.nc"), Answer::kDone);
  EXPECT_NEAR(run(), 1, 1e-9);
  EXPECT_EQ(runtime_->info().messages, 1u) << "selected anew";
  write("m.nc", "G90\nM98 P77\nM30\n");
  ASSERT_EQ(runtime_->select_program(0, "m.nc"), Answer::kDone);
  EXPECT_NEAR(run(), 8, 1e-9);
  write("O77", "G1 X9. F6000\nM99\n");
  EXPECT_NEAR(run(), 8, 1e-9);
  EXPECT_EQ(runtime_->info().messages, 2u);
  EXPECT_EQ(runtime_->info().said.back().text, "changed since it was selected, runs as it was then: O77") << "a sub program";
  std::filesystem::remove(folder_ + "/m.nc");
  std::filesystem::remove(folder_ + "/O77");
  EXPECT_NEAR(run(), 8, 1e-9);
  EXPECT_EQ(runtime_->info().messages, 3u) << "gone, too";
}

}  // namespace
}  // namespace nc::tools
