// SPDX-License-Identifier: Apache-2.0
// The parameters of the m700 family that the control uses.
#include <cmath>

#include "dialect/m700/tables.hpp"

namespace nc::m700 {
namespace {

using P = Parameter;

constexpr int8_t kAll = -1;
constexpr const char* kOffOn = "0, 1";

// Each of these functions tells whether a parameter can have a value.
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
/// 0, which says that there is none, or one of these.
template <int low, int high>
bool none_or(double value) {
  return value == 0 || whole<low, high>(value);
}
/// A number of a program, of a variable, or a kind of call.
bool program(double value) { return whole<0, 99999999>(value); }
bool minute_length(double value) { return value >= 0 || value == -1; }  // -1: no block is too long (13.18)
bool below_100000(double value) { return value >= 0 && value < 100000; }
bool below_million(double value) { return std::fabs(value) < 1000000; }
bool unit_letter(double value) { return whole<'B', 'E'>(value); }
bool command_unit(double value) { return value == 0 || value == 10 || value == 100 || value == 1000 || value == 10000; }

// clang-format off
constexpr ParameterRow kNumbers[] = {
    {1003, 1003, 1, kAll, false,      P::setting_unit,               unit_letter,           "B, C, D, E", "setting unit: 1, 0.1, 0.01, 0.001 um (0.1 um ... inch)", "2.1"},
    {1015, 1015, 1, kAll, true,       P::command_unit,               command_unit,          "setting unit; 10 ... 10000", "command unit, in 0.1 um", "2.1"},
    {1025, 1025, 1, kAll, false,      P::start_plane,                whole<1, 3>,           "1, 2, 3", "plane at power on: G17, G18, G19", "6.3"},
    {1026, 1028, 1, kAll, false,      P::plane_axis,                 any,                   "X, Y, Z", "axes of I, J, K in the plane selection", "6.3"},
    {1029, 1031, 1, kAll, false,      P::parallel_axis,              any,                   "none, an axis", "axes parallel to those, also for drilling and length compensation", "6.3"},
    {1037, 1037, 1, kAll, false,      P::tool_memory_type,           whole<1, 2>,           "1, 2", "memory type of tool offsets", "12.1"},
    {1041, 1041, 1, kAll, false,      P::initial_inch,               whole<0, 1>,           kOffOn, "offsets and parameters are read and written by programs in inch", "2.1"},
    {1073, 1073, 1, kAll, false,      P::start_absolute,             whole<0, 1>,           "0 G91, 1 G90", "absolute values at power on", "5.1"},
    {1074, 1074, 1, kAll, false,      P::start_synchronous,          whole<0, 1>,           kOffOn, "synchronous feed G95 at power on", "7.4"},
    {1078, 1078, 1, kAll, false,      P::decimal_type_2,             whole<0, 1>,           kOffOn, "decimal point type II: a number without a point is in mm", "5.3"},
    {1079, 1079, 1, kAll, false,      P::feed_by_digit,              whole<0, 1>,           kOffOn, "F1-digit feed", "7.3"},
    {1080, 1080, 1, kAll, false,      P::drilling_axis_z,            whole<0, 1>,           kOffOn, "drilling axis and length compensation are always Z", "12.2"},
    {1081, 1081, 1, kAll, false,      P::system_codes_call,          whole<0, 1>,           kOffOn, "G codes of the control may call a macro, too", "13.5.2"},
    {1084, 1084, 1, kAll, false,      P::arc_tolerance,              between<0, 1>,         "mm", "difference of an arc's radii that is corrected", "6.4"},
    {1085, 1085, 1, kAll, false,      P::rapid_dry,                  whole<0, 1>,           kOffOn, "in dry run rapid traverse goes at the manual feed rate, too", "13.1.1"},
    {1086, 1086, 1, kAll, false,      P::rapid_by_axis,              whole<0, 1>,           kOffOn, "rapid traverse without interpolation: other axes do not wait for the clamp of a table", "6.1"},
    {1092, 1092, 1, kAll, true,       P::tool_change_axis,           whole<0, 1>,           kOffOn, "the axis takes part in the return to the tool change position", "13.13"},
    {1103, 1103, 1, kAll, false,      P::life_managed,               whole<0, 1>,           kOffOn, "tool life management: T selects tools of groups, their lives are counted", "10.15"},
    {1104, 1104, 1, kAll, false,      P::life_by_tool,               whole<0, 1>,           kOffOn, "with it T is the number of a tool, at 0 that of a group", "10.15"},
    {1109, 1109, 1, kAll, false,      P::interrupt_own_m,            whole<0, 1>,           kOffOn, "#1110 and #1111 hold", "13.12"},
    {1110, 1110, 1, kAll, false,      P::interrupt_on_m,             whole<3, 97>,          "96; 3-97", "M code that allows the macro interrupt", "13.12"},
    {1111, 1111, 1, kAll, false,      P::interrupt_off_m,            whole<3, 97>,          "97; 3-97", "M code that ends it", "13.12"},
    {1112, 1112, 1, kAll, false,      P::interrupt_by_level,         whole<0, 1>,           kOffOn, "the interrupt signal counts as long as it is on, not when it rises", "13.12"},
    {1113, 1113, 1, kAll, false,      P::interrupt_type_2,           whole<0, 1>,           kOffOn, "the interrupt comes at the end of the block (type 2)", "13.12"},
    {1121, 1121, 1, kAll, false,      P::edit_lock_c,              whole<0, 1>,           kOffOn, "programs 9000-9999 are protected", "13.3"},
    {1128, 1128, 1, kAll, false,      P::reset_clears_common,        whole<0, 1>,           kOffOn, "reset clears the common variables from #100 on", "13.4"},
    {1129, 1129, 1, kAll, false,      P::power_off_clears_common,    whole<0, 1>,           kOffOn, "power off clears them (in ncrtd)", "13.4"},
    {1146, 1146, 1, kAll, false,      P::clamp_command_always,       whole<0, 1>,           kOffOn, "G92 S is a clamp in G97, too", "10.4"},
    {1148, 1148, 1, kAll, false,      P::start_high_accuracy,        whole<0, 1>,           kOffOn, "high-accuracy control G61.1 at power on", "13.15"},
    {1149, 1149, 1, kAll, false,      P::arc_joint_clamp,            whole<0, 1>,           kOffOn, "speed is clamped where an arc begins or ends (#1209)", "13.15"},
    {1152, 1152, 1, kAll, false,      P::start_inch,                 whole<0, 1>,           kOffOn, "inch at power on", "5.2"},
    {1172, 1172, 1, kAll, false,      P::tap_return_override,        whole<0, 999>,         "100; %", "synchronous tap: speed of the way back in % of S; 0: 100 %; not beside ,S", "13.1.1"},
    {1173, 1173, 1, kAll, false,      P::dwell_skip,                 whole<0, 255>,         "0-255", "skip signals that end a dwell, one bit each", "8.1"},
    {1174, 1174, 1, kAll, false,      P::skip_feed,                  at_least_0,            "mm/min", "feed of G31", "15.2"},
    {1175, 1179, 2, kAll, false,      P::multi_skip_signals,         whole<0, 255>,         "0-255", "skip signals of G31.1, G31.2, G31.3, one bit each", "15.3"},
    {1176, 1180, 2, kAll, false,      P::multi_skip_feed,            at_least_0,            "mm/min", "feeds of G31.1, G31.2, G31.3", "15.3"},
    {1181, 1181, 1, kAll, false,      P::surface_axis,               whole<0, 3>,           "0; 1-3", "axis of constant surface speed; 0: always the first", "10.3"},
    {1185, 1189, 1, kAll, false,      P::digit_feed,                 between<0, 10000000>,  "mm/min", "feeds F1 to F5", "7.3"},
    {1193, 1193, 1, kAll, false,      P::checks_position,            whole<0, 1>,           kOffOn, "deceleration check waits for the position", "7.9"},
    {1195, 1198, 1, kAll, false,      P::words_call,                 whole<0, 1>,           "1, 0", "M, S, T, second auxiliary function may call a macro", "13.5.2"},
    {1205, 1205, 1, kAll, false,      P::rapid_before,               whole<0, 1>,           kOffOn, "rapid traverse is accelerated before interpolation; one part system only", "13.15"},
    {1206, 1206, 1, kAll, false,      P::accuracy_speed,             at_least_0,            "mm/min", "speed of the acceleration before interpolation", "13.15"},
    {1207, 1207, 1, kAll, false,      P::accuracy_time,              at_least_0,            "ms", "its time", "13.15"},
    {1209, 1209, 1, kAll, false,      P::arc_joint_speed,            at_least_0,            "mm/min", "speed where an arc begins or ends (#1149)", "13.15"},
    {1210, 1210, 1, 11, false,        P::keeps_polar_command,        any,                   kOffOn, "reset keeps the polar coordinate command G16", "6.12"},
    {1210, 1210, 1, 19, false,        P::keeps_clamp,                any,                   kOffOn, "reset keeps the clamp of the spindle speed", "10.4"},
    {1223, 1223, 1, 1, false,         P::checks_cutting,             any,                   kOffOn, "G01 with G09 or G61 waits for the position", "7.9"},
    {1223, 1223, 1, 2, false,         P::tap_check_approach,         any,                   kOffOn, "synchronous tap with P: in-position check at R on the way in (with bit 3)", "13.1.1"},
    {1223, 1223, 1, 3, false,         P::tap_checks,                 any,                   kOffOn, "synchronous tap: in-position checks by bits 2, 4, 5", "13.1.1"},
    {1223, 1223, 1, 4, false,         P::tap_check_bottom,           any,                   kOffOn, "the same at the bottom", "13.1.1"},
    {1223, 1223, 1, 5, false,         P::tap_check_r,                any,                   kOffOn, "the same at R on the way back", "13.1.1"},
    {1227, 1227, 1, 5, false,         P::clamp_in_surface_speed,     any,                   kOffOn, "the spindle speed is clamped in G96 only", "10.4"},
    {1229, 1229, 1, 0, false,         P::interrupt_as_sub,           any,                   kOffOn, "the interrupt program is a sub program, not a macro", "13.12"},
    {1229, 1229, 1, 1, false,         P::precision_lead,             any,                   kOffOn, "E of G33 is a lead, not ridges per inch", "6.7"},
    {1229, 1229, 1, 2, false,         P::comp_type_b,                any,                   kOffOn, "radius compensation starts and ends by type B", "12.4"},
    {1229, 1229, 1, 4, false,         P::tap_synchronous,            any,                   kOffOn, "taps without ,R are synchronous", "13.1.1"},
    {1235, 1235, 1, 0, false,         P::helix_plane_feed,           any,                   kOffOn, "F of a helix is the speed in the plane of its arc", "6.6"},
    {1267, 1267, 1, 0, false,         P::code_type,                  any,                   "G61.1 and G92.1, and the high-speed codes, exist; 0, 1", "G code type: G61.1 (0), G05 P10000 and G92.1 (1)", "3.7"},
    {1272, 1272, 1, 1, false,         P::tap_by_code,                any,                   kOffOn, "the M code of #1513 makes taps synchronous", "13.1.1"},
    {1272, 1272, 1, 2, false,         P::spiral_type_2,              any,                   kOffOn, "spiral of type 2", "6.13"},
    {1272, 1272, 1, 4, false,         P::tap_to_r,                   any,                   kOffOn, "taps with Q go back to R between their cuts", "13.1.1"},
    {1273, 1273, 1, 0, false,         P::asin_0_360,                 any,                   kOffOn, "ASIN gives 0 to 360 degrees", "13.5.6"},
    {1273, 1273, 1, 1, false,         P::run_time_hours,             any,                   kOffOn, "#3002 counts hours", "13.5.5"},
    {1303, 1303, 1, kAll, false,      P::last_shared_of_first,       none_or<100, 199>,     "none; 100-199", "last of the variables from #100 that part systems share", "13.4"},
    {1304, 1304, 1, kAll, false,      P::last_shared_of_second,      none_or<500, 999>,     "all; 500-999", "last of the variables from #500 that part systems share", "13.4"},
    {1306, 1306, 1, kAll, false,      P::one_position_check,         whole<0, 1>,           kOffOn, "#1193 holds for cutting, too", "7.9"},
    {1313, 1313, 1, kAll, false,      P::tap_dwell,                  between<0, 999999>,    "0; ms", "synchronous tap: least time at the bottom (#1223 bit 3)", "13.1.1"},
    {1503, 1503, 1, kAll, false,      P::checks_reversal,            whole<0, 1>,           kOffOn, "G01 checks the deceleration where an axis turns back", "7.9"},
    {1506, 1506, 1, kAll, false,      P::digit_most,                 at_least_0,            "mm/min", "F1-digit: largest feed", "7.3"},
    {1507, 1507, 1, kAll, false,      P::digit_divisions,            whole<1, 32767>,       "1-32767", "F1-digit: pulses of the handle from 0 to that", "7.3"},
    {1513, 1513, 1, kAll, false,      P::tap_code,                   whole<0, 99999999>,    "0; M code", "M code that makes taps synchronous (#1272 bit 1)", "13.1.1"},
    {1514, 1515, 1, kAll, false,      P::exponential_axis,           any,                   "an axis", "linear and rotary axis of exponential interpolation", "6.11"},
    {1516, 1516, 1, kAll, false,      P::mill_axis,                  any,                   "an axis", "rotary axis of cylindrical and polar coordinate interpolation", "6.9"},
    {1517, 1517, 1, kAll, false,      P::hypothetical_by_name,       whole<0, 1>,           kOffOn, "the hypothetical axis of G12.1 has the rotary axis' own name", "6.10"},
    {1533, 1533, 1, kAll, false,      P::polar_linear_axis,          any,                   "an axis", "linear axis of polar coordinate interpolation", "6.10"},
    {1568, 1569, 1, kAll, false,      P::pattern_filter,             between<0, 200>,       "0; 0-200 ms", "S-pattern filter of cuts and of rapid traverse in high-accuracy control", "13.15"},
    {1570, 1570, 1, kAll, false,      P::pattern_second,             between<0, 200>,       "0; 0-200 ms", "a second one behind it", "13.15"},
    {2004, 2004, 1, kAll, true,       P::rapid_linear,               between<0, 4000>,      "0; ms", "rapid traverse: linear acceleration after interpolation", "7.7"},
    {2005, 2005, 1, kAll, true,       P::rapid_exponential,          between<0, 5000>,      "0; ms", "rapid traverse: exponential acceleration after interpolation", "7.7"},
    {2007, 2007, 1, kAll, true,       P::cut_linear,                 between<0, 4000>,      "0; ms", "cutting: linear acceleration after interpolation", "13.15"},
    {2008, 2008, 1, kAll, true,       P::cut_exponential,            between<0, 5000>,      "0; ms", "cutting: exponential acceleration after interpolation", "13.15"},
    {2031, 2031, 1, kAll, true,       P::no_reference,               whole<0, 1>,           kOffOn, "an axis that is a spindle too needs no reference position return", "10.5"},
    {2037, 2040, 1, kAll, true,       P::reference_position,         any,                   "mm", "reference positions 1 to 4", "14.3"},
    {2069, 2069, 1, kAll, true,       P::arc_radius_shift,           between<-1, 1>,        "0; mm", "arcs are moved outwards by this (#8107 and #8108)", "13.15"},
    {2076, 2076, 1, kAll, true,       P::index_axis,                 whole<0, 1>,           kOffOn, "axis of an index table", "9.3"},
    {2096, 2096, 1, kAll, true,       P::corner_least_speed,         at_least_0,            "mm/min", "least speed at a corner", "13.15"},
    {2102, 2102, 1, kAll, true,       P::skip_linear,                between<0, 4000>,      "0; ms", "skip: linear acceleration after interpolation", "15.5"},
    {2103, 2103, 1, kAll, true,       P::skip_exponential,           between<0, 5000>,      "0; ms", "skip: exponential acceleration after interpolation", "15.5"},
    {2106, 2106, 1, kAll, true,       P::index_increment,            between<0, 360>,       "0; deg", "indexing increment that positions must be multiples of", "2.3"},
    {2109, 2110, 1, kAll, true,       P::accuracy_clamp,             at_least_0,            "mm/min", "rapid rate and clamp of the cutting feed in high-accuracy control", "13.15"},
    {3005, 3045, 40, kAll, false,     P::spindle_most,               at_least_0,            "none; r/min, ms", "highest speed of the spindle, and time of the third stage of a synchronous tap, which goes up to it (gear 1)", "13.1.1"},
    {3013, 3037, 24, kAll, false,     P::tap_speed,                  at_least_0,            "none; r/min", "synchronous tap: speeds where the first and the second stage of acceleration end (gear 1)", "13.1.1"},
    {3017, 3041, 24, kAll, false,     P::tap_time,                   between<0, 5000>,      "none; ms", "synchronous tap: times of these stages", "13.1.1"},
    {3028, 3028, 1, kAll, false,      P::spindle_forward_code,       whole<0, 99999998>,    "0; M code", "M code of the spindle forward in taps, its successor is reverse; 0: M3, M4", "13.1.1"},
    {7001, 7091, 10, kAll, false,     P::m_call_code,                whole<0, 9999>,        "9999; M code", "M codes that call a macro", "13.5.2"},
    {7002, 7092, 10, kAll, false,     P::m_call_type,                whole<0, 3>,           "0; 1-3", "how: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7003, 7093, 10, kAll, false,     P::m_call_program,             program,               "program", "which program", "13.5.2"},
    {7102, 7102, 1, kAll, false,      P::second_aux_call_type,       whole<0, 3>,           "0; 1-3", "how the second auxiliary function calls: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7103, 7103, 1, kAll, false,      P::second_aux_call_program,    program,               "program", "which program", "13.5.2"},
    {7201, 7291, 10, kAll, false,     P::g_call_code,                between<0, 9999>,      "9999; G code", "G codes that call a macro", "13.5.2"},
    {7202, 7292, 10, kAll, false,     P::g_call_type,                whole<0, 3>,           "0; 1-3", "how: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7203, 7293, 10, kAll, false,     P::g_call_program,             program,               "program", "which program", "13.5.2"},
    {7302, 7302, 1, kAll, false,      P::s_call_type,                whole<0, 3>,           "0; 1-3", "how S calls: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7303, 7303, 1, kAll, false,      P::s_call_program,             program,               "program", "which program", "13.5.2"},
    {7312, 7312, 1, kAll, false,      P::t_call_type,                whole<0, 3>,           "0; 1-3", "how T calls: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7313, 7313, 1, kAll, false,      P::t_call_program,             program,               "program", "which program", "13.5.2"},
    {7401, 7411, 10, kAll, false,     P::ascii_call_on,              whole<0, 1>,           kOffOn, "the ASCII code macro is in force", "13.5.3"},
    {7402, 7412, 10, kAll, false,     P::ascii_call_letter,          whole<0, 255>,         "character code", "its letter", "13.5.3"},
    {7403, 7413, 10, kAll, false,     P::ascii_call_type,            whole<0, 3>,           "0; 1-3", "how: M98 (0), G65, G66, G66.1", "13.5.3"},
    {7404, 7414, 10, kAll, false,     P::ascii_call_program,         program,               "program", "which program", "13.5.3"},
    {7405, 7415, 10, kAll, false,     P::ascii_call_variable,        program,               "variable", "where the value goes", "13.5.3"},
    {8004, 8004, 1, kAll, false,      P::measure_feed,               at_least_0,            "mm/min", "G37: measuring feed", "15.1"},
    {8005, 8005, 1, kAll, false,      P::measure_deceleration,       at_least_0,            "mm", "G37: distance from which on it is in force", "15.1"},
    {8006, 8006, 1, kAll, false,      P::measure_range,              at_least_0,            "mm", "G37: range around the point where the tool may be", "15.1"},
    {8007, 8007, 1, kAll, false,      P::corner_override,            between<0, 100>,       "0-100 %", "G62: feed in corners", "7.10"},
    {8008, 8008, 1, kAll, false,      P::corner_override_angle,      between<0, 180>,       "0-180 deg", "G62: largest inner angle", "7.10"},
    {8009, 8009, 1, kAll, false,      P::corner_override_zone,       between<0, 99999>,     "mm", "G62: way in front of the corner", "7.10"},
    {8012, 8012, 1, kAll, false,      P::step_clearance,             at_least_0,            "0; mm", "G73: way back after each cut", "13.1.1"},
    {8013, 8013, 1, kAll, false,      P::peck_clearance,             at_least_0,            "0; mm", "G83: distance from the last bottom where rapid ends", "13.1.1"},
    {8018, 8018, 1, kAll, false,      P::tap_clearance,              at_least_0,            "0; mm", "G84, G74 with Q: way back after each cut", "13.1.1"},
    {8019, 8019, 1, kAll, false,      P::radius_percent,             between<-1000, 99>,    "0; -1000 to 99 %", "accuracy coefficient of arcs, or of all", "13.15"},
    {8020, 8020, 1, kAll, false,      P::corner_angle,               between<0, 180>,       "deg", "angle from which on a corner is one", "13.15"},
    {8021, 8021, 1, kAll, false,      P::separate_percents,          whole<0, 1>,           kOffOn, "corners and curves have coefficients of their own", "13.15"},
    {8022, 8023, 1, kAll, false,      P::corner_percent,             between<-1000, 99>,    "0; -1000 to 99 %", "accuracy coefficients of corners and of curves", "13.15"},
    {8025, 8025, 1, kAll, false,      P::spline_allowed,             whole<0, 1>,           kOffOn, "spline G05.1 Q2 exists", "13.18"},
    {8026, 8026, 1, kAll, false,      P::spline_cancel_angle,        between<0, 180>,       "0; deg", "angle at which a spline ends", "13.18"},
    {8027, 8028, 1, kAll, false,      P::spline_tolerance,           at_least_0,            "0; mm", "tolerances of its revision", "13.18"},
    {8029, 8029, 1, kAll, false,      P::fairing_length,             between<0, 100>,       "0; mm", "fairing: lines that are shorter are left out where they protrude", "13.17"},
    {8030, 8030, 1, kAll, false,      P::spline_minute_length,       minute_length,      "1 mm", "length of a block that is too short to end a spline", "13.18"},
    {8033, 8033, 1, kAll, false,      P::fairing,                    whole<0, 1>,           kOffOn, "fairing in high-speed high-accuracy control II (#8029)", "13.17"},
    {8034, 8034, 1, kAll, false,      P::acceleration_clamp,         whole<0, 1>,           kOffOn, "acceleration clamp of fine segments", "13.17"},
    {8036, 8036, 1, kAll, false,      P::corner_judgement,           whole<0, 1>,           kOffOn, "corners are judged without short lines (#8037)", "13.17"},
    {8037, 8037, 1, kAll, false,      P::judgement_length,           below_100000,          "0; mm", "lines that are shorter do not count there", "13.17"},
    {8071, 8071, 1, kAll, false,      P::space_divisor,              between<0, 100000>,    "0; mm", "what divides I J K of three-dimensional radius compensation instead of their length; 0 = that", "12.5"},
    {8072, 8072, 1, kAll, false,      P::scaling_factor,             any,                   "1", "scaling factor of G51 without P", "13.19"},
    {8075, 8075, 1, kAll, false,      P::spiral_tolerance,           at_least_0,            "0.1 mm", "how far the end of a spiral may lie from its curve", "6.13"},
    {8090, 8090, 1, kAll, false,      P::smooth_control,             whole<0, 1>,           kOffOn, "SSS control with G05 P10000", "13.17"},
    {8101, 8101, 1, kAll, false,      P::macro_single,               whole<0, 1>,           kOffOn, "single block stops at macro statements", "13.5.9"},
    {8102, 8102, 1, kAll, false,      P::interference_avoided,       whole<0, 1>,           kOffOn, "interference of radius compensation is avoided, not an alarm", "12.4.8"},
    {8103, 8103, 1, kAll, false,      P::interference_ignored,       whole<0, 1>,           kOffOn, "no interference check", "12.4.8"},
    {8105, 8105, 1, kAll, false,      P::edit_lock_b,              whole<0, 1>,           kOffOn, "programs 8000-9999 are protected", "13.3"},
    {8107, 8107, 1, kAll, false,      P::arc_compensation,           whole<0, 1>,           kOffOn, "circular error radius compensation in every mode: #8108 is asked for", "13.15"},
    {8108, 8108, 1, kAll, false,      P::arc_compensation_by_axis,   whole<0, 1>,           kOffOn, "circular error radius compensation for each axis (#2069), with #8107", "13.15"},
    {8112, 8112, 1, kAll, false,      P::dwell_p_decimal,            whole<0, 1>,           kOffOn, "P of G04 may have a decimal point", "8.1"},
    {8117, 8117, 1, kAll, false,      P::diameter_offsets,           whole<0, 1>,           kOffOn, "tool radius offsets are diameters", "12.4"},
    {8206, 8206, 1, kAll, true,       P::tool_change_position,       any,                   "mm", "tool change position", "13.13"},
    {8207, 8207, 1, kAll, true,       P::shift_ignored,              whole<0, 1>,           kOffOn, "G76, G87 with Q: no shift of the axis (#1080)", "13.1.1"},
    {8208, 8208, 1, kAll, true,       P::shift_minus,                whole<0, 1>,           kOffOn, "G76, G87 with Q: the shift is towards minus", "13.1.1"},
    {8209, 8209, 1, kAll, true,       P::creep,                      any,                   "mm", "G60: way in front of the position; its sign is the direction", "6.8"},
    {8211, 8211, 1, kAll, true,       P::mirrored,                   whole<0, 1>,           kOffOn, "programs are mirrored in the axis, about where it stands at their start", "13.6"},
    {8213, 8213, 1, kAll, true,       P::rotary_type,                whole<0, 3>,           "3; 0-3", "type of a rotary axis", "14.13"},
    {8621, 8622, 1, kAll, false,      P::work_turn_axis,             any,                   "first, second axis; an axis", "rotation of the workpiece coordinates: its plane", "13.21"},
    {8623, 8624, 1, kAll, false,      P::work_turn_center,           below_million,         "0; mm", "its centre, machine coordinates", "13.21"},
    {8625, 8626, 1, kAll, false,      P::work_turn_vector,           below_million,         "0; mm", "its direction as G10 I J gave it; the angle is what counts", "13.21"},
    {8627, 8627, 1, kAll, false,      P::work_turn_angle,            between<-360, 360>,    "0; deg", "its angle, from the next cycle start on", "13.21"},
    {9115, 9515, 100, kAll, false,    P::parity_unit,                whole<0, 1>,           kOffOn, "parity V of input devices 1 to 5", "3.6"},
};
// clang-format on

constexpr ParameterPlaces kPlaces = places_of(kNumbers);

/// Each meaning has one row only, because the control finds a parameter by its meaning.
constexpr bool rows_differ() {
  for (const ParameterRow& row : kNumbers)
    if (&kNumbers[kPlaces.row[static_cast<unsigned>(row.what)] - 1] != &row) return false;
  return true;
}
static_assert(rows_differ());

// Parameters for which the manual gives no number: UNIT*10 is only named (2.2), the blanks of DPRNT are "a parameter" (13.5.8), and the M codes that
// prohibit pre-reading and the order of M S T B and motion are left to the machine (4.2, 9.1). macro_extensions and negative_count are options
// (docs/macros.md), and comments behind ';' exist only in other families.
constexpr ParameterName kNames[] = {
    {"UNIT*10", P::tenfold, 0, 1, nullptr, "1; 1-10000", "numbers without a point, times this", "2.2", whole<1, 10000>},
    {"DPRNT_BLANK", P::print_blanks, 0, 0, nullptr, "0, 1", "DPRNT prints blanks for leading zeros", "13.5.8", whole<0, 1>},
    {"macro_extensions", P::macro_extensions, 0, 0, nullptr, "0, 1", "IF ... THEN of later models", "13.5.7", whole<0, 1>},
    {"semicolon_comments", P::semicolon_comments, 0, 0, nullptr, "0, 1", "what stands behind ';' in a line is a comment, not P33", "3.2", whole<0, 1>},
    {"negative_count", P::negative_count, 0, 0, nullptr, "0, 1", "#3901 can be set below 0", "13.5.5", whole<0, 1>},
    {"corner_ii", P::corner_arcs, 0, 0, nullptr, "0, 1", "option: ,C and ,R beside arcs are cut, not P381", "13.7", whole<0, 1>},
    {"CONTOUR_CHECK", P::contour_checked, 0, 0, nullptr, "0, 1", "radius compensation that would cut into any block of the contour is P153 (#8103 off)", "12.4.8", whole<0, 1>},
    {"MSTB_AFTER_MOTION", P::codes_after_motion, 0, 0, nullptr, "0, 1", "M S T B of a block come after its movement", "9.1", whole<0, 1>},
    {"PREREAD_STOP_M1", P::reading_stop, 0, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M2", P::reading_stop, 1, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M3", P::reading_stop, 2, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M4", P::reading_stop, 3, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M5", P::reading_stop, 4, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M6", P::reading_stop, 5, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M7", P::reading_stop, 6, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
    {"PREREAD_STOP_M8", P::reading_stop, 7, 0, nullptr, "0; 1-99999999", "M code that prohibits reading ahead", "4.2", whole<0, 99999999>},
};

// 13.5.5 (10.16): the manual's own example is axisno; axname and rot are the parameters beside it.
constexpr MachineParameter kMachine[] = {{1001, MachineDatum::system_used}, {1002, MachineDatum::axis_count}, {1013, MachineDatum::axis_name}, {1017, MachineDatum::rotary}};

// 13.11, note 3: the parameters of axes. For all other parameters the word A, which chooses the axis, has no effect.
constexpr NumberRange kOfAxes[] = {{1013, 1013}, {1015, 1015}, {2000, 2299}, {8200, 8299}};

template <class T, unsigned count>
constexpr Table<T> table(const T (&rows)[count]) {
  return {rows, count};
}

}  // namespace

constinit const FamilyParameters kParameters = {
    .numbers = table(kNumbers),
    .places = &kPlaces,
    .names = table(kNames),
    .machine = table(kMachine),
    .there = {1001, 19999},
    .of_axes = table(kOfAxes),
    .locked_programs = {{8000, 9999}, {9000, 9999}},  // 13.3, #8105 edit lock B, #1121 edit lock C
    .arc_tolerance_mm = 0.1,      // 6.4, #1084 RadErr
    .checks_interference = true,  // 12.6
};

}  // namespace nc::m700
