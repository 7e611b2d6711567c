// SPDX-License-Identifier: Apache-2.0
// The speed of a spindle comes from what is bound to it: the simulation, a point, or nothing. Without it a function that needs it waits and
// says why.
#include <gtest/gtest.h>

#include <algorithm>

#include "hal/sim/sim_machine.hpp"
#include "runtime/console.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

constexpr char kLink[] = R"([[modbus]]
name = "vfd"
host = "127.0.0.1"
[[point]]
name = "vfd_speed"
type = "word"
direction = "output"
modbus = { link = "vfd", table = "holding", address = 1 }
)";

class SpindleFeedback : public testing::Test {
 protected:
  void build(const std::string& more, const std::string& program) {
    runtime.reset();  // it refers to the others
    config = nc::test::parse_or_fail(nc::test::base_toml() + more);
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    text = program;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "a.nc", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    steps(1500);
  }
  void steps(unsigned count) {
    for (unsigned n = 0; n < count; ++n) runtime->step();
  }
  nc::rt::SystemSnapshot now() const { return runtime->snapshot().system[0]; }
  bool warned() const {
    const std::vector<std::string> all = runtime->warnings();
    return std::any_of(all.begin(), all.end(), [](const std::string& w) { return w.find("nothing measures spindle 1") != std::string::npos; });
  }
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<nc::hal::SimMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::string text;
};

TEST_F(SpindleFeedback, NothingIsInventedOnAMachineWithABus) {
  for (const char* more : {kLink, "[[spindle]]\nfeedback = \"none\"\n"}) {
    for (const char* program : {"S3000 M3\nG95 G1 X50. F0.5\nM30\n", "S3000 M3\nG33 Z-5. F1.\nM30\n"}) {
      SCOPED_TRACE(std::string(more) + program);
      ASSERT_NO_FATAL_FAILURE(build(more, program));
      EXPECT_TRUE(warned());
      EXPECT_EQ(now().nc.state, NC_STATE_RUNNING);
      EXPECT_EQ(now().nc.command.v[0], 0);
      EXPECT_EQ(now().nc.command.v[2], 0);
      EXPECT_EQ(now().nc.cause, NC_CAUSE_SPINDLE_UNMEASURED) << unsigned{now().nc.cause};
      EXPECT_EQ(nc::rt::state_text(now().nc), "105 spindle speed not measured");
      EXPECT_EQ(now().shown_spindle().rev_per_s, 0);
      EXPECT_TRUE(now().shown_spindle().unmeasured);
    }
  }
}

TEST_F(SpindleFeedback, TheSimulationWhereItIsOne) {
  for (const std::string& more : {std::string(), std::string(kLink) + "[[spindle]]\nfeedback = \"simulated\"\n"}) {
    ASSERT_NO_FATAL_FAILURE(build(more, "S3000 M3\nG95 G1 X400. F0.5\nM30\n"));
    EXPECT_FALSE(warned());
    EXPECT_NEAR(now().nc.feed_mm_min, 1500, 1);
    EXPECT_NEAR(now().shown_spindle().rev_per_s * 60, 3000, 1);
  }
}

TEST_F(SpindleFeedback, APointGivesTheSpeed) {
  build("[[spindle]]\nfeedback = \"word_in\"\nrpm_per_count = 0.1\n", "S3000 M3\nG95 G1 X400. F0.5\nM30\n");
  EXPECT_FALSE(warned());
  EXPECT_EQ(now().nc.cause, NC_CAUSE_SPINDLE_STOPPED);  // the spindle was told to turn, and does not
  EXPECT_EQ(now().nc.command.v[0], 0);
  const unsigned point = static_cast<unsigned>(config.points.find("word_in"));
  machine->set_input(point, 20000);
  steps(500);
  EXPECT_NEAR(now().nc.feed_mm_min, 1000, 1);
  EXPECT_NEAR(now().shown_spindle().rev_per_s * 60, 2000, 1e-6);
  machine->set_input(point, static_cast<std::uint32_t>(-10000));  // M04
  steps(500);
  EXPECT_NEAR(now().nc.feed_mm_min, 500, 1);
  EXPECT_NEAR(now().shown_spindle().rev_per_s * 60, -1000, 1e-6);
}

// A thread is not begun while the spindle turns the wrong way. It is begun where that cannot be known, because the speed has no sign, or
// because neither M03 nor M04 has commanded a direction.
TEST_F(SpindleFeedback, AThreadWaitsForASpindleThatTurnsTheWrongWay) {
  struct Case {
    const char* code;
    std::uint32_t counts;
    const char* more;
    bool waits;
  };
  const auto reversed = static_cast<std::uint32_t>(-6000);
  for (const Case& c : {Case{"M3", 6000, "", false}, Case{"M3", reversed, "", true}, Case{"M4", 6000, "", true}, Case{"M4", reversed, "", false},
                        Case{"M4", 6000, "signed = false\n", false}, Case{"M3", reversed, "signed = true\n", true}, Case{"M7", reversed, "", false}}) {
    SCOPED_TRACE(std::string(c.code) + " " + std::to_string(static_cast<std::int32_t>(c.counts)) + " " + c.more);
    ASSERT_NO_FATAL_FAILURE(build("[[spindle]]\nfeedback = \"word_in\"\nrpm_per_count = 0.1\n" + std::string(c.more),
                                  ("S600 " + std::string(c.code) + "\nG33 Z-5. F1.\nM30\n").c_str()));
    machine->set_input(static_cast<unsigned>(config.points.find("word_in")), c.counts);
    steps(8000);
    EXPECT_EQ(now().nc.cause == NC_CAUSE_SPINDLE_REVERSED, c.waits);
    EXPECT_NEAR(now().nc.command.v[2], c.waits ? 0 : -5, 1e-9) << nc::rt::state_text(now().nc);
    if (!c.waits) continue;
    EXPECT_EQ(nc::rt::state_text(now().nc), "thread waits: spindle turns the other way round");
    machine->set_input(static_cast<unsigned>(config.points.find("word_in")), -c.counts);
    steps(8000);
    EXPECT_NEAR(now().nc.command.v[2], -5, 1e-9);
  }
}

TEST(SpindleFeedbackConfig, Mistakes) {
  const auto error_of = [](const std::string& more) {
    nc::rt::Config config;
    const std::vector<nc::rt::ConfigError> errors = nc::rt::parse_config(nc::test::base_toml() + more, "t.toml", &config);
    return errors.empty() ? std::string() : errors[0].key + ": " + errors[0].message;
  };
  EXPECT_NE(error_of("[[spindle]]\nnumber = 1\n").find("feedback"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"word_im\"\n").find("no point is named \"word_im\""), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"in0\"\n").find("must be an input and a word"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"word_out\"\n").find("must be an input and a word"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"none\"\nrpm_per_count = 2.0\n").find("is for a speed that a point gives"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"none\"\nsigned = true\n").find("is for a speed that a point gives"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"word_in\"\nsigned = 1\n").find("signed"), std::string::npos);
  EXPECT_NE(error_of("[[spindle]]\nfeedback = \"none\"\n[[spindle]]\nfeedback = \"none\"\n").find("is there already"), std::string::npos);
  EXPECT_EQ(error_of("[[spindle]]\nfeedback = \"word_in\"\n"), "");
  // A misspelt point is one mistake only: the keys beside it are not reported as unknown.
  nc::rt::Config config;
  const char* const beside = "rpm_per_count = 2.0\nsigned = true\n";
  for (const char* point : {"word_im", "in0"})
    EXPECT_EQ(nc::rt::parse_config(nc::test::base_toml() + "[[spindle]]\nfeedback = \"" + point + "\"\n" + beside, "t.toml", &config).size(), 1u) << point;
}

// A register of 16 bits that is read without a sign turns -1000 into 64536.
TEST_F(SpindleFeedback, APointWithoutASignIsAWarningOnItsLine) {
  const auto read_with = [](const std::string& map, const std::string& more) {
    return nc::test::parse_or_fail(nc::test::base_toml() + kLink +
                                   "[[point]]\nname = \"speed\"\ntype = \"word\"\ndirection = \"input\"\nmodbus = { link = \"vfd\", table = "
                                   "\"input\", address = 2" + map + " }\n[[spindle]]\nfeedback = \"speed\"\n" + more);
  };
  const auto warnings = [&](const std::string& map, const std::string& more = "") { return nc::rt::spindle_warnings(read_with(map, more)); };
  // What threading needs to know.
  EXPECT_EQ(read_with("", "").nc.system[0].spindle_unsigned, 1u);
  EXPECT_EQ(read_with("", "signed = true\n").nc.system[0].spindle_unsigned, 0u);
  EXPECT_EQ(read_with(", signed = true", "").nc.system[0].spindle_unsigned, 0u);
  EXPECT_EQ(read_with(", signed = true", "signed = false\n").nc.system[0].spindle_unsigned, 1u);
  EXPECT_TRUE(warnings("", "signed = false\n").empty()) << "that is said";
  EXPECT_EQ(warnings("", "signed = true\n").size(), 1u) << "the register contradicts";
  const std::vector<std::string> found = warnings("");
  ASSERT_EQ(found.size(), 1u);
  const std::string before = nc::test::base_toml() + kLink;
  const auto line = std::count(before.begin(), before.end(), '\n') + 7;  // [[point]] has five, [[spindle]] comes, then its feedback
  EXPECT_NE(found[0].find(":" + std::to_string(line) + ": spindle[1].feedback: point \"speed\" has no sign"), std::string::npos) << found[0];
  EXPECT_EQ(warnings(", scale = 0.1").size(), 1u);
  EXPECT_EQ(warnings(", words = \"ABCD\", scale = 0.1").size(), 1u) << "saturated before it could come back to its sign";
  EXPECT_TRUE(warnings(", signed = true").empty());
  EXPECT_TRUE(warnings(", float = true").empty());
  EXPECT_TRUE(warnings(", offset = -32768.0").empty()) << "the device adds half of the range";
  EXPECT_TRUE(warnings(", words = \"ABCD\"").empty()) << "32 bits are a number with its sign";
}

}  // namespace
