// SPDX-License-Identifier: Apache-2.0
// Looking for dwells, or for lengths without a point, passes over nearly all lines of a text and finds what reading every block finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>

#include "tools/lib/dialect_names.hpp"
#include "tools/lib/number_hints.hpp"

namespace nc::tools {
namespace {

void expect_the_same(const std::string& text) {
  for (const std::string& family : dialect_names()) {
    nc_dialect dialect{};
    ASSERT_EQ(nc_dialect_get(family.c_str(), &dialect), NC_OK);
    const NumberHints all = number_hints(text, dialect, "XYZ", true), dwells = number_hints(text, dialect, "XYZ", false);
    EXPECT_EQ(dwells.dwells, all.dwells) << family << ": " << text;
    EXPECT_EQ(dwells.first_dwell, all.first_dwell) << family << ": " << text;
    EXPECT_EQ(dwells.dwell_word, all.dwell_word) << family << ": " << text;
  }
}

TEST(NumberHints, ADwellIsFoundHoweverItsCodeIsWritten) {
  const char* const dwell[] = {"G4 P1.5",   "g4 p1.5",   "G04X2.",       "X2.G04",       "G 4 P1.",       "G0 4 P1.",       "G(a)4 P1.",     "G4(a)P1.",      "G4.P1.",
                               "G4.0 P1.",  "G+4 P1.",   "G#1 P1.",      "G[4] P1.",     "G000000004P1.", "G1 G4 P1.",      "G4\tP1.",       "G4 \r P1.",     "N4 G4 P1.",
                               "/G4 P1.",   "G4;P1.",    "G1 X1;G4 P1.", "G1X1.G4P1.",   "G99999999 P1.", "G4 P1. G10 L2",  "G10 L2 G4 P1.", "G1 X1 ;G4 P1.", "O4 G4 P1.",
                               "(G4 P1.)",  "G4 P1",     "G4 U1.",       "G65 P9 G4 X1.", "M98 G4 P1.",   "GOTO 4",         "G41 X1.",       "G4",            "IF[#1 GT 1.]GOTO4"};
  for (const std::string before : {"", "G1 X1. Y2.\nX3.\n", "%\nO1(G4)\n\n"})
    for (const char* const line : dwell)
      for (const std::string behind : {"", "\n", "\nX1.\nG4 P2.5\nM30\n"}) expect_the_same(before + line + behind);
}

TEST(NumberHints, LinesOfDataAreNoDwells) {
  for (const std::string begin : {"G10 L70\n", "G10L50\n", "g10 l70\n", "G1 X1.\nG10 L70 (a)\n"})
    for (const std::string end : {"G11\n", "g11\n", "", "G1 X1.\n"}) expect_the_same(begin + "G4 P1.5\nX1.\n" + end + "G1 X1.\nG4 P2.5\n");
}

/// What number_hints() finds when it reads every block: nothing is passed over before a length with a point was read, so texts that are read line by line are.
NumberHints read_line_by_line(const std::string& text, nc_dialect dialect) {
  NumberHints all;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const NumberHints line = number_hints(text.substr(begin, end - begin), dialect, "XYZ", true);
    if (all.without_point == 0 && line.without_point != 0) {
      all.first_without = 1 + static_cast<uint32_t>(std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(begin), '\n'));
      all.first_word = line.first_word;
    }
    if (line.largest_without > all.largest_without) {
      all.largest_without = line.largest_without;
      all.largest_word = line.largest_word;
    }
    all.without_point += line.without_point;
    all.with_point = all.with_point || line.with_point;
    all.dwells += line.dwells;
    begin = end;
  }
  return all;
}

TEST(NumberHints, ALengthWithoutAPointIsFoundAmongAnyLines) {
  const char* const line[] = {"X1.",        "N12 X1.5 Y2.",    "X10",           "G1X1.Y-20F100", "G4 P1.5",        "G4 X3",       "(X7)",      "X(a)7",       "G81 X1. Z-3. R2 Q4.", "G2 X1. I5",
                              "G83 Q3000 Z-2.", "M98 P7 L2",   "T12 M6",        "G65 P9 X4 Y5.", "G1 X1.,C2",      "G1 X1.,R.5",  "x9",        "X#1",         "X[10]Y3",            "G04 P100",
                              "X 1 2",      "X-.5",            "S1000 M3 F200", "G10 L2 P1 X5",  "/N5 X1. Z8",     "H3 D2 P5",    "#100=5",    "IF[#1 EQ 2]GOTO 10", "A90 B1.", "",
                              "G41 D1 X1.", "G52 X2 Y3.",      "K4",            "R6.5",          "G92 X0 Y00.0 Z0", "Y+77",       "X1.Y",      "Y.",          "U5 V6. W7",          "G68 X0. Y0. R45"};
  for (const std::string& family : dialect_names()) {
    nc_dialect dialect{};
    ASSERT_EQ(nc_dialect_get(family.c_str(), &dialect), NC_OK);
    std::mt19937 random(7);
    for (unsigned round = 0; round < 40; ++round) {
      std::string text;
      for (unsigned i = 0; i < 400; ++i) text += random() % 3 != 0 ? "G1 X1.25 Y-3.5\n" : std::string(line[random() % std::size(line)]) + (random() % 9 == 0 ? "\r\n" : "\n");
      const NumberHints found = number_hints(text, dialect, "XYZ", true), all = read_line_by_line(text, dialect);
      EXPECT_EQ(found.with_point, all.with_point) << family << ": " << text;
      EXPECT_EQ(found.without_point, all.without_point) << family << ": " << text;
      EXPECT_EQ(found.first_without, all.first_without) << family << ": " << text;
      EXPECT_EQ(found.first_word, all.first_word) << family << ": " << text;
      EXPECT_EQ(found.largest_word, all.largest_word) << family << ": " << text;
      EXPECT_EQ(found.dwells, all.dwells) << family << ": " << text;
    }
  }
}

TEST(NumberHints, TheLineOfTheFirstDwellIsCounted) {
  nc_dialect dialect{};
  ASSERT_EQ(nc_dialect_get("m700", &dialect), NC_OK);
  const NumberHints hints = number_hints("G1 X1.\n\nX2.\nG4 P1.5\nX3.\nG4 P2.5", dialect, "XYZ", false);
  EXPECT_EQ(hints.dwells, 2u);
  EXPECT_EQ(hints.first_dwell, 4u);
  EXPECT_EQ(hints.dwell_word, "P1.5");
}

}  // namespace
}  // namespace nc::tools
