// SPDX-License-Identifier: Apache-2.0
// Where the families of controllers differ, each difference with a program for each family and with what it does. docs/families.md shows the same table
// to people: its text is compared with the one here, so that no line of it stands there without a program that shows it.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "places/places.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr nc_dialect kFamilies[] = {NC_DIALECT_M700, NC_DIALECT_DGSHAPE, NC_DIALECT_ISO, NC_DIALECT_HX, NC_DIALECT_SERIES8};
constexpr unsigned kCount = sizeof kFamilies / sizeof kFamilies[0];

struct Side {
  const char* says;      ///< the cell of the document
  const char* program;   ///< "---" stands between two programs, of which the second one is looked at
  const char* does;      ///< outcome() of it
};
struct Difference {
  const char* what;
  Side side[kCount];     ///< in the order of kFamilies
};

const Difference kDifferences[] = {
    // clang-format off
    {"A length without a point (`X1000`)",
     {{"0.001 mm (#1078 = 1: mm), 5.3", "G00 X1000\nM30", "rapid 1 0 0"},
      {"0.001 mm, or mm in the calculator type, 1-5", "%\nG00X1000\nM30", "rapid 1 0 0"},
      {"mm, RS-274/NGC 3.3.2.1", "G0 X1000\nM2", "rapid 1000 0 0"},
      {"0.001 mm, 8.4", "G00 X1000\nM30", "rapid 1 0 0"},
      {"mm, G00", "G00X1000", "rapid 1000 0 0"}}},
    {"A feed without a point (`F100`)",
     {{"100 mm/min, 7.2", "G01 X1. F100\nM30", "line 1 0 0 F100"},
      {"0.1 mm/min, or 100 in the calculator type, 1-5", "%\nG01X1.F100\nM30", "line 1 0 0 F0.1"},
      {"100 mm/min", "G1 X1 F100\nM2", "line 1 0 0 F100"},
      {"100 mm/min", "G01 X1. F100\nM30", "line 1 0 0 F100"},
      {"100 mm/min, G01", "G01X1F100", "line 1 0 0 F100"}}},
    {"A word without a number",
     {{"a fault, 3.7", "G01 X F100\nM30", "P33"},
      {"a fault, 1-1", "%\nG00X\nM30", "NC-FORMAT"},
      {"a fault, RS-274/NGC 3.3.2", "G0 X\nM2", "NC-FORMAT"},
      {"a fault, 2.2", "G00 X\nM30", "F_82004"},
      {"0, G00", "G00X5\nG00X", "rapid 5 0 0, rapid 0 0 0"}}},
    {"A word that no code of the block takes (`G00 X1 K5`)",
     {{"is passed over, 6.6", "G00 X1. K5.\nM30", "rapid 1 0 0"},
      {"a fault, chosen", "%\nG00X1.K5.\nM30", "NC-ADDRESS"},
      {"a fault, LinuxCNC", "G0 X1 K5\nM2", "NC-ADDRESS"},
      {"a fault, chosen", "G00 X1. K5.\nM30", "F_82001"},
      {"a fault, chosen", "G00X1K5", "NC-ADDRESS"}}},
    {"A formula that is no multiple of the least unit",
     {{"as calculated, 13.5.4", "G00 X[10./3.]\nM30", "rapid 3.333333 0 0"},
      {"no formulas", "%\nG00X[10./3.]\nM30", "NC-CHARACTER"},
      {"as calculated", "G0 X[10/3]\nM2", "rapid 3.333333 0 0"},
      {"rounded, 14.2.4", "G00 X[10./3.]\nM30", "rapid 3.333 0 0"},
      {"no formulas", "G00X[10/3]", "NC-CHARACTER"}}},
    {"The motion in force when a program begins",
     {{"G01, 3.7", "X1. F100\nM30", "line 1 0 0 F100"},
      {"G00, chosen", "%\nX1.\nM30", "rapid 1 0 0"},
      {"G0, chosen", "X1\nM2", "rapid 1 0 0"},
      {"G00 (PI 144), 3.2", "X1.\nM30", "rapid 1 0 0"},
      {"G00, chosen", "X1", "rapid 1 0 0"}}},
    {"`G91 X2 G90 Y2` in one block",
     {{"each word by the code before it, 5.1", "G00 X1. Y1.\nG91 X2. G90 Y2.\nM30", "rapid 1 1 0, rapid 3 2 0"},
      {"the last code for the whole block, 1-2", "%\nG00X1.Y1.\nG91X2.G90Y2.\nM30", "rapid 1 1 0, rapid 2 2 0"},
      {"a fault, RS-274/NGC 3.4", "G0 X1 Y1\nG91 X2 G90 Y2\nM2", "rapid 1 1 0, NC-FORMAT"},
      {"the last code for the whole block", "G00 X1. Y1.\nG91 X2. G90 Y2.\nM30", "rapid 1 1 0, rapid 2 2 0"},
      {"the last code for the whole block", "G00X1Y1\nG91X2G90Y2", "rapid 1 1 0, rapid 2 2 0"}}},
    {"Codes of inch and millimetre",
     {{"G20, G21", "G20 G00 X1.\nM30", "rapid 25.4 0 0"},
      {"G20, G21", "%\nG20G00X1.\nM30", "rapid 25.4 0 0"},
      {"G20, G21", "G20 G0 X1\nM2", "rapid 25.4 0 0"},
      {"G20, G21", "G20 G00 X1.\nM30", "rapid 25.4 0 0"},
      {"G70, G71; G21 is a line with a sharp corner", "G70G00X1", "rapid 25.4 0 0"}}},
    {"The first block",
     {{"any", "G00 X1.\nM30", "rapid 1 0 0"},
      {"`%`, 2-6", "G00X1.\nM30", "NC-START"},
      {"any", "G0 X1\nM2", "rapid 1 0 0"},
      {"any", "G00 X1.\nM30", "rapid 1 0 0"},
      {"any", "G00X1", "rapid 1 0 0"}}},
    {"A program without M02 or M30",
     {{"a fault, appendix 1", "G00 X1.", "rapid 1 0 0, P36"},
      {"a fault, 1-1", "%\nG00X1.", "rapid 1 0 0, NC-END"},
      {"ends with its text, chosen", "G0 X1", "rapid 1 0 0"},
      {"a fault, 2.3", "G00 X1.", "rapid 1 0 0, F_82016"},
      {"ends with its text, chosen", "G00X1", "rapid 1 0 0"}}},
    {"`;`",
     {{"ends the block (a setting makes it a comment)", "G00 X1. ; X2.\nM30", "P33"},
      {"no character of the code", "%\nG00X1. ; BACK\nM30", "NC-CHARACTER"},
      {"begins a comment", "G0 X1 ; X2\nM2", "rapid 1 0 0"},
      {"begins a comment, 14.5", "G00 X1. ; X2.\nM30", "rapid 1 0 0"},
      {"begins a comment", "G00X1 ; X2", "rapid 1 0 0"}}},
    {"I J of an arc",
     {{"from the start, signed, 6.4", "G02 X10. Y10. I10. J0 F100\nM30", "cw 10 10 0 c10,0 F100"},
      {"from the start, signed, G02", "%\nG02X10.Y10.I10.J0.F100.\nM30", "cw 10 10 0 c10,0 F100"},
      {"from the start, signed (G90.1: absolute)", "G2 X10 Y10 I10 J0 F100\nM2", "cw 10 10 0 c10,0 F100"},
      {"from the start, signed, 4.4", "G02 X10. Y10. I10. J0 F100\nM30", "cw 10 10 0 c10,0 F100"},
      {"without a sign, within a quadrant of the centre, G02", "G00X10Y0\nF100\nG03X0Y10I10J0", "rapid 10 0 0, ccw 0 10 0 c0,0 F100"}}},
    {"An arc over more than a quadrant by I J",
     {{"is made", "G02 X20. Y0 I10. F100\nM30", "cw 20 0 0 c10,0 F100"},
      {"is made", "%\nG02X20.Y0.I10.F100.\nM30", "cw 20 0 0 c10,0 F100"},
      {"is made", "G2 X20 Y0 I10 F100\nM2", "cw 20 0 0 c10,0 F100"},
      {"is made", "G02 X20. Y0 I10. F100\nM30", "cw 20 0 0 c10,0 F100"},
      {"INVALID ARC, G02", "F100\nG02X20Y0I10", "INVALIDARC"}}},
    {"An R below half the chord",
     {{"a fault, 6.5", "G02 X20. R5. F100\nM30", "P71"},
      {"a fault, chosen", "%\nG02X20.R5.F100.\nM30", "NC-ARC"},
      {"a fault, RS-274/NGC 3.5.3.1", "G2 X20 R5 F100\nM2", "NC-ARC"},
      {"a fault, 4.4", "G02 X20. R5. F100\nM30", "F_82100"},
      {"half the chord, G02", "F100\nG02X20R5", "cw 20 0 0 c10,0 F100"}}},
    {"An arc without R and without a centre",
     {{"a fault, 6.4", "G02 X20. R10. F100\nX0\nM30", "cw 20 0 0 c10,0 F100, P70"},
      {"a fault", "%\nG02X20.R10.F100.\nX0.\nM30", "cw 20 0 0 c10,0 F100, NC-ARC"},
      {"a fault", "G2 X20 R10 F100\nX0\nM2", "cw 20 0 0 c10,0 F100, NC-ARC"},
      {"a fault", "G02 X20. R10. F100\nX0\nM30", "cw 20 0 0 c10,0 F100, F_82112"},
      {"has the last R, G02", "F100\nG02X20R10\nX0", "cw 20 0 0 c10,0 F100, cw 0 0 0 c10,0 F100"}}},
    {"An arc by R back to its start",
     {{"makes no move, 6.5", "G02 X0 R5. F100\nM30", ""},
      {"makes no move", "%\nG02X0.R5.F100.\nM30", ""},
      {"a fault, RS-274/NGC 3.5.3.1", "G2 X0 R5 F100\nM2", "NC-ARC"},
      {"a fault, 4.4", "G02 X0 R5. F100\nM30", "F_82100"},
      {"makes no move, chosen", "F100\nG02X0R5", ""}}},
    {"The end of an arc 0.05 mm beside its circle",
     {{"is led to (#1084), 6.4", "G02 X20.05 Y0 I10. F100\nM30", "cw 20.05 0 0 c10,0 F100"},
      {"a fault beyond 0.01 mm, chosen", "%\nG02X20.05Y0.I10.F100.\nM30", "NC-ARC"},
      {"a fault beyond 0.005 mm and 0.001 of the radius, LinuxCNC G2", "G2 X20.05 Y0 I10 F100\nM2", "NC-ARC"},
      {"a fault beyond PI 151, 4.4", "G02 X20.05 Y0 I10. F100\nM30", "F_82112"},
      {"INVALID ARC beyond a thousandth of an inch, chosen", "G00X10Y0\nF100\nG03X0Y10.05I10", "rapid 10 0 0, INVALIDARC"}}},
    {"Corner between two lines",
     {{",C and ,R, 13.7", "G01 X10. ,C2. F100\nY10.\nM30", "line 8 0 0 F100, line 10 2 0 F100, line 10 10 0 F100"},
      {"none", "%\nG01X10.,C2.F100.\nY10.\nM30", "NC-CHARACTER"},
      {"none", "G1 X10 ,C2 F100\nY10\nM2", "NC-CHARACTER"},
      {",C and ,R, 4.3", "G01 X10. ,C2. F100\nY10.\nM30", "line 8 0 0 F100, line 10 2 0 F100, line 10 10 0 F100"},
      {"G10 with L or R", "F100\nG01G10X10L2\nY10", "line 8 0 0 F100, line 10 2 0 F100, line 10 10 0 F100"}}},
    {"A dwell of half a second",
     {{"`G04 P500` or `X0.5`, 8.1", "G04 P500\nM30", "dwell 0.5"},
      {"`G04 P500` or `X0.5`, alone in its block", "%\nG04P500\nM30", "dwell 0.5"},
      {"`G4 P0.5`, RS-274/NGC 3.5.4", "G4 P0.5\nM2", "dwell 0.5"},
      {"`G04 P500` or `X0.5`, 5.4", "G04 P500\nM30", "dwell 0.5"},
      {"`G04 X.5` or `F.5`", "G04F.5", "dwell 0.5"}}},
    {"Inverse time F of an arc",
     {{"speed divided by the radius, 7.5", "G93 G02 X20. R10. F2\nM30", "cw 20 0 0 c10,0 F20"},
      {"none", "%\nG93\nM30", "NC-NO-SUCH-CODE"},
      {"1 divided by the minutes of the block", "G93 G2 X20 R10 F2\nM2", "cw 20 0 0 c10,0 F62.831853"},
      {"none", "G93\nM30", "F_82030"},
      {"1 divided by the minutes of the block, and modal", "G93F2\nG02X20R10", "cw 20 0 0 c10,0 F62.831853"}}},
    {"Reference return of one axis (G28)",
     {{"that axis, 14.7", "G28 X5.\nG28 Y6.\nM30", "rapid 5 0 0, rapid 0 0 0, rapid 0 6 0, rapid 0 0 0"},
      {"and those of an earlier G28, by their points", "%\nG28X5.\nG28Y6.\nM30", "rapid 5 0 0, rapid 0 0 0, rapid 5 6 0, rapid 0 0 0"},
      {"that axis (all without a word)", "G28 X5\nG28 Y6\nM2", "rapid 5 0 0, rapid 0 0 0, rapid 0 6 0, rapid 0 0 0"},
      {"that axis, 6.1", "G28 X5.\nG28 Y6.\nM30", "rapid 5 0 0, rapid 0 0 0, rapid 0 6 0, rapid 0 0 0"},
      {"none", "G28X5", "NC-NO-SUCH-CODE"}}},
    {"A move in machine coordinates in G91",
     {{"an increment, 14.4", "G00 X1.\nG91 G53 X2.\nM30", "rapid 1 0 0, rapid 3 0 0"},
      {"a fault, G53", "%\nG00X1.\nG91G53X2.\nM30", "rapid 1 0 0, NC-INCREMENTAL"},
      {"a fault, LinuxCNC G53", "G0 X1\nG91 G53 X2\nM2", "rapid 1 0 0, NC-INCREMENTAL"},
      {"nothing, 7.1.1", "G00 X1.\nG91 G53 X2.\nM30", "rapid 1 0 0"},
      {"absolute (G69)", "G00X1\nG91G69X2", "rapid 1 0 0, rapid 2 0 0"}}},
    {"A shift of the coordinates (G92) behind M30",
     {{"stays, 9.1", "G92 X-5.\nM30---G00 X1.\nM30", "rapid 6 0 0"},
      {"stays", "%\nG92X-5.\nM30---%\nG00X1.\nM30", "rapid 6 0 0"},
      {"stays (G92.1, G92.2 end it)", "G92 X-5\nM2---G0 X1\nM2", "rapid 6 0 0"},
      {"stays", "G92 X-5.\nM30---G00 X1.\nM30", "rapid 6 0 0"},
      {"ends, G92", "G92X-5\nM30---G00X1", "rapid 1 0 0"}}},
    {"Work coordinate system 2",
     {{"G55", "G55 G00 X1.\nM30", "rapid 1 0 0"},
      {"G55", "%\nG55G00X1.\nM30", "rapid 1 0 0"},
      {"G55 (up to G59.3)", "G55 G0 X1\nM2", "rapid 1 0 0"},
      {"G55", "G55 G00 X1.\nM30", "rapid 1 0 0"},
      {"none; G55 turns the part", "G55R90\nG00X1Y0", "rapid 0 1 0"}}},
    {"Length compensation without a word of its axis",
     {{"moves it at once, 12.2; a cut takes a feed, P62", "G00 G43 H1\nX1.\nZ0\nM30", "rapid 0 0 2, rapid 1 0 2"},
      {"moves it at once, G43", "%\nG43H1\nG00X1.\nZ0.\nM30", "rapid 0 0 2, rapid 1 0 2"},
      {"changes what is read; absolute words go there", "G43 H1\nG0 X1\nZ0\nM2", "rapid 1 0 0, rapid 1 0 2"},
      {"moves the axis on the plane at once, 13.1.1", "G00 G19 G43 H1\nY1.\nX0\nM30", "rapid 2 0 0, rapid 2 1 0"},
      {"D of a cycle; G43 is an entry", "F100\nG81X1Z-1R2D1\nG80", "rapid 1 0 0, rapid 1 0 4, line 1 0 1 F100, rapid 1 0 4"}}},
    {"Setting data by program",
     {{"G10 L2, L10 to L13, L70 …, G91 adds, 12.7", "G10 L2 P1 X10.\nG00 X1.\nM30", "rapid 11 0 0"},
      {"G10 L2 P0 to P6; `G10 P R` a radius; always absolute", "%\nG10L2P1X10.\nG00X1.\nM30", "rapid 11 0 0"},
      {"G10 L2, L20", "G10 L2 P1 X10\nG0 X1\nM2", "rapid 11 0 0"},
      {"G10 L10 (length), L12 (D), G91 adds, 13.1.3; systems by #2377", "#2377=10\nG00 X1.\nM30", "rapid 11 0 0"},
      {"none; G10 is a corner", "G10L2P1X10", "NC-ADDRESS"}}},
    {"Scaling by a half",
     {{"`G51 X0 Y0 P0.5` or P500000, 13.19", "G51 X0 Y0 P0.5\nG00 X10. Z10.\nM30", "rapid 5 0 10"},
      {"`G51 X0 Y0 P0.5`: X Y Z, about the tool where no point is given", "%\nG51X0.Y0.Z0.P0.5\nG00X10.Z10.\nM30", "rapid 5 0 5"},
      {"none", "G51 X0 Y0 P0.5\nM2", "NC-NO-SUCH-CODE"},
      {"`G51 X0 Y0 P500`, or I J K by axis, 15.2", "G51 X0 Y0 Z0 P500\nG00 X10. Z10.\nM30", "rapid 5 0 5"},
      {"`G57 R.5`: the plane, about program zero", "G57R.5\nG00X10Y0Z10", "rapid 5 0 10"}}},
    {"Mirror image of X",
     {{"`G51.1 X0`, 13.6", "G51.1 X0\nG00 X10.\nM30", "rapid -10 0 0"},
      {"none", "%\nG51.1X0.\nM30", "NC-NO-SUCH-CODE"},
      {"none", "G51.1 X0\nM2", "NC-NO-SUCH-CODE"},
      {"`G51 X0 Y0 I-1000 J1000`, 15.3", "G51 X0 Y0 I-1000 J1000\nG00 X10.\nM30", "rapid -10 0 0"},
      {"none", "G51.1X", "NC-NO-SUCH-CODE"}}},
    {"Rotation by 90 degrees",
     {{"`G68 X0 Y0 R90.`, 13.20", "G68 X0 Y0 R90.\nG00 X10. Y0\nM30", "rapid 0 10 0"},
      {"none", "%\nG68X0.Y0.R90.\nM30", "NC-NO-SUCH-CODE"},
      {"none (G10 L2 R is refused)", "G68 X0 Y0 R90\nM2", "NC-NO-SUCH-CODE"},
      {"`G68 X0 Y0 R90.`, PI 117 without R, 15.4", "G68 X0 Y0 R90.\nG00 X10. Y0\nM30", "rapid 0 10 0"},
      {"`G55 R90`, about program zero", "G55R90\nG00X10Y0", "rapid 0 10 0"}}},
    {"The code of radius compensation alone, then a line",
     {{"the tool goes beside the start at once, 12.4.2", "G41 D1 F100\nG01 X10.\nX20.\nM30", "line 0 2 0 F100, line 10 2 0 F100, line 20 2 0 F100"},
      {"the code waits, and the line leads beside its end, G41", "%\nG41D1F100.\nG01X10.\nX20.\nM30", "line 10 2 0 F100, line 20 2 0 F100"},
      {"the code waits, and the line leads beside its end; without D it is the number of the tool in the spindle", "G41 D1 F100\nG1 X10\nX20\nM2", "line 10 2 0 F100, line 20 2 0 F100"},
      {"the code waits, and the line leads beside its end, 13.2.2", "G41 D1 F100\nG01 X10.\nX20.\nM30", "line 10 2 0 F100, line 20 2 0 F100"},
      {"the code waits, and the line begins beside its start (G43: leads beside its end)", "D1F100\nG41\nG01X10\nX20", "line 0 2 0 F100, line 10 2 0 F100, line 20 2 0 F100"}}},
    {"G42 while G41 is in force",
     {{"changes the side, 12.4.1", "G41 D1 G01 X10. F100\nX20.\nG42 X30.\nX40.\nG40 X50.\nM30", "line 10 2 0 F100, line 20 2 0 F100, line 20 -2 0 F100, line 30 -2 0 F100, line 40 -2 0 F100, line 50 0 0 F100"},
      {"a fault, G41", "%\nG41D1G01X10.F100.\nX20.\nG42X30.\nM30", "line 10 2 0 F100, line 20 2 0 F100, NC-OFFSET-CODE"},
      {"a fault, RS-274/NGC 3.5.10", "G41 D1 G1 X10 F100\nX20\nG42 X30\nM2", "line 10 2 0 F100, line 20 2 0 F100, NC-OFFSET-CODE"},
      {"changes the side, 13.2.2", "G41 D1 G01 X10. F100\nX20.\nG42 X30.\nX40.\nG40 X50.\nM30", "line 10 2 0 F100, line 20 2 0 F100, line 20 -2 0 F100, line 30 -2 0 F100, line 40 -2 0 F100, line 50 0 0 F100"},
      {"changes the side", "D1F100\nG41G43G01X10\nX20\nG42X30\nX40\nG40\nX50", "line 10 2 0 F100, line 20 2 0 F100, line 20 -2 0 F100, line 30 -2 0 F100, line 40 -2 0 F100, line 50 0 0 F100"}}},
    {"An outer corner of 45 degrees",
     {{"two lines more, 12.4.1", "G41 D1 G01 X10. F100\nX30.\nX20. Y-10.\nM30", "line 10 2 0 F100, line 32 2 0 F100, line 32.828427 0 0 F100, line 21.414214 -11.414214 0 F100"},
      {"two lines more", "%\nG41D1G01X10.F100.\nX30.\nX20.Y-10.\nM30", "line 10 2 0 F100, line 32 2 0 F100, line 32.828427 0 0 F100, line 21.414214 -11.414214 0 F100"},
      {"two lines more; LinuxCNC: an arc", "G41 D1 G1 X10 F100\nX30\nX20 Y-10\nM2", "line 10 2 0 F100, line 32 2 0 F100, line 32.828427 0 0 F100, line 21.414214 -11.414214 0 F100"},
      {"two lines more", "G41 D1 G01 X10. F100\nX30.\nX20. Y-10.\nM30", "line 10 2 0 F100, line 32 2 0 F100, line 32.828427 0 0 F100, line 21.414214 -11.414214 0 F100"},
      {"an arc, below 70 degrees, G41", "D1F100\nG41G43G01X10\nX30\nX20Y-10", "line 10 2 0 F100, line 30 2 0 F100, cw 31.414214 -1.414214 0 c30,0 F100, line 21.414214 -11.414214 0 F100"}}},
    {"A move to a probe, which is not touched",
     {{"G31 ends at its word, 15.2", "G31 Z-5. F100\nG00 X1.\nM30", "skip 0 0 -5 F100, rapid 1 0 -5"},
      {"none", "%\nG31Z-5.F100.\nM30", "NC-NO-SUCH-CODE"},
      {"G38.2 is a fault behind the move, G38.3 is none", "G38.2 Z-5 F100\nG0 X1\nM2", "skip 0 0 -5 F100, NC-PROBE"},
      {"G31 ends at its word, 4.9", "G31 Z-5. F100\nG00 X1.\nM30", "skip 0 0 -5 F100, rapid 1 0 -5"},
      {"G51 is a fault behind the move, chosen", "F100\nG51Z-5\nG00X1", "skip 0 0 -5 F100, NC-PROBE"}}},
    {"The lead of a thread (G33)",
     {{"F, or E, 6.7.1", "S100 M03\nG33 Z-5. F2.\nM30", "S100, thread 0 0 -5 F0"},
      {"none", "%\nM03S1000\nG33Z-5.F2.\nM30", "S1000, NC-NO-SUCH-CODE"},
      {"K; F stays the feed", "S100 M3 F100\nG33 Z-5 K2\nG1 Z0\nM2", "S100, thread 0 0 -5 F0, line 0 0 0 F100"},
      {"F, 4.8", "S100 M03\nG33 Z-5. F2.\nM30", "S100, thread 0 0 -5 F0"},
      {"none", "M03S100\nG33Z-5", "S100, NC-NO-SUCH-CODE"}}},
    {"G16, radius and angle",
     {{"polar coordinate command, 6.12", "G16\nG00 X10. Y90.\nM30", "rapid 0 10 0"},
      {"none", "%\nG16\nM30", "NC-NO-SUCH-CODE"},
      {"none", "G16\nM2", "NC-NO-SUCH-CODE"},
      {"polar coordinate command, 8.3", "G16\nG00 X10. Y90.\nM30", "rapid 0 10 0"},
      {"none", "G16", "NC-NO-SUCH-CODE"}}},
    {"G22",
     {{"stroke check before travel, 15.7", "G22 X10. Y10. Z10. I-10. J-10. K-10.\nG00 X1.\nM30", "P452"},
      {"none", "%\nG22\nM30", "NC-NO-SUCH-CODE"},
      {"none", "G22\nM2", "NC-NO-SUCH-CODE"},
      {"stored stroke check, 15.5.3", "G22 X10. Y10. Z10. I-10. J-10. K-10.\nG00 X1.\nM30", "NC-LIMIT"},
      {"an arc clockwise with a sharp corner", "F100\nG22X2R1", "cw 2 0 0 c1,0 F100"}}},
    {"Where a hole ends",
     {{"G98 the level of before, G99 R, 13.1.2", "G00 Z9.\nG99 G81 X1. Z-1. R2. F100\nG98 X2.\nM30", "rapid 0 0 9, rapid 1 0 9, rapid 1 0 2, line 1 0 -1 F100, rapid 1 0 2, rapid 2 0 2, line 2 0 -1 F100, rapid 2 0 9"},
      {"G98, G99; the spindle has to turn, G81", "%\nM03S1000\nG00Z9.\nG99G81X1.Z-1.R2.F100.\nG98X2.\nM30", "S1000, rapid 0 0 9, rapid 1 0 9, rapid 1 0 2, line 1 0 -1 F100, rapid 1 0 2, rapid 2 0 2, line 2 0 -1 F100, rapid 2 0 9"},
      {"G98, G99; below R it rises first", "G0 Z9\nG99 G81 X1 Z-1 R2 F100\nG98 X2\nM2", "rapid 0 0 9, rapid 1 0 9, rapid 1 0 2, line 1 0 -1 F100, rapid 1 0 2, rapid 2 0 2, line 2 0 -1 F100, rapid 2 0 9"},
      {"G98, G99, 12.1.4", "G00 Z9.\nG99 G81 X1. Z-1. R2. F100\nG98 X2.\nM30", "rapid 0 0 9, rapid 1 0 9, rapid 1 0 2, line 1 0 -1 F100, rapid 1 0 2, rapid 2 0 2, line 2 0 -1 F100, rapid 2 0 9"},
      {"always R, whose level stays behind G80, G81", "F100\nG00Z9\nG81X1Z-1R2\nX2", "rapid 0 0 9, rapid 1 0 9, rapid 1 0 2, line 1 0 -1 F100, rapid 1 0 2, rapid 2 0 2, line 2 0 -1 F100, rapid 2 0 2"}}},
    {"R and Z of a cycle in G91",
     {{"R takes the sign of Z, 13.1.1", "G00 Z20.\nG91 G99 G81 X1. Z-5. R3. F100\nM30", "rapid 0 0 20, rapid 1 0 20, rapid 1 0 17, line 1 0 12 F100, rapid 1 0 17"},
      {"each its own sign", "%\nM03S1000\nG00Z20.\nG91G99G81X1.Z-5.R3.F100.\nM30", "S1000, rapid 0 0 20, rapid 1 0 20, rapid 1 0 23, line 1 0 18 F100, rapid 1 0 23"},
      {"each its own sign; it rises to R first", "G0 Z20\nG91 G99 G81 X1 Z-5 R3 F100\nM2", "rapid 0 0 20, rapid 0 0 23, rapid 1 0 23, line 1 0 18 F100, rapid 1 0 23"},
      {"each its own sign, 12.1.3", "G00 Z20.\nG91 G99 G81 X1. Z-5. R3. F100\nM30", "rapid 0 0 20, rapid 1 0 20, rapid 1 0 23, line 1 0 18 F100, rapid 1 0 23"},
      {"R from where it is, Z from R; chosen", "F100\nG00Z20\nG91G81X1Z-5R3", "rapid 0 0 20, rapid 1 0 20, rapid 1 0 23, line 1 0 18 F100, rapid 1 0 23"}}},
    {"A peck, and what is left free behind it",
     {{"Q; #8013, 13.1.1", "G99 G83 X1. Z-4. R0 Q3. F100\nM30", "rapid 1 0 0, line 1 0 -3 F100, rapid 1 0 0, rapid 1 0 -3, line 1 0 -4 F100, rapid 1 0 0"},
      {"Q; 1 mm, G83", "%\nM03S1000\nG99G83X1.Z-4.R0.Q3.F100.\nM30", "S1000, rapid 1 0 0, line 1 0 -3 F100, rapid 1 0 0, rapid 1 0 -2, line 1 0 -4 F100, rapid 1 0 0"},
      {"Q; 0.254 mm, LinuxCNC G83", "G99 G83 X1 Z-4 R0 Q3 F100\nM2", "rapid 1 0 0, line 1 0 -3 F100, rapid 1 0 0, rapid 1 0 -2.746, line 1 0 -4 F100, rapid 1 0 0"},
      {"Q; PI 129, 12.3.3", "G99 G83 X1. Z-4. R0 Q3. F100\nM30", "rapid 1 0 0, line 1 0 -3 F100, rapid 1 0 0, rapid 1 0 -3, line 1 0 -4 F100, rapid 1 0 0"},
      {"I the first depth, J the others; 1.27 mm, G83", "F100\nG83X1Z-4R0I-3J3", "rapid 1 0 0, line 1 0 -3 F100, rapid 1 0 0, rapid 1 0 -1.73, line 1 0 -4 F100, rapid 1 0 0"}}},
    {"Dwell at the bottom of a hole",
     {{"P in ms", "G99 G82 X1. Z-1. R0 P500 F100\nM30", "rapid 1 0 0, line 1 0 -1 F100, dwell 0.5, rapid 1 0 0"},
      {"P in ms", "%\nM03S1000\nG99G82X1.Z-1.R0.P500F100.\nM30", "S1000, rapid 1 0 0, line 1 0 -1 F100, dwell 0.5, rapid 1 0 0"},
      {"P in s", "G99 G82 X1 Z-1 R0 P.5 F100\nM2", "rapid 1 0 0, line 1 0 -1 F100, dwell 0.5, rapid 1 0 0"},
      {"P in ms", "G99 G82 X1. Z-1. R0 P500 F100\nM30", "rapid 1 0 0, line 1 0 -1 F100, dwell 0.5, rapid 1 0 0"},
      {"P in s", "F100\nG82X1Z-1R0P.5", "rapid 1 0 0, line 1 0 -1 F100, dwell 0.5, rapid 1 0 0"}}},
    {"Z and R of a hole behind the code of another cycle (`G82 X2`)",
     {{"stay, 13.1.1", "G99 G81 X1. Z-1. R0 F100\nG82 X2. P500\nM30", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, dwell 0.5, rapid 2 0 0"},
      {"are those of its block: no Z, no hole, G81", "%\nM03S1000\nG99G81X1.Z-1.R0.F100.\nG82X2.P500\nM30", "S1000, rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0"},
      {"are those of the same cycle: an alarm, 3.5.16", "G99 G81 X1 Z-1 R0 F100\nG82 X2 P.5\nM2", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, NC-WORDS"},
      {"stay, 12.1.2", "G99 G81 X1. Z-1. R0 F100\nG82 X2. P500\nM30", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, dwell 0.5, rapid 2 0 0"},
      {"stay, chosen", "F100\nG81X1Z-1R0\nG82X2P.5", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, dwell 0.5, rapid 2 0 0"}}},
    {"Holes in a row by one block in G91",
     {{"L2, 13.1.1", "G91 G99 G81 X1. Z-1. R0 L2 F100\nM30", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, rapid 2 0 0"},
      {"K2", "%\nM03S1000\nG91G99G81X1.Z-1.R0.K2F100.\nM30", "S1000, rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, rapid 2 0 0"},
      {"L2", "G91 G99 G81 X1 Z-1 R0 L2 F100\nM2", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, rapid 2 0 0"},
      {"K2 or L2, 12.1.2", "G91 G99 G81 X1. Z-1. R0 K2 F100\nM30", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, rapid 2 0 0"},
      {"no word; K is the lead of a tap", "F100\nG91G81X1Z-1R0\nX1R0Z-1", "rapid 1 0 0, line 1 0 -1 F100, rapid 1 0 0, rapid 2 0 0, line 2 0 -1 F100, rapid 2 0 0"}}},
    {"G98",
     {{"return level", "G00 X5.\nG98 X1.\nM30", "rapid 5 0 0, rapid 1 0 0"},
      {"return level", "%\nG00X5.\nG98X1.\nM30", "rapid 5 0 0, rapid 1 0 0"},
      {"return level", "G0 X5\nG98 X1\nM2", "rapid 5 0 0, rapid 1 0 0"},
      {"return level", "G00 X5.\nG98 X1.\nM30", "rapid 5 0 0, rapid 1 0 0"},
      {"program zero, as G92", "G00X5\nG98X1\nX2", "rapid 5 0 0, rapid 6 0 0"}}},
    {"A sub program",
     {{"M98 P, H, L, D", "M98 P10\nM30\nO10\nG00 X1.\nM99", "rapid 1 0 0"},
      {"none", "%\nM98P10\nM30", "NC-NO-SUCH-CODE"},
      {"none: O words and M98 are alarms", "M98 P10\nM2", "NC-NOT-BUILT"},
      {"M98 P, from Q to R, L, 2.4", "M98 P10\nM30\nO10\nG00 X1.\nM99", "rapid 1 0 0"},
      {"none", "M98P10", "NC-NO-SUCH-CODE"}}},
    {"Loops",
     {{"WHILE [ ] DO n, 13.5.7", "#100=0\nWHILE [#100 LT 2] DO 1\n#100=#100+1\nG00 X#100\nEND 1\nM30", "rapid 1 0 0, rapid 2 0 0"},
      {"none", "%\n#100=0\nM30", "NC-CHARACTER"},
      {"O words, refused", "O1 WHILE [#1 LT 2]\nM2", "NC-O-WORD"},
      {"WHILE [ ] DO n, any number, three deep, 14.2.5", "#100=0\nWHILE [#100 LT 2] DO 7\n#100=#100+1\nG00 X#100\nEND 7\nM30", "rapid 1 0 0, rapid 2 0 0"},
      {"none", "WHILE", "NC-ADDRESS"}}},
    {"The tool of a block",
     {{"T, M06 where the machine wants it", "T5 M06\nM30", "T5"},
      {"`M06T5` together, M06", "%\nM06T5\nM30", "T5"},
      {"T selects, M6 changes", "T5 M6\nM2", "T5"},
      {"T; PI 105, 106 make it a macro", "T5 M06\nM30", "T5"},
      {"T D", "T5D1\nM06", "T5"}}},
    {"S below 100",
     {{"r/min", "S60 M03\nM30", "S60"},
      {"a code of the R20 series: S60 is 1000 r/min, 2-4", "%\nS60\nM03\nM30", "S1000"},
      {"r/min", "S60 M3\nM2", "S60"},
      {"r/min", "S60 M03\nM30", "S60"},
      {"r/min", "S60M03", "S60"}}},
    // clang-format on
};

/// What a program does, as text: its moves, dwells and codes in order, and its alarm.
std::string outcome(nc_dialect family, const std::string& program) {
  Bench bench(family);
  bench.tool(1, 2, family == NC_DIALECT_M700 ? NC_TOOL_LENGTH : NC_TOOL_RADIUS);
  if (family != NC_DIALECT_M700) bench.tool(1, 2, NC_TOOL_LENGTH);
  const size_t second = program.find("---");  // two programs, one after the other
  if (second != std::string::npos) bench.run(program.substr(0, second));
  const Outcome run = bench.run(second == std::string::npos ? program : program.substr(second + 3));
  std::string all;
  const auto add = [&all](const std::string& text) { all += (all.empty() ? "" : ", ") + text; };
  const Path path = run.path();
  size_t moves = 0;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) add(path[moves++]);
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) add("dwell " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B && item.u.action.kind != NC_ACTION_M) add(item.u.action.letter + brief(item.u.action.value));
  }
  if (!run.alarm.empty()) add(run.alarm);
  return all;
}

TEST(Families, DifferWhereTheirTableSaysSo) {
  for (const Difference& row : kDifferences)
    for (unsigned i = 0; i < kCount; ++i) EXPECT_EQ(outcome(kFamilies[i], row.side[i].program), row.side[i].does) << row.what << ", " << nc_dialect_name(kFamilies[i]);
}

TEST(Families, EachLineOfTheTableIsADifference) {
  for (const Difference& row : kDifferences) {
    std::set<std::string> says;
    for (const Side& side : row.side) says.insert(side.says);
    EXPECT_GT(says.size(), 1u) << row.what;
  }
}

TEST(Families, TheDocumentShowsThisTable) {
  std::ostringstream table;
  table << "| what |";
  for (const nc_dialect family : kFamilies) table << " " << nc_dialect_name(family) << " |";
  table << "\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Difference& row : kDifferences) {
    table << "| " << row.what << " |";
    for (const Side& side : row.side) table << " " << side.says << " |";
    table << "\n";
  }
  std::ifstream file(kSourceDir + "/docs/families.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(table.str()), std::string::npos) << "docs/families.md has to contain:\n" << table.str();
}

TEST(Families, AllAreInTheTable) { EXPECT_EQ(kCount, static_cast<unsigned>(NC_DIALECT_COUNT)); }

}  // namespace
}  // namespace nc::test
