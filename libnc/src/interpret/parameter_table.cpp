// SPDX-License-Identifier: Apache-2.0
#include "interpret/parameter_table.hpp"

#include <cmath>
#include <cstring>

#include "nc/control.h"

namespace nc {
namespace {

constexpr int8_t kAll = -1;
constexpr const char* kOffOn = "0, 1";

// What a parameter can be.
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
bool below_100000(double value) { return value >= 0 && value < 100000; }
bool below_million(double value) { return std::fabs(value) < 1000000; }
bool unit_letter(double value) { return whole<'B', 'E'>(value); }
bool command_unit(double value) { return value == 0 || value == 10 || value == 100 || value == 1000 || value == 10000; }

// clang-format off
constexpr ParameterRow kRows[] = {
    {1003, 1003, 1, kAll, false, unit_letter,          "B, C, D, E",              "setting unit: 1, 0.1, 0.01, 0.001 um (0.1 um ... inch)", "2.1"},
    {1015, 1015, 1, kAll, true,  command_unit,         "setting unit; 10 ... 10000", "command unit, in 0.1 um", "2.1"},
    {1025, 1025, 1, kAll, false, whole<1, 3>,          "1, 2, 3",                 "plane at power on: G17, G18, G19", "6.3"},
    {1026, 1028, 1, kAll, false, any,                  "X, Y, Z",                 "axes of I, J, K in the plane selection", "6.3"},
    {1029, 1031, 1, kAll, false, any,                  "none, an axis",           "axes parallel to those, also for drilling and length compensation", "6.3"},
    {1037, 1037, 1, kAll, false, whole<1, 2>,          "1, 2",                    "memory type of tool offsets", "12.1"},
    {1073, 1073, 1, kAll, false, whole<0, 1>,          "0 G91, 1 G90",            "absolute values at power on", "5.1"},
    {1074, 1074, 1, kAll, false, whole<0, 1>,          kOffOn,                    "synchronous feed G95 at power on", "7.4"},
    {1078, 1078, 1, kAll, false, whole<0, 1>,          kOffOn,                    "decimal point type II: a number without a point is in mm", "5.3"},
    {1079, 1079, 1, kAll, false, whole<0, 1>,          kOffOn,                    "F1-digit feed", "7.3"},
    {1080, 1080, 1, kAll, false, whole<0, 1>,          kOffOn,                    "drilling axis and length compensation are always Z", "12.2"},
    {1081, 1081, 1, kAll, false, whole<0, 1>,          kOffOn,                    "G codes of the control may call a macro, too", "13.5.2"},
    {1084, 1084, 1, kAll, false, between<0, 1>,        "mm",                      "difference of an arc's radii that is corrected", "6.4"},
    {1086, 1086, 1, kAll, false, whole<0, 1>,          kOffOn,                    "rapid traverse without interpolation: other axes do not wait for the clamp of a table", "6.1"},
    {1092, 1092, 1, kAll, true,  whole<0, 1>,          kOffOn,                    "the axis takes part in the return to the tool change position", "13.13"},
    {1109, 1109, 1, kAll, false, whole<0, 1>,          kOffOn,                    "#1110 and #1111 hold", "13.12"},
    {1110, 1110, 1, kAll, false, any,                  "96; 3-97",                "M code that allows the macro interrupt", "13.12"},
    {1111, 1111, 1, kAll, false, any,                  "97; 3-97",                "M code that ends it", "13.12"},
    {1112, 1112, 1, kAll, false, whole<0, 1>,          kOffOn,                    "the interrupt signal counts as long as it is on, not when it rises", "13.12"},
    {1113, 1113, 1, kAll, false, whole<0, 1>,          kOffOn,                    "the interrupt comes at the end of the block (type 2)", "13.12"},
    {1121, 1121, 1, kAll, false, whole<0, 1>,          kOffOn,                    "programs 9000-9999 are protected", "13.3"},
    {1128, 1128, 1, kAll, false, whole<0, 1>,          kOffOn,                    "reset clears the common variables from #100 on", "13.4"},
    {1129, 1129, 1, kAll, false, whole<0, 1>,          kOffOn,                    "power off clears them (in ncrtd)", "13.4"},
    {1146, 1146, 1, kAll, false, whole<0, 1>,          kOffOn,                    "G92 S is a clamp in G97, too", "10.4"},
    {1148, 1148, 1, kAll, false, whole<0, 1>,          kOffOn,                    "high-accuracy control G61.1 at power on", "13.15"},
    {1149, 1149, 1, kAll, false, whole<0, 1>,          kOffOn,                    "speed is clamped where an arc begins or ends (#1209)", "13.15"},
    {1152, 1152, 1, kAll, false, whole<0, 1>,          kOffOn,                    "inch at power on", "5.2"},
    {1173, 1173, 1, kAll, false, whole<0, 255>,        "0-255",                   "skip signals that end a dwell, one bit each", "8.1"},
    {1174, 1174, 1, kAll, false, at_least_0,           "mm/min",                  "feed of G31", "15.2"},
    {1175, 1179, 2, kAll, false, whole<0, 255>,        "0-255",                   "skip signals of G31.1, G31.2, G31.3, one bit each", "15.3"},
    {1176, 1180, 2, kAll, false, at_least_0,           "mm/min",                  "feeds of G31.1, G31.2, G31.3", "15.3"},
    {1181, 1181, 1, kAll, false, any,                  "0; 1-3",                  "axis of constant surface speed; 0: always the first", "10.3"},
    {1185, 1189, 1, kAll, false, between<0, 10000000>, "mm/min",                  "feeds F1 to F5", "7.3"},
    {1193, 1193, 1, kAll, false, whole<0, 1>,          kOffOn,                    "deceleration check waits for the position", "7.9"},
    {1195, 1198, 1, kAll, false, any,                  "1, 0",                    "M, S, T, second auxiliary function may call a macro", "13.5.2"},
    {1205, 1205, 1, kAll, false, whole<0, 1>,          kOffOn,                    "rapid traverse is accelerated before interpolation; one part system only", "13.15"},
    {1206, 1206, 1, kAll, false, at_least_0,           "mm/min",                  "speed of the acceleration before interpolation", "13.15"},
    {1207, 1207, 1, kAll, false, any,                  "ms",                      "its time", "13.15"},
    {1209, 1209, 1, kAll, false, at_least_0,           "mm/min",                  "speed where an arc begins or ends (#1149)", "13.15"},
    {1210, 1210, 1, 11,   false, any,                  kOffOn,                    "reset keeps the polar coordinate command G16", "6.12"},
    {1210, 1210, 1, 19,   false, any,                  kOffOn,                    "reset keeps the clamp of the spindle speed", "10.4"},
    {1223, 1223, 1, 1,    false, any,                  kOffOn,                    "G01 with G09 or G61 waits for the position", "7.9"},
    {1227, 1227, 1, 5,    false, any,                  kOffOn,                    "the spindle speed is clamped in G96 only", "10.4"},
    {1229, 1229, 1, 0,    false, any,                  kOffOn,                    "the interrupt program is a sub program, not a macro", "13.12"},
    {1229, 1229, 1, 1,    false, any,                  kOffOn,                    "E of G33 is a lead, not ridges per inch", "6.7"},
    {1229, 1229, 1, 2,    false, any,                  kOffOn,                    "radius compensation starts and ends by type B", "12.4"},
    {1235, 1235, 1, 0,    false, any,                  kOffOn,                    "F of a helix is the speed in the plane of its arc", "6.6"},
    {1267, 1267, 1, 0,    false, any,                  "G61.1 and G92.1, and the high-speed codes, exist; 0, 1", "G code type: G61.1 (0), G05 P10000 and G92.1 (1)", "3.7"},
    {1272, 1272, 1, 2,    false, any,                  kOffOn,                    "spiral of type 2", "6.13"},
    {1273, 1273, 1, 0,    false, any,                  kOffOn,                    "ASIN gives 0 to 360 degrees", "13.5.6"},
    {1273, 1273, 1, 1,    false, any,                  kOffOn,                    "#3002 counts hours", "13.5.5"},
    {1303, 1303, 1, kAll, false, any,                  "none; 100-199",           "last of the variables from #100 that part systems share", "13.4"},
    {1304, 1304, 1, kAll, false, any,                  "all; 500-999",            "last of the variables from #500 that part systems share", "13.4"},
    {1306, 1306, 1, kAll, false, whole<0, 1>,          kOffOn,                    "#1193 holds for cutting, too", "7.9"},
    {1503, 1503, 1, kAll, false, whole<0, 1>,          kOffOn,                    "G01 checks the deceleration where an axis turns back", "7.9"},
    {1506, 1506, 1, kAll, false, at_least_0,           "mm/min",                  "F1-digit: largest feed", "7.3"},
    {1507, 1507, 1, kAll, false, whole<1, 32767>,      "1-32767",                 "F1-digit: pulses of the handle from 0 to that", "7.3"},
    {1514, 1515, 1, kAll, false, any,                  "an axis",                 "linear and rotary axis of exponential interpolation", "6.11"},
    {1516, 1516, 1, kAll, false, any,                  "an axis",                 "rotary axis of cylindrical and polar coordinate interpolation", "6.9"},
    {1517, 1517, 1, kAll, false, whole<0, 1>,          kOffOn,                    "the hypothetical axis of G12.1 has the rotary axis' own name", "6.10"},
    {1533, 1533, 1, kAll, false, any,                  "an axis",                 "linear axis of polar coordinate interpolation", "6.10"},
    {1568, 1569, 1, kAll, false, between<0, 200>,      "0; 0-200 ms",             "S-pattern filter of cuts and of rapid traverse in high-accuracy control", "13.15"},
    {1570, 1570, 1, kAll, false, between<0, 200>,      "0; 0-200 ms",             "a second one behind it", "13.15"},
    {2004, 2004, 1, kAll, true,  between<0, 4000>,     "0; ms",                   "rapid traverse: linear acceleration after interpolation", "7.7"},
    {2005, 2005, 1, kAll, true,  between<0, 5000>,     "0; ms",                   "rapid traverse: exponential acceleration after interpolation", "7.7"},
    {2007, 2007, 1, kAll, true,  between<0, 4000>,     "0; ms",                   "cutting: linear acceleration after interpolation", "13.15"},
    {2008, 2008, 1, kAll, true,  between<0, 5000>,     "0; ms",                   "cutting: exponential acceleration after interpolation", "13.15"},
    {2031, 2031, 1, kAll, true,  whole<0, 1>,          kOffOn,                    "an axis that is a spindle too needs no reference position return", "10.5"},
    {2037, 2040, 1, kAll, true,  any,                  "mm",                      "reference positions 1 to 4", "14.3"},
    {2069, 2069, 1, kAll, true,  between<-1, 1>,       "0; mm",                   "arcs are moved outwards by this (#8107 and #8108)", "13.15"},
    {2076, 2076, 1, kAll, true,  whole<0, 1>,          kOffOn,                    "axis of an index table", "9.3"},
    {2096, 2096, 1, kAll, true,  at_least_0,           "mm/min",                  "least speed at a corner", "13.15"},
    {2102, 2102, 1, kAll, true,  between<0, 4000>,     "0; ms",                   "skip: linear acceleration after interpolation", "15.5"},
    {2103, 2103, 1, kAll, true,  between<0, 5000>,     "0; ms",                   "skip: exponential acceleration after interpolation", "15.5"},
    {2106, 2106, 1, kAll, true,  between<0, 360>,      "0; deg",                  "indexing increment that positions must be multiples of", "2.3"},
    {2109, 2110, 1, kAll, true,  at_least_0,           "mm/min",                  "rapid rate and clamp of the cutting feed in high-accuracy control", "13.15"},
    {7001, 7091, 10, kAll, false, any,                  "9999; M code",           "M codes that call a macro", "13.5.2"},
    {7002, 7092, 10, kAll, false, any,                  "0; 1-3",                 "how: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7003, 7093, 10, kAll, false, any,                  "program",                "which program", "13.5.2"},
    {7102, 7103, 1, kAll, false, any,                  "0-3, program",            "call by the second auxiliary function", "13.5.2"},
    {7201, 7291, 10, kAll, false, any,                  "9999; G code",           "G codes that call a macro", "13.5.2"},
    {7202, 7292, 10, kAll, false, any,                  "0; 1-3",                 "how: M98 (0), G65, G66, G66.1", "13.5.2"},
    {7203, 7293, 10, kAll, false, any,                  "program",                "which program", "13.5.2"},
    {7302, 7303, 1, kAll, false, any,                  "0-3, program",            "call by S", "13.5.2"},
    {7312, 7313, 1, kAll, false, any,                  "0-3, program",            "call by T", "13.5.2"},
    {7401, 7411, 10, kAll, false, whole<0, 1>,          kOffOn,                   "the ASCII code macro is in force", "13.5.3"},
    {7402, 7412, 10, kAll, false, any,                  "character code",         "its letter", "13.5.3"},
    {7403, 7413, 10, kAll, false, any,                  "0; 1-3",                 "how: M98 (0), G65, G66, G66.1", "13.5.3"},
    {7404, 7414, 10, kAll, false, any,                  "program",                "which program", "13.5.3"},
    {7405, 7415, 10, kAll, false, any,                  "variable",               "where the value goes", "13.5.3"},
    {8004, 8004, 1, kAll, false, at_least_0,           "mm/min",                  "G37: measuring feed", "15.1"},
    {8005, 8005, 1, kAll, false, any,                  "mm",                      "G37: distance from which on it is in force", "15.1"},
    {8006, 8006, 1, kAll, false, any,                  "mm",                      "G37: range around the point where the tool may be", "15.1"},
    {8007, 8007, 1, kAll, false, between<0, 100>,      "0-100 %",                 "G62: feed in corners", "7.10"},
    {8008, 8008, 1, kAll, false, between<0, 180>,      "0-180 deg",               "G62: largest inner angle", "7.10"},
    {8009, 8009, 1, kAll, false, between<0, 99999>,    "mm",                      "G62: way in front of the corner", "7.10"},
    {8012, 8012, 1, kAll, false, any,                  "0; mm",                   "G73: way back after each cut", "13.1.1"},
    {8013, 8013, 1, kAll, false, any,                  "0; mm",                   "G83: distance from the last bottom where rapid ends", "13.1.1"},
    {8019, 8019, 1, kAll, false, any,                  "0; %",                    "accuracy coefficient of arcs, or of all", "13.15"},
    {8020, 8020, 1, kAll, false, any,                  "deg",                     "angle from which on a corner is one", "13.15"},
    {8021, 8021, 1, kAll, false, whole<0, 1>,          kOffOn,                    "corners and curves have coefficients of their own", "13.15"},
    {8022, 8023, 1, kAll, false, any,                  "%",                       "accuracy coefficients of corners and of curves", "13.15"},
    {8025, 8025, 1, kAll, false, whole<0, 1>,          kOffOn,                    "spline G05.1 Q2 exists", "13.18"},
    {8026, 8026, 1, kAll, false, any,                  "0; deg",                  "angle at which a spline ends", "13.18"},
    {8027, 8028, 1, kAll, false, any,                  "0; mm",                   "tolerances of its revision", "13.18"},
    {8029, 8029, 1, kAll, false, between<0, 100>,      "0; mm",                   "fairing: lines that are shorter are left out where they protrude", "13.17"},
    {8030, 8030, 1, kAll, false, any,                  "1 mm",                    "length of a block that is too short to end a spline", "13.18"},
    {8033, 8033, 1, kAll, false, whole<0, 1>,          kOffOn,                    "fairing in high-speed high-accuracy control II (#8029)", "13.17"},
    {8034, 8034, 1, kAll, false, whole<0, 1>,          kOffOn,                    "acceleration clamp of fine segments", "13.17"},
    {8036, 8036, 1, kAll, false, whole<0, 1>,          kOffOn,                    "corners are judged without short lines (#8037)", "13.17"},
    {8037, 8037, 1, kAll, false, below_100000,         "0; mm",                   "lines that are shorter do not count there", "13.17"},
    {8072, 8072, 1, kAll, false, any,                  "1",                       "scaling factor of G51 without P", "13.19"},
    {8075, 8075, 1, kAll, false, any,                  "0.1 mm",                  "how far the end of a spiral may lie from its curve", "6.13"},
    {8090, 8090, 1, kAll, false, whole<0, 1>,          kOffOn,                    "SSS control with G05 P10000", "13.17"},
    {8101, 8101, 1, kAll, false, whole<0, 1>,          kOffOn,                    "single block stops at macro statements", "13.5.9"},
    {8102, 8102, 1, kAll, false, whole<0, 1>,          kOffOn,                    "interference of radius compensation is avoided, not an alarm", "12.6"},
    {8103, 8103, 1, kAll, false, whole<0, 1>,          kOffOn,                    "no interference check", "12.6"},
    {8105, 8105, 1, kAll, false, whole<0, 1>,          kOffOn,                    "programs 8000-9999 are protected", "13.3"},
    {8107, 8107, 1, kAll, false, whole<0, 1>,          kOffOn,                    "circular error radius compensation in every mode: #8108 is asked for", "13.15"},
    {8108, 8108, 1, kAll, false, whole<0, 1>,          kOffOn,                    "circular error radius compensation for each axis (#2069), with #8107", "13.15"},
    {8112, 8112, 1, kAll, false, whole<0, 1>,          kOffOn,                    "P of G04 may have a decimal point", "8.1"},
    {8117, 8117, 1, kAll, false, whole<0, 1>,          kOffOn,                    "tool radius offsets are diameters", "12.4"},
    {8206, 8206, 1, kAll, true,  any,                  "mm",                      "tool change position", "13.13"},
    {8209, 8209, 1, kAll, true,  any,                  "mm",                      "G60: way in front of the position; its sign is the direction", "6.8"},
    {8211, 8211, 1, kAll, true,  whole<0, 1>,          kOffOn,                    "programs are mirrored in the axis, about where it stands at their start", "13.6"},
    {8213, 8213, 1, kAll, true,  whole<0, 3>,          "3; 0-3",                  "type of a rotary axis", "14.13"},
    {8621, 8622, 1, kAll, false, any,                  "first, second axis; an axis", "rotation of the workpiece coordinates: its plane", "13.21"},
    {8623, 8624, 1, kAll, false, below_million,        "0; mm",                   "its centre, machine coordinates", "13.21"},
    {8625, 8626, 1, kAll, false, below_million,        "0; mm",                   "its direction as G10 I J gave it; the angle is what counts", "13.21"},
    {8627, 8627, 1, kAll, false, between<-360, 360>,   "0; deg",                  "its angle, from the next cycle start on", "13.21"},
    {9115, 9515, 100, kAll, false, whole<0, 1>,          kOffOn,                  "parity V of input devices 1 to 5", "3.6"},
};
// clang-format on

const ParameterRow* find_row(const ParameterKey& key) {
  for (const ParameterRow& row : kParameterTable) {
    if (key.number < row.first || key.number > row.last || (key.number - row.first) % row.step != 0) continue;
    if (row.bit < 0 || key.bit < 0 || row.bit == key.bit) return &row;
  }
  return nullptr;
}

}  // namespace

const Table<ParameterRow> kParameterTable = {kRows, sizeof kRows / sizeof kRows[0]};

bool parse_parameter_key(const char* text, ParameterKey* key) {
  const auto digits = [](const char* at, unsigned most, uint32_t* number) {
    unsigned count = 0;
    for (*number = 0; at[count] >= '0' && at[count] <= '9' && count < most; ++count)
      *number = *number * 10 + static_cast<uint32_t>(at[count] - '0');
    return count;
  };
  key->digits = digits(text, 6, &key->number);
  key->bit = -1;
  if (key->digits == 0) return false;
  const char* at = text + key->digits;
  if (*at == 0) return true;
  if (std::strncmp(at, "/bit", 4) != 0) return false;
  at += 4;
  uint32_t bit = 0;
  const unsigned length = digits(at, 2, &bit);
  key->bit = static_cast<int>(bit);
  return length != 0 && at[length] == 0 && bit < 32;
}

bool parameter_takes(const ParameterKey& key, double value) {
  const ParameterRow* row = find_row(key);
  return row == nullptr || row->bit >= 0 || row->takes(value);
}

bool parameter_used(const Dialect& dialect, const char* key) {
  for (const ParameterName& row : dialect.parameters)
    if (std::strcmp(row.key, key) == 0) return true;
  ParameterKey parsed;
  return dialect.id == NC_DIALECT_M700 && parse_parameter_key(key, &parsed) && find_row(parsed) != nullptr;
}

}  // namespace nc

nc_status nc_parameter_row(nc_dialect dialect, unsigned index, nc_parameter* row) {
  if (row == nullptr || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Dialect* d = &nc::dialect(dialect);
  *row = nc_parameter{};
  row->bit = -1;
  if (index < d->parameters.size) {
    const nc::ParameterName& named = d->parameters.begin()[index];
    row->key = named.key;
    row->values = named.values != nullptr ? named.values : named.words;
    row->name = named.name;
    row->section = named.section;
    return NC_OK;
  }
  index -= d->parameters.size;
  if (dialect != NC_DIALECT_M700 || index >= nc::kParameterTable.size) return NC_E_NOT_FOUND;
  const nc::ParameterRow& from = nc::kParameterTable.begin()[index];
  *row = nc_parameter{nullptr, from.first, from.last, from.step, from.bit, from.by_axis, from.values, from.name, from.section};
  return NC_OK;
}

bool nc_parameter_used(nc_dialect dialect, const char* key) {
  return key != nullptr && nc::known(dialect) && nc::parameter_used(nc::dialect(dialect), key);
}
