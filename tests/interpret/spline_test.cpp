// SPDX-License-Identifier: Apache-2.0
// G05.1 Q2 (M700 13.18): which blocks become parts of the curve, how the curve is revised, alarms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Bench spline_bench() {
  Bench bench;
  bench.param("1267/bit0", "1").param("8025", "1");
  return bench;
}

const std::string kOn = "G5 P10000\nG5.1 Q2 X0 Y0 Z0\nG1 F1000\n", kOff = "G5.1 Q0\nG5 P0\nM30";

/// The kinds of the moves, one letter each: s = spline, l = line.
std::string kinds(Bench& bench, const std::string& text) {
  const Outcome run = bench.at(0, 0, 0).run(kOn + text + kOff);
  EXPECT_EQ(run.alarm, "") << text;
  std::string all;
  for (const nc_move& m : run.moves()) all += m.kind == NC_MOVE_SPLINE ? 's' : m.kind == NC_MOVE_LINE ? 'l' : '?';
  return all;
}

TEST(Spline, GoesThroughThePointsBlockByBlock) {
  Bench bench = spline_bench();
  const Outcome run = bench.at(0, 0, 0).run(kOn + "X.5 Y.1\nX1. Y.4\nX1.2 Y.9 Z.1\nX1.1 Y1.4\n" + kOff);
  EXPECT_EQ(run.alarm, "");
  const std::vector<nc_move> m = run.moves();
  ASSERT_EQ(m.size(), 4u);
  const double points[4][3] = {{.5, .1, 0}, {1, .4, 0}, {1.2, .9, .1}, {1.1, 1.4, .1}};
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ(m[i].kind, NC_MOVE_SPLINE);
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(m[i].machine.v[axis], points[i][axis], 1e-12);
  }
  // The first block is the parabola through the first three points: longer than its chord by less than a tenth.
  EXPECT_GT(m[0].length, std::hypot(.5, .1));
  EXPECT_LT(m[0].length, 1.1 * std::hypot(.5, .1));
}

TEST(Spline, CircleOfFineSegmentsComesOutRound) {
  Bench bench = spline_bench();
  std::string text;
  for (int k = 1; k <= 36; ++k)
    text += "X" + std::to_string(5 * std::sin(k * M_PI / 36)) + " Y" + std::to_string(5 - 5 * std::cos(k * M_PI / 36)) + "\n";
  const Outcome run = bench.at(0, 0, 0).run(kOn + text + kOff);
  double length = 0;
  for (const nc_move& m : run.moves()) length += m.length;
  EXPECT_NEAR(length, 5 * M_PI, 1e-4);  // 36 chords are 5e-3 shorter
}

TEST(Spline, ConditionsBreakIt) {  // 13.18 (1)
  Bench bench = spline_bench();
  EXPECT_EQ(kinds(bench, "X.5 Y.1\nX1. Y.3\nX1.5 Y.6\n"), "sss");
  EXPECT_EQ(kinds(bench, "X.5 Y.1\n"), "l");                                     // one block alone
  EXPECT_EQ(kinds(bench, "X.5\nX1.\nX1.5\n"), "lll");                            // points on a line
  EXPECT_EQ(kinds(bench, "X.5 Y.1\nX1. Y.3\nX3. Y.6\nX3.5 Y.8\nX4. Y1.2\n"), "sslss");   // longer than 1 mm
  EXPECT_EQ(kinds(bench, "X.5 Y.1\nX1. Y.3\nM8\nX1.5 Y.6\nX2. Y1.\n"), "ssss");  // no movement: two splines
  EXPECT_EQ(kinds(bench, "X.5 Y.1\nM8\nX1. Y.3\n"), "ll");
  EXPECT_EQ(kinds(bench, "X.5 Y.1\n;\nX1. Y.3\n"), "ss");                        // ";" alone is no block
  EXPECT_EQ(kinds(bench, "X.9 Y.1\nX1. Y.2\nX1.1 Y.4\n"), "sss");
  EXPECT_EQ(kinds(bench, "X.9 Y.1\nX1. Y.12\nX1.1 Y.2\n"), "lss");               // more than eight times its neighbour
  bench.param("8030", "-1");
  EXPECT_EQ(kinds(bench, "X.9 Y.1\nX1. Y.12\nX1.1 Y.2\n"), "sss");
  EXPECT_EQ(kinds(bench, "X5. Y1.\nX10. Y3.\n"), "ss");
  bench.param("8030", "6");
  EXPECT_EQ(kinds(bench, "X5. Y1.\nX10. Y3.\nX17. Y5.\n"), "ssl");
}

TEST(Spline, OnlyTheNamedAxesTakePart) {  // 13.18 (2)
  Bench bench = spline_bench();
  const Outcome run = bench.at(0, 0, 0).run("G5 P10000\nG5.1 Q2 X0 Y0\nG1 F1000\nX.5 Y.1\nX1. Y.3\nX1.5 Y.6 Z.1\nX2. Y.8\nX2.5 Y1.2\n" + kOff);
  std::string all;
  for (const nc_move& m : run.moves()) all += m.kind == NC_MOVE_SPLINE ? 's' : 'l';
  EXPECT_EQ(all, "sslss");
}

TEST(Spline, CornersLargerThanTheCancelAngle) {  // 13.18 (1) (a)
  Bench bench = spline_bench();
  const std::string corner = "X.5 Y.1\nX1. Y.1\nX1. Y.6\nX.9 Y1.\n";
  EXPECT_EQ(kinds(bench, corner), "ssss");
  bench.param("8026", "60");
  EXPECT_EQ(kinds(bench, corner), "ssss");  // two curves that meet at the corner
  const std::vector<nc_move> split = bench.at(0, 0, 0).run(kOn + corner + kOff).moves();
  bench.param("8026", "0");
  const std::vector<nc_move> whole = bench.at(0, 0, 0).run(kOn + corner + kOff).moves();
  EXPECT_LT(split[1].length, whole[1].length);  // no bulge towards the corner
  bench.param("8026", "8");
  EXPECT_EQ(kinds(bench, corner), "llll");
}

TEST(Spline, ChordErrorIsRevisedOrCancels) {  // 13.18 (2)
  Bench bench = spline_bench();
  // Without an inflection: half a millimetre that rises and falls.
  const std::string arch = "X.5 Y.25\nX1. Y0\n";
  const double free_length = bench.at(0, 0, 0).run(kOn + arch + kOff).moves()[0].length;
  bench.param("8027", "0.001");  // not the one of a block without an inflection
  EXPECT_EQ(bench.at(0, 0, 0).run(kOn + arch + kOff).moves()[0].length, free_length);
  bench.param("8027", "0").param("8028", "0.03");
  const nc_move revised = bench.at(0, 0, 0).run(kOn + arch + kOff).moves()[0];
  EXPECT_EQ(revised.kind, NC_MOVE_SPLINE);
  EXPECT_LT(revised.length, free_length);
  bench.param("8028", "0.001");
  EXPECT_EQ(kinds(bench, arch), "ll");  // more than five times the tolerance
}

using Point = std::array<double, 3>;

/// The path of `text` as so many points for each move: [move][sample].
std::vector<std::vector<Point>> sampled(Bench& bench, const std::string& text, unsigned samples) {
  bench.at(0, 0, 0).start(text);
  std::vector<std::vector<Point>> all;
  Step step;
  while (bench.pull(&step) == NC_OK) {
    if (step.item.kind != NC_ITEM_MOVE) continue;
    std::vector<Point>& move = all.emplace_back();
    for (unsigned k = 0; k <= samples; ++k) {
      nc_axes at{};
      const double share = static_cast<double>(k) / samples;
      if (!step.item.u.move.curved) {
        for (unsigned i = 0; i < 3; ++i)
          at.v[i] = step.item.u.move.machine_start.v[i] + share * (step.item.u.move.machine.v[i] - step.item.u.move.machine_start.v[i]);
      } else {
        EXPECT_EQ(nc_move_point(bench.control(), 0, share, &at), NC_OK);
      }
      move.push_back({at.v[0], at.v[1], at.v[2]});
    }
  }
  return all;
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double norm(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// Random fine segments that turn a little from one to the next.
std::string random_text(std::mt19937_64& rng, unsigned blocks) {
  std::uniform_real_distribution<double> length(0.3, 0.9), turn(-0.5, 0.5);
  double heading = 0, x = 0, y = 0, z = 0;
  std::string text;
  for (unsigned i = 0; i < blocks; ++i) {
    heading += turn(rng);
    const double l = length(rng);
    x += l * std::cos(heading);
    y += l * std::sin(heading);
    z += 0.3 * turn(rng);
    text += "X" + std::to_string(x) + " Y" + std::to_string(y) + " Z" + std::to_string(z) + "\n";
  }
  return text;
}

TEST(Spline, TangentAndCurvatureGoOnAtThePoints) {
  std::mt19937_64 rng(1);
  constexpr unsigned kSamples = 400;
  for (unsigned n = 0; n < 20; ++n) {
    Bench bench = spline_bench();
    const auto path = sampled(bench, kOn + random_text(rng, 12) + kOff, kSamples);
    ASSERT_EQ(path.size(), 12u);
    for (size_t i = 1; i < path.size(); ++i) {
      const Point before[3] = {path[i - 1][kSamples - 2], path[i - 1][kSamples - 1], path[i - 1][kSamples]};
      const Point behind[3] = {path[i][0], path[i][1], path[i][2]};
      EXPECT_LT(norm(minus(before[2], behind[0])), 1e-12);
      // One-sided differences by the length, with an error of the first order in the step.
      const double ha = norm(minus(before[2], before[1])), hb = norm(minus(behind[1], behind[0]));
      Point ta, tb, ka, kb;
      for (unsigned axis = 0; axis < 3; ++axis) {
        ta[axis] = (3 * before[2][axis] - 4 * before[1][axis] + before[0][axis]) / (2 * ha);
        tb[axis] = (-3 * behind[0][axis] + 4 * behind[1][axis] - behind[2][axis]) / (2 * hb);
        ka[axis] = (before[2][axis] - 2 * before[1][axis] + before[0][axis]) / (ha * ha);
        kb[axis] = (behind[2][axis] - 2 * behind[1][axis] + behind[0][axis]) / (hb * hb);
      }
      EXPECT_LT(norm(minus(ta, tb)), 1e-3) << n << " " << i;
      EXPECT_LT(norm(minus(ka, kb)), 0.1) << n << " " << i;
    }
  }
}

TEST(Spline, RevisedBlocksKeepTheirTolerance) {  // 13.18 (2)
  std::mt19937_64 rng(2);
  for (unsigned n = 0; n < 20; ++n) {
    Bench bench = spline_bench();
    bench.param("8027", "0.004").param("8028", "0.006");
    const auto path = sampled(bench, kOn + random_text(rng, 12) + kOff, 200);
    for (const auto& move : path) {
      const Point chord = minus(move.back(), move.front());
      double most = 0;
      for (const Point& p : move) {
        const Point q = minus(p, move.front());
        const double along = (q[0] * chord[0] + q[1] * chord[1] + q[2] * chord[2]) / norm(chord);
        most = std::max(most, std::sqrt(std::max(0.0, norm(q) * norm(q) - along * along)));
      }
      EXPECT_LT(most, 0.006 + 1e-9) << n;
    }
  }
}

TEST(Spline, Alarms) {
  Bench bench = spline_bench();
  EXPECT_EQ(bench.run("G5.1 Q2 X0 Y0 Z0\nM30").alarm, "P34");
  EXPECT_EQ(bench.run("G5.1 Q1\nG5.1 Q2 X0\nM30").alarm, "P34");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 X0\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 Q2 X0 F100\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 Q2 X0 G1\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 Q2 X0\nG5.1 Q0 X0\nM30").alarm, "P33");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 Q2 X0\nG16\nM30").alarm, "P34");
  bench.param("8025", "0");
  EXPECT_EQ(bench.run("G5 P10000\nG5.1 Q2 X0 Y0 Z0\nM30").alarm, "P34");
}

TEST(Spline, ReadAgainFromItsMiddleIsTheSameCurve) {
  Bench bench = spline_bench();
  const std::string text = kOn + "X.5 Y.1\nX1. Y.4\nX1.2 Y.9 Z.1\nX1.1 Y1.4\nX1. Y2.\n" + kOff;
  const std::vector<nc_move> all = bench.at(0, 0, 0).run(text).moves();
  ASSERT_EQ(all.size(), 5u);
  for (const unsigned back : {4u, 5u, 6u, 7u}) {
    bench.at(0, 0, 0).start(text);
    Step step, mark;
    while (bench.pull(&step) == NC_OK && step.item.source.line < 9)
      if (step.item.kind == NC_ITEM_MARK && step.item.source.line == back) mark = step;
    ASSERT_EQ(bench.rewind(mark.item.serial, mark.machine), NC_OK);
    const std::vector<nc_move> rest = bench.finish().moves();
    ASSERT_EQ(rest.size(), all.size() - (back - 3));
    for (size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i].length, all[all.size() - rest.size() + i].length) << back;
  }
}

}  // namespace
}  // namespace nc::test
