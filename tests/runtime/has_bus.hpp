// SPDX-License-Identifier: Apache-2.0
// Whether this build has a kind of bus: if the library for it was missing, its tests are skipped.
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
