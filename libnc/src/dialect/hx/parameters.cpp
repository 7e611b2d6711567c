// SPDX-License-Identifier: Apache-2.0
// The parameters of the HX family that something in the control asks for. Their keys are the numbers of the variables that they are to a program
// (14.2.3): PI 144 is 3144, PM 2097 is 22097.
#include <cmath>

#include "dialect/hx/tables.hpp"

namespace nc::hx {
namespace {

using P = Parameter;

constexpr int8_t kAll = -1;
constexpr const char* kOffOn = "0, 1";

bool any(double) { return true; }
bool at_least_0(double value) { return value >= 0; }
template <int low, int high>
bool between(double value) {
  return value >= low && value <= high;
}
template <int low, int high>
bool whole(double value) {
  return between<low, high>(value) && value == std::floor(value);
}

/// 0 is the first plane here, 1 is it where the meaning counts.
double plane_number(double value) { return value + 1; }
/// 0 means that it is on.
double unless(double value) { return value == 0 ? 1 : 0; }

/// 14.1.3 (2), 14.1.4 (3): codes that keep their meaning.
bool g_that_calls(double value) { return whole<0, 255>(value) && (value < 65 || value > 67); }
bool m_that_calls(double value) { return whole<0, 97>(value) && value != 2 && value != 30; }

/// 2.3.4: of 1 nothing but the number is left.
bool zero_or_two(double value) { return value == 0 || value == 2; }
/// 2 is what the meaning counts as yes.
double is_two(double value) { return value == 2 ? 1 : 0; }

/// What the manual has and is not built: only the value that leaves it off is accepted.
constexpr bool (*kOffOnly)(double) = whole<0, 0>;

// clang-format off
constexpr ParameterRow kNumbers[] = {
    {3061, 3069, 1, kAll, false,    P::creep,                   any,               "mm", "G60: overrun of the axes; its sign is the direction", "4.2", 1},
    {3070, 3070, 1, kAll, false,    P::shift_axis,              whole<0, 1>,       "0 first, 1 second", "G76, G87: axis of the plane along which Q shifts; Q needs PI 70 and PI 71", "12.3.9"},
    {3071, 3071, 1, kAll, false,    P::shift_direction,         whole<0, 1>,       "0 plus, 1 minus", "G76, G87: direction in which Q shifts", "12.3.9"},
    {3072, 3072, 1, kAll, false,    P::diameter_offsets,        whole<0, 1>,       kOffOn, "values of D are diameters", "13.2.1"},
    {3074, 3074, 1, kAll, false,    P::reset_clears_common,     whole<0, 1>,       kOffOn, "reset clears #100 to #199", "14.4"},
    {3085, 3094, 1, kAll, false,    P::g_call_code,             g_that_calls,      "0; 1-64, 68-255", "G codes that call 9010 to 9019", "14.1.3"},
    {3095, 3104, 1, kAll, false,    P::m_call_code,             m_that_calls,      "0; 1-97, not 2, 30", "M codes that call 9020 to 9029", "14.1.4"},
    {3105, 3106, 1, kAll, false,    P::tool_macro,              whole<0, 9>,       "0; 0-9", "T calls a macro: with PI 106 program 9000 + PI 105, with PI 105 alone 9000", "10.1.1"},
    {3108, 3116, 1, kAll, false,    P::axis_factor,             any,               "1000; 1/1000", "G51: factors of the axes", "15.2.1", 1},
    {3117, 3117, 1, kAll, false,    P::rotation_angle,          between<-360, 360>, "0; deg", "G68: angle without R", "15.4.1"},
    {3120, 3120, 1, kAll, false,    P::dwell_in_revolutions,    whole<0, 1>,       kOffOn, "G04 counts revolutions in G95", "5.4"},
    {3124, 3124, 1, kAll, false,    P::corner_override,         between<0, 100>,   "0-100 %", "G62: feed in corners", "5.3.5"},
    {3125, 3125, 1, kAll, false,    P::corner_override_zone,    at_least_0,        "mm", "G62: way in front of the corner", "5.3.5"},
    {3126, 3126, 1, kAll, false,    P::corner_behind,           at_least_0,        "mm", "G62: way behind the corner", "5.3.5"},
    {3128, 3128, 1, kAll, false,    P::comp_type_b,             whole<0, 1>,       "0 A, 1 B", "radius compensation starts and ends by type B", "13.2.2"},
    {3129, 3129, 1, kAll, false,    P::peck_clearance,          at_least_0,        "0; mm", "G73, G83: distance d", "12.3.3"},
    {3130, 3130, 1, kAll, false,    P::corner_override_angle,   between<2, 178>,   "2-178 deg", "G62: largest inner angle", "5.3.5"},
    {3131, 3131, 1, kAll, false,    P::corner_always,           whole<0, 1>,       kOffOn, "the override of inner corners and arcs acts in G64, too", "5.3.5"},
    {3132, 3132, 1, kAll, false,    P::inner_arc_least,         between<0, 100>,   "0 off; 1-100 %", "G62: least Rc/Rp by which the feed of an inner arc is lowered", "5.3.6"},
    {3133, 3133, 1, kAll, false,    P::stays_behind_reset,      zero_or_two,       "0, 2", "program restart: a start behind a reset begins 0 at the head of the program, 2 with the block that was stopped, in the modes of before", "2.3.4", 0, 0, is_two},
    {3134, 3134, 1, kAll, false,    P::none,                    whole<0, 1>,       kOffOn, "search of sequence numbers: with either value through the whole program", "2.3.3"},
    {3141, 3141, 1, kAll, false,    P::measure_deceleration,    at_least_0,        "mm", "G37: distance from which on the measuring feed is in force", "4.10"},
    {3142, 3142, 1, kAll, false,    P::measure_range,           at_least_0,        "mm", "G37: range around the point where the signal may come", "4.10"},
    {3143, 3143, 1, kAll, false,    P::measure_feed,            at_least_0,        "mm/min", "G37: measuring feed", "4.10"},
    {3144, 3144, 1, kAll, false,    P::start_linear,            whole<0, 1>,       "0 G00, 1 G01", "motion at power on", "3.2"},
    {3145, 3145, 1, kAll, false,    P::start_plane,             whole<0, 2>,       "0, 1, 2", "plane at power on: G17, G18, G19", "3.2", 0, 0, plane_number},
    {3146, 3146, 1, kAll, false,    P::start_absolute,          whole<0, 1>,       "0 G90, 1 G91", "absolute or incremental at power on", "3.2", 0, 0, unless},
    {3147, 3147, 1, kAll, false,    P::start_inch,              whole<0, 1>,       "0 G21, 1 G20", "inch at power on", "3.2"},
    {3148, 3148, 1, kAll, false,    P::start_stroke_check,      whole<0, 1>,       "1 G23; 0 G22", "stored stroke check at power on", "3.2", 0, 0, unless},
    {3149, 3149, 1, kAll, false,    P::start_scaling,           whole<0, 1>,       "0 G50, 1 G51", "scaling at power on, by PI 108 to 116 about the zero point", "3.2"},
    {3150, 3150, 1, kAll, false,    P::start_rotation,          whole<0, 1>,       "0 G69, 1 G68", "rotation at power on, by PI 117 about the zero point", "3.2"},
    {3151, 3151, 1, kAll, false,    P::arc_tolerance,           at_least_0,        "0.01 mm", "how far the end of an arc may lie beside its circle", "4.4"},
    {3153, 3153, 1, kAll, false,    P::corner_feed,             at_least_0,        "0; mm/min", "G62: feed in corners in place of the override of PI 124", "5.3.5"},
    {3155, 3155, 1, kAll, false,    P::cylinder_second_axis,    whole<0, 1>,       "0 X (G17, G18) Y (G19), 1 Y (G17) Z (G18, G19)", "G107: axis of the plane that the rotary axis stands for", "4.7"},
    {22097, 22192, 32, kAll, false, P::reference_position,      any,               "mm", "reference positions 2 to 4, 32 numbers each, by axis", "6.2", 1, 1},
    {23474, 23474, 1, kAll, false,  P::box_outside,             whole<0, 1>,       "0 inside, 1 outside", "G22: where no axis may go", "15.5.3"},
    {24623, 24624, 1, kAll, false,  P::polar_axis,              whole<0, 32>,      "0; number of the axis", "G112: linear axis (0 = the first), rotary axis (0 = the first that turns)", "4.6"},
    {27308, 27308, 1, kAll, false,  P::stitch_signals,          whole<0, 1>,       "0, 1", "G63.1: 1 each stitch is asked of the head by PPF (#7531) and waited for, PPE (#7030), NPFIN (#7031)", "15.6"},
    {27321, 27327, 1, kAll, false,  P::stitch_length,           at_least_0,        "mm", "G63.1: ends of the ranges of lengths", "15.6"},
    {27328, 27335, 1, kAll, false,  P::stitch_feed,             at_least_0,        "0 any; mm/min", "G63.1: feed of the first axis in each range", "15.6"},
    {27336, 27343, 1, kAll, false,  P::stitch_wait,             at_least_0,        "ms", "G63.1: wait behind a move of the first axis in each range", "15.6"},
    {27344, 27351, 1, kAll, false,  P::stitch_feed_2,           at_least_0,        "0 any; mm/min", "G63.1: feed of the second axis in each range", "15.6"},
    {27352, 27359, 1, kAll, false,  P::stitch_wait_2,           at_least_0,        "ms", "G63.1: wait behind a move of the second axis in each range", "15.6"},
    {27374, 27381, 1, kAll, false,  P::stitch_call,             at_least_0,        "ms", "G63.1: from the end of a move of the first axis to PPF, in each range", "15.6"},
    {27382, 27389, 1, kAll, false,  P::stitch_call_2,           at_least_0,        "ms", "G63.1: from the end of a move of the second axis to PPF, in each range", "15.6"},
    {27391, 27393, 1, kAll, false,  P::none,                    kOffOnly,          "0", "times of PPF outside of G63.1 and at its start; only 0 is taken", "15.6"},
    {27394, 27394, 1, kAll, false,  P::stitch_next,             at_least_0,        "ms", "G63.1: from NPFIN to the next move", "15.6"},
    {27395, 27395, 1, kAll, false,  P::stitch_release,          at_least_0,        "ms", "G63.1: from PPE to the end of PPF", "15.6"},
    {27408, 27408, 1, kAll, false,  P::stitch_longest,          at_least_0,        "0 any; mm", "G63.1: longest stitch", "15.6"},
};
// clang-format on

constexpr ParameterPlaces kPlaces = places_of(kNumbers);

// 14.2.3: the manual has it so without a parameter, and no host is told so of a family.
constexpr ParameterName kNames[] = {
    {"power_off_clears_common", P::power_off_clears_common, 0, 0, nullptr, "0, 1", "power off clears #100 to #199 (in ncrtd)", "14.2.3", whole<0, 1>},
};

// What other families have a parameter for and this one does not.
constexpr FixedParameter kFixed[] = {
    {P::tool_memory_type, 2},         // 13.1.2: H and D, a column each
    {P::clamp_command_always, 1},     // 9.3: S of G92 is the limit of G96 and no speed
    {P::clamp_in_surface_speed, 1},
    {P::system_codes_call, 1},        // 14.1.3 (2): G01 to G255
    {P::hypothetical_by_name, 1},     // 4.6: the second axis is C
};

template <class T, unsigned count>
constexpr Table<T> table(const T (&rows)[count]) {
  return {rows, count};
}

}  // namespace

constinit const FamilyParameters kParameters = {
    .numbers = table(kNumbers),
    .places = &kPlaces,
    .names = table(kNames),
    .fixed = table(kFixed),
    .arc_tolerance_mm = 0.01,     // docs/decisions.md
    .checks_interference = true,  // 13.2.2
};

}  // namespace nc::hx
