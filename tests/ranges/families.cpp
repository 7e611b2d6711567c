// SPDX-License-Identifier: Apache-2.0
#include "families.hpp"

#include "dialect/dgshape/dgshape.hpp"
#include "dialect/hx/hx.hpp"
#include "dialect/iso/iso.hpp"
#include "dialect/m700/m700.hpp"
#include "dialect/series8/series8.hpp"

namespace nc::test {

std::array<Dialect, NC_DIALECT_COUNT>& families() {
  static std::array<Dialect, NC_DIALECT_COUNT> copies = {m700::kDialect, dgshape::kDialect, iso::kDialect, hx::kDialect, series8::kDialect};
  return copies;
}

}  // namespace nc::test

namespace nc {

// In place of the list of libnc.a (dialect/registry.cpp).
const Dialect& dialect(nc_dialect id) { return test::families()[id < NC_DIALECT_COUNT ? id : NC_DIALECT_M700]; }

}  // namespace nc
