// SPDX-License-Identifier: Apache-2.0
// The end of a path is given out in slices. Where a hold, a reset or a new block breaks that off, the path is as it was before, and the same pieces
// come when it is ended again: none of them twice.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "at_once.hpp"
#include "builder_rig.hpp"
#include "interpolate/line_program.hpp"

namespace nc::test {
namespace {

using optimal::Piece;

constexpr uint32_t kCapacity = 256;
constexpr unsigned kMostPauses = 400;

/// A builder that has taken all lines of a wave, and waits for what comes behind them.
class Wave : private BuilderRig {
 public:
  explicit Wave(double tolerance) : BuilderRig(kCapacity, tolerance) {
    Program p(standard_config(3));
    for (unsigned n = 1; n <= 12; ++n) {
      AxisVec end;
      end[0] = n;
      end[1] = n % 2 == 0 ? 0.4 : 0.0;
      p.line(end, 50);
    }
    for (size_t n = 0; n < p.records.size(); ++n) ring[n] = p.records[n];
    const auto count = static_cast<uint32_t>(p.records.size());
    at_once([&](optimal::Work& work) { return builder.take(work, count); });
    begun = builder.head();
  }
  const Piece& piece(uint32_t k) const { return store.piece_at(k); }

  using BuilderRig::builder;
  uint32_t begun = 0;  ///< pieces in front of the end
};

/// Ends the path but for `pauses` pauses of the end. @return it was broken off
bool break_off(Wave& wave, unsigned pauses) {
  const auto work = std::make_unique<optimal::Work>();
  work->begin(wave.builder.finish(*work));
  for (unsigned n = 0; n < pauses && work->open(); ++n) work->go_on(1);
  if (!work->open()) return false;
  work->give_up();
  wave.builder.give_up();
  return true;
}

void end(Wave& wave) {
  EXPECT_TRUE(at_once([&](optimal::Work& work) { return wave.builder.finish(work); }));
}

void check(double tolerance) {
  const auto all = std::make_unique<Wave>(tolerance);
  end(*all);
  ASSERT_GT(all->builder.head(), all->begun + 3);
  unsigned broken = 0;
  for (unsigned pauses = 1; pauses < kMostPauses; ++pauses) {
    const auto wave = std::make_unique<Wave>(tolerance);
    ASSERT_EQ(wave->begun, all->begun);
    if (!break_off(*wave, pauses)) break;
    ++broken;
    end(*wave);
    ASSERT_EQ(wave->builder.head(), all->builder.head()) << pauses << " pauses";
    EXPECT_EQ(wave->builder.end_u(), all->builder.end_u()) << pauses << " pauses";
    for (uint32_t k = 0; k != all->builder.head(); ++k) {
      EXPECT_EQ(wave->piece(k).length, all->piece(k).length) << pauses << " pauses, piece " << k;
      EXPECT_EQ(wave->piece(k).rest_behind, all->piece(k).rest_behind) << pauses << " pauses, piece " << k;
      EXPECT_EQ(wave->builder.start_of(k), all->builder.start_of(k)) << pauses << " pauses, piece " << k;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(broken, 5u);
  EXPECT_LT(broken, kMostPauses - 1);
}

TEST(PathGivenUp, TheEndOfASmoothedLineComesOnceHoweverOftenItIsBrokenOff) {
  check(0.01);
}

TEST(PathGivenUp, TheEndOfLinesWithoutAToleranceComesOnce) {
  check(0);
}

}  // namespace
}  // namespace nc::test
