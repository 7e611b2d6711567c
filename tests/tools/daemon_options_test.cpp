// SPDX-License-Identifier: Apache-2.0
// Options of ncrtd that contradict each other, and the option for another dialect than the configured one.
#include "tools/lib/daemon_options.hpp"

#include <gtest/gtest.h>

#include "tools/lib/output_check.hpp"

namespace nc::tools {
namespace {

using Command = DaemonOptions::Command;

TEST(DaemonOptions, CommandsAreForRealTime) {
  DaemonOptions options;
  options.command = Command::kRun;
  options.commands = options.fast = true;
  options.share = "mill";
  EXPECT_NE(conflict_of(options, {}).find("not for --fast"), std::string::npos);
  options.fast = false;
  EXPECT_EQ(conflict_of(options, {}), "");
}

TEST(DaemonOptions, CommandsNeedSharedMemory) {
  rt::Config config;
  DaemonOptions options;
  options.command = Command::kRun;
  options.commands = true;
  EXPECT_NE(conflict_of(options, config).find("needs shared memory"), std::string::npos);
  options.command = Command::kServe;  // has shared memory in any case
  EXPECT_EQ(conflict_of(options, config), "");
  options.command = Command::kMdi;
  config.share.enabled = true;
  EXPECT_EQ(conflict_of(options, config), "");
}

// What the configuration asks for in vain has its place there; where the machine is served, or only checked, it is not in vain.
TEST(DaemonOptions, CommandsOfTheConfigurationNeedSharedMemory) {
  rt::Config config;
  config.file = "m.toml";
  config.share.commands = true;
  config.share.commands_place = {7, "share.commands"};
  DaemonOptions options;
  for (const Command command : {Command::kCheck, Command::kServe}) {
    options.command = command;
    EXPECT_EQ(conflict_of(options, config), "");
  }
  for (const Command command : {Command::kRun, Command::kMdi}) {
    options.command = command;
    options.fast = false;
    EXPECT_EQ(conflict_of(options, config).find("m.toml:7: share.commands: needs shared memory"), 0u) << conflict_of(options, config);
    options.fast = true;
    EXPECT_EQ(conflict_of(options, config), "") << "takes no commands";
  }
  options.fast = false;
  config.share.enabled = true;
  EXPECT_EQ(conflict_of(options, config), "");
}

TEST(DaemonOptions, NothingAskedIsNoConflict) {
  DaemonOptions options;
  options.fast = true;
  EXPECT_EQ(conflict_of(options, {}), "");
}

TEST(DaemonOptions, AnotherDialectLeavesTheParametersOut) {
  rt::Config config;
  config.parameters.push_back({});
  EXPECT_FALSE(change_dialect("m700", &config)) << "the configured one";
  EXPECT_EQ(config.parameters.size(), 1u);
  EXPECT_TRUE(change_dialect("dgshape", &config));
  EXPECT_TRUE(config.parameters.empty());
  EXPECT_EQ(config.nc.dialect, config.sim.dialect);
  EXPECT_STREQ(nc_dialect_name(static_cast<nc_dialect>(config.nc.dialect)), "dgshape");
  EXPECT_FALSE(change_dialect("m700", &config)) << "there are none to leave out";
}

TEST(OutputCheck, AStatusStandsWhenEverythingWasWritten) {
  EXPECT_EQ(status_when_written("test", 0), 0);
  EXPECT_EQ(status_when_written("test", 130), 130);
}

}  // namespace
}  // namespace nc::tools
