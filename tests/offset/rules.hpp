// SPDX-License-Identifier: Apache-2.0
// What the tests of the rules of radius compensation ask of a path: where blocks end, which points it goes through, with which alarm it stops.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "alarm/condition.hpp"
#include "path_builder.hpp"

namespace nc::test {

inline constexpr double kTol = 6e-6;  // the numbers are printed with five decimals

inline void expect_at(const std::vector<Item>& out, const PathBuilder& path, uint32_t line, double h, double v) {
  const AxisVec p = at_block(out, path.start(), line);
  EXPECT_NEAR(p[path.comp.axis[0]], h, kTol) << "block " << line;
  EXPECT_NEAR(p[path.comp.axis[1]], v, kTol) << "block " << line;
}

inline void expect_path(const std::vector<Item>& out, const PathBuilder& path, const std::vector<Point>& points) {
  const std::vector<Move> moves = moves_of(out);
  ASSERT_EQ(moves.size(), points.size());
  AxisVec at = path.start();
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(moves[i].start, at) << "move " << i << " does not start where the one before ended";
    EXPECT_NEAR(moves[i].end[path.comp.axis[0]], points[i].h, kTol) << "move " << i;
    EXPECT_NEAR(moves[i].end[path.comp.axis[1]], points[i].v, kTol) << "move " << i;
    at = moves[i].end;
  }
}

inline void expect_alarm(const std::vector<Item>& out, Condition condition) {
  const Item* alarm = alarm_of(out);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->alarm.condition, condition);
}

}  // namespace nc::test
