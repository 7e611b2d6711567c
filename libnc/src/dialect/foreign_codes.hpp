// SPDX-License-Identifier: Apache-2.0
// Codes of other controls, which a program written for one of those may contain.
#pragma once

namespace nc {

/// A sentence for the alarm about G code `code` (as it is written), which no family here knows and another control does; nullptr = there is
/// nothing to say of this code.
const char* foreign_code_hint(double code);

}  // namespace nc
