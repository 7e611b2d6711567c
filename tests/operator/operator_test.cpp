// SPDX-License-Identifier: Apache-2.0
// Random sessions by seed. More on request: NC_SEEDS=100000 NC_FIRST_SEED=1; NC_SHOW=1 prints the program of a
// seed that does not hold, NC_LOG=1 every cycle.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "operator/session.hpp"

namespace nc::test {
namespace {

uint64_t wish(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(Operator, DoesAnything) {
  const char* sanitizer = std::getenv("NC_SANITIZE");
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = wish("NC_SEEDS", sanitizer != nullptr && *sanitizer != 0 ? 20 : 150);
  uint64_t wrong = 0, wild = 0, blocks = 0;
  double velocity = 0, acceleration = 0, jerk = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Dice dice(seed);
    Session session(dice, {});
    const std::string what = session.run();
    EXPECT_EQ(what, "") << "seed " << seed << (session.wild() ? " wild " : " quiet ")
                        << (session.config().motion_mode == NC_MOTION_OPTIMAL ? "optimal" : "trapezoid")
                        << (wish("NC_SHOW", 0) != 0 ? "\n" + session.text() : "");
    wrong += !what.empty();
    wild += session.wild();
    blocks += session.blocks();
    velocity = std::max(velocity, session.watch().worst_velocity);
    acceleration = std::max(acceleration, session.watch().worst_acceleration);
    jerk = std::max(jerk, session.watch().worst_jerk);
  }
  std::printf("%llu sessions (%llu wild), %llu blocks: velocity %.4f, acceleration %.4f, jerk %.4f of the limits; %llu wrong\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(wild), static_cast<unsigned long long>(blocks), velocity,
              acceleration, jerk, static_cast<unsigned long long>(wrong));
  EXPECT_GT(blocks, count);  // the programs come somewhere
}

}  // namespace
}  // namespace nc::test
