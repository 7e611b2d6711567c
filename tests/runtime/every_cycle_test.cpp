// SPDX-License-Identifier: Apache-2.0
// examples/parts/every-cycle.nc, with every fixed cycle of the m700 family and every pattern, on the simulated machine that is shipped (M700 13.1, 13.2). The
// picture in docs/cycles.md is made of it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "ladder_machine.hpp"

namespace {

class EveryCycle : public nc::test::LadderMachine {};

TEST_F(EveryCycle, IsMadeByTheMachine) {
  std::ifstream file(nc::test::kSourceDir + "/examples/parts/every-cycle.nc");
  std::stringstream text;
  text << file.rdbuf();
  for (const char* code : {"G73", "G74", "G75", "G76", "G81", "G82", "G83", "G84", "G85", "G86", "G87", "G88", "G89", "G34", "G35", "G36", "G37.1"})
    EXPECT_NE(text.str().find(std::string(code) + " "), std::string::npos) << code;
  build();
  const std::uint64_t runs = runtime->info().system[0].runs;
  start(text.str());
  double deepest = 0, apart = 0, began = 0;
  bool held = false;
  const int scans = until(
      [&] {
        const nc_outputs now = out();
        deepest = std::min(deepest, now.work.v[2]);
        // In a tap the axis goes with the spindle as it has really turned.
        if (now.spindle_synchronous != 0 && held) apart = std::max(apart, std::fabs(std::fabs(now.work.v[2] - 3) - std::fabs(machine->spindle_turns(0, 0) - began)));
        if (now.spindle_synchronous == 0 || !held) began = machine->spindle_turns(0, 0);
        held = now.spindle_synchronous != 0 && (held || std::fabs(machine->spindle_rpm(0, 0)) < 1e-3);
        return (now.state == NC_STATE_IDLE && runtime->info().system[0].runs > runs) || !alarm().empty();
      },
      600000);
  EXPECT_GE(scans, 0);
  EXPECT_EQ(alarm(), "");
  EXPECT_NEAR(deepest, -14, 1e-6) << "G87 from below";
  EXPECT_LT(apart, 2e-3) << "mm, at a lead of 1 mm";
  EXPECT_NEAR(out().work.v[2], 12, 1e-6);
}

}  // namespace
