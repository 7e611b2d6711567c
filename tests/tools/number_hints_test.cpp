// SPDX-License-Identifier: Apache-2.0
// Looking for dwells alone passes over nearly all lines of a text and finds what reading every block finds.
#include <gtest/gtest.h>

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
