// SPDX-License-Identifier: Apache-2.0
// Interference and its avoidance around arcs (M700 12.4.8): whatever is left out or erased, and in front of whichever alarm, an arc that is driven lies on its
// own offset circle and goes round in its own sense.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

#include "alarm/condition.hpp"
#include "path_builder.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) { return std::uniform_real_distribution<>(low, high)(random); }
double any_size(Random& random, double low, double high) { return std::exp(between(random, std::log(low), std::log(high))); }
int pick(Random& random, int n) { return std::uniform_int_distribution<>(0, n - 1)(random); }

/// Lines and arcs from far shorter to far longer than the amount, with corners of every kind and changes of side.
PathBuilder crowded_contour(Random& random) {
  PathBuilder path(-50, -30);
  const double r = any_size(random, 0.3, 20);
  int side = pick(random, 2) == 0 ? 1 : -1;
  path.side(side, r);
  path.comp.check = true;
  path.comp.avoid = pick(random, 4) != 0;
  path.comp.type_b = pick(random, 3) == 0;
  path.line(0, 0);
  double heading = between(random, -3, 3);
  for (int blocks = 4 + pick(random, 8); blocks > 0; --blocks) {
    if (pick(random, 6) == 0) path.side(side = -side, r);
    if (pick(random, 2) == 0) {
      const double radius = any_size(random, 0.05 * r, 10 * r), sweep = any_size(random, 0.02, 6.2), s = pick(random, 2) == 0 ? 1 : -1;
      const double i = -s * std::sin(heading) * radius, j = s * std::cos(heading) * radius;
      heading += s * sweep;
      path.arc_by(s > 0, i + s * std::sin(heading) * radius, j - s * std::cos(heading) * radius, i, j);
    } else {
      const double length = any_size(random, 0.02 * r, 10 * r);
      path.by(length * std::cos(heading), length * std::sin(heading));
    }
    heading += pick(random, 4) == 0 ? 0 : pick(random, 3) == 0 ? (pick(random, 2) == 0 ? 1 : -1) * std::acos(0.0) : between(random, -2.5, 2.5);
  }
  path.cancel().by(40 * std::cos(heading), 40 * std::sin(heading)).end();
  return path;
}

/// What is wrong with an arc that comes out for this programmed one, or nothing.
std::string wrong_with(const Move& out, const Move& programmed) {
  const double sense = programmed.circle.sweep > 0 ? 1 : -1;
  const double radius = programmed.circle.radius_start - sense * signed_offset(programmed.comp), small = 1e-9 * std::max(1.0, out.circle.radius_start);
  if (std::abs(out.circle.radius_start - out.circle.radius_end) > small) return "its radii differ";
  if (radius < -small) return "there is no such offset circle";
  if (std::abs(out.circle.radius_start - radius) > 10 * small) return "it is beside its offset circle";
  if (out.circle.sweep * sense < 0) return "it goes back";
  const double angle = out.circle.angle_start + out.circle.sweep;
  const double h = out.circle.center[0] + out.circle.radius_end * std::cos(angle), v = out.circle.center[1] + out.circle.radius_end * std::sin(angle);
  return std::hypot(h - out.end[0], v - out.end[1]) > 100 * small ? "its end is not where its angle leads to" : "";
}

TEST(Avoidance, EveryArcLiesOnItsOffsetCircle) {
  unsigned arcs = 0, left_out = 0;
  for (unsigned seed = 0; seed < 12500; ++seed) {
    Random random(seed);
    const PathBuilder path = crowded_contour(random);
    std::map<uint32_t, const Move*> programmed;
    for (const Item& item : path.items)
      if (item.kind == ItemKind::move) programmed[item.source.line] = &item.move;
    const std::vector<Item> out = run_stage(path);
    AxisVec at = path.start();
    uint32_t line = 0;
    for (const Item& item : out) {
      if (item.kind != ItemKind::move) continue;
      for (unsigned i = 0; i < 3; ++i) ASSERT_NEAR(item.move.start[i], at[i], 1e-9) << "seed " << seed << ": a gap at line " << item.source.line;
      at = item.move.end;
      if (!item.move.connecting && item.source.line > line + 1) ++left_out;
      line = item.source.line;
      if (!item.move.circular) continue;
      ++arcs;
      ASSERT_EQ(wrong_with(item.move, *programmed[item.source.line]), "") << "seed " << seed << ", line " << item.source.line;
    }
  }
  EXPECT_GT(arcs, 8000u);
  EXPECT_GT(left_out, 100u);
}

Section line_section(Vec2 delta, double offset) {
  Section section;
  section.begin = section.end = {unit(delta), 0};
  section.delta = delta;
  section.offset = offset;
  section.check = true;
  return section;
}

/// An arc of this radius that begins in the direction of the first axis; the sweep is counter-clockwise positive.
Section arc_section(double radius, double sweep, double offset) {
  const double k = (sweep > 0 ? 1 : -1) / radius;
  Section section;
  section.begin = {{1, 0}, k};
  section.end = {{std::cos(sweep), std::sin(sweep)}, k};
  section.delta = {std::sin(sweep) / k, (1 - std::cos(sweep)) / k};
  section.offset = offset;
  section.sweep = sweep;
  section.check = true;
  return section;
}

void set_joint(Section* section, std::initializer_list<Vec2> vectors) {
  section->joint = ContourJoint{};
  for (const Vec2 w : vectors) section->joint.v[section->joint.n++] = w;
  section->jointed = true;
}

/// Two joints of four vectors at the ends of an arc; (3) and (2)' cross, and (2) and (3)' are what is left.
Chain around_an_arc(const Section& arc, Vec2 second, Vec2 third) {
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(arc);
  chain.push_back(line_section({0, 50}, 10));
  set_joint(&chain[0], {{-10, 0}, second, {8, 10}, {9, 10}});
  set_joint(&chain[1], {{-9, 10}, {-8, 10}, third, {10, 0}});
  return chain;
}

// 12.4.8, the figure with an arc: "linear movement" between the vectors that are valid.
TEST(Avoidance, ALineLeadsBetweenTheVectorsThatAreLeftOfAnArc) {
  Chain chain = around_an_arc(arc_section(100, 0.1, 10), {-10, 11}, {10, 11});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 3, {}, &at), Finding::alarm);  // it leaves something uncut, which only the avoidance may
  EXPECT_EQ(at, 1u);
  chain = around_an_arc(arc_section(100, 0.1, 10), {-10, 11}, {10, 11});
  chain[1].avoid = true;
  EXPECT_EQ(check_interference(&chain, 3, {}, &at), Finding::none);
  EXPECT_EQ(chain[0].joint.v[chain[0].joint.n - 1], (Vec2{-10, 11}));
  EXPECT_EQ(chain[1].joint.v[0], (Vec2{10, 11}));
  EXPECT_TRUE(chain[1].oblique);
  EXPECT_FALSE(path_of(chain[1], {}, chain[0].joint.v[1], chain[1].joint.v[0]).round);
}

// ... and where that line would cut into the arc, it is an alarm: the vectors of lengthened corners lie beyond it.
TEST(Avoidance, ALineThroughTheArcIsAnAlarm) {
  Chain chain = around_an_arc(arc_section(100, 0.1, 10), {-10, 5}, {10, 5});
  chain[1].avoid = true;
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 3, {}, &at), Finding::alarm);
  EXPECT_EQ(at, 1u);
}

/// P153, with the avoidance as without it; without it in this line.
void expect_alarm_with_and_without(const char* radius, const std::string& contour, unsigned line) {
  for (const char* const avoid : {"0", "1"}) {
    Bench bench;
    bench.tool(1, std::strtod(radius, nullptr)).param("8102", avoid);
    const Outcome run = bench.run(contour + "M30");
    EXPECT_EQ(run.alarm, "P153") << contour << avoid;
    if (avoid[0] == '0') {
      EXPECT_EQ(run.alarm_line, line) << contour;
    }
  }
}

// 12.4.8: the avoidance leaves something uncut, and cuts nothing off. The offset curves around the blocks that it would leave out meet beyond them.
TEST(Avoidance, WhatStandsBetweenTheBlocksIsNotCutOff) {
  expect_alarm_with_and_without("5", "G90 G0 X80. Y20.\nG1 G42 D1 X70. Y0 F500\nX51.\nX50.8\nX50.2 Y1.1\nX49.85 Y0\nX30.\nG40 Y20.\n", 3);            // a rib
  expect_alarm_with_and_without("5", "G90 G0 X-20. Y20.\nG1 G41 D1 X0 Y0 F500\nX40.\nY-1.2\nX40.1\nX41.3 Y-2.5\nX80.\nG40 Y20.\n", 4);                // a stair
}

// A groove beside a half-round nose: the circle of the nose goes on through the wall in front of the groove before it meets that wall's offset curve.
TEST(Avoidance, AnArcIsNotLengthenedThroughTheBlockInFront) {
  expect_alarm_with_and_without("1", "G90 G0 X-20. Y10.\nG1 G42 D1 X-10. Y0 F500\nX0.\nY-.2\nX-8.\nG3 Y-20.2 J-10.\nG1 X5.\nG40 Y-30.\n", 3);
}

// The blocks beside the one that interferes run in parallel, so they cannot be joined (2)(b); the next two would meet, over a face that the tool can go along.
TEST(Avoidance, ABlockThatTheToolCanGoAlongIsNotLeftOut) {
  Bench bench;
  bench.tool(1, 2).param("8102", "1");
  const Outcome run = bench.run("G90 G0 X45. Y70.\nG1 G42 D1 X42. Y60. F500\nX31.\nX31.012 Y59.98\nX-69.\nY30.\nG40 X-80.\nM30");
  EXPECT_EQ(run.alarm, "P153");
}

// A step is left out, and the block behind the short one that is joined in its place cuts its upper corner off by 0.07 mm.
TEST(Avoidance, TheBlockBehindTheJoinedOnesKeepsTheAmountToWhatIsLeftOut) {
  for (const auto& [corner, alarm] : {std::pair{"Y-0.1", "P153"}, std::pair{"Y-0.01", ""}}) {
    Bench bench;
    bench.tool(1, 1).param("8102", "1");
    const Outcome run = bench.run(std::string("G90 G0 X0 Y2.5\nG41 D1 G1 X0 Y0 F500\nX7.5\n") + corner + "\nX7.506 " + (*alarm != 0 ? "Y-0.093" : "Y-0.003") + "\nX12. Y-3.2\nG40 X13.4 Y-1.2\nM30");
    EXPECT_EQ(run.alarm, alarm) << corner;
    EXPECT_EQ(run.alarm_line, *alarm != 0 ? 3u : 0u);
  }
}

// A change of side has a vector on each side; without the one of its own side a block would run on the other's.
TEST(Avoidance, TheVectorsOfAChangeOfSideAreNotErasedOneByOne) {
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({30, 1}, -10));
  set_joint(&chain[0], {{-10, 0}, {8, 10}});
  set_joint(&chain[1], {{-8, 10}, {0.3, -10}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::alarm);
}

}  // namespace
}  // namespace nc::test
