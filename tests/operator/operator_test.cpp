// SPDX-License-Identifier: Apache-2.0
// Random sessions by seed. NC_SEEDS=100000 NC_FIRST_SEED=1 runs more of them; NC_PASSAGES, NC_CYCLES and NC_PATIENCE (Session::Size) make them
// shorter, for more programs in the same time. NC_SHOW=1 prints the program of a seed that fails, NC_LOG=1 every cycle.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "operator/session.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

/// Where the counters begin: in every fourth session they pass the end of their 31 or 32 bits at the first or a later item.
uint32_t count_from(uint64_t seed) {
  if (seed % 4 != 0) return 0;
  return (seed % 8 == 0 ? 0u : 0x80000000u) - static_cast<uint32_t>(1 + seed / 8 % 200);
}

using Count = unsigned long long;

TEST(Operator, DoesAnything) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(150, 20);
  Session::Size size;
  size.passages = static_cast<unsigned>(wish("NC_PASSAGES", size.passages));
  size.cycles = static_cast<unsigned>(wish("NC_CYCLES", size.cycles));
  size.patience = static_cast<unsigned>(wish("NC_PATIENCE", size.patience));
  uint64_t wrong = 0, wild = 0, blocks = 0;
  Programs programs;
  double velocity = 0, acceleration = 0, jerk = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Dice dice(seed);
    size.count_from = count_from(seed);
    Session session(dice, size);
    const std::string what = session.run();
    EXPECT_EQ(what, "") << "seed " << seed << (session.wild() ? " wild " : " quiet ")
                        << (session.config().motion_mode == NC_MOTION_OPTIMAL ? "optimal" : "trapezoid")
                        << (wish("NC_SHOW", 0) != 0 ? "\n" + session.text() : "");
    wrong += !what.empty();
    wild += session.wild();
    blocks += session.blocks();
    programs += session.tally().programs();
    velocity = std::max(velocity, session.watch().worst_velocity);
    acceleration = std::max(acceleration, session.watch().worst_acceleration);
    jerk = std::max(jerk, session.watch().worst_jerk);
  }
  std::printf("%llu sessions (%llu wild), %llu programs (%llu selected, %llu restarted, %llu MDI, %llu interrupt), %llu blocks: "
      "velocity %.4f, acceleration %.4f, jerk %.4f of the limits; %llu wrong\n",
      Count{count}, Count{wild}, Count{programs.all()}, Count{programs.selected}, Count{programs.restarted}, Count{programs.mdi},
      Count{programs.interrupts}, Count{blocks}, velocity, acceleration, jerk, Count{wrong});
  EXPECT_GT(blocks, count);           // the programs execute blocks
  EXPECT_GT(programs.all(), count);  // and several of them in each session
}

}  // namespace
}  // namespace nc::test
