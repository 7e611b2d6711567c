// SPDX-License-Identifier: Apache-2.0
// The system variables of the HX family (14.2.3).
#include "dialect/hx/tables.hpp"

namespace nc::hx {
namespace {

using V = SystemVariable;
using W = ModalWord;

// Range, meaning, first part, stride of parts. The tables of turning tools (#1600 to #2111) are not of a machining centre.
// clang-format off
constexpr VariableRow kRows[] = {
    {2112, 2239, V::tool_offset, 2, 0, "mm", "tool offsets D1 to D128", "14.2.3"},
    {2240, 2367, V::tool_offset, 0, 0, "mm", "tool offsets H1 to H128", "14.2.3"},
    {2368, 2370, V::work_offset, 0, 0, "mm", "shift of all work coordinate systems, X Y Z", "14.2.3"},
    {2377, 2430, V::work_offset, 1, 9, "mm, deg", "work coordinate systems G54 to G59, an axis each", "14.2.3"},
    {3000, 3082, V::parameter_itself, 0, 0, "the parameter's", "parameters PI 0 to PI 82", "14.2.3"},
    {3083, 3083, V::single_block_off, 0, 0, "0/1", "no single block stop", "14.2.3 (4)"},
    {3084, 3999, V::parameter_itself, 0, 0, "the parameter's", "parameters PI 84 to PI 999", "14.2.3"},
    {4083, 4086, V::work_position, 0, 0, "mm, inch, deg", "workpiece position, an axis each", "14.2.3 (7)"},
    {4379, 4382, V::skip_position, 0, 0, "mm, inch, deg", "position of the last skip, an axis each", "14.2.3 (7)"},
    {4792, 4792, V::word, 0, 0, "as programmed", "S", "14.2.3 (6)"},
    {4882, 4883, V::word, 1, 0, "as programmed", "D, #4883 H", "14.2.3 (6)"},
    {5001, 5004, V::end_point, 0, 0, "mm, inch, deg", "end of the last block, an axis each", "14.2.3 (7)"},
    {5021, 5024, V::machine_position, 0, 0, "mm, inch, deg", "machine position, an axis each", "14.2.3 (7)"},
    {6205, 6208, V::machine_position, 0, 0, "mm, inch, deg", "machine position, an axis each", "14.2.3 (7)"},
    {6319, 6350, V::skip_position, 0, 0, "mm, inch, deg", "position of the last skip, an axis each", "4.9"},
    {6716, 6716, V::word, 3, 0, "as programmed", "N", "14.2.3 (6)"},
    {6718, 6749, V::code, 1, 0, "G code", "active G code of groups 1 to 32", "14.2.3 (6)"},
    {7000, 7031, V::input_bit, 0, 0, "0/1", "macro interface inputs, bits of #7032", "14.2.3 (1)"},
    {7032, 7035, V::input_word, 0, 0, "32 bits", "macro interface inputs, words", "14.2.3 (1)"},
    {7500, 7531, V::output_bit, 0, 0, "0/1", "macro interface outputs, bits of #7532", "14.2.3 (2)"},
    {7532, 7535, V::output_word, 0, 0, "32 bits", "macro interface outputs, words", "14.2.3 (2)"},
    {8000, 8095, V::reference_position, 1, 32, "mm, deg", "reference positions 2, 3 (#8032) and 4 (#8064), an axis each", "14.2.3"},
    {20000, 29999, V::parameter_itself, 0, 0, "the parameter's", "parameters PM 0 to PM 9999", "14.2.3"},
};
// clang-format on

constexpr ModalWord kWords[] = {W::spindle, W::radius_number, W::length_number, W::sequence};

}  // namespace

constinit const FamilyVariables kVariables = {
    .rows = {kRows, sizeof kRows / sizeof kRows[0]},
    .last_local = 99,
    .common = {{100, 199}, {200, 699}},
    .words = {kWords, sizeof kWords / sizeof kWords[0]},
};

}  // namespace nc::hx
