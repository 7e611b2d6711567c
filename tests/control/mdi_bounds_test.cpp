// SPDX-License-Identifier: Apache-2.0
// Blocks of MDI in a block stop (M700 12.4.4), at the bounds: where they are refused, what ends them, and what is left when they do not come to their end.
#include <gtest/gtest.h>

#include "mdi_machine.hpp"

namespace nc::test {
namespace {

class MdiBounds : public testing::TestWithParam<bool> {
 protected:
  MdiMachine machine() const { return MdiMachine(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(BothLaws, MdiBounds, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

/// At the block stops of the program, one after the other: 'y' where blocks of MDI are taken, else '-'. With the line of the block that has ended.
std::string where_taken(MdiMachine& m, const std::string& text) {
  m.start(text);
  std::string taken;
  for (unsigned stop = 0; stop < 30; ++stop) {
    EXPECT_TRUE(m.until_stop());
    if (m.drive->out.state != NC_STATE_STOPPED) break;
    const nc_status status = m.load("Y1.");
    EXPECT_TRUE(status == NC_OK || status == NC_E_STATE);
    taken += std::to_string(m.drive->out.source.line) + (status == NC_OK ? "y " : "- ");
    if (status == NC_OK) {
      EXPECT_EQ(m.load(" "), NC_OK);  // it is taken back
    }
    m.press();
  }
  EXPECT_TRUE(m.drive->ended) << taken << m.drive->alarm();
  EXPECT_EQ(m.drive->alarm(), "") << taken;
  return taken;
}

// What has begun and goes on with the block behind is not torn apart.
TEST_P(MdiBounds, RefusedWithinWhatGoesOn) {
  struct {
    const char* what;
    const char* program;
    const char* taken;
  } const cases[] = {
      {"NURBS (6.15)", "G5 P10000\nG1 X1. Y0 F6000\nG6.2 P2 X1. Y0 R1. K0\nX10. Y0 R1. K0\nX10. Y10. R1. K1\nK1\nK1\nG1 X20.\nM30", "1y 2y 7y 8y "}  /* it has no stop within */,
      {"two blocks that meet (13.9)", "G1 X1. F6000\nA45.\nX20. Y0 A-45.\nX30.\nM30", "1y 2- 3y 4y "},
      {"an arc in space (6.14)", "G1 X1. F6000\nG2.4 X10. Y5. Z1.\nX20. Y0 Z0\nG1 X30.\nM30", "1y 2- 3y 4y "},
      {"parameters (4.16)", "G1 X1. F6000\nG10 L70\nP8117 D1\nG11\nX30.\nM30", "1y 2- 3- 4y 5y "},
      {"tool life data", "G1 X1. F6000\nG10 L3\nP10 L2 Q1\nT101 H1 D1\nG11\nX30.\nM30", "1y 2- 3- 4- 5y 6y "},
      {"a figure that is rotated (13.3.3)", "G1 X1. F6000\nM98 P77 I5. J0 L2\nX30.\nM30\nO77\nG91 G1 X5.\nY5.\nG90\nM99", "1y 2- 6- 7- 8- 6- 7- 8- 3y "},
  };
  for (const auto& part : cases) {
    SCOPED_TRACE(part.what);
    MdiMachine m = machine();
    EXPECT_EQ(where_taken(m, part.program), part.taken);
    EXPECT_LT(m.worst, 1.001);
  }
}

// The main program itself is one of MDI: its text is in execution.
TEST_P(MdiBounds, RefusedWhereTheProgramIsMdi) {
  MdiMachine m = machine();
  m.start("M30");
  ASSERT_TRUE(m.until_stop());
  m.drive->ended = false;
  ASSERT_EQ(m.load("G90 G1 X5. F6000\nX10."), NC_OK);
  m.stops(1);
  ASSERT_EQ(m.drive->out.state, NC_STATE_STOPPED) << m.state();
  EXPECT_EQ(m.load("Y1."), NC_E_STATE);
  EXPECT_TRUE(m.to_end_of_program()) << m.state();
  m.expect_at(10, 0);
}

// M700 13.12: an interrupt program is interrupted like any other, and M99 of it goes back into the main program behind.
TEST_P(MdiBounds, WithinAnInterruptProgram) {
  MdiMachine m = machine();
  m.start("M96 P1000\nG90 G1 X1. F3000\nX100.\nX110.\nM97\nM30\nO1000\nG91 Z2.\nZ3.\nG90\nM99");
  m.step(12);
  for (unsigned n = 0; n < 60000 && m.drive->out.command.v[0] < 20; ++n) {
    if (m.stands()) m.press();
    m.step();
  }
  m.drive->in.macro_interrupt = true;
  ASSERT_TRUE(m.until_stop());
  m.drive->in.macro_interrupt = false;
  for (unsigned n = 0; n < 5 && m.drive->out.command.v[2] < 1.999; ++n) m.stops(1);
  const double x = m.drive->out.command.v[0];
  ASSERT_NEAR(m.drive->out.command.v[2], 2, 1e-6) << m.state() << m.drive->alarm();
  EXPECT_LT(x, 90);
  ASSERT_EQ(m.load("Y4."), NC_OK);  // it begins in the modes of the interrupt program
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state();
  m.expect_at(x, 4, 2);
  m.stops(1);
  m.expect_at(x, 4, 5, 0.0101);  // the rest of the interrupt program
  EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
  m.expect_at(110, 4, 5);
  EXPECT_LT(m.worst, 1.001);
}

// The signal of M96 during blocks of MDI that interrupt: the interrupt program runs, and the rest of them, and the program behind.
TEST_P(MdiBounds, AnInterruptProgramWithinThem) {
  MdiMachine m = machine();
  m.start("M96 P1000\nG90 G1 X10. F3000\nX20.\nM97\nM30\nO1000\nG91 Z2.\nG90\nM99");
  for (unsigned n = 0; n < 5 && m.drive->out.command.v[0] < 9.999; ++n) m.stops(1);
  m.expect_at(10, 0);
  m.drive->in.single_block = false;
  ASSERT_EQ(m.load("Y50.\nY60."), NC_OK);
  m.press();
  for (unsigned n = 0; n < 60000 && m.drive->out.command.v[1] < 10; ++n) m.step();
  m.drive->in.macro_interrupt = true;
  m.step(20);
  m.drive->in.macro_interrupt = false;
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED) << m.state() << m.drive->alarm();
  EXPECT_NEAR(m.drive->out.command.v[1], 60, 1e-6);
  EXPECT_NEAR(m.drive->out.command.v[2], 2, 1e-6);
  EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
  m.expect_at(20, 60, 2);
  EXPECT_LT(m.worst, 1.001);
}

// An alarm in the middle of them: what is in front of it has been done, the program has ended with it, and a reset brings it back to its head.
TEST_P(MdiBounds, AnAlarmInTheMiddle) {
  MdiMachine m = machine();
  m.start("G90 G1 X10. F6000\nX20. Y#100\nM30");
  ASSERT_TRUE(m.until_stop());
  m.drive->in.single_block = false;
  ASSERT_EQ(m.load("Y5.\n#100=7\nY8.\nG2 X50. R1.\nY9.\n#100=9"), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  EXPECT_EQ(m.drive->alarm(), "P71");
  EXPECT_EQ(m.drive->out.state, NC_STATE_ALARM) << m.state();
  m.expect_at(10, 8);
  m.press();
  m.step(50);
  m.expect_at(10, 8);
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(20);
  EXPECT_EQ(m.drive->out.state, NC_STATE_IDLE) << m.state();
  EXPECT_EQ(m.drive->alarm(), "");
  EXPECT_EQ(m.bench.var_now(100), 7);
  m.drive->ended = false;
  EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();  // the same program, from its head
  m.expect_at(20, 7);
  EXPECT_LT(m.worst, 1.001);
}

TEST_P(MdiBounds, TheLongestText) {
  MdiMachine m = machine();
  m.start("G90 G1 X10. F6000\nX20.\nM30");
  ASSERT_TRUE(m.until_stop());
  std::string text = "G91\n", longer;
  while (text.size() + 12 <= 1024) text += "Y.1 Z-.01\n";
  const auto blocks = static_cast<double>((text.size() - 4) / 10);
  text += std::string(1024 - text.size(), ' ');
  longer = text + " ";
  EXPECT_EQ(m.load(longer), NC_E_ARGUMENT);
  EXPECT_EQ(m.load(longer + "\n\n"), NC_E_ARGUMENT);
  ASSERT_EQ(m.load(text), NC_OK);
  m.drive->in.single_block = false;
  ASSERT_TRUE(m.to_end_of_mdi()) << m.state() << m.drive->alarm();
  EXPECT_GT(blocks, 90);
  m.expect_at(10, 0.1 * blocks, -0.01 * blocks, 1e-6);
  ASSERT_EQ(m.load("G90"), NC_OK);
  ASSERT_TRUE(m.to_end_of_mdi());
  EXPECT_TRUE(m.to_end_of_program()) << m.state();
  m.expect_at(20, 0.1 * blocks, -0.01 * blocks);
  EXPECT_LT(m.worst, 1.001);
}

// M700 13.3.1 (3): M99 goes to the head of the text. Where nothing stands in front of it there is nothing to repeat, and the text ends.
TEST_P(MdiBounds, M99AloneIsTheEnd) {
  for (const char* const text : {"M99", "\n\n(BACK)\n  M99\n", "M99\nG91 Y0 G90"}) {
    SCOPED_TRACE(text);
    MdiMachine m = machine();
    m.start("G90 G1 X10. F6000\nX20.\nM30");
    ASSERT_TRUE(m.until_stop());
    ASSERT_EQ(m.load(text), NC_OK);
    ASSERT_TRUE(m.to_end_of_mdi()) << m.state() << m.drive->alarm();
    m.expect_at(10, 0);
    EXPECT_TRUE(m.to_end_of_program()) << m.state();
    m.expect_at(20, 0);
  }
}

TEST_P(MdiBounds, AResetInTheMiddle) {
  for (const bool moving : {false, true}) {
    MdiMachine m = machine();
    m.start("G90 G41 D1 G1 X10. Y5. F6000\nX20.\nX40. Y20.\nG40 X60.\nM30");
    ASSERT_TRUE(m.until_stop());
    m.stops(1);
    const double before = m.drive->out.command.v[1];
    m.drive->in.single_block = !moving;
    ASSERT_EQ(m.load("#500=1\nY50.\n#500=2\nX10. Y90.\n#500=3"), NC_OK);
    if (moving) {
      m.press();
      for (unsigned n = 0; n < 60000 && m.drive->out.command.v[1] < before + 10; ++n) m.step();
    } else {
      m.stops(1);
    }
    m.drive->in.reset = true;
    m.step(500);
    m.drive->in.reset = false;
    m.step(20);
    EXPECT_EQ(m.drive->out.state, NC_STATE_IDLE) << m.state();
    EXPECT_EQ(m.drive->alarm(), "");
    EXPECT_LT(m.drive->out.command.v[1], 70);
    EXPECT_EQ(m.bench.var_now(500), 1);  // what has been executed
    EXPECT_LT(m.worst, 1.001);
    // Compensation has ended with it, the program is at its head, and its next run is that of a machine that has been moved there by hand.
    m.drive->ended = false;
    EXPECT_TRUE(m.to_end_of_program()) << m.state() << m.drive->alarm();
    m.expect_at(60, 20);
    EXPECT_LT(m.worst, 1.001);
  }
}

// The power fails in the middle of them. Another control gets what the host has kept, which is what the executed blocks have left; of the blocks of MDI it knows
// nothing, and the program begins at its head.
TEST_P(MdiBounds, APowerCutInTheMiddle) {
  const std::string program = "G90 G1 X10. Y0 F6000\n#501=#500+1\nX20.\nM30";
  unsigned kept[4] = {};
  for (const double until : {1.0, 15.0, 25.0, 35.0}) {
    MdiMachine m = machine();
    m.start(program);
    ASSERT_TRUE(m.until_stop());
    m.drive->in.single_block = false;
    ASSERT_EQ(m.load("#500=1\nY10.\n#500=2\nY20.\n#500=3\nY40."), NC_OK);
    m.press();
    for (unsigned n = 0; n < 60000 && m.drive->out.command.v[1] < until; ++n) m.step();
    double value = 0;
    const std::pair<double*, int> to{&value, 0};
    nc_look_executed(
        m.bench.control(),
        [](void* user, const nc_control* control) {
          bool vacant = false;
          EXPECT_EQ(nc_variable_get(control, 0, 500, static_cast<const std::pair<double*, int>*>(user)->first, &vacant), NC_OK);
        },
        const_cast<std::pair<double*, int>*>(&to));
    ++kept[static_cast<unsigned>(value)];
    const nc_axes at = m.drive->out.command;

    MdiMachine next = machine();
    ASSERT_EQ(nc_position_set(next.bench.control(), 0, &at), NC_OK);
    ASSERT_EQ(nc_variable_set(next.bench.control(), 0, 500, value, false), NC_OK);
    next.start(program);
    EXPECT_TRUE(next.to_end_of_program()) << next.state() << next.drive->alarm();
    next.expect_at(20, 0);
    EXPECT_EQ(next.bench.var_now(501), value + 1);
    EXPECT_LT(next.worst, 1.001);
  }
  EXPECT_EQ(kept[1], 1u);
  EXPECT_EQ(kept[2], 1u);
  EXPECT_EQ(kept[3], 2u);
}

}  // namespace
}  // namespace nc::test
