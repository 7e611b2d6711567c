// SPDX-License-Identifier: Apache-2.0
// Which kinds of bus this build has: tests of one that needs a library are skipped without it.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "runtime/hal_factory.hpp"

namespace nc::test {

inline bool has_bus(std::string_view name) {
  for (const rt::PointBusKind& kind : rt::point_bus_kinds())
    if (kind.name == name) return kind.make != nullptr;
  ADD_FAILURE() << "there is no row " << name;
  return false;
}

}  // namespace nc::test
