// SPDX-License-Identifier: Apache-2.0
// A task of the planner from its beginning to its end.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "motion/optimal/work.hpp"

namespace nc::test {

/// `make(work)` makes it.
template <class Make>
auto at_once(Make&& make) {
  const auto work = std::make_unique<optimal::Work>();
  const auto result = work->now(make(*work));
  EXPECT_FALSE(work->ran_out());
  return result;
}

}  // namespace nc::test
