// SPDX-License-Identifier: Apache-2.0
// A macro interrupt of type 1 in a fixed cycle (M700 13.12, 13.1.1), on a control that is driven cycle by cycle. It acts at once, but not in a hole: with
// what is left of a hole its way out would be lost, and the next one be gone to at its depth.
#include <gtest/gtest.h>

#include <algorithm>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

constexpr double kTop = 10, kR = 2, kBottom = -8;
constexpr double kFirst = 5, kSecond = 25, kAside = 4.5;  // places of the holes; no cycle leads farther beside them

std::function<void(nc_config&)> drilling_machine(bool optimal) {
  return [optimal](nc_config& c) {
    c.cycle_s = 0.004;
    c.look_ahead = 256;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 200;
      c.system[0].axis[i].max_velocity = 100;
      c.system[0].axis[i].max_acceleration = 1000;
      c.system[0].axis[i].max_jerk = optimal ? 100000 : 0;
    }
    if (optimal) c.motion_mode = NC_MOTION_OPTIMAL;
  };
}

class HoleInterrupt : public testing::TestWithParam<bool> {
 protected:
  HoleInterrupt() : bench(NC_DIALECT_M700, drilling_machine(GetParam())) { bench.param("8013", "1").param("8012", "0.5").tool(7, 1); }

  void start(const std::string& blocks) {
    bench.at(0, 0, kTop);
    drive = std::make_unique<Drive>(bench, "G90 G94 G0 X0\nS600\nM3\nM96 P1000\n" + blocks + "\nG80\nM97\nM30");
    level_of_traverse = 1e9;
    given_out.clear();
    bottoms.clear();
    strobe = 0;
  }
  void step() {
    drive->press_start();
    drive->step(50);
    const nc_outputs& out = drive->out;
    if ((out.strobe & ~strobe & 1) != 0) given_out.push_back(static_cast<int>(out.m));
    strobe = out.strobe;
    const double x = out.command.v[0];
    const bool traverses = std::fabs(x - before) > 1e-9;
    before = x;
    if (traverses && x > kFirst + kAside && x < kSecond - kAside) level_of_traverse = std::min(level_of_traverse, z());
    if (z() <= kBottom + 0.5 && (bottoms.empty() || std::fabs(bottoms.back() - x) > 2 * kAside)) bottoms.push_back(x);
  }
  template <class Done>
  bool until(Done done, unsigned most = 20000) {
    for (unsigned n = 0; n < most && !done(); ++n) step();
    return done();
  }
  void interrupt() {
    drive->in.macro_interrupt = true;
    step();
    drive->in.macro_interrupt = false;
  }
  double z() const { return drive->out.command.v[2]; }
  double x() const { return drive->out.command.v[0]; }
  unsigned count(int code) const { return static_cast<unsigned>(std::count(given_out.begin(), given_out.end(), code)); }

  Bench bench;
  std::unique_ptr<Drive> drive;
  double level_of_traverse = 0, before = 0;
  std::vector<int> given_out;   ///< M codes
  std::vector<double> bottoms;  ///< where the tool has been at the bottom
  uint8_t strobe = 0;
};

INSTANTIATE_TEST_SUITE_P(BothLaws, HoleInterrupt, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

/// 13.12: "the commands in the interrupted block are lost", with them the way out of the hole, and in some cycles the M3 behind it.
TEST_P(HoleInterrupt, ActsBehindTheWayBackInEveryCycle) {
  bench.add("O1000", "M8\nM99\n");
  for (const char* words : {"G81", "G82 P200", "G83 Q3.", "G73 Q3.", "G85", "G86 P200", "G88", "G89 P200", "G76 I1.", "G75 Q5. P7", "G84 P200 ,R0"}) {
    for (const char* level : {"G98", "G99"}) {
      const bool to_r = std::string(level) == "G99";
      for (const double depth : {5.0, -1.0, -7.5}) {
        start(std::string(level) + " " + words + " X5. Z-8. R2. F900\nX25.");
        ASSERT_TRUE(until([&] { return std::fabs(x() - kFirst) < kAside && z() < depth; })) << words;
        interrupt();
        ASSERT_TRUE(until([&] { return drive->ended; })) << words;
        const std::string what = std::string(words) + " " + level + ", signal below " + brief(depth);
        EXPECT_EQ(drive->alarm(), "") << what;
        EXPECT_EQ(count(8), 1U) << what << ": the interrupt program has run";
        EXPECT_GE(level_of_traverse, (to_r ? kR : kTop) - 1e-6) << what;
        ASSERT_EQ(bottoms.size(), 2U) << what << ": both holes are made";
        EXPECT_NEAR(bottoms[1], kSecond, kAside) << what;
        if (count(5) + count(19) != 0) {
          EXPECT_EQ(count(3), 1 + count(5) + count(19)) << what << ": the spindle turns again behind each hole";
        }
      }
    }
  }
}

/// From below: the tool would stand under the part, its spindle oriented.
TEST_P(HoleInterrupt, ActsBehindABackBore) {
  bench.add("O1000", "M8\nM99\n");
  start("G87 X5. R-8. Z-4. I1. F900\nX25.");
  ASSERT_TRUE(until([&] { return z() < -7; }));
  interrupt();
  ASSERT_TRUE(until([&] { return drive->ended; }));
  EXPECT_EQ(count(8), 1U);
  EXPECT_GE(level_of_traverse, kTop - 1e-6);
  EXPECT_EQ(count(19), 4U) << "twice for each hole";
  EXPECT_EQ(count(3), 5U);
}

TEST_P(HoleInterrupt, OnTheWayToAHoleActsAtOnce) {
  bench.add("O1000", "G0 Z50.\nM99\n");
  start("G81 X80. Z-8. R2. F900\nG80");
  ASSERT_TRUE(until([&] { return x() > 20; }));
  interrupt();
  double farthest = 0, highest = 0;
  ASSERT_TRUE(until([&] {
    farthest = std::max(farthest, x());
    highest = std::max(highest, z());
    return drive->ended;
  }));
  EXPECT_LT(farthest, 50) << "the rest of the block is lost";
  EXPECT_NEAR(highest, 50, 1e-6);
  EXPECT_TRUE(bottoms.empty());
}

/// Between the holes of one block: the next of them are lost behind M S T B and moves, and made where the interrupt program has none.
TEST_P(HoleInterrupt, BetweenTheHolesOfABlock) {
  bench.add("O1000", "#100=#100+1\nIF[#101EQ0]GOTO9\nM8\nN9 M99\n");
  for (const bool moves : {false, true}) {
    start(std::string("#100=0\n#101=") + (moves ? "1" : "0") + "\nG81 Z-8. R2. F900 L0\nG91 X20. L3\nG90 X90.");
    ASSERT_TRUE(until([&] { return z() < -3; }));
    interrupt();
    ASSERT_TRUE(until([&] { return drive->ended; }));
    EXPECT_EQ(drive->alarm(), "");
    EXPECT_EQ(bench.var_now(100), 1);
    ASSERT_EQ(bottoms.size(), moves ? 2U : 4U);
    EXPECT_NEAR(bottoms[0], 20, 1e-6);
    EXPECT_NEAR(bottoms.back(), 90, 1e-6) << "the next block is made";
    EXPECT_EQ(count(8), moves ? 1U : 0U);
  }
}

/// M700 7.11 (4): the blocks of the mode of tapping are not apart, and behind the first of them the tap is in its thread. So it acts behind the mode.
TEST_P(HoleInterrupt, InTheModeOfTappingActsBehindTheMode) {
  bench.add("O1000", "G0 X7.\nM99\n");
  start("G63\nG1 Z-8. F900\nG1 Z2.\nG64");
  ASSERT_TRUE(until([&] { return z() < -3; }));
  interrupt();
  double lowest = 1e9, aside = 1e9;
  ASSERT_TRUE(until([&] {
    lowest = std::min(lowest, z());
    if (x() > 1e-6) aside = std::min(aside, z());
    return drive->ended;
  }));
  EXPECT_LT(lowest, -7.9);
  EXPECT_NEAR(aside, 2, 1e-6) << "out of the thread";
}

}  // namespace
}  // namespace nc::test
