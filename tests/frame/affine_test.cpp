// SPDX-License-Identifier: Apache-2.0
// The affine maps of the axes: their products, their inverses, and which results are exact.
#include "frame/affine.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <random>

namespace nc::test {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
unsigned axis_below(Random& random, unsigned count) { return std::uniform_int_distribution<unsigned>(0, count - 1)(random); }

AxisVec any_point(Random& random) {
  AxisVec p;
  for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = between(random, -1000, 1000);
  return p;
}

/// A reflection, a stretch of one axis, a translation, or a rotation of two of the axes from `first` on, of which there are `count`.
Affine any_map(Random& random, unsigned first, unsigned count, bool stretch = true) {
  const unsigned h = first + axis_below(random, count), v = first + (h - first + 1 + axis_below(random, count - 1)) % count;
  switch (axis_below(random, 4)) {
    case 0: return Affine::stretch(axis_below(random, kMaxAxes), -1, between(random, -500, 500));
    case 1:
      if (stretch) return Affine::stretch(axis_below(random, kMaxAxes), between(random, 0.2, 5), between(random, -500, 500));
      [[fallthrough]];
    case 2: return Affine::translation(any_point(random));
    default: return Affine::rotation(h, v, Affine::Angle::degrees(between(random, -400, 400)), between(random, -500, 500), between(random, -500, 500));
  }
}

/// `size` is the largest size of coordinates in the calculation, which determines the rounding.
void expect_same(const AxisVec& a, const AxisVec& b, double size, const char* what) {
  for (unsigned i = 0; i < kMaxAxes; ++i) EXPECT_NEAR(a[i], b[i], 1e-12 * size) << what << ", axis " << i;
}

// M98 I J makes its angle from two directions and adds angles up: quarter turns must exchange coordinates to the last bit (13.3.3).
TEST(AffineAngle, SumsOfQuartersInRadiansAreExact) {
  for (const double step : {std::atan2(1, 0) - std::atan2(0, 1), std::atan2(-7, 0) - std::atan2(0, 3), std::atan2(1, 1) - std::atan2(-1, 1)}) {
    double angle = 0;
    for (int n = 1; n <= 20; ++n) {
      angle += step;
      const Affine::Angle turn = Affine::Angle::radians(angle);
      EXPECT_EQ(std::fabs(turn.cos) + std::fabs(turn.sin), 1) << step << " " << n;
      EXPECT_EQ(turn.cos * turn.sin, 0) << step << " " << n;
      EXPECT_NEAR(turn.cos, std::cos(angle), 1e-12);
      EXPECT_NEAR(turn.sin, std::sin(angle), 1e-12);
    }
  }
  EXPECT_NE(Affine::Angle::radians(1e-12).sin, 0);  // a commanded angle stays an angle, however small
}

TEST(Affine, TogetherTheyAreOneBehindTheOther) {
  Random random(1);
  for (int run = 0; run < 2000; ++run) {
    Affine whole;
    AxisVec p = any_point(random);
    const AxisVec start = p;
    double size = 1000;
    for (unsigned n = 0; n < 6; ++n) {
      const Affine next = any_map(random, 1, 4);
      ASSERT_TRUE(whole.then(next));
      p = next.apply(p);
      for (unsigned i = 0; i < kMaxAxes; ++i) size = std::max(size, std::fabs(p[i]));
    }
    expect_same(whole.apply(start), p, 10 * size, "whole");
  }
}

TEST(Affine, TheInverseLeadsBack) {
  Random random(2);
  for (int run = 0; run < 2000; ++run) {
    Affine map;
    for (unsigned n = 0; n < 5; ++n) ASSERT_TRUE(map.then(any_map(random, 0, 3)));
    const AxisVec p = any_point(random), there = map.apply(p);
    double size = 1000;
    for (unsigned i = 0; i < kMaxAxes; ++i) size = std::max({size, std::fabs(there[i]), std::fabs(map.offset()[i])});
    size *= 625;  // four stretches by 5
    expect_same(map.inverse().apply(there), p, size, "inverse()");
    expect_same(map.apply_inverse(there), p, size, "apply_inverse()");
    Affine none = map;
    ASSERT_TRUE(none.then(map.inverse()));
    expect_same(none.apply(p), p, size, "map and inverse");
  }
}

TEST(Affine, ATranslationIsExactAndSaysSo) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    const AxisVec by = any_point(random), p = any_point(random);
    Affine map = Affine::translation(by);
    ASSERT_TRUE(map.then(Affine::stretch(2, 1, 7)));  // neither of these changes anything
    ASSERT_TRUE(map.then(Affine::rotation(0, 1, Affine::Angle::degrees(720), 3, 4)));
    EXPECT_TRUE(map.only_translates());
    EXPECT_TRUE(map == Affine::translation(by));
    for (unsigned i = 0; i < kMaxAxes; ++i) {
      EXPECT_EQ(map.apply(p)[i], p[i] + by[i]);
      EXPECT_EQ(map.apply_inverse(p)[i], p[i] - by[i]);
      EXPECT_EQ(map.inverse().apply(p)[i], p[i] - by[i]);
    }
  }
  EXPECT_FALSE(Affine::stretch(1, -1, 0).only_translates());
  EXPECT_FALSE(Affine::translation(any_point(random)) == Affine{});
  EXPECT_FALSE(Affine::stretch(1, -1, 0) == Affine::stretch(2, -1, 0));
  EXPECT_FALSE(Affine::rotation(0, 1, Affine::Angle::degrees(90), 0, 0) == Affine::rotation(0, 2, Affine::Angle::degrees(90), 0, 0));
}

TEST(Affine, QuartersAreExact) {
  Random random(4);
  for (const auto& [h, v] : {std::pair{0u, 1u}, std::pair{2u, 0u}, std::pair{5u, 3u}})
    for (int quarter = -9; quarter <= 9; ++quarter) {
      const Affine map = Affine::rotation(h, v, Affine::Angle::degrees(90 * quarter), 0, 0);
      const AxisVec p = any_point(random);
      double x = p[h], y = p[v];
      for (int n = 0; n < ((quarter % 4) + 4) % 4; ++n) {
        const double before = x;
        x = -y;
        y = before;
      }
      for (unsigned i = 0; i < kMaxAxes; ++i) EXPECT_EQ(map.apply(p)[i], i == h ? x : i == v ? y : p[i]) << quarter << " axis " << i;
      for (unsigned i = 0; i < kMaxAxes; ++i) EXPECT_EQ(map.inverse().apply(map.apply(p))[i], p[i]) << quarter << " axis " << i;
      EXPECT_EQ(std::popcount(map.coupled()), quarter % 2 == 0 ? 0 : 2);
    }
}

TEST(Affine, AnAxisThatIsNotConcernedKeepsItsLastBit) {
  Random random(5);
  for (int run = 0; run < 200; ++run) {
    Affine map = Affine::rotation(0, 1, Affine::Angle::degrees(between(random, 0, 360)), 7, 8);
    ASSERT_TRUE(map.then(Affine::rotation(4, 3, Affine::Angle::degrees(between(random, 0, 360)), 9, 10)));
    ASSERT_TRUE(map.then(Affine::stretch(5, -1, 3)));
    const AxisVec p = any_point(random);
    for (const unsigned i : {2u, 6u, 7u}) {
      EXPECT_EQ(map.apply(p)[i], p[i]);
      EXPECT_EQ(map.inverse().apply(p)[i], p[i]);
    }
    EXPECT_EQ(map.apply(p)[5], 6 - p[5]);
    EXPECT_EQ(map.on_axis(5, p[5]), 6 - p[5]);
  }
}

TEST(Affine, ItIsWhatEigenMakesOfTheSameMaps) {
  Random random(6);
  for (int run = 0; run < 500; ++run) {
    const double z = between(random, -180, 180), x = between(random, -180, 180), factor = between(random, 0.1, 9);
    const Eigen::Vector3d about(1, 2, 3), by(4, -5, 6);
    Affine map = Affine::rotation(0, 1, Affine::Angle::degrees(z), about[0], about[1]);
    ASSERT_TRUE(map.then(Affine::rotation(1, 2, Affine::Angle::degrees(x), 0, 0)));
    ASSERT_TRUE(map.then(Affine::stretch(2, factor, 1.5)));
    ASSERT_TRUE(map.then(Affine::translation({{by[0], by[1], by[2]}})));
    const auto rad = [](double deg) { return deg * EIGEN_PI / 180; };
    const Eigen::Affine3d expected = Eigen::Translation3d(by) * Eigen::Translation3d(0, 0, 1.5) * Eigen::Scaling(1.0, 1.0, factor) *
                                     Eigen::Translation3d(0, 0, -1.5) * Eigen::AngleAxisd(rad(x), Eigen::Vector3d::UnitX()) *
                                     Eigen::Translation3d(about) * Eigen::AngleAxisd(rad(z), Eigen::Vector3d::UnitZ()) *
                                     Eigen::Translation3d(-about);
    const AxisVec p = any_point(random), q = map.apply(p);
    const Eigen::Vector3d r = expected * Eigen::Vector3d(p[0], p[1], p[2]);
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(q[i], r[i], 1e-8);
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned k = 0; k < 3; ++k) EXPECT_NEAR(map.coefficient(i, k), expected.linear()(i, k), 1e-13 * factor + 1e-13);
    for (unsigned i = 3; i < kMaxAxes; ++i) EXPECT_EQ(q[i], p[i]);
  }
}

TEST(Affine, EachMirrorTurnsTheSenseOfAPlaneRound) {
  Random random(7);
  for (int run = 0; run < 2000; ++run) {
    Affine map;
    bool odd = false;
    for (unsigned n = 0; n < 6; ++n) {
      const unsigned axis = axis_below(random, 4);
      const bool mirror = axis_below(random, 2) == 0;
      ASSERT_TRUE(map.then(mirror ? Affine::stretch(axis, -1, between(random, -9, 9))
                                  : Affine::rotation(0, 1, Affine::Angle::degrees(between(random, -400, 400)), 1, 2)));
      odd = odd != (mirror && axis < 2);
      ASSERT_EQ(map.reflects(0, 1), odd);
      ASSERT_EQ(map.reflects(1, 0), odd);
    }
    ASSERT_TRUE(map.keeps_plane(0, 1));
    EXPECT_NEAR(std::fabs(map.determinant(0, 1)), 1, 1e-13);
  }
}

TEST(Affine, APlaneIsKeptUnlessAnAxisLeavesIt) {
  const auto turned = [](unsigned h, unsigned v) { return Affine::rotation(h, v, Affine::Angle::degrees(30), 0, 0); };
  EXPECT_TRUE(turned(0, 1).keeps_plane(0, 1));
  EXPECT_TRUE(turned(2, 3).keeps_plane(0, 1));
  EXPECT_FALSE(turned(1, 2).keeps_plane(0, 1));
  EXPECT_FALSE(turned(2, 0).keeps_plane(0, 1));
  Affine both = turned(0, 1);
  ASSERT_TRUE(both.then(turned(2, 3)));
  EXPECT_TRUE(both.keeps_plane(0, 1));
  EXPECT_TRUE(both.keeps_plane(3, 2));
  EXPECT_FALSE(both.keeps_plane(0, 2));
}

TEST(Affine, FourAxesDependOnEachOtherAtMost) {
  Affine map = Affine::rotation(0, 1, Affine::Angle::degrees(30), 0, 0);
  ASSERT_TRUE(map.then(Affine::rotation(6, 7, Affine::Angle::degrees(40), 0, 0)));
  EXPECT_EQ(map.coupled(), 0xC3u);
  const Affine before = map;
  EXPECT_FALSE(map.then(Affine::rotation(6, 2, Affine::Angle::degrees(50), 0, 0)));
  EXPECT_TRUE(map == before);
}

}  // namespace
}  // namespace nc::test
