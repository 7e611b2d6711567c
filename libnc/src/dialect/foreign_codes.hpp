// SPDX-License-Identifier: Apache-2.0
// Codes of other controls that a program may have brought along.
#pragma once

namespace nc {

/// What to say of a G code (as it is written) that no family here knows and others do; nullptr = nothing.
const char* foreign_code_hint(double code);

}  // namespace nc
