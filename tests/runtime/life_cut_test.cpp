// SPDX-License-Identifier: Apache-2.0
// Tool life by minutes over power cuts: of what a tool has cut no more is lost than the last second, at whatever moment the machine goes dark, however often, and
// whatever is read ahead. What the keeper has written is taken as it is in memory; how files come through a power cut is proven in retain_test.cpp.
#include <algorithm>
#include <cmath>
#include <random>

#include "ladder_machine.hpp"
#include "runtime/retain/tables.hpp"
#include "support/seeds.hpp"

namespace {

constexpr double kTold_s = 1;  // the scan tells the feeder by the second (count_cutting())
constexpr double kBeside_s = 0.02;  // what is under way between scan and feeder, and cycles in which a move begins or ends

class LifeOverPowerCuts : public nc::test::LadderMachine {
 protected:
  void SetUp() override {
    config = nc::test::parse_or_fail(nc::test::base_toml() + "[parameters]\n\"1103\" = 1\n");
    build();
    configured = nc::rt::read_tables(runtime->control(), config.nc);
  }
  double used_s() {
    double minutes = NAN;
    EXPECT_EQ(nc_tool_life_get(runtime->control(), 1, NC_LIFE_USED, &minutes), NC_OK);
    return 60 * minutes;
  }
  // The machine goes dark, and the next one finds what was kept.
  void cut_power() {
    const std::string kept = nc::rt::encode_changes(nc::rt::executed_tables(runtime->control(), config.nc), configured);
    runtime.reset();
    build();
    ASSERT_TRUE(nc::rt::restore_changes(runtime->control(), config.nc, configured, kept));
  }
  nc::rt::TableRows configured;
};

TEST_F(LifeOverPowerCuts, NoMoreThanTheLastSecondIsLost) {
  for (std::uint64_t seed = 1; seed <= nc::test::seeds(6, 2); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    start("G10 L3\nP7 L1 Q2\nT11\nT12\nG11\nM30\n");
    ASSERT_GE(until_end(), 0) << alarm();
    double cut_s = 0;
    unsigned cuts = 0;
    for (; cuts < 4; ++cuts) {
      // Cuts of all lengths with rapid traverse and dwells between them, far more than the look-ahead holds, and at their end the group anew.
      std::string text = "T7 M6\nG91 G1 F600\n";
      for (unsigned n = 0; n < 40; ++n) text += "G1 X" + std::to_string(number(-8, 8)) + "\nG0 Y" + std::to_string(number(-3, 3)) + "\nG4 P" + std::to_string(static_cast<int>(number(1, 200))) + "\n";
      start(text + "G10 L3\nP7 L9 Q2\nT11\nG11\nM30\n");
      const int scans = static_cast<int>(number(500, 12000));
      for (int n = 0; n < scans; ++n) {
        const double before = out().command.v[0];
        runtime->step();
        if (out().command.v[0] != before) cut_s += config.nc.cycle_s;
      }
      ASSERT_NE(out().state, NC_STATE_IDLE);
      cut_power();
      EXPECT_LE(used_s(), cut_s + kBeside_s);
      EXPECT_GE(used_s(), cut_s - kTold_s - kBeside_s) << "cut " << cuts;
      cut_s = used_s();  // what is lost is lost
    }
    EXPECT_GT(cut_s, 1);
  }
}

// The life that ended before the power cut has ended behind it, and the next tool of the group is taken.
TEST_F(LifeOverPowerCuts, ALifeThatHasEndedHasEndedBehindIt) {
  start("G10 L3\nP7 L1 Q2\nT11\nT12\nG11\nT7 M6\nG91 G1 X62. F60\nX1.\nM30\n");
  ASSERT_GE(until_line(9), 0);
  cut_power();
  EXPECT_NEAR(used_s(), 62, kTold_s + kBeside_s);
  start("T7 M6\nM30\n");
  ASSERT_GE(until_end(), 0) << alarm();
  EXPECT_EQ(out().t, 12U);
}

}  // namespace
