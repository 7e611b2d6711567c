// SPDX-License-Identifier: Apache-2.0
// M700 9.1: the M codes that the control keeps for itself. Every other M is output.
#include "dialect/m700/tables.hpp"

namespace nc::m700 {

using M = MiscFunction;

const MiscRow kMisc[] = {
    {0, M::program_stop, nullptr, "program stop", "9.1"},
    {1, M::optional_stop, nullptr, "optional stop", "9.1"},
    {2, M::program_end, nullptr, "program end", "9.1"},
    {30, M::program_end, nullptr, "program end and rewind", "9.1"},
    {96, M::output, nullptr, "macro interrupt on", "13.12"},
    {97, M::output, nullptr, "macro interrupt off", "13.12"},
    {98, M::call_sub, nullptr, "sub program call", "13.3.1"},
    {99, M::return_sub, nullptr, "return from a sub program", "13.3.1"},
    {198, M::call_external, nullptr, "sub program call in the data server", "13.3.2"},
};

}  // namespace nc::m700
