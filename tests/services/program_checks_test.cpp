// SPDX-License-Identifier: Apache-2.0
// The queue of the checks by itself, with checks that end when the test says so.
#include "runtime/services/program_checks.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <semaphore>
#include <thread>

namespace nc::rt::services {
namespace {

constexpr auto kPatience = std::chrono::seconds(20);  // only a failure takes so long

class ProgramChecksAlone : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/nc_checks_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
    Config config;
    config.programs = folder_;
    config.nc.system_count = 1;
    checks_ = std::make_unique<ProgramChecks>(config, &programs_, [this](const CheckOrder& order, const std::atomic<bool>&) {
      CheckReport report;
      for (const std::string& path : {order.path, folder_ + "/O1000.nc"}) {
        report.files.push_back({path, {}});
        if (stat(path.c_str(), &report.files.back().info) != 0) report.files.pop_back();
      }
      std::string text;
      std::getline(std::ifstream(folder_ + "/O1000.nc"), text);
      report.state = text == "good" ? CheckState::kPassed : CheckState::kRefused;
      report.text = text;
      read_.release();
      go_on_.acquire();
      return report;
    });
    std::string error;
    ASSERT_TRUE(checks_->start(&error)) << error;
  }
  void TearDown() override {
    go_on_.release(100);
    checks_->stop();
    std::filesystem::remove_all(folder_);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ + "/." + name) << text << "\n";
    std::filesystem::rename(folder_ + "/." + name, folder_ + "/" + name);
  }
  CheckState settled() {
    CheckState state;
    while ((state = checks_->state("main.nc", 0)) == CheckState::kChecking) std::this_thread::yield();
    return state;
  }

  std::string folder_;
  share::ProgramTable programs_{NC_DIALECT_M700};
  std::unique_ptr<ProgramChecks> checks_;
  std::counting_semaphore<1000> read_{0}, go_on_{0};
};

// While a program is checked, the sub program that it calls is written anew, by the services or by somebody else, or comes at last: at no time is told what was found in the old one.
TEST_F(ProgramChecksAlone, WhatHasBeenWrittenMeanwhileIsReadAgain) {
  for (const bool known : {true, false})
    for (const char* before : {"bad", "good", ""})
      for (const char* after : {"bad", "good"}) {
        SCOPED_TRACE(std::string(before) + " -> " + after + (known ? ", known" : ", not known"));
        std::filesystem::remove(folder_ + "/O1000.nc");
        if (!known && *before == '\0') continue;  // who was not told of it finds it with the folder, which real checks have among their files
        write("main.nc", "M98 P1000");
        if (*before != '\0') write("O1000.nc", before);
        ASSERT_TRUE(checks_->order("main.nc", 0, 60));
        ASSERT_TRUE(read_.try_acquire_for(kPatience));
        write("O1000.nc", after);
        if (known) checks_->arrived("O1000.nc");
        go_on_.release();  // of what was read before
        go_on_.release(known ? 2 : 1);
        EXPECT_EQ(settled(), std::string(after) == "good" ? CheckState::kPassed : CheckState::kRefused);
        // The checks of this turn have ended: of the program, of it again, and of the sub program itself.
        for (int n = 0; n < (known ? 2 : 1); ++n) {
          ASSERT_TRUE(read_.try_acquire_for(kPatience));
        }
        while (checks_->state("O1000.nc", 0) == CheckState::kChecking) std::this_thread::yield();
        checks_->gone("O1000.nc");
      }
}

}  // namespace
}  // namespace nc::rt::services
