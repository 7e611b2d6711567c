// SPDX-License-Identifier: Apache-2.0
// Reads and checks the tables that nc_config points to. Their rows may have the size of another version of the library.
#pragma once

#include "dialect/dialect.hpp"
#include "nc/control.h"

namespace nc {

/// The member of a row that is refused, and what it has to be; nullptr = no member is refused.
struct VendorFault {
  const char* member = nullptr;
  const char* reason = nullptr;
  int joint = -1;  ///< number of the joint whose member it is, -1 = a member of no joint
};

/// Copies row `index` of a table whose rows may have the size of another version. False when its struct_size is not valid, or it sets members that
/// this library does not know.
bool take_vendor_code(const nc_vendor_code* rows, unsigned index, nc_vendor_code* known);
/// Checks row `index`. The rows before it have been checked already.
VendorFault check_vendor_code(const Dialect& dialect, const nc_vendor_code* rows, unsigned index);
VendorFault check_kinematics(const nc_kinematics& given);

}  // namespace nc
