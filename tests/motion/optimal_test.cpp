// SPDX-License-Identifier: Apache-2.0
// The room `optimal`: smoothing stays within its tolerance; laws keep the limits of every axis, measured on positions
// every 1 ms and not on the solver's own numbers, and take little more time than the known optimum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "at_once.hpp"
#include "motion/optimal/profile.hpp"
#include "motion/optimal/smooth.hpp"
#include "motion/optimal/windows.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::CellState;
using optimal::Limits;
using optimal::Piece;
using optimal::Windows;

constexpr double kCycle = 0.001;

Limits standard_limits() {
  Limits l;
  for (unsigned i = 0; i < 3; ++i) {
    l.velocity[i] = l.rapid[i] = 250;
    l.acceleration[i] = 2000;
    l.jerk[i] = 50000;
  }
  return l;
}

/// A polyline with its lengths and feeds, smoothed.
struct Path {
  std::vector<AxisVec> vertex;
  std::vector<double> length, feed;
  std::vector<Piece> pieces;

  void to(double x, double y, double z = 0, double f = 100) {
    AxisVec p;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    if (!vertex.empty()) {
      const AxisVec& q = vertex.back();
      length.push_back(
          std::sqrt((x - q[0]) * (x - q[0]) + (y - q[1]) * (y - q[1]) + (z - q[2]) * (z - q[2])));
      feed.push_back(f);
    }
    vertex.push_back(p);
  }
  bool smooth(double tolerance, double spacing) {
    const unsigned vertices = static_cast<unsigned>(vertex.size()), knots = 64 * vertices + 64;
    std::vector<double> u(vertices), knot(knots);
    std::vector<AxisVec> control(knots + 3);
    std::vector<unsigned> corner(knots);
    std::vector<optimal::SmoothCell> cell(knots);
    pieces.resize(knots);
    optimal::SmoothRequest request;
    request.line = {vertex.data(), length.data(), feed.data(), vertices};
    request.tolerance = tolerance;
    request.spacing = spacing;
    const optimal::SmoothRoom room{u.data(),      vertices,     knot.data(), control.data(),
                                   corner.data(), cell.data(), knots};
    pieces.resize(at_once([&](optimal::Work& work) { return optimal::smooth(work, request, room, pieces.data(), knots); }));
    return !pieces.empty();
  }
  double distance_to_edge(const AxisVec& p, size_t e) const {
    double along = 0, off = 0;
    for (unsigned i = 0; i < 3; ++i) along += (p[i] - vertex[e][i]) * (vertex[e + 1][i] - vertex[e][i]);
    along = std::clamp(along / (length[e] * length[e]), 0.0, 1.0);
    for (unsigned i = 0; i < 3; ++i)
      off += std::pow(p[i] - vertex[e][i] - along * (vertex[e + 1][i] - vertex[e][i]), 2);
    return std::sqrt(off);
  }
  /// Largest distance of the smoothed path from the polyline.
  double deviation() const {
    double worst = 0, at = 0;
    size_t near = 0;
    std::vector<double> u{0};
    for (const double l : length) u.push_back(u.back() + l);
    for (const Piece& p : pieces) {
      for (int n = 0; n <= 20; ++n) {
        const double x = p.length * n / 20;
        const AxisVec q = evaluate(p, x, 3).position;
        while (near + 1 < length.size() && u[near + 1] < at + x) ++near;
        double best = HUGE_VAL;
        for (size_t e = near > 3 ? near - 3 : 0; e < std::min(length.size(), near + 4); ++e)
          best = std::min(best, distance_to_edge(q, e));
        worst = std::max(worst, best);
      }
      at += p.length;
    }
    return worst;
  }
};

/// Largest jump of position, first and second derivative between pieces.
double worst_joint(const std::vector<Piece>& pieces) {
  double worst = 0;
  for (size_t k = 0; k + 1 < pieces.size(); ++k) {
    const CurvePoint a = evaluate(pieces[k], pieces[k].length, 3), b = evaluate(pieces[k + 1], 0, 3);
    for (unsigned i = 0; i < 3; ++i) {
      worst = std::max({worst, std::fabs(a.position[i] - b.position[i]), std::fabs(a.d1[i] - b.d1[i]),
                        std::fabs(a.d2[i] - b.d2[i]) / (1 + std::fabs(a.d2[i]))});
    }
  }
  return worst;
}

/// Positions at every cycle from rest to rest.
struct Motion {
  std::vector<AxisVec> position;
  double seconds = 0;
  bool failed = false;
  double worst_velocity = 0, worst_acceleration = 0, worst_jerk = 0, worst_feed = 0;

  void measure(const Limits& l, double feed) {
    for (size_t n = 3; n < position.size(); ++n) {
      double speed2 = 0;
      for (unsigned i = 0; i < l.axis_count; ++i) {
        const double p0 = position[n][i], p1 = position[n - 1][i], p2 = position[n - 2][i],
                     p3 = position[n - 3][i];
        const double v = (p0 - p1) / kCycle;
        speed2 += v * v;
        worst_velocity = std::max(worst_velocity, std::fabs(v) / l.velocity[i]);
        worst_acceleration =
            std::max(worst_acceleration, std::fabs(p0 - 2 * p1 + p2) / (kCycle * kCycle) / l.acceleration[i]);
        worst_jerk = std::max(worst_jerk,
                              std::fabs(p0 - 3 * p1 + 3 * p2 - p3) / (kCycle * kCycle * kCycle) / l.jerk[i]);
      }
      worst_feed = std::max(worst_feed, std::sqrt(speed2) / feed);
    }
  }
};

Motion run(const std::vector<Piece>& pieces, const Limits& limits, double feed) {
  static const std::unique_ptr<Windows> windows = std::make_unique<Windows>();
  Motion m;
  windows->start(pieces.data(), static_cast<unsigned>(pieces.size()), limits);
  const AxisVec first = evaluate(pieces.front(), 0, 3).position,
                last = evaluate(pieces.back(), pieces.back().length, 3).position;
  m.position.assign(4, first);
  double due = kCycle;
  while (at_once([&](optimal::Work& work) { return windows->next(work); })) {
    double clock = 0;
    for (unsigned k = 0; k < windows->keep(); ++k) {
      const double cell = cell_seconds(windows->law(), windows->mesh(), k);
      for (; due <= clock + cell; due += kCycle) {
        const CellState at = cell_state(windows->law(), windows->mesh(), k, due - clock);
        m.position.push_back(evaluate(windows->piece_of(k), windows->place(k).x + at.x, 3).position);
      }
      clock += cell;
    }
    m.seconds += clock;
    due -= clock;
  }
  m.failed = windows->failed();
  m.position.insert(m.position.end(), 4, last);
  m.measure(limits, feed);
  return m;
}

/// The time from rest to rest with limits of jerk, acceleration and speed: the seven phases.
double seven_phases(double length, double v, double a, double j) {
  const auto ramp = [&](double speed) {
    return speed >= a * a / j ? speed / a + a / j : 2 * std::sqrt(speed / j);
  };
  if (v * ramp(v) > length) {
    double low = 0, high = v;
    for (int n = 0; n < 100; ++n)
      (0.5 * (low + high) * ramp(0.5 * (low + high)) > length ? high : low) = 0.5 * (low + high);
    v = low;
  }
  return 2 * ramp(v) + (length - v * ramp(v)) / v;
}

Piece straight(double length, double feed) {
  Piece p;
  p.length = length;
  p.feed = feed;
  p.c[1][0] = 1;
  return p;
}

/// Slow lines that are shorter than the tolerance, between long fast ones: the path that has the feed of a line is no longer than that line.
TEST(Smooth, NoLineGivesItsFeedToMorePathThanItIsLong) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 rng(seed);
    const auto between = [&](double low, double high) {
      return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(rng));
    };
    Path path;
    AxisVec at;
    const auto line = [&](double length, double feed) {
      at[rng() % 3] += (rng() % 2 != 0 ? 1 : -1) * length;
      path.to(at[0], at[1], at[2], feed);
    };
    path.to(0, 0);
    for (unsigned n = 0; n < 4; ++n) {
      line(between(1, 100), between(20, 100));
      for (unsigned k = 1 + static_cast<unsigned>(rng() % 3); k > 0; --k) line(between(0.0005, 0.02), between(0.002, 2));
    }
    line(10, 50);
    ASSERT_TRUE(path.smooth(between(0.001, 0.05), 0.5)) << "seed " << seed;
    for (size_t e = 0; e < path.length.size(); ++e) {
      if (path.feed[e] > 2) continue;
      double way = 0;
      for (const Piece& p : path.pieces) {
        constexpr int kParts = 50;
        for (int n = 0; n < kParts && p.feed == path.feed[e]; ++n) {
          const CurvePoint q = evaluate(p, p.length * (n + 0.5) / kParts, 3);
          way += std::hypot(q.d1[0], q.d1[1], q.d1[2]) * p.length / kParts;
        }
      }
      EXPECT_LE(way, 1.0001 * path.length[e]) << "seed " << seed << ", line " << e << " of " << path.length[e] << " mm";
    }
  }
}

TEST(OptimalLaw, OneLineTakesTheTimeOfTheSevenPhases) {
  for (const double length : {0.002, 0.1, 1.0, 7.0, 50.0, 400.0}) {
    for (const double feed : {5.0, 50.0, 250.0}) {
      const Limits limits = standard_limits();
      const Motion m = run({straight(length, feed)}, limits, feed);
      ASSERT_FALSE(m.failed) << length << " " << feed;
      const double optimum = seven_phases(length, feed, 2000, 50000);
      EXPECT_LE(m.seconds, (length < 0.05 ? 1.03 : 1.012) * optimum) << length << " " << feed;
      EXPECT_GE(m.seconds, optimum) << length << " " << feed;
      EXPECT_LE(m.worst_jerk, 1.001) << length << " " << feed;
      EXPECT_LE(m.worst_acceleration, 1.001) << length << " " << feed;
      EXPECT_LE(m.worst_feed, 1.001) << length << " " << feed;
    }
  }
}

TEST(OptimalLaw, AFullCircleKeepsTheLimits) {
  for (const double radius : {0.3, 2.0, 25.0}) {
    Circle k;
    k.radius_start = k.radius_end = radius;
    k.sweep = 2 * std::numbers::pi;
    AxisVec start;
    start[0] = radius;
    const Curve curve = make_arc(start, start, 0, 1, k, 3, 0);
    Piece p;
    p.length = curve.length;
    p.feed = 100;
    p.curve = &curve;
    const Motion m = run({p}, standard_limits(), 100);
    ASSERT_FALSE(m.failed) << radius;
    EXPECT_LE(m.worst_jerk, 1.001) << radius;
    EXPECT_LE(m.worst_acceleration, 1.001) << radius;
    EXPECT_LE(m.worst_feed, 1.001) << radius;
    for (const AxisVec& q : m.position)
      EXPECT_NEAR(std::hypot(q[0], q[1]), radius, 1e-9);  // an arc stays an arc
  }
}

/// One micrometre of noise on a surface in short lines is averaged, so that it takes no longer than without noise.
TEST(OptimalLaw, NoiseOfAMicrometreCostsNothing) {
  constexpr double kFeed = 8000.0 / 60;
  for (const double step : {0.02, 0.05, 0.2}) {
    const auto gone = [&](double noise, double* slowest) {
      std::mt19937_64 rng(7);
      std::normal_distribution<double> draw(0, noise);
      Path path;
      for (int n = 0; n * step < 60; ++n) path.to(n * step, 0, 0.4 * std::sin(0.3 * n * step) + (noise > 0 ? draw(rng) : 0), kFeed);
      EXPECT_TRUE(path.smooth(0.01, 0.005 * kFeed));
      EXPECT_LE(path.deviation(), 0.01);
      const Motion m = run(path.pieces, standard_limits(), kFeed);
      EXPECT_FALSE(m.failed);
      EXPECT_LE(m.worst_jerk, 1.001);
      double low = HUGE_VAL, sum = 0;
      unsigned count = 0;
      for (size_t k = 200; k + 200 < m.position.size(); ++k, ++count) {
        const double v = std::hypot(m.position[k][0] - m.position[k - 1][0], m.position[k][2] - m.position[k - 1][2]);
        low = std::min(low, v);
        sum += v;
      }
      *slowest = low * count / sum;
      return m.seconds;
    };
    double smooth_slowest, noisy_slowest;
    const double smooth = gone(0, &smooth_slowest), noisy = gone(0.001, &noisy_slowest);
    EXPECT_LE(noisy, 1.03 * smooth) << step;
    EXPECT_GE(noisy_slowest, 0.9) << step;
  }
}

/// Cells in which the feed can be kept are not solved for, since their law is known: the time is the same with and without that.
TEST(OptimalLaw, CellsThatStayAtTheFeedChangeNothing) {
  for (const double radius : {8.0, 40.0}) {
    Path path;
    for (int n = 0; n <= 250; ++n) path.to(radius * (std::cos(n * 0.4 / radius) - 1), radius * std::sin(n * 0.4 / radius));
    ASSERT_TRUE(path.smooth(0.01, 0.5));
    const Limits limits = standard_limits();
    optimal::MeshRequest request;
    request.piece = path.pieces.data();
    request.count = static_cast<unsigned>(path.pieces.size());
    const auto mesher = std::make_unique<optimal::Mesher>();
    const auto mesh = std::make_unique<optimal::Mesh>();
    const auto solver = std::make_unique<optimal::TimeLaw>();
    const auto law = std::make_unique<optimal::Law>(), whole = std::make_unique<optimal::Law>();
    at_once([&](optimal::Work& work) { return mesher->build(work, request, limits, mesh.get()); });
    ASSERT_GT(mesh->levels, mesh->cells / 2);
    at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::anew, law.get()); });
    ASSERT_TRUE(law->ok);
    std::fill(mesh->level, mesh->level + mesh->cells, false);
    mesh->levels = 0;
    at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::anew, whole.get()); });
    ASSERT_TRUE(whole->ok);
    EXPECT_NEAR(law->seconds, whole->seconds, 6e-4 * whole->seconds) << radius;
    EXPECT_LE(law->seconds, whole->seconds * (1 + 1e-4)) << radius;
  }
}

/// Where a few cells of a law are to use less of a limit, those about them are solved once more and all others stay to the last bit; the law is hardly longer than
/// the one that is solved as a whole.
TEST(OptimalLaw, CellsThatAreKeptStayAndTheLawIsAsGood) {
  const Limits limits = standard_limits();
  std::mt19937_64 rng(7);
  unsigned found = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Path path;
    const double size = std::uniform_real_distribution<double>(1, 4)(rng), high = std::uniform_real_distribution<double>(0.5, 3)(rng);
    for (int n = 1; n <= 700; ++n) path.to(0.2 * n, high * std::sin(0.2 * n / size));
    ASSERT_TRUE(path.smooth(0.01, 0.5));
    optimal::MeshRequest request;
    request.piece = path.pieces.data();
    request.count = static_cast<unsigned>(path.pieces.size());
    const auto mesher = std::make_unique<optimal::Mesher>();
    const auto mesh = std::make_unique<optimal::Mesh>();
    const auto solver = std::make_unique<optimal::TimeLaw>();
    const auto first = std::make_unique<optimal::Law>(), nearby = std::make_unique<optimal::Law>(), whole = std::make_unique<optimal::Law>();
    at_once([&](optimal::Work& work) { return mesher->build(work, request, limits, mesh.get()); });
    at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::anew, first.get()); });
    ASSERT_TRUE(first->ok) << seed;
    ASSERT_GT(mesh->cells, 200u) << seed;
    const unsigned less = std::uniform_int_distribution<unsigned>(80, mesh->cells - 80)(rng), from = less - 30, to = less + 30;
    mesh->use[less] = 0.99;
    for (unsigned k = 0; k < mesh->cells; ++k) mesh->kept[k] = k < from || k >= to;
    at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::nearby, nearby.get()); });
    found += nearby->ok ? 1u : 0u;
    for (unsigned k = 0; k <= mesh->cells && nearby->ok; ++k) {
      if (k < from || k > to) {
        EXPECT_EQ(nearby->b[k], first->b[k]) << seed << ' ' << k;
      }
    }
    std::fill(mesh->kept, mesh->kept + mesh->cells, false);
    at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::again, whole.get()); });
    ASSERT_TRUE(whole->ok) << seed;
    if (nearby->ok) {
      EXPECT_NEAR(nearby->seconds, whole->seconds, 6e-4 * whole->seconds) << seed;
    }
  }
  EXPECT_GE(found, 6u);  // where there is none, the whole is solved, from where that had begun
  std::printf("%u of 12 were found nearby\n", found);
}

/// Level cells that are too near to a rest are detected: beside them a lower speed would make the whole faster, or there is no law at all.
TEST(OptimalLaw, CellsThatCannotStayAtTheFeedAreNoLaw) {
  const Limits limits = standard_limits();
  const Piece line = straight(100, 100);
  optimal::MeshRequest request;
  request.piece = &line;
  request.count = 1;
  const auto mesher = std::make_unique<optimal::Mesher>();
  const auto mesh = std::make_unique<optimal::Mesh>();
  const auto solver = std::make_unique<optimal::TimeLaw>();
  const auto law = std::make_unique<optimal::Law>();
  at_once([&](optimal::Work& work) { return mesher->build(work, request, limits, mesh.get()); });
  unsigned k = 1;
  for (double u = 0; u < 2; ++k) u += mesh->h[k - 1];  // the ramp takes 4.5 mm
  for (; !mesh->level[k]; ++k) mesh->level[k] = true, ++mesh->levels;
  at_once([&](optimal::Work& work) { return solver->solve(work, *mesh, limits, optimal::TimeLaw::Begins::anew, law.get()); });
  EXPECT_FALSE(law->ok);
}

/// From rest to a slow piece, and from one to rest, where the acceleration is reached in a hundredth of a cell: the cells grow from rest on by themselves and
/// not by some percent each, which filled a mesh within micrometres.
TEST(OptimalLaw, CellsBesideASlowPieceGrowFromRest) {
  Limits limits = standard_limits();
  for (unsigned i = 0; i < 3; ++i) {
    limits.acceleration[i] = 137;
    limits.jerk[i] = 3.3e7;
  }
  const Piece pieces[2][2] = {{straight(0.014, 250), straight(0.0012, 0.087)}, {straight(0.0012, 0.087), straight(0.014, 250)}};
  for (const auto& path : pieces) {
    for (const double period : {0.001, 0.0025, 0.005, 0.01, 0.02}) {
      optimal::MeshRequest request;
      request.piece = path;
      request.count = 2;
      request.period = period;
      const auto mesher = std::make_unique<optimal::Mesher>();
      const auto mesh = std::make_unique<optimal::Mesh>();
      at_once([&](optimal::Work& work) { return mesher->build(work, request, limits, mesh.get()); });
      EXPECT_TRUE(mesher->whole()) << period;
      EXPECT_LE(mesh->cells, 150u) << period;
    }
  }
}

/// The next law begins where the speed has begun to rise, if that is near, else where it does not fall, else at the place that was asked for.
TEST(OptimalLaw, TheNextLawBeginsWhereTheSpeedRises) {
  const auto from = [](std::vector<int> slopes, unsigned k) {
    return optimal::better_start(k, [&](unsigned n) { return static_cast<double>(slopes[n]); });
  };
  EXPECT_EQ(from({0, 1, 1, -1, -1, 1, 1, -1, -1}, 8), 5u);
  EXPECT_EQ(from({0, 1, 1, 1, 1, 1, 1, -1, -1}, 8), 6u);
  EXPECT_EQ(from({0, 1, 0, 0, 0, 0, 0, 0, 0}, 8), 8u);
  EXPECT_EQ(from({0, -1, -1, -1, -1, -1, -1, -1, -1}, 8), 8u);
  EXPECT_EQ(from({0, 1}, 1), 1u);
}

/// The rows for an axis that moves only a little are omitted, but not if its limits are low, too.
TEST(OptimalLaw, AnAxisThatGoesAlongALittleKeepsItsLimits) {
  for (const double share : {1.0, 0.1, 0.03, 0.01, 0.001}) {
    Limits limits = standard_limits();
    limits.acceleration[2] *= share;
    limits.jerk[2] *= share;
    Path path;
    for (int n = 0; n <= 120; ++n) path.to(0.3 * n, 2 * std::sin(0.09 * n), 0.02 * std::sin(0.21 * n));
    ASSERT_TRUE(path.smooth(0.01, 0.5));
    const Motion m = run(path.pieces, limits, 100);
    ASSERT_FALSE(m.failed) << share;
    EXPECT_LE(m.worst_velocity, 1.001) << share;
    EXPECT_LE(m.worst_acceleration, 1.001) << share;
    EXPECT_LE(m.worst_jerk, 1.001) << share;
    EXPECT_LE(m.worst_feed, 1.001) << share;
  }
}

TEST(OptimalLaw, TheCheckerSeesAStepOfAMicrometre) {
  const Limits limits = standard_limits();
  Motion m = run({straight(10, 100)}, limits, 100);
  ASSERT_LE(m.worst_jerk, 1.001);
  m.position[m.position.size() / 2][0] += 1e-3;
  m.measure(limits, 100);
  EXPECT_GT(m.worst_jerk, 1.1);
}

TEST(OptimalSmooth, ASquareIsCutByItsToleranceAndStraightBetween) {
  Path path;
  path.to(0, 0);
  path.to(50, 0);
  path.to(50, 50);
  path.to(0, 50);
  ASSERT_TRUE(path.smooth(0.01, 0.5));
  EXPECT_LE(path.deviation(), 0.01);
  EXPECT_GE(path.deviation(), 0.9 * 0.01 / std::sqrt(2));  // the corner itself is cut by nearly the tolerance
  EXPECT_LE(worst_joint(path.pieces), 1e-9);
  const CurvePoint middle = evaluate(path.pieces.front(), 25, 3);
  EXPECT_NEAR(middle.position[0], 25, 1e-12);
  EXPECT_NEAR(middle.position[1], 0, 1e-12);
}

/// Where one direction stops while the other one starts, each with constant jerk, in the time t from 0 to 1: the curvature at u = t^3 - (1 - t)^3.
double curvature_of_corner(double u) {
  double low = 0, high = 1;
  for (unsigned n = 0; n < 60; ++n) {
    const double t = 0.5 * (low + high);
    (t * t * t - (1 - t) * (1 - t) * (1 - t) < u ? low : high) = t;
  }
  const double even = low * low + (1 - low) * (1 - low);
  return 2 * low * (1 - low) / (3 * even * even * even);
}

TEST(OptimalSmooth, ASharpCornerIsTheCurveOfConstantJerk) {
  Path path;
  path.to(0, 0);
  path.to(12, 0);
  path.to(12, 12);
  ASSERT_TRUE(path.smooth(0.01, 0.5));
  const auto bent = [](const optimal::Piece& p) { return p.c[3][1] != 0; };
  const auto first = std::find_if(path.pieces.begin(), path.pieces.end(), bent);
  ASSERT_NE(first, path.pieces.end());
  double start = 0;
  for (auto p = path.pieces.begin(); p != first; ++p) start += p->length;
  const double reach = 12 - start;
  double u = start, worst = 0;
  for (auto p = first; p != path.pieces.end() && u < 12 + 0.999 * reach; u += p++->length)
    for (unsigned n = 0; n <= 8; ++n) {
      const double x = p->length * n / 8;
      worst = std::max(worst, std::fabs(reach * evaluate(*p, x, 3).d2[1] - curvature_of_corner((u + x - 12) / reach)));
    }
  EXPECT_LE(worst, 0.005 * curvature_of_corner(0));
  EXPECT_NEAR(evaluate(*first, 0, 3).d3[1] * reach * reach, 2.0 / 9, 0.01);  // entered with no more jerk than the curve has
}

TEST(OptimalSmooth, APathMayTurnRound) {
  Path path;
  path.to(0, 0);
  path.to(10, 0);
  path.to(0, 0);
  ASSERT_TRUE(path.smooth(0.01, 0.5));
  EXPECT_LE(path.deviation(), 0.01);
  const Motion m = run(path.pieces, standard_limits(), 100);
  ASSERT_FALSE(m.failed);
  EXPECT_LE(m.worst_jerk, 1.001);
  EXPECT_LE(m.worst_acceleration, 1.001);
  EXPECT_LE(m.seconds, 2 * seven_phases(10, 100, 2000, 50000));
}

/// A polyline: dense or coarse, smooth or with corners, with even or uneven lines.
Path random_path(std::mt19937_64& rng) {
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); };
  Path path;
  const double step = std::exp(uniform(std::log(0.002), std::log(20.0))),
               wobble = uniform(0, 1) < 0.5 ? 0.05 : 2.0;
  const double feed = std::exp(uniform(std::log(5.0), std::log(250.0)));
  const bool uneven = uniform(0, 1) < 0.5;
  const int count = 3 + static_cast<int>(uniform(0, 60));
  double x = 0, y = 0, z = 0, heading = uniform(-3, 3);
  path.to(0, 0, 0, feed);
  for (int n = 0; n < count; ++n) {
    heading += uniform(-1, 1) * wobble;
    const double l = step * (uneven ? std::exp(uniform(-2, 1)) : 1);
    x += l * std::cos(heading);
    y += l * std::sin(heading);
    z += l * uniform(-0.2, 0.2) * wobble;
    path.to(x, y, z, feed);
  }
  return path;
}

uint64_t looks_seeds() {
  return seeds(80, 16);
}

TEST(OptimalProperty, RandomPolylinesKeepToleranceAndLimits) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 rng(seed);
    Path path = random_path(rng);
    const double feed = path.feed.front();
    ASSERT_TRUE(path.smooth(0.01, std::max(0.005 * feed, 0.02))) << "seed " << seed;
    EXPECT_LE(path.deviation(), 0.01 + 1e-9) << "seed " << seed;
    EXPECT_LE(worst_joint(path.pieces), 1e-7) << "seed " << seed;
    const AxisVec end = evaluate(path.pieces.back(), path.pieces.back().length, 3).position;
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(end[i], path.vertex.back()[i], 1e-9) << "seed " << seed;
    const Motion m = run(path.pieces, standard_limits(), feed);
    ASSERT_FALSE(m.failed) << "seed " << seed;
    EXPECT_LE(m.worst_velocity, 1.001) << "seed " << seed;
    EXPECT_LE(m.worst_acceleration, 1.001) << "seed " << seed;
    EXPECT_LE(m.worst_jerk, 1.001) << "seed " << seed;
    EXPECT_LE(m.worst_feed, 1.001) << "seed " << seed;
  }
}

/// If the jerk limit is high compared with the acceleration, the acceleration of an axis has its peak between two of the places at which the law is
/// checked. A former fault: 1.0012 of the limit in a test of the operator, 1.0023 at the peak.
TEST(OptimalProperty, NoPeakBetweenTheLooksIsAboveALimit) {
  const auto windows = std::make_unique<Windows>();
  double worst_acceleration = 0, worst_jerk = 0;
  for (uint64_t seed = 1; seed <= looks_seeds(); ++seed) {
    std::mt19937_64 rng(seed);
    const auto between = [&](double low, double high) { return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(rng)); };
    Limits limits = standard_limits();
    const double acceleration = between(200, 15000), jerk = acceleration * between(15, 3000);
    for (unsigned i = 0; i < 3; ++i) limits.acceleration[i] = acceleration, limits.jerk[i] = jerk;
    Path path = random_path(rng);
    ASSERT_TRUE(path.smooth(0.01, std::max(0.005 * path.feed.front(), 0.02))) << "seed " << seed;
    windows->start(path.pieces.data(), static_cast<unsigned>(path.pieces.size()), limits);
    while (at_once([&](optimal::Work& work) { return windows->next(work); })) {
      for (unsigned k = 0; k < windows->keep(); ++k) {
        const double whole = cell_seconds(windows->law(), windows->mesh(), k);
        constexpr int kPlaces = 240;
        AxisVec before;
        for (int n = 0; n <= kPlaces; ++n) {
          const CellState at = cell_state(windows->law(), windows->mesh(), k, whole * n / kPlaces);
          const Piece& p = windows->piece_of(k);
          const CurvePoint q = evaluate(p, std::clamp(windows->place(k).x + at.x, 0.0, p.length), 3);
          for (unsigned i = 0; i < 3; ++i) {
            const double a = q.d1[i] * at.a + q.d2[i] * at.v * at.v;
            worst_acceleration = std::max(worst_acceleration, std::fabs(a) / acceleration);
            if (n > 0) worst_jerk = std::max(worst_jerk, std::fabs(a - before[i]) * kPlaces / whole / jerk);
            before[i] = a;
          }
        }
      }
    }
    EXPECT_FALSE(windows->failed()) << "seed " << seed;
    EXPECT_LE(worst_acceleration, 1.0004) << "seed " << seed;
    EXPECT_LE(worst_jerk, 1.0004) << "seed " << seed;
  }
  std::printf("%.5f of the acceleration, %.5f of the jerk\n", worst_acceleration, worst_jerk);
}

}  // namespace
}  // namespace nc::test
