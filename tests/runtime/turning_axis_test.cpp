// SPDX-License-Identifier: Apache-2.0
// A rotary axis whose position counts on over several turns (M700 14.13), on a machine: its limits hold in every turn, also in the last check
// of the runtime, and a reference return does not turn it back through all turns.
#include "ladder_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

constexpr unsigned kC = 3;

class TurningAxis : public nc::test::LadderMachine {
 protected:
  // `limits` is a line of TOML.
  void set_up(const std::string& limits) {
    config = nc::test::parse_or_fail(nc::test::base_toml() +
                                     "[[axis]]\nname = \"C\"\nrotary = true\nmax_velocity = 180.0\nmax_acceleration = 1800.0\n" + limits +
                                     "[parameters]\n\"8213\" = { C = 0 }\n");
    build();
  }
  double c() const { return out().command.v[kC]; }
  void manual() {
    ASSERT_EQ(runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  }
};

TEST_F(TurningAxis, ItsLimitsHoldInTheNextTurnToo) {
  set_up("soft_limits = [0.0, 365.0]\n");
  start("G91 G0 C363.\nC100.\nC-50.\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(alarm(), "");
  EXPECT_NEAR(c(), 413, 1e-9);
  manual();
  ASSERT_EQ(runtime->execute({CommandKind::kStep, 0, kC, 0, -100.0, 0}), Answer::kDone);
  for (int n = 0; n < 2000; ++n) runtime->step();
  EXPECT_NEAR(c(), 360, 1e-9) << "0 of this turn";
  EXPECT_EQ(alarm(), "");
}

TEST_F(TurningAxis, ReferenceReturnStaysInItsTurn) {
  set_up("");
  start("G91 G0 C800.\nM30\n");
  ASSERT_GE(until_end(), 0);
  EXPECT_EQ(out().at_reference >> kC & 1u, 0u);
  manual();
  ASSERT_EQ(runtime->execute({CommandKind::kReference, 0, kC, 0, 0, 0}), Answer::kDone);
  ASSERT_GT(until([&] { return c() == 720; }, 5000), 0);
  EXPECT_EQ(out().at_reference >> kC & 1u, 1u);
  for (int n = 0; n < 20; ++n) runtime->step();
  EXPECT_EQ(c(), 720);
  EXPECT_NE(out().state, NC_STATE_MANUAL);
}

}  // namespace
