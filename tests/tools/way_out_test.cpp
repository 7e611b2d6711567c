// SPDX-License-Identifier: Apache-2.0
// Whether a loop has an end by what is written: where it is not plain that it has none, it may have one.
#include "tools/lib/way_out.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace nc::tools {
namespace {

// The loop of the whole text.
bool out(const std::string& text, nc_dialect dialect = NC_DIALECT_M700) {
  return has_way_out(dialect, text, 1, static_cast<uint32_t>(std::count(text.begin(), text.end(), '\n') + 1));
}

TEST(WayOut, NoneWhereEveryWayStaysInTheLoop) {
  for (const char* text : {"N1 X1\n#500=#500+1\nGOTO1", "n1 x1\ngoto 1", "N0001 X1\nGOTO 1", "N1 X1 (M30)\nGOTO1 (IF)", "DO1\nX1\nEND1", "N1 WHILE[#1LT5]DO1\n#1=#1+1\nEND1\nGOTO1",
                           "N1 IF[#1EQ2]GOTO3\nX1\nN3 Y1\nGOTO1", "N1 X1 M8\nM98 P1000\nGOTO1", "N1 IF[#1EQ1]THEN #2=3\nGOTO1"})
    EXPECT_FALSE(out(text)) << text;
  EXPECT_FALSE(out("N1 X1\nGOTO N1", NC_DIALECT_HX));
  EXPECT_FALSE(has_way_out(NC_DIALECT_M700, "T1 M6\nN1 X1\nGOTO1\nM30", 2, 3)) << "what stands around it does not count";
}

TEST(WayOut, OfEveryKind) {
  for (const char* text : {"N1 X1\nIF[#500LT9]GOTO1", "N1 X1\nGOTO#1", "N1 X1\nGOTO[#1]", "N1 IF[#1EQ2]GOTO3\nGOTO1", "N1 IF[#1EQ2]GOTO#3\nGOTO1", "N1 X1\nM30\nGOTO1", "N1 X1\nM02\nGOTO1", "N1 X1\nM#1\nGOTO1",
                           "N1 X1\nM99 P3\nGOTO1", "N1 X1\nM98 P#1\nGOTO1", "WHILE[#1LT5]DO1\nX1\nEND1", "N1 WHILE[#1LT5]DO1\nGOTO1", "N1 X1\n/GOTO1", "N1 X1\nY1", "N1 X1\nGOTO"})
    EXPECT_TRUE(out(text)) << text;
  const std::string twice = "N1 X1\nGOTO1\nN1 M30";
  EXPECT_TRUE(has_way_out(NC_DIALECT_M700, twice, 1, 2)) << "the number stands outside as well";
  for (const auto& [first, last] : {std::pair{0u, 1u}, {2u, 1u}, {1u, 9u}}) EXPECT_TRUE(has_way_out(NC_DIALECT_M700, twice, first, last)) << first;
}

TEST(WayOut, ATextThatIsCalledMayNotReturn) {
  EXPECT_FALSE(may_not_return(NC_DIALECT_M700, "O1000\nG0 X1.\nIF[#1EQ1]GOTO5\nX2.\nN5 M99\n"));
  for (const char* text : {"O1000\nM30\n", "M99 P20\n", "M98 P#5\nM99\n", "M[#1]\nM99\n"}) EXPECT_TRUE(may_not_return(NC_DIALECT_M700, text)) << text;
}

}  // namespace
}  // namespace nc::tools
