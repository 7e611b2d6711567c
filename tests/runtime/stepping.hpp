// SPDX-License-Identifier: Apache-2.0
// Helpers for a runtime that is stepped on virtual time, and the values of its variables.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/clock.hpp"
#include "runtime/runtime.hpp"

namespace nc::test {

// A simulated machine whose runtime is stepped. `runtime` is null, and the test has failed, when it cannot be made.
struct SteppedMachine {
  explicit SteppedMachine(rt::Config wanted) : config(std::move(wanted)), machine(config.sim, config.points) {
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
    std::string error;
    if (runtime == nullptr || !runtime->start_stepping(&error)) {
      ADD_FAILURE() << error;
      runtime = nullptr;
    }
  }
  rt::Config config;
  hal::SimMachine machine;
  rt::VirtualClock clock;
  std::unique_ptr<rt::Runtime> runtime;
};

inline void steps_of(rt::Runtime& runtime, int n) {
  while (n-- > 0) runtime.step();
}

// The value of a variable, or `if_vacant` when it has none; `system` counts from 0.
inline double variable_of(rt::Runtime& runtime, std::uint32_t number, double if_vacant, unsigned system = 0) {
  double value = 0;
  bool vacant = true;
  EXPECT_EQ(nc_variable_get(runtime.control(), system, number, &value, &vacant), NC_OK);
  return vacant ? if_vacant : value;
}

}  // namespace nc::test
