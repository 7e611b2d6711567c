// SPDX-License-Identifier: Apache-2.0
// M00 and M01 over the hole of a fixed cycle (M700 13.1.1 (2)) on a control that is driven cycle by cycle: where the tool stands, and how many starts it takes.
#include <gtest/gtest.h>

#include "online_helpers.hpp"

namespace nc::test {
namespace {

struct Stops {
  std::vector<double> levels;  ///< of the tool at each stop
  std::vector<nc_stop_cause> causes;
};

/// A finger that starts again behind each stop.
Stops stops_of(const std::string& block, bool single_block, bool optional_stop) {
  Bench bench(NC_DIALECT_M700, machine(256));
  bench.at(0, 0, 10);
  Drive drive(bench, "G0 S600\nM3\n" + block + "\nG80\nM30");
  drive.in.optional_stop = optional_stop;
  Stops stops;
  bool stood = false;
  for (unsigned n = 0; n < 20000 && !drive.ended; ++n) {
    const bool stands = drive.out.state == NC_STATE_STOPPED && drive.out.distance_zero;
    if (stands && !stood && drive.out.source.line == 3) {
      stops.levels.push_back(drive.out.command.v[2]);
      stops.causes.push_back(static_cast<nc_stop_cause>(drive.out.cause));
    }
    stood = stands;
    drive.in.single_block = single_block;
    drive.press_start();
    drive.in.cycle_start = drive.in.cycle_start || (stands && n % 8 == 0);
    drive.step(50);
  }
  EXPECT_TRUE(drive.ended) << block;
  EXPECT_EQ(drive.alarm(), "") << block;
  return stops;
}

TEST(CycleStop, StandsOverTheHole) {
  const Stops stops = stops_of("G81 X5. Z-8. R2. F900 M00", false, false);
  EXPECT_EQ(stops.levels, std::vector<double>{10});
  EXPECT_EQ(stops.causes, std::vector<nc_stop_cause>{NC_CAUSE_PROGRAM_STOP});
  EXPECT_TRUE(stops_of("G81 X5. Z-8. R2. F900 M01", false, false).levels.empty());
  EXPECT_EQ(stops_of("G81 X5. Z-8. R2. F900 M01", false, true).levels, std::vector<double>{10});
}

/// (3): single block stops behind the positioning, at R, and at the end. Behind the positioning one start is enough.
TEST(CycleStop, IsNoSecondOneInSingleBlock) {
  EXPECT_EQ(stops_of("G81 X5. Z-8. R2. F900", true, false).levels, (std::vector<double>{10, 2, 10}));
  EXPECT_EQ(stops_of("G81 X5. Z-8. R2. F900 M00", true, false).levels, (std::vector<double>{10, 2, 10}));
}

}  // namespace
}  // namespace nc::test
