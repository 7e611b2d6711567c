// SPDX-License-Identifier: Apache-2.0
// Makes the command of a block: evaluates its expressions, finds its codes in the family's table, and sorts its words by what they mean.
#pragma once

#include "command/command.hpp"
#include "command/front_end.hpp"

namespace nc {

/// Reads a block into `command`. Its targets are set by the core, which knows the modes: Command::target is empty. Whether what the
/// block commands may stand together, and now, is for the core to say.
Reading read_command(const Block& block, FrontEnd& front, Command& command);

/// Bit i: the word of axis i is incremental. For each word the code of absolute or incremental programming before it in the block counts, and before the first
/// of them `incremental` (M700 5.1).
uint32_t incremental_axes(const Block& block, const AxisWords& axis_words, const Command& command, bool incremental);

}  // namespace nc
