// SPDX-License-Identifier: Apache-2.0
// A start, and in the same scan what would have refused it: the start goes to the NC with the next scan, and between the two nothing may change what it was judged by.
#include "axes_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

class SameScan : public nc::test::AxesMachine {
 protected:
  static std::string with_modes() {
    return changed({{"[signals]\n", "[[point]]\nname = \"by_hand\"\ndirection = \"input\"\n[signals]\n\"plc.mode_manual\" = \"by_hand\"\n"}});
  }
  // The button goes off, which starts, and the other input changes with it.
  void start_and(const char* other, std::uint32_t value, int scans_later) {
    in("start", 1);
    steps(5);
    in("start", 0);
    if (scans_later == 0) in(other, value);
    steps(1);
    if (scans_later == 1) in(other, value);
    steps(1);
    if (scans_later == 2) in(other, value);
    steps(1);
  }
};

// The drive of Z would go off behind its brake while the program leads it.
TEST_F(SameScan, ServoOffWaitsForTheProgramThatIsStartedWithIt) {
  for (const int later : {0, 1, 2}) {
    SCOPED_TRACE(later);
    build();
    home_machine();
    load("G90 G53 G0 Z100.\nG53 G1 Z50. F3000\nM30\n");
    start_and("z_servo_off", 1, later);
    if (out().state == NC_STATE_RUNNING) {
      const auto held = [&] { return brake_open() && (measured->last.off & 1u << kZ) == 0; };
      ASSERT_LT(until([&] { return out().state != NC_STATE_RUNNING || !held(); }, 20000), 20000);
      EXPECT_EQ(out().state, NC_STATE_IDLE) << "the brake closes in the program";
    } else {
      EXPECT_FALSE(brake_open());
    }
    ASSERT_GE(until([&] { return measured->last.off == 1u << kZ; }, 1000), 0) << "at its end";
    EXPECT_FALSE(brake_open());
  }
}

// A program runs in the mode in which it was started.
TEST_F(SameScan, TheModeStaysThatOfTheProgram) {
  for (const int later : {0, 1, 2}) {
    SCOPED_TRACE(later);
    build(with_modes());
    home_machine();
    load("G90 G53 G0 X100.\nM30\n");
    start_and("by_hand", 1, later);
    steps(3);
    if (out().state == NC_STATE_RUNNING) {
      EXPECT_EQ(runtime->snapshot().mode, Mode::kAuto);
    } else {
      EXPECT_EQ(runtime->snapshot().mode, Mode::kManual);
    }
    ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }, 20000), 0);
  }
}

}  // namespace
