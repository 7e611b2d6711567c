// SPDX-License-Identifier: Apache-2.0
// The interference check at joints with several vectors: which of them are erased, and when it is an alarm (M700 12.4.8).
#include "offset/interference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Section line_section(Vec2 delta, double offset) {
  Section section;
  section.begin = section.end = {unit(delta), 0};
  section.delta = delta;
  section.offset = offset;
  section.check = true;
  return section;
}

void set_joint(Section* section, std::initializer_list<Vec2> vectors) {
  section->joint = ContourJoint{};
  for (Vec2 w : vectors) section->joint.v[section->joint.n++] = w;
  section->jointed = true;
}

TEST(Interference, OutermostVectorsFirstInnerOnesErased) {
  // "(1) (4)' no interference, (2) (3)' no interference, (3) (2)' interference: erase (3) (2)', erase (4)
  // (1)'".
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({0, 50}, 10));
  set_joint(&chain[0], {{-10, 0}, {-10, 5}, {8, 10}, {9, 10}});
  set_joint(&chain[1], {{-9, 10}, {-8, 10}, {10, 5}, {10, 0}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::none);
  ASSERT_EQ(chain[0].joint.n, 2);
  EXPECT_EQ(chain[0].joint.v[0], (Vec2{-10, 0}));
  EXPECT_EQ(chain[0].joint.v[1], (Vec2{-10, 5}));
  ASSERT_EQ(chain[1].joint.n, 2);
  EXPECT_EQ(chain[1].joint.v[0], (Vec2{10, 5}));
  EXPECT_EQ(chain[1].joint.v[1], (Vec2{10, 0}));
}

TEST(Interference, NothingCrossesNothingChanges) {
  Chain chain;
  chain.push_back(line_section({50, 0}, 10));
  chain.push_back(line_section({0, -30}, 10));
  chain.push_back(line_section({-50, 0}, 10));
  set_joint(&chain[0], {{10, 10}});
  set_joint(&chain[1], {{10, -10}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 3, {}, &at), Finding::none);
  EXPECT_EQ(chain[0].joint.n, 1);
  EXPECT_FALSE(chain[1].dead);
}

TEST(Interference, CommandedVectorsAreNeverErased) {
  // M700 12.4.3 precaution (2): the same crossing, but one of the vectors was given by I, J.
  for (const bool commanded : {false, true}) {
    Chain chain;
    chain.push_back(line_section({20, -40}, 20));
    chain.push_back(line_section({10, 0}, 20));
    chain.push_back(line_section({20, 40}, 20));
    set_joint(&chain[0], {{12, 20}});
    set_joint(&chain[1], {{-12, 20}});
    chain[1].commanded = commanded;
    unsigned at = 99;
    EXPECT_EQ(check_interference(&chain, 0, {}, &at), commanded ? Finding::none : Finding::alarm);
  }
}

TEST(Interference, RemainingPathThatRunsBackwardsIsAnAlarm) {
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({0, 50}, 10));
  set_joint(&chain[0], {{30, 1}, {8, 10}});
  set_joint(&chain[1], {{-8, 10}, {-30, 2}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::alarm);
}

TEST(Interference, WideAngleBetweenTheVectorsIsAnAlarm) {
  // (2)(b): the walls converge towards the opening.
  Chain chain;
  chain.push_back(line_section({-40, -20}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({-40, 20}, 10));
  for (unsigned i = 0; i < 3; ++i) chain[i].avoid = true;
  set_joint(&chain[0], {{20, 8}});
  set_joint(&chain[1], {{-20, 8}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::alarm);
  EXPECT_EQ(at, 0u);
}

// A step that is lower than the radius behind a corner of a little more than 90 degrees: the tool goes down by less than the radius, and never stands at right angles
// to the step. The same the other way round.
TEST(Interference, AVectorThatTheToolDoesNotReachTellsNothing) {
  for (const char* const avoid : {"0", "1"}) {
    for (const auto& [x, y] : {std::pair{"X0.001", "Y-0.2"}, std::pair{"X0.1", "Y-0.9"}, std::pair{"X0.0001", "Y-0.02"}}) {
      const std::string edge = std::string(x) + ' ' + y;
      Bench bench;
      bench.tool(1, 1).param("8102", avoid);
      const Outcome down = bench.run("G90 G0 X10. Y10.\nG1 G42 D1 X10. Y0 F500\nX0.\n" + edge + "\nX-10.\nG40 Y10.\nM30");
      EXPECT_EQ(down.alarm, "") << edge;
      Bench other;
      other.tool(1, 1).param("8102", avoid);
      const Outcome up = other.run(std::string("G90 G0 X-10. Y10.\nG1 G41 D1 X-10. ") + y + " F500\n" + edge + "\nX0. Y0\nX10.\nG40 Y10.\nM30");
      EXPECT_EQ(up.alarm, "") << edge;
      ASSERT_EQ(down.moves().size(), up.moves().size());
      for (unsigned i = 1, n = static_cast<unsigned>(up.moves().size()); i + 1 < n; ++i) {  // without the ways there and away
        EXPECT_NEAR(down.moves()[i].machine.v[0], up.moves()[n - 1 - i].machine.v[0], 1e-9) << edge;
        EXPECT_NEAR(down.moves()[i].machine.v[1], up.moves()[n - 1 - i].machine.v[1], 1e-9) << edge;
      }
    }
  }
}

// Where the block behind the step rises above what the corner in front of it is lengthened by, the ways themselves cut into it.
TEST(Interference, AVectorThatTheToolDoesNotReachCountsWhereItsWaysCutIntoTheBlocks) {
  Bench bench;
  bench.tool(1, 1);
  const Outcome run = bench.run(
      "G90 G0 X-0.528607 Y2.443476\nG1 G42 D1 X0 Y0 F500\nX-4.939394 Y-1.068560\nX-4.939075 Y-1.070034\nG3 X-4.972010 Y-1.076423 I-0.010422 J-0.034361\n"
      "G1 X-0.792280 Y-6.423044\nG1 G40 X-2.761861 Y-7.962768\nM30");
  EXPECT_EQ(run.alarm, "P153");
}

/// A groove in a straight edge, its mouth at X0 to X`mouth`, cut with a tool of 10 mm; the walls go from there to X`from` and X`to` at Y-30.
Outcome groove(const char* from, const char* to, const char* mouth, const char* avoid, double offset_x = 0, double offset_y = 0) {
  Bench bench;
  bench.tool(1, 5).param("8102", avoid).work_offset(1, {offset_x, offset_y});
  return bench.run(std::string("G90 G0 X-60. Y20.\nG41 D1 G1 X-60. Y0 F100\nX0.\nX") + from + " Y-30.\nX" + to + "\nX" + mouth + " Y0\nX60.\nG40 Y20.\nM30");
}

// 12.4.8 (2)(c): "grooves which are narrower than the tool ... or which have parallel or widening walls". The vectors at the two ends of the mouth
// cross, and three blocks lie between them; five are read ahead.
TEST(Interference, AGrooveThatWidensBehindItsMouth) {
  for (const char* const avoid : {"0", "1"}) {
    for (const auto& [from, to, mouth] : {std::array{"-5.", "10.", "5."}, std::array{"-1.", "10.", "9."}, std::array{"-.5", "10.4", "9.9"}}) {
      const Outcome run = groove(from, to, mouth, avoid);
      EXPECT_EQ(run.alarm, "P153") << mouth;
      EXPECT_EQ(run.alarm_line, 3u) << mouth;
    }
    EXPECT_EQ(groove("-5.", "16.", "11.", avoid).alarm, "");  // as wide as the tool at its mouth, and wider
  }
}

// The vectors at the mouth point down along walls like these and lie over each other or spread: they do not cross.
TEST(Interference, AMouthThatIsTooNarrowWithVectorsThatDoNotCross) {
  for (const char* const avoid : {"0", "1"}) {
    for (const auto& [from, to, mouth] : {std::array{"-30.", "38.", "8."}, std::array{"-60.", "67.", "7."}, std::array{"-30.", "39.9", "9.9"}}) {
      const Outcome run = groove(from, to, mouth, avoid);
      EXPECT_EQ(run.alarm, "P153") << mouth << ' ' << avoid;
      EXPECT_EQ(run.alarm_line, 3u) << mouth << ' ' << avoid;
    }
    EXPECT_EQ(groove("-30.", "42.2", "12.2", avoid).alarm, "");  // at these corners the tool reaches 12.07 mm into the mouth: 5 / cos 45 deg, and its radius
  }
}

/// P153 in this line, in front of the groove, with the avoidance and without.
void expect_too_narrow(const char* radius, const std::string& contour, unsigned line) {
  for (const char* const avoid : {"0", "1"}) {
    Bench bench;
    bench.tool(1, std::strtod(radius, nullptr)).param("8102", avoid);
    const Outcome run = bench.run("G90 G17 G94\n" + contour + "M30");
    EXPECT_EQ(run.alarm, "P153") << contour << avoid;
    EXPECT_EQ(run.alarm_line, line) << contour << avoid;
  }
}

// One wall of the groove is lower than the radius: the vectors at its two ends do not cross, the contour ends or goes on along the other one, and the tool, at the corner
// of the mouth, is in that wall.
TEST(Interference, AMouthOfALowWallAndAHighOne) {
  expect_too_narrow("1", "G0 X.336778 Y2.477212\nG1 G42 D1 X0 Y0 F500\nX-5.275072 Y.717149\nX-5.166765 Y.229571\nX-8.289435 Y-.464076\nX-5.44051 Y6.05345\nG40 X-3.149795 Y5.052138\n", 4);
  expect_too_narrow("1", "G0 X-3.149795 Y5.052138\nG1 G41 D1 X-5.44051 Y6.05345 F500\nX-8.289435 Y-.464076\nX-5.166765 Y.229571\nX-5.275072 Y.717149\nX0 Y0\nG40 X.336778 Y2.477212\n", 3);
  expect_too_narrow("0.5", "G0 X0 Y1.25\nG1 G42 D1 X0 Y0 F500\nX-1.841143\nY-.176743\nG2 X-3.471519 I-.815188 J1.109274\nG1 X-1.917884 Y1.8191\nG40 X-.931508 Y1.05127\n", 4);
  expect_too_narrow("0.5", "G0 X-.931508 Y1.05127\nG1 G41 D1 X-1.917884 Y1.8191 F500\nX-3.471519 Y-.176743\nG3 X-1.841143 I.815188 J1.109274\nG1 Y0\nX0\nG40 Y1.25\n", 3);
  // two arcs between the corner of the mouth and an arc that bends over it
  expect_too_narrow("1", "G0 X-2. Y-3.\nG1 G41 D1 X-4.7701 Y-4.50948 F500\nX-7.44678 Y-6.2512\nG2 X-7.69518 Y-5.34137 I1.29426 J.84218\nG3 X-10.6738 Y-7.9481 I.26454 J-3.30743\nG3 X-4.15898 Y-7.46838 I2.52576 J10.17611\nG40 G1 X-5.11013 Y-5.15639\n", 4);
}

// Arcs all round, which bend towards each other: no vectors cross.
TEST(Interference, AMouthBetweenArcs) {
  expect_too_narrow("3.604",
                    "G0 X-8.277572 Y-14.487777\nG42 D1 G1 X-8.381396 Y-19.892780 F1000\nG3 X-13.950034 Y-21.157255 I-0.228363 J-11.888450\n"
                    "G2 X-23.239758 Y11.541996 I7.348999 J19.757033\nG3 X-16.597511 Y-2.045697 I37.317 J9.824795\nG3 X16.336102 Y-17.155704 I30.674753 J23.412488\n"
                    "G2 X2.258907 Y-25.980627 I-15.993774 J9.87251\nG3 X-2.865426 Y-21.370177 I-3.538078 J1.220538\nG3 X-8.381396 Y-19.89278 I-5.744333 J-10.411053\n"
                    "G1 G40 X-8.277572 Y-14.487777\n",
                    6);
}

// As wide as the tool, above the tip of the tool, or a way in or out, it is no such mouth.
TEST(Interference, AMouthOfALowWallAndAHighOneThatIsWideEnough) {
  const auto expect_none = [](const std::string& contour) {
    for (const char* const avoid : {"0", "1"}) {
      Bench bench;
      bench.tool(1, 1).param("8102", avoid);
      EXPECT_EQ(bench.run("G90 G17 G94\n" + contour + "M30").alarm, "") << contour << avoid;
    }
  };
  expect_none("G0 X-10. Y3. Z0\nG1 G41 D1 X-10. Y0 F500\nX0\nY-.5\nX3.\nX2. Y5.\nG40 X0 Y4.6\n");          // 2.1 mm at the height of the corner
  expect_none("G0 X-10. Y3. Z0\nG1 G41 D1 X-10. Y0 F500\nX0\nY-.5\nX3. Z5.\nX.5 Y5.\nG40 X-1. Y4.6\n");      // the wall stands above the tool
  // of the corner in front of a line of 11 um the vector at right angles to that line is not gone to
  expect_none("G0 X-1.185087 Y2.201265\nG1 G41 D1 X0 Y0 F500\nX4.856908 Y2.614795\nX5.412441 Y1.520836\nX11.816698 Y5.43921\nX11.813184 Y5.428859\nX11.891265 Y5.332326\nX11.889561 Y5.332782\nX9.882647 Y-2.16674\nG40 X12.297669 Y-2.813013\n");
  expect_none("G0 X3. Y-10. Z0\nG41 D1 G1 X4. Y-4. F500\nG3 X0 Y0 R4.\nG1 X-4.\nY-8.\nX4.\nY0\nX0\nG3 X-1. Y1. I0 J1.\nG40 G1 X-1. Y3.\n");
}

// Below the mouth a wall, the greater part of a circle, a wall. The contour turns away from the tool at each of its corners, and comes back along the arc.
TEST(Interference, AMouthThatIsTooNarrowInFrontOfARoundChamber) {
  for (const char* const mouth : {"8.", "10.", "12.2"}) {  // see above: 12.07 mm are needed
    const double half = std::strtod(mouth, nullptr) / 2;
    char arc[80];
    std::snprintf(arc, sizeof arc, "G3 X%.3f Y-1. I%.3f J%.6f", 2 * half + 1, half + 1, -std::sqrt(64 - (half + 1) * (half + 1)));
    Bench bench;
    bench.tool(1, 5);
    const Outcome run =
        bench.run(std::string("G90 G0 X-60. Y20.\nG41 D1 G1 X-60. Y0 F100\nX0.\nX-1. Y-1.\n") + arc + "\nG1 X" + mouth + " Y0\nX60.\nG40 Y20.\nM30");
    EXPECT_EQ(run.alarm, half < 6 ? "P153" : "") << mouth;
    EXPECT_EQ(run.alarm_line, half < 6 ? 3u : 0u) << mouth;
  }
}

// (2)(c): P153 with the avoidance, too, wherever the part lies.
TEST(Interference, AGrooveWithParallelWallsIsAnAlarm) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {-68.406, -127.58}, {1000, -700}, {0.1, 33.333}, {-0.7, 1e-3}})
    for (const char* const width : {"9.", "7.", "4."})
      for (const char* const avoid : {"0", "1"}) EXPECT_EQ(groove("0", width, width, avoid, x, y).alarm, "P153") << x << ' ' << width;
}

// Where the amount at one of its two ends is larger than the radius inside of an arc there is no curve (12.4.6).
TEST(Interference, AnArcThatIsSmallerThanTheAmountBefore) {
  const auto with = [](const char* line, const char* arc, const char* contour_check) {
    Bench bench;
    bench.tool(1, 2.5).tool(2, 3.2).tool(3, 2.4).param("CONTOUR_CHECK", contour_check);
    return bench.run(std::string("G90 G0 X0 Y-20. F1000\nG41 D1 G1 X0 Y0\nX-30.\nY20.\nX30. ") + line + "\nG3 X32.5 Y17.5 I2.5 " + arc + "\nG1 Y0\nX0 D1\nG40 Y-20.\nM30");
  };
  for (const char* const check : {"0", "1"}) {
    EXPECT_EQ(with("D2", "D1", check).alarm, "P153");
    EXPECT_EQ(with("D2", "D1", check).alarm_line, 6u);
    EXPECT_EQ(with("D3", "D2", check).alarm, "P153");
    EXPECT_EQ(with("D2", "D2", check).alarm, "P153");
    EXPECT_EQ(with("D3", "D3", check).alarm, "");
  }
}

// The vector of a start is that of the block behind it: without one the tool's centre would go to the corner of the part.
TEST(Interference, AnAlarmBehindTheStartStandsInFrontOfIt) {
  for (const char* const bad : {"Y50. D999", "G2 X20. Y50. R1.", "G101", "M98 P77"}) {
    Bench bench;
    bench.tool(1, 5);
    const Outcome run = bench.run(std::string("G90 G0 X0 Y0 F100\nG41 D1 G1 X10. Y10.\n") + bad + "\nG40 X0\nM30");
    EXPECT_NE(run.alarm, "") << bad;
    EXPECT_EQ(run.alarm_line, 3u) << bad;
    EXPECT_EQ(run.moves().size(), 0u) << bad;
    bench.start(std::string("G90 G0 X0 Y0 F100\nG41 D1 G1 X10. Y10.\nY30.\n") + bad + "\nG40 X0\nM30");
    EXPECT_EQ(bench.finish().moves().size(), 2u) << bad;  // the mode has begun: the block before the alarm ends at right angles
  }
}

// The perpendicular vectors of an acute corner lie on the way of lines that run beside their programmed ones, and are left out only there.
TEST(AcuteCorner, KeepsThePerpendicularOfALineThatRunsObliquely) {
  const auto path = [](const std::string& contour) {
    Bench bench;
    bench.tool(1, 10).tool(2, 2);
    const Outcome run = bench.run("G90 G0 X-100. Y-20. F100\nG41 D1 G1 X-60. Y0\n" + contour + "\nG40 X0 Y-90.\nM30");
    EXPECT_EQ(run.alarm, "");
    return run.path();
  };
  const auto passes = [](const Path& moves, const char* point) { return std::find(moves.begin(), moves.end(), std::string("line ") + point + " 0 F100") != moves.end(); };
  const Path plain = path("X0.\nX-20. Y-20.\nY-80.");
  EXPECT_TRUE(passes(plain, "10 10") && passes(plain, "14.142136 0"));
  EXPECT_FALSE(passes(plain, "0 10") || passes(plain, "7.071068 -7.071068"));
  EXPECT_TRUE(passes(path("X0.\nX-20. Y-20. D2\nY-80."), "7.071068 -7.071068"));       // another amount at its end
  EXPECT_TRUE(passes(path("X0.\nG41 X-20. Y-20. I1. J1.\nY-80."), "7.071068 -7.071068"));  // a vector of the program there
  EXPECT_TRUE(passes(path("X0.\nG38 X-20. Y-20.\nY-80."), "7.071068 -7.071068"));
  EXPECT_TRUE(passes(path("G38 X-30. Y0 I-5. J10.\nX0.\nX-20. Y-20.\nY-80."), "0 10"));  // or at its start
  EXPECT_TRUE(passes(path("G41 X-30. Y0 I5. J5.\nX0.\nX-20. Y-20.\nY-80."), "0 10"));
}

}  // namespace
}  // namespace nc::test
