// SPDX-License-Identifier: Apache-2.0
// The interface between programs and the machine of each family that has one, by the family's own names in the configuration: points of the process image go
// into a program while it runs on the machine, and come out of it.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "hal/sim/sim_machine.hpp"
#include "nc/nc.h"
#include "stepping.hpp"
#include "test_config.hpp"

namespace {

using nc::hal::PointImage;

/// The simulated machine, with what a test puts on the inputs in0 and word_in.
class DrivenMachine final : public nc::hal::Hal {
 public:
  explicit DrivenMachine(const nc::rt::Config& config) : sim_(config.sim, config.points), config_(config) {}
  bool start(const PointImage& initial, std::string* error) override { return sim_.start(initial, error); }
  void read(nc::hal::Feedback* feedback, PointImage* image) noexcept override {
    sim_.read(feedback, image);
    image->value[point("in0")] = in0 ? 1 : 0;
    image->value[point("word_in")] = word_in;
  }
  void write(const nc::hal::Command& command, const PointImage& image) noexcept override {
    out0 = image.value[point("out0")] != 0;
    word_out = image.value[point("word_out")];
    sim_.write(command, image);
  }
  void stop() noexcept override { sim_.stop(); }
  bool in0 = false, out0 = false;
  std::uint32_t word_in = 0, word_out = 0;

 private:
  unsigned point(const char* name) const { return static_cast<unsigned>(config_.points.find(name)); }
  nc::hal::SimMachine sim_;
  const nc::rt::Config& config_;
};

class FamilyInterface : public testing::Test {
 protected:
  /// `names`: the sections [macro_interface] and [signals] of the family.
  void build(const std::string& dialect, const std::string& names, const std::string& program) {
    std::string toml = nc::test::base_toml();
    const size_t from = toml.find("[macro_interface]"), to = toml.find("[sim]");
    toml = toml.substr(0, from) + names + toml.substr(to);
    toml.insert(toml.find("name = \"test\"\n"), "dialect = \"" + dialect + "\"\n");
    config = nc::test::parse_or_fail(toml);
    machine = std::make_unique<DrivenMachine>(config);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    text = program;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), nc::rt::Answer::kDone);
  }
  std::uint64_t runs() { return runtime->info().system[0].runs; }
  void start() {
    before = runs();
    ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kCycleStart), nc::rt::Answer::kDone);
  }
  /// Runs on for `cycles` at most, or to the end of the program; true: it has ended.
  bool run(int cycles = 20000) {
    while (cycles-- > 0 && runs() == before) runtime->step();
    return runs() != before;
  }
  double variable(std::uint32_t number) { return nc::test::variable_of(*runtime, number, -1); }
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<DrivenMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
  std::string text;
  std::uint64_t before = 0;
};

TEST_F(FamilyInterface, NumbersOfTheHx) {  // HX 14.2.3 (1), (2)
  build("hx", "[macro_interface]\n\"#7000\" = \"in0\"\n\"#7033\" = \"word_in\"\n\"#7500\" = \"out0\"\n\"#7533\" = \"word_out\"\n",
        "#100=#7000\n#101=#7033\n#7500=#100\n#7533=#101+1\nG04 P20\nM30\n");
  machine->in0 = true;
  machine->word_in = 41;
  start();
  ASSERT_TRUE(run());
  EXPECT_EQ(variable(100), 1);
  EXPECT_EQ(variable(101), 41);
  EXPECT_TRUE(machine->out0);
  EXPECT_EQ(machine->word_out, 42u);
}

TEST_F(FamilyInterface, NamesOfLinuxCnc) {  // M62 to M68
  build("iso", "[macro_interface]\n\"@motion.digital-in-00\" = \"in0\"\n\"@motion.analog-in-00\" = \"word_in\"\n\"@motion.digital-out-00\" = \"out0\"\n\"@motion.analog-out-00\" = \"word_out\"\n",
        "M66 E0 L0\n#100=#5399\nM66 P0 L3 Q10\n#101=#5399\nM64 P0\nM68 E0 Q7\nG4 P0.02\nM2\n");
  machine->word_in = 5;
  start();
  EXPECT_FALSE(run(200)) << "it waits for its input";
  EXPECT_FALSE(machine->out0);
  machine->in0 = true;
  ASSERT_TRUE(run());
  EXPECT_EQ(variable(100), 5);
  EXPECT_EQ(variable(101), 1);
  EXPECT_TRUE(machine->out0);
  EXPECT_EQ(machine->word_out, 7u);
}

TEST_F(FamilyInterface, PmiVariablesOfTheSeries8) {  // G06: @RUNG6; S: @SCODE
  build("series8", "[macro_interface]\n\"@RUNG6\" = \"in0\"\n\"@SCODE\" = \"word_out\"\n", "G71G90\nM03S600\nG06X5F3000\nM30\n");
  machine->in0 = true;
  start();
  EXPECT_FALSE(run(6000)) << "to and fro as long as it is on";
  EXPECT_EQ(machine->word_out, 600u) << "@SCODE";
  const double there = runtime->snapshot().system[0].nc.command.v[0];
  machine->in0 = false;
  ASSERT_TRUE(run());
  EXPECT_NEAR(runtime->snapshot().system[0].nc.command.v[0], 0, 1e-6) << "it ends at the start, wherever it was: " << there;
}

TEST_F(FamilyInterface, TheWantedSpeedOfTheSeries8) {  // @LCRPM: of G97, and of G96, where the S code is a surface speed (R of G92: the radius at X)
  build("series8", "[macro_interface]\n\"@LCRPM\" = \"word_out\"\n", "G71G90\nG97M03S600\nG04X.5\nG92R10S5000\nG96S63\nG04X.5\nG04X.5\nM30\n");
  start();
  EXPECT_FALSE(run(300));
  EXPECT_EQ(machine->word_out, 600u);
  EXPECT_FALSE(run(500));
  EXPECT_NEAR(machine->word_out, 1000, 15) << "63 m/min at a radius of 10 mm";
  EXPECT_TRUE(run());
}

TEST(FamilyInterfaceErrors, NamesOfTheSeries8AreSaidAndCheckedAsSignals) {
  const auto error_of = [](const std::string& names) {
    std::string toml = nc::test::base_toml();
    const size_t from = toml.find("[macro_interface]"), to = toml.find("[sim]");
    toml = toml.substr(0, from) + names + toml.substr(to);
    toml.insert(toml.find("name = \"test\"\n"), "dialect = \"series8\"\n");
    nc::rt::Config config;
    std::string all;
    for (const nc::rt::ConfigError& error : nc::rt::parse_config(toml, "test.toml", &config)) all += error.text() + "\n";
    return all;
  };
  const auto has = [&](const std::string& names, const char* text) { EXPECT_NE(error_of("[macro_interface]\n" + names + "\n").find(text), std::string::npos) << error_of("[macro_interface]\n" + names + "\n"); };
  has("\"@SPEED\" = \"word_out\"", "is no name of the macro interface (@RUNG6, @SCODE, @LCRPM)");
  has("\"@SCODE\" = \"word_in\"", "comes from the NC, but point \"word_in\" is an input");
  has("\"@SCODE\" = \"out0\"", "is a word, but point \"out0\" is a bit");
  has("\"@LCRPM\" = \"nowhere\"", "no point is named");
  has("\"@SCODE\" = \"word_out\"\n\"@LCRPM\" = \"word_out\"", "point \"word_out\" is set by two");
  has("\"#1100\" = \"word_out\"", "is no name of the macro interface");
}

TEST_F(FamilyInterface, NumbersOfTheM700) {  // M700 13.5.3
  build("m700", "[macro_interface]\n\"#1000\" = \"in0\"\n\"#1033\" = \"word_in\"\n\"#1100\" = \"out0\"\n\"#1133\" = \"word_out\"\n", "#100=#1000\n#101=#1033\n#1100=#100\n#1133=#101+1\nG04 P20\nM30\n");
  machine->in0 = true;
  machine->word_in = 41;
  start();
  ASSERT_TRUE(run());
  EXPECT_EQ(variable(100), 1);
  EXPECT_TRUE(machine->out0);
  EXPECT_EQ(machine->word_out, 42u);
}

}  // namespace
