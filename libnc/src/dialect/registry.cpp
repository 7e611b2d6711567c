// SPDX-License-Identifier: Apache-2.0
// The list of the families. It has a file of its own so that a test program can give the library other tables: if the program defines
// dialect() itself, the linker takes that one and leaves this file of libnc.a out (tests/permuted).
#include "dialect/dgshape/dgshape.hpp"
#include "dialect/dialect.hpp"
#include "dialect/hx/hx.hpp"
#include "dialect/iso/iso.hpp"
#include "dialect/m700/m700.hpp"
#include "dialect/series8/series8.hpp"

namespace nc {

const Dialect& dialect(nc_dialect id) {
  switch (id) {
    case NC_DIALECT_DGSHAPE:
      return dgshape::kDialect;
    case NC_DIALECT_ISO:
      return iso::kDialect;
    case NC_DIALECT_HX:
      return hx::kDialect;
    case NC_DIALECT_SERIES8:
      return series8::kDialect;
    case NC_DIALECT_M700:
    case NC_DIALECT_COUNT:
      break;
  }
  return m700::kDialect;
}

}  // namespace nc
