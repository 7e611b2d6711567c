// SPDX-License-Identifier: Apache-2.0
// A configuration that the control refuses: the runtime names the member and the reason, and does not start.
#include <gtest/gtest.h>

#include <limits>

#include "ladder_machine.hpp"

namespace {

TEST(RefusedConfig, NamesTheMemberAndTheReason) {
  nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  config.nc.system[0].axis[1].max_velocity = std::numeric_limits<double>::quiet_NaN();
  std::vector<nc::rt::ConfigError> errors;
  EXPECT_EQ(nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors), nullptr);
  ASSERT_EQ(errors.size(), 1u);
  const std::string text = errors[0].text();
  EXPECT_NE(text.find("the control refuses system[0].axis[1].max_velocity: is no finite number; must be 0 to 1e12"), std::string::npos) << text;
}

}  // namespace
