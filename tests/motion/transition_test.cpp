// SPDX-License-Identifier: Apache-2.0
// Where arcs meet lines and other arcs: the path stays within the tolerance of the programmed one, its direction and curvature have no steps, and
// moves that need an exact end have it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "at_once.hpp"
#include "motion/optimal/path_builder.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::Limits;
using optimal::PathBuilder;
using optimal::Piece;

constexpr unsigned kAxes = 4;
constexpr double kTolerance = 0.01;

/// Records, and the pieces that are made from them.
class Path {
 public:
  Path() : records(kRecords) {
    Limits limits;
    limits.axis_count = kAxes;
    Arena measure;
    PathBuilder().create(limits, kTolerance, 0.005, records.data(), &store, measure);
    memory.resize(measure.used() + 64);
    Arena arena(memory.data(), memory.size());
    passed.resize(kRecords);
    builder = std::make_unique<PathBuilder>();
    builder->create(limits, kTolerance, 0.005, records.data(), &store, arena);
    store.passed = passed.data();
    store.record_mask = kRecords - 1;
    builder->restart(0, 0, at, 0, 0);
  }
  Segment& add(const Curve& curve, double feed) {
    Record& r = records[count++];
    r.kind = ItemKind::move;
    r.segment = Segment{};
    r.segment.curve = curve;
    r.segment.feed_mm_s = feed;
    at = curve.end;
    return r.segment;
  }
  Segment& line(double length, double heading, double rise = 0, double feed = 100) {
    AxisVec end = at;
    end[0] += length * std::cos(heading);
    end[1] += length * std::sin(heading);
    end[2] += rise;
    return add(make_line(at, end, kAxes, 1u << 3), feed);
  }
  Segment& arc(double radius, double heading, double sweep, double rise = 0, double turned = 0, double spiral = 0, double feed = 100) {
    Circle k;
    k.angle_start = heading + (sweep > 0 ? -1 : 1) * std::numbers::pi / 2;
    k.sweep = sweep;
    k.radius_start = radius;
    k.radius_end = radius + spiral;
    k.center[0] = at[0] - radius * std::cos(k.angle_start);
    k.center[1] = at[1] - radius * std::sin(k.angle_start);
    AxisVec end = at;
    end[0] = k.center[0] + k.radius_end * std::cos(k.angle_start + sweep);
    end[1] = k.center[1] + k.radius_end * std::sin(k.angle_start + sweep);
    end[2] += rise;
    end[3] += turned;
    return add(make_arc(at, end, 0, 1, k, kAxes, 1u << 3), feed);
  }
  void gate() { records[count++].kind = ItemKind::gate; }
  void build() {
    gate();
    at_once([&](optimal::Work& work) { return builder->take(work, count); });
    for (uint32_t k = 0; k < builder->head(); ++k) pieces.push_back(store.piece_at(k));
  }
  unsigned rests() const {
    unsigned n = 0;
    for (const Piece& p : pieces) n += p.rest_behind ? 1u : 0u;
    return n;
  }
  /// The programmed place at u, the length along all records.
  AxisVec programmed(double u) const {
    uint32_t k = 0;
    for (; k + 1 < count && (records[k].kind != ItemKind::move || passed[k] < u); ++k) {
    }
    while (records[k].kind != ItemKind::move) --k;
    const Curve& c = records[k].segment.curve;
    return curve_position(c, c.length - (passed[k] - u), kAxes);
  }
  double distance(double u, const AxisVec& q) const {
    const AxisVec p = programmed(u);
    double sum = 0;
    for (unsigned i = 0; i < kAxes; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
    return std::sqrt(sum);
  }
  double deviation() const {
    double worst = 0, u = 0;
    for (const Piece& p : pieces) {
      for (int n = 0; n <= 50; ++n) worst = std::max(worst, distance(u + p.length * n / 50, evaluate(p, p.length * n / 50, kAxes).position));
      u += p.length;
    }
    return worst;
  }
  /// The largest step between pieces that are passed at speed: of position, of direction, or of curvature divided by the largest one beside it.
  double step(unsigned derivative) const {
    double worst = 0;
    for (size_t k = 0; k + 1 < pieces.size(); ++k) {
      if (pieces[k].rest_behind && derivative > 0) continue;
      const CurvePoint a = evaluate(pieces[k], pieces[k].length, kAxes), b = evaluate(pieces[k + 1], 0, kAxes);
      for (unsigned i = 0; i < kAxes; ++i) {
        const double off[] = {std::fabs(a.position[i] - b.position[i]), std::fabs(a.d1[i] - b.d1[i]),
                              std::fabs(a.d2[i] - b.d2[i]) / (1 + std::fabs(a.d2[i]))};
        worst = std::max(worst, off[derivative]);
      }
    }
    return worst;
  }
  unsigned transitions() const {
    unsigned n = 0;
    for (size_t k = 0; k < pieces.size(); ++k) n += pieces[k].quintic && !(k > 0 && pieces[k - 1].quintic) ? 1u : 0u;
    return n;
  }

  static constexpr unsigned kRecords = 256;
  std::vector<Record> records;
  std::vector<double> passed;
  std::vector<Piece> pieces;
  AxisVec at;
  uint32_t count = 0;

 private:
  optimal::PlanStore store;
  std::vector<unsigned char> memory;
  std::unique_ptr<PathBuilder> builder;
};

void expect_smooth(const Path& path, const char* what, uint64_t seed = 0) {
  EXPECT_LE(path.deviation(), kTolerance) << what << " " << seed;
  EXPECT_LE(path.step(0), 1e-9) << what << " " << seed;
  EXPECT_LE(path.step(1), 1e-7) << what << " " << seed;
  EXPECT_LE(path.step(2), 1e-4) << what << " " << seed;
}

TEST(Transition, ALineIntoAnArcAndOutAgainRestsOnlyAtTheEnd) {
  Path path;
  path.line(20, 0);
  path.arc(5, 0, std::numbers::pi);
  path.line(20, std::numbers::pi);
  path.build();
  EXPECT_EQ(path.rests(), 1u);
  EXPECT_EQ(path.transitions(), 2u);
  expect_smooth(path, "tangent");
  EXPECT_GE(path.deviation(), 0.8 * kTolerance);  // as long as the tolerance allows
  EXPECT_NEAR(path.distance(path.passed[2], evaluate(path.pieces.back(), path.pieces.back().length, kAxes).position), 0, 1e-12);
}

TEST(Transition, TheBoundOfTheDistanceIsThatOfTheFormula) {
  // A step of curvature 1/r over a reach h on either side: 0.0108 h^2 / r.
  Path path;
  path.line(5, 0);
  path.arc(50, 0, 1);
  path.build();
  ASSERT_EQ(path.transitions(), 1u);
  for (const Piece& p : path.pieces) {
    if (!p.quintic) continue;
    const double reach = 0.5 * p.length;
    EXPECT_NEAR(path.deviation(), 0.0108 / 50 * reach * reach, 0.02 * path.deviation());
  }
}

TEST(Transition, ACornerOfALineAndAnArcIsCutByItsTolerance) {
  Path path;
  path.line(20, 0);
  path.arc(5, 1.2, 2);
  path.line(20, -1);
  path.build();
  EXPECT_EQ(path.rests(), 1u);
  expect_smooth(path, "corner");
  EXPECT_GE(path.deviation(), 0.8 * kTolerance);
}

TEST(Transition, PartsOfOneArcGoOnInEachOther) {
  Path path;
  path.arc(5, 0.3, 1);
  path.arc(5, 1.3, 1.5, 0, 0, 0);
  path.build();
  EXPECT_EQ(path.rests(), 1u);
  EXPECT_LE(path.deviation(), 1e-6);
  expect_smooth(path, "one arc");
}

TEST(Transition, AnExactStopIsHit) {
  Path path;
  path.line(20, 0).exact_stop = true;
  path.arc(5, 0, std::numbers::pi).exact_stop = true;
  path.line(20, std::numbers::pi);
  path.gate();
  path.arc(5, std::numbers::pi, 2);
  path.build();
  EXPECT_EQ(path.rests(), 4u);
  EXPECT_EQ(path.transitions(), 0u);
  EXPECT_LE(path.deviation(), 1e-9);
}

/// Series of lines of all lengths, arcs, helices, spirals, tangential or not, some with a stop.
Path random_path(std::mt19937_64& rng) {
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); };
  const auto log_uniform = [&](double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); };
  Path path;
  double heading = uniform(-3, 3);
  for (int n = 0; n < 12; ++n) {
    if (uniform(0, 1) < 0.3) heading += uniform(-1, 1) * log_uniform(1e-5, 3);
    const double feed = log_uniform(5, 250);
    if (uniform(0, 1) < 0.5) {
      const int lines = uniform(0, 1) < 0.3 ? static_cast<int>(uniform(2, 14)) : 1;
      const double length = log_uniform(0.003, 60);
      for (int k = 0; k < lines; ++k) {
        path.line(length, heading, uniform(0, 1) < 0.2 ? uniform(-0.3, 0.3) * length : 0, feed).exact_stop = uniform(0, 1) < 0.05;
        if (k + 1 < lines) heading += uniform(-0.2, 0.2);
      }
    } else {
      const double radius = log_uniform(0.02, 300), sweep = uniform(0.02, 6.5) * (uniform(0, 1) < 0.5 ? -1 : 1);
      path.arc(radius, heading, sweep, uniform(0, 1) < 0.3 ? uniform(-1, 1) * radius : 0, uniform(0, 1) < 0.2 ? uniform(-90, 90) : 0,
               uniform(0, 1) < 0.2 ? uniform(-0.1, 0.1) * std::min(radius, 0.1) : 0, feed)
          .exact_stop = uniform(0, 1) < 0.1;
      heading += sweep;
    }
  }
  path.build();
  return path;
}

TEST(Transition, RandomPathsKeepToleranceDirectionAndCurvature) {
  const uint64_t count = seeds(300, 60);
  unsigned arcs_met = 0;
  for (uint64_t seed = 1; seed <= count; ++seed) {
    std::mt19937_64 rng(seed);
    const Path path = random_path(rng);
    expect_smooth(path, "seed", seed);
    arcs_met += path.transitions();
    double u = 0;
    for (const Piece& p : path.pieces) {
      u += p.length;
      if (!p.rest_behind) continue;
      EXPECT_LE(path.distance(u, evaluate(p, p.length, kAxes).position), kTolerance) << seed;
    }
    for (uint32_t k = 0; k < path.count; ++k) {
      if (path.records[k].kind != ItemKind::move || !path.records[k].segment.exact_stop) continue;
      double at = 0;
      const Piece* ends = nullptr;
      for (const Piece& p : path.pieces) {
        at += p.length;
        if (std::fabs(at - path.passed[k]) < 1e-9) ends = &p;
      }
      ASSERT_NE(ends, nullptr) << "seed " << seed << " record " << k;
      EXPECT_TRUE(ends->rest_behind) << "seed " << seed << " record " << k;
      EXPECT_LE(path.distance(path.passed[k], evaluate(*ends, ends->length, kAxes).position), 1e-9) << "seed " << seed;
    }
  }
  EXPECT_GT(arcs_met, count);
}

}  // namespace
}  // namespace nc::test
