// SPDX-License-Identifier: Apache-2.0
// From every place of the law that is being followed a law is known; the times of other laws are compared with it.
#include "motion/optimal/known_law.hpp"
#include "at_once.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "motion/law_paths.hpp"
#include "motion/optimal/profile.hpp"
#include "motion/optimal/windows.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::Followed;
using optimal::KnownLaw;
using optimal::Limits;
using optimal::MeshRequest;
using optimal::PhaseLaw;
using optimal::Piece;
using optimal::Windows;

/// The pieces of a random polyline, rounded within 10 um.
std::vector<Piece> random_path(std::mt19937_64& rng) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
  const auto log_uniform = [&](double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); };
  const unsigned count = 12 + static_cast<unsigned>(rng() % 30);
  const double feed = log_uniform(10, 200), step = log_uniform(0.02, 5);
  std::vector<Vertex> line{{0, 0, 0}};
  double heading = 0;
  for (unsigned k = 1; k < count; ++k) {
    heading += uniform(-1.5, 1.5);
    const double length = step * log_uniform(0.3, 3);
    line.push_back({line.back().x + length * std::cos(heading), line.back().y + length * std::sin(heading), feed});
  }
  return smoothed(line);
}

/// The solver finds laws to the middle of a path; then more of the path comes, and each place of these laws is a possible start.
TEST(KnownLaw, IsThereFromEveryPlaceOfWhatIsFollowed) {
  const auto windows = std::make_unique<Windows>();
  const auto phases = std::make_unique<PhaseLaw>();
  KnownLaw known;
  Followed followed;
  unsigned starts = 0, left = 0, rested = 0;
  for (uint64_t seed = 1; seed <= seeds(25, 8); ++seed) {
    std::mt19937_64 rng(seed);
    const std::vector<Piece> pieces = random_path(rng);
    const Limits limits = limits_of(2000, 50000);
    double whole = 0;
    for (const Piece& p : pieces) whole += p.length;
    MeshRequest request;
    request.piece = pieces.data();
    request.count = static_cast<unsigned>(pieces.size());
    request.reach = 0.5 * whole;
    const Windows::Goal goal;
    if (pieces.empty() || !at_once([&](optimal::Work& work) { return windows->law_to(work, request, limits, goal); })) continue;
    const auto& law = windows->law();
    const auto& mesh = windows->mesh();
    for (unsigned from = 1; from + 1 < law.cells; ++from) {
      followed.count = 0;
      double s = 0, seconds = 0;
      for (unsigned k = from; k < law.cells; ++k) {
        if (followed.count < Followed::kMost) followed.at[followed.count++] = {s, seconds, std::sqrt(law.b[k]), 0.5 * law.slope[k]};
        s += mesh.h[k];
        seconds += optimal::cell_seconds(law, mesh, k);
      }
      followed.end = {s, seconds, 0, 0};
      MeshRequest next = request;
      next.reach = HUGE_VAL;
      next.from = windows->place(from);
      next.from_rest = false;
      next.b0 = law.b[from];
      next.slope0 = law.slope[from];
      next.followed = &followed;
      ++starts;
      ASSERT_TRUE(at_once([&](optimal::Work& work) { return known.find(work, next, limits, phases.get()); })) << "seed " << seed << " cell " << from;
      EXPECT_TRUE(known.whole());
      EXPECT_GT(known.seconds(), 0);
      if (known.rests()) {
        ++rested;
        EXPECT_EQ(known.leaves_at(), followed.count);
        EXPECT_NEAR(known.squared_speed(followed.end.s), 0, 1e-3);
        EXPECT_GT(known.seconds(), followed.end.seconds);
        next.reach = s;  // and where the path ends there, too, it is what is followed
        ASSERT_TRUE(at_once([&](optimal::Work& work) { return known.find(work, next, limits, phases.get()); })) << "seed " << seed << " cell " << from;
        EXPECT_LE(known.seconds(), followed.end.seconds * 1.5);
      } else {
        left += known.leaves_at() > 0 ? 1u : 0u;
      }
    }
  }
  EXPECT_GT(starts, seeds(500, 100));
  EXPECT_GT(left, 0u);    // some laws leave it before its end
  EXPECT_GT(rested, 0u);  // and some only at its rest
}

}  // namespace
}  // namespace nc::test
