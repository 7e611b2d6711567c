// SPDX-License-Identifier: Apache-2.0
// ISO 6983 / RS-274 as CAM systems and LinuxCNC users write it. There is no single manual: the facts come from NIST's RS274/NGC (cited as
// "RS-274/NGC" with the section) and from the documentation of LinuxCNC (cited as "LinuxCNC" with the code).
#pragma once

#include "dialect/dialect.hpp"

namespace nc::iso {

extern const Dialect kDialect;

}  // namespace nc::iso
