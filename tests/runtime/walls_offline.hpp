// SPDX-License-Identifier: Apache-2.0
// The offline side of walls_test.cpp: pulls the same program item by item from an identical control, and compares.
#pragma once

#include <string>
#include <vector>

#include "walls_machine.hpp"

namespace nc::test {

struct Pulled {
  std::uint64_t serial = 0;
  std::uint8_t kind = 0;
  std::uint32_t line = 0;
  nc_axes machine{};       // where the axes are when it has been executed
  bool skip = false;       // a skip move, whose end depends on the machine
  nc_axes start{}, end{};  // programmed start and end of a skip move
};

struct Listing {
  std::vector<Pulled> items;
  std::string alarm;
  std::uint32_t alarm_line = 0;
  bool ended = false;
  std::uint32_t interface_output[NC_WORDS] = {};
  std::map<std::uint32_t, double> variables;
  unsigned skips = 0, syncs = 0;
};

// Inputs change at the same lines and M codes as on the machine, by the same script; a skip ends where it did on the
// machine.
Listing pull_offline(const rt::Config& config, const std::string& text, const Operator& op,
                     const Recording& machine);

// Expects the same items, serials, variables and outputs, the same end points within 1e-9 mm, and no limit broken.
void expect_same(const Recording& online, const Listing& offline, const rt::Config& config);

}  // namespace nc::test
