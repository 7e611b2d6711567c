// SPDX-License-Identifier: Apache-2.0
// docs/ladder.md lists exactly the instructions of the code, with the texts of the code. When this test fails its message
// has the expected table, which is to be copied between the markers of the file.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "ladder/ladder.hpp"
#include "places/places.hpp"
#include "rig.hpp"
#include "runtime/ladder_task.hpp"

namespace nc::ladder {
namespace {

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string table() {
  std::string out, group;
  for (const InstructionInfo& info : instruction_table()) {
    if (group != info.group) {
      group = info.group;
      out +=
          "\n### " + group + "\n\n| instruction | operands | effect | P form |\n| --- | --- | --- | --- |\n";
    }
    out += "| `" + std::string(info.name) + "` | " + escaped(info.operands) + " | " + escaped(info.summary) +
           " | " + (info.pulse ? "yes" : "") + " |\n";
  }
  return out;
}

std::string document() {
  std::ifstream file(nc::test::kSourceDir + "/docs/ladder.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(LadderDocument, ListsTheInstructionsOfTheCode) {
  const std::string text = document();
  const std::string begin = "<!-- instructions: made by the code -->\n",
                    end = "\n<!-- end of instructions -->";
  const std::size_t from = text.find(begin), to = text.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  const std::string written = text.substr(from + begin.size(), to - from - begin.size()), expected = table();
  std::istringstream left(written), right(expected);
  for (std::string l, r; std::getline(right, r); l.clear()) {
    std::getline(left, l);
    ASSERT_EQ(l, r) << "the whole table:\n" << expected;
  }
  EXPECT_EQ(written, expected);
}

TEST(LadderDocument, ItsExamplesCompile) {
  const std::string text = document();
  unsigned examples = 0;
  for (std::size_t at = 0; (at = text.find("```il\n", at)) != std::string::npos; ++examples) {
    at += 6;
    const std::string example = text.substr(at, text.find("```", at) - at);
    Program program;
    std::vector<Error> errors;
    if (examples == 0) continue;  // the example for the shipped machine is tested below
    EXPECT_TRUE(compile(example, "ladder.md", test_table(), {}, &program, &errors))
        << all_text(errors) << example;
  }
  EXPECT_GE(examples, 3u);
}

// The first example is for the shipped machine, which has its devices.
TEST(LadderDocument, TheFirstExampleIsOfTheShippedMachine) {
  nc::rt::Config config;
  for (const nc::rt::ConfigError& error : nc::rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config))
    FAIL() << error.text();
  std::vector<nc::rt::ConfigError> wrong;
  const DeviceTable table = nc::rt::LadderTask::device_table(config, &wrong);
  ASSERT_TRUE(wrong.empty());
  const std::string text = document();
  const std::size_t at = text.find("```il\n") + 6;
  const std::string example = text.substr(at, text.find("```", at) - at);
  Program program;
  std::vector<Error> errors;
  EXPECT_TRUE(compile(example, "ladder.md", table, {}, &program, &errors)) << all_text(errors) << example;
  EXPECT_TRUE(program.warnings().empty());
}

TEST(LadderInstructions, EachNameOnceAndEachCompiles) {
  std::set<std::string> names;
  for (const InstructionInfo& info : instruction_table()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_STRNE(info.summary, "") << info.name;
    // For an existing instruction the engine complains only about its operands when there are too many of them.
    for (const char* p : {"", "P"}) {
      const std::vector<Error> errors = errors_of("LD X0\n" + std::string(info.name) + p + " a b c d e\n");
      const std::string text = all_text(errors);
      const bool known = text.find("no such instruction") == std::string::npos;
      const bool another = names.count(std::string(info.name) + p) != 0 ||
                           std::string(info.name) + p == "LDP" || std::string(info.name) + p == "ANDP" ||
                           std::string(info.name) + p == "ORP";
      EXPECT_EQ(known, *p == '\0' || info.pulse || another) << info.name << p;
    }
  }
  EXPECT_GT(names.size(), 100u);
}

}  // namespace
}  // namespace nc::ladder
