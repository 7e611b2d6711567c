// SPDX-License-Identifier: Apache-2.0
// Acceleration after interpolation, S-pattern filters and radius compensation from the parameters to the axes (M700 7.7, 13.15, 15.5).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/drive.hpp"

namespace nc::test {
namespace {

void machine(nc_config& c) {
  for (unsigned i = 0; i < c.system[0].axis_count; ++i) {
    c.system[0].axis[i].rapid = 300;
    c.system[0].axis[i].max_velocity = 200;
    c.system[0].axis[i].max_acceleration = 2000;
    c.system[0].axis[i].max_jerk = 50000;
  }
}

struct Course {
  double seconds = 0;      ///< until the axes stand at the end
  double nearest = 1e9;    ///< least distance to the corner 50, 0
  double fastest = 0;      ///< of X and Y together, mm/s
  double acceleration = 0; ///< largest of any axis by finite differences, mm/s^2
  double largest = 0;      ///< distance from 0, 0
};

Course run(Bench& bench, const std::string& text, const std::function<void(nc_inputs&, const nc_outputs&)>& see = {}) {
  Drive drive(bench, text);
  Course c;
  nc_axes before = drive.out.command, velocity{};
  for (bool any = false; drive.cycle < 100000 && !drive.ended;) {
    drive.press_start();
    drive.step();
    if (see) see(drive.in, drive.out);
    const nc_axes& at = drive.out.command;
    for (unsigned i = 0; i < 3 && any; ++i) {
      const double v = (at.v[i] - before.v[i]) * 1000;
      c.acceleration = std::max(c.acceleration, std::fabs(v - velocity.v[i]) * 1000);
      velocity.v[i] = v;
    }
    if (any && !drive.out.distance_zero) c.seconds = drive.cycle * 0.001;
    c.fastest = std::max(c.fastest, std::hypot(velocity.v[0], velocity.v[1]));
    c.nearest = std::min(c.nearest, std::hypot(at.v[0] - 50, at.v[1]));
    c.largest = std::max(c.largest, std::hypot(at.v[0], at.v[1]));
    before = at;
    any = true;
  }
  EXPECT_TRUE(drive.ended) << drive.alarm();
  while (nc_feed(bench.control(), 100) == NC_OK) {}
  nc_feed(bench.control(), 100);  // the feeder sees that the program has ended
  return c;
}

constexpr const char* kCorner = "G1 X50. F3000\nY50.\nM02";

TEST(FiltersOnline, ConstantsOfTheAxesAreAtWork) {
  Bench plain(NC_DIALECT_M700, machine), filtered(NC_DIALECT_M700, machine);
  filtered.param("2007", "100");
  const Course a = run(plain, kCorner), b = run(filtered, kCorner);
  EXPECT_LT(a.nearest, 0.06);  // without filters the trapezoid reaches the corner; filters round it
  EXPECT_NEAR(b.nearest, 50 * 0.1 / 8 * std::sqrt(2.0), 0.03);
  EXPECT_NEAR(b.acceleration, 50 / 0.1, 1);
  EXPECT_NEAR(b.seconds - 0.003, 2 + 0.1, 0.004);
}

TEST(FiltersOnline, ExactStopTakesTheCheckTime) {  // 7.7 (3): Td = Ts, 2 Ts, of the longest of the axes
  const auto seconds = [](const char* linear, const char* exponential, const char* text) {
    Bench bench(NC_DIALECT_M700, machine);
    if (linear != nullptr) bench.param("2007", linear, 'X').param("2007", "20", 'Y').param("2007", "20", 'Z');
    if (exponential != nullptr) bench.param("2008", exponential);
    return run(bench, text).seconds;
  };
  const char* const exact = "G9 G1 X50. F3000\nX100.\nM02";
  const char* const passed = "G1 X50. F3000\nX100.\nM02";
  EXPECT_NEAR(seconds("100", nullptr, exact) - seconds("100", nullptr, passed), 0.1, 0.002);
  EXPECT_NEAR(seconds(nullptr, "60", exact) - seconds(nullptr, "60", passed), 0.12, 0.002);
  EXPECT_NEAR(seconds("100", "60", exact) - seconds("100", "60", passed), 0.22, 0.002);
}

TEST(FiltersOnline, RapidTraverseHasConstantsOfItsOwn) {
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2004", "80");
  const Course c = run(bench, "G0 X50.\nM02");
  EXPECT_NEAR(c.fastest, 2000 * 0.08, 1e-6);  // A T
  EXPECT_NEAR(c.seconds - 0.003, 50 / 160.0 + 0.08, 0.004);
}

TEST(FiltersOnline, AnAxisWithoutAConstantKeepsTheTrapezoid) {
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "100", 'X').param("2007", "100", 'Y');
  const Course c = run(bench, "G1 Z50. F6000\nM02");
  EXPECT_NEAR(c.seconds - 0.003, 0.5 + 0.05, 0.004);
  const Course both = run(bench, "G1 X50. Z0 F6000\nX0\nM02");
  EXPECT_LE(both.acceleration, 2000 * 1.001);
}

TEST(FiltersOnline, ThreadsAndTapsHaveNone) {
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "100").param("2004", "100");
  const auto spindle = [](nc_inputs& in, const nc_outputs&) { in.spindle[0].rev_per_s = 10; };
  const Course thread = run(bench, "G33 Z-20. F2. Q0\nM02", spindle);
  EXPECT_NEAR(thread.seconds - 0.003, 1 + 0.01, 0.01);  // 20 mm/s, at 2000 mm/s^2
  bench.at(0, 0, 0);
  const Course tap = run(bench, "G63\nG1 Z-20. F1200\nM02");
  EXPECT_NEAR(tap.seconds - 0.003, 1 + 0.01, 0.01);
}

TEST(FiltersOnline, SkipMovesHaveTheirConstantOnly) {  // 15.5 (12)
  const auto seconds = [](const char* skip) {
    Bench bench(NC_DIALECT_M700, machine);
    bench.param("2007", "100");
    if (skip != nullptr) bench.param("2102", skip);
    return run(bench, "G31 X20. F1200\nM02").seconds;
  };
  EXPECT_NEAR(seconds(nullptr) - 0.003, 1 + 0.01, 0.006);
  EXPECT_NEAR(seconds("50") - 0.003, 1 + 0.05, 0.006);
}

TEST(FiltersOnline, AProgramChangesThemWhereItSays) {  // G10 L70
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "50");
  double first = 0, second = 0, before = 0;
  Drive drive(bench, "G1 X50. F3000\nG9 X100.\nG10 L70\nP2007 A1 D100\nG11\nG1 X0\nM02");
  while (drive.cycle < 20000 && !drive.ended) {
    drive.press_start();
    drive.step();
    const double a = std::fabs(drive.out.velocity.v[0] - before) * 1000;
    (drive.out.source.line <= 2 ? first : second) = std::max(drive.out.source.line <= 2 ? first : second, a);
    before = drive.out.velocity.v[0];
  }
  ASSERT_TRUE(drive.ended) << drive.alarm();
  EXPECT_NEAR(first, 50 / 0.05, 1);
  EXPECT_NEAR(second, 50 / 0.1, 1);
}

TEST(FiltersOnline, HighAccuracyHasItsSlopeAndItsFilters) {  // 13.15
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "100").param("1206", "6000").param("1207", "100");  // these parameters give 1000 mm/s^2
  const Course slope = run(bench, "G61.1\nG1 X50. F3000\nM02");
  EXPECT_NEAR(slope.acceleration, 1000, 1);
  constexpr double kRounding = 0.005;  // the mean that rounds corners within 0.01 mm, where no filter is set
  EXPECT_NEAR(slope.seconds - 0.003, 1 + 0.05 + kRounding, 0.002);
  bench.param("1568", "40").param("1570", "20").at(0, 0, 0);
  const Course smooth = run(bench, "G61.1\nG1 X50. F3000\nM02");
  EXPECT_NEAR(smooth.seconds - 0.003, 1 + 0.05 + 0.06, 0.005);
  bench.at(0, 0, 0);
  const Course normal = run(bench, "G64\nG1 X50. F3000\nM02");
  EXPECT_NEAR(normal.acceleration, 500, 1);
}

TEST(FiltersOnline, RapidTraverseBeforeInterpolation) {  // #1205
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2004", "200").param("1205", "1").param("1569", "50");
  const Course c = run(bench, "G0 X100.\nM02");
  EXPECT_NEAR(c.fastest, 300, 1e-6);
  EXPECT_NEAR(c.seconds - 0.003, 100 / 300.0 + 300 / 2000.0 + 0.05, 0.005);
}

TEST(FiltersOnline, RadiusCompensation) {  // #8107, #8108, #2069
  const auto largest = [](const char* one, const char* two) {
    Bench bench(NC_DIALECT_M700, machine);
    bench.param("8107", one).param("8108", two).param("2069", "0.03").at(10, 0, 0);
    return run(bench, "G3 I-10. F1200\nM02").largest;
  };
  EXPECT_NEAR(largest("1", "1"), 10.03, 1e-4);
  EXPECT_NEAR(largest("1", "0"), 10, 1e-6);
  EXPECT_NEAR(largest("0", "1"), 10, 1e-6);
}

TEST(FiltersOnline, ReversalsAreChecked) {  // 7.9.2: #1503
  const auto seconds = [](const char* check) {
    Bench bench(NC_DIALECT_M700, machine);
    bench.param("2007", "100").param("1503", check);
    return run(bench, "G1 X50. F3000\nX0\nM02").seconds;
  };
  EXPECT_NEAR(seconds("1") - seconds("0"), 0.1, 0.002);
}

TEST(FiltersOnline, InPositionWaitsForTheAxesBehindTheFilters) {  // 7.9: #1193 and #1306
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    machine(c);
    c.system[0].axis[0].in_position = 0.01;
  });
  bench.param("2007", "100").param("1193", "1").param("1306", "1");
  nc_axes actual{};
  bool checked = true;
  run(bench, "G61 G1 X50. F3000\nY10.\nM02", [&](nc_inputs& in, const nc_outputs& out) {
    actual.v[0] += (out.command.v[0] - actual.v[0]) * 0.02;  // a servo of 50 ms
    actual.v[1] = out.command.v[1];
    in.actual = actual;
    in.actual_valid = true;
    checked = checked && (out.command.v[1] == 0 || std::fabs(actual.v[0] - 50) <= 0.0101);
  });
  EXPECT_TRUE(checked);
}

TEST(FiltersOnline, AMacroInterruptCutsWhereTheAxesStand) {  // 13.12 type 1
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "100").param("1229/bit0", "1");
  bench.add("O1000", "G91 G1 Y5. F3000\nY-5.\nG90\nM99\n");
  double stood_at = 0, aside = 0, acceleration = 0, last = 0;
  Drive drive(bench, "M96 P1000\nG1 X100. F3000\nM30");
  while (drive.cycle < 20000 && !drive.ended) {
    drive.press_start();
    drive.in.macro_interrupt = drive.out.command.v[0] > 30 && drive.out.command.v[0] < 31;
    drive.step();
    if (drive.out.velocity.v[1] != 0 && stood_at == 0) stood_at = drive.out.command.v[0];
    if (drive.out.velocity.v[1] != 0) aside = std::max(aside, std::fabs(drive.out.command.v[0] - stood_at));
    acceleration = std::max(acceleration, std::fabs(drive.out.velocity.v[0] - last) * 1000);
    last = drive.out.velocity.v[0];
  }
  ASSERT_TRUE(drive.ended) << drive.alarm();
  EXPECT_NEAR(stood_at, 30 + 50 * 0.1 / 2, 0.2);  // plus what was still in the filters
  EXPECT_EQ(aside, 0);
  EXPECT_NEAR(acceleration, 500, 1);
  EXPECT_EQ(drive.out.command.v[0], stood_at);  // the interrupt program has moves, and replaces the rest of the block
  EXPECT_EQ(drive.out.command.v[1], 0);
}

TEST(FiltersOnline, ByHandInABlockStop) {  // and the program goes on from there
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "100").param("2004", "60");
  Drive drive(bench, "G1 X20. F3000\nG1 Y10.\nM30");
  drive.in.single_block = true;
  double acceleration = 0;
  nc_axes last{};
  unsigned stops = 0, waited = 0;
  while (drive.cycle < 20000 && !drive.ended) {
    const bool stopped = drive.out.state == NC_STATE_STOPPED;
    waited = stopped ? waited + 1 : 0;
    if (waited == 1 && drive.out.source.line > stops) {  // a new block stop, not the end of the manual motion
      ++stops;
      EXPECT_TRUE(drive.out.distance_zero);
      EXPECT_EQ(drive.out.command.v[0], stops == 1 ? 20 : 25);
    }
    drive.in.manual[0] = {};
    if (stops == 1 && waited == 3 && drive.out.command.v[0] == 20) drive.in.manual[0] = {.kind = NC_MANUAL_STEP, .velocity = 0, .distance = 5};
    drive.in.cycle_start = drive.cycle == 2 || waited == 200;
    drive.step();
    for (unsigned i = 0; i < 2; ++i) acceleration = std::max(acceleration, std::fabs(drive.out.velocity.v[i] - last.v[i]) * 1000);
    last = drive.out.velocity;
  }
  ASSERT_TRUE(drive.ended) << drive.alarm();
  EXPECT_EQ(stops, 2u);
  EXPECT_EQ(drive.out.command.v[0], 25);
  EXPECT_EQ(drive.out.command.v[1], 10);
  EXPECT_LE(acceleration, 2000 * 1.001);
}

// ---- what is refused, and what is noted --------------------------------------------------------------------------------------

TEST(FiltersOnline, ValuesOutOfRangeAreRefused) {
  Bench bench(NC_DIALECT_M700, machine);
  const auto set = [&](const char* key, const char* value) { return nc_parameter_set(bench.control(), 0, key, 0, value); };
  for (const char* key : {"2004", "2007", "2102"}) {
    EXPECT_EQ(set(key, "4000"), NC_OK) << key;
    EXPECT_EQ(set(key, "4001"), NC_E_ARGUMENT) << key;
    EXPECT_EQ(set(key, "-1"), NC_E_ARGUMENT) << key;
  }
  for (const char* key : {"2005", "2008", "2103"}) {
    EXPECT_EQ(set(key, "5000"), NC_OK) << key;
    EXPECT_EQ(set(key, "5001"), NC_E_ARGUMENT) << key;
  }
  for (const char* key : {"1568", "1569", "1570"}) {
    EXPECT_EQ(set(key, "200"), NC_OK) << key;
    EXPECT_EQ(set(key, "201"), NC_E_ARGUMENT) << key;
  }
  EXPECT_EQ(set("8108", "2"), NC_E_ARGUMENT);
  EXPECT_EQ(set("2069", "1.5"), NC_E_ARGUMENT);
}

TEST(FiltersOnline, AConstantLongerThanTheMemoryIsRefused) {  // a cycle of 20 us: 65535 of them are 1310.7 ms
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    machine(c);
    c.cycle_s = 2e-5;
  });
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "2007", 0, "1310"), NC_OK);
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "2007", 0, "1312"), NC_E_ARGUMENT);
}

TEST(FiltersOnline, RapidBeforeInterpolationIsForTheFirstPartSystem) {  // 13.15, precaution (5)
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system_count = 2;
    c.system[1] = c.system[0];
  });
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "1205", 0, "1"), NC_OK);
  EXPECT_EQ(nc_parameter_set(bench.control(), 1, "1205", 0, "0"), NC_OK);
  EXPECT_EQ(nc_parameter_set(bench.control(), 1, "1205", 0, "1"), NC_E_ARGUMENT);
}

std::vector<std::string> notes(Bench& bench) {
  std::vector<std::string> all;
  nc_parameter_note note;
  for (unsigned i = 0; nc_parameter_note_row(bench.control(), 0, i, &note) == NC_OK; ++i) all.push_back(note.text);
  return all;
}

TEST(FiltersOnline, NotesSayWhatLimitsTheMachine) {
  Bench bench(NC_DIALECT_M700, machine);
  EXPECT_TRUE(notes(bench).empty());
  bench.param("2007", "100", 'X').param("2007", "250", 'Y');
  EXPECT_EQ(notes(bench),
            (std::vector<std::string>{"X: #2007 #2008 let cuts go at 6000 mm/min, the axis could go at 12000: faster would break its limit of acceleration",
                                      "Z: #2007 #2008 not set, of other axes they are: cuts of this axis are accelerated before interpolation, and the "
                                      "path rests beside them"}));
}

// A host that shows a note beside what was set needs no look into the sentence.
TEST(FiltersOnline, ANoteNamesItsAxisAndItsParameters) {
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("2007", "250", 'Y').param("8107", "1").param("2069", "0.01");
  nc_parameter_note note;
  ASSERT_EQ(nc_parameter_note_row(bench.control(), 0, 1, &note), NC_OK);
  EXPECT_STREQ(note.text, "#2069: no effect while #8107 and #8108 are not both 1");
  ASSERT_EQ(note.key_count, 3u);
  EXPECT_STREQ(note.key[0], "2069");
  EXPECT_STREQ(note.key[1], "8107");
  EXPECT_STREQ(note.key[2], "8108");
  EXPECT_EQ(note.axis, 0);
  ASSERT_EQ(nc_parameter_note_row(bench.control(), 0, 2, &note), NC_OK);
  EXPECT_EQ(note.axis, 'X');
  ASSERT_EQ(note.key_count, 2u);
  EXPECT_STREQ(note.key[0], "2007");
  EXPECT_STREQ(note.key[1], "2008");
  nc_parameter_note old = NC_INIT(nc_parameter_note);
  old.struct_size = 2;
  EXPECT_EQ(nc_parameter_note_row(bench.control(), 0, 0, &old), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_note_row(bench.control(), 0, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_note_row(bench.control(), 1, 0, &note), NC_E_ARGUMENT);
}

TEST(FiltersOnline, NotesSayWhatHasNoEffect) {
  Bench bench(NC_DIALECT_M700, machine);
  bench.param("8108", "1").param("2069", "0.01");
  EXPECT_EQ(notes(bench), (std::vector<std::string>{"#8108: no effect while #8107 is 0", "#2069: no effect while #8107 and #8108 are not both 1"}));
  bench.param("8107", "1");
  EXPECT_TRUE(notes(bench).empty());
  bench.param("1205", "1").param("2004", "300");
  EXPECT_EQ(notes(bench), (std::vector<std::string>{"#1205: rapid traverse is accelerated before interpolation: #2004 and #2005 have no effect"}));
}

TEST(FiltersOnline, TheOptimalModeHasNoneAndSaysSo) {
  const auto optimal = [](nc_config& c) {
    machine(c);
    c.motion_mode = NC_MOTION_OPTIMAL;
  };
  Bench plain(NC_DIALECT_M700, optimal), set(NC_DIALECT_M700, optimal);
  set.param("2007", "100").param("2004", "100").param("1568", "50").param("8107", "1").param("8108", "1").param("2069", "0.1");
  const char* const text = "G0 X20.\nG1 X50. F3000\nG3 X60. Y10. R10.\nM02";
  const Course a = run(plain, text), b = run(set, text);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.acceleration, b.acceleration);
  EXPECT_EQ(notes(set).size(), 6u);
  EXPECT_EQ(notes(set).front(), "#1568: no effect in the time-optimal mode, which keeps acceleration and jerk by itself");
}

}  // namespace
}  // namespace nc::test
