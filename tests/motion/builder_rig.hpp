// SPDX-License-Identifier: Apache-2.0
// A builder of paths of three axes with its ring of records and its store, at their start.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "motion/optimal/path_builder.hpp"

namespace nc::test {

struct BuilderRig {
  // `records`: of the ring, a power of two. `tolerance`: mm.
  explicit BuilderRig(uint32_t records, double tolerance = 0.01) : memory(8u << 20), ring(records), passed(records) {
    store.passed = passed.data();
    store.record_mask = records - 1;
    optimal::Limits limits;
    for (unsigned i = 0; i < 3; ++i) {
      limits.velocity[i] = limits.rapid[i] = 250;
      limits.acceleration[i] = 2000;
      limits.jerk[i] = 50000;
    }
    Arena arena(memory.data(), memory.size());
    builder.create(limits, tolerance, 0.005, ring.data(), &store, arena);
    EXPECT_FALSE(arena.overflowed());
    builder.restart(0, 0, {}, 0, 0);
  }
  BuilderRig(const BuilderRig&) = delete;
  BuilderRig& operator=(const BuilderRig&) = delete;

  std::vector<std::byte> memory;
  std::vector<Record> ring;
  std::vector<double> passed;
  optimal::PlanStore store;
  optimal::PathBuilder builder;
};

}  // namespace nc::test
