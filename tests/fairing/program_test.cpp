// SPDX-License-Identifier: Apache-2.0
// Fairing and the corner judgement in programs (M700 13.17.1): parameters, other blocks, stops, rewinding, the machine.
#include <gtest/gtest.h>

#include "support/drive.hpp"
#include "support/pull.hpp"
#include "support/seeds.hpp"

#include <random>

namespace nc::test {
namespace {

const std::string kStep = "G1 X10. F1000.\nY.08\nX20.\n", kEnd = "G5 P0\nM30";

Bench& faired(Bench& bench, const char* length = "0.1") { return bench.param("8033", "1").param("8029", length); }

Path path_of(const std::string& text, const std::function<void(Bench&)>& change = [](Bench& bench) { faired(bench); }) {
  Bench bench;
  change(bench);
  return bench.run(text).path();
}

const Path kFaired{"line 10 0.04 0 F1000", "line 20 0.08 0 F1000"};
const Path kProgrammed{"line 10 0 0 F1000", "line 10 0.08 0 F1000", "line 20 0.08 0 F1000"};

TEST(FairingProgram, ParametersAndModes) {
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd), kFaired);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd, [](Bench& b) { b.param("8029", "0.1"); }), kProgrammed);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd, [](Bench& b) { b.param("8033", "1"); }), kProgrammed);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd, [](Bench& b) { faired(b, "0.08"); }), kProgrammed);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd, [](Bench& b) { faired(b).param("8020", "91"); }), kProgrammed);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + kEnd, [](Bench& b) { faired(b).param("8090", "1"); }), kFaired);  // SSS
  EXPECT_EQ(path_of("G5.1 Q1\n" + kStep + "G5.1 Q0\nM30"), kProgrammed);  // mode I
  EXPECT_EQ(path_of("G61.1\n" + kStep + "M30"), kProgrammed);
  EXPECT_EQ(path_of(kStep + "M30"), kProgrammed);
}

TEST(FairingProgram, RangesOfTheParameters) {
  Bench bench;
  const auto takes = [&bench](const char* key, const char* value) { return nc_parameter_set(bench.control(), 0, key, 0, value) == NC_OK; };
  EXPECT_TRUE(takes("8029", "100"));
  EXPECT_FALSE(takes("8029", "100.001"));
  EXPECT_FALSE(takes("8029", "-0.1"));
  EXPECT_TRUE(takes("8037", "99999.999"));
  EXPECT_FALSE(takes("8037", "100000"));
  EXPECT_FALSE(takes("8037", "-1"));
  for (const char* key : {"8033", "8036"}) {
    EXPECT_TRUE(takes(key, "1"));
    EXPECT_FALSE(takes(key, "2"));
  }
}

TEST(FairingProgram, ProgramsSwitchIt) {  // G10 L70: from the next block on
  const std::string on = "G10 L70\nP8029 D0.1\nP8033 D1\nG11\n", off = "G10 L70\nP8033 D0\nG11\n", more = "G1 X30. F1000.\nY.16\nX40.\n";
  Path both = kFaired;
  for (const char* move : {"line 30 0.08 0 F1000", "line 30 0.16 0 F1000", "line 40 0.16 0 F1000"}) both.push_back(move);
  EXPECT_EQ(path_of("G5 P10000\n" + on + kStep + off + more + kEnd, [](Bench&) {}), both);
  Path second = kProgrammed;
  for (const char* move : {"line 30 0.12 0 F1000", "line 40 0.16 0 F1000"}) second.push_back(move);
  EXPECT_EQ(path_of("G5 P10000\n" + kStep + on + more + kEnd, [](Bench&) {}), second);
  // Parameters that do not matter for fairing do not end it.
  const std::string other = "G1 X10. F1000.\nG10 L70\nP8004 D5\nG11\nY.08\nX20.\n", angle = "G1 X10. F1000.\nG10 L70\nP8020 D5\nG11\nY.08\nX20.\n";
  EXPECT_EQ(path_of("G5 P10000\n" + other + kEnd), kFaired);
  EXPECT_EQ(path_of("G5 P10000\n" + angle + kEnd), kProgrammed);
}

TEST(FairingProgram, WhatLiesBetween) {  // precaution (13), and all functions that act at a place
  for (const char* block : {"M8", "S500", "T5", "G0 Z1.", "G2 X12. R1.", "M0", "G53 G0 Z1.", "G92 X9.", "G55"}) {
    const std::string text = std::string("G5 P10000\nG1 X10. F1000.\n") + block + "\nG91 G1 Y.08\nX9.\nG90\n" + kEnd;
    const std::string without = std::string("G1 X10. F1000.\n") + block + "\nG91 G1 Y.08\nX9.\nG90\nM30";
    const auto change = [](Bench& bench) { faired(bench).work_offset(2, {1, 0, 0}); };
    EXPECT_EQ(path_of(text, change), path_of(without, change)) << block;
  }
  for (const char* block : {"", "N5", "(text)", "G90", "F1000.", "G17"}) {
    const std::string text = std::string("G5 P10000\nG1 X10. F1000.\n") + block + "\nY.08\n" + block + "\nX20.\n" + kEnd;
    EXPECT_EQ(path_of(text), kFaired) << block;
  }
  // Radius compensation is applied to the figure as it is programmed.
  const auto with_tool = [](Bench& bench) { faired(bench).tool(1, 1, NC_TOOL_RADIUS).param("8103", "1"); };
  const std::string contour = "G41 D1 G1 X10. Y5. F1000.\nX20.\nY5.08\nX30.\nG40 X40.\n";
  EXPECT_EQ(path_of("G5 P10000\n" + contour + kEnd, with_tool), path_of(contour + "M30", with_tool));
}

TEST(FairingProgram, BlocksAndPositionsStayThoseOfTheProgram) {
  Bench bench;
  const Outcome run = faired(bench).run("G5 P10000\n" + kStep + kEnd);
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(run.work(), (Path{"line 10 0 0 F1000", "line 20 0.08 0 F1000"}));
  std::vector<double> y;
  for (const Step& step : run.steps)
    if (step.item.kind == NC_ITEM_MARK) y.push_back(step.item.u.mark.work.v[1]);
  EXPECT_EQ(y, (std::vector<double>{0, 0, 0.08, 0.08, 0.08, 0.08}));
  EXPECT_EQ(run.end_work.v[1], 0.08);
}

TEST(FairingProgram, AnAlarmBehindTheLines) {
  Bench bench;
  const Outcome run = faired(bench).run("G5 P10000\nG1 X10. F1000.\nY.08\nX20.\nX30. E5\nM30");
  EXPECT_EQ(run.alarm, "P33");
  EXPECT_EQ(run.alarm_line, 5u);
  EXPECT_EQ(run.path(), kFaired);  // what was before it is executed
}

TEST(FairingProgram, AStrokeLimitStopsBeforeItsBlock) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system[0].axis[0].soft_limited = true;
    c.system[0].axis[0].soft_min = -1;
    c.system[0].axis[0].soft_max = 15;
  });
  const Outcome run = faired(bench).run("G5 P10000\nG1 X10. F1000.\nY.08\nX20.\nX5.\nM30");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.path(), (Path{"line 10 0.04 0 F1000"}));
  // The codes of a block go out only when its moves are known to be possible, whether they are held back or not.
  const Outcome coded = bench.run("G5 P10000\nG1 X9. F1000.\nX8.\nM8 X20.\nX5.\nM30");
  EXPECT_EQ(coded.aux(), "");
  EXPECT_EQ(coded.alarm_line, 4u);
}

// ---- random programs -------------------------------------------------------------------------------------------------------

/// Fine segments with protrusions, and everything that may be between them. Numbers are rounded to micrometres.
std::string random_program(uint32_t seed, bool splines = true) {
  std::mt19937 random(seed);
  const auto real = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto coordinate = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return std::string(text);
  };
  std::string text = "G90 G0 X0 Y0 Z5.\nG1 Z0 F" + std::to_string(2000 + random() % 4000) + ".\nG5 P10000\n";
  double x = 0, y = 0;
  for (unsigned i = 0; i < 60; ++i) {
    const bool is_short = random() % 2 != 0;
    x += is_short ? real(-0.03, 0.08) : real(0.1, 2);
    y += is_short ? real(-0.08, 0.08) : real(-0.2, 0.2);
    switch (random() % 24) {
      case 0: text += "M8\n"; break;
      case 1: text += "G0 Z1.\nG1 Z0\n"; break;
      case 2: text += "\n"; break;
      case 3: text += "F" + std::to_string(1000 + random() % 5000) + ".\n"; break;
      case 4: text += "M98 H10\n"; break;
      case 5:
        text += "G10 L70\nP8029 D" + std::string(random() % 2 != 0 ? "0.05" : "0.15") + "\nP8020 D" + std::to_string(random() % 20) + "\nG11\n";
        break;
      case 6: text += "M0\n"; break;
      case 7: text += "S" + std::to_string(i) + " "; break;
      case 8:
        for (unsigned n = 0; random() % 4 == 0 && n < 50; ++n) text += "N1\n";
        break;
      case 9:
        if (splines) text += "G5.1 Q" + std::string(random() % 2 != 0 ? "2 X0 Y0 Z0" : "0") + "\n";
        break;
      default: break;
    }
    text += "G1 X" + coordinate(x) + " Y" + coordinate(y) + "\n";
  }
  return text + "G5 P0\nM30\nN10\nG91 X.03 Y.05\nX.03 Y-.05\nG90\nM99\n";
}

Bench& fine_parameters(Bench& bench, uint32_t seed) {
  faired(bench).param("8025", "1").param("8030", "0.5").param("8036", seed % 2 != 0 ? "1" : "0").param("8037", "0.1").param("1206", "6000").param("1207", "100");
  return bench;
}

const auto kPrograms = static_cast<uint32_t>(seeds(40, 12));

TEST(FairingProgram, FromAnyMarkTheSameAgain) {
  unsigned moves = 0, blocks = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = random_program(seed);
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 1024; });
    const Outcome whole = fine_parameters(bench, seed).run(text);
    ASSERT_EQ(whole.alarm, "") << whole.alarm_line << whole.alarm_detail;
    moves += static_cast<unsigned>(whole.moves().size());
    for (char c : text) blocks += c == 'X';
    std::mt19937 random(seed);
    std::vector<const Step*> marks;
    for (const Step& step : whole.steps)
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) marks.push_back(&step);
    for (unsigned i = 0; i < 25; ++i) {
      const Step& mark = *marks[random() % marks.size()];
      ASSERT_EQ(bench.rewind(mark.item.serial, mark.machine), NC_OK);
      const Outcome rest = bench.finish(1 + random() % 50);
      ASSERT_EQ(rest.steps.size(), whole.steps.size() - mark.item.serial);
      for (size_t k = 0; k < rest.steps.size(); ++k) ASSERT_EQ(exactly(rest.steps[k]), exactly(whole.steps[mark.item.serial + k]));
    }
  }
  EXPECT_LT(moves, blocks);  // lines have been left out
}

struct Disturbance {
  bool hold = false, single = false, recalculate = false, optimal = false;
  uint32_t look_ahead = 64;
};

/// Expects that the machine executes the items that are pulled, with every block end in its place.
void compare(const Disturbance& disturb) {
  unsigned recalculated = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = random_program(seed, !disturb.optimal);
    Bench offline;
    const Outcome expected = fine_parameters(offline, seed).run(text);
    Bench online(NC_DIALECT_M700, [&disturb](nc_config& c) {
      c.look_ahead = disturb.look_ahead;
      c.cycle_s = 0.004;
      if (disturb.optimal) c.motion_mode = NC_MOTION_OPTIMAL, c.path_tolerance = 0.01;
      for (unsigned i = 0; i < 3; ++i) {
        nc_axis_config& axis = c.system[0].axis[i];
        axis.rapid = axis.max_velocity = 400;
        axis.max_acceleration = 10000;
        if (disturb.optimal) axis.max_jerk = 500000;
      }
    });
    fine_parameters(online, seed);
    Drive drive(online, text);
    std::mt19937 random(seed);
    bool asking = false;
    for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
      if (random() % 3 != 0 || n < 3) nc_feed(online.control(), 1 + random() % 40);
      const bool stopped = drive.out.state == NC_STATE_STOPPED;
      if (asking || (disturb.recalculate && stopped && random() % 3 == 0)) {
        const nc_status status = nc_recalculate(online.control(), 0);
        recalculated += status == NC_OK;
        asking = status == NC_WAITING && stopped;
      }
      drive.in.cycle_start = !asking && (n == 2 || (n > 2 && n % 7 == 0));
      if (disturb.hold) drive.in.feed_hold = random() % 40 < 3;
      if (disturb.single) drive.in.single_block = (n / 500) % 2 == 0;
      drive.step(0);
    }
    ASSERT_TRUE(drive.ended) << drive.alarm();
    ASSERT_EQ(drive.events.size(), expected.steps.size());
    for (size_t i = 0; i < drive.events.size(); ++i) {
      const Step& step = expected.steps[i];
      const nc_event& event = drive.events[i];
      ASSERT_EQ(event.serial, step.item.serial);
      ASSERT_EQ(event.kind, step.item.kind) << event.serial;
      ASSERT_EQ(event.source.line, step.item.source.line) << event.serial;
      const double near = disturb.optimal ? 0.0101 : 1e-9;  // a joint that is passed may be missed by the tolerance
      for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NEAR(event.machine.v[axis], step.machine.v[axis], near) << event.serial;
    }
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(drive.out.command.v[axis], expected.steps.back().machine.v[axis], 1e-9);
  }
  if (disturb.recalculate) {
    EXPECT_GT(recalculated, kPrograms);
  }
}

TEST(FairingOnline, ExecutesWhatWasPulled) { compare({.look_ahead = 256}); }
TEST(FairingOnline, HoldsAndASmallRing) { compare({.hold = true}); }
TEST(FairingOnline, SingleBlock) { compare({.single = true}); }
TEST(FairingOnline, RecalculationAtEveryStop) { compare({.single = true, .recalculate = true}); }
TEST(FairingOnline, OptimalMode) { compare({.hold = true, .optimal = true}); }

/// Single block stops behind every block, also where a line has been left out: the machine stands at the joint then.
TEST(FairingOnline, SingleBlockStopsAtTheJoint) {
  Bench bench;
  Drive drive(faired(bench), "G5 P10000\n" + kStep + kEnd);
  drive.in.single_block = true;
  std::vector<std::string> stops;
  uint64_t blocks = 0;
  for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
    drive.in.cycle_start = n % 10 == 2;
    drive.step();
    if (drive.out.state != NC_STATE_STOPPED || drive.out.blocks == blocks) continue;
    blocks = drive.out.blocks;
    stops.push_back(std::to_string(blocks) + ": " + brief(drive.out.command.v[0]) + " " + brief(drive.out.command.v[1]));
  }
  EXPECT_EQ(stops, (std::vector<std::string>{"1: 0 0", "2: 10 0.04", "3: 10 0.04", "4: 20 0.08", "5: 20 0.08"}));
}

/// While lines are held back, the reader does not go so far ahead that the block at which the machine has stopped is forgotten.
TEST(FairingOnline, ALongWayAheadOfAStop) {
  for (unsigned empty = 30; empty < 60; ++empty) {
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 64; });
    std::string text = "G5 P10000\nG1 X1. F1000.\n";
    for (unsigned n = 0; n < empty; ++n) text += "N1\n";
    for (unsigned n = 2; n < 25; ++n) text += "G1 X" + std::to_string(n) + ".\nN1\n";
    Drive drive(faired(bench), text + kEnd);
    bool asked = false;
    for (unsigned n = 0; n < 100000 && !drive.ended && drive.alarm().empty(); ++n) {
      drive.in.single_block = !asked;
      const bool there = drive.out.state == NC_STATE_STOPPED && drive.out.blocks >= 2;
      if (there && !asked) {
        for (unsigned k = 0; k < 50; ++k) nc_feed(bench.control(), 100);
        asked = nc_recalculate(bench.control(), 0) == NC_OK;
      }
      drive.in.cycle_start = n % 10 == 2 && (!there || asked);
      drive.step();
    }
    ASSERT_TRUE(asked && drive.ended) << empty << " " << drive.alarm();
    ASSERT_NEAR(drive.out.command.v[0], 24, 1e-9);
  }
}

/// An axis is moved by hand while the machine stands at a joint: every line from there goes to its own end, and incremental ones keep their length.
TEST(FairingOnline, MovedByHandAtTheJoint) {
  for (const unsigned stop_behind : {2u, 3u}) {
    Bench bench;
    Drive drive(faired(bench), "G5 P10000\nG91\n" + kStep + "X5. Y0.02\nX5.\n" + kEnd);
    drive.in.single_block = true;
    bool jogged = false;
    unsigned jogging = 0;
    for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
      const bool here = (drive.out.state == NC_STATE_STOPPED || drive.out.state == NC_STATE_MANUAL) && drive.out.blocks == stop_behind + 1;
      if (here && !jogged && jogging < 40) {
        ++jogging;
        drive.in.cycle_start = false;
        drive.in.manual[2] = {NC_MANUAL_JOG, jogging < 20 ? 3.0 : 0.0, 0};
      } else {
        jogged = jogged || jogging >= 40;
        drive.in.manual[2] = {};
        drive.in.cycle_start = n % 10 == 2;
      }
      drive.step();
    }
    ASSERT_TRUE(drive.ended);
    EXPECT_NEAR(drive.out.command.v[0], 40, 1e-9) << stop_behind;
    EXPECT_NEAR(drive.out.command.v[1], 0.1, 1e-9) << stop_behind;
    EXPECT_GT(drive.out.command.v[2], 0.03) << stop_behind;  // it has been moved
    EXPECT_EQ(drive.ends().size(), stop_behind == 2 ? 5u : 4u);  // stopped before it, the line that was left out is executed
  }
}

/// A reset while lines are held back: blocks that were only read ahead have no effect.
TEST(FairingOnline, AResetForgetsWhatIsHeld) {
  for (unsigned cycles = 5; cycles < 800; cycles += 53) {
    Bench bench;
    Drive drive(fine_parameters(bench, 1), random_program(3));
    while (drive.cycle < cycles + 3000 && !(drive.in.reset && drive.out.state == NC_STATE_IDLE)) {
      drive.press_start();
      drive.in.reset = drive.cycle >= cycles;
      drive.step();
    }
    ASSERT_EQ(drive.out.state, NC_STATE_IDLE);
    drive.in.reset = false;
    const size_t before = drive.events.size();
    const std::pair<double, double> at{drive.out.command.v[0], drive.out.command.v[1]};
    for (unsigned n = 0; n < 50; ++n) drive.step();
    EXPECT_EQ(drive.events.size(), before);
    EXPECT_EQ(drive.out.command.v[0], at.first);
    EXPECT_EQ(drive.out.command.v[1], at.second);
  }
}

/// A block that is skipped only at the second reading: the line that fairing had left out after the mark does not exist any more.
TEST(FairingProgram, ASwitchOfBlockSkipBetweenTwoReadings) {
  Bench bench;
  const Outcome whole = faired(bench).run("G5 P10000\nG1 X10. F1000.\n/Y.08\nX20.\nY3.\n" + kEnd);
  ASSERT_EQ(whole.path()[0], "line 10 0.04 0 F1000");
  const Step* mark = nullptr;
  for (const Step& step : whole.steps)
    if (step.item.kind == NC_ITEM_MARK && step.item.source.line == 2) mark = &step;
  nc_switches_set(bench.control(), 0, 2, 0);
  ASSERT_EQ(bench.rewind(mark->item.serial, mark->machine), NC_OK);
  EXPECT_EQ(bench.finish().path(), (Path{"line 20 0 0 F1000", "line 20 3 0 F1000"}));  // the long line is not mistaken for the short one
}

// ---- corners ---------------------------------------------------------------------------------------------------------------

/// Lowest path speed between X9 and X11, mm/s.
double slowest_around_ten(const std::function<void(Bench&)>& change, const std::string& text) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.cycle_s = 0.004;
    for (unsigned i = 0; i < 3; ++i) {
      nc_axis_config& axis = c.system[0].axis[i];
      axis.rapid = axis.max_velocity = 500;
      axis.max_acceleration = 1000;
    }
  });
  bench.param("1206", "60").param("1207", "10").param("8020", "10");  // dV = 6 mm/min: 0.1 mm/s
  change(bench);
  Drive drive(bench, text);
  double least = 1e9;
  nc_axes before{};
  for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
    drive.press_start();
    drive.step();
    const nc_axes& at = drive.out.command;
    if (before.v[0] > 9 && at.v[0] < 11) least = std::min(least, std::hypot(at.v[0] - before.v[0], at.v[1] - before.v[1]) / 0.004);
    before = at;
  }
  EXPECT_TRUE(drive.ended);
  return least;
}

/// A step of 20 degrees in a straight path. As two corners of 20 degrees it allows 0.1 / (2 sin 10) = 0.29 mm/s, and one cycle of acceleration is
/// 4 mm/s. Without the short line there is no corner, and the feed of 5 mm/s stays: the axes allow v (v dt / 0.05 mm + 1) sin 20 =
/// 0.75 * 4 mm/s, that is, v = 6 mm/s. (The chord over a corner within one cycle is 5 cos 10.)
TEST(CornerJudgementOnline, AShortStepIsNoCorner) {
  const std::string text = "G5 P10000\nG1 X10. F300.\nX10.047 Y.017\nX30.\n" + kEnd;
  EXPECT_LT(slowest_around_ten([](Bench&) {}, text), 3);
  EXPECT_NEAR(slowest_around_ten([](Bench& b) { b.param("8036", "1").param("8037", "0.1"); }, text), 5, 0.08);
  EXPECT_LT(slowest_around_ten([](Bench& b) { b.param("8036", "1").param("8037", "0.01"); }, text), 3);  // the line is not shorter
  EXPECT_LT(slowest_around_ten([](Bench& b) { b.param("8036", "1"); }, text), 3);
  // G10 L70 switches it on before the lines, and off after them.
  const std::string on = "G10 L70\nP8037 D0.1\nP8036 D1\nG11\n", off = "G10 L70\nP8036 D0\nG11\n";
  EXPECT_NEAR(slowest_around_ten([](Bench&) {}, "G5 P10000\n" + on + "G1 X10. F300.\nX10.047 Y.017\nX30.\n" + off + kEnd), 5, 0.08);
  EXPECT_LT(slowest_around_ten([](Bench&) {}, "G5 P10000\n" + on + off + "G1 X10. F300.\nX10.047 Y.017\nX30.\n" + kEnd), 3);
}

/// Parameters that a program changes after lines which are still held back do not act on these lines.
TEST(CornerJudgementOnline, ParametersBehindTheLinesAreNotTheirs) {
  const std::string lines = "G5 P10000\nG1 X10. F300.\nX10.047 Y.017\nX30.\n", faster = "G10 L70\nP1206 D600000\nG11\n";
  const auto held = [](Bench& bench) { faired(bench, "0.01"); };
  EXPECT_LT(slowest_around_ten(held, lines + faster + kEnd), 3);
  EXPECT_NEAR(slowest_around_ten(held, faster + lines + kEnd), 5, 0.08);
}

/// An interrupt program never comes between lines that are held back: both modes exclude each other (M700 13.17.1).
TEST(FairingProgram, NoMacroInterruptInTheMode) {
  Bench bench;
  bench.param("1109", "1").add("O1", "M99\n");
  EXPECT_EQ(faired(bench).run("M96 P1\nG5 P10000\nM30").alarm, "P34");
  EXPECT_EQ(bench.run("G5 P10000\nG1 X10. F1000.\nM96 P1\nM30").alarm, "P33");
}

/// A sharp corner between short lines is still passed within the limits of the axes.
TEST(CornerJudgementOnline, TheAxesKeepTheirLimits) {
  const std::string text = "G5 P10000\nG1 X10. F300.\nY.05\nX10.05\nX30.\n" + kEnd;
  EXPECT_LT(slowest_around_ten([](Bench& b) { b.param("8036", "1").param("8037", "0.1"); }, text), 4);  // a step of 3 mm/s, and half a cycle of acceleration
}

}  // namespace
}  // namespace nc::test
