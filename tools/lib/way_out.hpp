// SPDX-License-Identifier: Apache-2.0
// Whether a loop comes to an end by what is written: a program that counts its parts and jumps back for ever never comes back to an earlier state, and a long
// one that counts to a million does not for a long time either. The text tells them apart.
#pragma once

#include <cstdint>
#include <string_view>

#include "nc/nc.h"

namespace nc::tools {

/**
 * Whether a main program can leave the lines `first` to `last`, the last of which has jumped back to the first one. False only where every way stays among
 * them: the jump back has no condition, each other jump leads to a block among them, and none of them ends the program. What is not understood is a way out.
 */
bool has_way_out(nc_dialect dialect, std::string_view text, uint32_t first, uint32_t last);

/** Whether a text that such a loop calls can end the program, or return elsewhere than behind its call. */
bool may_not_return(nc_dialect dialect, std::string_view text);

}  // namespace nc::tools
