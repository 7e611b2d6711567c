// SPDX-License-Identifier: Apache-2.0
// The path of the tool against the blocks around it (CONTOUR_CHECK), and blocks that run backwards though no vectors cross (M700 12.4.8).
#include "offset/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/pull.hpp"

namespace nc {
namespace {

Vec2 at(const Piece& piece, double part) {
  if (!piece.round) return piece.from + part * (piece.to - piece.from);
  const Vec2 r = piece.from - piece.center;
  const double c = std::cos(part * piece.sweep), s = std::sin(part * piece.sweep);
  return piece.center + Vec2{c * r.h - s * r.v, s * r.h + c * r.v};
}

Piece random_piece(std::mt19937& random) {
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Piece piece;
  piece.from = {number(-10, 10), number(-10, 10)};
  if (random() % 2 == 0) {
    piece.to = {number(-10, 10), number(-10, 10)};
    return piece;
  }
  piece.round = true;
  piece.center = {number(-10, 10), number(-10, 10)};
  piece.radius = piece.radius_end = norm(piece.from - piece.center);
  piece.sweep = number(-6.2, 6.2);
  piece.to = at(piece, 1);
  return piece;
}

TEST(Walls, DistanceIsThatOfTheNearestPoints) {
  std::mt19937 random(7);
  constexpr int kSteps = 100;
  unsigned crossing = 0;
  for (int i = 0; i < 400; ++i) {
    const Piece a = random_piece(random), b = random_piece(random);
    double sampled = 1e9;
    for (int k = 0; k <= kSteps; ++k)
      for (int m = 0; m <= kSteps; ++m) sampled = std::min(sampled, norm(at(a, 1.0 * k / kSteps) - at(b, 1.0 * m / kSteps)));
    const double exact = distance(a, b);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GT(exact, sampled - 1.3) << i;  // between two samples
    EXPECT_NEAR(exact, distance(b, a), 1e-12);
    crossing += exact == 0;
  }
  EXPECT_GT(crossing, 80u);
}

double away_at(const Piece& piece, double part, const Piece& other) {
  Piece place;
  place.from = place.to = at(piece, part);
  return distance(place, other);
}

// The part from one end of a piece on that is near to another without a gap is the one that its points say, to rounding: all in front of its end is near, what is right behind it is not.
TEST(Walls, AStretchEndsWhereThePieceIsFartherAway) {
  std::mt19937 random(18);
  constexpr int kSteps = 100;
  unsigned some = 0, all = 0;
  for (int i = 0; i < 4000; ++i) {
    const Piece piece = random_piece(random), other = random_piece(random);
    const double clear = std::uniform_real_distribution<double>(0.5, 12)(random);
    for (const bool from_start : {true, false}) {
      const double end = stretch_beside(piece, from_start, other, clear);
      for (int k = 0; end > 0 && k <= kSteps; ++k) EXPECT_LE(away_at(piece, from_start ? end * k / kSteps : 1 - end * k / kSteps, other), clear + 1e-6) << i;
      if (end < 1) {
        EXPECT_GT(away_at(piece, from_start ? end + 1e-7 : 1 - end - 1e-7, other), clear) << i;
      }
      some += end > 0 && end < 1;
      all += end == 1;
    }
  }
  EXPECT_GT(some, 1000u);
  EXPECT_GT(all, 300u);
}

// However short a gap is, the stretch ends there: the top of an arc that leaves the strip beside a line by 1 um, on 0.09 mm, where the tool has a radius of 5 mm.
TEST(Walls, AShortGapIsOne) {
  Piece line, arc;
  line.from = {-10, 0};
  line.to = {10, 0};
  arc.round = true;
  arc.center = {0, 4.001};
  arc.radius = arc.radius_end = 1;
  arc.from = {1, 4.001};
  arc.to = {-1, 4.001};
  arc.sweep = 3.14159265358979;
  const double begins = std::asin(0.999) / arc.sweep;
  EXPECT_NEAR(stretch_beside(arc, true, line, 5), begins, 1e-9);
  EXPECT_NEAR(stretch_beside(arc, false, line, 5), begins, 1e-9);
  EXPECT_EQ(stretch_beside(arc, true, line, 5.0011), 1);
  arc.radius = 1.001;  // its radius changes by the last digit
  arc.from = {1.001, 4.001};
  EXPECT_LT(stretch_beside(arc, true, line, 5), 0.5);
  EXPECT_LT(stretch_beside(arc, false, line, 5), 0.5);
}

}  // namespace

namespace test {
namespace {

std::string alarm_of(const std::string& text, double radius, const char* check) {
  Bench bench;
  bench.tool(1, radius).param("CONTOUR_CHECK", check);
  const Outcome run = bench.run(text);
  return run.alarm + " L" + std::to_string(run.alarm_line);
}

// A pocket whose walls come near each other, with four blocks between them: five are read ahead, so the vectors at the ends of four of them are compared.
constexpr char kNarrow[] =
    "G0 X-8.277572 Y-14.487777\nG42 D1 G1 X-8.381396 Y-19.892780 F1000\nG3 X-13.950034 Y-21.157255 I-0.228363 J-11.888450\n"
    "G2 X-23.239758 Y11.541996 I7.348999 J19.757033\nG3 X-16.597511 Y-2.045697 I37.317 J9.824795\nG3 X16.336102 Y-17.155704 I30.674753 J23.412488\n"
    "G2 X8.28561 Y-24.317616 I-15.993774 J9.87251\nG2 X2.258907 Y-25.980627 I-7.943282 J17.034422\nG3 X-2.865426 Y-21.370177 I-3.538078 J1.220538\nG3 X-8.381396 Y-19.89278 I-5.744333 J-10.411053\n"
    "G1 G40 X-8.277572 Y-14.487777\nM30\n";

TEST(ContourCheck, FindsTheWallThatTheVectorsDoNotShow) {
  EXPECT_EQ(alarm_of(kNarrow, 3.604, "0"), " L0");
  EXPECT_EQ(alarm_of(kNarrow, 3.604, "1"), "P153 L6");
  EXPECT_EQ(alarm_of(kNarrow, 2.5, "1"), " L0");
}

TEST(ContourCheck, AWayInOnAnArcIsNoWall) {
  // The way in and out of a bore on arcs: the circle's path crosses both.
  const std::string bore = "G0 X0 Y0\nG41 D1 G1 X5. Y-5. F500\nG3 X10. Y0 J5.\nG3 I-10.\nG3 X5. Y5. I-5.\nG40 G1 X0 Y0\nM30\n";
  EXPECT_EQ(alarm_of(bore, 3, "0"), " L0");
  EXPECT_EQ(alarm_of(bore, 3, "1"), " L0");
}

TEST(Interference, AnArcThatRunsBackwardsIsFoundThoughNoVectorsCross) {  // 12.4.8 alarm (2)(c)
  const std::string text =
      "G0 X-5.854393 Y7.040663\nG42 D1 G1 X-6.738054 Y6.854783 F1000\nG3 X-11.280107 Y12.449718 I-7.716389 J-1.62316\n"
      "G3 X-11.281022 Y12.450121 I-3.174336 J-7.218095\nG1 X20.956282 Y-1.157072\nG1 X20. Y-20.\nG40 G1 X0 Y-30.\nM30\n";
  EXPECT_EQ(alarm_of(text, 0.602, "0"), "P153 L4");
}

}  // namespace
}  // namespace test
}  // namespace nc
