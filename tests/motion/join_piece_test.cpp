// SPDX-License-Identifier: Apache-2.0
// Where curves meet with a step of the curvature and are too short for a transition, the path rests between them: at speed such a step would be an
// unlimited jerk.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "at_once.hpp"
#include "builder_rig.hpp"
#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

using optimal::Piece;

/// The pieces of a line, of a tangential arc of this radius and length after it, and of another line.
std::vector<Piece> pieces(double radius, double length, std::vector<Curve>* curves) {
  Program p(standard_config(3));
  p.line(AxisVec{{10, 0, 0}}, 50);
  const double sweep = length / radius;
  p.arc(0, 1, radius, -std::numbers::pi / 2, sweep, 50);
  AxisVec to = p.at();
  to[0] += 10 * std::cos(sweep);
  to[1] += 10 * std::sin(sweep);
  p.line(to, 50);
  p.end();
  BuilderRig rig(64);
  std::copy(p.records.begin(), p.records.end(), rig.ring.begin());
  for (unsigned n = 0; n < 10; ++n) at_once([&](optimal::Work& work) { return rig.builder.take(work, static_cast<uint32_t>(p.records.size())); });
  at_once([&](optimal::Work& work) { return rig.builder.finish(work); });
  std::vector<Piece> all;
  for (uint32_t k = 0; k != rig.builder.head(); ++k) all.push_back(rig.store.piece_at(k));
  curves->clear();
  curves->reserve(all.size());
  for (Piece& piece : all) {
    if (piece.curve == nullptr) continue;
    curves->push_back(*piece.curve);
    piece.curve = &curves->back();
  }
  return all;
}

TEST(JoinPiece, RestsWhereTheCurvatureWouldStep) {
  unsigned rests = 0, passed = 0;
  for (const double radius : {1e4, 3e4, 1e5, 3e5, 1e6}) {
    for (const double sweep : {1e-9, 1.5e-9, 1.9e-9, 1e-8, 1e-6}) {
      SCOPED_TRACE(std::to_string(radius) + " mm, " + std::to_string(sweep * 1e9) + "e-9");
      std::vector<Curve> curves;
      const std::vector<Piece> all = pieces(radius, sweep * radius, &curves);
      ASSERT_GE(all.size(), 2u);
      EXPECT_TRUE(all.back().rest_behind);
      for (size_t k = 1; k < all.size(); ++k) {
        const CurvePoint a = evaluate(all[k - 1], all[k - 1].length, 3), b = evaluate(all[k], 0, 3);
        const double shorter = std::min(all[k - 1].length, all[k].length);
        double corner = 0, step = 0;
        for (unsigned i = 0; i < 3; ++i) {
          EXPECT_NEAR(a.position[i], b.position[i], 1e-7);
          corner = std::max(corner, std::fabs(a.d1[i] - b.d1[i]));
          step = std::max(step, std::fabs(a.d2[i] - b.d2[i]));
        }
        if (all[k - 1].rest_behind) {
          ++rests;
          continue;
        }
        ++passed;
        EXPECT_LE(corner, 1e-6) << "behind piece " << k - 1;
        EXPECT_LE(step, 2e-6 + 2e-13 / (shorter * shorter)) << "behind piece " << k - 1;
      }
    }
  }
  EXPECT_GT(rests, 0u);   // there were such places
  EXPECT_GT(passed, 0u);  // and the others are passed at speed
}

}  // namespace
}  // namespace nc::test
