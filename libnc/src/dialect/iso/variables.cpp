// SPDX-License-Identifier: Apache-2.0
// Those parameters of RS-274/NGC 3.2.1, table 3, that mean something to the control. All others up to 5399 are free for the user.
#include "dialect/iso/tables.hpp"

namespace nc::iso {
namespace {

using V = SystemVariable;

constexpr VariableRow kRows[] = {
    {5061, 5069, V::skip_position, 0, 0, "mm or inch, deg", "place where the probe touched, an axis each", "LinuxCNC G38"},
    {5070, 5070, V::skip_answer, 0, 0, "0/1", "whether the last G38 ended by its signal", "LinuxCNC parameters"},
    {5221, 5386, V::work_offset, 1, 20, "mm or inch, deg", "coordinate systems G54 to G59.3, an axis each", "RS-274/NGC 3.2.1"},
    {5399, 5399, V::input_answer, 0, 0, "0, 1, -1", "what the last M66 has found", "LinuxCNC M66"},
    {5400, 5400, V::word, 0, 0, "", "number of the tool in the spindle, 0 = none", "LinuxCNC parameters"},
    {5420, 5428, V::work_position, 0, 0, "mm or inch, deg", "place where the axis is commanded to be", "LinuxCNC parameters"},
    // LinuxCNC names its inputs and outputs; programs reach them by M62 to M68. The numbers of ours lie above its parameters.
    {6000, 6031, V::input_bit, 0, 0, "0/1", "@motion.digital-in-00 to 31: P of M66", "LinuxCNC M66"},
    {6032, 6034, V::input_word, 1, 0, "32 bits", "@motion.analog-in-00 to 02: E of M66", "LinuxCNC M66"},
    {6100, 6131, V::output_bit, 0, 0, "0/1", "@motion.digital-out-00 to 31: P of M62 to M65", "LinuxCNC M62"},
    {6132, 6134, V::output_word, 1, 0, "32 bits", "@motion.analog-out-00 to 02: E of M67, M68", "LinuxCNC M67"},
};

constexpr ModalWord kWords[] = {ModalWord::spindle_tool};

}  // namespace

constinit const FamilyVariables kVariables = {
    .rows = {kRows, sizeof kRows / sizeof kRows[0]},
    .common = {{34, 499}, {500, 5000}},  // RS-274/NGC 3.2.1: free for the user; #1 to #33 are local variables here
    .words = {kWords, sizeof kWords / sizeof kWords[0]},
};

}  // namespace nc::iso
