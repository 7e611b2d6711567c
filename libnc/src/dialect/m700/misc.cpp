// SPDX-License-Identifier: Apache-2.0
// M700 9.1: the M codes that the control keeps for itself. Every other M code is put out to the machine.
#include "dialect/m700/tables.hpp"

namespace nc::m700 {

using M = MiscFunction;

const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "9.1"},
    {1, M::optional_stop, nullptr, "optional stop", "9.1"},
    {2, M::program_end, nullptr, "program end", "9.1"},
    {30, M::program_end, nullptr, "program end and rewind", "9.1"},
    {96, M::interrupt_on, nullptr, "macro interrupt on", "13.12"},
    {97, M::interrupt_off, nullptr, "macro interrupt off", "13.12"},
    {98, M::call_sub, nullptr, "sub program call", "13.3.1"},
    {99, M::return_sub, nullptr, "return from a sub program", "13.3.1"},
    {198, M::call_external, nullptr, "sub program call in the data server", "13.3.2"},
};

// 9.1, 10: what the machine does with them is its own affair; here they say whether the spindle turns, and which one hosts show as the tool change, which one
// orients it for a fixed cycle.
const OutputRow kOutputs[] = {
    {3, M::spindle_forward},
    {4, M::spindle_reverse},
    {5, M::spindle_stop},
    {6, M::tool_change},
    {19, M::spindle_oriented},  // 13.1.1, 6.7
};

}  // namespace nc::m700
