// SPDX-License-Identifier: Apache-2.0
// The image of the macro interface: bits and words are one memory, and outputs are written only when the NC changes them.
#include "runtime/macro_interface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/sim/sim_machine.hpp"
#include "ladder_machine.hpp"
#include "stepping.hpp"

namespace {

using nc::hal::PointImage;

// Points: 0..31 bits of #1000.., 40 word #1034; 100..131 bits of #1100.., 140 word #1135.
nc::rt::MacroMap map_all() {
  nc::rt::MacroMap map;
  for (int bit = 0; bit < 32; ++bit) {
    map.input_bit[0][static_cast<unsigned>(bit)] = bit;
    map.output_bit[0][static_cast<unsigned>(bit)] = 100 + bit;
  }
  map.input_word[2] = 40;
  map.output_word[3] = 140;
  return map;
}

TEST(MacroInterface, InputsAreGatheredIntoWords) {
  const nc::rt::MacroInterface macro(map_all(), {});
  PointImage points;
  points.value[0] = points.value[31] = points.value[7] = 1;
  points.value[40] = 0xDEADBEEF;
  std::uint32_t input[NC_WORDS] = {1, 2, 3, 4};
  macro.gather(points, input);
  EXPECT_EQ(input[0], 0x80000081u);
  EXPECT_EQ(input[1], 0u);
  EXPECT_EQ(input[2], 0xDEADBEEFu);
  EXPECT_EQ(input[3], 0u);
}

TEST(MacroInterface, OnlyBitsThatABlockWritesReachTheirPoints) {
  nc::rt::MacroInterface macro(map_all(), {});
  PointImage points;
  points.value[101] = 1;  // set by someone else
  const std::uint32_t none[NC_WORDS] = {};
  std::uint32_t output[NC_WORDS] = {1, 0, 0, 0}, written[NC_WORDS] = {1, 0, 0, 0};
  macro.distribute(output, written, &points);
  EXPECT_EQ(points.value[100], 1u);
  EXPECT_EQ(points.value[101], 1u) << "bit 1 is not the program's to write";
  points.value[100] = 0;
  macro.distribute(output, none, &points);
  EXPECT_EQ(points.value[100], 0u) << "nothing written";
  macro.distribute(output, written, &points);
  EXPECT_EQ(points.value[100], 1u) << "the same value again is a command, too";
  output[0] = 2;
  output[3] = 0x12345678;
  written[0] = 2;
  written[3] = ~0u;
  macro.distribute(output, written, &points);
  EXPECT_EQ(points.value[101], 1u);
  EXPECT_EQ(points.value[140], 0x12345678u);
  EXPECT_EQ(macro.output()[0], 3u);
}

TEST(MacroInterface, PartSystemsShareOneImage) {
  nc::rt::MacroInterface macro(map_all(), {});
  PointImage points;
  const std::uint32_t first[NC_WORDS] = {1, 0, 0, 0}, second[NC_WORDS] = {4, 0, 0, 0}, none[NC_WORDS] = {};
  macro.distribute(first, first, &points);
  macro.distribute(second, second, &points);
  EXPECT_EQ(macro.output()[0], 5u) << "system 2 writes its bit, it does not clear the other's";
  EXPECT_EQ(points.value[100], 1u);
  EXPECT_EQ(points.value[102], 1u);
  macro.distribute(none, first, &points);
  EXPECT_EQ(macro.output()[0], 4u);
}

TEST(MacroInterface, OutputsBeginWithTheirPointsAndWithWhatTheBusFinds) {
  PointImage points;
  points.value[101] = 1;  // the `initial` value of the point
  nc::rt::MacroInterface macro(map_all(), points);
  EXPECT_EQ(macro.output()[0], 2u);
  std::uint32_t found[NC_WORDS];
  EXPECT_FALSE(macro.take_over(points, found));
  points.value[100] = 1;  // read back
  points.value[140] = 0xABCD0000;
  EXPECT_TRUE(macro.take_over(points, found));
  EXPECT_EQ(found[0], 1u);
  EXPECT_EQ(found[3], ~0u);
  EXPECT_FALSE(macro.take_over(points, found)) << "once";
  EXPECT_EQ(macro.output()[0], 3u);
  EXPECT_EQ(macro.output()[3], 0xABCD0000u);
  points.value[102] = 1;  // written by the ladder, in the middle of the scan
  macro.leave(points);
  EXPECT_FALSE(macro.take_over(points, found));
  const std::uint32_t off[NC_WORDS] = {}, written[NC_WORDS] = {1, 0, 0, 0};
  macro.distribute(off, written, &points);
  EXPECT_EQ(points.value[100], 0u) << "#1100 = 0 opens what was found closed";
  EXPECT_EQ(points.value[101], 1u);
}

// A machine whose output `out0` (#1100) is on at the start, as a bus finds it that reads outputs back.
class ClosedMachine final : public nc::hal::Hal {
 public:
  explicit ClosedMachine(const nc::rt::Config& config)
      : sim(config.sim, config.points), out0_(static_cast<unsigned>(config.points.find("out0"))) {}
  bool start(const PointImage& initial, std::string* error) override { return sim.start(initial, error); }
  void read(nc::hal::Feedback* feedback, PointImage* image) noexcept override {
    sim.read(feedback, image);
    if (++reads == found_at) image->value[out0_] = 1;
  }
  void write(const nc::hal::Command& command, const PointImage& image) noexcept override {
    closed = image.value[out0_] != 0;
    sim.write(command, image);
  }
  void stop() noexcept override { sim.stop(); }
  nc::hal::SimMachine sim;
  unsigned reads = 0, found_at = 1;
  bool closed = false;

 private:
  unsigned out0_;
};

class FoundOutput : public testing::Test {
 protected:
  void build(unsigned found_at, const char* initial = "") {
    std::string toml = nc::test::base_toml();
    toml.insert(toml.find("name = \"out0\"\n"), initial);
    config = nc::test::parse_or_fail(toml);
    machine = std::make_unique<ClosedMachine>(config);
    machine->found_at = found_at;
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void steps(int n) { nc::test::steps_of(*runtime, n); }
  double variable(std::uint32_t number) const { return nc::test::variable_of(*runtime, number, -1); }
  void mode(nc::rt::Mode mode) { ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode)), nc::rt::Answer::kDone); }
  void run() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kCycleStart), nc::rt::Answer::kDone);
    for (int n = 0; n < 10000 && runtime->info().system[0].runs == runs; ++n) runtime->step();
    ASSERT_GT(runtime->info().system[0].runs, runs);
  }
  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<ClosedMachine> machine;
  std::unique_ptr<nc::rt::Runtime> runtime;
};

constexpr char kOpens[] = "#101=#1100\n#102=#1132\n#1100=0\n#103=#1100\nM30\n";

TEST_F(FoundOutput, AProgramReadsItAndOpensIt) {
  build(3);
  steps(10);
  EXPECT_TRUE(machine->closed);
  EXPECT_EQ(runtime->snapshot().interface_output[0], 1u);
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "p", kOpens, sizeof kOpens - 1, &file), NC_OK);
  ASSERT_EQ(runtime->select_program(file), nc::rt::Answer::kDone);
  run();
  EXPECT_EQ(variable(101), 1);
  EXPECT_EQ(variable(102), 1);
  EXPECT_EQ(variable(103), 0);
  EXPECT_FALSE(machine->closed);
  run();
  EXPECT_EQ(variable(101), 0) << "what the program has left, not what was found once";
}

// A program that was selected before has been read ahead before the partner answered.
TEST_F(FoundOutput, WhatIsSelectedBeforeReadsItAllTheSame) {
  build(100);
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "p", kOpens, sizeof kOpens - 1, &file), NC_OK);
  ASSERT_EQ(runtime->select_program(file), nc::rt::Answer::kDone);
  steps(200);
  ASSERT_TRUE(machine->closed);
  run();
  EXPECT_EQ(variable(101), 1);
  EXPECT_FALSE(machine->closed);
}

TEST_F(FoundOutput, BlocksOfMdiToo) {
  build(100);
  mode(nc::rt::Mode::kMdi);
  ASSERT_EQ(runtime->load_mdi(kOpens), nc::rt::Answer::kDone);
  steps(200);
  ASSERT_TRUE(machine->closed);
  run();
  EXPECT_EQ(variable(101), 1);
  EXPECT_FALSE(machine->closed);
}

TEST_F(FoundOutput, AnOutputThatBeginsOnReadsOn) {
  build(0, "initial = 1\n");
  mode(nc::rt::Mode::kMdi);
  ASSERT_EQ(runtime->load_mdi(kOpens), nc::rt::Answer::kDone);
  run();
  EXPECT_EQ(variable(101), 1);
  EXPECT_FALSE(machine->closed);
}

}  // namespace
