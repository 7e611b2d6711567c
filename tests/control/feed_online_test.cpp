// SPDX-License-Identifier: Apache-2.0
// Feed functions (M700 7) from the program to the motion of the axes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>

#include "support/drive.hpp"

namespace nc::test {
namespace {

void quick_machine(nc_config& c) {
  for (unsigned i = 0; i < c.system[0].axis_count; ++i) {
    c.system[0].axis[i].rapid = 1000;
    c.system[0].axis[i].max_velocity = 500;
    c.system[0].axis[i].max_acceleration = 20000;
  }
}

/// Runs the text to its end, and calls `see` after every cycle.
void run_online(Bench& bench, const std::string& text, const std::function<void(nc_inputs&, const nc_outputs&)>& see) {
  Drive drive(bench, text);
  drive.in.spindle[0].rev_per_s = 0;
  while (drive.cycle < 200000) {
    drive.in.cycle_start = drive.cycle == 1;
    drive.step();
    see(drive.in, drive.out);
    if (drive.cycle > 6 && drive.out.state == NC_STATE_IDLE) {
      while (nc_feed(bench.control(), 100) == NC_OK) {}
      nc_feed(bench.control(), 100);
      return;
    }
  }
  FAIL() << "the program does not end";
}

/// For each line the speed in the middle of its time, mm/min.
std::map<unsigned, double> speeds(Bench& bench, const std::string& text) {
  std::map<unsigned, std::vector<double>> all;
  bench.at(0, 0, 0);
  run_online(bench, text, [&](nc_inputs& in, const nc_outputs& out) {
    in.spindle[0].rev_per_s = 10;
    if (!out.distance_zero) all[out.source.line].push_back(out.feed_mm_min);
  });
  std::map<unsigned, double> middle;
  for (const auto& [line, values] : all) middle[line] = values[values.size() / 2];
  return middle;
}

TEST(FeedOnline, InverseTimeKeepsTheSpeedAtTheCut) {  // M700 7.5, the printed example: tool radius 10
  Bench bench(NC_DIALECT_M700, quick_machine);
  bench.tool(11, 10).param("8103", "1");
  auto speed = speeds(bench,
                      "G0 X80. Y-80.\nG1 G41 X80. Y-80. D11 F5000\nX180.\nG93 G2 Y-280. R100. F50\nG3 Y-480. R100. F50\nG2 Y-680. R100. F50\n"
                      "G94 G1 X80. F5000\nY-80.\nG40 X0\nM02");
  EXPECT_NEAR(speed[3], 5000, 1e-6);
  EXPECT_NEAR(speed[4], 5500, 1e-6);
  EXPECT_NEAR(speed[5], 4500, 1e-6);
  EXPECT_NEAR(speed[6], 5500, 1e-6);
}

TEST(FeedOnline, InverseTimeIsTheTimeOfTheBlock) {
  Bench bench(NC_DIALECT_M700, quick_machine);
  bench.tool(1, 5).param("8103", "1");
  // Around a square: the compensated lines have other lengths, but take the same time.
  const std::string square = " D1 G1 X0 Y10. F60\nX0 Y50. F60\nX50. F60\nY0 F60\nX-9. F60\nG40 G0 X-20. Y-20.\nM30";
  auto speed = speeds(bench, "G93 G41" + square);
  EXPECT_NEAR(speed[2], 60 * 45, 1e-6);  // the path outside the square is longer by the radius at the end of this line
  EXPECT_NEAR(speed[3], 60 * 60, 1e-6);  // and of this one at both ends
  speed = speeds(bench, "G93 G42" + square);
  EXPECT_NEAR(speed[2], 60 * 35, 1e-6);
  EXPECT_NEAR(speed[3], 60 * 40, 1e-6);
}

TEST(FeedOnline, MixedAxesAreComposite) {  // M700 7.6
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    axes("XYZc")(c);
    quick_machine(c);
  });
  double x = 0, turned = 0;
  bench.at(0, 0, 0);
  run_online(bench, "G1 X30. C40. F3000\nM30", [&](nc_inputs&, const nc_outputs& out) {
    if (out.command.v[0] > 10 && out.command.v[0] < 20) x = out.velocity.v[0], turned = out.velocity.v[3];
  });
  EXPECT_NEAR(x, 50 * 0.6, 1e-6);
  EXPECT_NEAR(turned, 50 * 0.8, 1e-6);
}

TEST(FeedOnline, CornerOverrideActsInsideOnly) {  // M700 7.10
  Bench bench(NC_DIALECT_M700, quick_machine);
  bench.tool(1, 2).param("8103", "1").param("8007", "50").param("8008", "120").param("8009", "5");
  const auto slowest_part = [&](const std::string& head, unsigned line) {
    double slow = 0, count = 0;
    bench.at(0, 0, 0);
    run_online(bench, head + "G1 X0 Y5. F1200\nX0 Y50.\nX50.\nY20.\nX20. Y20.\nG40 G0 X0 Y0\nM30", [&](nc_inputs&, const nc_outputs& out) {
      if (out.distance_zero || out.source.line != line) return;
      ++count;
      if (std::fabs(out.feed_mm_min - 600) < 1) ++slow;
    });
    return slow / count;
  };
  EXPECT_GT(slowest_part("G62 G42 D1\n", 3), 0.1);    // right of the path, which turns right: inner corners
  EXPECT_EQ(slowest_part("G64 G42 D1\n", 3), 0);
  EXPECT_EQ(slowest_part("G62 G41 D1\n", 3), 0);      // outside
  EXPECT_EQ(slowest_part("G62 G42 D1\n", 6), 0);      // the corner of the cancel
  EXPECT_EQ(slowest_part("G62\n", 3), 0);             // without compensation
  bench.param("8008", "80");
  EXPECT_EQ(slowest_part("G62 G42 D1\n", 3), 0);      // 90 degrees is not sharp enough
}

TEST(FeedOnline, CornerOverrideOfHxGoesByItsParameters) {  // HX 5.3.5, PI 124, 125, 130
  Bench bench(NC_DIALECT_HX, quick_machine);
  bench.tool(1, 2, NC_TOOL_RADIUS).param("3124", "50").param("3125", "5");
  const auto is_slow = [&](const char* angle) {
    bench.param("3130", angle).at(0, 0, 0);
    bool slow = false;
    run_online(bench, "G62 G42 D1\nG01 X0 Y5. F1200\nX0 Y50.\nX50.\nY20.\nG40 G00 X0 Y0\nM30", [&](nc_inputs&, const nc_outputs& out) {
      slow = slow || (out.source.line == 3 && !out.distance_zero && std::fabs(out.feed_mm_min - 600) < 1);
    });
    return slow;
  };
  EXPECT_TRUE(is_slow("120"));
  EXPECT_FALSE(is_slow("80"));
}

TEST(FeedOnline, CornerOverrideReachesBackOverShortBlocks) {  // M700 7.10
  const auto slow_way = [](const char* zone) {  // along Y before the corner at Y50, which the tool centre passes at Y48
    Bench bench(NC_DIALECT_M700, quick_machine);
    bench.tool(1, 2).param("8103", "1").param("8007", "50").param("8008", "120").param("8009", zone);
    bench.at(0, 0, 0);
    double first = 1e9;
    run_online(bench, "G62 G42 D1\nG1 X0 Y5. F1200\nX0 Y40.\nY44.\nY47.\nY50.\nX50.\nG40 G0 X0 Y0\nM30", [&](nc_inputs&, const nc_outputs& out) {
      if (out.distance_zero || out.source.line > 6 || out.command.v[1] < 10) return;
      if (std::fabs(out.feed_mm_min - 600) < 1) first = std::min(first, out.command.v[1]);
    });
    return 48 - first;
  };
  EXPECT_NEAR(slow_way("0.5"), 0.5, 0.1);
  EXPECT_NEAR(slow_way("3"), 3, 0.1) << "of the block before";
  EXPECT_NEAR(slow_way("6"), 6, 0.1) << "and the one before that";
}

/// The feeds along X behind the inner corner at X2, of a program of the HX with the tool on the right of a path that turns right; by the place on X.
std::map<int, double> feeds_behind_corner(Bench& bench, const std::string& text) {
  std::map<int, double> feeds;
  bench.at(0, 0, 0);
  run_online(bench, text, [&](nc_inputs&, const nc_outputs& out) {
    if (!out.distance_zero && std::fabs(out.velocity.v[1]) < 1e-9 && out.velocity.v[0] > 0) feeds[static_cast<int>(out.command.v[0])] = out.feed_mm_min;
  });
  return feeds;
}

TEST(FeedOnline, CornerOverrideActsBehindTheCornerAsWell) {  // HX 5.3.5: PI 124 to 126, 130, 131, 153
  const std::string path = "G01 X0 Y5. F1200\nX0 Y50.\nX50.\nY20.\nX20. Y20.\nG40 G00 X0 Y0\nM30";
  const auto bench = [] {
    auto b = std::make_unique<Bench>(NC_DIALECT_HX, quick_machine);
    b->tool(1, 2, NC_TOOL_RADIUS).param("3124", "50").param("3130", "120").param("3125", "5").param("3126", "10");
    return b;
  };
  const auto normal = bench();
  std::map<int, double> feed = feeds_behind_corner(*normal, "G62 G42 D1\n" + path);
  EXPECT_NEAR(feed[6], 600, 1);    // the corner is at X2 for the centre of the tool: up to X12
  EXPECT_NEAR(feed[11], 600, 1);
  EXPECT_NEAR(feed[14], 1200, 1);
  EXPECT_NEAR(feed[40], 1200, 1);
  EXPECT_NEAR(feed[45], 600, 1);   // in front of the next corner, at X48
  const auto always = bench();     // PI 131
  always->param("3131", "1");
  EXPECT_NEAR(feeds_behind_corner(*always, "G64 G42 D1\n" + path)[6], 600, 1);
  EXPECT_NEAR(feeds_behind_corner(*normal, "G64 G42 D1\n" + path)[6], 1200, 1);
  const auto fixed = bench();      // PI 153
  fixed->param("3153", "300");
  EXPECT_NEAR(feeds_behind_corner(*fixed, "G62 G42 D1\n" + path)[6], 300, 1);
  EXPECT_NEAR(feeds_behind_corner(*normal, "G62 G41 D1\n" + path)[6], 1200, 1);  // outside
}

TEST(FeedOnline, InnerArcsGoByTheRatioOfTheirRadii) {  // HX 5.3.6: PI 132
  const auto on_arc = [](const char* least, const char* radius, const std::string& head) {
    Bench bench(NC_DIALECT_HX, quick_machine);
    bench.tool(1, std::atof(radius), NC_TOOL_RADIUS).param("3132", least);
    return speeds(bench, head + "G01 X0 Y10. F1200\nX40.\nG03 X60. Y30. R20.\nG01 Y60.\nG40 X0\nM30")[4];
  };
  EXPECT_NEAR(on_arc("10", "5", "G62 G41 D1\n"), 1200 * 15 / 20.0, 1);   // the tool goes inside, on a radius of 15
  EXPECT_NEAR(on_arc("80", "5", "G62 G41 D1\n"), 1200 * 0.8, 1);         // not below PI 132
  EXPECT_NEAR(on_arc("0", "5", "G62 G41 D1\n"), 1200, 1);                // off
  EXPECT_NEAR(on_arc("10", "5", "G64 G41 D1\n"), 1200, 1);
  EXPECT_NEAR(on_arc("10", "5", "G62 G42 D1\n"), 1200, 1);               // outside
}

TEST(FeedOnline, ReversalsRestByParameter) {  // M700 7.9.2, the printed examples (1), (3), (4), (5)
  const auto rests = [](const char* value, const std::string& text) {
    Bench bench(NC_DIALECT_M700, [](nc_config& c) {
      quick_machine(c);
      for (unsigned i = 0; i < 3; ++i) c.system[0].axis[i].max_acceleration = 2000;
    });
    bench.param("1503", value).at(0, 0, 0);
    double at_joint = 0;  // speed behind the joint
    run_online(bench, text, [&](nc_inputs&, const nc_outputs& out) {
      if (out.source.line == 2 && at_joint == 0) at_joint = out.feed_mm_min;
    });
    return at_joint;
  };
  const std::string smooth = "G91 G1 X100. Y100. F4000\nX100. Y100.\nG4 P1\nM30", axis = "G91 G1 X100. Y1. F4000\nX80.\nG4 P1\nM30";
  EXPECT_GT(rests("1", smooth), 500);
  EXPECT_GT(rests("1", axis), 500);
  // Y reverses at a joint that could be passed at speed.
  const std::string back = "G91 G1 X100. Y.5 F4000\nX100. Y-.5\nG4 P1\nM30";
  EXPECT_GT(rests("0", back), 500);
  EXPECT_LT(rests("1", back), 500);
}

TEST(FeedOnline, TheHandleReachesTheProgram) {  // M700 7.3
  Bench bench(NC_DIALECT_M700, quick_machine);
  bench.param("1079", "1").param("1506", "6000").param("1507", "600").param("1185", "1200").at(0, 0, 0);
  double fastest = 0;
  run_online(bench, "G1 X50. F1\nX60. F1200\nM30", [&](nc_inputs& in, const nc_outputs& out) {
    in.feed_pulses = out.source.line == 1 ? 1 : 0;
    if (out.source.line == 1) fastest = std::max(fastest, out.feed_mm_min);
    EXPECT_TRUE(!out.feed_digit_on || out.feed_digit == 1);
  });
  EXPECT_NEAR(fastest, 6000, 1e-3);  // 10 mm/min a pulse, up to FM
}

TEST(FeedOnline, ThreadsOfOneProgramLieInOneGroove) {  // M700 6.7.1
  Bench bench(NC_DIALECT_M700, quick_machine);
  bench.at(0, 0, 0);
  std::map<unsigned, double> phase;
  run_online(bench, "S600 M3\nG33 Z-20. F2.\nG0 Z0\nG4 P33\nG33 Z-20. F2.\nG0 Z0\nG4 P77\nG33 Z-20. F2. Q180.\nM30",
             [&](nc_inputs& in, const nc_outputs& out) {
               const double turns = in.spindle[0].turns + (in.spindle[0].rev_per_s * 0.001);
               const double place = turns + out.command.v[2] / 2;
               if (out.command.v[2] < -9 && out.command.v[2] > -12 && out.velocity.v[2] < 0) phase[out.source.line] = place - std::floor(place);
               in.spindle[0].rev_per_s = 10;
               in.spindle[0].turns_valid = true;
               in.spindle[0].turns = turns;
             });
  ASSERT_EQ(phase.size(), 3u);
  EXPECT_NEAR(phase[2], phase[5], 1e-6);
  const double other = phase[8] - phase[2];
  EXPECT_NEAR(other - std::floor(other), 0.5, 1e-6);
}

}  // namespace
}  // namespace nc::test
