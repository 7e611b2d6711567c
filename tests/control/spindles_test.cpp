// SPDX-License-Identifier: Apache-2.0
// Several spindles of a part system, selected from outside (M700 10.6.1), on a control that is driven cycle by cycle.
#include "online_helpers.hpp"

#include <gtest/gtest.h>

namespace nc::test {
namespace {

std::function<void(nc_config&)> with_spindles(unsigned count) {
  return [count](nc_config& c) {
    machine(256)(c);
    c.system[0].spindle_count = static_cast<uint8_t>(count);
  };
}

/// Runs to the end, for `most` cycles at most, and calls `each` in every cycle.
template <class Each>
bool run(Drive& drive, Each each, unsigned most = 20000) {
  for (unsigned n = 0; n < most && !drive.ended; ++n) {
    drive.press_start();
    each(drive.in, drive.out);
    drive.step(50);
  }
  return drive.ended;
}

TEST(Spindles, TheSelectedOneTakesTheSCommand) {
  Bench bench(NC_DIALECT_M700, with_spindles(3));
  Drive drive(bench, "M21\nS500\nG4 P40\nM22\nS800\nG4 P40\nM26\nG92 S600\nG4 P40\nM30");
  bench.param("1146", "1");
  std::string seen;
  ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
    if (out.m >= 21 && out.m <= 26) in.spindle_select = static_cast<uint8_t>(out.m - 20);  // as a ladder does it, before FIN
    if (out.cause != NC_CAUSE_DWELL) return;
    const std::string now = std::to_string(out.source.line) + ":" + brief(out.spindle_rev_min[0]) + "," + brief(out.spindle_rev_min[1]) + "," +
                            brief(out.spindle_rev_min[2]) + " ";
    if (seen.find(now) == std::string::npos) seen += now;
    EXPECT_EQ(out.s, out.m == 21 ? 500 : out.m == 22 ? 800 : 600);
    EXPECT_EQ(out.spindle_selected, in.spindle_select);
  }));
  EXPECT_EQ(seen, "3:500,0,0 6:500,800,0 9:500,600,600 ");
}

TEST(Spindles, OneSpindleNeedsNoSelection) {
  Bench bench(NC_DIALECT_M700, machine(256));
  Drive drive(bench, "S500\nG4 P40\nM30");
  ASSERT_TRUE(run(drive, [](nc_inputs&, const nc_outputs& out) {
    if (out.cause == NC_CAUSE_DWELL) {
      EXPECT_EQ(out.spindle_rev_min[0], 500);
    }
  }));
}

// 10.6.1, relation (3): the selected encoder counts, or if none is selected that of the selected spindle.
TEST(Spindles, FeedPerRevolutionGoesByTheSelectedEncoder) {
  for (const unsigned encoder : {0u, 1u, 2u}) {
    Bench bench(NC_DIALECT_M700, with_spindles(2));
    Drive drive(bench, "G95 G1 X20. F2.\nM30");
    drive.in.spindle[0].rev_per_s = 5;
    drive.in.spindle[1].rev_per_s = 10;
    double fastest = 0;
    ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
      in.spindle_select = 2;
      in.spindle_encoder = static_cast<uint8_t>(encoder);
      fastest = std::max(fastest, out.feed_mm_min);
    }));
    EXPECT_NEAR(fastest, 2 * (encoder == 1 ? 5 : 10) * 60, 1e-6) << encoder;
  }
}

TEST(Spindles, AnEncoderThatIsNotThereTurnsNothing) {
  Bench bench(NC_DIALECT_M700, with_spindles(2));
  Drive drive(bench, "G95 G1 X20. F2.\nM30");
  drive.in.spindle[1].rev_per_s = 10;
  bool waited = false;
  ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
    in.spindle_select = 1;
    in.spindle_encoder = drive.cycle < 500 ? 3 : 2;
    if (drive.cycle < 500 && out.cause == NC_CAUSE_SPINDLE_STOPPED) waited = true;
    if (drive.cycle < 500) {
      EXPECT_EQ(out.command.v[0], 0);
    }
  }));
  EXPECT_TRUE(waited);
}

// When no spindle is selected any more, the encoder of the last one counts, since that spindle turns on.
TEST(Spindles, TheEncoderStaysWhenTheSelectionGoes) {
  Bench bench(NC_DIALECT_M700, with_spindles(2));
  Drive drive(bench, "S600\nG95 G1 X20. F2.\nM30");
  drive.in.spindle[0].rev_per_s = 0;
  drive.in.spindle[1].rev_per_s = 10;
  ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) { in.spindle_select = out.source.line < 2 ? 2 : 0; }));
  EXPECT_EQ(drive.out.spindle_rev_min[1], 600);
}

TEST(Spindles, AThreadKeepsItsSpindle) {  // 10.6.1, relation (3)
  Bench bench(NC_DIALECT_M700, with_spindles(2));
  Drive drive(bench, "S600 M3\nG33 Z-20. F2.\nM30");
  ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
    in.spindle_select = out.command.v[2] < -5 ? 2 : 1;
    for (unsigned n = 0; n < 2; ++n) {
      in.spindle[n].rev_per_s = n == 0 ? 10 : 3;
      in.spindle[n].turns_valid = true;
      in.spindle[n].turns += in.spindle[n].rev_per_s * 0.004;
    }
    if (out.command.v[2] < -8 && out.command.v[2] > -15) {
      EXPECT_EQ(out.spindle_encoder, 1);
      EXPECT_NEAR(out.velocity.v[2], -20, 0.5) << "at the pace of the first";
    }
  }));
  EXPECT_EQ(drive.out.spindle_selected, 2) << "the selection acts behind the thread";
}

// The direction counts that M03 or M04 of the program has commanded for the selected spindle.
TEST(Spindles, AThreadWaitsForASpindleThatTurnsTheOtherWayRound) {
  for (const char* code : {"M3", "M4", "M4\nM5\nM3", "M3\nM05"}) {
    Bench bench(NC_DIALECT_M700, with_spindles(2));
    Drive drive(bench, std::string("S600 ") + code + "\nG33 Z-20. F2.\nM30");
    const bool stopped = std::string(code) == "M3\nM05", reverse = std::string(code) == "M4";
    bool waited = false;
    ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
      in.spindle_select = 2;
      in.spindle[1].rev_per_s = (reverse ? -1 : 1) * (drive.cycle < 500 ? -10 : 10);
      if (out.cause != NC_CAUSE_SPINDLE_REVERSED) return;
      waited = true;
      EXPECT_EQ(out.command.v[2], 0);
      EXPECT_LE(drive.cycle, 501u);
    })) << code;
    EXPECT_EQ(waited, !stopped) << code;
    EXPECT_NEAR(drive.out.command.v[2], -20, 1e-9);
  }
}

// A direction that was commanded before a reset, or in the program before, does not count.
TEST(Spindles, TheWayRoundIsForgottenAtTheEndOfAProgram) {
  Bench bench(NC_DIALECT_M700, machine(256));
  Drive drive(bench, "IF[#500EQ1]GOTO9\n#500=1\nS600 M4\nM30\nN9 G33 Z-20. F2.\nM30");
  ASSERT_TRUE(run(drive, [](nc_inputs&, const nc_outputs&) {}));
  ASSERT_EQ(nc_program_select(bench.control(), 0, 0), NC_OK);
  drive.ended = false;
  drive.cycle = 0;
  ASSERT_TRUE(run(drive, [](nc_inputs& in, const nc_outputs& out) {
    in.spindle[0].rev_per_s = 10;
    EXPECT_NE(out.cause, NC_CAUSE_SPINDLE_REVERSED);
  }));
  EXPECT_NEAR(drive.out.command.v[2], -20, 1e-9);
}

TEST(Spindles, AMaskOfSpindlesThatThereAre) {
  nc_config c;
  nc_config_init(&c);
  c.system[0].spindle_count = 2;
  nc_config_fault fault;
  for (const uint64_t mask : {0u, 1u, 2u, 3u}) {
    c.system[0].spindle_unsigned = mask;
    EXPECT_EQ(nc_config_check(&c, &fault), NC_OK) << mask;
  }
  c.system[0].spindle_unsigned = 4;
  ASSERT_EQ(nc_config_check(&c, &fault), NC_E_ARGUMENT);
  EXPECT_STREQ(fault.field, "system[0].spindle_unsigned");
}

// 10.6.1, relation (5): the selection must not change in the tapping mode. If it does, a move does not begin until the old selection is back.
TEST(Spindles, TheTappingModeKeepsItsSpindle) {
  Bench bench(NC_DIALECT_M700, with_spindles(2));
  Drive drive(bench, "S600\nG63 G1 Z-5. F100\nG4 P8\nZ-10.\nG64\nG4 P20\nM30");
  unsigned waited = 0;
  ASSERT_TRUE(run(drive, [&](nc_inputs& in, const nc_outputs& out) {
    const bool other = out.tapping && out.command.v[2] < -1 && waited < 50;
    in.spindle_select = other ? 2 : 1;
    if (out.tapping) {
      EXPECT_EQ(out.spindle_selected, 1);
    }
    if (out.cause == NC_CAUSE_TAP_SPINDLE) {
      ++waited;
      EXPECT_NEAR(out.command.v[2], -5, 1e-9) << "at the end of the block";
    }
  }));
  EXPECT_GE(waited, 50u);
  EXPECT_NEAR(drive.out.command.v[2], -10, 1e-9);
}

TEST(Spindles, SpindlesByNumberAndTheChangeoverAreNot) {  // 10.6.1, restrictions (3), (4)
  Bench bench(NC_DIALECT_M700, with_spindles(2));
  EXPECT_EQ(bench.run("S1=500\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("S2=500\nM30").alarm, "P33");
  for (const char* code : {"G44.1", "G47.1"}) EXPECT_EQ(bench.run(std::string(code) + "\nM30").alarm, "P34") << code;
}

TEST(Spindles, WhatAControlRefuses) {
  const auto refused = [](const std::function<void(nc_config&)>& change) {
    nc_config c;
    nc_config_init(&c);
    c.system[0].axis_count = 5;
    c.system[0].axis[3].name = 'C';
    c.system[0].axis[4].name = 'A';
    c.system[0].axis[3].rotary = c.system[0].axis[4].rotary = true;
    c.system[0].spindle_count = 2;
    change(c);
    return nc_memory_required(&c) == 0;
  };
  EXPECT_FALSE(refused([](nc_config& c) { c.system[0].axis[3].spindle = 2, c.system[0].axis[4].spindle = 1; }));
  EXPECT_TRUE(refused([](nc_config& c) { c.system[0].spindle_count = NC_MAX_SPINDLES + 1; }));
  EXPECT_TRUE(refused([](nc_config& c) { c.system[0].axis[3].spindle = 3; })) << "there are two";
  EXPECT_TRUE(refused([](nc_config& c) { c.system[0].axis[3].spindle = c.system[0].axis[4].spindle = 1; }));
  EXPECT_TRUE(refused([](nc_config& c) { c.system[0].axis[0].spindle = 1; })) << "X does not turn";
}

}  // namespace
}  // namespace nc::test
