// SPDX-License-Identifier: Apache-2.0
// Codes of a block that call: those that parameters register (M700 13.5.2, 13.5.3) and those of the vendor of the machine.
#pragma once

#include "command/front_end.hpp"

namespace nc {

/// The word of a block that calls.
struct Caller {
  unsigned at = 0;                ///< number of the word in the block
  WordSlot word = kNoWord;
  const CodeCall* call = nullptr; ///< nullptr = no word calls
  bool ascii = false;             ///< it is an ASCII code
  double value = 0;
};

/// Finds the first word that calls. Behind G65, G66 or G66.1 it is an argument, behind G10 an ordinary word. `functions_only`: only codes that call functions
/// of the vendor count. `in_cycle`: a fixed cycle is in force.
Reading find_caller(const Block& block, FrontEnd& front, bool functions_only, bool in_cycle, Caller* caller);

/// The block has the code of a fixed cycle beside the word that calls, which may be such a code itself (HX 14.1.3: one of the control is taken over).
bool begins_cycle(const Block& block, const FrontEnd& front, const Caller& caller);

/// The block has a code of the control by which it goes on in another program, or returns from this one, or ends it.
Reading goes_on_elsewhere(const Block& block, FrontEnd& front, bool* elsewhere);

}  // namespace nc
