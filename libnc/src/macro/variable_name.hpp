// SPDX-License-Identifier: Apache-2.0
/// Which names a common variable cannot have, whoever gives it: a program (SETVN) or the host.
#pragma once

#include <cstddef>

namespace nc {

/// A name may not begin with the name of a function or operator (M700 13.5.5, note).
bool is_reserved_name(const char* name, size_t length);

}  // namespace nc
