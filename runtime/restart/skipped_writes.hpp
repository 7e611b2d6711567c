// SPDX-License-Identifier: Apache-2.0
// What a search for a place has changed of the common variables, offsets, parameters and tool lives: the part of the program that is skipped counts once more what the run that was stopped has
// counted, and only the operator knows whether that is right.
#pragma once

#include <string>

#include "nc/nc.h"
#include "runtime/nc_port.hpp"

namespace nc::rt {

// "#500 = 8 (it was 7), work offset 1 X = -2 (it was -3)"; "" = nothing that was there before has another value now. `local`: variables that nobody keeps.
std::string skipped_writes(const KeptValues& before, const KeptValues& after, unsigned system, const nc_variable_range& local);

}  // namespace nc::rt
