// SPDX-License-Identifier: Apache-2.0
// Targets of a block: what is commanded, how it is meant, and which of them count on.
#include "command/target.hpp"

#include <gtest/gtest.h>

namespace nc {
namespace {

TEST(Targets, EachKindCountsOnOrNot) {
  Targets targets;
  targets.set(0, TargetKind::absolute, 1);
  targets.set(1, TargetKind::incremental, 2);
  targets.set(2, TargetKind::radius, 3);
  targets.set(3, TargetKind::radius_increment, 4);
  targets.set(4, TargetKind::angle, 5);
  targets.set(5, TargetKind::angle_increment, 6);
  EXPECT_EQ(targets.axes(), 0x3fu);
  EXPECT_EQ(targets.incremental(), 0x2au);
  EXPECT_FALSE(targets.counts_on(2));
  EXPECT_TRUE(targets.counts_on(5));
  EXPECT_EQ(targets[3], 4);
  EXPECT_FALSE(targets.commands(6));
  EXPECT_EQ(targets.kind(6), TargetKind::omitted);
}

TEST(Targets, TheLastMeaningOfAnAxisHolds) {
  Targets targets;
  targets.set(1, TargetKind::incremental, 2);
  targets.set(1, TargetKind::absolute, -3);
  EXPECT_EQ(targets.incremental(), 0u);
  EXPECT_EQ(targets.kind(1), TargetKind::absolute);
  EXPECT_EQ(targets[1], -3);
}

TEST(Targets, WithoutAnAxisTheOthersStay) {
  Targets targets;
  targets.set(0, TargetKind::incremental, 1);
  targets.set(2, TargetKind::incremental, 3);
  const Targets left = targets.without(1u << 2 | 1u << 5);
  EXPECT_EQ(left.axes(), 1u);
  EXPECT_EQ(left.incremental(), 1u);
  EXPECT_EQ(left.kind(2), TargetKind::omitted);
  EXPECT_EQ(left[0], 1);
  EXPECT_TRUE(targets.commands(2));
  targets.clear();
  EXPECT_EQ(targets.axes() | targets.incremental(), 0u);
  EXPECT_EQ(targets.kind(0), TargetKind::omitted);
}

}  // namespace
}  // namespace nc
