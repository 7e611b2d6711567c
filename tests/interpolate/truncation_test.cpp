// SPDX-License-Identifier: Apache-2.0
// The protocol by which committed records are given up, step by step, with one thread for both sides.
#include "interpolate/truncation.hpp"

#include <gtest/gtest.h>

namespace nc::test {
namespace {

TEST(TruncationProtocol, WhatIsAgreedAndNotClaimedIsTakenBack) {
  Truncation t;
  t.ask();
  ASSERT_TRUE(t.open());
  t.answer(true);
  EXPECT_TRUE(t.answered());
  EXPECT_TRUE(t.holds());
  EXPECT_TRUE(t.withdraw());
  EXPECT_FALSE(t.holds());
  EXPECT_FALSE(t.claim());
}

TEST(TruncationProtocol, WhatIsClaimedIsTheFeedersUntilReleased) {
  Truncation t;
  t.ask();
  t.answer(true);
  ASSERT_TRUE(t.claim());
  EXPECT_TRUE(t.holds());
  EXPECT_FALSE(t.withdraw());
  EXPECT_TRUE(t.holds());
  t.release();
  EXPECT_FALSE(t.holds());
}

// The feeder claims, gives records up and releases during a cycle of the scan that saw the agreement at its beginning. The plan of this cycle is
// older than that, so a reset must not get the ring back within the cycle.
TEST(TruncationProtocol, WhatIsReleasedWithinACycleIsNotTakenBackInIt) {
  Truncation t;
  t.ask();
  t.answer(true);
  ASSERT_TRUE(t.holds());  // the cycle begins, and is frozen
  ASSERT_TRUE(t.claim());
  t.release();
  EXPECT_FALSE(t.withdraw());  // a reset comes later in the cycle: it stays frozen
  EXPECT_FALSE(t.holds());     // the next cycle is free, and takes the newest plan first
}

TEST(TruncationProtocol, ARefusalLeavesTheRingToTheScan) {
  Truncation t;
  t.ask();
  t.answer(false);
  EXPECT_TRUE(t.answered());
  EXPECT_FALSE(t.holds());
  EXPECT_FALSE(t.claim());
  EXPECT_FALSE(t.open());
}

}  // namespace
}  // namespace nc::test
