// SPDX-License-Identifier: Apache-2.0
// The least-squares control points alone: lines and cubics are reproduced, and noise is averaged.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "motion/optimal/fit.hpp"

namespace nc::test {
namespace {

using optimal::CellMoments;

constexpr unsigned kAxes = 3;

double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

/// A polyline through points of a curve, with u as the parameter of both.
struct Line {
  std::vector<AxisVec> vertex;
  std::vector<double> length, u;

  void to(double at, const AxisVec& p) {
    if (!u.empty()) length.push_back(at - u.back());
    u.push_back(at);
    vertex.push_back(p);
  }
  AxisVec control(const double (&knot)[5]) const {
    CellMoments cell[4];
    const CellMoments* cells[4];
    unsigned edge = 0;
    for (unsigned k = 0; k < 4; ++k) {
      const optimal::Edges edges{vertex.data(), length.data(), u.data(), static_cast<unsigned>(u.size())};
      cell_moments(edges, knot[k], knot[k + 1], kAxes, &edge, &cell[k]);
      cells[k] = &cell[k];
    }
    return fitted_control(cells, kAxes);
  }
};

void random_knots(std::mt19937_64& rng, double from, double size, double (&knot)[5]) {
  knot[0] = from;
  for (unsigned k = 1; k < 5; ++k) knot[k] = knot[k - 1] + size * std::exp(uniform(rng, -2, 2));
}

TEST(Fit, AStraightLineIsGivenBack) {
  std::mt19937_64 rng(1);
  for (unsigned n = 0; n < 2000; ++n) {
    double knot[5];
    random_knots(rng, uniform(rng, 0, 100), std::exp(uniform(rng, -5, 2)), knot);
    const double step = (knot[4] - knot[0]) * std::exp(uniform(rng, -4, 1));
    AxisVec start, way;
    for (unsigned i = 0; i < kAxes; ++i) start[i] = uniform(rng, -100, 100), way[i] = uniform(rng, -1, 1);
    Line line;
    for (double u = knot[0] - step; u < knot[4] + step; u += step * uniform(rng, 0.2, 1)) {
      AxisVec p;
      for (unsigned i = 0; i < kAxes; ++i) p[i] = start[i] + u * way[i];
      line.to(u, p);
    }
    const double place = (knot[1] + knot[2] + knot[3]) / 3;
    if (line.u.back() < knot[4]) continue;
    const AxisVec d = line.control(knot);
    for (unsigned i = 0; i < kAxes; ++i) ASSERT_NEAR(d[i], start[i] + place * way[i], 2e-12) << n;
  }
}

/// The polar form of (u - a) (u - b) (u - c) at x, y, z is the mean of (x - a) (y - b) (z - c) over the six orders of
/// a, b, c.
TEST(Fit, ACubicHasItsPolarForm) {
  std::mt19937_64 rng(2);
  for (unsigned n = 0; n < 200; ++n) {
    double knot[5];
    random_knots(rng, 0, 1, knot);
    const double a = uniform(rng, -3, 3), b = uniform(rng, -3, 3), c = uniform(rng, -3, 3);
    Line line;
    constexpr unsigned kParts = 4000;
    for (unsigned k = 0; k <= kParts; ++k) {
      const double u = knot[4] * k / kParts;
      AxisVec p;
      p[0] = (u - a) * (u - b) * (u - c);
      line.to(u, p);
    }
    const double root[3] = {a, b, c}, x = knot[1], y = knot[2], z = knot[3];
    double polar = 0;
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = 0; j < 3; ++j)
        if (i != j) polar += (x - root[i]) * (y - root[j]) * (z - root[3 - i - j]) / 6;
    const double chord = std::pow(knot[4] / kParts, 2) * (knot[4] + 3);  // distance of the lines from the cubic
    EXPECT_NEAR(line.control(knot)[0], polar, 4 * chord + 1e-12) << n;
  }
}

/// With ten short lines in a cell the control points have a third of the noise of the vertices.
TEST(Fit, NoiseIsAveraged) {
  std::mt19937_64 rng(3);
  std::normal_distribution<double> noise(0, 1);
  double squares = 0;
  constexpr unsigned kTimes = 4000;
  for (unsigned n = 0; n < kTimes; ++n) {
    Line line;
    for (unsigned k = 0; k <= 40; ++k) {
      AxisVec p;
      p[2] = noise(rng);
      line.to(k, p);
    }
    const double knot[5] = {0, 10, 20, 30, 40};
    squares += std::pow(line.control(knot)[2], 2);
  }
  EXPECT_LT(std::sqrt(squares / kTimes), 1.0 / 3);
}

/// A cell in two parts is the same as a whole.
TEST(Fit, MomentsOfPartsAddUp) {
  std::mt19937_64 rng(4);
  Line line;
  for (unsigned k = 0; k <= 30; ++k) {
    AxisVec p;
    for (unsigned i = 0; i < kAxes; ++i) p[i] = uniform(rng, -1, 1);
    line.to(k, p);
  }
  const optimal::Edges edges{line.vertex.data(), line.length.data(), line.u.data(), 31};
  for (unsigned n = 0; n < 500; ++n) {
    const double from = uniform(rng, 0, 14), to = from + uniform(rng, 0.1, 15), middle = 0.5 * (from + to);
    CellMoments whole, first, second;
    unsigned edge = 0;
    cell_moments(edges, from, to, kAxes, &edge, &whole);
    edge = 0;
    cell_moments(edges, from, middle, kAxes, &edge, &first);
    cell_moments(edges, middle, to, kAxes, &edge, &second);
    for (unsigned i = 0; i < kAxes; ++i) {
      const double shift = second.at[i] - first.at[i];
      EXPECT_NEAR(whole.moment[0][i], 0.5 * (first.moment[0][i] + second.moment[0][i] + shift), 1e-12);
      // s of the second half is (1 + x) / 2, that of the first one x / 2.
      const double behind = second.moment[0][i] + shift + second.moment[1][i] + shift / 2;
      EXPECT_NEAR(whole.moment[1][i], 0.25 * (first.moment[1][i] + behind), 1e-12);
    }
  }
}

}  // namespace
}  // namespace nc::test
