// SPDX-License-Identifier: Apache-2.0
// Which families there are. Alone in its file so that a program of the tests can hand the library tables of its own: one that defines
// dialect() itself links its own, and libnc.a's stays out (tests/permuted).
#include "dialect/dgshape/dgshape.hpp"
#include "dialect/dialect.hpp"
#include "dialect/hx/hx.hpp"
#include "dialect/iso/iso.hpp"
#include "dialect/m700/m700.hpp"

namespace nc {

const Dialect& dialect(nc_dialect id) {
  switch (id) {
    case NC_DIALECT_DGSHAPE:
      return dgshape::kDialect;
    case NC_DIALECT_ISO:
      return iso::kDialect;
    case NC_DIALECT_HX:
      return hx::kDialect;
    case NC_DIALECT_M700:
    case NC_DIALECT_COUNT:
      break;
  }
  return m700::kDialect;
}

}  // namespace nc
