// SPDX-License-Identifier: Apache-2.0
// The tables that nc_config points to: rows of another version's size, and what is wrong with them.
#pragma once

#include "dialect/dialect.hpp"
#include "nc/control.h"

namespace nc {

/// What is refused of a row: the member and what it has to be; nullptr = nothing.
struct VendorFault {
  const char* member = nullptr;
  const char* reason = nullptr;
  int joint = -1;  ///< `member` is one of this joint
};

/// Row `index` of a table whose rows may have the size of another version; false when its struct_size is none, or it asks for what this
/// library does not know.
bool take_vendor_code(const nc_vendor_code* rows, unsigned index, nc_vendor_code* known);
/// Looks at that row; those before it have been looked at.
VendorFault check_vendor_code(const Dialect& dialect, const nc_vendor_code* rows, unsigned index);
VendorFault check_kinematics(const nc_kinematics& given);

}  // namespace nc
