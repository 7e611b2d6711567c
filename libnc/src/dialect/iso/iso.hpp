// SPDX-License-Identifier: Apache-2.0
// ISO 6983 / RS-274 as CAM systems and LinuxCNC users write it. There is no one manual: facts are those of NIST's RS274/NGC (cited
// "RS-274/NGC" with the section) and of what LinuxCNC documents of its codes (cited "LinuxCNC" with the code).
#pragma once

#include "dialect/dialect.hpp"

namespace nc::iso {

extern const Dialect kDialect;

}  // namespace nc::iso
