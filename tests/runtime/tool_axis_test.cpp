// SPDX-License-Identifier: Apache-2.0
// The length along the axis of the tool (M700 12.3) in the runtime: signals of the ladder and its handle change it, the ladder gives the angles of a head that is no axis.
#include <cmath>

#include "ladder_machine.hpp"
#include "runtime/refusal.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr double kNear = 0.0101;  // the optimal mode stops on the rounding of a corner

class ToolAxisRuntime : public nc::test::OwnLadder {
 protected:
  // word_in 1 to 3 turn the third handle by 3 increments back, by 200 forth, and that of X; in0 chooses the mode of the length. M50 turns the head: its angles
  // are there when it is answered.
  void run() {
    use("LD in0\nOUT plc.tool_length_by_handle\nLD SM400\nMOV K0 plc.handle.Z\nMOV K0 plc.handle.X\nLDD= word_in K1\nMOV K-3 plc.handle.Z\nLDD= word_in K2\nMOV K200 plc.handle.Z\n"
        "LDD= word_in K3\nMOV K5 plc.handle.X\nLDD= nc.m_code K50\nAND nc.m_strobe\nDMOV K90000 D0\nDMOV K90000 D2\n"
        "LD SM400\nDMOV D0 plc.tool_tilt\nDMOV D2 plc.tool_turn\nDMOV nc.tool_length_added D4\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
    config.nc.system[0].tool_axis = NC_TOOL_AXIS_MECHANICAL_A;
    build();
    ASSERT_EQ(nc_tool_offset_set(runtime->control(), 1, NC_TOOL_LENGTH, 20), NC_OK);
    steps(2);
  }
  double at(unsigned axis) const { return out().command.v[axis]; }
  void turn(unsigned word) {
    in("word_in", word);
    steps(1);
    in("word_in", 0);
    steps(2);
  }
  void block() {
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    steps(5);
    ASSERT_GE(until([&] { return out().state != NC_STATE_RUNNING; }), 0);
    steps(3);
  }
  void start_single(const std::string& text) {
    ASSERT_EQ(runtime->execute(CommandKind::kSingleBlock, 0, 1), Answer::kDone);
    start(text);
    ASSERT_GE(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
    steps(3);
  }
};

TEST_F(ToolAxisRuntime, TheHandleOfTheThirdAxisChangesTheLength) {
  run();
  start_single("G90 G1 F1000 G43.1 H1 X0 Y0 Z0\nX1.\nX2.\nX3.\nM30");
  EXPECT_NEAR(at(2), 20, kNear);
  turn(2);  // the mode is not chosen
  EXPECT_EQ(device("D4"), 0);
  in("in0", 1);
  steps(2);
  turn(2);
  EXPECT_EQ(device("D4"), 200);
  EXPECT_NEAR(at(2), 20, kNear);
  turn(1);
  EXPECT_EQ(device("D4"), 197);
  turn(3);  // the handle of another axis
  EXPECT_EQ(device("D4"), 197);
  block();
  EXPECT_NEAR(at(2), 20.197, kNear);
  block();
  EXPECT_NEAR(at(0), 2, kNear);
  EXPECT_NEAR(at(2), 20.197, kNear);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 500), 0);
  steps(3);
  EXPECT_EQ(device("D4"), 0);
}

TEST_F(ToolAxisRuntime, PulsesThatDoNotCountAreNotedOnce) {
  run();
  in("in0", 1);
  steps(2);
  start_single("G90 G1 F1000 X1.\nX2.\nM30");
  const auto count = [&] { return runtime->snapshot().system[0].refusal.count; };
  const auto before = count();
  turn(2);  // no length is compensated along the tool
  EXPECT_EQ(count(), before + 1);
  EXPECT_NE(nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal).find('Z'), std::string::npos);
  turn(2);
  EXPECT_EQ(count(), before + 1);
}

TEST_F(ToolAxisRuntime, InManualModeTheHandleMovesTheAxis) {
  run();
  in("in0", 1);
  steps(2);
  start_single("G90 G1 F1000 G43.1 H1 X0 Y0 Z0\nX1.\nX2. Z0\nM30");
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
  steps(3);
  turn(2);
  steps(200);
  EXPECT_EQ(device("D4"), 0);
  EXPECT_NEAR(at(2), 20.2, kNear);
}

TEST_F(ToolAxisRuntime, TheLadderGivesTheAnglesOfTheHead) {
  run();
  start("G90 G1 F1000 G43.1 H1 X0 Y0 Z0\nM50\nX1.\nG4 X0.1\nM0\nM30");
  ASSERT_GE(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
  EXPECT_NEAR(at(0), 21, kNear);
  EXPECT_NEAR(at(1), 0, kNear);
  EXPECT_NEAR(at(2), 0, kNear);
  EXPECT_EQ(alarm(), "");
}

TEST_F(ToolAxisRuntime, AReferenceReturnByHandEndsTheCompensation) {
  run();
  start_single("G90 G1 F1000 G43.1 H1 X0 Y5. Z0\nX1.\nX2.\nZ3.\nM30");
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
  steps(3);
  nc::rt::Command command;
  command.kind = CommandKind::kReference;
  command.axis = 1;
  ASSERT_EQ(runtime->execute(command), Answer::kDone);
  steps(5);
  ASSERT_GE(until([&] { return out().state != NC_STATE_MANUAL; }), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(Mode::kAuto)), Answer::kDone);
  steps(3);
  const double z = at(2);
  block();
  EXPECT_NEAR(at(0), 1, kNear);
  EXPECT_NEAR(at(2), z, kNear);
  block();
  block();
  EXPECT_NEAR(at(2), 3, kNear);
  EXPECT_EQ(alarm(), "");
}

TEST_F(ToolAxisRuntime, TheConfigurationNamesTheHead) {
  const auto with = [](const std::string& line) {
    std::string text = nc::test::base_toml();
    const std::string name = "name = \"test\"";
    text.replace(text.find(name), name.size(), name + "\n" + line);
    return text;
  };
  EXPECT_EQ(nc::test::parse_or_fail(with("tool_axis = [\"mechanical_b\"]")).nc.system[0].tool_axis, static_cast<std::uint64_t>(NC_TOOL_AXIS_MECHANICAL_B));
  EXPECT_EQ(nc::test::parse_or_fail(with("")).nc.system[0].tool_axis, static_cast<std::uint64_t>(NC_TOOL_AXIS_TURNED));
}

}  // namespace
