// SPDX-License-Identifier: Apache-2.0
// Configurations for the tests of the runtime.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/config.hpp"

namespace nc::test {

// Three axes with limits, and some points; what tests change is at the end.
inline std::string base_toml() {
  return R"([machine]
name = "test"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
max_jerk = 50000.0
soft_limits = [-500.0, 500.0]
servo_lag_ms = 2.0
[[axis]]
name = "Y"
max_velocity = 150.0
max_acceleration = 1500.0
max_jerk = 50000.0
soft_limits = [-500.0, 500.0]
servo_lag_ms = 2.0
[[axis]]
name = "Z"
max_velocity = 100.0
max_acceleration = 1000.0
max_jerk = 50000.0
soft_limits = [-300.0, 300.0]
servo_lag_ms = 2.0
[[point]]
name = "in0"
direction = "input"
[[point]]
name = "in1"
direction = "input"
[[point]]
name = "word_in"
type = "word"
direction = "input"
[[point]]
name = "out0"
direction = "output"
[[point]]
name = "word_out"
type = "word"
direction = "output"
[macro_interface]
"#1000" = "in0"
"#1001" = "in1"
"#1033" = "word_in"
"#1100" = "out0"
"#1133" = "word_out"
[sim]
spindle_ramp_rpm_per_s = 100000.0
tool_change_s = 0.05
m_time_s = 0.004
)";
}

inline rt::Config parse_or_fail(const std::string& text) {
  rt::Config config;
  for (const rt::ConfigError& error : rt::parse_config(text, "test.toml", &config))
    ADD_FAILURE() << error.text();
  return config;
}

}  // namespace nc::test
