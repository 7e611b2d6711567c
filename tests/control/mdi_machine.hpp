// SPDX-License-Identifier: Apache-2.0
// A machine whose program is interrupted by blocks of MDI in a block stop.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/watched_machine.hpp"

namespace nc::test {

/// In single block, with a tool of 4 mm; blocks of MDI are loaded and run to their end.
class MdiMachine : public WatchedMachine {
 public:
  explicit MdiMachine(bool optimal, nc_dialect dialect = NC_DIALECT_M700) : WatchedMachine(dialect, "XYZ", {200, 200, 200}, optimal, 40) { bench.tool(1, 4); }
  bool stands() const { return drive->out.state != NC_STATE_RUNNING && drive->out.state != NC_STATE_HOLD; }
  bool until_stop() {
    step(12);
    for (unsigned n = 0; n < 60000 && !stands(); ++n) step();
    step(3);
    return stands();
  }
  /// Presses start, and again at each block stop, until the machine stands at the n-th stop from here.
  void stops(unsigned n) {
    for (; n > 0; --n) {
      press();
      EXPECT_TRUE(until_stop());
    }
  }
  nc_status load(const std::string& text) { return nc_mdi_load(bench.control(), 0, text.data(), text.size()); }
  /// Runs to the stop behind blocks of MDI, from block stop to block stop.
  bool to_end_of_mdi() {
    for (unsigned n = 0; n < 40; ++n) {
      press();
      if (!until_stop()) return false;
      if (drive->out.state != NC_STATE_STOPPED) return false;
      if (drive->out.cause == NC_CAUSE_MDI_ENDED) return true;
    }
    return false;
  }
  bool to_end_of_program() {
    drive->in.single_block = false;
    for (unsigned n = 0; n < 20 && !drive->ended; ++n) {
      press();
      if (!until_stop()) return false;
    }
    return drive->ended && drive->alarm().empty();
  }
  void expect_at(double x, double y, double z = 0, double near = 1e-6) const {
    EXPECT_NEAR(drive->out.command.v[0], x, near);
    EXPECT_NEAR(drive->out.command.v[1], y, near);
    EXPECT_NEAR(drive->out.command.v[2], z, near);
  }
  std::string state() const { return "state " + std::to_string(drive->out.state) + " cause " + std::to_string(drive->out.cause) + " line " + std::to_string(drive->out.source.line); }
};

}  // namespace nc::test
