// SPDX-License-Identifier: Apache-2.0
// A line of micrometres leads wherever the last digits of its words lead it: between two arcs of a fillet aside by 45 degrees, though no part of it is farther from them than these
// digits. A corner at both of its ends would take the tool by tan(22.5) of its radius along the fillet and back, and where the fillet is hardly larger than the tool there is no such corner.
// It is a part of the blocks beside it where these go on, one behind the other, as if it were none.
#pragma once

#include "offset/interference.hpp"

namespace nc {

/// Behind the block `before`: it leads aside, by no more than a digit. Whether it is a part of it the block behind tells.
bool may_be_part(const Section& before, const Section& line);
/// The block behind leads it back, and the tool goes past all three at right angles to `before` at its end and to `behind` at its start.
bool is_part(const Section& before, const Section& line, const Section& behind);

}  // namespace nc
