// SPDX-License-Identifier: Apache-2.0
// The manual's rules of radius compensation, of the plane (M700 12.4) and in space (12.5), row by row: what a sentence or a row of a table says, a program in which
// it happens, and the points to which the tool goes. Amounts: D1 = 5, D2 = 8, D3 = 0 unless the program sets it. The tool stands at X-20 Y20.
#include <gtest/gtest.h>

#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

struct Row {
  const char* section;
  const char* says;
  const char* parameter;  ///< that is 1, "" = none
  const char* program;
  const char* path;       ///< end points X,Y or X,Y,Z, those of arcs behind ~; an alarm with the line of the program
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.section << ": " << row.says; }

/// A number to a thousandth.
std::string short_number(double value) { return brief(std::nearbyint(value * 1e3) / 1e3); }

std::string path_of(const Row& row) {
  Bench bench;
  if (row.parameter[0] != 0) bench.param(row.parameter, "1");
  bench.tool(1, 5).tool(2, 8).tool(3, 0).at(-20, 20, 0);
  const Outcome run = bench.run(std::string("G90 G17 G94 G21 G0\n") + row.program + "M30\n");
  std::string all;
  const auto add = [&](const std::string& what) { all += (all.empty() ? "" : " ") + what; };
  for (const nc_move& move : run.moves()) {
    const double* end = move.machine.v;
    add((move.plane != NC_PLANE_NONE ? "~" : "") + short_number(end[0]) + "," + short_number(end[1]) + (std::abs(end[2]) < 5e-4 ? "" : "," + short_number(end[2])));
  }
  if (!run.alarm.empty()) add(run.alarm + " L" + std::to_string(run.alarm_line - 1));
  return all;
}

// clang-format off
constexpr Row kOfThePlane[] = {
    {"12.4", "acts in the plane; other axes are untouched", "", "G41 D1 G1 X0 Y0 F500\nX40.\nZ-5.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,5,-5 35,40,-5 60,60,-5"},
    {"12.4", "H is ignored, only D counts", "", "G41 D1 H2 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.1 (1)", "starts with a movement, D above 0: D0 starts nothing", "", "G41 D0 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "0,0 40,0 40,40 60,60"},
    {"12.4.1 (1)", "... and D up to the number of sets", "", "G41 D999 G1 X0 Y0 F500\nX40.\n", "P170 L1"},
    {"12.4.1 (1)", "... by G00 or G01: an arc is P151", "", "G41 D1 G2 X0 Y0 R30. F500\nX40.\n", "P151 L1"},
    {"12.4.1 (1)", "G00", "", "G0 G41 D1 X0 Y0\nG1 X40. F500\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.1 (2)", "the vector of the start is at right angles to the block behind it", "", "G41 D1 G1 X0 Y0 F500\nX40. Y40.\nX80.\nG40 Y60.\n", "-3.536,3.536 37.929,45 80,45 80,60"},
    {"12.4.1 (4)", "the same code again is ignored", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG41 Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,35 0,35 60,60"},
    {"12.4.1 (4)", "no pre-reading behind M00: the block before it ends at right angles", "", "G41 D1 G1 X0 Y0 F500\nX40.\nM00\nY40.\nG40 X60. Y60.\n", "0,5 40,5 35,40 60,60"},
    {"12.4.1 (5)", "cancel by G40: the last block ends at right angles", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.1 (5)", "cancel by D00", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nD0 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.1 (5)", "the cancel is no arc: P151", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 G3 X30. Y50. R10.\n", "0,5 35,5 35,40 P151 L4"},
    {"12.4.2 (1)", "G39: an arc about the corner, from one vector at right angles to the other", "", "G41 D1 G1 X0 Y0 F500\nG39 X40.\nY-40.\nG40 X60. Y-60.\n", "0,5 40,5 ~45,0 45,-40 60,-60"},
    {"12.4.2 (1)", "G39 at an inner corner", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG39 Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,40 ~40,35 0,35 60,60"},
    {"12.4.2 (1)", "... without a block behind it, in front of M00, the arc leads nowhere", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG39 Y-40.\nM0\nX0\nG40 X60. Y-60.\n", "0,5 45,5 P152 L3"},
    {"12.4.2 (2)", "G38: the vector at the end of the block before is kept", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG38 Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,45 0,35 60,60"},
    {"12.4.2 (2)", "G38 I J: the vector lies along the words", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG38 Y40. I-3. J4.\nX0\nG40 X60. Y60.\n", "0,5 35,5 37,44 0,35 60,60"},
    {"12.4.2 (2)", "G38 I J D: ... with the amount of D", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG38 Y40. I-5. J0 D2\nX0\nG40 X60. Y60.\n", "0,5 35,5 32,40 0,32 60,60"},
    {"12.4.2 (2)", "G38 I J in an arc: an error", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG38 G3 X50. Y10. I0 J10.\nX0\nG40 X60. Y60.\n", "0,5 40,5 P33 L3"},
    {"12.4.2 (3)", "G41 to G42: the two offset lines meet", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG42 Y40.\nX80.\nG40 X100. Y60.\n", "0,5 45,5 45,35 80,35 100,60"},
    {"12.4.2 (3)", "... where they do not: two vectors at right angles", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG42 X80.\nY-40.\nG40 Y-60.\n", "0,5 40,5 40,-5 75,-5 75,-40 80,-60"},
    {"12.4.2 (3)", "... straight back: the tool returns along its own line", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG42 X0.\nY40.\nG40 Y60.\n", "0,5 40,5 5,5 5,40 0,60"},
    {"12.4.2 (3)", "the side is code times sign: D of the other sign changes it", "", "G10 L10 P3 R-5.\nG41 D1 G1 X0 Y0 F500\nX40.\nY40. D3\nX80.\nG40 X100. Y60.\n", "0,5 45,5 45,35 80,35 100,60"},
    {"12.4.2 (4)", "G28: no vector at the intermediate point, directly back to the next meeting", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG28 X40. Y30.\nX80. Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 40,30 0,0 58.82,35 0,35 60,60"},
    {"12.4.2 (4)", "... at the intermediate point already: the block before ends at right angles, and the tool goes to the point itself", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG91 G28 X0 Y0\nG90 G1 X80. Y40.\nX0\nG40 X60. Y60.\n", "0,5 40,5 40,0 0,0 58.82,35 0,35 60,60"},
    {"12.4.2 (4)", "... G30", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG91 G30 X0 Y0\n", "0,5 40,5 40,0 0,0"},
    {"12.4.2 (4)", "... one axis", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG91 G28 X0\n", "0,5 40,5 40,0 0,0"},
    {"12.4.2 (4)", "... behind the start", "", "G41 D1 G1 X5. Y20. F500\nG91 G28 X0 Y0\n", "5,20 0,0"},
    {"12.4.2 (4)", "... an axis that only lifts the tool does not draw it to the contour", "", "G41 D1 G1 X0 Y0 F500\nX40. Z-5.\nG91 G28 Z0\nG90 X60.\nX80.\nG40 X90.\n", "0,5 40,5,-5 40,5 60,5 80,5 90,0"},
    {"12.4.2 (3)", "G53 of the axis across the plane lifts the tool beside the wall", "", "G41 D1 G1 X0 Y0 F500\nX40. Z-5.\nG53 Z0\nG1 Z-5.\nX80.\nG40 X90.\n", "0,5 40,5,-5 40,5 40,5,-5 80,5,-5 90,0,-5"},
    {"12.4.2", "G39 in front of G40: its arc at an outer corner", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG39 X60.\nG40 Y-40.\n", "0,5 40,5 60,5 ~65,0 60,-40"},
    {"12.4.2 (3)", "G53 to the programmed point itself", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG53 X40. Y0\nX60.\nX80.\nG40 X90.\n", "0,5 40,5 40,0 60,5 80,5 90,0"},
    {"12.4.2 (4)", "G30", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG30 X40. Y30.\nX80. Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 40,30 0,0 58.82,35 0,35 60,60"},
    {"12.4.2 (4)", "G29: without vector to the intermediate point, back to the compensated path (14.8 (5))", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY20.\nG28 X30. Y40.\nG29 X20. Y50.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,18.82 30,40 0,0 30,40 17.929,45 0,45 60,60"},
    {"12.4.2 (4)", "G33: no compensation in that block", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nS100 M3\nG33 X20. Y50. F1.\nG1 X0 F500\nG40 X60. Y60.\n", "0,5 35,5 35,36.91 20,50 0,45 60,60"},
    {"12.4.2 (4)", "G53: the vector is taken away", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG53 X30. Y30.\nY40.\nX0\nG40 X60. Y60.\n", "0,5 33.063,5 30,30 25,35 0,35 60,60"},
    {"12.4.2 (4)", "G92: vectors do not change", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG92 X0 Y0\nX-40.\nG40 X-60. Y20.\n", "0,5 35,5 35,35 0,35 -20,60"},
    {"12.4.2 (5)", "M: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nM8\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "S: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nS1000\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "T: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nT5\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "dwell: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG4 X1.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "G22: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG22 X-100. Y-100. Z-100. I-200. J-200. K-200.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "G10: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG10 L2 P3 X1.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "movement across the plane: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nZ-1.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,5,-1 35,40,-1 60,60,-1"},
    {"12.4.2 (5)", "a G code only: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG94\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "G91, movement 0: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG91 X0\nG90\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "F only: a block without movement, looked over", "", "G41 D1 G1 X0 Y0 F500\nX40.\nF300\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "up to three of them: the meeting as usual", "", "G41 D1 G1 X0 Y0 F500\nX40.\nM8\nS1000\nG4 X1.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "four of them: the block before ends at right angles", "", "G41 D1 G1 X0 Y0 F500\nX40.\nM8\nS1000\nG4 X1.\nF300\nY40.\nG40 X60. Y60.\n", "0,5 40,5 35,40 60,60"},
    {"12.4.2 (5)", "G41 alone: the vector stands at right angles at the start of the block behind", "", "G41 D1\nG1 X20. Y0 F500\nY40.\nG40 X60. Y60.\n", "-17.764,24.472 15,8.09 15,40 60,60"},
    {"12.4.2 (5)", "G41 and four of them: no vector, the next block leads to its end", "", "G41 D1\nM20\nM21\nM22\nM23\nG1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "2.071,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "G41 and M00: no vector", "", "G41 D1\nM0\nG1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "2.071,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "the start moves and four of them follow: no vector", "", "G41 D1 G1 X0 Y0 F500\nM20\nM21\nM22\nM23\nX40.\nY40.\nG40 X60. Y60.\n", "0,0 35,5 35,40 60,60"},
    {"12.4.2 (5)", "G40 without movement: the following movement ends without compensation", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 M5\nX60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (5)", "... and G41 without one between: a new start", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG40\nM8\nG41 D1\nY40.\nX0\nG40 X60. Y60.\n", "0,5 40,5 35,0 35,35 0,35 60,60"},
    {"12.4.2 (5)", "... with a movement and another amount", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG40\nG41 D2 Y40.\nX0\nG40 X60. Y60.\n", "0,5 40,5 40,32 0,32 60,60"},
    {"12.4.2 (6)", "G40 I J: the meeting with a hypothetical path along the words", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60. I10. J0\n", "0,5 35,5 35,45 60,60"},
    {"12.4.2 (6)", "... parallel to the last block: at right angles", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60. I0 J10.\n", "0,5 35,5 35,40 60,60"},
    {"12.4.2 (7)", "corner movement: straight between several vectors", "", "G41 D1 G1 X0 Y0 F500\nX40.\nX0 Y-10.\nG40 Y-60.\n", "0,5 45,5 46.063,-3.638 1.213,-14.851 0,-60"},
    {"12.4.3 (2)", "G41 I J: at right angles to the words, turned to the left, no meeting", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG41 Y40. I3. J4.\nX0\nG40 X60. Y60.\n", "0,5 35,5 36,43 0,35 60,60"},
    {"12.4.3 (2)", "G42 I J: turned to the right", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG42 Y40. I3. J4.\nX80.\nG40 X100. Y60.\n", "0,5 45,5 44,37 80,35 100,60"},
    {"12.4.3 (2)", "without movement the vector holds from there", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG41 I5.\nY40.\nX0\nG40 X60. Y60.\n", "0,5 40,5 35,35 0,35 60,60"},
    {"12.4.3 (2)", "the amount is that of D in force in the block", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG41 Y40. I0 J5. D2\nX0\nG40 X60. Y60.\n", "0,5 35,5 32,40 0,32 60,60"},
    {"12.4.3 (2)", "at a start with movement", "", "G41 D1 G1 X0 Y0 I3. J4. F500\nX40.\nY40.\nG40 X60. Y60.\n", "-4,3 35,5 35,40 60,60"},
    {"12.4.3 (2)", "at a start without movement", "", "G41 D1 I4. J-3.\nG1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "-17,24 2.071,5 35,5 35,40 60,60"},
    {"12.4.3 (3)", "I J and an acute corner: no block is inserted", "", "G41 D1 G1 X0 Y0 F500\nG41 X40. I1. J0\nX0 Y-20.\nG40 Y-60.\n", "0,5 40,5 2.236,-24.472 0,-60"},
    {"12.4.5 (1)", "H instead of D: P170", "", "G41 H1 G1 X0 Y0 F500\nX40.\n", "P170 L1"},
    {"12.4.5 (2)", "the vector at a block's end has the amount of that block", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40. D2\nX0\nG40 X60. Y60.\n", "0,5 35,5 32,32 0,32 60,60"},
    {"12.4.5 (3)", "a negative amount: the other side", "", "G10 L10 P3 R-5.\nG41 D3 G1 X0 Y0 F500\nX40.\nY-40.\nG40 Y-60.\n", "0,-5 35,-5 35,-40 40,-60"},
    {"12.4.7", "start, three blocks without movement: the vector is right", "", "G91 G0 G41 D1 X20. Y-20.\nS1000\nM3\nG1 Z-5. F100\nY40. F500\nX40.\nG40 Y20.\n", "-5,0 -5,0,-5 -5,45,-5 40,45,-5 40,60,-5"},
    {"12.4.7", "... four: none, and an overcut", "", "G91 G0 G41 D1 X20. Y-20.\nS1000\nM3\nG1 Z-4. F100\nZ-1.\nY40. F500\nX40.\nG40 Y20.\n", "0,0 0,0,-4 0,0,-5 -5,45,-5 40,45,-5 40,60,-5"},
    {"12.4.8", "the printed program up to r = 16.18: no interference", "", "G10 L10 P1 R16.\nG0 X-40. Y80.\nG41 D1 G1 X0 Y0 F500\nX50. Y-100.\nX70.\nX120. Y0\nX200.\nG40 Y60.\n", "-40,80 14.311,7.155 59.889,-84 60.111,-84 110.111,16 200,16 200,60"},
    {"12.4.8", "above: P153 in front of the block", "", "G10 L10 P1 R17.\nG0 X-40. Y80.\nG41 D1 G1 X0 Y0 F500\nX50. Y-100.\nX70.\nX120. Y0\nX200.\nG40 Y60.\n", "-40,80 15.205,7.603 P153 L4"},
    {"12.4.8", "#8102: N1 and N3 are joined", "8102", "G10 L10 P1 R17.\nG0 X-40. Y80.\nG41 D1 G1 X0 Y0 F500\nX50. Y-100.\nX70.\nX120. Y0\nX200.\nG40 Y60.\n", "-40,80 15.205,7.603 60,-81.987 109.493,17 200,17 200,60"},
    {"12.4.8", "#8103: no check", "8103", "G10 L10 P1 R17.\nG0 X-40. Y80.\nG41 D1 G1 X0 Y0 F500\nX50. Y-100.\nX70.\nX120. Y0\nX200.\nG40 Y60.\n", "-40,80 15.205,7.603 60.507,-83 59.493,-83 109.493,17 200,17 200,60"},
    {"12.4.8", "the edited program passes", "", "G10 L10 P1 R17.\nG0 X-40. Y80.\nG41 D1 G1 X0 Y0 F500\nX20. Y-40.\nX70.\nX120. Y0\nX200.\nG40 Y60.\n", "-40,80 15.205,7.603 30.507,-23 64.037,-23 114.037,17 200,17 200,60"},
    {"12.4.8 (2)(c)", "a groove narrower than the tool", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY-30.\nX49.\nY0\nX100.\nG40 Y60.\n", "0,5 45,5 P153 L3"},
    {"12.4.8 (2)(c)", "... with the avoidance, too", "8102", "G41 D1 G1 X0 Y0 F500\nX40.\nY-30.\nX49.\nY0\nX100.\nG40 Y60.\n", "0,5 45,5 P153 L3"},
    {"12.4.8 (2)(c)", "... widening walls: P153", "8102", "G41 D1 G1 X0 Y0 F500\nX40.\nX35. Y-30.\nX54.\nX49. Y0\nX100.\nG40 Y60.\n", "0,5 P153 L2"},
    {"App. 1, P40", "a short block, which the one behind it makes possible", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY3.\nX50. Y5.\nX100.\nG40 Y50.\n", "0,5 35,5 35,7.099 49.505,10 100,10 100,50"},
    {"App. 1, P40", "an alarm in that one is the one that is given, and the short block does not run back", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY3.\nX50. Y5. D999\n", "0,5 35,5 P170 L4"},
    {"App. 1, P40", "an interference in front of it comes first", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY-30.\nX49.\nY0\nX100. D999\n", "0,5 45,5 P153 L3"},
    {"App. 1, P40", "... unless a block behind might avoid it", "8102", "G41 D1 G1 X0 Y0 F500\nX40.\nX43. Y-30.\nX46.\nX49. Y0\nX100. D999\n", "0,5 44.525,5 P170 L6"},
    {"12.4.9", "#8117: D is a diameter", "8117", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "0,2.5 37.5,2.5 37.5,40 60,60"},
    {"12.4.9", "... no parameter is set in the mode (P241 is printed; App. 1, 13.11: P421)", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG10 L70\nP8117 D1\nG11\n", "0,5 40,5 P421 L3"},
    {"App. 1, 2", "G31 in the mode: P608", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG31 X50. F10\n", "0,5 40,5 P608 L3"},
    {"App. 1, 2", "a cycle in the mode: P155", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG81 X50. Z-5. R1.\n", "0,5 40,5 P155 L3"},
    {"App. 1, 2", "another plane in the mode: P112", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG18 X50.\n", "0,5 40,5 P112 L3"},
    {"App. 1, 2", "... and behind G40 as long as no axis has moved", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40\nG18 X50.\n", "0,5 35,5 35,40 P112 L5"},
    {"App. 2", "the plane in force again", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG17 Y40.\nG40 X60. Y60.\n", "0,5 35,5 35,40 60,60"},
    {"App. 2", "beside G04 the codes G40 to G42 are ignored", "", "G41 D1 G4 X1.\nG1 X0 Y0 F500\nX40.\n", "0,0 40,0"},
    {"App. 2", "... beside G10", "", "G41 D1 G10 L2 P1 X0\nG1 X0 Y0 F500\nX40.\n", "0,0 40,0"},
    {"App. 2", "... beside G28", "", "G41 D1 G28 X0\nG1 X0 Y0 F500\nX40.\n", "0,20 0,0 40,0"},
    {"6.10", "G12.1 in the mode: P485", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG12.1\n", "0,5 40,5 P485 L3"},
    {"13.10", "G12: compensated on top of its own D", "", "G41 D1 G1 X0 Y0 F500\nX10.\nG12 I20. D3\nY40.\nG40 X60. Y60.\n", "0,5 5.858,5 ~35,0 ~35,0 ~5,0 5,40 60,60"},
    {"13.7", "`,C`: compensation acts on the chamfered shape", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40. ,C4.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,33.929 33.929,35 0,35 60,60"},
    {"13.7", "`,R`", "", "G41 D1 G1 X0 Y0 F500\nX40.\nY40. ,R8.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,32 ~32,35 0,35 60,60"},
    {"13.19", "G51: the shape is scaled, not the amount", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG51 X0 Y0 P2.\nY40.\nG40 X60. Y60.\n", "0,5 35,5 35,80 120,120"},
    {"13.20", "G68: the shape is rotated", "", "G68 X0 Y0 R90.\nG41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "-5,0 -5,35 -40,35 -60,60"},
    {"13.x", "G51.1: mirrored behind compensation", "", "G51.1 X0\nG41 D1 G1 X0 Y0 F500\nX40.\nY40.\nG40 X60. Y60.\n", "0,5 -35,5 -35,40 -60,60"},
    {"14.10", "another coordinate system does not cancel", "", "G10 L2 P2 X1. Y1.\nG41 D1 G1 X0 Y0 F500\nX40.\nG55 Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,36 1,36 61,61"},
    {"14.11", "G52: the local coordinates are others, the vectors stay", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG52 X1. Y1.\nY40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,36 1,36 61,61"},
    {"6.8", "G60: positions, and is compensated like G00", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG60 Y40.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,35 0,35 60,60"},
    {"12.6", "G45 in the mode: its displaced point is compensated", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG45 Y40. D1\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,40 0,40 60,60"},
};

constexpr Row kInSpace[] = {
    {"12.5", "start: to the end and the vector", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\n", "0,0 -15.774,-25.774,-15.774"},
    {"12.5", "2-D: a start that lacks one of I J K is that of the plane", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. D3\n", "0,0 -2.929,-27.071,-10"},
    {"12.5", "2-D: in its mode I J K are no three-dimensional command", "", "G41 D1 G1 X0 Y0 F500\nX40.\nG41 Y40. Z9. I0 J5. K5.\nX0\nG40 X60. Y60.\n", "0,5 35,5 35,40,9 0,35,9 60,60,9"},
    {"12.5", "2-D: G42 without I J K changes the modal, the vector stays", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG42 X-30.\nX-40. I-5. J-5. K-5.\n", "0,0 -15.774,-25.774,-15.774 -35.774,-25.774,-15.774 -34.226,-14.226,-4.226"},
    {"12.5", "tool length: added behind it", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG10 L10 P4 R3.\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG43 H4 Z-20.\n", "0,0 -15.774,-25.774,-15.774 -15.774,-25.774,-22.774"},
    {"12.5", "tool position: added behind it, by its own D", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG45 X-30. D1\n", "0,0 -15.774,-25.774,-15.774 -40.774,-25.774,-15.774"},
    {"12.5", "fixed cycle: P155", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG81 X9. Z-5. R1.\n", "0,0 -15.774,-25.774,-15.774 P155 L4"},
    {"12.5", "scaling: of the points, not of I J K and the amount", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG51 X0 Y0 P0.5\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nX-30. Y-30. Z-20.\n", "0,0 -10.774,-15.774,-15.774 -20.774,-20.774,-25.774"},
    {"12.5", "G68: of the points, I J K do not rotate", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG68 X0 Y0 R45.\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nX-30. Y-30. Z-20.\n", "0,0 1.298,-26.987,-15.774 -5.774,-48.2,-25.774"},
    {"12.5", "mirror image: of the points and of I J K", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG51.1 X0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\n", "0,0 15.774,-25.774,-15.774"},
    {"12.5", "G31: P608", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG31 X9. F100\n", "0,0 -15.774,-25.774,-15.774 P608 L4"},
    {"12.5", "G27: P434", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG27 X0 Y0 Z0\n", "0,0 -15.774,-25.774,-15.774 -5.774,-5.774,-5.774 P434 L4"},
    {"12.5", "G53: all axes without compensation at its end", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nX-30. Y-30. Z-20.\nG53 Y0\nX-40.\n", "0,0 -15.774,-25.774,-15.774 -35.774,-35.774,-25.774 -30,0,-20 -45.774,-5.774,-25.774"},
    {"12.5", "G53 in G91: the words less their vector, the others by less theirs", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nX-50. Y-20. Z-10.\nG91 G53 Y20.\n", "0,0 -15.774,-25.774,-15.774 -55.774,-25.774,-15.774 -50,0,-10"},
    {"12.5", "G92 in the start block: the vector alone moves", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG92 G41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\n", "0,0 -5.774,-5.774,-5.774"},
    {"12.5", "G28: all axes without compensation at the intermediate point", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG28 X-30. Y0 Z0\n", "0,0 -15.774,-25.774,-15.774 -30,0 0,0"},
    {"12.5", "cancel alone: back by the vector", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nG40\n", "0,0 -15.774,-25.774,-15.774 -10,-20,-10"},
    {"12.5", "D00 cancels", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X-10. Y-20. Z-10. I-5. J-5. K-5. D3\nX-30. D0\n", "0,0 -15.774,-25.774,-15.774 -30,-20,-10"},
    {"12.5", "I J K overflow: P35", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG41 X1. I0 J0 K0 D3\n", "0,0 P35 L3"},
    {"12.5", "G41 with I J K in arc mode: P150", "", "G10 L10 P3 R10.\nG0 X0 Y0\nG1 F500 X1.\nG2 X10. I4.5\nG41 I1. J1. K1. D3\n", "0,0 1,0 ~10,0 P150 L5"},
};
// clang-format on

class RadiusCompensation : public testing::TestWithParam<Row> {};

TEST_P(RadiusCompensation, DoesWhatTheManualSays) { EXPECT_EQ(path_of(GetParam()), GetParam().path) << GetParam().program; }

INSTANTIATE_TEST_SUITE_P(OfThePlane, RadiusCompensation, testing::ValuesIn(kOfThePlane));
INSTANTIATE_TEST_SUITE_P(InSpace, RadiusCompensation, testing::ValuesIn(kInSpace));

}  // namespace
}  // namespace nc::test
