// SPDX-License-Identifier: Apache-2.0
// Lines that nobody waits for become path together with many that follow, because what is not settled is smoothed once more each time; as soon as the path is
// wanted all of them do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "at_once.hpp"
#include "builder_rig.hpp"
#include "interpolate/line_program.hpp"

namespace nc::test {
namespace {

constexpr uint32_t kRing = 4096, kLines = 2000, kAtATime = 20;

struct Grown {
  unsigned times = 0;  ///< the path became longer
  double most_waiting = 0, end = 0;  ///< mm
};

/// A wave in lines of 0.1 mm that come by twenties. The path is wanted each time, or only with the last of them.
Grown grow(bool wanted) {
  BuilderRig rig(kRing);
  Program p(standard_config(3));
  for (unsigned n = 1; n <= kLines; ++n) {
    AxisVec end;
    end[0] = 0.1 * n;
    end[1] = 2 * std::sin(0.05 * n);
    p.line(end, 100);
  }
  Grown out;
  for (uint32_t head = kAtATime; head <= kLines; head += kAtATime) {
    std::copy(p.records.begin() + (head - kAtATime), p.records.begin() + head, rig.ring.begin() + (head - kAtATime));
    const double before = rig.builder.end_u();
    at_once([&](optimal::Work& work) { return rig.builder.take(work, head, wanted || head == kLines); });
    out.times += rig.builder.end_u() > before ? 1u : 0u;
    if (head != kLines) out.most_waiting = std::max(out.most_waiting, rig.passed[head - 1] - rig.builder.end_u());
    out.end = rig.builder.end_u();
  }
  return out;
}

TEST(PathWaits, ForManyLinesUnlessItIsWanted) {
  const Grown eager = grow(true), lazy = grow(false);
  std::printf("%u times, %.1f mm waited at most; %u times, %.1f mm\n", eager.times, eager.most_waiting, lazy.times, lazy.most_waiting);
  EXPECT_GT(eager.times, 90u);
  EXPECT_LT(lazy.times, 35u);
  EXPECT_LT(lazy.most_waiting, 20);  // it does not wait for ever
  EXPECT_NEAR(lazy.end, eager.end, 3);
}

}  // namespace
}  // namespace nc::test
