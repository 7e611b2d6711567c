// SPDX-License-Identifier: Apache-2.0
// The system variables of the m700 family (M700 13.5.5), in the layout of the manual's table.
#include "dialect/m700/tables.hpp"

namespace nc::m700 {
namespace {

using V = SystemVariable;
using W = ModalWord;

// Columns: first and last number, meaning, first part, stride of parts, unit, name, section.
// clang-format off
constexpr VariableRow kRows[] = {
    {1000, 1031, V::input_bit, 0, 0, "0/1", "macro interface inputs, bits of #1032", "13.5.5"},
    {1032, 1035, V::input_word, 0, 0, "32 bits", "macro interface inputs, words", "13.5.5"},
    {1100, 1131, V::output_bit, 0, 0, "0/1", "macro interface outputs, bits of #1132", "13.5.5"},
    {1132, 1135, V::output_word, 0, 0, "32 bits", "macro interface outputs, words", "13.5.5"},
    {1200, 1295, V::input_bit, 1, 0, "0/1", "macro interface inputs, bits of #1033 to #1035", "13.5.5"},
    {1300, 1395, V::output_bit, 1, 0, "0/1", "macro interface outputs, bits of #1133 to #1135", "13.5.5"},
    {2001, 2800, V::tool_offset, 0, 200, "mm (inch: #1041)", "tool offsets 1 to 200: length, #2201 its wear, #2401 radius, #2601 its wear", "13.5.5"},
    {3000, 3000, V::alarm, 0, 0, "1-9999", "alarm of the program, with its text in ( )", "13.5.5"},
    {3001, 3001, V::time_powered, 0, 0, "ms", "time with power on", "13.5.5"},
    {3002, 3002, V::time_running, 0, 0, "ms, h (#1273 bit 1)", "time in automatic start", "13.5.5"},
    {3003, 3004, V::control, 0, 0, "bits", "#3003 no single block stop, no FIN; #3004 no feed hold, override, G09", "13.5.5"},
    {3006, 3006, V::message, 0, 0, "-", "stop with the message in ( )", "13.5.5"},
    {3007, 3007, V::mirror, 0, 0, "bits", "mirrored axes, bit 0 = first axis", "13.5.5"},
    {3011, 3011, V::date, 0, 0, "YYYYMMDD", "date", "13.5.5"},
    {3012, 3012, V::time_of_day, 0, 0, "HHMMSS", "time of day", "13.5.5"},
    {3901, 3902, V::count, 0, 0, "count", "workpieces machined, #3902 their maximum", "13.5.5"},
    {4001, 4021, V::code, 0, 0, "G code", "active G code of groups 1 to 21, as read", "13.5.5"},
    {4101, 4120, V::word, 0, 0, "as programmed", "B D F H M N O S T (#4102 07 09 11 13 14 15 19 20), as read", "13.5.5"},
    {4130, 4130, V::extended_work, 0, 0, "as programmed", "P of the G54.1 in force, as read; 0 = G54 to G59", "14.10"},
    {4201, 4221, V::code_now, 0, 0, "G code", "active G code of groups 1 to 21, block in execution", "13.5.5"},
    {4301, 4320, V::word_now, 0, 0, "as programmed", "B D F H M N O S T, block in execution", "13.5.5"},
    {4401, 4421, V::code_at_interrupt, 0, 0, "G code", "active G code of groups 1 to 21 at a macro interrupt", "13.12"},
    {4501, 4520, V::word_at_interrupt, 0, 0, "as programmed", "D F H M N O S T at a macro interrupt", "13.12"},
    {5001, 5020, V::end_point, 0, 0, "mm, inch, deg", "end point of the block before, by axis", "13.5.5"},
    {5021, 5040, V::machine_position, 0, 0, "mm, inch, deg", "machine position", "13.5.5"},
    {5041, 5060, V::work_position, 0, 0, "mm, inch, deg", "workpiece position, tool compensation in it", "13.5.5"},
    {5061, 5080, V::skip_position, 0, 0, "mm, inch, deg", "position of the last skip", "13.5.5"},
    {5081, 5100, V::compensation, 0, 0, "mm, inch, deg", "tool position compensation", "13.5.5"},
    {5101, 5120, V::deviation, 0, 0, "mm, inch, deg", "servo deviation", "13.5.5"},
    {5201, 5340, V::work_offset, 0, 20, "mm (inch: #1041), deg", "work offsets: external, #5221 G54 to #5321 G59, by axis", "13.5.5"},
    {7001, 8920, V::work_offset, 7, 20, "mm (inch: #1041), deg", "work offsets G54.1 P1 to P96, 20 numbers each, by axis", "14.10"},
    {10001, 10999, V::tool_offset, 0, 0, "mm (inch: #1041)", "tool offsets: length (type I: the value)", "13.5.5"},
    {11001, 11999, V::tool_offset, 1, 0, "mm (inch: #1041)", "tool offsets: length wear (type II)", "13.5.5"},
    {16001, 16999, V::tool_offset, 2, 0, "mm (inch: #1041)", "tool offsets: radius (type II)", "13.5.5"},
    {17001, 17999, V::tool_offset, 3, 0, "mm (inch: #1041)", "tool offsets: radius wear (type II)", "13.5.5"},
    {30060, 30068, V::rotation, 0, 0, "axis, mm, deg", "coordinate rotation by parameter (13.21): axes, centre, angle, SIN, COS, vector", "13.5.5"},
    {60000, 60000, V::tool_group_select, 0, 0, "group", "tool life: group that is read", "13.5.5"},
    {60001, 60008, V::tool_group, 0, 0, "-", "tool life of the group; -1 = not registered", "13.5.5"},
    {60501, 60700, V::tool_life, 0, 0, "-", "tool life: group number; -1 = no tool registered", "13.5.5"},
    {61001, 61200, V::tool_life, 1, 0, "-", "tool life: tool number", "13.5.5"},
    {61501, 61700, V::tool_life, 2, 0, "-", "tool life: flags", "13.5.5"},
    {62001, 62200, V::tool_life, 3, 0, "-", "tool life: status", "13.5.5"},
    {62501, 62700, V::tool_life, 4, 0, "-", "tool life: life", "13.5.5"},
    {63001, 63200, V::tool_life, 5, 0, "-", "tool life: used", "13.5.5"},
    {63501, 63700, V::tool_life, 6, 0, "-", "tool life: length compensation", "13.5.5"},
    {64001, 64200, V::tool_life, 7, 0, "-", "tool life: radius compensation", "13.5.5"},
    {64501, 64700, V::tool_life, 8, 0, "-", "tool life: auxiliary data", "13.5.5"},
    {100000, 100002, V::parameter_select, 0, 0, "-", "parameter that is read: number, part system, axis", "13.5.5"},
    {100010, 100010, V::parameter, 0, 0, "the parameter's", "value of that parameter", "13.5.5"},
    {100100, 100103, V::device_select, 0, 0, "-", "PLC data that is read: device, number, bytes, bit", "13.5.5"},
    {100110, 100110, V::device, 0, 0, "-", "value of that device", "13.5.5"},
};
// clang-format on

// 13.5.5 (10.10): the words of #41nn by nn: 2 B, 7 D, 9 F, 11 H, 13 M, 14 N, 15 O, 19 S, 20 T.
constexpr ModalWord kWords[] = {W::none,          W::second_auxiliary, W::none,     W::none,    W::none, W::none, W::radius_number,
                                W::none,          W::feed,             W::none,     W::length_number, W::none, W::misc, W::sequence,
                                W::program,       W::none,             W::none,     W::none,    W::spindle, W::tool};

// 13.5.5 (10.17): code, width and number of the devices.
// M700 13.5.5 (10.17), #100102
constexpr DeviceWidth kDeviceWidths[] = {
    {0, 0, false}, {1, 1, false}, {101, 1, true}, {2, 2, false}, {102, 2, true}, {4, 4, false}, {104, 4, true},
};

constexpr DeviceRow kDevices[] = {
    {0, false, 10240}, {1, true, 2048},    {2, false, 256}, {4, false, 0x2000}, {5, false, 0x2000}, {6, true, 13312},
    {7, false, 704},   {9, false, 128},    {10, false, 1024}, {13, false, 512}, {18, false, 256},   {19, false, 64},
    {20, true, 128},   {21, false, 0x200}, {22, true, 0x200}, {23, false, 0x2000}, {24, true, 0x2000},
};

}  // namespace

constinit const FamilyVariables kVariables = {
    .rows = {kRows, sizeof kRows / sizeof kRows[0]},
    .words = {kWords, sizeof kWords / sizeof kWords[0]},
    .devices = {kDevices, sizeof kDevices / sizeof kDevices[0]},
    .device_widths = {kDeviceWidths, sizeof kDeviceWidths / sizeof kDeviceWidths[0]},
};

}  // namespace nc::m700
