// SPDX-License-Identifier: Apache-2.0
// Real programs of other controls in `ncsim trace`: they come to their end, or stop with the right alarm in the right
// line.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "own_folder.hpp"
#include "places/places.hpp"

namespace nc::tools {
namespace {

using Json = nlohmann::json;

struct Trace {
  int code = -1;
  size_t moves = 0, blocks = 0;
  Json alarm, end;
};

class SharedPrograms : public OwnFolder {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(programs_)) GTEST_SKIP() << programs_ << " is not here";
    OwnFolder::SetUp();
    // Words without a point mean whole units in these programs.
    std::ofstream(folder_ + "/s.json") << R"({"params": {"1078": 1}})";
  }

  Trace trace(const std::string& name) { return trace_with(" --setup " + folder_ + "/s.json ", name); }
  Trace trace_with(const std::string& options, const std::string& name) {
    const std::string command = nc::test::kBinaryDir + "/bin/ncsim trace" + options + programs_ +
                                "/" + name + " > " + folder_ + "/out.jsonl";
    const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
    Trace result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::ifstream lines(folder_ + "/out.jsonl");
    for (std::string line; std::getline(lines, line);) {
      const Json event = Json::parse(line);
      result.moves += event["t"] == "move";
      result.blocks += event["t"] == "block";
      if (event["t"] == "alarm") result.alarm = event;
      if (event["t"] == "end") result.end = event;
    }
    return result;
  }

  // Number of the first line of a program that contains `what`.
  unsigned line_of(const std::string& name, const std::string& what) {
    std::ifstream lines(programs_ + "/" + name);
    unsigned number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (line.find(what) != std::string::npos) return number;
    }
    return 0;
  }

  const std::string programs_ = nc::test::kSharedDir + "/programs";
};

TEST_F(SharedPrograms, ProgramsOfRs274RunAsTheyAre) {
  const struct {
    const char* name;
    size_t moves;
  } programs[] = {{"3D_Chips.ngc", 4'684},  {"arcspiral.ngc", 1'003}, {"botomata_bottom.nc", 6'031},
                  {"compass.ngc", 2'996}, {"flower_mold.nc", 16'557}, {"tort.ngc", 268}};
  for (const auto& p : programs) {
    const Trace run = trace_with(" --dialect iso ", p.name);
    EXPECT_EQ(run.code, 0) << p.name << ": " << run.alarm;
    EXPECT_EQ(run.moves, p.moves) << p.name;
  }
}

TEST_F(SharedPrograms, ProgramsThatTheControlHasAllWordsForRunToTheirEnd) {
  const struct {
    const char* name;
    size_t least_moves;
  } programs[] = {
      {"flower_mold.nc", 16'000}, {"botomata_bottom.nc", 1'000}, {"arcspiral.ngc", 300}, {"tort.ngc", 100}};
  for (const auto& p : programs) {
    const Trace run = trace(p.name);
    EXPECT_EQ(run.code, 0) << p.name << ": " << run.alarm;
    ASSERT_TRUE(run.end.is_object()) << p.name;
    EXPECT_EQ(run.end["ok"], true) << p.name << ": " << run.alarm;
    EXPECT_GE(run.moves, p.least_moves) << p.name;
  }
}

TEST_F(SharedPrograms, AProgramThatEndsWithoutM30IsP36OnItsLastLine) {
  const Trace run = trace("compass.ngc");
  EXPECT_EQ(run.code, 2);
  ASSERT_TRUE(run.alarm.is_object());
  EXPECT_EQ(run.alarm["code"], "P36") << run.alarm;
  EXPECT_EQ(run.alarm["line"], line_of("compass.ngc", "%")) << run.alarm;
  EXPECT_GE(run.moves, 2'900u);
}

TEST_F(SharedPrograms, NamedParametersAreAnAlarmOnTheirFirstLine) {
  const Trace run = trace("3D_Chips.ngc");
  EXPECT_EQ(run.code, 2);
  ASSERT_TRUE(run.alarm.is_object());
  EXPECT_EQ(run.alarm["line"], line_of("3D_Chips.ngc", "#<")) << run.alarm;
  EXPECT_FALSE(run.alarm["detail"].get<std::string>().empty());
  EXPECT_EQ(run.end["ok"], false);
}

}  // namespace
}  // namespace nc::tools
