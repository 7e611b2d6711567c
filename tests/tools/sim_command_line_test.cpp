// SPDX-License-Identifier: Apache-2.0
// The words of a command line of ncsim become one command with all its options.
#include "tools/lib/sim_command_line.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nc::tools {
namespace {

using What = SimCommand::What;

SimCommand parsed(std::vector<const char*> words) {
  words.insert(words.begin(), "ncsim");
  SimCommand command;
  const auto status = parse_sim_command(static_cast<int>(words.size()), words.data(), &command);
  EXPECT_FALSE(status.has_value());
  return command;
}

// The exit status, and the text on standard error.
std::pair<int, std::string> refused(std::vector<const char*> words) {
  words.insert(words.begin(), "ncsim");
  SimCommand command;
  testing::internal::CaptureStderr();
  const auto status = parse_sim_command(static_cast<int>(words.size()), words.data(), &command);
  return {status.value_or(-1), testing::internal::GetCapturedStderr()};
}

TEST(SimCommandLine, EachSubcommandIsFound) {
  const std::pair<std::vector<const char*>, What> rows[] = {
      {{"trace", "p.nc"}, What::kTrace},
      {{"check", "p.nc"}, What::kCheck},
      {{"time", "p.nc"}, What::kTime},
      {{"motion", "p.nc"}, What::kMotion},
      {{"plot", "p.nc"}, What::kPlot},
      {{"plot", "p.nc", "--profile"}, What::kProfile},
      {{"dialects"}, What::kDialects},
      {{"functions"}, What::kFunctions},
      {{"alarms"}, What::kAlarms},
      {{"variables"}, What::kVariables},
      {{"variables", "--of", "p.nc"}, What::kVariableUse},
      {{"parameters"}, What::kParameters},
  };
  for (const auto& [words, what] : rows) EXPECT_EQ(parsed(words).what, what) << words[0];
}

TEST(SimCommandLine, ADialectOfTheCommandLineIsGiven) {
  EXPECT_FALSE(parsed({"trace", "p.nc"}).session.dialect_given);
  const SimCommand command = parsed({"time", "p.nc", "--dialect", "dgshape"});
  EXPECT_TRUE(command.session.dialect_given);
  EXPECT_EQ(command.session.dialect, "dgshape");
}

TEST(SimCommandLine, NamesOfOutputs) {
  EXPECT_EQ(parsed({"plot", "p.nc"}).output, "toolpath");
  EXPECT_EQ(parsed({"plot", "p.nc", "--profile"}).output, "profile");
  EXPECT_EQ(parsed({"plot", "p.nc", "-o", "a"}).output, "a");
  EXPECT_EQ(parsed({"motion", "p.nc"}).output, "") << "standard output";
}

TEST(SimCommandLine, OptionsOfAMachine) {
  const SimCommand command = parsed({"motion", "p.nc", "--machine", "m.toml", "--cycle-us", "0250", "--tolerance", "0.01", "--format", "F64", "--max-seconds", "7"});
  EXPECT_EQ(command.machine.machine, "m.toml");
  EXPECT_EQ(command.machine.cycle_us, 250u);
  EXPECT_EQ(command.machine.tolerance, 0.01);
  EXPECT_EQ(command.format, MotionFormat::kF64);
  EXPECT_EQ(command.limits.seconds, 7);
  EXPECT_EQ(command.session.machine, "") << "of the run alone";
  EXPECT_FALSE(parsed({"time", "p.nc"}).machine.cycle_us.has_value());
}

TEST(SimCommandLine, ThePlotOfAPathIsOfTheMachineToo) {
  EXPECT_EQ(parsed({"plot", "p.nc", "--machine", "m.toml"}).session.machine, "m.toml");
  EXPECT_EQ(parsed({"plot", "p.nc", "--machine", "m.toml", "--profile"}).session.machine, "");
}

TEST(SimCommandLine, HowAPathIsDrawn) {
  const SimCommand command = parsed({"plot", "p.nc", "--view", "xz", "--coordinates", "machine", "--color", "tool"});
  EXPECT_EQ(command.plot.view, PlotView::kXZ);
  EXPECT_EQ(command.plot.coordinates, PlotCoordinates::kMachine);
  EXPECT_EQ(command.plot.color, PlotColor::kTool);
}

TEST(SimCommandLine, MistakesAreASentence) {
  using Said = std::pair<int, std::string>;
  EXPECT_EQ(refused({"tracee", "p.nc"}), Said(1, "ncsim: there is no subcommand 'tracee' (ncsim --help)\n"));
  EXPECT_EQ(refused({"trace"}), Said(1, "ncsim: PROGRAM is required (ncsim --help)\n"));
  EXPECT_EQ(refused({}).first, 1);
  EXPECT_EQ(refused({"plot", "p.nc", "--cycle-us", "100"}).first, 1) << "is of --profile";
  EXPECT_EQ(refused({"variables", "--encoding", "utf-8"}).first, 1) << "is of --of";
}

}  // namespace
}  // namespace nc::tools
