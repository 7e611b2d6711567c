// SPDX-License-Identifier: Apache-2.0
// HX 3.1: every code of the table, one row for each: what a program with it does by its section, and which words and neighbours it cannot have, with the alarm
// on the line of the block. Where sentences of the manual are lost, docs/decisions.md says what was chosen.
#include "support/code_rows.hpp"

namespace nc::test {
namespace {

/// D1 is 3 mm, H1 is 10 mm; the 2nd reference position is at 100, 200, 300.
Outcome run_of(const std::string& text) {
  Bench bench(NC_DIALECT_HX, axes("XYZc"));
  bench.tool(1, 3, NC_TOOL_RADIUS).tool(1, 10, NC_TOOL_LENGTH);
  bench.param("22097", "100").param("22098", "200").param("22099", "300").param("3061", "2").param("3151", "0.01");
  return bench.run(text + "\nM30");
}

const CodeRow kRows[] = {
    {"G00", "G00 X1. Y2. Z3. C4. F5.\nX-1.", {"rapid 1 2 3 4", "rapid -1 2 3 4"}, "M30",
     {{"G00 X1. ^", "F_82001"}, {"G00 X1.2.3", "F_82004"}, {"G00 X1000000.", "F_82002"}, {"G00 X", "F_82004"}, {"G00 A1.", "NC-AXIS"}}},
    {"G01", "G01 X1. F100.\nY2.\nX5. Y2. ,R1. F50.\nX5. Y9.\nX0 ,C2.\nY0", {"line 1 0 0 0 F100", "line 1 2 0 0 F100", "line 4 2 0 0 F50", "ccw 5 3 0 0 c4,3 F50", "line 5 9 0 0 F50", "line 2 9 0 0 F50",
      "line 0 7 0 0 F50", "line 0 0 0 0 F50"}, "M30",
     {{"G01 X1.", "F_84020"}, {"G01 X1. F0", "F_84020"}, {"G01 X1. F-5.", "F_82002"}}},
    {"G02", "G02 X10. Y10. I10. F100.\nG02 X20. Y0 R10.\nG02 I-5.", {"cw 10 10 0 0 c10,0 F100", "cw 20 0 0 0 c10,0 F100", "cw 20 0 0 0 c15,0 F100"}, "M30",
     {{"G02 X50. Y50.5 I50. F100", "F_82112"}, {"G02 X50. R5. F100", "F_82100"}, {"G02 X50. F100", "F_82112"}, {"G02 X0 Y0 R5. F100", "F_82100"}, {"G02 X10. I5.", "F_84020"}}},
    {"G03", "G03 X10. Y10. J10. F100.\nG03 X0 Y0 Z4. R10.", {"ccw 10 10 0 0 c0,10 F100", "ccw 0 0 4 0 c10,0 F100"}, "M30", {{"G03 X50. Y52. J50. F100", "F_82112"}, {"G03 X50. R-5. F100", "F_82100"}}},
    {"G04", "G04 P1500\nG04 X2.5", {}, "M30", {{"G04 X-1.", "F_82002"}, {"G04 P-1", "F_82002"}}},
    {"G09", "G09 G01 X1. F100\nX2.", {"line 1 0 0 0 F100", "line 2 0 0 0 F100"}, "M30", {{"G09 G01 X1.", "F_84020"}}},
    {"G10", "G10 L10 P2 R5.\nG43 H2 Z0\nG10 L12 P2 R4.\nG41 D2 X0 Y10.\nX0 Y20.", {"rapid 0 0 5 0", "rapid -4 10 5 0", "rapid -4 20 5 0"}, "M30",
     {{"G10 P1 R1.", "NC-DATA"}, {"G10 L99 P1 R1.", "NC-DATA"}, {"G10 L10 P129 R1.", "NC-DATA"}, {"G10 L10 R1.", "NC-WORDS"}, {"G10 L10.9 P1 R1.", "F_82004"}}},
    {"G10.3", "G10.3\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G11.3", "G10.3\nG11.3\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G15", "G16 X10. Y90.\nG15\nX1. Y1.", {"rapid 0 10 0 0", "rapid 1 1 0 0"}, "M30", {}},
    {"G16", "G16\nX10. Y90.\nY180.\nX20.", {"rapid 0 10 0 0", "rapid -10 0 0 0", "rapid -20 0 0 0"}, "M30", {}},
    {"G17", "G18\nG17 G02 X10. I5. F100", {"cw 10 0 0 0 c5,0 F100"}, "M30", {}},
    {"G18", "G18 G02 X10. I5. F100", {"cw 10 0 0 0 c0,5 F100"}, "M30", {{"G41 D1 X5.\nX9.\nG18", "NC-OFFSET-CODE"}}},
    {"G19", "G19 G03 Y10. J5. F100", {"ccw 0 10 0 0 c5,0 F100"}, "M30", {{"G41 D1 X5.\nX9.\nG19", "NC-OFFSET-CODE"}}},
    {"G20", "G20\nX1.\nX5000\nG01 Y1. F2.", {"rapid 25.4 0 0 0", "rapid 12.7 0 0 0", "line 12.7 25.4 0 0 F50.8"}, "M30", {}},
    {"G21", "G20\nG21\nX1.\nX5000", {"rapid 1 0 0 0", "rapid 5 0 0 0"}, "M30", {}},
    {"G22", "X-20.\nG22 X10. Y10. Z10. I-10. J-10. K-10.\nY20.", {"rapid -20 0 0 0", "rapid -20 20 0 0"}, "M30",
     {{"X-20.\nG22 X10. Y10. Z10. I-10. J-10. K-10.\nX0", "NC-LIMIT"}, {"X-20.\nG22 X10. Y10. Z10. I-10. J-10. K-10.\nX20.", "NC-LIMIT"},
      {"G22", "NC-WORDS"}, {"X-20.\nG22 X10. Y10. Z10. I-10. J-10. K-10.\nG23\nG22\nX0", "NC-LIMIT"}}},
    {"G23", "X-20.\nG22 X10. Y10. Z10. I-10. J-10. K-10.\nG23\nX0", {"rapid -20 0 0 0", "rapid 0 0 0 0"}, "M30", {}},
    {"G27", "X5.\nG27 X0", {"rapid 5 0 0 0", "rapid 0 0 0 0"}, "M30", {{"G27 X5.", "F_82209"}, {"G27", "NC-WORDS"}, {"G51 X0 Y0 P2000\nG27 X0", "NC-MODE"}}},
    {"G28", "X5. Y5.\nG28 X10.", {"rapid 5 5 0 0", "rapid 10 5 0 0", "rapid 0 5 0 0"}, "M30", {{"G28", "NC-WORDS"}, {"G68 X0 Y0 R30.\nG28 X0", "NC-MODE"}}},
    {"G29", "X5.\nG28 X10.\nG29 X7.", {"rapid 5 0 0 0", "rapid 10 0 0 0", "rapid 0 0 0 0", "rapid 10 0 0 0", "rapid 7 0 0 0"}, "M30", {{"G51 X0 Y0 P2000\nG29 X0", "NC-MODE"}}},
    {"G30", "X5.\nG30 P2 X10. Y0", {"rapid 5 0 0 0", "rapid 10 0 0 0", "rapid 100 200 0 0"}, "M30", {{"G30 P1 X0", "F_82002"}, {"G30 P5 X0", "F_82002"}, {"G30 P2", "NC-WORDS"}, {"G51 X0 Y0 P2000\nG30 P2 X0", "NC-MODE"}}},
    {"G31", "G31 Z-10. F100\nX1.", {"skip 0 0 -10 0 F100", "rapid 1 0 -10 0"}, "M30", {{"G31 Z-10.", "F_84020"}, {"G41 D1 X5.\nX9.\nG31 X9. F100", "NC-OFFSET-CODE"}}},
    {"G31.1", "G31.1 Z-10. F100", {"skip 0 0 -10 0 F100"}, "M30", {{"G31.1 Z-10.", "F_84020"}}},
    {"G31.2", "G31.2 Z-10. F100", {"skip 0 0 -10 0 F100"}, "M30", {{"G31.2 Z-10.", "F_84020"}}},
    {"G31.3", "G31.3 Z-10. F100", {"skip 0 0 -10 0 F100"}, "M30", {{"G31.3 Z-10.", "F_84020"}}},
    {"G31.4", "G31.4 Z-10. F100", {"skip 0 0 -10 0 F100"}, "M30", {{"G31.4 Z-10.", "F_84020"}, {"G31.5 Z-10. F100", "F_82030"}}},
    {"G33", "S500 M03\nG33 Z-10. F2.", {"thread 0 0 -10 0 F0"}, "S500 M3 M30", {{"S500 M03\nG33 Z-10. F0", "NC-THREAD"}}},
    {"G37", "G43 H1", {"rapid 0 0 10 0"}, "M30", {{"G43 H1\nG37 Z-10.", "F_82002"}, {"G37", "NC-MEASURE"}}},
    {"G37.1", "G43 H1", {"rapid 0 0 10 0"}, "M30", {{"G43 H1\nG37.1 Z-10.", "F_82002"}}},
    {"G37.2", "G43 H1", {"rapid 0 0 10 0"}, "M30", {{"G43 H1\nG37.2 Z-10.", "F_82002"}}},
    {"G37.3", "G43 H1", {"rapid 0 0 10 0"}, "M30", {{"G43 H1\nG37.3 Z-10.", "F_82002"}}},
    {"G37.4", "G43 H1", {"rapid 0 0 10 0"}, "M30", {{"G43 H1\nG37.4 Z-10.", "F_82002"}, {"G37.5 Z-10.", "F_82030"}}},
    {"G39", "G42 D1\nG01 X5. F100\nX10.\nG39 X10. Y10.\nX10. Y10.", {"line 5 -3 0 0 F100", "line 10 -3 0 0 F100", "ccw 13 0 0 0 c10,0 F100", "line 13 10 0 0 F100"}, "M30", {{"G39 X1.", "NC-OFFSET-CODE"}, {"G41 D1\nG01 X10. F100\nX20.\nG39 X20. Y10.", "NC-OFFSET-PATH"}}},
    {"G40", "G41 D1 X0 Y10.\nX0 Y20.\nG40 X5. Y30.", {"rapid -3 10 0 0", "rapid -3 20 0 0", "rapid 5 30 0 0"}, "M30", {{"G41 D1 X5.\nX9. F100\nG40 G02 X10. I.5", "NC-OFFSET-START"}}},
    {"G41", "G41 D1 X0 Y10.\nX0 Y20.\nZ5.", {"rapid -3 10 0 0", "rapid -3 20 0 0", "rapid -3 20 5 0"}, "M30",
     {{"G41 D1 G02 X10. I5. F100", "NC-OFFSET-START"}, {"G41 D129 X1.", "NC-OFFSET-DATA"}, {"G41 D1.5 X1.", "F_82004"}, {"G41 D1 X5.\nX9.\nG81 Z-1. R1. F100", "NC-OFFSET-CODE"}}},
    {"G42", "G42 D1 X0 Y10.\nX0 Y20.", {"rapid 3 10 0 0", "rapid 3 20 0 0"}, "M30", {{"G42 D1 G03 X10. I5. F100", "NC-OFFSET-START"}}},
    {"G43", "G43 H1 Z1.\nG43 H0 Z1.", {"rapid 0 0 11 0", "rapid 0 0 1 0"}, "M30", {{"G43 H129 Z1.", "NC-OFFSET-DATA"}, {"G43 H1.5 Z1.", "F_82004"}}},
    {"G44", "G44 H1 Z1.", {"rapid 0 0 -9 0"}, "M30", {{"G44 H129 Z1.", "NC-OFFSET-DATA"}}},
    {"G45", "G91 G45 D1 X10.\nG45 X-10.", {"rapid 13 0 0 0", "rapid 0 0 0 0"}, "M30", {{"G41 D1 X5.\nX9.\nG45 X1.", "NC-OFFSET-CODE"}, {"G81 G45 X1. Z-1. R1. F100", "NC-MODE"}}},
    {"G46", "G91 G46 D1 X10.\nG46 X0", {"rapid 7 0 0 0", "rapid 4 0 0 0"}, "M30", {}},
    {"G47", "G91 G47 D1 X10.", {"rapid 16 0 0 0"}, "M30", {}},
    {"G48", "G91 G48 D1 X10.", {"rapid 4 0 0 0"}, "M30", {}},
    {"G49", "G43 H1 Z1.\nG49 Z1.", {"rapid 0 0 11 0", "rapid 0 0 1 0"}, "M30", {}},
    {"G50", "G51 X0 Y0 P2000\nX1.\nG50\nX3.", {"rapid 2 0 0 0", "rapid 3 0 0 0"}, "M30", {}},
    {"G51", "G51 X0 Y0 Z0 I2000 J-1000 K500\nX1. Y2. Z4.", {"rapid 2 -2 2 0"}, "M30", {{"G51 X0 P0", "F_82002"}, {"G51 C1. P2000", "NC-AXIS"}, {"G51 X0 P100000", "F_82002"}}},
    {"G52", "G52 X5.\nX1.\nG55\nX1.\nG54\nG52 X0\nX1.", {"rapid 6 0 0 0", "rapid 1 0 0 0"}, "M30", {}},
    {"G53", "G52 X5.\nG53 X1.\nX1.\nG91 G53 X9.", {"rapid 1 0 0 0", "rapid 6 0 0 0"}, "M30", {}},
    {"G54", "#2377=1.\nG54 X0", {"rapid 1 0 0 0"}, "M30", {{"G54.1 P1", "F_82030"}}},
    {"G55", "#2386=2.\nG55 X0", {"rapid 2 0 0 0"}, "M30", {}},
    {"G56", "#2395=3.\nG56 X0", {"rapid 3 0 0 0"}, "M30", {}},
    {"G57", "#2404=4.\nG57 X0", {"rapid 4 0 0 0"}, "M30", {}},
    {"G58", "#2413=5.\nG58 X0", {"rapid 5 0 0 0"}, "M30", {}},
    {"G59", "#2422=6.\nG59 X0", {"rapid 6 0 0 0"}, "M30", {}},
    {"G60", "G60 X10.\nX0", {"rapid 8 0 0 0", "rapid 10 0 0 0", "rapid 0 0 0 0"}, "M30", {}},
    {"G61", "G61\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G62", "G62\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G63", "G63\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G63.1", "G63.1\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {{"G63.1\nG01 X1.", "F_84020"}}},
    {"G63.2", "G63.1\nG63.2\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {{"G63.3", "F_82030"}}},
    {"G64", "G61\nG64\nG01 X1. F100", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G65", "G65 P1 L2 A3.\nM30\nO1\nG91 G00 X#1\nM99", {"rapid 3 0 0 0", "rapid 6 0 0 0"}, "M30", {{"G65 P777", "F_82109"}, {"G65 P10.2", "F_82004"}}},
    {"G66", "G66 P1 A3.\nX1.\nG67\nM30\nO1\nY[#1+1]\nM99", {"rapid 1 0 0 0", "rapid 1 4 0 0"}, "M30", {{"G66 P777", "F_82109"}}},
    {"G67", "G66 P1\nX1.\nG67\nX2.\nM30\nO1\nY4.\nM99", {"rapid 1 0 0 0", "rapid 1 4 0 0", "rapid 2 4 0 0"}, "M30", {}},
    {"G68", "G68 X10. Y0 R90.\nX20. Y0", {"rapid 10 10 0 0"}, "M30", {}},
    {"G69", "G68 X0 Y0 R90.\nX10. Y0\nG69\nX1. Y0", {"rapid 0 10 0 0", "rapid 1 0 0 0"}, "M30", {}},
    {"G73", "G99 G73 X1. Z-5. R1. Q4. F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -3 0 F100", "line 1 0 -5 0 F100", "rapid 1 0 1 0"}, "M30", {{"G73 X1. Z-5. R1. F100", "NC-WORDS"}}},
    {"G74", "S300 M04\nG99 G74 X1. Z-1. R1. P500 F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S300 M4 M3 M4 M30", {{"G74 X1. Z-1. R1. F100", "NC-SPINDLE"}}},
    {"G76", "S300 M03\nG99 G76 X1. Z-1. R1. I.5 F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1.5 0 -1 0 F100", "rapid 1.5 0 1 0", "rapid 1 0 1 0"}, "S300 M3 M19 M3 M30",
     {{"G76 X1. Z-1. R1. Q.5 F100", "NC-WORDS"}}},
    {"G80", "G99 G81 X1. Z-1. R1. F100\nG80\nX5.", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0", "rapid 5 0 1 0"}, "M30", {}},
    {"G81", "Z5.\nG98 G81 X1. Z-1. R1. F100\nG91 X2. K2", {"rapid 0 0 5 0", "rapid 1 0 5 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 5 0", "rapid 3 0 5 0", "rapid 3 0 1 0", "line 3 0 -1 0 F100",
      "rapid 3 0 5 0", "rapid 5 0 5 0", "rapid 5 0 1 0", "line 5 0 -1 0 F100", "rapid 5 0 5 0"}, "M30",
     {{"G81 X1. Z-1. R1.", "F_84020"}, {"G81 X1. Z-1. R1. K2.7 F100", "F_82004"}, {"G81 X1. Z-1. R1. K10000 F100", "F_82002"}}},
    {"G82", "G99 G82 X1. Z-1. R1. P500 F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "M30", {{"G82 X1. Z-1. R1. P-1 F100", "F_82002"}}},
    {"G83", "G99 G83 X1. Z-5. R1. Q4. F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -3 0 F100", "rapid 1 0 1 0", "rapid 1 0 -3 0", "line 1 0 -5 0 F100", "rapid 1 0 1 0"}, "M30", {{"G83 X1. Z-5. R1. F100", "NC-WORDS"}}},
    {"G84", "S300 M03\nG99 G84 X1. Z-1. R1. F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "S300 M3 M4 M3 M30", {{"G84 X1. Z-1. R1. F100", "NC-SPINDLE"}}},
    {"G84.2", "S300 M03\nG99 G84.2 X1. Z-1. R1. F450", {"rapid 1 0 0 0", "rapid 1 0 1 0", "tap 1 0 -1 0 F450", "tap 1 0 1 0 F450"}, "S300 M3 M30", {{"S300 M03\nG84.2 X1. Z-1. R1.", "F_84020"}}},
    {"G84.3", "S300 M03\nG99 G84.3 X1. Z-1. R1. F450", {"rapid 1 0 0 0", "rapid 1 0 1 0", "tap 1 0 -1 0 F450", "tap 1 0 1 0 F450"}, "S300 M3 M30", {{"S300 M03\nG84.3 X1. Z-1. R1.", "F_84020"}, {"G84.1 X1.", "F_82030"}}},
    {"G85", "G99 G85 X1. Z-1. R1. F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "M30", {{"G85 X1. Z-1. R1.", "F_84020"}}},
    {"G86", "G99 G86 X1. Z-1. R1. F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "M5 M3 M30", {{"G86 X1. Z-1. R1.", "F_84020"}}},
    {"G87", "S300 M03\nG98 G87 X1. Z1. R-1. I.5 F100", {"rapid 1 0 0 0", "rapid 1.5 0 0 0", "rapid 1.5 0 -1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100", "rapid 1.5 0 1 0", "rapid 1.5 0 0 0", "rapid 1 0 0 0"}, "S300 M3 M19 M3 M19 M3 M30",
     {{"G87 X1. Z1. R-1. F100", "NC-WORDS"}}},
    {"G88", "G99 G88 X1. Z-1. R1. P500 F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "rapid 1 0 1 0"}, "M5 M3 M30", {{"G88 X1. Z-1. R1.", "F_84020"}}},
    {"G89", "G99 G89 X1. Z-1. R1. P500 F100", {"rapid 1 0 0 0", "rapid 1 0 1 0", "line 1 0 -1 0 F100", "line 1 0 1 0 F100"}, "M30", {{"G89 X1. Z-1. R1.", "F_84020"}}},
    {"G90", "G91 X1.\nG90 X3.", {"rapid 1 0 0 0", "rapid 3 0 0 0"}, "M30", {}},
    {"G91", "G91 X1.\nX1.", {"rapid 1 0 0 0", "rapid 2 0 0 0"}, "M30", {}},
    {"G92", "X5.\nG92 X0\nX1.\nG55 X0", {"rapid 5 0 0 0", "rapid 6 0 0 0", "rapid 5 0 0 0"}, "M30", {{"G51 X0 Y0 P2000\nG92 X0", "NC-MODE"}}},
    {"G94", "G95 F1.\nG94 F100\nG01 X1.", {"line 1 0 0 0 F100"}, "M30", {}},
    {"G95", "S500 M03\nG95 F.5\nG01 X1.", {"line 1 0 0 0 F0"}, "S500 M3 M30", {{"G95\nG01 X1.", "F_84020"}}},
    {"G96", "G96 S100", {}, "S100 M30", {}},
    {"G97", "G97 S500", {}, "S500 M30", {}},
    {"G98", "Z5.\nG98 G81 Z-1. R1. F100", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 5 0"}, "M30", {}},
    {"G99", "Z5.\nG99 G81 Z-1. R1. F100", {"rapid 0 0 5 0", "rapid 0 0 1 0", "line 0 0 -1 0 F100", "rapid 0 0 1 0"}, "M30", {}},
    {"G107", "G18\nG107 C57.299\nG107 C0\nX1.", {"rapid 1 0 0 0"}, "M30", {{"G107 X10.", "F_82208"}, {"G107 C-1.", "F_82002"}, {"G18\nG107 C30.\nG28 Z0", "F_82208"}, {"G18\nG51 X0 Y0 P2000\nG107 C10.", "F_82208"}}},
    {"G112", "X50.\nG112\nG113\nX1.", {"rapid 50 0 0 0", "rapid 1 0 0 0"}, "M30", {{"X50.\nG112\nG00 X1.", "F_82204"}, {"X50.\nG112\nG81 Z-1. R1. F100", "F_82204"}, {"X50.\nG51 X0 Y0 P2000\nG112", "F_82204"}}},
    {"G113", "G113\nX1.", {"rapid 1 0 0 0"}, "M30", {}},
    {"M00", "M00\nX1.", {"rapid 1 0 0 0"}, "M0 M30", {{"M3.5", "F_82004"}}},
    {"M01", "M01", {}, "M30", {}},
    {"M02", "M02", {}, "M2", {}},
    {"M30", "X1.", {"rapid 1 0 0 0"}, "M30", {}},
    {"M98", "M98 P1\nM30\nO1\nX1.\nM99", {"rapid 1 0 0 0"}, "M30", {{"M98 P777", "F_82109"}, {"M98 P1.5", "F_82004"}, {"M98", "NC-WORDS"}}},
    {"M99", "N1 G91 X1.\nM99 P1 L2", {"rapid 1 0 0 0", "rapid 2 0 0 0", "rapid 3 0 0 0"}, "M30", {{"M99 P777", "F_82019"}}},
    {"M03", "M03 S5", {}, "S5 M3 M30", {}},
    {"M04", "M04 S5", {}, "S5 M4 M30", {}},
    {"M05", "M05", {}, "M5 M30", {}},
    {"M06", "M06 T1", {}, "T1 M6 M30", {{"M06 T1.5", "F_82004"}}},
    {"M19", "M19", {}, "M19 M30", {}},
};

TEST(HxCodes, DoWhatTheirSectionSays) {
  expect_done(kRows, run_of);
  EXPECT_EQ(run_of("G04 P1500\nG04 X2.5").dwells(), (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(run_of("G82 X1. Z-1. R1. P500 F100\nG89 X2. P250").dwells(), (std::vector<double>{0.5, 0.25}));
  EXPECT_TRUE(run_of("G09 G01 X1. F100\nX2.").moves()[0].exact_stop);
  EXPECT_TRUE(run_of("G61 G01 X1. F100\nX2.").moves()[0].exact_stop);
  EXPECT_FALSE(run_of("G61\nG64 G01 X1. F100\nX2.").moves()[0].exact_stop);
  EXPECT_EQ(run_of("S500 M03\nG95 F.5\nG01 X1.").moves().back().feed_mm_rev, 0.5);
  EXPECT_EQ(run_of("S500 M03\nG33 Z-10. F2.").moves().back().feed_mm_rev, 2);
  for (unsigned i = 1; i <= 4; ++i) EXPECT_EQ(run_of("G31." + std::to_string(i) + " Z-1. F1.").moves().back().skip_mask, 1u << (i - 1));
}

TEST(HxCodes, RefuseWhatTheyCannotHave) { expect_refused(kRows, run_of, 0); }

TEST(HxCodes, AreThoseOfTheTable) { expect_codes_of(NC_DIALECT_HX, kRows); }

}  // namespace
}  // namespace nc::test
