// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside (nc/restart.h) has given out its tools and its spindle on paper. What the machine has is known beside it: a family that passes
// over the tool that is held passes over that of the machine, and a reset in the stop leaves it.
#include <gtest/gtest.h>

#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

/// A machine of any family that notes what goes out to it.
class ToolMachine : public WatchedMachine {
 public:
  explicit ToolMachine(nc_dialect dialect) : WatchedMachine(dialect, "XYZ", {200, 200, 200}, false, 40) {
    for (int tool = 1; tool < 5; ++tool) bench.tool(tool, 10.0 * tool);
  }
  void load(const std::string& text) {
    drive = std::make_unique<Drive>(bench, text);
    step(3);
  }
  void enter(uint32_t line) {
    nc_restart_place place;
    nc_restart_place_init(&place);
    place.by = NC_RESTART_LINE;
    place.number = line;
    nc_restart_found found;
    nc_restart_found_init(&found);
    ASSERT_EQ(nc_restart_begin(bench.control(), 0, &place, nullptr), NC_OK);
    nc_status status = NC_BUDGET;
    while (status == NC_BUDGET) status = nc_restart_find(bench.control(), 0, 10, &found);
    ASSERT_EQ(status, NC_OK);
    go();
    ASSERT_EQ(drive->out.cause, NC_CAUSE_RESTART);
  }
  /// One start; what has gone out until the machine stands.
  std::string go() {
    std::string given;
    drive->in.cycle_start = true;
    for (unsigned n = 0; n < 40000 && (n < 15 || drive->out.state == NC_STATE_RUNNING); ++n) {
      const uint8_t before = drive->out.strobe;
      step();
      drive->in.cycle_start = n < 1;
      const unsigned rising = drive->out.strobe & ~unsigned{before};
      if ((rising & 4) != 0) given += " T" + std::to_string(drive->out.t);
      if ((rising & 1) != 0) given += " M" + std::to_string(drive->out.m);
    }
    step(5);
    return given.empty() ? given : given.substr(1);
  }
  std::string mdi(const std::string& blocks) {
    EXPECT_EQ(nc_mdi_load(bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
    const std::string given = go();
    EXPECT_EQ(drive->out.cause, NC_CAUSE_MDI_ENDED) << drive->alarm();
    return given;
  }
  void reset() {
    drive->in.reset = true;
    step(5);
    drive->in.reset = false;
    step(5);
  }
  double ends(const std::string& text) {
    load(text);
    go();
    EXPECT_TRUE(drive->alarm().empty()) << drive->alarm();
    return drive->out.command.v[2];
  }
};

const struct {
  nc_dialect dialect;
  const char *program, *change, *given, *spindle;
  uint32_t line;
} kFamilies[] = {
    {NC_DIALECT_M700, "T1 M6\nM3 S500\nG0 X0\nG0 X0\nM30", "T1 M6", "T1 M6", "M3 S500", 4},
    {NC_DIALECT_DGSHAPE, "%\nM06T1\nM03S5000\nG00X0\nG00X0\nM30", "M06T1", "T1 M6", "M03S5000", 5},
    {NC_DIALECT_ISO, "T1 M6\nM3 S500\nG0 X0\nG0 X0\nM30", "T1 M6", "T1 M6", "M3 S500", 4},
    {NC_DIALECT_HX, "T1\nM6\nM3 S500\nG0 X0\nG0 X0\nM30", "T1\nM6", "T1 M6", "M3 S500", 5},
    {NC_DIALECT_SERIES8, "T1 M6\nM3 S500\nG0 X0\nG0 X0\nM30", "T1 M6", "T1 M6", "M3 S500", 4},
};

TEST(RestartTool, WhatTheMachineDoesNotHaveGoesOutFromTheStop) {
  for (const auto& family : kFamilies) {
    SCOPED_TRACE(family.dialect);
    ToolMachine m(family.dialect);
    m.load(family.program);
    m.enter(family.line);
    EXPECT_EQ(m.mdi(family.change), family.given);
    EXPECT_EQ(m.mdi(family.spindle), "M3");
    const bool passes_over = family.dialect == NC_DIALECT_DGSHAPE;
    EXPECT_EQ(m.mdi(family.change), passes_over ? "" : family.given) << "now it has it";
    EXPECT_EQ(m.mdi(family.spindle), passes_over ? "" : "M3");
    EXPECT_EQ(m.mdi("M05"), "M5");
    EXPECT_EQ(m.mdi(family.spindle), "M3");
    EXPECT_EQ(m.go(), "M30") << m.drive->alarm();
  }
}

// The operator has confirmed that the tool is in the spindle, without a change.
TEST(RestartTool, IsThatOfTheProgramOnceItHasGoneOn) {
  ToolMachine m(NC_DIALECT_DGSHAPE);
  m.load("%\nM06T1\nM03S5000\nG00X0\nM06T1\nM00\nM06T2\nM30");
  m.enter(4);
  EXPECT_EQ(m.go(), "M0");
  EXPECT_EQ(m.mdi("M06T1"), "") << "in another stop";
  EXPECT_EQ(m.go(), "T2 M6 M30");
}

// `iso` takes the length of the tool in the spindle where G43 has no H.
TEST(RestartTool, AResetInTheStopLeavesTheOneThatTheMachineHas) {
  const std::string program = "T3 M6\nG0 X0\nX0\nM30\n";
  const struct {
    const char* mdi;
    double length;
  } cases[] = {{"", 10}, {"T2 M6", 20}, {"T4", 10}, {"T3 M6", 30}};
  for (const auto& given : cases) {
    SCOPED_TRACE(given.mdi);
    ToolMachine m(NC_DIALECT_ISO);
    EXPECT_NEAR(m.ends("T1 M6\nG43\nG0 Z5\nM30\n"), 15, 1e-9);
    m.load(program);
    m.enter(3);
    if (*given.mdi != 0) m.mdi(given.mdi);
    m.reset();
    EXPECT_NEAR(m.ends("G43\nG0 Z6\nM30\n"), 6 + given.length, 1e-9);
  }
}

TEST(RestartTool, AResetAmidTheBlocksOfMdiLeavesWhatTheyHaveGivenOut) {
  ToolMachine m(NC_DIALECT_ISO);
  m.ends("T1 M6\nM30\n");
  m.load("T3 M6\nG0 X0\nX0\nM30\n");
  m.enter(3);
  const std::string blocks = "T2 M6\nM0\nT4 M6\nG4 P5";
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
  EXPECT_EQ(m.go(), "T2 M6 M0");
  m.reset();
  EXPECT_NEAR(m.ends("G43\nG0 Z6\nM30\n"), 26, 1e-9);
}

TEST(RestartTool, BehindTheStopTheProgramHasChangedIt) {
  for (const bool ends : {false, true}) {
    ToolMachine m(NC_DIALECT_ISO);
    m.ends("T1 M6\nM30\n");
    m.load("T3 M6\nG0 X0\nG4 P0.01\nM0\nM30\n");
    m.enter(3);
    m.mdi("T2 M6");  // and then the right one by hand, which the operator confirms
    m.go();
    if (ends) {
      m.go();
    } else {
      m.reset();
    }
    EXPECT_NEAR(m.ends("G43\nG0 Z6\nM30\n"), 36, 1e-9) << ends;
  }
}

// Another place is not found, or what has changed makes the one that was found void: nothing of the search has come to the machine.
TEST(RestartTool, AVoidPlaceLeavesTheOneThatTheMachineHas) {
  ToolMachine m(NC_DIALECT_ISO);
  m.ends("T1 M6\nM30\n");
  for (unsigned twice = 0; twice < 2; ++twice) {
    m.load("T3 M6\nG0 X0\nX0\nM30\n");
    nc_restart_place place;
    nc_restart_place_init(&place);
    place.by = NC_RESTART_LINE;
    place.number = 3;
    nc_restart_found found;
    nc_restart_found_init(&found);
    ASSERT_EQ(nc_restart_begin(m.bench.control(), 0, &place, nullptr), NC_OK);
    nc_status status = NC_BUDGET;
    while (status == NC_BUDGET) status = nc_restart_find(m.bench.control(), 0, 10, &found);
    ASSERT_EQ(status, NC_OK);
    m.bench.work_offset(1, {1.0 + twice, 0, 0});
    m.go();
    EXPECT_EQ(m.drive->alarm(), "NC-RESTART");
    m.reset();
    EXPECT_NEAR(m.ends("G43\nG0 Z6\nM30\n"), 16, 1e-9);
  }
}

}  // namespace
}  // namespace nc::test
