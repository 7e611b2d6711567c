// SPDX-License-Identifier: Apache-2.0
// The law in phases: there is always one from rest, it keeps the limits of every axis, and the law of cells is never slower.
#include "motion/optimal/phase_law.hpp"
#include "at_once.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "motion/law_paths.hpp"
#include "motion/optimal/windows.hpp"

namespace nc::test {
namespace {

using optimal::LineState;
using optimal::Limits;
using optimal::MeshRequest;
using optimal::PhaseLaw;
using optimal::Piece;
using optimal::Windows;

double seven_phases(double length, double v, double a, double j) {
  const auto ramp = [&](double speed) { return speed >= a * a / j ? speed / a + a / j : 2 * std::sqrt(speed / j); };
  double low = 0, high = v;
  if (v * ramp(v) <= length) low = v;
  for (int n = 0; n < 100 && low < v; ++n) {
    const double middle = 0.5 * (low + high);
    (middle * ramp(middle) > length ? high : low) = middle;
  }
  return 2 * ramp(low) + (length - low * ramp(low)) / low;
}

MeshRequest request_for(const std::vector<Piece>& pieces) {
  MeshRequest r;
  r.piece = pieces.data();
  r.count = static_cast<unsigned>(pieces.size());
  return r;
}

bool find(PhaseLaw* law, const MeshRequest& request, const Limits& limits) {
  return at_once([&](optimal::Work& work) { return law->find(work, request, limits); });
}

/// Largest share of a limit, at many places of each phase.
double worst_share(const PhaseLaw& law, const std::vector<Piece>& pieces, const Limits& limits, unsigned piece = 0, double x = 0) {
  double worst = 0, begun = -x;
  LineState from = law.start();
  CurvePoint q;
  for (unsigned k = 0; k < law.count(); ++k) {
    for (unsigned n = 0; n < 200; ++n) {  // not at its ends, where it may lie on two pieces
      const LineState s = from.behind(law.phase(k).jerk, law.phase(k).seconds * (n + 1e-4) / (199 + 2e-4));
      while (piece + 1 < pieces.size() && s.s > begun + pieces[piece].length) begun += pieces[piece++].length;
      derivatives(pieces[piece], std::clamp(s.s - begun, 0.0, pieces[piece].length), 3, &q);
      worst = std::max(worst, s.v / pieces[piece].feed);
      for (unsigned i = 0; i < 3; ++i) {
        const double a = q.d1[i] * s.a + q.d2[i] * s.v * s.v;
        const double j = q.d1[i] * law.phase(k).jerk + 3 * q.d2[i] * s.v * s.a + q.d3[i] * s.v * s.v * s.v;
        worst = std::max({worst, std::fabs(a) / limits.acceleration[i], std::fabs(j) / limits.jerk[i]});
      }
    }
    from = from.behind(law.phase(k).jerk, law.phase(k).seconds);
  }
  EXPECT_NEAR(from.s, law.distance(), 1e-9);
  EXPECT_NEAR(from.v, 0, 1e-9);
  return worst;
}

std::vector<Vertex> random_polyline(std::mt19937_64& rng) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
  const auto log_uniform = [&](double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); };
  std::vector<Vertex> line{{0, 0, 0}};
  double heading = uniform(-3, 3), feed = log_uniform(0.1, 200);
  const bool one_feed = rng() % 2 == 0;
  for (unsigned n = 1 + static_cast<unsigned>(rng() % 12); n > 0; --n) {
    heading += rng() % 2 == 0 ? uniform(-0.3, 0.3) : uniform(-3.1, 3.1);
    if (!one_feed) feed = log_uniform(0.1, 200);
    const double length = log_uniform(0.05, 30);
    line.push_back({line.back().x + length * std::cos(heading), line.back().y + length * std::sin(heading), feed});
  }
  return line;
}

TEST(PhaseLaw, OneLineTakesTheSevenPhases) {
  const auto law = std::make_unique<PhaseLaw>();
  for (const double length : {1e-6, 0.002, 0.1, 7.0, 400.0})
    for (const double feed : {0.02, 5.0, 250.0}) {
      const std::vector<Piece> pieces = smoothed({{0, 0, 0}, {length, 0, feed}});
      const Limits limits = limits_of(2000, 50000);
      ASSERT_TRUE(find(law.get(), request_for(pieces), limits)) << length << " " << feed;
      const double least = seven_phases(length, feed, 2000, 50000);
      EXPECT_LE(law->seconds(), 1.005 * least) << length << " " << feed;
      EXPECT_GE(law->seconds(), 0.9999 * least) << length << " " << feed;
    }
}

TEST(PhaseLaw, FromRestThereAlwaysIsOneAndItKeepsTheLimits) {
  const auto law = std::make_unique<PhaseLaw>();
  for (uint64_t seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 rng(seed);
    const std::vector<Piece> pieces = smoothed(random_polyline(rng));
    if (pieces.empty()) continue;
    const Limits limits = limits_of(std::pow(10, 1.7 + 2.6 * (seed % 7) / 6), std::pow(10, 3 + 6.0 * (seed % 11) / 10));
    ASSERT_TRUE(find(law.get(), request_for(pieces), limits)) << "seed " << seed;
    EXPECT_TRUE(law->whole());
    EXPECT_LE(worst_share(*law, pieces, limits), 1.0005) << "seed " << seed;
  }
}

/// A law may begin at nearly every place of another one where that has constant speed, and keeps the feed of the following path.
TEST(PhaseLaw, FromPlacesAtConstantSpeedItKeepsTheLimits) {
  const auto law = std::make_unique<PhaseLaw>(), next = std::make_unique<PhaseLaw>();
  unsigned asked = 0, found = 0;
  for (uint64_t seed = 1; seed <= 25; ++seed) {
    std::mt19937_64 rng(seed);
    const std::vector<Piece> pieces = smoothed(random_polyline(rng));
    const Limits limits = limits_of(2000, 50000);
    if (pieces.empty() || !find(law.get(), request_for(pieces), limits)) continue;
    LineState at = law->start();
    for (unsigned k = 0; k < law->count(); ++k) {
      if (at.v > 1e-6 && std::fabs(at.a) < 1e-6 && at.s < 0.999 * law->distance()) {
        MeshRequest r = request_for(pieces);
        double begun = 0;
        while (begun + pieces[r.from.piece].length <= at.s) begun += pieces[r.from.piece++].length;
        r.from.x = at.s - begun;
        r.from_rest = false;
        r.b0 = at.v * at.v;
        ++asked;
        if (find(next.get(), r, limits)) {
          ++found;
          EXPECT_LE(worst_share(*next, pieces, limits, r.from.piece, r.from.x), 1.0005) << "seed " << seed << " phase " << k;
        }
      }
      at = at.behind(law->phase(k).jerk, law->phase(k).seconds);
    }
  }
  EXPECT_GT(found, 0.95 * asked) << found << " of " << asked;
}

/// For any path. A former fault: 3,000 mm/min beside 30 mm/min made the law creep for hours.
TEST(PhaseLaw, TheLawOfCellsIsNeverSlower) {
  const auto law = std::make_unique<PhaseLaw>();
  const auto windows = std::make_unique<Windows>();
  unsigned failed = 0;
  for (uint64_t seed = 1; seed <= 150; ++seed) {
    std::mt19937_64 rng(seed);
    const std::vector<Vertex> line = seed == 1 ? std::vector<Vertex>{{0, 0, 0}, {20, 0, 50}, {20, 4, 0.5}} : random_polyline(rng);
    const std::vector<Piece> pieces = smoothed(line);
    const Limits limits = limits_of(2000, 50000);
    if (pieces.empty()) continue;
    windows->start(pieces.data(), static_cast<unsigned>(pieces.size()), limits);
    if (!at_once([&](optimal::Work& work) { return windows->next(work); })) {
      ++failed;
      continue;
    }
    if (!windows->whole()) continue;
    ASSERT_TRUE(find(law.get(), request_for(pieces), limits));
    EXPECT_LE(windows->law().seconds, 1.021 * law->seconds()) << "seed " << seed;
  }
  EXPECT_LE(failed, 1u);
}

}  // namespace
}  // namespace nc::test
